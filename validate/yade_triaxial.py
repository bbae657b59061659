# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""The triaxial compression of in.triaxial in Yade, run as a program: yade -n -x -j1 yade_triaxial.py PACKING OUT RATE STRAIN STIFFNESS
DAMPING.

PACKING has the positions of the walls, -x +x -y +y -z +z, in its first line, then x, y, z, radius of each sphere. OUT gets a row for each
stage of 0.0025 axial strain as in.triaxial has them: axial strain, volumetric strain (dilation positive), axial and lateral stress; its
last line is the time per particle and step in nanoseconds. DAMPING is Cundall's local damping."""

import math
import sys
import time

import yade.config
from yade import O, utils
from yade.wrapper import (Bo1_Box_Aabb, Bo1_Sphere_Aabb, ForceResetter, FrictMat, Ig2_Box_Sphere_ScGeom, Ig2_Sphere_Sphere_ScGeom,
                          InsertionSortCollider, InteractionLoop, Ip2_FrictMat_FrictMat_FrictPhys, Law2_ScGeom_FrictPhys_CundallStrack,
                          MatchMaker, NewtonIntegrator, TriaxialStressController)

FRICTION, RATIO, STEP, STAGE = 0.5, 0.5, 0.0025, 0.0025
SETTLE = 20.0               # time under the confining pressure before the walls move
SAMPLES = 40                # of the wall forces in each stage


def read_packing(path):
    """(lower corner, upper corner, [(x, y, z, radius)])."""
    with open(path) as file:
        rows = [list(map(float, line.split())) for line in file if line.strip() and not line.startswith("#")]
    walls, spheres = rows[0], rows[1:]
    return walls[0::2], walls[1::2], spheres


def build(packing, stiffness, damping):
    """Spheres and six smooth walls; every contact has the same springs, as in in.triaxial."""
    low, high, spheres = packing
    grain = O.materials.append(FrictMat(density=1.0, young=stiffness, poisson=RATIO, frictionAngle=math.atan(FRICTION)))
    smooth = O.materials.append(FrictMat(density=0.0, young=stiffness, poisson=RATIO, frictionAngle=0.0))
    walls = O.bodies.append(utils.aabbWalls([low, high], thickness=0.0, material=smooth))
    O.bodies.append([utils.sphere(row[:3], row[3], material=grain) for row in spheres])
    control = TriaxialStressController(internalCompaction=False, thickness=0.0, stressMask=7, goal1=-1.0, goal2=-1.0, goal3=-1.0,
                                       max_vel=0.2, stressDamping=0.25)
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Box_Aabb()]),
        InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Box_Sphere_ScGeom()],
                        [Ip2_FrictMat_FrictMat_FrictPhys(kn=MatchMaker(algo="val", val=stiffness),
                                                         ks=MatchMaker(algo="val", val=RATIO * stiffness))],
                        [Law2_ScGeom_FrictPhys_CundallStrack()]),
        control,
        NewtonIntegrator(damping=damping, gravity=(0, 0, 0))]
    O.dt = STEP
    return walls, control


def edges(walls):
    """Lengths of the sample along x, y, z; walls are in the order -x, +x, -y, +y, -z, +z."""
    return [O.bodies[walls[2 * k + 1]].state.pos[k] - O.bodies[walls[2 * k]].state.pos[k] for k in range(3)]


def pressures(walls):
    """Mean of opposite walls along x, y, z."""
    size = edges(walls)
    force = [0.5 * (O.forces.f(walls[2 * k + 1])[k] - O.forces.f(walls[2 * k])[k]) for k in range(3)]
    return [force[k] * size[k] / (size[0] * size[1] * size[2]) for k in range(3)]


def stage(walls, steps):
    """Means of the pressures over so many steps."""
    each = max(1, steps // SAMPLES)
    found = []
    for _ in range(steps // each):
        O.run(each, True)
        found.append(pressures(walls))
    return [sum(row[k] for row in found) / len(found) for k in range(3)]


def shear(walls, control, rate, strain):
    """Rows of axial strain, volumetric strain, axial and lateral stress; strains are logarithmic."""
    control.stressMask, control.goal3 = 3, -rate
    start, rows = edges(walls), []
    for _ in range(round(strain / STAGE)):
        px, py, pz = stage(walls, round(STAGE / rate / STEP))
        size = edges(walls)
        volumetric = sum(math.log(b / a) for a, b in zip(start, size))
        rows.append((-math.log(size[2] / start[2]), volumetric, pz, 0.5 * (px + py)))
    return rows


def main(path, out, rate, strain, stiffness, damping):
    walls, control = build(read_packing(path), stiffness, damping)
    stage(walls, round(SETTLE / STEP))
    print("settled:", pressures(walls), edges(walls), flush=True)
    begun, first = time.process_time(), O.iter    # the core may be shared
    rows = shear(walls, control, rate, strain)
    cost = 1e9 * (time.process_time() - begun) / ((O.iter - first) * (len(O.bodies) - 6))
    with open(out, "w") as file:
        file.writelines(" ".join(f"{value:.6g}" for value in row) + "\n" for row in rows)
        file.write(f"# {cost:.6g} ns per particle and step, Yade {yade.config.version}\n")


main(*sys.argv[1:3], *map(float, sys.argv[3:7]))
