# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Weak and strong scaling as far as this machine goes, and a projection to many ranks."""

import itertools
import re
import statistics

import beds
import lammps
import machine
import paired
import plot
import projection
from exchange_runs import Runner, counted
from lammps import STOCK, TALUS

TITLE = "Scaling"
QUESTION = """How do more ranks and threads pay, with the work per core kept (weak) and with the whole work kept (strong)?
Measured as far as this machine has cores; what many ranks would do is projected from what was measured and counted, and
called a projection."""

# Chrono::Distributed, 12 cores per rank, 1.236 million bodies (weak: per rank)
REFERENCE_WEAK = {2: 0.983, 4: 0.979, 8: 0.975, 16: 0.962, 32: 0.960}
REFERENCE_STRONG = {2: 0.993, 4: 0.986, 8: 1.059, 16: 1.020, 32: 1.031}

OWN, PLAIN = "run_style verlet\n", ""
ARRAYS = "comm_proxy no\nrun_style verlet/stock\n"
WAITING = re.compile(r"Talus exchange: (\d+) updates .* bytes [^/]+/([^/]+)/.* s packing [^/]+/([^/]+)/")

# spheres per rank and ranks of the projection; 1.236 million on 32 ranks is what the reference reported
PER_RANK = (12500, 100000, 1236372)
RANKS = (32, 1000, 10000, 100000)


