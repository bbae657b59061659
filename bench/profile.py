# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Where the time of a step goes."""

import os
import re
import shutil
import subprocess

import beds
import function_stages
import lammps
import machine
import paired
from lammps import STOCK, TALUS

TITLE = "Profile"
QUESTION = """What share of a step is broad phase, narrow phase, contact force, integration, exchange and waiting? The host's
own timers tell neighbor lists, pair style, communication and fixes apart; the functions within them are told apart by
sampling (perf), if that is available."""

# name, code, physics, commands before the run
VARIANTS = [
    ("Talus", TALUS, beds.talus, "run_style verlet\n"),
    ("Talus, run style of LAMMPS", TALUS, beds.talus, "comm_proxy yes\nrun_style verlet/stock\n"),
    ("stock", STOCK, beds.stock, ""),
]
CATEGORIES = ("Pair", "Neigh", "Comm", "Modify", "Output", "Other")

# of Chrono::Distributed, per cent: its report, 1 rank and 10 ranks (1.236 million bodies each); release 8.0.0, one core
REFERENCE = {
    "broad phase": (35.58, 21.73, 26.0), "narrow phase": (11.32, 10.67, 11.0), "contact force": (43.14, 61.11, 33.0),
    "exchange": (float("nan"), 5.81, float("nan")), "other": (9.96, 0.68, 30.0),
}

SHOWN = ("broad phase", "narrow phase", "contact force", "floor and walls", "integration", "exchange", "waiting", "other")


def sampled(bench, script, code, ranks):
    """{stage: share of the samples of the last run command} by perf, or None where it does not work."""
    if not shutil.which("perf"):
        return None
    data, control = bench.path("perf.data"), bench.path("perf.control")
    if not os.path.exists(control):
        os.mkfifo(control)
    # perf begins when LAMMPS says so, and ends before LAMMPS does
    script = re.sub(r"(run \d+\n)$", rf"shell echo enable > {control}\n\1shell echo disable > {control}\n", script)
    record = [shutil.which("perf"), "record", "-q", "-F", "997", "-D", "-1", "--control", f"fifo:{control}", "-o", data, "--"]
    try:
        lammps.run(bench.workdir, "perf", script, code, ranks=ranks, cores=cores(ranks), prefix=record, timeout=300)
    except lammps.Failed:
        return None
    done = subprocess.run(["perf", "report", "-i", data, "--comm", "lmp", "--stdio", "--no-children", "-F", "overhead,dso,symbol",
                           "-g", "none"], capture_output=True, text=True, check=False)
    shares = {}
    for line in done.stdout.splitlines():
        match = re.match(r"\s*([\d.]+)%\s+(\S+)\s+\[(.)\]\s+(.*)", line)
        if match:
            stage = "other" if match[3] == "k" else function_stages.stage_of(match[2], match[4])
            shares[stage] = shares.get(stage, 0.0) + float(match[1])
    total = sum(shares.values())
    return {stage: share / total for stage, share in shares.items()} if total else None


def cores(ranks):
    return paired.one_core() if ranks == 1 else machine.cores()[-ranks:]


