# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""fix gravity with the suffix beside fix rigid/small: where the order in the script matters in LAMMPS, the log says what differs."""

import unittest

from talus_testing import SceneCase, head, read_dump

SCRIPT = head() + """
fix body all property/atom mol ghost yes
region box block -5 5 -5 5 -5 5
create_box 1 box
create_atoms 1 single -0.2 0 0
create_atoms 1 single 0.7 0 0
create_atoms 1 single 0 3 0
create_atoms 1 single 0.9 3 0
set group all diameter 1 density 1
set atom 1*2 mol 1
set atom 3*4 mol 2
pair_style gran/hooke/history 1e5 NULL 50 NULL 0.5 1
pair_coeff * *
neigh_modify exclude molecule/intra all
{fixes}
timestep 0.001
thermo_style custom step
run 1
write_dump all custom after id vz modify format float %.17g
run 1
"""
RIGID, GRAVITY = "fix r all rigid/small molecule", "fix g all gravity 1 vector 0 0 -1"
WARNING = "in LAMMPS the bodies of fix r do not fall in the first half step of a run"


class SuffixGravity(SceneCase):

    def test_behind_rigid_bodies(self):
        for order, words, fallen in ((f"{RIGID}\n{GRAVITY}", (), 0.5), (f"{RIGID}\n{GRAVITY}", ("-sf", "talus"), 1.0),
                                     (f"{GRAVITY}\n{RIGID}", (), 1.0), (f"{GRAVITY}\n{RIGID}", ("-sf", "talus"), 1.0)):
            for np in (1, 2) if words and order.startswith(RIGID) else (1,):
                with self.subTest(order=order, words=words, ranks=np):
                    log = self.run_lammps(SCRIPT.format(fixes=order), np=np, arguments=words).log
                    for velocity in read_dump(self.path("after"))[0].column("vz").values():
                        self.assertAlmostEqual(velocity, -0.001 * fallen, delta=1e-12)
                    self.assertEqual(log.count(WARNING), 1 if words and order.startswith(RIGID) else 0)


if __name__ == "__main__":
    unittest.main()
