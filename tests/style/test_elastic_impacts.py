# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""The warning about scenes without damping and friction: at time steps with which impacts keep less than 1e-3 of their
energy in order, and not elsewhere."""

import math
import re
import unittest

import body_meshes
from talus_testing import SceneCase, Sphere, begin, read_dump, write_sphere_data

ELASTIC = r"WARNING: Pair style gran/penalty: no contact has damping or friction: at this time step, (\S+) of the critical one, " \
          r"impacts of (.*) gain or lose some energy by chance, which adds up over many: use at most (\S+) of it"

SCRIPT = begin("si", skin=0.1) + """
{pairs}
fix move all nve/sphere/symplectic start {start}
{more}
timestep {dt!r}
thermo 1000
run {steps}
write_dump all custom end id vx vy vz modify format float %.17g
"""

R, MASS, YOUNG = 0.5, 1000.0 * math.pi / 6, 1e7
STIFFNESS = YOUNG / (1 - 0.3**2) * math.sqrt(R / 2 * 0.01 * R)      # of the Hertzian contact at an overlap of .01 r
CRITICAL = math.sqrt(MASS / 2 / STIFFNESS)
DEEP = 3.0                                                          # m/s: overlaps of .09 r

LAWS = {"linear": (f"hooke {STIFFNESS!r} {{damping}}", 0.03), "Hertz": (f"hertz/material {YOUNG!r} {{e}} 0.3", 0.07)}


def law(name, e=1.0, words=""):
    ratio = -math.log(e) / math.hypot(math.pi, math.log(e))
    return LAWS[name][0].format(e=e, damping=2 * ratio / CRITICAL) + " " + words


class ElasticImpacts(SceneCase):

    def impacts(self, coefficients, fraction, speed=DEEP, count=40, np=1, steps=None, more="", pairs=None, start="plain"):
        """Pairs of spheres collide head-on, each at another moment within a step. Largest error of a pair's energy."""
        spheres, dt = [], fraction * CRITICAL
        for n in range(count):
            gap = speed * dt * (1 + (n + 0.5) / count)
            spheres += [Sphere((side * (R + gap / 2), 1.5 * n, 0), (-side * speed / 2, 0, 0), density=1000.0) for side in (-1, 1)]
        write_sphere_data(self.path("data"), ((-5, 5), (-3, 1.5 * count + 3), (-3, 3)), spheres, types=2)
        if steps is None:
            steps = math.ceil(6 / fraction)
        script = SCRIPT.format(pairs=pairs or f"pair_coeff * * {coefficients}", dt=dt, steps=steps, more=more, start=start)
        self.log = self.run_lammps(script, np=np).log
        frame, = read_dump(self.path("end"))
        v = [frame.atoms[tag][1] for tag in sorted(frame.atoms)]
        return max(abs((a * a + b * b) / (speed * speed / 2) - 1) for a, b in zip(v[::2], v[1::2]))

    def said(self):
        found = re.findall(ELASTIC, self.log)
        self.assertLessEqual(len(found), 1)
        return found[0] if found else None

    def test_where_energy_goes_astray(self):
        for name, (_, limit) in LAWS.items():
            for start in "plain", "half":
                error = self.impacts(law(name), 0.199, start=start)
                print(f"{name}, start {start}, dt .199 critical: up to {error:.1e}")
                self.assertEqual(self.said(), ("0.199", "types 1 and 1", f"{limit:g}"))
                self.assertGreater(error, 1e-3, "a warning without reason")

    def test_where_it_does_not(self):
        for name, (_, limit) in LAWS.items():
            error = self.impacts(law(name), 0.99 * limit)
            print(f"{name}, dt {0.99 * limit:.3g} critical: up to {error:.1e}")
            self.assertIsNone(self.said())
            self.assertLess(error, 5e-4)
            self.impacts(law(name), 1.01 * limit, steps=1)
            self.assertIsNotNone(self.said())

    def test_order_2_makes_up_for_the_kinks(self):
        for name in LAWS:
            for fraction, limit in (0.199, 5e-6), (0.1, 1e-7):
                error = self.impacts(law(name), fraction, start="half order 2")
                print(f"{name}, order 2, dt {fraction:.3g} critical: up to {error:.1e}")
                self.assertIsNone(self.said())
                self.assertLess(error, limit)

    def test_order_2_at_bodies_that_are_touched_at_several_points(self):
        """As at a plane."""
        body_meshes.write_stl(self.path("wall.stl"), body_meshes.grid(lambda i, j: (-4.0, 7.0 * i - 3.1, 7.0 * j - 10.5), 9, 3))
        for name in LAWS:
            plane, order_1 = (self.bounces(name, "plane -4 0 0 1 0 0", start) for start in ("half order 2", "half"))
            for wall in "mesh wall.stl two-sided", "box 0 28 0 8 60 8 inside":
                error = self.bounces(name, wall, "half order 2")
                print(f"{name}, {wall}: up to {error:.1e}, order 1: {order_1:.1e}")
                self.assertIsNone(self.said())
                self.assertLess(error, 2e-5)
                self.assertAlmostEqual(error, plane, delta=1e-10)
            self.assertGreater(order_1, 1e-3)

    def bounces(self, name, wall, start, fraction=0.199, speed=DEEP / 2, count=40):
        """As impacts(), of single spheres with a wall at x = -4."""
        dt = fraction * CRITICAL
        spheres = [Sphere((-4.0 + R + speed * dt * (1 + (n + 0.5) / count), 1.5 * n, 0.1), (-speed, 0, 0), density=1000.0)
                   for n in range(count)]
        write_sphere_data(self.path("data"), ((-5, 5), (-3, 1.5 * count + 3), (-3, 3)), spheres)
        script = SCRIPT.format(pairs=f"pair_coeff * * {law(name)}", dt=dt, steps=math.ceil(9 / fraction), start=start,
                               more=f"fix wall all large/body {wall} contact {law(name)}")
        self.log = self.run_lammps(script).log
        frame, = read_dump(self.path("end"))
        return max(abs((row[1] / speed)**2 - 1) for row in frame.atoms.values())

    def test_what_loses_energy(self):
        friction = "tangential multistep NULL NULL 0.1"
        for name in LAWS:
            for what, coefficients in (("e = .99", law(name, 0.99)), ("friction", law(name, words=friction)),
                                       ("friction without memory", law(name, words="tangential dashpot 1.0 0.1"))):
                self.impacts(coefficients, 0.199, steps=1)
                self.assertIsNone(self.said(), f"{name}, {what}")
            self.impacts(law(name, 0.999), 0.199, steps=1)
            self.assertIsNotNone(self.said(), f"{name}: so little damping takes away less than the time step may add")

    def test_laws_of_pair_granular(self):
        """Friction without a spring is a share of the damping: of none. Contacts of jkr and bridges tear apart with a loss, and others
        remember."""
        material = f"{YOUNG!r} 0.0 0.3"
        for words, expected in ((f"hertz/material {material} damping none tangential linear_nohistory 1.0 0.5", True),
                                (f"hertz/material {material} damping none tangential mindlin NULL 0.0 0.5", False),
                                (f"hertz/material {material} damping none tangential mindlin 0.0 1.0 0.5", True),
                                (f"hertz/material {YOUNG!r} 0.99 0.3 damping tsuji", False),
                                (f"dmt {material} 0.0", True), (f"jkr {material} 0.0", True), (f"jkr {material} 1.0", False),
                                ("walton/braun 1e5 2e5 0.0", False), ("luding 1e5 2e5 0.0 0.1 0.0", False),
                                (f"eepa {YOUNG!r} 1.0 0.3 0.0 0.5 0.0 1.5 1.5", False),
                                (f"hertz {YOUNG!r} 0.0 adhesion willett 1.0 0 fraction 0.01", False)):
            self.impacts(words, 0.199, steps=1)
            self.assertEqual(self.said() is not None, expected, words)

    def test_all_contacts_of_the_scene_count(self):
        """Energy that one kind of contact loses is not kept by the others; types without particles do not touch."""
        pairs = f"pair_coeff 1 1 {law('Hertz')}\npair_coeff 1 2 {law('Hertz')}\npair_coeff 2 2 {law('Hertz', 0.5)}"
        self.impacts("", 0.199, pairs=pairs, steps=1)
        self.assertIsNotNone(self.said(), "there are no particles of type 2")
        floor = "fix floor all large/body plane -4 0 0 1 0 0 contact hertz 1e5 {}"
        for np in 1, 2:
            self.impacts(law("Hertz"), 0.199, more=floor.format(0.0), np=np, steps=1)
            self.assertIsNotNone(self.said())
            self.impacts(law("Hertz"), 0.199, more=floor.format(1e3), np=np, steps=1)
            self.assertIsNone(self.said())
        soft = "fix floor all large/body plane -4 0 0 1 0 0 contact hooke 1e3 0.0"
        self.impacts(law("Hertz"), 0.199, more=soft, steps=1)
        self.assertEqual(self.said()[1:], ("type 1 with fix large/body floor", "0.03"))


if __name__ == "__main__":
    unittest.main()
