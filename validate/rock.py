# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Bonded spheres as a rock: elasticity and stresses of a disk, strength of a cylinder, against theory and other codes."""

import math
import os
import statistics

import numpy

import problems

TITLE = "Bonded rock"
QUESTION = """A triangular lattice of springs kn, ks is an isotropic plate with E = 2 sqrt(3) kn (kn + ks)/(3 kn + ks) and Poisson's ratio
(kn - ks)/(3 kn + ks). In a disk that is pressed at two poles (Brazilian test) stresses do not depend on either; those of point loads are
known in closed form (Hertz 1883; Timoshenko, Goodier, Theory of Elasticity, 1951, section 37), and a loaded arc is a sum of them.

A random packing with bonds is softer than with the strain of its envelope in all bonds (Voigt), and stiffer than by the static hypothesis
(Chang, Liao, Appl. Mech. Rev. 47, S197, 1994). Its compressive strength is a few times that in tension, less than that of rock: about
4.5 in two and 7 in three dimensions for a granite with Brazilian tests (Potyondy, Cundall, Int. J. Rock Mech. Min. Sci. 41, 1329, 2004)."""

KN, SHEAR = 1e4, 0.3                              # of the lattice
YOUNG, POISSON, RADIUS = 1e4, 0.25, 0.5           # of the beams of the cylinder
STEP, STRAIN = 6e-4, {-1: 0.012, 1: 0.004}        # of time; at the end, pressed and pulled
SEEDS = (1, 2, 3)
DISK, CYLINDER = "disk", "cylinder"


def entries(path):
    """Rows of the last frame of a dump."""
    with open(path) as file:
        for line in file:
            if line.startswith("ITEM: NUMBER"):
                count = int(next(file))
            elif line.startswith(("ITEM: ENTRIES", "ITEM: ATOMS")):
                rows = numpy.array([next(file).split() for _ in range(count)], dtype=float)
    return rows


# ---- the disk -----------------------------------------------------------------------------------

def point_loads(x, y, radius):
    """xx, yy and xy of the stress in a disk of thickness 1 that two forces of 1 press at (0, radius) and (0, -radius)."""
    above, below = radius - y, radius + y
    r1, r2 = (x**2 + above**2)**2, (x**2 + below**2)**2
    factor = -2 / math.pi
    return (factor * (above * x**2 / r1 + below * x**2 / r2 - 0.5 / radius), factor * (above**3 / r1 + below**3 / r2 - 0.5 / radius),
            -factor * (above**2 * x / r1 - below**2 * x / r2))


def arcs(x, y, radius, angles):
    """The same with forces of 1 along diameters at these angles to y."""
    total = numpy.zeros((2, len(x)))
    for angle in angles:
        c, s = math.cos(angle), math.sin(angle)
        xx, yy, xy = point_loads(c * x - s * y, s * x + c * y, radius)
        total += c * c * xx + s * s * yy + 2 * c * s * xy, s * s * xx + c * c * yy - 2 * c * s * xy
    return total


def disk(bench, cores):
    folder, _ = problems.run(bench, "rock_disk", DISK, {"radius": bench.size(30, 20), "shear": SHEAR}, cores)
    x, y, ux, uy, sxx, syy, loaded = entries(os.path.join(folder, "rock.dump")).T[1:]
    x, y = x - ux, y - uy
    area = math.sqrt(3) / 2
    radius = math.sqrt(len(x) * area / math.pi)
    found = numpy.array((sxx, syy)) / area
    found *= -numpy.sign(found[1][numpy.argmin(numpy.hypot(x, y))])     # LAMMPS 4 Jul 2026 tells stresses of bonds with the other sign
    poles = (loaded > 0) & (y > 0)
    angles = numpy.arctan2(x[poles], y[poles])
    expected = arcs(x, y, radius, angles)
    force = float(numpy.cos(angles).sum())
    scale = 2 * force / (math.pi * 2 * radius)
    inner = numpy.hypot(x, y) < 0.25 * radius
    bound = bench.size(0.02, 0.04)
    for name, k in (("tension across", 0), ("compression along", 1)):
        ratio = float(found[k][inner].mean() / expected[k][inner].mean())
        bench.section.result(f"{name} the loaded diameter at the center, over that of theory", ratio, 1 - bound, 1 + bound)
    line = (numpy.abs(y) < 0.3) & (numpy.abs(x) < 0.9 * radius)
    worst = float(numpy.abs(found[:, line] - expected[:, line]).max() / scale)
    bench.section.result("largest error on the other diameter, of 2 P/(pi D)", worst, 0, bench.size(0.03, 0.06))
    ends = numpy.abs(y) < 0.3
    widening = float(ux[ends][numpy.argmax(x[ends])] - ux[ends][numpy.argmin(x[ends])])
    young, poisson = lattice()
    expected_widening = force / young * (4 / math.pi - 1 + poisson)
    bench.section.result("widening of the disk, over P (4/pi - 1 + nu)/E", widening / expected_widening, 1 - bound, 1 + bound)
    for k in numpy.flatnonzero(line):
        bench.section.record(part=DISK, x=x[k] / radius, across=found[0][k] / scale, along=found[1][k] / scale,
                             across_theory=expected[0][k] / scale, along_theory=expected[1][k] / scale)
    return len(x), x[line] / radius, found[:, line] / scale, expected[:, line] / scale


