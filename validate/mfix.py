# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""The verification cases of MFIX-DEM."""

import math
import os
import statistics
import sys

import numpy

import lammps
import machine
import mfix_exact
import problems

os.environ.setdefault("TALUS_LMP", machine.STOCK_LMP)
os.environ.setdefault("TALUS_PLUGIN", os.path.join(machine.BUILD, "talusplugin.so"))
sys.path.append(os.path.join(machine.ROOT, "tests", "lib"))
import impact_tables
from impact_tables import AL_OXIDE, Impact, Material

TITLE = "The cases of MFIX-DEM"
QUESTION = """One or two spheres whose motion is known: the cases DEM01 to DEM05 with which MFIX-DEM is verified (Garg, Galvin, Li, Pannala,
Powder Technology 220, 122, 2012; [manual](https://mfix.netl.doe.gov/doc/vvuq-manual)). A sphere falls on a plane and rebounds (01) and
bounces on (02), two spheres are compressed between planes (03), a sphere slides until it rolls (04), and meets a plane at all angles (05,
measured by Kharaz, Gorham, Salman, Powder Technology 120, 281, 2001)."""

R, DENSITY, HEIGHT = 0.1, 2600.0, 0.5
MASS = DENSITY * 4 / 3 * math.pi * R**3
STEPS = 1000                # per contact, of all cases
FALLS = (1e4, 2.5e4, 5e4, 1e5), (0.6, 0.7, 0.8, 0.9)
BOUNCES = (5e4, 5e5, 5e6), (0.5, 0.6, 0.7, 0.8, 0.9, 1.0)
NUMBER = 3                  # of bounces that are looked at
LADDER = (16, 32, 64, 128, 256)
SLIPS = (0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)

# 05: angle from the normal and tangential restitution, angle and angular velocity (rad/s) as measured
MEASURED_E = ((2.2, 0.797), (4.2, 0.746), (9.8, 0.675), (20.2, 0.599), (30.4, 0.690), (39.5, 0.774), (49.6, 0.848),
              (71.1, 0.937), (79.2, 0.970), (85.2, 0.979))
MEASURED_W = ((5.9, -135), (10.9, -261), (21.1, -574), (31.1, -612), (39.0, -595), (50.2, -450),
              (60.1, -376), (70.0, -243), (78.6, -142), (84.3, -71))
FRICTION, SPEED, SMALL = 0.092, 3.9, 0.0025
SPRINGS = 1.72e7, 1.48e7    # along the normal, along the plane
GLASS = Material(70e9, 0.25, 2500.0)
SLIDES = 35.0               # degrees: from here on the sphere slides to the end of the impact


def contact_time(stiffness, mass):
    return math.pi * math.sqrt(mass / stiffness)


def fall(bench, stiffness, restitution, number, cores, steps=STEPS, order=1, every=10):
    """(times, heights, what they should be) of a sphere until it has bounced so often."""
    damped = mfix_exact.damping(restitution, stiffness, MASS)
    exact = mfix_exact.Bounces(stiffness, damped, MASS, R, HEIGHT, number, pulls=order == 1)
    dt = contact_time(stiffness, MASS) / steps
    flight = 2 * math.sqrt(2 * (exact.tops[-1] - R) / mfix_exact.GRAVITY)
    variables = {"kn": stiffness, "damping": damped, "order": order, "dt": repr(dt), "run": exact.starts[-1] + 0.9 * flight, "every": every}
    folder, _ = problems.run(bench, "mfix_fall", f"fall-{stiffness}-{restitution}-{steps}-{order}-{number}", variables, cores)
    frames = lammps.read_frames(os.path.join(folder, "heights.txt"))
    return [step * dt for step, _ in frames], [columns["z"][0] for _, columns in frames], exact


def tops(times, heights, exact):
    """The tops after each bounce, of parabolas through three heights well within the flight."""
    found = []
    ends = [*exact.starts[1:], times[-1]]
    for k in range(2, 2 * len(exact.tops) - 1, 2):
        begin, end = exact.starts[k], min(ends[k], times[-1])
        picked = [numpy.searchsorted(times, begin + share * (end - begin)) for share in (0.2, 0.5, 0.8)]
        t, z = [times[n] - times[picked[0]] for n in picked], [heights[n] for n in picked]
        a, b, c = numpy.polyfit(t, z, 2)
        found.append(float(c - b * b / (4 * a)))
    return found


