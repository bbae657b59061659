# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Extreme scenes of clumps."""

import math
import random

from extreme_scene import Ball, Extreme

K = 1.0e5
DENSITY = 1.0
LOSSY = ("hooke", K, 60.0, 2 / 7 * K, 30.0, 0.5)
ELASTIC = ("hooke", K, 0.0, 0.0, 0.0, 0.0)
GRAVITY = 10.0

# (center, diameter, density over that of the others) of spheres, and the distance of clumps on a lattice
THREE = [((0.0, 0.0, 0.0), 1.0, 1.0), ((0.8, 0.1, 0.0), 0.9, 1.0), ((0.3, 0.7, 0.2), 0.8, 1.0)]
ROD = [((0.1 * k, 0.0, 0.0), 0.2, 1.0) for k in range(20)]
PLATE = [((0.2 * (k % 4), 0.2 * (k // 4), 0.0), 0.2, 1.0) for k in range(16)]
SATELLITE = [((0.0, 0.0, 0.0), 1.0, 1.0), ((0.5, 0.0, 0.0), 0.05, 1.0)]
HEAVY_END = [((0.0, 0.0, 0.0), 1.0, 1.0), ((0.6, 0.0, 0.0), 0.5, 1e3)]
KINDS = {"three spheres": (THREE, 2.0), "rods 1:10": (ROD, 2.3), "plates 1:4": (PLATE, 1.2), "a tiny satellite": (SATELLITE, 1.2),
         "a heavy end": (HEAVY_END, 2.6)}


def _centered(parts):
    masses = [d**3 * density for _, d, density in parts]
    center = [sum(m * x[axis] for m, (x, _, _) in zip(masses, parts)) / sum(masses) for axis in range(3)]
    return [(tuple(x[axis] - center[axis] for axis in range(3)), d, density) for x, d, density in parts]


def clump(parts, at, v=(0.0, 0.0, 0.0), w=(0.0, 0.0, 0.0)):
    """Its spheres, with the velocities that it gives them."""
    balls = []
    for arm, d, density in _centered(parts):
        swing = (w[1] * arm[2] - w[2] * arm[1], w[2] * arm[0] - w[0] * arm[2], w[0] * arm[1] - w[1] * arm[0])
        balls.append(Ball(tuple(p + q for p, q in zip(at, arm)), tuple(p + q for p, q in zip(v, swing)), w, d, DENSITY * density))
    return balls


def scene(name, clumps, law, steps, box, **more):
    """clumps: lists of balls."""
    numbers = tuple(k for k, balls in enumerate(clumps, 1) for _ in balls)
    return Extreme(name, [ball for balls in clumps for ball in balls], law, steps, box, clumps=numbers, units="lj", **more)


def grid(parts, spacing, lift=0.0, speed=0.0, count=3):
    draw = random.Random(5)
    return [clump(parts, (spacing * (k % count + 0.5), spacing * (k // count % count + 0.5), spacing * (k // count**2 + 0.5) + lift),
                  tuple(speed * draw.gauss(0, 1) for _ in "xyz")) for k in range(count**3)]


def bed(kind, steps, **more):
    parts, spacing = KINDS[kind]
    width = 3 * spacing
    walls = ((2, 0.0, 1), (0, 0.0, 1), (0, width, -1), (1, 0.0, 1), (1, width, -1))
    name = f"bed of clumps with {kind}" if kind.startswith("a ") else f"bed of clumps, {kind}"
    options = {"frames": 40, **more}
    return scene(name, grid(parts, spacing, 0.3), LOSSY, steps, ((-2.0, width + 2.0), (-2.0, width + 2.0), (-2.0, width + 5.0)),
                 gravity=GRAVITY, planes=walls, **options)


def gas(name, speed, fraction, steps):
    parts, spacing = KINDS["three spheres"]
    return scene(name, grid(parts, spacing, 0.0, speed), ELASTIC, steps, ((0.0, 3 * spacing),) * 3, periodic="p p p", frames=100,
                 fraction=fraction)


def turning(angle, steps):
    """A single clump that turns by about this angle in a step."""
    mass = DENSITY * math.pi / 6 * sum(d**3 for _, d, _ in THREE)
    rate = angle / (0.2 * math.sqrt(0.5 * mass / K))
    return scene(f"free clump turns by {angle:g} in a step", [clump(THREE, (0.0, 0.0, 0.0), w=(1e-3 * rate, rate, 1e-3 * rate))],
                 ELASTIC, steps, ((-20.0, 20.0),) * 3, frames=100)


def scenes(quick):
    steps = 3000 if quick else 20000
    found = [bed(kind, steps) for kind in KINDS if kind != "a heavy end"]
    # a push on the light end turns the clump about the heavy one: it has a fortieth of the mass
    heavy, slow, late = (bed(kind, steps, fraction=fraction, frames=200) for kind, fraction in
                         (("a heavy end", 0.2), ("a heavy end", 0.02), ("three spheres", 1.5)))
    slow.name += ", dt .02 critical"
    late.name += ", dt 1.5 critical"
    found += [heavy, slow, late, gas("gas of clumps, dt .2 critical", 1.0, 0.2, steps), gas("gas of clumps, dt .03 critical", 1.0, 0.03, steps),
              gas("gas of clumps, fast", 30.0, 0.2, steps // 8)]
    found += [turning(angle, 5000) for angle in (0.1, 1.0, 30.0)]
    two = [clump(THREE, (0.0, 0.0, 0.0)), clump(THREE, (0.0, 0.0, 0.6))]
    found.append(scene("two clumps overlap from the beginning", two, ELASTIC, 200, ((-20.0, 20.0),) * 3))
    return found
