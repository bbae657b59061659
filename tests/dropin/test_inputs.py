# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=60 timeout=600
"""The input scripts for grains that LAMMPS comes with, by plain LAMMPS and with -sf talus, on 1 and 2 ranks: same
numbers, and the log says what is accelerated. Runs are shortened, and a dump is added; nothing else is edited."""

import unittest

from input_comparison import tests_of

Inputs = tests_of("short")

if __name__ == "__main__":
    unittest.main()
