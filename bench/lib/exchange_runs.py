# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Scenes of the benchmark of the exchange, and how they are run: with a library preloaded, on any number of ranks."""

import dataclasses
import os
import re
import shlex
import statistics
import subprocess

import beds
import machine
import paired

LAWS = {"friction": beds.HISTORY, "frictionless": beds.FRICTIONLESS}
METHODS = {
    "stock": "comm_proxy no\nrun_style verlet/stock",
    "direct": "comm_proxy yes\nrun_style verlet/proxy overlap no",
    "overlapped": "comm_proxy yes\nrun_style verlet/proxy overlap yes",
}
# under the run style of LAMMPS
VERLET = {"stock": "comm_proxy no\nrun_style verlet/stock", "direct": "comm_proxy yes\nrun_style verlet/stock"}

COUNTER = os.path.join(machine.BUILD, "tests", "libcount_mpi.so")
MODEL = os.path.join(machine.BUILD, "bench", "libnetwork_model.so")

START = """units {units}
boundary {boundary}
atom_style sphere
atom_modify map yes
newton off
comm_modify vel yes
processors {grid}
"""


class Runner:
    """Runs scripts in a directory of their own."""

    def __init__(self, workdir):
        self.workdir = workdir

    def run(self, script, ranks=2, preload=None, **variables):
        """Returns the log.  preload: a library; variables: of the environment."""
        with open(os.path.join(self.workdir, "in.bench"), "w") as file:
            file.write(script)
        env = {**os.environ, "OMP_NUM_THREADS": "1", "OMPI_MCA_pml": "ob1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
               **{name: str(value) for name, value in variables.items()}}
        command = ["mpirun", "-np", str(ranks)]
        if preload:
            command += ["env", f"LD_PRELOAD={preload}"]
        command += [machine.TALUS_LMP, "-in", "in.bench", "-log", "log.bench", "-screen", "none"]
        done = subprocess.run(command, cwd=self.workdir, env=env, capture_output=True, text=True)
        with open(os.path.join(self.workdir, "log.bench")) as file:
            log = file.read()
        if done.returncode:
            raise RuntimeError(f"{shlex.join(command)}\n{log[-2000:]}\n{done.stderr[-2000:]}")
        return log


class Bed:
    """A bed on a floor, between walls or periodic in x and y, cut in two along x, that has come to rest."""

    def __init__(self, bench, runner, count, law="friction", periodic=False, physics=None):
        self.count, self.file = count, f"rest-{count}-{law}-{periodic}-{bool(physics)}"
        self.physics = physics or beds.talus(LAWS[law], walls=not periodic)
        self.boundary = "p p f" if periodic else "f f f"
        data = beds.tile_data(bench)[0] if periodic else beds.bed(bench, count)[0]
        if os.path.exists(os.path.join(runner.workdir, self.file)):
            return
        steps = max(500, min(4000, 100000000 // count))
        runner.run(self.start(f"read_data {data}") + self.physics +
                   f"neighbor {beds.SKIN} bin\n{beds.neighbors(0)}timestep {beds.DT}\nfix slow all viscous 2e-2\n"
                   f"thermo 100000\nthermo_modify lost error\nrun {steps}\nwrite_restart {self.file}\n")

    def start(self, read):
        return START.format(units="si", boundary=self.boundary, grid="2 1 1") + read + "\n"

    def script(self, methods, steps, cycles, every=0, networks=(None,)):
        """Continues the bed: short runs of all methods in turns, every second cycle in reverse order.  The machine
        changes its speed from second to second, so the turns must be shorter.  every: see beds.neighbors();
        networks: latency (us) and bandwidth (GB/s) of the model of a network, whose library must be preloaded."""
        turns = [f"{modeled_by(networks[n])}{command}\nprint 'TURN {name} {n}'\nrun {steps} post no\n"
                 for n in range(len(networks)) for name, command in methods.items()]
        return (self.start(f"read_restart {self.file}") + self.physics +
                f"neighbor {beds.SKIN} bin\n{beds.neighbors(every)}timestep {beds.DT}\nthermo 1000000\n"
                f"thermo_modify lost error\nrun {2 * steps}\n" +
                "".join("".join(turns[::1 if k % 2 == 0 else -1]) for k in range(cycles)))


def modeled_by(network):
    if not network:
        return ""
    return f"shell putenv TALUS_LATENCY={1e-6 * network[0]!r} TALUS_BANDWIDTH={1e9 * network[1]!r}\n"


@dataclasses.dataclass
class Turns:
    """Of one method: time of a step (us) in each cycle, waiting for proxies (us), and bytes of a message."""
    step: list
    waited: list
    sent: float = 0.0

    @property
    def median(self):
        return statistics.median(self.step)

    @property
    def waiting(self):
        return statistics.median(self.waited) if self.waited else float("nan")


EXCHANGE = re.compile(r"Talus exchange: (\d+) updates .* bytes [^/]+/([^/]+)/.* waiting [^/]+/([^/]+)/")
LOOP = re.compile(r"Loop time of (\S+) on \d+ procs for (\d+) steps")


def read_turns(log):
    """[{method: Turns}, ...] of a script by Bed.script(), for each network."""
    found, turns = [], None
    for line in log.splitlines():
        exchange, loop = EXCHANGE.match(line), LOOP.match(line)
        if line.startswith("TURN "):
            _, method, network = line.split()
            while len(found) <= int(network):
                found.append({})
            turns = found[int(network)].setdefault(method, Turns([], []))
        elif exchange and turns:
            turns.waited.append(1e6 * float(exchange[3]) / max(1, int(exchange[1])))
            turns.sent = float(exchange[2])
        elif loop and turns:
            turns.step.append(1e6 * float(loop[1]) / int(loop[2]))
    return found


def ratio(a, b):
    """Median of a/b over the cycles, and its quartiles."""
    low, middle, high = statistics.quantiles([x / y for x, y in zip(a.step, b.step)], n=4)
    return paired.Ratio(middle, low, high)


# ---- counting ---------------------------------------------------------------------------------

def rest_scene(grid, law, method, steps):
    """Grains at rest that do not touch, 6 x 6 x 6 per rank, periodic: nothing ever happens but the exchange."""
    box = [6 * n for n in grid]
    law = {"friction": "hertz 4000.0 40.0 tangential multistep NULL NULL 0.5", "frictionless": "hertz 4000.0 40.0"}[law]
    return START.format(units="lj", boundary="p p p", grid="%d %d %d" % grid) + f"""
lattice sc 1.0
region box block 0 {box[0]} 0 {box[1]} 0 {box[2]}
create_box 1 box
create_atoms 1 box
set group all diameter 0.8
set group all density 1.0
comm_modify cutoff 1.2
pair_style gran/penalty
pair_coeff * * {law}
fix step all nve/sphere/symplectic
neigh_modify every 1 delay 0 check yes
thermo 100000
{METHODS[method]}
run {steps}
"""


def counted(runner, grid, law, method):
    """[messages, bytes, blocking collectives] of a step, of each rank."""
    ranks = grid[0] * grid[1] * grid[2]
    stem = os.path.join(runner.workdir, "counts")
    totals = []
    for steps in 10, 30:
        runner.run(rest_scene(grid, law, method, steps), ranks, COUNTER, TALUS_COUNTS=stem,
                   OMPI_MCA_mpi_yield_when_idle=1)
        totals.append([_read_counts(f"{stem}.{rank}") for rank in range(ranks)])
    return [[(b - a) / 20 for a, b in zip(*pair)] for pair in zip(*totals)]


def _read_counts(path):
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
