# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What the exchange of proxies costs: messages and bytes, time per step in a model of a network, and on this machine.

counts  Messages and bytes that a rank sends in a step without a rebuild, by the stock exchange and the direct
        one, on grids of ranks; counted by a preloaded library.
model   Two ranks under a preloaded library which delivers a message no earlier than latency + bytes/bandwidth
        after it was sent. This is a model, not a network.
real    Two ranks without it: ratio of the times of whole steps, direct over stock, taken in turns.
"""

import itertools
import math
import os
import re
import shlex
import statistics
import subprocess

import machine

TITLE = "Exchange of proxies"
QUESTION = """How many messages and bytes does a rank send in a step, by the exchange of LAMMPS and by the direct one of
comm_proxy? How much of the time of a network does run_style verlet/proxy hide behind the forces between owned particles,
and from which latency and bandwidth on does that pay? And what does the direct exchange cost on this machine?"""

LAW = {"friction": "hertz 4000.0 40.0 tangential multistep NULL NULL 0.5", "frictionless": "hertz 4000.0 40.0"}
SEGMENTS = 30    # short runs of each measurement
METHODS = {
    "stock": "comm_proxy no\nrun_style verlet",
    "direct": "comm_proxy yes\nrun_style verlet/proxy overlap no",
    "overlapped": "comm_proxy yes\nrun_style verlet/proxy",
}
START = """
units lj
boundary {boundary}
atom_style sphere
atom_modify map yes
newton off
comm_modify vel yes
processors {grid}
"""
PHYSICS = """
pair_style gran/penalty
pair_coeff * * {law}
neighbor 0.2 bin
neigh_modify every 1 delay 0 check yes
timestep 0.002
fix step all nve/sphere/symplectic gravity 1.0 vector 0 0 -1
fix floor all large/body plane 0 0 0  0 0 1  contact {law}
"""
# polydisperse grains that fall from a lattice onto a floor, slowed down until they rest
BED = START + """
lattice sc 0.9
region box block 0 {nx} 0 {ny} -1 {top}
create_box 1 box
region grains block INF INF INF INF 0.1 {nz}
create_atoms 1 region grains
variable d atom 0.75+0.25*random(0,1,4711)
set group all diameter v_d
set group all density 1.0
displace_atoms all random 0.05 0.05 0.05 77
reset_atoms id sort yes
velocity all set 0 0 0
""" + PHYSICS + """
fix slow all viscous 0.5
run {steps}
write_restart bed
"""


class Runner:
    """Runs scripts in a directory of their own."""

    def __init__(self, workdir):
        self.workdir = workdir
        self.program = machine.TALUS_LMP

    def run(self, script, ranks, preload=None, **variables):
        with open(os.path.join(self.workdir, "in.bench"), "w") as file:
            file.write(script)
        env = {**os.environ, "OMP_NUM_THREADS": "1", "OMPI_MCA_pml": "ob1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1", **{k: str(v) for k, v in variables.items()}}
        command = ["mpirun"] + ["-np", str(ranks)]
        if preload:
            command += ["env", f"LD_PRELOAD={preload}"]
        command += [self.program, "-in", "in.bench", "-log", "log.bench", "-screen", "none"]
        done = subprocess.run(command, cwd=self.workdir, env=env, capture_output=True, text=True)
        with open(os.path.join(self.workdir, "log.bench")) as file:
            log = file.read()
        if done.returncode:
            raise RuntimeError(f"{shlex.join(command)}\n{log[-2000:]}\n{done.stderr[-2000:]}")
        return log

    def bed(self, particles, ranks=2):
        """A bed at rest in the restart file 'bed', elongated along x as the grid is."""
        edge = (particles / 2.0) ** (1.0 / 3.0)
        sizes = {"nx": round(2.0 * edge), "ny": round(edge), "nz": round(edge) + 0.5, "top": round(edge) + 8}
        self.run(BED.format(grid=f"{ranks} 1 1", boundary="p p f", law=LAW["friction"], steps=3000, **sizes), ranks)


def scene(method, steps, law="friction", grid="2 1 1", more="thermo 100000\n"):
    """Continues the bed: a short run to warm up, then the one that counts."""
    return (START.format(grid=grid, boundary="p p f") + "read_restart bed\n" + PHYSICS.format(law=LAW[law]) +
            more + METHODS[method] + f"\nrun {max(10, steps // 10)}\n" +
            SEGMENTS * f"run {max(10, steps // SEGMENTS)} pre no post no\n")


def microseconds_per_step(log):
    """Of each of the short runs after the first run."""
    loops = re.findall(r"Loop time of (\S+) on \d+ procs for (\d+) steps", log)[1:]
    return [1e6 * float(seconds) / int(steps) for seconds, steps in loops]


# ---- counts ----------------------------------------------------------------------------------

def counts(bench, runner):
    grids = [(2, 1, 1), (4, 1, 1), (2, 2, 1), (8, 1, 1), (4, 2, 1), (2, 2, 2)]
    if not bench.quick:
        grids += [(16, 1, 1), (4, 4, 1), (4, 2, 2), (64, 1, 1), (8, 8, 1), (4, 4, 4)]
    library = os.path.join(machine.BUILD, "tests", "libcount_mpi.so")
    rows = []
    for grid, law, method in itertools.product(grids, LAW, ("stock", "direct")):
        ranks = math.prod(grid)
        totals = []
        for steps in 10, 30:
            script = rest_scene(grid, law, method, steps)
            stem = os.path.join(runner.workdir, "counts")
            runner.run(script, ranks, library, TALUS_COUNTS=stem)
            totals.append([read_counts(f"{stem}.{r}") for r in range(ranks)])
        steps = 20
        per_rank = [[(b - a) / steps for a, b in zip(*pair)] for pair in zip(*totals)]
        messages, sent, collectives = ([rank[k] for rank in per_rank] for k in range(3))
        rows.append(["x".join(map(str, grid)), ranks, law, method, statistics.mean(messages), max(messages),
                     statistics.mean(sent), max(sent), max(collectives)])
        bench.note(" ".join(map(str, rows[-1][:4])))
    columns = ["grid", "ranks", "law", "exchange", "messages per rank and step", "largest", "bytes per rank and step",
               "largest bytes", "blocking collectives per step"]
    tabulate(bench, "Messages and bytes", columns, rows)
    bench.section.text("216 particles per rank at rest, periodic in all directions, counted outside of Talus by a preloaded "
                       "library over steps without a rebuild.")


def rest_scene(grid, law, method, steps):
    """Grains at rest that do not touch, 6 x 6 x 6 per rank, periodic: nothing ever happens but the exchange."""
    box = [6 * n for n in grid]
    return (START.format(grid="%d %d %d" % grid, boundary="p p p") + f"""
