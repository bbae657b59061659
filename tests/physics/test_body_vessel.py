# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=200
"""A closed vessel of 10 000 triangles is shaken: no particle gets out, forces and torques balance in each step; at rest
it carries the weight of what it holds. test_body_vessel_long.py is the same with 20 000 particles for 20 000 steps."""

import math
import random
import unittest

import body_balance
import body_meshes
from talus_testing import SceneCase, Sphere, begin, read_dump, thermo, write_sphere_data

SCENE = begin(read="read_data grains", law="hertz 4e4 200 tangential multistep NULL NULL 0.4", skin=0.15, dt=0.001) + """
fix step all nve/sphere/symplectic gravity 5.0 vector 0 0 -1
variable t equal step*0.001
variable on equal step<{end}
# jerks to all sides, about 6 g
variable dx equal v_on*0.15*sin(9.0*v_t)*sin(2.0*v_t)
variable vx equal v_on*0.15*(9.0*cos(9.0*v_t)*sin(2.0*v_t)+2.0*sin(9.0*v_t)*cos(2.0*v_t))
variable dz equal v_on*0.2*sin(11.0*v_t)^2
variable vz equal v_on*0.2*22.0*sin(11.0*v_t)*cos(11.0*v_t)
fix vessel all large/body mesh vessel.stl contact hertz 4e4 200 tangential multistep NULL NULL 0.4 &
    move variable v_dx NULL v_dz v_vx NULL v_vz
thermo 1000
thermo_style custom step atoms ke f_vessel[20]
thermo_modify lost error norm no
run {shaken}
# friction between particles acts on each at the end of its own radius: their torques balance without it only
pair_coeff * * hertz 4e4 200
{balance}thermo 1
thermo_style custom step ke {columns}
thermo_modify norm no
run {watched}
pair_coeff * * hertz 4e4 200 tangential multistep NULL NULL 0.4
thermo 1000
thermo_style custom step atoms ke f_vessel[20]
fix drag all viscous 2.0
run {rest}
unfix drag
fix mean all ave/time 1 500 500 f_vessel[3]
thermo_style custom step atoms ke f_mean f_vessel[3]
thermo_modify lost error norm no format float %.12g
run 500
write_dump all custom state id radius mass x y z modify format float %.17g
"""


class Vessel(SceneCase):
    GRAINS, SHAKEN, REST = (7, 7, 7), 2500, 9000
    WATCHED = 100    # steps in which the third law is watched, while it is shaken
    RANKS = 1

    def test_nothing_gets_lost(self):
        draw = random.Random(4)
        n = self.GRAINS
        size = [1.08 * k + 0.3 for k in n]
        size[2] *= 1.5
        particles = [Sphere(tuple(1.08 * k + 0.7 + draw.uniform(-0.03, 0.03) for k in (i, j, l)),
                            diameter=draw.uniform(0.8, 1.05))
                     for l in range(n[2]) for j in range(n[1]) for i in range(n[0])]
        mesh = body_meshes.box((0, 0, 0), size, 29, inward=True)
        body_meshes.write_stl(self.path("vessel.stl"), mesh)
        write_sphere_data(self.path("grains"), [(-3, s + 3) for s in size], particles)
        log = self.run_lammps(SCENE.format(
            shaken=self.SHAKEN - self.WATCHED, watched=self.WATCHED, end=self.SHAKEN, rest=self.REST,
            balance=body_balance.script(["vessel"]), columns=body_balance.COLUMNS), np=self.RANKS, timeout=3000).log
        frame, = read_dump(self.path("state"))
        self.assertEqual(len(frame.atoms), len(particles))
        for axis, high in zip("xyz", size):
            for tag, x in frame.column(axis).items():
                self.assertGreater(x, 0.9 * frame.column("radius")[tag])
                self.assertLess(x, high - 0.9 * frame.column("radius")[tag])
        last = thermo(log)[-1]
        weight = 5.0 * math.fsum(frame.column("mass").values())
        shaking = max(row["KinEng"] for row in thermo(log))
        worst = body_balance.worst([row for row in thermo(log) if "c_scale" in row])
        print(f"{len(mesh)} triangles, {len(particles)} particles: force/weight {-last['f_mean'] / weight:.6f}, kinetic "
              f"energy {shaking:.3g} when shaken, {last['KinEng']:.2g} at rest, third law "
              f"to {worst:.1e} of the forces")
        self.assertLess(worst, 1e-10)
        self.assertGreater(shaking, 1e-2 * weight)
        self.assertAlmostEqual(-last["f_mean"] / weight, 1.0, delta=1e-3)


if __name__ == "__main__":
    unittest.main(verbosity=2)
