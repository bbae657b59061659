# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""A small sphere rolls over the gap between two fixed ones of twenty times its size, falls through it and
bounces on a floor (Vyas et al. 2025, Comput. Phys. Commun. 310, 109524).

The usual update of the tangential displacement takes its increment with the normal at the end of the step and
the velocity of its middle: friction then holds the sphere below the gap, whatever the time step.  `midpoint`
lets it fall.  Numbers to compare with: the log of the example in.sync_verlet of LAMMPS (pair granular with
synchronized_verlet, velocity Verlet)."""

import math
import unittest

from talus_testing import SceneCase, Sphere, begin, thermo, write_sphere_data

BIG, SMALL, DENSITY = 0.01, 0.0005, 2500.0    # diameters
MASS = DENSITY * math.pi / 6 * SMALL**3
KN, KT, MU, E = 1e4, 8235.0, 0.5, 0.5
GN = -2 * math.sqrt(KN / MASS) * math.log(E) / math.hypot(math.pi, math.log(E))
STEPS = 300000
PUBLISHED = {90000: 8.3124767e-12, 144000: 2.799638e-10, 204000: 3.2458236e-08, STEPS: 4.5214992e-10}

SCRIPT = begin("si", boundary="p p f") + """
group big type 1
group small type 2
pair_coeff * * {law}
fix floor all large/body plane 0 0 -0.02 0 0 1 contact {law}
fix hold big freeze
{move}
neigh_modify delay 0
timestep {dt!r}
compute energy small ke
thermo_style custom step c_energy
thermo_modify format float %.17g
thermo {every}
run {steps}
"""
GRAVITY = "gravity 9.81 vector 0 0 -1"
SYMPLECTIC = f"fix step small nve/sphere/symplectic {GRAVITY}"
VERLET = f"fix step small nve/sphere\nfix g small {GRAVITY}"


class SizeRatio(SceneCase):

    def energies(self, word, move, finer=1):
        """Kinetic energy of translation by time step of 1e-6 s."""
        law = f"hooke {KN!r} {GN!r} tangential multistep {KT!r} 0.0 {MU} {word}"
        spheres = [Sphere((x, 0, 0), diameter=BIG, density=DENSITY) for x in (0.0, 0.01)]
        spheres.append(Sphere((0.005, 2.7937481665024794e-05, 0.0016005372526493155), diameter=SMALL,
                              density=DENSITY, type=2))
        write_sphere_data(self.path("data"), ((-0.03, 0.03), (-0.02, 0.02), (-0.02, 0.02)), spheres)
        log = self.run_lammps(SCRIPT.format(law=law, move=move, dt=1e-6 / finer, every=3000 * finer,
                                            steps=STEPS * finer)).log
        return {row["Step"] // finer: row["c_energy"] for row in thermo(log)}

    def test_falls_through_with_midpoint(self):
        print("\nkinetic energy over the published one at steps " + ", ".join(map(str, PUBLISHED)))
        for word in "midpoint", "midpoint slider":
            for name, move in (("symplectic", SYMPLECTIC), ("nve/sphere", VERLET)):
                found = self.energies(word, move)
                print(f"{word:16}{name:12}" + "".join(f"{found[s] / e:10.5f}" for s, e in PUBLISHED.items()))
                for step, tolerance in zip(PUBLISHED, (1e-3, 1e-3, 5e-3)):
                    self.assert_close(found[step], PUBLISHED[step], tolerance, f"{word} {name} {step}")
                # bounces on the floor multiply a difference: of the end only the order of magnitude
                self.assertGreater(found[STEPS], 0.3 * PUBLISHED[STEPS])
                self.assertLess(found[STEPS], 10 * PUBLISHED[STEPS])

    def test_is_held_without(self):
        print("\nwithout midpoint: kinetic energy at the end over the published one")
        for word in "stock", "slider":
            for finer in 1, 2:
                found = self.energies(word, SYMPLECTIC, finer)
                print(f"{word:16}time step 1e-6/{finer}{found[STEPS] / PUBLISHED[STEPS]:10.5f}")
                self.assert_close(found[90000], PUBLISHED[90000], 1e-3)
                self.assertLess(found[STEPS], 0.01 * PUBLISHED[STEPS], "no artifact any more: tell the doc page")


if __name__ == "__main__":
    unittest.main()
