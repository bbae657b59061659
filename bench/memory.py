# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Peak of resident memory per particle, by what is switched on, against other codes."""

import math

import arrays
import beds
import lammps
import machine
from lammps import LIGGGHTS, STOCK, TALUS

TITLE = "Memory"
QUESTION = """How many bytes does a particle take, with which features, and what would 10^9 particles need? Peak of the
resident memory of one process, which the operating system keeps, for beds of different size: their difference over the
difference in particles leaves out what does not grow with them."""

NODE, FILLED = 256, 0.8     # GiB; share of it for the run
STEPS = 120     # with one rebuild of the neighbor lists, which is where the peak is

BODIES, WALLS = 5, 3      # of the bed: large bodies, fixes of the stock style
COMPARED = ("Talus, multistep friction, floor and walls", "stock gran/hertz/history, floor and walls")
NOTHING = "pair_style none\ncomm_modify cutoff 3e-3\nfix move all nve/sphere\n"
STOCK_PLAIN = "gran/hooke 500.0 NULL 50.0 NULL 0.5 1"    # as stiff as the Hertzian contacts of the bed


def talus(law, bodies):
    text = beds.talus(law)
    return text if bodies else "\n".join(line for line in text.splitlines() if "large/body" not in line) + "\n"


def stock(pair, bodies):
    text = beds.stock(pair)
    return text if bodies else "\n".join(line for line in text.splitlines() if "wall/gran" not in line) + "\n"


def variants():
    """name: (code, physics)"""
    found = {
        "particles alone": (STOCK, NOTHING),
        "Talus, no friction": (TALUS, talus(beds.FRICTIONLESS, False)),
        "Talus, onestep friction": (TALUS, talus(beds.HISTORY.replace("multistep", "onestep"), False)),
        "Talus, multistep friction": (TALUS, talus(beds.HISTORY, False)),
        "Talus, multistep friction, floor and walls": (TALUS, talus(beds.HISTORY, True)),
        "stock gran/hooke": (STOCK, stock(STOCK_PLAIN, False)),
        "stock gran/hertz/history": (STOCK, stock(f"gran/{beds.STOCK_HISTORY}", False)),
        "stock gran/hertz/history, floor and walls": (STOCK, stock(f"gran/{beds.STOCK_HISTORY}", True)),
        "stock granular, floor and walls": (STOCK, beds.stock_granular()),
    }
    if machine.LIGGGHTS:
        found["LIGGGHTS, floor and walls"] = (LIGGGHTS, None)
    return found


def peak(bench, count, code, physics):
    data, box = beds.bed(bench, count)
    if code == LIGGGHTS:
        script = beds.liggghts_script(data, box, 0, STEPS)
    else:
        script = beds.script(data, physics, 0, STEPS)
    return lammps.measured_peak(lammps.run(bench.workdir, "memory", script, code))


def by_array(bench, measured):
    """Tables of what stands in memory by design, beside the measured bytes per particle of the compared variants."""
    contacts, pairs = beds.contacts(bench, bench.size(50000, 12500))
    rows, sums = arrays.table(contacts, pairs, BODIES, WALLS)
    section = bench.section
    section.heading("By array")
    section.table(["whose", "array", "bytes", "bytes per particle of the bed", "if"], rows)
    section.text(f"""By design, for {contacts:.2f} contacts and {pairs:.2f} candidate pairs per sphere,
{BODIES} large bodies with friction or {WALLS} fixes wall/gran; to be compared with what is measured:""")
    totals = []
    for name, owner in zip(COMPARED, ("Talus", "stock gran/hertz/history")):
        total = max(sums["LAMMPS"][phase] + sums[owner][phase] for phase in arrays.PHASES)
        totals.append([name, total, measured.get(name, float("nan")), measured.get(name, float("nan")) - total])
        bench.section.record(variant="by array: " + name, bytes_per_particle=total)
    section.table(["bytes per particle", "sum of the arrays", "measured", "rest"], totals)
    section.text("""Sum: the largest of what stands at once in steps, while displacements are put aside, and while
new lists are made: a rebuild of Talus takes the place of what it replaces. Without what other laws, checks of the lists, threads or ranks need. Rest: arrays that have grown further than
needed, buffers of messages and of reading the file, what the allocator holds, or less where an array is freed before others
grow. A proxy takes as much as a particle, without its share of pairs.""")


def measure(bench):
    section = bench.section
    sizes = bench.size((50000, 400000), (12500, 50000))
    rows, per_particle = [], {}
    for name, (code, physics) in variants().items():
        if not bench.wants(name):
            continue
        bench.note(name)
        peaks = [peak(bench, count, code, physics) for count in sizes]
        per_particle[name] = (peaks[1] - peaks[0]) / (sizes[1] - sizes[0])
        section.record(variant=name, small=sizes[0], large=sizes[1], small_bytes=peaks[0], large_bytes=peaks[1],
                       bytes_per_particle=per_particle[name])
        rows.append([name, peaks[1] / 2**20, per_particle[name], per_particle[name] * 1e9 / 2**40])
    section.table(["", f"peak at {sizes[1]} (MiB)", "bytes per particle", "10^9 particles (TiB)"], rows)
    section.text(f"Beds of {sizes[0]} and {sizes[1]} spheres, {STEPS} steps with a rebuild, one rank. Differences between the "
                 "rows are what a feature takes; the temporary copies of a rebuild are part of the peak.")
    ours, stock = (per_particle.get(name) for name in COMPARED)
    if ours:
        need = ours * 1e9 / 2**30
        section.text(f"""10^9 particles of the full law with floor and walls need {need:.0f} GiB, without proxies: {math.ceil(need / NODE / FILLED)} nodes
of {NODE} GiB that are filled to {100 * FILLED:.0f} %.""")
    if ours and stock:
        section.headline(f"memory: from {sizes[0]} to {sizes[1]} spheres Talus takes {ours:.0f} bytes for each, stock {stock:.0f}.")
    if not bench.quick and bench.wants("large"):
        large(bench)
    by_array(bench, per_particle)
    if rows:
        section.plot("", "Bytes per particle", lambda plt: draw(plt, rows))


def large(bench):
    """The whole process with 1 236 372 spheres."""
    count = 1236372
    rows = []
    for name in COMPARED:
        bench.note(f"{count} spheres: {name}")
        code, physics = variants()[name]
        size = peak(bench, count, code, physics) / count
        rows.append([name, size])
        bench.section.record(variant=name + ", whole process", large=count, bytes_per_particle=size)
    bench.section.table([f"{count} spheres, whole process", "bytes per particle"], rows)
    (_, ours), (_, stock) = rows
    bench.section.headline(f"memory: a process with {count} spheres takes {ours:.0f} bytes for each, stock {stock:.0f}.")


def draw(plt, rows):
    _, axes = plt.subplots(figsize=(6.5, 0.3 * len(rows) + 1))
    axes.barh(range(len(rows)), [row[2] for row in rows], color=["0.35" if "Talus" in row[0] else "0.7" for row in rows])
    axes.set_yticks(range(len(rows)), [row[0] for row in rows], fontsize=7)
    axes.invert_yaxis()
    axes.set_xlabel("bytes per particle")
