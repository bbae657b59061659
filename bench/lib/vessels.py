# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Vessels of triangles for beds, as STL files."""

import math
import os
import sys

import machine

sys.path.append(os.path.join(machine.ROOT, "tests", "lib"))
import body_meshes


def write(path, triangles, binary=False):
    """Returns the number of triangles."""
    body_meshes.write_stl(path, triangles, binary)
    return len(triangles)


def wall(low, high, axis, place, inward, cells):
    """The rectangle low ... high perpendicular to `axis` at `place`; inward: +1 or -1, where its normal points."""
    u, v = (axis + 1) % 3, (axis + 2) % 3

    def at(i, j):
        p = [place, place, place]
        for k, n, cell in ((u, i, cells[u]), (v, j, cells[v])):
            p[k] = high[k] if n == cell else low[k] + (high[k] - low[k]) * n / cell
        return tuple(p)

    found = body_meshes.grid(at, cells[u], cells[v])
    return found if inward > 0 else [(a, c, b) for a, b, c in found]


def bed(box, count):
    """Floor at z = 0 and four walls of a bed by beds.bed(), open above, about `count` triangles."""
    low, high = [b[0] for b in box], [b[1] for b in box]
    low[2] = 0.0
    x, y, z = (b - a for a, b in zip(low, high))
    cell = math.sqrt(2 * (x * y + 2 * (x + y) * z) / count)
    cells = [max(1, round(s / cell)) for s in (x, y, z)]
    found = wall(low, high, 2, 0.0, 1, cells)
    for axis in (0, 1):
        found += wall(low, high, axis, low[axis], 1, cells) + wall(low, high, axis, high[axis], -1, cells)
    return found


def plate(box, count):
    """About `count` triangles of a plate far above the bed."""
    if not count:
        return []
    low, high = [b[0] for b in box], [b[1] for b in box]
    n = max(1, round(math.sqrt(count / 2)))
    return wall(low, high, 2, high[2] + 10 * (high[2] - low[2]), -1, [n, n, n])


def closed(size, n):
    """A closed box from the origin, 12 n^2 triangles, normals inward."""
    return body_meshes.box((0.0, 0.0, 0.0), size, n, inward=True)
