# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""Contacts of jkr, which last beyond zero overlap until pull-off: their forces at large bodies against walls of LAMMPS, and
the energy that is lost at pull-off."""

import math
import unittest

import body_meshes
from talus_testing import SceneCase, Sphere, begin, read_dump, thermo, write_sphere_data

R, YOUNG, NU, GAMMA = 0.5, 1e5, 0.3, 50.0
E_EFF = YOUNG / (2 * (1 - NU * NU))    # of two bodies of this material
JKR = f"jkr {YOUNG} 0.0 {NU} {GAMMA}"


def reach(r_eff):
    return (3 * math.pi**2 / 16 * r_eff * (GAMMA / E_EFF)**2)**(1 / 3)


def work(a, r_eff):
    """Of the elastic force from a contact radius of zero on."""
    tension = math.sqrt(math.pi * GAMMA * E_EFF * a)
    return a * a * (8 / 15 * E_EFF * a**3 / r_eff**2 - 8 / 3 * tension * a / r_eff + 2 * math.pi * GAMMA)


def lost(r_eff):
    """From overlap zero to the strongest pull, where the bodies separate."""
    cube = math.pi * GAMMA * r_eff**2 / E_EFF
    return work((9 / 4 * cube)**(1 / 3), r_eff) - work((4 * cube)**(1 / 3), r_eff)


DRIVEN = begin("si", law="{pair}", skin=0.05, dt=1e-3) + """
fix drive all move wiggle 0 0 {depth} 2.0
{wall}
dump state all custom 1 {out} id z fz
dump_modify state format float %.17g
run 3000
"""


class PullOff(SceneCase):
    """A sphere that is moved to a wall, away from it, and back again."""

    depth = 2.5 * reach(R)

    def forces(self, name, wall, pair=JKR, start=R, **options):
        write_sphere_data(self.path("data"), ((-4, 4), (-4, 4), (-4, 4)), [Sphere((0.1, 0.2, start + 1e-6), diameter=2 * R)])
        self.run_lammps(DRIVEN.format(pair=pair, wall=wall, depth=-self.depth, out=name), **options)
        frames = read_dump(self.path(name))
        return [frame.column("z")[1] for frame in frames], [frame.column("fz")[1] for frame in frames]

    def test_against_a_wall_of_lammps(self):
        z, wall = self.forces("wall", f"fix w all wall/gran granular {JKR} tangential linear_nohistory 0.0 0.0 zplane 0.0 NULL")
        _, body = self.forces("body", f"fix w all large/body plane 0 0 0 0 0 1 contact {JKR}")
        largest = 3 * math.pi * GAMMA * R
        self.assertAlmostEqual(min(body), -largest, delta=1e-4 * largest)
        worst = max(abs(a - b) for a, b in zip(wall, body)) / largest
        print(f"\nstrongest pull over 3 pi gamma R {min(body) / -largest:.7f}, largest difference from a wall of LAMMPS {worst:.1e}")
        self.assertLess(worst, 1e-9)
        stretched = [x for x, f in zip(z, body) if x > R and f != 0.0]
        alone = [x for x, f in zip(z, body) if x < R + reach(R) and x > R and f == 0.0]
        self.assertGreater(len(stretched), 50)
        self.assertGreater(len(alone), 50)
        self.assertAlmostEqual(max(stretched) - R, reach(R), delta=0.02 * reach(R))

    def test_shapes(self):
        """With one contact, with several, and at a body that moves to a sphere at rest."""
        _, plane = self.forces("plane", f"fix w all large/body plane 0 0 0 0 0 1 contact {JKR}")
        body_meshes.write_stl(self.path("plate.stl"), body_meshes.grid(lambda i, j: (1.1 * i - 4, 1.1 * j - 4, 0.0), 7, 7))
        for shape in ("box 0 0 -1 6 6 2 outside", "box 0 0 2 6 6 4 inside", "rectangle 0 0 0 0 0 1 1 0 0 6 6", "mesh plate.stl"):
            with self.subTest(shape):
                _, forces = self.forces("other", f"fix w all large/body {shape} contact {JKR}")
                self.assertLess(max(abs(a - b) for a, b in zip(plane, forces)), 1e-9 * -min(plane))
        still = "unfix drive\nfix drive all move linear 0 0 0\n"
        _, forces = self.forces("moved", f"{still}fix w all large/body plane 0 0 0 0 0 1 contact {JKR} "
                                         f"move wiggle 0 0 {self.depth} 2.0")
        self.assertLess(max(abs(a - b) for a, b in zip(plane, forces)), 1e-6 * -min(plane))

    def test_types_with_other_laws(self):
        """Another type has a law that does not last."""
        pair = f"{JKR}\npair_coeff 2 2 hooke 1e4 0.0\npair_coeff 1 2 hooke 1e4 0.0"
        _, alone = self.forces("one", f"fix w all large/body plane 0 0 0 0 0 1 contact {JKR}")
        spheres = [Sphere((0.1, 0.2, R + 1e-6), diameter=2 * R), Sphere((2.1, 0.2, R + 1e-6), diameter=2 * R, type=2)]
        write_sphere_data(self.path("data"), ((-4, 4),) * 3, spheres)
        for np in 1, 2:
            self.run_lammps(DRIVEN.format(pair=pair, depth=-self.depth, out="two",
                                          wall=f"fix w all large/body plane 0 0 0 0 0 1 contact types 1 {JKR} "
                                               "contact types 2 hooke 1e4 0.0"), np=np)
            frames = read_dump(self.path("two"))
            self.assertEqual(alone, [frame.column("fz")[1] for frame in frames])
            self.assertTrue(all(frame.column("fz")[2] >= 0.0 for frame in frames))


IMPACT = begin("si", law="{words}", skin=0.05, dt="{dt}") + """
fix step all nve/sphere/symplectic start half
{wall}
compute s all penalty/stats
compute k all ke
thermo_style custom step c_k c_s[2] c_s[4] c_s[5] c_s[6] c_s[7]
thermo_modify format float %.17g norm no
thermo 20
run {steps}
"""
KINETIC, CONTACTS, ELASTIC, DISSIPATED = "c_k", "c_s[2]", "c_s[4]", "c_s[5]"


class LostEnergy(SceneCase):

    def impact(self, spheres, wall="", words=JKR, dt=2e-5, steps=12000):
        write_sphere_data(self.path("data"), ((-4, 4),) * 3, spheres)
        return thermo(self.run_lammps(IMPACT.format(words=words, wall=wall, dt=dt, steps=steps)).log)

    def check(self, what, rows, expected):
        totals = [row[KINETIC] + row[ELASTIC] + row[DISSIPATED] for row in rows]
        error = max(abs(total - totals[0]) for total in totals) / totals[0]
        touching = [row for row in rows if row[CONTACTS] > 0]
        self.assertGreater(len(touching), 20)
        self.assertEqual(rows[-1][CONTACTS], 0.0, "they have not come apart")
        early = max(abs(row[DISSIPATED]) for row in touching) / expected
        found = rows[-1][DISSIPATED]
        print(f"\n{what}: kinetic energy {totals[0]:.5g} -> {rows[-1][KINETIC]:.5g}, dissipated {found:.6g}, expected {expected:.6g}; "
              f"change of the sum {error:.1e}, counted before pull-off {early:.1e}")
        self.assertLess(error, 1e-5)    # of second order in the time step
        self.assertLess(early, 5e-3)
        self.assert_close(found, expected, 2e-3)
        self.assertEqual(rows[-1][ELASTIC], 0.0)

    def test_head_on_impact(self):
        m = 10.0 * 4 / 3 * math.pi * R**3
        v = math.sqrt(3 * lost(R / 2) / m)
        spheres = [Sphere((s * (R + 1e-3), 0, 0), (-s * v, 0, 0), density=10.0, diameter=2 * R) for s in (-1, 1)]
        self.check("two spheres", self.impact(spheres), lost(R / 2))
        v = math.sqrt(6 * lost(R) / m)
        one = [Sphere((0, 0, R + 1e-3), (0, 0, -v), density=10.0, diameter=2 * R)]
        self.check("at a plane", self.impact(one, f"fix floor all large/body plane 0 0 0 0 0 1 contact {JKR}"), lost(R))

    def test_with_damping(self):
        """What damping dissipates and what pull-off dissipates are one sum."""
        m = 10.0 * 4 / 3 * math.pi * R**3
        v = math.sqrt(9 * lost(R / 2) / m)
        spheres = [Sphere((s * (R + 1e-3), 0, 0), (-s * v, 0, 0), density=10.0, diameter=2 * R) for s in (-1, 1)]
        rows = self.impact(spheres, words=f"jkr {YOUNG} 5.0 {NU} {GAMMA}")
        totals = [row[KINETIC] + row[ELASTIC] + row[DISSIPATED] for row in rows]
        self.assertEqual(rows[-1][CONTACTS], 0.0)
        self.assertGreater(rows[-1][DISSIPATED], 1.02 * lost(R / 2))
        self.assertLess(max(abs(total - totals[0]) for total in totals), 1e-5 * totals[0])

    def test_contacts_that_exist_already(self):
        """What is stored when the account begins has not been taken from anything."""
        rows = self.impact([Sphere((0, 0, 0)), Sphere((0, 0, 0.99))], steps=0)
        self.assertNotEqual(rows[0][ELASTIC], 0.0)
        self.assertEqual(rows[0][DISSIPATED], 0.0)


if __name__ == "__main__":
    unittest.main()
