# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=20 timeout=300
"""A shape of particles that is added by one file, tests/added_shape/capsule.cpp, and used from an input script: mass and
inertia, contacts with itself, spheres, convex particles, planes, boxes and meshes, pictures, refusals; same bits on 1, 2 and
4 ranks, with threads, and across a restart."""

import math
import os
import random
import unittest

import body_meshes
from talus_testing import SceneCase, Sphere, begin, read_dump, thermo, write_sphere_data
from vtk_files import read_part, read_series

WITH_SHAPE = {"LAMMPS_PLUGIN_PATH": os.path.join(os.environ["TALUS_BINARY_DIR"], "added")}
LENGTH, RADIUS = 0.8, 0.3
CAPSULE = f"capsule {LENGTH} {RADIUS}"
OF_CYLINDER, OF_BALL = math.pi * RADIUS ** 2 * LENGTH, 4 / 3 * math.pi * RADIUS ** 3
MASS = OF_CYLINDER + OF_BALL
ACROSS = OF_CYLINDER * (LENGTH ** 2 / 12 + RADIUS ** 2 / 4) \
    + OF_BALL * (0.4 * RADIUS ** 2 + LENGTH ** 2 / 4 + 0.375 * LENGTH * RADIUS)
ALONG = OF_CYLINDER * RADIUS ** 2 / 2 + OF_BALL * 0.4 * RADIUS ** 2

HEAD = begin(read="{read}", law="{law}", skin=0.2, dt="{dt}") + """
"""
COLUMNS = "x y z vx vy vz omegax omegay omegaz f_s[1] f_s[2] f_s[3] f_s[4]".split()
END = f"\nwrite_dump all custom end id radius mass {' '.join(COLUMNS)} modify format float %a"


def lying(axis="y", angle=90.0):
    """Words that turn the z axis of a capsule about another one."""
    half = math.radians(angle) / 2
    turn = [math.cos(half)] + [math.sin(half) * (axis == other) for other in "xyz"]
    return "orient quat " + " ".join(map(repr, turn))


