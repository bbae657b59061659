# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""Convex particles on meshes: a floor of many triangles against the plane, slopes, a table and a fence by hand, a drum,
moving meshes, and what the mesh bears."""

import math
import random
import unittest

import body_meshes
from talus_testing import SceneCase, Sphere, begin, read_dump, thermo, write_sphere_data

SCENE = begin(read="read_data grains", law="{law}", skin=0.2, dt="{dt}") + """
{shapes}
fix body all large/body {body} contact {law} {motion}
{commands}
thermo {thermo}
thermo_style custom step f_s[1] f_s[2] f_body[1] f_body[2] f_body[3] {columns}
thermo_modify norm no format float %.17g
run {steps}
write_dump all custom state id x y z vx vy vz omegax omegay omegaz f_s[1] f_s[2] f_s[3] f_s[4] modify format float %.17g
"""
STATE = "x y z vx vy vz omegax omegay omegaz f_s[1] f_s[2] f_s[3] f_s[4]".split()
LAW = "hooke 1e5 150 tangential multistep NULL NULL {mu}"
KINDS = "fix s all shape/gran type 1 box 1 1 1 density 1 type 2 box 0.8 0.6 1 rounded 0.05 density 1 orient random 3 " \
        "type 3 vertices 4 1 1 1 1 -1 -1 -1 1 -1 -1 -1 1 scale 0.5 density 1 orient random 4"


class MeshCase(SceneCase):

    def simulate(self, particles, body, steps, shapes=KINDS, law=LAW.format(mu=0.5), dt=2e-4, commands="", motion="",
                 every=None, columns="", size=20.0, np=1):
        write_sphere_data(self.path("grains"), 3 * ((-size, size),), particles, types=3)
        log = self.run_lammps(SCENE.format(shapes=shapes, law=law, dt=dt, body=body, commands=commands, motion=motion,
                                           columns=columns, thermo=every or steps, steps=steps), np=np).log
        self.log = log
        frame, = read_dump(self.path("state"))
        self.end = {tag: {name: frame.column(name)[tag] for name in STATE} for tag in range(1, len(particles) + 1)}
        return thermo(log)

    def mesh(self, triangles, name="mesh.stl"):
        body_meshes.write_stl(self.path(name), triangles)
        return f"mesh {name}"

    def floor(self, half=8.0, cells=24, seed=5):
        """z = 0, irregular triangles."""
        draw = random.Random(seed)
        points = {}
        for i in range(cells + 1):
            for j in range(cells + 1):
                shake = [0.3 * (0 < k < cells) * draw.uniform(-1, 1) for k in (i, j)]
                points[i, j] = tuple(2 * half * (k + s) / cells - half for k, s in zip((i, j), shake)) + (0.0,)
        return body_meshes.grid(lambda i, j: points[i, j], cells, cells)

    def worst(self, other):
        return max(abs(self.end[tag][name] - other[tag][name]) for tag in other for name in STATE)


def gravity(tangent=0.0):
    angle = math.atan(tangent)
    return f"fix g all gravity/talus 10 vector {math.sin(angle)!r} 0 {-math.cos(angle)!r}"


class FloorsOfTriangles(MeshCase):

    def test_thrown_bodies_move_as_on_a_plane(self):
        draw = random.Random(7)
        shapes = KINDS.replace("type 1 box 1 1 1 density 1", "type 1 box 1 1 1 density 1 orient random 2")
        grains = [Sphere((2.5 * i - 4, 2.5 * j - 4, 1.2), v=(draw.uniform(-2, 2), draw.uniform(-2, 2), -1),
                         omega=tuple(draw.gauss(0, 2) for _ in "xyz"), type=1 + (i + j) % 3)
                  for i in range(4) for j in range(4)]
        floor = self.mesh(self.floor())
        ends = []
        for body in ("plane 0 0 0 0 0 1", floor + " one-sided", floor + " two-sided"):
            self.simulate(grains, body, 6000, shapes=shapes, commands=gravity())
            ends.append(self.end)
        # collisions make differences grow: rounding is seen after 1.2 time units of bounces
        for body, end in zip(("one side", "two sides"), ends[1:]):
            self.end = end
            print(f"floor of 1152 triangles, {body}: within {self.worst(ends[0]):.1e} of the plane")
            self.assertLess(self.worst(ends[0]), 1e-9)

    def test_slides_and_topples_as_on_a_plane(self):
        floor = self.mesh(self.floor())
        for tangent, mu in ((0.6, 0.5), (0.45, 0.5), (1.05, 2.0), (0.95, 2.0)):
            with self.subTest(tangent=tangent, mu=mu):
                ends = []
                for body in ("plane 0 0 0 0 0 1", floor):
                    self.simulate([Sphere((-3, 0.1, 0.5))], body, 8000, law=LAW.format(mu=mu), commands=gravity(tangent))
                    ends.append(self.end)
                self.assertLess(self.worst(ends[0]), 1e-9)
                moved = self.end[1]["x"] + 3
                if tangent == 0.6:
                    angle = math.atan(tangent)
                    expected = 0.5 * 10 * (math.sin(angle) - mu * math.cos(angle)) * 1.6 ** 2
                    print(f"slide over 24 x 24 cells: {moved:.4f}, by hand {expected:.4f}")
                    self.assertAlmostEqual(moved, expected, delta=0.02 * expected)
                elif tangent < 1.0:
                    self.assertLess(abs(moved), 1e-2)
                else:
                    self.assertGreater(self.end[1]["omegay"], 0.1)

    def test_two_triangles_as_a_rectangle(self):
        grains = [Sphere((1.2, 0.3, 1.0), v=(0.3, 0.1, -1), type=3), Sphere((-1.0, 0.2, 1.0), v=(-3, 0, 0))]
        rectangle = "rectangle 0 0 0 0 0 1 1 0 0 3 3"
        square = self.mesh([((-1.5, -1.5, 0), (1.5, -1.5, 0), (1.5, 1.5, 0)), ((-1.5, -1.5, 0), (1.5, 1.5, 0), (-1.5, 1.5, 0))])
        ends = []
        for body in (rectangle, square + " one-sided"):
            self.simulate(grains, body, 5000, commands=gravity())
            ends.append(self.end)
        self.assertLess(self.worst(ends[0]), 1e-12)
        self.assertLess(self.end[2]["z"], -0.2, "it falls over the edge")


class Edges(MeshCase):

    def test_cube_over_the_edge_of_a_table(self):
        # it stays while its center is above the table, and falls if not
        table = self.mesh(body_meshes.box((-4, -4, -1), (2, 4, 0), 5))
        a, r = 0.9, 0.05
        rounded = a ** 3 + 6 * r * a * a + 3 * a * math.pi * r * r + 4 / 3 * math.pi * r ** 3
        for shape, volume in (("box 1 1 1", 1.0), (f"box {a} {a} {a} rounded {r}", rounded)):
            for x, stays in ((1.9, True), (2.1, False)):
                with self.subTest(shape=shape, x=x):
                    rows = self.simulate([Sphere((x, 0.1, 0.5))], table, 15000, commands=gravity(), size=100.0,
                                         shapes=f"fix s all shape/gran type 1 {shape} density 1")
                    if stays:
                        self.assertAlmostEqual(self.end[1]["z"], 0.5, delta=2e-3)
                        self.assertLess(rows[-1]["f_s[1]"] + rows[-1]["f_s[2]"], 1e-9)
                        self.assertAlmostEqual(rows[-1]["f_body[3]"], -10 * volume, delta=1e-4)
                    else:
                        self.assertLess(self.end[1]["z"], -0.5)

    def test_plate_on_spikes_and_on_a_fence(self):
        # a large flat box rests on the tips of four pyramids, and on two sheets without thickness that stand upright
        spikes, feet = [], (((-1, -1), (1, -1), (1, 1), (-1, 1)))
        for cx, cy in ((-2, -2), (2, -2), (2, 2), (-2, 2)):
            base = [(cx + 0.5 * u, cy + 0.5 * v, -1.0) for u, v in feet]
            spikes += [((cx, cy, 0.0), base[k], base[(k + 1) % 4]) for k in range(4)]
        fence = []
        for x in (-2.0, 2.0):
            fence += body_meshes.grid(lambda i, j, x=x: (x, i - 4.0, j - 2.0), 8, 2)
        for body in (self.mesh(spikes, "spikes.stl"), self.mesh(fence, "fence.stl")):
            for rounded in ("box 6 6 1", "box 5.8 5.8 0.8 rounded 0.1"):
                with self.subTest(body=body, rounded=rounded):
                    rows = self.simulate([Sphere((0.3, 0.2, 0.5))], body, 30000, commands=gravity(),
                                         shapes=f"fix s all shape/gran type 1 {rounded} density 0.1",
                                         law="hooke 1e5 100")
                    self.assertAlmostEqual(self.end[1]["z"], 0.5, delta=1e-3)
                    self.assertLess(rows[-1]["f_s[1]"] + rows[-1]["f_s[2]"], 1e-6)


class Vessels(MeshCase):

    def test_ball_and_cone_from_inside(self):
        # a cube at the bottom of a ball touches it with four corners; in a cone of 45 degrees likewise
        law = "hooke 1e6 300"
        for body, z in (("sphere 0 0 0 3 inside", 0.5 - math.sqrt(9 - 0.5)),
                        ("cone 0 0 0 0 0 1 0 4 4 inside", -2 + math.sqrt(0.5) + 0.5)):
            with self.subTest(body):
                rows = self.simulate([Sphere((0, 0, z))], body, 20000, law=law, commands=gravity())
                self.assertAlmostEqual(self.end[1]["z"], z, delta=1e-4)
                self.assertLess(rows[-1]["f_s[1]"] + rows[-1]["f_s[2]"], 1e-10)
                self.assertAlmostEqual(rows[-1]["f_body[3]"], -10.0, delta=1e-4)

    def test_prism_rolls_in_a_drum(self):
        # a prism of 16 sides at the bottom of a drum that turns, at first at rest: its mantle comes to the speed of that
        # of the drum; the drum is a mesh of 200 facets, or a cylinder
        radius, omega = 4.0, 0.5
        n, r = 16, 0.5
        corners = [(r * math.cos(2 * math.pi * k / n), y, r * math.sin(2 * math.pi * k / n))
                   for k in range(n) for y in (-0.6, 0.6)]
        shapes = f"fix s all shape/gran type 1 vertices {2 * n} " + " ".join(repr(c) for p in corners for c in p) + " density 1"
        low = math.cos(math.pi / n) * r
        results = {}
        drum = self.mesh(body_meshes.tube(radius, -2.0, 2.0, 200))
        for body in (drum, f"cylinder 0 0 0 0 1 0 {radius} 4 inside"):
            rows = self.simulate([Sphere((0, 0, low - radius + 0.01))], body, 40000, shapes=shapes,
                                 law=LAW.format(mu=0.8), commands=gravity(), every=200,
                                 motion=f"move rotate 0 0 0 0 1 0 {2 * math.pi / omega!r}")
            spin = [math.sqrt(2 * row["f_s[2]"] / self.inertia(r, n)) for row in rows[len(rows) // 2:]]
            results[body] = sum(spin) / len(spin)
            distance = math.hypot(self.end[1]["x"], self.end[1]["z"])
            self.assertLess(distance, radius - low + 0.01)
            self.assertGreater(distance, radius - r - 0.1)
        expected = omega * radius / r
        print(f"prism in a drum: spin {results[drum]:.3f}, in a cylinder {list(results.values())[1]:.3f}, "
              f"by hand {expected:.3f}")
        for value in results.values():
            self.assertAlmostEqual(value, expected, delta=0.1 * expected)

    @staticmethod
    def inertia(r, n):
        area = 0.5 * n * r * r * math.sin(2 * math.pi / n)
        return 1.2 * area * r * r / 6 * (2 + math.cos(2 * math.pi / n))


class MovingMeshes(MeshCase):

    def test_plate_moves_as_a_plane(self):
        floor = self.mesh(self.floor())
        for motion in ("move wiggle 0.3 0 0.1 0.7", "move linear 0.4 0 0.2", "move rotate 2 0 0 0 0 1 5"):
            with self.subTest(motion):
                ends = []
                for body in ("plane 0 0 0 0 0 1", floor):
                    self.simulate([Sphere((0.5, 0, 0.6)), Sphere((-1.5, 0.5, 0.7), type=2)], body, 5000,
                                  commands=gravity(), motion=motion)
                    ends.append(self.end)
                self.assertGreater(abs(ends[0][1]["x"] - 0.5) + abs(ends[0][1]["y"]), 1e-2)
                self.assertLess(self.worst(ends[0]), 1e-8)

    def test_momentum(self):
        # no gravity: what the bodies lose in a step the mesh has; a box that spins, closed, of many triangles
        box = self.mesh(body_meshes.box((-2, -2, -2), (2, 2, 2), 4))
        draw = random.Random(3)
        grains = [Sphere((0.95 * i - 0.6, 0.95 * j - 0.6, 0.95 * k - 0.6), v=tuple(draw.gauss(0, 3) for _ in "xyz"),
                         omega=tuple(draw.gauss(0, 3) for _ in "xyz"), type=2 + (i + j) % 2)
                  for i in range(2) for j in range(2) for k in range(2)]
        shapes = "fix s all shape/gran type 1 box 1 1 1 density 1 type 2 box 0.4 0.3 0.5 density 1 " \
                 "type 3 vertices 4 1 1 1 1 -1 -1 -1 1 -1 -1 -1 1 scale 0.2 rounded 0.08 density 1"
        columns = " ".join(f"v_p{d}" for d in "xyz") + " v_count"
        commands = "\n".join(f"variable a{d} atom mass*v{d}\ncompute c{d} all reduce sum v_a{d}\nvariable p{d} equal c_c{d}"
                             for d in "xyz") + "\nvariable count equal f_s[7]"
        rows = self.simulate(grains, box + " inside", 1500, dt=2e-4, shapes=shapes, columns=columns, every=1,
                             commands=commands, motion="move rotate 0 0 0 1 2 3 4", np=2)
        worst, most = 0.0, 0.0
        for before, after in zip(rows, rows[1:]):
            for d, k in zip("xyz", (1, 2, 3)):
                change = after[f"v_p{d}"] - before[f"v_p{d}"]
                worst = max(worst, abs(change + 2e-4 * before[f"f_body[{k}]"]))
                most = max(most, abs(before[f"f_body[{k}]"]))
        print(f"momentum: within {worst:.1e} in a step, force on the mesh up to {most:.0f}")
        self.assertGreater(most, 50.0)
        self.assertLess(worst, 1e-12)

    def test_loads_of_triangles(self):
        # a cube at rest: the pressures of the triangles times their areas carry it
        floor = self.floor(half=2.0, cells=4)
        body = self.mesh(floor)
        columns = " ".join(f"f_body[{t + 1}][1]" for t in range(len(floor))) + " c_low c_sum c_high"
        rows = self.simulate([Sphere((0.3, 0.2, 0.5))], body, 20000, motion="pressure yes", columns=columns,
                             commands=gravity() + self.PARTS)
        carried = [rows[-1][f"f_body[{t + 1}][1]"] * self.area(floor[t]) for t in range(len(floor))]
        self.assertAlmostEqual(rows[-1]["f_body[3]"], -10.0, delta=1e-5)
        self.assertAlmostEqual(sum(carried), 10.0, delta=1e-5)
        # the triangles under its four corners
        self.assertEqual(sum(force > 0 for force in carried), 4)
        # which the rows of contacts name
        parts = [t + 1 for t, force in enumerate(carried) if force > 0]
        self.assertEqual([rows[-1][f"c_{name}"] for name in ("low", "sum", "high")], [parts[0], sum(parts), parts[-1]])

    PARTS = "\ncompute parts all contact/gran/local part\n" + "\n".join(
        f"compute {name} all reduce {way} c_parts inputs local" for name, way in (("low", "min"), ("sum", "sum"), ("high", "max")))

    @staticmethod
    def area(triangle):
        (ax, ay, _), (bx, by, _), (cx, cy, _) = triangle
        return 0.5 * abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))


if __name__ == "__main__":
    unittest.main()
