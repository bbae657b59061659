# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Discharge of a bin through holes of several sizes."""

import math
import os

import numpy

import problems
import stl

TITLE = "Discharge of a bin"
QUESTION = """Grains run out of a flat-bottomed bin through a round hole of the diameter D at a rate that does not depend on what stands
above: W = C rho_b sqrt(g) (D - k d)^(5/2), with the bulk density rho_b and the diameter d of the grains (Beverloo, Leniger, van de
Velde, Chem. Eng. Sci. 15, 260, 1961: C = 0.58, k = 1.4). C is nearly the same for any material that was tested, while k varies by up to a
factor of 2 among grains (Madrid, Darias, Pugnaloni, Powders and Grains 2017, arXiv:1611.05277, after Nedderman, Statics and Kinematics
of Granular Materials, 1992): here C may be 10 % off 0.58, and k from 1 to 2."""

D, GRAVITY = 0.002, 9.81
OUTLETS = (6, 7, 8, 10, 12)      # in diameters
SEGMENTS = 96


def floor(path, outlet, radius):
    """A disc with a hole, at z = 0, as STL."""
    def ring(r, k):
        angle = 2 * math.pi * k / SEGMENTS
        return r * math.cos(angle), r * math.sin(angle), 0.0
    triangles = []
    for k in range(SEGMENTS):
        a, b, c, d = ring(outlet, k), ring(radius, k), ring(radius, k + 1), ring(outlet, k + 1)
        triangles += [(a, b, c), (a, c, d)]
    stl.write(path, "floor", triangles)


def discharge(bench, outlet, cores):
    """(rate in kg/s, bulk density)."""
    radius = bench.size(0.03, 0.02)
    mesh = bench.path(f"floor-{outlet}.stl")
    floor(mesh, 0.5 * outlet * D, 1.2 * radius)
    variables = {"outlet": outlet * D, "mesh": mesh, "radius": radius, "open": bench.size(0.1, 0.05), "watch": bench.size(0.4, 0.15)}
    folder, result = problems.run(bench, "discharge", f"outlet-{outlet}", variables, cores)
    time, rest = numpy.loadtxt(os.path.join(folder, "rest.txt")).T
    rate = -float(numpy.polyfit(time, rest, 1)[0])
    bench.note(f"hole of {outlet} diameters: {1e3 * rate:.1f} g/s")
    return rate, result.printed("Bulk")[0][0]


def measure(bench):
    outlets = bench.size(OUTLETS, (8, 10))
    found = problems.at_once([lambda cores, o=o: discharge(bench, o, cores) for o in outlets])
    bulk = sum(b for _, b in found) / len(found)
    scaled = [(rate / (bulk * math.sqrt(GRAVITY) * D**2.5)) ** 0.4 for rate, _ in found]     # C^(2/5) (D/d - k)
    slope, start = numpy.polyfit(outlets, scaled, 1)
    c, k = float(slope) ** 2.5, float(-start / slope)
    wide = bench.size(0.0, 0.5)
    bench.section.result("C", c, 0.9 * 0.58 - wide, 1.1 * 0.58 + wide)
    bench.section.result("k", k, 1.0 - 4 * wide, 2.0 + 4 * wide)
    worst = max(abs((slope * o + start) / s - 1) for o, s in zip(outlets, scaled))
    bench.section.result("largest distance of a rate from the line of power 5/2", 2.5 * float(worst), 0.0, 0.05)
    rows = [[o, 1e3 * rate, (s) ** 2.5, (slope * o + start) ** 2.5] for o, (rate, _), s in zip(outlets, found, scaled)]
    for row in rows:
        bench.section.record(outlet=row[0], rate_g_s=row[1], scaled=row[2], fitted=row[3])
    bench.section.table(["hole over grain", "rate, g/s", "W/(rho_b sqrt(g) d^(5/2))", "fitted"], rows)
    bench.section.text(f"""Spheres of 2 mm +- 5 % (glass density, hertz/material 1e7 Pa, e = 0.5, friction 0.5, no rolling resistance) in a bin of
30 mm radius, filled to 60 mm; bulk density {bulk:.0f} kg/m^3. The rate is that of 0.4 s, 0.1 s after the hole was opened. The walls
are said not to matter in a bin wider than 2.5 D and D + 30 d (Nedderman, after Mankoc et al., Granular Matter, 2007,
doi:10.1007/s10035-007-0062-2): this one is as wide as the former for the widest hole, and narrower than the latter. Input script:
`validate/in.discharge`; the floor is a mesh that `validate/discharge.py` writes.""")
    bench.section.plot("", "Rate to the power 2/5 over the diameter of the hole, and the line of Beverloo with C = 0.58, k = 1.4",
                       lambda plt: draw(plt, outlets, scaled, slope, start))


def draw(plt, outlets, scaled, slope, start):
    import plot
    _, axes = plt.subplots(figsize=(5, 3.5))
    line = numpy.linspace(0, max(outlets) + 1, 50)
    axes.plot(outlets, scaled, **plot.style(0, linestyle="none"), label="Talus")
    axes.plot(line, numpy.maximum(0, slope * line + start), **plot.style(0, marker=None), label="fitted")
    axes.plot(line, numpy.maximum(0, 0.58**0.4 * (line - 1.4)), **plot.style(1, marker=None), label="Beverloo 1961")
    axes.set_xlabel("hole over grain")
    axes.set_ylabel("(W/(rho_b sqrt(g) d^2.5))^0.4")
    axes.legend()
