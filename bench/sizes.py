# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Spheres of different sizes."""

import itertools
import math
import os
import re
import statistics

import beds
import lammps
import machine
import paired
from lammps import STOCK, TALUS

TITLE = "Wide distributions of sizes"
QUESTION = """What do sizes 1:10, 1:30 and 1:100 cost, beside equal spheres and beside the best that LAMMPS has for them,
`neighbor multi` with a collection for each factor of two in size and `comm_modify mode multi`? Spheres that fall, at a solid fraction
of .34, and settled ones; periodic across or between walls. And how long does it take to fill a region?"""

D = 0.002       # of the smallest
LOGNORMAL = 2.5, 0.5, 8      # median over D, deviation, largest over D
# name: sizes as fill_region has them, largest over smallest, solid fraction from which they settle
SIZES = {
    "equal": (f"{D}", 1, 0.58),
    "lognormal": (f"lognormal {LOGNORMAL[0] * D} {LOGNORMAL[1]} {D} {LOGNORMAL[2] * D} mass", LOGNORMAL[2], 0.6),
    "two 1:10": (f"discrete 2 {D} 1 {10 * D} 1 mass", 10, 0.6),
    "1:10": (f"uniform {D} {10 * D} mass", 10, 0.62),
    "1:30": (f"uniform {D} {30 * D} mass", 30, 0.62),
    "1:100": (f"uniform {D} {100 * D} mass", 100, 0.62),
}
SIDES = {"periodic": "p", "walls": "f"}
FALLING, FALL = 0.34, 0.5                     # solid fraction, speed
SETTLING = 20000                              # steps
FLOORS = {"falling": 2.5, "settled": 4.0}     # of the ratio to LAMMPS
LIMITS = 1.2, 1.3                             # of rebuilds and memory, over those of equal spheres
GRAVITY, SKIN = 9.81, 0.0003
# (time step, law): spheres a million times as heavy as the smallest go through these unless they are stiffer
PHYSICS_OF = {"1:100": (1e-6, "hertz/history 3e8 NULL 2.7e4 NULL 0.5 1")}
USUAL = (5e-6, "hertz/history 1e7 NULL 5e3 NULL 0.5 1")
FILLS = [(f"80 large and {small} thousand small", f"discrete 2 {D} {1000 * small} {10 * D} 80", 80 + 1000 * small, 0.5)
         for small in (5, 10, 20, 40)] + [
    ("a million equal", SIZES["equal"][0], 10**6, 0.5),
    ("a million 1:30", SIZES["1:30"][0], 10**6, 0.5),
]

HEAD = """units si
atom_style sphere
atom_modify map array
boundary {side} {side} f
newton off
neighbor {skin} {style}
comm_modify {mode} vel yes
"""
PHYSICS = """neigh_modify every 1 delay 0 check yes
pair_style gran/{law}
pair_coeff * *
timestep {dt}
fix weight all gravity {gravity} vector 0 0 -1
fix move all nve/sphere
fix floor all wall/gran {law} zplane 0 NULL
{walls}
thermo 1000
thermo_modify norm no lost error
"""
WALLS = """fix x all wall/gran {law} xplane 0 {wide}
fix y all wall/gran {law} yplane 0 {wide}"""
BOX = """region box block 0 {wide} 0 {wide} 0 {high} units box
create_box {types} box
"""
FALLING_SPEEDS = """variable across atom random(-0.1,0.1,4711)
variable along atom random(-0.1,0.1,4712)
variable down atom -{speed}+random(-0.1,0.1,4713)
velocity all set v_across v_along v_down
"""
# a type, and so a collection of LAMMPS, for each factor of two
CLASSES = """compute size all property/atom diameter
variable class atom 1+floor(ln(1.0000001*c_size/{d})/ln(2))
run 0
set group all type v_class
"""


def head(side, multi=False):
    return HEAD.format(side=SIDES[side], skin=SKIN, style="multi" if multi else "bin", mode="mode multi" if multi else "mode single")