def falls(bench):
    """Case 01: largest errors of the height over the diameter in the three stages."""
    stiffnesses, values = FALLS if not bench.quick else ((1e4,), (0.6, 0.9))
    runs = problems.at_once([lambda cores, k=k, e=e: fall(bench, k, e, 1, cores) for k in stiffnesses for e in values])
    worst = [0.0] * 3
    for times, heights, exact in runs:
        for t, z in zip(times, heights):
            stage = exact.stage(t)
            worst[stage] = max(worst[stage], abs(z - exact.height(t)) / (2 * R))
    for what, error, bound in zip(("free fall", "contact", "rebound"), worst, (1e-9, 1.0 / STEPS, 2.5 / STEPS)):
        bench.section.result(f"01, {what}: largest error of the height over the diameter", error, 0.0, bound)
    return dict(zip(values, runs))


def bounces(bench):
    """Case 02: rows of stiffness, restitution, distances of the tops from those of the springs, and from those of hard spheres."""
    stiffnesses, values = BOUNCES if not bench.quick else ((5e4, 5e5), (0.7, 1.0))
    pairs = [(k, e) for k in stiffnesses for e in values]
    runs = problems.at_once([lambda cores, k=k, e=e: fall(bench, k, e, NUMBER, cores, every=20) for k, e in pairs])
    rows, hard = [], dict.fromkeys(stiffnesses, 0.0)
    for (stiffness, e), run in zip(pairs, runs):
        found, exact = tops(*run), run[2].tops[1:]
        rigid = [R + e**(2 * n) * (HEIGHT - R) for n in range(1, NUMBER + 1)]
        errors = [abs(f / x - 1) for f, x in zip(found, exact)]
        hard[stiffness] = max([hard[stiffness], *(abs(f / x - 1) for f, x in zip(found, rigid))])
        rows.append([stiffness, e, found[0], exact[0], rigid[0], max(errors)])
    bench.section.result("02, largest relative error of the height of the first bounces", max(row[-1] for row in rows), 0.0, 1.5 / STEPS)
    stiff, soft = max(stiffnesses), min(stiffnesses)
    bench.section.result(f"02, largest relative distance from hard spheres, kn = {stiff:.0e} N/m", hard[stiff], 0.0, bench.size(0.02, 0.05))
    # the weight acts for as long as the contact lasts
    rate = math.log(hard[soft] / hard[stiff]) / math.log(stiff / soft)
    bench.section.result("02, power of 1/kn with which that distance falls", rate, 0.45, 0.55)
    bench.section.table(["kn, N/m", "e", "first top, m", "of the spring", "of hard spheres", "largest relative error of the tops"], rows)


def compressed(bench):
    """Case 03: largest error of the heights over the diameter."""
    stiffness, radius, ceiling = 1e3, 5e-4, 1.8e-3
    masses = [density * 4 / 3 * math.pi * radius**3 for density in (2e4, 1e4)]
    between = masses[0] * masses[1] / sum(masses)
    dt = contact_time(stiffness, between) / STEPS

    def one(restitution, cores):
        lower, upper, middle = (mfix_exact.damping(restitution, stiffness, m) for m in (*masses, between))
        variables = {"lower": lower, "upper": upper, "middle": middle, "dt": repr(dt)}
        folder, _ = problems.run(bench, "mfix_stack", f"stack-{restitution}", variables, cores)
        frames = lammps.read_frames(os.path.join(folder, "heights.txt"))
        exact = mfix_exact.stack(stiffness, lower, upper, middle, masses, radius, ceiling, [step * dt for step, _ in frames])
        return max(abs(columns["z"][k] - y[k]) for (_, columns), y in zip(frames, exact) for k in (0, 1)) / (2 * radius)
    values = bench.size((0.5, 0.6, 0.7, 0.8, 0.9, 1.0), (0.5, 1.0))
    worst = max(problems.at_once([lambda cores, e=e: one(e, cores) for e in values]))
    bench.section.result("03, largest error of the heights over the diameter", worst, 0.0, 1e-4)


