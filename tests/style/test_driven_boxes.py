# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=5 timeout=120
"""Boxes that are driven with `remap v`: velocities at borders follow the speed of the sides, also where a side follows a pressure
or a volume, for which LAMMPS tells a rate of strain."""

import math
import unittest

from talus_testing import SceneCase, read_dump

HEAD = """
units lj
newton off
atom_style sphere
atom_modify map array
comm_modify vel yes
boundary p p p
region box block 0 8 0 6 0 7
create_box 1 box
"""
# two grains at rest across each border: what acts between them is damping, by the speed at which the border moves; held by nothing
ACROSS = HEAD + """
create_atoms 1 single 0.5 2 2
create_atoms 1 single 7.55 2 2
create_atoms 1 single 4 0.5 2
create_atoms 1 single 4 5.55 2
create_atoms 1 single 4 4 0.5
create_atoms 1 single 4 4 6.55
set group all diameter 1.0
set group all density 1.0
pair_style gran/hooke 1e-9 NULL 20 NULL 0 0
pair_coeff * *
neighbor 0.3 bin
timestep 0.001
{drive}
dump all all custom 10 dump id fx fy fz
dump_modify all sort id format float %.17g
run 10
"""
BED = HEAD + """
lattice sc 1.0 origin 0.5 0.5 0.5
create_atoms 1 box
displace_atoms all random 0.02 0.02 0.02 7
set type 1 diameter 1.0 density 1.0
velocity all ramp vx 0.4 -0.4 x 0 8
pair_style gran/hooke/history 1000 NULL 20 NULL 0.3 1
pair_coeff * *
neighbor 0.3 bin
timestep 0.001
fix move all nve/sphere
{drive}
dump all all custom 300 dump id vx vy vz
dump_modify all sort id format float %.17g
run 300
"""
LENGTHS, RATE, DAMPING = (8, 6, 7), 0.1, 20
HALF_MASS = math.pi / 12
TOLD = "needs? the speed of the side"


# two grains that meet across borders, in a box whose speeds change
MEET = """
units lj
atom_style sphere
atom_modify map yes
newton off
comm_modify vel yes
boundary p p p
region box block -0.55535 2.55977 -0.55125 2.54556 -0.55732 2.54937
create_box 1 box
change_box all triclinic
create_atoms 1 single 0.022 0.968 2.045
create_atoms 1 single 0.034 1.946 1.944
set group all diameter 1.0 density 1.0
velocity all set -2.05 3.646 -0.963
set atom 2 vx 0 vy 0 vz 0
pair_style gran/penalty
pair_coeff * * hertz 17071 31.23 tangential multistep NULL NULL 0.25 slider midpoint limit_damping
timestep 0.0005
fix step all nve/sphere/symplectic order 2
fix drive all deform 1 x trate -0.44 xy erate 15.57 remap v
{outputs}
run 40
write_dump all custom end id x y z vx vy vz omegax omegay omegaz modify sort id format float %a
"""


class DrivenBoxes(SceneCase):

    def check_across(self, drive, strains, words=("-sf", "talus")):
        """Forces on the grains at the lower borders are those of sides with these rates of strain, but for what lengths change in
        ten steps."""
        for np in 1, 2, 4:
            log = self.run_lammps(ACROSS.format(drive=drive), arguments=words, np=np).log
            frame = read_dump(self.path("dump"))[-1]
            for k, (name, length, strain) in enumerate(zip(("fx", "fy", "fz"), LENGTHS, strains)):
                self.assertAlmostEqual(frame.column(name)[2 * k + 1], -DAMPING * HALF_MASS * length * strain,
                                       delta=2e-3 * DAMPING * HALF_MASS * length * RATE, msg=f"{name} on {np} ranks")
            self.assertRegex(log, TOLD)

    def test_sides_that_follow_a_pressure(self):
        """So far from its target that the rate is the largest one."""
        self.check_across(f"fix drive all deform/pressure 1 x pressure 1e9 1.0 z pressure -1e9 1.0 max/rate {RATE} remap v", (-RATE, 0, RATE))

    def test_sides_that_keep_the_volume(self):
        self.check_across(f"fix drive all deform 1 x trate {-RATE} y volume z volume remap v", (-RATE, RATE / 2, RATE / 2))

    def test_outputs_change_no_bit_of_order_2(self):
        ends = []
        for outputs in "", "thermo 2\ncompute s all stress/atom NULL\ncompute sum all reduce sum c_s[1]\nthermo_style custom step pxx c_sum\n":
            for np in 1, 2:
                self.run_lammps(MEET.format(outputs=outputs), np=np)
                ends += read_dump(self.path("end"))
        for end in ends[1:]:
            self.assert_same_bits(end, ends[0])
        self.assertGreater(abs(ends[0].column("vx")[2]), 0.1)    # they have met

    def test_others_are_told_as_they_are(self):
        for drive in "x erate -0.1", "x trate -0.1", "x final 0.2 7.8", "x vel -0.5", "x wiggle 0.1 1.0", "x delta 0.1 -0.1 y erate 0.05":
            found = []
            for words in ("-sf", "talus"), ():
                log = self.run_lammps(BED.format(drive=f"fix drive all deform 1 {drive} remap v"), arguments=words).log
                self.assertNotRegex(log, TOLD)
                found.append(read_dump(self.path("dump"))[-1])
            for name in "vx", "vy", "vz":
                mine, theirs = (frame.column(name) for frame in found)
                self.assertLess(max(abs(mine[tag] - theirs[tag]) for tag in mine), 1e-9)


if __name__ == "__main__":
    unittest.main()
