# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=20 timeout=400 stay
"""Meshes whose vertices a partner moves: moved as a rigid body they are one; forces on vertices have the force, torque and work of
the contacts; momentum is kept; the same bits on any ranks and over a restart; a surface that stretches or runs takes grains along;
a wave against a slow twin; spheres, clumps and particles with a shape; refusals."""

import json
import math
import os
import random
import unittest

import body_meshes
import deforming_reference
import moved_mesh
from coupled_case import CoupledCase
from talus_testing import Sphere, begin, read_dump, write_sphere_data
from vectors import dot

STICKY = "hooke 1e4 20 tangential multistep NULL NULL 0.5"
ROLLING = "hertz/material 1e6 0.7 0.3 tangential mindlin NULL 1.0 0.5 rolling sds 100 1 0.2 twisting sds 50 1 0.1"
SECOND = "hooke 1e4 20 tangential multistep NULL NULL 0.5 slider midpoint limit_damping"
DT = 0.001

SCENE = begin(boundary="{boundary}", read="{read}", law="{law}", skin=0.2, dt="{dt}") + """
fix step all {integrator} {gravity}
fix body all large/body mesh {mesh} contact {law} move {move} {more}
thermo_style custom step
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


class MovedMesh(CoupledCase):

    def setUp(self):
        self.grains(grains())

    def grains(self, spheres, box=((-6, 6), (-6, 6), (-5, 8))):
        write_sphere_data(self.path("grains"), box, spheres)

    def scene(self, triangles, move="vertices", law=STICKY, read="read_data grains", boundary="f f f", dt=DT, more="",
              integrator="nve/sphere/symplectic", gravity="gravity 5.0 vector 0 0 -1"):
        body_meshes.write_stl(self.path("mesh.stl"), triangles)
        return SCENE.format(boundary=boundary, read=read, law=law, dt=dt, integrator=integrator, gravity=gravity, mesh="mesh.stl",
                            move=move, more=more)

    def move(self, name, np=1, env=None, **spec):
        """Rows of the exchanges."""
        self.write(name + ".spec", json.dumps(spec))
        self.drive("import moved_mesh\nmoved_mesh.main()\n", name + ".spec", name, np=np, env=env)
        return moved_mesh.in_numbers(self.read_json(name))

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
        rows = [self.move(name, scene=self.scene(triangles, move, law, integrator=integrator), rigid=name == "rigid", **shared)
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

    def test_periodic(self):
        """Images behind the faces of the box follow; grains go through these, on 1 and 2 ranks."""
        spheres = grains(low=1.1, side=4)
        for n, s in enumerate(spheres):
            s.x, s.v = (2.0 * s.x[0], 2.0 * s.x[1], s.x[2]), (0.5 if n % 2 else -0.3, 3.0, 0.0)
        self.grains(spheres, ((-4, 4), (-4, 4), (-5, 8)))
        words = {"swing": [0.0, 0.0, 0.1], "rate": 9.0}

        def bumps(i, j):
            return (-4 + 0.8 * i, -4 + 0.8 * j, 0.2 * math.cos(0.5 * math.pi * (i % 10) * 0.8) * math.sin(0.25 * math.pi * (j % 10) * 0.8))
        triangles = body_meshes.grid(bumps, 10, 10)
        found = [self.move(name, np, scene=self.scene(triangles, move, ROLLING, boundary="p p f"), way="rigid", words=words, every=1,
                           steps=500, rigid=name == "rigid") for name, move, np in (("rigid", "external", 1), ("one", "vertices", 1),
                                                                                      ("two", "vertices", 2))]
        self.assertEqual(found[1], found[2])
        self.assert_same_bits(self.end("one"), self.end("two"))
        size = max(abs(row["load"][2]) for row in found[0])
        worst = max(abs(a - b) for mine, theirs in zip(*found[:2]) for a, b in zip(mine["load"][:3], theirs["load"][:3])) / size
        crossed = sum(abs(self.end("one").column("y")[n + 1] - s.x[1]) > 4.0 for n, s in enumerate(spheres))
        print(f"periodic: loads up to {size:.0f} differ by {worst:.1e}, {crossed} grains went through a face")
        self.assertGreater(size, 100.0)
        self.assertGreater(crossed, 3)
        self.assertLess(worst, 1e-10)

    def test_order_2(self):
        """Half way through a step places are the means of both ends: those of a turn differ from it in second order."""
        order_2 = {"law": SECOND, "integrator": "nve/sphere/symplectic order 2", "steps": 120}
        self.compare(hills(), {"swing": [0.1, 0.05, 0.06], "rate": 9.0}, 1e-11, **order_2)
        self.compare(hills(), {"omega": 0.5}, 1e-5, **order_2)

    def test_velocities_of_the_way(self):
        """Those of a straight way are those of a rigid body on it."""
        words = {"drift": [0.3, 0.2, 0.1]}
        (rigid, _), _ = self.both(hills(), words, every=10, steps=200)
        found = self.move("again", scene=self.scene(hills()), way="rigid", words=words, every=10, steps=200, with_velocities=False)
        self.assertEqual(rigid[0]["load"][6], 0, "before they are the same")
        self.assertGreater(max(abs(row["load"][2]) for row in found), 10.0)
        for mine, theirs in zip(rigid, found):
            self.assert_near(theirs["load"][:3], mine["load"][:3], 1e-10)


class Ledgers(MovedMesh):

    def moved(self, name, every, np=1, steps=200, root=-1, law=ROLLING, env=None, **options):
        return self.move(name, np, env, scene=self.scene(hills(), law=law, **options), way="wave",
                          words={"height": 0.1, "number": 1.1, "rate": 6.0, "growth": 0.1}, every=every, steps=steps, root=root)

    def test_forces_on_vertices_are_the_load(self):
        """Of each step: sums over vertices are force and torque to rounding, and the work is that of the ways."""
        places, worst = None, 0.0
        rows = self.moved("rows", 1, read="read_data grains\nvelocity all set 0 0 -2.0", steps=300)
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
        self.assertGreater(sum(row["load"][6] > 2 for row in rows), 50)
        print(f"force and torque of vertices are those of the body to {worst:.1e}")
        self.assertLess(worst, 1e-12)

    def test_momentum(self):
        """What grains lose, vertices get, with each integrator, while they are in contact."""
        for name, integrator in (("euler", "nve/sphere/symplectic"), ("verlet", "nve/sphere/talus"),
                                 ("order2", "nve/sphere/symplectic order 2")):
            law = SECOND if name == "order2" else ROLLING
            rows = self.moved(name, 20, law=law, integrator=integrator, gravity="", read="read_data grains\nvelocity all set 0 0 -2.0",
                              steps=260)
            got = [math.fsum(p[k] for row in rows for p in row["impulses"]) for k in range(3)]
            masses = {n + 1: math.pi / 6 * s.diameter ** 3 * s.density for n, s in enumerate(grains())}
            momentum = [math.fsum(masses[tag] * v for tag, v in self.end(name).column("v" + axis).items()) for axis in "xyz"]
            lost = [-momentum[0], -momentum[1], -2.0 * math.fsum(masses.values()) - momentum[2]]
            self.assertGreater(abs(lost[2]), 10.0)
            self.assertGreater(rows[-1]["load"][6], 0.0, "contacts at the end")
            self.assert_near(got, lost, 1e-12, integrator)

    def test_same_bits(self):
        rows = self.moved("one", 7, steps=203)
        for np, root in ((2, -1), (4, 0), (2, 1)):
            self.assertEqual(self.moved(f"r{np}{root}", 7, np=np, root=root, steps=203), rows, f"{np} ranks, partner on {root}")
            self.assert_same_bits(self.end(f"r{np}{root}"), self.end("one"))
        self.assertEqual(self.moved("threads", 7, steps=203, env={"OMP_NUM_THREADS": "3"}), rows, "threads")
        self.assert_same_bits(self.end("threads"), self.end("one"))

    def test_restart(self):
        """Within a way, and on another number of ranks."""
        def move(name, np=1, **options):
            return self.move(name, np, way="wave", every=20, words={"height": 0.1, "number": 1.1, "rate": 6.0, "growth": 0.1},
                              **options)
        rows = move("whole", scene=self.scene(hills(), law=ROLLING), steps=400,
                     restart={"step": 253, "file": "half"})
        for np in (1, 2):
            again = move(f"again{np}", np, scene=self.scene(hills(), law=ROLLING, read="read_restart half"), steps=400,
                          state="half.json")
            for row in rows:
                row.pop("before", None)
            for row in again:
                row.pop("before", None)
            self.assertEqual(again, rows[-len(again):], f"{np} ranks")
            self.assertEqual(len(again), 8)
            self.assert_same_bits(self.end(f"again{np}"), self.end("whole"))


class Surfaces(MovedMesh):

    def test_a_sheet_that_stretches_takes_grains_along(self):
        """Spheres at rest come to roll with 2/7 of the velocity of the surface below them: their distance from the center grows
        with the power 2/7 of the stretch."""
        sites = [(-2.5, 0.3), (-1.0, -1.7), (0.8, 1.1), (2.2, -0.6)]
        self.grains([Sphere((x, y, 0.4997), diameter=1.0) for x, y in sites])
        rate, steps = 0.4, 1500
        rows = self.move("sheet", scene=self.scene(floor(), gravity="gravity 10.0 vector 0 0 -1"), way="stretch",
                         words={"rates": [rate, rate, 0.0]}, every=10, steps=steps)
        end, grown = self.end("sheet"), 1.0 + rate * steps * DT
        for tag, site in enumerate(sites, 1):
            for axis, start in zip("xy", site):
                place, speed = end.column(axis)[tag], end.column("v" + axis)[tag]
                self.assert_close(speed, 2.0 / 7.0 * rate * place / grown, 0.01)
                self.assert_close(place, start * grown ** (2.0 / 7.0), 0.01)
        self.assertEqual(rows[-1]["load"][6], 4)

    def test_a_surface_that_runs_is_a_belt(self):
        """Vertices that stay and have a velocity are `surface_velocity`."""
        self.grains([Sphere((x, 0.1 * x, 0.4995), diameter=1.0) for x in (-2.3, -1.1, 0.2, 1.7)])
        self.run_lammps(self.scene(floor(), move="none", more="surface_velocity 0.5 -0.2 0") + """