lattice sc 1.0
region box block 0 {box[0]} 0 {box[1]} 0 {box[2]}
create_box 1 box
create_atoms 1 box
set group all diameter 0.8
set group all density 1.0
comm_modify cutoff 1.2
pair_style gran/penalty
pair_coeff * * {LAW[law]}
fix step all nve/sphere/symplectic
neigh_modify every 1 delay 0 check yes
thermo 100000
{METHODS[method]}
run {steps}
""")


def read_counts(path):
    """Messages, bytes, blocking collectives of a rank."""
    messages = sent = collectives = 0
    with open(path) as file:
        for line in file:
            words = line.split()
            if words[0] == "to":
                messages += int(words[3])
                sent += int(words[5])
            elif words[0] == "collectives":
                collectives = int(words[1])
    return messages, sent, collectives


# ---- the model of a network ------------------------------------------------------------------

def model(bench, runner):
    full = not bench.quick
    latencies = (1, 5, 25, 100, 400, 1000) if full else (1, 400)      # us
    bandwidths = (0.1, 1.0, 25.0) if full else (1.0,)                 # GB/s
    sizes = (1000, 5000, 20000, 100000) if full else (1000,)          # particles per rank
    rows = []
    for size in sizes:
        runner.bed(2 * size)
        steps = max(300, (6000000 if full else 1000000) // size)
        base = {method: timed(runner, method, steps, 0.0, 1e6) for method in METHODS}
        for latency, bandwidth in itertools.product(latencies, bandwidths):
            times = {method: timed(runner, method, steps, latency, bandwidth) for method in METHODS}
            rows.append([size, latency, bandwidth, *(base[m] for m in METHODS), *(times[m] for m in METHODS),
                         hidden(base, times)])
            bench.note(" ".join(f"{x:.4g}" for x in rows[-1]))
    columns = ["particles per rank", "latency (us)", "bandwidth (GB/s)", *(f"{m}, no network (us/step)" for m in METHODS),
               *(f"{m} (us/step)" for m in METHODS), "share hidden"]
    tabulate(bench, "A model of a network", columns, rows)
    bench.section.text("Two ranks. A preloaded library delivers each message no earlier than latency + bytes/bandwidth after "
                       "it was sent: a model, no network. Share hidden: how much of the time that the model adds to the "
                       "blocking direct exchange is not added with overlap.")
    bench.section.plot("model", "Time of a step over the latency of the modelled network",
                       lambda plt: draw_model(plt, rows, sizes, bandwidths))


def timed(runner, method, steps, latency, bandwidth):
    """Best of many short runs: the model adds a fixed time, everything else that varies is noise."""
    library = os.path.join(machine.BUILD, "bench", "libnetwork_model.so")
    return min(microseconds_per_step(
        runner.run(scene(method, steps), 2, library, TALUS_LATENCY=1e-6 * latency, TALUS_BANDWIDTH=1e9 * bandwidth)))


def hidden(base, times):
    """Share of the modelled communication time of the blocking direct exchange that overlap takes away."""
    blocking = times["direct"] - base["direct"]
    return 1.0 - (times["overlapped"] - base["overlapped"]) / blocking if blocking > 0.0 else float("nan")


def draw_model(pyplot, rows, sizes, bandwidths):
    styles = {"stock": ("0.0", "o", "-"), "direct": ("0.3", "s", "--"), "overlapped": ("0.55", "^", "-.")}
    _, axes = pyplot.subplots(len(sizes), len(bandwidths), squeeze=False, sharex=True, sharey="row",
                                   figsize=(3.0 * len(bandwidths), 2.4 * len(sizes)), layout="constrained")
    for (i, size), (j, bandwidth) in itertools.product(enumerate(sizes), enumerate(bandwidths)):
        axis = axes[i][j]
        chosen = [row for row in rows if row[0] == size and row[2] == bandwidth]
        for k, (method, (color, marker, line)) in enumerate(styles.items()):
            axis.loglog([row[1] for row in chosen], [row[6 + k] for row in chosen], color=color, marker=marker,
                        linestyle=line, label=method)
        axis.grid(color="0.85")
        axis.set_title(f"{size} per rank, {bandwidth} GB/s", fontsize=9)
        if i == len(sizes) - 1:
            axis.set_xlabel("latency (us), model")
        if j == 0:
            axis.set_ylabel("us per step")
    axes[0][0].legend(fontsize=7)


# ---- this machine ----------------------------------------------------------------------------

def real(bench, runner):
    full = not bench.quick
    rows = []
    for size in (1000, 5000, 20000, 100000) if full else (1000,):
        runner.bed(2 * size)
        steps = max(300, (12000000 if full else 1000000) // size)
        for law in LAW:
            times = {method: [] for method in METHODS}
            for _ in range(bench.rounds):
                for method in METHODS:
                    times[method].append(statistics.mean(microseconds_per_step(
                        runner.run(scene(method, steps, law), 2))))
            ratios = {m: statistics.median(t / s for t, s in zip(times[m], times["stock"])) for m in METHODS}
            rows.append([size, law, *(statistics.median(times[m]) for m in METHODS), ratios["direct"],
                         ratios["overlapped"]])
            bench.note(f"{size} per rank, {law}: direct {ratios['direct']:.3f}, overlapped {ratios['overlapped']:.3f}")
            if ratios["direct"] > 1.02:
                bench.section.headline(f"exchange: with {size} particles per rank ({law}) the direct exchange takes "
                                       f"{ratios['direct']:.2f} of the time of the stock one on this machine.")
    columns = ["particles per rank", "law", *(f"{m} (us/step)" for m in METHODS), "direct over stock",
               "overlapped over stock"]
    tabulate(bench, "Two ranks of this machine", columns, rows)
    bench.section.text("Whole steps; ratios are medians of runs taken in turns.")


def tabulate(bench, heading, columns, rows):
    bench.section.heading(heading)
    bench.section.table(columns, rows)
    for row in rows:
        bench.section.record(part=heading, **dict(zip(columns, row)))


def measure(bench):
    for name, part in {"counts": counts, "model": model, "real": real}.items():
        if bench.wants(name):
            part(bench, Runner(bench.workdir))
