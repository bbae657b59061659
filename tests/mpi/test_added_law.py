# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""A contact law that is added by one file, tests/added_law/stiffening.cpp, and used from an input script: forces, what
it remembers, energy, critical time step, log, restart files; same bits on 1, 2 and 4 ranks and 2 threads."""

import math
import os
import random
import re
import unittest

from talus_testing import SceneCase, Sphere, head, read_dump, write_sphere_data

PLUGIN = os.path.join(os.environ["TALUS_BINARY_DIR"], "added")
WITH_LAW = {"LAMMPS_PLUGIN_PATH": PLUGIN}
STIFFNESS, SPEED = 2e4, 0.5

HEAD = head("si")
COLUMNS = "x y z vx vy vz omegax omegay omegaz fx fy fz".split()
BED = """
pair_style gran/penalty
pair_coeff * * stiffening {k} {v} 20.0 tangential multistep NULL NULL 0.4 rolling 0.05 adhesion constant 1.0
"""
PHYSICS = """
timestep 2e-4
fix step all nve/sphere/symplectic start half gravity 10.0 vector 0.1 0 -1
fix floor all large/body plane 0 0 -0.6 0 0 1 contact stiffening {k} {v} 20.0 tangential multistep NULL NULL 0.4
fix wall all large/body plane -0.7 0 0 1 0 0 contact stiffening {k} {v} 20.0 tangential multistep NULL NULL 0.4
thermo 1000
"""
NUMBERS = {"k": STIFFNESS, "v": SPEED}
DUMP = f"write_dump all custom last id {' '.join(COLUMNS)} modify format float %a\n"


class AddedLaw(SceneCase):

    def state(self, text, **options):
        self.run_lammps(text, **{"env": WITH_LAW, **options})
        return read_dump(self.path("last"))[-1]

    def test_same_bits(self):
        draw = random.Random(5)
        spheres = [Sphere(tuple(1.08 * n + draw.uniform(-0.05, 0.05) for n in (i, j, k)),
                          tuple(draw.gauss(0, 2) for _ in "xyz"), tuple(draw.gauss(0, 4) for _ in "xyz"),
                          draw.uniform(0.8, 1.05)) for i in range(4) for j in range(4) for k in range(4)]
        write_sphere_data(self.path("data"), ((-3, 8), (-3, 7), (-1.5, 9)), spheres)
        scene = f"{HEAD}read_data data\n{BED}{PHYSICS}".format(**NUMBERS)
        once = self.state(f"{scene}run 400\n{DUMP}")
        self.assertGreater(max(abs(z) for z in once.column("fz").values()), 100.0)
        for np, threads in (2, 1), (4, 1), (1, 2), (2, 2):
            with self.subTest(ranks=np, threads=threads):
                frame = self.state(f"{scene}run 400\n{DUMP}", np=np,
                                   env={**WITH_LAW, "OMP_NUM_THREADS": threads})
                self.assert_same_bits(frame, once, COLUMNS)
        self.run_lammps(f"{scene}run 200\nwrite_restart middle\n", np=2, env=WITH_LAW)
        again = f"{HEAD}read_restart middle\n{PHYSICS}run 200\n{DUMP}".format(**NUMBERS)
        self.assert_same_bits(self.state(again), once, COLUMNS)

        log = self.run_lammps(again, expect_error=True, env={}).log
        self.assertRegex(log, r"ERROR: Pair style gran/penalty: types 1 and 1: the restart file has the normal law "
                              r"'stiffening', which this Talus does not have: write a data file")

    def test_impact(self):
        """Two spheres meet at 2 v: duration pi sqrt(m_eff/K) with K = k (1 + 2 v/v_s), no energy lost."""
        speed, diameter, density = 1.5, 1.0, 1000.0
        mass = density * math.pi / 6 * diameter ** 3
        stiff = STIFFNESS * (1 + 2 * speed / SPEED)
        duration, dt = math.pi * math.sqrt(mass / 2 / stiff), 1e-4
        steps = round(0.5 * duration / dt)
        write_sphere_data(self.path("pair"), ((-3, 3), (-3, 3), (-3, 3)),
                          [Sphere((-0.5 * diameter, 0, 0), (speed, 0, 0), (0, 0, 0), diameter, density=density),
                           Sphere((0.5 * diameter, 0, 0), (-speed, 0, 0), (0, 0, 0), diameter, density=density)])
        log = self.run_lammps(f"""{HEAD}
read_data pair
pair_style gran/penalty
pair_coeff * * stiffening {STIFFNESS} {SPEED} 0.0
fix step all nve/sphere/symplectic
compute s all penalty/stats
compute t all timestep/gran
variable overlap equal 1.0-(x[2]-x[1])
timestep {dt}
thermo 1
thermo_style custom step ke c_s[4] c_t[1] v_overlap
thermo_modify format float %.15g
run {2 * steps + 40}
""", env=WITH_LAW).log
        self.assertIn(f"types 1 1: stiffening + none; k {STIFFNESS:g} vs {SPEED:g} gn 0", log)
        table = [list(map(float, line.split())) for line in log.splitlines() if re.fullmatch(r"[\s\d.e+-]+", line)
                 and len(line.split()) == 5]
        overlap = [row[-1] for row in table]
        deepest = overlap.index(max(overlap))
        self.assertAlmostEqual(deepest * dt, 0.5 * duration, delta=2 * dt)
        self.assert_close(max(overlap), 2 * speed * math.sqrt(mass / 2 / stiff), 1e-3)
        kinetic = table[0][1]
        self.assert_close(kinetic, mass * speed ** 2, 1e-9)
        self.assert_close(table[deepest][2], kinetic, 1e-3)
        for row in table:
            self.assert_close(row[1] + row[2], kinetic, 5e-3, f"energy in step {row[0]:g}")
        self.assert_close(table[-1][1], kinetic, 1e-3)
        # of a contact of which nothing is known yet
        self.assert_close(table[-1][3], math.sqrt(mass / 2 / STIFFNESS), 1e-12)


if __name__ == "__main__":
    unittest.main()
