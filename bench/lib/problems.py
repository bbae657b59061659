# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What the problems of validate/ share: their input scripts, and many runs at once."""

import concurrent.futures
import os
import queue

import lammps
import machine

LIMIT = 7200.0      # seconds for a run


def script(name):
    with open(os.path.join(machine.ROOT, "validate", f"in.{name}")) as file:
        return file.read()


def run(bench, name, case, variables, cores, **more):
    """The input script validate/in.NAME with these variables, in a folder of its own, which is its variable `out` too."""
    folder = bench.path(case)
    os.makedirs(folder, exist_ok=True)
    words = [word for key, value in {**variables, "out": folder}.items() for word in ("-var", key, str(value))]
    result = lammps.run(folder, name, script(name), lammps.TALUS, cores=cores, arguments=words, timeout=LIMIT, **more)
    return folder, result


def at_once(tasks):
    """Results of task(cores) for all of them, in their order; each has a core of its own while it runs."""
    free = queue.Queue()
    for core in machine.cores():
        free.put(core)

    def work(task):
        core = free.get()
        try:
            return task([core])
        finally:
            free.put(core)
    with concurrent.futures.ThreadPoolExecutor(len(machine.cores())) as pool:
        return list(pool.map(work, tasks))
