# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Time of a step on one core and two, against other codes with the same physics."""

import concurrent.futures
import os
import re
import statistics

import beds
import lammps
import machine
import paired
import two_cores
from lammps import LIGGGHTS, STOCK, TALUS

TITLE = "One core, and two"
QUESTION = """How long does a step take, against other codes with the same physics, time step, skin and
schedule of rebuilds? The whole step is measured: neighbor lists, contacts, walls, gravity, integration."""

REBUILD = 100           # steps between rebuilds of the neighbor lists, in all codes
# steps in our own records, with our exchange where there is one: what Talus chooses within one machine
OWN_STEPS = "run_style verlet\n"
OVERLAPPED = "run_style verlet/proxy overlap yes\n"
OWN_EXCHANGE = OWN_STEPS
CHRONO_DEMO, CHRONO_CHUTE = 3640.0, 55.0     # ns per particle and step: Chrono::Distributed, and in.chute beside it


# ---- one run ----------------------------------------------------------------------------------

class Runner:
    """Runs scripts and returns the time per particle and step of their last run command (ns)."""

    def __init__(self, bench):
        self.bench, self.count = bench, 0

    def __call__(self, script, code=TALUS, cores=None, **options):
        self.count += 1
        cores = paired.one_core() if cores is None else cores
        loop = lammps.run(self.bench.workdir, f"run{self.count}", script, code, cores=cores, **options).loops()[-1]
        return loop.nanoseconds()


def plan(bench, count):
    """Steps that do not count and steps that do: some seconds for the slower code."""
    steps = max(100, int(bench.size(3.0e7, 3.0e6) / count / 100) * 100)
    return 100, min(steps, 2000)


# ---- beds -------------------------------------------------------------------------------------

def bed_scripts(bench, count, every=REBUILD):
    data, box = beds.bed(bench, count)
    warm, steps = plan(bench, count)
    return {
        "talus": beds.script(data, beds.talus(), warm, steps, every, more=OWN_STEPS),
        "talus ranks": beds.script(data, beds.talus(), warm, steps, every, more=OWN_EXCHANGE),
        "talus overlapped": beds.script(data, beds.talus(), warm, steps, every, more=OVERLAPPED),
        "talus verlet": beds.script(data, beds.talus(), warm, steps, every, more="run_style verlet/stock\n"),
        "stock": beds.script(data, beds.stock(), warm, steps, every),
        "talus material": beds.script(data, beds.talus(beds.MATERIAL), warm, steps, every, more=OWN_STEPS),
        "granular": beds.script(data, beds.stock_granular(), warm, steps, every),
        "frictionless": beds.script(data, beds.talus(beds.FRICTIONLESS), warm, steps, every, more=OWN_STEPS),
        "liggghts": beds.liggghts_script(data, box, warm, steps, every),
    }


def compare(bench, case, what, pair, floor, goal, rounds=None):
    """pair: {name: function}, first the other code, then ours."""
    bench.note(case)
    series = paired.measure(pair, rounds or bench.rounds)
    other, ours = series.values()
    return finish(bench, case, what, other, ours, paired.ratio(other, ours), floor, goal)


def finish(bench, case, what, other, ours, ratio, floor, goal, more=None):
    """more: for each round a dictionary with what else is known of it."""
    for k, (a, b) in enumerate(zip(other.values, ours.values)):
        bench.section.record(case=case, round=k + 1, other_ns=a, ours_ns=b, ratio=a / b, **(more[k] if more else {}))
    if ratio.median < floor:
        bench.section.headline(f"single, {case}: ratio {ratio.median:.2f}, less than the {floor} that was aimed at.")
    return [case, what, other.median, ours.median, str(ratio), floor, goal]


