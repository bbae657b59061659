# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What is wrong where a feature is left out, in scenes small enough to know the answer.

Every function returns rows [feature, where it matters, what is measured, with it, without it]."""

import math

import beds
import lammps

D, DENSITY, G = 0.01, 2500.0, 9.81
MATERIAL = "hertz/material 1e7 0.5 0.3"
DT = 1.0e-5

HEAD = """units si
atom_style sphere
atom_modify map array
newton off
comm_modify vel yes
boundary f f f
read_data {data}
neighbor {skin!r} bin
pair_style gran/penalty
pair_coeff * * {law}
fix move all nve/sphere/symplectic{pull}
fix floor all large/body plane 0 0 0 0 0 1 contact {law}
timestep {dt!r}
thermo {steps}
thermo_modify lost ignore
"""


def _one(bench, name, law, steps, velocity=(0, 0, 0), spin=(0, 0, 0), slope=0.0, height=0.0, dt=DT):
    """The last frame of a single sphere on a floor, `slope` = tangent of its angle."""
    lammps.write_data(bench.path(f"{name}.data"), ((-1, 1),) * 3, [(1, 1, D, DENSITY, 0.0, 0.0, D / 2 + height)],
                      [(1, *velocity, *spin)])
    pull = f" gravity {G} vector {slope!r} 0 -1"
    lammps.run(bench.workdir, name, HEAD.format(data=f"{name}.data", skin=0.1 * D, law=law, pull=pull, dt=dt, steps=steps)
               + f"dump d all custom {steps} {name}.frames id x y z vx vy vz omegaz\ndump_modify d format float %.17g\nrun {steps}\n")
    return lammps.read_frames(bench.path(f"{name}.frames"))[-1][1]


def slope(bench):
    """A sphere that rolling resistance keeps from rolling, on a slope that friction can hold."""
    steps, tangent, rest = bench.size(100000, 20000), 0.2, "0.5 rolling 0.4"
    rows, way = [], {}
    laws = {"multistep": f"{MATERIAL} tangential multistep NULL NULL {rest}", "onestep": f"{MATERIAL} tangential onestep NULL NULL {rest}",
            "dashpot": f"{MATERIAL} tangential dashpot NULL {rest}", "no rolling": f"{MATERIAL} tangential multistep NULL NULL 0.5"}
    for name, law in laws.items():
        way[name] = _one(bench, "slope-" + name.replace(" ", "-"), law, steps, slope=tangent)["x"][0] / D
    where, what = f"sphere at rest on a slope of tangent {tangent}, {steps * DT:g} s", "way down (d)"
    for feature, without in (("history (onestep instead)", "onestep"), ("history (dashpot instead)", "dashpot"),
                             ("rolling resistance", "no rolling")):
        rows.append([feature, where, what, way["multistep"], way[without]])
    return rows


def spinning(bench):
    """A sphere that rotates about the vertical: stops after t = 2 r^2 w/(5 mu_s r_c g) with resistance."""
    steps = bench.size(60000, 20000)
    law = f"{MATERIAL} tangential multistep NULL NULL 0.5"
    left = [_one(bench, f"top-{n}", law + words, steps, spin=(0, 0, 1.0))["omegaz"][0] for n, words in enumerate((" spinning 0.3", ""))]
    return [["spinning resistance", f"sphere that rotates about the normal of a floor, {steps * DT:g} s", "angular velocity left (of 1)", *left]]


def damping(bench):
    """A sphere dropped from ten diameters: height of its first rebound, e = .5 and 1."""
    steps = round(math.sqrt(2 * 10 * D / G) * (1 + 0.5) / DT)
    low, high = (_one(bench, f"drop-{n}", f"{law} tangential multistep NULL NULL 0.5", round(steps * share), height=10 * D)["z"][0] / D - 0.5
                 for n, (law, share) in enumerate(((MATERIAL, 1.0), (MATERIAL.replace(" 0.5 ", " 1.0 "), 4 / 3))))
    return [["damping", "sphere dropped from 10 d", "height of the first rebound (d)", low, high]]


def adhesion(bench):
    """Two spheres that are pulled apart by their weight: the lower one hangs, or falls."""
    weight = DENSITY * math.pi / 6 * D**3 * G
    found = []
    for n, words in enumerate((f" adhesion constant {3 * weight!r}", "")):
        law = f"{MATERIAL} tangential multistep NULL NULL 0.5{words}"
        lammps.write_data(bench.path(f"hang{n}.data"), ((-1, 1),) * 3, [(1, 1, D, DENSITY, 0, 0, 0.5), (2, 1, D, DENSITY, 0, 0, 0.5 - 0.9999 * D)])
        script = HEAD.format(data=f"hang{n}.data", skin=0.1 * D, law=law, pull=f" gravity {G} vector 0 0 -1", dt=DT, steps=10000)
        script = script.replace("fix move all", "group top id 1\ngroup low id 2\nfix hold top freeze\nfix move low")
        lammps.run(bench.workdir, f"hang{n}", script + f"dump d all custom 10000 hang{n}.frames id z\nrun 10000\n")
        frame = lammps.read_frames(bench.path(f"hang{n}.frames"))[-1][1]
        found.append((0.5 - 0.9999 * D - frame["z"][1]) / D)
    return [["adhesion (3 weights)", "sphere that hangs on another, .1 s", "way down (d)", *found]]


def bodies(bench):
    """A box of planes that lacks its floor."""
    law = f"{MATERIAL} tangential multistep NULL NULL 0.5"
    kept = _one(bench, "floor", law, 10000)["z"][0] / D
    data = "floor.data"
    script = HEAD.format(data=data, skin=0.1 * D, law=law, pull=f" gravity {G} vector 0 0 -1", dt=DT, steps=10000)
    lines = [line for line in script.split("\n") if "large/body" not in line]
    lammps.run(bench.workdir, "nofloor", "\n".join(lines) + "dump d all custom 10000 nofloor.frames id z\nrun 10000\n")
    return [["a body", "sphere at rest on it, .1 s", "height (d)", kept, lammps.read_frames(bench.path("nofloor.frames"))[-1][1]["z"][0] / D]]


def _end(bench, name, script, **options):
    lammps.run(bench.workdir, name, script + f"write_dump all custom {name}.end id x y z vx vy vz modify format float %.17g\n", **options)
    return lammps.read_frames(bench.path(f"{name}.end"))[-1][1]


def _difference(one, other):
    return max(abs(a - b) for key in one for a, b in zip(one[key], other[key]))


def orientation(bench, hybrid):
    """No force on a sphere depends on how it is turned: the same motion, bit for bit."""
    frames = [_end(bench, f"turned-{n}", hybrid(words)) for n, words in enumerate((" orientation yes", ""))]
    return [["orientation", "a bed", "largest difference of positions and velocities", 0.0, _difference(*frames)]]


def exchange(bench):
    """Two ranks: what the direct exchange leaves out is not missed."""
    steps = bench.size(500, 100)
    script = beds.script(beds.tile_data(bench)[0], beds.talus(beds.FRICTIONLESS, walls=False), 0, steps, boundary="p p f")
    full = _end(bench, "full", script.replace("timestep", "comm_proxy no\ntimestep", 1), ranks=2)
    direct = _end(bench, "direct", script.replace("timestep", "comm_proxy yes\ntimestep", 1), ranks=2)
    return [["angular velocities in messages (comm_proxy, no friction)", f"a bed on 2 ranks, {steps} steps", "largest difference of positions and velocities",
             0.0, _difference(full, direct)]]
