#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Makes the STL files of the scenes, in units of their radius: drum, hopper, wheel; and stones.  Run in this folder."""

import math
import random
import struct


def write_stl(path, triangles):
    with open(path, "wb") as file:
        file.write(b"made by make_meshes.py".ljust(80) + struct.pack("<I", len(triangles)))
        for corners in triangles:
            file.write(struct.pack("<12f", 0, 0, 0, *(c for corner in corners for c in corner)))
            file.write(b"\0\0")


def turned(profile, sectors, axis="z", inward=True, first=0, last=None):
    """Surface of revolution of a list of (radius, height): normals to the left of its way, if inward. With first and
    last only these of the sectors."""
    def at(k, j):
        r, h = profile[k]
        a = 2 * math.pi * (j % sectors) / sectors
        p = (r * math.cos(a), r * math.sin(a), h)
        return p if axis == "z" else (p[1], p[2], p[0])

    found = []
    for k in range(len(profile) - 1):
        for j in range(first, sectors if last is None else last):
            a, b, c, d = at(k, j), at(k, j + 1), at(k + 1, j + 1), at(k + 1, j)
            found += [(a, c, b), (a, d, c)] if inward else [(a, b, c), (a, c, d)]
    return [t for t in found if len(set(t)) == 3]


def lifter(angle, low, high, width, half):
    """A bar along the y axis on a cylinder, from radius low to high: closed, normals outward."""
    c, s = math.cos(angle), math.sin(angle)

    def at(r, t, y):
        return (r * s + t * c, y, r * c - t * s)

    corners = [at(r, t, y) for r in (low, high) for t in (-width, width) for y in (-half, half)]
    quads = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    found = []
    for a, b, c2, d in quads:
        found += [(corners[a], corners[b], corners[c2]), (corners[a], corners[c2], corners[d])]
    middle = tuple(sum(p[k] for p in corners) / 8 for k in range(3))

    def outward(t):
        u, v = ([t[n][k] - t[0][k] for k in range(3)] for n in (1, 2))
        normal = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        return t if sum(normal[k] * (t[0][k] - middle[k]) for k in range(3)) > 0 else t[::-1]

    return [outward(t) for t in found]


def wheel(half_width):
    """Axis y, radius 0.9, sixteen grousers up to radius 1; closed."""
    found = turned([(0.0, -half_width), (0.9, -half_width), (0.9, half_width), (0.0, half_width)], 64, "y", inward=False)
    for k in range(16):
        found += lifter(2 * math.pi * k / 16, 0.85, 1.0, 0.02, half_width)
    return found


# stones of the scene gravel: corners on ellipsoids, each of which is one of the hull; sizes about 1 across
def stone(seed, corners, half):
    draw = random.Random(seed)
    found = []
    while len(found) < corners:
        p = [draw.gauss(0, 1) for _ in range(3)]
        n = math.sqrt(sum(c * c for c in p))
        p = [c / n for c in p]
        if all(sum(a * b for a, b in zip(p, q)) < 0.75 for q in found):
            found.append(p)
    return [[h * c for h, c in zip(half, p)] for p in found]


def make_bodies():
    # axis y, radius 1, length 0.6, four lifters; closed
    drum = turned([(0.0, -0.3), (1.0, -0.3), (1.0, 0.3), (0.0, 0.3)], 64, "y")
    view = turned([(1.0, -0.3), (1.0, 0.3), (0.0, 0.3)], 64, "y")    # for pictures: one end plate left out
    for k in range(4):
        bar = lifter(0.5 * math.pi * k, 0.9, 1.05, 0.03, 0.3)
        drum += bar
        view += bar
    write_stl("drum.stl", drum)
    write_stl("drum_view.stl", view)

    # axis z: outlet of radius 0.3 at height 0, cone of 60 degrees up to radius 1, then straight; open
    height = 0.7 * math.tan(math.radians(60))
    profile = [(0.3, 0.0), (1.0, height), (1.0, height + 1.5)]
    write_stl("hopper.stl", turned(profile, 64))
    write_stl("hopper_view.stl", turned(profile, 64, first=0, last=32))    # for pictures: the half with y > 0

    write_stl("wheel.stl", wheel(0.4))


def make_stones():
    with open("../include.stones", "w") as file:
        file.write("# Made by meshes/make_meshes.py: convex stones about 1 across, for fix shape/gran.\n\n")
        for k, (corners, half) in enumerate(((8, (0.5, 0.45, 0.4)), (10, (0.5, 0.4, 0.3)), (12, (0.45, 0.45, 0.45)),
                                             (14, (0.55, 0.4, 0.35))), start=1):
            file.write(f"variable        stone{k} string \"vertices {corners}")
            for p in stone(k, corners, half):
                file.write(" &\n                " + " ".join(f"{c:.4f}" for c in p))
            file.write("\"\n")


if __name__ == "__main__":
    make_bodies()
    make_stones()