run 400
write_dump all custom belt.end id x y z vx vy vz omegax omegay omegaz modify format float %a
""")
        self.move("running", scene=self.scene(floor()), way="running", words={"velocity": [0.5, -0.2, 0.0]}, every=400, steps=400)
        belt, running = self.end("belt"), self.end("running")
        # velocities go to those that were given on the way of the first exchange, so that the belt is ahead
        self.assertGreater(belt.column("vx")[1], running.column("vx")[1])
        again = self.move("again", scene=self.scene(floor()), way="running", words={"velocity": [0.5, -0.2, 0.0]}, every=400,
                          steps=400, at_once=True)
        self.assert_same_bits(self.end("again"), belt, ["x", "y", "z", "vx", "vy", "vz", "omegax", "omegay", "omegaz"])
        self.assertGreater(math.fsum(p[0] for p in again[-1]["impulses"]), -1.0)

    def test_a_wave_against_a_slow_twin(self):
        draw = random.Random(9)
        spheres = [Sphere((-2.5 + 1.7 * i + draw.uniform(-0.2, 0.2), -2.0 + 1.3 * j, 0.75), v=(0.0, 0.1 * i, 0.0),
                          omega=(0.3, 0.0, -0.2 * j), diameter=draw.uniform(0.7, 1.0)) for i in range(4) for j in range(4)]
        self.grains(spheres)
        law, words = "hooke 5e3 20 tangential dashpot 15 0.4", {"height": 0.15, "number": 1.5, "rate": 8.0, "growth": 0.1}
        triangles, steps = floor(8), 400
        self.move("wave", scene=self.scene(triangles, law=law), way="wave", words=words, every=1, steps=steps)
        end = self.end("wave")
        wave = moved_mesh.Wave(None, **words)
        given = [(s.x, s.v, s.omega, 0.5 * s.diameter, math.pi / 6 * s.diameter ** 3 * s.density) for s in spheres]
        twin = deforming_reference.run(given, triangles, wave.vertex, steps, DT, 5e3, 20.0, 15.0, 0.4, 5.0)
        worst = 0.0
        for tag, state in enumerate(twin, 1):
            for names, vector in zip((("x", "y", "z"), ("vx", "vy", "vz"), ("omegax", "omegay", "omegaz")), state):
                worst = max(worst, *(abs(end.column(name)[tag] - value) for name, value in zip(names, vector)))
        moved = max(abs(state[1][0]) for state in twin)
        print(f"carried at up to {moved:.2f}; twin differs by {worst:.1e}")
        self.assertGreater(moved, 0.05)
        self.assertLess(worst, 1e-6)

    def test_a_closed_mesh_that_breathes(self):
        """A ball that shrinks around grains: they stay inside, and the box around it is deformed in all pictures."""
        self.grains([Sphere((x, y, z), diameter=0.8) for x in (-0.9, 0.0, 0.9) for y in (-0.9, 0.0, 0.9) for z in (-0.9, 0.0, 0.9)])
        ball = body_meshes.sphere((0.0, 0.0, 0.0), 2.4, 10)
        rows = self.move("ball", np=2, scene=self.scene(ball, gravity="", more="vtk 300 ball.*.vtp"), way="stretch",
                         words={"rates": [-0.3, -0.3, -0.3]}, every=10, steps=900)
        end = self.end("ball")
        far = max(math.sqrt(sum(end.column(axis)[tag] ** 2 for axis in "xyz")) for tag in end.atoms)
        self.assertEqual(len(end.atoms), 27)
        self.assertLess(far, 0.73 * 2.4)
        self.assertGreater(rows[-1]["load"][6], 5)
        self.assertIn("particles are inside", self.read("log.driver"))
        largest = max(abs(c) for x in rows[-1]["x"] for c in x)
        self.assert_close(largest, 0.73 * 2.4, 1e-9)
        self.assertTrue(os.path.exists(self.path("ball.900.vtp")))


class Others(MovedMesh):

    def test_clumps_and_shapes(self):
        """Moved as rigid bodies, they give the same loads."""
        words = {"swing": [0.1, 0.05, 0.06], "rate": 9.0, "omega": 0.6}
        pairs = "fix mol all property/atom mol ghost yes\nread_data grains fix mol NULL Molecules"
        for name, read, mover in (("clumps", pairs, "rigid/small/symplectic molecule"),
                                  ("shapes", "read_data grains", "shape/gran type 1 box 0.6 0.55 0.5 density 1 orient random 5")):
            spheres = grains(low=1.05, side=4)
            self.grains(spheres)
            if name == "clumps":
                with open(self.path("grains"), "a") as file:
                    file.write("\nMolecules\n\n" + "".join(f"{k + 1} {k // 2 + 1}\n" for k in range(len(spheres))))
            weight = "\nfix weight all gravity/talus 5.0 vector 0 0 -1" if name == "shapes" else "gravity 5.0 vector 0 0 -1"
            loads = [self.move(name + move, scene=self.scene(hills(), move, read=read, integrator=mover, gravity=weight), way="rigid",
                               words=words, every=1, steps=300, rigid=move == "external") for move in ("external", "vertices")]
            size = max(abs(f) for row in loads[0] for f in row["load"][:3])
            worst = max(abs(a - b) for mine, theirs in zip(*loads) for a, b in zip(mine["load"][:3], theirs["load"][:3])) / size
            print(f"{name}: loads up to {size:.0f} differ by {worst:.1e}")
            self.assertGreater(size, 10.0)
            self.assertLess(worst, 1e-9)
            for row in loads[1]:
                sums = [math.fsum(p[k] for p in row["impulses"]) / DT for k in range(3)]
                self.assert_near(sums, row["before"][:3], 1e-11)

    def test_snapshot(self):
        """Within a way."""
        out = self.drive(SNAPSHOT.replace("SCENE", repr(self.scene(hills(), law=ROLLING))))
        self.assertIn("same", out)

    def test_refusals(self):
        for np, root in ((1, -1), (2, 1)):
            roof = [((-1, -1, 2), (1, -1, 2), (1, 1, 2)), ((-1, -1, 2), (1, 1, 2), (-1, 1, 2))]
            self.drive(REFUSALS.replace("SCENE", repr(self.scene(floor() + roof))).replace("ROOT", str(root)), np=np)
            for rank in range(np):    # by file: what ranks print can be lost when mpiexec ends
                said = self.read(f"said.{rank}")
                for text in REFUSED:
                    self.assertIn(text, said)
                self.assertNotIn("no error", said)

    def test_words(self):
        text = self.scene(floor())
        for change, message in ((("mesh mesh.stl", "plane 0 0 0 0 0 1"), "move vertices is for mesh"),
                                (("move vertices", "move vertices surface_velocity 1 0 0"),
                                 "surface_velocity does not go with move vertices")):
            self.assertIn(message, self.run_lammps(text.replace(*change), expect_error=True).log)


SNAPSHOT = """
import math
from lammps import lammps
from talus import Partner
import moved_mesh
lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
lmp.commands_string(SCENE)
with Partner(lmp) as partner:
    body = partner.body("body")
    x0 = body.mesh[0]
    wave = moved_mesh.Wave(None, 0.1, 1.1, 6.0, 0.1)
    def go(until):
        rows = []
        while partner.step < until:
            ahead = 20 - partner.step % 20
            if ahead == 20:
                moved = [wave.vertex(x, (partner.step + 20) * partner.dt) for x in x0]
                body.put_vertices([x for x, _ in moved], [v for _, v in moved], 20)
            partner.advance(ahead)
            numbers, impulses, work, time = body.vertex_loads()
            rows.append([list(map(int, numbers)), [list(map(float, p)) for p in impulses], work, time, moved_mesh.load(lmp)])
        return rows
    go(240)
    partner.advance(0)
    moved = [wave.vertex(x, 0.26) for x in x0]
    body.put_vertices([x for x, _ in moved], [v for _, v in moved], 20)
    partner.advance(7)
    with partner.save() as snapshot:
        once = go(400)
        partner.restore(snapshot)
        again = go(400)
