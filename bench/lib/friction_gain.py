# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Energy gained in elastic impacts with friction: thousands of pairs of spheres that do not see each other.

Impacts differ in angle, spin, and in the moment within a time step at which they begin; the last is what a
first-order error depends on, so that a mean over it is what many impacts add up to."""

import math
import statistics

import lammps
from lammps import SECOND, STOCK, TALUS

R, DENSITY, YOUNG, NU = 0.5, 1000.0, 1.0e7, 0.3
MASS = DENSITY * math.pi / 6
ANGLES, SPINS = (0, 10, 20, 30, 45, 60, 75, 80), (-20, -5, -2, 0, 2, 5, 20)      # degrees, rad/s
FLIGHT, CONTACT = 0.2, 0.4       # time of the run before and with contact, in units of d/v


def critical():
    """sqrt(m_eff/k) at an overlap of 1 % of the radius: the smallest of the three rules here (s)."""
    return math.sqrt(MASS / 2 / (YOUNG / (1 - NU**2) * math.sqrt(R / 2 * 0.01 * R)))


def laws(code, mu, mu_roll, midpoint):
    if code == STOCK:
        return f"hertz/material {YOUNG!r} 1.0 {NU} tangential mindlin NULL 1.0 {mu!r} damping coeff_restitution"
    way = " slider midpoint" if code == SECOND else " midpoint" * midpoint
    return (f"hertz/material {YOUNG!r} 1.0 {NU} tangential multistep NULL NULL {mu!r}{way}"
            + (f" rolling {mu_roll!r}" if mu_roll else ""))


def _cases(types, phases):
    return [(angle, spin, t, phase) for angle in ANGLES for spin in SPINS for t in range(1, types + 1) for phase in range(phases)]


def _energy(v, w):
    return 0.5 * MASS * sum(c * c for c in v) + 0.2 * MASS * R * R * sum(c * c for c in w)


def _write(path, cases, types, phases, dt):
    side, rows, speeds = math.ceil(math.sqrt(len(cases))), [], []
    for n, (angle, spin, kind, phase) in enumerate(cases):
        along, across = 0.5 * math.cos(math.radians(angle)), 0.5 * math.sin(math.radians(angle))
        gap = 1e-3 + 2 * along * dt * (phase + 0.5) / phases
        for k, (sign, turn) in enumerate(((-1, 0.5), (1, 0.15))):
            rows.append((2 * n + k + 1, kind, 2 * R, DENSITY, 3.0 * (n % side), 3.0 * (n // side), sign * (R + gap / 2)))
            speeds.append((2 * n + k + 1, -sign * across, 0.0, -sign * along, 0.0, turn * spin, 0.0))
    lammps.write_data(path, ((-2, 3 * side), (-2, 3 * side), (-2, 2)), rows, speeds, types=types)
    return [_energy(s[1:4], s[4:]) for s in speeds]


def gains(bench, code, kinds, fraction, midpoint=False, phases=8):
    """kinds: [(mu, mu_roll), ...]. Returns for each (largest mean over the moments, largest gain, warnings' words)."""
    dt = fraction * critical()
    cases = _cases(len(kinds), phases)
    name = f"gain-{code}-{fraction}-{midpoint}-{len(kinds)}-{kinds[-1][1]}"
    before = _write(bench.path(name + ".data"), cases, len(kinds), phases, dt)
    coefficients = "\n".join(f"pair_coeff {t} {t} {laws(code, *kind, midpoint)}" for t, kind in enumerate(kinds, 1))
    if code == STOCK:      # particles of unlike types never meet
        coefficients += f"\npair_coeff * * {laws(code, 0.5, 0.0, False)}\n" + coefficients
    style, move = {STOCK: ("granular", "nve/sphere"), TALUS: ("gran/penalty", "nve/sphere/symplectic"),
                   SECOND: ("gran/penalty", "nve/sphere/symplectic order 2")}[code]
    steps = math.ceil((FLIGHT + CONTACT) / dt)
    lammps.run(bench.workdir, name, f"""units si
atom_style sphere
newton off
comm_modify vel yes
boundary f f f
read_data {name}.data
neighbor 0.1 bin
pair_style {style}
{coefficients}
fix move all {move}
timestep {dt!r}
thermo {steps}
run {steps}
write_dump all custom {name}.end id vx vy vz omegax omegay omegaz fx fy fz modify format float %.17g
""", code)
    (_, frame), = lammps.read_frames(bench.path(name + ".end"))
    return _judge(cases, before, frame, len(kinds))


def _judge(cases, before, frame, types):
    after = [_energy((a, b, c), (p, q, s)) for a, b, c, p, q, s in zip(*(frame[k] for k in (
        "vx", "vy", "vz", "omegax", "omegay", "omegaz")))]
    touching = [any((x, y, z)) for x, y, z in zip(frame["fx"], frame["fy"], frame["fz"])]
    found = [{} for _ in range(types)]
    for n, (angle, spin, kind, _) in enumerate(cases):
        if not touching[2 * n]:
            start = before[2 * n] + before[2 * n + 1]
            found[kind - 1].setdefault((angle, spin), []).append((after[2 * n] + after[2 * n + 1]) / start - 1)
    return [(max(statistics.fmean(g) for g in of.values()), max(max(g) for g in of.values())) for of in found]


def warned(bench, code, mu, mu_roll, fraction, midpoint):
    """What Talus says at the start of a run with this law: "", "time step", "any time step" or both."""
    dt = fraction * critical()
    lammps.write_data(bench.path("said.data"), ((-2, 2),) * 3, [(1, 1, 2 * R, DENSITY, 0.0, 0.0, 0.0)])
    result = lammps.run(bench.workdir, "said", f"""units si
atom_style sphere
newton off
comm_modify vel yes
boundary f f f
read_data said.data
neighbor 0.1 bin
pair_style gran/penalty
pair_coeff * * {laws(code, mu, mu_roll, midpoint)}
fix move all nve/sphere/symplectic{" order 2" * (code == SECOND)}
timestep {dt!r}
run 0
""")
    lines = [line for line in result.warnings() if "next to no damping" in line]
    return " and ".join("any time step" if "any time step" in line else "time step" for line in lines)
