# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What the time step does to the energy of impacts without damping and friction: of one, and of very many."""

import dataclasses
import math
import os
import random
import statistics
import tempfile

import extreme
import lammps
from extreme_scene import NU, YOUNG, Ball, Extreme
from lammps import SECOND

R, MASS = 0.5, 1000 * math.pi / 6
DEPTH = 0.05       # overlap of the single impacts over the radius: that of the fast ones in the gas
STIFFNESS = YOUNG / (1 - NU**2) * math.sqrt(R / 2 * 0.01 * R)      # of the Hertzian contact at an overlap of .01 r
LAWS = {"linear": ("hooke", STIFFNESS, 0.0, 0.0, 0.0, 0.0), "Hertz": ("material", YOUNG, 1.0, NU, 0.0)}
CRITICAL = math.sqrt(MASS / 2 / STIFFNESS) * (1 - 1e-12)       # rounding must not decide whether a limit is kept


def gas(name, law, speed, steps, seed=9, fraction=0.2, frames=200):
    """64 spheres fly about in a periodic box; speed: standard deviation of a component."""
    draw = random.Random(seed)
    balls = [Ball((1.3 * (k % 4) + 0.6, 1.3 * (k // 4 % 4) + 0.6, 1.3 * (k // 16) + 0.6),
                  tuple(speed * draw.gauss(0, 1) for _ in "xyz")) for k in range(64)]
    return Extreme(name, balls, law, steps, ((0.0, 5.2),) * 3, periodic="p p p", frames=frames, fraction=fraction)


@dataclasses.dataclass
class Errors:
    """Of energies, relative."""
    values: list
    said: bool = False      # some run had the warning about elastic impacts

    def spread(self):
        return math.sqrt(statistics.fmean(v * v for v in self.values))

    def largest(self):
        return max(map(abs, self.values))


def single(bench, code, law, fraction, moments):
    """Errors of head-on impacts of two spheres that begin at different moments within a step, with an order of Talus."""
    dt = fraction * CRITICAL
    speed = extreme.speed_for(DEPTH) if law == "Hertz" else DEPTH * R / CRITICAL
    rows, speeds = [], []
    for n in range(moments):
        gap = speed * dt * (1 + (n + 0.5) / moments)
        for k, sign in enumerate((-1, 1)):
            rows.append((2 * n + k + 1, 1, 2 * R, 1000.0, 3.0 * n, 0.0, sign * (R + gap / 2)))
            speeds.append((2 * n + k + 1, 0.0, 0.0, -sign * speed / 2, 0.0, 0.0, 0.0))
    name = f"single-{code}-{law}-{fraction}"
    lammps.write_data(bench.path(name + ".data"), ((-2, 3 * moments), (-2, 2), (-2, 2)), rows, speeds)
    steps = math.ceil(6 * CRITICAL / dt)
    lammps.run(bench.workdir, name, f"""units si
atom_style sphere
newton off
comm_modify vel yes
boundary f f f
read_data {name}.data
neighbor 0.1 bin
pair_style gran/penalty
pair_coeff * * {extreme.talus_law(LAWS[law])}
fix move all nve/sphere/symplectic{" order 2" * (code == SECOND)}
timestep {dt!r}
thermo {steps}
run {steps}
write_dump all custom {name}.end id vz modify format float %.17g
""")
    (_, frame), = lammps.read_frames(bench.path(name + ".end"))
    return Errors([(a * a + b * b) / (speed * speed / 2) - 1 for a, b in zip(frame["vz"][::2], frame["vz"][1::2])])


def walk(bench, code, law, fraction, steps, seed):
    """(growth of the energy of the gas, whether it was warned about)."""
    folder = tempfile.mkdtemp(prefix="gas-", dir=bench.workdir)
    scene = gas(f"{law} {fraction}", LAWS[law], math.sqrt(YOUNG / 1e8), steps, seed, frames=100)
    outcome, _ = extreme.run(bench, scene, code, folder, fraction * CRITICAL)
    os.remove(f"{folder}/frames.{code}")
    return outcome.growth, any("no contact has damping" in warning for warning in outcome.warnings)


def singles(bench, pool, code, cases):
    """{(law, fraction): Errors of single impacts}."""
    return dict(zip(cases, pool.map(lambda case: single(bench, code, *case, bench.size(64, 8)), cases)))


def gases(bench, pool, code, cases, steps):
    """{(law, fraction): Errors of the gas, one for each seed}."""
    seeds = range(bench.size(8, 2))
    jobs = [(law, fraction, seed) for law, fraction in cases for seed in seeds]
    found = dict(zip(jobs, pool.map(lambda job: walk(bench, code, job[0], job[1], steps, job[2]), jobs)))
    return {case: Errors([found[(*case, seed)][0] for seed in seeds], any(found[(*case, seed)][1] for seed in seeds)) for case in cases}
