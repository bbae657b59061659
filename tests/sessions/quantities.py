# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Numbers of an input script that know what they are, so that a scene can be moved, turned and told in other units."""

import dataclasses
import math

# how the values of a Quantity follow when the scene is turned or moved
SCALAR, VECTOR, PLACE, AXIAL = "scalar", "vector", "place", "axial"
ALONG = {"along x": 0, "along y": 1, "along z": 2}    # a coordinate on its own
TURN = "turn"                                         # a quaternion w x y z


@dataclasses.dataclass(frozen=True)
class Quantity:
    """values: 1, 3 or 4 floats; units: exponents of length, mass and time."""
    values: tuple
    kind: str = SCALAR
    units: tuple = (0, 0, 0)

    def __str__(self):
        return " ".join(repr(float(value)) for value in self.values)


def number(x, *units):
    """A scalar; units: exponents of length, mass, time."""
    return Quantity((x,), SCALAR, units or (0, 0, 0))


def length(x):
    return number(x, 1, 0, 0)


def place(p):
    return Quantity(tuple(p), PLACE, (1, 0, 0))


def direction(n):
    return Quantity(tuple(n), VECTOR)


def axis(n):
    """Of a rotation: it turns with the scene like any other direction, since turns have no mirror."""
    return Quantity(tuple(n), AXIAL)


def displacement(d):
    return Quantity(tuple(d), VECTOR, (1, 0, 0))


def velocity(v):
    return Quantity(tuple(v), VECTOR, (1, 0, -1))


def spin(w):
    return Quantity(tuple(w), AXIAL, (0, 0, -1))


def along(which, x):
    """A coordinate: 0, 1, 2 for x, y, z."""
    return Quantity((x,), f"along {'xyz'[which]}", (1, 0, 0))


def turned(quaternion):
    return Quantity(tuple(quaternion), TURN)


def duration(t):
    return number(t, 0, 0, 1)


# ---- lines --------------------------------------------------------------------------------------

def line(*words):
    """A command: words are text, numbers without a unit, and quantities; nested lists of words are taken apart."""
    found = []
    for word in words:
        if isinstance(word, (list, tuple)):
            found += line(*word)
        else:
            found.append(word if isinstance(word, (str, Quantity)) else str(word))
    return tuple(found)


def text(words):
    return " ".join(map(str, words))


# ---- other coordinates and units ----------------------------------------------------------------

def product(p, q):
    """Of quaternions w x y z."""
    a, b, c, d = p
    e, f, g, h = q
    return (a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f,
            a * h + b * g - c * f + d * e)


def rotated(q, v):
    return product(product(q, (0.0, *v)), (q[0], -q[1], -q[2], -q[3]))[1:]


@dataclasses.dataclass(frozen=True)
class Change:
    """First the rotation about the origin, then the shift, then the units: of length, mass and time, of which each number tells
    so many that were one."""
    rotation: tuple = (1.0, 0.0, 0.0, 0.0)
    shift: tuple = (0.0, 0.0, 0.0)
    units: tuple = (1.0, 1.0, 1.0)

    def of(self, quantity):
        values = quantity.values
        if quantity.kind in (VECTOR, AXIAL, PLACE) and self.rotation != Change.rotation:
            values = rotated(self.rotation, values)
        if quantity.kind == PLACE:
            values = tuple(x + d for x, d in zip(values, self.shift))
        elif quantity.kind in ALONG:
            values = (values[0] + self.shift[ALONG[quantity.kind]],)
        elif quantity.kind == TURN and self.rotation != Change.rotation:
            values = product(self.rotation, values)
        factor = math.prod(unit**power for unit, power in zip(self.units, quantity.units))
        return Quantity(tuple(x * factor for x in values), quantity.kind, quantity.units)



class Rounding:
    """Numbers of so many decimals, which a reader can take in; quaternions keep their length."""

    def __init__(self, digits):
        self.digits = digits

    def of(self, quantity):
        if quantity.kind == TURN:
            return quantity
        return dataclasses.replace(quantity, values=tuple(round(x, self.digits) for x in quantity.values))
