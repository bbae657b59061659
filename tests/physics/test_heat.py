# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Large bodies with a temperature: ten spheres between two of them, against resistances in a row."""

import math
import unittest

from body_meshes import write_stl
from heat_row import CAPACITY, CONDUCTIVITY, LAW, LENGTH, MASS, HeatRowCase


class Heat(HeatRowCase):

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

    def test_softened_moduli(self):
        """A plane and a mesh: all circles are smaller in the same ratio, and so is the flow."""
        ratio = ((1e6 / (1 - 0.3**2)) / (7e10 / (1 - 0.22**2)))**(1 / 3)
        law = f"{LAW} modulus 7e10 0.22"
        write_stl(self.path("wall.stl"), [((LENGTH, 0, 0), (LENGTH, 0, 0.04), (LENGTH, 0.04, 0)),
                                          ((LENGTH, 0.04, 0), (LENGTH, 0, 0.04), (LENGTH, 0.04, 0.04))])
        walls = (f"fix lo all large/body plane 0 0 0 1 0 0 contact {law} temperature 50\n"
                 f"fix hi all large/body mesh wall.stl two-sided contact {law} temperature 10\ntimestep {0.01 / ratio}\n")
        frames, rows = self.heat(walls, pair=f"pair_style gran/penalty\npair_coeff * * {law}")
        flow, expected = self.steady(50.0, 10.0)
        self.assertAlmostEqual(rows[-1]["f_hi[21]"] / (ratio * flow), 1, delta=1e-8)
        for found, value in zip(frames[-1], expected, strict=True):
            self.assertAlmostEqual(found, value, delta=1e-7)


if __name__ == "__main__":
    unittest.main()
