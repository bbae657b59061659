# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""ended.py COMMAND...: runs a command, in which temporary files are below a folder of its own, and returns its status. When it
is done, or a signal ends this program, or the script that called it is ended in any way, all processes that the command has
started end, with whatever session, and after a signal the folder is removed. Called by scripts/lib/measure.sh."""

import contextlib
import ctypes
import os
import shutil
import signal
import subprocess
import sys
import tempfile

PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36    # linux/prctl.h


def children():
    """Processes whose parent this one is."""
    found = []
    for entry in filter(str.isdigit, os.listdir("/proc")):
        with contextlib.suppress(OSError), open(f"/proc/{entry}/stat") as file:
            if int(file.read().rpartition(")")[2].split()[1]) == os.getpid():    # PID (NAME) STATE PARENT
                found.append(int(entry))
    return found


def end_children():
    """Kills them until there are none: those that a killed one has started become ours, and can start no more."""
    while True:
        for child in children():
            with contextlib.suppress(ProcessLookupError):
                os.kill(child, signal.SIGKILL)
        try:
            os.wait()
        except ChildProcessError:
            return


def end_with_caller():
    caller = os.getppid()
    prctl = ctypes.CDLL(None).prctl
    prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
    prctl(PR_SET_CHILD_SUBREAPER, 1)
    if os.getppid() != caller:    # ended meanwhile
        raise SystemExit(128 + signal.SIGTERM)


def end(number, _):
    for other in signal.SIGTERM, signal.SIGHUP, signal.SIGINT:
        signal.signal(other, signal.SIG_IGN)    # nothing interrupts what follows
    raise SystemExit(128 + number)


def main(command):
    for number in signal.SIGTERM, signal.SIGHUP, signal.SIGINT:
        signal.signal(number, end)
    end_with_caller()
    folder = tempfile.mkdtemp(prefix="talus-")
    try:
        status = subprocess.Popen(command, env={**os.environ, "TMPDIR": folder}, start_new_session=True).wait()
    except SystemExit:
        end_children()
        shutil.rmtree(folder, ignore_errors=True)
        raise
    end_children()
    with contextlib.suppress(OSError):    # what shall be kept is in there
        os.rmdir(folder)
    return status if status >= 0 else 128 - status


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
