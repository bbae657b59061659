# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: label=slow timeout=3600
"""test_mutations.py with other seeds and many times as many runs. TALUS_SEED chooses another one."""

import os
import unittest

import test_mutations


class ManyMutations(test_mutations.Mutations):
    seed, lines, files = int(os.environ.get("TALUS_SEED", "7")), 1500, 400


del test_mutations.Mutations


if __name__ == "__main__":
    unittest.main()
