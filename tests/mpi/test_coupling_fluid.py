# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300 cost=20
"""examples/cosim/fluid.py, small: terminal velocities of grains in water, the pressure drop of a packed bed and of one that
the water carries."""

import csv
import os
import re
import sys
import unittest
import xml.etree.ElementTree

from coupled_case import SOURCE, CoupledCase


class Fluid(CoupledCase):

    def test_fluid(self):
        said = self.launch([sys.executable, os.path.join(SOURCE, "examples/cosim/fluid.py"), "--quick", "--out", self.dir])

        def percent(line):
            return float(re.search(rf"Result: {line}: (\S+) %", said).group(1))

        self.assertLess(percent(r"terminal velocities of .*"), 1.0)
        self.assertLess(percent("pressure gradient of the packed bed"), 3.0)
        self.assertLess(percent("pressure drop of the fluidised bed"), 3.0)
        with open(self.path("fluid.csv")) as file:
            rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
        drops = [row["drop_over_weight"] for row in rows]
        self.assertEqual(drops, sorted(drops))
        at_umf = next(row for row in rows if row["velocity_over_umf"] == 1.0)
        self.assertGreater(at_umf["drop_over_weight"], 0.9)
        self.assertLess(rows[0]["porosity"] + 0.01, rows[-1]["porosity"])    # the bed grows
        plot = xml.etree.ElementTree.parse(self.path("fluid.svg"))
        self.assertEqual(len(plot.findall(".//{http://www.w3.org/2000/svg}circle")), len(rows) + 5)


if __name__ == "__main__":
    unittest.main()
