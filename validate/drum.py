# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""A measured drum."""

import dataclasses
import math
import os
import statistics

import numpy

import machine
import paired
import problems
import turned_mesh
from lammps import LIGGGHTS, TALUS

TITLE = "A rotating drum"
QUESTION = """A drum of 42 mm inner radius and 20 mm length between flat ends, half full of nearly round grains of microcrystalline cellulose
(29 185 of them, 1.05 to 1.5 mm), turns about its horizontal axis at 10 to 45 turns per minute. Photographs along the axis, averaged
over time, are published with sizes and density of the grains, and with values of a contact law that were calibrated to them with
LIGGGHTS (data set of the GranuDrum calibration of ACCES, Positron Imaging Centre, University of Birmingham). Do these values, in
the law as it is there, give the measured surfaces in Talus?"""

RADIUS = 42.0                   # mm
PLACES = (-18, -12, -6, 0, 6, 12, 18)
# rpm: slope within 10 mm of the axis, slope of the whole line (degrees), heights (mm) at these places
MEASURED = {
    10: (37.9, 36.9, (16.1, 10.8, 5.7, 0.9, -3.4, -7.9, -11.7)),
    15: (41.1, 39.0, (17.3, 11.7, 5.7, 0.3, -4.7, -9.0, -13.0)),
    30: (49.5, 44.9, (21.1, 14.6, 6.9, -0.3, -7.2, -12.3, -15.9)),
    45: (55.5, 49.8, (24.8, 18.3, 9.9, 0.1, -8.4, -13.9, -17.9)),
}
# of LIGGGHTS with the calibrated values, published with the data
PUBLISHED = {15: (41.5, 40.1), 45: (54.9, 50.0)}
GRAIN = "hertz/material 5e6 0.3 0.3 tangential multistep NULL NULL 0.5613 stock"
LAWS = {
    "cdt": f"{GRAIN} rolling cdt 0.2931",
    "cdt capped": f"{GRAIN} rolling cdt 0.2931 capped",
    "epsd2": f"{GRAIN} rolling epsd2 0.2931",
    "sds": f"{GRAIN} rolling sds 150 0 0.2931",
}
SEEDS = (4711, 1234, 98765)
TURN = 75.0                     # degrees that the drum turns at least before the flow is looked at
PIXEL = 0.25                    # mm
SLOPE_BOUND, HEIGHT_BOUND = 2.0, 2.0        # degrees, mm


def read_states(path):
    """Rows (x, z, diameter) in mm of all states, and how many states there are."""
    rows, states = [], 0
    with open(path) as file:
        for line in file:
            if line.startswith("ITEM"):
                states += line.startswith("ITEM: ATOMS")
                numbers = 1 if line.startswith(("ITEM: TIMESTEP", "ITEM: NUMBER")) else 3 if line.startswith("ITEM: BOX") else 0
                for _ in range(numbers):
                    next(file)
            else:
                rows.append(line)
    return 1e3 * numpy.loadtxt(rows), states


