# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Input scripts of a Scene for every method, and the state that a run leaves.

    plain, half                    Talus with its run style, the two starts of its integrator
    plain midpoint, half midpoint  the same with the second-order update of tangential displacements
    order 2                        its contacts that dissipate of second order
    stock                          gran/hooke/history or gran/hertz/history, fix nve/sphere
    granular                       pair granular with the same coefficients, fix nve/sphere
    liggghts                       LIGGGHTS, only undamped Hertz scenes: its damping is another one

Where there is damping it is not allowed to attract, with the word limit_damping in every code."""

import dataclasses
import math
import os

import lammps
import machine
import scenes
from lammps import LIGGGHTS, STOCK, TALUS

COLUMNS = "id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz"
FIRST_ORDER = ("plain", "half", "plain midpoint", "half midpoint")
SECOND_ORDER = "order 2"
TALUS_METHODS = (*FIRST_ORDER, SECOND_ORDER)
OTHER_METHODS = ("stock", "granular", "liggghts")


def family(method):
    return method.split()[0] if method in FIRST_ORDER else method if method in TALUS_METHODS else "verlet"


def code_of(method):
    return TALUS if method in TALUS_METHODS else LIGGGHTS if method == "liggghts" else STOCK


def law_of(method, scene):
    """Methods with the same word solve the same equations. Pair granular and LIGGGHTS shorten the lever
    arm of friction by half the overlap. `order 2` asks for the rule `slider`, which is another one only where
    friction has a dashpot."""
    if scene.law.mu and method in ("granular", "liggghts"):
        return method
    return "slider" if scene.law.gt and scene.law.mu and method == SECOND_ORDER else "talus"


def finest(law, scene):
    """The method whose converged solution is the reference of a law."""
    if law in OTHER_METHODS:
        return law
    return "half midpoint" if law == "talus" and scene.law.gt and scene.law.mu else SECOND_ORDER


def methods_for(scene):
    """Methods that have the scene's law. Without friction there is one tangential update: none."""
    found = ["plain", "half"] + (["plain midpoint", "half midpoint"] if scene.law.mu else []) + [SECOND_ORDER]
    # with a floor the other wall styles of 4 Feb 2025 have another law than the pair styles
    found += ["granular"] if scene.floor else ["stock", "granular"]
    law = scene.law
    if machine.LIGGGHTS and not scene.floor and law.kind == "hertz" and law.gn == 0.0:
        found.append("liggghts")
    return found


# ---- laws -------------------------------------------------------------------------------------

def limit(law):
    return " limit_damping" if law.gn else ""


def talus_law(law, more=""):
    """more: words of the tangential law."""
    text = f"{law.kind} {law.kn!r} {law.gn!r}"
    kt, gt = law.kt, law.gt
    if law.kind == "hertz/material":
        text, kt, gt = f"{text} {scenes.NU}", "NULL", "NULL"
    if law.mu:
        text += f" tangential multistep {kt} {gt} {law.mu!r}{more}"
    return text + limit(law)


def granular_law(law):
    if law.kind == "hertz/material":
        shear = f"mindlin NULL 1.0 {law.mu!r}" if law.mu else "linear_nohistory 0.0 0.0"
        return (f"hertz/material {law.kn!r} {law.gn!r} {scenes.NU} tangential {shear} damping coeff_restitution{limit(law)}")
    ratio = law.gt / law.gn if law.gn else 0.0
    tangential = {"hooke": "linear_history", "hertz": "mindlin"}[law.kind]
    damping = {"hooke": "mass_velocity", "hertz": "viscoelastic"}[law.kind]
    if law.mu:
        shear = f"tangential {tangential} {law.kt!r} {ratio!r} {law.mu!r}"
    else:
        shear = "tangential linear_nohistory 0.0 0.0"
    return f"{law.kind} {law.kn!r} {law.gn!r} {shear} damping {damping}{limit(law)}"


def physics(scene, method):
    law = scene.law
    if method in TALUS_METHODS:
        words = talus_law(law, " slider midpoint" if method == SECOND_ORDER else " midpoint" * ("midpoint" in method))
        start = method if method == SECOND_ORDER else f"start {family(method)}"
        pull = f" gravity {scene.gravity!r} vector 0 0 -1" if scene.gravity else ""
        text = f"pair_style gran/penalty\npair_coeff * * {words}\n" \
               f"fix move all nve/sphere/symplectic {start}{pull}\n"
        if scene.floor:
            text += f"fix floor all large/body plane 0 0 0 0 0 1 contact {words}\n"
        return text
    text = f"fix gravity all gravity {scene.gravity!r} vector 0 0 -1\n" if scene.gravity else ""
    text += "fix move all nve/sphere\n"
    if method == "stock":
        kt = law.kt if law.mu else 1.0      # a number must be given
        return text + f"pair_style gran/{law.kind}/history {law.kn!r} {kt!r} {law.gn!r} {law.gt!r} {law.mu!r} 1{limit(law)}\n" \
                      "pair_coeff * *\n"
    if method == "granular":
        text += f"pair_style granular\npair_coeff * * {granular_law(law)}\n"
        if scene.floor:
            text += f"fix floor all wall/gran granular {granular_law(law)} zplane 0.0 NULL\n"
        return text
    return text + liggghts_physics(law)


def liggghts_physics(law):
    young = 0.75 * law.kn * 2 * (1 - scenes.NU**2)
    return f"""fix m1 all property/global youngsModulus peratomtype {young!r}
fix m2 all property/global poissonsRatio peratomtype {scenes.NU}
fix m3 all property/global coefficientRestitution peratomtypepair 1 1.0
fix m4 all property/global coefficientFriction peratomtypepair 1 {law.mu!r}
pair_style gran model hertz tangential history tangential_damping off
pair_coeff * *
"""


