# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=20
"""Contacts with large bodies are of second order in the time step with `order 2`, where their normal turns and where
they move: errors against a solution with a small time step, over several spheres that touch at different moments within
a step. The limit must be that of order 1, which has none of what makes the order two."""

import math
import random
import unittest

import body_meshes
import body_reference
from talus_testing import SceneCase, Sphere, begin, read_dump, write_sphere_data

LAW = "hertz 2.0e4 300.0 tangential multistep NULL NULL 0.3 slider midpoint limit_damping"
DETACHING = "jkr 2.0e4 300.0 0.3 0.3 tangential mindlin NULL 0.0 0.3"
COUNT = 8    # spheres in a row along y, 2 from each other
SCENE = begin(law="{law}", skin=0.5) + f"""
fix step all nve/sphere/symplectic {{order}} gravity 10 vector 0 0 -1
{{body}}
timestep {{dt!r}}
thermo 100000
run {{steps}}
write_dump all custom {{name}} id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz mass radius &
modify format float %.17g
"""


class OrderCase(SceneCase):
    steps = (128, 2048)
    exact_steps = 16384
    old_steps = 32768    # of order 1
    law = LAW

    def write(self, x, z, v=(1.0, 0.5, -0.5), w=(0.0, 3.0, 1.0), number=COUNT):
        draw = random.Random(3)

        def near(center, size):
            return tuple(c + draw.uniform(-size, size) for c in center)
        spheres = [Sphere(near((x, 2.0 * k - COUNT, z), 0.03), near(v, 0.1), near(w, 0.1), density=1.0, diameter=1.0)
                   for k in range(number)]
        write_sphere_data(self.path("data"), ((-20, 20), (-20, 20), (-20, 20)), spheres)

    def end(self, body, time, steps, order="order 2", output=None):
        """Positions, velocities and angular velocities times radius of all spheres at the end."""
        name, dt = f"end{steps}", time / steps
        self.run_lammps(SCENE.format(law=self.law, body=body, order=order, dt=dt, steps=steps, name=name), name=f"run{steps}")
        at, = read_dump(self.path(name))
        values = {key: at.column(key) for key in at.columns}
        found = []
        for n in at.atoms:
            v = {key: values[key][n] for key in values}
            inertia = 0.4 * v["mass"] * v["radius"]**2
            for d in "xyz":
                weight = -10.0 if d == "z" else 0.0
                found.append(v[d])
                found.append(v["v" + d] + 0.5 * dt * (v["f" + d] / v["mass"] + weight))
                found.append(v["radius"] * (v["omega" + d] + 0.5 * dt * v["tq" + d] / inertia))
        return found

    @staticmethod
    def error(a, b):
        return math.sqrt(sum((p - q)**2 for p, q in zip(a, b)) / (len(a) / 9))

    def assert_second_order(self, body, time, least=1.8, old_limit=2.0e-3):
        body = body.replace("LAW", self.law)
        exact = self.end(body, time, self.exact_steps)
        coarse, fine = (self.error(self.end(body, time, n), exact) for n in self.steps)
        order = math.log(coarse / fine) / math.log(self.steps[1] / self.steps[0])
        self.assertGreater(order, least, f"{body}: {coarse:.2e} {fine:.2e}")
        if old_limit:
            old = self.error(self.end(body, time, self.old_steps, "start half"), exact)
            self.assertLess(old, old_limit, body)
        return fine


def folded(*profile):
    """The surface above a line in the x-z plane, on whose left it faces."""
    return body_meshes.grid(lambda i, j: (profile[i][0], 12.0 - 24.0 * j, profile[i][1]), len(profile) - 1, 1)


