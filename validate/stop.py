# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""The slope on which a layer stops over its thickness."""

import math
import statistics

import numpy

import problems

TITLE = "Where a flow stops"
QUESTION = """A layer that flows down a rough plane stops when the slope is lowered: the thinner it is the steeper is the plane on which
it stops. The thickness that stays on a slope theta is described by h_stop(theta) = A d (tan(theta_2) - tan(theta))/(tan(theta) -
tan(theta_1)): no layer, however thick, flows below theta_1, and none, however thin, stays above theta_2 (Pouliquen, Phys. Fluids 11, 542,
1999; Pouliquen, Forterre, J. Fluid Mech. 453, 133, 2002). For glass beads tan(theta_1) = 0.382 and tan(theta_2) = 0.643 (Jop, Forterre,
Pouliquen, Nature 441, 727, 2006)."""

LAYERS = {3: 26.5, 4: 25.5, 5: 24.5, 7: 23.0, 10: 21.8, 15: 21.0}     # height filled in, diameters: slope at the beginning, degrees
LOWERED = 0.04           # degrees per unit of time times the height: a thicker layer takes longer to follow
CHECKED = 10, 1          # height and seed of the layer that is also lowered half as fast
GLASS = 0.382, 0.643     # tangents of the two limits


def layer(bench, height, seed, cores, slower=1):
    """(thickness at rest, tangent of the slope on which it stopped)."""
    rate = LOWERED / height * bench.size(1, 4) / slower
    variables = {"height": height, "length": bench.size(20, 10), "from": LAYERS[height], "rate": rate, "seed": seed,
                 "flow": bench.size(60, 20)}
    _, result = problems.run(bench, "stop", f"layer-{height}-{seed}-{slower}", variables, cores)
    slope, thickness, speed = result.printed("Stopped")[0]
    bench.note(f"thickness {thickness:.2f}: stopped at {slope:.2f} degrees")
    return thickness, math.tan(math.radians(slope)) if speed < 1e-3 else math.nan


def fitted(points):
    """(A, tan(theta_1), tan(theta_2)) of least squares of the tangents: tan(theta) = (h tan(theta_1) + A tan(theta_2))/(h + A)."""
    thickness, tangent = numpy.array(points).T
    best = None
    for a in numpy.arange(0.1, 20, 0.02):
        share = thickness / (thickness + a)
        ends, rest, *_ = numpy.linalg.lstsq(numpy.column_stack((share, 1 - share)), tangent, rcond=None)
        if best is None or rest[0] < best[0]:
            best = rest[0], a, *ends
    return best[1:]


def slope_of(thickness, fit):
    a, low, high = fit
    return math.degrees(math.atan((thickness * low + a * high) / (thickness + a)))


def exponential(points):
    """tan(theta_1) of the older form, tan(theta) = tan(theta_1) + (tan(theta_2) - tan(theta_1)) exp(-h/A)."""
    thickness, tangent = numpy.array(points).T
    fits = []
    for a in numpy.arange(0.5, 30, 0.05):
        share = numpy.exp(-thickness / a)
        ends, rest, *_ = numpy.linalg.lstsq(numpy.column_stack((1 - share, share)), tangent, rcond=None)
        fits.append((rest[0], ends[0]))
    return min(fits)[1]


