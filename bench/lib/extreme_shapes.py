# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Extreme scenes of particles with a shape: beds, gases, impacts, and bodies that meet face on face, edge on edge, corner on corner.
Unit of length: about the size of a particle; density 1, gravity 10."""

import dataclasses
import math
import os
import random
import tempfile

import lammps
import verdict
from lammps import SECOND, TALUS

STIFFNESS = 1.0e5
LOSSY = f"hooke {STIFFNESS} 60.0 tangential multistep NULL NULL 0.5"
ELASTIC = f"hooke {STIFFNESS} 0.0"
FRACTION = 0.1      # of the critical time step of spheres: half of what is advised for these, as the page of fix shape/gran says
GRAVITY = 10.0
FREE = ((-20.0, 20.0),) * 3
FLOOR = ("plane 0 0 0 0 0 1",)

CUBE, ROUNDED = "box 1 1 1", "box 0.9 0.9 0.9 rounded 0.05"
NEEDLE, PLATE = "box 2 0.1 0.1", "box 1 1 0.05"
LENTIL, BLOCK = "ellipsoid 0.5 0.4 0.05", "superellipsoid 0.5 0.5 0.5 20 20"
SHAPES = {
    "sharp cubes": CUBE,
    "rounded cubes": ROUNDED,
    "tetrahedra": "vertices 4 0.5 0.5 0.5 0.5 -0.5 -0.5 -0.5 0.5 -0.5 -0.5 -0.5 0.5",
    "needles 1:20": NEEDLE,
    "plates 1:20": PLATE,
    "ellipsoids 1:10": LENTIL,
    "superellipsoids, exponents 20": BLOCK,
    "superellipsoids, exponents 2, 20": "superellipsoid 0.5 0.5 0.5 2 20",
}


@dataclasses.dataclass
class Body:
    x: tuple
    turn: tuple = (1.0, 0.0, 0.0, 0.0)
    v: tuple = (0.0, 0.0, 0.0)
    w: tuple = (0.0, 0.0, 0.0)
    type: int = 1


@dataclasses.dataclass
class Shaped:
    """shapes: words of each type, None of spheres of diameter 1. fraction: time step over the critical one of the rule
    `contact`, or over the limit of stability. walls: words of large bodies. in_the_way: that bodies do not touch is a fault; needs
    few steps, since only 400 or so are looked at."""
    name: str
    shapes: list
    bodies: list
    law: str
    steps: int
    box: tuple = FREE
    periodic: str = "f f f"
    fraction: float = FRACTION
    of_limit: bool = False
    gravity: float = 0.0
    walls: tuple = ()
    random: bool = False      # orientations
    skin: float = 0.1
    order: int = 1
    in_the_way: bool = False


def about(axis, angle):
    """Quaternion of a turn."""
    size = math.sqrt(sum(a * a for a in axis))
    return (math.cos(angle / 2), *(a / size * math.sin(angle / 2) for a in axis))


def after(p, q):
    """Turned by q, then by p."""
    (a, *u), (b, *v) = p, q
    cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return (a * b - sum(x * y for x, y in zip(u, v)), *(a * y + b * x + c for x, y, c in zip(u, v, cross)))


# of a cube: with an edge below, with one across it, and with a corner below
ON_EDGE = about((1, 0, 0), math.pi / 4)
ACROSS = after(about((0, 0, 1), math.pi / 2), ON_EDGE)
ON_CORNER = about((1, -1, 0), math.acos(math.sqrt(1 / 3)))
UPSIDE_DOWN = after(about((1, 0, 0), math.pi), ON_CORNER)


# ---- running ----------------------------------------------------------------------------------

def movers(scene):
    words = " ".join(f"type {k} {shape} density 1.0{' orient random 4711' * scene.random}"
                     for k, shape in enumerate(scene.shapes, 1) if shape)
    balls = [str(k) for k, shape in enumerate(scene.shapes, 1) if not shape]
    if not balls:
        return f"fix shapes all shape/gran {words}\n"
    return (f"group balls type {' '.join(balls)}\ngroup shaped subtract all balls\n"
            f"fix balls balls nve/sphere/symplectic order {scene.order}\nfix shapes shaped shape/gran {words}\n")


def physics(scene):
    turns = "".join(f"fix_modify shapes orient {k} {' '.join(map(repr, b.turn))}\n" for k, b in enumerate(scene.bodies, 1)
                    if not scene.random and scene.shapes[b.type - 1])
    walls = "".join(f"fix wall{k} all large/body {wall} contact {scene.law}\n" for k, wall in enumerate(scene.walls))
    fall = f"fix fall all gravity/talus {scene.gravity} vector 0 0 -1\n" if scene.gravity else ""
    return f"pair_style gran/penalty\npair_coeff * * {scene.law}\n{movers(scene)}{turns}{fall}{walls}"


def script(scene):
    """The spheres among them are not shaped: their kinetic energy is that of LAMMPS."""
    limit = "c_limits[7]" if scene.of_limit else "c_limits[1]"
    spheres = not all(scene.shapes)
    return f"""units lj
