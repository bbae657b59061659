#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# packages: python3-numpy
"""A fluidized bed: a solver of the volume-averaged equations of Navier and Stokes (flow/averaged_flow.py) blows air through
grains that Talus moves; doc/coupling_fluid.md.

The solver lives on the first rank and takes drag implicitly, by the coefficients that put() returns; grains are on all ranks.
The bed settles, then the flow gets faster in stages.  Of each stage: pressure drop of the air and force of the floor over the weight of the
bed; both over that weight and the change of momentum of the grains, which must be 1; and inside of the bed the pressure gradient
over that of Ergun's equation.  In the end: minimum fluidization velocity, where gradients of the fixed bed come to the weight, against
equations of Ergun and of Wen and Yu; air and impulses that went astray; the frequency of the pressure in the last stage.

What is found goes to fluidized.csv and the plot fluidized.svg, pictures to fluidized.*.png, grains and air to
paraview/grains.pvd and air.pvd.

  . build/env.sh
  [mpirun -np 2] python3 examples/cosim/fluidized.py [--out DIR] [--quick]"""

import argparse
import collections
import math
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "python"))
import numpy
from flow.averaged_flow import AveragedFlow
from flow.bed_theory import GRAVITY, SpheresInGas, natural_frequency
from flow.paraview import Series
from lammps import lammps
from plots.drawing import Drawing
from talus import Partner

DENSITY, D = 2500.0, 1e-3    # of grains; their diameter, +- 5 %
AIR, VISCOSITY = 1.2, 1.8e-5
THEORY = SpheresInGas(AIR, VISCOSITY, DENSITY)
EDGE = 2.5 * D               # of cells
KERNEL = f"tophat {4 * D}"
FRAME = 25                   # exchanges between two frames for ParaView
SETTLE, CALM = 4000, 1000    # steps, of a fall and of a rest in which the bed stops to swing

BED = """
units si
atom_style sphere
newton off
comm_modify vel yes
processors * * 1
boundary p p f
region box block 0 {wide} 0 {thick} 0 {high} units box
create_box 1 box
region full block 0 {wide} 0 {thick} 0.0005 {top} units box
fill_region full 1 fraction 0.5 diameter uniform {low} {large} density {density} seed 4711
neighbor 0.0003 bin
pair_style gran/penalty
pair_coeff * * hooke 50 2.8e-3 tangential multistep NULL NULL 0.3
timestep 3e-5
fix step all nve/sphere/symplectic gravity {g} vector 0 0 -1
fix floor all large/body plane 0 0 0 0 0 1 contact hooke 50 2.8e-3 tangential multistep NULL NULL 0.3
thermo 0
run {settle}
fix calm all viscous 4e-4
run {calm}
unfix calm
log none
"""
FILM = """
dump film all vtk/gran {steps} "{out}/paraview/grains.pvd" radius vx vy vz
dump picture all image {seldom} "{out}/fluidized.*.png" vz diameter size 600 1000 zoom 1.7 view 80 -80 &
    center s 0.5 0.5 0.42 box no 0.0 shiny 0.3 fsaa yes
dump_modify picture pad 6 backcolor white amap -0.2 0.2 cf 0.0 3 min steelblue 0.5 wheat max firebrick
"""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", default=".", help="directory for what is written")
    parser.add_argument("--every", type=int, default=20, help="steps of grains for one of the fluid")
    parser.add_argument("--velocities", type=float, nargs="+", help="of the stages, over that of minimum fluidization")
    parser.add_argument("--time", type=float, nargs=2, metavar=("FIXED", "FLUIDIZED"),
                        help="of a stage below minimum fluidization and beyond (s); the last one takes twice as long")
    parser.add_argument("--quick", action="store_true", help="a small bed and few stages, for tests")
    options = parser.parse_args()
    options.out = os.path.abspath(options.out)
    options.cells, options.deep = ((4, 4), 20 * D) if options.quick else ((12, 4), 30 * D)
    options.velocities = options.velocities or ((0.5, 0.8, 1.2) if options.quick else (0.4, 0.8, 1.2, 1.5))
    options.time = options.time or (0.05, 0.06 if options.quick else 0.2)
    os.makedirs(os.path.join(options.out, "paraview"), exist_ok=True)
    return options


