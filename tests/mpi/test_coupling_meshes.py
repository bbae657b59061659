# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=40 timeout=400
"""Meshes whose vertices a partner moves: moved as a rigid body they are one; forces on vertices have the force, torque and work of
the contacts; momentum is kept; the same bits on any ranks and over a restart; a surface that stretches or runs takes grains along;
a wave against a slow twin; spheres, clumps and particles with a shape; refusals."""

import json
import math
import os
import random
import sys
import unittest

TESTS = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(TESTS, "..", "lib"))
import body_meshes
import moved_mesh
from talus_testing import SceneCase, Sphere, read_dump, run_program, write_sphere_data

SOURCE = os.environ["TALUS_SOURCE_DIR"]
HOST, HOST_SOURCE = os.environ["TALUS_LAMMPS_BINARY"], os.environ["TALUS_LAMMPS_SOURCE"]
if not os.path.isdir(os.path.join(HOST_SOURCE, "python")):
    HOST_SOURCE = os.path.dirname(HOST_SOURCE.rstrip("/"))

STICKY = "hooke 1e4 20 tangential multistep NULL NULL 0.5"
ROLLING = "hertz/material 1e6 0.7 0.3 tangential mindlin NULL 1.0 0.5 rolling sds 100 1 0.2 twisting sds 50 1 0.1"
SECOND = "hooke 1e4 20 tangential multistep NULL NULL 0.5 slider midpoint limit_damping"
DT = 0.001

SCENE = """
units lj
boundary {boundary}
atom_style sphere
atom_modify map yes
newton off
comm_modify vel yes
{read}
neighbor 0.2 bin
neigh_modify every 1 delay 0 check yes
pair_style gran/penalty
pair_coeff * * {law}
timestep {dt}
fix step all {integrator} {gravity}
fix body all large/body mesh {mesh} contact {law} move {move} {more}
thermo 0
"""


def hills(nodes=10, half=4.0, height=0.25):
    def at(i, j):
        x, y = -half + 2 * half * i / nodes, -half + 2 * half * j / nodes
        return (x, y, height * (1 - math.cos(1.7 * x) * math.cos(1.3 * y)))
    return body_meshes.grid(at, nodes, nodes)


def floor(nodes=8, half=4.0):
    return hills(nodes, half, 0.0)


def grains(layers=2, low=0.95, jitter=0.04, side=5):
    draw = random.Random(4)
    return [Sphere(tuple(c + draw.uniform(-jitter, jitter) for c in (i - 0.5 * (side - 1), j - 0.5 * (side - 1), low + 0.99 * k)),
                   diameter=draw.uniform(0.9, 0.98)) for k in range(layers) for j in range(side) for i in range(side)]


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


class MovedMesh(SceneCase):

    def setUp(self):
        self.grains(grains())

    def grains(self, spheres, box=((-6, 6), (-6, 6), (-5, 8))):
        write_sphere_data(self.path("grains"), box, spheres)

    def scene(self, triangles, move="vertices", law=STICKY, read="read_data grains", boundary="f f f", dt=DT, more="",
              integrator="nve/sphere/symplectic", gravity="gravity 5.0 vector 0 0 -1"):
        body_meshes.write_stl(self.path("mesh.stl"), triangles)
        text = SCENE.format(boundary=boundary, read=read, law=law, dt=dt, integrator=integrator, gravity=gravity, mesh="mesh.stl",
                            move=move, more=more)
        if "read_restart" in read:
            for line in ("units lj", f"boundary {boundary}", "atom_style sphere"):
                text = text.replace(line + "\n", "", 1)
        return text

    def drive(self, name, np=1, **spec):
        """Rows of the exchanges."""
        with open(self.path(name + ".spec"), "w") as file:
            json.dump(spec, file)
        self.python([os.path.join(TESTS, "..", "lib", "moved_mesh.py"), name + ".spec", name], np)
        with open(self.path(name)) as file:
            return moved_mesh.in_numbers(json.load(file))

    def python(self, words, np=1):
        paths = [os.path.join(HOST_SOURCE, "python"), os.path.join(SOURCE, "python"), os.path.join(TESTS, "..", "lib")]
        libraries = HOST + ":" + os.environ.get("LD_LIBRARY_PATH", "")
        return run_program(sys.executable, np, words, cwd=self.dir,
                           env={"LD_LIBRARY_PATH": libraries, "PYTHONPATH": ":".join(paths)}).output

    def end(self, name):
        frame, = read_dump(self.path(name + ".end"))
        return frame

    def assert_near(self, found, expected, share, what=""):
        size = max(map(abs, expected)) or 1.0
        for a, b in zip(found, expected):
            self.assertLessEqual(abs(a - b), share * size, f"{what}: {found} against {expected}")