class AddedShape(SceneCase):

    def simulate(self, particles, commands, steps, dt=1e-4, law="hooke 1e4 0", every=None, columns="f_s", types=1):
        write_sphere_data(self.path("grains"), 3 * ((-6, 6),), particles, types)
        script = HEAD.format(read="read_data grains", law=law, dt=dt) + commands + f"""
thermo {every or steps}
thermo_style custom step {columns}
thermo_modify norm no format float %.17g
run {steps}
""" + END
        log = self.run_lammps(script, env=WITH_SHAPE).log
        self.frame, = read_dump(self.path("end"))
        return thermo(log)

    def of(self, name, tag=1):
        return self.frame.column(name)[tag]

    def test_mass_and_inertia(self):
        vector = " ".join(f"f_s[{k}]" for k in range(1, 6))
        row, = self.simulate([Sphere((0, 0, 0), v=(2, 0, 0), omega=(3.0, 0.0, 5.0))], f"fix s all shape/gran type 1 {CAPSULE} density 1",
                             0, columns=vector)
        self.assert_close(self.of("mass"), MASS, 1e-14)
        self.assert_close(self.of("radius"), 0.5 * LENGTH + RADIUS, 1e-14)
        for key, expected in (("f_s[1]", 2 * MASS), ("f_s[2]", 0.5 * (9 * ACROSS + 25 * ALONG)), ("f_s[3]", 3 * ACROSS),
                              ("f_s[4]", 0.0), ("f_s[5]", 5 * ALONG)):
            self.assertAlmostEqual(row[key], expected, delta=1e-13, msg=key)

    def test_lies_on_all_kinds_of_floors(self):
        """It falls flat, and on one end, on a plane, a box, a mesh, a rectangle and a convex particle: the same motion."""
        body_meshes.write_stl(self.path("floor.stl"), body_meshes.box((-5, -5, -1), (5, 5, 0), 4))
        floors = {"plane": "plane 0 0 0 0 0 1", "box": "box 0 0 -0.5 10 10 1 outside", "mesh": "mesh floor.stl",
                  "room": "box 0 0 5 10 10 10 inside", "rectangle": "rectangle 0 0 0 0 0 1 1 0 0 10 10"}
        for angle, height in (90.0, RADIUS), (40.0, 0.5 * LENGTH * math.cos(math.radians(40)) + RADIUS):
            found = {}
            for name, floor in floors.items():
                self.simulate([Sphere((0.1, 0.2, height + 0.005), v=(0.3, 0.1, -1.0))], f"""
fix s all shape/gran type 1 {CAPSULE} density 1 {lying(angle=angle)}
fix floor all large/body {floor} contact hertz 1e5 20 tangential multistep NULL NULL 0.4
""", 3000, dt=5e-5)
                found[name] = [self.of(key) for key in COLUMNS]
            for name, state in found.items():
                for one, other, key in zip(state, found["plane"], COLUMNS):
                    self.assertAlmostEqual(one, other, delta=1e-9, msg=f"{name}, {angle} degrees: {key}")
            self.assertGreater(found["plane"][5], 0.2, "it bounces")
            self.assertGreater(max(map(abs, found["plane"][6:9])), 0.3, "and turns")

    def test_rests_on_both_ends(self):
        """Each bears half of the weight: overlap m g/(2 k)."""
        weight, stiffness = 10.0 * MASS, 1e4
        self.simulate([Sphere((0, 0, RADIUS))], f"""
fix s all shape/gran type 1 {CAPSULE} density 1 {lying()}
fix g all gravity/talus 10 vector 0 0 -1
fix floor all large/body plane 0 0 0 0 0 1 contact hooke {stiffness} 40
""", 20000, dt=1e-4)
        self.assertAlmostEqual(self.of("z"), RADIUS - 0.5 * weight / stiffness, delta=1e-9)

    def test_pairs_keep_momentum_and_energy(self):
        """Without dissipation, of two capsules, a capsule and a sphere, a capsule and a box: impacts off the center."""
        kinds = {"capsule": CAPSULE, "box": "box 0.9 0.7 0.5 rounded 0.1", "sphere": None}
        for name, shape in kinds.items():
            with self.subTest(name):
                two = f"type 2 {shape} density 1 orient random 7" if shape else ""
                rows = self.simulate(
                    [Sphere((-0.8, 0.05, 0.1), v=(1.0, 0, 0), omega=(0.5, -1, 0.3)),
                     Sphere((0.8, -0.1, 0), v=(-1.0, 0.1, 0), omega=(1, 0.2, 0.7), diameter=0.9, type=2, density=1.3)],
                    f"""
group balls type {1 if shape else 2}
fix s all shape/gran type 1 {CAPSULE} density 1 {lying("x", 50)} {two}
{"" if shape else "fix b balls nve/sphere/symplectic"}
variable px equal vcm(all,x)
variable e equal {"f_s" if shape else "f_s+0.5*mass[2]*(vx[2]^2+vy[2]^2+vz[2]^2)"}
""", 30000, dt=4e-5, every=100, columns="v_px v_e f_s[6]", types=2)
                touched = [row["f_s[6]"] for row in rows]
                self.assertGreater(max(touched), 0, "they meet")
                self.assertEqual(touched[0], 0)
                self.assertEqual(touched[-1], 0, "and part")
                print(f"{name}: energy {rows[-1]['v_e'] / rows[0]['v_e'] - 1:.1e}")
                self.assert_close(rows[-1]["v_e"], rows[0]["v_e"], 2e-4)
                self.assertAlmostEqual(rows[-1]["v_px"], rows[0]["v_px"], delta=1e-12)

    def test_sphere_as_limit(self):
        """A very short capsule is a sphere: two of them bounce as spheres do."""
        states = []
        for words in (f"fix s all shape/gran type 1 capsule 1e-9 0.5 density 1", "fix s all nve/sphere/symplectic"):
            write_sphere_data(self.path("grains"), 3 * ((-6, 6),), [Sphere((-0.51, 0.2, 0), v=(1, 0, 0), omega=(0, 1, 2)),
                                                                  Sphere((0.51, -0.2, 0.1), v=(-1, 0, 0), density=1.0)])
            self.run_lammps(HEAD.format(read="read_data grains", law="hertz 1e5 30", dt=5e-5) + words + "\nrun 3000\n"
                            + "write_dump all custom end id x y z vx vy vz modify format float %a", env=WITH_SHAPE)
            states.append(read_dump(self.path("end"))[0])
        for key in "x y z vx vy vz".split():
            for tag in (1, 2):
                self.assertAlmostEqual(states[0].column(key)[tag], states[1].column(key)[tag], delta=1e-7)
        self.assertLess(states[0].column("vx")[1], 0.5, "they have met")

    def test_picture(self):
        """Surfaces in files for ParaView: their volume and their highest point."""
        self.simulate([Sphere((1, 2, 3))], f"fix s all shape/gran type 1 {CAPSULE} density 1 {lying('x', 30)}\n"
                      "dump film all vtk/gran 1 run.pvd id", 0)
        (_, parts), = read_series(self.path("run.pvd"))
        piece, = read_part(parts["shapes"])
        self.assertEqual(set(piece.cell_data["id"]), {1})
        volume = 0.0
        for k in range(len(piece.points) // 3):
            a, b, c = ([x - m for x, m in zip(p, (1, 2, 3))] for p in piece.points[3 * k:3 * k + 3])
            volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                       + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
        self.assertLess(volume, MASS)
        self.assertGreater(volume, 0.88 * MASS, "triangles face outward")
        self.assertAlmostEqual(max(p[2] for p in piece.points) - 3,
                               0.5 * LENGTH * math.cos(math.radians(30)) + RADIUS, delta=1e-6)

    def test_refusals(self):
        def error(commands, env=WITH_SHAPE, types=1):
            write_sphere_data(self.path("grains"), 3 * ((-6, 6),), [Sphere((0, 0, 2))], types)
            return self.run_lammps(HEAD.format(read="read_data grains", law="hooke 1e4 0", dt=1e-4) + commands + "\nrun 1\n",
                                   expect_error=True, env=env).log
        capsule = f"fix s all shape/gran type 1 {CAPSULE} density 1\n"
        for commands, expected in (
                (capsule + "fix drum all large/body cylinder 0 0 0 0 0 1 3 8 inside contact hooke 1e4 0",
                 "its contacts with the shape capsule of particles of type 1 are not known: use another surface, such as plane "
                 "or mesh"),
                ("fix s all shape/gran type 1 capsule -1 0.3 density 1", "capsule L"),
                ("fix s all shape/gran type 1 capsule 1 0.3 rounded 0.1 density 1", "'rounded'"),
                ("fix s all shape/gran type 1 capsule 1 0.3", "no density is given")):
            with self.subTest(expected):
                self.assertIn(expected, error(commands))
        self.assertIn("unknown shape 'capsule', expected box, polyhedron, vertices, ellipsoid or superellipsoid", error(capsule, env={}))

    def scene(self, name, np=1, commands="run 2000", read="read_data ../grains", env=None):
        where = self.path(name)
        os.makedirs(where, exist_ok=True)
        law = "hertz 2e4 60 tangential multistep NULL NULL 0.5"
        script = HEAD.format(read=read, law=law, dt=5e-4) + f"""
group balls type 3
fix step balls nve/sphere/symplectic
fix s all shape/gran type 1 {CAPSULE} density 1 orient random 11 type 2 box 0.6 0.5 0.4 rounded 0.1 density 1 orient random 12
fix g all gravity/talus 15 vector 0.2 0.1 -1
fix floor all large/body plane 0 0 0 0 0 1 contact {law}
fix stirrer all large/body mesh ../stirrer.stl contact {law} move rotate 4 4 0 0 0 1 3
fix block all large/body box 1 1 0.4 0.8 0.8 0.8 outside contact {law}
fix sides all large/body box 4 4 6 8 8 12 inside contact {law}
thermo 1000
thermo_style custom step f_s f_s[6]
thermo_modify norm no
{commands}
""" + END
        log = self.run_lammps(script, np=np, cwd=where, env={**WITH_SHAPE, **(env or {})}).log
        return read_dump(os.path.join(where, "end"))[0], log

    def test_same_bits(self):
        draw = random.Random(5)
        sites = [(i, j, k) for k in range(4) for j in range(5) for i in range(5)]
        write_sphere_data(self.path("grains"), ((0, 8), (0, 8), (-1, 12)), [
            Sphere((1.5 * i + 1.0, 1.5 * j + 1.0, 1.6 * k + 1.7), v=tuple(draw.gauss(0, 0.7) for _ in "xyz"),
                   omega=tuple(draw.gauss(0, 1) for _ in "xyz"), diameter=draw.uniform(0.6, 1.0), type=draw.choice((1, 1, 2, 3)))
            for i, j, k in sites], types=3)
        body_meshes.write_stl(self.path("stirrer.stl"), body_meshes.box((2, 3.7, 0), (6, 4.3, 0.7), 4))
        once, log = self.scene("one")
        self.assertIn("steps without output              in the records", log)
        self.assertGreater(thermo(log)[-1]["f_s[6]"], 20)
        for np, threads in (4, 1), (1, 3), (2, 2):
            with self.subTest(ranks=np, threads=threads):
                self.assert_same_bits(self.scene(f"{np} {threads}", np, env={"OMP_NUM_THREADS": str(threads)})[0], once, COLUMNS)
        self.scene("first", 2, commands="run 1000\nwrite_restart half")
        self.assert_same_bits(self.scene("second", 4, "run 1000", "read_restart ../first/half")[0], once, COLUMNS)


if __name__ == "__main__":
    unittest.main()
