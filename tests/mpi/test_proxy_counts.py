# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=20 timeout=300
"""Messages, bytes and collective operations of a step, counted by an interposed library.

Particles at rest: the steps of a long run are those of a short one and more of the same.  What one
step must send is worked out from the positions: a message to each rank that has at least one proxy of
ours, of 72 bytes for each of our particles with a proxy there: once, however many images of it are there.  In
scenes without friction steps without output send 48 bytes, from records to records; where types have a shape,
all steps 104."""

import itertools
import os
import random
import re
import unittest

from message_counts import counting
from talus_testing import SceneCase, Sphere, thermo, write_sphere_data

BOX = (12.0, 10.0, 8.0)
CUT = 1.4    # cutoff for ghosts
SHORT, LONG = 20, 52    # of fours, as the changes that energies take

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
timestep 0.001
fix step all nve/sphere/symplectic
{more}
comm_proxy {proxies}
run_style {style}
thermo 1000
{before_run}
run {steps}
{after_run}
comm_proxy info
""" % CUT
STATS = dict(before_run="compute cost all penalty/stats",
             after_run="thermo_style custom step c_cost[8] c_cost[9] c_cost[10] c_cost[11]\nrun 0")
NO_STATS = dict(before_run="", after_run="")
IN_RECORDS = "steps without output              in the records"


def grains():
    """Nearly at rest, and without contacts: where nothing moves at all, each step asks whether that is still so."""
    draw = random.Random(8)
    return [Sphere(tuple(s + 0.5 + draw.uniform(-0.2, 0.2) for s in site), v=(1e-9, 0, 0), diameter=0.5)
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

    def counted(self, steps, ranks, builds=0, env=None, arguments=(), **scene):
        """Counts of a run, per rank: {'collectives', 'started', 'beside', other rank: (messages, bytes)}"""
        stem = self.path("counts")
        for name in os.listdir(self.dir):
            if name.startswith("counts."):
                os.remove(self.path(name))
        result = self.run_lammps(SCRIPT.format(steps=steps, **scene), np=ranks, arguments=arguments,
                                 env={**counting(stem), **(env or {})})
        self.assertIn(f"Neighbor list builds = {builds}\n", result.log)
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

    def check(self, grid, boundary="p p p", size=72, style="verlet/proxy overlap yes", law=None, more="", stats=True,
              in_records=True):
        particles = grains()
        write_sphere_data(self.path("grains"), tuple((0.0, length) for length in BOX), particles, types=2)
        ranks = grid[0] * grid[1] * grid[2]
        found, log = self.per_step(ranks, boundary=boundary, law=law or LAWS[size], style=style,
                                   grid="%d %d %d map zyx" % grid, proxies="yes", more=more,
                                   **(STATS if stats else NO_STATS))
        expected = expected_proxies(particles, grid, [b == "p" for b in boundary.split()])
        messages, sent = [], []
        for rank, counts in enumerate(found):
            if style.startswith("verlet/proxy"):
                self.assertEqual(counts["collectives"], 0)
                self.assertEqual(counts["started"], int(ranks > 1))    # the forecast for the next step
            else:
                self.assertEqual(counts["collectives"], 1)    # the host's rebuild check
            others = {key: value for key, value in counts.items() if isinstance(key, int)}
            self.assertEqual(others, {other: (1, n * size) for (owner, other), n in
                                      expected.items() if owner == rank})
            messages.append(len(others))
            sent.append(sum(size for _, size in others.values()))
        self.assert_own_counters(log, "messages per exchange", messages)
        full = sent if size == 104 else [72 * n // size for n in sent]    # from arrays to arrays
        looked_at = 2 if size == 48 else LONG    # before and after those in records
        self.assert_own_counters(log, "bytes per exchange", full)
        self.assert_own_counters(log, "messages sent", [LONG * n for n in messages])
        self.assert_own_counters(log, "bytes sent", [looked_at * n + (LONG - looked_at) * m
                                                     for n, m in zip(full, sent)])
        if not stats:
            return self.assertEqual(IN_RECORDS in log, in_records)
        cost = thermo(log)[-1]
        self.assertEqual((cost["c_cost[8]"], cost["c_cost[9]"]), (sum(messages), sum(full)))
        self.assertGreaterEqual(cost["c_cost[11]"], 0.0)
        self.assertGreater(cost["c_cost[10]"], 0.0)

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

    def test_without_friction_records_send_no_angular_velocity(self):
        self.check((2, 2, 1), size=48, stats=False)
        # where others look at each step, the arrays of LAMMPS are complete
        self.check((2, 1, 1), size=72, law=LAWS[48], stats=False, in_records=False,
                   more="fix other all langevin 0.0 0.0 1.0 1")

    def test_orientations_travel_along(self):
        """Where types have a shape, with all particles in the same messages: 104 bytes."""
        for style in "verlet/proxy overlap yes", "verlet/proxy overlap no":
            self.check((2, 2, 1), size=104, law=LAWS[72], stats=False, style=style,
                       more="fix s all shape/gran type 2 box 0.1 0.1 0.1 density 1")

    def test_with_friction_in_records(self):
        self.check((2, 1, 1), stats=False)

    def test_rebuilds(self):
        """One reduction for all warnings, of pairs and of bodies, and one for the longest history that may travel;
        in periodic boxes those by which ranks agree on the histories of pairs that two of them compute."""
        write_sphere_data(self.path("grains"), tuple((0.0, length) for length in BOX), grains())
        law = LAWS[72]
        bodies = "\n".join(f"fix body{n} all large/body plane 0 0 {-n} 0 0 1 contact {law} move linear 0 0 0"
                           for n in range(1, 4))
        for boundary, more, law, most in (("f f f", "", LAWS[72], 2), ("f f f", bodies, LAWS[72], 2),
                                          ("f f f", bodies, LAWS[48], 2), ("p p f", bodies, LAWS[72], 4)):
            with self.subTest(boundary=boundary, more=more, law=law):
                counts = []
                for steps in SHORT, LONG:
                    found, _ = self.counted(steps, 2, builds=steps, boundary=boundary, law=law, grid="2 1 1",
                                            style="verlet/proxy overlap yes", proxies="yes", **NO_STATS,
                                            more="neigh_modify every 1 delay 0 check no\n" + more)
                    counts.append([rank["collectives"] for rank in found])
                for before, after in zip(*counts):
                    per_rebuild = (after - before) / (LONG - SHORT)
                    self.assertGreaterEqual(per_rebuild, 1)
                    self.assertLessEqual(per_rebuild, most)

    def test_messages_are_asked_for_beside_threads_only_where_mpi_allows_it(self):
        write_sphere_data(self.path("grains"), tuple((0.0, length) for length in BOX), grains())
        single, funneled = "0", "1"    # the order of MPI_THREAD_SINGLE, MPI_THREAD_FUNNELED in every MPI
        for threads, level, expected in (2, single, False), (2, funneled, True), (1, single, False):
            with self.subTest(threads=threads, level=level):
                found, _ = self.counted(SHORT, 2, boundary="p p p", law=LAWS[72], grid="2 1 1", style="verlet/proxy overlap yes",
                                        proxies="yes", more="", **NO_STATS, arguments=("-pk", "omp", threads),
                                        env={"TALUS_THREAD_LEVEL": level, "OMP_WAIT_POLICY": "passive"})
                for rank in found:
                    self.assertEqual(rank["beside"] > 0, expected)

    def test_blocking(self):
        self.check((2, 2, 1), style="verlet/stock", stats=False, in_records=False)
        self.check((2, 2, 1), style="verlet/proxy overlap no")

    def test_energies_send_changes_of_velocities_where_lammps_sends(self):
        """In one step of four, by the messages of LAMMPS: there and back in each direction, none across a corner."""
        particles = grains()
        write_sphere_data(self.path("grains"), tuple((0.0, length) for length in BOX), particles)
        found, _ = self.per_step(4, boundary="p p p", law=LAWS[72], style="verlet/stock", grid="2 2 1 map zyx", proxies="yes",
                                 more="", **STATS)
        self.assertEqual({other: count[0] for other, count in found[0].items() if isinstance(other, int)}, {1: 1.5, 2: 1.5, 3: 1.0})


if __name__ == "__main__":
    unittest.main()
