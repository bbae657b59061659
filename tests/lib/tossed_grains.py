# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Grains on a jittered lattice over a floor of 9.5 x 7.2, each with a velocity of its own."""

import random

from talus_testing import Sphere


def tossed_grains(layers):
    draw = random.Random(4)
    return [Sphere(tuple(1.15 * s + 0.7 + draw.uniform(-0.1, 0.1) for s in (i, j, k)),
                   v=tuple(draw.uniform(-2.0, 2.0) for _ in "xyz"),
                   diameter=draw.uniform(0.7, 1.15))
            for i in range(8) for j in range(6) for k in range(layers)]
