# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""Convex particles: free rotation, impacts with impulse and rebound by hand, slopes, stacks, spheres on boxes, and what
elastic impacts keep."""

import math
import os
import unittest

from talus_testing import SceneCase, Sphere, begin, read_dump, thermo, write_sphere_data

SCENE = begin(read="read_data grains", law="{pair}", skin=0.2, dt="{dt}") + """
{commands}
thermo {thermo}
thermo_style custom step ke {columns}
thermo_modify norm no format float %.17g
run {steps}
write_dump all custom state id x y z vx vy vz omegax omegay omegaz {extra} modify format float %.17g
"""
VECTOR = " ".join(f"f_s[{k}]" for k in range(1, 8))
FLOOR = "fix floor all large/body plane 0 0 0 0 0 1 contact {law}"


def quat(axis, angle):
    return "quat " + " ".join(repr(c) for c in (math.cos(angle / 2), *(math.sin(angle / 2) * a for a in axis)))


class ShapeCase(SceneCase):

    def simulate(self, particles, commands, steps, dt=1e-3, pair="hooke 1e4 0", every=None, np=1, size=20.0,
                 columns=VECTOR, extra="f_s[1] f_s[2] f_s[3] f_s[4]", types=None, **options):
        write_sphere_data(self.path("grains"), 3 * ((-size, size),), particles, types)
        log = self.run_lammps(SCENE.format(pair=pair, dt=dt, commands=commands, columns=columns, steps=steps,
                                           thermo=every or steps, extra=extra), np=np, **options).log
        self.frame, = read_dump(self.path("state"))
        self.log = log
        return thermo(log)

    def of(self, name, tag=1):
        return self.frame.column(name)[tag]


class FreeRotation(ShapeCase):

    def test_energy_and_angular_momentum(self):
        # edges 1, 2, 3 and density 0.5: m = 3, I = m/12 (13, 10, 5); about the axis in the middle it tumbles
        rows = self.simulate([Sphere((0, 0, 0), v=(0.01, 0.0, 0.0), omega=(0.02, 1.0, 0.03))],
                             "fix s all shape/gran type 1 box 1 2 3 density 0.5", 50000, dt=1e-2, every=500)
        inertia = [13 / 4, 10 / 4, 5 / 4]
        start = [i * w for i, w in zip(inertia, (0.02, 1.0, 0.03))]
        energy = 0.5 * sum(l * l / i for l, i in zip(start, inertia))
        # thermo's first line is that of the start
        for k, l in enumerate(start, start=3):
            self.assertLess(max(abs(row[f"f_s[{k}]"] - l) for row in rows), 1e-10)
        worst = max(abs(row["f_s[2]"] / energy - 1) for row in rows)
        late = max(abs(row["f_s[2]"] / energy - 1) for row in rows[50:])
        early = max(abs(row["f_s[2]"] / energy - 1) for row in rows[:50])
        print(f"free rotation: energy within {worst:.2e}")
        self.assertLess(worst, 2e-5)
        self.assertLess(late, 1.2 * early)
        self.assertAlmostEqual(rows[-1]["f_s[1]"], 0.5 * 3 * 0.0001, delta=1e-12)
        self.assertAlmostEqual(self.of("x"), 5.0, delta=1e-9)

    def test_orientation(self):
        # a cube turns uniformly: by omega t about the axis
        self.simulate([Sphere((0, 0, 0), omega=(0.3, 0.0, 0.4))],
                      "fix s all shape/gran type 1 box 1 1 1 density 1", 1000)
        for k, expected in enumerate((math.cos(0.25), 0.6 * math.sin(0.25), 0.0, 0.8 * math.sin(0.25)), start=1):
            self.assertAlmostEqual(self.of(f"f_s[{k}]"), expected, delta=1e-12)


class Impacts(ShapeCase):
    """A cube of edge 1 and mass 1 that falls on a plane with speed 1, no gravity. Elastic and without friction the
    impulse at a point with arm r is J = 2 v/(1/m + |r x n|^2/I), I = 1/6."""

    def impact(self, axis, angle, height, law="hooke 1e6 0", spec="box 1 1 1", steps=20000):
        rows = self.simulate([Sphere((0, 0, height + 0.01), v=(0, 0, -1.0))],
                             f"fix s all shape/gran type 1 {spec} density 1 orient {quat(axis, angle)}\n"
                             + FLOOR.format(law=law), steps, dt=1e-5, pair=law)
        return rows[-1]

    def test_flat(self):
        end = self.impact((0, 0, 1), 0.3, 0.5)
        self.assertAlmostEqual(self.of("vz"), 1.0, delta=1e-4)
        self.assertLess(end["f_s[2]"], 1e-10)

    def test_on_an_edge_and_on_a_corner(self):
        self.impact((0, 1, 0), math.pi / 4, math.sqrt(0.5))
        self.assertAlmostEqual(self.of("vz"), 1.0, delta=1e-4)
        axis = (math.sqrt(0.5), -math.sqrt(0.5), 0)
        self.impact(axis, math.acos(math.sqrt(1 / 3)), math.sqrt(0.75))
        self.assertAlmostEqual(self.of("vz"), 1.0, delta=1e-4)
        self.assertLess(abs(self.of("omegax")) + abs(self.of("omegay")), 1e-3)

    def test_oblique_edge(self):
        angle = 0.3    # the lower edge is at r = (-s, -c), both of its ends touch
        c = 0.5 * (math.cos(angle) + math.sin(angle))
        s = 0.5 * (math.cos(angle) - math.sin(angle))
        end = self.impact((0, 1, 0), angle, c, steps=4000 + 2000)
        impulse = 2.0 / (1.0 + 6.0 * s * s)
        print(f"oblique edge: v = {self.of('vz'):.5f}, by hand {impulse - 1:.5f}; "
              f"omega = {self.of('omegay'):.5f}, by hand {6 * s * impulse:.5f}")
        self.assertAlmostEqual(self.of("vz"), impulse - 1.0, delta=5e-3)
        self.assertAlmostEqual(abs(self.of("omegay")), 6.0 * s * impulse, delta=2e-2)
        self.assertAlmostEqual(end["f_s[1]"] + end["f_s[2]"], 0.5, delta=2e-4)

    def test_oblique_corner_rounded(self):
        # cores of 0.8 rounded by 0.1: the corner's ball touches; its volume and moments are those of the fix
        end = self.impact((0.6, 0.8, 0), 0.7, 0.78, spec="box 0.8 0.8 0.8 rounded 0.1", steps=40000)
        self.assertGreater(end["f_s[2]"], 0.02)
        start = thermo(self.log)[0]
        self.assertAlmostEqual(end["f_s[1]"] + end["f_s[2]"], start["f_s[1]"], delta=3e-4)

    def test_restitution(self):
        # damped flat impact: four points in parallel, each with a quarter of the mass in its contact
        self.impact((0, 0, 1), 0.0, 0.5, law="hooke 1e6 100")
        flat = self.of("vz")
        self.assertLess(flat, 0.95)
        self.assertGreater(flat, 0.1)


class Pairs(ShapeCase):

    def both(self, spec, first, second, steps=30000, **options):
        """Two bodies of types 1 and 2 collide without friction: energy and momentum are kept."""
        rows = self.simulate([first, second], f"fix s all shape/gran {spec}", steps, dt=2e-5, pair="hooke 1e6 0",
                             every=20, **options)
        start, end = rows[0], rows[-1]
        energy = [row["f_s[1]"] + row["f_s[2]"] for row in (start, end)]
        self.assertGreater(max(row["f_s[6]"] for row in rows), 0.9, "they touch")
        self.assertEqual(end["f_s[6]"], 0.0)
        print(f"{self.id().split('.')[-1]}: energy {energy[1] / energy[0] - 1:.2e}")
        self.assertAlmostEqual(energy[1], energy[0], delta=5e-4 * energy[0])
        return rows

    def momentum(self, masses):
        return [sum(m * self.of(f"v{d}", tag) for tag, m in masses.items()) for d in "xyz"]

    def test_two_boxes(self):
        for name, turn in (("corner", quat((0.6, 0.8, 0), 0.9)), ("edges", quat((0.8, 0, 0.6), 0.5)),
                           ("faces", "quat 1 0 0 0")):
            with self.subTest(name):
                self.both(f"type 1 box 1 1 1 density 1 type 2 box 1 0.8 1.2 density 2 orient {turn}",
                          Sphere((0, 0, 0), v=(0.2, 0, 1)), Sphere((0.15, 0.1, 1.6), v=(0, 0, -1), type=2), size=9.0)
                self.assertGreater(self.of("vz", 2), self.of("vz", 1))
                total = self.momentum({1: 1.0, 2: 1.92})
                for value, expected in zip(total, (0.2, 0.0, 1 - 1.92)):
                    self.assertAlmostEqual(value, expected, delta=1e-10)

    def test_rounded_tetrahedra(self):
        corner = "vertices 4 1 1 1 1 -1 -1 -1 1 -1 -1 -1 1 scale 0.5 rounded 0.1 density 1"
        self.both(f"type 1 {corner} type 2 {corner} orient {quat((0, 0, 1), 0.4)}",
                  Sphere((0, 0, 0), v=(0, 0, 1), omega=(0, 1, 0)), Sphere((0.3, 0.1, 1.8), v=(0, 0, -1), type=2))


    def test_mpr_has_one_point(self):
        points = {}
        if os.environ["TALUS_CCD"] == "0":
            return    # style/test_shape_errors asks for the message
        for way in "features", "mpr":
            rows = self.simulate([Sphere((0, 0, 0), v=(0, 0, 1)), Sphere((0.15, 0.1, 1.6), v=(0, 0, -1), type=2)],
                                 "fix s all shape/gran type 1 box 1 1 1 density 1 type 2 box 1 0.8 1.2 density 2 "
                                 f"contacts {way}", 30000, dt=2e-5, pair="hooke 1e6 0", every=20, size=9.0)
            points[way] = max(row["f_s[7]"] for row in rows)
            self.assertGreater(self.of("vz", 2), self.of("vz", 1))
            self.assertAlmostEqual(rows[-1]["f_s[1]"] + rows[-1]["f_s[2]"], 1.46, delta=0.02)
            for value, expected in zip(self.momentum({1: 1.0, 2: 1.92}), (0.0, 0.0, 1 - 1.92)):
                self.assertAlmostEqual(value, expected, delta=1e-10)
        self.assertEqual(points, {"features": 4.0, "mpr": 1.0})


class SphereOnBox(ShapeCase):

    def test_impact(self):
        # a sphere of mass pi/6 on the face of a box, off its center by 0.3: J = 2 v/(1/m1 + 1/m2 + |r x n|^2/I)
        write = [Sphere((0.3, 0, 1.05), v=(0, 0, -1.0)), Sphere((0, 0, 0), type=2)]
        rows = self.simulate(write, "group balls type 1\nfix 1 balls nve/sphere/symplectic\n"
                             "fix s all shape/gran type 2 box 1 1 1 density 1", 8000, dt=1e-5, pair="hooke 1e6 0",
                             every=100)
        m1, m2, inertia = math.pi / 6, 1.0, 1 / 6
        impulse = 2.0 / (1 / m1 + 1 / m2 + 0.3 ** 2 / inertia)
        print(f"sphere on box: v = {self.of('vz'):.5f}, by hand {impulse / m1 - 1:.5f}")
        self.assertAlmostEqual(self.of("vz"), impulse / m1 - 1.0, delta=2e-3)
        self.assertAlmostEqual(self.of("vz", 2), -impulse / m2, delta=2e-3)
        self.assertAlmostEqual(abs(self.of("omegay", 2)), 0.3 * impulse / inertia, delta=1e-2)
        self.assertAlmostEqual(rows[-1]["KinEng"] + rows[-1]["f_s[2]"], 0.5 * m1, delta=1e-3)

    def test_face_edge_and_corner_carry_it(self):
        # a box that does not move; gravity 1; overlap = m g/k at rest
        for x, y, z in ((0.2, 0.1, 1.0), ):
            self.simulate([Sphere((x, y, z)), Sphere((0, 0, 0), type=2)],
                          "group balls type 1\nfix 1 balls nve/sphere/symplectic\n"
                          "fix g balls gravity/talus 1 vector 0 0 -1\n"
                          "fix s balls shape/gran type 2 box 1 1 1 density 1", 20000, dt=1e-3, pair="hooke 1e4 20")
            self.assertAlmostEqual(self.of("z"), 1.0 - math.pi / 6 / 1e4, delta=1e-7)
            self.assertEqual(self.of("z", 2), 0.0)


class Drum(ShapeCase):

    def test_cube_in_a_cylinder(self):
        # at rest on four corners; the normal forces N lean: 4 N low/R = m g
        radius, stiffness = 2.0, 1e5
        low = math.sqrt(radius ** 2 - 0.25)
        for spec, reach in ("box 1 1 1", radius), ("box 0.8 0.8 0.8 rounded 0.1", 0.1 + math.hypot(0.4, low - 0.1)):
            law = f"hooke {stiffness} 100"
            self.simulate([Sphere((0, 0, 0.5 - low))],
                          f"fix s all shape/gran type 1 {spec} density 1\nfix g all gravity/talus 10 vector 0 0 -1\n"
                          f"fix drum all large/body cylinder 0 0 0 1 0 0 {reach!r} 6 inside contact {law}",
                          40000, dt=2e-4, pair=law, extra="fx fy fz")
            edge = low if spec == "box 1 1 1" else low - 0.1
            mass = 1.0 if spec == "box 1 1 1" else 0.512 + 6 * 0.1 * 0.64 + 2.4 * math.pi * 0.01 + math.pi * 0.004 / 3
            lean = edge / math.hypot(0.5 if spec == "box 1 1 1" else 0.4, edge)
            self.assertAlmostEqual(self.of("z"), 0.5 - low - mass * 10 / 4 / lean / stiffness / lean, delta=1e-6)
            self.assertLess(abs(self.of("vz")), 1e-8)

    def test_caps(self):
        self.simulate([Sphere((0.4, 0, 0), v=(1, 0, 0))], "fix s all shape/gran type 1 box 1 1 1 density 1\n"
                      "fix drum all large/body cylinder 0 0 0 1 0 0 2 2 inside contact hooke 1e6 0",
                      10000, dt=2e-5)
        self.assertAlmostEqual(self.of("vx"), -1.0, delta=2e-3)
        self.assertAlmostEqual(self.of("x"), 0.4, delta=5e-3)


class Slopes(ShapeCase):
    """A cube on a plane, gravity inclined."""

    def on_slope(self, tangent, mu, steps, law="hooke 1e5 200 tangential multistep NULL NULL {mu}"):
        law = law.format(mu=mu)
        angle = math.atan(tangent)
        rows = self.simulate([Sphere((0, 0, 0.5))],
                             f"fix s all shape/gran type 1 box 1 1 1 density 1\n{FLOOR.format(law=law)}\n"
                             f"fix g all gravity/talus 10 vector {math.sin(angle)!r} 0 {-math.cos(angle)!r}",
                             steps, dt=1e-4, pair=law, every=steps // 4)
        return angle, rows

    def test_sticks_and_slides(self):
        self.on_slope(0.45, 0.5, 20000)
        self.assertLess(self.of("x"), 1e-3)
        self.assertLess(abs(self.of("vx")), 1e-6)
        angle, _ = self.on_slope(0.6, 0.5, 10000)
        expected = 10 * (math.sin(angle) - 0.5 * math.cos(angle)) * 1.0
        print(f"slide: v = {self.of('vx'):.5f}, by hand {expected:.5f}")
        self.assertAlmostEqual(self.of("vx"), expected, delta=0.01 * expected)
        self.assertLess(abs(self.of("omegay")), 1e-3)

    def test_topples(self):
        self.on_slope(0.95, 2.0, 10000)
        self.assertLess(abs(self.of("omegay")), 1e-4)
        self.on_slope(1.05, 2.0, 10000)
        self.assertGreater(self.of("omegay"), 0.1)


class Rolling(ShapeCase):

    def test_prism_on_a_slope(self):
        # corner after corner strikes and stays: before an impact w^2 = 4 g s sin(slope)/((c + 1) R (1 - p^2)), after it p w,
        # with s = sin(pi/n), c = I/(m R^2) = (2 + cos(2 pi/n))/6, p = (c + cos(2 pi/n))/(c + 1)
        n, slope = 8, 0.3
        corners = [(math.sin(2 * math.pi * (k + 0.5) / n), y, math.cos(2 * math.pi * (k + 0.5) / n))
                   for k in range(n) for y in (-0.5, 0.5)]
        words = " ".join(f"{c:.15g}" for corner in corners for c in corner)
        law = "hooke 2e5 300 tangential multistep NULL NULL 1.0"
        rows = self.simulate([Sphere((-12, 0, math.cos(math.pi / n)), omega=(0, 2.3, 0), v=(2.3 * math.cos(math.pi / n), 0, 0))],
                             f"fix s all shape/gran type 1 vertices {2 * n} {words} density 1\n{FLOOR.format(law=law)}\n"
                             f"fix g all gravity/talus 10 vector {math.sin(slope)!r} 0 {-math.cos(slope)!r}",
                             50000, dt=1e-4, pair=law, every=10)
        around = math.cos(2 * math.pi / n)
        c = (2 + around) / 6
        kept = (c + around) / (c + 1)
        before = math.sqrt(40 * math.sin(math.pi / n) * math.sin(slope) / ((c + 1) * (1 - kept ** 2)))
        inertia = c * n / 2 * math.sin(2 * math.pi / n)
        late = [row["f_s[4]"] / inertia for row in rows[len(rows) // 2:]]
        print(f"rolling prism: omega {min(late):.3f} to {max(late):.3f}, by hand {kept * before:.3f} to {before:.3f}")
        self.assertAlmostEqual(max(late), before, delta=0.03 * before)


class Bodies(ShapeCase):

    def test_rest_on_bodies(self):
        # the height of the center of a cube, less the overlap; in the cylinder its lower edges touch
        law = "hooke 1e5 200 tangential multistep NULL NULL 0.5"
        for body, z in (("plane 0 0 0 0 0 1", 0.5), ("box 0 0 -1 4 4 2 outside", 0.5), ("box 0 0 4 8 8 8 inside", 0.5),
                        ("sphere 0 0 -2 2 outside", 0.5), ("cylinder 0 0 -1 0 0 1 3 2 outside", 0.5),
                        ("cylinder 0 0 -2 0 1 0 2 8 outside", 0.5), ("cone 0 0 -1 0 0 1 3 2 2 outside", 0.5),
                        ("cylinder 0 0 5 0 1 0 5 8 inside", 0.5 + 5.0 - math.sqrt(25.0 - 0.25))):
            with self.subTest(body):
                rows = self.simulate([Sphere((0, 0, z))],
                                     f"fix s all shape/gran type 1 box 1 1 1 density 1\n"
                                     f"fix body all large/body {body} contact {law}\n"
                                     "fix g all gravity/talus 10 vector 0 0 -1", 20000, dt=2e-4, pair=law,
                                     columns=VECTOR + " f_body[3]")
                self.assertAlmostEqual(self.of("z"), z, delta=2e-4)
                self.assertLess(self.of("z"), z)
                self.assertLess(rows[-1]["f_s[1]"] + rows[-1]["f_s[2]"], 1e-12)
                self.assertAlmostEqual(rows[-1]["f_body[3]"], -10.0, delta=1e-6)

    def test_stands_or_falls_at_an_edge(self):
        # the edge of a box at x = 2: what has its center beyond it topples; rounded, up to .03 of it is held (page)
        law = "hooke 1e5 200 tangential multistep NULL NULL 0.5"
        for shape in "box 1 1 1", "box .9 .9 .9 rounded .05":
            for x, stands in ((1.95, True), (2.05, False)):
                with self.subTest(shape, x=x):
                    self.simulate([Sphere((x, 0.1, 0.5))],
                                  f"fix s all shape/gran type 1 {shape} density 1\n"
                                  f"fix body all large/body box -1 0 -.5 6 8 1 outside contact {law}\n"
                                  "fix g all gravity/talus 10 vector 0 0 -1", 15000, dt=2e-4, pair=law, size=100.0)
                    self.assertEqual(self.of("z") > 0.49, stands)


class Stacks(ShapeCase):

    def test_three_cubes(self):
        law = "hooke 1e5 100 tangential multistep NULL NULL 0.5"
        for rounded in ("box 1 1 1", "box 0.9 0.9 0.9 rounded 0.05"):
            with self.subTest(rounded):
                rows = self.simulate([Sphere((0.05 * k, 0.03 * k, 0.5 + 1.0 * k)) for k in range(3)],
                                     f"fix s all shape/gran type 1 {rounded} density 1\n{FLOOR.format(law=law)}\n"
                                     "fix g all gravity/talus 10 vector 0 0 -1", 60000, dt=2e-4, pair=law, every=20000)
                print(f"stack of {rounded}: energies {rows[-1]['f_s[1]']:.1e} {rows[-1]['f_s[2]']:.1e}, "
                      f"{rows[-1]['f_s[6]']:.0f} pairs, {rows[-1]['f_s[7]']:.0f} points")
                self.assertLess(rows[-1]["f_s[1]"] + rows[-1]["f_s[2]"], 1e-12)
                self.assertEqual(rows[-1]["f_s[6]"], 2.0)
                for k in range(3):
                    self.assertAlmostEqual(self.of("z", k + 1), 0.5 + k, delta=1e-3)
                    self.assertAlmostEqual(self.of("x", k + 1), 0.05 * k, delta=1e-3)

    def test_wall(self):
        # the short form of 100 cubes for 10^6 steps: once it has settled nothing creeps
        law = "hooke 1e5 60 tangential multistep NULL NULL 0.5"
        for rounded in ("box 1 1 1", "box 0.9 0.9 0.9 rounded 0.05"):
            with self.subTest(rounded):
                places = []
                for end in 30000, 40000:
                    self.simulate([Sphere((1.002 * c + 0.25 * (k % 2), 0.0, 0.5 + k)) for k in range(4) for c in range(3)],
                                  f"fix s all shape/gran type 1 {rounded} density 1\n{FLOOR.format(law=law)}\n"
                                  "fix g all gravity/talus 10 vector 0 0 -1", end, dt=2e-4, pair=law)
                    places.append([self.of(d, k) for k in range(1, 13) for d in "xyz"])
                creep = max(abs(a - b) for a, b in zip(*places))
                print(f"wall of {rounded}: creep {creep:.1e} in 10^4 steps")
                self.assertLess(creep, 1e-6)
                for k in range(12):
                    self.assertAlmostEqual(self.of("z", k + 1), 0.5 + k // 3, delta=2e-3)


if __name__ == "__main__":
    unittest.main()
