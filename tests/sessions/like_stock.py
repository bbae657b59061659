# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Relation: with the suffix a script of LAMMPS gives what it gives without, to rounding. After every few steps the accelerated run
starts anew from the state of the stock one, which its restart file tells, so that chaos has no say."""

import bonds
import changes
import scenes
from closeness import compare
from pool import OK, Session

STEPS = 6
SEGMENTS = 4
POSITION, RELATIVE = 1e-11, 1e-8    # of a diameter; of the largest value of a column
OF_BONDS = 1e-8, 2e-6               # the same where angles of LAMMPS are rounded to 1e-8
OF_RATES = 1e-8, 1e-4               # and where damping divides that by the time step


def draw(rng):
    while True:
        scene = scenes.any_scene(rng, (scenes.of_the_host, scenes.of_the_host, scenes.bonded))
        style = bonds.style_of(scene) if scene.once else ()
        # when springs break LAMMPS mixes up the lengths of those that are left, and leaves their volumes to ghosts
        mixed_up = bonds.SPRINGS in style and "break" not in style and (bonds.FRAMES or bonds.VOLUMES in style)
        if "host" in scene.traits and not scene.traits & {"wiggle", "speeds"} and not mixed_up:    # LAMMPS begins its time anew after a restart
            scene = scene.but(program=(("run", rng.choice((1, STEPS))),))
            # LAMMPS reads no volumes of springs on several ranks
            return scene, 1 if segments(scene) == 1 or bonds.VOLUMES in style else rng.choice((1, 1, 1, 2))


def segments(scene):
    """How often. Signs of what rolling and twisting remember are neither in files of LAMMPS nor right on several ranks of it, so that
    these go on from the beginning only, on one rank."""
    pair = " ".join(words for words in scene.physical() if words.startswith("pair_coeff"))
    return 1 if "rolling" in pair or "twisting" in pair else SEGMENTS


def stock(scene, ranks):
    lines = scene.beginning() + scene.physical()
    for n in range(SEGMENTS):
        lines += [*scene.steps(), *scene.seen(str(n)), f"write_restart half.{n}"]
    return Session(lines, ranks, files=scene.files(), keep=tuple(f"half.{n}" for n in range(SEGMENTS)))


def accelerated(scene, ranks, n, restarts):
    """From the state of the stock run, which is that of its restart file; the first one from the beginning."""
    if n == 0:
        begin = scene.beginning()
    else:
        start = [words for words in scene.beginning()[:len(scene.start)] if not words.startswith(("boundary", "fix"))]
        begin = [*start, *changes.read_restart(scene, f"half.{n - 1}")]
    lines = [*begin, *scene.physical(again=n > 0), *scene.steps(), *scene.seen(str(n))]
    return Session(lines, ranks, words=scene.words, files={**scene.files(), **restarts})


def limits(scene):
    if not scene.once:
        return POSITION, RELATIVE
    return OF_RATES if any("damping derivative" in words for words in scene.physical()) else OF_BONDS


def _is_that_of_one_whole_run(run, scene, ranks, seen):
    """LAMMPS loses histories where particles change ranks, and where it writes restart files; where it has none to lose it is right."""
    lines, on_one = stock(scene, ranks).lines, stock(scene, 1).lines
    alone = run(Session([words for words in on_one if not words.startswith("write_restart")], 1, files=scene.files()))
    through = run(Session(lines, ranks, words=scene.words, files=scene.files()))
    return alone.kind == through.kind == OK and not compare(alone.seen[seen], through.seen[seen], *limits(scene))


def check(run, scene, ranks):
    plain = stock(scene, ranks)
    expected = run(plain)
    if expected.kind != OK:    # LAMMPS itself refuses the scene, or cannot make it
        return "", [plain]
    for n in range(segments(scene)):
        talus = accelerated(scene, ranks, n, expected.kept)
        found = run(talus)
        if found.kind != OK:
            return changes.fault_of_failure(found) or f"refused: {found.text}", [plain, talus]
        difference = compare(expected.seen[f"seen.{n}"], found.seen[f"seen.{n}"], *limits(scene))
        if difference and not _is_that_of_one_whole_run(run, scene, ranks, f"seen.{n}"):
            return f"differs from stock: segment {n}: {difference}", [plain, talus]
    return "", [plain, talus]
