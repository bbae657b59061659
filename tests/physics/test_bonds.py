#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""Beams of bonded spheres against the theory of beams, with the conversions of doc/bonds.md: a cantilever under its own
weight, a rod that is pulled until it breaks, and a chain in free flight."""

import math
import unittest

from bonded_rods import (AREA, ENDLESS, GRAVITY, INERTIA, MASS, RADIUS, ROUND, SHEAR, YOUNG, RodCase, coeffs_of)
from talus_testing import read_local


class Bonds(RodCase):

    def deflection(self, count, slender):
        """Of the tip of a rod at rest, the first sphere of which is held; in space and by rotation."""
        length = 2 * RADIUS * (count - 1)
        frequency = 3.516 / length**2 * math.sqrt(YOUNG * INERTIA / (MASS / (2 * RADIUS)))
        dt = 4e-7
        fixes = (f"fix move moving nve/bpm/sphere\nfix weight all gravity {GRAVITY!r} vector 0 0 -1\n"
                 f"fix slow all viscous {1.4 * frequency * MASS!r}")
        state = self.simulate(count, coeffs_of(2 * RADIUS, slender=slender, damping=(0.0, 0.0, 1e-8, 1e-8)), fixes, dt,
                              int(20 / frequency / dt))
        return state.column("z")[count]

    def expected(self, count, slender):
        """By the theory of beams with the weights of the spheres where they are."""
        end, found = 2 * RADIUS * (count - 1), 0.0
        for n in range(1, count):
            a = 2 * RADIUS * n
            by_shear = 0.0 if slender else a / (ROUND * SHEAR * AREA)
            found += MASS * GRAVITY * (a**2 * (3 * end - a) / (6 * YOUNG * INERTIA) + by_shear)
        return -found

    def test_cantilever(self):
        for count, slender in (10, True), (10, False), (5, False):
            self.assert_close(self.deflection(count, slender), self.expected(count, slender), 2e-4)

    def test_cantilever_of_many(self):
        """q L^4/8EI, with an error of first order in the number of spheres."""
        errors = []
        for count in 5, 10, 20:
            length, load = 2 * RADIUS * (count - 1), MASS * GRAVITY / (2 * RADIUS)
            theory = -load * length**4 / (8 * YOUNG * INERTIA)
            errors.append(self.expected(count, True) / theory - 1)
        self.assert_close(self.deflection(20, True), self.expected(20, True), 2e-4)
        for coarse, fine in zip(errors, errors[1:]):
            self.assertLess(abs(fine), 0.6 * abs(coarse))

    def test_rod_that_is_pulled(self):
        """Stress over strain is E, and it breaks at strength/E."""
        count, strength, speed, dt = 11, 2e6, 0.1, 2e-7
        length = 2 * RADIUS * (count - 1)
        limits = strength * AREA, ENDLESS, ENDLESS, ENDLESS
        damping = 0.2 * math.sqrt(YOUNG * AREA / (2 * RADIUS) * MASS)
        needed = strength / YOUNG * length / speed / dt
        fixes = (f"group last id {count}\ngroup free subtract moving last\nfix move free nve/bpm/sphere\n"
                 f"fix pull last move linear {speed!r} 0 0\nfix hold fixed move linear 0 0 0\n"
                 "variable pull equal (fx[1]-fx[11])/2\nvariable long equal x[11]-x[1]")
        self.simulate(count, coeffs_of(2 * RADIUS, limits, (damping, 0.0, 0.0, 0.0)), fixes, dt, int(1.2 * needed),
                      words="smooth no store/local broken 1 time id1 id2", every=200, columns="v_pull v_long",
                      more="dump b all local 1 breaks f_broken[1] f_broken[2] f_broken[3]")
        broken = [row for frame in read_local(self.path("breaks")) for row in frame.rows]
        self.assertLess(len(broken), count - 1)
        self.assert_close(broken[0][0], needed, 0.02)
        early = [(row["v_long"] / length - 1, row["v_pull"] / AREA) for row in self.rows if row["Step"] < 0.95 * needed]
        mean = [sum(column) / len(early) for column in zip(*early)]
        slope = (sum((e - mean[0]) * (s - mean[1]) for e, s in early) / sum((e - mean[0])**2 for e, _ in early))
        self.assert_close(slope, YOUNG, 5e-3)

    def momenta(self, state):
        total = [0.0] * 6
        for row in state.atoms.values():
            mass, x, v, w = row[1], row[2:5], row[5:8], row[8:11]
            for k in range(3):
                a, b = (k + 1) % 3, (k + 2) % 3
                total[k] += mass * v[k]
                total[3 + k] += mass * (x[a] * v[b] - x[b] * v[a]) + 0.4 * mass * RADIUS**2 * w[k]
        return total

    def test_chain_in_free_flight(self):
        """Both momenta are kept to rounding, in any motion and with damping."""
        motion = lambda n: ((0.3 * math.sin(n), 0.2 * math.cos(3 * n), 0.1 * n % 0.3),
                            (200 * math.cos(n), 100.0, -150 * math.sin(2 * n)))
        coeffs = coeffs_of(2 * RADIUS, damping=(1e-2, 1e-2, 1e-8, 1e-8))
        start = self.momenta(self.simulate(8, coeffs, "fix move all nve/bpm/sphere", 2e-7, 0, motion=motion))
        end = self.momenta(self.simulate(8, coeffs, "fix move all nve/bpm/sphere", 2e-7, 5000, motion=motion))
        for k, (a, b) in enumerate(zip(start, end)):
            scale = 8 * MASS * 0.3 * (1.0 if k < 3 else 8 * RADIUS)
            self.assertLess(abs(a - b), 1e-12 * scale, k)


if __name__ == "__main__":
    unittest.main()
