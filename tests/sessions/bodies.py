# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Large bodies and walls drawn at random so that some of the grains touch them a little."""

import math

import body_meshes
from quantities import along, axis, direction, displacement, duration, length, line, number, place, spin, velocity
from scene import Mesh
from vectors import cross, dot

AXES = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def plus(a, factor, b):
    return tuple(x + factor * y for x, y in zip(a, b))


def unit(v):
    size = math.sqrt(dot(v, v))
    return tuple(x / size for x in v)


def random_direction(rng):
    while True:
        v = tuple(rng.uniform(-1, 1) for _ in range(3))
        if 0.1 < dot(v, v) < 1.0:
            return unit(v)


def random_turn(rng):
    """A quaternion w x y z."""
    q = [rng.gauss(0, 1) for _ in range(4)]
    size = math.sqrt(sum(x * x for x in q))
    return tuple(x / size for x in q)


def across(n):
    """A unit vector that is perpendicular to it."""
    return unit(cross(n, min(AXES, key=lambda e: abs(dot(e, n)))))


class Cluster:
    """Where the grains are: spheres, as (place, radius)."""

    def __init__(self, grains):
        self.spheres = [(grain.place.values, grain.diameter.values[0] / 2) for grain in grains]
        count = len(self.spheres)
        self.center = tuple(sum(x[k] for x, _ in self.spheres) / count for k in range(3))
        self.size = max(math.dist(x, self.center) + r for x, r in self.spheres)

    def below(self, n, overlap):
        """The point of a plane with the normal n that the extreme grain touches, so deep."""
        x, r = min(self.spheres, key=lambda sphere: dot(sphere[0], n) - sphere[1])
        return plus(x, overlap - r, n)


def _depth(rng):
    return rng.choice((0.002, 0.01, 0.03))


def floor_mesh(rng, p, n, size, name, slivers=False):
    """A flat square with the center p: of two triangles, of many, or of slivers."""
    u = across(n)
    v = cross(n, u)
    cuts = rng.choice((1, 2, 5))
    steps = [k / cuts for k in range(cuts + 1)]
    if slivers:
        steps = [0.0, 0.5, 0.5 + 1e-3 * rng.random(), 0.5 + 2e-3, 1.0]
    grid = body_meshes.grid(lambda i, j: plus(plus(p, size * (steps[i] - 0.5), u), size * (j / cuts - 0.5), v), len(steps) - 1, cuts)
    return Mesh(name, tuple(grid))


def flat(rng, cluster, name, kinds=("plane", "rectangle", "mesh", "region")):
    """A surface below all, with any normal: words of the shape, meshes, traits."""
    n = random_direction(rng)
    p = cluster.below(n, _depth(rng))
    size = 6 * cluster.size
    kind = rng.choice(kinds)
    if kind == "plane":
        return line("plane", place(p), direction(n)), (), ()
    if kind == "rectangle":
        return line("rectangle", place(p), direction(n), direction(across(n)), length(size), length(size)), (), ()
    if kind == "mesh":
        mesh = floor_mesh(rng, p, n, size, f"{name}.stl", rng.random() < 0.3)
        return line("mesh", mesh.name), (mesh,), ("mesh",)
    return line("region", f"of_{name}"), (), ("region", line("region", f"of_{name}", "plane", place(p), direction(n), "units box"))


def flat_for_shapes(rng, cluster, name):
    return flat(rng, cluster, name, ("plane", "rectangle", "mesh"))


def around(rng, cluster, name):
    """A vessel that holds all."""
    kind = rng.choice(("sphere", "cylinder", "box", "mesh"))
    c, depth = cluster.center, _depth(rng)
    if kind == "sphere":
        return line("sphere", place(c), length(cluster.size - depth), "inside"), (), ()
    if kind == "cylinder":
        a = random_direction(rng)
        far = max(math.sqrt(max(0.0, math.dist(x, c)**2 - dot(plus(x, -1, c), a)**2)) + r for x, r in cluster.spheres)
        return line("cylinder", place(c), direction(a), length(far - depth), length(6 * cluster.size), "inside"), (), ()
    half = [max(abs(x[k] - c[k]) + r for x, r in cluster.spheres) - depth for k in range(3)]
    if kind == "box":
        return line("box", place(c), *[length(2 * h) for h in half], "inside"), (), ("box",)
    low, high = (tuple(x + s * h for x, h in zip(c, half)) for s in (-1, 1))
    mesh = Mesh(f"{name}.stl", tuple(body_meshes.box(low, high, rng.choice((1, 3)), inward=True)))
    return line("mesh", mesh.name), (mesh,), ("mesh",)


