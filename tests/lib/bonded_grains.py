# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Data files of bonded spheres for tests."""

import itertools
import math
import random


def write_bonded_data(path, box, spheres, bonds, bond_types=1, style="bpm/sphere"):
    with open(path, "w") as file:
        file.write(bonded_data(box, spheres, bonds, bond_types, style))


def bonded_data(box, spheres, bonds, bond_types=1, style="bpm/sphere"):
    """spheres: (x, v, omega, diameter, density); bonds: (type, i, j) with IDs from 1, the places in spheres. style: of atoms, bpm/sphere or
    hybrid sphere bond."""
    row = "{n} 1 1 {diameter!r} {density!r} {place}" if style == "bpm/sphere" else "{n} 1 {place} {diameter!r} {density!r} 1"
    rows = ["Talus test", "", f"{len(spheres)} atoms", "1 atom types", f"{len(bonds)} bonds", f"{bond_types} bond types",
            "20 extra bond per atom", "40 extra special per atom"]
    rows += [f"{low!r} {high!r} {axis}lo {axis}hi" for axis, (low, high) in zip("xyz", box)]
    rows += ["", f"Atoms # {style.split()[0]}", ""]
    rows += [row.format(n=n, diameter=diameter, density=density, place=" ".join(map(repr, x)))
             for n, (x, _, _, diameter, density) in enumerate(spheres, 1)]
    rows += ["", "Velocities", ""]
    rows += [f"{n} " + " ".join(repr(float(c)) for c in (*v, *omega)) for n, (_, v, omega, _, _) in enumerate(spheres, 1)]
    if bonds:
        rows += ["", "Bonds", ""]
    rows += [f"{n} " + " ".join(map(str, bond)) for n, bond in enumerate(bonds, 1)]
    return "\n".join(rows) + "\n"


def crystal(cells, spacing, origin=(0.0, 0.0, 0.0), jitter=0.05, velocity=(0.0, 0.0, 0.0), seed=1, spin=0.3):
    """Spheres of diameter 1 near the places of a face-centered crystal with that distance of neighbors."""
    draw, edge, spheres = random.Random(seed), spacing * math.sqrt(2.0), []
    for cell in itertools.product(*map(range, cells)):
        for site in (0, 0, 0), (0.5, 0.5, 0), (0.5, 0, 0.5), (0, 0.5, 0.5):
            x = tuple(o + edge * (c + s) + draw.uniform(-jitter, jitter) for o, c, s in zip(origin, cell, site))
            spheres.append((x, tuple(v + draw.gauss(0, 0.02) for v in velocity),
                            tuple(draw.gauss(0, spin) for _ in "xyz"), 1.0, 1.0))
    return spheres


def bonds_within(spheres, distance, first=1, types=1):
    """(type, i, j) of all pairs that are nearer; types by turns."""
    found = []
    for (i, a), (j, b) in itertools.combinations(enumerate(spheres, start=first), 2):
        if math.dist(a[0], b[0]) < distance:
            found.append((1 + (i + j) % types, i, j))
    return found
