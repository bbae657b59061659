# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What happens to a scene: commands between runs, outputs, restart files; and what a failure says."""

import re

import bodies
import bonds
import laws
from mutation import CRASHES
from pool import CRASH, ERROR, HANG
from quantities import along, duration, length, line, number, place, text


def fault_of_failure(outcome):
    """Of an outcome that is not OK: what is wrong with it; empty where it is an error with a message."""
    if outcome.kind in (CRASH, HANG):
        return f"{outcome.kind}: {outcome.text}"
    if outcome.kind == ERROR and (re.search(CRASHES, outcome.text) or len(outcome.text.strip()) < 15):
        return f"no message: {outcome.text}"
    return ""


def read_restart(scene, name):
    """Lines; fixes that hold properties of particles come next."""
    return [f"read_restart {name}", *(text(words) for words in scene.start if text(words).startswith("fix "))]


# ---- outputs ------------------------------------------------------------------------------------

def _gone(program):
    return {words[1] for words in program if words[0] == "unfix"}


def output(rng, scene, n):
    """Lines, behind the physics, that ask for something every few steps; it must not matter."""
    every, name = rng.choice((1, 2, 3, 7, 10)), f"o{n}"
    gone = _gone(scene.program)
    fixes = [words[1] for words in scene.physics if words[0] == "fix" and "contact" in words and words[1] not in gone]
    kinds = [contact_rows, contact_counts, stats, dissipation, stress, grid, dump_of_particles, vtk, averages, restarts, energies]
    return rng.choice(kinds)(rng, name, every, fixes, scene)


def contact_rows(rng, name, every, fixes, scene):
    values = rng.sample(("id1", "id2", "body", "part", "px", "nx", "overlap", "force", "fn", "ft", "fx", "tx", "eng", "h1"), 3)
    return [f"compute {name} all contact/gran/local {' '.join(values)}",
            f"dump {name} all local {every} rows.{name} index c_{name}[1] c_{name}[2] c_{name}[3]"]


def contact_counts(rng, name, every, fixes, scene):
    return [f"compute {name} all contact/gran/atom", f"dump {name} all custom {every} counts.{name} id c_{name}[1]"]


def stats(rng, name, every, fixes, scene):
    return [f"compute {name} all penalty/stats", f"thermo {every}",
            f"thermo_style custom step pe ke press c_{name}[1] c_{name}[2] c_{name}[3] c_{name}[4] c_{name}[5]"]


def dissipation(rng, name, every, fixes, scene):
    return [f"compute {name} all dissipation/gran/atom", f"dump {name} all custom {every} lost.{name} id c_{name}[1] c_{name}[2]"]


def stress(rng, name, every, fixes, scene):
    return [f"compute {name} all stress/atom NULL", f"compute {name}s all reduce sum c_{name}[1] c_{name}[4]",
            f"thermo {every}", f"thermo_style custom step pxx pxy c_{name}s[1] c_{name}s[2]"]


def grid(rng, name, every, fixes, scene):
    if "tilted" in scene.traits:
        return []
    return [f"compute {name} all coarse/grid 10 10 10 1.25 fraction", f"dump {name} all grid {every} fields.{name} c_{name}:grid:data"]


def dump_of_particles(rng, name, every, fixes, scene):
    return [f"dump {name} all custom {every} particles.{name} id x y z vx vy vz fx fy fz tqx tqy tqz"]


def vtk(rng, name, every, fixes, scene):
    return [f"dump {name} all vtk/gran {every} {name}.pvd"]


def averages(rng, name, every, fixes, scene):
    what = f"f_{rng.choice(fixes)}[{rng.choice((1, 3, 6, 9, 20))}]" if fixes else "c_thermo_press"
    return [f"fix {name} all ave/time {every} 2 {2 * every} {what} file means.{name}"]


def restarts(rng, name, every, fixes, scene):
    return [] if "periodic" in scene.traits else [f"restart {every} saved.{name}.*"]


def energies(rng, name, every, fixes, scene):
    if not fixes or "pressure" in scene.traits:    # which counts these virials
        return [f"thermo {every}"]
    fix = rng.choice(fixes)
    return [f"fix_modify {fix} energy {rng.choice(('yes', 'no'))} virial {rng.choice(('yes', 'no'))}", f"thermo {every}",
            f"thermo_style custom step pe etotal press f_{fix}"]


# ---- commands between runs ----------------------------------------------------------------------

def lifecycle(rng, scene):
    """Half of the scenes go on after a command or two."""
    program = list(scene.program)
    while rng.random() < 0.5 and len(program) < 6:
        made = rng.choice(COMMANDS + 2 * OF_BONDS if "bonded" in scene.traits else COMMANDS)(rng, scene)
        if made:
            program += [*made, ("run", rng.choice((5, 15, 30)))]
    gone = _gone(program)
    return scene.but(program=tuple(program), vectors=tuple(vector for vector in scene.vectors if vector[0] not in gone))


def _plain(scene):
    return not scene.traits & {"shapes", "clumps", "host", "order 2"}


