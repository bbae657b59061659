# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=45 timeout=300
"""The rover of examples/cosim with coarse grains: its wheels carry its weight, slip rises with the slope, the exchange takes
little; the same bits on 1 and 2 ranks. A vehicle that cannot be had, or goes wrong, ends in one message on all ranks."""

import csv
import os
import re
import sys
import unittest

from coupled_case import SOURCE, CoupledCase

ROVER = os.path.join(SOURCE, "examples", "cosim", "rover.py")

# what the example does, with a model of its own and a bed that need not be settled
DRIVE = """
import os, sys
sys.path[:0] = [os.path.dirname({rover!r}), os.path.join(os.path.dirname({rover!r}), "rover")]
import rover
rover.MODEL = sys.argv.pop(1)
sys.argv += ["--quick", "--out", "."]
settled = rover.lammps.file
def file(lmp, path):
    with open(path) as script:
        lmp.commands_string(script.read().replace("settle  index 0.15", "settle  index 0.001"))
rover.lammps.file = file
rover.main()
"""
# the beginning of the example
BEGIN = """
import os, sys
sys.path[:0] = [os.path.dirname({rover!r}), os.path.join(os.path.dirname({rover!r}), "rover")]
import rover
rover.Drive.LONGEST = 0.5
sys.argv += ["--quick", "--out", "two"]
rover.main()
"""


class RoverTest(CoupledCase):

    def rows(self, folder):
        with open(os.path.join(self.path(folder), "rover.csv")) as file:
            return file.read()

    def refusal(self, model, np, **env):
        """What is said of a drive that ends with an error."""
        with self.assertRaises(AssertionError) as problem:
            self.drive(DRIVE.format(rover=ROVER), model, np=np, env=env)
        return str(problem.exception)

    def test_drive(self):
        said = self.launch([sys.executable, ROVER, "--quick", "--out", "one"], timeout=200)
        print(said)
        self.drive(BEGIN.format(rover=ROVER), np=2, timeout=200)
        text, begin = self.rows("one"), self.rows("two")
        self.assertGreater(begin.count("level"), 5)
        self.assertEqual(text[:len(begin)], begin, "the same bits on 1 and 2 ranks")

        carried = float(re.search(r"the wheels carry .* N, ([\d.]+) of the weight", said).group(1))
        self.assertAlmostEqual(carried, 1.0, delta=0.01)
        slips = [float(slip) for slip in re.findall(r"Result: (?:level|foot|slope): slip ([-\d.]+) %", said)]
        self.assertEqual(len(slips), 3)
        self.assertEqual(slips, sorted(slips), "slip rises with the slope")
        self.assertGreater(slips[2], slips[0] + 5.0)
        self.assertLess(slips[2], 80.0, "it climbs")
        self.assertRegex(said, r"exchanges [\d.]+ s: [\d.]+ %")

        rows = list(csv.DictReader(text.splitlines()))
        wheels = [name[5:] for name in rows[0] if name.startswith("load_")]
        self.assertEqual(len(wheels), 6)
        driving = [row for row in rows if row["phase"] != "start"]
        for wheel in wheels:
            load = sum(float(row["load_" + wheel]) for row in driving) / len(driving)
            sinkage = sum(float(row["sinkage_" + wheel]) for row in driving) / len(driving)
            self.assertGreater(load, 5.0, wheel)
            self.assertLess(load, 35.0, wheel)
            self.assertGreater(sinkage, 0.0, wheel)
            self.assertLess(sinkage, 0.02, wheel)
        for k in ("left", "right"):    # a bed that is as wide on both sides
            self.assertAlmostEqual(sum(float(row[f"load_{place}_{k}"]) for row in driving for place in ("front", "middle", "rear")),
                                   0.5 * carried * 104 * len(driving), delta=0.1 * 104 * len(driving))
        with open(os.path.join(self.path("one"), "rover.svg")) as file:
            self.assertIn("load of a wheel", file.read())
        self.assertEqual(len([name for name in os.listdir(self.path("one")) if name.endswith(".png")]), 1)

    def test_no_vehicle(self):
        self.assertIn("is MuJoCo there (Debian: libmujoco-dev)?", self.refusal("none.xml", 1, CXX="false"))
        said = self.refusal("none.xml", 2)
        self.assertIn("none.xml", said)
        self.assertIn("the partner on rank 0 has failed: RuntimeError", said)

    def test_a_vehicle_that_goes_wrong(self):
        with open(os.path.join(os.path.dirname(ROVER), "rover", "rover.xml")) as file:
            model = file.read()
        # a servo that overreacts in every step, the more the faster the wheels turn
        self.write("wild.xml", model.replace('kv="2" forcerange="-3 3"', 'kv="2e6"'))
        said = self.refusal("wild.xml", 2)
        self.assertIn("MuJoCo: Nan, Inf or huge value in Q", said)
        self.assertIn("the partner on rank 0 has failed: RuntimeError: MuJoCo", said)


if __name__ == "__main__":
    unittest.main(verbosity=2)