def bed_rows(bench, run):
    size = bench.size(50000, 12500)
    sizes = {"bed": size}
    if not bench.quick:
        sizes.update({"bed400k": 400000, "bed1236k": 1236372})
    aims = {"bed": (4, 5), "bed400k": (4, 5), "bed1236k": (4.5, 6)}
    for case, count in sizes.items():
        if bench.wants(case):
            s = bed_scripts(bench, count)
            yield compare(bench, case, f"{count} spheres, gran/hertz/history",
                          {"stock": lambda s=s: run(s["stock"], STOCK), "talus": lambda s=s: run(s["talus"])},
                          *aims[case])
    if bench.wants("verlet"):
        s = bed_scripts(bench, size)
        yield compare(bench, "verlet", f"{size} spheres, Talus with run_style verlet of LAMMPS",
                      {"stock": lambda: run(s["stock"], STOCK), "talus": lambda: run(s["talus verlet"])}, 4, 5)
    if bench.wants("checked"):
        s = bed_scripts(bench, size, every=0)
        yield compare(bench, "checked", f"{size} spheres, lists rebuilt when particles have moved",
                      {"stock": lambda: run(s["stock"], STOCK), "talus": lambda: run(s["talus"])}, 4, 5)
    s = bed_scripts(bench, size)
    if bench.wants("granular"):
        yield compare(bench, "granular", f"{size} spheres, pair granular, hertz/material and mindlin",
                      {"stock": lambda: run(s["granular"], STOCK), "talus": lambda: run(s["talus material"])}, 6, 8)
    if bench.wants("liggghts") and machine.LIGGGHTS:
        yield compare(bench, "liggghts", f"{size} spheres, LIGGGHTS, hertz and history",
                      {"liggghts": lambda: run(s["liggghts"], LIGGGHTS), "talus": lambda: run(s["talus material"])},
                      5, 6)
    if bench.wants("frictionless"):
        yield compare(bench, "frictionless", f"{size} spheres, Talus with friction against without",
                      {"friction": lambda: run(s["talus"]), "none": lambda: run(s["frictionless"])}, 1.4, 1.6)


# ---- the chute of LAMMPS ----------------------------------------------------------------------

def chute_scripts(bench):
    """bench/in.chute of the host, and the same with our styles; None without the host's source."""
    folder = os.path.join(machine.HOST_SOURCE, "bench")
    if not os.path.exists(os.path.join(folder, "in.chute")):
        return None
    with open(os.path.join(folder, "in.chute")) as file:
        text = file.read().replace("data.chute", os.path.join(folder, "data.chute"))
    steps = bench.size(1000, 300)
    text = re.sub(r"(?m)^run\s+\d+", f"run 100\nrun {steps}", text)
    text = re.sub(r"(?m)^thermo\s+100$", "thermo 1000000", text)
    ours = re.sub(r"pair_style\s.*\npair_coeff.*", "pair_style gran/penalty\npair_coeff * * hooke 200000.0 50.0 "
                  "tangential multistep NULL 0.0 0.5", text)
    ours = re.sub(r"(?m)^fix\s+1 all gravity.*\n", "", ours)
    ours = re.sub(r"(?m)^run 100$", OWN_EXCHANGE + "run 100", ours, 1)
    ours = re.sub(r"(?m)^(fix\s+3 active) nve/sphere", r"\1 nve/sphere/symplectic gravity 1.0 chute 26.0", ours)
    return text, ours


def chute_row(bench, run):
    scripts = chute_scripts(bench)
    if scripts and bench.wants("chute"):
        stock, ours = scripts
        yield compare(bench, "chute", "in.chute of LAMMPS, 32 000 spheres, gran/hooke/history",
                      {"stock": lambda: run(stock, STOCK), "talus": lambda: run(ours)}, 2, 2.5)


# ---- the scaling scene of Chrono::Distributed -------------------------------------------------

