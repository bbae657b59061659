# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Single impacts after Chung and Ooi 2011 (Granular Matter 13:643): their digitised curves, and runs of many of them at once, far from
each other. Before and after an impact the motion is free, so that times of contact and speeds follow from the last state exactly."""

import collections
import math

from granular_script import begin
from talus_testing import Sphere, read_dump, write_sphere_data

STEPS_PER_CONTACT = 2000    # Hertzian contact time over time step

Material = collections.namedtuple("Material", "young poisson density")
GLASS, LIMESTONE = Material(4.8e10, .20, 2800.0), Material(2.0e10, .25, 2500.0)
AL_ALLOY, MG_ALLOY = Material(7.0e10, .30, 2699.0), Material(4.0e10, .35, 1800.0)
AL_OXIDE, CAST_IRON = Material(3.8e11, .23, 4000.0), Material(1.0e11, .25, 7000.0)
AL_ALLOY_4, NYLON = Material(7.0e10, .33, 2700.0), Material(2.5e9, .40, 1000.0)

# test 4: angle, then e_t, w', rebound angle of the contact patch for aluminium oxide, e_t, w' for alloy
DIGITISED_4 = [
    (5, .948, -19.3, 3.8, .899, -35.3), (10, .687, -213, -1.6, .671, -224),
    (15, .624, -378, -5.5, .613, -390), (20, .616, -511, -7.5, .609, -519),
    (25, .634, -599, -7.5, .633, -599), (30, .684, -617, -3.5, .683, -618),
    (35, .737, -582, 3.4, .736, -582), (40, .781, -545, 11.6, .780, -545),
    (50, .845, -457, 29.4, .844, -458), (60, .893, -357, 47.8, .891, -359),
    (70, .932, -246, 64.6, .932, -245), (80, .966, -126, 78.7, .966, -125),
    (85, .983, -63, 84.5, .983, -64)]
ANGLES = [2, *(row[0] for row in DIGITISED_4)]

# test 6, aluminium alloy: (7/2) mu (1+e) Vn/Vt, negative tangential restitution of the patch
DIGITISED_6 = [
    (.176, -.820), (.352, -.633), (.551, -.445), (.771, -.243), (.969, -.028), (1.19, .097),
    (1.45, .119), (1.74, .100), (2.09, .058), (2.49, .005), (3.0, -.050), (3.63, -.100),
    (4.52, -.140), (5.75, -.175), (7.82, -.208), (11.9, -.258), (24.0, -.342)]
# the same as tangents of the angles of the patch before and after
RECOIL_6 = [
    (.085, .022), (.173, .062), (.268, .089), (.363, .102), (.465, .089), (.574, .089), (.696, .050),
    (.838, -.031), (1.0, -.151), (1.20, -.271), (1.43, -.351), (1.73, -.377), (2.15, .052),
    (2.75, 1.27), (3.73, 3.24), (5.68, 7.13), (6.11, 7.98)]
SPINS_6 = [.175, .2, .3, .5, .7, .9, 1.3, 2, 3, 4, 5, 7, 9, 12, 22]

SCRIPT = begin("si") + """
{pairs}
{body}
neighbor {skin} bin
fix step all nve/sphere/symplectic
timestep {dt}
thermo {steps}
dump d all custom {every} out id x y z vx vy vz omegay fx fz
dump_modify d format float %.17g sort id
run {steps}
"""

# E, e, nu of a body without compliance: E* = E/(1-nu^2) and G* = G/(2-nu) are those of the particle
RIGID = "hertz/material 1e30 1.0 0.0"


class Hertz:
    """Closed forms for two elastic bodies that meet at a relative speed."""

    def __init__(self, material, radius, speed, pair=False):
        modulus = material.young / (1 - material.poisson**2) / (2 if pair else 1)
        mass = material.density * 4 / 3 * math.pi * radius**3 / (2 if pair else 1)
        stiffness = 4 / 3 * modulus * math.sqrt(radius / (2 if pair else 1))
        self.depth = (5 * mass * speed**2 / (4 * stiffness))**0.4
        self.force = stiffness * self.depth**1.5
        self.time = 2.9432750 * self.depth / speed
        self.mass = mass


def sum_of_force(restitution, steps=20000):
    """Integral of |F_n| over m v_n of a damped Hertzian impact that ends at overlap zero, tail included:
    x'' = -x^(3/2) - 2 b sqrt(5/4) x^(1/4) x' in scaled units."""
    damping = -math.log(restitution) / math.hypot(math.log(restitution), math.pi)
    x, v, h, total = 0.0, 1.0, 4.0 / steps, 0.0
    while x >= 0.0:
        force = x**1.5 + math.sqrt(5) * damping * x**0.25 * v
        total += h * abs(force)
        v -= h * force
        x += h * v
    return total


