# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Relation: without friction and damping the force is minus the gradient of the energy that is told, and the torque that by the angle:
of any particle with any surface, edges and rims included, and with another particle."""

import re

import bodies
import body_meshes
import changes
import laws
import scenes
from pool import OK, Session
from quantities import direction, length, line, number, place, product, spin, text, turned, velocity
from scene import Grain, Mesh, Scene, value

RAY, TRIES = 3.2, 80    # length of the way on which a place is looked for where the particle touches, and steps on it
STEP = 1e-6
COUPLE = 0.02    # of the force: torque about its line that sharp bodies deep in edges and corners of boxes lack
SMOOTH, BOUND = 1e-5, 2e-4    # of the largest force: difference of two quotients that shows a kink, and of the force from them


def random_body(rng, particle):
    """Lines before, words, meshes, and whether particles are inside."""
    kinds = ["box", "sphere", "cylinder", "cone"]
    if particle == "sphere" or particle in ("ellipsoid", "superellipsoid"):
        kinds += ["mesh box", "mesh ball"]
    if particle == "sphere":
        kinds += ["region block", "region cylinder"]
    kind, inside = rng.choice(kinds), rng.random() < 0.3
    side = "inside" if inside else "outside"
    r = rng.uniform(1.2, 2.0) if inside else rng.uniform(0.3, 1.0)
    a, c, long = bodies.random_direction(rng), (0.0, 0.0, 0.0), r * rng.uniform(1.0, 2.5)
    if kind == "box":
        return (), line("box", place(c), *[length(2 * r * rng.uniform(0.8, 1.5)) for _ in "xyz"], side), (), inside
    if kind == "sphere":
        return (), line("sphere", place(c), length(r), side), (), inside
    if kind == "cylinder":
        return (), line("cylinder", place(c), direction(a), length(r), length(long), side), (), inside
    if kind == "cone":
        return (), line("cone", place(c), direction(a), length(r), length(r * rng.uniform(0.1, 0.9)), length(long), side), (), inside
    if kind == "region block":
        edges = [length(s * r) for _ in "xyz" for s in (-1, 1)]
        return (line("region it block", edges, "side", side[:-4], "units box"),), line("region it"), (), inside
    if kind == "region cylinder":
        return (line("region it cylinder z 0 0", length(r), length(-long / 2), length(long / 2), "side", side[:-4], "units box"),), \
            line("region it"), (), inside
    triangles = body_meshes.sphere(c, r, 6) if kind == "mesh ball" else body_meshes.box((-r,) * 3, (r,) * 3, rng.choice((1, 2)))
    return (), line("mesh it.stl", side), (Mesh("it.stl", tuple(triangles)),), inside


def _particle(rng, kind):
    """Words of fix shape/gran, empty for a sphere."""
    return () if kind == "sphere" else scenes.shape(rng, (kind,))[0]


def draw(rng):
    kind, partner = rng.choice(("sphere", "sphere", *scenes.SHAPES)), rng.choice(("sphere", *scenes.SHAPES))
    words, q = _particle(rng, kind), bodies.random_turn(rng)
    pair = rng.random() < 0.35 and kind != "sphere"
    smooth = any("ellipsoid" in one for one in (kind, partner if pair else ""))    # their radius depends on the place
    law = text(laws.elastic(rng, "hooke" if smooth else rng.choice(("hooke", "hertz"))))
    physics = [line("pair_style gran/penalty"), line("pair_coeff * *", law), *scenes.neighbors(rng, (0.3,))]
    grains = [Grain(place((0, 0, RAY)), velocity((0, 0, 0)), spin((0, 0, 0)), length(1.0), number(1, -3, 1, 0), 1)]
    other, meshes, inside, turns = (), (), False, [line("fix_modify shapes orient 1", turned(q))] if words else []
    if pair:
        other = _particle(rng, partner)
        grains.append(Grain(place((0, 0, 0)), velocity((0, 0, 0)), spin((0, 0, 0)), length(1.0), number(1, -3, 1, 0), 2))
        if other:
            turns.append(line("fix_modify shapes orient 2", turned(bodies.random_turn(rng))))
    shapes = [line("type", t, what, "density", number(1, -3, 1, 0)) for t, what in ((1, words), (2, other)) if what]
    physics.append(line("fix shapes all shape/gran", shapes) if shapes else line("fix step all nve/sphere/symplectic"))
    if not pair:
        before, surface, meshes, inside = random_body(rng, kind)
        physics += [*before, line("fix b all large/body", surface, "contact", law)]
    physics.append(line("compute all all penalty/stats"))
    edges = [length(s * (RAY + 2)) for _ in "xyz" for s in (-1, 1)]
    box = (line("region whole block", edges, "units box"), line("create_box 2 whole"))
    scene = Scene(scenes.begin(rng, "f f f"), box, tuple(grains), tuple(physics), tuple(turns), tuple(meshes))
    return scene, bodies.random_direction(rng), inside, q if words else None


ASK = 'run 0 post no\nprint "$(c_all[4]:%.17g) $(c_all[3]:%.17g) $(c_all[2]:%.17g)" append seen.energies screen no'
SHOWN = "thermo_style custom step c_all[2] c_all[3] c_all[4]\nthermo_modify norm no"


def _put(x):
    return f"set atom 1 x {x[0]!r} y {x[1]!r} z {x[2]!r}"


def _session(scene, asked):
    return Session([*scene.beginning(), *scene.physical(), *scene.steps(), *SHOWN.splitlines(), *asked], files=scene.files())


def _numbers(outcome):
    return [[value(word) for word in row.split()] for row in outcome.seen["seen.energies"].splitlines()]


def _touching(rows, inside):
    """The place on the way at which the particle begins to touch, but for one step."""
    order = range(len(rows)) if inside else range(len(rows) - 1, -1, -1)
    for n in order:
        if rows[n][0] > 0:
            return n
    return None


def check(run, scene, way, inside, q):
    places = [tuple(RAY * (n + 0.5) / TRIES * x for x in way) for n in range(TRIES)]
    scan = _session(scene, [row for x in places for row in (_put(x), *ASK.splitlines())])
    found = run(scan)
    if found.kind != OK:
        return changes.fault_of_failure(found) or f"refused: {found.text}", [scan]
    n = _touching(_numbers(found), inside)
    if n is None:
        return "", [scan]
    x, asked = places[n], []
    moves = [(k, s * h) for h in (STEP, STEP / 2) for k in range(3) for s in (1, -1)]
    for k, d in moves:
        asked += [_put(bodies.plus(x, d, bodies.AXES[k])), *ASK.splitlines()]
    asked.append(_put(x))
    if q:
        for k, d in moves:
            small = (1.0, *(d / 2 * e for e in bodies.AXES[k]))
            asked += [text(line("fix_modify shapes orient 1", turned(unit4(product(small, q))))), *ASK.splitlines()]
        asked.append(text(line("fix_modify shapes orient 1", turned(q))))
    session = _session(scene, [*asked, "run 0 post no", *scene.seen("end")])
    found = run(session)
    if found.kind != OK:
        return changes.fault_of_failure(found) or f"refused: {found.text}", [session]
    return _difference(found, len(moves), _are_sharp(scene)), [session]


def _are_sharp(scene):
    """Box and box, box and polyhedron: none of them a sphere, smooth or rounded."""
    what = [text(words) for words in scene.physics]
    shapes = " ".join(one for one in what if one.startswith("fix shapes"))
    flat = [one for one in what if one.startswith("fix b ") and " box " in one and " outside " in one]
    return bool(shapes) and not re.search("ellipsoid|rounded", shapes) and (bool(flat) or "type 1" in shapes and "type 2" in shapes)


def unit4(q):
    size = sum(x * x for x in q)**0.5
    return tuple(x / size for x in q)


def _without_couple(expected, these, force):
    """What is expected, but for a small difference along the force."""
    squared = sum(f * f for f in force)
    if not squared:
        return expected
    couple = sum((a - b) * f for a, b, f in zip(these, expected, force)) / squared
    couple = max(-COUPLE, min(COUPLE, couple))
    return [b + couple * f for b, f in zip(expected, force)]


def _difference(found, count, sharp):
    from closeness import vectors
    seen, energies = vectors(found.seen["seen.end"]), [row[0] for row in _numbers(found)]
    told = [*seen["fx"][1], *seen["tqx"][1]]
    size = max(map(abs, told))
    for part, name in ((0, "force"), (1, "torque"))[:len(energies) // count]:
        mine = energies[count * part:count * (part + 1)]
        first, second = ([-(mine[6 * j + 2 * k] - mine[6 * j + 2 * k + 1]) / (2 * STEP / (1, 2)[j]) for k in range(3)] for j in (0, 1))
        size = max(size, *map(abs, second))
        if max(abs(a - b) for a, b in zip(first, second)) > SMOOTH * size:    # a kink is near
            continue
        these = told[3 * part:3 * part + 3]
        if part and sharp:
            second = _without_couple(second, these, told[:3])
        if max(abs(a - b) for a, b in zip(these, second)) > BOUND * size:
            return f"the {name} {these} is not minus the gradient of the energy {second}"
    return ""
