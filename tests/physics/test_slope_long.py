# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: label=slow timeout=1800
"""What rests on a slope in test_slope.py, for a million steps."""

import unittest

import test_slope


class RestsForLong(test_slope.Rests):

    STEPS = 1000000


if __name__ == "__main__":
    unittest.main()
