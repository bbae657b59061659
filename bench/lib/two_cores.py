# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What two cores cost each other on this machine, whatever they compute."""

import os
import statistics
import subprocess

import machine

LOCKSTEP = os.path.join(machine.BUILD, "bench", "lockstep")
TURNS = 10


def _lockstep(cores, turns):
    done = subprocess.run([LOCKSTEP, *map(str, cores), str(turns)], capture_output=True, text=True, check=True)
    return map(float, done.stdout.split())


def lockstep(cores):
    """Throughput of two cores that wait for each other after each millisecond of work, of that of two that do not."""
    apart, together, _ = _lockstep(cores, TURNS)
    return apart / together


def line_trip(cores):
    """Time (ns) that a cache line takes from one core to the other and back."""
    return list(_lockstep(cores, 0))[2]


class Distance:
    """How far two cores are from each other before and after runs.  Virtual cores may be moved between processors
    that share a cache and such that do not, at any time."""

    NAMES = ("near", "far", "changing")

    def __init__(self, cores):
        self.cores, self.trips = cores, {}

    def around(self, case, run):
        """The result of run(), which is remembered as one of a case."""
        before = line_trip(self.cores)
        result = run()
        self.trips.setdefault(case, []).append((before, line_trip(self.cores)))
        return result

    def shortest(self):
        return min(min(pair) for pairs in self.trips.values() for pair in pairs)

    def name(self, before, after):
        """`near` if a line took less than twice the shortest of all times, before and after."""
        far = [trip > 2.0 * self.shortest() for trip in (before, after)]
        return self.NAMES[2 if far[0] != far[1] else far[0]]

    def sort(self, case, values):
        """{name: values of the rounds in which the cores were so}."""
        sorted_values = {name: [] for name in self.NAMES}
        for (before, after), value in zip(self.trips[case], values):
            sorted_values[self.name(before, after)].append(value)
        return sorted_values

    def time(self, name):
        """Median time of a line in the runs of all cases that were so."""
        return statistics.median(trip for pairs in self.trips.values() for pair in pairs
                                 if self.name(*pair) == name for trip in pair)

    def seen(self, name):
        return any(self.name(*pair) == name for pairs in self.trips.values() for pair in pairs)
