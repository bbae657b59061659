# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=400 cost=20
"""examples/cosim/fluidized.py, small: pressure drop of a fixed bed and of a fluidized one, minimum fluidization velocity, air and
impulses that stay, the same on two ranks, files for ParaView; and the solver of its flow against exact answers."""

import csv
import glob
import os
import re
import unittest
import xml.etree.ElementTree

from coupled_case import SOURCE, CoupledCase

PYTHON = "/usr/bin/python3"    # Debian's packages belong to its own

SOLVER = """
import numpy, sys
sys.path.insert(0, SOURCE + "/examples/cosim")
from flow.averaged_flow import AveragedFlow
from flow.pressure import PressureEquation

random = numpy.random.default_rng(1)
x, y, z = (random.uniform(0.2, 1.0, shape) for shape in ((7, 5, 6), (7, 5, 6), (8, 5, 6)))
z[0] = 0.0
equation = PressureEquation(x, y, z)
p = random.normal(size=(7, 5, 6))
found = equation.solve(equation.product(p), numpy.zeros_like(p), relative=1e-13)
print("pressure", abs(found - p).max())

# any porosity: the flow through each layer is that through the floor, less what the change of porosity takes
flow = AveragedFlow((6, 5, 7), 0.1, 1.2, 1e-3)
drag = numpy.zeros((7, 5, 6, 3))
stored = came = 0.0
for step in range(20):
    solid = random.uniform(0.0, 0.5, (7, 5, 6))
    beta = random.uniform(0.0, 100.0, (7, 5, 6))
    old = flow.porosity
    flow.step(1e-3, solid, beta[..., None] * flow.velocity(), beta, 0.3)
    stored = stored or flow.volume()
    came += 1e-3 * (0.3 * 0.3 - flow.outflow())    # area 0.3
e, change = flow.porosity, (flow.porosity - old)[1:-1].mean(axis=(1, 2)) / 1e-3 * 0.1
through = (0.5 * (e + numpy.roll(e, -1, 0)) * flow.u[2])[:-1].mean(axis=(1, 2))
print("continuity", abs(numpy.diff(through)[:-1] + change[:-1]).max())
print("volume", abs(came - (flow.volume() - stored)) / stored)

# uniform porosity and coefficient: e dp/dz = -beta u
flow = AveragedFlow((4, 4, 8), 0.1, 1.2, 1e-3)
beta = numpy.full((8, 4, 4), 50.0)
for _ in range(200):
    flow.step(1e-3, numpy.full((8, 4, 4), 0.4), beta[..., None] * flow.velocity(), beta, 0.3)
print("drop", abs(flow.pressure_gradient()[2:6, ..., 2] / (-50.0 * (0.3 / 0.6) / 0.6) - 1.0).max())

# a uniform flow along x slows down by drag whose coefficient changes: what it has lost is what has been taken, but for what
# the last step took ahead
flow = AveragedFlow((4, 4, 6), 0.1, 1.2, 0.0)
flow.u[0][1:] = 1.0
taken, drag, beta = 0.0, numpy.zeros((6, 4, 4, 3)), numpy.zeros((6, 4, 4))
for _ in range(50):
    flow.step(1e-3, numpy.full((6, 4, 4), 0.4), drag, beta, 0.0)
    beta = numpy.full((6, 4, 4), random.uniform(0.0, 1500.0))
    drag = 0.1 * beta[..., None] * flow.velocity()
    taken += 1e-3 * drag[3, 0, 0, 0]
flow.step(1e-3, numpy.full((6, 4, 4), 0.4), drag, 0.0 * beta, 0.0)
print("momentum", abs(1.2 * 0.6 * (1.0 - flow.u[0][3]) - taken).max())

# a wave along x, far from the floor: exp(-mu k^2 t/rho), with the k of the differences
flow = AveragedFlow((32, 4, 20), 1.0 / 32, 1.0, 0.01)
wave = numpy.sin(2.0 * numpy.pi * numpy.arange(32) / 32)
flow.u[1][1:] = wave
still = numpy.zeros((20, 4, 32))
for _ in range(100):
    flow.step(1e-3, still, numpy.zeros((20, 4, 32, 3)), still, 0.0)
k2 = (2.0 - 2.0 * numpy.cos(2.0 * numpy.pi / 32)) * 32 ** 2
print("wave", abs(flow.u[1][18] / wave.max() - wave * (1.0 - 1e-3 * 0.01 * k2) ** 100).max())
"""


class Fluidized(CoupledCase):

    def test_solver(self):
        said = self.launch([PYTHON, self.write("solver.py", f"SOURCE = {SOURCE!r}\n{SOLVER}")])
        found = {word: float(value) for word, value in re.findall(r"^(\w+) (\S+)$", said, re.MULTILINE)}
        self.assertLess(found["pressure"], 1e-11)
        self.assertLess(found["continuity"], 1e-7)
        self.assertLess(found["volume"], 1e-9)
        self.assertLess(found["drop"], 1e-6)
        self.assertLess(found["momentum"], 1e-12)
        self.assertLess(found["wave"], 1e-3)

    def bed(self, *words, np=1):
        """What it says, and rows of fluidized.csv."""
        program = os.path.join(SOURCE, "examples/cosim/fluidized.py")
        said = self.launch([PYTHON, program, "--quick", "--out", self.dir, *words], np=np, timeout=190)
        with open(self.path("fluidized.csv")) as file:
            return said, [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]

    def test_bed(self):
        said, rows = self.bed()

        def number(pattern):
            return float(re.search("Result: .*" + pattern, said, re.MULTILINE).group(1))

        self.assertLess(number(r"in the fixed bed: (\S+) % from Ergun"), 1.0)
        self.assertLess(number(r"m/s: (\S+) % from Ergun"), 1.0)
        self.assertAlmostEqual(number(r", (\S+) times that of Wen and Yu"), 1.0, delta=0.15)
        self.assertLess(number(r"fluidized bed: (\S+) % from its weight"), 10.0)    # while it lifts once
        self.assertLess(number(r"but for (\S+) %"), 1.0)
        self.assertLess(number(r"that came (\S+) is astray"), 1e-8)
        self.assertLess(number(r"grain by grain, (\S+)$"), 1e-10)
        self.assertLess(rows[0]["height"] * 1.03, rows[-1]["height"])
        self.assertLess(rows[-1]["floor"], 0.2)
        for name in ("grains", "air"):
            series = xml.etree.ElementTree.parse(self.path(f"paraview/{name}.pvd"))
            self.assertGreater(len(series.findall(".//DataSet")), 5)
        plot = xml.etree.ElementTree.parse(self.path("fluidized.svg"))
        self.assertEqual(len(plot.findall(".//{http://www.w3.org/2000/svg}circle")), len(rows) + sum(row["velocity"] < 1 for row in rows))
        self.assertGreater(len(glob.glob(self.path("fluidized.*.png"))), 1)
        # grains of a fixed bed stay where they are, on any ranks; the last stage takes twice its time
        _, on_two = self.bed("--velocities", "0.5", "--time", "0.025", "0", np=2)
        for name in ("drop", "floor", "gradient", "voidage", "height"):
            self.assertAlmostEqual(on_two[0][name] / rows[0][name], 1.0, delta=1e-6, msg=name)


if __name__ == "__main__":
    unittest.main()