class Accounts:
    """Seconds of processor time that each part has taken."""

    def __init__(self):
        self.seconds = {}

    def timed(self, account, call, *words):
        begin = time.process_time()
        result = call(*words)
        self.seconds[account] = self.seconds.get(account, 0.0) + time.process_time() - begin
        return result

    def __str__(self):
        total = sum(self.seconds.values())
        return f"{total:.0f} s: " + ", ".join(f"{name} {100 * value / total:.0f} %" for name, value in self.seconds.items())


# ---- grains and air

Means = collections.namedtuple("Means", "drop floor balance pressures profile")


class Bed:
    """Both, in a column that is periodic along x and y. Fields are None but on the first rank, `here`."""

    def __init__(self, partner, cells, options):
        self.partner, self.every, self.here, self.accounts = partner, options.every, partner.lives_here, Accounts()
        self.dt = self.every * partner.dt    # of an interval
        size = [count * EDGE for count in cells]
        self.area = size[0] * size[1]
        self.fluid = partner.fluid_grid((0.0, 0.0, 0.0), size, cells, KERNEL)
        self.fluid.drag_law("gidaspow", AIR, VISCOSITY)
        self.flow = AveragedFlow(cells, EDGE, AIR, VISCOSITY)
        self.drag, self.coefficient = numpy.zeros((*cells[::-1], 3)), numpy.zeros(cells[::-1])
        self.film = Series(os.path.join(options.out, "paraview"), "air", cells, EDGE) if self.here else None
        self.floor = partner.body("floor")
        self.floor.watch()
        self.ids = partner.ids()
        radii = partner.particles(self.ids, "radius")
        if self.here:
            self.d = 2.0 * (radii ** 3).sum() / (radii ** 2).sum()    # of Sauter
            self.weight = (DENSITY - AIR) * GRAVITY * 4.0 / 3.0 * math.pi * (radii ** 3).sum()
        self.inflow = self.outflow = 0.0    # volumes of air
        self.given = numpy.zeros(3)         # impulse of drag, of all cells

    def interval(self, superficial):
        """One step of the air, and those of the grains; solid fractions before."""
        timed, dt = self.accounts.timed, self.dt
        solid = timed("exchange", self.fluid.grains, "solid")
        velocity = gradient = ()
        if self.here:
            first = self.flow.porosity is None
            timed("air", self.flow.step, dt, solid, self.drag, self.coefficient, superficial)
            velocity, gradient = self.flow.velocity(), self.flow.pressure_gradient()
            if first:
                self.first_volume = self.flow.volume()
            self.inflow += superficial * self.area * dt
            self.outflow += self.flow.outflow() * dt
        self.coefficient = timed("exchange", self.fluid.put, velocity, gradient, (0.0, 0.0, -GRAVITY) if self.here else None)
        timed("grains", self.partner.advance, self.every)
        exchange = timed("exchange", self.fluid.grains, "exchange")
        if self.here:
            self.drag = exchange / dt
            self.given += exchange.sum(axis=(0, 1, 2)) * EDGE ** 3
            if self.partner.step % (FRAME * self.every) == 0:
                self.film.write(self.partner.time, solid=solid, velocity=self.flow.velocity(), pressure=self.flow.pressure())
        return solid

    def momentum(self):
        """Of the grains, upwards."""
        fields = self.fluid.grains("solid", "velocity")
        return DENSITY * (fields[0] * fields[1][..., 2]).sum() * EDGE ** 3 if self.here else 0.0

    def hold(self, before, superficial, seconds):
        """The flow changes in the first 0.03 s, smoothly: the bed is a spring. Means over the rest: of the pressure drop and the force of
        the floor, over the weight, of both over the weight and what accelerates grains, of pressures and solid fractions of layers."""
        rounds, change = round(seconds / self.dt), round(0.03 / self.dt)
        for n in range(change):
            self.interval(before + 0.5 * (1.0 - math.cos(math.pi * (n + 1) / change)) * (superficial - before))
        self.floor.load()
        self.drops, pressures, profiles, momentum, begin = [], [], [], self.momentum(), self.partner.time
        for _ in range(rounds - change):
            solid = self.interval(superficial)
            if self.here:
                self.drops.append(self.flow.pressure_at_floor() * self.area / self.weight)
                pressures.append(self.flow.pressure().mean(axis=(1, 2)))
                profiles.append(solid.mean(axis=(1, 2)))
        load, momentum, passed = self.floor.load(), self.momentum() - momentum, self.partner.time - begin
        if not self.here:
            return None
        drop, floor = numpy.mean(self.drops), -load.impulse[2] / (self.weight * passed)
        return Means(drop, floor, (drop + floor) / (1.0 + momentum / (self.weight * passed)), numpy.mean(pressures, axis=0),
                     numpy.mean(profiles, axis=0))


