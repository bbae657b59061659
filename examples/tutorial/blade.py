#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""A blade is pushed into grains (in.blade) and drawn through them; its force is printed (doc/tutorial.md).

  scripts/run examples/tutorial/blade.py [-np 2] [-- --speed 0.3]"""

import argparse
import os

from lammps import lammps
from talus import Partner

X, Z, VX, VZ = 0, 2, 7, 9    # in the state of a body: position 3, quaternion 4, velocity 3, angular velocity 3

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--speed", type=float, default=0.2, help="m/s")
parser.add_argument("--depth", type=float, default=0.015, help="of the lower edge, below its place at the beginning (m)")
parser.add_argument("--way", type=float, default=0.03, help="through the grains (m)")
parser.add_argument("--every", type=int, default=50, help="steps between exchanges")
parser.add_argument("--out", default=".", help="folder of the log and of force.txt")
options = parser.parse_args()
out = os.path.abspath(options.out)
os.chdir(os.path.dirname(os.path.abspath(__file__)))

lmp = lammps(cmdargs=["-log", os.path.join(out, "log.blade"), "-screen", "none"])
lmp.file("in.blade")
lmp.command("log none")    # LAMMPS would write a head for each of many short runs
first = lmp.extract_setting("world_rank") == 0
rows = []


def move(partner, blade, vx, vz, length):
    """Draw the blade along at constant speed; a row for each exchange, the force on the blade as a mean over it."""
    state = list(blade.state)
    state[VX], state[VZ] = vx, vz
    blade.put_state(state)                  # at once: the new speed, in the same place
    for _ in range(round(length / options.speed / (options.every * partner.dt))):
        partner.advance(options.every)
        impulse, angular_impulse, work, time = blade.load()
        state = blade.state
        rows.append([1000 * state[X], 1000 * state[Z], impulse[0] / time, impulse[2] / time, work])


with Partner(lmp) as partner:
    blade = partner.body("blade")
    blade.watch()
    move(partner, blade, 0, -options.speed, options.depth)
    down = len(rows)
    move(partner, blade, options.speed, 0, options.way)
    blade.put_state([*blade.state[:VX], 0, 0, 0, 0, 0, 0])

if first:
    with open(os.path.join(out, "force.txt"), "w") as file:
        print("# x, z of the center (mm), force on the blade along x and z (N), work of the grains on it (J)", file=file)
        for row in rows:
            print(*(f"{value:.6g}" for value in row), file=file)
    last = rows[(down + len(rows)) // 2:]
    print(f"Result: pushed down against {max(row[3] for row in rows[:down]):.3f} N at most")
    print(f"Result: drawn against {-sum(row[2] for row in last) / len(last):.3f} N in the second half, work {sum(row[4] for row in rows):.5f} J")
lmp.finalize()
