# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Clumps of three spheres that overlap, and single spheres among them, thrown at each other."""

import math
import random

from talus_testing import Sphere, write_sphere_data

PLACES = (0.0, 0.0, 0.0), (0.8, 0.1, 0.0), (0.3, 0.7, 0.2)
FLAT_PLACES = tuple((x, y, 0.0) for x, y, _ in PLACES)
DIAMETERS = 1.0, 0.9, 0.8
BOX = (0, 9), (0, 9), (0, 9)
FLAT_BOX = (0, 15), (0, 15), (-0.5, 0.5)


def random_rotation(draw):
    w, x, y, z = (draw.gauss(0, 1) for _ in range(4))
    n = math.sqrt(w * w + x * x + y * y + z * z)
    w, x, y, z = w / n, x / n, y / n, z / n
    return ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))


def random_turn(draw):
    """About z."""
    angle = draw.uniform(0, 2 * math.pi)
    return (math.cos(angle), -math.sin(angle), 0.0), (math.sin(angle), math.cos(angle), 0.0), (0.0, 0.0, 1.0)


def clump_at(center, v, omega, turn, places=PLACES):
    """Spheres of one clump, in rigid motion."""
    found = []
    for place, diameter in zip(places, DIAMETERS):
        arm = [sum(a * b for a, b in zip(row, place)) for row in turn]
        cross = (omega[1] * arm[2] - omega[2] * arm[1], omega[2] * arm[0] - omega[0] * arm[2],
                 omega[0] * arm[1] - omega[1] * arm[0])
        found.append(Sphere(tuple(c + a for c, a in zip(center, arm)), tuple(a + b for a, b in zip(v, cross)),
                            tuple(omega), diameter))
    return found


def tossed_in_space(draw):
    """(molecule, sphere): 3 x 3 x 3 sites, every fifth of which holds a single sphere of type 2 (molecule 0)."""
    grains = []
    for n, (i, j, k) in enumerate((i, j, k) for i in range(3) for j in range(3) for k in range(3)):
        center = tuple(3.0 * s + 1.2 for s in (i, j, k))
        v, omega = (tuple(draw.gauss(0, 3.0) for _ in "xyz") for _ in "vw")
        if n % 5 == 4:
            grains.append((0, Sphere(center, v, omega, type=2)))
        else:
            grains += [(n + 1, one) for one in clump_at(center, v, omega, random_rotation(draw))]
    return grains


def tossed_in_a_plane(draw):
    """The same at 5 x 5 sites of the plane z = 0."""
    grains = []
    for n, (i, j) in enumerate((i, j) for i in range(5) for j in range(5)):
        center, v = (3.0 * i + 1.2, 3.0 * j + 1.2, 0.0), (draw.gauss(0, 3.0), draw.gauss(0, 3.0), 0.0)
        omega = 0.0, 0.0, draw.gauss(0, 3.0)
        if n % 5 == 4:
            grains.append((0, Sphere(center, v, omega, type=2)))
            continue
        grains += [(n + 1, one) for one in clump_at(center, v, omega, random_turn(draw), FLAT_PLACES)]
    return grains


def write_clumps(path, seed=5, box=BOX, toss=tossed_in_space):
    """A data file with Molecules. IDs are in no order."""
    draw = random.Random(seed)
    grains = toss(draw)
    ids = list(range(1, len(grains) + 1))
    draw.shuffle(ids)
    for tag, (_, one) in zip(ids, grains):
        one.id = tag
        one.x = tuple(lo + (x - lo) % (hi - lo) if d < 2 else x for d, (x, (lo, hi)) in enumerate(zip(one.x, box)))
    write_sphere_data(path, box, [one for _, one in grains])
    with open(path, "a") as file:
        file.write("\nMolecules\n\n")
        for tag, (molecule, _) in zip(ids, grains):
            file.write(f"{tag} {molecule}\n")