# ---- the experiment

# velocity: over that of minimum fluidization
Stage = collections.namedtuple("Stage", "velocity drop floor balance gradient ergun voidage height")


class Taps:
    """Two layers of the settled bed that are not near the floor or the surface, between which the pressure gradient is measured."""

    def __init__(self, profile):
        filled = numpy.flatnonzero(profile > 0.5 * profile.max())
        self.low, self.high = filled[0] + 2, filled[-1] - 2

    def voidage(self, profile):
        """From the middle of one of these layers to that of the other."""
        return 1.0 - 0.5 * (profile[self.low:self.high] + profile[self.low + 1:self.high + 1]).mean()

    def gradient(self, pressures):
        return (pressures[self.low] - pressures[self.high]) / ((self.high - self.low) * EDGE)


def height(profile):
    """Of a bed, twice that of its center."""
    return 2.0 * EDGE * ((numpy.arange(len(profile)) + 0.5) * profile).sum() / profile.sum()


def fluidize(options):
    """Stages and the bed, which knows its height, voidage and minimum fluidization velocity at rest."""
    layers = round(2.5 * options.deep / EDGE)
    wide, thick = (count * EDGE for count in options.cells)
    lmp = lammps(cmdargs=["-log", os.path.join(options.out, "log.fluidized"), "-screen", "none"])
    lmp.commands_string(BED.format(wide=wide, thick=thick, high=layers * EDGE, top=1.3 * options.deep, low=0.95 * D, large=1.05 * D,
                                   density=DENSITY, g=GRAVITY, settle=SETTLE, calm=CALM))
    lmp.commands_string(FILM.format(out=options.out, steps=FRAME * options.every, seldom=4 * FRAME * options.every))
    stages, before = [], 0.0
    with Partner(lmp, root=0) as partner:
        bed = Bed(partner, (*options.cells, layers), options)
        means = bed.hold(0.0, 0.0, 0.04)
        if bed.here:
            taps, bed.height = Taps(means.profile), height(means.profile)
            bed.voidage = taps.voidage(means.profile)
            bed.umf = THEORY.minimum_fluidization(bed.voidage, bed.d)
        for share in options.velocities:
            superficial = share * bed.umf if bed.here else 0.0
            means = bed.hold(before, superficial, options.time[share > 1.0] * (1 + (share == options.velocities[-1])))
            before = superficial
            if bed.here:
                voidage = taps.voidage(means.profile)
                stages.append(Stage(share, means.drop, means.floor, means.balance, taps.gradient(means.pressures),
                                    THEORY.ergun(voidage, superficial, bed.d), voidage, height(means.profile)))
        by_grain = partner.drag_impulses(bed.ids)
        if bed.here:
            bed.astray = abs(by_grain.sum(axis=0) - bed.given).max() / abs(bed.given).max()
    return stages, bed


# ---- what comes out

def minimum_found(fixed, bed):
    """Minimum fluidization velocity: where a u + b u^2, by least squares through gradients of the fixed bed, is the weight; and that
    of Ergun's equation with the voidage of the bed just before."""
    voidage = fixed[-1].voidage
    velocities = numpy.array([stage.velocity for stage in fixed])
    gradients = numpy.array([stage.gradient for stage in fixed]) / THEORY.weight(voidage)
    (a, b), *_ = numpy.linalg.lstsq(numpy.stack([velocities, velocities ** 2], axis=1), gradients, rcond=None)
    return 2.0 * bed.umf / (a + math.sqrt(a * a + 4.0 * b)), THEORY.minimum_fluidization(voidage, bed.d)


def frequency(values, interval):
    """Of the largest wave among them."""
    waves = abs(numpy.fft.rfft((values - numpy.mean(values)) * numpy.hanning(len(values)), 16 * len(values)))
    return waves.argmax() / (16 * len(values) * interval)


