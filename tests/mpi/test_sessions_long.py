# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: label=slow timeout=3600
"""test_sessions.py with other cases and thirty times as many. TALUS_ROUND chooses others."""

import os
import unittest

import test_sessions


class ManySessions(test_sessions.Sessions):
    first, count = int(os.environ.get("TALUS_ROUND", "1000")), 10000


del test_sessions.Sessions


if __name__ == "__main__":
    unittest.main()
