# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Where the time step stops being stable, very stiff contacts, and extreme scenes: ours and stock."""

import concurrent.futures
import math
import os
import re
import statistics
import tempfile

import elastic
import errors
import extreme
import extreme_bodies
import extreme_scene
import friction_gain
import heap
import lammps
import limits
import machine
import plot
import verdict
from lammps import SECOND, STOCK, TALUS

TITLE = "Stability"
QUESTION = f"""How large may the time step be, does very stiff material gain energy, and what becomes of extreme scenes?
A run is bad if its energy has risen at the end by more than {verdict.GROWTH:g} of the largest kinetic or elastic energy, an overlap exceeds
{verdict.OVERLAP:g} of the radius, a particle is lost, or a number is not finite."""

CODES = (TALUS, SECOND, STOCK)
LOUD = verdict.GROWTH      # mean gain of an impact that calls for a warning; smaller ones are noise of the moments


# ---- (a) the boundary -------------------------------------------------------------------------

def boundary(bench, pool):
    section = bench.section
    cases = limits.cases(bench.quick)
    steps = bench.size(20000, 4000)
    jobs = [(case, code) for case in cases for code in (TALUS, SECOND, STOCK)]
    found = dict(zip(((case.name, code) for case, code in jobs),
                     pool.map(lambda job: limits.measured(bench, job[0], job[1], steps if len(job[0].moving) == 1
                                                          else steps // 4), jobs)))
    rows, off, advised = [], {TALUS: 0.0, SECOND: 0.0}, []
    for case in cases:
        row = [case.group, case.name]
        for order, code in ((1, TALUS), (2, SECOND)):
            expected, (limit, critical, allowed) = limits.theory(case, order), found[case.name, code]
            off[code] = max(off[code], abs(limit / expected - 1))
            row += [expected, limit, limit / critical, limit / allowed]
            advised.append((limit / critical, case.name, code, allowed / critical))
            section.record(part="boundary", case=case.name, code=code, theory=expected, talus=limit, critical=critical,
                           allowed=allowed)
        stock = found[case.name, STOCK][0]
        section.record(part="boundary", case=case.name, code=STOCK, talus=stock)
        rows.append([*row, stock])
    section.heading("Largest stable time step")
    columns = [f"{name}: {what}" for name in ("order 1", "order 2") for what in ("theory", "found", "/critical", "/stable")]
    section.table(["", "case", *columns, "stock"], rows)
    section.text(f"""Time steps in units of sqrt(m/k), linear contacts that never open, measured by bisection: a disturbance
of 1e-9 grows 10^4-fold in {steps} steps ({steps // 4} in lattices) or not. Theory: the roots of the difference equation of the linear
system leave the unit circle; without damping 2 over the largest eigenfrequency of translation and rotation, with both orders. Largest
difference from theory: order 1 {100 * off[TALUS]:.2f} %, order 2 {100 * off[SECOND]:.2f} %. Damping ratios are those of one contact of the moving
sphere; in lattices, where neighbors move as well, of a sphere of twice the effective mass. Stock: `gran/hooke/history` and fix
nve/sphere, whose forces see positions and velocities at the same moments as those of the symplectic Euler method. /critical:
the limit in units of the first rule of compute timestep/gran (sqrt(m_eff/k) of the contact); /stable: of its stability limit, which is
that of twelve contacts with the damping and friction of the law. Below 1 in the last column of an order would be a limit that compute
timestep/gran calls stable. Order 2 is implicit in the normal damping of each contact, so that one contact is stable up to 2 with any
damping; what other contacts and the tangential dashpot add is extrapolated by half a step, which doubles its weight.""")
    below = [f"{name} ({'order 2' if code == SECOND else 'order 1'}, {fraction:.2f})" for fraction, name, code, _ in advised
             if fraction < 0.2]
    section.text("Limits below the 20 % of the critical time step that are advised: "
                 + ("; ".join(below) + ": of these the log warns at the start of a run" if below else "none") + ".")
    section.plot("limits", "Largest stable time step in units of compute timestep/gran's critical one",
                 lambda plt: draw_limits(plt, rows))


def draw_limits(plt, rows):
    _, axes = plt.subplots(figsize=(6.5, 0.24 * len(rows) + 1))
    for k, row in enumerate(rows):
        axes.plot([row[4]], [k], "o", color="0.0", markersize=4, label="order 1")
        axes.plot([row[8]], [k], "x", color="0.0", markersize=5, label="order 2")
        if not k:
            axes.legend(loc="lower right")
    axes.axvline(0.2, color="0.5", linestyle="--")
    axes.set_yticks(range(len(rows)), [row[1] for row in rows], fontsize=7)
    axes.set_xlim(0, 2.2)
    axes.invert_yaxis()
    axes.set_xlabel("limit / critical time step (dashed: advised)")


# ---- (b) stiff --------------------------------------------------------------------------------

def stiff_scene(young, mu, steps, fraction=0.2, fast=False):
    """Below 1e8 Pa speeds are less, in proportion to sqrt(E): overlaps stay those of small ones."""
    name = f"E = {young:.0e}, mu = {mu:g}" + f", dt {fraction:g} critical" * (fraction != 0.2) + ", fast" * fast
    return elastic.gas(name, ("material", young, 1.0, 0.3, mu), 1.0 if fast else min(1.0, math.sqrt(young / 1e8)), steps,
                       fraction=fraction)


def stiff(bench, pool):
    section = bench.section
    steps = bench.size(100000, 10000)
    powers = (5, 8, 12) if bench.quick else range(5, 13)
    scenes = [stiff_scene(10.0**n, mu, steps, fraction) for n in powers for mu, fraction in ((0.0, 0.2), (0.0, 0.07), (0.3, 0.2))]
    scenes.append(stiff_scene(1e5, 0.0, steps, fast=True))
    rows = []
    for scene, outcomes in zip(scenes, pool.map(lambda s: every_code(bench, s), scenes)):
        ours, second, stock = (outcomes[code] for code in CODES)
        rows.append([scene.name, ours.growth, ours.overlap, describe(ours), *growth_and_verdict(second), *growth_and_verdict(stock)])
        record(section, "stiff", scene, outcomes)
        bench.tally.outcomes("stiff: " + scene.name, outcomes)
    section.heading("Stiff material")
    section.table(["scene", "Talus: energy", "overlap/r", "verdict", "order 2: energy", "verdict", "stock: energy", "verdict"], rows)
    section.text(f"""64 spheres with e = 1 fly about in a periodic box, speeds about 1.7 m/s, below 1e8 Pa less in proportion
to sqrt(E), but in the last scene, {steps} steps of .2 of the smallest
critical time step, and without friction also of the .07 that Talus advises there. energy: rise of kinetic and elastic energy from
the beginning to the last tenth of the run, over the largest of both; elastic energies of normal contacts are computed from positions
by the benchmark, in the same way for both codes, those of tangential springs are not counted. Stock: pair granular with the same
law. Verdicts as below. Talus warns of all scenes without friction at .2 (next section); the stiffest have overlaps far below the 1 % of
the radius at which the critical time step is taken, and stay stable.""")


# ---- elastic impacts --------------------------------------------------------------------------

def impacts(bench, pool):
    """Why an elastic gas at .2 of the critical time step may gain energy, and at which step it does not."""
    section = bench.section
    steps, fractions = bench.size(100000, 10000), (0.2, 0.1, 0.07, 0.03)
    cases = [(law, fraction) for law in elastic.LAWS for fraction in fractions]
    singles = {code: elastic.singles(bench, pool, code, cases) for code in (TALUS, SECOND)}
    early = elastic.gases(bench, pool, TALUS, cases, steps // 10)
    gas = {code: elastic.gases(bench, pool, code, cases, steps) for code in CODES}
    rows = []
    for law, fraction in cases:
        name = f"{law}, dt {fraction:g} critical"
        rows.append([name])
        for code in CODES:
            ours = gas[code][law, fraction]
            if code == STOCK:
                section.record(part="elastic", case=name, code=code, fraction=fraction, growth=ours.spread(), largest=ours.largest())
                bench.tally.add("elastic: " + name, code, "silent" if ours.largest() > verdict.GROWTH else "stable")
                rows[-1] += [ours.spread(), ours.largest()]
                continue
            one = singles[code][law, fraction]
            bad = max(one.largest(), ours.largest()) > verdict.GROWTH
            word = ("warned" if ours.said else "silent") if bad else "stable"
            rows[-1] += [one.spread(), one.largest(), *([early[law, fraction].spread()] if code == TALUS else []), ours.spread(),
                         ours.largest(), word + " (warned)" * (ours.said and not bad)]
            section.record(part="elastic", case=name, code=code, fraction=fraction, growth=ours.spread(), largest=ours.largest(),
                           single=one.spread(), largest_single=one.largest(), verdict=word, said=ours.said)
            bench.tally.add("elastic: " + name, code, word)
    orders = [errors.order(fractions, [singles[TALUS][law, fraction].spread() for fraction in fractions]) for law in elastic.LAWS]
    root = statistics.geometric_mean(gas[TALUS][case].spread() / early[case].spread() for case in cases)
    shrinks = statistics.geometric_mean(gas[TALUS][case].spread() / gas[SECOND][case].spread() for case in cases)
    section.heading("Elastic impacts without friction")
    section.table(["law", "one impact: rms", "largest", f"gas, {steps // 10} steps: rms", f"{steps} steps: rms", "largest", "verdict",
                   "order 2, one impact: rms", "largest", f"gas, {steps} steps: rms", "largest", "verdict",
                   f"stock, {steps} steps: rms", "largest"], rows)
    section.text(f"""Energy that is too much or too little, over the whole: of one head-on impact of two spheres, over {len(one.values)} moments within a step
at which it begins (overlaps up to {elastic.DEPTH:g} r); and of the 64 spheres of the section above (1e7 Pa, or linear),
over {len(ours.values)} beginnings. The force of a contact begins and ends with a kink that falls within a time step. What that does
to the energy depends on the moment, is next to zero on average over them, and of order dt^2 with a linear law and dt^2.5 with a Hertzian
one, up to a factor that goes up and down with the number of steps in a contact (fitted: {orders[0]:.1f} and {orders[1]:.1f}).
Nothing brings it back: without damping or friction the energy walks at random, with the root of the number of
impacts ({root:.1f} times as far in 10 times as many steps, on average over the rows; root 10 is 3.2).
It is the same for velocity Verlet of the stock styles and for both starts of fix nve/sphere/symplectic, whose impacts have the same errors. With `order 2`, which
makes up for the kinks, the energy of the gas walks {shrinks:.1f} times less far (mean over the rows). Cure: a smaller time
step, .03 of the critical one with a linear law, .07 with a Hertzian one, whose kinks are weaker; or e below .995, with which an impact loses more.
Talus says so at the start of a run above these time steps, if no contact of the scene has damping or friction.""")


# ---- (c) extreme ------------------------------------------------------------------------------

def every_code(bench, scene):
    """{code: Outcome} with one time step for all codes."""
    folder = tempfile.mkdtemp(prefix="scene-", dir=bench.workdir)
    extreme.write(scene, f"{folder}/data")
    dt = scene.dt or scene.fraction * extreme.critical_step(bench, scene, folder)
    found = {}
    for code in CODES:
        found[code], _ = extreme.run(bench, scene, code, folder, dt)
        if os.path.exists(f"{folder}/frames.{code}"):
            os.remove(f"{folder}/frames.{code}")
    return found


def record(section, part, scene, outcomes):
    for code, o in outcomes.items():
        section.record(part=part, case=scene.name, code=code, verdict=o.word(), growth=o.growth, swing=o.swing, overlap=o.overlap,
                       lost=o.lost, finite=o.finite, creep=o.creep, kinetic=o.kinetic, said=len(o.warnings),
                       error=o.error)


def growth_and_verdict(outcome):
    """Cells; a run that was refused has no energy."""
    return ["" if outcome.word() == "refused" else outcome.growth, describe(outcome)]


def describe(outcome):
    """Verdict with the faults."""
    faults = ", ".join(outcome.faults())
    return outcome.word() + (f": {faults}" if faults else "")


def extremes(bench, pool):
    section = bench.section
    scenes = [s for s in extreme.scenes(bench.quick) if bench.wants(s.name)]
    order = sorted(scenes, key=lambda s: -s.steps * len(s.balls))      # the long ones first
    found = dict(zip((s.name for s in order), pool.map(lambda s: every_code(bench, s), order)))
    rows = []
    for scene in scenes:
        rows.append([scene.name])
        for outcome in (found[scene.name][code] for code in CODES):
            rows[-1] += [*growth_and_verdict(outcome)[:1], outcome.overlap, outcome.creep if scene.creep else "", describe(outcome)]
        record(section, "extreme", scene, found[scene.name])
        bench.tally.outcomes(scene.name, found[scene.name])
    section.heading("Extreme scenes")
    section.table(["scene", *(f"{name}{what}" for name in ("Talus: ", "order 2: ", "stock: ")
                              for what in ("energy", "overlap/r", "creep/r", "verdict"))], rows)
    section.text("""verdict: `stable`; `warned`: bad, and the log has a warning about it; `stopped`: ended in an error; `silent`:
bad, and nothing was said; `refused`: an error that says what stands in the way of the order. order 2: with limit_damping and slider
midpoint. creep: largest way of a particle in the last nine tenths of the run. Time steps are .2 of the
smallest critical one unless the name says otherwise, the same for both codes. Stock: pair granular with the same law, fix
wall/gran, fix nve/sphere. In `size ratio 20, wedged` the small sphere rolls down between
the large ones, faster and faster: damping that may attract holds it on its way around them, with limit_damping (order 2) it takes off at their
side and falls out of the box, at any time step. Clumps: stock is fix rigid/small. Their energies are those of the velocities of their spheres,
which are behind by half a step with order 2, as it shows in fast turns. `heavy end`: a push on the light end has a fortieth of the mass
against it, which no rule but the limit of stability knows.""")
    alarms = [scene.name + " (order 2)" * (code == SECOND) for code in (TALUS, SECOND) for scene in scenes
              if found[scene.name][code].warnings and found[scene.name][code].word() == "stable"]
    section.text("Warnings of Talus in scenes that stayed stable: " + ("; ".join(alarms) if alarms else "none") + "."
                 + (" One elastic impact is a matter of the moment at which it begins; with mu = 1000 and no damping, of its angle: "
                    "what is warned about is the worst case, see the sections on elastic impacts and on friction.") * bool(alarms))


# ---- (d) friction without damping -------------------------------------------------------------

def friction_case(kind, code, fraction, midpoint):
    return f"friction: {kind}{', midpoint' * (midpoint and code == TALUS)}, dt {fraction} critical"


def friction(bench, pool):
    section = bench.section
    kinds = [(mu, 0.0) for mu in (0.5, 1.0, 1.5, 2.0, 5.0, 10.0, 1000.0)] + [(10.0, 0.05)] + [(1.0, r) for r in (0.1, 0.2, 0.5, 1.0)]
    rolls = [k for k in kinds if k[1]]
    slides = [k for k in kinds if not k[1]]
    columns = [(TALUS, f, False) for f in (0.2, 0.1, 0.05)] + [(TALUS, f, True) for f in (0.2, 0.05)] + [
        (SECOND, f, True) for f in (0.2, 0.05)] + [(STOCK, 0.2, False), (STOCK, 0.05, False)]
    phases = bench.size(16, 4)

    def one(column):
        code, fraction, midpoint = column
        found = dict(zip(slides, friction_gain.gains(bench, code, slides, fraction, midpoint, phases)))
        if code != STOCK:
            try:
                found.update(zip(rolls, friction_gain.gains(bench, code, rolls, fraction, midpoint, phases)))
            except lammps.Failed as failure:      # rolling resistance and order 2
                if code != SECOND or "order 2" not in str(failure):
                    raise
        return found
    results = dict(zip(columns, pool.map(one, columns)))
    rows = []
    for kind in kinds:
        row = [f"mu {kind[0]:g}" + (f", rolling {kind[1]:g}" if kind[1] else "")]
        for code, fraction, midpoint in columns:
            if kind not in results[code, fraction, midpoint]:
                row.append("-")
                if code == SECOND:
                    bench.tally.add(friction_case(row[0], code, fraction, midpoint), code, "refused")
                continue
            mean, largest = results[code, fraction, midpoint][kind]
            said = friction_gain.warned(bench, code, *kind, fraction, midpoint) if code != STOCK else ""
            row.append(f"{mean:+.1e}" + (" (warned)" if said else ""))
            section.record(part="friction", case=row[0], code=code, fraction=fraction, midpoint=midpoint, growth=mean, largest=largest,
                           said=said)
            word = "stable" if mean <= LOUD else "warned" if said else "silent"
            bench.tally.add(friction_case(row[0], code, fraction, midpoint), code, word)
        rows.append(row)
    section.heading("Friction without damping")
    section.table(["", *(("stock" if code == STOCK else "order 2" if code == SECOND else "midpoint" if mid else "Talus") + f", dt {f} critical" for code, f, mid in columns)], rows)
    section.text(f"""Elastic impacts (hertz/material, e = 1) of two spheres at {len(friction_gain.ANGLES)} angles from 0 to {max(friction_gain.ANGLES)}
degrees and {len(friction_gain.SPINS)} angular velocities: gain of kinetic energy, mean over {phases} moments within a step at which the contact begins, at
the angle and angular velocity where it is largest. (warned): Talus says so at the start of the run. Single impacts scatter also without
friction, see above; the mean does not grow. Two errors of the spring give energy. The usual update of the tangential displacement is of
first order (the step in which a contact begins counts whole), and above mu = .5 the limit of friction takes away less and less of
what is too much: a smaller time step or `midpoint` cures it, and rolling resistance of .01 mu or more takes it away. And the spring of a Hertzian contact that neither slips (mu above 10) nor turns (rolling
resistance above .2) stiffens with the overlap while it is stretched, which adds energy: that is a property of the law, which no time step cures, and damping does.""")


# ---- (e) would an adaptive time step pay? -----------------------------------------------------

def adaptive(bench, _pool):
    """How much the critical time step changes while a column falls apart."""
    section = bench.section
    steps = bench.size(40000, 8000)
    log = heap.watched(bench, steps)
    found = [float(m[1]) for m in re.finditer(r"^ *\d+ +(\S+) watched$", log, re.MULTILINE)]
    lowest, median, highest = min(found), statistics.median(found), max(found)
    section.heading("A time step that adapts itself")
    section.text(f"""There is none (no fix dt/gran), because it would not pay. While a column of {heap.COUNT} spheres falls apart ({steps} steps, hertz/material,
friction, looked at every {heap.WATCH} steps) the smallest critical time step of compute timestep/gran is between {lowest:.3g} and {highest:.3g} s,
median {median:.3g} s: a step that followed it everywhere would be {statistics.fmean(found) / lowest:.2f} times the one that is small enough
throughout. With linear contacts it does not change at all; a Hertzian one depends on the overlap by its fourth root: between 1 % of the
radius, where the rule is taken, and 10 %, where the overlap is warned about, by 1.78. What can change by more are sizes and masses, if
smaller particles are added or particles shrink: pair gran/penalty looks at them at every rebuild and warns if the time step is then
above .2 of the critical one.""")
    section.record(part="adaptive", case="column", theory=lowest, critical=median, talus=highest)


# ---- the detectors ----------------------------------------------------------------------------

def detectors(bench):
    """A seeded failure for each, which it must find."""
    scene = extreme.impact("seeded", ("material", extreme_scene.YOUNG, 1.0, extreme_scene.NU, 0.0))
    folder = bench.path("seeded")
    os.makedirs(folder, exist_ok=True)
    extreme.write(scene, f"{folder}/data")
    dt = 0.01 * extreme.critical_step(bench, scene, folder)
    scene.steps = 1500
    clean, frames = extreme.run(bench, scene, TALUS, folder, dt)

    def judged(change):
        spoiled = [(step, {k: list(v) for k, v in frame.items()}) for step, frame in frames]
        for _, frame in spoiled[-len(spoiled) // 10:]:
            change(frame)
        return verdict.judge(spoiled, _quiet(), extreme.grains(scene))

    def faster(frame):
        frame["vx"] = [1.001 * v for v in frame["vx"]]

    def not_a_number(frame):
        frame["y"][0] = float("nan")

    def gone(frame):
        for column in frame.values():
            column.pop()

    def deeper(frame):
        frame["x"] = [-0.47, 0.47]
        frame["vx"] = [0.0, 0.0]
    seeded = {"nothing": clean, "speeds up by .1 %": judged(faster), "one coordinate not a number": judged(not_a_number),
              "one particle taken away": judged(gone), "pressed together by .12 r": judged(deeper)}
    bench.section.heading("Detectors")
    bench.section.table(["seeded into the last tenth of an elastic impact", "found"],
                        [[name, ", ".join(o.faults()) or "nothing"] for name, o in seeded.items()])
    missed = [name for name, o in seeded.items() if bool(o.faults()) == (name == "nothing")]
    if missed:
        bench.section.headline("stability: detectors fail for: " + "; ".join(missed) + ".")


class _quiet:
    """A lammps.Result of a run that said nothing."""

    def warnings(self):
        return []

    def error(self):
        return ""


class Tally:
    """Verdicts of all tables, by code."""

    def __init__(self):
        self.words = {code: {} for code in CODES}

    def add(self, name, code, word):
        self.words[code][name] = word

    def outcomes(self, name, found):
        for code, outcome in found.items():
            self.add(name, code, outcome.word())

    def silent(self, code):
        return [name for name, word in self.words[code].items() if word == "silent"]

    def counts(self, code):
        words = list(self.words[code].values())
        return ", ".join(f"{words.count(word)} {word}" for word in ("stable", "warned", "stopped", "refused") if word in words)

    def sentence(self):
        """For the first paragraph of the report."""
        stock = f"the stock styles left {len(self.silent(STOCK))} of their {len(self.words[STOCK])} without a word"
        silent = self.silent(TALUS) + [name + " (order 2)" for name in self.silent(SECOND)]
        if silent:
            return f"stability: scenes that went wrong without a word: {'; '.join(silent)}; {stock}."
        return (f"stability: none of {len(self.words[TALUS])} scenes went wrong without a word ({self.counts(TALUS)}), nor of "
                f"{len(self.words[SECOND])} with order 2 ({self.counts(SECOND)}); {stock}.")


def measure(bench):
    plot.style(0)
    bench.tally = Tally()
    parts = ((boundary, "boundary"), (stiff, "stiff"), (impacts, "elastic"), (extremes, "extremes"), (extreme_bodies.shapes, "shapes"),
             (extreme_bodies.meshes, "meshes"), (friction, "friction"), (adaptive, "adaptive"))
    with concurrent.futures.ThreadPoolExecutor(len(machine.cores())) as pool:
        for part, name in parts:
            if name == "extremes" or bench.wants(name):
                bench.note(name)
                part(bench, pool)
    if bench.tally.words[TALUS]:
        bench.section.headline(bench.tally.sentence())
    detectors(bench)