class RigidWays(MovedMesh):

    def both(self, triangles, words, law=STICKY, steps=120, every=1, integrator="nve/sphere/symplectic"):
        """Rows of the rigid body and of the mesh of vertices, and the ends."""
        shared = {"way": "rigid", "words": words, "every": every, "steps": steps}
        rows = [self.drive(name, scene=self.scene(triangles, move, law, integrator=integrator), rigid=name == "rigid", **shared)
                for name, move in (("rigid", "external"), ("vertices", "vertices"))]
        return rows, [self.end(name) for name in ("rigid", "vertices")]

    def largest_difference(self, rows):
        """Of loads, over the largest one."""
        size = max(abs(f) for row in rows[0] for f in row["load"][:6])
        self.assertGreater(size, 10.0, "the mesh bears grains")
        worst = 0.0
        for mine, theirs in zip(*rows):
            p = [a - b for a, b in zip(mine["state"][:3], rows[0][0]["center"])]
            f = theirs["load"]
            torque = [f[3 + k] - moved_mesh.cross(p, f[:3])[k] for k in range(3)]    # about the point that moves
            self.assertEqual(mine["load"][6], f[6], "contacts")
            worst = max(worst, max(abs(a - b) for a, b in zip(mine["load"], f[:3] + torque)) / size)
        return worst

    def compare(self, triangles, words, bound, **options):
        rows, ends = self.both(triangles, words, **options)
        center = [0.0, 0.0, 0.0]    # of the area; from the state, which is center + way
        first, t = rows[0][0]["state"], rows[0][0]["step"] * DT
        way, _ = moved_mesh.Rigid(center, **words).way(t)
        rows[0][0]["center"] = [first[k] - way[k] for k in range(3)]
        worst = self.largest_difference(rows)
        print(f"{options.get('law', STICKY)[:22]}... {words}: loads differ by {worst:.1e}")
        self.assertLess(worst, bound)
        return ends

    def test_same_bits_where_places_have_the_same(self):
        """Whole numbers of 1/2^10 in every step."""
        step = 2.0 ** -10
        self.grains(grains(low=0.5))
        rows, ends = self.both(floor(), {"drift": [step / DT, -2 * step / DT, 0.5 * step / DT]})
        self.assertGreater(max(row["load"][6] for row in rows[0]), 5)
        self.assert_same_bits(*ends)
        for mine, theirs in zip(*rows):
            self.assertEqual(mine["load"][:3], theirs["load"][:3])

    def test_first_order(self):
        swing = {"swing": [0.1, 0.05, 0.06], "rate": 9.0}
        for law in (STICKY, ROLLING):
            self.compare(hills(), swing, 1e-11, law=law)
            self.compare(hills(), {**swing, "omega": 0.8}, 1e-11, law=law)

    def test_order_2(self):
        """Half way through a step places are the means of both ends: those of a turn differ from it in second order."""
        order_2 = {"law": SECOND, "integrator": "nve/sphere/symplectic order 2", "steps": 120}
        self.compare(hills(), {"swing": [0.1, 0.05, 0.06], "rate": 9.0}, 1e-11, **order_2)
        self.compare(hills(), {"omega": 0.5}, 1e-5, **order_2)

    def test_velocities_of_the_way(self):
        """Those of a straight way are those of a rigid body on it."""
        words = {"drift": [0.3, 0.2, 0.1]}
        (rigid, _), _ = self.both(hills(), words, every=10, steps=200)
        found = self.drive("again", scene=self.scene(hills()), way="rigid", words=words, every=10, steps=200, with_velocities=False)
        self.assertEqual(rigid[0]["load"][6], 0, "before they are the same")
        self.assertGreater(max(abs(row["load"][2]) for row in found), 10.0)
        for mine, theirs in zip(rigid, found):
            self.assert_near(theirs["load"][:3], mine["load"][:3], 1e-10)


