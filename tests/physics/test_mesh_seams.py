# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""Flat meshes with seams: what corners differ by, and where triangles are cut, is not felt by a sphere."""

import unittest

from body_meshes import write_stl
from talus_testing import SceneCase, thermo

BEGIN = """
units lj
atom_style sphere
atom_modify map yes
boundary f f f
region box block -3 25 -5 5 -3 8
create_box 1 box
create_atoms 1 single {x} {y} {z}
set group all diameter 1.0 density 1.0
comm_modify vel yes
pair_style gran/penalty
pair_coeff * * {law}
fix w all large/body {body} contact {law}
variable x equal x[1]
variable z equal z[1]
variable vx equal vx[1]
variable fz equal fz[1]
thermo_style custom step v_x v_z v_vx v_fz f_w[20]
thermo_modify norm no format float %.12g
"""
ROLL = """
velocity all set 1 0 0
set group all omega 0 2.0 0
fix step all nve/sphere/symplectic gravity {g} vector 0 0 -1
timestep 0.0005
thermo 1000
run 12000
"""
ROUGH = "hooke 1e3 5 tangential multistep NULL NULL 0.6"
SMOOTH = "hooke 1e4 0"


def rectangle(x0, x1, y0, y1, z=0.0):
    return [((x0, y0, z), (x1, y0, z), (x1, y1, z)), ((x0, y0, z), (x1, y1, z), (x0, y1, z))]


def gap(width):
    return rectangle(-2, -0.5 * width, -2, 2) + rectangle(0.5 * width, 2, -2, 2)


def tee():
    """One large triangle on the left of the seam, two on the right."""
    return rectangle(-2, 0, -2, 2) + [((0, -2, 0), (2, -2, 0), (0, 0.1, 0)), ((2, -2, 0), (2, 2, 0), (0, 0.1, 0)),
                                      ((2, 2, 0), (0, 2, 0), (0, 0.1, 0))]


def strips():
    """Each strip along x is cut at other places than its neighbors."""
    triangles = []
    for j in range(-4, 4):
        cuts = [-3.0, *(k + 0.13 * (j % 5) for k in range(-2, 24)), 25.0]
        for a, b in zip(cuts, cuts[1:]):
            triangles += rectangle(a, b, j, j + 1)
    return triangles


class MeshSeams(SceneCase):

    def press(self, triangles, x, y, words=""):
        write_stl(self.path("mesh.stl"), triangles)
        return self.run_lammps(BEGIN.format(x=x, y=y, z=0.49, law=SMOOTH, body="mesh mesh.stl " + words) +
                               "fix step all nve/sphere\nrun 0\n").log

    def test_force_on_a_seam(self):
        for name, mesh in ("gap", gap(2e-6)), ("rounding", gap(1e-15)), ("tee", tee()):
            for x in -0.03, -1e-4, 0.0, 1e-7, 0.02:
                for y in 0.0, 0.1, 0.13:
                    with self.subTest(mesh=name, x=x, y=y):
                        row = thermo(self.press(mesh, x, y))[0]
                        self.assert_close(row["v_fz"], 100.0, 1e-5)
                        self.assertEqual(row["f_w[20]"], 1)

    def test_log(self):
        self.assertRegex(self.press(gap(2e-6), 0, 0), r"2 corners joined that are up to 2e-06 apart")
        self.assertRegex(self.press(tee(), 0, 0), r"triangles divided at 1 edges on which corners of others lie \(first: triangle 1\)")

    def test_tolerance(self):
        apart = self.press(gap(2e-3), 0, 0)
        self.assertGreater(thermo(apart)[0]["v_fz"], 150)
        self.assertNotIn("joined", apart)
        joined = self.press(gap(2e-3), 0, 0, "tolerance 0.003 two-sided")
        self.assert_close(thermo(joined)[0]["v_fz"], 100.0, 1e-4)
        self.assertIn("corners joined", joined)
        self.assertNotIn("joined", self.press(gap(1e-9), 0, 0, "tolerance 0"))

    def test_bad_tolerance(self):
        write_stl(self.path("mesh.stl"), tee())
        for word in "-1", "wide", "":
            log = self.run_lammps(BEGIN.format(x=0, y=0, z=0.49, law=SMOOTH, body="mesh mesh.stl tolerance " + word),
                                  expect_error=True).log
            self.assertRegex(log, r"fix large/body: expected tolerance d|fix large/body.*tolerance d")

    def test_a_ball_rolls_over_strips(self):
        write_stl(self.path("strips.stl"), strips())
        ways = []
        for body in "plane 0 0 0 0 0 1", "mesh strips.stl":
            log = self.run_lammps(BEGIN.format(x=0.3, y=0.3, z=0.495, law=ROUGH, body=body) +
                                  ROLL.format(g=5 / 0.5235987755982988)).log
            ways.append(thermo(log))
        plane, mesh = ways
        self.assertGreater(plane[-1]["v_x"], 6)
        for a, b in zip(plane, mesh, strict=True):
            for column in "v_x", "v_z", "v_vx":
                self.assertAlmostEqual(a[column], b[column], delta=1e-9)


if __name__ == "__main__":
    unittest.main()