def plot(path, stages, bed):
    """Pressure drop over velocity; pressure over time in the last stage."""
    most, end = 1.05 * max(stage.velocity for stage in stages), len(bed.drops) * bed.dt
    with open(path, "w") as file:
        drawing = Drawing(file, 2)
        drawing.panel("pressure / weight: whole bed (blue), inside (red)", "velocity / minimum fluidization velocity",
                      lambda share: share / most, lambda drop: drop / 1.3,
                      [(k / 2, f"{k / 2:g}") for k in range(int(2 * most) + 1)], [(k / 4, f"{k / 4:g}") for k in range(6)])
        at_umf = THEORY.ergun(bed.voidage, bed.umf, bed.d)
        drawing.curve([(0.01 * k, THEORY.ergun(bed.voidage, 0.01 * k * bed.umf, bed.d) / at_umf) for k in range(112)])
        drawing.curve([(0.0, 1.0), (most, 1.0)])
        drawing.dots([(stage.velocity, stage.drop) for stage in stages], "#1f5fa8")
        drawing.dots([(stage.velocity, stage.gradient / THEORY.weight(stage.voidage)) for stage in stages if stage.velocity < 1.0], "#b03030")
        drawing.text(drawing.x(0.5), drawing.y(0.2), "Ergun, voidage inside at rest", color="#666")
        drawing.text(drawing.x(0.02), drawing.y(1.03), "weight in air", color="#666")
        drawing.panel("pressure at the floor / weight, last stage", "time (s)", lambda t: t / end, lambda drop: drop / 2.0,
                      [(k / 10, f"{k / 10:g}") for k in range(int(10 * end) + 1)], [(k / 2, f"{k / 2:g}") for k in range(5)])
        drawing.curve([(0.0, 1.0), (end, 1.0)])
        drawing.line([(drawing.x((n + 0.5) * bed.dt), drawing.y(min(drop, 2.0))) for n, drop in enumerate(bed.drops)], "#1f5fa8")
        drawing.close()


def tell(options, stages, bed):
    with open(os.path.join(options.out, "fluidized.csv"), "w") as file:
        file.write(",".join(Stage._fields) + "\n")
        for stage in stages:
            file.write(",".join(f"{value:.9g}" for value in stage) + "\n")
    plot(os.path.join(options.out, "fluidized.svg"), stages, bed)
    print(f"Result: bed of {len(bed.ids)} grains, height {1e3 * bed.height:.3g} mm, voidage {bed.voidage:.3f}")
    for stage in stages:
        print(f"Result: air at {stage.velocity * bed.umf:.3f} m/s: pressure drop {stage.drop:.3f}, floor {stage.floor:.3f} of the weight; "
              f"inside {stage.gradient / stage.ergun:.3f} of Ergun's; height {1e3 * stage.height:.3g} mm")
    fixed, carried = [s for s in stages if s.velocity < 0.95], [s for s in stages if s.velocity > 1.05]
    if len(fixed) > 1:
        found, of_ergun = minimum_found(fixed, bed)
        print(f"Result: pressure gradient in the fixed bed: {100 * max(abs(s.gradient / s.ergun - 1.0) for s in fixed):.2g} % from Ergun")
        print(f"Result: minimum fluidization velocity {found:.4f} m/s: {100 * abs(found / of_ergun - 1.0):.2g} % from Ergun, "
              f"{found / THEORY.wen_yu(bed.d):.3g} times that of Wen and Yu")
    if carried:
        print(f"Result: pressure drop of the fluidized bed: {100 * max(abs(s.drop - 1.0) for s in carried):.2g} % from its weight")
        print(f"Result: pressure at the floor: {frequency(bed.drops, bed.dt):.2g} Hz, +- {0.5 / (len(bed.drops) * bed.dt):.2g}; "
              f"bubbling beds of this height: {natural_frequency(bed.height):.2g} Hz")
    print("Result: drop and floor bear the weight and what accelerates grains but for "
          f"{100 * max(abs(s.balance - 1.0) for s in stages):.2g} %")
    lost = bed.inflow - bed.outflow - (bed.flow.volume() - bed.first_volume)
    print(f"Result: of the air that came {abs(lost) / bed.inflow:.1e} is astray; of the impulse of drag in all cells, grain by grain, "
          f"{bed.astray:.1e}")
    print(f"Result: processor time of the first rank {bed.accounts}")


def main():
    options = arguments()
    stages, bed = fluidize(options)
    if bed.here:
        tell(options, stages, bed)
    bed.partner.lmp.finalize()


if __name__ == "__main__":
    main()
