# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=600 cost=40
"""examples/cosim/belt.py, small: a belt that finite elements bend under the grains that it carries, against a clamped beam under
the load that it has borne. Left out where /usr/bin/python3 has no GetFEM (tests/CMakeLists.txt)."""

import os
import re
import unittest
import xml.etree.ElementTree

from coupled_case import SOURCE, CoupledCase

PYTHON = "/usr/bin/python3"    # of Debian, whose packages these are


class Belt(CoupledCase):

    def test_belt(self):
        said = self.launch([PYTHON, os.path.join(SOURCE, "examples/cosim/belt.py"), "--quick", "--out", self.dir], np=2, timeout=400)

        def number(line):
            return float(re.search(rf"Result: .*{line}", said).group(1))

        self.assertLess(number(r"measured load \S+ mm: (\S+) % apart"), 2.0)
        self.assertLess(abs(number(r"the belt bears (\S+) of the weight") - 1.0), 0.01)
        self.assertGreater(number(r"carried at (\S+) m/s"), 0.39)
        self.assertGreater(number(r"mean sag (\S+) mm"), 1.0)
        self.assertEqual(xml.etree.ElementTree.parse(self.path("belt.svg")).getroot().tag, "{http://www.w3.org/2000/svg}svg")


if __name__ == "__main__":
    unittest.main()
