# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=200
"""Balancing by contacts: a heap in a corner and a drum, divided among four ranks such that each has the same number of them."""

import unittest

from talus_testing import SceneCase, head, read_dump, thermo

SCENE = head("si") + """
comm_style tiled
region box block -1 1 -0.4 0.4 -1 1
create_box 1 box
pair_style gran/penalty
pair_coeff * * hertz 1e6 50 tangential multistep NULL NULL 0.5
neighbor 0.01 bin
{walls}
fill_region grains 1 fraction 0.4 diameter uniform 0.06 0.1 mass density 2500 seed 5
fix step all nve/sphere/symplectic gravity 9.81 vector 0 0 -1
timestep 1e-4
{balance}
thermo_style custom step atoms ke {columns}
thermo 500
run 3000
write_dump all custom state id x y z vx vy vz omegax omegay omegaz modify sort id format float %a
"""
LAW = "contact hertz 1e6 50 tangential multistep NULL NULL 0.5"
HEAP = f"""region grains block -0.95 -0.2 -0.35 0.35 -0.95 -0.1
fix floor all large/body plane 0 0 -1 0 0 1 {LAW}
fix back all large/body plane -1 0 0 1 0 0 {LAW}
fix left all large/body plane 0 -0.4 0 0 1 0 {LAW}
fix right all large/body plane 0 0.4 0 0 -1 0 {LAW}"""
DRUM = f"""region grains block -0.6 0.6 -0.35 0.35 -0.6 0.1
fix drum all large/body cylinder 0 0 0 0 1 0 0.9 0.8 inside move rotate 0 0 0 0 1 0 4 {LAW}"""
BALANCE = """compute touching all contact/gran/atom
variable load atom 1+c_touching[1]
fix even all balance 100 1.02 rcb weight var load"""


class BalanceByContacts(SceneCase):

    def simulate(self, walls, balance, np):
        log = self.run_lammps(SCENE.format(walls=walls, balance=balance, columns="f_even" if balance else ""), np=np).log
        frame, = read_dump(self.path("state"))
        return log, frame

    def test_heap_and_drum(self):
        for name, walls in ("heap", HEAP), ("drum", DRUM):
            with self.subTest(name):
                log, frame = self.simulate(walls, BALANCE, 4)
                self.assertRegex(log, r"steps without output +in the records")
                rows = thermo(log)
                self.assertGreater(rows[0]["Atoms"], 400)
                self.assertLess(max(row["f_even"] for row in rows[1:]), 1.1)
                self.assert_same_bits(frame, self.simulate(walls, "", 1)[1])


if __name__ == "__main__":
    unittest.main()
