# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Existing input scripts, run with -sf talus."""

import math
import os
import re
import sys

import beds
import lammps
import machine
import paired
from lammps import STOCK, TALUS

sys.path.append(os.path.join(machine.ROOT, "tests", "lib"))
import stock_inputs

TITLE = "Existing scripts"
QUESTION = """What does `-sf talus` gain for a script that was written for LAMMPS? The whole run is measured, start and output
included."""

SUFFIX = {STOCK: [], TALUS: ["-sf", "talus"]}
FLOOR = 0.98            # of inputs of which nothing need be accelerated
FLOORS = {"granregion.mixer": 2.5, "granregion.funnel": 2.5, "granregion.box": 1.0}
CHUTE_FLOOR = 2.0
LONG_CHUTE = 3000       # steps

# as users of LAMMPS write it
BED = """units si
atom_style sphere
boundary f f f
comm_modify vel yes
read_data {data}
pair_style {style}
pair_coeff * * {coefficients}
neighbor {skin} bin
neigh_modify every 1 delay 0
fix weight all gravity {gravity} vector 0 0 -1
fix move all nve/sphere
fix floor all wall/gran {wall} zplane 0.0 NULL
fix x all wall/gran {wall} xplane $(xlo) $(xhi)
fix y all wall/gran {wall} yplane $(ylo) $(yhi)
timestep {dt}
thermo 100
thermo_modify norm no lost error
run {steps}
"""

# pair granular: case, law, floors of its ratio on Zen 5 and before
GRANULAR_BEDS = [
    ("bed.tsuji", "hertz/material {E} 0.5 0.3 tangential mindlin NULL 1.0 0.5 damping tsuji", (7.0, 5.0)),
    ("bed.rolling", "hertz/material {E} 0.5 0.3 tangential mindlin NULL 1.0 0.5 damping tsuji "
                    "rolling sds 500.0 0.01 0.1 twisting marshall", (5.0, 4.0)),
    ("bed.jkr", "jkr {E} 50.0 0.3 0.01 tangential mindlin NULL 1.0 0.5 damping viscoelastic", (4.0, 3.0)),
]
POISSON = 0.3

SPHERES_IN_A_PERIOD = """units si
atom_style sphere
boundary p p p
newton off
comm_modify vel yes
region box block 0 {edge} 0 {edge} 0 {edge} units box
create_box 1 box
lattice sc {apart}
create_atoms 1 box
"""

# solid fraction, floor of its ratio
GASES = [(0.02, 3.0), (0.1, 3.0), (0.3, 3.5)]
GAS_SIDE = 30       # spheres
GAS = SPHERES_IN_A_PERIOD + """set type 1 diameter 0.002
set type 1 density 2500
velocity all create 1 4711 dist uniform
velocity all scale 1e18
pair_style gran/hertz/history 1e7 NULL 1e2 NULL 0.5 1
pair_coeff * *
neighbor 0.0006 bin
neigh_modify every 1 delay 0 check yes
timestep 5e-6
fix move all nve/sphere
thermo 1000
run {steps}
"""

# bonds between all grains of a block that falls on a plate
BLOCK_SIDE = 10     # cells of four spheres
AGGLOMERATE_FLOOR = 2.5
BLOCK = """units lj
boundary s s m
atom_style bpm/sphere
newton on off
comm_modify vel yes cutoff 3.0
special_bonds lj 0 1 1 coul 0 1 1
region box block -1 {edge} -1 {edge} -2 {edge}
create_box 1 box bond/types 1 extra/bond/per/atom 20 extra/special/per/atom 60
lattice fcc 1.33
region block block 0 {side} 0 {side} 0 {side}
create_atoms 1 region block
set group all diameter 1.0 density 1.0
displace_atoms all random 0.05 0.05 0.05 4711 units box
neighbor 0.3 bin
timestep 0.01
pair_style gran/hooke/history 200.0 NULL 5.0 NULL 0.5 1
pair_coeff * *
create_bonds many all all 1 0.5 1.2
special_bonds lj 0 1 1 coul 1 1 1
{bonds}
velocity all create 0.01 77
velocity all set NULL NULL -0.3 sum yes
fix move all nve/bpm/sphere
fix weight all gravity 0.1 vector 0 0 -1
fix floor all wall/gran hooke/history 200.0 NULL 5.0 NULL 0.5 1 zplane -1.0 NULL
thermo 1000
run {steps}
"""

BLOCKS = [    # case, style, coefficients, floor
    ("bonds.block", "bpm/rotational", "30.0 10.0 2.0 3.0 1e9 1e9 1e9 1e9 0.3 0.2 0.1 0.05", 2.5),
    ("bonds.springs", "bpm/spring", "30.0 1e9 0.3", 1.2),
]

