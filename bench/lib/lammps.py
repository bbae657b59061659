# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Run LAMMPS (with or without Talus) or LIGGGHTS, and read what it says."""

import dataclasses
import os
import re
import resource
import shutil
import signal
import subprocess
import tempfile
import threading
import time

import machine

TALUS, STOCK, LIGGGHTS = "talus", "stock", "liggghts"
BODY = "body"          # LAMMPS with package BODY
ASPHERE = "asphere"    # LAMMPS of 2026 with package ASPHERE
SECOND = "order2"      # Talus with order 2 of its integrator
TIMEOUT = 1800.0
START_LIMIT, STARTS = 30.0, 3      # seconds until LAMMPS must have opened its log; attempts


@dataclasses.dataclass
class Loop:
    """One `run` command: its loop time (s), steps, atoms, and time by category (s, mean of ranks)."""
    seconds: float
    steps: int
    atoms: int
    breakdown: dict

    def nanoseconds(self):
        """Per particle and step."""
        return 1e9 * self.seconds / max(1, self.steps * self.atoms)


@dataclasses.dataclass
class Result:
    log: str
    output: str
    returncode: int
    seconds: float      # wall clock of the whole process
    peak: int           # resident bytes of the process at most; one rank only; see measured_peak()

    def loops(self):
        return read_loops(self.log)

    def printed(self, word):
        """Numbers of the lines that the script printed as: WORD number number ..."""
        return [list(map(float, line.split()[1:])) for line in self.log.splitlines()
                if line.startswith(word + " ")]

    def warnings(self):
        return [line for line in self.log.splitlines() if line.startswith("WARNING")]

    def error(self):
        match = re.search(r"^ERROR.*$", self.log + "\n" + self.output, re.MULTILINE)
        if match:
            return match.group(0)
        return f"ended by signal {-self.returncode} after {self.seconds:.0f} s" if self.returncode < 0 else ""


class Failed(Exception):
    """A run that should have worked did not."""


