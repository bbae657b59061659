# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Large bodies with a temperature: ten spheres between two of them, against resistances in a row."""

import math
import unittest

from body_meshes import write_stl
from talus_testing import SceneCase, Sphere, head, read_dump, thermo, write_sphere_data

COUNT, DIAMETER, OVERLAP = 10, 0.01, 1e-4
DENSITY, CONDUCTIVITY, CAPACITY = 2500.0, 3000.0, 300.0
MASS = DENSITY * math.pi / 6 * DIAMETER**3
LENGTH = COUNT * (DIAMETER - OVERLAP) - OVERLAP    # the walls are pressed in as much
BETWEEN = 2 * CONDUCTIVITY * math.sqrt(DIAMETER / 4 * OVERLAP)    # power over difference of temperature
AT_WALL = 2 * CONDUCTIVITY * math.sqrt(DIAMETER / 2 * OVERLAP)
LAW = f"hertz/material 1e6 0.9 0.3 heat radius {CONDUCTIVITY}"
SCENE = head("si", "f p p") + """
fix therm all property/atom temperature heatflow ghost yes
read_data spheres
pair_style gran/penalty
pair_coeff * * {law}
neighbor 0.001 bin
timestep 0.01
set group all temperature {start}
{more}
fix heat all heat/flow constant {capacity}
thermo_style custom step {columns}
thermo_modify format float %.17g
thermo {thermo}
compute t all property/atom temperature
dump grains all custom {every} grains id c_t
dump_modify grains sort id format float %.17g
run {steps}
"""
PLANES = """
fix lo all large/body plane 0 0 0 1 0 0 contact {law} {lo}
fix hi all large/body plane {length} 0 0 -1 0 0 contact {law} {hi}
"""


class Heat(SceneCase):

    def setUp(self):
        start = DIAMETER / 2 - OVERLAP
        spheres = [Sphere((start + k * (DIAMETER - OVERLAP), 0.02, 0.02), diameter=DIAMETER, density=DENSITY) for k in range(COUNT)]
        write_sphere_data(self.path("spheres"), ((-0.01, LENGTH + 0.01), (0, 0.04), (0, 0.04)), spheres)

    def heat(self, more="", start=0.0, columns="f_lo[21] f_hi[21]", steps=5000, every=5000, rows=5000, **options):
        """Temperatures by sphere in the dumps, and rows of thermo output."""
        log = self.run_lammps(SCENE.format(law=LAW, start=start, more=more, capacity=CAPACITY, columns=columns, steps=steps,
                                           every=every, thermo=rows), **options).log
        return [[row[1] for _, row in sorted(frame.atoms.items())] for frame in read_dump(self.path("grains"))], thermo(log)

    def planes(self, lo, hi):
        return PLANES.format(law=LAW, length=LENGTH, lo=lo, hi=hi)

    def steady(self, lo, hi):
        """Flow from lo to hi, and the temperatures."""
        flow = (lo - hi) / (2 / AT_WALL + (COUNT - 1) / BETWEEN)
        return flow, [lo - flow * (1 / AT_WALL + k / BETWEEN) for k in range(COUNT)]

    def test_two_halves_meet(self):
        halves = "group cold id <= 5\nset group all temperature 330\nset group cold temperature 270"
        walls = self.planes("", "").replace(f" heat radius {CONDUCTIVITY}", "")
        frames, _ = self.heat(f"{halves}\n{walls}", every=10, columns="ke")
        self.assertEqual(frames[0], [270.0] * 5 + [330.0] * 5)
        for frame in frames:
            self.assertAlmostEqual(math.fsum(frame), 3000.0, delta=1e-9)
        self.assertLess(max(abs(t - 300.0) for t in frames[-1]), 1e-8)
        self.assertGreater(max(abs(t - 300.0) for t in frames[10]), 10.0)

    def test_between_two_temperatures(self):
        flow, expected = self.steady(50.0, 10.0)
        first = None
        for np, threads in (1, 1), (2, 1), (1, 2), (4, 1):
            for style in "run_style verlet/stock\n", "":
                with self.subTest(ranks=np, threads=threads, style=style):
                    frames, rows = self.heat(self.planes("temperature 50", "temperature 10") + style, np=np,
                                             env={"OMP_NUM_THREADS": str(threads)})
                    for found, value in zip(frames[-1], expected, strict=True):
                        self.assertAlmostEqual(found, value, delta=1e-8)
                    self.assertAlmostEqual(rows[-1]["f_lo[21]"], -flow, delta=1e-8 * flow)
                    self.assertAlmostEqual(rows[-1]["f_hi[21]"], flow, delta=1e-8 * flow)
                    self.assertNotIn("the time step is", self.read("log.script"))    # nothing moves
                    first = first or frames
                    self.assertEqual(frames, first)

    def test_what_goes_in_stays_or_goes_out(self):
        """While one wall becomes warmer; from a mesh, whose triangles tell the same."""
        write_stl(self.path("wall.stl"), [((0, 0, 0), (0, 0.04, 0), (0, 0, 0.04)), ((0, 0.04, 0), (0, 0.04, 0.04), (0, 0, 0.04))])
        walls = f"""
variable warm equal 20+3*step*dt
fix lo all large/body mesh wall.stl two-sided contact {LAW} temperature v_warm pressure yes
fix hi all large/body plane {LENGTH} 0 0 -1 0 0 contact {LAW} temperature 10
"""
        for np in 1, 2:
            columns = "f_lo[21] f_hi[21] f_lo[1][4] f_lo[2][4]"
            frames, rows = self.heat(walls, start=10.0, columns=columns, steps=300, every=300, rows=1, np=np)
            into_walls = math.fsum(row["f_lo[21]"] + row["f_hi[21]"] for row in rows[1:])
            stored = MASS * CAPACITY * (math.fsum(frames[-1]) - math.fsum(frames[0]))
            self.assertGreater(stored, 10.0)
            self.assertAlmostEqual(-0.01 * into_walls, stored, delta=1e-11 * stored)
            area = 0.04 * 0.04 / 2
            for row in rows:
                self.assertAlmostEqual(area * (row["f_lo[1][4]"] + row["f_lo[2][4]"]), row["f_lo[21]"], delta=1e-9)


if __name__ == "__main__":
    unittest.main()
