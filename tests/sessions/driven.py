# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What drives the box of a scene, drawn at random: sides that move as told, sides that follow a pressure."""

from laws import PRESSURE, RATE, SPEED, some
from quantities import duration, length, line

GAIN = 1, -1, 1    # strain rate over pressure
REMAP = "x", "v", "none"


def _number(rng, word):
    return {"erate": lambda: some(rng, -0.5, 0.5, *RATE), "trate": lambda: some(rng, -0.5, 0.5, *RATE),
            "vel": lambda: some(rng, -1, 1, *SPEED),
            "wiggle": lambda: (length(0.05), duration(0.2))}[word]()


def _sides(rng, periodic, bonded):
    """fix deform; and whether the box has to be triclinic. Boxes that flip stretch bonds beyond half of them, where LAMMPS warns that
    images of their ends are wrong."""
    words = [(k, word, _number(rng, word)) for k in rng.sample("xyz", rng.choice((1, 1, 2, 3)))
             for word in (rng.choice(("erate", "erate", "trate", "vel", "wiggle")),)]
    if len(words) == 1 and rng.random() < 0.3:
        other = rng.choice([k for k in "xyz" if k != words[0][0]])
        words.append((other, "volume"))
    tilted = periodic == "ppp" and rng.random() < 0.3
    if tilted:
        words.append((rng.choice(("xy", "xz", "yz")), "erate", some(rng, *((-1, 1) if bonded else rng.choice(((-1, 1), (15, 25)))), *RATE)))
    return line("fix drive all deform", rng.choice((1, 1, 1, 4)), words, "remap", rng.choice(REMAP)), tilted


def _pressures(rng, periodic):
    """fix deform/pressure or press/berendsen."""
    free = [k for k, word in zip("xyz", periodic) if word == "p"]
    pressure = some(rng, 0, 200, *PRESSURE)
    if rng.random() < 0.4:
        how = line("iso", pressure, pressure, duration(0.1)) if periodic == "ppp" else line(free[0], pressure, pressure, duration(0.1))
        return line("fix drive all press/berendsen", how, "modulus", some(rng, 1e3, 1e4, *PRESSURE))
    words = [(k, "pressure", pressure, some(rng, 1e-4, 1e-2, *GAIN)) for k in rng.sample(free, rng.randint(1, len(free)))]
    return line("fix drive all deform/pressure 1", words, "max/rate", some(rng, 0.1, 2, *RATE), "remap", rng.choice(REMAP))


def driven(rng, scene):
    """The same with a box that changes. Traits: `deform`; `pressure` where it follows sums with rounding; `speeds` where Talus knows
    those of sides, and LAMMPS does not; `tilted` where it is triclinic."""
    periodic = _periodic(scene)
    if rng.random() < 0.25:
        fix = _pressures(rng, periodic)
        return scene.but(physics=(*scene.physics, fix), traits=scene.traits | {"deform", "pressure"} | _speeds(fix))
    fix, tilted = _sides(rng, periodic, "bonded" in scene.traits)
    box = (*scene.box, line("change_box all triclinic")) if tilted else scene.box
    traits = {"deform"} | _speeds(fix) | ({"tilted"} if tilted else set())
    return scene.but(box=box, physics=(*scene.physics, fix), traits=scene.traits | traits)


def _speeds(fix):
    return {"speeds"} if "v" in fix and {"pressure", "volume"} & set(fix) else set()


def _periodic(scene):
    """As ppf: of each direction."""
    words, = (words for words in scene.start if words[0] == "boundary")
    return "".join(words[1:]).replace(" ", "")