def ways():
    """(name, ranks, threads) that the cores allow, powers of two."""
    cores = len(machine.cores())
    counts = [n for n in (1, 2, 4, 8, 16, 32, 64) if n <= cores]
    return [("ranks", n, 1) for n in counts] + [("threads", 1, n) for n in counts if n > 1] + \
        [("ranks x threads", n // 2, 2) for n in counts if n > 2]


def plans():
    """(row, code, commands, way of the cores): rows of a table; efficiency is against the row's own single core."""
    for name, ranks, threads in ways():
        yield "Talus", TALUS, OWN, (name, ranks, threads)
    for name, ranks, threads in ways():
        yield "Talus, run style and exchange of LAMMPS", TALUS, ARRAYS, (name, ranks, threads)
    for name, ranks, threads in ways():
        yield "stock", STOCK, PLAIN, (name, ranks, threads)


def one_run(bench, code, count, commands, ranks, threads):
    data, _ = beds.bed(bench, count)
    steps = max(100, int(bench.size(4.0e7, 3.0e6) / count / 100) * 100)
    script = beds.script(data, beds.talus() if code == TALUS else beds.stock(), 100, min(steps, 1000), more=commands)
    return lammps.run(bench.workdir, "scaling", script, code, ranks=ranks, threads=threads,
                      cores=machine.cores()[-ranks * threads:],
                      arguments=["-sf", "omp"] if code == STOCK and threads > 1 else [])


def table(bench, kind, base, reference):
    """Writes the weak or strong table and returns the log of Talus on two ranks, if there are two cores."""
    log, seconds = "", {}
    order = list(plans())
    for k in range(bench.rounds):
        for row, code, commands, (name, ranks, threads) in order if k % 2 == 0 else reversed(order):
            cores = ranks * threads
            count = base * cores if kind == "weak" else base
            bench.note(f"{kind}, round {k + 1}: {row}, {ranks} x {threads}")
            result = one_run(bench, code, count, commands, ranks, threads)
            loop = result.loops()[-1]
            seconds.setdefault((row, name, cores, count), []).append(loop.seconds / loop.steps)
            if commands == OWN and ranks == 2:
                log = result.log
    rows = []
    for (row, name, cores, count), values in seconds.items():
        alone = seconds[row, "ranks", 1, base]
        ratio = paired.ratio(paired.Series([a * (count / base) / cores for a in alone]), paired.Series(values))
        middle = statistics.median(values)
        rows.append([row, name if cores > 1 else "1 core", cores, count, 1e9 * middle * cores / count, str(ratio),
                     reference.get(cores, "") if cores > 1 else ""])
        bench.section.record(kind=kind, code=row, way=name, cores=cores, spheres=count, seconds_per_step=middle,
                             efficiency=ratio.median)
    rows.sort(key=lambda row: [plan[0] for plan in order].index(row[0]))
    bench.section.heading(f"{kind.capitalize()} scaling, measured")
    bench.section.table(["", "on", "cores", "spheres", "core ns per particle and step", "efficiency",
                         "Chrono::Distributed on as many ranks"], rows)
    return log


# ---- projection -------------------------------------------------------------------------------

def messages(bench):
    """(stock, direct): messages that a rank with neighbors on all sides sends in a step, counted."""
    grid = (4, 4, 4) if not bench.quick else (2, 2, 2)
    bench.note(f"counting messages on a grid of {grid}")
    counts = [counted(Runner(bench.workdir), grid, "friction", method) for method in ("stock", "direct")]
    return [round(statistics.mean(rank[0] for rank in found)) for found in counts]


def alone(bench, count):
    """(core ns per particle and step, share of the pair style) on one core."""
    bench.note(f"one core, {count} spheres")
    runs = [one_run(bench, TALUS, count, OWN, 1, 1).loops()[-1] for _ in range(bench.rounds)]
    loop = sorted(runs, key=lambda run: run.seconds)[len(runs) // 2]
    return loop.nanoseconds(), loop.breakdown.get("Pair", 0.0) / loop.seconds


def copying(log):
    """Seconds to pack, send and unpack a proxy, and bytes of it, in a run on two ranks."""
    found, proxies = WAITING.search(log), re.findall(r"^Nghost:\s+(\S+) ave", log, re.MULTILINE)
    if not found or not proxies or not float(proxies[-1]):
        return 0.0, 72
    updates = max(1, int(found[1]))
    return float(found[3]) / updates / float(proxies[-1]), round(float(found[2]) / float(proxies[-1]))


def project(bench, log):
    section = bench.section
    sizes = bench.size(PER_RANK, PER_RANK[:1] + (25000,))
    single = {count: alone(bench, count) for count in sizes}
    seconds, size = copying(log)
    found = projection.Measured({count: ns for count, (ns, _) in single.items()}, seconds,
                                min(share for _, share in single.values()))
    stock, direct = messages(bench)
    exchanges = {"of LAMMPS": projection.Exchange(stock, size, True, False),
                 "direct": projection.Exchange(direct, size, False, False),
                 "direct, overlapped": projection.Exchange(direct, size, False, True)}
    rows = []
    for (name, exchange), count, ranks in itertools.product(exchanges.items(), sizes, RANKS):
        time, share, efficiency = projection.efficiency(count, ranks, exchange, found)
        reference = f"{REFERENCE_WEAK[32]:.3f}" if (count, ranks) == (PER_RANK[-1], 32) else ""
        rows.append([name, count, ranks, f"{count * ranks:.2g}", 1e3 * time, share, efficiency, reference])
        section.record(kind="projection", way=name, per_rank=count, ranks=ranks, seconds_per_step=time, efficiency=efficiency)
    section.heading("Projection to many ranks")
    section.text("**This is a projection, not a measurement.**")
    section.table(["exchange", "spheres per rank", "ranks", "spheres", "ms per step", "share of exchange and waiting",
                   "efficiency (weak)", "Chrono::Distributed, measured"], rows)
    per_count = ", ".join(f"{ns:.1f} with {count}" for count, ns in found.nanoseconds.items())
    section.text(f"""Measured here: ns per particle and step on one core, {per_count} spheres, of which the pair style takes at least
{100 * found.forces:.0f} %; {1e9 * seconds:.1f} ns to pack and unpack a proxy. Counted here: {stock} messages per rank and step (LAMMPS) and
{direct} (direct) on a periodic grid of {"4 x 4 x 4" if not bench.quick else "2 x 2 x 2"} ranks, {size} bytes for each proxy.
By geometry: a cube of a bed with {100 * projection.FILL:.0f} % solid volume has {projection.proxies_of_cube(sizes[0])[0]:.0f} proxies around {sizes[0]}
spheres and {projection.proxies_of_cube(sizes[-1])[0]:.0f} around {sizes[-1]}; contacts across its border are computed on both sides. Stated, not
measured: {1e6 * projection.LATENCY:g} us for each message, one after the other, {projection.BANDWIDTH / 1e9:g} GB/s for a node that
{projection.RANKS_PER_NODE} ranks share, {100 * projection.LEAVING:.0f} % of whose proxies are in other nodes, a rebuild every {projection.REBUILD} steps with {projection.REBUILD_MESSAGES} times the messages and
{projection.REBUILD_BYTES} times the bytes of a step, a reduction over all ranks in 2 log2(ranks) latencies: in each step with the exchange
of LAMMPS, at rebuilds with the direct one. Left out: imbalance, and memory bandwidth that the cores of a node share.
Chrono::Distributed reported {REFERENCE_WEAK[32]:.3f} (weak) and {REFERENCE_STRONG[32]:.3f} (strong) on 32 ranks of 12 cores with 1.236 million
bodies per rank, in slabs.""")
    section.plot("projection", "Projected efficiency of weak scaling", lambda plt: draw(plt, rows))


def draw(plt, rows):
    _, axes = plt.subplots(figsize=(5, 3.2))
    series = {}
    for name, count, ranks, *_, efficiency, _ in rows:
        series.setdefault((name, count), []).append((ranks, efficiency))
    for k, ((name, count), points) in enumerate(series.items()):
        axes.semilogx(*zip(*points), label=f"{name}, {count} per rank", **plot.style(k))
    axes.semilogx(list(REFERENCE_WEAK), list(REFERENCE_WEAK.values()), label="Chrono::Distributed, measured", color="0.0",
                  marker="*", linestyle="")
    axes.set_ylim(0, 1.05)
    axes.set_xlabel("ranks")
    axes.set_ylabel("efficiency (projection)")
    axes.legend(fontsize=6)


def measure(bench):
    log = table(bench, "weak", bench.size(100000, 12500), REFERENCE_WEAK)
    table(bench, "strong", bench.size(400000, 25000), REFERENCE_STRONG)
    bench.section.text(f"""Efficiency: time on one core, of the same row, over core time with more; medians over {bench.rounds} rounds in turn (range).
Talus: its own run style and exchange, as it chooses them. Threads of the stock styles: `-sf omp`. Settled beds between
floor and walls, cut along x, lists rebuilt every 100 steps. All cores share cache and memory: the rows `ranks` and `threads` of
the section "One core, and two" compare with two independent runs side by side. Chrono::Distributed: ranks of 12 cores.""")
    project(bench, log)
