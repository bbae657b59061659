# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Surfaces of the rover, from its model: a wheel, which grains touch, and all of it, for pictures."""

import math
import os
import sys
import xml.etree.ElementTree as xml

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "..", "input", "meshes"))
import make_meshes
from make_meshes import write_stl

MODEL = os.path.join(HERE, "rover.xml")


def numbers(element, name):
    return [float(word) for word in element.get(name, "0 0 0").split()]


def turn(q, v):
    """v turned by the quaternion w x y z."""
    w, x, y, z = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return (v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0])


def box(middle, half):
    corner = [tuple(m + s * h for m, s, h in zip(middle, signs, half))
              for signs in ((a, b, c) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1))]
    faces = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    return [(corner[a], corner[b], corner[c]) for face in faces for a, b, c in (face[:3], (face[0], *face[2:]))]


def beam(ends, radius, sectors=12):
    """A cylinder from end to end."""
    a, b = ends[:3], ends[3:]
    along = [q - p for p, q in zip(a, b)]
    size = math.dist(a, b)
    flat = [1.0, 0.0, 0.0] if abs(along[0]) < 0.9 * size else [0.0, 1.0, 0.0]
    u = [p - q * sum(m * n for m, n in zip(along, flat)) / size**2 for p, q in zip(flat, along)]
    u = [c / math.hypot(*u) for c in u]
    v = [(along[(k + 1) % 3] * u[(k + 2) % 3] - along[(k + 2) % 3] * u[(k + 1) % 3]) / size for k in range(3)]

    def ring(p):
        angles = [2 * math.pi * k / sectors for k in range(sectors)]
        return [tuple(p[k] + radius * (math.cos(t) * u[k] + math.sin(t) * v[k]) for k in range(3)) for t in angles]

    low, high, found = ring(a), ring(b), []
    for k in range(sectors):
        n = (k + 1) % sectors
        found += [(low[k], low[n], high[n]), (low[k], high[n], high[k]), (tuple(a), low[n], low[k]), (tuple(b), high[k], high[n])]
    return found


class Rover:
    """radius of the wheels over their grousers; surfaces of bodies, each in its own frame."""

    def __init__(self):
        model = xml.parse(MODEL).getroot()
        self.shapes = {one.get("class"): one.find("geom") for one in model.iter("default") if one.get("class")}
        self.bodies = {body.get("name"): body for body in model.iter("body")}
        self.inside = {part.get("name"): name for name, body in self.bodies.items() for part in body.findall("body")}
        self.wheels = [one.get("joint") for one in model.find("actuator")]    # bodies are called as their joints
        self.radius, self.half_width = numbers(self.shapes["wheel"], "size")

    def wheel(self):
        return [tuple(tuple(self.radius * c for c in corner) for corner in triangle)
                for triangle in make_meshes.wheel(self.half_width / self.radius)]

    def place(self, name):
        """Of a body of the model as it is written, from the first one."""
        x = [0.0, 0.0, 0.0]
        while name in self.inside:
            x = [a + b for a, b in zip(x, numbers(self.bodies[name], "pos"))]
            name = self.inside[name]
        return x

    def surface(self, name):
        found = []
        for geom in self.bodies[name].findall("geom"):
            kind = geom.get("class")
            if kind == "wheel":
                found += self.wheel()
            elif kind == "beam":
                found += beam(numbers(geom, "fromto"), numbers(self.shapes[kind], "size")[0])
            else:
                found += box(numbers(geom, "pos"), numbers(geom, "size"))
        return found

    def write_wheel(self, path):
        write_stl(path, self.wheel())

    def write_all(self, path, state_of):
        """In the place where state_of(body) says that they are."""
        found = []
        for name in self.bodies:
            state = state_of(name)
            found += [tuple(tuple(p + q for p, q in zip(state[:3], turn(state[3:7], corner))) for corner in triangle)
                      for triangle in self.surface(name)]
        write_stl(path, found)
