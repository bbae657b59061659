# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=200 stay
"""Heat from a fluid to grains, talus.h: laws of Gunn and of Ranz and Marshall against their formulas, on one and two ranks; the
grains' temperatures after steps; a closed box, whose heat stays; errors."""

import json
import math
import unittest

from coupled_case import CoupledCase
from talus_testing import head

EDGE, D, DENSITY, CAPACITY = 2.0, 0.5, 3.0, 7.0
FLUID, VISCOSITY, CONDUCTIVITY, OF_FLUID = 1.3, 0.02, 0.4, 11.0
WIND, WARM, DT, STEPS = (0.3, -0.2, 0.9), (5.0, 4.0, 6.5, 2.0), 1e-3, 20

# cell k has k + 1 grains, and the last one none that are in the fluid
SCENE = head(map=None, boundary="p p p") + f"""
{{property}}
region box block 0 {4 * EDGE} 0 {EDGE} 0 {EDGE}
create_box 1 box
""" + "\n".join(f"create_atoms 1 single {EDGE * cell + 0.6 + 0.7 * (n % 2)} {0.6 + 0.7 * (n // 2)} 1.0" for cell in range(3)
                for n in range(cell + 1)) + f"""
set group all diameter {D} density {DENSITY}
{{warm}}
neighbor 0.1 bin
pair_style gran/penalty
pair_coeff * * hooke 1e3 0
timestep {DT}
fix step all nve/sphere/symplectic
thermo 0
"""
MEAN = """
compute t all property/atom temperature
compute warmth all reduce ave c_t
"""
WITH_HEAT = SCENE.format(property="fix prop all property/atom temperature heatflow ghost yes",
                         warm=f"set group all temperature 1.5\nfix warm all heat/flow constant {CAPACITY}") + MEAN

DRIVER = """
import json
from lammps import lammps
from talus import Partner, TalusError
lmp = lammps(cmdargs=["-log", "log.driver", "-screen", "none"])
lmp.commands_string(SCENE)

def say(result):
    if lmp.extract_setting("world_rank") == 0:
        with open("said", "w") as file:
            json.dump(result, file)
"""

LAWS = """
result = {}
with Partner(lmp) as partner:
    fluid = partner.fluid_grid((0, 0, 0), (4 * EDGE, EDGE, EDGE), (4, 1, 1))
    fluid.drag_law("stokes", FLUID, VISCOSITY)
    for law in ("gunn", "ranz/marshall"):
        power = [float(p) for p in fluid.put_heat(law, [WIND] * 4, WARM, CONDUCTIVITY, OF_FLUID)[0][0]]
        partner.advance(STEPS)
        lmp.command("run 0 post no")
        result[law] = [power, lmp.extract_compute("warmth", 0, 0)]
say(result)
lmp.close()
lmp.finalize()
"""

CLOSED = """
with Partner(lmp) as partner:
    fluid = partner.fluid_grid((0, 0, 0), (4 * EDGE, EDGE, EDGE), (1, 1, 1))
    fluid.drag_law("stokes", FLUID, VISCOSITY)
    solid = float(fluid.grains("solid")[0][0][0])
    warm, volume = 5.0, 4 * EDGE ** 3
    of_fluid = FLUID * OF_FLUID * (1 - solid) * volume
    for _ in range(50):
        power = float(fluid.put_heat("gunn", [WIND], [warm], CONDUCTIVITY, OF_FLUID)[0][0][0])
        partner.advance(STEPS)
        warm -= power * volume * STEPS * DT / of_fluid
    lmp.command("run 0 post no")
    say([of_fluid, warm, lmp.extract_compute("warmth", 0, 0)])
lmp.close()
lmp.finalize()
"""

