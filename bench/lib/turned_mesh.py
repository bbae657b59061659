# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""A drum as a mesh, half full of grains, with the same law in Talus and in LIGGGHTS: time per grain and step."""

import math
import os

import lammps
import paired
import stl
from lammps import LIGGGHTS, TALUS

SEGMENTS = 120
YOUNG, POISSON, RESTITUTION, FRICTION, ROLLING = 5e6, 0.3, 0.3, 0.5613, 0.2931
DENSITY, SKIN, DT = 1580.0, 0.00015, 1e-5
WARM, STEPS = 2000, 1000

HEAD = """units si
atom_style {style}
atom_modify map array
newton off
{velocities}
boundary f f f
read_data grains.data
neighbor {skin} bin
neigh_modify every 1 delay 0 check yes
timestep {dt}
"""
TALUS_DRUM = """variable law string "hertz/material {e} {r} {nu} tangential multistep NULL NULL {mu} stock rolling cdt {mur}"
pair_style gran/penalty
pair_coeff * * ${{law}}
fix step all nve/sphere/symplectic gravity 9.81 vector 0 0 -1
fix cad all large/body mesh drum.stl contact ${{law}} move rotate 0 0 0 0 1 0 {period}
"""
LIGGGHTS_DRUM = """fix m1 all property/global youngsModulus peratomtype {e}
fix m2 all property/global poissonsRatio peratomtype {nu}
fix m3 all property/global coefficientRestitution peratomtypepair 1 {r}
fix m4 all property/global coefficientFriction peratomtypepair 1 {mu}
fix m5 all property/global coefficientRollingFriction peratomtypepair 1 {mur}
pair_style gran model hertz tangential history rolling_friction cdt
pair_coeff * *
fix gravity all gravity 9.81 vector 0 0 -1
fix cad all mesh/surface file drum.stl type 1
fix wall all wall/gran model hertz tangential history rolling_friction cdt mesh n_meshes 1 meshes cad
fix turn all move/mesh mesh cad rotate origin 0. 0. 0. axis 0. 1. 0. period {period}
fix step all nve/sphere
"""
RUN = f"thermo 1000000\nthermo_modify norm no lost error\nrun {WARM}\nrun {STEPS}\n"


def write_drum(path, radius, half):
    """Closed, along y, normals inward."""
    def rim(k, y):
        angle = 2 * math.pi * k / SEGMENTS
        return radius * math.cos(angle), y, radius * math.sin(angle)
    low, high = (0.0, -half, 0.0), (0.0, half, 0.0)
    triangles = []
    for k in range(SEGMENTS):
        a, b, c, d = rim(k, -half), rim(k + 1, -half), rim(k + 1, half), rim(k, half)
        triangles += [(a, b, c), (a, c, d), (low, b, a), (high, d, c)]
    stl.write(path, "drum", triangles)


def script(code, rpm):
    ours = code == TALUS
    law = {"e": YOUNG, "nu": POISSON, "r": RESTITUTION, "mu": FRICTION, "mur": ROLLING, "period": 60.0 / rpm}
    head = HEAD.format(style="sphere" if ours else "granular", skin=SKIN, dt=DT,
                       velocities="comm_modify vel yes" if ours else "communicate single vel yes")
    return head + (TALUS_DRUM if ours else LIGGGHTS_DRUM).format(**law) + RUN


def compare(folder, settled, radius, half, rpm, rounds, ranks=1):
    """{code: Series of ns per grain and step} from the file of in.drum, on one core or on several ranks."""
    _, frame = lammps.read_frames(settled)[-1]
    rows = [(int(k), 1, d, DENSITY, x, y, z) for k, x, y, z, d in zip(*(frame[name] for name in ("id", "x", "y", "z", "diameter")))]
    lammps.write_data(os.path.join(folder, "grains.data"), ((-0.045, 0.045), (-half - 0.002, half + 0.002), (-0.045, 0.045)), rows)
    write_drum(os.path.join(folder, "drum.stl"), radius, half)
    cores = paired.one_core() if ranks == 1 else None
    return paired.measure({code: lambda c=code: lammps.run(folder, f"mesh-{c}", script(c, rpm), c, cores=cores, ranks=ranks)
                           .loops()[-1].nanoseconds() for code in (TALUS, LIGGGHTS)}, rounds)
