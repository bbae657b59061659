# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Contacts of LIGGGHTS, from the equations of its manual (pages gran model hertz, hooke, tangential history and no_history, rolling
friction cdt, fix heat/gran/conduction), and impacts with them: an independent reference for lines that are converted."""

import dataclasses
import math

from vectors import cross, dot, plus


@dataclasses.dataclass
class Sphere:
    x: tuple
    v: tuple
    w: tuple
    radius: float
    density: float

    @property
    def mass(self):
        return 4 / 3 * math.pi * self.radius**3 * self.density

    def push(self, force, torque, dt):
        self.v = plus(self.v, force, dt / self.mass)
        self.w = plus(self.w, torque, dt / (0.4 * self.mass * self.radius**2))
        self.x = plus(self.x, self.v, dt)


def effective_moduli(young, poisson):
    """Of two materials: Y*, G*."""
    return (1 / sum((1 - n**2) / y for y, n in zip(young, poisson)),
            1 / sum(2 * (2 - n) * (1 + n) / y for y, n in zip(young, poisson)))


@dataclasses.dataclass
class Law:
    """What property/global says of a pair of types: moduli of both, the rest of the pair."""
    young: tuple
    poisson: tuple
    restitution: float
    friction: float
    model: str = "hertz"
    tangential: str = "history"
    characteristic_velocity: float = 0.0
    cdt: float = 0.0

    def stiffness_and_damping(self, radius, mass, overlap):
        """kn, kt, gamma_n, gamma_t."""
        young, shear = effective_moduli(self.young, self.poisson)
        log = math.log(self.restitution)
        if self.model == "hooke":
            root = math.sqrt(radius)
            k = 16 / 15 * root * young * (15 * mass * self.characteristic_velocity**2 / (16 * root * young))**0.2
            gamma = math.sqrt(4 * mass * k / (1 + (math.pi / log)**2))
            return k, k, gamma, gamma
        beta = log / math.sqrt(log**2 + math.pi**2)
        a = math.sqrt(radius * overlap)
        normal, tangential = 2 * young * a, 8 * shear * a
        factor = -2 * math.sqrt(5 / 6) * beta
        return 2 / 3 * normal, tangential, factor * math.sqrt(normal * mass), factor * math.sqrt(tangential * mass)


class Contact:
    """Of a sphere with another one, or with a wall (`other` is None) at z = 0."""

    def __init__(self, law):
        self.law, self.shear = law, (0.0, 0.0, 0.0)

    def forces(self, one, other, dt):
        """Force on the first, torques on both; None: they do not touch."""
        away = plus(one.x, other.x, -1) if other else (0.0, 0.0, one.x[2])
        distance = math.sqrt(dot(away, away))
        overlap = one.radius + (other.radius if other else 0.0) - distance
        if overlap <= 0:
            return None
        n = tuple(c / distance for c in away)
        radius = one.radius * other.radius / (one.radius + other.radius) if other else one.radius
        mass = one.mass * other.mass / (one.mass + other.mass) if other else one.mass
        kn, kt, gn, gt = self.law.stiffness_and_damping(radius, mass, overlap)

        arm, other_arm = one.radius - overlap / 2, (other.radius - overlap / 2 if other else 0.0)
        v = plus(one.v, other.v, -1) if other else one.v
        vn = dot(v, n)
        turning = plus(tuple(arm * c for c in one.w), other.w if other else (0, 0, 0), other_arm)
        vt = plus(plus(v, n, -vn), cross(turning, n), -1)
        fn = kn * overlap - gn * vn
        ft = self.tangential(n, vt, kt, gt, self.law.friction * abs(fn), dt)

        turn = cross(n, ft)
        torque, other_torque = tuple(-arm * c for c in turn), tuple(-other_arm * c for c in turn)
        rolling = self.rolling(one, other, n, kn * overlap * radius)
        return (plus(tuple(fn * c for c in n), ft), plus(torque, rolling), plus(other_torque, rolling, -1))

    def tangential(self, n, vt, kt, gt, limit, dt):
        if self.law.tangential == "no_history":
            speed = math.sqrt(dot(vt, vt))
            return tuple(-min(limit, gt * speed) / speed * c for c in vt) if speed else (0.0, 0.0, 0.0)
        s = plus(self.shear, vt, dt)
        s = plus(s, n, -dot(s, n))
        spring = kt * math.sqrt(dot(s, s))
        if spring > limit:
            self.shear = tuple(limit / spring * c for c in s)
            return tuple(-kt * c for c in self.shear)
        self.shear = s
        return plus(tuple(-kt * c for c in s), vt, -gt)

    def rolling(self, one, other, n, size):
        w = plus(one.w, other.w, -1) if other else one.w
        length = math.sqrt(dot(w, w))
        if not self.law.cdt or not length:
            return (0.0, 0.0, 0.0)
        return tuple(-self.law.cdt * size / length * c for c in plus(w, n, -dot(w, n)))


def collide(law, one, other=None, dt=1e-7):
    """Until they are apart again; the spheres are changed."""
    contact, touched = Contact(law), False
    while True:
        found = contact.forces(one, other, dt)
        if found is None and touched:
            return
        touched = touched or found is not None
        force, torque, other_torque = found or ((0.0,) * 3,) * 3
        one.push(force, torque, dt)
        if other:
            other.push(tuple(-c for c in force), other_torque, dt)


def heat_flow(conductivity, one, other, overlap):
    """Power per difference of temperature between two spheres, through the circle in which they intersect."""
    distance = one + other - overlap
    area = -math.pi / 4 * ((distance - one - other) * (distance + one - other) * (distance - one + other) * (distance + one + other)) / distance**2
    mean = 4 * conductivity[0] * conductivity[1] / sum(conductivity)
    return mean * math.sqrt(area)
