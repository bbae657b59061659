# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Relation: the same flat surface, told as plane, rectangle, box, region or mesh, with few triangles, many or slivers, acts alike on
a sphere, a clump or a particle with a shape, at any depth."""

import math

import bodies
import body_meshes
import changes
import laws
import scenes
from closeness import compare
from pool import OK, Session
from quantities import along, direction, length, line, number, place, spin, text, turned, velocity
from scene import Grain, Mesh, Scene, value

SIZE = 12.0    # of the surfaces that end
STEPS = 15


def kinds_of(particle, sharp, axes, shallow):
    """Names of surfaces that act alike on this particle."""
    found = ["plane", "rectangle", "mesh 1", "mesh 4", "slivers"]
    if particle in ("sphere", "clump"):
        found.append("region plane")
    if axes:
        found.append("solid")    # a mesh of a box
        if particle in ("sphere", "clump"):
            found.append("region block")
        if not sharp and shallow:
            found.append("box")
    return found


def surface(kind, p, n):
    """Lines before, words of the surface, meshes."""
    u = bodies.across(n)
    v = bodies.cross(n, u)
    below = bodies.plus(p, -SIZE / 2, n)
    sizes = [SIZE] * 3
    if kind == "plane":
        return (), line("plane", place(p), direction(n)), ()
    if kind == "rectangle":
        return (), line("rectangle", place(p), direction(n), direction(u), length(SIZE), length(SIZE)), ()
    if kind == "box":
        return (), line("box", place(below), *map(length, sizes), "outside"), ()
    if kind == "region plane":
        return (line("region under plane", place(p), direction(n), "units box"),), line("region under"), ()
    if kind == "region block":
        edges = [along(k, x + s * SIZE / 2) for k, x in enumerate(below) for s in (-1, 1)]
        return (line("region under block", edges, "side out units box"),), line("region under"), ()
    if kind == "solid":
        low, high = (bodies.plus(below, s * SIZE / 2, (1, 1, 1)) for s in (-1, 1))
        mesh = Mesh("solid.stl", tuple(body_meshes.box(low, high, 3)))
        return (), line("mesh", mesh.name, "outside"), (mesh,)
    cuts = {"mesh 1": (0, 1), "mesh 4": (0, 0.25, 0.5, 0.75, 1), "slivers": (0, 0.4999, 0.5, 0.5001, 0.5003, 1)}[kind]
    corners = [[bodies.plus(bodies.plus(p, SIZE * (a - 0.5), u), SIZE * (b - 0.5), v) for b in (0, 0.3, 1)] for a in cuts]
    mesh = Mesh(f"{kind.replace(' ', '')}.stl", tuple(body_meshes.grid(lambda i, j: corners[i][j], len(cuts) - 1, 2)))
    return (), line("mesh", mesh.name), (mesh,)


# ---- particles ----------------------------------------------------------------------------------

def support(words, q, n):
    """How far the shape reaches from its center against n (sharp boxes, tetrahedra, superellipsoids)."""
    m = scenes.rotated_back(q, n)
    name, numbers = words[0], [word.values[0] for word in words if not isinstance(word, str)]
    extra = numbers[-1] if "rounded" in words else 0.0
    if name == "box":
        return sum(a / 2 * abs(x) for a, x in zip(numbers, m)) + extra
    if name.startswith("vertices"):
        return 0.33 * max(-bodies.dot(m, corner) for corner in scenes.CORNERS) + extra
    if name == "ellipsoid":
        return math.sqrt(sum((a * x)**2 for a, x in zip(numbers, m)))
    n1, n2 = (float(word) for word in words[4:6])
    dual = [e / (e - 1) for e in (n1, n2)]
    (a, b, c), (x, y, z) = numbers[:3], m
    flat = (abs(a * x)**dual[1] + abs(b * y)**dual[1])**(1 / dual[1])
    return (flat**dual[0] + abs(c * z)**dual[0])**(1 / dual[0])


def _grain(rng, x, density=1.0, diameter=1.0, molecule=0, speed=0.5):
    return Grain(place(x), velocity(tuple(rng.gauss(0, speed) for _ in "xyz")), spin((0, 0, 0)), length(diameter),
                 number(density, -3, 1, 0), 1, molecule)


def draw(rng):
    """A scene without the surface, which is put in by check: point, normal, and kinds that are compared."""
    axes = rng.random() < 0.4
    n = tuple(float(x) for x in rng.choice(bodies.AXES)) if axes else bodies.random_direction(rng)
    particle = rng.choice(("sphere", "clump", "shape", "shape", "shape"))
    p = tuple(rng.uniform(-1, 1) for _ in "xyz")
    depth = 10**rng.uniform(-12, -0.6)
    physics, start, columns, program, sharp, smallest = [], (), (), [], False, 0.5
    law = laws.law(rng, True, rng.choice(("hooke", "hertz")))
    physics += [line("pair_style gran/penalty"), line("pair_coeff * *", law), *scenes.neighbors(rng, (0.1, 0.3))]
    if particle == "shape":
        words, _ = scenes.shape(rng)
        q = rng.choice((bodies.random_turn(rng), (1.0, 0.0, 0.0, 0.0)))
        numbers = [word.values[0] for word in words if not isinstance(word, str)]
        smallest = min(numbers[:3]) if words[0] != "vertices 4" else 0.2
        sharp = words[0] in ("box", "vertices 4") and "rounded" not in words
        reach = support(words, q, n)
        depth *= smallest
        grains = (_grain(rng, bodies.plus(p, reach - depth, n)),)
        physics.append(line("fix step all shape/gran type 1", words, "density", number(1, -3, 1, 0), "orient quat", turned(q)))
        columns = tuple(f"f_step[{k}]" for k in range(1, 5))
    elif particle == "sphere":
        grains = (_grain(rng, bodies.plus(p, 0.5 - 0.5 * depth, n)),)
        physics.append(line("fix step all nve/sphere/symplectic"))
    else:
        way, x = bodies.random_direction(rng), (0.0, 0.0, 0.0)
        v = tuple(rng.gauss(0, 0.5) for _ in "xyz")
        spheres = [(bodies.plus(x, s, way), d) for s, d in ((0.3, 0.9), (-0.35, 0.7))]
        low = min(bodies.dot(at, n) - d / 2 for at, d in spheres)
        shift = bodies.plus(p, -low - 0.3 * depth, n)
        grains = tuple(Grain(place(bodies.plus(at, 1, shift)), velocity(v), spin((0, 0, 0)), length(d), number(1, -3, 1, 0), 1, 1)
                       for at, d in spheres)
        start = (line("fix prop all property/atom mol ghost yes"),)
        physics += [*scenes.MEMBERS_APART, line("fix step all rigid/small/symplectic molecule")]
    edges = [along(k, s * 6.0) for k in range(3) for s in (-1, 1)]
    box = (line("region whole block", edges, "units box"), line("create_box 1 whole"))
    scene = Scene(scenes.begin(rng, "f f f") + start, box, grains, tuple(physics), tuple(program), columns=columns, vectors=(("b", 20),))
    kinds = kinds_of(particle, sharp, axes, depth < 0.04)
    others = rng.sample(kinds[1:], min(3, len(kinds) - 1))
    return scene, (p, n, text(law)), ("plane", *others)


def _lines(scene, kind, where):
    p, n, law = where
    before, words, meshes = surface(kind, p, n)
    name = kind.replace(" ", "")
    lines = [*scene.beginning(), *scene.physical(), *map(text, before), text(line("fix b all large/body", words, "contact", law)),
             *scene.steps(), "run 0", *scene.seen(f"{name}.0"), f'print "$(f_b:%.17g)" append seen.{name}.energy screen no',
             f"run {STEPS}", *scene.seen(f"{name}.1")]
    return lines, meshes


def check(run, scene, where, kinds):
    lines, files = [], {}
    for kind in kinds:
        more, meshes = _lines(scene, kind, where)
        lines += [*(["clear"] if lines else []), *more]
        files.update(scene.but(meshes=tuple(meshes)).files())
    session = Session(lines, files=files)
    found = run(session)
    if found.kind != OK:
        return changes.fault_of_failure(found) or f"refused: {found.text}", [session]
    first = kinds[0].replace(" ", "")
    for kind in kinds[1:]:
        name = kind.replace(" ", "")
        fault = _difference(found.seen, first, name)
        if fault:
            return f"{kind} is not {kinds[0]}: {fault}", [session]
    return "", [session]


def _difference(seen, first, name):
    """An overlap is known to 1e-14 of the coordinates or so, and with it the force; motion follows."""
    force = _force(seen[f"seen.{first}.0"])
    fault = compare_forces(force, _force(seen[f"seen.{name}.0"]))
    if fault:
        return "at first: " + fault
    energies = [value(seen[f"seen.{k}.energy"].split()[0]) for k in (first, name)]
    if abs(energies[0] - energies[1]) > 1e-7 * max(map(abs, energies)) + 1e-9:
        return f"energies {energies}"
    return compare(seen[f"seen.{first}.1"], seen[f"seen.{name}.1"], 1e-8, 1e-3)


def _force(dump):
    from closeness import vectors
    found = vectors(dump)
    return [(*found["fx"][tag], *found["tqx"][tag]) for tag in sorted(found["fx"])]


STIFFEST, NOISE = 1e5, 3e-13


def compare_forces(mine, theirs):
    for row, twin in zip(mine, theirs):
        size = max(map(abs, (*row, *twin)))
        worst = max(abs(a - b) for a, b in zip(row, twin))
        if not worst <= 1e-6 * size + STIFFEST * NOISE:
            return f"force and torque {row} and {twin}"
    return ""
