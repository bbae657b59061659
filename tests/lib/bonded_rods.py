# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Rods of bonded spheres that touch, in a line along x, with the conversions of doc/bonds.md, for tests."""

import math

from bonded_grains import write_bonded_data
from talus_testing import SceneCase, read_dump, thermo

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


class RodCase(SceneCase):

    def simulate(self, count, coeffs, fixes, dt, steps, words="break no smooth no", every=100, columns="ke", more="",
                 motion=lambda n: ((0.0,) * 3, (0.0,) * 3), spacing=2 * RADIUS, np=1):
        """The last state, after run 0 ... steps; self.rows: of the log."""
        spheres = [((n * spacing, 0.0, 0.0), *motion(n), 2 * RADIUS, DENSITY) for n in range(count)]
        edge = (count + 2) * spacing
        write_bonded_data(self.path("rod"), ((-edge, edge),) * 3, spheres, [(1, n, n + 1) for n in range(1, count)])
        result = self.run_lammps(SCENE.format(coeffs=coeffs, fixes=fixes, dt=dt, steps=steps, words=words, every=every,
                                              columns=columns, more=more), np=np, arguments=["-sf", "talus"])
        self.assertRegex(result.log, "(?m)^  bond bpm/rotational +accelerated$")
        self.rows = thermo(result.log)
        return read_dump(self.path("state"))[-1]