class Ledgers(MovedMesh):

    def moved(self, name, every, np=1, steps=200, root=-1, law=ROLLING, **options):
        return self.drive(name, np, scene=self.scene(hills(), law=law, **options), way="wave",
                          words={"height": 0.1, "number": 1.1, "rate": 6.0, "growth": 0.1}, every=every, steps=steps, root=root)

    def test_forces_on_vertices_are_the_load(self):
        """Of each step: sums over vertices are force and torque to rounding, and the work is that of the ways."""
        places, worst = None, 0.0
        rows = self.moved("rows", 1)
        reference = center_of(self.path("mesh.stl"))
        for row in rows:
            force, torque = row["before"][:3], row["before"][3:6]
            sums = [math.fsum(p[k] for p in row["impulses"]) / DT for k in range(3)]
            size = max(1.0, *map(abs, row["before"]))
            if places:    # where they were when the forces were found
                turning = [moved_mesh.cross(places[n], p) for n, p in zip(row["numbers"], row["impulses"])]
                about = [math.fsum(m[k] for m in turning) / DT - moved_mesh.cross(reference, force)[k] for k in range(3)]
                worst = max(worst, *(abs(a - b) / size for a, b in zip(sums + about, force + torque)))
                work = math.fsum(dot(p, [a - b for a, b in zip(row["x"][n], places[n])])
                                 for n, p in zip(row["numbers"], row["impulses"])) / DT
                self.assertLessEqual(abs(work - row["work"]), 1e-12 * size)
            places = row["x"]
        self.assertGreater(max(row["load"][6] for row in rows), 8)
        print(f"force and torque of vertices are those of the body to {worst:.1e}")
        self.assertLess(worst, 1e-12)

    def test_momentum(self):
        """What grains lose, vertices get, with each integrator; what vertices get is a few numbers of those touched."""
        for integrator in ("nve/sphere/symplectic", "nve/sphere/talus", "nve/sphere/symplectic order 2"):
            law = SECOND if "order" in integrator else ROLLING
            rows = self.moved(integrator.replace("/", "-").replace(" ", "-"), 20, law=law, integrator=integrator, gravity="",
                              read="read_data grains\nvelocity all set 0 0 -2.0", steps=400)
            got = [math.fsum(p[k] for row in rows for p in row["impulses"]) for k in range(3)]
            end = self.end(integrator.replace("/", "-").replace(" ", "-"))
            masses = {n + 1: math.pi / 6 * s.diameter ** 3 * s.density for n, s in enumerate(grains())}
            momentum = [math.fsum(masses[tag] * v for tag, v in end.column("v" + axis).items()) for axis in "xyz"]
            lost = [-momentum[0], -momentum[1], -2.0 * math.fsum(masses.values()) - momentum[2]]
            self.assertGreater(abs(lost[2]), 10.0)
            print(integrator, "momentum", got, lost)
            self.assert_near(got, lost, 1e-12, integrator)

    def test_same_bits(self):
        rows = self.moved("one", 7, steps=203)
        for np, root in ((2, -1), (4, 0), (2, 1)):
            self.assertEqual(self.moved(f"r{np}{root}", 7, np=np, root=root, steps=203), rows, f"{np} ranks, partner on {root}")
            self.assert_same_bits(self.end(f"r{np}{root}"), self.end("one"))

    def test_restart(self):
        """Within a way, and on another number of ranks."""
        def drive(name, np=1, **options):
            return self.drive(name, np, way="wave", every=20, words={"height": 0.1, "number": 1.1, "rate": 6.0, "growth": 0.1},
                              **options)
        rows = drive("whole", scene=self.scene(hills(), law=ROLLING), steps=400,
                     restart={"step": 253, "file": "half"})
        for np in (1, 2):
            again = drive(f"again{np}", np, scene=self.scene(hills(), law=ROLLING, read="read_restart half"), steps=400,
                          state="half.json")
            for row in rows:
                row.pop("before", None)
            for row in again:
                row.pop("before", None)
            self.assertEqual(again, rows[-len(again):], f"{np} ranks")
            self.assertEqual(len(again), 8)
            self.assert_same_bits(self.end(f"again{np}"), self.end("whole"))


def center_of(path):
    """Center of the area of a mesh that is not closed."""
    corners, total, sums = [], 0.0, [0.0, 0.0, 0.0]
    with open(path) as file:
        for line in file:
            if line.startswith("vertex"):
                corners.append(tuple(map(float, line.split()[1:])))
    for a, b, c in zip(corners[::3], corners[1::3], corners[2::3]):
        twice = moved_mesh.cross([q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)])
        area = math.sqrt(dot(twice, twice))
        total += area
        sums = [s + area * (p + q + r) / 3.0 for s, p, q, r in zip(sums, a, b, c)]
    return [s / total for s in sums]


if __name__ == "__main__":
    unittest.main(verbosity=2)