class NormalsThatTurn(OrderCase):

    def mesh(self, *profile):
        body_meshes.write_stl(self.path("m.stl"), folded(*profile))
        return "fix b all large/body mesh m.stl contact LAW"

    def test_round_surfaces(self):
        self.write(0.5, -1.3)
        self.assert_second_order("fix b all large/body cylinder 0 0 0 0 1 0 2 INF inside contact LAW", 0.5)
        self.write(0.0, 0.55)
        self.assert_second_order("fix b all large/body cylinder 0 0 -1 0 1 0 1 INF open contact LAW", 0.4)
        self.assert_second_order("\n".join(
            f"fix b{k} all large/body sphere 0 {2 * k - COUNT} -1 1 outside contact LAW" for k in range(COUNT)), 0.4)
        self.write(1.2, 0.6, (0.3, 1.5, -0.5), number=1)
        self.assert_second_order(f"fix b all large/body cone 0 {-COUNT} 0 0 0 1 1 3 4 open contact LAW", 0.4)

    def test_without_friction(self):
        self.write(0.5, -1.3)
        self.assert_second_order("fix b all large/body cylinder 0 0 0 0 1 0 2 INF inside contact "
                                 "hertz 2.0e4 300 limit_damping", 0.5)

    def test_edges(self):
        self.write(0.8, 0.52)
        self.assert_second_order("fix b all large/body rectangle 0 0 0 0 0 1 1 0 0 2 40 contact LAW", 0.4)
        self.assert_second_order("fix b all large/body box 0 0 -1 2 40 2 outside contact LAW", 0.4)
        self.write(1.35, 0.54)
        self.assert_second_order("fix b all large/body box 0 0 4 4 40 8 inside contact LAW", 0.5)

    def test_meshes(self):
        self.write(-0.3, 0.56)
        self.assert_second_order(self.mesh((-3, 0), (0.1, 0), (0.4, 0), (3, 0)), 0.4)
        self.assert_second_order(self.mesh((-3, -3), (0, 0), (3, -3)), 0.4)
        self.assert_second_order(self.mesh((-3, 0), (0, 0), (3, 2.5)), 0.5)    # touches both facets

    def test_regions(self):
        self.write(0.5, -1.25)
        self.assert_second_order("region r cylinder y 0 0 2 EDGE EDGE\nfix b all large/body region r contact LAW", 0.5)

    def test_a_smooth_hollow_of_facets_has_jumps(self):
        """Going from facet to facet of one smooth patch the force changes its direction at once."""
        self.write(-0.1, 0.51, (1.0, 0.5, 0.0))
        fold = self.mesh((-3, 0), (0, 0), (3, 0.3))
        with self.assertRaises(AssertionError):
            self.assert_second_order(fold, 0.4)


class ContactsThatDetach(OrderCase):
    law = DETACHING

    def test_planes_and_round_surfaces(self):
        self.write(0.3, 0.52)
        self.assert_second_order("fix b all large/body plane 0 0 0 0 0 1 contact LAW", 0.4)
        self.write(0.5, -1.3)
        self.assert_second_order("fix b all large/body cylinder 0 0 0 0 1 0 2 INF inside contact LAW", 0.3)

    def test_bodies_with_several_contacts(self):
        self.write(0.3, 0.52)
        body_meshes.write_stl(self.path("m.stl"), folded((-3, 0), (0.35, 0), (3, 0)))
        self.assert_second_order("fix b all large/body mesh m.stl contact LAW", 0.4)
        body_meshes.write_stl(self.path("m.stl"), folded((-3, 3), (0, 0), (3, 3)))
        self.write(0.0, 0.73, (0.3, 0.5, -0.5))
        self.assert_second_order("fix b all large/body mesh m.stl contact LAW", 0.4)
        self.write(1.45, 0.54, (0.2, 0.5, -0.5))
        self.assert_second_order("fix b all large/body box 0 0 4 4 40 8 inside contact LAW", 0.4)

    def test_prescribed_motion(self):
        self.write(0.3, 0.56)
        self.assert_second_order("fix b all large/body plane 0 0 0 0 0 1 contact LAW move wiggle 0.05 0.02 0.03 0.3", 0.4)


