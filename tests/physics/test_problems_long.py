# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: label=slow timeout=1200
"""Small versions of the problems with published answers that take longer: drum, bin, incline, where a flow stops."""

import unittest

from small_problems import run_small


class Problems(unittest.TestCase):

    def test_drum(self):
        run_small(self, "drum")

    def test_discharge(self):
        run_small(self, "discharge")

    def test_chute(self):
        run_small(self, "chute")

    def test_stop(self):
        run_small(self, "stop")


if __name__ == "__main__":
    unittest.main()
