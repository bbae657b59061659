# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Stability limits of the stability benchmark, in short: stable 3 % below the theory, unstable 3 % above.

Spheres of mass 1 and diameter 1, linear contacts of stiffness 1 that never open; the limit is 2 over the
largest eigenfrequency of translation and rotation."""

import itertools
import math
import random
import unittest

from talus_testing import SceneCase, Sphere, begin, write_sphere_data

DENSITY = 6 / math.pi
OVERLAP, KICK = 1e-3, 1e-9

SCRIPT = """
clear
units si
boundary {boundary}
atom_style sphere
atom_modify map array
newton off
comm_modify vel yes
read_data {data}
neighbor 0.05 bin
group moving type 1
group base type 2
pair_style gran/penalty
pair_coeff * * hooke 1.0 {gn!r} {friction}
fix move moving nve/sphere/symplectic order {order}
fix hold base freeze
neigh_modify exclude group base base
compute k moving ke
compute r moving erotate/sphere
compute t all timestep/gran
timestep {dt!r}
thermo 100000
thermo_modify norm no lost ignore
thermo_style custom step c_k c_r c_t[7] c_t[8]
run 0
variable begin string $(c_k+c_r)
variable grown equal (c_k+c_r)/v_begin
fix stop all halt 1 v_grown > 1e8 error continue message no
run 4000
print "RESULT $(v_grown) $(count(moving)) ${{begin}} $(c_t[7]:%.17g) $(c_t[8]:%.17g)"
"""

STICKS = "tangential multistep {} 0.0 1e9"


def kicked(positions):
    draw = random.Random(2)
    return [Sphere(x, [draw.gauss(0, KICK) for _ in "xyz"], [draw.gauss(0, KICK) for _ in "xyz"], density=DENSITY)
            for x in positions]


def cage():
    """A sphere among twelve fixed ones, as in the densest packing."""
    signs = list(itertools.product((1, -1), repeat=2))
    corners = [c for a, b in signs for c in ((a, b, 0), (a, 0, b), (0, a, b))]
    distance = (1 - OVERLAP) / math.sqrt(2)
    return kicked([(0, 0, 0)]) + [Sphere(tuple(distance * c for c in corner), density=DENSITY, type=2)
                                  for corner in corners]


def lattice(cells=3):
    """Spheres in the densest packing, periodic; and the edge of the box."""
    edge = math.sqrt(2) * (1 - OVERLAP)
    basis = ((0, 0, 0), (0.5, 0.5, 0), (0.5, 0, 0.5), (0, 0.5, 0.5))
    return kicked([tuple(edge * (c + b) for c, b in zip(cell, base))
                   for cell in itertools.product(range(cells), repeat=3) for base in basis]), edge * cells


class Limits(SceneCase):

    def grows(self, data, friction, limit, boundary="f f f", gn=0.0, order=1):
        """[whether the disturbance grows at .97, at 1.03 of the limit]."""
        script = "".join(SCRIPT.format(boundary=boundary, data=data, friction=friction, dt=f * limit, gn=gn, order=order)
                         for f in (0.97, 1.03))
        self.log = self.run_lammps(script).log
        found = [line.split()[1:] for line in self.log.splitlines() if line.startswith("RESULT ")]
        count = found[0][1]
        self.stable = [(float(row[3]), float(row[4])) for row in found]
        return [not float(row[0]) < 1e8 or row[1] != count for row in found]

    def test_twelve_contacts(self):
        write_sphere_data(self.path("data"), ((-3, 3),) * 3, cage(), types=2)
        # 2 over the square root of: translation 4 kn + 8 kt, rotation 20 kt (kn = 1, mass 1, inertia .1)
        for kt in None, 2 / 7, 1.0:
            largest = max(4 + 8 * (kt or 0), 20 * (kt or 0))
            friction = STICKS.format(kt) if kt else ""
            self.assertEqual(self.grows("data", friction, 2 / math.sqrt(largest)), [False, True], f"kt {kt}")

    def test_damped(self):
        """Among twelve with a tangential dashpot rotation goes first, and compute timestep/gran knows."""
        write_sphere_data(self.path("data"), ((-3, 3),) * 3, cage(), types=2)
        kt, gn = 2 / 7, 0.6      # damping ratio .3
        friction = f"tangential multistep {kt!r} {0.5 * gn!r} 1e9 slider midpoint limit_damping"

        def limit(order, mass_eff):
            """20 kt dt^2 + 2 order 20 gt dt = 4 m_eff"""
            drag = 2 * order * 20 * 0.5 * gn * mass_eff
            return 8 * mass_eff / (drag + math.sqrt(drag**2 + 16 * 20 * kt * mass_eff))
        for order in 1, 2:
            self.assertEqual(self.grows("data", friction, limit(order, 1.0), gn=gn, order=order), [False, True], f"order {order}")
            for (stable, fraction), f in zip(self.stable, (0.97, 1.03)):
                self.assert_close(stable, limit(order, 0.5), 1e-9)      # of two free spheres
                self.assert_close(fraction, f * limit(order, 1.0) / stable, 1e-9)
            self.assertIn("are stable with the damping of their contacts", self.log)

    def test_said(self):
        """Of the stability limit alone, where the time step is below 20 % of the critical one."""
        write_sphere_data(self.path("data"), ((-3, 3),) * 3, cage(), types=2)
        friction = f"tangential multistep {2 / 7!r} 0.6 1e9 slider midpoint limit_damping"
        for order, said in (1, False), (2, True):
            self.grows("data", friction, 0.13, gn=0.6, order=order)
            self.assertEqual("are stable with the damping of their contacts" in self.log, said, f"order {order}")
            self.assertNotIn("is advised", self.log)

    def test_lattice(self):
        spheres, edge = lattice()
        write_sphere_data(self.path("data"), ((0, edge),) * 3, spheres, types=2)
        # zone boundary: longitudinal without friction, coupled to rotation with it
        for friction, limit in ("", math.sqrt(0.5)), (STICKS.format(2 / 7), math.sqrt(0.35)):
            self.assertEqual(self.grows("data", friction, limit, "p p p"), [False, True], friction)


GAS = begin("si", "p p p", law="hertz/material {young!r} 1.0 0.3", skin=0.1) + """
fix move all nve/sphere/symplectic
compute t all timestep/gran
thermo_style custom step c_t[1] c_t[2] c_t[3]
timestep 1e-30
run 0
variable dt equal {fraction}*ternary(c_t[1]<c_t[2],c_t[1],c_t[2])
timestep ${{dt}}
compute account all penalty/stats
compute k all ke
variable total equal c_k+c_account[4]
thermo_style custom step c_k c_account[4] v_total
thermo_modify norm no
fix mean all ave/time 1 200 {half} v_total
thermo {half}
run 0
variable begin string $(v_total)
run {steps}
print "RESULT $(f_mean/v_begin-1)"
"""


class Stiff(SceneCase):
    """An elastic gas neither gains nor loses energy at the time step that is advised for it, however stiff its spheres are."""

    STEPS = 8000

    def grown(self, young, fraction):
        draw = random.Random(9)
        spheres = [Sphere((1.3 * (k % 4) + 0.6, 1.3 * (k // 4 % 4) + 0.6, 1.3 * (k // 16) + 0.6),
                          [draw.gauss(0, 1) for _ in "xyz"], density=1000.0) for k in range(64)]
        write_sphere_data(self.path("data"), ((0, 5.2),) * 3, spheres)
        log = self.run_lammps(GAS.format(young=young, fraction=fraction, steps=self.STEPS, half=self.STEPS // 2)).log
        grown, = [float(line.split()[1]) for line in log.splitlines() if line.startswith("RESULT ")]
        said = "no contact has damping or friction" in log
        print(f"E = {young:g}, dt {fraction} critical: energy {grown:+.1e}" + ", warned" * said)
        return grown, said

    def test_energy(self):
        for young in 1e8, 1e12:
            grown, said = self.grown(young, 0.0699)
            self.assertLess(abs(grown), 5e-4)
            self.assertFalse(said)
        grown, said = self.grown(1e8, 0.2)
        self.assertTrue(said, "impacts go astray here, by chance in both directions")
        self.assertLess(abs(grown), 1e-2)


if __name__ == "__main__":
    unittest.main()
