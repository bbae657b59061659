# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""Clumps with `order 2`: errors of second order in the time step where contacts have damping and friction, against a
solution with a small time step; that one against the limit of a slow program of first order, which shares no code. Positions
of all spheres are compared, a while after the impacts."""

import math
import random
import unittest

import clump_reference
from talus_testing import SceneCase, Sphere, head, read_dump, write_sphere_data
from tossed_clumps import DIAMETERS, PLACES, random_rotation

LAW = "hertz 2.0e4 300.0 tangential multistep NULL NULL 0.3 slider midpoint limit_damping"
FLOOR = "fix floor all large/body plane 0 0 0  0 0 1 contact LAW"
DUMBBELL = ((-0.4, 0.0, 0.0), (0.4, 0.0, 0.0)), (1.0, 1.0)
TRIANGLE = PLACES, DIAMETERS
SCENE = head() + """
fix prop all property/atom mol ghost yes
read_data data fix prop NULL Molecules
group clumps molecule > 0
group singles subtract all clumps
neighbor 0.5 bin
neigh_modify every 1 delay 0 check yes exclude molecule/intra clumps
pair_style gran/penalty
pair_coeff * * {law}
fix step clumps rigid/small/symplectic molecule {order} gravity {gravity!r} vector 0 0 -1
fix step1 singles nve/sphere/symplectic {order} gravity {gravity!r} vector 0 0 -1
{body}
timestep {dt!r}
thermo 100000
thermo_style custom step
run {steps}
write_dump all custom {name} id x y z modify format float %.17g
"""


class ClumpOrder(SceneCase):

    def setUp(self):
        self.draw = random.Random(4)
        self.groups = []

    def place(self, center, v, omega, clump=DUMBBELL):
        """One more clump in rigid motion, turned at random; `clump`: places and diameters of its spheres."""
        places, diameters = clump
        masses = [d**3 for d in diameters]
        middle = [sum(m * p[k] for m, p in zip(masses, places)) / sum(masses) for k in range(3)]
        turn, spheres = random_rotation(self.draw), []
        for place, diameter in zip(places, diameters):
            arm = [sum(a * (p - c) for a, p, c in zip(row, place, middle)) for row in turn]
            cross = (omega[1] * arm[2] - omega[2] * arm[1], omega[2] * arm[0] - omega[0] * arm[2],
                     omega[0] * arm[1] - omega[1] * arm[0])
            spheres.append(Sphere(tuple(c + a for c, a in zip(center, arm)), tuple(a + b for a, b in zip(v, cross)),
                                  tuple(omega), diameter, density=1.0))
        self.groups.append(spheres)

    def write(self):
        spheres = [s for group in self.groups for s in group]
        for n, sphere in enumerate(spheres):
            sphere.id = n + 1
        write_sphere_data(self.path("data"), ((-20, 20),) * 3, spheres)
        with open(self.path("data"), "a") as file:
            file.write("\nMolecules\n\n")
            for m, group in enumerate(self.groups):
                for sphere in group:
                    file.write(f"{sphere.id} {m + 1 if len(group) > 1 else 0}\n")

    def end(self, body, time, steps, order="order 2", law=LAW, gravity=10.0):
        name = f"end{steps}"
        self.run_lammps(SCENE.format(body=body.replace("LAW", law), order=order, dt=time / steps, steps=steps, name=name,
                                     law=law, gravity=gravity), name=f"run{steps}")
        at, = read_dump(self.path(name))
        columns = [at.column(c) for c in "xyz"]
        return [tuple(c[n] for c in columns) for n in sorted(at.atoms)]

    @staticmethod
    def error(a, b):
        return math.sqrt(sum((p - q)**2 for x, y in zip(a, b) for p, q in zip(x, y)) / len(a))

    def assert_second_order(self, body, time, steps=(256, 2048), gravity=10.0, law=LAW, reference=5.0e-5, reference_steps=8000):
        self.write()
        exact = self.end(body, time, 16384, gravity=gravity, law=law)
        coarse, fine = (self.error(self.end(body, time, n, gravity=gravity, law=law), exact) for n in steps)
        order = math.log(coarse / fine) / math.log(steps[1] / steps[0])
        old = self.error(self.end(body, time, steps[1], "start half", gravity=gravity, law=law), exact)
        print(f"{self.id().split('.')[-1]}: {coarse:.1e} {fine:.1e}, order {order:.2f}; order 1: {old:.1e}")
        self.assertGreater(order, 1.8)
        if reference:
            self.assertLess(fine, 0.2 * old)
            expected = clump_reference.limit(self.groups, bool(body), time, reference_steps, kn=2.0e4, gn=300.0, mu=0.3,
                                             gravity=gravity)
            error = self.error(expected, exact)
            print(f"    reference: {error:.1e}")
            self.assertLess(error, reference)

    def test_a_dumbbell_on_a_floor(self):
        self.place((0.0, 0.0, 1.0), (1.0, 0.5, -0.5), (0.0, 3.0, 1.0))
        self.assert_second_order(FLOOR, 0.4)

    def test_two_clumps_that_meet_askew(self):
        self.place((0.0, 0.0, 5.0), (1.0, 0.5, -0.5), (0.0, 3.0, 1.0), TRIANGLE)
        self.place((1.6, 0.3, 5.0), (-1.0, 0.5, -0.3), (2.0, 0.0, -1.0), TRIANGLE)
        self.assert_second_order("", 0.6, gravity=0.0)

    def test_clumps_and_spheres(self):
        for k in range(6):
            self.place((1.7 * (k % 2) + 0.01 * k, 1.7 * (k // 2 % 2), 1.2 + 1.7 * (k // 4)), (0.3 * (-1)**k, 0.2, -1.0),
                       (0.0, 3.0, 1.0), TRIANGLE if k % 3 else DUMBBELL)
        self.place((0.8, 0.8, 2.6), (0.0, 0.0, -1.0), (0.0, 0.0, 2.0), (((0.0, 0.0, 0.0),), (0.8,)))
        self.assert_second_order(FLOOR, 0.5, reference=None)

    def test_without_friction_and_without_damping(self):
        self.place((0.0, 0.0, 1.0), (1.0, 0.5, -0.5), (0.0, 3.0, 1.0))
        self.assert_second_order(FLOOR, 0.4, law="hertz 2.0e4 300 limit_damping", reference=None)
        self.assert_second_order(FLOOR, 0.4, law="hertz 2.0e4 0", reference=None)


if __name__ == "__main__":
    unittest.main()
