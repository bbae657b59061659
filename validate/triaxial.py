# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Triaxial compression, compared with Yade."""

import csv
import math
import os
import re
import shutil
import subprocess

import numpy

import lammps
import machine
import problems

TITLE = "Triaxial compression"
QUESTION = """A dense sample of spheres in a box of six smooth walls is compressed along one axis, while the other walls keep their
pressure: how do stress and volume follow the strain? Compared with [Yade](https://yade-dem.org) (Smilauer et al., Yade Documentation 3rd
ed., 2021), a program of its own, with the same contact law (linear springs, Coulomb friction; Cundall and Strack, Geotechnique 29, 47,
1979), the same samples and the same rate. A soil dilates until its stress ratio has come from a peak down to that of the critical
state."""

SEEDS = (1, 2, 3, 4)
NUMBER, START, RATE, STRAIN, STIFFNESS = 1000, 0.56, 8e-4, 0.25, 1000
STORED = os.path.join(machine.ROOT, "validate", "triaxial_yade.csv")
COLUMNS = "damping", "seed", "strain", "volumetric", "axial", "lateral"
GRID = numpy.arange(0.005, 0.2451, 0.0025)
LAST = 0.2              # axial strain from which the state counts as critical
DAMPING, USUAL = 0.02, 0.2      # of Yade: what is compared, and its default, up to the strain EARLY
EARLY = 0.05
QUICK = {"number": 500, "start": 0.54, "rate": 2e-3, "strain": 0.08}


class Sample:
    """One compression: strains, stresses, and nanoseconds per particle and step."""

    def __init__(self, rows, cost=math.nan):
        self.rows, self.cost = numpy.array(rows)[:, :4], cost
        strain, volumetric, axial, lateral = self.rows.T
        self.grid = GRID[GRID < strain[-1]]
        self.ratio = numpy.interp(self.grid, strain, 3 * (axial - lateral) / (axial + 2 * lateral))
        self.volume = numpy.interp(self.grid, strain, volumetric)
        self.angle = numpy.interp(self.grid, strain, numpy.degrees(numpy.arcsin((axial - lateral) / (axial + lateral))))

    def until(self, strain):
        return Sample(self.rows[self.rows[:, 0] < strain])

    def __str__(self):
        return f"{self.peak():.1f} degrees at the peak, {self.critical():.1f} at the end, {self.cost:.0f} ns"

    def peak(self):
        return float(self.angle.max())

    def critical(self):
        return float(self.angle[self.grid >= min(LAST, 0.8 * self.grid[-1])].mean())

    def dilation(self):
        return float(self.volume[-1])


def compress(bench, seed, rate, cores):
    """Sample of Talus and its folder, with packing.txt for Yade."""
    variables = bench.size({"number": NUMBER, "start": START, "rate": rate, "strain": STRAIN}, QUICK)
    folder, result = problems.run(bench, "triaxial", f"talus-{seed}-{rate}", {**variables, "stiffness": STIFFNESS, "seed": seed}, cores)
    write_packing(folder, result.printed("Walls")[0])
    rows = result.printed("Stage")
    sample = Sample(rows, processor_time(result, len(rows)))
    bench.note(f"Talus, sample {seed}, rate {rate}: {sample}")
    return folder, sample


def processor_time(result, stages):
    """Nanoseconds per particle and step in the last stages: wall clock times the share of the processor, as the core may be shared."""
    loops = result.loops()[-stages:]
    shares = [float(share) for share in re.findall(r"^(\S+)% CPU use", result.log, re.MULTILINE)][-stages:]
    seconds = sum(loop.seconds * share / 100 for loop, share in zip(loops, shares))
    return 1e9 * seconds / sum(loop.steps * loop.atoms for loop in loops)


def write_packing(folder, walls):
    with open(os.path.join(folder, "spheres.txt")) as file:
        spheres = file.readlines()[9:]
    with open(os.path.join(folder, "packing.txt"), "w") as file:
        file.writelines([" ".join(map(repr, walls)) + "\n", *spheres])


def run_yade(bench, seed, folder, damping, cores):
    """Sample of Yade from the packing in this folder."""
    script, out = os.path.join(machine.ROOT, "validate", "yade_triaxial.py"), f"yade-{damping}.txt"
    numbers = RATE, STRAIN if damping == DAMPING else EARLY, STIFFNESS, damping
    command = ["taskset", "-c", str(cores[0]), "yade", "-n", "-x", "-j1", script, "packing.txt", out, *map(str, numbers)]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=problems.LIMIT,
                          check=False)
    if not os.path.exists(os.path.join(folder, out)):
        raise lammps.Failed(f"yade: {done.stdout[-1500:]}{done.stderr[-1500:]}")
    sample, version = read_yade(os.path.join(folder, out))
    bench.note(f"Yade, sample {seed}, damping {damping}: {sample}")
    return sample, version


