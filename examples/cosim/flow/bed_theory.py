# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What is known of beds in a flow upwards: SI units."""

import math

GRAVITY = 9.81


class SpheresInGas:
    """Densities of both, and the viscosity of the gas."""

    def __init__(self, density, viscosity, of_grains):
        self.density, self.viscosity, self.of_grains = density, viscosity, of_grains

    def ergun(self, porosity, superficial, d):
        """Pressure gradient (Pa/m) of a bed: Ergun, Chem. Eng. Prog. 48, 89 (1952)."""
        solid = 1.0 - porosity
        return (150.0 * self.viscosity * solid / d ** 2 + 1.75 * self.density * superficial / d) * solid * superficial / porosity ** 3

    def weight(self, porosity):
        """Of a bed less buoyancy, per volume."""
        return (self.of_grains - self.density) * (1.0 - porosity) * GRAVITY

    def minimum_fluidization(self, porosity, d):
        """The superficial velocity at which both are equal."""
        low, high = 0.0, 100.0
        for _ in range(200):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.ergun(porosity, middle, d) < self.weight(porosity) else (low, middle)
        return low

    def wen_yu(self, d):
        """The same without the porosity: Re = (33.7^2 + 0.0408 Ar)^1/2 - 33.7, Wen and Yu, AIChE J. 12, 610 (1966)."""
        archimedes = self.density * (self.of_grains - self.density) * GRAVITY * d ** 3 / self.viscosity ** 2
        return (math.sqrt(33.7 ** 2 + 0.0408 * archimedes) - 33.7) * self.viscosity / (self.density * d)


def natural_frequency(height):
    """Of the pressure below a bubbling bed of that height: Baskakov, Tuponogov and Filippovsky, Powder Technol. 45, 113 (1986)."""
    return math.sqrt(GRAVITY / height) / math.pi
