# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300 procs=2
"""Messages, bytes and collective operations of a step, counted by an interposed library.

Particles at rest: the steps of a long run are those of a short one and more of the same.  What one
step must send is worked out from the positions: a message to each rank that has at least one proxy of
ours, of 72 bytes, or 48 without friction, for each of our particles with a proxy there: once, however many
images of it are there."""

import itertools
import os
import random
import re
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "lib"))
from talus_testing import SceneCase, Sphere, thermo, write_sphere_data

BOX = (12.0, 10.0, 8.0)
CUT = 1.4    # cutoff for ghosts
SHORT, LONG = 20, 50

LAWS = {72: "hertz 4000.0 40.0 tangential multistep NULL NULL 0.5", 48: "hertz 4000.0 40.0"}
SCRIPT = """
units lj
boundary {boundary}
atom_style sphere
newton off
processors {grid}
comm_modify vel yes cutoff %s
read_data grains
pair_style gran/penalty
pair_coeff * * {law}
neighbor 0.2 bin
neigh_modify every 1 delay 0 check yes
timestep 0.001
fix step all nve/sphere/symplectic
{more}
comm_proxy {proxies}
run_style {style}
thermo 1000
compute cost all penalty/stats
run {steps}
thermo_style custom step c_cost[8] c_cost[9] c_cost[10] c_cost[11]
run 0
comm_proxy info
""" % CUT


def grains():
    """At rest, and without contacts."""
    draw = random.Random(8)
    return [Sphere(tuple(s + 0.5 + draw.uniform(-0.2, 0.2) for s in site), diameter=0.5)
            for site in itertools.product(*(range(int(length)) for length in BOX))]


def expected_proxies(particles, grid, periodic):
    """{(owner, other rank): number of particles with proxies there}, ranks numbered with z fastest as the host does."""
    def ranges(d):
        width = BOX[d] / grid[d]
        return [(k * width, (k + 1) * width) for k in range(grid[d])]

    counts = {}
    for p in particles:
        along = []    # per direction: places that see an image, and whether the image is shifted
        home = []
        for d in range(3):
            home.append(int(p.x[d] / (BOX[d] / grid[d])))
            shifts = (-1, 0, 1) if periodic[d] else (0,)
            along.append([(place, shift) for place, (low, high) in enumerate(ranges(d))
                          for shift in shifts
                          if low - CUT <= p.x[d] + shift * BOX[d] <= high + CUT])
        places = {tuple(image[0] for image in images) for images in itertools.product(*along)}
        for place in places - {tuple(home)}:    # nothing is sent to the own rank
            key = tuple(home), place
            counts[key] = counts.get(key, 0) + 1
    def rank(place):
        return (place[0] * grid[1] + place[1]) * grid[2] + place[2]

    return {(rank(owner), rank(other)): n for (owner, other), n in counts.items()}


class Counts(SceneCase):

    def counted(self, steps, ranks, **scene):
        """Counts of a run, per rank: {'collectives', 'started', other rank: (messages, bytes)}"""
        stem = self.path("counts")
        for name in os.listdir(self.dir):
            if name.startswith("counts."):
                os.remove(self.path(name))
        library = os.path.join(os.environ["TALUS_BINARY_DIR"], "tests", "libcount_mpi.so")
        preload = " ".join(filter(None, [os.environ.get("LD_PRELOAD"), library]))
        result = self.run_lammps(SCRIPT.format(steps=steps, **scene), np=ranks,
                                 env={"LD_PRELOAD": preload, "TALUS_COUNTS": stem})
        self.assertIn("Neighbor list builds = 0", result.log)
        found = []
        for r in range(ranks):
            entries = {}
            with open(f"{stem}.{r}") as file:
                for line in file:
                    words = line.split()
                    if words[0] == "to":
                        entries[int(words[1])] = int(words[3]), int(words[5])
                    else:
                        entries[words[0]] = int(words[1])
            found.append(entries)
        return found, result.log

    def per_step(self, ranks, **scene):
        short, _ = self.counted(SHORT, ranks, **scene)
        long, log = self.counted(LONG, ranks, **scene)
        steps = LONG - SHORT
        result = []
        for before, after in zip(short, long):
            difference = {}
            for key, value in after.items():
                if isinstance(value, tuple):
                    old = before.get(key, (0, 0))
                    value = tuple((a - b) / steps for a, b in zip(value, old))
                    if value != (0, 0):
                        difference[key] = value
                else:
                    difference[key] = (value - before.get(key, 0)) / steps
            result.append(difference)
        return result, log

    def check(self, grid, boundary="p p p", size=72, style="verlet/proxy", law=None, more=""):
        particles = grains()
        write_sphere_data(self.path("grains"), tuple((0.0, length) for length in BOX), particles)
        ranks = grid[0] * grid[1] * grid[2]
        found, log = self.per_step(ranks, boundary=boundary, law=law or LAWS[size], style=style,
                                   grid="%d %d %d map zyx" % grid, proxies="yes", more=more)
        expected = expected_proxies(particles, grid, [b == "p" for b in boundary.split()])
        messages, sent = [], []
        for rank, counts in enumerate(found):
            if style.startswith("verlet/proxy"):
                self.assertEqual(counts["collectives"], 0)
                self.assertEqual(counts["started"], 1)    # the forecast for the next step
            else:
                self.assertEqual(counts["collectives"], 1)    # the host's rebuild check
            others = {key: value for key, value in counts.items() if isinstance(key, int)}
            self.assertEqual(others, {other: (1, n * size) for (owner, other), n in
                                      expected.items() if owner == rank})
            messages.append(len(others))
            sent.append(sum(size for _, size in others.values()))
        self.assert_own_counters(log, "messages per exchange", messages)
        self.assert_own_counters(log, "bytes per exchange", sent)
        self.assert_own_counters(log, "messages sent", [LONG * n for n in messages])
        self.assert_own_counters(log, "bytes sent", [LONG * n for n in sent])
        stats = thermo(log)[-1]
        self.assertEqual((stats["c_cost[8]"], stats["c_cost[9]"]), (sum(messages), sum(sent)))
        self.assertGreaterEqual(stats["c_cost[11]"], 0.0)
        self.assertGreater(stats["c_cost[10]"], 0.0)

    def assert_own_counters(self, log, name, values):
        numbers = re.search(rf"{name} +(\S+) +(\S+) +(\S+)$", log, re.MULTILINE).groups()
        mine = min(values), sum(values) / len(values), max(values)
        for number, value in zip(numbers, mine):
            self.assertLessEqual(abs(float(number) - value), 1e-5 * value, name)

    def test_grids(self):
        for grid in (1, 1, 1), (2, 1, 1), (1, 1, 4), (2, 2, 1), (2, 2, 2):
            with self.subTest(grid=grid):
                self.check(grid)

    def test_walls(self):
        self.check((2, 2, 1), boundary="f f f")
        self.check((4, 1, 1), boundary="f p f")

    def test_without_friction_no_spin_is_sent(self):
        self.check((2, 2, 1), size=48)
        # unless somebody else may read it
        self.check((2, 1, 1), size=72, law=LAWS[48], more="fix other all langevin 0.0 0.0 1.0 1")

    def test_blocking(self):
        self.check((2, 2, 1), style="verlet")
        self.check((2, 2, 1), style="verlet/proxy overlap no")


if __name__ == "__main__":
    unittest.main()
