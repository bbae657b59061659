# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Settled beds of spheres and convex bodies, and the scripts that run them.

A bed is made once, by Talus: bodies on a lattice fall with random orientations, periodic in x and y, on a floor, and the
result is kept as rows (type, diameter, center, quaternion) in the cache, for all codes. Unit of length: the edge of a cube
or about that; of mass: the cube's; gravity 10."""

import json
import math
import os

import beds
import lammps

ROUNDING = 0.05
DT, GRAVITY = 2.0e-4, 10.0
K, GN, MU = 1.0e5, 60.0, 0.5
LAW = f"hooke {K} {GN} tangential multistep NULL NULL {MU}"
FRICTIONLESS = f"hooke {K} {GN}"
STOCK = f"hooke/history {K} NULL {GN} NULL {MU} 1"
FALL, REST = 5.0, 500       # time of the fall; steps before a measurement


class Body:
    """A polyhedron: corners of its core, and faces counterclockwise from outside."""

    def __init__(self, corners, rounding=ROUNDING):
        self.corners, self.rounding = corners, rounding

    def words(self):
        flat = " ".join(repr(c) for corner in self.corners for c in corner)
        return f"vertices {len(self.corners)} {flat} rounded {self.rounding} density 1"

    def faces(self):
        """Corners of each plane that has all others behind it."""
        found, x = {}, self.corners
        for i in range(len(x)):
            for j in range(i):
                for k in range(j):
                    n = cross(less(x[j], x[i]), less(x[k], x[i]))
                    side = [dot(n, less(p, x[i])) for p in x]
                    if max(side) > 1e-9 and min(side) < -1e-9:
                        continue
                    sign = 1.0 if max(side) <= 1e-9 else -1.0
                    on = tuple(p for p, s in enumerate(side) if abs(s) <= 1e-9)
                    found[on] = ordered(on, x, tuple(sign * c for c in n))
        return list(found.values())


class Round:
    """A superellipsoid with the volume of the cube, or about that."""

    def __init__(self, half, n1=2.0, n2=2.0):
        self.half, self.n1, self.n2 = half, n1, n2

    def words(self):
        return f"superellipsoid {' '.join(map(repr, self.half))} {self.n1} {self.n2} density 1"


def less(a, b):
    return tuple(p - q for p, q in zip(a, b))


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def ordered(on, x, normal):
    middle = tuple(sum(x[p][d] for p in on) / len(on) for d in range(3))
    first = less(x[on[0]], middle)
    across = cross(normal, first)
    return sorted(on, key=lambda p: math.atan2(dot(across, less(x[p], middle)) / math.sqrt(dot(across, across)),
                                               dot(first, less(x[p], middle)) / math.sqrt(dot(first, first))))


def cube():
    h = 0.5 - ROUNDING
    return Body([(a * h, b * h, c * h) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)])


def dodecahedron():
    """As large as the cube, nearly."""
    phi, s = 0.5 * (1 + math.sqrt(5)), 0.36
    corners = [(a * s, b * s, c * s) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)]
    for a in (-1, 1):
        for b in (-1, 1):
            p, q = a * s / phi, b * s * phi
            corners += [(0.0, p, q), (p, q, 0.0), (q, 0.0, p)]
    return Body(corners)


def tetrahedron():
    s = 0.45
    return Body([(s, s, s), (s, -s, -s), (-s, s, -s), (-s, -s, s)])


BODIES = {"cubes": [cube()], "dodecahedra": [dodecahedron()], "tetrahedra": [tetrahedron()],
          "mixed": [cube(), dodecahedron(), None], "spheres": [None],
          "ellipsoids": [Round((0.75, 0.64, 0.5))], "superellipsoids": [Round((0.6, 0.55, 0.5), 4.0, 4.0)]}
SPHERE = 1.24       # diameter: the volume of the cube
SPACING = 1.75


def shape_words(kind, orient=""):
    return " ".join(f"type {k} {body.words()}{orient}" for k, body in enumerate(BODIES[kind], 1) if body)


def movers(kind, orient=""):
    """fix commands that move all bodies."""
    words, text = shape_words(kind, orient), ""
    spheres = [str(k) for k, body in enumerate(BODIES[kind], 1) if not body]
    if spheres:
        text += f"group balls type {' '.join(spheres)}\nfix balls balls nve/sphere/symplectic\n"
    if words:
        text += f"fix shapes all shape/gran {words}\n" if not spheres else \
            f"group bodies subtract all balls\nfix shapes bodies shape/gran {words}\n"
    return text


