# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=50 timeout=300
"""The scenes with large bodies, small: rotating drum, plate penetration, wave tank, hopper, and the wheel that a Python
program drives."""

import glob
import os
import re
import shutil
import sys
import unittest

from coupled_case import SOURCE, host_environment
from talus_testing import SceneCase, run_program


class Scenes(SceneCase):

    def setUp(self):
        shutil.copytree(os.path.join(SOURCE, "input"), self.path("input"))

    def simulate(self, name, np=2, way="in the records", **variables):
        """{words: number} of the lines behind the title of the summary."""
        script = self.read(f"input/in.{name}")
        log = self.run_lammps(script, np=np, cwd=self.path("input"), variables={"out": self.dir, **variables}).log
        lines = re.findall(r"^([a-zA-Z /-]+?) {2,}(-?[\d.]\S*)", log.rsplit("\n--- ", 1)[1], re.MULTILINE)
        self.assertEqual(re.findall("WARNING.*", log), [])
        ways = set(re.findall(r"steps without output +(.*)", log))
        self.assertEqual({one[:len(way)] for one in ways}, {way})
        found = {words: float(number) for words, number in lines}
        print(name, found)
        pictures = glob.glob(self.path(f"{name}.*.png"))
        self.assertTrue(pictures)
        for picture in pictures:
            with open(picture, "rb") as file:
                self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
        return found

    def table(self, name):
        with open(self.path(name)) as file:
            return [list(map(float, line.split())) for line in file if line[0] != "#"]

    def test_drum(self):
        found = self.simulate("drum", np=1, radius=9, period=0.6, time=0.4)
        self.assertGreater(found["lean of the bed"], 8.0)
        self.assertLess(found["lean of the bed"], 45.0)
        self.assertAlmostEqual(found["torque on the drum / lever of the bed"], 1.0, delta=0.2)

    def test_penetration(self):
        self.simulate("penetration", np=1, width=8, settle=0.15, speed=0.4, kn=2e7)
        force = self.table("force.txt")
        quarter = len(force) // 4
        means = [sum(row[1] for row in force[k * quarter:(k + 1) * quarter]) / quarter for k in range(4)]
        print("force in the quarters of the way:", means)
        self.assertLess(abs(means[0]), means[2])
        self.assertLess(means[1], means[3])
        self.assertGreater(means[3], 0.02)

    def test_wavetank(self):
        found = self.simulate("wavetank", np=1, x=10, z=8, end=1.0, settle=0.2)
        self.assertAlmostEqual(found["force on the tank / weight"], 1.0, delta=0.3)
        slosh = [row[1] for row in self.table("slosh.txt")]
        self.assertGreater(max(slosh) - min(slosh), 0.01)

    def test_hopper(self):
        found = self.simulate("hopper", np=1, radius=7, settle=0.05, time=0.1)
        self.assertGreater(found["mass discharged / mass"], 0.03)
        mass = [row[1] for row in self.table("discharge.txt")]
        self.assertEqual(mass, sorted(mass))
        self.assertEqual(mass[0], 0.0)

    def test_dice(self):
        found = self.simulate("dice", np=1, n=3, layers=3, time=1.5)
        self.assertAlmostEqual(found["force on the floor / weight"], 1.0, delta=0.05)
        self.assertLess(found["kinetic energy / weight / edge"], 1e-3)

    def test_gravel(self):
        found = self.simulate("gravel", np=1, radius=4.5, settle=0.25, time=0.15)
        self.assertAlmostEqual(found["weight on hopper and gate / weight"], 1.0, delta=0.3)
        self.assertGreater(found["mass discharged / mass"], 0.05)
        mass = [row[1] for row in self.table("discharge.txt")]
        self.assertEqual(mass, sorted(mass))
        self.assertEqual(mass[0], 0.0)

    def test_crushing(self):
        found = self.simulate("crushing", np=2, radius=3, strength=4e5, time=4e-4)
        self.assertGreater(found["fragments"], 3)
        self.assertLess(found["grains of the largest one"], found["grains"])
        self.assertGreater(found["broken bonds"], 20)
        self.assertGreater(found["energy of breaking / at impact"], 0.0)
        self.assertLess(found["energy of breaking / at impact"], 0.5)
        rows = self.table("fragments.txt")
        self.assertEqual(rows[0][1], 1)
        self.assertGreater(rows[-1][3], 20)
        self.assertLessEqual(rows[-1][3], found["broken bonds"])

    def test_lentils(self):
        found = self.simulate("lentils", np=2, radius=5, settle=0.2, time=0.12)
        self.assertAlmostEqual(found["weight on hoppers and gate / weight"], 1.0, delta=0.3)
        self.assertGreater(found["mass of lentils discharged / mass"], 0.05)
        self.assertGreater(found["mass of spheres discharged / mass"], 0.05)
        for column in 1, 2:
            mass = [row[column] for row in self.table("discharge.txt")]
            self.assertEqual(mass, sorted(mass))

    def test_wheel(self):
        rows = []
        for np in (1, 2):
            done = run_program(sys.executable, np, [os.path.join(SOURCE, "examples/cosim/wheel.py"), "--quick", "--out", self.dir],
                               env=host_environment(), timeout=240)
            rows.append(self.read("wheel.csv"))
        print(done.output.strip())
        self.assertEqual(rows[0], rows[1], "the same bits on 1 and 2 ranks")
        with open(self.path("log.wheel")) as log:
            self.assertLess(len(log.read()), 20000)
        numbers = [list(map(float, line.split(","))) for line in rows[0].splitlines()[1:]]
        last = numbers[len(numbers) // 2:]
        sinkage, lift, torque = (sum(row[k] for row in last) / len(last) for k in (3, 5, 6))
        self.assertGreater(sinkage, 0.0)
        self.assertLess(sinkage, 0.015)
        self.assertAlmostEqual(lift, 0.4, delta=0.15)    # carries its load
        self.assertGreater(torque, 0.0, "slip takes torque")
        self.assertIn("drawbar pull", self.read("wheel.svg"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
