# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Sessions of LAMMPS, and input scripts, in processes that stay: one takes some hundredths of a second, since MPI and the
interpreter have started.

A process makes a fresh instance of LAMMPS for each. After a crash, a hang or an error on one rank only it is replaced, and
so it is after many sessions, which keeps what is left behind small."""

import collections
import dataclasses
import json
import os
import select
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

from coupled_case import host_environment
from talus_testing import MPIEXEC, SLOWER, cores_held, end_process, environment, processes_of_session

WORKER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "worker.py")
SHARED = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None    # memory, where there is some
LIMIT = 60.0        # seconds for a session that takes hundredths
START = 180.0       # for the start of a process, which takes half a second
LIFE = 400          # sessions of one process
OK, ERROR, CRASH, HANG = "ok", "error", "crash", "hang"


@dataclasses.dataclass
class Session:
    """What is to be run. lines: see worker.py; files: {name: bytes} that it reads; keep: names of files that it writes and others
    need."""
    lines: list
    ranks: int = 1
    threads: int = 1
    words: tuple = ()
    files: dict = dataclasses.field(default_factory=dict)
    keep: tuple = ()
    examines_numbers = False    # whether numbers in the log that are none are a fault


@dataclasses.dataclass
class Outcome:
    """kind: OK, ERROR, CRASH or HANG; text: the message, or the end of what the process said; seen: {name: text} of the files
    seen.*; kept: {name: bytes}."""
    kind: str
    text: str = ""
    log: str = ""
    seen: dict = dataclasses.field(default_factory=dict)
    kept: dict = dataclasses.field(default_factory=dict)

    @property
    def ended(self):
        return self.kind in (OK, ERROR)


class Process:
    """Ranks that wait for sessions."""

    def __init__(self, ranks, threads):
        self.ranks, self.made, self.dead = ranks, 0, False
        self.folder = tempfile.mkdtemp(prefix="talus-sessions-", dir=SHARED)
        names = [f"jobs.{rank}" for rank in range(ranks)]
        for name in ["said", *names]:
            os.mkfifo(os.path.join(self.folder, name))
        # for reading and writing, so that neither end waits for the other
        self.said = os.open(os.path.join(self.folder, "said"), os.O_RDWR | os.O_NONBLOCK)
        self.jobs = [os.open(os.path.join(self.folder, name), os.O_RDWR) for name in names]
        self.rest = b""
        env = environment({**host_environment(), "OMP_NUM_THREADS": threads, "TMPDIR": self.folder})
        launcher = shlex.split(MPIEXEC) + ["-np", str(ranks)] if ranks > 1 else []
        self.output = open(os.path.join(self.folder, "output"), "a+", errors="replace")
        self.process = subprocess.Popen([*launcher, sys.executable, WORKER, self.folder], env=env, stdin=subprocess.DEVNULL,
                                        stdout=self.output, stderr=self.output, start_new_session=True)
        kind, text = self._wait(START * SLOWER)
        if kind != OK:
            self.end()
            raise AssertionError(f"no process for sessions: {kind} {text}")

    def _lines(self, seconds):
        """What ranks have said within that time, decoded."""
        if select.select([self.said], [], [], seconds)[0]:
            self.rest += os.read(self.said, 65536)
        *lines, self.rest = self.rest.split(b"\n")
        return [json.loads(line) for line in lines]

    def _wait(self, seconds):
        """Until all ranks have said something, or one of them that the others are lost: kind and text."""
        end, found = time.monotonic() + seconds, {}
        while len(found) < self.ranks:
            gone = self.process.poll() is not None    # asked first: what was said before it went counts
            for rank, problem, lost in self._lines(0.05):
                found[rank] = problem
                if lost and self.ranks > 1:
                    self.dead = True
                    return ERROR, problem
            if len(found) == self.ranks:
                break
            if gone or time.monotonic() > end:
                self.dead = True
                if not gone:
                    self._ask_where()
                return (CRASH if gone else HANG), self._end_of_output()
        problem = max(found.values(), key=len)
        return (ERROR if problem else OK), problem

    def _ask_where(self):
        """Of ranks that hang: Open MPI lists the calls of a process that gets this signal."""
        for pid in processes_of_session(self.process.pid):
            if self.ranks == 1 or pid != self.process.pid:
                try:
                    os.kill(pid, signal.SIGSEGV)
                except ProcessLookupError:
                    pass
        time.sleep(1.0)

    def _end_of_output(self):
        said = self.printed()
        frames = said.rfind("*** Process received signal")    # Open MPI's list of calls
        return f"return code {self.process.poll()}: {said[frames:][:6000] if frames >= 0 else said[-1500:]}"

    def make(self, job, seconds):
        """job: see worker.py. Kind and text of the outcome."""
        self.made += 1
        path = os.path.join(self.folder, "job.json")
        with open(path, "w") as file:
            json.dump(job, file)
        for pipe in self.jobs:
            os.write(pipe, (path + "\n").encode())
        return self._wait(seconds)

    def printed(self):
        """All that the process has printed so far."""
        self.output.seek(0)
        return self.output.read()

    def end(self):
        end_process(self.process)
        for file in [self.said, *self.jobs]:
            os.close(file)
        self.output.close()
        shutil.rmtree(self.folder, ignore_errors=True)


class Pool:
    """Processes for sessions; run() may be called by several threads at a time. In a `with` statement they end with it."""

    def __init__(self):
        self._idle, self._lock = {}, threading.Lock()
        self.kinds = collections.Counter()    # of the outcomes so far

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in sum(self._idle.values(), []):
            process.end()
        self._idle = {}

    def _take(self, key):
        with self._lock:
            waiting = self._idle.get(key)
            if waiting:
                return waiting.pop()
        return Process(*key)

    def _give_back(self, key, process):
        if process.dead or process.made >= LIFE:
            process.end()
            return
        with self._lock:
            self._idle.setdefault(key, []).append(process)

    def run(self, session, fresh=False, limit=LIMIT):
        """The Outcome of a session; fresh: in a process that has made no other."""
        key = session.ranks, session.threads
        with cores_held(session.ranks * session.threads):
            process = Process(*key) if fresh else self._take(key)
            folder = tempfile.mkdtemp(prefix="session-", dir=process.folder)
            try:
                for name, data in session.files.items():
                    with open(os.path.join(folder, name), "wb") as file:
                        file.write(data)
                job = {"folder": folder, "words": ["-log", "log", *session.words], "lines": session.lines}
                kind, text = process.make(job, limit * SLOWER)
                outcome = Outcome(kind, text)
                self._read(folder, session, outcome)
                self.kinds[kind] += 1
            finally:
                shutil.rmtree(folder, ignore_errors=True)
                if fresh:
                    process.end()
                else:
                    self._give_back(key, process)
        return outcome

    def run_job(self, job, ranks=1, threads=1, limit=LIMIT):
        """A script or a program of the caller's folder (worker.py): return code and what was printed, as of a process of its own.
        The caller holds the cores."""
        key = ranks, threads
        process = self._take(key)
        try:
            before = len(process.printed())
            kind, text = process.make(job, limit)
            printed = process.printed()[before:]
            if kind == HANG:
                raise AssertionError(f"no end after {limit} s: {job}\n{text}")
            if kind == CRASH:    # or the command quit
                return process.process.wait(), printed
            return (1 if kind == ERROR else 0), printed + text
        finally:
            self._give_back(key, process)

    @staticmethod
    def _read(folder, session, outcome):
        for name in os.listdir(folder):
            path = os.path.join(folder, name)
            if name in session.keep:
                with open(path, "rb") as file:
                    outcome.kept[name] = file.read()
            elif name.startswith("seen.") or name == "log":
                with open(path, errors="replace") as file:
                    outcome.seen[name] = file.read()
        outcome.log = outcome.seen.pop("log", "")
