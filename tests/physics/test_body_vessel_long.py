# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=3000 label=slow
"""test_body_vessel.py with 20 000 particles, shaken for 20 000 steps: 70 jerks upwards. Then it rests as long as the bed
needs to settle."""

import unittest

import test_body_vessel


class LongVessel(test_body_vessel.Vessel):
    GRAINS, SHAKEN, REST = (28, 28, 26), 20000, 14000
    RANKS = 2


del test_body_vessel

if __name__ == "__main__":
    unittest.main(verbosity=2)
