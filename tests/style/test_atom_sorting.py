# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""atom_modify sort and pair_style gran/penalty, which sorts particles itself while a run lasts.

What atom_modify says, before or between runs, must hold: without sorting particles stay where they are in memory, and
once the pair style is gone the host sorts as often as it was told."""

import random
import unittest

from talus_testing import SceneCase, Sphere, write_sphere_data

SORTED, UNSORTED = "atom_modify sort 100 0.6", "atom_modify sort 0 0.0"
START = """
units lj
atom_style sphere
atom_modify map yes
{before}
boundary f f f
newton off
comm_modify vel yes
read_data grains
pair_style gran/penalty
pair_coeff * * hertz 4000.0 40.0
neighbor 0.1 bin
timestep 0.001
fix step all nve/sphere/symplectic
"""
RUN = "run 2\nwrite_dump all custom {name} id modify sort off\n"
OTHER_STYLE = "unfix step\npair_style zero 1.0\npair_coeff * *\n"
NAMES = "first", "second", "host"


class Sorting(SceneCase):

    def setUp(self):
        draw = random.Random(2)
        sites = [(i, j, k) for i in range(6) for j in range(6) for k in range(6)]
        draw.shuffle(sites)
        self.grains = [Sphere(tuple(s + 0.5 for s in site), diameter=0.5) for site in sites]
        write_sphere_data(self.path("grains"), ((0, 6),) * 3, self.grains)
        self.as_read = list(range(1, len(sites) + 1))

    def orders(self, before, between="", after=""):
        """IDs as they follow each other in memory: after two runs of ours and one without the pair style."""
        script = START.format(before=before)
        for name, then in zip(NAMES, (between, after + "\n" + OTHER_STYLE, "")):
            script += RUN.format(name=name) + then + "\n"
        self.run_lammps(script)
        found = []
        for name in NAMES:
            with open(self.path(name)) as file:
                lines = [line.strip() for line in file]
            found.append([int(line) for line in lines[lines.index("ITEM: ATOMS id") + 1:]])
            self.assertEqual(sorted(found[-1]), self.as_read)
        return found

    def test_before(self):
        self.assertEqual(self.orders(UNSORTED), [self.as_read] * 3)
        first, second, host = self.orders(SORTED)
        self.assertNotEqual(first, self.as_read)
        self.assertEqual(second, first)
        self.assertNotEqual(host, second)

    def test_default(self):
        """Without a word the host sorts every 1000 steps, and so do we."""
        first, second, host = self.orders("")
        self.assertNotEqual(first, self.as_read)
        self.assertEqual(second, first)
        self.assertNotEqual(host, second)

    def test_off_between_runs(self):
        first, second, host = self.orders(SORTED, between=UNSORTED)
        self.assertNotEqual(first, self.as_read)
        self.assertEqual((second, host), (first, first))

    def test_on_between_runs(self):
        first, second, host = self.orders(UNSORTED, between=SORTED)
        self.assertEqual(first, self.as_read)
        self.assertNotEqual(second, first)
        self.assertEqual(second, self.orders(SORTED)[0])    # the canonical order
        self.assertNotEqual(host, second)

    def test_off_after_runs(self):
        first, second, host = self.orders(SORTED, after=UNSORTED)
        self.assertNotEqual(first, self.as_read)
        self.assertEqual(host, second)

    def test_on_after_runs(self):
        first, second, host = self.orders(UNSORTED, after=SORTED)
        self.assertEqual((first, second), (self.as_read, self.as_read))
        self.assertNotEqual(host, self.as_read)


if __name__ == "__main__":
    unittest.main()