def law(material, restitution, friction, more="", gt="NULL"):
    """Words of a material; without friction there is no tangential law."""
    tangential = f"tangential multistep NULL {gt} {friction}" if friction else ""
    return (f"hertz/material {material.young} {restitution} {material.poisson} {tangential} {more}").strip()


class Impact:
    """A sphere on its way to the plane z = 0, or the upper one of two that meet."""

    def __init__(self, material, radius, speed, words, sideways=0.0, spin=0.0, pair=False):
        self.material, self.radius, self.speed, self.words = material, radius, speed, words
        self.sideways, self.spin, self.pair = sideways, spin, pair
        self.hertz = Hertz(material, radius, 2 * speed if pair else speed, pair)


def collide(impacts, run, path, friction=0.0, every=None, gt="NULL", plane=""):
    """Runs all impacts by run(script) in the folder of path(name); sets for each what came of it. Returns the frames and the ID of the
    (upper) sphere of each. plane: words of its material in place of those of a rigid one with gt and friction."""
    dt = min(i.hertz.time for i in impacts) / STEPS_PER_CONTACT
    steps = int(2.0 * max(i.hertz.time for i in impacts) / dt) + 10
    radius = max(i.radius for i in impacts)
    pair = impacts[0].pair
    words = sorted({i.words for i in impacts})
    spheres, first = [], []
    for n, i in enumerate(impacts):
        gap = 2.5 * i.speed * dt
        x = (n + 0.5) * 4 * radius
        first.append(len(spheres) + 1)
        common = {"omega": (0, i.spin, 0), "diameter": 2 * i.radius,
                  "density": i.material.density, "type": words.index(i.words) + 1}
        spheres.append(Sphere((x, 0, i.radius + gap), (i.sideways, 0, -i.speed), **common))
        if pair:
            spheres.append(Sphere((x, 0, -i.radius - gap), (-i.sideways, 0, i.speed), **common))
    write_sphere_data(path("data"), ((0, 4 * radius * len(impacts)), (-4 * radius, 4 * radius),
                                     (-4 * radius, 4 * radius)), spheres, types=len(words))
    plane = plane or RIGID + (f" tangential multistep NULL {gt} {friction}" if friction else "")
    run(SCRIPT.format(
        pairs="\n".join(f"pair_coeff {t} {t} {w}" for t, w in enumerate(words, 1)),
        body="" if pair else f"fix floor all large/body plane 0 0 0 0 0 1 contact {plane}",
        skin=0.2 * radius, dt=repr(dt), steps=steps, every=every or steps))
    frames = read_dump(path("out"))
    last = frames[-1]
    for i, tag in zip(impacts, first, strict=True):
        row = {key: last.column(key)[tag] for key in last.columns}
        if row["fz"] != 0.0 or row["vz"] <= 0.0:
            raise AssertionError(f"sphere {tag} is still in contact")
        i.normal, i.tangential, i.turn = row["vz"] / i.speed, row["vx"], row["omegay"]
        i.patch = row["vx"] - i.radius * row["omegay"]
        i.upward = row["vz"]
        i.time = steps * dt - 2.5 * dt - (row["z"] - i.radius) / row["vz"]
    return frames, first


def oblique(limit=""):
    """Test 4: impacts of both materials at all angles."""
    restitution, friction, radius, speed = 0.98, 0.092, 0.0025, 3.9
    return [Impact(m, radius, speed * math.cos(math.radians(a)), law(m, restitution, friction, limit), speed * math.sin(math.radians(a)))
            for m in (AL_OXIDE, AL_ALLOY_4) for a in ANGLES]


def spinning(material, ratios, limit="", gt="NULL"):
    """Test 6 for ratios of tangential to normal speed of the patch."""
    words = law(material, 0.5, 0.4, limit, gt)
    return [Impact(material, 0.1, 0.2, words, spin=ratio * 0.2 / 0.1) for ratio in ratios]
