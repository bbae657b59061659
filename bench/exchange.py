# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What the exchange of proxies costs: messages and bytes, time per step in a model of a network, and on this machine.

counts  Messages and bytes that a rank sends in a step without a rebuild, by the stock exchange and the direct
        one, on grids of ranks; counted by a preloaded library.
hidden  Two ranks of 20 000 spheres in the model of a network of 25 us and 1 GB/s: what overlap hides.
model   Times of a step over latency, bandwidth and size in that model: a preloaded library delivers a message
        no earlier than latency + bytes/bandwidth after it was sent. This is a model, not a network.
real    Two ranks without it: ratio of the times of whole steps, direct over stock, taken in turns.
"""

import itertools
import math
import statistics

import beds
import paired
import plot
from exchange_runs import Bed, LAWS, METHODS, Runner, VERLET, counted, microseconds, undisturbed, waited

TITLE = "Exchange of proxies"
QUESTION = """How many messages and bytes does a rank send in a step, by the exchange of LAMMPS and by the direct one of
comm_proxy? How much of the time of a network does run_style verlet/proxy hide behind the forces between owned particles,
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
                       "run_style verlet/proxy, which also has no blocking check for a rebuild. LAMMPS sends a rank with one "
                       "neighbor in a periodic direction two messages; and images travel apart. The direct exchange sends a "
                       "particle once to every rank with a proxy of it, and nothing to the own rank.")


# ---- the model of a network -------------------------------------------------------------------

