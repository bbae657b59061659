# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=200
"""Energies of clumps: kinetic (compute ke/rigid, erotate/rigid), gravitational, elastic and dissipated ones of a heap that
collapses and comes to rest add up to a constant, to second order in the time step, with order 1 and 2, on more ranks with
the same numbers; contacts between spheres of one clump are none."""

import unittest

from talus_testing import SceneCase, head, thermo
from tossed_clumps import write_clumps

LAW = "hertz/material 1e6 0.5 0.3 tangential multistep NULL NULL 0.5 slider midpoint limit_damping"
WALLS = "0 0 0  0 0 1", "0 0 0  1 0 0", "9 0 0  -1 0 0", "0 0 0  0 1 0", "0 9 0  0 -1 0"
HEAP = head() + """
fix prop all property/atom mol ghost yes
read_data grains fix prop NULL Molecules
velocity all set 0 0 0
set group all omega 0 0 0
group clumps molecule > 0
group singles subtract all clumps
neighbor 0.2 bin
neigh_modify every 1 delay 0 check yes exclude molecule/intra clumps
comm_proxy yes
run_style verlet/proxy
pair_style gran/penalty
pair_coeff * * {law}
fix move clumps rigid/small/symplectic molecule {order}
fix single singles nve/sphere/symplectic {order}
fix fall all gravity/talus 10 vector 0.2 0 -1
fix_modify fall energy yes
{walls}
compute s all penalty/stats
compute k clumps ke/rigid move
compute r clumps erotate/rigid move
compute ks singles ke
compute rs singles erotate/sphere
timestep {dt!r}
thermo_style custom step f_fall c_k c_r c_ks c_rs c_s[2] c_s[4] c_s[5] c_s[6]
thermo_modify format float %.17g norm no
thermo {every}
run {steps}
"""
KINETIC = "c_k", "c_r", "c_ks", "c_rs"


class ClumpEnergy(SceneCase):

    def rows(self, time, steps, order="start half", np=1):
        write_clumps(self.path("grains"))
        walls = "\n".join(f"fix w{n} all large/body plane {w} contact {LAW}" for n, w in enumerate(WALLS))
        log = self.run_lammps(HEAP.format(law=LAW, walls=walls, order=order, dt=time / steps, steps=steps, every=steps), np=np).log
        self.assertTrue("in the records" in log, "not in the records")
        rows = thermo(log)
        self.assertEqual(rows[0]["c_s[2]"], 1)    # with a wall, and none of spheres that overlap in a clump
        return rows

    def deviation(self, rows):
        """Of the sum of all energies at the end, relative to what the heap has fallen."""
        first, last = (row["f_fall"] + sum(row[c] for c in KINETIC) + sum(row[f"c_s[{n}]"] for n in (4, 5, 6))
                       for row in (rows[0], rows[-1]))
        fallen = rows[0]["f_fall"] - rows[-1]["f_fall"]
        self.assertGreater(fallen, 0.8 * rows[0]["f_fall"])
        self.assertLess(sum(rows[-1][c] for c in KINETIC), 1e-2 * fallen)    # nearly at rest
        self.assertGreater(rows[-1]["c_s[2]"], 50)
        return abs(last - first) / fallen

    def test_balance(self):
        for order in "start half", "order 2":
            with self.subTest(order=order):
                coarse, fine = (self.deviation(self.rows(4.0, n, order)) for n in (12000, 48000))
                print(f"{order}: {coarse:.2e} {fine:.2e}")
                self.assertLess(fine, 3e-4)
                self.assertGreater(coarse / fine, 8.0)    # second order: 16, first: 4

    def test_damping_and_friction_take_energy_and_ranks_agree(self):
        one, two = self.rows(2.0, 6000)[-1], self.rows(2.0, 6000, np=2)[-1]
        for n in 4, 5, 6:
            self.assertGreater(one[f"c_s[{n}]"], 0.0)
            self.assertAlmostEqual(one[f"c_s[{n}]"] / two[f"c_s[{n}]"], 1.0, delta=1e-10)


if __name__ == "__main__":
    unittest.main()
