# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=5 timeout=120
"""Boxes that are driven with `remap v`: velocities at borders follow the speed of the sides, also where a side follows a pressure
or a volume, for which LAMMPS tells a rate of strain."""

import math
import unittest

from talus_testing import SceneCase, read_dump

# pressure: so far from the target that the rate is the largest one
SCRIPT = """
units lj
newton off
atom_style sphere
atom_modify map array
comm_modify vel yes
boundary p p p
region box block 0 8 0 6 0 7
create_box 1 box
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
RATE, DT = 0.1, 0.001
TOLD = "needs? the speed of the side"


class DrivenBoxes(SceneCase):

    def velocities(self, drive, np=1, words=("-sf", "talus")):
        log = self.run_lammps(SCRIPT.format(drive=drive), arguments=words, np=np).log
        frame = read_dump(self.path("dump"))[-1]
        return [list(frame.column(name).values()) for name in ("vx", "vy", "vz")], log

    def check(self, drive, reference, np=1):
        expected, _ = self.velocities(reference, np)
        found, log = self.velocities(drive, np)
        for mine, theirs in zip(found, expected):
            worst = max(abs(a - b) for a, b in zip(mine, theirs))
            # newer hosts know a rate of strain, but no pressure, one step earlier; with LAMMPS' own speeds .08
            self.assertLess(worst, 4e-2 * max(map(abs, expected[0])))
        self.assertRegex(log, TOLD)

    def test_a_side_that_follows_a_pressure(self):
        strain = math.log1p(-RATE * DT) / DT
        for np in 1, 2:
            self.check(f"fix drive all deform/pressure 1 x pressure 1e9 1.0 max/rate {RATE} remap v",
                       f"fix drive all deform 1 x trate {strain!r} remap v", np)

    def test_sides_that_keep_the_volume(self):
        self.check(f"fix drive all deform 1 x trate {-RATE} y volume z volume remap v",
                   f"fix drive all deform 1 x trate {-RATE} y trate {RATE / 2} z trate {RATE / 2} remap v")

    def test_others_are_told_as_they_are(self):
        for drive in "x erate -0.1", "x trate -0.1", "x final 0.2 7.8", "x vel -0.5", "x wiggle 0.1 1.0", "x delta 0.1 -0.1 y erate 0.05":
            mine, log = self.velocities(f"fix drive all deform 1 {drive} remap v")
            stock, _ = self.velocities(f"fix drive all deform 1 {drive} remap v", words=())
            self.assertNotRegex(log, TOLD)
            for one, other in zip(mine, stock):
                self.assertLess(max(abs(a - b) for a, b in zip(one, other)), 1e-9)


if __name__ == "__main__":
    unittest.main()
