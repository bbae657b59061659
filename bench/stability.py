# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Where the time step stops being stable, very stiff contacts, and extreme scenes: ours and stock."""

import concurrent.futures
import os
import random
import tempfile

import extreme
import limits
import machine
import plot
import verdict
from extreme import Ball, Extreme
from lammps import STOCK, TALUS

TITLE = "Stability"
QUESTION = f"""How large may the time step be, does very stiff material gain energy, and what becomes of extreme scenes?
A run is bad if its energy has risen at the end by more than {verdict.GROWTH:g} of the largest kinetic or elastic energy, an overlap exceeds
{verdict.OVERLAP:g} of the radius, a particle is lost, or a number is not finite."""


# ---- (a) the boundary -------------------------------------------------------------------------

def boundary(bench, pool):
    section = bench.section
    cases = limits.cases(bench.quick)
    steps = bench.size(20000, 4000)
    jobs = [(case, code) for case in cases for code in (TALUS, STOCK)]
    found = dict(zip(((case.name, code) for case, code in jobs),
                     pool.map(lambda job: limits.measured(bench, job[0], job[1], steps if len(job[0].moving) == 1
                                                          else steps // 4), jobs)))
    rows, worst = [], 0.0
    for case in cases:
        expected = limits.theory(case)
        (ours, critical), (stock, _) = found[case.name, TALUS], found[case.name, STOCK]
        worst = max(worst, abs(ours / expected - 1) if expected else 0.0)
        rows.append([case.group, case.name, expected or "-", ours, stock, ours / critical])
        section.record(part="boundary", case=case.name, theory=expected, talus=ours, stock=stock, critical=critical)
    section.heading("Largest stable time step")
    section.table(["", "case", "theory", "Talus", "stock", "Talus / compute timestep/gran"], rows)
    least = min(rows, key=lambda row: row[5])
    section.text(f"""Time steps in units of sqrt(m/k), linear contacts that never open, measured by bisection: a disturbance
of 1e-9 grows 10^4-fold in {steps} steps ({steps // 4} in lattices) or not. Theory: 2 over the largest eigenfrequency of
translation and rotation, with one damped contact 2 (sqrt(1 + z^2) - z). Largest difference of Talus from theory:
{100 * worst:.2f} %. Stock: `gran/hooke/history` and fix nve/sphere, whose forces see positions and velocities at the same
moments as those of the symplectic Euler method. The last column is the limit in units of what compute timestep/gran
calls critical (sqrt(m_eff/k) of the contact): the lowest is {least[5]:.2f} ({least[1]}), so that the advised 20 % is
{least[5] / 0.2:.1f} times below the limit there.""")
    section.plot("limits", "Largest stable time step in units of compute timestep/gran's critical one",
                 lambda plt: draw_limits(plt, rows))


def draw_limits(plt, rows):
    _, axes = plt.subplots(figsize=(6.5, 0.24 * len(rows) + 1))
    for k, row in enumerate(rows):
        axes.plot([row[5]], [k], "o", color="0.0", markersize=4)
    axes.axvline(0.2, color="0.5", linestyle="--")
    axes.set_yticks(range(len(rows)), [row[1] for row in rows], fontsize=7)
    axes.set_xlim(0, 2.2)
    axes.invert_yaxis()
    axes.set_xlabel("limit / critical time step (dashed: advised)")


# ---- (b) stiff --------------------------------------------------------------------------------

def stiff_scene(young, mu, steps):
    draw = random.Random(9)
    balls = [Ball((1.3 * (k % 4) + 0.6, 1.3 * (k // 4 % 4) + 0.6, 1.3 * (k // 16) + 0.6),
                  tuple(draw.gauss(0, 1) for _ in "xyz")) for k in range(64)]
    return Extreme(f"E = {young:.0e}, mu = {mu:g}", balls, ("material", young, 1.0, 0.3, mu), steps, ((0.0, 5.2),) * 3,
                   periodic="p p p", frames=200)


def stiff(bench, pool):
    section = bench.section
    steps = bench.size(100000, 10000)
    powers = (5, 8, 12) if bench.quick else range(5, 13)
    scenes = [stiff_scene(10.0**n, mu, steps) for n in powers for mu in (0.0, 0.3)]
    rows = []
    for scene, outcomes in zip(scenes, pool.map(lambda s: both(bench, s), scenes)):
        ours, stock = outcomes[TALUS], outcomes[STOCK]
        rows.append([scene.name, ours.growth, ours.overlap, ours.word(), stock.growth, stock.word()])
        record(section, "stiff", scene, outcomes)
    section.heading("Stiff material")
    section.table(["scene", "Talus: energy", "overlap/r", "verdict", "stock: energy", "verdict"], rows)
    section.text(f"""64 spheres with e = 1 fly about in a periodic box, speeds about 1.7 m/s, {steps} steps of .2 of the smallest
critical time step. energy: rise of kinetic and elastic energy from the beginning to the last tenth of the run, over the largest of both;
elastic energies of normal contacts are computed from positions by the benchmark, in the same way for both codes, those of
tangential springs are not counted. Stock: pair granular with the same law.""")


# ---- (c) extreme ------------------------------------------------------------------------------

def both(bench, scene):
    """{code: Outcome} with one time step for both codes."""
    folder = tempfile.mkdtemp(prefix="scene-", dir=bench.workdir)
    extreme.write(scene, f"{folder}/data")
    dt = scene.dt or scene.fraction * extreme.critical_step(bench, scene, folder)
    found = {}
    for code in (TALUS, STOCK):
        found[code], _ = extreme.run(bench, scene, code, folder, dt)
        if os.path.exists(f"{folder}/frames.{code}"):
            os.remove(f"{folder}/frames.{code}")
    return found


def record(section, part, scene, outcomes):
    for code, o in outcomes.items():
        section.record(part=part, case=scene.name, code=code, verdict=o.word(), growth=o.growth, swing=o.swing, overlap=o.overlap,
                       lost=o.lost, finite=o.finite, creep=o.creep, kinetic=o.kinetic, said=len(o.warnings),
                       error=o.error)


def describe(outcome):
    """Verdict with the faults."""
    faults = ", ".join(outcome.faults())
    return outcome.word() + (f": {faults}" if faults else "")


def extremes(bench, pool):
    section = bench.section
    scenes = [s for s in extreme.scenes(bench.quick) if bench.wants(s.name)]
    order = sorted(scenes, key=lambda s: -s.steps * len(s.balls))      # the long ones first
    found = dict(zip((s.name for s in order), pool.map(lambda s: both(bench, s), order)))
    rows, silent = [], []
    for scene in scenes:
        ours, stock = found[scene.name][TALUS], found[scene.name][STOCK]
        rows.append([scene.name, ours.growth, ours.overlap, ours.creep if scene.creep else "", describe(ours),
                     stock.growth, stock.overlap, stock.creep if scene.creep else "", describe(stock)])
        record(section, "extreme", scene, found[scene.name])
        if ours.word() == "silent":
            silent.append(f"{scene.name} ({', '.join(ours.faults())})")
    section.heading("Extreme scenes")
    section.table(["scene", "Talus: energy", "overlap/r", "creep/r", "verdict", "stock: energy", "overlap/r", "creep/r",
                   "verdict"], rows)
    section.text("""verdict: `stable`; `warned`: bad, and the log has a warning about it; `stopped`: ended in an error; `silent`:
bad, and nothing was said. creep: largest way of a particle in the last nine tenths of the run. Time steps are .2 of the
smallest critical one unless the name says otherwise, the same for both codes. Stock: pair granular with the same law, fix
wall/gran, fix nve/sphere.""")
    if silent:
        section.headline("stability: scenes that went wrong without a word: " + "; ".join(silent) + ".")


# ---- the detectors ----------------------------------------------------------------------------

def detectors(bench):
    """A seeded failure for each, which it must find."""
    scene = extreme.impact("seeded", ("material", extreme.YOUNG, 1.0, extreme.NU, 0.0))
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


def measure(bench):
    plot.style(0)
    with concurrent.futures.ThreadPoolExecutor(len(machine.cores())) as pool:
        for part, name in ((boundary, "boundary"), (stiff, "stiff"), (extremes, "extremes")):
            if name == "extremes" or bench.wants(name):
                bench.note(name)
                part(bench, pool)
    detectors(bench)
