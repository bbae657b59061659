# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Which time step for which accuracy, with orders 1 and 2 and with the stock styles, and what it costs."""

import concurrent.futures
import dataclasses

import beds
import flows
import lammps
import machine
import paired
import rebound
import report
from lammps import STOCK

TITLE = "Which time step"
QUESTION = """Which time step gives the restitution and the direction of a rebound to 5 %, 1 % and .1 %, with which law? Which
one is small enough for what many spheres do together: the energy that a gas or a collapse loses, height, contacts, stress
and creep of a bed? What does it cost?"""

TARGETS = (0.05, 0.01, 0.001)
COUNT = 50000      # spheres of the bed in which a step is timed


# ---- impacts ----------------------------------------------------------------------------------

def impacts(bench, pool):
    """{(law, method): Ladder}, with their tables."""
    section, found = bench.section, rebound.ladders(bench, pool)
    rows, needs = [], []
    for (name, method), ladder in found.items():
        value = f"{ladder.restitution:.3f}" + (f", {ladder.angle * 57.29578:.1f} deg" if "angle" in ladder.errors else "")
        rows.append([name, method, value, *(ladder.errors["restitution"][ladder.steps.index(n)]
                                            for n in (4, 6, 10, 16, 25, 50, 100) if n in ladder.steps)])
        cells = [name, method]
        for quantity in ("restitution", "angle"):
            cells += [needed(ladder, quantity, target) for target in TARGETS]
        needs.append(cells)
        for quantity, values in ladder.errors.items():
            for n, value in zip(ladder.steps, values):
                section.record(part="rebound", case=name, method=method, quantity=quantity, steps=n, value=value)
    section.heading("Restitution and rebound: steps per contact")
    section.table(["law", "method", *(f"{what} to {100 * target:g} %" for what in ("restitution", "direction") for target in TARGETS)], needs)
    section.text(f"""Time steps in an undamped contact from which on the error, root mean square over 32 moments within a step at
which the contact begins, stays below the mark. Impacts of two spheres at speed 1; direction: angle of the rebound with the
normal of oblique impacts (speed {rebound.ACROSS} along the surface, both spins {rebound.SPIN}, mu = .3). In laws with damping it does not attract
(`limit_damping`). Stock: gran/*/history, and pair granular for hertz/material, whose restitution is another one. The 20 % of the critical time step that is advised is 16 steps per contact with a linear law, 20
with a Hertzian one whose overlap reaches 1 % of the radius. Order 1 and stock see the damping half a step late, and do not see where in a
step a contact begins: the first error goes with the damping, the second with the law, weak with Hertz. Order 2 corrects the
beginning, and the end where damping is limited; of an elastic linear contact it does not correct the end, whose error order 1 cancels with
that of the beginning: there order 1 is the better one.""")
    shown = [n for n in (4, 6, 10, 16, 25, 50, 100) if n in next(iter(found.values())).steps]
    section.heading("Restitution: relative error")
    section.table(["law", "method", "value", *(f"{n} steps" for n in shown)], rows)
    return found


def needed(ladder, quantity, target):
    if quantity not in ladder.errors:
        return ""
    n = ladder.needs(quantity, target)
    if not n:
        return f"> {ladder.steps[-1]}"
    return f"{n:.0f}" if n > ladder.steps[0] else f"at most {n:.0f}"


# ---- many spheres -----------------------------------------------------------------------------

def many(bench, pool, name):
    section, flow = bench.section, flows.FLOWS[name]
    found = flows.measured(bench, flow, pool)
    keys = list(next(value for value in found.values() if value))
    section.heading(f"{name}: {flow.what}")
    rows = []
    for (method, n), value in found.items():
        rows.append([f"{n}", method] + ([value[key].cell() for key in keys] if value else ["unstable"] * len(keys)))
        for key in keys if value else ():
            section.record(part=name, method=method, quantity=key, steps=n, **dataclasses.asdict(value[key]))
    rows.sort(key=lambda row: int(row[0]))
    section.table(["steps per contact", "method", *keys], rows)
    return found


def flows_of(bench, pool):
    section = bench.section
    for name in flows.FLOWS:
        bench.note(name)
        many(bench, pool, name)
    section.text("""Steps per contact: of an undamped impact at 1 m/s. Means and standard errors over beginnings, which are the same for
every time step and method; in brackets the change against the smallest time step from the same beginnings (of the same method, in the gas of
order 2: all have one law there), which the chance of the beginning has less part in. unstable: particles were lost, or a number was not finite, in at least one run. stress ratio:
horizontal over vertical, of the elastic forces. creep: mean way of a sphere in the last tenth of the run, over its radius.
Stock: pair granular. Order 2: with the rule slider.""")


# ---- what a step costs ------------------------------------------------------------------------

def costs(bench):
    """{method: ns per particle and step} in a settled bed on one core."""
    path = beds.bed(bench, bench.size(COUNT, 12500))[0]
    second = f"{beds.HISTORY} slider midpoint limit_damping"
    scripts = {"order 1": (lammps.TALUS, beds.talus()),
               "order 2": (lammps.TALUS, beds.talus(second, start="half order 2")),
               "stock": (STOCK, beds.stock())}
    core = paired.one_core()

    def one(code, physics):
        return lammps.run(bench.workdir, "cost", beds.script(path, physics, 100, bench.size(200, 50)), code,
                          cores=core).loops()[-1].nanoseconds()
    series = paired.measure({name: (lambda it=it: one(*it)) for name, it in scripts.items()}, bench.rounds)
    return {name: s.median for name, s in series.items()}


def bill(bench, ladders, nanoseconds):
    """Run time for a restitution, over that of order 1 with the time step that is advised."""
    section, rows = bench.section, []
    unit = nanoseconds["order 1"] * 16
    for name in rebound.CASES:
        for target in TARGETS:
            row, times = [name, f"{100 * target:g} %"], {}
            for method in rebound.METHODS:
                ladder = ladders[name, method]
                n = ladder.needs("restitution", target)
                times[method] = n and n * nanoseconds[method] / unit
                row.append(times[method] or f"> {ladder.steps[-1] * nanoseconds[method] / unit:.0f}")
            rows.append([*row, *(f"{times[a] / times['order 2']:.1f}" if times[a] and times["order 2"] else "-"
                                 for a in ("order 1", "stock"))])
            section.record(part="bill", case=name, quantity=f"{target:g}", **{m: times[m] for m in times})
    section.heading("What it costs")
    section.table(["law", "restitution to", *rebound.METHODS, "order 1 / order 2", "stock / order 2"], rows)
    section.text(f"""Run time of the same simulated time in a settled bed of {bench.size(COUNT, 12500)} spheres on one core, in units of that of order 1 with 16 steps
per contact. A step takes {", ".join(f"{report.number(v)} ns per particle with {m}" for m, v in nanoseconds.items())} (Hertz, friction, floor
and four walls). Fewer steps than about 12 per contact are not stable in a bed, whatever the restitution (tables above).""")


def measure(bench):
    with concurrent.futures.ThreadPoolExecutor(len(machine.cores())) as pool:
        bench.note("impacts")
        ladders = impacts(bench, pool)
        flows_of(bench, pool)
    bench.note("time of a step")
    bill(bench, ladders, costs(bench))
