# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Many spheres over the time step: energy lost by a gas and by a collapse, and the state of a bed at rest.

Motion is chaotic: numbers are means over beginnings, which are the same for every method and time step."""

import dataclasses
import math
import statistics

import accuracy_statistics
import methods
import scenes

METHODS = {"order 1": "half", "order 2": methods.SECOND_ORDER, "stock": "granular"}


@dataclasses.dataclass
class Flow:
    """make(seed): a Scene; numbers(scene, states): {quantity: value}; steps: per undamped contact at 1 m/s."""
    what: str
    make: object
    numbers: object
    steps: tuple
    seeds: int
    reference: str = ""      # the method of the finest run, if all have the same law


def gas(seed):
    scene = scenes.gas(seed, 1000)
    step = scene.law.contact_time() / 4
    return dataclasses.replace(scene, middle=step, time=round(1 / step / 4) * 4 * step)


def energy_lost(scene, states):
    """Of the kinetic and potential energy at the beginning, the part that is gone at the end."""
    def total(positions, kinetic):
        return kinetic + sum(scenes.MASS * scene.gravity * x[2] for x in positions)
    start = sum(0.5 * scenes.MASS * sum(c * c for c in v) for v in scene.velocities)
    before = total(scene.positions, start)
    return {"energy lost": 1 - total(states[1].x, states[1].kinetic()) / before}


def collapse(seed):
    """A column without walls falls apart; looked at while it does."""
    column = scenes.bed(seed)
    step = column.law.contact_time() / 4
    return dataclasses.replace(column, box=((-60.0, 60.0), (-60.0, 60.0), (-1.0, 30.0)), periodic="f f f",
                               velocities=[(0.0, 0.0, 0.0)] * len(column.positions), middle=4 * step,
                               time=round(1.5 / step / 4) * 4 * step)


def bed(seed):
    scene = scenes.bed(seed)
    return dataclasses.replace(scene, middle=0.9 * scene.time)


def stresses(state, scene):
    """(horizontal, vertical) sums over the contacts of elastic normal force times branch, from positions."""
    side, law = scene.box[0][1], scene.law
    order = sorted(range(len(state.x)), key=lambda k: state.x[k][2])
    across = up = 0.0
    for n, i in enumerate(order):
        for j in order[n + 1:]:
            dz = state.x[j][2] - state.x[i][2]
            if dz > 2 * scenes.R:
                break
            dx, dy = (math.remainder(state.x[j][d] - state.x[i][d], side) for d in (0, 1))
            distance = math.sqrt(dx * dx + dy * dy + dz * dz)
            overlap = 2 * scenes.R - distance
            if overlap > 0:
                force = law.kn * math.sqrt(scenes.R / 2 * overlap) * overlap
                across += 0.5 * force * (dx * dx + dy * dy) / distance
                up += force * dz * dz / distance
    return across, up


def rest(scene, states):
    """Of a bed: height, contacts, ratio of the horizontal to the vertical stress, creep in the last tenth of the run."""
    middle, end = states
    found = accuracy_statistics.bed_numbers(scene, states)
    across, up = stresses(end, scene)
    found["stress ratio"] = across / up
    found["creep/r"] = statistics.fmean(math.dist(a, b) for a, b in zip(middle.x, end.x)) / scenes.R
    return found


FLOWS = {
    "gas": Flow("1000 spheres in a periodic box (linear, e = .8) lose a quarter of their energy", gas, energy_lost,
                (4, 8, 16, 32, 64), 6, "order 2"),
    "collapse": Flow("a column of 500 spheres without walls falls apart (Hertz, damped, friction), after 1.5 s", collapse, energy_lost,
                     (8, 12, 16, 32, 64, 128), 6),
    "bed": Flow("500 spheres have settled on a floor (Hertz, damped, friction)", bed, rest, (8, 12, 16, 32, 64, 128), 8),
}


@dataclasses.dataclass
class Mean:
    """Over the beginnings: value, and change against the finest run with the same beginning, with standard errors."""
    value: float
    error: float
    change: float
    change_error: float

    def cell(self):
        return f"{self.value:.4g} +- {self.error:.1g} ({self.change:+.1g} +- {self.change_error:.1g})"


def _mean(values, finest):
    def error(numbers):
        return statistics.stdev(numbers) / math.sqrt(len(numbers))
    changes = [a - b for a, b in zip(values, finest)]
    return Mean(statistics.fmean(values), error(values), statistics.fmean(changes), error(changes))


def measured(bench, flow, pool):
    """{(method, steps per contact): {quantity: Mean} or None if a run broke}."""
    made = [flow.make(seed) for seed in range(1, bench.size(flow.seeds, 2) + 1)]
    steps = flow.steps[:bench.size(len(flow.steps), 3)]

    def one(job):
        name, n, k = job
        scene = made[k]
        try:
            states = methods.simulate(bench, scene, METHODS[name], scene.law.contact_time() / n)
        except methods.Broken:
            return None
        return flow.numbers(scene, states)
    jobs = [(name, n, k) for name in METHODS for n in steps for k in range(len(made))]
    found = dict(zip(jobs, pool.map(one, jobs)))

    def runs(name, n):
        return [found[name, n, k] for k in range(len(made))]
    table = {}
    for name in METHODS:
        finest = runs(flow.reference or name, steps[-1])
        for n in steps:
            here = runs(name, n)
            table[name, n] = None if None in here + finest else {
                key: _mean([run[key] for run in here], [run[key] for run in finest]) for key in here[0]}
    return table
