# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Belts, open pipes and cones, and what each triangle of a mesh bears: against closed forms and sums."""

import math
import unittest

import body_meshes
from talus_testing import SceneCase, Sphere, begin, read_dump, thermo, write_sphere_data
from vtk_files import Piece

SCENE = begin(read="read_data grains", law="hooke 1e4 0", skin=0.2, dt=0.001) + """
{step}
"""
BALL = "fix step all nve/sphere/symplectic gravity 10 vector 0 0 -1"
# without rotation: a grain that cannot roll
BLOCK = "fix step all nve\nfix weight all gravity 10 vector 0 0 -1"
MU, G, MASS, DT = 0.3, 10.0, math.pi / 6.0, 0.001
LAW = f"contact hooke 1e4 200 tangential multistep 5e3 0 {MU}"
OUTPUT = """
compute speed all reduce ave vx vy vz
variable v equal c_speed[1]
variable height equal c_speed[3]
thermo_style custom step v_v v_height f_body f_body[1] f_body[2] f_body[3] f_body[20]
thermo_modify format float %.15g
thermo 20
"""
# at rest on z = 0
RESTING = 0.5 - MASS * G / 1e4


class Surfaces(SceneCase):

    def rows(self, body, steps, step=BLOCK, some=None, **options):
        write_sphere_data(self.path("grains"), ((-9, 9), (-9, 9), (-9, 9)), some or [Sphere((0.1, 0.2, RESTING))])
        return thermo(self.run_lammps(SCENE.format(step=step) + body + OUTPUT + f"run {steps}\n", **options).log)


class Belts(Surfaces):

    def test_a_grain_reaches_the_speed_of_the_belt(self):
        u = 1.2
        body_meshes.write_stl(self.path("belt.stl"), body_meshes.grid(lambda i, j: (i - 4.0, j - 4.0, 0.0), 8, 8))
        law = f"{LAW} surface_velocity {u} NULL 7"    # the part along the normal does not count
        for step, slips, final in ((BLOCK, u / (MU * G), u), (BALL, 2 * u / (7 * MU * G), 2 * u / 7)):
            for shape, np in (("plane 0 0 0 0 0 1", 1), ("rectangle 0 0 0 0 0 1 1 0 0 8 8", 2), ("mesh belt.stl", 2)):
                with self.subTest(shape=shape, step=step):
                    rows = self.rows(f"fix body all large/body {shape} {law}\n", 600, step, np=np)
                    for row in rows:
                        t = row["Step"] * DT
                        if 0.0 < t < 0.95 * slips:
                            # friction from the first step whose displacement has grown to its limit
                            self.assertAlmostEqual(row["v_v"], MU * G * t, delta=1.5 * MU * G * DT)
                            self.assertAlmostEqual(row["f_body[1]"], -MU * MASS * G, delta=1e-3 * MASS)
                            self.assertAlmostEqual(row["f_body[3]"], -MASS * G, delta=1e-3 * MASS)
                    self.assertGreater(abs(rows[-1]["v_v"]), 0.95 * final)
                    # then it sticks, and swings a little on the spring of the contact
                    late = [row["v_v"] for row in rows if row["Step"] * DT > 1.1 * slips]
                    self.assertAlmostEqual(sum(late) / len(late), final, delta=0.02 * u)

    def test_a_belt_is_a_plane_that_moves_in_itself(self):
        plane = f"fix body all large/body plane 0 0 0 0 0 1 {LAW} "
        belt = self.rows(plane + "surface_velocity 0.7 0.2 0\n", 200, BALL)
        moved = self.rows(plane + "move linear 0.7 0.2 0\n", 200, BALL)
        for mine, theirs in zip(belt, moved):
            for key in mine:
                self.assertAlmostEqual(mine[key], theirs[key], delta=1e-9, msg=key)
        self.assertGreater(belt[-1]["f_body"], 1e-3)

    def test_a_belt_on_a_body_that_turns(self):
        # the belt turns with the body: after a quarter turn it runs along y
        body = (f"fix body all large/body plane 0 0 0 0 0 1 {LAW} surface_velocity 1 0 0 move variable NULL NULL NULL NULL "
                f"NULL NULL angle {math.pi / 2!r} NULL 0 0 1\n")
        rows = self.rows(body, 20)
        self.assertAlmostEqual(rows[-1]["f_body[1]"], 0.0, delta=1e-9)
        self.assertAlmostEqual(rows[-1]["f_body[2]"], -MU * MASS * G, delta=1e-3 * MASS)

    def test_refusals(self):
        box = "box 0 0 0 4 4 4 inside"
        for words, message in ((f"{box} {LAW} surface_velocity 1 0 0", "surface_velocity is for plane, rectangle and mesh"),
                               (f"plane 0 0 0 0 0 1 {LAW} surface_velocity 1 0", "surface_velocity: missing velocity"),
                               (f"plane 0 0 0 0 0 1 {LAW} wear 1", "wear: only the triangles of a mesh"),
                               (f"plane 0 0 0 0 0 1 {LAW} wear 0", "wear: expected coefficient k (a number > 0) instead of '0'"),
                               (f"sphere 0 0 0 1 open {LAW}", "unknown side 'open', expected inside or outside"),
                               (f"cone 0 0 0 0 0 1 1 2 3 opened {LAW}", "unknown side 'opened', expected inside, outside or open")):
            with self.subTest(words):
                write_sphere_data(self.path("grains"), ((-9, 9), (-9, 9), (-9, 9)), [Sphere((0.1, 0.2, RESTING))])
                log = self.run_lammps(SCENE.format(step=BALL) + f"fix body all large/body {words}\nrun 0\n", expect_error=True,
                                      np=2).log
                errors = [line for line in log.splitlines() if line.startswith("ERROR")]
                self.assertEqual(len(errors), 1)
                self.assertIn(message, errors[0])


