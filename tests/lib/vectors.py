# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Vectors of three numbers for the slow references of the tests."""

import math


def plus(a, b, factor=1.0):
    return a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]


def minus(a, b):
    return plus(a, b, -1.0)


def times(factor, a):
    return factor * a[0], factor * a[1], factor * a[2]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def length(a):
    return math.sqrt(dot(a, a))
