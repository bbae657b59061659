# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Heaps over rolling resistance."""

import math
import os
import statistics

import numpy

import problems
import report

TITLE = "Angle of repose"
QUESTION = """Spheres make flatter heaps than grains of other shapes; rolling resistance makes up for that. The angle of repose rises
with the coefficients of rolling and of sliding friction, and is not so sensitive to density, damping and Young's modulus (Zhou, Xu, Yu,
Zulli, Phys. Rev. E 64, 021301, 2001). That paper's heaps are made in a container whose thickness matters, which these are not: its
conclusions are compared, not its angles. Without rolling resistance the slope should be between the friction angles at the critical
state and at the peak of spheres with the same friction, which [triaxial compression](triaxial.md) tells."""

ROLLING = (0.0, 0.02, 0.05, 0.1, 0.2)
BY_CDT = (0.05, 0.2)
BASE = 0.05                    # coefficient at which other numbers are changed
SMOOTHER = "friction 0.3 for 0.5"
SEEDS = (1, 2, 3)
RADIUS = 10.0
LIFT = 0.15                    # speed of the pipe over sqrt(g d)
FIT = 0.2, 0.85                # of the radius: the peak is round, and grains at the rim fall off
CRITICAL, PEAK, SPARE = 19.4, 25.7, 1.0     # degrees: friction angles of validate/triaxial.py, and what the bounds leave
SAME = 1.5                     # degrees
CREEP = """ `cdt` is shown and
not compared: it has no spring that holds a grain at rest, some still move at the end, and the steepest heap is flatter than that of
`sds`."""
OTHERS = {"stiffness times 4": {"stiffness": 2e4, "damping": 45.2}, "restitution 0.3 for 0.7": {"damping": 71.6},
          "half the speed of the pipe": {"lift": 0.5 * LIFT}}


def surface(path, radius, points=3):
    """(distances from the axis, heights) of the upper side of the heap, on a grid of so many points per diameter."""
    x, y, z, size = numpy.loadtxt(path, skiprows=9).T
    line = (numpy.arange(2 * points * math.ceil(radius)) + 0.5) / points - math.ceil(radius)
    heights = numpy.zeros((len(line), len(line)))
    for k, px in enumerate(line):
        left = 0.25 * size**2 - (x - px) ** 2 - (line[:, None] - y) ** 2
        heights[k] = numpy.where(left > 0, z + numpy.sqrt(numpy.maximum(left, 0.0)), 0.0).max(axis=1)
    return numpy.hypot(line[:, None], line).ravel(), heights.ravel()


def slope(distances, heights, radius):
    """Degrees: of a cone through the surface by least squares."""
    inner = (distances > FIT[0] * radius) & (distances < FIT[1] * radius)
    return math.degrees(math.atan(-numpy.polyfit(distances[inner], heights[inner], 1)[0]))


def profile(distances, heights, radius):
    """Mean heights in rings of one diameter."""
    return [float(heights[distances.astype(int) == k].mean()) for k in range(int(radius))]


def heap(bench, variables, seed, cores):
    """(angle, profile, kinetic energy per grain at the end)."""
    radius = bench.size(RADIUS, 7.0)
    case = "-".join(map(str, [*variables.values(), seed]))
    folder, result = problems.run(bench, "repose", f"heap-{case}", {**variables, "radius": radius, "seed": seed,
        "lift": bench.size(variables.get("lift", LIFT), 2 * LIFT), "rest": bench.size(60, 30)}, cores)
    distances, heights = surface(os.path.join(folder, "heap.txt"), radius)
    angle = slope(distances, heights, radius)
    energy, count = result.printed("Rest")[0]
    bench.note(f"{variables}, seed {seed}: {angle:.1f} degrees, {count:.0f} grains stay, kinetic energy {energy:.1e}")
    return angle, profile(distances, heights, radius), energy / count


def cases(bench):
    """{name: variables}."""
    found = {("sds", mu): {"rolling": mu, "law": "sds"} for mu in bench.size(ROLLING, (0.0, 0.2))}
    if not bench.quick:
        found.update({("cdt", mu): {"rolling": mu, "law": "cdt"} for mu in BY_CDT})
        found.update({(name, BASE): {"rolling": BASE, "law": "sds", **other} for name, other in OTHERS.items()})
        found[SMOOTHER, BASE] = {"rolling": BASE, "law": "sds", "friction": 0.3}
    return found


def runs(bench):
    """{name: [(angle, profile, energy) of each seed]}."""
    todo = [(name, variables, seed) for name, variables in cases(bench).items() for seed in bench.size(SEEDS, (1,))]
    found = problems.at_once([lambda cores, v=v, s=s: heap(bench, v, s, cores) for _, v, s in todo])
    heaps = {}
    for (name, _, seed), one in zip(todo, found):
        heaps.setdefault(name, []).append(one)
        bench.section.record(case=name[0], rolling=name[1], seed=seed, angle=one[0])
    return heaps


