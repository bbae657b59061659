# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""A small bed of grains on a frozen layer, run with gran/penalty and with the stock style of the same law."""

import os
import random

from talus_testing import SceneCase, Sphere, max_difference, read_dump, write_sphere_data

STOCK = "pair_style gran/hooke/history 3000.0 NULL 20.0 NULL 0.5 1\npair_coeff * *"
TALUS = "pair_style gran/penalty\npair_coeff * * hooke 3000.0 20.0 tangential multistep NULL NULL 0.5"

SCRIPT = """
units lj
{before}
boundary {boundary}
{atom_style}
atom_modify map yes
newton off
comm_modify vel yes
read_data grains
{box}
group base type 2
group grains type 1
{pair}
neighbor 0.3 bin
timestep 0.001
fix gravity all gravity 2.0 vector {gravity} -1
thermo 100
thermo_modify norm no lost error
{commands}
run {steps}
write_dump all custom state id type diameter x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz &
    modify format float %.17g
"""
MOVE, FREEZE = "fix step grains nve/sphere", "fix hold base freeze"
BED = f"{MOVE}\n{FREEZE}\nneigh_modify exclude group base base"
MOTION = "x y z vx vy vz omegax omegay omegaz".split()


def grains():
    """One layer that may be frozen (type 2) under six layers of loose grains (type 1)."""
    draw = random.Random(3)
    found = []
    for k in range(7):
        for site in ((i, j) for i in range(6) for j in range(6)):
            x = tuple(s + 0.5 + draw.uniform(-0.1, 0.1) for s in (*site, 0.95 * k))
            motion = [tuple(draw.gauss(0, 1.0) for _ in "xyz") for _ in "vw"]
            if k < 1:
                found.append(Sphere(x, diameter=draw.uniform(0.9, 1.1), type=2))
            else:
                found.append(Sphere(x, *motion, diameter=draw.uniform(0.85, 1.15), type=1))
    draw.shuffle(found)
    return found


class BedCase(SceneCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), ((0, 6), (0, 6), (-2, 14)), grains())

    def simulate(self, pair, commands, np=2, steps=200, atom_style="atom_style sphere", before="",
                 box="", gravity="0.3 0.1",
                 boundary="p p f", **options):
        self.log = self.run_lammps(SCRIPT.format(
            pair=pair, commands=commands, steps=steps, box=box, atom_style=atom_style,
            before=before, gravity=gravity, boundary=boundary), np=np, **options).log
        frame, = read_dump(self.path("state"))
        os.remove(self.path("state"))
        return frame

    def assert_same_motion(self, frame, reference, limit=1e-9):
        self.assertEqual(sorted(frame.atoms), sorted(reference.atoms))
        found = max_difference(frame, reference, MOTION)
        self.assertLess(found, limit)
        return found
