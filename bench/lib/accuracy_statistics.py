# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""The part of bench/accuracy.py about scenes that are chaotic: averages over several beginnings."""

import concurrent.futures
import math
import statistics

import machine
import methods
import plot
import scenes

NAMES = ("plain", "half", methods.SECOND_ORDER, "stock", "granular")


def coordination(state, side):
    """Contacts per particle, counted twice, in a box periodic in x and y; the rest of the floor counts not."""
    count = 0
    limit = (2 * scenes.R)**2
    order = sorted(range(len(state.x)), key=lambda k: state.x[k][2])
    for n, i in enumerate(order):
        xi = state.x[i]
        for j in order[n + 1:]:
            xj = state.x[j]
            dz = xj[2] - xi[2]
            if dz > 2 * scenes.R:
                break
            dx, dy = (math.remainder(xj[d] - xi[d], side) for d in (0, 1))
            count += dx * dx + dy * dy + dz * dz < limit
    return 2 * count / len(state.x)


def gas_numbers(scene, states):
    """Kinetic energy at the end over that at the beginning."""
    start = sum(0.5 * scenes.MASS * sum(c * c for c in v) for v in scene.velocities)
    return {"energy left": states[1].kinetic() / start}


def bed_numbers(scene, states):
    heights = [x[2] for x in states[1].x]
    return {"mean height": statistics.fmean(heights), "coordination": coordination(states[1], scene.box[0][1])}


CASES = {"gas": (scenes.gas, gas_numbers), "bed": (scenes.bed, bed_numbers)}


def averages(bench, case, pool):
    """{(method, dt): {quantity: (mean over the seeds, standard error)}} and the time steps."""
    make, numbers = CASES[case]
    seeds = range(1, bench.size(6, 2) + 1)
    made = {seed: make(seed) for seed in seeds}
    steps = made[1].time_steps()[:bench.size(6, 3)]

    def one(job):
        name, dt, seed = job
        try:
            return numbers(made[seed], methods.simulate(bench, made[seed], name, dt))
        except methods.Broken:
            return None
    names = [name for name in NAMES if name in methods.methods_for(made[1])]
    jobs = [(name, dt, seed) for name in names for dt in steps for seed in seeds]
    results = dict(zip(jobs, pool.map(one, jobs)))
    table = {}
    for name in names:
        for dt in steps:
            found = [results[name, dt, seed] for seed in seeds]
            if None in found:
                table[name, dt] = None
                continue
            table[name, dt] = {key: (statistics.fmean(f[key] for f in found),
                                     statistics.stdev(f[key] for f in found) / math.sqrt(len(found)))
                               for key in found[0]}
    return made[1], names, steps, table


def show(section, case, scene, names, steps, table):
    section.heading(f"Averages: {scene.what}")
    keys = list(next(value for value in table.values() if value))
    rows = []
    for dt in steps:
        for name in names:
            value = table[name, dt]
            rows.append([f"{scene.law.contact_time() / dt:.0f}", name]
                        + ([f"{value[k][0]:.5g} +- {value[k][1]:.2g}" for k in keys] if value else ["unstable"] * len(keys)))
            section.record(scene=case, method=name, dt=dt,
                           **{k: value[k][0] for k in keys if value}, **{k + " error": value[k][1] for k in keys if value})
    section.table(["steps per contact", "method", *keys], rows)
    if None in table.values():
        section.text("""unstable: particles were lost in at least one run; a particle with many contacts has a lower limit than one
impact (see the section on stability). steps per contact: of an impact at 1 m/s.""")
    return keys


def draw(plt, scene, names, steps, table, key):
    _, axes = plt.subplots(figsize=(4.5, 3))
    for k, name in enumerate(names):
        points = [(dt, *table[name, dt][key]) for dt in steps if table[name, dt]]
        axes.errorbar([p[0] for p in points], [p[1] for p in points], yerr=[p[2] for p in points], label=name,
                      **plot.style(k))
    axes.set_xscale("log")
    axes.set_xticks(steps, [f"{dt:.1e}" for dt in steps], fontsize=7)
    axes.minorticks_off()
    axes.set_xlabel("time step (s)")
    axes.set_ylabel(key)
    axes.legend(fontsize=7)


def measure(bench):
    section = bench.section
    with concurrent.futures.ThreadPoolExecutor(len(machine.cores())) as pool:
        for case in CASES:
            if not bench.wants(case):
                continue
            bench.note(f"averages: {case}")
            scene, names, steps, table = averages(bench, case, pool)
            keys = show(section, case, scene, names, steps, table)
            if case == "gas":
                section.text(f"Haff's law with Enskog's collision frequency gives {scenes.haff(scene.time):.5g} for the energy "
                             "left; it holds for impacts without duration and particles that know nothing of each other.")
            section.plot(case, f"{scene.what}: {keys[0]}, with its standard error over the beginnings",
                         lambda plt: draw(plt, scene, names, steps, table, keys[0]))
