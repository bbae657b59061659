# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Tablets that have settled in a vessel: a cylinder that is curved inside, a mesh in its place, a box."""

import math

import paired
import turned_mesh

RADIUS, HALF = 0.05, 0.028      # m
LAW = "hertz/material 2e7 0.6 0.3 tangential multistep NULL NULL 0.4"
VESSELS = {
    "cylinder, inside": f"cylinder 0 0 0 0 1 0 {RADIUS} {2 * HALF} inside",
    f"mesh of {4 * turned_mesh.SEGMENTS} triangles": "mesh drum.stl",
    "box, inside": f"box 0 0 0 {2 * RADIUS} {2 * HALF} {2 * RADIUS} inside",
}

SCENE = """units si
atom_style sphere
atom_modify map array
boundary f f f
newton off
comm_modify vel yes
region whole block -0.055 0.055 -0.03 0.03 -0.055 0.055 units box
create_box 1 whole
neighbor 0.0008 bin
pair_style gran/penalty
pair_coeff * * {law}
region round cylinder y 0 0 0.045 -0.024 0.024 units box
region low block INF INF INF INF INF 0.01 units box
region fill intersect 2 round low
fill_region fill 1 fraction 0.5 diameter 0.0084 density 1100 seed 1
fix tablets all shape/gran type 1 superellipsoid 0.004 0.004 0.002 4 2 density 1100 orient random 5
fix weight all gravity 9.81 vector 0 0 -1
fix vessel all large/body {vessel} contact {law}
timestep 8e-6
thermo_modify norm no lost error
run {settling}
run {steps}
print "RESULT $(atoms) $(f_tablets[6]) $(f_vessel[20])"
"""


def compare(bench, run):
    """run(bench, name, script): a run on one core. Rows (vessel, tablets, pairs that touch, contacts with the vessel, times of a step) by vessel."""
    turned_mesh.write_drum(bench.path("drum.stl"), RADIUS / math.cos(math.pi / turned_mesh.SEGMENTS), HALF)
    settling, steps = 12500, bench.size(2500, 500)
    counts = {}

    def once(vessel):
        result = run(bench, "tablets", SCENE.format(law=LAW, vessel=VESSELS[vessel], settling=settling, steps=steps))
        counts[vessel] = result.printed("RESULT")[0]
        return result.loops()[-1].nanoseconds()

    series = paired.measure({vessel: lambda v=vessel: once(v) for vessel in VESSELS}, bench.rounds)
    return [(vessel, *counts[vessel], series[vessel]) for vessel in VESSELS]