def summary(heaps, name):
    """Mean angle and its standard deviation over seeds."""
    angles = [angle for angle, *_ in heaps[name]]
    return statistics.mean(angles), statistics.stdev(angles) if len(angles) > 1 else math.nan


def compare(bench, heaps):
    by_sds = [summary(heaps, name) for name in heaps if name[0] == "sds"]
    low, high = bench.size((CRITICAL - SPARE, PEAK + SPARE), (15.0, 35.0))
    bench.section.result("angle without rolling resistance", by_sds[0][0], low, high, "degrees", scatter=by_sds[0][1])
    bench.section.result("least rise of the angle from one coefficient to the next", min(b[0] - a[0] for a, b in zip(by_sds, by_sds[1:])),
                         0.0, 20.0, "degrees")
    for name in heaps:
        if name[0] in ("sds", "cdt"):
            continue
        one, other = summary(heaps, name), summary(heaps, ("sds", name[1]))
        low, high = (-20.0, 0.0) if name[0] == SMOOTHER else (-SAME, SAME)
        bench.section.result(f"change of the angle by {name[0]}, coefficient {name[1]}", one[0] - other[0], low, high, "degrees",
                             scatter=math.hypot(one[1], other[1]))


def measure(bench):
    heaps = runs(bench)
    compare(bench, heaps)
    rows = []
    for name in heaps:
        mean, scatter = summary(heaps, name)
        law = name[0] if name[0] in ("sds", "cdt") else f"sds, {name[0]}"
        rows.append([law, name[1], mean, scatter, max(energy for *_, energy in heaps[name])])
    bench.section.table(["law", "coefficient", "angle, degrees", "deviation over seeds", "kinetic energy, m g d"], rows)
    cdt = "" if bench.quick else CREEP
    bench.section.text(f"""Spheres of one diameter +- 10 %, friction 0.5, linear springs of 5e3 m g/d, e = 0.7, fill a pipe of
{bench.size(RADIUS, 7.0):.0f} diameters radius that stands on a rough plate of the same radius, fixed spheres at random places. It is
lifted at {bench.size(LIFT, 2 * LIFT)} sqrt(g d): what does not stay on the plate falls off its rim. The angle is that of a cone through
the upper side of the heap between {FIT[0]} and {FIT[1]} of the radius, by least squares; {len(bench.size(SEEDS, (1,)))} packings
(deviations are those of one heap). Rolling: `sds` with the tangential stiffness 2/7 kn and 0.3 of critical damping, and `cdt ... capped`;
both limit the torque to mu_r F_n R_1 R_2/(R_1 + R_2). The kinetic energy is that per grain {bench.size(60, 30)} times sqrt(d/g) after
the pipe is off, the largest of the packings (a grain that is falling beside the plate counts). Fourfold stiffness is a quarter of the
density as well: what counts is their ratio. Friction angles of spheres with that friction are {CRITICAL} degrees at the
critical state and {PEAK} at the peak, from which the slope without rolling resistance is {summary(heaps, ("sds", 0.0))[0] - PEAK:+.1f}
degrees away; the bounds leave {SPARE:.0f} degree to spare. A change of less than {report.number(SAME)}
degrees is called none.{cdt} Input script: `validate/in.repose`.""")
    bench.section.plot("", "Angle of repose over the coefficient of rolling resistance, means of packings with their standard deviation "
                       "(left), and mean height of the heaps over the distance from the axis (right)", lambda plt: draw(plt, heaps))


def draw(plt, heaps):
    import plot
    _, (left, right) = plt.subplots(1, 2, figsize=(8, 3.5))
    for k, law in enumerate(("sds", "cdt")):
        names = [name for name in heaps if name[0] == law]
        if names:
            found = numpy.array([summary(heaps, name) for name in names])
            look = {} if law == "sds" else {"linestyle": "none", "markerfacecolor": "none", "markersize": 8}
            left.errorbar([mu for _, mu in names], found[:, 0], None if numpy.isnan(found).any() else found[:, 1], capsize=3,
                          **plot.style(k, **look), label=law)
    left.set_xlabel("coefficient of rolling resistance")
    left.set_ylabel("angle of repose, degrees")
    left.legend()
    for k, name in enumerate(name for name in heaps if name[0] == "sds"):
        mean = numpy.mean([heights for _, heights, _ in heaps[name]], axis=0)
        right.plot(numpy.arange(len(mean)) + 0.5, mean, **plot.style(k), label=f"mu_r = {name[1]}")
    right.set_xlabel("distance from the axis, d")
    right.set_ylabel("height, d")
    right.legend()