def segments_of(bench, size):
    """Steps of one measurement."""
    return bench.size(max(300, min(3000, 6000000 // size)), max(300, 600000 // size))


def hidden(bench, runner):
    size, latency, bandwidth = (bench.size(STATED[0], 2000), *STATED[1:])
    bed, steps = Bed(bench, runner, 2 * size), bench.size(1500, 600)
    networks = {"without": (0.0, 1e6), "with": (latency, bandwidth)}
    waits = {key: [] for key in itertools.product(METHODS, networks)}

    def variant(method, network):
        def run():
            log = runner.in_model(bed.script(METHODS[method], steps, segments=60), *networks[network])
            if method != "stock":
                waits[method, network].append(waited(log))
            return undisturbed(log)
        return run
    times = paired.measure({key: variant(*key) for key in waits}, bench.rounds)

    bench.section.heading("Hidden behind the forces")
    tabulate(bench, ["exchange", "us/step without network", "with network", "waiting, without (us/step)", "with"],
             [[m, times[m, "without"].median, times[m, "with"].median,
               *(statistics.median(waits[m, n]) if m != "stock" else "" for n in networks)] for m in METHODS])

    def added(method):
        return [b - a for a, b in zip(times[method, "without"].values, times[method, "with"].values)]
    blocking, overlapped = statistics.median(added("direct")), statistics.median(added("overlapped"))
    by_time = 1.0 - overlapped / blocking
    wait = [statistics.median(waits[m, "with"]) for m in ("direct", "overlapped")]
    price = paired.ratio(times["overlapped", "without"], times["direct", "without"])
    bench.section.text(f"""{size} spheres per rank, settled, between walls; two ranks in the model of a network of
{latency:g} us and {bandwidth:g} GB/s; {bench.rounds} rounds in turns, and of each run the lower quartile of 60 short ones. The
network adds {blocking:.0f} us to a step of the blocking direct exchange and {overlapped:.0f} us to an overlapped step:
**{100 * by_time:.0f} % are hidden** by run time. By waiting time, {wait[0]:.1f} us per step become {wait[1]:.1f} us:
{100 * (1 - wait[1] / wait[0]):.0f} % hidden. What overlap itself costs where there is nothing to hide, because contacts
between early and late particles are computed twice: {price} of the blocking step.""")
    bench.section.record(part="hidden", by_time=by_time, by_waiting=1 - wait[1] / wait[0], price=price.median)


def model(bench, runner):
    latencies = bench.size((1, 5, 25, 100, 400, 1000), (5, 400))        # us
    bandwidths = bench.size((0.1, 1.0, 25.0), (1.0,))                   # GB/s
    sizes = bench.size((1000, 5000, 20000, 100000), (1000,))            # particles per rank
    rows = []
    for size in sizes:
        bed, steps = Bed(bench, runner, 2 * size), segments_of(bench, size)

        def times(network):
            return {m: undisturbed(runner.in_model(bed.script(METHODS[m], steps), *network)) for m in METHODS}
        none = times((0.0, 1e6))
        for bandwidth, latency in itertools.product(bandwidths, latencies):
            found = times((latency, bandwidth))
            rows.append([size, latency, bandwidth, *(none[m] for m in METHODS), *(found[m] for m in METHODS),
                         share_hidden(none, found)])
            bench.note("model: " + " ".join(f"{x:.4g}" for x in rows[-1]))
    bench.section.heading("A model of a network")
    tabulate(bench, ["particles per rank", "latency (us)", "bandwidth (GB/s)",
                     *(f"{m}, no network (us/step)" for m in METHODS), *(f"{m} (us/step)" for m in METHODS),
                     "share hidden"], rows)
    bench.section.text("Two ranks. A preloaded library delivers each message no earlier than latency + bytes/bandwidth after "
                       "it was sent: a model, no network. Share hidden: how much of the time that the model adds to the "
                       "blocking direct exchange is not added with overlap; not given where it adds less than 10 % of a "
                       "step. " + where_it_pays(rows))
    bench.section.plot("model", "Time of a step over the latency of the modelled network",
                       lambda plt: draw_model(plt, rows, sizes, bandwidths))
    bench.section.plot("overlap", "Where overlap pays: overlapped step over blocking step (below 1), and share hidden, over "
                                  "the time that the modelled network adds to the blocking step",
                       lambda plt: draw_overlap(plt, rows, sizes))


def share_hidden(none, found):
    """Share of the modelled communication time of the blocking direct exchange that overlap takes away."""
    blocking = found["direct"] - none["direct"]
    if blocking < 0.1 * none["direct"]:
        return float("nan")
    return 1.0 - (found["overlapped"] - none["overlapped"]) / blocking


def added_share(row):
    """Time that the network adds to the blocking direct step, over the step without it."""
    return (row[7] - row[4]) / row[4]


def where_it_pays(rows):
    """In words: from where on, and up to where."""
    loses = [added_share(row) for row in rows if row[8] > row[7]]
    half = [added_share(row) for row in rows if row[9] < 0.5]
    text = "Overlap costs more than it hides "
    text += f"only where the network adds less than {100 * max(loses):.0f} % to a step. " if loses else "nowhere here. "
    if half:
        text += f"It hides less than half where the network adds more than {100 * min(half):.0f} % to a step: " \
                "there is no more work to hide it behind."
    return text


def draw_model(plt, rows, sizes, bandwidths):
    _, axes = plt.subplots(len(sizes), len(bandwidths), squeeze=False, sharex=True, sharey="row",
                           figsize=(2.6 * len(bandwidths), 1.9 * len(sizes)))
    for (i, size), (j, bandwidth) in itertools.product(enumerate(sizes), enumerate(bandwidths)):
        axis = axes[i][j]
        chosen = [row for row in rows if row[0] == size and row[2] == bandwidth]
        for k, (method, style) in enumerate(zip(METHODS, (0, 3, 4))):
            axis.loglog([row[1] for row in chosen], [row[6 + k] for row in chosen], label=method, **plot.style(style))
        axis.set_title(f"{size} per rank, {bandwidth:g} GB/s")
        if i == len(sizes) - 1:
            axis.set_xlabel("latency (us), model")
        if j == 0:
            axis.set_ylabel("us per step")
    axes[0][0].legend()


def draw_overlap(plt, rows, sizes):
    _, (left, right) = plt.subplots(1, 2, figsize=(7.5, 3.2))
    for k, size in enumerate(sizes):
        points = sorted((max(added_share(row), 1e-3), row[8] / row[7], row[9]) for row in rows if row[0] == size)
        style = plot.style((0, 3, 4, 7)[k % 4], linestyle="none")
        left.semilogx([p[0] for p in points], [p[1] for p in points], label=f"{size} per rank", **style)
        right.semilogx([p[0] for p in points if p[2] == p[2]], [p[2] for p in points if p[2] == p[2]], **style)
    left.axhline(1.0, color="0.4", linewidth=0.8)
    left.set_ylabel("overlapped over blocking step")
    right.set_ylabel("share hidden")
    for axis in left, right:
        axis.set_xlabel("added by the network over step without it (model)")
    left.legend()


# ---- this machine -----------------------------------------------------------------------------

def cases(bench, runner):
    """(name, bed, methods, steps between rebuilds or 0) one after the other."""
    for size in bench.size((1000, 5000, 20000, 100000), (1000,)):
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
        steps = segments_of(bench, bed.count // 2)
        # whole steps with their rebuilds, or, at rest, steps as nobody disturbs them
        figure = statistics.median if every else lambda values: statistics.quantiles(values, n=4)[0]

        def variant(method):
            script = bed.script(methods[method], steps, segments=max(6, steps // 50) if every else 20, every=every)
            return lambda: figure(microseconds(runner.run(script)))
        times = paired.measure({m: variant(m) for m in methods}, bench.rounds)
        ratios = {m: paired.ratio(times[m], times["stock"]) for m in methods}
        rows.append([name, *(times[m].median if m in times else "" for m in METHODS), ratios["direct"],
                     ratios.get("overlapped", "")])
        bench.note(f"real: {name}: direct {ratios['direct']}, overlapped {ratios.get('overlapped', '-')}")
        if ratios["direct"].median > 1.0 and ratios["direct"].low > 1.0:
            slower.append(f"{name} ({ratios['direct']})")
    bench.section.heading("Two ranks of this machine")
    tabulate(bench, ["scene", *(f"{m} (us/step)" for m in METHODS), "direct over stock", "overlapped over stock"], rows)
    bench.section.text("Whole steps; ratios are medians of runs taken in turns (lowest to highest). Messages go through shared "
                       "memory: there is little to hide. The direct exchange takes more time than the stock one, in every "
                       "round, in: " + (", ".join(slower) or "no scene") + ".")
    if slower:
        bench.section.headline("exchange: on this machine the direct exchange is slower than the stock one in: " +
                               ", ".join(slower))


def measure(bench):
    for name, part in {"counts": counts, "hidden": hidden, "model": model, "real": real}.items():
        if bench.wants(name):
            part(bench, Runner(bench.workdir))