def demo_script(bench):
    """The scaling scene with 58 x 31 x 18 = 32 364 spheres after it has settled, dt 2e-5."""
    data = beds.cache_path("demo")
    s = 2.5e-3
    hx, hy, height = 29.5 * s, 16 * s, 0.05
    box = ((-hx, hx), (-hy, hy), (-s, height + 3 * s))
    law = "hertz/material 2e6 0.05 0.3 tangential onestep NULL NULL 0.4"
    physics = beds.talus(law, gravity=9.8)
    if not os.path.exists(data):
        bench.note("settling the reference's scene, once")
        rows = [(1 + i + 58 * (j + 31 * k), 1, s, 4000.0, (i - 28.5) * s, (j - 15) * s, (3 + k) * s)
                for k in range(18) for j in range(31) for i in range(58)]
        lammps.write_data(bench.path("lattice.data"), box, rows)
        lammps.run(bench.workdir, "demo", beds.script("lattice.data", physics, 0, 10000, 0, dt=2e-5)
                   + beds.save_state("demo.dump"))
        lammps.write_data(data, box, *beds.state_rows(bench.path("demo.dump"), 4000.0))
    return beds.script(data, physics, *plan(bench, 32364), REBUILD, dt=2e-5, more=OWN_STEPS)


def demo_row(bench, run):
    scripts = chute_scripts(bench)
    if not scripts or not bench.wants("demo"):
        return
    bench.note("demo")
    demo = demo_script(bench)
    series = paired.measure({"chute": lambda: run(scripts[0], STOCK), "talus": lambda: run(demo)}, bench.rounds)
    chrono = paired.Series([CHRONO_DEMO / CHRONO_CHUTE * ns for ns in series["chute"].values])
    ratio = paired.ratio(chrono, series["talus"])
    yield finish(bench, "demo", "Chrono::Distributed, scaling scene, 32 364 spheres (scaled by in.chute)",
                 chrono, series["talus"], ratio, 50, 80)


# ---- two cores --------------------------------------------------------------------------------

def two_at_once(run, script, cores):
    """Mean time per particle and step of two independent runs, one pinned to each core, per core pair."""
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        times = list(pool.map(lambda core: run(script, cores=[core]), cores))
    return 1.0 / sum(1.0 / t for t in times)      # time of the pair for one particle and step


def two_core_rows(bench, run, machine_says):
    """`machine_says` receives texts and tables on what two cores of this machine cost each other."""
    if len(machine.cores()) < 2:
        bench.section.text("Two cores: not measured, there is one.")
        return
    cores = machine.cores()[-2:]
    size = bench.size(50000, 12500)
    s = bed_scripts(bench, size)
    rounds = 3 * bench.rounds    # what disturbs one core delays both: the spread is larger, and runs are short
    both = {"ranks": ("talus ranks", "2 ranks", dict(ranks=2, cores=cores)),
            "overlapped": ("talus overlapped", "2 ranks, overlap", dict(ranks=2, cores=cores)),
            "threads": ("talus", "2 threads", dict(threads=2, cores=cores))}
    distance, limits, ratios = two_cores.Distance(cores), [], {}
    for case, (script, what, options) in both.items():
        if bench.wants(case):
            bench.note(case)
            series = paired.measure({"alone": lambda: two_at_once(run, s["talus"], cores),
                                     "pair": lambda c=case, o=options, n=script:
                                         distance.around(c, lambda: run(s[n], **o)),
                                     "lockstep": lambda: two_cores.lockstep(cores)}, rounds)
            alone, pair = series["alone"], series["pair"]
            ratios[case] = [a / b for a, b in zip(alone.values, pair.values)]
            yield finish(bench, case, f"{size} spheres, {what}; of the throughput of two independent runs",
                         alone, pair, paired.ratio(alone, pair), 0.92, 0.97,
                         [dict(line_before_ns=before, line_after_ns=after) for before, after in distance.trips[case]])
            limits += series["lockstep"].values
    if ratios:
        machine_says += [lockstep_text(limits), *distance_blocks(distance, ratios)]
    if bench.wants("omp"):
        omp = dict(threads=2, cores=cores)
        yield compare(bench, "omp", f"{size} spheres, 2 threads, stock with -sf omp",
                      {"stock": lambda: run(s["stock"], STOCK, arguments=["-sf", "omp"], **omp),
                       "talus": lambda: run(s["talus"], **omp)}, 4, 5, rounds)


