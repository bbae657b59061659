#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""Beams of bonded spheres against the theory of beams, with the conversions of doc/bonds.md: a cantilever under its own
weight, a rod that is pulled until it breaks, and a chain in free flight."""

import math
import unittest

from bonded_grains import write_bonded_data
from talus_testing import SceneCase, read_dump, read_local, thermo

RADIUS, YOUNG, SHEAR, DENSITY, GRAVITY = 1e-3, 1e9, 4e8, 2500.0, 9.81
AREA, INERTIA = math.pi * RADIUS**2, math.pi * RADIUS**4 / 4
MASS = 4 / 3 * math.pi * RADIUS**3 * DENSITY
ROUND = 0.9         # shear correction of a circle
SCENE = """
units si
boundary f f f
atom_style bpm/sphere
newton on off
comm_modify vel yes cutoff 6e-3
special_bonds lj 0 1 1 coul 1 1 1
read_data rod
neighbor 1e-3 bin
pair_style gran/hooke/history 1e4 NULL 0 NULL 0.5 0
pair_coeff * *
bond_style bpm/rotational {words}
bond_coeff 1 {coeffs}
group fixed id 1
group moving subtract all fixed
timestep {dt!r}
{fixes}
thermo {every}
thermo_style custom step {columns}
thermo_modify format float %.17g
{more}
run {steps}
write_dump all custom state id mass x y z vx vy vz omegax omegay omegaz modify format float %.17g
"""
ENDLESS = 1e9


def coeffs_of(length, limits=(ENDLESS,) * 4, damping=(0.0,) * 4, slender=False):
    """The words of bond_coeff for a round beam; `slender`: without its shear."""
    phi = 0.0 if slender else 12 * YOUNG * INERTIA / (ROUND * SHEAR * AREA * length**2)
    stiffness = (YOUNG * AREA / length, 12 * YOUNG * INERTIA / (length**3 * (1 + phi)), SHEAR * 2 * INERTIA / length,
                 YOUNG * INERTIA / length)
    return " ".join(map(repr, (*stiffness, *limits, *damping)))


class Bonds(SceneCase):

    def simulate(self, count, coeffs, fixes, dt, steps, words="break no smooth no", every=100, columns="ke", more="",
                 motion=lambda n: ((0.0,) * 3, (0.0,) * 3), spacing=2 * RADIUS):
        spheres = [((n * spacing, 0.0, 0.0), *motion(n), 2 * RADIUS, DENSITY) for n in range(count)]
        edge = (count + 2) * spacing
        write_bonded_data(self.path("rod"), ((-edge, edge),) * 3, spheres, [(1, n, n + 1) for n in range(1, count)])
        result = self.run_lammps(SCENE.format(coeffs=coeffs, fixes=fixes, dt=dt, steps=steps, words=words, every=every,
                                              columns=columns, more=more), arguments=["-sf", "talus"])
        self.assertRegex(result.log, "(?m)^  bond bpm/rotational +accelerated$")
        self.rows = thermo(result.log)
        return read_dump(self.path("state"))[-1]

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
