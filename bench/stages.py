# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Single stages of the contact pipeline on a bed in memory, and what canonical order costs."""

import google
import paired
import plot

TITLE = "Stages"
QUESTION = """What does each stage of a step and of a rebuild take on its own, with data in the cache and out of it? And what
does it cost that sums are taken in canonical order, against the same kernels on pairs as the neighbor list gives them?"""

REBUILD = 100       # steps between rebuilds
AIM = 1.10          # what canonical order may cost

# function of the program: what it does
STAGES = {
    "order_particles": "rebuild: particles into canonical order",
    "collect_pairs": "rebuild: pairs of the neighbor list, sorted",
    "keep_history": "rebuild: displacements put aside, fetched for the new pairs",
    "keep_history_periodic": "rebuild, periodic box: displacements put aside, fetched for the new pairs",
    "read_particles": "step: records read from the arrays of LAMMPS",
    "advance_records/acted_on": "step: records moved, of particles with contacts",
    "advance_records/free": "step: records moved, of particles without",
    "narrow_phase": "step: narrow phase",
    "contacts/hooke_frictionless": "step: contacts, hooke without friction",
    "contacts/hertz_frictionless": "step: contacts, hertz without friction",
    "contacts/hertz_onestep": "step: contacts, hertz, onestep friction",
    "contacts/hooke_multistep": "step: contacts, hooke, multistep friction",
    "contacts/hertz_multistep": "step: contacts, hertz, multistep friction",
    "add_to_host": "step: forces and torques added to the arrays of LAMMPS",
    "floor_find": "rebuild: which particles may touch a plane",
    "floor_contacts": "step: contacts with a plane, per sphere that touches it",
}

# how the work is divided: functions of a step and a rebuild, ours and those of the order-dependent baseline
DIVISIONS = {
    "one rank, one thread": (("canonical_step/one_part", "canonical_rebuild/one_part"), ("listed_step/one_part", "listed_rebuild")),
    "one rank, two threads": (("canonical_step/two_threads", "canonical_rebuild/two_threads"),
                              ("listed_step/two_threads", "listed_rebuild")),
    "two ranks": (("ranks_step/one_phase", "ranks_rebuild/one_phase"), ("listed_ranks_step", "listed_ranks_rebuild")),
    "two ranks, two phases (overlap)": (("ranks_step/two_phases", "ranks_rebuild/two_phases"),
                                        ("listed_ranks_step", "listed_ranks_rebuild")),
}


def measure(bench):
    found = google.run(bench, "contact_stages", bench.size(0.1, 0.01))
    if found is None:
        bench.section.text(google.LEFT_OUT)
        return
    series = {key: paired.Series([1e9 / result["items_per_second"] for result in each]) for key, each in found.items()}
    sizes = sorted({size for _, size in series})
    for (name, size), times in series.items():
        bench.section.record(stage=name, spheres=size, ns=times.median, low=min(times.values), high=max(times.values))
    stages(bench, series, sizes, found["contacts/hertz_multistep", sizes[-1]][0])
    order(bench, series, sizes)


def stages(bench, series, sizes, sample):
    section = bench.section
    section.heading("Stages")
    rows = [[words, *(series[name, size].median for size in sizes)] for name, words in STAGES.items() if bench.wants(name)]
    section.table(["ns per sphere", *(f"{size} spheres" for size in sizes)], rows)
    section.text(f"""One thread, medians of {bench.rounds} rounds. Spheres near the sites of a body-centerd lattice, in the order of their
keys, {sample["contacts"]:.2f} contacts and {sample["candidates"]:.2f} candidate pairs per sphere, as in a settled bed. contacts: narrow
phase, gathering, kernel and summing together. A stage that runs alone finds in the cache what it left there; in a whole step
of a large bed it does not, and stages that follow each other there share what they bring into it.""")
    if rows:
        section.plot("", "Time of each stage, by number of spheres", lambda plt: draw(plt, rows, sizes))


def order(bench, series, sizes):
    section, rows = bench.section, []

    def whole(names, size):
        """A step with its share of a rebuild, round by round."""
        step, rebuild = (series[name, size] for name in names)
        return paired.Series([a + b / REBUILD for a, b in zip(step.values, rebuild.values)])
    ratios = {}
    for words, (our_names, baseline_names) in DIVISIONS.items():
        for size in sizes:
            ours, baseline = whole(our_names, size), whole(baseline_names, size)
            ratio = paired.ratio(ours, baseline)
            times = [series[names[n], size].median for n in (0, 1) for names in (our_names, baseline_names)]
            rows.append([words, size, *times, str(ratio)])
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
sorting, each pair of a rank once. On two threads or ranks: the work of both, one after the other on one core. As listed on
two threads: the sums of the second are then added to those of the first (no thread contends for anything); on two ranks both
compute the pairs between them, as the stock styles do for friction with history, and two phases cost nothing. Ratios are medians
over the rounds (range); the functions of a round run in random order.""")


def draw(plt, rows, sizes):
    _, axes = plt.subplots(figsize=(6.5, 0.32 * len(rows) + 1))
    for k, size in enumerate(sizes):
        axes.plot([row[1 + k] for row in rows], range(len(rows)), label=f"{size} spheres", **{**plot.style(k), "linestyle": ""})
    axes.set_xscale("log")
    axes.set_yticks(range(len(rows)), [row[0] for row in rows], fontsize=7)
    axes.invert_yaxis()
    axes.set_xlabel("ns per sphere")
    axes.legend(loc="lower right")