def head(style="sphere", newton="off"):
    return (f"units lj\nnewton {newton}\natom_style {style}\natom_modify map array\ncomm_modify vel yes\nboundary p p f\n")


def tail(warm, steps, more=""):
    return (f"neighbor 0.15 bin\nneigh_modify every 1 delay 0 check yes\ntimestep {DT}\nthermo 1000000\n"
            f"thermo_modify norm no lost error\n{more}run {warm}\nrun {steps}\n")


def physics(kind, law, orient=""):
    return (f"pair_style gran/penalty\npair_coeff * * {law}\n{movers(kind, orient)}"
            f"fix g all gravity/talus {GRAVITY} vector 0 0 -1\nfix floor all large/body plane 0 0 0 0 0 1 contact {law}\n")


# ---- beds -------------------------------------------------------------------------------------

def settled(bench, kind, across, layers, law=LAW, name=""):
    """(box, rows (type, diameter, x, y, z, quaternion)) of across^2 * layers bodies."""
    path = beds.cache_path(f"shapes-{kind}{name}-{across}-{layers}").replace(".data", ".json")
    if not os.path.exists(path):
        bench.note(f"settling {across**2 * layers} {kind}{name.replace('-', ', ')}, once")
        with open(path + ".new", "w") as file:
            json.dump(settle(bench, kind, across, layers, law), file)
        os.replace(path + ".new", path)
    with open(path) as file:
        return json.load(file)


def settle(bench, kind, across, layers, law):
    width, types = SPACING * across, len(BODIES[kind])
    box = (0.0, width), (0.0, width), (0.0, SPACING * (layers + 1))
    rows = []
    for k in range(across**2 * layers):
        site = k % across, k // across % across, k // across**2
        rows.append((k + 1, k % types + 1, SPHERE, 1.0, *(SPACING * (s + 0.5) for s in site)))
    lammps.write_data(bench.path("loose.data"), box, rows, types=types)
    shaped = any(BODIES[kind])
    columns = "id type diameter x y z" + (" f_shapes[1] f_shapes[2] f_shapes[3] f_shapes[4]" if shaped else "")
    lammps.run(bench.workdir, "settle", head() + "read_data loose.data\n" + physics(kind, law, " orient random 4711")
               + tail(0, int(FALL / DT)) + f"write_dump all custom settled {columns} modify format float %.17g\n")
    frame = lammps.read_frames(bench.path("settled"))[-1][1]
    quaternion = [frame[f"f_shapes[{k}]"] for k in range(1, 5)] if shaped else [[1.0] * len(rows)] + [[0.0] * len(rows)] * 3
    names = "type", "diameter", "x", "y", "z"
    return box, [list(row) for row in zip(*(frame[name] for name in names), *quaternion)]


def tiled(bed, times):
    """The bed beside itself, times x times."""
    (x, y, z), rows = bed
    size_x, size_y = x[1] - x[0], y[1] - y[0]
    found = [[*row[:2], row[2] + i * size_x, row[3] + j * size_y, *row[4:]]
             for i in range(times) for j in range(times) for row in rows]
    return ((x[0], x[0] + times * size_x), (y[0], y[0] + times * size_y), z), found


def talus_script(bench, kind, bed, warm, steps, law=LAW, more=""):
    box, rows = bed
    lammps.write_data(bench.path(f"{kind}.data"), box,
                      [(k, int(row[0]), row[1], 1.0, *row[2:5]) for k, row in enumerate(rows, 1)], types=len(BODIES[kind]))
    turns = "".join(f"fix_modify shapes orient {k} {' '.join(repr(q) for q in row[5:])}\n"
                    for k, row in enumerate(rows, 1) if BODIES[kind][int(row[0]) - 1])
    return head() + f"read_data {kind}.data\n" + physics(kind, law) + turns + tail(warm, steps, more)


# ---- the same with pair body/rounded/polyhedron -------------------------------------------------

def rotation(q):
    w, x, y, z = q
    return ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))


