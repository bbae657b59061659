# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What the floor of a silo feels."""

import math
import statistics

import problems

TITLE = "The weight at the bottom of a silo"
QUESTION = """Friction at the walls of a tube bears what is filled in, so that the mass which its floor feels comes to a limit:
m_felt = m_s (1 - exp(-m/m_s)), m_s = rho_b pi R^3/(2 mu_w K), with the friction mu_w of the wall and the ratio K of horizontal to vertical
stress (Janssen, Z. VDI 39, 1045, 1895), if friction is mobilized everywhere, as it is while the floor sinks (Bertho, Giorgiutti-Dauphine,
Hulin, Phys. Rev. Lett. 90, 144301, 2003). For these
grains K should be between that of a bed at rest, 1 - sin(phi) = 0.6 (Jaky), and 1."""

NUMBERS = (500, 1000, 2000, 4000, 8000, 16000)
FRICTION, RADIUS = 0.3, 0.016


def silo(bench, number, cores):
    """(mass, mass that the floor feels, height)."""
    _, result = problems.run(bench, "silo", f"silo-{number}", {"number": number, "friction": FRICTION}, cores)
    found = result.printed("Felt")[0]
    bench.note(f"{number} spheres: {1e3 * found[0]:.1f} g filled in, {1e3 * found[1]:.1f} g felt")
    return found


def janssen(mass, limit):
    return limit * (1 - math.exp(-mass / limit))


def fitted(points):
    """The limit of least squares, by bisection of intervals around the best of a list."""
    def error(limit):
        return sum((felt - janssen(mass, limit)) ** 2 for mass, felt, _ in points)
    limits = [points[0][0] * 1.01**k for k in range(700)]
    return min(limits, key=error)


def measure(bench):
    numbers = bench.size(NUMBERS, (500, 1000, 2000))
    points = problems.at_once([lambda cores, n=n: silo(bench, n, cores) for n in numbers])
    limit = fitted(points)
    bulk = statistics.median(mass / (math.pi * RADIUS**2 * height) for mass, _, height in points)
    k = bulk * math.pi * RADIUS**3 / (2 * FRICTION * limit)
    apart = max(abs(felt - janssen(mass, limit)) / limit for mass, felt, _ in points)
    bench.section.result("largest distance from the law, over the limit", apart, 0.0, 0.08)
    bench.section.result("K", k, 0.6, 1.0)
    bench.section.result("felt of the fullest tube, over the limit", points[-1][1] / limit, bench.size(0.92, 0.3), 1.08)
    rows = [[n, 1e3 * mass, 1e3 * felt, 1e3 * janssen(mass, limit)] for n, (mass, felt, _) in zip(numbers, points)]
    for row in rows:
        bench.section.record(spheres=row[0], filled_g=row[1], felt_g=row[2], law_g=row[3])
    bench.section.table(["spheres", "filled in, g", "felt, g", "law, g"], rows)
    bench.section.text(f"""Spheres of 2 mm +- 5 %, friction 0.5 among them and {FRICTION} at the tube of 16 mm radius; the floor sinks at 2 cm/s, what it
feels is the mean of the second millimetre. The limit is fitted: {1e3 * limit:.1f} g. Input script: `validate/in.silo`.""")
    bench.section.plot("", "Mass that the floor feels over the mass that was filled in, and the law of Janssen",
                       lambda plt: draw(plt, points, limit))


def draw(plt, points, limit):
    import plot
    _, axes = plt.subplots(figsize=(5, 3.5))
    most = points[-1][0]
    line = [most * k / 100 for k in range(101)]
    axes.plot([1e3 * p[0] for p in points], [1e3 * p[1] for p in points], **plot.style(0, linestyle="none"), label="Talus")
    axes.plot([1e3 * m for m in line], [1e3 * janssen(m, limit) for m in line], **plot.style(0, marker=None), label="Janssen")
    axes.set_xlabel("filled in, g")
    axes.set_ylabel("felt, g")
    axes.legend()