def own_peak():
    """Resident bytes of this process at most."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def measured_peak(result):
    """The peak of a run. A process that is started here is at first a copy of this one: a smaller peak cannot be seen."""
    if result.peak <= own_peak():
        raise Failed("a run takes no more memory than the benchmark itself, which hides it")
    return result.peak


def _program(code):
    return {TALUS: machine.TALUS_LMP, SECOND: machine.TALUS_LMP, STOCK: machine.STOCK_LMP, LIGGGHTS: machine.LIGGGHTS,
            BODY: machine.BODY_LMP, ASPHERE: machine.ASPHERE_LMP}[code]


def _command(code, name, cores, ranks, threads, arguments):
    # LIGGGHTS crashes where it reads a mesh without a screen
    screen = f"screen.{name}" if code == LIGGGHTS else "none"
    command = [_program(code), "-in", f"in.{name}", "-log", f"log.{name}", "-screen", screen, *arguments]
    if threads > 1:
        command += ["-pk", "omp", str(threads)]
    if ranks > 1:
        place = ["--bind-to", "none"] if threads > 1 or ranks > len(machine.cores()) else ["--bind-to", "core"]
        command = ["mpirun", "-np", str(ranks), *place, "-x", "OMP_NUM_THREADS", *command]
    if cores is not None:
        command = ["taskset", "-c", ",".join(map(str, cores)), *command]
    return command


def _environment(threads, ranks, session):
    env = dict(os.environ, OMP_NUM_THREADS=str(threads))
    if ranks == 1:
        env["OMPI_MCA_btl"] = "self"                # no shared memory, whose names could collide
    env["OMPI_MCA_orte_tmpdir_base"] = session      # processes that share one remove it from under each other
    env.setdefault("OMPI_MCA_pml", "ob1")                 # others take longer to start
    env.setdefault("OMPI_MCA_ess_singleton_isolated", "1")
    env["OMPI_MCA_odls_base_sigkill_timeout"] = "0"
    if ranks * threads > len(machine.cores()):      # who waits must not keep others from working
        env.update(OMP_WAIT_POLICY="passive", OMPI_MCA_mpi_yield_when_idle="1")
    elif threads > 1:
        env.update(OMP_PROC_BIND="spread", OMP_PLACES="cores")
    return env


def _end(process):
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


def _wait(process, timeout, log):
    """wait4 with a time limit; the resources are those of this child alone. MPI hangs now and then when it
    starts: without a log after START_LIMIT the run is ended."""
    timers = [threading.Timer(timeout, _end, [process]),
              threading.Timer(START_LIMIT, lambda: os.path.exists(log) or _end(process))]
    for timer in timers:
        timer.start()
    try:
        _, status, usage = os.wait4(process.pid, 0)
    except BaseException:
        _end(process)
        raise
    finally:
        for timer in timers:
            timer.cancel()
    process.returncode = os.waitstatus_to_exitcode(status)
    return usage.ru_maxrss * 1024


def _launch(command, workdir, screen, log, threads, ranks, timeout):
    """(return code, peak of resident bytes)."""
    session = tempfile.mkdtemp(prefix="mpi-")       # not below workdir: paths of sockets must be short
    try:
        with open(screen, "w") as file:
            process = subprocess.Popen(command, cwd=workdir, stdout=file, stderr=subprocess.STDOUT,
                                       stdin=subprocess.DEVNULL, env=_environment(threads, ranks, session),
                                       start_new_session=True)
            peak = _wait(process, timeout, log)
        return process.returncode, peak
    finally:
        shutil.rmtree(session, ignore_errors=True)


def run(workdir, name, script, code=TALUS, cores=None, ranks=1, threads=1, arguments=(), check=True,
        timeout=TIMEOUT, prefix=()):
    """Run an input script in workdir and return a Result.  cores: pinned to these, or None; prefix: words of
    a command that runs the command."""
    with open(os.path.join(workdir, f"in.{name}"), "w") as file:
        file.write(script)
    log = os.path.join(workdir, f"log.{name}")
    if os.path.exists(log):
        os.remove(log)
    screen = os.path.join(workdir, f"out.{name}")
    command = [*prefix, *_command(code, name, cores, ranks, threads, arguments)]
    for _ in range(STARTS):
        start = time.perf_counter()
        returncode, peak = _launch(command, workdir, screen, log, threads, ranks, timeout)
        if os.path.exists(log):
            break
    result = Result(_read(log), _read(screen), returncode, time.perf_counter() - start, peak)
    if check and result.returncode:
        raise Failed(f"{code}, in.{name}: {result.error() or f'return code {result.returncode}'}\n"
                     + result.log[-1500:] + result.output[-1500:])
    return result


def _read(path):
    if not os.path.exists(path):
        return ""
    with open(path, errors="replace") as file:
        return file.read()


LOOP = re.compile(r"^Loop time of (\S+) on \d+ procs.* for (\d+) steps with (\d+) atoms")
SHARE = re.compile(r"^(Pair|Neigh|Comm|Modify|Output|Other)\s*\|")
OLD_SHARE = re.compile(r"^(Pair|Neigh|Comm|Modfy|Outpt|Other)\s+time \(%\) = (\S+)")


def read_loops(log):
    loops = []
    for line in log.splitlines():
        match = LOOP.match(line)
        if match:
            loops.append(Loop(float(match[1]), int(match[2]), int(match[3]), {}))
        elif loops and SHARE.match(line):
            columns = [c.strip() for c in line.split("|")]
            seconds = columns[2] or columns[1]
            if seconds:
                loops[-1].breakdown[columns[0]] = float(seconds)
        elif loops and OLD_SHARE.match(line):
            name, seconds = OLD_SHARE.match(line).groups()
            loops[-1].breakdown[{"Modfy": "Modify", "Outpt": "Output"}.get(name, name)] = float(seconds)
    return loops


def read_frames(path):
    """Frames of a text `dump custom` with columns of numbers: list of (step, {column: list}) sorted by id."""
    frames = []
    if not os.path.exists(path):
        return frames
    with open(path) as file:
        lines = iter(file.read().split("\n"))
    for line in lines:
        if line.startswith("ITEM: TIMESTEP"):
            step = int(next(lines))
        elif line.startswith("ITEM: NUMBER OF ATOMS"):
            count = int(next(lines))
        elif line.startswith("ITEM: ATOMS"):
            columns = line.split()[2:]
            rows = [tuple(map(float, next(lines).split())) for _ in range(count)]
            tag = columns.index("id")
            rows.sort(key=lambda row: row[tag])
            frames.append((step, {name: [row[k] for row in rows] for k, name in enumerate(columns)}))
    return frames


def write_data(path, box, rows, velocities=None, types=1, molecules=()):
    """A data file for atom_style sphere that LAMMPS and LIGGGHTS read.

    box: ((xlo, xhi), (ylo, yhi), (zlo, zhi)); rows: (id, type, diameter, density, x, y, z);
    velocities: (id, vx, vy, vz, wx, wy, wz) or None; molecules: numbers of them by ID from 1 on, for a fix property/atom."""
    with open(path + ".new", "w") as file:
        file.write(f"spheres\n\n{len(rows)} atoms\n{types} atom types\n\n")
        for axis, (low, high) in zip("xyz", box):
            file.write(f"{low!r} {high!r} {axis}lo {axis}hi\n")
        file.write("\nAtoms\n\n")
        file.writelines("%d %d %.17g %.17g %.17g %.17g %.17g\n" % tuple(row) for row in rows)
        if velocities:
            file.write("\nVelocities\n\n")
            file.writelines("%d %.17g %.17g %.17g %.17g %.17g %.17g\n" % tuple(row) for row in velocities)
        if molecules:
            file.write("\nMolecules\n\n")
            file.writelines(f"{k} {molecule}\n" for k, molecule in enumerate(molecules, 1))
    os.replace(path + ".new", path)
