# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Clumps of spheres and a floor by the simplest program that can be: steps of first order in the axes of space, rotation
matrices, no neighbor lists, for limits at small time steps that the engine is compared with. It shares no code with it. The
law is `hertz kn gn tangential multistep NULL NULL mu slider limit_damping`; the floor is the plane z = 0."""

import math

from vectors import cross, dot, length, plus, times


class Clump:
    """Spheres: what they are, and rigid motion in which they are."""

    def __init__(self, spheres):
        masses = [s.density * 4.0 / 3.0 * math.pi * (0.5 * s.diameter)**3 for s in spheres]
        self.mass = sum(masses)
        self.x = self.v = (0.0, 0.0, 0.0)
        for m, s in zip(masses, spheres):
            self.x = plus(self.x, s.x, m / self.mass)
            self.v = plus(self.v, s.v, m / self.mass)
        self.radii = [0.5 * s.diameter for s in spheres]
        self.arms = [plus(s.x, self.x, -1.0) for s in spheres]    # at the beginning
        self.inertia = [[0.0] * 3 for _ in "xyz"]    # the same
        for m, r, d in zip(masses, self.radii, self.arms):
            for i in range(3):
                for j in range(3):
                    self.inertia[i][j] += m * ((dot(d, d) + 0.4 * r * r if i == j else 0.0) - d[i] * d[j])
        self.turn = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        self.l = apply(self.inertia, spheres[0].omega)
        self.inverse = inverse_of(self.inertia)
        self.update()

    def update(self):
        back = list(zip(*self.turn))
        self.w = apply(self.turn, apply(self.inverse, apply(back, self.l)))
        self.now = [apply(self.turn, d) for d in self.arms]
        self.places = [plus(self.x, d) for d in self.now]
        self.speeds = [plus(self.v, cross(self.w, d)) for d in self.now]

    def step(self, force, torque, dt):
        self.v = plus(self.v, force, dt / self.mass)
        self.l = plus(self.l, torque, dt)
        self.x = plus(self.x, self.v, dt)
        self.update()
        angle = dt * length(self.w)
        if angle > 0.0:    # exp(angle n x) by Rodrigues
            n = times(1.0 / length(self.w), self.w)
            s, c = math.sin(angle), 1.0 - math.cos(angle)
            self.turn = [list(column) for column in zip(*[
                plus(plus(e, cross(n, e), s), plus(times(dot(n, e), n), e, -1.0), c) for e in zip(*self.turn)])]
        self.update()


def apply(matrix, v):
    return dot(matrix[0], v), dot(matrix[1], v), dot(matrix[2], v)


def inverse_of(m):
    a, b, c = m
    rows = cross(b, c), cross(c, a), cross(a, b)
    return [times(1.0 / dot(a, rows[0]), column) for column in zip(*rows)]


class Law:

    def __init__(self, kn, gn, mu):
        self.kn, self.gn, self.mu = kn, gn, mu
        self.memory = {}

    def force(self, key, n, overlap, radius, mass, seen, rotation, dt):
        """On the body from which `seen` is the velocity of the center against the other; n points to it. `rotation`: the
        angular velocities times radii, added up; None without contact. Returns force and the tangential part."""
        if overlap <= 0.0:
            self.memory.pop(key, None)
            return None
        contact = math.sqrt(radius * overlap)
        kt, gt = 2.0 / 7.0 * self.kn * contact, 0.5 * self.gn * mass * contact
        normal_speed = dot(seen, n)
        slip = plus(plus(seen, n, -normal_speed), cross(rotation, n), -1.0)
        pressed = max(contact * (self.kn * overlap - self.gn * mass * normal_speed), 0.0)
        before = self.memory.get(key, (0.0, 0.0, 0.0))
        flat = plus(before, n, -dot(before, n))
        before = times(length(before) / length(flat), flat) if length(flat) > 0.0 else flat
        d = plus(before, slip, dt)
        drag = plus(times(kt, d), slip, gt)
        limit = self.mu * pressed
        if length(drag) > limit:    # gt/kt d' + d = limit/kt along the force
            drag = times(limit / length(drag), drag)
            d = times(kt / (gt + kt * dt), plus(times(gt / kt, before), drag, dt / kt))
        self.memory[key] = d
        return plus(times(pressed, n), drag, -1.0), drag


def run(groups, floor, time, steps, gravity, **law):
    """Positions of all spheres at the end."""
    clumps = [Clump(spheres) for spheres in groups]
    law, dt = Law(**law), time / steps
    z = (0.0, 0.0, 1.0)
    for _ in range(steps):
        force = [times(-c.mass * gravity, z) for c in clumps]
        torque = [(0.0, 0.0, 0.0)] * len(clumps)

        def add_to(m, f, arm, moment):
            force[m] = plus(force[m], f)
            torque[m] = plus(plus(torque[m], cross(arm, f)), moment)
        for a, one in enumerate(clumps):
            for i, (r, x, v) in enumerate(zip(one.radii, one.places, one.speeds)):
                if floor:
                    found = law.force((a, i), z, r - x[2], r, one.mass, v, times(r, one.w), dt)
                    if found:
                        add_to(a, found[0], one.now[i], times(r, cross(z, found[1])))
                for b in range(a):
                    other = clumps[b]
                    for j, (rj, y, u) in enumerate(zip(other.radii, other.places, other.speeds)):
                        away = plus(x, y, -1.0)
                        far = length(away)
                        if far > r + rj and (a, i, b, j) not in law.memory:
                            continue
                        n = times(1.0 / far, away)
                        found = law.force((a, i, b, j), n, r + rj - far, r * rj / (r + rj),
                                          one.mass * other.mass / (one.mass + other.mass), plus(v, u, -1.0),
                                          plus(times(r, one.w), times(rj, other.w)), dt)
                        if found:
                            f, drag = found
                            add_to(a, f, one.now[i], times(r, cross(n, drag)))
                            add_to(b, times(-1.0, f), other.now[j], times(rj, cross(n, drag)))
        for c, f, t in zip(clumps, force, torque):
            c.step(f, t, dt)
    return [x for c in clumps for x in c.places]


def limit(groups, floor, time, steps, **rest):
    """What run() tends to, by its error of first order."""
    coarse, fine = (run(groups, floor, time, n, **rest) for n in (steps, 2 * steps))
    return [plus(times(2.0, b), a, -1.0) for a, b in zip(coarse, fine)]