def read_yade(path):
    """(sample, version) of what yade_triaxial.py has written."""
    with open(path) as file:
        cost, version = re.search(r"# (\S+) ns per particle and step, Yade (\S+)", file.read()).groups()
    return Sample(numpy.loadtxt(path), float(cost)), version


def store(found):
    """found: {(damping, seed): (sample, version)}."""
    cost = min(sample.cost for sample, _ in found.values())
    version = next(iter(found.values()))[1]
    with open(STORED, "w", newline="") as file:
        file.write(f"# Yade {version}: {cost:.0f} ns per particle and step on {machine.describe_cpu().split(',')[0]}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for (damping, seed), (sample, _) in found.items():
            writer.writerows([damping, seed, *(f"{value:.5g}" for value in row)] for row in sample.rows)


def stored():
    """{damping: samples of Yade} in the file, and its first line."""
    with open(STORED) as file:
        head = file.readline().lstrip("# ").strip()
    table = numpy.loadtxt(STORED, delimiter=",", skiprows=2)
    samples = {}
    for damping, seed in sorted({tuple(row[:2]) for row in table.tolist()}):
        samples.setdefault(damping, []).append(Sample(table[(table[:, 0] == damping) & (table[:, 1] == seed), 2:]))
    return samples, head


def yade(bench, folders):
    """Samples of Yade and where they are from: measured if it is installed, in a complete run, otherwise those of the file."""
    if not bench.quick and shutil.which("yade"):
        todo = [(damping, seed, folder) for damping in (DAMPING, USUAL) for seed, folder in zip(SEEDS, folders)]
        found = problems.at_once([lambda cores, d=d, s=s, f=f: run_yade(bench, s, f, d, cores) for d, s, f in todo])
        store({(damping, seed): one for (damping, seed, _), one in zip(todo, found)})
    return stored()


def spread(*sets):
    """Standard deviation of a number over samples, pooled over both codes."""
    return math.sqrt(numpy.mean([numpy.var(values, ddof=1) for values in sets if len(values) > 1]))


def compare(bench, talus, other):
    """Results: within two standard deviations of Yade's mean; in a small run, which has other samples, within four."""
    wide = bench.size(2.0, 4.0)
    parts = [("friction angle at the peak", Sample.peak, "degrees")]
    if not bench.quick:
        parts += [("friction angle at the critical state", Sample.critical, "degrees"),
                  ("volumetric strain at the end", Sample.dilation, "")]
    for what, number, unit in parts:
        here, there = [number(sample) for sample in talus], [number(sample) for sample in other]
        deviation = spread(here, there)
        middle = float(numpy.mean(there))
        bench.section.result(what, float(numpy.mean(here)), middle - wide * deviation, middle + wide * deviation, unit,
                             scatter=float(numpy.std(here, ddof=1)) if len(here) > 1 else math.nan)
    for what, name in (("q/p", "ratio"), ("volumetric strain", "volume")):
        apart, deviation = distance(talus, other, name)
        bench.section.result(f"mean distance of the curves of {what}", apart, 0.0, wide * deviation)


def curves(samples, name, size):
    return numpy.array([getattr(sample, name)[:size] for sample in samples])


def distance(first, second, name):
    """Of the mean curves, mean over strain; and the standard deviation over samples, mean over strain."""
    size = min(len(sample.grid) for sample in (*first, *second))
    one, two = curves(first, name, size), curves(second, name, size)
    deviation = numpy.sqrt(numpy.mean([part.var(axis=0, ddof=1) for part in (one, two) if len(part) > 1], axis=0))
    return float(abs(one.mean(axis=0) - two.mean(axis=0)).mean()), float(deviation.mean())


def at_half_rate(bench, talus):
    half = [sample for _, sample in problems.at_once([lambda cores, s=s: compress(bench, s, RATE / 2, cores) for s in SEEDS])]
    apart, deviation = distance(talus, half, "ratio")
    bench.section.result("mean distance of the curves of q/p at half the rate", apart, 0.0, 2 * deviation)
    return half


def gain(samples, others):
    """Percent by which q/p of the first is higher up to the strain EARLY, same packings, and the deviation over them."""
    size = min(len(sample.grid) for sample in (*samples, *others))
    ratios = [100 * (one.ratio[:size].mean() / other.ratio[:size].mean() - 1) for one, other in zip(samples, others)]
    return float(numpy.mean(ratios)), float(numpy.std(ratios, ddof=1))


def measure(bench):
    seeds = bench.size(SEEDS, SEEDS[:2])
    found = problems.at_once([lambda cores, s=s: compress(bench, s, RATE, cores) for s in seeds])
    folders, talus = [folder for folder, _ in found], [sample for _, sample in found]
    other, source = yade(bench, folders)
    compare(bench, talus, other[DAMPING])
    codes = {"Talus": talus, "Yade": other[DAMPING]}
    if not bench.quick:
        codes["Talus at half the rate"] = at_half_rate(bench, talus)
        early, deviation = gain([sample.until(EARLY) for sample in talus], [sample.until(EARLY) for sample in other[DAMPING]])
        bench.section.result("q/p above that of Yade from the same packings, up to a strain of 0.05", early, -2.0, 2.0, "%",
                             scatter=deviation)
    table(bench, codes)
    describe(bench, talus, other, source)
    bench.section.plot("", "Stress ratio q/p and volumetric strain over axial strain: means of samples; the bands are the standard "
                       "deviation of Yade's", lambda plt: draw(plt, codes))


def table(bench, codes):
    rows = []
    for name, samples in codes.items():
        for what, number in (("peak", Sample.peak), ("critical", Sample.critical), ("dilation", Sample.dilation)):
            values = [number(sample) for sample in samples]
            rows.append([f"{name}, {what}", *values, *[math.nan] * (len(SEEDS) - len(values)), float(numpy.mean(values))])
    bench.section.table(["friction angles in degrees, volumetric strain", *(f"sample {seed}" for seed in SEEDS), "mean"], rows)
    size = min(len(sample.grid) for samples in codes.values() for sample in samples)
    means = {f"{name}, {what}": curves(samples, part, size).mean(axis=0) for name, samples in codes.items()
             for what, part in (("q/p", "ratio"), ("volumetric", "volume"))}
    for k, strain in enumerate(GRID[:size]):
        bench.section.record(strain=round(float(strain), 4), **{key: float(values[k]) for key, values in means.items()})


def describe(bench, talus, other, source):
    number, rate = bench.size((NUMBER, RATE), (QUICK["number"], QUICK["rate"]))
    bench.section.text(f"""{number} spheres of diameters 1 +- 10 %, compressed from all sides without friction until they rest, then
given friction 0.5 (none at walls); {len(talus)} samples, the same for both codes. Every contact has kn = {STIFFNESS} and kt = kn/2, over
pressure times diameter. The walls along z come together at the inertial number {rate}; the others hold the pressure, by `servo` of [fix
large/body](../fix_large_body.md) in Talus (its target is the pressure times the area of each stage of 0.0025 strain; where walls yield,
the force is that target less the speed over vmax: stresses are measured), by TriaxialStressController in Yade. Strains are logarithmic,
p = (s1 + 2 s3)/3, q = s1 - s3; the critical state is that from a strain of {LAST} on. Bounds: two standard deviations over samples
(pooled over both codes), for curves their mean over strain.""")
    more, deviation = gain(other[USUAL], [sample.until(EARLY) for sample in other[DAMPING]])
    bench.section.text(f"""Damping cannot be the same: Talus has dashpots in contacts (e = 0.7), Yade's engine of that law reduces the
force on a particle by a share, Cundall's local damping. That share is {DAMPING} here. With {USUAL}, the default, q/p of Yade is
{more:.1f} % higher (+- {deviation:.1f} % over samples; up to a strain of {EARLY}), at this rate: local damping makes a sample
stronger. The bound of 2 % is below that.""")
    bench.section.text(f"""Time of the processor on one core, while sheared, the fastest of the samples: Talus
{min(sample.cost for sample in talus):.0f} ns per particle and step. {source} (one thread; Debian's build, which is for any processor of
the kind). Yade's curves are in `validate/triaxial_yade.csv`; a complete run makes them again where `yade` is installed (Debian:
`apt-get install yade`). Input scripts: `validate/in.triaxial`, `validate/yade_triaxial.py`.""")


def draw(plt, codes):
    import plot
    _, panels = plt.subplots(1, 2, figsize=(8, 3.5))
    for axes, part, label in zip(panels, ("ratio", "volume"), ("q/p", "volumetric strain")):
        for k, (name, samples) in enumerate(codes.items()):
            size = min(len(sample.grid) for sample in samples)
            values, strain = curves(samples, part, size), samples[0].grid[:size]
            mean = values.mean(axis=0)
            axes.plot(strain, mean, **plot.style(k, marker=None), label=name)
            if name == "Yade":
                deviation = values.std(axis=0, ddof=1)
                axes.fill_between(strain, mean - deviation, mean + deviation, color="0.85", linewidth=0)
        axes.set_xlabel("axial strain")
        axes.set_ylabel(label)
    panels[0].legend()
