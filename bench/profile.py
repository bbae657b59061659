# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Where the time of a step goes."""

import re
import shutil
import subprocess

import beds
import lammps
import machine
import paired
from lammps import STOCK, TALUS

TITLE = "Profile"
QUESTION = """What share of a step is broad phase, narrow phase, contact force, integration, exchange and waiting? The host's
own timers tell neighbor lists, pair style, communication and fixes apart; the functions within them are told apart by
sampling (perf), if that is available."""

CATEGORIES = ("Pair", "Neigh", "Comm", "Modify", "Output", "Other")

# of Chrono::Distributed: its report, 10 ranks and 1 rank, per cent; and release 8.0.0 on one core of such a machine
REFERENCE = [
    ["broad phase", 21.73, 35.58, 26], ["narrow phase", 10.67, 11.32, 11], ["contact forces (solver)", 61.11, 43.14, 33],
    ["communication", 5.81, float("nan"), float("nan")], ["other collision work", float("nan"), float("nan"), 22],
]

# first match counts; symbols of the plugin and of the host
STAGES = [
    ("waiting and messages", r"opal_|ompi_|mca_|PMPI_|MPI_|pml_|vader|poll"),
    ("exchange", r"Comm(Brick|Tiled|Proxy)|ProxyExchange|pack_comm|unpack_comm|pack_border|unpack_border|pack_exchange"
                 r"|unpack_exchange"),
    ("broad phase", r"NPair|NBin|NStencil|Neighbor|NeighList|CandidateList|order_particles|add_candidate"
                    r"|PartnerLists|FixContactStore|renumber|start_pairs|file_history|fetch_history|Atom::sort|CanonicalKey"),
    ("narrow phase", r"narrow_phase|find_contacts|NarrowPhase|find_touching"),
    ("large bodies", r"BodyContacts|FixLargeBody|FixWallGran|Plane::|Rectangle::"),
    ("integration", r"FixNVE|Symplectic|FixGravity|force_clear|memset"),
    ("contact force", r"ContactPipeline|contact_kernel|Kernel|run_law|evaluate|gather|transpose|add_up|ParticleRecords"
                      r"|Pair|GranSub|Granular|ContactBatch|sqrt|Talus"),
]


def stage_of(symbol):
    return next((name for name, pattern in STAGES if re.search(pattern, symbol)), "other")


def sampled(bench, script, code, ranks):
    """{stage: share} by perf, or None where it does not work."""
    if not shutil.which("perf"):
        return None
    data = bench.path("perf.data")
    record = [shutil.which("perf"), "record", "-q", "-F", "997", "-o", data, "--"]
    try:
        lammps.run(bench.workdir, "perf", script, code, ranks=ranks, cores=None if ranks > 1 else paired.one_core(),
                   prefix=record)
    except lammps.Failed:
        return None
    done = subprocess.run(["perf", "report", "-i", data, "--stdio", "--no-children", "-F", "overhead,dso,symbol", "-g", "none"],
                          capture_output=True, text=True, check=False)
    shares = {}
    for line in done.stdout.splitlines():
        match = re.match(r"\s*([\d.]+)%\s+(\S+)\s+\[(.)\]\s+(.*)", line)
        if match:
            mpi = re.match(r"libmpi|libopen-|mca_|libucp|libpmix|libevent", match[2])
            stage = STAGES[0][0] if mpi else "other" if match[3] == "k" else stage_of(match[4])
            shares[stage] = shares.get(stage, 0.0) + float(match[1])
    return shares or None


def breakdown(bench, name, script, code, ranks):
    """Nanoseconds per particle and step by category of the host, medians over the rounds."""
    cores = paired.one_core() if ranks == 1 else machine.cores()[-2:]
    rounds = []
    for _ in range(bench.rounds):
        loop = lammps.run(bench.workdir, "profile", script, code, cores=cores, ranks=ranks).loops()[-1]
        rounds.append({key: 1e9 * seconds * ranks / (loop.steps * loop.atoms) for key, seconds in loop.breakdown.items()}
                      | {"total": loop.nanoseconds() * ranks})
    middle = sorted(rounds, key=lambda r: r["total"])[len(rounds) // 2]
    bench.section.record(variant=name, ranks=ranks, **middle)
    return middle


def measure(bench):
    section = bench.section
    count = bench.size(50000, 12500)
    data, _ = beds.bed(bench, count)
    steps = bench.size(1000, 200)
    physics = {"Talus": (TALUS, beds.talus()), "stock": (STOCK, beds.stock())}
    runs = {(name, ranks): (code, beds.script(data, text, 100, steps)) for name, (code, text) in physics.items()
            for ranks in (1, 2) if ranks <= len(machine.cores())}
    rows, stages = [], {}
    for (name, ranks), (code, script) in runs.items():
        bench.note(f"{name}, {ranks} rank(s)")
        found = breakdown(bench, name, script, code, ranks)
        rows.append([name, ranks, found["total"], *(found.get(key, 0.0) for key in CATEGORIES)])
        long = script.replace(f"run {steps}\n", f"run {bench.size(3000, 2000)}\n")      # so that the start counts little
        stages[f"{name}, {ranks}"] = sampled(bench, long, code, ranks)
    section.heading("Timers of the host")
    section.table(["", "ranks", "ns per particle and step", *CATEGORIES], rows)
    section.text(f"""Bed of {count} spheres, Hertz, friction with history, floor and walls, lists rebuilt every 100 steps. ns of
all cores together. Pair: narrow phase and contact forces; Neigh: building of lists; Comm: exchange, ghosts, sorting, and
what is done when particles migrate; Modify: integration, gravity, floor and walls, storing of displacements.""")
    sampled_table(bench, stages)
    section.heading("The reference")
    section.table(["", "10 ranks (%)", "1 rank (%)", "1 core here (%)"], REFERENCE)
    section.text("""Chrono::Distributed: the first two columns are those of its technical report (1.236 million bodies per rank), the
third was measured with release 8.0.0 and its scaling scene on one core of a machine like this one.""")
    section.plot("", "Time of a step by timer", lambda plt: draw(plt, rows))


def sampled_table(bench, stages):
    section = bench.section
    section.heading("Samples")
    stages = {name: shares for name, shares in stages.items() if shares}
    if not stages:
        section.text("perf is not available, or may not sample (kernel.perf_event_paranoid): left out.")
        return
    names = [name for name, _ in STAGES] + ["other"]
    section.table(["stage (%)", *stages], [[stage] + [shares.get(stage, 0.0) for shares in stages.values()]
                                           for stage in names])
    for name, shares in stages.items():
        section.record(variant="samples " + name, **shares)
    section.text("Shares of all samples of the whole process, start included, by the name of the function; columns: code, ranks.")


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
