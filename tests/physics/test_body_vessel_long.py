# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=20000 label=slow procs=2
"""test_body_vessel.py with 20 000 particles, shaken for 100 000 steps."""

import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import test_body_vessel


class LongVessel(test_body_vessel.Vessel):
    GRAINS, SHAKEN, REST = (28, 28, 26), 100000, 30000
    RANKS = 2


del test_body_vessel

if __name__ == "__main__":
    unittest.main(verbosity=2)
