# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""The smallest input that still shows a fault: parts of it are left out, runs shortened and numbers simplified as long as the same
thing goes wrong."""

import copy
import dataclasses
import re
import time

from pool import Session
from quantities import Quantity, Rounding
from scene import Scene


def kind_of(fault):
    """What stays the same of a fault while its numbers change."""
    return re.sub(r"[-\d.e]+", "", fault.split("\n")[0])[:40] if fault.startswith(("refused", "no message")) else fault.split(":")[0]


def shrink(relation, run, case, fault, seconds):
    """The case, made smaller within the time, and its fault."""
    end, wanted = time.monotonic() + seconds, kind_of(fault)
    progress = True
    while progress and time.monotonic() < end:
        progress = False
        for smaller in candidates(case):
            if time.monotonic() > end:
                break
            try:
                found, _ = relation.check(run, *smaller)
            except (KeyError, IndexError, ValueError):    # what is left is no case of this relation
                continue
            if found and kind_of(found) == wanted:
                case, fault, progress = smaller, found, True
                break
    return case, fault


def candidates(case):
    for n, part in enumerate(case):
        for smaller in _smaller(part):
            yield (*case[:n], smaller, *case[n + 1:])


def _smaller(part):
    if isinstance(part, Scene):
        yield from _scenes(part)
    elif isinstance(part, Session):
        for lines in _shorter(part.lines):
            smaller = copy.copy(part)
            smaller.lines = lines
            yield smaller
        for name, value in ("ranks", 1), ("threads", 1), ("ranks", 2):
            if getattr(part, name) > value:
                smaller = copy.copy(part)
                setattr(smaller, name, value)
                yield smaller
    elif isinstance(part, tuple) and part and isinstance(part[0], tuple) and isinstance(part[0][0], str):    # named variations
        yield from map(tuple, _shorter(part))


def _shorter(parts):
    """Without halves, quarters, ... and single ones."""
    parts, size = list(parts), len(parts) // 2
    while size >= 1:
        for n in range(0, len(parts), size):
            yield parts[:n] + parts[n + size:]
        size //= 2


def _scenes(scene):
    for kept in _shorter(range(len(scene.grains))):
        if kept:
            place = {n + 1: k for k, n in enumerate(kept, start=1)}
            yield scene.but(grains=tuple(scene.grains[n] for n in kept),
                            bonds=tuple((kind, place[i], place[j]) for kind, i, j in scene.bonds if i in place and j in place))
    for bonds in _shorter(scene.bonds):
        yield scene.but(bonds=tuple(bonds))
    for program in _shorter(scene.program):
        yield scene.but(program=tuple(program))
    for n in reversed(range(len(scene.physics))):
        words = scene.physics[n]
        if words[0] == "timestep":    # that of LAMMPS is another one in other units
            continue
        name = words[1] if words[0] == "fix" and len(words) > 1 else None
        yield scene.but(physics=scene.physics[:n] + scene.physics[n + 1:],
                        vectors=tuple(vector for vector in scene.vectors if vector[0] != name))
    if scene.vectors:
        yield scene.but(vectors=())
    for n, words in enumerate(scene.program):
        if words[0] == "run" and words[1] > 1:
            for steps in sorted({1, words[1] // 2, words[1] - 1}):
                if steps < words[1]:
                    yield scene.but(program=(*scene.program[:n], ("run", steps), *scene.program[n + 1:]))
    for n, words in enumerate(scene.physics):
        for shorter in _ends(words):
            yield scene.but(physics=(*scene.physics[:n], shorter, *scene.physics[n + 1:]))
    for n, grain in enumerate(scene.grains):
        for simpler in _grains(grain):
            yield scene.but(grains=(*scene.grains[:n], simpler, *scene.grains[n + 1:]))
    for n, words in enumerate(scene.physics):
        for k, word in enumerate(words):
            if isinstance(word, Quantity) and rounded(word, 2) != word and words[0] != "timestep":    # which would be zero
                yield scene.but(physics=(*scene.physics[:n], (*words[:k], rounded(word, 2), *words[k + 1:]), *scene.physics[n + 1:]))


OPTIONS = ("tangential", "rolling", "rolling sds", "spinning", "twisting sds", "adhesion constant", "adhesion willett", "adhesion rabinovich", "viscosity", "share",
           "heat radius", "heat area", "temperature", "limit_damping", "move free mass",
           "move linear", "move wiggle", "move rotate", "servo force", "gravity", "start", "velocity", "spin", "rounded", "midpoint",
           "slider", "stock")


def _ends(words):
    """Without an option and what belongs to it."""
    for n, word in enumerate(words):
        if word in OPTIONS and n > 1:
            end = next((k for k in range(n + 1, len(words)) if words[k] in OPTIONS or words[k] in ("contact", "density")), len(words))
            yield words[:n] + words[end:]


def _grains(grain):
    for name in "velocity", "spin":
        if any(getattr(grain, name).values):
            yield dataclasses.replace(grain, **{name: dataclasses.replace(getattr(grain, name), values=(0.0, 0.0, 0.0))})
    for name, simple in ("density", 1.0), ("diameter", 1.0):
        if getattr(grain, name).values != (simple,):
            yield dataclasses.replace(grain, **{name: dataclasses.replace(getattr(grain, name), values=(simple,))})
    simple = {name: rounded(getattr(grain, name), 3) for name in ("place", "velocity", "spin", "diameter")}
    if any(getattr(grain, name) != value for name, value in simple.items()):
        yield dataclasses.replace(grain, **simple)


def rounded(quantity, digits):
    return Rounding(digits).of(quantity)