def delete(rng, scene):
    gone = rng.sample(range(1, len(scene.grains) + 1), max(1, len(scene.grains) // 4))
    more = "bond yes" if "bonded" in scene.traits and rng.random() < 0.8 else ""
    return [line("group gone id", *gone), line("delete_atoms group gone compress no", more.split()), line("group gone delete")]


def create(rng, scene):
    if not _plain(scene):
        return []
    cluster = bodies.Cluster(scene.grains)
    x = bodies.plus(cluster.center, cluster.size + rng.choice((0.4, 1.0)), (0, 0, 1))
    return [line("create_atoms 1 single", place(x), "units box"), line("group fresh id >", len(scene.grains)),
            line("set group fresh diameter", length(0.9), "density", number(1, -3, 1, 0)), *_properties(scene)]


def _properties(scene):
    """Of particles that LAMMPS has created: it leaves those of what was at their place in memory."""
    hot = [line("set group fresh temperature 1")] if "hot" in scene.traits else []
    return hot + ([line("set group fresh d_liquid 0")] if "wet" in scene.traits else [])


def pour(rng, scene):
    """A stream from above, into what a box that is not periodic has over the grains."""
    if not _plain(scene) or "periodic" in scene.traits:
        return []
    top = max(grain.place.values[2] for grain in scene.grains)
    edges = ["0 1.5 0 1.5", along(2, top + rng.choice((0.3, 1.0))), along(2, top + 2.5)]
    return [line("region mouth block", edges, "units box"),
            line("fix stream all pour/rate", rng.choice((1, 5)), "1 mouth", rng.choice((20, 300)), "diameter uniform 0.3 0.5 density 1 seed 7",
                 "velocity 0 0 -2")]


def faster(rng, scene):
    return [line("velocity all set", *[number(rng.uniform(-1, 1), 1, 0, -1) for _ in "xyz"], "units box")]


def displace(rng, scene):
    return [line("displace_atoms all move", *[length(rng.uniform(-0.01, 0.01)) for _ in "xyz"], "units box")]


def another_step(rng, scene):
    return [line("timestep", duration(rng.choice((2.5e-4, 4e-4))))]


def another_law(rng, scene):
    if scene.traits & {"host", "order 2"} or "/material" in text([word for words in scene.physics for word in words]):
        return []
    return [line("pair_coeff 1 1", laws.law(rng, "shapes" in scene.traits, rng.choice(("hooke", "hertz"))))]


def body_gone(rng, scene):
    fixes = [words[1] for words in scene.physics if words[0] == "fix" and "contact" in words or "wall/gran" in text(words)]
    return [line("unfix", rng.choice(fixes))] if len(fixes) > 1 else []


def body_more(rng, scene):
    if scene.traits & {"periodic", "host", "order 2"}:
        return []
    kinds = (bodies.flat_for_shapes, bodies.beside) if "shapes" in scene.traits else (bodies.flat, bodies.beside)
    lines, meshes, _ = bodies.body(rng, bodies.Cluster(scene.grains), f"m{rng.randrange(10**6)}",
                                   laws.law(rng, "shapes" in scene.traits, "hooke"), True, kinds)
    return lines if not meshes else []


def drag(rng, scene):
    return [line(f"fix d{rng.randrange(10**6)} all viscous", number(rng.uniform(0.1, 1), 0, 1, -1))]


def partner(rng, scene):
    law = rng.choice(("stokes", "wen/yu", "koch/hill total", "hoelzer/sommerfeld"))
    fluid = line("@fluid", law.split(), rng.choice(((), "saffman", "saffman/mei")), rng.choice(((), "magnus", "magnus/oesterle")),
                 rng.choice(((), "rotation")))
    return rng.choice(([fluid], [line("@put_forces 1", *[f"{rng.uniform(-3, 3):.4g}" for _ in "xyz"])] +
                       rng.choice(([], [line("@put_drag 2 0.4 0.1 0 0.3")]))))


def settings(rng, scene):
    return [line(rng.choice(("neigh_modify exclude none", "group half id 1:3", "write_data written", "run 0",
                             "write_dump all custom dumped id x y z", "run_style verlet", "comm_proxy auto", "info styles pair",
                             "thermo 3", "set group all omega 0 0 0")))]


def another_box(rng, scene):
    k = rng.choice("xyz")
    how = rng.choice((line("scale", f"{rng.uniform(0.98, 1.02):.4g}", "remap"), line("delta", length(-0.1), length(0.2))))
    return [line("change_box all", k, how, "units box")]


def bonds_more(rng, scene):
    """Between two that have none, if it is known which."""
    if "bonded" not in scene.traits or not scene.bonds:
        return []
    there = {(i, j) for _, i, j in scene.bonds}
    free = [pair for pair in bonds.near(scene) if pair not in there]
    return [line("create_bonds single/bond", rng.randint(1, 2), rng.choice(free))] if free else []


def bonds_gone(rng, scene):
    if "bonded" not in scene.traits:
        return []
    return [line("group few id", *rng.sample(range(1, len(scene.grains) + 1), 3)), line("delete_bonds few multi remove special"),
            line("group few delete")]


def other_bonds(rng, scene):
    if "bonded" not in scene.traits:
        return []
    return [bonds.coefficients(rng, rng.randint(1, 2), bonds.style_of(scene))]


COMMANDS = (delete, create, pour, body_gone, faster, displace, another_step, another_law, another_box, body_more, drag, partner, settings,
            settings)
OF_BONDS = bonds_more, bonds_gone, other_bonds
