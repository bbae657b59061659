# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""The largest stable time step, by bisection in the running code, and what linear theory says.

Spheres of mass 1 and diameter 1 with linear contacts of stiffness 1, pressed together so that contacts
never open, disturbed by 1e-9; unstable if the disturbance grows by 10^4."""

import dataclasses
import itertools
import math
import random

import lammps
from lammps import SECOND, STOCK, TALUS

OVERLAP, KICK, GROWTH = 1e-3, 1e-9, 1e4
DENSITY = 6 / math.pi
INERTIA = 0.4 * 0.25


@dataclasses.dataclass
class Case:
    """moving, fixed: lists of (position, radius). period: box edge if it is a lattice. zeta: damping ratio
    of one contact against a fixed sphere; friction: kt/kn, None without; mu is so large that nothing slides.
    drag: gt/gn."""
    group: str
    name: str
    moving: list
    fixed: list
    period: float = 0.0
    zeta: float = 0.0
    friction: float = None
    drag: float = 0.0
    hertz: bool = False      # with the same tangent stiffness at the overlap


def cage(n, ratio=1.0):
    """A sphere between n fixed ones that are `ratio` times as large."""
    t = math.sqrt(3)
    corners = {1: [(0, 0, -1)], 2: [(0, 0, -1), (0, 0, 1)],
               4: [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)],
               6: [tuple(s * (d == k) for d in range(3)) for k in range(3) for s in (1, -1)],
               8: list(itertools.product((1, -1), repeat=3)),
               12: [p for a, b in itertools.product((1, -1), repeat=2) for p in ((a, b, 0), (a, 0, b), (0, a, b))]}[n]
    length = {4: t, 8: t, 12: math.sqrt(2)}.get(n, 1.0)
    distance = 0.5 + 0.5 * ratio - OVERLAP
    return [((0.0, 0.0, 0.0), 0.5)], [(tuple(distance * c / length for c in p), 0.5 * ratio) for p in corners]


def lattice(kind):
    """(moving spheres, box edge): simple, body-centerd or face-centerd cubic, 6, 8, 12 contacts."""
    basis, edge, cells = {"sc": ([(0, 0, 0)], 1.0, 4), "bcc": ([(0, 0, 0), (.5, .5, .5)], 2 / math.sqrt(3), 4),
                          "fcc": ([(0, 0, 0), (.5, .5, 0), (.5, 0, .5), (0, .5, .5)], math.sqrt(2), 3)}[kind]
    edge *= 1 - OVERLAP
    return [(tuple(edge * (c + b) for c, b in zip(cell, base)), 0.5)
            for cell in itertools.product(range(cells), repeat=3) for base in basis], edge * cells


def cases(quick):
    found = [Case("damping", f"damping ratio {z}", *cage(1), zeta=z) for z in (0.0, 0.1, 0.3, 0.7)]
    for n in (12,) if quick else (2, 4, 12):
        found += [Case("damping", f"{n} contacts, damping ratio {z}", *cage(n), zeta=z) for z in (0.1, 0.3, 0.7)]
    for z in (0.3,) if quick else (0.1, 0.3, 0.7):
        found.append(Case("damping", f"12 contacts, damping ratio {z}, kt/kn .286, gt/gn .5", *cage(12), zeta=z, friction=2 / 7,
                          drag=0.5))
    for n in (2, 6, 12) if quick else (2, 4, 6, 8, 12):
        for friction in (None, 2 / 7, 1.0):
            words = "no friction" if friction is None else f"kt/kn {friction:.3g}"
            found.append(Case("contacts", f"{n} contacts, {words}", *cage(n), friction=friction))
    for n in (1, 12):
        found.append(Case("Hertz", f"Hertz, {n} contacts, no friction", *cage(n), hertz=True))
    found.append(Case("Hertz", "Hertz, 12 contacts, kt/kn .286", *cage(12), friction=2 / 7, hertz=True))
    for ratio in (10,) if quick else (3, 10, 30, 100):
        found.append(Case("size", f"between 2 that are {ratio} times larger, kt/kn .286", *cage(2, ratio), friction=2 / 7))
    for kind in ("fcc",) if quick else ("sc", "bcc", "fcc"):
        spheres, edge = lattice(kind)
        # without friction a compressed lattice of less than twelve contacts gives way at any time step
        for friction in (None, 2 / 7) if kind == "fcc" else (2 / 7,):
            words = "no friction" if friction is None else "kt/kn .286"
            found.append(Case("lattice", f"{kind} lattice, {words}", spheres, [], edge, friction=friction))
    spheres, edge = lattice("fcc")
    found.append(Case("lattice", "fcc lattice, damping ratio 0.3, kt/kn .286, gt/gn .5", spheres, [], edge, zeta=0.3, friction=2 / 7,
                      drag=0.5))
    return found


# ---- theory -----------------------------------------------------------------------------------

def theory(case, order=1):
    """Largest stable time step for the linear system, by order of the integrator.

    With the stiffness and damping k, g of each normal and kt, gt of each tangential contact, the roots of the
    difference equation leave the unit circle at -1, where the largest eigenvalue of

        dt^2 sum B^T B (k + 2 order g/dt)/(1 + g dt/m_eff if order 2) + T^T T (kt + 2 order gt/dt)

    is 4; B and T: normal and tangential displacement of a contact by translations and rotations of spheres of
    mass 1. Order 2 is implicit in the normal damping of each contact and extrapolates the velocity else. Without
    damping this is 2/omega, for one damped contact 2 (sqrt(1 + zeta^2) - zeta) with order 1 and 2/omega with order 2."""
    contacts = list(_touching(case))
    mass = 0.5 if case.period else 1.0        # effective mass of every contact
    kt, g = case.friction or 0.0, 2 * case.zeta * mass
    draw = random.Random(1)
    mode = [[draw.uniform(-1, 1) for _ in range(6)] for _ in case.moving]
    low, high = 1e-3, 4.0
    while high - low > 1e-4:
        dt = 0.5 * (low + high)
        shared = 1 + g * dt / mass if order > 1 else 1.0
        normal = dt * dt * (1 + 2 * order * g / dt) / shared
        tangential = dt * dt * (kt + 2 * order * case.drag * g / dt)
        largest, mode = _largest_eigenvalue(contacts, normal, tangential, mode)
        low, high = (dt, high) if largest < 4 else (low, dt)
    return low


def _cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _largest_eigenvalue(contacts, normal, tangential, mode):
    """Of the stiffness in units of mass and moment of inertia, by power iteration that begins with `mode`: six numbers
    of each sphere, of which the last three are angles times sqrt(inertia). With its mode."""
    arm = 0.5 * INERTIA**-0.5
    size, steady = 0.0, 0
    while steady < 5:
        force = [[0.0] * 6 for _ in mode]
        for i, j, along in contacts:
            moved = [0.0] * 3                # of the surfaces past each other: u + theta x (-r n), and the same of j
            for sign, k in ((1.0, i), (-1.0, j)):
                if k is not None:
                    turn = _cross(along, mode[k][3:])
                    moved = [m + sign * u + arm * t for m, u, t in zip(moved, mode[k], turn)]
            off = sum(m * n for m, n in zip(moved, along))
            f = [normal * off * n + tangential * (m - off * n) for m, n in zip(moved, along)]
            moment = [arm * m for m in _cross(f, along)]
            for sign, k in ((1.0, i), (-1.0, j)):
                if k is not None:
                    for d in range(3):
                        force[k][d] += sign * f[d]
                        force[k][3 + d] += moment[d]
        last, size = size, math.sqrt(sum(f * f for row in force for f in row))
        steady = steady + 1 if abs(size - last) <= 1e-6 * size else 0
        mode = [[f / size for f in row] for row in force]
    return size, mode


def _touching(case):
    """(i, j or None for a fixed one, unit normal from j to i) of every contact once."""
    everyone = case.moving + case.fixed
    for i, j in itertools.combinations(range(len(everyone)), 2):
        if i >= len(case.moving):
            break
        (x, a), (y, b) = everyone[i], everyone[j]
        gap = [p - q for p, q in zip(x, y)]
        if case.period:
            gap = [math.remainder(g, case.period) for g in gap]
        distance = math.hypot(*gap)
        if distance < a + b:
            yield i, (j if j < len(case.moving) else None), [g / distance for g in gap]


# ---- measurement ------------------------------------------------------------------------------

SCRIPT = """variable low string {low!r}
variable high string {high!r}
variable critical string 0
variable allowed string 0
variable known string 0
variable k loop {halvings}
label again
variable h equal 0.5*(v_low+v_high)
variable here string ${{h}}
clear
units si
atom_style sphere
atom_modify map array
newton off
comm_modify vel yes
boundary {boundary}
read_data {data}
neighbor 0.05 bin
group moving type 1
group base type 2
{physics}
timestep ${{here}}
thermo 1000000000
thermo_modify lost ignore
{settle}
compute k moving ke
compute r moving erotate/sphere
fix ke moving ave/time 1 1 1 c_k c_r
run 0 post no
variable start string $(c_k+c_r)
variable growth equal (c_k+c_r)/v_start
variable unstable equal "!(v_growth<{square}) || count(moving)<{moving}"
fix stop all halt 1 v_unstable > 0 error continue message no
run {steps} post no
{critical}
if "${{unstable}}" then "variable high string ${{here}}" else "variable low string ${{here}}"
next k
jump SELF again
print "RESULT ${{low}} ${{high}} ${{critical}} ${{allowed}}"
"""


def _physics(case, code):
    gn = 2 * case.zeta
    kt, gt = (case.friction or 0.0), case.drag * 2 * case.zeta
    law, kn = "hooke", 1.0
    if case.hertz:      # F = kn sqrt(R overlap) overlap; kt is multiplied with the same root
        root = math.sqrt(0.25 * OVERLAP)
        law, kn, kt = "hertz", 1 / (1.5 * root), kt / root
    if code != STOCK:
        second = code == SECOND
        words = f"{law} {kn!r} {gn!r}" + (f" tangential multistep {kt!r} {gt!r} 1e4" + " slider midpoint" * second
                                          if case.friction else "") + " limit_damping" * (second and gn > 0)
        text = f"pair_style gran/penalty\npair_coeff * * {words}\n" \
               f"fix move moving nve/sphere/symplectic{' order 2' * second}\ncompute t all timestep/gran\n"
    else:
        mu = 1e4 if case.friction else 0.0
        text = f"pair_style gran/{law}/history {kn!r} {kt or 1.0!r} {gn!r} {gt!r} {mu!r} 1\npair_coeff * *\n" \
               "fix move moving nve/sphere\n"
    if len(case.fixed) == 1:      # what a single contact pushes away
        text += f"fix weight moving addforce 0.0 0.0 {-OVERLAP / (1.5 if case.hertz else 1.0)!r}\n"
    return text + "fix hold base freeze\nneigh_modify exclude group base base\n"


def _settle(case, code):
    """A contact that begins a run with a load has no force of a last step, which order 2 needs: time to come to rest,
    then the disturbance."""
    if code != SECOND or not (case.zeta and len(case.fixed) == 1):
        return ""
    return f"timestep 0.05\nrun 8000 post no\nvelocity moving set 0 0 {KICK}\ntimestep ${{here}}\n"


def write_case(case, path):
    low, high = min(-3.0, -3 * max((r for _, r in case.fixed), default=1)), max(3.0, 3 * max((r for _, r in case.fixed), default=1))
    box = ((0.0, case.period),) * 3 if case.period else ((low, high),) * 3
    # without friction, nothing keeps spheres in a row from buckling at any time step: kick them along it
    directions = [-1, -1, 2, -1, -1, -1] if len(case.fixed) in (1, 2) and not case.friction else range(6)
    rows, speeds = [], []
    for k, (x, r) in enumerate(case.moving + case.fixed):
        moves = k < len(case.moving)
        rows.append((k + 1, 1 if moves else 2, 2 * r, DENSITY, *x))
        speeds.append((k + 1, *(KICK * math.sin(1 + 3.7 * k + 1.3 * d) * (moves and d >= 0) for d in directions)))
    lammps.write_data(path, box, rows, speeds, types=2)


def measured(bench, case, code, steps):
    """(largest stable time step; the critical and the stable one of compute timestep/gran, None of stock)."""
    name = f"limit-{abs(hash((case.name, code))):x}"
    write_case(case, bench.path(name + ".data"))
    critical = "if \"${known} == 0\" then \"variable known string 1\" \"run 0 post no\" \"variable critical string $(c_t[1])\" \"variable allowed string $(c_t[7])\"" if code != STOCK else ""
    result = lammps.run(bench.workdir, name, SCRIPT.format(
        low=0.03, high=2.5, halvings=12 if not bench.quick else 9, boundary="p p p" if case.period else "f f f",
        data=name + ".data", physics=_physics(case, code), settle=_settle(case, code), steps=steps, square=GROWTH**2,
        moving=len(case.moving), critical=critical), code)
    low, high, critical, stable = result.printed("RESULT")[0]
    return 0.5 * (low + high), critical or None, stable or None
