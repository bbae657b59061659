# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""A straight beam that is held at one end, with masses at places along it: static and first natural frequency, from the
deflections that unit forces and couples give (any text on the strength of materials), in plain numbers."""

import math


def flexibility(places, bending, shear=math.inf):
    """Deflection and slope at each place for a force and a couple at each: rows and columns by turns. bending: E I; shear: kappa G A."""
    def entry(of, at):
        a, x = of, at
        near = min(a, x)
        by_force = near**2 * (3 * max(a, x) - near) / 6 / bending + near / shear
        slope_by_force = (x * (2 * a - x) if x <= a else a**2) / 2 / bending
        by_couple = (x**2 if x <= a else a * (2 * x - a)) / 2 / bending
        return (by_force, by_couple), (slope_by_force, near / bending)
    return [[entry(a, x)[row][column] for a in places for column in (0, 1)] for x in places for row in (0, 1)]


def times(matrix, vector):
    return [sum(m * v for m, v in zip(row, vector)) for row in matrix]


def leaning(places, shape):
    """Forces and couples of a unit load along the axis at the end, which leans on straight lines between the places."""
    at, lines = [0.0, *places], [0.0, *shape[::2]]
    slopes = [(lines[n + 1] - lines[n]) / (at[n + 1] - at[n]) for n in range(len(places))] + [0.0]
    return [f for n in range(len(places)) for f in (slopes[n] - slopes[n + 1], 0.0)]


def largest(operation, size):
    """(value, shape) of a linear operation, by repeating it."""
    shape, value = [1.0] * size, 0.0
    for _ in range(60):
        shape = operation(shape)
        value = max(map(abs, shape))
        shape = [s / value for s in shape]
    return value, shape


def buckling_load(places, bending):
    matrix = flexibility(places, bending)
    return 1 / largest(lambda shape: times(matrix, leaning(places, shape)), 2 * len(places))[0]


def first_mode(places, masses, inertias, bending, shear=math.inf, press=0.0):
    """(angular frequency, deflections, slopes); press: load along the axis at the end, below that of buckling."""
    matrix = flexibility(places, bending, shear)
    weights = [w for pair in zip(masses, inertias) for w in pair]

    def deflect(shape):
        under_weights = times(matrix, [w * s for w, s in zip(weights, shape)])
        found = under_weights
        for _ in range(60 if press else 0):
            found = [u + press * d for u, d in zip(under_weights, times(matrix, leaning(places, found)))]
        return found

    value, shape = largest(deflect, len(weights))
    return 1 / math.sqrt(value), shape[::2], shape[1::2]


def crossings(times, values):
    """Times at which the values change their sign, between two of them."""
    points = list(zip(times, values))
    return [t + (u - t) * a / (a - b) for (t, a), (u, b) in zip(points, points[1:]) if a * b < 0]