def parts(body):
    """Edges, and faces of at most four corners each, which are all that it takes."""
    faces = []
    for face in body.faces():
        while len(face) > 4:
            faces.append([face[0], *face[1:4]])
            face = [face[0], *face[3:]]
        faces.append(face)
    edges = {tuple(sorted((face[k - 1], face[k]))) for face in faces for k in range(len(face))}
    return sorted(edges), faces


def stock_script(bench, kind, bed, warm, steps, mass, moment):
    """All bodies alike, with equal moments of inertia."""
    body, = BODIES[kind]
    (x, y, z), rows = bed
    edges, faces = parts(body)
    count = 6 + 3 * len(body.corners) + 2 * len(edges) + 4 * len(faces) + 1
    lines = [f"bodies\n\n{len(rows)} atoms\n{len(rows)} bodies\n1 atom types\n"]
    lines += [f"{low!r} {high!r} {axis}lo {axis}hi" for axis, (low, high) in zip("xyz", (x, y, z))]
    lines.append("\nAtoms\n")
    lines += [f"{k} 1 1 {mass!r} " + " ".join(repr(c) for c in row[2:5]) for k, row in enumerate(rows, 1)]
    lines.append("\nBodies\n")
    connections = [c for edge in edges for c in edge] + [c for face in faces for c in [*face, -1][:4]]
    for k, row in enumerate(rows, 1):
        turn = rotation(row[5:])
        values = [moment] * 3 + [0.0] * 3 + [dot(line, corner) for corner in body.corners for line in turn]
        values += [*connections, 2 * body.rounding]
        assert len(values) == count
        # lines may be neither long nor many
        lines += [f"{k} 3 {count}", f"{len(body.corners)} {len(edges)} {len(faces)}"]
        lines += [" ".join("%.12g" % v for v in values[n:n + 12]) for n in range(0, count, 12)]
    with open(bench.path(f"{kind}.bodies"), "w") as file:
        file.write("\n".join(lines) + "\n")
    damping = 0.5 * GN * mass       # force over velocity; ours is for each unit of effective mass
    most = max(len(body.corners), len(edges), len(faces))       # else its memory is too small
    return (head(f"body rounded/polyhedron {len(body.corners)} {most}", "on") + f"read_data {kind}.bodies\n"
            f"pair_style body/rounded/polyhedron {damping} {damping} {MU} 1.0 0.0\npair_coeff * * {K} 0.0\n"
            f"fix move all nve/body\nfix g all gravity {GRAVITY} vector 0 0 -1\n"
            f"fix floor all wall/body/polyhedron {K} {damping} {damping} zplane 0.0 NULL\n" + tail(warm, steps))


# ---- superellipsoids with the style of LAMMPS --------------------------------------------------

def superellipsoid_script(bench, kind, bed, warm, steps):
    """pair granular/superellipsoid, for which there is no floor: the lowest bodies stay where they are."""
    body, = BODIES[kind]
    (x, y, z), rows = bed
    lines = [f"superellipsoids\n\n{len(rows)} atoms\n{len(rows)} ellipsoids\n1 atom types\n"]
    lines += [f"{low!r} {high!r} {axis}lo {axis}hi" for axis, (low, high) in zip("xyz", (x, y, z))]
    lines.append("\nAtoms\n")
    lines += [f"{k} 1 1 1.0 " + " ".join(repr(c) for c in row[2:5]) for k, row in enumerate(rows, 1)]
    lines.append("\nEllipsoids\n")
    lines += [f"{k} " + " ".join(repr(v) for v in (*(2 * h for h in body.half), *row[5:], body.n1, body.n2))
              for k, row in enumerate(rows, 1)]
    with open(bench.path(f"{kind}.asphere"), "w") as file:
        file.write("\n".join(lines) + "\n")
    return (head("ellipsoid superellipsoid", "off") + f"read_data {kind}.asphere\n"
            "pair_style granular/superellipsoid\n"
            f"pair_coeff * * hooke {K} {GN} tangential linear_history {K * 2 / 7} 1.0 {MU} damping mass_velocity\n"
            f"region low block INF INF INF INF INF {max(body.half)}\ngroup low region low\ngroup rest subtract all low\n"
            f"fix move rest nve/asphere\nfix g rest gravity {GRAVITY} vector 0 0 -1\n" + tail(warm, steps))
