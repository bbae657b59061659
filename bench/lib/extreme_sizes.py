# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Extreme scenes with very different sizes."""

import random

from extreme_scene import NU, YOUNG, Ball, Extreme

LOSSY = ("material", YOUNG, 0.8, NU, 0.5)
ELASTIC = ("material", YOUNG, 1.0, NU, 0.0)
LIGHT, HEAVY = 0.01, 10.0      # gravity under which small spheres bear the large one, or do not


def on_small(name, ratio, across, gravity, speed=0.0, **more):
    """A sphere of diameter 1 falls on a layer of small ones between walls."""
    d = 1.0 / ratio
    width = across * d * 1.001
    balls = [Ball(((k % across + 0.5) * 1.001 * d, (k // across + 0.5) * 1.001 * d, 0.5 * d), diameter=d) for k in range(across**2)]
    balls.append(Ball((0.5 * width, 0.5 * width, 0.5 + 1.05 * d), (0.0, 0.0, -speed)))
    walls = ((2, 0.0, 1), (0, 0.0, 1), (0, width, -1), (1, 0.0, 1), (1, width, -1))
    options = {"steps": 8000, "frames": 20, "skin": 0.5 * d, **more}
    return Extreme(name, balls, LOSSY, box=((-1.0, width + 1.0), (-1.0, width + 1.0), (-1.0, 4.0)), gravity=gravity, planes=walls,
                   **options)


def gas(ratio, fraction, steps):
    """64 spheres fly about, the logarithms of their sizes evenly spread; all have the same energy, or about that."""
    draw = random.Random(9)
    balls = []
    for k in range(64):
        d = ratio ** (-(k * 29 % 64) / 63)
        speed = 0.3 * d**-1.5 / ratio**0.5
        balls.append(Ball((1.3 * (k % 4) + 0.6, 1.3 * (k // 4 % 4) + 0.6, 1.3 * (k // 16) + 0.6),
                          tuple(speed * draw.gauss(0, 1) for _ in "xyz"), diameter=d))
    return Extreme(f"gas of sizes 1:{ratio}, dt {fraction:g} critical", balls, ELASTIC, steps, ((0.0, 5.2),) * 3, periodic="p p p",
                   frames=200, fraction=fraction, skin=0.05)


def scenes(quick):
    across = 12 if quick else 32
    steps = 5000 if quick else 50000
    return [on_small("1 on many of 1/30", 30, across, LIGHT), on_small("1 on many of 1/30, too heavy", 30, across, HEAVY),
            on_small("1 hits many of 1/30", 30, across, LIGHT, 0.2),
            on_small("1 on many of 1/30, dt 2 critical", 30, across, LIGHT, fraction=2.0, steps=2000),
            gas(10, 0.2, steps), gas(10, 0.07, steps), gas(30, 0.07, steps)]