TRIAXIAL_SIDE = 12  # spheres
TRIAXIAL_FLOOR = 3.0
TRIAXIAL = SPHERES_IN_A_PERIOD + """set type 1 diameter 0.001
set type 1 density 2500
displace_atoms all random 2e-5 2e-5 2e-5 4711
pair_style granular
pair_coeff * * hertz/material 2e8 0.5 0.3 tangential mindlin NULL 1.0 0.5
neighbor 0.0002 bin
neigh_modify every 1 delay 0 check yes
timestep 5e-7
fix move all nve/sphere
compute contact all pressure NULL virial
thermo_style custom step lx lz c_contact[1] c_contact[3]
thermo 1000
fix press all deform/pressure 1 x pressure 5e4 5e-3 y pressure 5e4 5e-3 z pressure 5e4 5e-3 max/rate 20.0 remap v
run {steps}
unfix press
fix press all deform/pressure 1 z trate -5.0 x pressure 5e4 5e-3 y pressure 5e4 5e-3 max/rate 20.0 remap v
run {steps}
"""


# ---- cases ------------------------------------------------------------------------------------

class Case:
    """name; what it is; its script; floor of the ratio on one core; folder that holds what it reads."""

    def __init__(self, bench, name, what, text, floor, given=None):
        self.name, self.what, self.text, self.floor = name, what, text, floor
        self.variables = [word for key, value in given.variables.items() for word in ("-var", key, str(value))] \
            if given else []
        self.folder = bench.path(name)
        os.makedirs(self.folder, exist_ok=True)
        if given:
            stock_inputs.copy_companions(given, machine.HOST_SOURCE, self.folder)

    def run(self, code, cores, check=True):
        return lammps.run(self.folder, code, self.text, code, cores=cores, ranks=len(cores), check=check,
                          arguments=[*SUFFIX[code], *self.variables])


def zen4():
    with open("/proc/cpuinfo") as file:
        head = file.read(2000)
    return "AuthenticAMD" in head and re.search(r"cpu family\s*: 25\n", head) is not None


def laws_of_beds():
    """Case, what it is, pair style, its coefficients, words of the walls, floors on Zen 5 and before."""
    law = beds.STOCK_HISTORY
    yield "bed", f"gran/{law.split()[0]}", f"gran/{law}", "", law, (4.0, 3.3)
    # of the stiffness kn of the same bed
    modulus = 1.5 * float(law.split()[1]) * (1 - POISSON**2)
    for case, words, floors in GRANULAR_BEDS:
        words = words.format(E=modulus)
        yield case, f"granular {words}", "granular", words, f"granular {words}", floors


def bed_cases(bench):
    count = bench.size(50000, 12500)
    for case, what, style, coefficients, wall, floors in laws_of_beds():
        if not bench.wants(case):
            continue
        data, _ = beds.bed(bench, count)
        text = BED.format(data=data, style=style, coefficients=coefficients, wall=wall, skin=beds.SKIN,
                          gravity=beds.GRAVITY, dt=beds.DT, steps=bench.size(1000, 200))
        yield Case(bench, case, f"{count} spheres between walls, {what}", text, floors[zen4()])


def gas_cases(bench):
    for fraction, floor in GASES:
        if not bench.wants(f"gas.{fraction}"):
            continue
        edge = GAS_SIDE * 0.002 * (math.pi / 6 / fraction) ** (1 / 3)
        text = GAS.format(edge=edge, apart=edge / GAS_SIDE, steps=bench.size(3000, 300))
        yield Case(bench, f"gas.{fraction}", f"{GAS_SIDE**3} spheres fly in a periodic box, solid fraction {fraction}", text, floor)


def bonded_cases(bench):
    """Blocks; and the ball of the example, which breaks. Rods are those of in.bpm.pour."""
    side = BLOCK_SIDE * (4 / 1.33) ** (1 / 3)
    for name, style, coefficients, floor in BLOCKS:
        if not bench.wants(name):
            continue
        bonds = f"bond_style {style} break no smooth no\nbond_coeff 1 {coefficients}"
        yield Case(bench, name, f"a block of {4 * BLOCK_SIDE**3} spheres with bond_style {style}",
                   BLOCK.format(side=BLOCK_SIDE - 0.01, edge=side + 3, bonds=bonds, steps=bench.size(2000, 200)), floor)
    if bench.wants("bonds.agglomerate"):
        with open(os.path.join(machine.ROOT, "examples", "bonds", "in.agglomerate")) as file:
            text = file.read()
        for name, value in ("speed", 15.0), ("steps", bench.size(8000, 800)):
            text = re.sub(rf"(?m)^(variable {name} index) .*", rf"\1 {value}", text)
        yield Case(bench, "bonds.agglomerate", "examples/bonds/in.agglomerate: a ball of bonded spheres breaks on a plate", text,
                   AGGLOMERATE_FLOOR)


def triaxial_cases(bench):
    if bench.wants("triaxial"):
        yield Case(bench, "triaxial", f"{TRIAXIAL_SIDE**3} spheres, periodic triaxial compression with fix deform/pressure",
                   TRIAXIAL.format(edge=TRIAXIAL_SIDE * 0.00108, apart=0.00108, steps=bench.size(10000, 1000)), TRIAXIAL_FLOOR)


