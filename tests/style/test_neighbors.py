# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=240 procs=2
"""Neighbors that pair_style gran/penalty finds itself, against the lists of LAMMPS: the same bits.

As the only part of pair_style hybrid it takes the lists of LAMMPS.  What neigh_modify excludes is excluded in both."""

import os
import re
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "lib"))
from talus_testing import SceneCase, write_sphere_data
from tossed_grains import tossed_grains

LAW = "hertz 4000.0 40.0 tangential multistep NULL NULL 0.5"
OWN = "Talus gran/penalty: finds neighbors itself"
HOST = "Talus gran/penalty: neighbor lists are those of LAMMPS: "
SCENE = """
units lj
boundary {boundary}
atom_style sphere
atom_modify map yes
newton off
comm_modify vel yes
read_data grains
group low id <= 60
group high subtract all low
{pair}
neighbor 0.1 bin
neigh_modify every 1 delay 0 check yes
{more}
timestep 0.001
fix step all nve/sphere/symplectic gravity 4.0 vector 0.3 0.1 -1
fix floor all large/body plane 0 0 0  0 0 1  contact {law}
compute touching all contact/atom
compute pairs all pair gran/penalty
compute number all reduce sum c_touching
thermo_style custom step c_number c_pairs[1] c_pairs[2]
thermo_modify norm no lost ignore
thermo 20
dump all all custom 20 dump id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz c_touching
dump_modify all format float %a sort id
run 120
"""
ALONE = "pair_style gran/penalty\npair_coeff * * " + LAW
IN_HYBRID = "pair_style hybrid gran/penalty\npair_coeff * * gran/penalty " + LAW


class Neighbors(SceneCase):

    def setUp(self):
        super().setUp()
        grains = tossed_grains(3)
        for grain in grains[::2]:
            grain.type = 2
        write_sphere_data(self.path("grains"), ((0, 9.5), (0, 7.2), (-0.5, 6.5)), grains)

    def run_scene(self, pair=ALONE, boundary="f f f", more="", np=1, **options):
        """The dump, the log and the rows of thermo output."""
        log = self.run_lammps(SCENE.format(pair=pair, boundary=boundary, more=more, law=LAW), np=np, cwd=self.dir,
                              **options).log
        with open(self.path("dump")) as file:
            frames = file.read()
        rows = [list(map(float, row)) for row in re.findall(r"^ +(\d+) +(\S+) +(\S+) +(\S+) *$", log, re.M)]
        return frames, log, rows

    def assert_same(self, **options):
        own, log, rows = self.run_scene(**options)
        self.assertIn(OWN, log)
        host, log, _ = self.run_scene(pair=IN_HYBRID, **options)
        self.assertIn(HOST + "pair style hybrid", log)
        self.assertGreater(own.count("TIMESTEP"), 5)
        self.assertEqual(own, host)
        return own, rows

    def test_same_bits_as_with_the_lists_of_lammps(self):
        for np in 1, 2:
            with self.subTest(ranks=np):
                self.assert_same(np=np, env={"OMP_NUM_THREADS": "3"})

    def test_periodic_box(self):
        self.assert_same(boundary="p p f", np=2, more="neigh_modify every 10 check no")

    def test_contacts_are_those_that_lammps_counts(self):
        _, rows = self.assert_same()
        self.assertGreater(len(rows), 5)
        self.assertGreater(rows[-1][1], 20)
        for _, touching, contacts, candidates in rows:
            self.assertEqual(touching, 2 * contacts)    # contact/atom counts both sides
            self.assertGreater(candidates, contacts)

    def test_what_is_excluded(self):
        everything = self.assert_same()[0]
        seen = {everything}
        for words in "type 1 2", "group low high", "type 1 1":
            with self.subTest(exclude=words):
                seen.add(self.assert_same(more="neigh_modify exclude " + words)[0])
        self.assertEqual(len(seen), 4)

    def test_lists_of_a_group_are_those_of_lammps(self):
        _, log, _ = self.run_scene(more="atom_modify first low\nneigh_modify include low")
        self.assertIn(HOST + "they are those of a group", log)


if __name__ == "__main__":
    unittest.main()