def compare(bench, jobs, points, slopes, slow):
    """Rows of the complete run; returns the fit."""
    fit = fitted(points)
    apart = [s - slope_of(h, fit) for (h, _), s in zip(points, slopes)]
    bench.section.result("root mean square distance of the slopes from the fitted curve", math.sqrt(statistics.fmean(a * a for a in apart)),
                         0.0, 0.5, "degrees")
    thickest = [math.tan(math.radians(s)) for (h, _), s in zip(jobs, slopes) if h == max(LAYERS)]
    bench.section.result("tan(slope) of the thickest layers over tan(theta_1) of glass beads", statistics.fmean(thickest) / GLASS[0],
                         0.9, 1.1)
    steeper = math.degrees(math.atan(slow[1])) - slopes[jobs.index(CHECKED)]
    bench.section.result(f"{CHECKED[0]} d, lowered half as fast: stops on a slope that is steeper by", steeper, -0.5, 0.5, "degrees")
    low, high, other = (math.degrees(math.atan(tangent)) for tangent in (*fit[1:], exponential(points)))
    scatter = max(abs(a - b) for a, b in zip(slopes[::2], slopes[1::2]))
    shares = [found / measured for found, measured in zip(fit[1:], GLASS)]
    bench.section.text(f"""Fitted: A = {fit[0]:.2f}, theta_1 = {low:.1f}, theta_2 = {high:.1f} degrees, whose tangents are {shares[0]:.2f}
and {shares[1]:.2f} of those of glass beads. Both are extrapolated, theta_1 to thick layers: an exponential in place of the fraction
(Pouliquen 1999) gives theta_1 = {other:.1f} degrees from the same layers. They are therefore not compared within bounds. No layer is
farther than {max(map(abs, apart)):.2f} degrees from the curve; two of one height differ by up to {scatter:.2f}.""")
    return fit


def measure(bench):
    jobs = [(height, seed) for height in bench.size(tuple(LAYERS), (3, 10)) for seed in bench.size((1, 2), (1,))]
    tasks = [lambda cores, j=j: layer(bench, *j, cores) for j in jobs]
    if not bench.quick:
        tasks.append(lambda cores: layer(bench, *CHECKED, cores, slower=2))
    *points, slow = problems.at_once(tasks) + ([None] if bench.quick else [])
    slopes = [math.degrees(math.atan(t)) for _, t in points]
    thin, thick = (statistics.fmean(s for (h, _), s in zip(jobs, slopes) if h == end) for end in (jobs[0][0], jobs[-1][0]))
    bench.section.result("the thinnest layer stops on a slope that is steeper than that of the thickest by", thin - thick,
                         bench.size(3.0, 1.0), 10.0, "degrees")
    bench.section.text(f"""Spheres and base of [the flow down an incline](chute.md), here {bench.size(20, 10)} diameters long and 10 wide,
periodic. A layer flows for {bench.size(60, 20)} sqrt(d/g) on a slope that is above the one on which it stops; then the slope is lowered
by {LOWERED * bench.size(1, 4)}/h degrees in each sqrt(d/g), h: the height in diameters, as a thicker layer takes longer to follow. It has
stopped when its mean speed is below 0.001 sqrt(g d); the thickness then is twice the height of its center of mass over the base. Compared
are the form of the curve, which is fitted with its three numbers, and the slope of the thickest layers, near theta_1, with theta_1 of
glass beads, to which these spheres are close, not equal. Input script: `validate/in.stop`.""")
    fit = None if bench.quick else compare(bench, jobs, points, slopes, slow)
    rows = [[height, seed, h, s, slope_of(h, fit) if fit else "-"] for (height, seed), (h, _), s in zip(jobs, points, slopes)]
    for row in rows:
        bench.section.record(height=row[0], seed=row[1], thickness=row[2], slope=row[3])
    bench.section.table(["filled in, d", "beginning", "thickness, d", "stopped at, degrees", "fitted"], rows)
    if fit:
        bench.section.plot("", "Thickness of a layer over the slope on which it stopped; line: fitted",
                           lambda plt: draw(plt, points, slopes, fit))


def draw(plt, points, slopes, fit):
    import plot
    _, axes = plt.subplots(figsize=(5, 3.5))
    thickness = [h for h, _ in points]
    line = [1.5 + 0.1 * k for k in range(int(10 * max(thickness)))]
    axes.plot(slopes, thickness, **plot.style(0, linestyle="none"), label="Talus")
    axes.plot([slope_of(h, fit) for h in line], line, **plot.style(0, marker=None), label="fitted")
    axes.axvline(math.degrees(math.atan(fit[1])), color="0.6", linestyle=":", label="theta_1")
    axes.set_ylim(0, 1.1 * max(thickness))
    axes.set_xlabel("slope, degrees")
    axes.set_ylabel("thickness, d")
    axes.legend()