def lattice():
    """Young's modulus by thickness 1, Poisson's ratio."""
    ks = SHEAR * KN
    return 2 * math.sqrt(3) * KN * (KN + ks) / (3 * KN + ks), (KN - ks) / (3 * KN + ks)


# ---- the cylinder -------------------------------------------------------------------------------

def stiffness():
    """Of a beam, times its length: in tension, in shear."""
    area, inertia, shear = math.pi * RADIUS**2, math.pi * RADIUS**4 / 4, YOUNG / (2 * (1 + POISSON))
    slender = 12 * YOUNG * inertia
    return YOUNG * area, slender / (1 + slender / (0.9 * shear * area))


def voigt(places, bonds, volume):
    """Young's modulus along z if all bonds had the strain of the envelope and spheres did not turn."""
    d = places[bonds[:, 1]] - places[bonds[:, 0]]
    length = numpy.linalg.norm(d, axis=1)
    total = numpy.zeros((6, 6))
    kn, ks = stiffness()
    for (a, b, c), one in zip(d / length[:, None], length):
        normal = numpy.array((a * a, b * b, c * c, b * c, a * c, a * b))
        whole = numpy.array(((a, 0, 0, 0, c / 2, b / 2), (0, b, 0, c / 2, 0, a / 2), (0, 0, c, b / 2, a / 2, 0)))
        across = whole - numpy.outer((a, b, c), normal)
        total += one * (kn * numpy.outer(normal, normal) + ks * across.T @ across)    # one^2 times stiffness over length
    return float(1 / numpy.linalg.inv(total / volume)[2, 2])


class Test:
    """strength: peak of the stress; young: modulus; voigt: its bound; curve: (strain in %, stress). sign: 1 pulls, -1 presses."""

    def __init__(self, bench, sign, seed, cores):
        rate = sign * bench.size(4e-4, 1e-3)
        self.radius = bench.size(5.0, 3.5)
        folder, result = problems.run(bench, "rock", f"{CYLINDER}-{sign}-{seed}",
                                      {"radius": self.radius, "rate": rate, "strain": STRAIN[sign], "step": STEP, "seed": seed}, cores)
        self.count, bonds, height = result.printed("Rock")[0]
        area = math.pi * self.radius**2
        places, gauge = self._gauge(folder)
        ends = entries(os.path.join(folder, "bonds.dump")).astype(int)
        self.voigt = voigt(places, ends, area * height)
        (pressure,) = result.printed("Elastic")[0]
        self.young = -pressure / gauge
        rows = numpy.loadtxt(os.path.join(folder, "stress.txt"))
        self.curve = [(100 * abs(rate) * STEP * step, -sign * pressure) for step, pressure, _ in rows]
        self.strength = max(stress for _, stress in self.curve)
        bench.note(f"{'pulled' if sign > 0 else 'pressed'}, packing {seed}: {self.count:.0f} spheres, {bonds:.0f} bonds, strength "
                   f"{self.strength:.2f}, modulus {self.young:.0f}, by Voigt {self.voigt:.0f}")

    @staticmethod
    def _gauge(folder):
        """Places at first by ID, and the axial strain of the middle half."""
        tags, *x, uz = entries(os.path.join(folder, "grains.dump")).T
        places = numpy.zeros((int(tags.max()) + 1, 3))
        places[tags.astype(int)] = numpy.array(x).T
        places[tags.astype(int), 2] -= uz
        z = x[2] - uz
        inner = numpy.abs(z - z.mean()) < 0.25 * (z.max() - z.min())
        return places, float(numpy.polyfit(z[inner], uz[inner], 1)[0])


