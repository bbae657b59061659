# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Flow down a rough incline."""

import math
import os

import numpy

import problems

TITLE = "Flow down an incline"
QUESTION = """Spheres flow steadily down a rough plane between the angle where they stop and the one where they run away. The solid fraction
does not vary with depth, and the speed follows Bagnold's profile, v = A (h^(3/2) - (h - z)^(3/2)) (Silbert, Ertas, Grest, Halsey, Levine,
Plimpton, Phys. Rev. E 64, 051302, 2001). The inertial number I = d shear rate/sqrt(p/rho) then is one for the flow, and the slope follows
from it as mu(I) = mu_1 + (mu_2 - mu_1)/(I_0/I + 1), for glass beads with mu_1 = 0.382, mu_2 = 0.643, I_0 = 0.279 (Jop, Forterre, Pouliquen,
Nature 441, 727, 2006)."""

ANGLES = (21.0, 22.5, 24.0, 25.5)
STARTS = {21.0: 0.02, 22.5: 0.046, 24.0: 0.078, 25.5: 0.125}     # near the end, so that it is steady soon
STOPS = 17.0            # degrees: a slope that is too flat
JOP = 0.382, 0.643, 0.279
HEIGHT = 20
NEAR_STOP = 22.0        # degrees: below, a layer of this height is close to the slope on which it stops


def read_profile(path):
    """[(heights, speeds, solid fractions)] of the blocks of time."""
    blocks, rows = [], []
    with open(path) as file:
        lines = [line.split() for line in file if not line.startswith("#")]
    for words in lines:
        if len(words) == 3:
            rows = []
            blocks.append(rows)
        else:
            rows.append((float(words[1]), float(words[3]), math.pi / 6 * float(words[4])))
    return [numpy.array(rows).T for rows in blocks]


def flow(bench, angle, cores):
    variables = {"angle": angle, "start": STARTS.get(angle, STARTS[21.0]), "height": bench.size(HEIGHT, 8), "flow": bench.size(200, 60),
                 "watch": bench.size(150, 10)}
    folder, result = problems.run(bench, "chute", f"angle-{angle}", variables, cores)
    profiles = read_profile(os.path.join(folder, "profile.txt"))
    bench.note(f"{angle} degrees: mean speed {profiles[-1][1][profiles[-1][2] > 0.3].mean():.3g}, {result.loops()[-1].nanoseconds():.0f} ns")
    return profiles


def bagnold(profile):
    """Height, amplitude A, share of the variance that the law explains, solid fraction and inertial number."""
    z, v, fraction = profile
    full = fraction > 0.4
    height = float(z[full].max()) + 0.5
    inner = full & (z > 2) & (z < height - 2)
    law = height**1.5 - (height - z[inner]) ** 1.5
    slope, start = numpy.polyfit(law, v[inner], 1)
    rest = v[inner] - (slope * law + start)
    mean = float(fraction[inner].mean())
    return height, float(slope), 1.0 - float(rest.var() / v[inner].var()), mean, float(fraction[inner].std())


def inertial_number(amplitude, fraction, angle):
    return 1.5 * amplitude / math.sqrt(fraction * math.cos(math.radians(angle)))


def jop(number):
    return JOP[0] + (JOP[1] - JOP[0]) / (JOP[2] / number + 1)


def measure(bench):
    angles = [*bench.size(ANGLES, (24.0,)), STOPS]
    profiles = dict(zip(angles, problems.at_once([lambda cores, a=a: flow(bench, a, cores) for a in angles])))
    rows = []
    still = profiles.pop(STOPS)[-1]
    for angle, blocks in profiles.items():
        height, amplitude, explained, fraction, spread = bagnold(blocks[-1])
        before = bagnold(blocks[0])[1]
        number, mu = inertial_number(amplitude, fraction, angle), math.tan(math.radians(angle))
        rows.append([angle, height, amplitude, amplitude / before, explained, fraction, spread, number, mu, jop(number)])
        bench.section.record(angle=angle, amplitude=amplitude, fraction=fraction, inertial=number, mu=mu, jop=jop(number))
        if angle > NEAR_STOP:
            bench.section.result(f"variance of the speed that Bagnold's profile explains, {angle} degrees", explained, bench.size(0.99, 0.8), 1.0)
        bench.section.result(f"standard deviation of the solid fraction over depth, {angle} degrees", spread, 0.0, bench.size(0.01, 0.05))
        bench.section.result(f"tan(slope) over mu(I), {angle} degrees", mu / jop(number), bench.size(0.9, 0.7), bench.size(1.1, 1.3))
    bench.section.result(f"largest mean speed of a layer at {STOPS} degrees", float(numpy.abs(still[1][still[2] > 0.3]).max()), 0.0, 1e-3)
    bench.section.table(["slope, degrees", "height", "A", "A over that of the time before", "variance explained", "solid fraction",
                         "its deviation", "I", "tan(slope)", "mu(I) of Jop et al."], rows)
    bench.section.text(f"""Spheres of one size, friction 0.5, e = 0.88, linear springs (stiffness 2e4 m g/d, after Silbert et al., whose results
do not depend on it), {HEIGHT} diameters deep over a base of fixed spheres at random places, 10 diameters long and wide, periodic. Units:
diameter, mass of a sphere, gravity. Layers within two diameters of base and surface are left out. Near the slope on which a
layer of its height stops, here at {min(ANGLES):.0f} degrees, the profile becomes a straight line (Silbert, Landry, Grest, Phys. Fluids 15, 1, 2003): it is not
compared with Bagnold's there. Input script: `validate/in.chute`.""")
    bench.section.plot("", "Profiles of speed; lines are Bagnold's", lambda plt: draw(plt, profiles))


def draw(plt, profiles):
    import plot
    _, axes = plt.subplots(figsize=(5, 3.5))
    for k, (angle, blocks) in enumerate(profiles.items()):
        z, v, fraction = blocks[-1]
        height, amplitude, *_ = bagnold(blocks[-1])
        shown = fraction > 0.3
        axes.plot(v[shown], z[shown], **plot.style(k, linestyle="none"), label=f"{angle} degrees")
        inner = shown & (z > 2) & (z < height - 2)
        law = height**1.5 - numpy.maximum(0.0, height - z) ** 1.5
        start = float((v - amplitude * law)[inner].mean())
        axes.plot(amplitude * law[inner] + start, z[inner], **plot.style(k, marker=None))
    axes.set_xlabel("speed, sqrt(g d)")
    axes.set_ylabel("height, d")
    axes.legend()
