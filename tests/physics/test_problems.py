# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=60 timeout=600
"""Small versions of problems with published answers: impacts, cases of MFIX-DEM, silo, column, shear, triaxial compression, heap,
grains in a fluid, bonded rock.
Those that take longer are in test_problems_long."""

import unittest

from small_problems import run_small


class Problems(unittest.TestCase):

    def test_impacts(self):
        run_small(self, "impacts")

    def test_mfix(self):
        run_small(self, "mfix")

    def test_silo(self):
        run_small(self, "silo")

    def test_collapse(self):
        run_small(self, "collapse")

    def test_shear(self):
        run_small(self, "shear")

    def test_triaxial(self):
        run_small(self, "triaxial")

    def test_repose(self):
        run_small(self, "repose")

    def test_fluid(self):
        run_small(self, "fluid")

    def test_rock(self):
        run_small(self, "rock")


if __name__ == "__main__":
    unittest.main()
