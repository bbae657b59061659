# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Errors of states against a reference, fitted orders, and the time step for a given error."""

import math

import scenes

QUANTITIES = ("position", "velocity", "spin", "energy", "force")
TARGETS = (1e-2, 1e-3, 1e-4)


def _largest(rows, others):
    return max(math.dist(a, b) for a, b in zip(rows, others))


def of(scene, states, reference):
    """{quantity: error}, each relative to its scale: way during a contact, impact velocity, impact velocity
    over radius, initial kinetic energy; force in the middle of the scene, to the largest there."""
    middle, end = states
    exact_middle, exact_end = reference
    start = sum(0.5 * scenes.MASS * sum(c * c for c in v) + 0.5 * scenes.INERTIA * sum(c * c for c in w)
                for v, w in zip(scene.velocities, scene.spins))
    force = max(math.hypot(*f) for f in exact_middle.f) or 1.0
    return {"position": _largest(end.x, exact_end.x) / scene.length(),
            "velocity": _largest(end.v, exact_end.v) / scenes.SPEED,
            "spin": _largest(end.w, exact_end.w) * scenes.R / scenes.SPEED,
            "energy": abs(end.kinetic() - exact_end.kinetic()) / start,
            "force": _largest(middle.f, exact_middle.f) / force}


def motion(errors):
    """The one number for a run: its largest error of position, velocity and spin."""
    return max(errors["position"], errors["velocity"], errors["spin"])


def order(steps, errors, floor=1e-11):
    """Slope of log error over log dt, least squares over the finer half that is above rounding; or None."""
    points = [(math.log(h), math.log(e)) for h, e in zip(steps, errors) if e > floor]
    points = sorted(points)[:max(4, len(points) // 2 + 1)]
    if len(points) < 3:
        return None
    mx, my = (sum(p[k] for p in points) / len(points) for k in (0, 1))
    return sum((x - mx) * (y - my) for x, y in points) / sum((x - mx)**2 for x, _ in points)


def step_for(target, steps, errors):
    """Largest time step from which on all smaller ones have at most the error `target`, by
    interpolation between the two beside it; None if the finest is not good enough."""
    found = None
    for k, (h, e) in sorted(enumerate(zip(steps, errors)), key=lambda item: item[1][0]):
        if not e <= target:
            if found is None:
                return None
            h0, e0 = steps[found], errors[found]
            if e0 <= 0 or math.isinf(e):
                return h0
            part = math.log(target / e0) / math.log(e / e0)
            return h0 * (h / h0)**min(1.0, max(0.0, part))
        found = k
    return steps[found]
