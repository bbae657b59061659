# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What outputs cost, of a run that writes each of them every 1000 steps."""

import os

import beds
import lammps
import paired

TITLE = "Outputs"
QUESTION = """Which share of a run goes into an output that is written every 1000 steps? The bed of the other benchmarks is run with
and without it, ten times in 500 steps on one core; the difference of both runs, for one output, over the time of 1000 steps without."""

STEPS, TIMES, EVERY = 500, 10, 1000
GOAL = 0.03
LOCAL = ("compute local all contact/gran/local id1 id2 fn px py pz\n"
         "dump local all local {every} local.dump index c_local[1] c_local[2] c_local[3] c_local[4] c_local[5] c_local[6]\n")
PAIR_LOCAL = ("compute local all pair/local dist force p1 p2 p3\n"
              "dump local all local {every} pairs.dump index c_local[1] c_local[2] c_local[3] c_local[4] c_local[5]\n")
GRID = ("compute cells all chunk/atom bin/3d x lower $(2*{D}) y lower $(2*{D}) z lower $(2*{D})\n"
        "fix profile all ave/chunk {{every}} 1 {{every}} cells vx vy vz density/number file profile.txt\n").format(D=beds.D)
POUR = ("region mouth block $(xlo+0.01) $(xhi-0.01) $(ylo+0.01) $(yhi-0.01) $(zhi-3*{D}) $(zhi) units box\n"
        "fix pour all pour/rate {{every}} 1 mouth 0.01 diameter {D} density {rho} seed 4711\n").format(D=beds.D, rho=beds.DENSITY)

# name: (commands, whether Talus does the work; the rest is LAMMPS' own)
OUTPUTS = {
    "thermo: kinetic energy, pressure": ("thermo {every}\nthermo_style custom step ke press\n", False),
    "thermo: energies of compute penalty/stats": ("compute stats all penalty/stats\nthermo {every}\nthermo_style custom step c_stats[*]\n", True),
    "dump custom, 11 columns": ("dump out all custom {every} out.dump " + beds.DUMP + "\n", False),
    "dump custom, binary": ("dump out all custom {every} out.bin " + beds.DUMP + "\n", False),
    "dump vtk/gran": ("dump out all vtk/gran {every} out.pvd id type radius vx vy vz\n", True),
    "dump vtk/gran, contacts no": ("dump out all vtk/gran {every} out.pvd id type radius vx vy vz\ndump_modify out contacts no\n", True),
    "dump local, compute contact/gran/local": (LOCAL, True),
    "dump local, compute pair/local": (PAIR_LOCAL, True),
    "thermo: largest of compute contact/gran/atom": (
        "compute coordination all contact/gran/atom\ncompute most all reduce max c_coordination[1]\nthermo {every}\n"
        "thermo_style custom step c_most\n", True),
    "thermo: compute stress/atom, summed": (
        "compute stress all stress/atom NULL\ncompute sum all reduce sum c_stress[3]\nthermo {every}\nthermo_style custom step c_sum\n", False),
    "fix ave/chunk in cells of 2 diameters": (GRID, False),
    "restart": ("restart {every} out.restart\n", True),
    "fix pour/rate, called every 1000 steps": (POUR, True),
}


def seconds(bench, data, commands):
    every = STEPS // TIMES
    text = beds.script(data, beds.talus(), EVERY // 10, STEPS, more=commands.format(every=every))
    result = lammps.run(bench.workdir, "outputs", text, cores=paired.one_core())
    for name in os.listdir(bench.workdir):
        if not name.endswith(".data"):
            os.remove(bench.path(name))
    return result.loops()[-1].seconds


def share(series, name):
    """Of one output in EVERY steps, of the time of these steps without."""
    return [(a - b) / TIMES / (b * EVERY / STEPS) for a, b in zip(series[name].values, series["none"].values)]


def measure(bench):
    section = bench.section
    count = bench.size(100000, 12500)
    data, _ = beds.bed(bench, count)
    wanted = {name: commands for name, (commands, _) in OUTPUTS.items() if bench.wants(name)}
    variants = {name: (lambda text=text: seconds(bench, data, text)) for name, text in {"none": "", **wanted}.items()}
    series = paired.measure(variants, bench.rounds)
    rows, above = [], []
    for name in wanted:
        each = sorted(share(series, name))
        median = each[len(each) // 2]
        rows.append([name, "Talus" if OUTPUTS[name][1] else "LAMMPS", f"{100 * median:.2f}", f"{100 * each[0]:.2f} to {100 * each[-1]:.2f}"])
        section.record(variant=name, particles=count, share=median)
        if median > GOAL:
            above.append(name)
    section.table(["output, every 1000 steps", "by", "share of the run (%)", "range"], rows)
    section.text(f"{count} spheres, {1e9 * series['none'].median / STEPS / count:.0f} ns per particle and step without output. Files go to "
                 "the folder of temporary files.")
    section.headline(f"outputs every {EVERY} steps: each below {100 * GOAL:.0f} % of a run of {count} spheres"
                     + (", but for " + ", ".join(above) if above else "") + ".")
