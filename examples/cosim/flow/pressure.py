# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""The equation of the pressure on a grid of cells, periodic along x and y: conjugate gradients, which start from a given pressure.
They are preconditioned by the same equation with the mean weights of each layer, solved by Fourier transforms along x and y and
elimination along z."""

import numpy


class PressureEquation:
    """Sum over the faces of a cell of weight (p - p of the neighbor) = right, with p = 0 above the top.

    along_x, along_y: weights of the faces to the next cell, [z][y][x]; along_z: of the faces below each layer, from the floor,
    where they are 0, to the top, one layer more."""

    def __init__(self, along_x, along_y, along_z):
        self.x, self.y, self.z = along_x, along_y, along_z
        self._eliminate()

    def product(self, p):
        east, north = self.x * (p - numpy.roll(p, -1, 2)), self.y * (p - numpy.roll(p, -1, 1))
        up = numpy.zeros_like(self.z)
        up[1:-1] = self.z[1:-1] * (p[:-1] - p[1:])
        up[-1] = self.z[-1] * p[-1]
        return east - numpy.roll(east, 1, 2) + north - numpy.roll(north, 1, 1) + up[1:] - up[:-1]

    def _eliminate(self):
        nz, ny, nx = self.x.shape
        of_x = 2.0 - 2.0 * numpy.cos(2.0 * numpy.pi * numpy.arange(nx // 2 + 1) / nx)
        of_y = 2.0 - 2.0 * numpy.cos(2.0 * numpy.pi * numpy.arange(ny) / ny)
        x, y, self.below = self.x.mean(axis=(1, 2)), self.y.mean(axis=(1, 2)), self.z.mean(axis=(1, 2))
        self.pivots = numpy.empty((nz, ny, nx // 2 + 1))
        for k in range(nz):
            self.pivots[k] = x[k] * of_x + y[k] * of_y[:, None] + self.below[k] + self.below[k + 1]
            if k:
                self.pivots[k] -= self.below[k] ** 2 / self.pivots[k - 1]

    def precondition(self, right):
        modes = numpy.fft.rfft2(right)
        for k in range(1, len(modes)):
            modes[k] += self.below[k] / self.pivots[k - 1] * modes[k - 1]
        modes[-1] /= self.pivots[-1]
        for k in range(len(modes) - 2, -1, -1):
            modes[k] = (modes[k] + self.below[k + 1] * modes[k + 1]) / self.pivots[k]
        return numpy.fft.irfft2(modes, right.shape[1:])

    def solve(self, right, p, relative=1e-9, most=200):
        """With residuals below that part of the norm of the right side, or a RuntimeError."""
        residual = right - self.product(p)
        enough = relative * numpy.linalg.norm(right)
        direction, before = numpy.zeros_like(p), 1.0
        for _ in range(most):
            if numpy.linalg.norm(residual) <= enough:
                return p
            better = self.precondition(residual)
            now = numpy.vdot(residual, better)
            direction = better + now / before * direction
            before = now
            product = self.product(direction)
            length = now / numpy.vdot(direction, product)
            p = p + length * direction
            residual = residual - length * product
        raise RuntimeError(f"the pressure is not found in {most} iterations")
