# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: label=slow timeout=3600
"""test_restart_damage.py with many times as many bits."""

import unittest

import test_restart_damage


class ManyBits(test_restart_damage.Damage):
    bits_of_part, rows = 60, 3


del test_restart_damage.Damage


if __name__ == "__main__":
    unittest.main()
