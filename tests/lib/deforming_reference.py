# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Spheres on a mesh that deforms by the simplest program that can be: in each step every sphere looks at every triangle. It shares
no code with the engine. The law is `hooke kn gn tangential dashpot gt mu`, gravity acts along -z; spheres do not touch each other,
each touches the nearest point of the mesh, and steps are of first order (v, then x)."""

import math

from vectors import cross, dot, minus, plus


def nearest(p, a, b, c):
    """Barycentric shares of the point of a triangle that is nearest to p, by trying face, edges and corners."""
    e, f = minus(b, a), minus(c, a)
    ee, ef, ff = dot(e, e), dot(e, f), dot(f, f)
    d = minus(p, a)
    s, t = dot(d, e), dot(d, f)
    det = ee * ff - ef * ef
    u, v = (ff * s - ef * t) / det, (ee * t - ef * s) / det
    if u >= 0.0 and v >= 0.0 and u + v <= 1.0:
        return (1.0 - u - v, u, v)
    best = None
    for i, j in ((0, 1), (1, 2), (2, 0)):
        corner = (a, b, c)
        along = minus(corner[j], corner[i])
        w = min(max(dot(minus(p, corner[i]), along) / dot(along, along), 0.0), 1.0)
        shares = [0.0, 0.0, 0.0]
        shares[i], shares[j] = 1.0 - w, w
        away = minus(p, plus(corner[i], along, w))
        if best is None or dot(away, away) < best[0]:
            best = (dot(away, away), tuple(shares))
    return best[1]


def turning(x, v):
    """Angular velocity of a triangle: by differences of its normal and of a direction in its plane a moment before and after."""
    h = 1e-6

    def axes(time):
        p = [plus(x[k], v[k], time) for k in range(3)]
        n = cross(minus(p[1], p[0]), minus(p[2], p[0]))
        return tuple(q / math.sqrt(dot(n, n)) for q in n), p
    (before, _), (now, _), (after, _) = axes(-h), axes(0.0), axes(h)
    tilt = cross(now, tuple((q - p) / (2.0 * h) for p, q in zip(before, after)))
    # half the curl in the plane: of the gradient that takes edges to differences of velocities
    e, f = minus(x[1], x[0]), minus(x[2], x[0])
    size = math.sqrt(dot(e, e))
    i = tuple(q / size for q in e)
    j = cross(now, i)
    a, b, c, d = dot(e, i), dot(f, i), dot(e, j), dot(f, j)
    det = a * d - b * c
    p, q = minus(v[1], v[0]), minus(v[2], v[0])
    by_i = tuple((d * p[k] - c * q[k]) / det for k in range(3))
    by_j = tuple((a * q[k] - b * p[k]) / det for k in range(3))
    return plus(tilt, now, 0.5 * (dot(by_i, j) - dot(by_j, i)))


def run(spheres, triangles, vertex, steps, dt, kn, gn, gt, mu, gravity):
    """States (x, v, omega) of spheres (x, v, omega, radius, mass) after the steps. triangles: corners at the beginning;
    vertex(x, t): where a corner that was at x is then, and its velocity."""
    state = [[list(s[0]), list(s[1]), list(s[2])] for s in spheres]
    for step in range(steps):
        moved = [[vertex(p, step * dt) for p in t] for t in triangles]
        for (x, v, w), (_, _, _, radius, mass) in zip(state, spheres):
            found = None
            for t in moved:
                corner = [p for p, _ in t]
                if min(abs(p[0] - x[0]) for p in corner) > 2.0:
                    continue
                shares = nearest(x, *corner)
                point = tuple(sum(shares[n] * corner[n][k] for n in range(3)) for k in range(3))
                away = minus(x, point)
                gap = math.sqrt(dot(away, away))
                if found is None or gap < found[0] - 1e-12:
                    found = (gap, point, away, shares, t)
            force, torque = (0.0, 0.0, -mass * gravity), (0.0, 0.0, 0.0)
            if found and found[0] < radius:
                gap, point, away, shares, t = found
                n = tuple(a / gap for a in away)
                omega = turning([p for p, _ in t], [u for _, u in t])
                surface = tuple(sum(shares[m] * t[m][1][k] for m in range(3)) for k in range(3))
                seen = minus(v, plus(surface, cross(omega, away)))
                spin = minus(w, omega)
                speed = dot(seen, n)
                slip = minus(plus(seen, n, -speed), cross(tuple(radius * q for q in spin), n))
                pressed = kn * (radius - gap) - mass * gn * speed
                drag = tuple(-mass * gt * q for q in slip)
                size, limit = math.sqrt(dot(drag, drag)), mu * abs(pressed)
                if size > limit:
                    drag = tuple(limit / size * q for q in drag)
                force = plus(plus(force, n, pressed), drag)
                torque = tuple(-radius * q for q in cross(n, drag))
            for k in range(3):
                v[k] += dt * force[k] / mass
                w[k] += dt * torque[k] / (0.4 * mass * radius * radius)
                x[k] += dt * v[k]
    return state
