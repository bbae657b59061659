#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""Rods of bonded spheres that move: natural frequencies of torsion and of a cantilever, also under a load along its axis,
which makes it buckle beyond Euler's; what bonds store and lose; and strengths with a spread."""

import math
import os
import re
import unittest

from beam_theory import buckling_load, crossings, first_mode
from bonded_rods import AREA, ENDLESS, INERTIA, MASS, RADIUS, ROUND, SHEAR, YOUNG, RodCase, coeffs_of
from talus_testing import read_local

SPACING, TURNING = 2 * RADIUS, 0.4 * MASS * RADIUS**2
ENERGIES = """
compute moving all ke
compute turning all erotate/sphere
compute account all penalty/stats
neigh_modify every 100 delay 0 check no
"""
KINETIC, STORED, DAMPED, BROKEN = ("c_moving", "c_turning"), "c_account[12]", "c_account[13]", "c_account[14]"
COLUMNS = " ".join((*KINETIC, STORED, DAMPED, BROKEN, "c_account[2]"))


class Frequencies(RodCase):

    def end_of_rod(self, seen, count, motion, coeffs, duration, dt=4e-7, fixes=""):
        """[(time, v_seen)] of a rod, the first sphere of which is held."""
        self.simulate(count, coeffs, f"fix move moving nve/bpm/sphere\n{fixes}\nvariable seen equal {seen}", dt,
                      int(duration / dt), every=10, columns="v_seen", motion=motion)
        return [(row["Step"] * dt, row["v_seen"]) for row in self.rows]

    def frequency(self, rows):
        found = crossings(*zip(*rows[1:]))
        self.assertGreater(len(found), 3)
        return math.pi * (len(found) - 1) / (found[-1] - found[0])

    def test_torsion(self):
        """A chain of discs on springs G J/L: 2 sqrt(k/I) sin(pi/(2(2n+1))), which tends to that of the rod."""
        count = 10
        moving = count - 1
        stiffness = SHEAR * 2 * INERTIA / SPACING
        expected = 2 * math.sqrt(stiffness / TURNING) * math.sin(math.pi / (2 * (2 * moving + 1)))
        shape = lambda n: 10.0 * math.sin(math.pi * n / (2 * moving + 1))
        rows = self.end_of_rod(f"C_turn[{count}]", count, lambda n: ((0.0,) * 3, (shape(n), 0.0, 0.0)), coeffs_of(SPACING),
                               20 / expected, dt=2e-7, fixes="compute turn all property/atom omegax")
        self.assert_close(self.frequency(rows), expected, 1e-4)
        of_rod = math.pi / (2 * SPACING * (moving + 0.5)) * math.sqrt(SHEAR * 2 * INERTIA * SPACING / TURNING)
        self.assert_close(expected, of_rod, 2e-3)

    def cantilever(self, count, slender):
        places = [SPACING * n for n in range(1, count)]
        return first_mode(places, [MASS] * len(places), [TURNING] * len(places), YOUNG * INERTIA,
                          math.inf if slender else ROUND * SHEAR * AREA)

    def swinging(self, count, slender, duration, press=0.0, speed=1e-4):
        """`duration` in units of 1/frequency."""
        frequency, deflections, slopes = self.cantilever(count, slender)
        motion = lambda n: (((0.0,) * 3, (0.0,) * 3) if n == 0 else
                            ((0.0, 0.0, speed * deflections[n - 1]), (0.0, -speed * slopes[n - 1], 0.0)))
        axial = 0.2 * math.sqrt(YOUNG * AREA / SPACING * MASS)
        rows = self.end_of_rod(f"z[{count}]", count, motion, coeffs_of(SPACING, damping=(axial, 0.0, 0.0, 0.0), slender=slender),
                               duration / frequency, fixes=f"group last id {count}\nfix press last addforce {-press!r} 0 0")
        return frequency, rows

    def test_cantilever(self):
        """With the masses where they are; 3.516 sqrt(EI/(mu L^4)) is reached with an error of first order."""
        for count, slender in (10, True), (6, False):
            expected, rows = self.swinging(count, slender, 15.0)
            self.assert_close(self.frequency(rows), expected, 5e-4)
        errors = []
        for count in 10, 20, 40:
            theory = 3.516015 / (SPACING * (count - 1))**2 * math.sqrt(YOUNG * INERTIA * SPACING / MASS)
            errors.append(self.cantilever(count, True)[0] / theory - 1)
        for coarse, fine in zip(errors, errors[1:]):
            self.assertLess(abs(fine), 0.6 * abs(coarse))

    def test_euler_buckling(self):
        """A load at the free end along the axis makes a rod slower, and beyond pi^2 E I/(4 L^2) it leaves its axis ever faster."""
        count = 10
        places = [SPACING * n for n in range(1, count)]
        critical = math.pi**2 * YOUNG * INERTIA / (2 * places[-1])**2
        self.assert_close(buckling_load(places, YOUNG * INERTIA), critical, 5e-3)
        expected = first_mode(places, [MASS] * len(places), [TURNING] * len(places), YOUNG * INERTIA, press=0.5 * critical)[0]
        free, rows = self.swinging(count, True, 22.0, 0.5 * critical)
        self.assertLess(expected, 0.75 * free)
        self.assert_close(self.frequency(rows), expected, 5e-3)
        free, rows = self.swinging(count, True, 11.0, 1.5 * critical, speed=1e-5)
        half = len(rows) // 2
        self.assertTrue(all(value > 0 for _, value in rows[1:]))
        rate = math.log(rows[-1][1] / rows[half][1]) / (rows[-1][0] - rows[half][0])
        self.assertTrue(0.45 < (rate / free)**2 < 0.6, (rate / free)**2)