class OpenShapes(Surfaces):

    def force(self, shape, x):
        row, = self.rows(f"fix body all large/body {shape} contact hooke 1e4 0\n", 0, some=[Sphere(x)])
        return [-row[f"f_body[{k}]"] for k in (1, 2, 3)]

    def check(self, found, expected):
        for mine, theirs in zip(found, expected):
            self.assertAlmostEqual(mine, theirs, delta=1e-8)

    def test_forces_inside_outside_and_at_rims(self):
        pipe = "cylinder 0 0 1 0 0 1 2 4 open"    # z = -1 ... 3
        self.check(self.force(pipe, (1.6, 0, 0.5)), (-1e3, 0, 0))
        self.check(self.force(pipe, (0, 2.4, 2.5)), (0, 1e3, 0))
        self.check(self.force(pipe, (2, 0, 3.3)), (0, 0, 2e3))
        self.check(self.force(pipe, (0, -1.76, -1.32)), (0, 0.6e3, -0.8e3))
        self.check(self.force(pipe, (0, 0, 3.0)), (0, 0, 0))    # where a cap would be
        self.check(self.force(pipe.replace("4 open", "INF open"), (2.4, 0, 7)), (1e3, 0, 0))
        # half angle of 45 degrees: radius 1 at z = 0, 3 at z = 2
        cone, a = "cone 0 0 1 0 0 1 1 3 2 open", math.sqrt(0.5)
        for side in (1, -1):
            x = (2 - side * 0.4 * a, 0, 1 + side * 0.4 * a)
            self.check(self.force(cone, x), (-side * 1e3 * a, 0, side * 1e3 * a))
        self.check(self.force(cone, (1.0, 0, -0.4)), (0, 0, -1e3))
        self.check(self.force(cone, (0, 0, 0)), (0, 0, 0))

    def test_grains_pass_a_pipe_and_leave_a_hopper(self):
        some = [Sphere((0.3 * k - 0.6, 0.2, 3.0 + 1.05 * k)) for k in range(4)]
        bodies = (f"fix body all large/body cone 0 0 1 0 0 1 1.2 4 2.5 open {LAW}\n"
                  f"fix pipe all large/body cylinder 0 0 -2 0 0 1 1.2 3 open {LAW}\n")
        dump = "dump d all custom 1200 end.* id x y z\ndump_modify d first yes\n"
        for np in (1, 2, 4):
            self.rows(bodies + dump, 1200, BALL, some, np=np)
            end = read_dump(self.path("end.1200"))[0]
            if np == 1:
                alone = end
            self.assert_same_bits(alone, end, ["x", "y", "z"])
        self.assertLess(max(alone.column("z").values()), -1.0)


class Triangles(Surfaces):

    def test_loads_and_wear(self):
        # a grain that slides over a plate: wear depth times area is k mu N times its way
        body_meshes.write_stl(self.path("plate.stl"), body_meshes.grid(lambda i, j: (i - 4.0, j - 4.0, 0.0), 8, 8))
        area, k, v = 0.5, 2e-3, 5.0
        body = (f"fix body all large/body mesh plate.stl {LAW} pressure {{mode}} wear {k} vtk 100 {{mode}}.*.vtp\n"
                "fix mean all ave/time 1 100 100 f_body[1] f_body[3] file mean.{mode}\n")
        for mode, np in (("yes", 1), ("average", 2)):
            with self.subTest(mode):
                rows = self.rows(body.format(mode=mode), 400, some=[Sphere((-3.1, 0.2, RESTING), v=(v, 0, 0))], np=np)
                with open(self.path(f"mean.{mode}")) as file:
                    mean = {int(line.split()[0]): tuple(map(float, line.split()[1:])) for line in file if line[0] != "#"}
                touched = []
                for step in (100, 200, 300, 400):
                    data = Piece(self.path(f"{mode}.{step}.vtp")).cell_data
                    row, = (r for r in rows if r["Step"] == step)
                    total = [sum(f[d] for f in data["force"]) for d in range(3)]
                    expected = (row["f_body[1]"], row["f_body[3]"]) if mode == "yes" else mean[step]
                    self.assertAlmostEqual(total[0], expected[0], delta=1e-5)
                    self.assertAlmostEqual(total[2], expected[1], delta=1e-5)
                    self.assertAlmostEqual(sum(data["pressure"]) * area, -total[2], delta=1e-9)
                    self.assertAlmostEqual(sum(data["shear_stress"]) * area, MU * MASS * G, delta=1e-3)
                    t = step * DT
                    way = v * t - 0.5 * MU * G * t * t
                    self.assert_close(sum(data["wear"]) * area, k * MU * MASS * G * way, 2e-3)
                    for w, s in zip(data["wear"], data["shear_work"]):
                        self.assertAlmostEqual(w, k * s, delta=1e-15)
                    touched.append(sum(p > 0 for p in data["pressure"]))
                self.assertEqual(max(touched) > 1, mode == "average")


if __name__ == "__main__":
    unittest.main(verbosity=2)
