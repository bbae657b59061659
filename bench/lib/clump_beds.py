# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""A settled bed of clumps of three spheres that overlap, another one of single spheres, and the scripts that run them.

A bed is made once, by Talus: bodies with random orientations fall on a floor, periodic in x and y; the data file is kept in
the cache, for all codes. Unit of length: the diameter of the largest sphere; density 1, gravity 10."""

import os
import shutil

import beds
import lammps

HISTORY = "hertz/history 200000 NULL 50 NULL 0.5 1"     # of pair gran and fix wall/gran
# nearly the same stiffness and damping, for pair granular: E = 3/4 kn 2 (1 - nu^2)
GRANULAR = "hertz/material 273000 50 0.3 tangential mindlin NULL 1.0 0.5 damping viscoelastic"
SPHERES = ((0.0, 0.0, 0.0, 1.0, 0.6), (0.8, 0.1, 0.0, 0.9, 0.4), (0.3, 0.7, 0.2, 0.8, 0.3))    # center, diameter, mass
NONE = "molecule/intra all"     # spheres of a clump do not touch each other
SETTLING, REST = 17000, 500     # steps


def template():
    lines = ["three spheres", "", f"{len(SPHERES)} atoms"]
    for name, columns in (("Coords", lambda s: f"{s[0]} {s[1]} {s[2]}"), ("Types", lambda s: "1"),
                          ("Diameters", lambda s: s[3]), ("Masses", lambda s: s[4])):
        lines += ["", name, ""] + [f"{k} {columns(sphere)}" for k, sphere in enumerate(SPHERES, 1)]
    return "\n".join(lines) + "\n"


def head():
    return ("units lj\natom_style sphere\natom_modify map array\nboundary p p f\nnewton off\ncomm_modify vel yes\n"
            "fix prop all property/atom mol ghost yes\n")


def physics(clumped, mover, granular=False):
    pair = f"granular\npair_coeff * * {GRANULAR}" if granular else f"gran/{HISTORY}\npair_coeff * *"
    wall = f"granular {GRANULAR}" if granular else HISTORY
    exclude = f"exclude {NONE}" if clumped else ""
    return (f"neighbor 0.2 bin\nneigh_modify delay 0 every 1 {exclude}\npair_style {pair}\n"
            f"timestep 0.0005\nfix g all gravity 10 vector 0 0 -1\nfix move all {mover}\n"
            f"fix floor all wall/gran {wall} zplane 0 NULL\nthermo 1000000\nthermo_style custom step atoms\nthermo_modify norm no lost error\n")


def settled(bench, clumped, across):
    """Path of the data file of a bed, across bodies wide."""
    path = beds.cache_path(f"clumps-{'three' if clumped else 'single'}-{across}")
    if not os.path.exists(path):
        bench.note("settling {}, once".format("clumps" if clumped else "spheres"))
        settle(bench, clumped, across)
        shutil.move(bench.path("settled.data"), path)
    return path


def settle(bench, clumped, across):
    """There are about as many single spheres as in clumps. Both lattices fit the width."""
    with open(bench.path("clump.mol"), "w") as file:
        file.write(template())
    width = 2.4 * across
    density = (2.4 if clumped else 1.6)**-3
    create = "0 region fill mol clump 4711" if clumped else "1 region fill"
    script = head() + (f"region box block 0 {width} 0 {width} 0 60\ncreate_box 1 box\nmolecule clump clump.mol\n"
                       f"region fill block 0 {width} 0 {width} 1 59\n"
                       f"lattice custom {density} a1 1 0 0 a2 0 1 0 a3 0 0 1 basis 0.3 0.3 0.5\n"
                       f"create_atoms {create}\n" + ("" if clumped else "set group all diameter 0.9\ndisplace_atoms all random 0.3 0.3 0.3 4711\n")
                       + physics(clumped, "rigid/small molecule" if clumped else "nve/sphere")
                       + f"fix v all viscous 0.5\nvelocity all set 0 0 -2\nrun {SETTLING}\nwrite_data settled.data\n")
    lammps.run(bench.workdir, "settle", script, lammps.TALUS, arguments=["-sf", "talus"])


def script(data, clumped, mover, steps, granular=False):
    return head() + f"read_data {data} fix prop NULL Molecules\n" + physics(clumped, mover, granular) + f"run {REST}\nrun {steps}\n"
