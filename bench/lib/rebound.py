# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Impacts of two spheres that begin at different moments within a time step: restitution and direction of rebound."""

import dataclasses
import math
import statistics

import errors
import lammps
import methods
import scenes

METHODS = {"order 1": "half", "order 2": methods.SECOND_ORDER, "stock": "stock"}      # stock: granular with a material
STEPS = (4, 5, 6, 8, 10, 12, 16, 20, 25, 32, 40, 50, 64, 80, 100, 128, 160, 200, 256, 320, 400, 512, 640)
FINEST = 12800
ACROSS, SPIN = 0.8, 1.0      # of the oblique impacts: speed along the surface, both spins

YOUNG = 0.75 * scenes.HERTZ * 2 * (1 - scenes.NU**2)
FRICTION = {"kt": scenes.KT_OF_KN * scenes.HERTZ, "mu": 0.3}
CASES = {
    "linear, elastic": scenes.Law("hooke", scenes.HOOKE),
    "linear, weakly damped": scenes.Law("hooke", scenes.HOOKE, 3.5),
    "linear, damped": scenes.Law("hooke", scenes.HOOKE, 22.0),
    "Hertz, elastic": scenes.Law("hertz", scenes.HERTZ),
    "Hertz, weakly damped": scenes.Law("hertz", scenes.HERTZ, 30.0),
    "Hertz, damped": scenes.Law("hertz", scenes.HERTZ, 240.0),
    "Hertz, friction": scenes.Law("hertz", scenes.HERTZ, **FRICTION),
    "Hertz, damped, friction": scenes.Law("hertz", scenes.HERTZ, 240.0, gt=120.0, **FRICTION),
    "hertz/material, e = .9": scenes.Law("hertz/material", YOUNG, 0.9),
    "hertz/material, e = .5": scenes.Law("hertz/material", YOUNG, 0.5),
    "hertz/material, e = .5, friction": scenes.Law("hertz/material", YOUNG, 0.5, gt=1.0, mu=0.3),
}


@dataclasses.dataclass
class Rebound:
    """Of each impact: separating over approaching speed, angle of the rebound with the normal (rad)."""
    restitution: list
    angle: list


def impacts(bench, name, law, method, steps, moments):
    """Rebound of head-on, or with friction oblique, impacts with so many time steps in an undamped contact."""
    dt = law.contact_time() / steps
    rows, speeds = [], []
    across, spin = (ACROSS, SPIN) if law.mu else (0.0, 0.0)
    for n in range(moments):
        gap = dt * (1 + (n + 0.5) / moments)
        for k, sign in enumerate((-1, 1)):
            # they meet with the normal along z
            rows.append((2 * n + k + 1, 1, 2 * scenes.R, scenes.DENSITY, 3.0 * n + 0.5 * sign * across * gap, 0.0,
                         sign * (scenes.R + gap / 2)))
            speeds.append((2 * n + k + 1, -0.5 * sign * across, 0.0, -0.5 * sign, 0.0, spin, 0.0))
    name = f"rebound-{abs(hash(name)):x}-{method}-{steps}".replace(" ", "_")
    lammps.write_data(bench.path(name + ".data"), ((-2, 3 * moments), (-2, 2), (-2, 2)), rows, speeds)
    scene = scenes.Scene(name, "", law, [], [], dt, dt, dt)
    lammps.run(bench.workdir, name, f"""units si
atom_style sphere
newton off
comm_modify vel yes
boundary f f f
read_data {name}.data
neighbor 0.1 bin
{methods.physics(scene, method)}timestep {dt!r}
thermo 100000000
run {math.ceil(2 * steps) + 3}
write_dump all custom {name}.end id vx vz fx fz modify format float %.17g
""", methods.code_of(method))
    (_, frame), = lammps.read_frames(bench.path(name + ".end"))
    if any(frame["fz"]):
        raise lammps.Failed(f"{name}: spheres still touch")
    normal = [b - a for a, b in zip(frame["vz"][::2], frame["vz"][1::2])]
    along = [a - b for a, b in zip(frame["vx"][::2], frame["vx"][1::2])]
    return Rebound(normal, [math.atan2(t, n) for t, n in zip(along, normal)])


def rms(values, exact):
    return math.sqrt(statistics.fmean((v - exact)**2 for v in values)) / abs(exact)


class Ladder:
    """Relative errors over the numbers of steps per contact of one law and method, against its converged solution."""

    def __init__(self, bench, name, method):
        law = CASES[name]
        moments = bench.size(32, 8)
        material = law.kind == "hertz/material"
        way = "granular" if material and method == "stock" else METHODS[method]
        # with another law a converged solution of its own: where friction has a dashpot, and of granular's materials
        own = law.mu and law.gt or material and method == "stock"
        finest = impacts(bench, name, law, way if own else methods.SECOND_ORDER, FINEST, 4)
        self.restitution, self.angle = statistics.fmean(finest.restitution), statistics.fmean(finest.angle)
        self.steps = STEPS[::bench.size(1, 4)]
        found = [impacts(bench, name, law, way, n, moments) for n in self.steps]
        self.errors = {"restitution": [rms(f.restitution, self.restitution) for f in found]}
        if law.mu:
            self.errors["angle"] = [rms(f.angle, self.angle) for f in found]

    def needs(self, quantity, target):
        """Smallest number of steps per contact from which on the error is at most `target`; None beyond the range."""
        dt = errors.step_for(target, [1 / n for n in self.steps], self.errors[quantity])
        return 1 / dt if dt else None


def ladders(bench, pool):
    """{(law, method): Ladder}"""
    jobs = [(name, method) for name in CASES for method in METHODS]
    return dict(zip(jobs, pool.map(lambda job: Ladder(bench, *job), jobs)))
