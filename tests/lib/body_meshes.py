# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Triangle meshes for scenes with large bodies: lists of triangles, and STL files of them."""

import math
import struct


def write_stl(path, triangles, binary=False):
    """Writes triangles ((x, y, z), ) * 3.  ASCII keeps every bit of the coordinates."""
    if binary:
        with open(path, "wb") as file:
            file.write(b"Talus".ljust(80) + struct.pack("<I", len(triangles)))
            for t in triangles:
                file.write(struct.pack("<12f", 0, 0, 0, *(c for corner in t for c in corner)))
                file.write(b"\0\0")
        return
    with open(path, "w") as file:
        file.write("solid talus\n")
        for t in triangles:
            file.write("facet normal 0 0 0\nouter loop\n")
            for corner in t:
                file.write("vertex " + " ".join(map(repr, map(float, corner))) + "\n")
            file.write("endloop\nendfacet\n")
        file.write("endsolid talus\n")


def grid(at, nu, nv):
    """Triangles of the surface at(i, j), i = 0 ... nu, j = 0 ... nv, with normals along d/di x d/dj."""
    found = []
    for i in range(nu):
        for j in range(nv):
            a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
            found += [(a, b, c), (a, c, d)] if (i + j) % 2 else [(a, b, d), (b, c, d)]
    return [t for t in found if len(set(t)) == 3]


def box(low, high, n, inward=False):
    """A closed box, n x n squares on each side."""
    def at(axis, side, i, j):
        p = [0.0, 0.0, 0.0]
        u, v = (axis + 1) % 3, (axis + 2) % 3
        p[axis] = high[axis] if side else low[axis]
        p[u] = high[u] if i == n else low[u] + (high[u] - low[u]) * i / n
        p[v] = high[v] if j == n else low[v] + (high[v] - low[v]) * j / n
        return tuple(p)

    found = []
    for axis in range(3):
        for side in (0, 1):
            some = grid(lambda i, j: at(axis, side, i, j), n, n)
            found += some if (side == 1) != inward else [(a, c, b) for a, b, c in some]
    return found


def sphere(center, radius, n):
    """A closed sphere of n rings, normals outward."""
    def at(i, j):
        if i in (0, n):
            return (center[0], center[1], center[2] + (radius if i == 0 else -radius))
        a, b = math.pi * i / n, 2 * math.pi * (j % (2 * n)) / (2 * n)
        return (center[0] + radius * math.sin(a) * math.cos(b),
                center[1] + radius * math.sin(a) * math.sin(b), center[2] + radius * math.cos(a))

    return grid(at, n, 2 * n)


def tube(radius, low, high, n, inward=True, caps=True):
    """A cylinder about the y axis of n facets, closed by caps."""
    def ring(j, y):
        a = 2 * math.pi * (j % n) / n
        return (radius * math.sin(a), y, radius * math.cos(a))

    found = grid(lambda i, j: ring(j, low if i == 0 else high), 1, n)
    if caps:
        for j in range(n):
            found.append(((0.0, low, 0.0), ring(j + 1, low), ring(j, low)))
            found.append(((0.0, high, 0.0), ring(j, high), ring(j + 1, high)))
    # found with normals outward on the mantle? made sure of by the sign of the volume
    volume = sum(a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                 a[2] * (b[0] * c[1] - b[1] * c[0]) for a, b, c in found)
    return [(a, c, b) for a, b, c in found] if (volume > 0) == inward else found
