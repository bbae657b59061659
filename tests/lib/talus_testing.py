# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Helpers for tests that run LAMMPS with the Talus plugin.

A test script derives its cases from SceneCase and ends with unittest.main().  ctest provides this folder
in PYTHONPATH, TALUS_LMP, TALUS_PLUGIN, TALUS_MPIEXEC, TALUS_SOURCE_DIR and LAMMPS_PLUGIN_PATH.  Without
a host or a plugin a script fails at import: it never skips.
"""

import atexit
import collections
import contextlib
import dataclasses
import fcntl
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from granular_script import begin, head
from lammps_output import Frame, LocalFrame, marked_word, read_dump, read_local, thermo

__all__ = ["Frame", "LocalFrame", "Result", "SceneCase", "Sphere", "begin", "head", "marked_word", "max_difference", "part_of",
           "ranks_of_refusal", "read_dump", "read_local", "relative_difference", "run_lammps", "run_program", "thermo",
           "write_sphere_data"]

DEFAULT_TIMEOUT = 120.0    # seconds; a hang is a failure
SLOWER = 4 if os.environ.get("TALUS_SANITIZE") else 1    # what sanitizers cost

# log: text of the log file; output: what the process printed; workdir: where it ran
Result = collections.namedtuple("Result", "log output returncode workdir")


# ---- running LAMMPS --------------------------------------------------------------------------

def _required_file(name):
    path = os.environ.get(name, "")
    if not os.path.isfile(path):
        sys.exit(f"{name}={path!r}: no such file; run this test through ctest or set it")
    return os.path.abspath(path)


LMP = _required_file("TALUS_LMP")
PLUGIN = _required_file("TALUS_PLUGIN")
MPIEXEC = os.environ.get("TALUS_MPIEXEC", "mpiexec")


def environment(extra):
    env = dict(os.environ)
    env.setdefault("LAMMPS_PLUGIN_PATH", os.path.dirname(PLUGIN))
    env.setdefault("OMP_NUM_THREADS", "1")
    env.setdefault("OMP_WAIT_POLICY", "passive")    # more threads than cores must not spin
    env.setdefault("OMPI_MCA_pml", "ob1")    # others take 0.2 s to start
    env.setdefault("OMPI_MCA_mpi_yield_when_idle", "1")    # ranks that wait leave busy cores to others
    env.update(OMPI_MCA_ess_singleton_isolated="1",    # no daemon for one rank, 0.1 s
               OMPI_ALLOW_RUN_AS_ROOT="1",
               OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
               OMPI_MCA_odls_base_sigkill_timeout="0",    # LAMMPS ends in a barrier: no wait, 2 s
               OMPI_MCA_rmaps_base_oversubscribe="1",               # Open MPI 4
               OMPI_MCA_hwloc_base_binding_policy="none",
               PRTE_MCA_rmaps_default_mapping_policy=":oversubscribe",    # Open MPI 5
               PRTE_MCA_hwloc_default_binding_policy="none")
    env.update({k: str(v) for k, v in (extra or {}).items()})
    return env


def processes_of_session(session):
    found = []
    for entry in filter(str.isdigit, os.listdir("/proc")):
        try:
            if os.getsid(int(entry)) == session:
                found.append(int(entry))
        except OSError:
            pass
    return found


def end_process(process):
    """End a launcher and everything it started, which may have left its process group."""
    try:
        os.killpg(process.pid, signal.SIGTERM)
        process.wait(timeout=5)
    except (ProcessLookupError, subprocess.TimeoutExpired):
        pass
    for pid in processes_of_session(process.pid):
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    process.wait()


CORES = len(os.sched_getaffinity(0))
PLACES = CORES + 2    # short runs of one rank wait for files and their launcher a third of their time


def _lock_another_place(folder, held):
    """Whether a place was free: add its locked file to held, {number: file}."""
    for place in range(PLACES):
        if place not in held:
            file = open(os.path.join(folder, str(place)), "w")
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                file.close()
            else:
                held[place] = file
                return True
    return False


@contextlib.contextmanager
def cores_held(count):
    """Hold places for that many ranks and threads.  Several hold one more, and never all: a rank spins while it waits for one
    that has no core, so on two cores no two runs of several ranks go side by side."""
    wanted = count if count == 1 else min(count, CORES) + 1
    folder = os.path.join(os.path.dirname(PLUGIN), "cores")
    os.makedirs(folder, exist_ok=True)
    held = {}
    try:
        # one collects at a time: two with a part each would wait for each other
        with open(os.path.join(folder, "gate"), "w") as gate:
            fcntl.flock(gate, fcntl.LOCK_EX)
            while len(held) < wanted:
                if not _lock_another_place(folder, held):
                    time.sleep(0.005)
        yield
    finally:
        for file in held.values():
            file.close()


def _launch(command, cwd, env, timeout, cores):
    with cores_held(cores):
        return _run_to_end(command, cwd, env, timeout)


def _threads(env):
    return int(env["OMP_NUM_THREADS"])


def _run_to_end(command, cwd, env, timeout):
    # Open MPI jobs that share a directory for temporary files remove it from under each other.
    with tempfile.TemporaryDirectory(prefix="mpi-", ignore_cleanup_errors=True) as private, \
         tempfile.TemporaryFile("w+", errors="replace") as sink:
        process = subprocess.Popen(command, cwd=cwd, env={**env, "TMPDIR": private},
                                   stdin=subprocess.DEVNULL, stdout=sink, stderr=sink,
                                   start_new_session=True)
        try:
            returncode = process.wait(timeout=timeout)
        except BaseException as problem:
            end_process(process)
            if isinstance(problem, subprocess.TimeoutExpired):
                raise AssertionError(f"no end after {timeout} s: {' '.join(command)}") from None
            raise
        sink.seek(0)
        return returncode, sink.read()


STAY = "TALUS_STAY" in os.environ and not os.environ.get("TALUS_LARGE_TESTS") and not os.environ.get("TALUS_SANITIZE")
_pool = []


def stays(env):
    """Whether runs with these variables are some of many in a process."""
    return STAY and set(env or {}) <= {"OMP_NUM_THREADS"}


def run_in_a_process_that_stays(job, np, threads, timeout):
    """(return code, output) of a job (worker.py); processes are those of this program, and end with it (pool.py)."""
    if not _pool:
        import pool    # which needs what is here
        _pool.append(pool.Pool())
        atexit.register(_pool[0].__exit__)
    return _pool[0].run_job(job, np, threads, timeout)


def _crashed_in_finalize(returncode, said, np):
    """LAMMPS and the plugin were gone, or LAMMPS had ended with an error, and so said; what is left is MPI_Finalize(), in which Open
    MPI 4 crashes about once in a thousand times (its issue 10117)."""
    segmentation_fault = 128 + 11
    return np > 1 and returncode == segmentation_fault and ("\nTotal wall time: " in said or _tells_error(said))


def _tells_error(said):
    return re.search("^ERROR(:| on proc)", said, re.MULTILINE) is not None


def run_lammps(script_text, np=1, variables=None, env=None, expect_error=False, cwd=None,
               timeout=DEFAULT_TIMEOUT, arguments=(), name="script", stay=True):
    """Run an input script on np ranks; return a Result.

    variables: {name: value or list of values} for -var.  arguments: more words for lmp.  In scripts with the word stay in
    their line "# ctest:" the run is one of many in a process, unless env asks for more than threads, or stay is False, and
    but for long test runs.
    With expect_error the run must end with a LAMMPS error (not a crash), otherwise without one.
    name: stem of the files in.NAME and log.NAME written to cwd (default: a new directory, which
    the caller removes)."""
    cwd = cwd or tempfile.mkdtemp(prefix="talus-")
    with open(os.path.join(cwd, f"in.{name}"), "w") as file:
        file.write(script_text)
    log_path = os.path.join(cwd, f"log.{name}")
    if os.path.exists(log_path):
        os.remove(log_path)

    words = ["-log", f"log.{name}", "-screen", "none"]
    for key, value in (variables or {}).items():
        values = value if isinstance(value, (list, tuple)) else [value]
        words += ["-var", key] + [repr(v) if isinstance(v, float) else str(v) for v in values]
    words += [str(word) for word in arguments]
    command = shlex.split(MPIEXEC) + ["-np", str(np)] if np > 1 else []
    command += [LMP, "-in", f"in.{name}", *words]

    stay = stay and stays(env)
    env = environment(env)
    cores = 1 if expect_error else np * _threads(env)    # the start of several ranks mostly waits, and that is all there is

    def run():
        with cores_held(cores):
            if stay:
                job = {"folder": cwd, "words": words, "script": f"in.{name}"}
                returncode, output = run_in_a_process_that_stays(job, np, _threads(env), timeout)
            else:
                returncode, output = _run_to_end(command, cwd, env, timeout * SLOWER)
        log = ""
        if os.path.exists(log_path):
            with open(log_path, errors="replace") as file:
                log = file.read()
        return returncode, log, output

    returncode, log, output = run()
    if expect_error and _crashed_in_finalize(returncode, log + "\n" + output, np):
        returncode, log, output = run()    # a crash of ours would come again
    result = Result(log, output, returncode, cwd)

    def problem(what):
        return AssertionError(f"{what}: {' '.join(command)}\n{log[-3000:]}\n{output[-2000:]}")

    if expect_error and (returncode != 1 or not _tells_error(log + "\n" + output)):
        raise problem(f"a LAMMPS error was expected, got return code {returncode}")
    if not expect_error and returncode != 0 and not _crashed_in_finalize(returncode, log, np):
        raise problem(f"return code {returncode}")
    return result


def ranks_of_refusal(n):
    """Rank counts for the n-th of many refusals by one parser, which all ranks run alike: two ranks for every eighth, for
    all in long test runs."""
    return (1, 2) if n % 8 == 0 or os.environ.get("TALUS_LARGE_TESTS") else (1,)


def part_of(cases, every, first=0):
    """Every second, third or so of many cases that differ little; all of them in long test runs, and half of these where
    sanitizers look at memory and not at numbers."""
    cases = list(cases)
    if os.environ.get("TALUS_SANITIZE"):
        every *= 2
    return cases if os.environ.get("TALUS_LARGE_TESTS") else cases[first::every]


def run_program(path, np=1, arguments=(), cwd=None, env=None, timeout=DEFAULT_TIMEOUT):
    """Run a program of ours on np ranks; return a Result without a log. A failure is an error."""
    command = shlex.split(MPIEXEC) + ["-np", str(np)] if np > 1 else []
    command += [path] + [str(word) for word in arguments]
    env = environment(env)
    returncode, output = _launch(command, cwd, env, timeout * SLOWER, np * _threads(env))
    if returncode != 0:
        raise AssertionError(f"return code {returncode}: {' '.join(command)}\n{output[-3000:]}")
    return Result("", output, returncode, cwd)


class SceneCase(unittest.TestCase):
    """A test case with a directory of its own, self.dir, that is kept if the test fails."""

    def run(self, result=None):
        result = result if result is not None else self.defaultTestResult()
        before = len(result.failures) + len(result.errors)
        self.dir = tempfile.mkdtemp(prefix=f"talus-{self._testMethodName}-")
        super().run(result)
        if len(result.failures) + len(result.errors) > before:
            print(f"{self.id()}: files kept in {self.dir}", file=sys.stderr)
        else:
            shutil.rmtree(self.dir, ignore_errors=True)
        return result

    def path(self, name):
        return os.path.join(self.dir, name)

    def read(self, name):
        with open(self.path(name)) as file:
            return file.read()

    def write(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)
        return name

    def run_lammps(self, script_text, **options):
        return run_lammps(script_text, **{"cwd": self.dir, **options})

    def assert_same_bits(self, frame, other, columns=None):
        """Two dump frames hold the same particles with the same bits, signed zeros included."""
        self.assertTrue(frame.lines, "no particles to compare")
        if not columns and frame.columns == other.columns and frame.lines == other.lines:
            return    # what is written the same is the same
        self.assertEqual(sorted(frame.tags), sorted(other.tags))
        for key in columns or frame.columns:
            if frame.words(key) != other.words(key):
                mine, theirs = frame.column(key), other.column(key)
                for tag in mine:
                    self.assertEqual(mine[tag].hex(), theirs[tag].hex(), f"{key} of atom {tag}")

    def assert_close(self, value, expected, relative, message=None):
        self.assertLessEqual(relative_difference(value, expected), relative,
                             message or f"{value!r} against {expected!r}")


# ---- what LAMMPS reads -----------------------------------------------------------------------

@dataclasses.dataclass
class Sphere:
    x: tuple
    v: tuple = (0.0, 0.0, 0.0)
    omega: tuple = (0.0, 0.0, 0.0)
    diameter: float = 1.0
    density: float = 1.0
    type: int = 1
    id: int = 0    # 0: position in the list, from 1


def write_sphere_data(path, box, particles, types=None):
    """Write a data file for atom_style sphere.  box: ((xlo, xhi), (ylo, yhi), (zlo, zhi))."""
    def row(*values):
        return " ".join(repr(float(v)) if isinstance(v, float) else str(v) for v in values) + "\n"

    numbered = [(p.id or k, p) for k, p in enumerate(particles, start=1)]
    with open(path, "w") as file:
        file.write(f"Talus test\n\n{len(numbered)} atoms\n")
        file.write(f"{types or max(p.type for p in particles)} atom types\n\n")
        for axis, (low, high) in zip("xyz", box):
            file.write(row(float(low), float(high), f"{axis}lo {axis}hi"))
        file.write("\nAtoms # sphere\n\n")
        for tag, p in numbered:
            file.write(row(tag, p.type, float(p.diameter), float(p.density), *map(float, p.x)))
        file.write("\nVelocities\n\n")
        for tag, p in numbered:
            file.write(row(tag, *map(float, p.v), *map(float, p.omega)))


# ---- comparing -------------------------------------------------------------------------------

def relative_difference(a, b):
    """|a - b| over the larger of the two; 0 for equal numbers, zeros included."""
    return 0.0 if a == b else abs(a - b) / max(abs(a), abs(b))


def max_difference(frame, other, columns):
    """Largest absolute difference of the given columns over the particles of two dump frames."""
    return max(abs(value - other.column(key)[tag])
               for key in columns for tag, value in frame.column(key).items())
