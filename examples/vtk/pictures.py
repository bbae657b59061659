#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Runs in.impact with a LAMMPS that has Talus, and draws what dump vtk/gran has written of its last step.

usage: pictures.py LMP [FOLDER]     e.g. examples/vtk/pictures.py build/lmp doc

Leaves vtk_grains.png, vtk_contacts.png and vtk_bodies.png in FOLDER (default: here). Needs nothing but Python: the
reader is that of the tests, the pictures are made pixel by pixel."""

import math
import os
import struct
import subprocess
import sys
import tempfile
import zlib

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "tests", "lib"))
import body_meshes
from vtk_files import read_part, read_series

WIDTH, HEIGHT = 720, 400
LIGHT = (-0.4, -0.7, 0.6)
STOPS = [(0.0, (40, 50, 120)), (0.25, (50, 130, 170)), (0.5, (120, 190, 120)), (0.75, (245, 200, 80)), (1.0, (200, 40, 40))]


def color(share):
    share = min(1.0, max(0.0, share))
    for (a, low), (b, high) in zip(STOPS, STOPS[1:]):
        if share <= b:
            t = (share - a) / (b - a)
            return tuple(p + t * (q - p) for p, q in zip(low, high))
    return STOPS[-1][1]


class Picture:
    """Seen along y; a pixel shows what is nearest."""

    def __init__(self, x=(0.0, 0.3), z=(-0.003, 0.162)):
        self.scale = min(WIDTH / (x[1] - x[0]), HEIGHT / (z[1] - z[0]))
        self.x0, self.z1 = x[0] - 0.5 * (WIDTH / self.scale - (x[1] - x[0])), z[1]
        self.depth = [math.inf] * (WIDTH * HEIGHT)
        self.pixels = bytearray(b"\xff" * (3 * WIDTH * HEIGHT))
        size = math.dist(LIGHT, (0, 0, 0))
        self.light = [c / size for c in LIGHT]

    def place(self, p):
        return (p[0] - self.x0) * self.scale, (self.z1 - p[2]) * self.scale, p[1] * self.scale

    def put(self, u, w, depth, rgb, normal=None):
        k = w * WIDTH + u
        if depth >= self.depth[k]:
            return
        self.depth[k] = depth
        shade = 1.0
        if normal:
            shade = 0.5 + 0.5 * max(0.0, sum(a * b for a, b in zip(normal, self.light)))
        self.pixels[3 * k:3 * k + 3] = bytes(int(max(0, min(255, c * shade))) for c in rgb)

    def sphere(self, center, radius, rgb):
        u0, w0, d0 = self.place(center)
        r = radius * self.scale
        for w in range(max(0, math.ceil(w0 - r)), min(HEIGHT, math.floor(w0 + r) + 1)):
            for u in range(max(0, math.ceil(u0 - r)), min(WIDTH, math.floor(u0 + r) + 1)):
                a, b = (u - u0) / r, (w - w0) / r
                c = 1.0 - a * a - b * b
                if c > 0.0:
                    c = math.sqrt(c)
                    self.put(u, w, d0 - c * r, rgb, (a, -c, -b))

    def line(self, p, q, radius, rgb):
        steps = max(1, int(math.dist(p, q) * self.scale / max(1.0, 0.5 * radius * self.scale)))
        for k in range(steps + 1):
            self.sphere([a + k / steps * (b - a) for a, b in zip(p, q)], radius, rgb)

    def triangle(self, corners, rgb):
        a, b, c = map(self.place, corners)
        e = [corners[1][d] - corners[0][d] for d in range(3)]
        f = [corners[2][d] - corners[0][d] for d in range(3)]
        n = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]]
        size = math.dist(n, (0, 0, 0))
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if size == 0.0 or area == 0.0:
            return
        n = [x / size * (1 if n[1] <= 0 else -1) for x in n]
        for w in range(max(0, math.floor(min(a[1], b[1], c[1]))), min(HEIGHT, math.ceil(max(a[1], b[1], c[1])) + 1)):
            for u in range(max(0, math.floor(min(a[0], b[0], c[0]))), min(WIDTH, math.ceil(max(a[0], b[0], c[0])) + 1)):
                s = ((b[0] - u) * (c[1] - w) - (b[1] - w) * (c[0] - u)) / area
                t = ((c[0] - u) * (a[1] - w) - (c[1] - w) * (a[0] - u)) / area
                if s >= -1e-9 and t >= -1e-9 and s + t <= 1 + 1e-9:
                    self.put(u, w, s * a[2] + t * b[2] + (1 - s - t) * c[2], rgb, n)

    def save(self, path):
        rows = b"".join(b"\0" + self.pixels[3 * WIDTH * w:3 * WIDTH * (w + 1)] for w in range(HEIGHT))

        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        with open(path, "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)) +
                       chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def rows(pieces, *names):
    for piece in pieces:
        yield from zip(piece.points, *(piece.point_data[name] for name in names))


def ball(parts, picture, value=None, behind=-math.inf):
    for piece in read_part(parts["body_ball"]):
        values = piece.cell_data["pressure"]
        top = sorted(values)[-max(1, len(values) // 200)] or 1.0
        for corners, pressure in zip(piece.cells["Polys"], values):
            triangle = [piece.points[k] for k in corners]
            if all(p[1] >= behind for p in triangle):
                shown = color(math.sqrt(pressure / top)) if value and pressure > 0.0 else (190, 190, 200)
                picture.triangle(triangle, shown)


def draw(parts, folder):
    grains = read_part(parts["grains"])
    speeds = sorted(math.dist(v, (0, 0, 0)) for _, v in rows(grains, "v"))
    fast = speeds[int(0.98 * len(speeds))]

    picture = Picture()
    for x, radius, v in rows(grains, "radius", "v"):
        if x[1] > 0.04:    # the rear half
            picture.sphere(x, radius, color(math.dist(v, (0, 0, 0)) / fast))
    ball(parts, picture, behind=0.04)
    picture.save(os.path.join(folder, "vtk_grains.png"))

    picture = Picture()
    contacts = read_part(parts["contacts"])
    forces = sorted(f for _, f in rows(contacts, "normal_force"))
    strong = forces[int(0.995 * len(forces))]
    for piece in contacts:
        for a, b in piece.cells["Lines"]:
            share = piece.point_data["normal_force"][a] / strong
            depth = 0.5 * (piece.points[a][1] + piece.points[b][1])
            if share > 0.02 and depth > 0.04 and math.dist(piece.points[a], piece.points[b]) < 0.02:
                picture.line(piece.points[a], piece.points[b], 0.0018 * math.sqrt(min(1.5, share)), color(math.sqrt(share)))
    ball(parts, picture, behind=0.04)
    picture.save(os.path.join(folder, "vtk_contacts.png"))

    picture = Picture(x=(0.08, 0.22), z=(0.08, 0.16))
    ball(parts, picture, value=True)
    picture.save(os.path.join(folder, "vtk_bodies.png"))


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    lmp, folder = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else HERE)
    with tempfile.TemporaryDirectory() as work:
        body_meshes.write_stl(os.path.join(work, "ball.stl"), body_meshes.sphere((0, 0, 0), 0.035, 12))
        subprocess.run([lmp, "-in", os.path.join(HERE, "in.impact"), "-log", "none"], cwd=work, check=True)
        draw(read_series(os.path.join(work, "film.pvd"))[-1][1], folder)


if __name__ == "__main__":
    main()