def beside(rng, cluster, name):
    """A small solid that pokes at the grains from outside."""
    kind = rng.choice(("sphere", "cylinder", "cone", "box", "mesh ball", "mesh box"))
    n = rng.choice(AXES) if "box" in kind else random_direction(rng)
    r = rng.uniform(0.3, 1.2)
    p = cluster.below(n, rng.choice((0.002, 0.02)))
    c = plus(p, -r, n)
    if kind == "sphere":
        return line("sphere", place(c), length(r), "outside"), (), ()
    if kind == "cylinder":
        return line("cylinder", place(c), direction(across(n)), length(r), length(rng.uniform(0.5, 3)), "outside"), (), ()
    if kind == "cone":
        return line("cone", place(c), direction(across(n)), length(r), length(0.6 * r), length(rng.uniform(0.5, 3)), "outside"), (), ()
    if kind == "box":
        sizes = [2 * r if abs(n[k]) > 0.5 else rng.uniform(0.5, 2) for k in range(3)]
        return line("box", place(c), *map(length, sizes), "outside"), (), ("box",)
    if kind == "mesh ball":
        mesh = Mesh(f"{name}.stl", tuple(body_meshes.sphere(c, r, rng.choice((4, 7)))))
    else:
        low, high = plus(c, -r, (1, 1, 1)), plus(c, r, (1, 1, 1))
        mesh = Mesh(f"{name}.stl", tuple(body_meshes.box(low, high, rng.choice((1, 2)))))
    return line("mesh", mesh.name, "outside"), (mesh,), ("mesh",)


def motion(rng, cluster, kind):
    """Words behind the contact: how the body moves, gently."""
    c = place(cluster.center)
    some = rng.choice(("none", "none", "linear", "wiggle", "rotate", "free", "servo"))
    if some == "linear":
        return line("move linear", velocity(tuple(rng.uniform(-0.5, 0.5) for _ in range(3))))
    if some == "wiggle":
        return line("move wiggle", displacement(tuple(rng.uniform(-0.05, 0.05) for _ in range(3))), duration(rng.uniform(0.2, 1.0)))
    if some == "rotate" and kind != "region":
        return line("move rotate", c, axis(random_direction(rng)), duration(rng.uniform(5, 20)))
    if some == "free" and kind not in ("region", "plane"):
        more = line("velocity", velocity(tuple(rng.uniform(-1, 1) for _ in range(3)))) if rng.random() < 0.5 else ()
        if rng.random() < 0.5:
            more = line(more, "spin", spin(tuple(rng.uniform(-1, 1) for _ in range(3))))
        return line("move free mass", number(rng.uniform(2, 9), 0, 1, 0), "inertia", [number(j, 2, 1, 0) for j in _inertia(rng)],
                    "com", c, more)
    if some == "servo":
        return line("servo force", direction(random_direction(rng)), number(rng.uniform(1, 20), 1, 1, -2), number(0.5, 1, 0, -1))
    return ()


def _inertia(rng):
    a, b = rng.uniform(1, 2), rng.uniform(1, 2)
    return a, b, rng.uniform(max(a, b) - 0.5, a + b - 0.3)


def body(rng, cluster, name, law, moves=True, kinds=(flat, flat, around, beside)):
    """Lines of a large body, its meshes and traits."""
    surface, meshes, traits = rng.choice(kinds)(rng, cluster, name)
    before = tuple(trait for trait in traits if isinstance(trait, tuple))
    traits = {trait for trait in traits if isinstance(trait, str)}
    how = motion(rng, cluster, surface[0]) if moves else ()
    if how:
        traits.add("moving")
    if "inertia" in how:
        traits.add("inertia")
    if surface[0] == "box":
        traits.add("axes")
    return (*before, line("fix", name, "all large/body", surface, "contact", law, how)), meshes, traits


# ---- walls of LAMMPS ----------------------------------------------------------------------------

def wall(rng, cluster, name, words):
    """A line of fix wall/gran or wall/gran/region, its lines before; words: of the contact."""
    kind = rng.choice(("plane", "plane", "planes", "cylinder", "block", "ball", "shear", "wiggle"))
    k = rng.randrange(3)
    low = [min(x[j] - r for x, r in cluster.spheres) + _depth(rng) for j in range(3)]
    high = [max(x[j] + r for x, r in cluster.spheres) - _depth(rng) for j in range(3)]
    begin = line("fix", name, "all wall/gran", words)
    if kind == "cylinder":
        far = max(math.hypot(x[0], x[1]) + r for x, r in cluster.spheres)
        return (line(begin, "zcylinder", length(far - _depth(rng))),)
    if kind == "block":
        bounds = [(along(j, low[j]), along(j, high[j])) for j in range(3)]
        region = line("region", f"of_{name} block", bounds, "units box")
    elif kind == "ball":
        region = line("region", f"of_{name} sphere", place(cluster.center), length(cluster.size - _depth(rng)), "units box")
    else:
        region = ()
    if region:
        return region, line("fix", name, "all wall/gran/region", words, "region", f"of_{name}")
    upper = along(k, high[k]) if kind == "planes" else "NULL"
    more = ()
    if kind == "shear":
        more = line("shear", "xyz"[(k + 1) % 3], number(rng.uniform(-1, 1), 1, 0, -1))
    elif kind == "wiggle":
        more = line("wiggle", "xyz"[k], length(0.05), duration(0.3))
    return (line(begin, "xyz"[k] + "plane", along(k, low[k]), upper, more),)
