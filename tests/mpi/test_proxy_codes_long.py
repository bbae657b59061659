# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: label=slow timeout=1800
"""The encoded values of test_proxy_codes.py on 27 ranks and on numbers that make odd grids."""

import unittest

import test_proxy_codes

test_proxy_codes.RANKS = 3, 6, 12, 27


class ManyRanks(test_proxy_codes.ProxyCodes):
    pass


if __name__ == "__main__":
    unittest.main()
