# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Solutions of the verification cases of MFIX-DEM that need no simulation. Heights are of centres above the plane."""

import bisect
import math

import numpy

GRAVITY = 9.81


def damping(restitution, stiffness, mass):
    """Coefficient of hooke (1/time) with which two bodies of this reduced mass separate with the restitution, without gravity."""
    loss = -math.log(restitution)
    return 2 * math.sqrt(stiffness / mass) * loss / math.hypot(math.pi, loss)


def root(function, low, high):
    """By bisection; the sign of the function changes once."""
    sign = function(low) > 0
    while high - low > 1e-15:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if (function(middle) > 0) == sign else (low, middle)
    return 0.5 * (low + high)


class Contact:
    """A damped oscillator with weight that begins at overlap zero and ends there, or if it must not pull, at force zero."""

    def __init__(self, stiffness, damped, mass, speed, pulls=True):
        self.w2, self.c = stiffness / mass, 0.5 * damped
        self.wd = math.sqrt(self.w2 - self.c**2)
        self.rest = -GRAVITY / self.w2
        self.cosine, self.sine = -self.rest, (-speed - self.c * self.rest) / self.wd
        turn = root(self.rate, 0.0, 1.2 * math.pi / self.wd)
        self.end = self._zero(self.height, turn)
        if not pulls:
            self.end = root(self._push, turn, self.end)

    def _zero(self, function, turn):
        """The first zero after the turn; infinite if it comes to rest instead."""
        high = turn
        while function(high) < 0:
            high += 0.1 / self.wd
            if high > turn + 4 * math.pi / self.wd:
                return math.inf
        return root(function, turn, high)

    def _wave(self, t, cosine, sine):
        return math.exp(-self.c * t) * (cosine * math.cos(self.wd * t) + sine * math.sin(self.wd * t))

    def height(self, t):
        return self.rest + self._wave(t, self.cosine, self.sine)

    def rate(self, t):
        return self._wave(t, -self.c * self.cosine + self.wd * self.sine, -self.c * self.sine - self.wd * self.cosine)

    def _push(self, t):
        return -self.w2 * self.height(t) - 2 * self.c * self.rate(t)


class Bounces:
    """A sphere that falls from rest: stages of flight and contact until it has bounced so often."""

    def __init__(self, stiffness, damped, mass, radius, height, number, pulls=True):
        self.radius, self.starts, self.motions, self.tops = radius, [], [], []
        time, x, v = 0.0, height - radius, 0.0
        for _ in range(number + 1):
            self._add(time, lambda t, x=x, v=v: x + v * t - 0.5 * GRAVITY * t * t)
            self.tops.append(radius + x + v * v / (2 * GRAVITY))
            if len(self.tops) > number or x + v * v / (2 * GRAVITY) <= 0:
                return
            speed = math.sqrt(v * v + 2 * GRAVITY * x)
            time += (v + speed) / GRAVITY
            contact = Contact(stiffness, damped, mass, speed, pulls)
            self._add(time, contact.height)
            if contact.end == math.inf:
                return
            x, v = contact.height(contact.end), contact.rate(contact.end)
            time += contact.end

    def _add(self, time, motion):
        self.starts.append(time)
        self.motions.append(motion)

    def stage(self, t):
        """0: first fall, 1: first contact, 2: first rebound, ..."""
        return bisect.bisect_right(self.starts, t) - 1

    def height(self, t):
        k = self.stage(t)
        return self.radius + self.motions[k](t - self.starts[k])


def stack(stiffness, lower, upper, middle, masses, radius, ceiling, times):
    """Heights of two spheres between planes at these equidistant times from 0, by Runge and Kutta's method of order 4."""
    between = masses[0] * masses[1] / (masses[0] + masses[1])

    def rates(state):
        y1, y2, v1, v2 = state
        floor = stiffness * (radius - y1) - masses[0] * lower * v1
        roof = stiffness * (y2 + radius - ceiling) + masses[1] * upper * v2
        pair = stiffness * (y1 + 2 * radius - y2) - between * middle * (v2 - v1)
        return numpy.array([v1, v2, (floor - pair) / masses[0] - GRAVITY, (pair - roof) / masses[1] - GRAVITY])
    state, found = numpy.array([0.25 * ceiling, 0.75 * ceiling, 0.0, 0.0]), []
    h = (times[1] - times[0]) / 20
    for _ in times:
        found.append(state[:2])
        for _ in range(20):
            a = rates(state)
            b = rates(state + 0.5 * h * a)
            c = rates(state + 0.5 * h * b)
            state = state + h / 6 * (a + 2 * b + 2 * c + rates(state + h * c))
    return numpy.array(found)


def oblique(ratio, stiffness, steps=20000):
    """(tangential speed of the patch, spin r w) after an elastic impact with linear springs on a plane, over mu v_n; ratio: v_t/(mu v_n),
    stiffness: tangential over normal."""
    z, v, patch, spring, impulse, h = 0.0, 1.0, ratio, 0.0, 0.0, 4.0 / steps
    while z >= 0.0:
        spring = max(-z / stiffness, min(z / stiffness, spring + patch * h))
        impulse += stiffness * spring * h
        patch -= 3.5 * stiffness * spring * h
        v -= z * h
        z += v * h
    return patch, 2.5 * impulse