def image(rows, states):
    """Mean number of grains over each pixel, seen along the axis."""
    count = int(round(2 * RADIUS / PIXEL)) + 8
    edges = (numpy.arange(count + 1) - count / 2) * PIXEL
    middle = (numpy.arange(count) - count // 2) * PIXEL
    total = numpy.zeros((count, count))
    for size in numpy.unique(rows[:, 2]):
        of_size = rows[rows[:, 2] == size]
        places = numpy.histogram2d(of_size[:, 0], of_size[:, 1], bins=(edges, edges))[0]
        disc = middle[:, None] ** 2 + middle[None, :] ** 2 < (0.5 * size) ** 2
        shape = numpy.fft.rfft2(places) * numpy.fft.rfft2(numpy.fft.ifftshift(disc.astype(float)))
        total += numpy.fft.irfft2(shape, places.shape)
    return 0.5 * (edges[1:] + edges[:-1]), total / states


@dataclasses.dataclass
class Surface:
    """x, z: its line (mm); slopes: within 10 mm of the axis and of the whole line (degrees); area (mm^2) of what is filled."""
    x: list
    z: list
    area: float

    def slope(self, reach):
        near = [(x, z) for x, z in zip(self.x, self.z) if abs(x) <= reach]
        return -math.degrees(math.atan(numpy.polyfit(*zip(*near), 1)[0]))

    def heights(self):
        return [float(numpy.interp(x, self.x, self.z)) for x in PLACES]


def surface(axis, grains):
    """As the photographs were treated: binary at 10/255 of the largest value, cut to r^2 < 0.6 R^2, highest pixel of each column."""
    filled = grains > 10.0 / 255.0 * grains.max()
    inside = axis[:, None] ** 2 + axis[None, :] ** 2 < 0.6 * RADIUS**2
    x, z = [], []
    for k, place in enumerate(axis):
        column = numpy.flatnonzero(filled[k] & inside[k])
        if len(column) and inside[k][column[-1] + 1]:      # not the rim
            x.append(float(place))
            z.append(float(axis[column[-1]]) + 0.5 * PIXEL)
    return Surface(x, z, float((filled & inside).sum()) * PIXEL**2)


def scale(bench):
    return bench.size(1.0, 0.25)


def case_name(law, rpm, seed):
    return f"{law.replace(' ', '-')}-{rpm}-{seed}"


def drum(bench, law, rpm, seed, cores):
    case = case_name(law, rpm, seed)
    spin = max(0.6, TURN / (6.0 * rpm))
    variables = {"rpm": rpm, "law": LAWS[law], "seed": seed, "scale": scale(bench), "periodic": bench.size(0, 1), "spin": bench.size(spin, 0.5),
                 "watch": bench.size(0.5, 0.2), "states": bench.size(100, 30)}
    folder, result = problems.run(bench, "drum", case, variables, cores)
    states = os.path.join(folder, "states.txt")
    found = surface(*image(*read_states(states)))
    os.remove(states)
    loop = result.loops()[-1]
    bench.note(f"{law}, {rpm} turns per minute, seed {seed}: slope {found.slope(10.0):.1f}, {loop.nanoseconds():.0f} ns per grain and step")
    return found, loop.nanoseconds()


def cases(bench):
    """(law, rpm, seed)."""
    if bench.quick:
        return [("cdt", 45, SEEDS[0])]
    wanted = [("cdt", rpm, SEEDS[0]) for rpm in (45, 30, 15, 10)]
    wanted += [(law, 45, SEEDS[0]) for law in LAWS if law != "cdt"] + [("sds", 15, SEEDS[0])]
    wanted += [("cdt", 45, seed) for seed in SEEDS[1:]]
    return [case for case in wanted if bench.wants(case[0])]


def difference(found, measured):
    """Mean distance of the heights (mm), and how much higher they are in the mean."""
    apart = [a - b for a, b in zip(found.heights(), measured[2])]
    return statistics.fmean(map(abs, apart)), statistics.fmean(apart)


def measure(bench):
    wanted = cases(bench)
    done = dict(zip(wanted, problems.at_once([lambda cores, c=case: drum(bench, *c, cores) for case in wanted])))
    rows = []
    for (law, rpm, seed), (found, ns) in done.items():
        measured = MEASURED[rpm]
        apart, higher = difference(found, measured)
        rows.append([law, rpm, seed, found.slope(10.0), measured[0], found.slope(RADIUS), measured[1], apart, higher, found.area, ns])
        for x, z in zip(found.x, found.z):
            bench.section.record(law=law, rpm=rpm, seed=seed, x=x, z=round(z, 4))
        if law == "cdt" and seed == SEEDS[0]:
            bound = bench.size(1.0, 6.0)      # a slice without ends, as in quick runs, is 9 degrees flatter
            bench.section.result(f"slope within 10 mm of the axis, {rpm} turns per minute", found.slope(10.0),
                                 measured[0] - bound * SLOPE_BOUND, measured[0] + bound * SLOPE_BOUND, "degrees", scatter(done, rpm))
            bench.section.result(f"mean distance from the measured line, {rpm} turns per minute", apart, 0.0, bound * HEIGHT_BOUND, "mm")
    bench.section.table(["rolling resistance", "turns per minute", "seed", "slope near the axis", "measured", "of the whole line", "measured",
                         "mean distance, mm", "higher by, mm", "area, mm^2", "ns per grain and step"], rows)
    words(bench)
    beside_liggghts(bench, *wanted[0])
    bench.section.plot("", "Surfaces: lines of Talus with rolling cdt; points were measured", lambda plt: draw(plt, done))


def scatter(done, rpm):
    """Standard deviation of the slope over seeds."""
    slopes = [found.slope(10.0) for (law, speed, _), (found, _) in done.items() if law == "cdt" and speed == rpm]
    return statistics.stdev(slopes) if len(slopes) > 1 else float("nan")


def beside_liggghts(bench, law, rpm, seed):
    if not machine.LIGGGHTS:
        bench.section.text("LIGGGHTS is not installed: nothing is compared with it.")
        return
    folder = bench.path(case_name(law, rpm, seed))
    length = 0.02 * scale(bench)
    series = turned_mesh.compare(folder, os.path.join(folder, "settled.txt"), 1e-3 * RADIUS, 0.5 * length, rpm, bench.rounds)
    bench.section.text(f"""Beside LIGGGHTS {machine.liggghts_version()} of Debian, the drum a mesh of {4 * turned_mesh.SEGMENTS} triangles, the same law
(`rolling cdt`), skin and time step, one core: {series[TALUS].median:.0f} ns per grain and step, LIGGGHTS {series[LIGGGHTS].median:.0f}; ratio
{paired.ratio(series[LIGGGHTS], series[TALUS])} over {bench.rounds} rounds.""")


def words(bench):
    published = ", ".join(f"{near} and {whole} at {rpm}" for rpm, (near, whole) in PUBLISHED.items())
    bench.section.text(f"""The law is that of the calibration: Hertz with E = 5e6 Pa, nu = 0.3, e = 0.3, friction 0.5613 with history, rolling
resistance `cdt` of 0.2931, for grains and drum alike, time step 1e-5 s ([from LIGGGHTS](../from_liggghts.md) has the words). The drum is an
exact cylinder. Input script: `validate/in.drum`. A surface is found as from the photographs: the mean number of grains over each
pixel in 100 states of half a second, filled where it is more than 10/255 of its largest value, cut to r^2 < 0.6 R^2, highest pixel of
each column. Slopes published for LIGGGHTS with these values, near the axis and of the whole line: {published} turns per minute.
`sds` has a spring
of 150 N/m. Friction at the two ends makes the drum steep: a slice
without ends (`-var periodic 1`) has 46 degrees at 45 turns per minute. `cdt` fits best of these laws, with the coefficient that was fitted to it; without its trembling (`capped`) the slope is a degree
less, the two laws with a spring lie a millimetre too high.""")


def draw(plt, done):
    import plot
    _, axes = plt.subplots(figsize=(6, 5))
    for k, rpm in enumerate(MEASURED):
        for (law, speed, seed), (found, _) in done.items():
            if law == "cdt" and speed == rpm and seed == SEEDS[0]:
                axes.plot(found.x, found.z, **plot.style(k, marker=None), label=f"{rpm} turns per minute")
        axes.plot(PLACES, MEASURED[rpm][2], **plot.style(k, linestyle="none"))
    axes.set_aspect("equal")
    axes.set_xlabel("x, mm")
    axes.set_ylabel("z, mm")
    axes.legend()