class Energies(RodCase):

    def total(self, row):
        return sum(row[name] for name in (*KINETIC, STORED, DAMPED, BROKEN))

    def deviation(self, dt):
        motion = lambda n: ((3e-4 * math.sin(n), 2e-4 * math.cos(3 * n), 1e-4 * math.sin(5 * n)),
                            (0.2 * math.cos(n), 0.1 * math.sin(4 * n), -0.15 * math.sin(2 * n)))
        self.simulate(8, coeffs_of(SPACING), "fix move all nve/bpm/sphere" + ENERGIES, dt, int(1.6e-4 / dt), every=5, columns=COLUMNS,
                      motion=motion)
        kept = [sum(row[name] for name in (*KINETIC, STORED)) for row in self.rows]
        self.assertGreater(max(row[STORED] for row in self.rows), 0.2 * kept[0])
        for row in self.rows:
            self.assertLess(abs(row[DAMPED]), 0.05 * kept[0])
        self.assertEqual(self.rows[-1][BROKEN], 0.0)
        return max(abs(e - kept[0]) for e in kept) / kept[0]

    def test_free_flight(self):
        """Without damping kinetic and stored energy are kept to second order in the time step: none of it is found from work."""
        coarse, fine = self.deviation(2e-7), self.deviation(1e-7)
        print(f"\ndeviation of the energy: {coarse:.2e} {fine:.2e}")
        self.assertLess(coarse, 0.05)
        self.assertTrue(3.4 < coarse / fine < 4.6, coarse / fine)

    def torn(self, damping, np=1, smooth="no"):
        """A rod whose spheres fly apart; `damping` of its normal motion."""
        motion = lambda n: ((3.5 * (n - 3.5) + 0.1 * math.sin(9 * n), 0.1 * math.cos(5 * n), 0.0), (0.0, 20.0 * math.sin(n), 0.0))
        limits = 2e6 * AREA, ENDLESS, ENDLESS, ENDLESS
        self.simulate(8, coeffs_of(SPACING, limits, (damping, 0.0, 0.0, 0.0)), "fix move all nve/bpm/sphere" + ENERGIES, 2e-8, 800, np=np,
                      words=f"smooth {smooth} store/local broken 1 time id1 id2", every=10, columns=COLUMNS, motion=motion,
                      more="dump b all local 1 breaks f_broken[1] f_broken[2] f_broken[3]")
        self.assertEqual(self.rows[-1]["c_account[2]"], 0.0)
        first, last = self.rows[0], self.rows[-1]
        for row in self.rows:
            self.assert_close(self.total(row), self.total(first), 1e-3)
        return first, last

    def test_bonds_that_break(self):
        """Kinetic energy goes into bonds, damping and breaking; each of them by itself where it is known."""
        first, last = self.torn(0.0)
        broken = sum(len(frame.rows) for frame in read_local(self.path("breaks")))
        self.assertGreater(broken, 2)
        at_limit = (2e6 * AREA)**2 / (2 * YOUNG * AREA / SPACING)
        self.assert_close(last[BROKEN], broken * at_limit, 0.05)
        self.assertLess(abs(last[DAMPED]), 0.03 * last[BROKEN])
        _, softened = self.torn(0.0, smooth="yes")
        self.assertEqual(softened[BROKEN], 0.0)
        self.assertGreater(softened[DAMPED], 0.1 * last[BROKEN])
        _, damped = self.torn(0.3 * math.sqrt(YOUNG * AREA / SPACING * MASS))
        self.assertGreater(damped[DAMPED], 0.1 * last[BROKEN])
        _, other = self.torn(0.3 * math.sqrt(YOUNG * AREA / SPACING * MASS), np=2)
        for name in STORED, DAMPED, BROKEN:
            self.assertLess(abs(other[name] - damped[name]), 1e-9 * damped[DAMPED])


