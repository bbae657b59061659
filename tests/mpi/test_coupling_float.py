# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=200
"""examples/cosim/float.py: a light raft on a bed. Explicit exchange diverges below a mass ratio, fixed point iteration converges to
the raft that Talus moves itself; their order in the window; the same on 1 and 2 ranks."""

import os
import re
import sys
import unittest

from coupled_case import SOURCE, CoupledCase


class Float(CoupledCase):

    def run_float(self, np=1):
        """{mass ratio: (error of explicit, of implicit exchange, iterations)}, {window: (the same)}."""
        said = self.launch([sys.executable, os.path.join(SOURCE, "examples", "cosim", "float.py"), "--quick", "--out", self.dir], np)
        print(said)
        self.assertRegex(said, r"Result: with windows of 40 steps the exchange, snapshots included, took [\d.]+ % of the run time")
        self.assertNotIn("not converged", said)
        with open(self.path("float.csv")) as file:
            rows = [list(map(float, line.split(","))) for line in list(file)[1:]]
        self.assertFalse(os.path.exists(self.path("float.bed")))
        self.said = re.sub("took .*", "", said)
        return {row[0]: row[2:] for row in rows[:5]}, {int(row[1]): row[2:] for row in rows[5:]}

    def test_raft(self):
        cases, windows = self.run_float()
        one = self.said
        self.assertGreater(cases[0.25][0], 1.0, "it is thrown off")
        self.assertGreater(cases[1][0], 0.5)
        self.assertLess(cases[64][0], 0.05, "explicit exchange will do for a heavy raft")
        for ratio, (explicit, implicit, iterations) in cases.items():
            self.assertLess(implicit, 0.05 * explicit, ratio)
            self.assertLess(implicit, 1e-3 if ratio >= 16 else 0.03, ratio)
            self.assertLess(iterations, 4.0)
        # of first order; of second order, down to what both integrators differ by
        self.assertAlmostEqual(windows[20][0] / windows[5][0], 4.0, delta=1.5)
        self.assertGreater(windows[80][1] / windows[20][1], 6.0)
        self.assertLess(windows[5][1], 2e-4)
        picture = self.read("float.svg")
        self.assertGreater(picture.count("<circle"), 40)
        self.assertTrue(picture.endswith("</svg>\n"))
        self.run_float(np=2)
        self.assertEqual(self.said, one)


if __name__ == "__main__":
    unittest.main()
