# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: label=slow timeout=1800
"""The sessions of test_proxy_life_cycle.py, many times over: what depends on timing has its chance."""

import unittest

import test_proxy_life_cycle

REPETITIONS = 20


class AgainAndAgain(test_proxy_life_cycle.Session):

    def test_one_rank(self):
        for _ in range(REPETITIONS):
            self.check(test_proxy_life_cycle.PIECES, 1)

    def test_four_ranks(self):
        for _ in range(REPETITIONS):
            self.check(test_proxy_life_cycle.PIECES, 4)


if __name__ == "__main__":
    unittest.main()
