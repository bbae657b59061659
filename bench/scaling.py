# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Weak and strong scaling as far as this machine goes, and a projection to many ranks."""

import math
import re

import beds
import features
import lammps
import machine
import paired
import plot
from lammps import STOCK, TALUS

TITLE = "Scaling"
QUESTION = """How do more ranks and threads pay, with the work per core kept (weak) and with the whole work kept (strong)?
Measured as far as this machine has cores; what many ranks would do is projected from what was measured and counted, and
called a projection."""

# Chrono::Distributed, 12 cores per rank, 1.236 million bodies (weak: per rank)
REFERENCE_WEAK = {2: 0.983, 4: 0.979, 8: 0.975, 16: 0.962, 32: 0.960}
REFERENCE_STRONG = {2: 0.993, 4: 0.986, 8: 1.059, 16: 1.020, 32: 1.031}

# of the projection: a network as clusters have it. Stated, not measured.
LATENCY = 2.0e-6            # s for a message between nodes
BANDWIDTH = 12.5e9          # bytes/s of a node (100 Gbit/s)
RANKS_PER_NODE = 64
PACK = 1.0e-9               # s per proxy and side to pack or unpack
REBUILD = 100               # steps between rebuilds, at which migration and borders cost
BORDER_FACTOR = 12          # messages of a rebuild over those of a step: exchange, borders, their counts


