# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=3600 label=slow
"""As test_inputs.py, with longer runs."""

import unittest

from input_comparison import tests_of

Inputs = tests_of("long")

if __name__ == "__main__":
    unittest.main()
