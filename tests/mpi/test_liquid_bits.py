# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=20 timeout=240
"""Liquid of particles that fly and hit each other, half of them wet at first, of two materials, in a periodic box and between wet
walls: the same bits on any ranks and threads, with other neighbor lists, after a restart; the sum stays."""

import itertools
import math
import random
import unittest

from talus_testing import SceneCase, Sphere, head, read_dump, write_sphere_data

SIDE, SPACING, STEPS, HALF = 7, 1.1, 1500, 700
DRY = "hertz/material 2e4 0.7 0.3 tangential multistep NULL NULL 0.4 adhesion willett"
LAWS = f"""
pair_style gran/penalty
pair_coeff 1 1 {DRY} 0.3 20 fraction 0.01 viscosity 0.05 0.05 share 0.9
pair_coeff 2 2 {DRY} 0.2 40 volume 0.02 share 0.5 viscosity 0.02 0.05
"""
HAVE = "fix liquid all property/atom d_liquid ghost yes\n"
WET = """
variable wet atom "(x > 4)*0.05*radius^2"
set group all d_liquid v_wet
"""
PHYSICS = """
neighbor {skin} bin
timestep 1e-3
fix step all nve/sphere/symplectic
compute liquid all property/atom d_liquid
compute sum all reduce sum c_liquid
thermo_style custom step c_sum
thermo_modify norm no
thermo 500
"""
COLUMNS = "x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz d_liquid"
END = f"write_dump all custom {{}} id {COLUMNS} modify format float %a\n"
LENGTH = SIDE * SPACING
WALLS = "".join(f"fix {axis}{end} all large/body plane {' '.join('0' if a != axis else str(place) for a in 'xyz')} "
                f"{' '.join('0' if a != axis else str(side) for a in 'xyz')} contact {DRY} 0.3 20 volume 0.002\n"
                for axis in "xyz" for end, place, side in (("lo", 0, 1), ("hi", LENGTH, -1)))


class Stirred(SceneCase):

    def setUp(self):
        draw = random.Random(5)
        sites = list(itertools.product(range(SIDE), repeat=3))
        draw.shuffle(sites)
        grains = [Sphere(tuple(SPACING * (s + 0.5) + draw.uniform(-0.05, 0.05) for s in site),
                         tuple(draw.uniform(-1.5, 1.5) for _ in range(3)), diameter=draw.uniform(0.7, 1.0), type=draw.choice((1, 2)))
                  for site in sites]
        write_sphere_data(self.path("data"), ((0, LENGTH),) * 3, grains)

    def frame(self, name, walls="", between="", skin=0.3, steps=STEPS, **options):
        start = head(boundary="f f f" if walls else "p p p")
        script = start + "read_data data\n" + HAVE + WET + LAWS + PHYSICS.format(skin=skin) + walls + END.format(name + ".first")
        self.run_lammps(script + between + f"run {steps}\n" + END.format(name), **options)
        return read_dump(self.path(name))[0]

    def liquid_stays(self, last):
        first, last = (list(frame.column("d_liquid").values()) for frame in (read_dump(self.path("one.first"))[0], last))
        print(f"\n{sum(v > 0 for v in first)} -> {sum(v > 0 for v in last)} wet grains of {len(last)}, "
              f"error of the sum {math.fsum(last) / math.fsum(first) - 1:.1e}")
        self.assertGreater(sum(v > 0 for v in last), sum(v > 0 for v in first) + 5)
        self.assertGreaterEqual(min(last), 0)
        self.assert_close(math.fsum(last), math.fsum(first), 1e-13)

    def test_ranks_and_threads(self):
        one = self.frame("one")
        self.liquid_stays(one)
        for name, options in (("two", {"np": 2}), ("threads", {"env": {"OMP_NUM_THREADS": 2}}),
                              ("overlap", {"np": 2, "between": "run_style verlet/proxy overlap yes\n"}),
                              ("stock", {"np": 2, "between": "run_style verlet/stock\ncomm_proxy no\n"}),
                              ("tiled", {"np": 2, "between": "comm_style tiled\nbalance 1.0 rcb\n"})):
            with self.subTest(name):
                self.assert_same_bits(one, self.frame(name, **options))

    def test_lists_runs_and_restart_files(self):
        one = self.frame("one", WALLS)
        self.liquid_stays(one)
        for name, options in (("skin", {"skin": 0.12, "np": 2}), ("pieces", {"steps": f"{HALF}\nrun {STEPS - HALF}"})):
            with self.subTest(name):
                self.assert_same_bits(one, self.frame(name, WALLS, **options))
        self.frame("half", WALLS, steps=f"{HALF}\nwrite_restart half.restart")
        for np in 1, 2:
            with self.subTest(np=np):
                self.run_lammps(head(boundary="f f f") + "read_restart half.restart\n" + HAVE + PHYSICS.format(skin=0.3) + WALLS +
                                f"run {STEPS - HALF}\n" + END.format("again"), np=np)
                self.assert_same_bits(one, read_dump(self.path("again"))[0])


if __name__ == "__main__":
    unittest.main()