def ways():
    """(name, ranks, threads) that the cores allow, powers of two."""
    cores = len(machine.cores())
    counts = [n for n in (1, 2, 4, 8, 16, 32, 64) if n <= cores]
    return [("ranks", n, 1) for n in counts] + [("threads", 1, n) for n in counts if n > 1] + \
        [("ranks x threads", n // 2, 2) for n in counts if n > 2]


def measured(bench, code, count, ranks, threads, proxy):
    """Seconds for a step, and the log of the run."""
    data, _ = beds.bed(bench, count)
    steps = max(100, int(bench.size(2.0e7, 3.0e6) / count / 100) * 100)
    text = beds.talus() if code == TALUS else beds.stock()
    script = beds.script(data, text, 100, min(steps, 1000), more="comm_proxy yes\n" if proxy else "")
    used = ranks * threads
    result = lammps.run(bench.workdir, "scaling", script, code, ranks=ranks, threads=threads,
                        cores=machine.cores()[-used:], arguments=["-sf", "omp"] if code == STOCK and threads > 1 else [])
    loop = result.loops()[-1]
    return loop.seconds / loop.steps, result.log


def table(bench, kind, base):
    """Rows of the weak or strong table; returns {(code, way, n): (seconds per step, spheres)} and a log of 2 ranks."""
    found, log = {}, ""
    proxies = (False, True) if features.has(bench, "comm_proxy yes") else (False,)
    plan = [(code, proxy, *way) for code in (TALUS, STOCK) for proxy in proxies for way in ways()
            if not (proxy and (code == STOCK or way[1] == 1))]
    for code, proxy, name, ranks, threads in plan:
        cores = ranks * threads
        count = base * cores if kind == "weak" else base
        bench.note(f"{kind}: {code}, {ranks} x {threads}{', direct exchange' if proxy else ''}")
        runs = [measured(bench, code, count, ranks, threads, proxy) for _ in range(bench.rounds)]
        if code == TALUS and ranks == 2:
            log = runs[0][1]
        seconds = sorted(run[0] for run in runs)[len(runs) // 2]
        words = (code, name + (", direct exchange" if proxy else ""), cores)
        found[words] = (seconds, count)
        bench.section.record(kind=kind, code=code, way=words[1], cores=cores, spheres=count, seconds_per_step=seconds)
    return found, log


def show(section, kind, found, reference):
    rows = []
    for (code, way, cores), (seconds, count) in found.items():
        alone, alone_count = found[code, "ranks", 1]
        efficiency = alone / alone_count / (seconds * cores / count)
        rows.append([code, way if cores > 1 else "1 core", cores, count, 1e9 * seconds * cores / count, efficiency,
                     reference.get(cores, "") if cores > 1 else ""])
    section.heading(f"{kind.capitalize()} scaling, measured")
    section.table(["code", "", "cores", "spheres", "core ns per particle and step", "efficiency",
                   "Chrono::Distributed on as many ranks"], rows)


# ---- projection -------------------------------------------------------------------------------

def ghosts_of(log):
    """Ghosts per rank in a log, mean."""
    match = re.findall(r"^Nghost:\s+(\S+) ave", log, re.MULTILINE)
    return float(match[-1]) if match else 0.0


def proxies_of_cube(count, cut, density):
    """Proxies around a cube that holds `count` spheres, reached by `cut`; density: spheres per volume."""
    edge = (count / density)**(1 / 3)
    return density * ((edge + 2 * cut)**3 - edge**3)


def step_of(count, ranks, nanoseconds, bytes_per_proxy, messages):
    """(seconds, share of communication) of one rank of many, without overlap of communication and computation."""
    density = 0.6 * 6 / math.pi / beds.D**3
    proxies = proxies_of_cube(count, 1.05 * beds.D + beds.SKIN, density)
    # a pair across the border is computed on both sides: half the contacts of the proxies come on top
    work = 1e-9 * nanoseconds * (count + 0.25 * proxies)
    sent = messages * LATENCY + proxies * bytes_per_proxy / (BANDWIDTH / RANKS_PER_NODE) + 2 * PACK * proxies
    rebuild = (BORDER_FACTOR * messages * LATENCY + 6 * proxies * bytes_per_proxy / (BANDWIDTH / RANKS_PER_NODE)) / REBUILD
    ask = math.ceil(math.log2(ranks)) * 2 * LATENCY      # whether to rebuild: an allreduce in every step
    return work + sent + rebuild + ask, (sent + rebuild + ask) / (work + sent + rebuild + ask)


def projection(bench, nanoseconds):
    section = bench.section
    section.heading("Projection")
    rows = []
    exchanges = {"stock exchange": (72, 6), "direct exchange": (72, 26)}
    for name, (size, messages) in exchanges.items():
        for count in (1e4, 1e5, 1e6):
            for ranks in (32, 1000, 10000, 100000):
                seconds, share = step_of(count, ranks, nanoseconds, size, messages)
                efficiency = 1e-9 * nanoseconds * count / seconds
                rows.append([name, f"{count:.0e}", f"{ranks}", f"{count * ranks:.0e}", 1e3 * seconds, share, efficiency])
                section.record(kind="projection", way=name, per_rank=count, ranks=ranks, seconds_per_step=seconds,
                               efficiency=efficiency)
    section.table(["exchange", "spheres per rank", "ranks", "spheres", "ms per step", "share of communication",
                   "efficiency (weak)"], rows)
    section.text(f"""**This is a projection, not a measurement.** Computation: {nanoseconds:.1f} ns per particle and step, as measured
on one core above. Counted: proxies of a cubic sub-domain in a dense bed at the cutoff of this one, 72 bytes for each in
every step (position, velocity, spin), 6 messages (stock: in three stages) or 26 (direct, to all neighbours at once), a
pair across a border computed on both sides. Assumed, not measured: {1e6 * LATENCY:g} us latency of a message,
{BANDWIDTH / 1e9:g} GB/s for a node of {RANKS_PER_NODE} ranks, {1e9 * PACK:g} ns to pack and to unpack a proxy, a rebuild every
{REBUILD} steps, an allreduce in every step, no overlap of communication with computation, no imbalance. Chrono::Distributed
reported .960 (weak) and 1.031 (strong) on 32 ranks of 12 cores with 1.236 million bodies per rank, in slabs.""")
    section.plot("projection", "Projected efficiency of weak scaling, 1e5 spheres per rank", lambda plt: draw(plt, rows))


def draw(plt, rows):
    _, axes = plt.subplots(figsize=(4.5, 3))
    series = {}
    for name, count, ranks, _, _, _, efficiency in rows:
        series.setdefault((name, count), []).append((int(ranks), efficiency))
    for k, ((name, count), points) in enumerate(series.items()):
        axes.semilogx(*zip(*points), label=f"{name}, {count} per rank", **plot.style(k))
    axes.set_ylim(0, 1.05)
    axes.set_xlabel("ranks")
    axes.set_ylabel("efficiency (projection)")
    axes.legend()


def measure(bench):
    section = bench.section
    weak, log = table(bench, "weak", bench.size(100000, 12500))
    show(section, "weak", weak, REFERENCE_WEAK)
    strong, _ = table(bench, "strong", bench.size(400000, 25000))
    show(section, "strong", strong, REFERENCE_STRONG)
    section.text(f"""core ns: time of a step times cores over spheres. Efficiency: against the same code on one core. Threads of the stock
styles: `-sf omp`. Bed between floor and walls, lists rebuilt every 100 steps, 2 ranks of the weak series have
{ghosts_of(log):.0f} ghosts each. Chrono::Distributed: ranks of 12 cores.""")
    seconds, count = weak[TALUS, "ranks", 1]
    projection(bench, 1e9 * seconds / count)
