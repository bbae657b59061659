# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=3600 label=slow
"""As test_inputs.py, with longer runs."""

import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "lib"))
from input_comparison import tests_of

Inputs = tests_of("long")

if __name__ == "__main__":
    unittest.main()