def slip(bench, friction, cores):
    """(moment at which it rolls, speed, spin) of case 04, over what they should be."""
    start, radius = 0.1, 5e-4
    moment = 2 * start / (7 * friction * mfix_exact.GRAVITY)
    dt = contact_time(1e4, 1e4 * 4 / 3 * math.pi * radius**3) / (STEPS // 10)
    variables = {"mu": friction, "dt": repr(dt), "run": 1.5 * moment}
    folder, _ = problems.run(bench, "mfix_slip", f"slip-{friction}", variables, cores)
    frames = lammps.read_frames(os.path.join(folder, "speeds.txt"))
    rows = [(step * dt, columns["vx"][0], radius * columns["omegay"][0]) for step, columns in frames]
    before, after = next((a, b) for a, b in zip(rows, rows[1:]) if b[1] <= b[2])
    slide = [u - w for _, u, w in (before, after)]
    rolls = before[0] + (after[0] - before[0]) * slide[0] / (slide[0] - slide[1])
    steady = [row for row in rows if row[0] > 1.2 * moment]
    speed, spin = (sum(row[k] for row in steady) / len(steady) / (5 * start / 7) for k in (1, 2))
    return rolls / moment, speed, spin


def slips(bench):
    values = bench.size(SLIPS, (0.2, 1.0))
    found = problems.at_once([lambda cores, mu=mu: slip(bench, mu, cores) for mu in values])
    for k, (what, bound) in enumerate((("moment at which it rolls", 1e-3), ("speed", 5e-4), ("spin", 5e-4))):
        bench.section.result(f"04, largest relative error of the {what}", max(abs(each[k] - 1) for each in found), 0.0, bound)


def meet(bench, name, words, plane, longer, angles, cores):
    """{angle: (tangential restitution, angular velocity)} of case 05; longer: time of contact over that on a rigid plane, by Hertz."""
    folder = bench.path(name)
    os.makedirs(folder, exist_ok=True)

    def run(script):
        lammps.run(folder, name, script, lammps.TALUS, cores=cores)
    impacts = [Impact(AL_OXIDE, SMALL, SPEED * math.cos(math.radians(a)), words, SPEED * math.sin(math.radians(a))) for a in angles]
    for impact in impacts:
        impact.hertz.time *= longer
    impact_tables.collide(impacts, run, lambda file: os.path.join(folder, file), plane=plane)
    return {a: (i.tangential / i.sideways, -i.turn) for a, i in zip(angles, impacts)}


def apart_from_equations(table):
    """Largest distance of case 05 with linear springs from the solution, in units of mu v_n."""
    worst = 0.0
    for angle, (e, w) in table.items():
        ratio, unit = math.tan(math.radians(angle)) / FRICTION, FRICTION * SPEED * math.cos(math.radians(angle))
        patch, spin = mfix_exact.oblique(ratio, SPRINGS[1] / SPRINGS[0])
        # the sphere and its spin share what the patch loses as 2 to 5
        worst = max(worst, abs(e - (1 - 0.4 * spin / ratio)), abs(-w * SMALL - spin * unit) / unit, abs((ratio - 1.4 * spin) - patch))
    return worst


def oblique(bench):
    """Case 05 with linear springs and with Hertz: {law: {angle: ...}}."""
    angles = sorted({a for a, _ in MEASURED_E + MEASURED_W})
    linear = f"hooke {SPRINGS[0]} 0 tangential multistep {SPRINGS[1]} 0 {FRICTION}"
    friction = f"tangential multistep NULL NULL {FRICTION}"
    hertz = [f"hertz/material {m.young} 1.0 {m.poisson} {friction}" for m in (AL_OXIDE, GLASS)]
    compliances = [(1 - m.poisson**2) / m.young for m in (AL_OXIDE, GLASS)]
    found = dict(zip(("linear springs", "Hertz"), problems.at_once([
        lambda cores: meet(bench, "linear", linear, linear, 2.5, angles, cores),
        lambda cores: meet(bench, "hertz", *hertz, (sum(compliances) / compliances[0])**0.4, angles, cores)])))
    apart = apart_from_equations(found["linear springs"])
    bench.section.result("05, linear springs: largest distance from their equations", apart, 0.0, 5e-3)
    for law, table in found.items():
        for k, what, measured, bound, unit in ((0, "e_t", MEASURED_E, 0.03, ""), (1, "the spin", MEASURED_W, 0.08 * 612, "rad/s")):
            apart = max(abs(table[a][k] - value) for a, value in measured if a > SLIDES)
            bench.section.result(f"05, {law}: largest distance of {what} from the measured, above {SLIDES:.0f} degrees", apart, 0.0,
                                 bound, unit)
    bench.section.table(["angle, degrees", "e_t, linear springs", "Hertz", "measured"],
                        [[a, found["linear springs"][a][0], found["Hertz"][a][0], e] for a, e in MEASURED_E])
    return found


def ladder(bench):
    """{order: [(steps per contact, root mean square of the relative errors of the height of the first bounce)]} of case 01."""
    numbers = bench.size(LADDER, LADDER[1:4])
    stiffnesses = bench.size((1e4, 1.4e4, 1.7e4, 2.1e4, 2.5e4, 3.1e4, 3.6e4, 4.3e4, 5e4, 6e4, 7e4, 8.4e4, 1e5), (1e4, 1.7e4, 2.5e4, 3.6e4))
    jobs = [(order, n, k) for order in (1, 2) for n in numbers for k in stiffnesses]
    runs = problems.at_once([lambda cores, j=j: fall(bench, j[2], 0.8, 1, cores, steps=j[1], order=j[0], every=1) for j in jobs])
    errors = {job: tops(*run)[0] / run[2].tops[1] - 1 for job, run in zip(jobs, runs)}
    found = {order: [(n, math.sqrt(statistics.fmean(errors[order, n, k]**2 for k in stiffnesses))) for n in numbers] for order in (1, 2)}
    for order, rows in found.items():
        slope = -float(numpy.polyfit(*numpy.log(rows).T, 1)[0])
        wide = bench.size(0.2, 0.4)
        bench.section.result(f"order of the error of the height of the first bounce, order {order}", slope, order - wide, order + wide)
    bench.section.table(["steps per contact", "error, order 1", "error, order 2"],
                        [[n, a, b] for (n, a), (_, b) in zip(found[1], found[2])])
    return found


def measure(bench):
    shown = falls(bench)
    bounces(bench)
    compressed(bench)
    slips(bench)
    angles = oblique(bench)
    errors = ladder(bench)
    for order, rows in errors.items():
        for n, error in rows:
            bench.section.record(order=order, steps_per_contact=n, error=error)
    bench.section.text(f"""01: diameter 0.2 m, 2600 kg/m^3, from 0.5 m; hooke with kn = 1e4, 2.5e4, 5e4 and 1e5 N/m, e = 0.6, 0.7, 0.8, 0.9. The
stages of free fall, damped oscillator and rebound follow each other exactly; e is that of the damping without weight. {STEPS} steps per
contact, as in 02 and 03. 02: the same with kn = 5e4, 5e5 and 5e6 N/m, e = 0.5 to 1, {NUMBER} bounces, against the exact motion of the
springs, and against hard spheres, whose tops are (0.5 m - R) e^(2 k) + R: these have no weight while they touch, so that the distance
falls as the duration of a contact, as 1/sqrt(kn). 03: spheres of 1 mm, the lower one of 20000, the upper one of 10000 kg/m^3, between
planes that are 1.8 mm apart, kn = 1000 N/m, e = 0.5 to 1, for 1 ms, against the method of Runge and Kutta of order 4. 04: a sphere of 1
mm, 10000 kg/m^3, starts with 0.1 m/s on a plane that bears its weight, kn = kt = 1e4 N/m, no damping, friction 0.2 to 1; it rolls after 2
u/(7 mu g), with 5/7 of its speed; {STEPS // 10} steps per contact. (The results that MFIX keeps for its own tests miss that moment by 0.04
to 0.6 %.)""")
    bench.section.text(f"""05: aluminium oxide, 5 mm, 3.9 m/s, friction 0.092, e = 1, on glass (70 GPa, nu = 0.25); linear springs of 1.72e7
N/m along the normal and 1.48e7 N/m along the plane, or hertz/material. Where the sphere slides to the end, above {SLIDES:.0f} degrees
here, the answer depends on friction alone and is compared with what was measured; below, with linear springs, with the equations of the
law, integrated apart. Orders of the last rows: root mean square of the relative error of the height of the first bounce of case 01, e =
0.8, over 13 stiffnesses, that is moments of touching within a step. Order 2 is a word of [the integrator](../fix_nve_sphere_symplectic.md#order-2); its contact must
not pull (`limit_damping`), and ends earlier in the exact motion too. Case 06, the terminal velocity in a fluid, is an [example of
coupling](../coupling.md#order-and-cost). Input scripts: `validate/in.mfix_fall`, `validate/in.mfix_stack`, `validate/in.mfix_slip`; 05:
`tests/lib/impact_tables.py`.""")
    bench.section.plot("", "Left: heights of case 01, kn = 1e4 N/m, dots: exact. Middle: case 05, dots: measured. Right: errors of the "
                       "first bounce over the steps per contact, lines: slopes 1 and 2", lambda plt: draw(plt, shown, angles, errors))


def draw(plt, shown, angles, errors):
    import plot
    _, (left, middle, right) = plt.subplots(1, 3, figsize=(10, 3.3))
    for k, (e, (times, heights, exact)) in enumerate(shown.items()):
        left.plot(times, heights, **plot.style(k, marker=None), label=f"e = {e}")
        some = times[::max(1, len(times) // 20)]
        left.plot(some, [exact.height(t) for t in some], **plot.style(k, linestyle="none", markersize=3))
    left.set_xlabel("time, s")
    left.set_ylabel("height, m")
    left.legend()
    for k, (law, table) in enumerate(angles.items()):
        middle.plot(list(table), [e for e, _ in table.values()], **plot.style(k, marker=None), label=law)
    middle.plot(*zip(*MEASURED_E), **plot.style(0, linestyle="none"), label="measured")
    middle.set_xlabel("angle from the normal, degrees")
    middle.set_ylabel("tangential restitution")
    middle.legend()
    for k, (order, rows) in enumerate(errors.items()):
        n, error = zip(*rows)
        right.loglog(n, error, **plot.style(k, linestyle="none"), label=f"order {order}")
        right.loglog(n, [error[-1] * (n[-1] / each) ** order for each in n], **plot.style(k, marker=None))
    right.set_xlabel("steps per contact")
    right.set_ylabel("relative error of the height")
    right.legend()
