# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Warnings about friction without damping: where impacts gain energy, and not elsewhere."""

import math
import re
import unittest

from talus_testing import SceneCase, Sphere, begin, read_dump, write_sphere_data

STEP = r"WARNING: Pair style gran/penalty: contacts of (.*) have a coefficient of friction of (\S+) and next to no damping: " \
       r"at this time step, (\S+) of the critical one,"
SPRING = r"WARNING: Pair style gran/penalty: contacts of (.*) have a coefficient of friction of ([^ ,]+)(?:, rolling resistance of " \
         r"(\S+))? and next to no damping: impacts gain energy at any time step"

SCRIPT = begin("si", skin=0.1) + """
{pairs}
fix move all nve/sphere/symplectic
{more}
timestep {dt!r}
thermo 1000
run {steps}
write_dump all custom end id vx vy vz omegax omegay omegaz modify format float %.17g
"""

R, DENSITY, YOUNG = 0.5, 1000.0, 1e7
MASS = DENSITY * math.pi / 6
# sqrt(m/k) of two spheres at an overlap of .01 r, the smallest of the three rules here
CRITICAL = math.sqrt(MASS / 2 / (YOUNG / (1 - 0.3**2) * math.sqrt(R / 2 * 0.01 * R)))


def energy(v, w):
    return 0.5 * MASS * sum(c * c for c in v) + 0.2 * MASS * R**2 * sum(c * c for c in w)


class UndampedFriction(SceneCase):

    def impacts(self, law, fraction, angle=30.0, spin=-2.0, count=12, more="", pairs=None, np=1, steps=None):
        """Pairs of spheres collide, each at another moment within a step. Mean gain of kinetic energy."""
        spheres, dt = [], fraction * CRITICAL
        t = math.radians(angle)
        for n in range(count):
            gap = 1e-4 + dt * math.cos(t) * (n + 0.5) / count
            for side in (-1, 1):
                spheres.append(Sphere((side * (R + gap / 2), 3 * n, 0), (-side * 0.5 * math.cos(t), -side * 0.5 * math.sin(t), 0),
                                      (0, 0, -spin * (0.5 if side < 0 else 0.15)), density=DENSITY))
        write_sphere_data(self.path("data"), ((-3, 3), (-3, 3 * count), (-3, 3)), spheres, types=2)
        if steps is None:
            steps = round(0.5 / dt)
        self.log = self.run_lammps(SCRIPT.format(pairs=pairs or f"pair_coeff * * {law}", more=more, dt=dt, steps=steps), np=np).log
        frame, = read_dump(self.path("end"))
        begin = sum(energy(s.v, s.omega) for s in spheres)
        return sum(energy(row[1:4], row[4:]) for row in frame.atoms.values()) / begin - 1

    def said(self, law, fraction, **options):
        gain = self.impacts(law, fraction, **options)
        found = ["step" * bool(re.search(STEP, self.log)), "spring" * bool(re.search(SPRING, self.log))]
        return gain, " ".join(w for w in found if w)

    def law(self, mu, e=1.0, words=""):
        return f"hertz/material {YOUNG!r} {e} 0.3 tangential multistep NULL NULL {mu} {words}"

    def test_where_energy_is_gained(self):
        for mu, e, words, fraction, expected in ((10, 1.0, "", 0.19, "step"), (5, 1.0, "", 0.19, "step"), (2, 1.0, "", 0.19, "step"), (1, 1.0, "", 0.199, "step"),
                                                 (5, 0.97, "", 0.19, "step"), (10, 1.0, "slider", 0.19, "step"),
                                                 (10, 1.0, "rolling 0.02", 0.19, "step")):
            gain, said = self.said(self.law(mu, e, words), fraction, angle={1: 10, 2: 0}.get(mu, 30), spin=2.0 if mu == 1 else -2.0)
            print(f"mu {mu}, e {e}, {words or 'stock'}, dt {fraction} critical: gain {gain:+.1e}, warned about {said}")
            self.assertEqual(said, expected)
            if e == 1.0:
                self.assertGreater(gain, 1e-3, "a warning without reason")

    def test_laws_of_pair_granular(self):
        """They gain as multistep does, unless the spring shrinks with the contact radius; midpoint is no word of theirs."""
        for law, mu, expected in (("mindlin", 5, "step"), ("mindlin/force", 1000, "step spring"), ("mindlin", 1000, "step spring"),
                                  ("mindlin_rescale", 1000, ""), ("mindlin_rescale/force", 1000, "")):
            gain, said = self.said(f"hertz/material {YOUNG!r} 1.0 0.3 tangential {law} NULL 0.0 {mu}", 0.19)
            print(f"{law}, mu {mu}: gain {gain:+.1e}, warned about {said or 'nothing'}")
            self.assertEqual(said, expected)
            self.assertEqual(gain > 1e-3, bool(expected))
            self.assertNotIn("midpoint", self.log)
            self.assertEqual("use mindlin_rescale or" in self.log, "spring" in expected)

    def test_where_it_is_not(self):
        for mu, e, words, fraction in ((10, 1.0, "midpoint", 0.19), (10, 1.0, "", 0.05), (10, 0.8, "", 0.19), (2, 0.97, "", 0.19),
                                       (0.5, 1.0, "", 0.19), (0.5, 0.5, "rolling 0.1", 0.19), (1, 1.0, "rolling 0.01", 0.199),
                                       (5, 1.0, "rolling 0.1", 0.19)):
            gain, said = self.said(self.law(mu, e, words), fraction)
            print(f"mu {mu}, e {e}, {words}, dt {fraction} critical: gain {gain:+.1e}, {said or 'no warning'}")
            self.assertEqual(said, "")
            self.assertLess(gain, 1e-3)

    def test_spring_that_stiffens(self):
        """The equations themselves gain energy: a time step that is ten times smaller does not help."""
        for words, angle, spin, mu, friction in (("midpoint", 80, 20, 1000, "1000"), ("midpoint rolling 1", 35, 0, 1, "1")):
            gain, said = self.said(self.law(mu, 1.0, words), 0.02, angle=angle, spin=spin)
            who, found, rolling = re.search(SPRING, self.log).groups()
            print(f"mu {mu}, {words}: gain {gain:+.1e}, warned about {said}")
            self.assertEqual((said, who, found, rolling), ("spring", "types 1 and 1", friction, "1" if "rolling" in words else None))
            self.assertGreater(gain, 1e-3)
        linear = f"hooke 7e5 0.0 tangential multistep 2e5 0.0 1000 midpoint"
        self.assertEqual(self.said(linear, 0.02, angle=80, spin=20)[1], "", "a linear spring does not stiffen")

    def test_names_what_touches(self):
        good, bad = self.law(0.5), self.law(20)
        floor = "hertz 1.4e7 0.0 tangential multistep NULL NULL 20"
        self.impacts("", 0.19, pairs=f"pair_coeff 1 1 {good}\npair_coeff 1 2 {good}\npair_coeff 2 2 {bad}", steps=1)
        self.assertEqual(re.findall(STEP, self.log), [], "no particles of type 2")
        self.impacts(good, 0.19, more=f"fix floor all large/body plane 0 0 -2 0 0 1 contact {floor}", np=2, steps=1)
        (who, mu, fraction), = re.findall(STEP, self.log)
        self.assertEqual((who, mu), ("type 1 with fix large/body floor", "20"))
        self.assertAlmostEqual(float(fraction), 0.19, delta=0.11)    # of a contact with the plane


if __name__ == "__main__":
    unittest.main()
