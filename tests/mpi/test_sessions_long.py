# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: label=slow timeout=3600
"""test_sessions.py with other cases and thirty times as many. TALUS_ROUND chooses others."""

import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import test_sessions


class ManySessions(test_sessions.Sessions):
    first, count = int(os.environ.get("TALUS_ROUND", "1000")), 10000


del test_sessions.Sessions


if __name__ == "__main__":
    unittest.main()
