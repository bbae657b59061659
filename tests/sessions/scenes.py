# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Scenes drawn at random: some grains that touch each other, with laws, bodies and integrators of every kind."""

import math

import bodies
import bonds
import laws
from driven import driven
from quantities import Rounding, along, direction, duration, length, line, number, place, rotated, spin, text, turned, velocity
from scene import Grain, Scene

STEP = 5e-4
START = ("units lj", "atom_style sphere", "atom_modify map yes", "newton off", "comm_modify vel yes")
START_OF_BONDS = (START[0], "atom_style bpm/sphere", *START[2:4], line("comm_modify vel yes cutoff", length(2.5)))


# ---- grains -------------------------------------------------------------------------------------

def grains(rng, count, types=1, sizes=(0.8, 1.1), speed=2.0, spacing=1.0):
    """On a lattice whose sites are shifted a little, so that many touch."""
    side = max(2, round(count**(1 / 3)))
    sites = [(i, j, k) for k in range(count // side**2 + 1) for j in range(side) for i in range(side)][:count]
    found = []
    for site in sites:
        x = tuple(spacing * s + rng.uniform(-0.06, 0.06) for s in site)
        found.append(Grain(place(x), velocity(tuple(rng.gauss(0, speed) for _ in "xyz")),
                           spin(tuple(rng.gauss(0, speed) for _ in "xyz")), length(rng.uniform(*sizes)),
                           number(rng.choice((1.0, 1.0, 2.5)), -3, 1, 0), rng.randint(1, types)))
    return tuple(found)


def clumps(rng, count):
    """Of two or three spheres that overlap, far enough from each other that they touch a little at most."""
    found = []
    for n in range(count):
        center = (1.9 * (n % 2), 1.9 * (n // 2 % 2), 1.9 * (n // 4))
        way, v, w = bodies.random_direction(rng), [rng.gauss(0, 1) for _ in "xyz"], (0, 0, 0)
        side = bodies.across(way)
        for k, at in enumerate((bodies.plus(center, 0.35, way), bodies.plus(center, -0.35, way), bodies.plus(center, 0.5, side))):
            if k < rng.choice((2, 3)):
                found.append(Grain(place(at), velocity(v), spin(w), length(rng.uniform(0.7, 1.0)), number(1, -3, 1, 0), 1, n + 1))
    return tuple(found)


SHAPES = "box", "vertices", "ellipsoid", "superellipsoid"
CORNERS = (1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)    # of a tetrahedron


def rotated_back(q, v):
    """From space to the frame of a particle."""
    return rotated((q[0], -q[1], -q[2], -q[3]), v)


def shape(rng, kinds=SHAPES):
    """Words of a shape of fix shape/gran and the radius of the sphere around it."""
    kind = rng.choice(kinds)
    rounded = line("rounded", length(0.05)) if kind in ("box", "vertices") and rng.random() < 0.6 else ()
    if kind == "box":
        a = [rng.uniform(0.5, 0.8) for _ in "abc"]
        return line("box", *map(length, a), rounded), math.hypot(*a) / 2 + 0.05
    if kind == "vertices":
        return line("vertices 4", CORNERS, "scale", length(0.33), rounded), 0.33 * math.sqrt(3) + 0.05
    a = [rng.uniform(0.25, 0.55) for _ in "abc"]
    if kind == "ellipsoid":
        return line("ellipsoid", *map(length, a)), max(a)
    return line("superellipsoid", *map(length, a), rng.choice((2.5, 4, 8)), rng.choice((2, 3, 5))), math.hypot(*a)


# ---- boxes --------------------------------------------------------------------------------------

def box(found, boundary, types, margin=3.0):
    """Lines of a box around grains; a periodic direction is as long as they are."""
    edges = []
    for k, word in enumerate(boundary.split()):
        low = min(grain.place.values[k] for grain in found)
        high = max(grain.place.values[k] for grain in found)
        gap = 0.5 if word == "p" else margin
        while word == "p" and high - low + 2 * gap < 2.6:    # at least two diameters
            gap += 0.1
        edges += [along(k, low - gap), along(k, high + gap)]
    return line("region whole block", edges, "units box"), line("create_box", types, "whole")


def cube(scene, half):
    """The box of a scene made a cube about the origin, which holds it however it is turned."""
    edges = [along(k, sign * half) for k in range(3) for sign in (-1, 1)]
    return (line("region whole block", edges, "units box"), *scene.box[1:])


def gravity(rng):
    return rng.uniform(1, 20), direction(bodies.random_direction(rng))


# without contacts in a clump; and temperatures of a few clumps have freedoms left
MEMBERS_APART = line("neigh_modify exclude molecule/intra all"), line("compute_modify thermo_temp extra/dof -99")


# ---- kinds of scenes ----------------------------------------------------------------------------

def begin(rng, boundary, start=START):
    return tuple(line(words) for words in start) + (line("boundary", boundary),)


def neighbors(rng, skins=(0.05, 0.1, 0.3)):
    return (line("neighbor", length(rng.choice(skins)), "bin"), line("neigh_modify every 1 delay 0 check yes"),
            line("timestep", duration(STEP)), line("thermo_style custom step atoms"))


def _boundary(rng, periodic):
    return rng.choice(("p p f", "p p p", "p f f", "f p p")) if periodic else "f f f"


def _program(rng):
    return (("run", rng.choice((20, 40, 60))),)


def spheres(rng, periodic=False, moves=True):
    """Of gran/penalty, with any laws and bodies."""
    types = rng.choice((1, 1, 2))
    found = grains(rng, rng.randint(6, 30), types, rng.choice(((0.9, 1.05), (0.8, 1.1), (0.4, 1.1))))
    second = rng.random() < 0.15
    hot = not second and rng.random() < 0.15
    wet = not second and not hot and rng.random() < 0.1
    normal = rng.choice(laws.MATERIALS + laws.COHESIVE) if rng.random() < 0.4 else None
    normal = rng.choice(("hooke", "hertz")) if second else normal

    def law(normal=normal):
        if second:
            return laws.of_second_order(rng, normal)
        return line(laws.law(rng, normal=normal), laws.heat(rng) if hot else ())

    def of_grains():
        return laws.wet(rng) if wet and rng.random() < 0.8 else law()

    physics = [line("pair_style gran/penalty"), line("pair_coeff * *", of_grains())]
    if types == 2:
        physics += [line("pair_coeff 1 2", of_grains()), line("pair_coeff 2 2", of_grains())]
    physics += neighbors(rng)
    fall = line("gravity", number(gravity(rng)[0], 1, 0, -2), "vector", direction(bodies.random_direction(rng)))
    order = "order 2" if second else rng.choice(("", "start half"))
    physics.append(line("fix step all nve/sphere/symplectic", order.split(), rng.choice((fall, ()))))
    boundary, traits = _boundary(rng, periodic), {"order 2"} if second else set()
    materials = normal in laws.MATERIALS + laws.COHESIVE

    def contact():
        words = law(normal if materials or second else rng.choice(laws.NORMALS[:3] + laws.PLASTIC))
        return line(words, "temperature", laws.some(rng, 0, 5)) if hot and rng.random() < 0.7 else words

    scene = _with_bodies(rng, found, physics, boundary, types, contact, moves, traits=traits)
    return _with_heat(rng, scene) if hot else _with_liquid(rng, scene) if wet else scene


def _with_liquid(rng, scene):
    """Its grains have liquid, of which bridges take some."""
    first = (line("set group all d_liquid", laws.some(rng, 1e-3, 1e-2, *laws.VOLUME)),
             line("set atom", f"1*{rng.randint(1, len(scene.grains))}", "d_liquid", laws.some(rng, 0, 1e-3, *laws.VOLUME)))
    return scene.but(start=(*scene.start, line("fix wet all property/atom d_liquid ghost yes")),
                     physics=(*scene.physics, line("compute liquid all property/atom d_liquid")), program=(*first, *scene.program),
                     columns=("c_liquid",), traits=scene.traits | {"wet"})


def _with_heat(rng, scene):
    """Its grains have a temperature each, which conduction changes."""
    physics = (*scene.physics, line("fix warm all heat/flow constant", laws.some(rng, 0.5, 2, *laws.HEAT_CAPACITY)),
               line("compute hot all property/atom temperature heatflow"))
    first = line("set group all temperature 1"), line("set atom", f"1*{rng.randint(1, len(scene.grains))}", "temperature 4")
    return scene.but(start=(*scene.start, line("fix hot all property/atom temperature heatflow ghost yes")), physics=physics,
                     program=(*first, *scene.program), columns=("c_hot[1]", "c_hot[2]"), traits=scene.traits | {"hot"})


def _with_bodies(rng, found, physics, boundary, types, contact, moves=True, traits=(), columns=(), start=(), kinds=None):
    """contact: draws a law of a body."""
    cluster, meshes, traits, vectors = bodies.Cluster(found), [], set(traits), []
    periodic = "p" in boundary
    for n in range(rng.choice((0, 1, 1, 2, 3))):
        these = kinds or ((bodies.beside,) if periodic else (bodies.flat, bodies.flat, bodies.around, bodies.beside))
        if periodic and "mesh" in traits:
            break
        lines, more, marks = bodies.body(rng, cluster, f"b{n}", contact(), moves, these)
        physics += lines
        meshes += more
        traits |= marks
        if "moving" in marks:    # the forces of others are sums with rounding
            vectors.append((f"b{n}", 20))
    if periodic:
        traits.add("periodic")
    return Scene(begin(rng, boundary) + tuple(start), box(found, boundary, types), found, tuple(physics), _program(rng),
                 tuple(meshes), tuple(columns), tuple(vectors), frozenset(traits))


def shaped(rng, periodic=False, moves=True):
    """Particles with shapes, and spheres."""
    words, radius = shape(rng)
    count = rng.randint(2, 8)
    spacing = rng.uniform(0.9, 1.15) * 1.5 * radius
    found = grains(rng, count, 2, (0.6, 0.9), 1.0, spacing)
    drawn = rng.random() < 0.5    # by the command; else one by one
    orient = line("orient random", rng.randint(1, 9999)) if drawn else ()
    normal = rng.choice(("hooke", "hertz"))
    physics = [line("pair_style gran/penalty"), line("pair_coeff * *", laws.law(rng, True, normal)), *neighbors(rng),
               line("group balls type 2"), line("fix step balls nve/sphere/symplectic"),
               line("fix shapes all shape/gran type 1", words, "density", number(1, -3, 1, 0), orient)]
    if rng.random() < 0.5:
        physics.append(line("fix fall all gravity/talus", number(gravity(rng)[0], 1, 0, -2), "vector", direction((0, 0, -1))))
    kinds = (bodies.flat_for_shapes, bodies.around, bodies.beside)
    scene = _with_bodies(rng, found, physics, _boundary(rng, periodic), 2, lambda: laws.law(rng, True, rng.choice(laws.NORMALS[:3])), moves,
                         ("shapes",), [f"f_shapes[{n}]" for n in range(1, 5)], kinds=kinds)
    turns = () if drawn else tuple(line("fix_modify shapes orient", tag, turned(bodies.random_turn(rng)))
                                   for tag, grain in enumerate(found, start=1) if grain.type == 1)
    traits = scene.traits | ({"drawn"} if drawn else set())
    return scene.but(program=(*turns, *scene.program), traits=traits)


def clumped(rng, periodic=False, moves=True):
    """Clumps of rigid/small/symplectic."""
    found = clumps(rng, rng.randint(2, 6))
    physics = [line("pair_style gran/penalty"), line("pair_coeff * *", laws.law(rng, normal=rng.choice(("hooke", "hertz")))),
               *neighbors(rng, (0.1, 0.3)), *MEMBERS_APART,
               line("fix step all rigid/small/symplectic molecule", rng.choice(("", "start half")).split(),
                    rng.choice(((), line("gravity", number(9, 1, 0, -2), "vector", direction(bodies.random_direction(rng))))))]
    return _with_bodies(rng, found, physics, _boundary(rng, periodic), 1, lambda: laws.law(rng, normal=rng.choice(laws.NORMALS[:3])), moves,
                        ("clumps",), start=(line("fix prop all property/atom mol ghost yes"),))


def of_the_host(rng, periodic=False, moves=True):
    """A script for LAMMPS alone: stock pair styles, walls and integrators, which the suffix accelerates."""
    granular = rng.random() < 0.4
    style, words = ("granular", laws.granular(rng)) if granular else laws.stock(rng)
    found = clumps(rng, rng.randint(2, 5)) if rng.random() < 0.2 else grains(rng, rng.randint(6, 24))
    in_clumps = any(grain.molecule for grain in found)
    pair = (line("pair_style granular"), line("pair_coeff * *", words)) if granular else (line("pair_style", style, words),
                                                                                         line("pair_coeff * *"))
    # without a skin LAMMPS takes pairs that adhere beyond touch from its lists
    physics = [*pair, *neighbors(rng, (0.1, 0.3) if "jkr" in text(words) else (0.0, 0.1, 0.3))]
    if in_clumps:
        physics += [*MEMBERS_APART, line("fix step all rigid/small molecule")]
    else:
        physics.append(line("fix step all nve/sphere"))
    fall = line("fix fall all gravity", number(gravity(rng)[0], 1, 0, -2), "vector", direction(bodies.random_direction(rng)))
    physics.insert(len(physics) - (1 if in_clumps else rng.choice((0, 1))), fall)    # behind rigid/small it acts from another step on
    boundary, cluster = _boundary(rng, periodic), bodies.Cluster(found)
    if not periodic:
        for n in range(rng.choice((0, 1, 2))):
            kind, contact = ("granular", laws.granular(rng)) if rng.random() < 0.4 else laws.stock(rng)
            physics += bodies.wall(rng, cluster, f"b{n}", line(kind.removeprefix("gran/"), contact))
    # models of granular are drawn without units
    marks = _marks_of_walls(physics) | ({"no units"} if any("damping" in text(words) for words in physics) else set())
    traits = {"host"} | marks | ({"periodic"} if periodic else set()) | ({"clumps"} if in_clumps else set())
    start = (line("fix prop all property/atom mol ghost yes"),) if in_clumps else ()
    return Scene(begin(rng, boundary) + start, box(found, boundary, 1), found, tuple(physics), _program(rng),
                 traits=frozenset(traits), words=("-sf", "talus"))


def bonded(rng, periodic=False, moves=True):
    """Grains with bonds, by scripts for LAMMPS alone, or with contacts and bodies of Talus."""
    found, boundary = grains(rng, rng.randint(4, 24), sizes=(0.8, 1.05)), _boundary(rng, periodic)
    with_host = rng.random() < 0.5
    if with_host:
        style, words = laws.stock(rng)
        physics = [line("pair_style", style, words), line("pair_coeff * *")]
    else:
        physics = [line("pair_style gran/penalty"), line("pair_coeff * *", laws.law(rng))]
    physics += [*neighbors(rng, (0.1, 0.3)), line("fix step all nve/bpm/sphere"),
                line("fix fall all gravity", number(gravity(rng)[0], 1, 0, -2), "vector", direction(bodies.random_direction(rng)))]
    if with_host:
        walls = [] if periodic else [bodies.wall(rng, bodies.Cluster(found), "b0", line(style.removeprefix("gran/"), words))]
        scene = Scene((), box(found, boundary, 1), found, physics=(*physics, *sum(walls, ())), program=_program(rng),
                      traits=frozenset({"host"} | ({"periodic"} if periodic else set()) | _marks_of_walls(physics + sum(map(list, walls), []))))
    else:
        scene = _with_bodies(rng, found, physics, boundary, 1, lambda: laws.law(rng, normal=rng.choice(laws.NORMALS[:3])), moves)
    return bonds.bonded(rng, scene.but(start=begin(rng, boundary, START_OF_BONDS), words=("-sf", "talus")))


def _marks_of_walls(physics):
    """Traits. Walls with a history have the wrong one in other units with LAMMPS 4 Feb 2025."""
    return {"wiggle"} & {word for words in physics for word in words} | \
        ({"no units"} if any("wall/gran" in text(words) for words in physics) else set())


KINDS = spheres, spheres, shaped, clumped, of_the_host, bonded


def any_scene(rng, kinds=KINDS, periodic=0.3, moves=True):
    scene = rng.choice(kinds)(rng, rng.random() < periodic, moves)
    if "periodic" in scene.traits and rng.random() < 0.3:
        scene = driven(rng, scene)
    return scene.changed(Rounding(5))
