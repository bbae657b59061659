# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: label=slow timeout=600
"""Slow compression of 512 bodies without friction in a periodic box: the solid fraction at which they begin to bear, from the line
of pressure over fraction, of ellipsoids 1 : 1 : .5 (M&M candies, .68 to .71: A. Donev et al., Science 303, 990, 2004) and of
spheres (.64)."""

import unittest

from talus_testing import SceneCase, head, thermo

SCENE = head(boundary="p p p", map=None) + """
lattice sc {lattice!r}
region box block 0 8.4 0 8.4 0 8.4 units box
create_box 1 box
create_atoms 1 box
velocity all create 0.5 11
neighbor 0.15 bin
pair_style gran/penalty
pair_coeff * * hooke 1e4 40
fix s all shape/gran type 1 ellipsoid 0.5 0.5 {c} density 1 orient random 11
variable phi equal mass(all)/vol
fix d all deform 1 x scale {first!r} y scale {first!r} z scale {first!r}
timestep 5e-4
run 20000
unfix d
fix d all deform 1 x scale {second!r} y scale {second!r} z scale {second!r}
thermo 200
thermo_style custom step v_phi press ke
thermo_modify norm no
run 80000
"""


class Packing(SceneCase):

    def bears_from(self, c, low, high):
        """Where the line through the pressures from 1/300 to 1/80 of the stiffness over the diameter meets 0."""
        volume = 512 * 4 / 3 * 3.141592653589793 * 0.25 * c
        first, second = (volume / low) ** (1 / 3) / 8.4, (low / high) ** (1 / 3)
        scene = SCENE.format(lattice=1 / 1.05 ** 3, c=c, first=first, second=second)
        points = [(row["Press"], row["v_phi"]) for row in thermo(self.run_lammps(scene).log) if 30 < row["Press"] < 120]
        self.assertGreater(len(points), 20)
        mean_p, mean_phi = (sum(p[k] for p in points) / len(points) for k in range(2))
        slope = sum((p - mean_p) * (phi - mean_phi) for p, phi in points) / sum((p - mean_p) ** 2 for p, _ in points)
        return mean_phi - slope * mean_p

    def test_lentils_and_spheres(self):
        for name, c, low, high, least, most in (("M&M candies", 0.25, 0.62, 0.73, 0.68, 0.71), ("spheres", 0.5, 0.58, 0.66, 0.63, 0.65)):
            found = self.bears_from(c, low, high)
            print(f"{name}: {found:.4f}")
            self.assertGreater(found, least)
            self.assertLess(found, most)


if __name__ == "__main__":
    unittest.main()
