# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Bonds of bond_style bpm/rotational and bpm/spring drawn at random: between which grains, how strong, made how."""

import itertools
import math
import os

from laws import FORCE, STIFFNESS, TORQUE, some
from quantities import length, line, number
from scene import BOND_TYPES

BEAMS, SPRINGS, VOLUMES = "bond_style bpm/rotational", "bond_style bpm/spring", "volume/factor"
FAR = 1.3      # of the centers of two that may have a bond
MORE = line("bond/types", BOND_TYPES, "extra/bond/per/atom 20 extra/special/per/atom 60")    # of create_box
DAMPING, OF_TWIST, OF_ROLL = (0, 1, -1), (2, 1, -1), (1, 1, -1)    # force over velocity, torque over angular velocity; by length
APART, TOUCHING = "special_bonds lj 0 1 1 coul 1 1 1", "special_bonds lj 1 1 1 coul 1 1 1"    # spheres that have a bond
FRAMES = int(os.environ["TALUS_LAMMPS_VERSION"]) >= 20260000    # words that LAMMPS has since then


def near(scene):
    """(i, j) of grains near each other, also across a border of the box."""
    (start,), edges = [words for words in scene.start if words[0] == "boundary"], scene.edges()
    periods = [high - low if word == "p" else math.inf for word, (low, high) in zip("".join(start[1:]).replace(" ", ""), edges)]

    def apart(a, b):
        return math.hypot(*(min(abs(p - q), period - abs(p - q)) for p, q, period in zip(a, b, periods)))

    return [(i, j) for (i, a), (j, b) in itertools.combinations(enumerate(scene.grains, start=1), 2)
            if apart(a.place.values, b.place.values) < FAR]


def style_of(scene):
    """Words of bond_style."""
    words, = [words for words in scene.once if words[0] in (BEAMS, SPRINGS)]
    return words


def coefficients(rng, bond_type, style):
    """Line of bond_coeff for bonds of length 1 or so and these words of bond_style."""
    if style[0] == SPRINGS:
        stiffness = some(rng, 2e3, 1e4, *((1, 1, -2) if "normalize" in style else STIFFNESS))
        limit = "1e9" if rng.random() < 0.2 else f"{0.01 * 50**rng.random():.4g}"
        damping = some(rng, 0, 20, *DAMPING) if rng.random() < 0.7 else "0"
        return line("bond_coeff", bond_type, stiffness, limit, damping, some(rng, 100, 1e3, *FORCE) if VOLUMES in style else ())
    turning = (OF_TWIST, OF_TWIST if "derivative" in style else OF_ROLL) if FRAMES else (OF_ROLL, OF_TWIST)
    stiffness = (1, 1, -2) if "normalize" in style else STIFFNESS

    def strength(low, high, *units):
        return number(1e9, *units) if rng.random() < 0.2 else number(float(f"{low * (high / low)**rng.random():.4g}"), *units)

    limits = strength(20, 2e3, *FORCE), strength(20, 2e3, *FORCE), strength(5, 500, *TORQUE), strength(5, 500, *TORQUE)
    damping = [some(rng, 0, high, *units) if rng.random() < 0.7 else "0" for high, units in
               ((20, DAMPING), (20, DAMPING), (1, turning[0]), (1, turning[1]))]
    return line("bond_coeff", bond_type, some(rng, 2e3, 1e4, *stiffness), some(rng, 1e3, 5e3, *stiffness), some(rng, 50, 500, *TORQUE),
                some(rng, 50, 500, *TORQUE), limits, damping)


def style(rng):
    """Words of bond_style."""
    name = rng.choice((BEAMS, BEAMS, SPRINGS))
    words = rng.choice(("break no smooth no", "", "", "smooth no", "smooth yes")).split()
    for likely, more in (0.3, "normalize yes"), (0.25, "overlay/pair yes"), (0.3, "store/local broken 1 time id1 id2"):
        if rng.random() < likely:
            words += more.split()
    if name == SPRINGS and rng.random() < 0.3:
        words += [VOLUMES, "yes"]
    if FRAMES and name == BEAMS:
        words = ["frame", rng.choice(("particle", "average")), "damping", rng.choice(("dem", "derivative")), *words]
    return line(name, words)


def bonded(rng, scene):
    """The grains of a scene with bonds: made one by one, by distance, or read with them. It is one for atom_style bpm/sphere."""
    words = style(rng)
    how = rng.choice(("one by one", "many", "read"))
    once = [line(APART.replace("coul 1", "coul 0")), line("create_bonds many all all 1 0", length(1.0))] if how == "many" else []
    once += [line(TOUCHING if "overlay/pair" in words else APART), words, *(coefficients(rng, k, words) for k in range(1, BOND_TYPES + 1))]
    if rng.random() < 0.3:    # bonds begin strained by it
        once.append(line("set group all quat", *[f"{rng.uniform(-1, 1):.3g}" for _ in "xyz"], rng.randint(1, 359)))
    share = rng.choice((0.5, 0.9, 1.0))
    found = () if how == "many" else tuple((rng.randint(1, BOND_TYPES), i, j) for i, j in near(scene) if rng.random() < share)
    traits = {"bonded"} | ({"read"} if how == "read" else set())
    if rng.random() < 0.5 or {"normalize", "break"} & set(words):    # LAMMPS 4 Feb 2025 has these not in restart files
        traits.add("again")
    return scene.but(bonds=found, once=tuple(once), box=(scene.box[0], line(scene.box[1], MORE)), traits=scene.traits | traits)