def mean(values):
    values = list(values)
    return statistics.fmean(values), statistics.stdev(values) if len(values) > 1 else math.nan


def measure(bench):
    seeds = bench.size(SEEDS, SEEDS[:1])
    jobs = [(sign, seed) for seed in seeds for sign in (-1, 1)]
    plate, *tests = problems.at_once([lambda cores: disk(bench, cores)] +
                                     [lambda cores, j=j: Test(bench, *j, cores) for j in jobs])
    pressed, pulled = tests[::2], tests[1::2]
    kn, ks = stiffness()
    static = 5 * ks / (2 * ks + 3 * kn) / ((2 * kn + 3 * ks) / (4 * kn + ks))
    ratio, scatter = mean(test.young / test.voigt for test in tests)
    bench.section.result("Young's modulus of a packing over that by Voigt, between the static hypothesis and 1", ratio, static, 1,
                         scatter=scatter)
    ratio, scatter = mean(a.strength / b.strength for a, b in zip(pressed, pulled))
    low, high = bench.size((2.5, 7.5), (2.0, 10.0))
    bench.section.result("strength in compression over that in tension, about 4.5 and 7 elsewhere", ratio, low, high, scatter=scatter)
    rows = []
    for seed, a, b in zip(seeds, pressed, pulled):
        rows.append([seed, a.count, a.voigt, a.young, b.young, a.strength, b.strength])
        bench.section.record(part=CYLINDER, seed=seed, voigt=a.voigt, pressed=a.young, pulled=b.young, compressive=a.strength,
                             tensile=b.strength)
    bench.section.table(["packing", "spheres", "E by Voigt", "E pressed", "E pulled", "strength in compression", "in tension"], rows)
    bench.section.text(f"""Disk: one layer of {plate[0]} spheres, ks = {SHEAR} kn, radial forces on the spheres of two arcs of 17 degrees,
viscous drag until it rests; its radius is that of the area of its spheres. Stresses are those of bonds (compute stress/atom), over the area
of a site; the center is all within a quarter of the radius. Input script: `validate/in.rock_disk`.""")
    bench.section.text(f"""Cylinder: random packings of equal spheres, {bench.size(10, 7)} diameters wide and twice as high, solid fraction
0.62, with beams of their own radius and E = {YOUNG:.0f} between all that are nearer than 1.15 diameters; strength E/500 in tension and 1.5
times that in shear; friction 0.5 where they have broken. Ends one diameter thick are moved at {bench.size("3e-5", "6e-5")} of the speed of
sound. Moduli: stress at a tenth of the run over the strain of the middle half. Strengths: peaks of the stress. Their ratio has no theory:
the bounds are ours, around those of others, and it depends on the rule by which beams break, here the sum of all loads over their limits.
Input script: `validate/in.rock`.""")
    bench.section.plot("", "Stress on the diameter across the load (left; lines: theory), and stress over strain of the cylinders (right)",
                       lambda plt: draw(plt, plate, pressed, pulled))


def draw(plt, plate, pressed, pulled):
    import plot
    _, (left, right) = plt.subplots(1, 2, figsize=(8, 3.5))
    _, x, found, expected = plate
    order = numpy.argsort(x)
    for k, name in enumerate(("across the load", "along the load")):
        some = order[::4]
        left.plot(x[some], found[k][some], **plot.style(k, linestyle="none"), label=name)
        left.plot(x[order], expected[k][order], **plot.style(k, marker=None))
    left.set_xlabel("x/R")
    left.set_ylabel("stress, 2 P/(pi D)")
    left.legend()
    for k, (name, tests) in enumerate((("pressed", pressed), ("pulled", pulled))):
        for n, test in enumerate(tests):
            right.plot(*zip(*test.curve), **plot.style(k, marker=None), label=None if n else name)
    right.set_xlabel("strain (%)")
    right.set_ylabel("stress")
    right.legend()