def breakdown(bench, name, script, code, ranks):
    """Nanoseconds per particle and step by category of the host, of the round in the middle."""
    rounds = []
    for _ in range(bench.rounds):
        loop = lammps.run(bench.workdir, "profile", script, code, cores=cores(ranks), ranks=ranks).loops()[-1]
        rounds.append({key: 1e9 * seconds * ranks / (loop.steps * loop.atoms) for key, seconds in loop.breakdown.items()}
                      | {"total": loop.nanoseconds() * ranks})
    middle = sorted(rounds, key=lambda r: r["total"])[len(rounds) // 2]
    bench.section.record(variant=name, ranks=ranks, **middle)
    return middle


def measure(bench):
    section = bench.section
    count = bench.size(50000, 12500)
    data, _ = beds.bed(bench, count)
    steps = 1000
    rows, shares, totals = [], {}, {}
    for name, code, physics, more in VARIANTS:
        for ranks in (1, 2):
            if ranks > len(machine.cores()):
                continue
            bench.note(f"{name}, {ranks} rank(s)")
            script = beds.script(data, physics(), 100, steps, more=more)
            found = breakdown(bench, name, script, code, ranks)
            rows.append([name, ranks, found["total"], *(found.get(key, 0.0) for key in CATEGORIES)])
            shares[name, ranks], totals[name, ranks] = sampled(bench, script, code, ranks), found["total"]
    sampled_table(bench, shares, totals)
    section.heading("Timers of the host")
    section.table(["", "ranks", "ns per particle and step", *CATEGORIES], rows)
    section.text(f"""Bed of {count} spheres, Hertz, friction with history, floor and walls, lists rebuilt every 100 steps. ns of
all cores together. Pair: narrow phase and contact forces, and with the run style of Talus the integration, too; Neigh: building of lists;
Comm: exchange, waiting, ghosts, sorting; Modify: integration, gravity, floor and walls, and what is done with displacements at
rebuilds.""")
    section.plot("", "Time of a step by timer of the host", lambda plt: draw(plt, rows))


def sampled_table(bench, sampled_shares, totals):
    section = bench.section
    section.heading("Stages")
    found = {key: shares for key, shares in sampled_shares.items() if shares}
    if not found:
        section.text("perf is not available, or may not sample (kernel.perf_event_paranoid): left out.")
        return
    rows, nothing = [], (float("nan"),) * 3
    for stage in SHOWN:
        shares = [of_stage.get(stage, 0.0) for of_stage in found.values()]
        rows.append([stage, *(f"{share * totals[key]:.1f} ({100 * share:.0f} %)" for key, share in zip(found, shares)),
                     *REFERENCE.get(stage, nothing)])
    rows.append(["whole step", *(f"{totals[key]:.1f}" for key in found), 100.0, 100.0, 100.0])
    section.table(["ns per particle and step (share)", *(f"{name}, {ranks} rank{'s' if ranks > 1 else ''}" for name, ranks in found),
                   "Chrono::Distributed, 1 rank (%)", "10 ranks (%)", "1 core here (%)"], rows)
    for (name, ranks), shares in found.items():
        section.record(variant="samples, " + name, ranks=ranks, **{key: 100 * value for key, value in shares.items()})
    section.text("""Samples of the functions that run (perf, about 1000 per second) during the steps, as shares of the measured time; on
two ranks of both cores together. broad phase: neighbor lists, sorting, and all that is done with pairs and displacements at
rebuilds; waiting: all time in the MPI library, the moving of data among it; other: the operating system and what could not be
attributed. The kernel of contacts with floor and walls is the one of contacts between spheres and counts there.
Chrono::Distributed: its technical report, 1 rank and 10 ranks of 12 cores with 1.236 million bodies each, where contact force is
its solver and exchange its communication; and release 8.0.0 with its scaling scene on one core of a machine like this one, where
other is mostly its serial contacts with planes.""")


def draw(plt, rows):
    _, axes = plt.subplots(figsize=(6.5, 0.5 * len(rows) + 1.2))
    left = [0.0] * len(rows)
    for k, key in enumerate(CATEGORIES):
        widths = [row[3 + k] for row in rows]
        axes.barh(range(len(rows)), widths, left=left, color=str(0.15 + 0.14 * k), edgecolor="white", label=key,
                  hatch=["", "//", "..", "", "xx", ""][k])
        left = [a + b for a, b in zip(left, widths)]
    axes.set_yticks(range(len(rows)), [f"{row[0]}, {row[1]} rank(s)" for row in rows])
    axes.invert_yaxis()
    axes.set_xlabel("ns per particle and step, all cores")
    axes.legend(ncol=3)
