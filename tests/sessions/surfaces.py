# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Relation: the same surface, told as plane, rectangle, box, region or mesh, with few triangles, many or slivers, acts alike on a
sphere, a clump or a particle with a shape, at any depth. Flat ones, and for spheres and clumps solids and vessels with their edges."""

import dataclasses
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


def flat_kinds(particle, sharp, axes, shallow):
    """Names of flat surfaces that act alike on this particle."""
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


def _box(kind, c, half, side):
    """A box, or a region or mesh of it."""
    if kind == "box":
        return (), line("box", place(c), *[length(2 * h) for h in half], side), ()
    low, high = (tuple(x + s * h for x, h in zip(c, half)) for s in (-1, 1))
    if kind == "region block":
        edges = [along(k, x) for k in range(3) for x in (low[k], high[k])]
        return (line("region it block", edges, "side", side[:-4], "units box"),), line("region it"), ()
    mesh = Mesh(f"{kind.replace(' ', '')}.stl", tuple(body_meshes.box(low, high, int(kind.split()[1]))))
    return (), line("mesh", mesh.name, side), (mesh,)


def _round(kind, c, r, r2, long, side):
    """A sphere, or a cylinder or cone along z, or a region of it."""
    what, region = kind.split()[-1], kind.startswith("region")
    if not region:
        size = {"sphere": (r,), "cylinder": (r, long), "cone": (r, r2, long)}[what]
        way = () if what == "sphere" else (direction((0, 0, 1)),)
        return (), line(what, place(c), *way, *map(length, size), side), ()
    ends = along(2, c[2] - long / 2), along(2, c[2] + long / 2)
    size = {"sphere": (place(c), length(r)), "cylinder": ("z", along(0, c[0]), along(1, c[1]), length(r), *ends),
            "cone": ("z", along(0, c[0]), along(1, c[1]), length(r), length(r2), *ends)}[what]
    return (line("region it", what, size, "side", side[:-4], "units box"),), line("region it"), ()


def surface(kind, where):
    """Lines before, words of the surface, meshes."""
    return {"flat": _flat, "box": _box, "round": _round}[where[0]](kind, *where[1:])


def _flat(kind, p, n):
    u = bodies.across(n)
    v = bodies.cross(n, u)
    below = bodies.plus(p, -SIZE / 2, n)
    if kind == "plane":
        return (), line("plane", place(p), direction(n)), ()
    if kind == "rectangle":
        return (), line("rectangle", place(p), direction(n), direction(u), length(SIZE), length(SIZE)), ()
    if kind == "region plane":
        return (line("region under plane", place(p), direction(n), "units box"),), line("region under"), ()
    if kind in ("box", "region block"):
        return _box(kind, below, (SIZE / 2,) * 3, "outside")
    if kind == "solid":
        return _box("mesh 3", below, (SIZE / 2,) * 3, "outside")
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
    """A scene without the surface, which check puts in: where it is, the law, and its kinds."""
    return (_near_solid if rng.random() < 0.3 else _on_flat)(rng)


def _scene(rng, grains, physics, clump=False, columns=()):
    law = laws.law(rng, True, rng.choice(("hooke", "hertz")))
    begin = [line("pair_style gran/penalty"), line("pair_coeff * *", law), *scenes.neighbors(rng, (0.1, 0.3))]
    edges = [along(k, s * 6.0) for k in range(3) for s in (-1, 1)]
    box = (line("region whole block", edges, "units box"), line("create_box 1 whole"))
    start = (line("fix prop all property/atom mol ghost yes"),) if clump else ()
    return Scene(scenes.begin(rng, "f f f") + start, box, tuple(grains), (*begin, *physics), columns=columns, vectors=(("b", 20),)), text(law)


SPHERE = (line("fix step all nve/sphere/symplectic"),)
CLUMP = (*scenes.MEMBERS_APART, line("fix step all rigid/small/symplectic molecule"))


def _clump(rng):
    """Two spheres about the origin."""
    way, v = bodies.random_direction(rng), tuple(rng.gauss(0, 0.5) for _ in "xyz")
    return [Grain(place(bodies.plus((0, 0, 0), s, way)), velocity(v), spin((0, 0, 0)), length(d), number(1, -3, 1, 0), 1, 1)
            for s, d in ((0.3, 0.9), (-0.35, 0.7))]


def _put(grains, shift):
    return [dataclasses.replace(grain, place=place(bodies.plus(grain.place.values, 1, shift))) for grain in grains]


def _on_flat(rng):
    axes = rng.random() < 0.4
    n = tuple(float(x) for x in rng.choice(bodies.AXES)) if axes else bodies.random_direction(rng)
    particle = rng.choice(("sphere", "clump", "shape", "shape", "shape"))
    p, depth, sharp = tuple(rng.uniform(-1, 1) for _ in "xyz"), 10**rng.uniform(-12, -0.6), False
    if particle == "shape":
        words, _ = scenes.shape(rng)
        q = rng.choice((bodies.random_turn(rng), (1.0, 0.0, 0.0, 0.0)))
        numbers = [word.values[0] for word in words if not isinstance(word, str)]
        depth *= min(numbers[:3]) if words[0] != "vertices 4" else 0.2
        sharp = words[0] in ("box", "vertices 4") and "rounded" not in words
        grain = _grain(rng, bodies.plus(p, support(words, q, n) - depth, n))
        move = line("fix step all shape/gran type 1", words, "density", number(1, -3, 1, 0), "orient quat", turned(q))
        scene, law = _scene(rng, [grain], (move,), columns=tuple(f"f_step[{k}]" for k in range(1, 5)))
    elif particle == "sphere":
        scene, law = _scene(rng, [_grain(rng, bodies.plus(p, 0.5 - 0.5 * depth, n))], SPHERE)
    else:
        grains = _clump(rng)
        low = min(bodies.dot(grain.place.values, n) - grain.diameter.values[0] / 2 for grain in grains)
        scene, law = _scene(rng, _put(grains, bodies.plus(p, -low - 0.3 * depth, n)), CLUMP, True)
    kinds = flat_kinds(particle, sharp, axes, depth < 0.04)
    return scene, ("flat", p, n), law, ("plane", *rng.sample(kinds[1:], min(3, len(kinds) - 1)))


def _holds(where, x):
    """Whether the point is in the solid or in the vessel."""
    d = [a - b for a, b in zip(x, where[1])]
    if where[0] == "box":
        return all(abs(e) < h for e, h in zip(d, where[2]))
    what, _, r, r2, long, _ = where[6], *where[1:6]
    if what == "sphere":
        return math.hypot(*d) < r
    at = r if what == "cylinder" else r + (r2 - r) * (d[2] / long + 0.5)
    return abs(d[2]) < long / 2 and math.hypot(d[0], d[1]) < at


def _has_foot(where, x):
    """In a cone: the place of the side that is nearest to x is not beyond its narrow end, where regions have the rim and bodies still the side,
    at overlaps near a radius."""
    if where[0] != "round" or where[5] != "inside" or where[6] != "cone":
        return True
    _, c, r, r2, long, _, _ = where
    slope, d = (r - r2) / long, [a - b for a, b in zip(x, c)]
    gap = r - slope * (d[2] + long / 2) - math.hypot(d[0], d[1])
    return d[2] + gap * slope / (1 + slope**2) < long / 2


def _near_solid(rng):
    """A sphere or a clump somewhere at a solid or in a vessel, often at an edge; centers are not behind the surface, where it ends
    for regions."""
    inside, c = rng.random() < 0.4, tuple(rng.uniform(-1, 1) for _ in "xyz")
    half = [rng.uniform(0.8, 1.5) if inside else rng.uniform(0.2, 1.0) for _ in "xyz"]
    side, what = "inside" if inside else "outside", rng.choice(("box", "box", "box", "sphere", "cylinder", "cone"))
    if what == "box":
        where, kinds = ("box", c, tuple(half), side), ["box", "region block", "mesh 1", "mesh 3"]
    else:
        where, kinds = ("round", c, half[0], 0.6 * half[0], 2 * half[2], side, what), [what, f"region {what}"]
    clump = rng.random() < 0.4
    while True:
        x = tuple(a + rng.uniform(-1, 1) * (h if inside else h + 0.5) for a, h in zip(c, half))
        grains = _put(_clump(rng) if clump else [_grain(rng, (0, 0, 0))], x)
        if all(_holds(where, grain.place.values) == inside and _has_foot(where, grain.place.values) for grain in grains):
            break
    scene, law = _scene(rng, grains, CLUMP if clump else SPHERE, clump)
    return scene, where[:6], law, (kinds[0], *rng.sample(kinds[1:], min(2, len(kinds) - 1)))


def _lines(scene, kind, where, law):
    before, words, meshes = surface(kind, where)
    name = kind.replace(" ", "")
    lines = [*scene.beginning(), *scene.physical(), *map(text, before), text(line("fix b all large/body", words, "contact", law)),
             *scene.steps(), "run 0", *scene.seen(f"{name}.0"), f'print "$(f_b:%.17g)" append seen.{name}.energy screen no',
             f"run {STEPS}", *scene.seen(f"{name}.1")]
    return lines, meshes


def check(run, scene, where, law, kinds):
    lines, files = [], {}
    for kind in kinds:
        more, meshes = _lines(scene, kind, where, law)
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