print("same" if once == again and max(row[4][6] for row in once) > 2 else ("differs", once, again))
"""

REFUSALS = """
from lammps import lammps
from talus import Partner, TalusError
lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
lmp.commands_string(SCENE)
lmp.command("fix rigid all large/body sphere 0 0 30 1 outside contact hooke 1 1")
lmp.command("fix still all large/body mesh mesh.stl translate 0 0 -20 contact hooke 1 1 move external")
said = open(f"said.{lmp.extract_setting('world_rank')}", "w")
def tried(call, *words, **more):
    try:
        call(*words, **more)
        print("no error", file=said)
    except TalusError as problem:
        print(problem, file=said)
with Partner(lmp, ROOT) as partner:
    here = partner.lives_here
    body = partner.body("body")
    x, triangles = body.mesh
    partner.advance(0)
    def moved(changes):
        if not here:
            return None
        places = [list(map(float, p)) for p in x]
        for vertex, by in changes.items():
            places[vertex] = [a + b for a, b in zip(places[vertex], by)]
        return places
    if here:
        inner = [v for v in range(len(x)) if max(abs(x[v][0]), abs(x[v][1])) < 0.5][0]
        a, b, c = (int(v) for v in triangles[40])
    else:
        inner = a = b = c = 0
    tried(body.put_vertices, moved({inner: (0.0, 0.0, float("nan"))}), steps=1)
    tried(body.put_vertices, moved({inner: (0.0, 0.0, 0.3)}), steps=1)
    tried(body.put_vertices, moved({inner: (1.3, 0.1, 0.0)}), steps=100)
    middle = [0.5 * (x[b][k] + x[c][k]) - x[a][k] for k in range(3)] if here else None
    tried(body.put_vertices, moved({a: middle}), steps=100)
    roof = [v for v in range(len(x)) if x[v][2] > 1.0] if here else []
    tried(body.put_vertices, moved({v: (0.0, 0.0, -2.0 + 0.3 * x[v][0] + 0.01) for v in roof}), steps=100)
    tried(body.put_vertices, moved({}), steps=-1)
    tried(partner.body("rigid").put_vertices, None, steps=1)
    tried(partner.body("still").put_vertices, moved({}), steps=1)
    tried(partner.body("still").vertex_loads)
    tried(lambda: partner.body("none").mesh_size)
    tried(partner.body("body").put_state, [0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0] if here else None)
    partner.advance(10)
    body.put_vertices(moved({inner: (0.0, 0.0, 0.05)}), steps=10)
    partner.advance(10)
said.close()
lmp.finalize()
"""
REFUSED = ["x[", "is no finite number", "more than the skin 0.2", "has turned over against its neighbor", "has no area",
           "cut each other", "expected 0 or more", "is no mesh", "use 'mesh ... move vertices'", "use 'move external'"]


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
