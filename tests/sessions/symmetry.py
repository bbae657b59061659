# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Relation: a scene that is moved, turned or told in other units does the same, to rounding."""

import bodies
import changes
import scenes
from closeness import compare
from pool import OK, Session
from quantities import Change
from scene import not_finite

NOT_TURNED = {"periodic", "axes", "inertia", "host", "drawn"}
POSITION, RELATIVE = 1e-9, 1e-6


def draw(rng):
    scene = scenes.any_scene(rng, (scenes.spheres, scenes.spheres, scenes.shaped, scenes.clumped, scenes.of_the_host, scenes.bonded))
    scene = scene.but(program=(*scene.program[:-1], ("run", rng.choice((1, 10, 25)))))
    scene = scene.but(once=tuple(words for words in scene.once if words[0] != "set group all quat"))    # new bonds begin strained by it
    kinds = ["moved"] if scene.traits & NOT_TURNED else ["moved", "turned", "turned"]
    kind = rng.choice(kinds if "no units" in scene.traits else [*kinds, "units"])
    if kind == "units":
        change = Change(units=tuple(rng.choice((2.0**rng.randint(-12, 12), 10.0**rng.randint(-4, 4))) for _ in range(3)))
    elif kind == "moved":
        change = Change(shift=tuple(rng.uniform(-5, 5) for _ in range(3)))
    else:
        change = Change(rotation=bodies.random_turn(rng))
        scene = scene.but(box=scenes.cube(scene, 9.0))
    if "host" in scene.traits and kind == "moved":
        change = Change(shift=(0.0, 0.0, change.shift[2]))    # cylinders of LAMMPS stand at the origin
    return scene, change


def session(scene):
    return Session(scene.beginning() + scene.physical() + scene.steps() + scene.seen("end"), words=scene.words, files=scene.files())


def check(run, scene, change):
    plain, other = session(scene), session(scene.changed(change))
    expected = run(plain)
    if expected.kind != OK or not_finite(expected.seen):
        return changes.fault_of_failure(expected), [plain]
    found = run(other)
    if found.kind != OK:
        return changes.fault_of_failure(found) or f"refused: {found.text}", [plain, other]
    difference = compare(expected.seen["seen.end"], found.seen["seen.end"], POSITION, RELATIVE, change)
    return f"not the same when moved, turned or in other units: {difference}" if difference else "", [plain, other]
