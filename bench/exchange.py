# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What the exchange of proxies costs: messages and bytes, time per step in a model of a network, and on this machine.

counts  Messages and bytes that a rank sends in a step without a rebuild, by the stock exchange and the direct
        one, on grids of ranks; counted by a preloaded library.
hidden  Two ranks of 20 000 spheres in the model of a network of 25 us and 1 GB/s: what overlap hides.
model   Times of a step over latency, bandwidth and size in that model: a preloaded library delivers a message
        no earlier than latency + bytes/bandwidth after it was sent. This is a model, not a network.
real    Two ranks without it: ratio of the times of whole steps, direct over stock, taken in turns.
packing What it takes to pack and to unpack a proxy, without messages.
"""

import itertools
import math
import statistics

import beds
import google
import paired
import plot
from exchange_runs import Bed, LAWS, METHODS, MODEL, Runner, VERLET, counted, ratio, read_turns

TITLE = "Exchange of proxies"
QUESTION = """How many messages and bytes does a rank send in a step, by the exchange of LAMMPS and by the direct one of
comm_proxy? How much of the time of a network does the run style of Talus hide behind the forces between owned particles,
and from which latency and bandwidth on does that pay? And what does the direct exchange cost on this machine?"""

STATED = 20000, 25.0, 1.0      # particles per rank, us, GB/s


def tabulate(bench, columns, rows):
    bench.section.table(columns, rows)
    for row in rows:
        bench.section.record(**dict(zip(columns, row)))


# ---- counts -----------------------------------------------------------------------------------

def counts(bench, runner):
    grids = [(2, 1, 1), (4, 1, 1), (2, 2, 1), (8, 1, 1), (4, 2, 1), (2, 2, 2)]
    if not bench.quick:
        grids += [(16, 1, 1), (4, 4, 1), (4, 2, 2), (64, 1, 1), (8, 8, 1), (4, 4, 4)]
    rows = []
    for grid, law in itertools.product(grids, LAWS):
        if law == "frictionless" and math.prod(grid) > 8:
            continue
        bench.note(f"counts: {grid}, {law}")
        found = {m: counted(runner, grid, law, m) for m in ("stock", "direct")}
        means = {m: [statistics.mean(rank[k] for rank in found[m]) for k in range(3)] for m in found}
        rows.append(["x".join(map(str, grid)), math.prod(grid), law, *means["stock"], *means["direct"],
                     means["direct"][1] / means["stock"][1] if means["stock"][1] else 1.0])
    columns = ["grid", "ranks", "law", *(f"{m} {what}" for m in ("stock", "direct")
                                         for what in ("messages", "bytes", "blocking collectives")), "bytes, direct/stock"]
    bench.section.heading("Messages and bytes")
    tabulate(bench, columns, rows)
    bench.section.text("Per rank and step, means of all ranks; 216 particles per rank at rest, periodic in all directions, "
                       "counted outside of Talus by a preloaded library over steps without a rebuild. direct: "
                       "the run style of Talus, which also has no blocking check for a rebuild. LAMMPS sends a rank with one "
                       "neighbor in a periodic direction two messages; and images travel apart. The direct exchange sends a "
                       "particle once to every rank with a proxy of it, and nothing to the own rank.")


# ---- the model of a network -------------------------------------------------------------------

def plan(bench, size):
    """Steps of a turn, and cycles: a second or two for each method."""
    steps = max(10, min(200, 400000 // size))
    return steps, max(5, bench.size(24, 8) * 20000 // max(20000, size))


def modeled(network, turns):
    """What the model adds to a blocking exchange (us)."""
    latency, bandwidth = network
    return latency + 1e-3 * turns.sent / bandwidth


NONE = 0.0, 1e6     # a network that takes no time


def gains(turns):
    """What overlap gains over the blocking exchange in each cycle (us); without a network its price."""
    return [a - b for a, b in zip(turns["direct"].step, turns["overlapped"].step)]


def share_hidden(without, found, network):
    """By how much more overlap gains with the network than without it, over the time of the network: quartiles."""
    time = modeled(network, found["direct"])
    low, middle, high = statistics.quantiles([(a - b) / time for a, b in zip(gains(found), gains(without))], n=4)
    return paired.Ratio(middle, low, high)


def in_model(bench, runner, bed, size, network, cycles):
    """Turns without and with the network."""
    steps = int(max(10, min(plan(bench, size)[0], 3e4 / max(1.0, network[0]))))
    return read_turns(runner.run(bed.script(METHODS, steps, cycles, networks=(NONE, network)), 2, MODEL))


def hidden(bench, runner):
    size, *network = bench.size(STATED[0], 2000), *STATED[1:]
    bed = Bed(bench, runner, 2 * size)
    without, found = in_model(bench, runner, bed, size, network, 16 * bench.rounds)
    bench.section.heading("Hidden behind the forces")
    tabulate(bench, ["exchange", "us/step without network", "with network", "waiting, without (us/step)", "waiting, with"],
             [[m, without[m].median, found[m].median, without[m].waiting, found[m].waiting] for m in METHODS])
    by_time = share_hidden(without, found, network)
    by_waiting = 1.0 - found["overlapped"].waiting / found["direct"].waiting
    added = [statistics.median(b - a for a, b in zip(without[m].step, found[m].step)) for m in ("direct", "overlapped")]
    bench.section.text(f"""{size} spheres per rank, settled, between walls; two ranks in the model of a network of
{network[0]:g} us and {network[1]:g} GB/s, in which a message of {found["direct"].sent:.0f} bytes takes
{modeled(network, found["direct"]):.0f} us. {len(found["direct"].step)} cycles of short runs in one process, all exchanges with and
without the network in turns; medians over cycles (quartiles). The network adds {added[0]:.0f} us to a step of the blocking
direct exchange and {added[1]:.0f} us to an overlapped one. Hidden, by time per step: what overlap gains with the network
less what it gains without it (its price, negative), over the time of a message: **{by_time}**; over what was added to
the blocking step, {1.0 - added[1] / added[0]:.2f}. Hidden, by the time that ranks wait for proxies: **{by_waiting:.2f}**.
Overlapped over blocking step: {ratio(found["overlapped"], found["direct"])} with the network,
{ratio(without["overlapped"], without["direct"])} without it, where there is nothing to hide: contacts between early and late
particles are computed twice.""")
    bench.section.record(part="hidden", by_time=by_time.median, by_waiting=by_waiting)


def model(bench, runner):
    latencies = bench.size((1, 10, 100, 1000), (5, 400))          # us
    bandwidths = bench.size((0.1, 1.0, 25.0), (1.0,))             # GB/s
    sizes = bench.size((1000, 10000, 100000), (1000,))            # particles per rank
    rows = []
    for size in sizes:
        bed = Bed(bench, runner, 2 * size)
        for network in [(latency, bandwidth) for bandwidth in bandwidths for latency in latencies]:
            without, found = in_model(bench, runner, bed, size, network, max(3, plan(bench, size)[1] // 3))
            share = modeled(network, found["direct"]) / without["direct"].median
            rows.append([size, *network, share, *(without[m].median for m in METHODS), *(found[m].median for m in METHODS),
                         ratio(found["overlapped"], found["direct"]).median,
                         share_hidden(without, found, network).median if share > 0.05 else float("nan")])
            bench.note("model: " + " ".join(f"{x:.4g}" for x in rows[-1]))
    bench.section.heading("A model of a network")
    tabulate(bench, ["particles per rank", "latency (us)", "bandwidth (GB/s)", "network over step",
                     *(f"{m}, no network (us/step)" for m in METHODS), *(f"{m} (us/step)" for m in METHODS),
                     "overlapped over direct", "share hidden"], rows)
    bench.section.text("Two ranks. A preloaded library delivers each message no earlier than latency + bytes/bandwidth after "
                       "it was sent: a model, no network. Network over step: that time over the blocking direct step without "
                       "it. Share hidden: as above; not given below 5 % of a step, where it is noise, and above 1 where the "
                       "blocking step loses more than the time of a message, because ranks wait for each other's delays "
                       "or, where the latency is longer than a step, for the answer whether to make new lists. " +
                       where_it_pays(rows))
    bench.section.plot("model", "Time of a step over the latency of the modeled network",
                       lambda plt: draw_model(plt, rows, sizes, bandwidths))
    bench.section.plot("overlap", "Where overlap pays: overlapped over blocking step (pays below 1), and share of the modeled "
                                  "time that it hides, over the modeled time as a share of a step",
                       lambda plt: draw_overlap(plt, rows, sizes))


def where_it_pays(rows):
    """In words: from where on, and up to where."""
    loses = [row[3] for row in rows if row[10] > 1.01]
    half = [row[3] for row in rows if row[3] > 0.5 and row[11] < 0.5]
    text = "Overlap costs more than it hides "
    text += f"only where the network takes less than {100 * max(loses):.0f} % of a step. " if loses else "nowhere here. "
    if half:
        text += f"It hides less than half where the network takes more than {100 * min(half):.0f} % of a step: " \
                "there is no more work to hide it behind."
    return text


def draw_model(plt, rows, sizes, bandwidths):
    _, axes = plt.subplots(len(sizes), len(bandwidths), squeeze=False, sharex=True, sharey="row",
                           figsize=(2.6 * len(bandwidths), 1.9 * len(sizes)))
    for (i, size), (j, bandwidth) in itertools.product(enumerate(sizes), enumerate(bandwidths)):
        axis = axes[i][j]
        chosen = [row for row in rows if row[0] == size and row[2] == bandwidth]
        for k, (method, style) in enumerate(zip(METHODS, (0, 1, 6))):
            axis.loglog([row[1] for row in chosen], [row[7 + k] for row in chosen], label=method, **plot.style(style))
        axis.set_title(f"{size} per rank, {bandwidth:g} GB/s")
        if i == len(sizes) - 1:
            axis.set_xlabel("latency (us), model")
        if j == 0:
            axis.set_ylabel("us per step")
    axes[0][0].legend()


def draw_overlap(plt, rows, sizes):
    _, (left, right) = plt.subplots(1, 2, figsize=(7.5, 3.2))
    for k, size in enumerate(sizes):
        points = sorted((row[3], row[10], row[11]) for row in rows if row[0] == size)
        style = plot.style((0, 3, 5)[k % 3], linestyle="none")
        left.semilogx([p[0] for p in points], [p[1] for p in points], label=f"{size} per rank", **style)
        clear = [p for p in points if p[2] == p[2]]
        right.semilogx([p[0] for p in clear], [p[2] for p in clear], **style)
    left.axhline(1.0, color="0.4", linewidth=0.8)
    left.set_ylabel("overlapped over blocking step")
    right.set_ylabel("share hidden")
    for axis in left, right:
        axis.set_xlabel("modeled time of the network over step")
    left.legend()


# ---- this machine -----------------------------------------------------------------------------

def cases(bench, runner):
    """(name, bed, methods, steps between rebuilds or 0) one after the other."""
    for size in bench.size((1000, 20000, 100000), (1000,)):
        bed = Bed(bench, runner, 2 * size)
        yield f"{size} per rank", bed, METHODS, 0
        yield f"{size} per rank, lists every 50 steps", bed, METHODS, 50
        if size == 20000 or bench.quick:
            yield f"{size} per rank, without friction", Bed(bench, runner, 2 * size, "frictionless"), METHODS, 0
            stock = Bed(bench, runner, 2 * size, physics=beds.stock())
            yield f"{size} per rank, styles of LAMMPS, lists every 50 steps", stock, VERLET, 50
    tile = Bed(bench, runner, beds.TILE, periodic=True)
    yield f"{beds.TILE // 2} per rank, periodic in x and y", tile, METHODS, 0


def real(bench, runner):
    rows, slower = [], []
    for name, bed, methods, every in cases(bench, runner):
        steps, cycles = plan(bench, bed.count // 2)
        script = bed.script(methods, every or steps, bench.rounds * cycles // 2, every)
        times, = read_turns(runner.run(script))
        ratios = {m: ratio(times[m], times["stock"]) for m in methods}
        rows.append([name, *(times[m].median if m in times else "" for m in METHODS), ratios["direct"],
                     ratios.get("overlapped", "")])
        bench.note(f"real: {name}: direct {ratios['direct']}, overlapped {ratios.get('overlapped', '-')}")
        if ratios["direct"].low > 1.0:
            slower.append(f"{name} ({ratios['direct']})")
    bench.section.heading("Two ranks of this machine")
    tabulate(bench, ["scene", *(f"{m} (us/step)" for m in METHODS), "direct over stock", "overlapped over stock"], rows)
    bench.section.text("Whole steps; ratios are medians over turns of the same process (quartiles). Messages go through shared "
                       "memory: there is little to hide. The direct exchange takes longer than the stock one, with the "
                       "lower quartile above 1, in: " + (", ".join(slower) or "no scene") + ".")
    if slower:
        bench.section.headline("exchange: on this machine the direct exchange is slower than the stock one in: " +
                               ", ".join(slower))


# ---- packing ----------------------------------------------------------------------------------

def packing(bench, runner):
    found = google.run(bench, "packing", 0.002)    # to fill the caches takes much longer
    bench.section.heading("Packing and unpacking")
    if found is None:
        bench.section.text(google.LEFT_OUT)
        return
    functions = sorted({name for name, _ in found})
    rows = []
    for size in sorted({size for _, size in found}):
        times = [paired.Series([1e9 / each["items_per_second"] for each in found[name, size]]).median for name in functions]
        rows.append([size, round(found[functions[0], size][0]["proxies"]), *times])
    tabulate(bench, ["spheres", "proxies", *(f"{name.split('/')[1]} (ns per proxy)" for name in functions)], rows)
    bench.section.text("One rank that is a cube of a lattice with neighbors on all 26 sides: the states of its proxies packed "
                       "for them, and as many unpacked. Caches are filled with something else before, as by a step.")


def measure(bench):
    for name, part in {"counts": counts, "hidden": hidden, "model": model, "real": real, "packing": packing}.items():
        if bench.wants(name):
            part(bench, Runner(bench.workdir))