def lockstep_text(limits):
    return f"""`ranks`, `overlapped` and `threads` wait for each other after each step. Two threads that do mere arithmetic on data of
their own, for 1 ms at a time, and then wait for each other reach {statistics.median(limits):.2f} ({min(limits):.2f} to {max(limits):.2f}) of
their throughput without waiting, measured in turn with these rows: an upper limit, for threads and ranks share data
as well."""


def distance_blocks(distance, ratios):
    """ratios: {case: ratio of each round}.  A sentence; and a table if the machine has changed."""
    times = {name: distance.time(name) for name in ("near", "far") if distance.seen(name)}
    said = " or ".join(f"{time:.0f} ns ({name})" for name, time in times.items())
    text = f"A cache line that goes to the other core and back takes {said or 'a time that changed in every round'}"
    if list(times) == ["near"] and not distance.seen("changing"):
        return [text + ", measured before and after each run of these rows."]
    rows = []
    for case, values in ratios.items():
        for name, times in distance.sort(case, values).items():
            if times:
                rows.append([case, name, len(times), f"{statistics.median(times):.2f} ({min(times):.2f} to {max(times):.2f})"])
    return [text + """: measured before and after each run of these rows; near is less than
twice the shortest time, and in some runs it changed on the way. A machine with cores of its own has one of these times;
threads send lines to each other all the time, independent runs do not.""",
            (["case", "cores", "rounds", "ratio, median (range)"], rows)]


# ---- all --------------------------------------------------------------------------------------

COLUMNS = ["case", "what", "other, ns", "Talus, ns", "ratio, median (range)", "floor", "goal"]


def measure(bench):
    section, run, machine_says = bench.section, Runner(bench), []
    rows = [row for part in (bed_rows, chute_row, demo_row) for row in part(bench, run)]
    rows += two_core_rows(bench, run, machine_says)
    section.table(COLUMNS, rows)
    section.text(f"""Times in ns per particle and step. Beds: settled, 15 diameters deep, diameters +- 5 %, Hertz, friction
with history, floor and four walls, skin .1 diameters; lists are rebuilt every {REBUILD} steps in all codes (in the row
`checked`, each step asks whether a particle has moved by half the skin). Talus uses its own `run_style verlet`, but in
the row `verlet`; with the direct exchange and without overlap, as it chooses within one machine, on two ranks and in
the periodic chute (`overlapped`: with overlap, the default). 100 steps before those that count. floor and goal are what
was aimed at.""")
    section.text("""`demo`: a reference that cannot be run here took 3640 ns per particle and step on a core on which in.chute
takes 55 ns with the stock style; its time is scaled by in.chute, which ran in turn. `frictionless`: the same positions
without friction; `ranks`, `overlapped` and `threads`: time for a particle and step of two independent runs on the two cores, both
running, over that of one run on both. Rows with two cores have three times as many rounds.""")
    for block in machine_says:
        section.text(block) if isinstance(block, str) else section.table(*block)
    state = beds.contacts(bench, bench.size(50000, 12500))
    section.text(f"The bed has {state[0]:.2f} contacts and {state[1]:.2f} candidate pairs per sphere.")
    if rows:
        section.plot("", "Ratios of run times, with the range over the rounds; the bar is the floor",
                     lambda plt: draw(plt, rows))


def draw(plt, rows):
    _, axes = plt.subplots(figsize=(6.5, 0.35 * len(rows) + 1))
    for k, row in enumerate(rows):
        median, low, high = map(float, re.findall(r"[\d.]+", row[4]))
        axes.plot([low, high], [k, k], color="0.0", linewidth=3)
        axes.plot([median], [k], "o", color="0.0", markersize=6)
        axes.plot([row[5]], [k], "|", color="0.5", markersize=16, markeredgewidth=2)
    axes.set_yticks(range(len(rows)), [row[0] for row in rows])
    axes.set_xscale("log")
    axes.set_xticks([1, 2, 4, 8, 16, 32, 64, 128], map(str, [1, 2, 4, 8, 16, 32, 64, 128]))
    axes.invert_yaxis()
    axes.set_xlabel("times faster")
