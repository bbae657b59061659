# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What became of a run, by number: energy, overlap, particles, finite numbers; and whether anyone said so."""

import dataclasses
import math

GROWTH, OVERLAP = 1e-3, 0.1      # above these a run counts as bad

# what a warning must be about to count for a fault: words of it, by the word of faults()
DEEP = ("overlap", "moves by", "move past", "time step is", "Lost")
TOLD_BY = {"energy": ("time step", "overlap", "Lost"), "overlap": DEEP, "lost": DEEP, "not": DEEP, "passed": DEEP}


@dataclasses.dataclass
class Grains:
    """What the energies need. normal: "hooke" or "hertz" with stiffness kn, radius by sphere;
    floors: list of (axis, place, sign) of planes that push along sign; period: edge lengths or None; clump: number of the clump by
    sphere, whose spheres do not touch each other, or nothing."""
    normal: str
    kn: float
    radius: list
    mass: list
    gravity: float = 0.0
    floors: tuple = ()
    period: tuple = (None, None, None)
    clump: tuple = ()

    def spring(self, overlap, radius):
        """Elastic energy of one contact with the effective radius."""
        if self.normal == "hooke":
            return 0.5 * self.kn * overlap**2
        return 0.4 * self.kn * math.sqrt(radius) * overlap**2.5


@dataclasses.dataclass
class Outcome:
    """growth: rise of the energy from the beginning to the mean of the last tenth of the run, over the largest
    kinetic or elastic energy; in the middle of an impact the energy of any scheme is off by some (omega dt)^2 and
    comes back, which is not counted. swing: largest rise at any moment. creep: largest way of a particle in the last nine tenths of the run, over its radius."""
    growth: float = 0.0
    swing: float = 0.0
    overlap: float = 0.0
    lost: int = 0
    passed: bool = False       # what was to meet never touched
    finite: bool = True
    creep: float = 0.0
    kinetic: float = 0.0       # at the end
    steps: int = 0             # that were done
    warnings: tuple = ()
    error: str = ""

    def faults(self):
        found = []
        if not self.finite:
            found.append("not a number")
        if self.lost:
            found.append(f"{self.lost} lost")
        if self.passed:
            found.append("passed through")
        if self.growth > GROWTH:
            found.append(f"energy +{self.growth:.1e}")
        if self.overlap > OVERLAP:
            found.append(f"overlap {self.overlap:.2f} r")
        return found

    def told(self, fault):
        """Whether a warning is about a fault."""
        kind = next(k for k in TOLD_BY if k in fault.split())
        return any(words in warning for warning in self.warnings for words in TOLD_BY[kind])

    def word(self):
        """stable; or what was said about a run that is not: refused, stopped, warned (of every fault), silent."""
        if self.error:
            return "refused" if self.steps == 0 else "stopped"
        if not self.faults():
            return "stable"
        return "warned" if all(map(self.told, self.faults())) else "silent"


def _pairs(x, grains):
    """Index pairs that touch, with their distance: sorted along z, brute force along the rest."""
    order = sorted(range(len(x)), key=lambda k: x[k][2])
    reach = 2 * max(grains.radius)
    wrapped = grains.period[2] is not None
    for n, i in enumerate(order):
        for j in order[n + 1:]:
            if grains.clump and grains.clump[i] == grains.clump[j]:
                continue
            if not wrapped and x[j][2] - x[i][2] > reach:
                break
            square = 0.0
            for d in range(3):
                gap = x[j][d] - x[i][d]
                if grains.period[d] is not None:
                    gap = math.remainder(gap, grains.period[d])
                square += gap * gap
            if square < (grains.radius[i] + grains.radius[j])**2:
                yield i, j, math.sqrt(square)


def contacts(x, grains):
    """(overlap, effective radius, smaller radius) of every contact, planes included."""
    found = []
    for i, j, distance in _pairs(x, grains):
        a, b = grains.radius[i], grains.radius[j]
        found.append((a + b - distance, a * b / (a + b), min(a, b)))
    for axis, place, sign in grains.floors:
        for row, r in zip(x, grains.radius):
            overlap = r - sign * (row[axis] - place)
            if overlap > 0:
                found.append((overlap, r, r))
    return found