PAIRS = """
units si
boundary f f f
atom_style bpm/sphere
newton on off
comm_modify vel yes cutoff 6e-3
special_bonds lj 0 1 1 coul 0 1 1
region box block -1e-3 0.0601 -1e-3 0.0601 -1e-3 0.0151
create_box 4 box bond/types 4 extra/bond/per/atom 4 extra/special/per/atom 10
lattice custom 6e-3 basis 0.1 0.1 0.1 basis 0.43333333333333 0.1 0.1
region inside block 0 0.06 0 0.06 0 0.015 units box
create_atoms 1 region inside
reset_atoms id sort yes
set group all diameter 2e-3
set group all density 2500
neighbor 1e-3 bin
pair_style gran/hooke/history 1e4 NULL 0 NULL 0.5 0
pair_coeff * *
{recipe}
variable out atom "{speed}*(2*(x-6e-3*floor(x/6e-3)>1.5e-3)-1)"
velocity all set v_out 0 0
fix move all nve/bpm/sphere
timestep 2e-7
dump b all local 1 breaks f_broken[1] f_broken[2]
compute bonds all property/local batom1 batom2 btype
run 0
write_dump all local whole c_bonds[1] c_bonds[2] c_bonds[3]
run 100
"""


class Spread(RodCase):

    def recipe(self):
        with open(os.path.join(os.environ["TALUS_SOURCE_DIR"], "doc", "bonds.md")) as page:
            found = re.search(r"### Strengths with a spread.*?```\n(.*?)```", page.read(), re.S)
        return found[1]

    def test_recipe(self):
        """Pairs that fly apart with one speed: those break whose strength is below sqrt(m/2 k) times it; a quarter of bonds has each
        strength of the recipe, the same bonds on any ranks."""
        strengths = [2e6 * AREA * (-math.log(1 - (k - 0.5) / 4))**0.25 for k in range(1, 5)]
        pull = (strengths[1] + strengths[2]) / 2
        speed = pull / math.sqrt(1.57e6 * MASS / 2) / 2
        found = []
        for np in 1, 2:
            self.run_lammps(PAIRS.format(recipe=self.recipe(), speed=repr(speed)), np=np, arguments=["-sf", "talus"])
            types = {frozenset(map(int, row[:2])): int(row[2]) for row in read_local(self.path("whole"))[-1].rows}
            broken = {frozenset(map(int, row)) for frame in read_local(self.path("breaks")) for row in frame.rows}
            self.assertGreater(len(types), 150)
            self.assertEqual(broken, {pair for pair, bond_type in types.items() if bond_type <= 2})
            for k in range(1, 5):
                share = sum(t == k for t in types.values()) / len(types)
                self.assertLess(abs(share - 0.25), 4 * math.sqrt(0.25 * 0.75 / len(types)))
            found.append(types)
        self.assertEqual(found[0], found[1])


if __name__ == "__main__":
    unittest.main()
