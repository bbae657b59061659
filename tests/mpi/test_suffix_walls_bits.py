# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=240
"""fix wall/gran/talus and wall/gran/region/talus: the same bits on any number of ranks and threads, with or without
overlap, and where every step goes through the arrays of LAMMPS; -sf talus chooses them."""

import unittest

from talus_testing import SceneCase, begin, read_dump, write_sphere_data
from tossed_grains import tossed_grains

LAW = "hooke/history 4000.0 NULL 20.0 NULL 0.5 0"
SCENE = begin(read="read_data grains", law="hertz 4000.0 40.0 tangential multistep NULL NULL 0.5", skin=0.1, dt=0.001,
              map=None) + f"""
fix step all nve/sphere/symplectic gravity 10.0 vector 0.3 0.1 -1
variable turn equal '3.0*time'
region drum cylinder y 4.75 3.0 6.2 -0.5 7.6 rotate v_turn 4.75 0 3.0 0 1 0
fix floor all wall/gran {LAW} zplane 0 NULL wiggle z 0.2 0.3
fix side all wall/gran {LAW} xplane 0 9.5 shear y 2.0
fix drum all wall/gran/region {LAW} region drum
{{more}}
comm_proxy yes
run_style verlet/proxy {{overlap}}
thermo 1000
thermo_modify norm no lost ignore
dump all all custom 100 dump id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz
dump_modify all format float %a sort id
run 600
"""


class Walls(SceneCase):

    def run_scene(self, np=1, threads=1, more="", overlap="overlap yes"):
        write_sphere_data(self.path("grains"), ((-1, 11), (-1, 9), (-1, 8)), tossed_grains(3))
        log = self.run_lammps(SCENE.format(more=more, overlap=overlap), np=np, arguments=("-sf", "talus"),
                              env={"OMP_NUM_THREADS": str(threads)}).log
        if not more:
            self.assertNotIn("through the arrays of LAMMPS", log)
        return read_dump(self.path("dump"))

    def test_same_bits(self):
        one = self.run_scene()
        self.assertGreater(len(one), 5)
        for options in ({"np": 2}, {"np": 4}, {"np": 4, "overlap": "overlap no"}, {"np": 2, "threads": 2},
                        {"np": 2, "more": "fix none all viscous 0.0"}):
            with self.subTest(**options):
                for frame, other in zip(one, self.run_scene(**options), strict=True):
                    self.assert_same_bits(frame, other)


if __name__ == "__main__":
    unittest.main()