class BodiesThatMove(OrderCase):

    def test_prescribed(self):
        self.write(0.3, 0.56)
        plane = "fix b all large/body plane 0 0 0 0 0 1 contact LAW"
        self.assert_second_order(f"{plane} move wiggle 0.05 0.02 0.03 0.3", 0.4)
        self.assert_second_order(f"{plane} move rotate 0.2 0 0 0 0 1 2", 0.4)
        sine = "variable z equal 0.03*sin(20*step*dt)\nvariable vz equal 0.6*cos(20*step*dt)\n"
        self.assert_second_order(f"{sine}{plane} move variable NULL NULL v_z NULL NULL v_vz", 0.4)
        self.assert_second_order(f"{sine}region r plane 0 0 0 0 0 1 move NULL NULL v_z\n"
                                 "fix b all large/body region r contact LAW", 0.4)

    def test_drums(self):
        self.write(0.3, 0.56)
        drum = "fix b all large/body cylinder 0 0 2 0 1 0 2 INF inside contact LAW move rotate 0 0 2 0 1 0 3"
        self.assert_second_order(drum, 0.5)
        box = "fix b all large/body box 0 0 4 4 40 8 inside contact LAW move rotate 0 0 4 0 1 0 3"
        self.assert_second_order(box, 0.4, old_limit=2.0e-2)

    def test_free(self):
        self.write(0.3, 0.56)
        self.assert_second_order("fix b all large/body box 0 0 -1 4 18 2 outside contact LAW move free mass 2 "
                                 "inertia 20 8 22 velocity 0 0 0.2 spin 1 .3 0", 0.4)
        self.write(0.1, 0.53, number=1)
        self.assert_second_order(f"fix b all large/body sphere 0 {-COUNT} -2 2 outside contact LAW move free mass 1 "
                                 "inertia 1 2 1.5 velocity 0 0 0.2 spin 1 2 0", 0.4)

    def test_servo(self):
        self.write(0.3, 0.51, (1.0, 0.5, 0.0))
        self.steps = 512, 4096    # above its limit of stability at less
        self.assert_second_order("fix f all large/body plane 0 0 0 0 0 1 contact LAW\n"
                                 "fix b all large/body rectangle 0 0 1.2 0 0 -1 1 0 0 10 40 contact LAW "
                                 "servo force 0 0 -1 20 0.5", 0.4)

    def test_belts(self):
        self.write(-0.1, 0.51, (0.5, 0.1, 0.0))
        self.assert_second_order("fix b all large/body rectangle -2 0 0 0 0 1 1 0 0 4 40 contact LAW "
                                 "surface_velocity 1 0.5 0", 0.4)
        body_meshes.write_stl(self.path("m.stl"), folded((-3, -0.5), (0, 0), (3, -0.5)))
        self.assert_second_order("fix b all large/body mesh m.stl contact LAW surface_velocity 1 0.5 0.3", 0.3)


class LimitOfTheReference(OrderCase):
    """The engine with a moderate time step against the limit of a slow program of first order."""

    def assert_limit(self, body, surface, x, v, time):
        sphere = Sphere(x, v, (0.0, 3.0, 1.0), density=1.0, diameter=1.0)
        write_sphere_data(self.path("data"), ((-20, 20), (-20, 20), (-20, 20)), [sphere])
        expected = body_reference.limit(sphere, surface, time, 16000, kn=2.0e4, gn=300.0, mu=0.3)
        found = self.end(body.replace("LAW", LAW), time, 4096)
        # position, velocity and spin by component, in this order
        found = [found[3 * d + k] for k in range(3) for d in range(3)]
        self.assertLess(self.error(expected, found), 1.0e-4, f"{body}: {expected} {found}")

    def test_edge(self):
        def surface(t, x):
            beyond = max(x[0] - 1.0, 0.0)
            height = math.hypot(beyond, x[2])
            return (beyond / height, 0.0, x[2] / height), height, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
        self.assert_limit("fix b all large/body rectangle 0 0 0 0 0 1 1 0 0 2 40 contact LAW", surface,
                          (0.8, 0.0, 0.52), (1.0, 0.5, -0.5), 0.4)

    def test_drum(self):
        rate = 2.0 * math.pi / 3.0

        def surface(t, x):
            a, c = x[0], x[2] - 2.0
            r = math.hypot(a, c)
            return (-a / r, 0.0, -c / r), 2.0 - r, (rate * c, 0.0, -rate * a), (0.0, rate, 0.0)
        self.assert_limit("fix b all large/body cylinder 0 0 2 0 1 0 2 INF inside contact LAW move rotate 0 0 2 0 1 0 3",
                          surface, (0.3, 0.1, 0.56), (1.0, 0.5, -0.5), 0.4)

    def test_turntable(self):
        rate = math.pi

        def surface(t, x):
            return (0.0, 0.0, 1.0), x[2], (-rate * x[1], rate * (x[0] - 0.2), 0.0), (0.0, 0.0, rate)
        self.assert_limit("fix b all large/body plane 0 0 0 0 0 1 contact LAW move rotate 0.2 0 0 0 0 1 2", surface,
                          (0.3, 0.1, 0.51), (1.0, 0.5, 0.0), 0.4)

    def test_shaker(self):
        rate = 2.0 * math.pi / 0.3

        def surface(t, x):
            speed = rate * math.cos(rate * t)
            return ((0.0, 0.0, 1.0), x[2] - 0.03 * math.sin(rate * t),
                    (0.05 * speed, 0.02 * speed, 0.03 * speed), (0.0, 0.0, 0.0))
        self.assert_limit("fix b all large/body plane 0 0 0 0 0 1 contact LAW move wiggle 0.05 0.02 0.03 0.3", surface,
                          (0.3, 0.1, 0.56), (1.0, 0.5, -0.5), 0.4)


if __name__ == "__main__":
    unittest.main()
