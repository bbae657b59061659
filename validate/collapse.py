# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Columns that collapse."""

import math
import os

import numpy

import problems

TITLE = "Collapse of a column"
QUESTION = """A column of grains of the radius r0 and height h0 = a r0 on a floor is set free at once. How far does it run out? Measured
with many materials, r/r0 - 1 = 1.24 a for a < 1.7, and 1.6 sqrt(a) above (Lube, Huppert, Sparks, Hallworth, J. Fluid Mech. 508, 175,
2004); Lajeunesse, Mangeney-Castelnau, Vilotte, Phys. Fluids 16, 2371, 2004, find a for a < 3 with glass beads on a rough floor."""

D = 0.002
RADIUS = 12.0                     # diameters
ASPECTS = (0.5, 1.0, 2.0, 4.0)
COVERED = 0.5                     # part of the floor that grains of the deposit cover


def run_out(path):
    """Radius up to which rings of one diameter are covered."""
    x, y, _, size = numpy.loadtxt(path, skiprows=9).T
    ring = (numpy.hypot(x, y) / D).astype(int)
    count = ring.max() + 1
    covered = numpy.bincount(ring, 0.25 * math.pi * size**2, count) / (math.pi * D**2 * (2 * numpy.arange(count) + 1))
    bare = numpy.flatnonzero(covered < COVERED)
    last = int(bare[0]) if len(bare) else count
    return D * (last if last == count else last + min(1.0, covered[last] / COVERED))


def collapse(bench, aspect, cores):
    """(aspect ratio of the settled column, run-out over radius)."""
    radius = bench.size(RADIUS, 6.0)
    time = 5.0 * math.sqrt((1.0 + aspect) * radius * D / 9.81)
    folder, result = problems.run(bench, "collapse", f"collapse-{aspect}", {"aspect": aspect, "radius": radius, "time": time}, cores)
    found = result.printed("Height")[0][0] / (radius * D), run_out(os.path.join(folder, "rest.txt")) / (radius * D) - 1.0
    bench.note(f"aspect ratio {found[0]:.2f}: run-out {found[1]:.2f}")
    return found


def lube(aspect):
    return 1.24 * aspect if aspect < 1.7 else 1.6 * math.sqrt(aspect)


def measure(bench):
    aspects = bench.size(ASPECTS, (1.0, 2.0))
    found = problems.at_once([lambda cores, a=a: collapse(bench, a, cores) for a in reversed(aspects)])[::-1]
    part = bench.size(0.2, 0.4)
    rows = []
    for aspect, out in found:
        bench.section.result(f"run-out at a = {aspect:.2f}", out, (1 - part) * min(lube(aspect), aspect if aspect < 3 else lube(aspect)),
                             (1 + part) * lube(aspect))
        rows.append([aspect, out, lube(aspect), aspect if aspect < 3 else float("nan")])
        bench.section.record(aspect=aspect, run_out=out, lube=lube(aspect))
    bench.section.table(["a", "r/r0 - 1", "Lube et al.", "Lajeunesse et al."], rows)
    bench.section.text(f"""Spheres of 2 mm +- 5 %, friction 0.5 among them and at the floor, rolling resistance 0.1 (`cdt capped`), column of
{bench.size(RADIUS, 6.0):.0f} diameters radius. The deposit ends where less than half of a ring of one diameter is covered. Bounds: 20 % below
the lower and above the higher of both measurements. Input script: `validate/in.collapse`.""")
    bench.section.plot("", "Run-out over the aspect ratio of the column", lambda plt: draw(plt, found))


def draw(plt, found):
    import plot
    _, axes = plt.subplots(figsize=(5, 3.5))
    line = numpy.linspace(0.1, 5, 100)
    axes.plot(*zip(*found), **plot.style(0, linestyle="none"), label="Talus")
    axes.plot(line, [lube(a) for a in line], **plot.style(0, marker=None), label="Lube et al. 2004")
    axes.plot(line[line < 3], line[line < 3], **plot.style(1, marker=None), label="Lajeunesse et al. 2004")
    axes.set_xlabel("height over radius")
    axes.set_ylabel("r/r0 - 1")
    axes.legend()
