# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""A fluid among grains: the volume-averaged equations of Navier and Stokes (Anderson and Jackson 1967, model A)

    de/dt + div(e u) = 0
    rho e (du/dt + u grad u) = - e grad p + mu e laplace(u) - S

with porosity e, pressure p without its hydrostatic part, and S the force of drag on grains per volume.  Finite volumes of equal
cubes on a staggered grid (velocities on faces), periodic along x and y, a given flow through the floor and p = 0 at the top;
upwind differences; pressure and drag are taken at the new time, by a projection.  Drag that a step takes ahead of the grains, for
the change of the velocity, is given back in the next one: the fluid loses in all what grains get.

Arrays are [z][y][x] with one more layer of cells below and above.  Component d of a velocity at a cell is that on the face
between it and the next cell along d (0: x, 1: y, 2: z)."""

import numpy
from flow.pressure import PressureEquation

AXES = (2, 1, 0)    # of arrays, for x, y, z


def ahead(a, d):
    return numpy.roll(a, -1, AXES[d])


def behind(a, d):
    return numpy.roll(a, 1, AXES[d])


def on_faces(a, d):
    return 0.5 * (a + ahead(a, d))


def with_ends(values):
    """Of all cells, with copies below and above."""
    return numpy.concatenate((values[:1], values, values[-1:]))


class AveragedFlow:

    def __init__(self, cells, edge, density, viscosity):
        """cells: along x, y, z; edge: of a cell."""
        self.edge, self.density, self.viscosity = edge, density, viscosity
        shape = (cells[2] + 2, cells[1], cells[0])
        self.u = [numpy.zeros(shape) for _ in range(3)]
        self.ahead = [numpy.zeros(shape) for _ in range(3)]
        self.p = numpy.zeros(shape)
        self.porosity = None

    # ---- in cells

    def velocity(self):
        """[z][y][x][3]"""
        return numpy.stack([(0.5 * (self.u[d] + behind(self.u[d], d)))[1:-1] for d in range(3)], axis=-1)

    def pressure(self):
        return self.p[1:-1]

    def pressure_gradient(self):
        """[z][y][x][3]: means of those on faces, of which the floor has that of the next one."""
        slopes = [(ahead(self.p, d) - self.p) / self.edge for d in range(3)]
        slopes[2][0] = slopes[2][1]
        return numpy.stack([(0.5 * (slopes[d] + behind(slopes[d], d)))[1:-1] for d in range(3)], axis=-1)

    def pressure_at_floor(self):
        first, second = self.p[1].mean(), self.p[2].mean()
        return first + 0.5 * (first - second)

    # ---- of all cells

    def volume(self):
        return self.porosity[1:-1].sum() * self.edge ** 3

    def outflow(self):
        """Volume per time, through the top."""
        return (on_faces(self.porosity, 2) * self.u[2])[-2].sum() * self.edge ** 2

    # ---- a step

    def step(self, dt, solid, drag, coefficient, superficial):
        """One time step. solid: fraction of grains; drag: S of the last interval ([z][y][x][3]), found with the velocity that is
        to be replaced; coefficient: its derivative by that. superficial: velocity of the flow through the floor."""
        e = with_ends(1.0 - solid)
        change = numpy.zeros_like(e) if self.porosity is None else (e - self.porosity) / dt
        self.porosity = e
        beta, s = with_ends(coefficient), with_ends(drag)
        old, guess, mobility = self.u, [], []
        for d in range(3):
            e_face, u = on_faces(e, d), old[d]
            total = self.density * e_face / dt + on_faces(beta, d)
            forces = e_face * (self.viscosity * self._laplace(u) - self.density * self._convection(d))
            guess.append(u + (forces - on_faces(s[..., d], d) + self.ahead[d]) / total)
            mobility.append(e_face / total)
        self._set_ends(guess, e, superficial)
        mobility[2][0] = 0.0
        self._project(guess, mobility, e, change)
        self._set_ends(self.u, e, superficial)
        self.ahead = [on_faces(beta, d) * (self.u[d] - old[d]) for d in range(3)]

    def _set_ends(self, u, e, superficial):
        for d in range(2):
            u[d][0] = 0.0
            u[d][-1] = u[d][-2]
        u[2][0] = superficial / e[0]
        u[2][-1] = u[2][-2]

    def _laplace(self, u):
        return sum(ahead(u, d) - 2.0 * u + behind(u, d) for d in range(3)) / self.edge ** 2

    def _convection(self, d):
        """u grad u_d on faces of d."""
        u, total = self.u[d], numpy.zeros_like(self.p)
        for other in range(3):
            carrier = u if other == d else on_faces(0.5 * (self.u[other] + behind(self.u[other], other)), d)
            total += numpy.maximum(carrier, 0.0) * (u - behind(u, other)) + numpy.minimum(carrier, 0.0) * (ahead(u, other) - u)
        return total / self.edge

    def _project(self, guess, mobility, e, change):
        """Pressure such that div(e u) = -de/dt with u = guess - mobility grad p."""
        right, weights = -change, []
        for d in range(3):
            e_face = on_faces(e, d)
            flow = e_face * guess[d]
            right = right - (flow - behind(flow, d)) / self.edge
            weights.append(e_face * mobility[d] / self.edge ** 2)
        equation = PressureEquation(weights[0][1:-1], weights[1][1:-1], weights[2][:-1])
        self.p[1:-1] = equation.solve(right[1:-1], self.p[1:-1])
        self.u = [guess[d] - mobility[d] * (ahead(self.p, d) - self.p) / self.edge for d in range(3)]