def input_case(bench, given, steps):
    text = stock_inputs.shortened(stock_inputs.read_text(given, machine.HOST_SOURCE), steps)
    return Case(bench, given.title[3:], given.name, text, FLOORS.get(given.title[3:], FLOOR), given)


def long_chute(bench, given):
    steps = bench.size(LONG_CHUTE, 300)
    text = stock_inputs.RUN.sub(rf"\g<1>{steps}", stock_inputs.read_text(given, machine.HOST_SOURCE))
    return Case(bench, "chute.long", f"{given.name} with {steps} steps", text, CHUTE_FLOOR, given)


def cases(bench):
    """Those that are asked for and can be made."""
    yield from bed_cases(bench)
    yield from gas_cases(bench)
    yield from bonded_cases(bench)
    yield from triaxial_cases(bench)
    for given in stock_inputs.INPUTS:
        if not os.path.exists(os.path.join(machine.HOST_SOURCE, given.name)):
            bench.section.text(f"Left out: {given.name}, which the source of this LAMMPS does not have.")
            continue
        if given.name == "bench/in.chute" and bench.wants("chute.long"):
            yield long_chute(bench, given)
        if bench.wants(given.title[3:]):
            yield input_case(bench, given, bench.size(given.bench_steps, min(500, given.bench_steps)))


# ---- measuring --------------------------------------------------------------------------------

def shares(result):
    """Where LAMMPS spends its time, summed over all runs of a script: the categories above 10 %."""
    loops = result.loops()
    total = sum(loop.seconds for loop in loops) or 1.0
    found = {}
    for loop in loops:
        for name, seconds in loop.breakdown.items():
            found[name] = found.get(name, 0.0) + seconds / total
    return ", ".join(f"{name} {100 * share:.0f} %" for name, share in sorted(found.items(), key=lambda pair: -pair[1])
                     if share >= 0.1)


def compare(bench, case, cores):
    """Ratio of wall times; all rounds go to the table of the section."""
    series = paired.measure({code: lambda c=code: case.run(c, cores).seconds for code in (STOCK, TALUS)}, bench.rounds)
    for k, (plain, ours) in enumerate(zip(series[STOCK].values, series[TALUS].values)):
        bench.section.record(case=case.name, ranks=len(cores), round=k + 1, stock_s=plain, talus_s=ours, ratio=plain / ours)
    return series[STOCK].median, series[TALUS].median, paired.ratio(series[STOCK], series[TALUS])


def row(bench, case):
    """None if LAMMPS itself ends in an error."""
    bench.note(case.name)
    first = case.run(STOCK, paired.one_core(), check=False)
    if first.returncode:
        bench.section.text(f"Left out: {case.what}, with which this LAMMPS itself ends in an error: `{first.error()}`")
        return None
    said = stock_inputs.accelerated(case.run(TALUS, paired.one_core()).log)
    plain, ours, ratio = compare(bench, case, paired.one_core())
    if ratio.median < case.floor:
        bench.section.headline(f"dropin, {case.name}: ratio {ratio.median:.2f}, less than the {case.floor} that was aimed at.")
    pair = "-"
    if len(machine.cores()) > 1:
        pair = str(compare(bench, case, machine.cores()[-2:])[2])
    return [case.name, case.what, plain, ours, str(ratio), case.floor, pair, said, shares(first)]


COLUMNS = ["case", "what", "LAMMPS, s", "-sf talus, s", "ratio, median (range)", "floor", "ratio on 2 ranks",
           "accelerated", "where LAMMPS spends its time"]


def measure(bench):
    rows = list(filter(None, (row(bench, case) for case in cases(bench))))
    bench.section.table(COLUMNS, rows)
    bench.section.text(f"""Wall time of the whole process, on one core unless said otherwise; LAMMPS runs without the plugin.
`accelerated`: what the log says at the start of the first run. Runs are shortened, so that LAMMPS takes some seconds
for each; `chute.long` is lengthened. Nothing else is edited. The beds are settled, 15 diameters deep, with floor and four
walls. floor is what was aimed at on one core; for beds it is lower on processors of the generation before Zen 5.""")
    if rows:
        bench.section.plot("", "Ratios of run times on one core, with the range over the rounds; the bar is the floor",
                           lambda plt: draw(plt, rows))


def draw(plt, rows):
    _, axes = plt.subplots(figsize=(6.5, 0.3 * len(rows) + 1))
    for k, line in enumerate(rows):
        median, low, high = map(float, re.findall(r"[\d.]+", line[4]))
        axes.plot([low, high], [k, k], color="0.0", linewidth=3)
        axes.plot([median], [k], "o", color="0.0", markersize=6)
        axes.plot([line[5]], [k], "|", color="0.5", markersize=16, markeredgewidth=2)
    axes.set_yticks(range(len(rows)), [line[0] for line in rows])
    axes.set_xscale("log")
    axes.set_xticks([0.5, 1, 2, 4, 8], map(str, [0.5, 1, 2, 4, 8]))
    axes.invert_yaxis()
    axes.set_xlabel("times faster")