def energies(frame, grains):
    """(kinetic, elastic, potential), largest overlap over the smaller radius, of a frame with columns
    x y z vx vy vz omegax omegay omegaz."""
    x = list(zip(frame["x"], frame["y"], frame["z"]))
    kinetic = sum(0.5 * m * (a * a + b * b + c * c) + 0.2 * m * r * r * (p * p + q * q + s * s)
                  for m, r, a, b, c, p, q, s in zip(grains.mass, grains.radius, frame["vx"], frame["vy"], frame["vz"],
                                                    frame["omegax"], frame["omegay"], frame["omegaz"]))
    touching = contacts(x, grains)
    elastic = sum(grains.spring(overlap, radius) for overlap, radius, _ in touching)
    height = sum(m * row[2] for m, row in zip(grains.mass, x)) * grains.gravity
    return (kinetic, elastic, height), max((overlap / r for overlap, _, r in touching), default=0.0)


def said(result):
    """Warnings and error of a lammps.Result that are about the scene."""
    about = ("gran/penalty", "Lost", "large/body", "shape/gran")
    return {"warnings": tuple(w for w in result.warnings() if any(word in w for word in about)), "error": result.error()}


def judge_account(rows, result, count, driven=False, meet=False):
    """The same from what the run itself has printed: rows (step, particles, kinetic, potential, elastic, overlap over the
    radius). driven: something outside does work, so that energies may rise. meet: some row must have an overlap."""
    outcome = Outcome(**said(result))
    for step, particles, *_, overlap in rows:
        outcome.steps = max(outcome.steps, int(step))
        outcome.lost = max(outcome.lost, count - int(particles))
        outcome.overlap = max(outcome.overlap, overlap)
    outcome.passed = meet and bool(rows) and outcome.overlap == 0.0
    outcome.finite = all(math.isfinite(number) for row in rows for number in row)
    whole = [row for row in rows if row[1] == count]
    if driven or not whole or not outcome.finite:
        return outcome
    total = [sum(row[2:5]) for row in whole]
    scale = max(max(row[2], row[4]) for row in whole)
    if scale > 0.0:
        tail = total[-max(1, len(total) // 10):]
        outcome.growth, outcome.swing = (sum(tail) / len(tail) - total[0]) / scale, (max(total) - total[0]) / scale
    outcome.kinetic = whole[-1][2]
    return outcome


def judge(frames, result, grains):
    """Outcome of a run from its frames [(step, columns)] and its lammps.Result."""
    outcome = Outcome(**said(result))
    total, scale, start, early = [], 0.0, None, None
    for step, frame in frames:
        outcome.steps = max(outcome.steps, step)
        outcome.lost = max(outcome.lost, len(grains.mass) - len(frame["x"]))
        if not all(math.isfinite(c) for key in frame for c in frame[key]):
            outcome.finite = False
            break
        if outcome.lost:
            continue
        (kinetic, elastic, height), overlap = energies(frame, grains)
        outcome.overlap = max(outcome.overlap, overlap)
        outcome.kinetic = kinetic
        scale = max(scale, kinetic, elastic) if start is not None else max(kinetic, elastic)
        total.append(kinetic + elastic + height)
        start = total[0] if start is None else start
        if early is None and step >= 0.1 * frames[-1][0]:
            early = frame
        if early:
            outcome.creep = max(outcome.creep, max(
                math.dist(a, b) / r for a, b, r in zip(zip(early["x"], early["y"], early["z"]),
                                                       zip(frame["x"], frame["y"], frame["z"]), grains.radius)))
    if total and scale > 0.0:
        tail = total[-max(1, len(total) // 10):]
        outcome.growth = (sum(tail) / len(tail) - start) / scale
        outcome.swing = (max(total) - start) / scale
    return outcome
