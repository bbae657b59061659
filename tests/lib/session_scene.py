# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Grains that slide and collide on a floor in the corner of two walls: the scene of whole sessions in one process."""

import random

from talus_testing import Sphere, head

LAW = "hertz 4000.0 40.0 tangential multistep NULL NULL 0.5"
BOX = (-1, 12), (-1, 10), (-1, 12)
START = head()
PAIR = f"pair_style gran/penalty\npair_coeff * * {LAW}\n"
# {ylo}: the body behind
PHYSICS = f"""
neighbor 0.1 bin
timestep 0.001
fix step all nve/sphere/symplectic gravity 4.0 vector 0.3 0.1 -1
fix floor all large/body plane 0 0 0  0 0 1  contact {LAW}
fix xlo all large/body plane 0 0 0  1 0 0  contact {LAW}
fix ylo all large/body {{ylo}}  contact {LAW}
"""
PLANE, RECTANGLE = "plane 0 0 0  0 1 0", "rectangle 5 0 5  0 1 0  1 0 0  30 30"


def grains(largest):
    """7 x 6 x 8 of them, with diameters between .7 and `largest`."""
    draw = random.Random(4)
    return [Sphere(tuple(1.05 * s + 0.6 + draw.uniform(-0.1, 0.1) for s in (i, j, k)),
                   diameter=draw.uniform(0.7, largest))
            for i in range(7) for j in range(6) for k in range(8)]
