# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Single stages of the contact pipeline on a bed in memory, and what canonical order costs."""

import json
import os
import subprocess

import lammps
import machine
import paired
import plot

TITLE = "Stages"
QUESTION = """What does each stage of a step and of a rebuild take on its own, with data in the cache and out of it? And what
does it cost that sums are taken in canonical order, against the same kernels on pairs as the neighbor list gives them?"""

PROGRAM = os.path.join(machine.BUILD, "bench", "contact_stages")
REBUILD = 100       # steps between rebuilds
AIM = 1.10          # what canonical order may cost
LISTED = "listed"   # the order-dependent twin

# function of the program: what it does
STAGES = {
    "order_particles": "rebuild: particles into canonical order",
    "collect_pairs": "rebuild: pairs of the neighbor list, sorted",
    "keep_history": "rebuild, no periodic borders: displacements kept, fetched by pair",
    "file_history": "rebuild, periodic box: displacements filed by particle",
    "fetch_history": "rebuild, periodic box: displacements fetched by pair",
    "read_particles": "step: records read from the arrays of the host",
    "advance_records": "step: records moved, with the travel since the rebuild",
    "narrow_phase": "step: narrow phase",
    "contacts/hooke_frictionless": "step: contacts, hooke without friction",
    "contacts/hertz_frictionless": "step: contacts, hertz without friction",
    "contacts/hertz_onestep": "step: contacts, hertz, onestep friction",
    "contacts/hooke_multistep": "step: contacts, hooke, multistep friction",
    "contacts/hertz_multistep": "step: contacts, hertz, multistep friction",
    "add_to_host": "step: forces and torques added to the arrays of the host",
    "floor_find": "rebuild: which particles may touch a plane",
    "floor_contacts": "step: contacts with a plane, per sphere that touches it",
}

# how the work is divided: (function, variant) of a step and of a rebuild, for `FUNCTION_step/VARIANT`
DIVISIONS = {
    "one rank, one thread": "canonical_{}/one_part",
    "one rank, two threads": "canonical_{}/two_threads",
    "two ranks": "ranks_{}/one_phase",
    "two ranks, two phases (overlap)": "ranks_{}/two_phases",
}


def one_round(bench):
    """{(function, spheres): result of Google Benchmark}."""
    out = bench.path("stages.json")
    command = ["taskset", "-c", str(paired.one_core()[0]), PROGRAM, f"--benchmark_out={out}", "--benchmark_out_format=json",
               f"--benchmark_min_time={bench.size(0.1, 0.01)}"]
    if bench.quick:
        command.append("--benchmark_filter=/(3000|50000)$")
    # the parts of several threads one after the other: their work is asked for, not what the machine makes of it
    done = subprocess.run(command, env=dict(os.environ, OMP_THREAD_LIMIT="1"), capture_output=True, text=True, check=False)
    if done.returncode:
        raise lammps.Failed(f"{PROGRAM}: {done.stderr[-1500:]}")
    with open(out) as file:
        results = json.load(file)["benchmarks"]
    return {(name, int(size)): result for result in results for name, size in [result["name"].rsplit("/", 1)]}


def measure(bench):
    if not os.path.exists(PROGRAM):
        bench.section.text("Left out: Google Benchmark was not found when Talus was built (Debian: libbenchmark-dev).")
        return
    rounds = []
    for k in range(bench.rounds):
        bench.note(f"round {k + 1} of {bench.rounds}")
        rounds.append(one_round(bench))
    series = {key: paired.Series([1e9 / found[key]["items_per_second"] for found in rounds]) for key in rounds[0]}
    sizes = sorted({size for _, size in series})
    for (name, size), times in series.items():
        bench.section.record(stage=name, spheres=size, ns=times.median, low=min(times.values), high=max(times.values))
    stages(bench, series, sizes, rounds[0])
    order(bench, series, sizes)


def stages(bench, series, sizes, first):
    section = bench.section
    section.heading("Stages")
    rows = [[words, *(series[name, size].median for size in sizes)] for name, words in STAGES.items() if bench.wants(name)]
    section.table(["ns per sphere", *(f"{size} spheres" for size in sizes)], rows)
    sample = first["contacts/hertz_multistep", sizes[-1]]
    section.text(f"""One thread, medians of {bench.rounds} rounds. Spheres near the sites of a body-centred lattice, in the order of their
keys, {sample["contacts"]:.2f} contacts and {sample["candidates"]:.2f} candidate pairs per sphere, as in a settled bed. contacts: narrow
phase, gathering, kernel and summing together. A stage that runs alone finds in the cache what it left there; in a whole step
of a large bed it does not, and stages that follow each other there share what they bring into it.""")
    if rows:
        section.plot("", "Time of each stage, by number of spheres", lambda plt: draw(plt, rows, sizes))


def order(bench, series, sizes):
    section, rows = bench.section, []

    def whole(pattern, size):
        """A step with its share of a rebuild, round by round."""
        pairs = zip(series[pattern.format("step"), size].values, series[pattern.format("rebuild"), size].values)
        return paired.Series([step + rebuild / REBUILD for step, rebuild in pairs])
    ratios = {}
    for words, pattern in DIVISIONS.items():
        for size in sizes:
            ours, twin = whole(pattern, size), whole(LISTED + "_{}", size)
            ratio = paired.ratio(ours, twin)
            rows.append([words, size, series[pattern.format("step"), size].median,
                         series[LISTED + "_step", size].median, series[pattern.format("rebuild"), size].median,
                         series[LISTED + "_rebuild", size].median, str(ratio)])
            section.record(stage="canonical order: " + words, spheres=size, ns=ours.median, ratio=ratio.median,
                           low=ratio.low, high=ratio.high)
            ratios.setdefault(words, []).append(ratio.median)
    above = {words: found for words, found in ratios.items() if max(found) > AIM}
    if above and not bench.quick:
        costs = "; ".join(f"{words} {100 * (min(found) - 1):.0f} to {100 * (max(found) - 1):.0f} %"
                          for words, found in above.items())
        section.headline(f"stages: canonical order costs more than the {100 * (AIM - 1):.0f} % that were aimed at: {costs}.")
    section.heading("What canonical order costs")
    section.table(["", "spheres", "step (ns per sphere)", "as listed", "rebuild (ns per sphere)", "as listed",
                   f"ratio of step + rebuild/{REBUILD}"], rows)
    section.text("""Hertz with multistep friction; step: particles moved and contacts computed, in the records; rebuild: all that Talus does with
a new neighbor list, the making of which is left out. As listed: the same kernels on pairs in the order of the list, no keys, no
sorting, each pair once; its work on two threads or ranks is taken to be that of one, which no real code reaches, since it
would have to bring together what several have added to one particle. Ours on two threads or ranks: the work of both, one
after the other on one core, pairs between them computed by both. Ratios are medians over the rounds (range).""")


def draw(plt, rows, sizes):
    _, axes = plt.subplots(figsize=(6.5, 0.32 * len(rows) + 1))
    for k, size in enumerate(sizes):
        axes.plot([row[1 + k] for row in rows], range(len(rows)), label=f"{size} spheres", **{**plot.style(k), "linestyle": ""})
    axes.set_xscale("log")
    axes.set_yticks(range(len(rows)), [row[0] for row in rows], fontsize=7)
    axes.invert_yaxis()
    axes.set_xlabel("ns per sphere")
    axes.legend(loc="lower right")
