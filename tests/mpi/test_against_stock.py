# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""gran/penalty against the stock granular styles with the same law, particle by particle.

Both run the same script with fix nve/sphere from the same data file, on 1, 2 and 4 ranks."""

import collections
import math
import os
import random
import re
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "lib"))
from talus_testing import (SceneCase, Sphere, read_dump, read_local, relative_difference, thermo,
                           write_sphere_data)

RANKS = 1, 2, 4
STEPS = 1000

# name: (stock pair_style, gran/penalty words); the stock default of kt and gt is asked for by NULL
LAWS = {
    "hooke none": ("gran/hooke 2000.0 NULL 2.0 0.0 0.0 0", "hooke 2000.0 2.0"),
    "hooke dashpot": ("gran/hooke 2000.0 NULL 2.0 30.0 0.5 1",
                      "hooke 2000.0 2.0 tangential dashpot 30.0 0.5"),
    "hooke multistep": ("gran/hooke/history 2000.0 NULL 2.0 NULL 0.5 1",
                        "hooke 2000.0 2.0 tangential multistep NULL NULL 0.5"),
    "hooke multistep limit_damping": (
        "gran/hooke/history 2000.0 1500.0 20.0 30.0 0.3 1 limit_damping",
        "hooke 2000.0 20.0 tangential multistep 1500.0 30.0 0.3 limit_damping"),
    "hertz none": ("gran/hertz/history 10000.0 NULL 10.0 0.0 0.0 0", "hertz 10000.0 10.0"),
    "hertz multistep": ("gran/hertz/history 10000.0 NULL 10.0 NULL 0.5 1",
                        "hertz 10000.0 10.0 tangential multistep NULL NULL 0.5"),
    "hertz multistep limit_damping": (
        "gran/hertz/history 10000.0 8000.0 100.0 90.0 0.3 1 limit_damping",
        "hertz 10000.0 100.0 tangential multistep 8000.0 90.0 0.3 limit_damping"),
}

SCRIPT = """
units lj
boundary p p p
atom_style sphere
atom_modify map yes
newton off
comm_modify vel yes
read_data {data}
{pair}
neighbor 0.1 bin
neigh_modify every 1 delay 0 check yes
timestep 0.001
fix step all nve/sphere
compute stress all stress/atom NULL
thermo_style custom step pxx pyy pzz pxy pxz pyz
thermo_modify format float %.17g norm no
thermo 20
dump early all custom 20 early.* id fx fy fz tqx tqy tqz c_stress[*]
dump_modify early format float %.17g
run 20
undump early
{more}
"""
LONG = """
dump place all custom {steps} place.* id xu yu zu proc
dump_modify place format float %.17g
run {steps}
"""
COUNT = """
compute ends all property/local patom1 patom2 cutoff radius
dump ends all local 4 contacts index c_ends[*]
dump_modify ends format float %.0f
"""


def stock(words):
    return f"pair_style {words}\npair_coeff * *"


def talus(words):
    return f"pair_style gran/penalty\npair_coeff * * {words}"


def grains():
    """2000 fast spheres of diameter 0.8 to 1.2 that overlap, in a periodic box, drifting in x."""
    draw = random.Random(2)
    sites = [(i, j, k) for i in range(20) for j in range(10) for k in range(10)]
    draw.shuffle(sites)
    return [Sphere(tuple(s + 0.5 + draw.uniform(-0.15, 0.15) for s in site),
                   tuple(draw.gauss(mean, 1.0) for mean in (2.0, 1.0, 1.0)),
                   tuple(draw.gauss(0, 3.0) for _ in "xyz"), draw.uniform(0.8, 1.2))
            for site in sites]


def norm(values):
    return math.sqrt(sum(v * v for v in values))


def worst(frame, reference, columns):
    """Largest difference of a vector or tensor over particles, relative to its own length."""
    k = [frame.columns.index(c) for c in columns]
    return max(norm([row[n] - reference.atoms[tag][n] for n in k]) /
               (norm([reference.atoms[tag][n] for n in k]) or 1.0)
               for tag, row in frame.atoms.items())


FORCE, TORQUE = ("fx", "fy", "fz"), ("tqx", "tqy", "tqz")
STRESS = tuple(f"c_stress[{n}]" for n in range(1, 7))
PRESSURE = "Pxx Pyy Pzz Pxy Pxz Pyz".split()


if __name__ == "__main__":
    unittest.main()