def mean_volume(name):
    """Of a sphere, from diameters that have equal shares of the mass."""
    kind, ratio = SIZES[name][0].split()[0], SIZES[name][1]
    shares = [(k + 0.5) / 5000 for k in range(5000)]
    if kind == "uniform":
        diameters = [D * (1 + (ratio - 1) * q) for q in shares]
    elif kind == "discrete":
        diameters = [D * (1 if q < 0.5 else ratio) for q in shares]
    elif kind == "lognormal":
        median, sigma, largest = LOGNORMAL
        normal = statistics.NormalDist(math.log(median), sigma)
        low, high = normal.cdf(0.0), normal.cdf(math.log(largest))
        diameters = [D * math.exp(normal.inv_cdf(low + q * (high - low))) for q in shares]
    else:
        diameters = [D]
    return math.pi / 6 / statistics.fmean(d**-3 for d in diameters)


class Bed:
    """So many spheres with these sizes and sides, at this moment."""

    def __init__(self, bench, name, side, moment, count):
        self.bench, self.name, self.side, self.moment, self.count = bench, name, side, moment, count
        self.sizes, ratio, settled = SIZES[name]
        self.fraction = settled - bench.size(0.0, 0.1) if moment == "settled" else FALLING
        self.types = 1 + int(math.log2(ratio))
        self.wide = (count * mean_volume(name) / self.fraction) ** (1 / 3)
        self.dt, self.law = PHYSICS_OF.get(name, USUAL)

    def path(self):
        name = re.sub(r"[^a-z0-9]", "", self.name)
        return beds.cache_path(f"sizes-{name}-{self.side}-{self.count}-{self.moment}")

    def commands(self, begin, multi=False):
        walls = WALLS.format(law=self.law, wide=self.wide) if self.side == "walls" else ""
        return head(self.side, multi) + begin + PHYSICS.format(law=self.law, dt=self.dt, gravity=GRAVITY, walls=walls)

    def make(self):
        """Once."""
        if os.path.exists(self.path()):
            return
        self.bench.note(f"filling with {self.count} spheres, {self.name}, {self.side}, {self.moment}, once")
        script = self.commands(BOX.format(wide=self.wide, high=1.1 * self.wide, types=self.types)) \
            + f"region fill block 0 {self.wide} 0 {self.wide} 0 {self.wide} units box\n" \
            f"fill_region fill 1 number {self.count} diameter {self.sizes} density 2500 seed 4711\n"
        if self.types > 1:
            script += CLASSES.format(d=D)
        steps = self.bench.size(SETTLING, SETTLING // 10)
        if self.moment == "falling":
            steps = 200
            script += FALLING_SPEEDS.format(speed=FALL)
        script += f"run {steps}\nwrite_data {self.path()} nocoeff\n"
        lammps.run(self.bench.workdir, "make", script, TALUS, arguments=["-sf", "talus"])

    def script(self, code, steps):
        return self.commands(f"read_data {self.path()}\n", code == STOCK and self.types > 1) + f"run 50\nrun {steps}\n"

    def run(self, code, steps, cores):
        return lammps.run(self.bench.workdir, "bed", self.script(code, steps), code, cores=cores, ranks=len(cores),
                          arguments=["-sf", "talus"] if code == TALUS else [])


def after_loop(result, pattern):
    """The number after the last match."""
    return float(re.findall(pattern + r"\s*=?:?\s*([\d.]+)", result.log)[-1])


def ratio(bench, bed, cores, steps):
    runs = {code: [] for code in (STOCK, TALUS)}

    def once(code):
        runs[code].append(bed.run(code, steps, cores))
        return runs[code][-1].loops()[-1].nanoseconds()

    series = paired.measure({code: lambda c=code: once(c) for code in runs}, bench.rounds)
    for k, (plain, ours) in enumerate(zip(series[STOCK].values, series[TALUS].values)):
        bench.section.record(case=bed.name, sides=bed.side, moment=bed.moment, ranks=len(cores), round=k + 1, stock_ns=plain,
                             talus_ns=ours, ratio=plain / ours)
    return series, paired.ratio(series[STOCK], series[TALUS]), runs[TALUS][-1], runs[STOCK][-1]


def per_rebuild(result):
    """Time of category Neigh per particle and rebuild (ns)."""
    loop = result.loops()[-1]
    builds = after_loop(result, "Neighbor list builds")
    return 1e9 * loop.breakdown["Neigh"] / (builds * loop.atoms) if builds else float("nan")


def settle(bench):
    steps = bench.size(1000, 200)
    rows, equal = [], {}
    for name in SIZES:
        # of few spheres none of the largest is among them
        count = bench.size(120000, 0) if name == "1:100" else bench.size(30000, 8000)
        if not bench.wants(name) or not count:
            continue
        for side, moment in itertools.product(SIDES, FLOORS):
            bed = Bed(bench, name, side, moment, count)
            bed.make()
            bench.note(f"{name}, {side}, {moment}")
            try:
                series, gain, ours, stock = ratio(bench, bed, paired.one_core(), steps)
            except lammps.Failed as problem:    # LAMMPS' multi loses spheres at 1:100; Talus must not
                ours = bed.run(TALUS, steps, paired.one_core())
                bench.note(str(problem).splitlines()[0])
                rows.append([name, count, side, moment, ours.loops()[-1].nanoseconds(), "LAMMPS ends in an error", "-",
                             after_loop(ours, "Nghost") / count, "-", f"{per_rebuild(ours) / equal.get((side, moment), float('nan')):.2f}"])
                continue
            two = ratio(bench, bed, machine.cores()[-2:], steps)[1] if len(machine.cores()) > 1 else "-"
            rebuild = per_rebuild(ours)
            if name == "equal":
                equal[side, moment] = rebuild
            more = rebuild / equal[side, moment] if (side, moment) in equal else float("nan")
            rows.append([name, count, side, moment, series[TALUS].median, str(gain), str(two), after_loop(ours, "Nghost") / count,
                         after_loop(stock, "Nghost") / count, f"{more:.2f}"])
            if gain.median < FLOORS[moment] and name != "equal":
                bench.section.headline(f"sizes, {name}, {side}, {moment}: ratio {gain.median:.2f}, less than the {FLOORS[moment]} "
                                       "that was aimed at.")
    bench.section.heading("Beds")
    bench.section.table(["sizes", "spheres", "sides", "moment", "ns per particle and step", "times LAMMPS, one rank", "two ranks", "proxies per "
                         "particle", "of LAMMPS", "rebuild over equal"], rows)
    bench.section.text(f"""Sizes with a ratio alone have the same mass in each interval of diameters of the same width. Settled beds have
had {SETTLING} steps; those of 1:100, which have stiffer contacts and a fifth of the time step, are not quite at rest by then.
Rebuild: time of category Neigh per particle and rebuild, over that of equal spheres; aimed at: {LIMITS[0]}.""")


def memory(bench):
    rows, first = [], None
    for name in ("equal", "1:10", "1:30"):
        if not bench.wants(name):
            continue
        counts = bench.size((30000, 60000), (4000, 8000))
        peaks = []
        for count in counts:
            bed = Bed(bench, name, "walls", "settled", count)
            bed.make()
            peaks.append(lammps.measured_peak(bed.run(TALUS, 200, paired.one_core())))
        each = (peaks[1] - peaks[0]) / (counts[1] - counts[0])
        first = first or each
        rows.append([name, each, each / first])
    bench.section.heading("Memory")
    bench.section.table(["sizes", "bytes per particle", "over equal"], rows)
    bench.section.text(f"Difference of the peaks of two settled beds over the difference in spheres; aimed at: {LIMITS[1]}.")


def filling(bench):
    if not bench.wants("filling"):
        return
    rows = []
    for what, sizes, count, fraction in FILLS:
        count = bench.size(count, count // 4)
        large = re.search(r"discrete 2 \S+ (\S+) \S+ (\S+)", sizes)
        volume = (math.pi / 6 * D**3 * (float(large[1]) + 1000 * float(large[2])) * count / (float(large[1]) + float(large[2]))
                  if large else count * mean_volume("1:30" if "uniform" in sizes else "equal"))
        wide = (volume / fraction) ** (1 / 3)
        script = head("periodic") + BOX.format(wide=wide, high=wide, types=1) \
            + f"fill_region box 1 number {count} diameter {sizes} density 2500 seed 4711\n"
        bench.note(what)
        found = lammps.run(bench.workdir, "fill", script, TALUS, cores=paired.one_core())
        rows.append([what, count, fraction, found.seconds, 1e6 * found.seconds / count])
        bench.section.record(case=what, spheres=count, seconds=found.seconds)
    bench.section.heading("Filling a region")
    bench.section.table(["spheres", "number", "solid fraction", "s", "us per sphere"], rows)
    bench.section.text("The whole process, on one core; fill_region, periodic across, between floor and lid.")


def measure(bench):
    settle(bench)
    memory(bench)
    filling(bench)