atom_style sphere
atom_modify map array
newton off
comm_modify vel yes
boundary {scene.periodic}
read_data data
neighbor {scene.skin!r} bin
neigh_modify every 1 delay 0 check yes
{physics(scene)}compute limits all timestep/gran
compute contacts all penalty/stats
{"compute ke balls ke" if spheres else ""}
{"compute turning balls erotate/sphere" if spheres else ""}
variable kinetic equal f_shapes{"+c_ke+c_turning" * spheres}
variable potential equal {scene.gravity}*mass(all)*xcm(all,z)
thermo_style custom step {limit} c_contacts[3]
thermo_modify norm no lost warn
timestep 1e-30
run 0 post no
timestep $({scene.fraction}*{limit}:%.17g)
fix account all print {max(1, scene.steps // 400)} "Account $(step) $(atoms) $(v_kinetic:%.17g) $(v_potential:%.17g) &
$(c_contacts[4]:%.17g) $(c_contacts[3])"
thermo {max(1, scene.steps // 20)}
run {scene.steps} post no
"""


def run(bench, scene):
    folder = tempfile.mkdtemp(prefix="shaped-", dir=bench.workdir)
    lammps.write_data(os.path.join(folder, "data"), scene.box,
                      [(k, b.type, 1.0, 1.0, *b.x) for k, b in enumerate(scene.bodies, 1)],
                      [(k, *b.v, *b.w) for k, b in enumerate(scene.bodies, 1)], types=len(scene.shapes))
    code = SECOND if scene.order == 2 else TALUS
    result = lammps.run(folder, "scene", script(scene), code, check=False, timeout=bench.size(900, 60))
    return verdict.judge_account(result.printed("Account"), result, len(scene.bodies), meet=scene.in_the_way)


# ---- the list ---------------------------------------------------------------------------------

def grid(spacing, speed=0.0, lift=0.0, count=3):
    draw = random.Random(5)
    return [Body((spacing * (k % count + 0.5), spacing * (k // count % count + 0.5), spacing * (k // count**2 + 0.5) + lift),
                 v=tuple(speed * draw.gauss(0, 1) for _ in "xyz")) for k in range(count**3)]


def spacing_of(kind):
    return 2.1 if "needles" in kind else 1.75


def bed(kind, steps, **more):
    spacing = spacing_of(kind)
    width = 3 * spacing
    walls = (*FLOOR, "plane 0 0 0 1 0 0", f"plane {width} 0 0 -1 0 0", "plane 0 0 0 0 1 0", f"plane 0 {width} 0 0 -1 0")
    return Shaped(f"bed of {kind}", [SHAPES[kind]], grid(spacing, lift=0.3), LOSSY, steps,
                  ((-1.0, width + 1.0), (-1.0, width + 1.0), (-1.0, width + 3.0)), gravity=GRAVITY, walls=walls, random=True, **more)


def gas(kind, speed, steps, **more):
    spacing = spacing_of(kind)
    name = f"gas of {kind}" + ", fast" * (speed > 10)
    return Shaped(name, [SHAPES[kind]], grid(spacing, speed), ELASTIC, steps, ((0.0, 3 * spacing),) * 3, periodic="p p p", random=True,
                  **more)


def meet(name, shapes, low, high, law=ELASTIC, steps=1500, **more):
    """Two bodies in space, the second of the last type."""
    high.type = len(shapes)
    return Shaped(name, shapes, [low, high], law, steps, **more)


def contacts(name, shape):
    """Two cubes meet with each part of their surfaces."""
    down = (0.0, 0.0, -1.0)
    places = [("face on face", (1, 0, 0, 0), 1.02, (1, 0, 0, 0)), ("face on face, turned", (1, 0, 0, 0), 1.02, about((0, 0, 1), math.pi / 4)),
              ("edge on edge", ON_EDGE, 1.43, ON_EDGE), ("edge across edge", ON_EDGE, 1.43, ACROSS),
              ("edge on face", (1, 0, 0, 0), 1.22, ON_EDGE), ("corner on corner", ON_CORNER, 1.75, UPSIDE_DOWN),
              ("corner on edge", ON_EDGE, 1.6, ON_CORNER), ("corner on face", (1, 0, 0, 0), 1.38, ON_CORNER)]
    found = [meet(f"{name}, {what}", [shape], Body((0, 0, 0), below), Body((0, 0, height), above, down))
             for what, below, height, above in places]
    found += [meet(f"{name}, half beside each other", [shape], Body((0, 0, 0)), Body((1.0, 0.5, 1.02), v=down)),
              meet(f"{name} at the same place", [shape], Body((0, 0, 0)), Body((0, 0, 0))),
              meet(f"{name} overlap by .05", [shape], Body((0, 0, 0)), Body((0, 0, 0.95))),
              meet(f"{name}, dt 2 critical", [shape], Body((0, 0, 0)), Body((0, 0, 1.02), v=down), fraction=2.0, steps=50),
              meet(f"{name}, mu = 1000", [shape], Body((0, 0, 0)), Body((0.3, 0.1, 1.4), ON_CORNER, (0.5, 0, -1.0)),
                   law=f"hooke {STIFFNESS} 0.0 tangential multistep NULL NULL 1000.0"),
              meet(f"{name}, e = 0", [shape], Body((0, 0, 0)), Body((0.3, 0.1, 1.4), ON_CORNER, (0.5, 0, -1.0)),
                   law="hertz/material 1e6 0.0 0.3 tangential multistep NULL NULL 0.5", steps=5000)]
    found += [Shaped(f"{name}: one squeezed between planes", [shape], [Body((0, 0, 0.475))], LOSSY, 20000, gravity=0.0,
                     walls=(*FLOOR, "plane 0 0 0.95 0 0 -1")),
              Shaped(f"{name}: one on its edge", [shape], [Body((0, 0, math.sqrt(0.5) - 1e-4), ON_EDGE)], LOSSY, 20000, gravity=GRAVITY,
                     walls=FLOOR),
              Shaped(f"{name}: one hits the floor at 300", [shape], [Body((0, 0, 0.6), v=(0, 0, -300.0))], LOSSY, 100, walls=FLOOR,
                     skin=0.5),
              Shaped(f"{name}: tower of ten", [shape], [Body((0, 0, 0.5 + k)) for k in range(10)], LOSSY, 100000, gravity=GRAVITY,
                     walls=FLOOR)]
    return found


def thin():
    """What is much thinner than it is long."""
    slow = (0.0, 0.0, -0.1)
    return [meet("needles, end on end", [NEEDLE], Body((0, 0, 0)), Body((2.02, 0, 0), v=(-1.0, 0, 0))),
            meet("needles, crossed", [NEEDLE], Body((0, 0, 0)), Body((0, 0, 0.11), about((0, 0, 1), math.pi / 2), slow), steps=5000),
            meet("plates, edge on edge", [PLATE], Body((0, 0, 0)), Body((1.01, 0, 0), v=(-0.1, 0, 0)), steps=5000),
            meet("plates, fast", [PLATE], Body((0, 0, 0)), Body((0.1, 0, 0.06), v=(0, 0, -30.0)), steps=500, skin=0.5,
                 in_the_way=True),
            meet("plates, so fast that they pass", [PLATE], Body((0, 0, 0)), Body((0.1, 0, 0.06), v=(0, 0, -3000.0)), steps=50,
                 in_the_way=True),
            meet("ellipsoids, pole on pole", [LENTIL], Body((0, 0, 0)), Body((0, 0, 0.11), v=slow), steps=5000),
            meet("ellipsoids at the same place", [LENTIL], Body((0, 0, 0)), Body((0, 0, 0)))]


def mixed():
    """Of different kinds and sizes."""
    down = (0.0, 0.0, -1.0)
    found = [meet("sphere on a corner", [CUBE, None], Body((0, 0, 0), ON_CORNER), Body((0, 0, 1.38), v=down)),
             meet("sphere in the middle of a cube", [CUBE, None], Body((0, 0, 0)), Body((0, 0, 0))),
             meet("superellipsoids, exponents 20, face on face", [BLOCK], Body((0, 0, 0)), Body((0, 0, 1.02), v=down))]
    for n in (30, 100):
        small = f"box {1 / n!r} {1 / n!r} {1 / n!r}"
        found += [meet(f"cubes 1:{n}, corner on corner", [CUBE, small], Body((0, 0, 0), ON_CORNER),
                       Body((0, 0, 0.867 + 1 / n), UPSIDE_DOWN, down), steps=20000),
                  meet(f"cube of 1/{n} within another", [CUBE, small], Body((0, 0, 0)), Body((0.2, 0.3, 0.1), ON_CORNER), steps=1000)]
    for factor in (1e-9, 1e9):
        edge = f"{factor!r} {factor!r} {factor!r}"
        found.append(meet(f"cubes, lengths times {factor:.0e}", [f"box {edge}"], Body((0, 0, 0)),
                          Body((0.1 * factor, 0.1 * factor, 1.4 * factor), ON_CORNER, (0, 0, -factor)), skin=0.1 * factor,
                          law=f"hooke {STIFFNESS * factor**3!r} 60.0 tangential multistep NULL NULL 0.5",
                          box=tuple((low * factor, high * factor) for low, high in FREE)))
    for angle in (0.1, 1.0, 30.0, 1000.0):
        dt = FRACTION * math.sqrt(0.5 * 6.0 / STIFFNESS)
        rate = angle / dt
        found.append(Shaped(f"free box 3:2:1 turns by {angle:g} in a step", ["box 3 2 1"],
                            [Body((0, 0, 0), w=(1e-3 * rate, rate, 1e-3 * rate))], LOSSY, 20000))
    return found


def scenes(quick):
    steps = 4000 if quick else 60000
    found = []
    for kind in SHAPES:
        late = bed(kind, 5000, fraction=1.5, of_limit=True)
        late.name += ", dt 1.5 of the limit"
        found += [bed(kind, steps), late, gas(kind, 1.0, steps // 2), gas(kind, 30.0, 3000)]
    found += contacts("sharp cubes", CUBE) + contacts("rounded cubes", ROUNDED) + thin() + mixed()
    second = Shaped("spheres of order 2 among cubes", [CUBE, None], [Body((0, 0, 0)), Body((0, 0, 1.02), v=(0, 0, -1.0), type=2)],
                    LOSSY, 1000, order=2)
    return found + [second]