REFUSED = """
with Partner(lmp) as partner:
    fluid = partner.fluid_grid((0, 0, 0), (4 * EDGE, EDGE, EDGE), (1, 1, 1))
    said = []
    def refused(*words):
        try:
            fluid.put_heat(*words)
        except TalusError as error:
            said.append(str(error))
    refused("gunn", [WIND], [1.0], 1.0, 1.0)
    fluid.drag_law("stokes", FLUID, VISCOSITY)
    refused("nusselt", [WIND], [1.0], 1.0, 1.0)
    refused("gunn", [WIND], [1.0], 0.0, 1.0)
    refused("gunn", [WIND], [1.0], 1.0, -2.0)
    refused("gunn", [WIND], [float("nan")], 1.0, 1.0)
    say(said)
lmp.close()
lmp.finalize()
"""


def nusselt(law, porosity):
    re, root = FLUID * math.sqrt(sum(u * u for u in WIND)) * D / VISCOSITY, (OF_FLUID * VISCOSITY / CONDUCTIVITY) ** (1 / 3)
    if law == "ranz/marshall":
        return 2 + 0.6 * re ** 0.5 * root
    re *= porosity
    e = porosity
    return (7 - 10 * e + 5 * e * e) * (1 + 0.7 * re ** 0.2 * root) + (1.33 - 2.4 * e + 1.2 * e * e) * re ** 0.7 * root


class FluidHeat(CoupledCase):

    def said(self, program, np=1, scene=WITH_HEAT):
        values = {"SCENE": scene, "EDGE": EDGE, "FLUID": FLUID, "VISCOSITY": VISCOSITY, "CONDUCTIVITY": CONDUCTIVITY, "OF_FLUID": OF_FLUID,
                  "WIND": WIND, "WARM": WARM, "DT": DT, "STEPS": STEPS}
        self.drive("".join(f"{name} = {value!r}\n" for name, value in values.items()) + DRIVER + program, np=np)
        return json.loads(self.read("said"))

    def test_laws(self):
        grain = math.pi / 6 * D ** 3
        for np in (1, 2):
            result = self.said(LAWS, np)
            mean, each = 1.5, {k: 1.5 for k in range(3)}
            for law in ("gunn", "ranz/marshall"):
                power, warmth = result[law]
                for cell in range(3):
                    count = cell + 1
                    expected = nusselt(law, 1 - count * grain / EDGE ** 3) * math.pi * D * CONDUCTIVITY * (WARM[cell] - each[cell])
                    self.assertAlmostEqual(power[cell] / (count * expected / EDGE ** 3), 1.0, delta=1e-12, msg=f"{law} {cell} {np}")
                    each[cell] += expected * STEPS * DT / (DENSITY * grain * CAPACITY)
                self.assertEqual(power[3], 0.0)
                mean = sum((cell + 1) * each[cell] for cell in range(3)) / 6
                self.assertAlmostEqual(warmth / mean, 1.0, delta=1e-12, msg=f"{law} {np}")

    def test_closed_box(self):
        of_fluid, warm, grains = self.said(CLOSED)
        of_grains = 6 * DENSITY * math.pi / 6 * D ** 3 * CAPACITY
        self.assertLess(abs(warm - grains), 0.2 * 3.5)
        self.assertAlmostEqual((of_fluid * warm + of_grains * grains) / (of_fluid * 5.0 + of_grains * 1.5), 1.0, delta=1e-12)

    def test_errors(self):
        said = self.said(REFUSED, 2)
        self.assertEqual(said, [f"talus_put_fluid_heat: {text}" for text in (
            "there is no law of drag: call talus_set_drag_law() before",
            "law: unknown law of heat 'nusselt', expected ranz/marshall or gunn",
            "conductivity is 0, expected more than 0", "heat_capacity is -2, expected more than 0",
            "temperature is no finite number")])
        cold = SCENE.format(property="", warm="")
        said = self.said(REFUSED, scene=cold)
        self.assertIn("particles have no temperature: use 'fix property/atom temperature heatflow' and 'fix heat/flow'", said[-1])


if __name__ == "__main__":
    unittest.main()
