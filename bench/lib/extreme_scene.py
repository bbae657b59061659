# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What an extreme scene of spheres or clumps is."""

import dataclasses
import math

YOUNG, NU = 1.0e7, 0.3


@dataclasses.dataclass
class Ball:
    x: tuple
    v: tuple = (0.0, 0.0, 0.0)
    w: tuple = (0.0, 0.0, 0.0)
    diameter: float = 1.0
    density: float = 1000.0

    def mass(self):
        return self.density * math.pi / 6 * self.diameter**3


@dataclasses.dataclass
class Extreme:
    """law: (kind, kn, gn, kt, gt, mu) of gran/*, or ("material", E, e, nu, mu). fraction: time step over the
    smallest critical one of compute timestep/gran. planes: (axis, place, sign). frames: how many are looked at."""
    name: str
    balls: list
    law: tuple
    steps: int
    box: tuple
    fraction: float = 0.2
    frames: int = 400
    gravity: float = 0.0
    planes: tuple = ()
    periodic: str = "f f f"
    fixed: tuple = ()            # indices of balls that are frozen
    units: str = "si"
    skin: float = 0.1
    dt: float = 0.0              # instead of a fraction
    creep: bool = False          # whether creep is what matters
    midpoint: bool = False       # the second-order update of tangential displacements, with Talus
    clumps: tuple = ()           # number of the clump by ball, from 1; none: single balls

    def hertz(self):
        return self.law[0] in ("hertz", "material")

    def stiffness(self):
        if self.law[0] == "material":
            return 4 / 3 * self.law[1] / (2 * (1 - self.law[3]**2))
        return self.law[1]
