# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""One sphere and one body by the simplest program that can be: steps of first order, in the axes of space, for limits at
small time steps that the engine is compared with. It shares no code with it. The law is `hertz kn gn tangential multistep
NULL NULL mu slider limit_damping`, gravity acts along -z."""

import math

from vectors import cross, dot, length, plus, times


def run(sphere, surface, time, steps, kn, gn, mu, gravity=10.0):
    """State (position, velocity, angular velocity times radius: nine numbers) of a sphere at the end.

    surface(t, x): unit normal of the nearest point, distance of x from it, velocity of the surface there if it were a
    part of the body at x, angular velocity of the body."""
    x, v, w = sphere.x, sphere.v, sphere.omega
    radius = 0.5 * sphere.diameter
    mass = sphere.density * 4.0 / 3.0 * math.pi * radius**3
    inertia = 0.4 * mass * radius**2
    dt = time / steps
    d = None    # displacement of the surfaces
    for step in range(steps):
        n, height, of_body, turn = surface(step * dt, x)
        overlap = radius - height
        force, torque = (0.0, 0.0, -mass * gravity), (0.0, 0.0, 0.0)
        if overlap > 0.0:
            contact = math.sqrt(radius * overlap)
            kt, gt = 2.0 / 7.0 * kn * contact, 0.5 * gn * mass * contact
            seen, spin = plus(v, of_body, -1.0), plus(w, turn, -1.0)
            normal_speed = dot(seen, n)
            slip = plus(plus(seen, n, -normal_speed), cross(times(radius, spin), n), -1.0)
            pressed = max(contact * (kn * overlap - gn * mass * normal_speed), 0.0)
            before = plus(d, cross(turn, d), dt) if d else (0.0, 0.0, 0.0)
            flat = plus(before, n, -dot(before, n))
            before = times(length(before) / length(flat), flat) if length(flat) > 0.0 else flat
            d = plus(before, slip, dt)
            drag = plus(times(kt, d), slip, gt)
            limit = mu * pressed
            if length(drag) > limit:    # gt/kt d' + d = limit/kt along the force
                drag = times(limit / length(drag), drag)
                d = times(kt / (gt + kt * dt), plus(times(gt / kt, before), drag, dt / kt))
            force = plus(plus(force, n, pressed), drag, -1.0)
            torque = times(radius, cross(n, drag))
        else:
            d = None
        v = plus(v, force, dt / mass)
        w = plus(w, torque, dt / inertia)
        x = plus(x, v, dt)
    return x + v + times(radius, w)


def limit(sphere, surface, time, steps, **law):
    """What run() tends to, by its error of first order."""
    coarse, fine = (run(sphere, surface, time, n, **law) for n in (steps, 2 * steps))
    return [2.0 * b - a for a, b in zip(coarse, fine)]