# ---- scripts ----------------------------------------------------------------------------------

def _head(scene, method, data):
    old = method == "liggghts"
    style = "granular" if old else "sphere"
    speak = "communicate single vel yes" if old else "comm_modify vel yes"
    return (f"units si\natom_style {style}\natom_modify map array\nnewton off\n{speak}\n"
            f"boundary {scene.periodic}\nread_data {data}\nneighbor 0.1 bin\n"
            "neigh_modify every 1 delay 0 check yes\n" + physics(scene, method)
            + "thermo 1000000000\nthermo_modify norm no lost error\n")


def _dump(method, every, path):
    if method == "liggghts":
        form = "'%d " + " ".join(["%.17g"] * (len(COLUMNS.split()) - 1)) + "'"
    else:
        form = "float %.17g"
    return f"dump d all custom {every} {path} {COLUMNS}\ndump_modify d format {form} sort id first no\n"


def write_scene(scene, path, copies=1):
    """Data file, with copies of the scene side by side along its copy axes."""
    across = math.ceil(math.sqrt(copies))
    rows, speeds, tag = [], [], 0
    for c in range(copies):
        shift = [0.0, 0.0, 0.0]
        for axis, distance, place in zip(scene.copy_axes, scene.copy_distance, (c % across, c // across)):
            shift[axis] = distance * place
        for x, v, w in zip(scene.positions, scene.velocities, scene.spins):
            tag += 1
            rows.append((tag, 1, 2 * scenes.R, scenes.DENSITY, *(a + s for a, s in zip(x, shift))))
            speeds.append((tag, *v, *w))
    box = [list(edge) for edge in scene.box]
    if copies > 1:
        for axis, distance in zip(scene.copy_axes, scene.copy_distance):
            box[axis][1] += distance * across
    lammps.write_data(path, tuple(map(tuple, box)), rows, speeds)


# ---- states -----------------------------------------------------------------------------------

@dataclasses.dataclass
class State:
    """Lists of triples; velocities and spins at the time of the positions; f: contact forces alone."""
    x: list
    v: list
    w: list
    f: list

    def kinetic(self):
        return sum(0.5 * scenes.MASS * _square(v) + 0.5 * scenes.INERTIA * _square(w)
                   for v, w in zip(self.v, self.w))


def _square(vector):
    return sum(c * c for c in vector)


def _state(scene, method, dt, frame):
    def triples(*names):
        return list(zip(*(frame[name] for name in names)))
    x, f, torque = triples("x", "y", "z"), triples("fx", "fy", "fz"), triples("tqx", "tqy", "tqz")
    v, w = triples("vx", "vy", "vz"), triples("omegax", "omegay", "omegaz")
    if method not in TALUS_METHODS:   # fix gravity is part of their forces
        f = [(a, b, c + scenes.MASS * scene.gravity) for a, b, c in f]
    if family(method) in ("half", SECOND_ORDER):      # these velocities belong to half a step earlier
        g = (0.0, 0.0, -scene.gravity)
        v = [tuple(a + 0.5 * dt * (b / scenes.MASS + c) for a, b, c in zip(*row, g)) for row in zip(v, f)]
        w = [tuple(a + 0.5 * dt * b / scenes.INERTIA for a, b in zip(*row)) for row in zip(w, torque)]
    return State(x, v, w, f)


class Broken(Exception):
    """The run ended in an error, or its numbers are not finite."""


def simulate(bench, scene, method, dt):
    """States in the middle and at the end of the scene."""
    steps, middle = round(scene.time / dt), round(scene.middle / dt)
    name = f"{scene.name}-{method}-{steps}-{id(scene)}".replace(" ", "_")
    write_scene(scene, bench.path(name + ".data"))
    result = lammps.run(
        bench.workdir, name, _head(scene, method, name + ".data") + f"timestep {dt!r}\n"
        + _dump(method, middle, name + ".mid") + f"run {middle}\nundump d\n"
        + _dump(method, steps, name + ".end") + f"run {steps - middle}\n", code_of(method), check=False)
    frames = [frame for suffix, step in ((".mid", middle), (".end", steps))
              for when, frame in lammps.read_frames(bench.path(name + suffix)) if when == step]
    for suffix in (".data", ".mid", ".end"):
        if os.path.exists(bench.path(name + suffix)):
            os.remove(bench.path(name + suffix))
    if result.returncode or len(frames) != 2:
        raise Broken(result.error() or f"{method}: return code {result.returncode}")
    states = [_state(scene, method, dt, frame) for frame in frames]
    if not all(math.isfinite(c) for s in states for row in s.x + s.v for c in row):
        raise Broken(f"{method}: not a number")
    return states


def step_cost(bench, scene, method, cores):
    """Time per particle and step (ns): the scene many times over, at a fine time step."""
    particles = bench.size(20000, 4000)
    copies = max(1, particles // len(scene.positions)) if scene.periodic == "f f f" else 1
    name = f"cost-{scene.name}-{method}".replace(" ", "_")
    if not os.path.exists(bench.path(f"cost-{scene.name}.data".replace(" ", "_"))):
        write_scene(scene, bench.path(f"cost-{scene.name}.data".replace(" ", "_")), copies)
    data = f"cost-{scene.name}.data".replace(" ", "_")
    dt = scene.step / 32
    steps = max(round(scene.time / dt), 1 if copies > 1 else bench.size(4000, 1000))
    if copies == 1:
        steps = min(steps, bench.size(20000, 4000))
    result = lammps.run(bench.workdir, name, _head(scene, method, data) + f"timestep {dt!r}\nrun {steps}\n",
                        code_of(method), cores=cores)
    return result.loops()[-1].nanoseconds()
