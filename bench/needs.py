# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What every feature costs, and what goes wrong where it is left out."""

import concurrent.futures
import os
import re

import beds
import features
import heap
import lammps
import left_out
import machine
import paired

TITLE = "What each feature costs"
QUESTION = """What does a scene save that leaves a feature out, in time, memory and message size, and how wrong is it where the
feature matters?"""

SHAPE = f"fix shapes all shape/gran type 2 box 1e-3 1e-3 1e-3 density {beds.DENSITY}\n"
LUDING = f"luding 1e4 4e4 1e4 0.02 100.0 tangential multistep NULL NULL {beds.MU}"
EEPA = f"eepa {beds.YOUNG} 0.5 {beds.NU} 0.02 0.5 0.0 1.5 3.0 tangential multistep NULL NULL {beds.MU}"
HOT = "fix hot all property/atom temperature heatflow ghost yes\nset group all temperature 300\nfix flow all heat/flow constant 1000\n"
STICKS = f"hertz {beds.KN} {beds.GN} tangential multistep NULL NULL {beds.MU}"


def variants(bench):
    """name: (law, with walls, atom style, words for the integrator, boundary)."""
    onestep = STICKS.replace("multistep", "onestep")
    dashpot = STICKS.replace("multistep NULL", "dashpot")
    material = f"hertz/material {beds.YOUNG} 0.5 {beds.NU} tangential multistep NULL NULL {beds.MU}"
    found = {
        "no friction, no damping": (beds.FRICTIONLESS.replace(str(beds.GN), "0.0"), True, "sphere", "", "f f f"),
        "no friction": (beds.FRICTIONLESS, True, "sphere", "", "f f f"),
        "dashpot friction": (dashpot, True, "sphere", "", "f f f"),
        "onestep friction": (onestep, True, "sphere", "", "f f f"),
        "multistep friction": (STICKS, True, "sphere", "", "f f f"),
        "multistep, midpoint": (STICKS + " midpoint", True, "sphere", "", "f f f"),
        "multistep, material law": (material, True, "sphere", "", "f f f"),
        "multistep, rolling": (STICKS + " rolling 0.02", True, "sphere", "", "f f f"),
        "multistep, rolling, spinning": (STICKS + " rolling 0.02 spinning 0.02", True, "sphere", "", "f f f"),
        "multistep, limit_damping": (STICKS + " limit_damping", True, "sphere", "", "f f f"),
        "multistep, adhesion": (STICKS + " adhesion perko 0.01", True, "sphere", "", "f f f"),
        "multistep, liquid bridges": (STICKS + " adhesion willett 1e-3 20 fraction 0.005", True, "sphere", "", "f f f"),
        "multistep, viscous bridges": (STICKS + " adhesion rabinovich 1e-3 20 fraction 0.005 viscosity 1e-3 0.01", True, "sphere", "",
                                       "f f f"),
        "multistep, elasto-plastic": (LUDING, True, "sphere", "", "f f f"),
        "multistep, eepa": (EEPA, True, "sphere", "", "f f f"),
        "multistep, heat": (STICKS + " heat radius 1.0", True, "hot", "", "f f f"),
        "multistep, heat through gas": (STICKS + " heat gas 1.0 0.025 0.5 0.1", True, "hot", "", "f f f"),
        "multistep, impact velocity and age": (material.replace("hertz/", "flores/").replace(f"{beds.NU} tang",
                                                                                        f"{beds.NU} 1.0 tang"),
                                            True, "sphere", "", "f f f"),
        "multistep, one body instead of five": (STICKS, False, "sphere", "", "f f f"),
        "multistep, order 2": (STICKS + " slider midpoint limit_damping", True, "sphere", " order 2", "f f f"),
        "multistep, a shape that no particle has": (STICKS, True, "shape", "", "f f f"),
        "multistep, orientation": (STICKS, True, "hybrid sphere dipole", " orientation yes", "f f f"),
    }
    return {name: v for name, v in found.items() if bench.wants(name)}


def script(bench, variant, count, steps):
    law, walls, style, words, boundary = variant
    data, _ = beds.bed(bench, count)
    physics = physics_of(law, walls, words)
    if style == "shape":
        return beds.script(f"{data} extra/atom/types 1", physics + SHAPE, 100, steps, boundary=boundary)
    if style == "hot":
        return beds.script(data, physics + HOT, 100, steps, boundary=boundary)
    if style != "sphere":
        return hybrid(data, physics, style, steps)
    return beds.script(data, physics, 100, steps, boundary=boundary)


def physics_of(law, walls, words):
    start = "half" if "order 2" in words else "plain"
    dry = law.split(" heat ")[0]     # walls have no temperature
    return beds.talus(dry, walls=walls, start=start, materials=law).replace("symplectic start", f"symplectic{words} start")


def hybrid(data, physics, style, steps, boundary="f f f", warm=100):
    """The bed in the data format of atom_style hybrid, written once."""
    path = data.replace(".data", ".dipole")
    if not os.path.exists(path):
        box, rows, velocities = beds.read_data(data)
        with open(path + ".new", "w") as file:
            file.write(f"spheres with dipoles\n\n{len(rows)} atoms\n1 atom types\n\n")
            for axis, (low, high) in zip("xyz", box):
                file.write(f"{low!r} {high!r} {axis}lo {axis}hi\n")
            file.write("\nAtoms\n\n")
            file.writelines(f"{r[0]} {int(r[1])} {r[4]!r} {r[5]!r} {r[6]!r} {r[2]!r} {r[3]!r} 0.0 1.0 0.0 0.0\n" for r in rows)
            file.write("\nVelocities\n\n")
            file.writelines(" ".join(map(repr, v)) + "\n" for v in velocities)
        os.replace(path + ".new", path)
    return beds.script(path, physics, warm, steps, boundary=boundary, style=style)


def times(bench, found, count, steps):
    """{name: Series of ns per particle and step}, all in turn on one core."""
    core = paired.one_core()

    def run(text):
        return lambda: lammps.run(bench.workdir, "needs", text, cores=core).loops()[-1].nanoseconds()
    return paired.measure({name: run(script(bench, v, count, steps)) for name, v in found.items()}, bench.rounds)


def bytes_per_particle(bench, variant, sizes):
    """Slope of the peak of resident memory over the size of the bed, with one rebuild."""
    peaks = [lammps.measured_peak(lammps.run(bench.workdir, "needs", script(bench, variant, n, 20))) for n in sizes]
    return (peaks[1] - peaks[0]) / (sizes[1] - sizes[0])


def message(bench, variant):
    """(bytes of a proxy in the host's messages, in those of the direct exchange).

    The host packs position, velocity and angular velocity of every proxy, 9 doubles, and what else the atom style has. comm_proxy info has
    the bytes and proxies of the direct exchange, which leaves these to the host's own packing if they are more than that."""
    if not features.has(bench, "comm_proxy yes"):
        return 72, "-"
    law, _, style, words, _ = variant
    data = beds.tile_data(bench)[0]
    physics = physics_of(law, False, words) + "comm_proxy yes\n"
    if style == "shape":
        text = beds.script(f"{data} extra/atom/types 1", physics + SHAPE, 0, 20, boundary="p p f")
    elif style == "hot":
        text = beds.script(data, physics + HOT, 0, 20, boundary="p p f")
    elif style != "sphere":
        text = hybrid(data, physics, style, 20, boundary="p p f", warm=0)
    else:
        text = beds.script(data, physics, 0, 20, boundary="p p f")
    log = lammps.run(bench.workdir, "message", text + "comm_proxy info\n", ranks=2).log
    sent, proxies = (float(re.search(rf"^ *{what} sent +\S+ +(\S+)", log, re.MULTILINE)[1]) for what in ("bytes", "particles"))
    return max(72, round(sent / proxies)), round(sent / proxies)


def costs(bench):
    section, found = bench.section, variants(bench)
    count = bench.size(50000, 12500)
    sizes = bench.size((50000, 400000), (12500, 50000))
    bench.note("times")
    series = times(bench, found, count, bench.size(600, 200))
    base = "multistep friction" if "multistep friction" in series else next(iter(series), None)
    rows = []
    for name, variant in found.items():
        bench.note(f"memory: {name}")
        memory = bytes_per_particle(bench, variant, sizes)
        ratio = paired.ratio(series[name], series[base])
        host, direct = message(bench, variant)
        rows.append([name, series[name].median, str(ratio), memory, host, direct])
        section.record(feature=name, ns=series[name].median, ratio=ratio.median, bytes_per_particle=memory, message=host,
                       direct_message=direct)
    section.heading("Cost")
    section.table(["scene", "ns per particle and step", f"time over that of {base}", "bytes per particle",
                   "bytes of a proxy in a message", "direct"], rows)
    section.text(f"""Bed of {count} spheres at rest, floor and four walls, one core, {bench.rounds} rounds in turn; memory: slope of the peak
between {sizes[0]} and {sizes[1]} spheres. The host's exchange sends position, velocity and angular velocity of every proxy in each
step, needed or not; direct: measured with comm_proxy on two ranks, which leaves out the angular velocity where no force reads it.""")
    exchange(bench)
    if rows:
        section.plot("", "Time over that of multistep friction", lambda plt: draw(plt, rows))


def exchange(bench):
    """What it costs to have neighbors at all: one rank, a box periodic in x and y against four walls."""
    if not bench.wants("exchange"):
        return
    bench.note("exchange")
    core, steps = paired.one_core(), bench.size(3000, 300)
    texts = {"periodic": beds.script(beds.tile_data(bench)[0], beds.talus(walls=False), 100, steps, boundary="p p f"),
             "fenced": beds.script(beds.bed(bench, beds.TILE)[0], beds.talus(), 100, steps)}

    def run(text):
        return lambda: lammps.run(bench.workdir, "exchange", text, cores=core).loops()[-1].nanoseconds()
    series = paired.measure({name: run(text) for name, text in texts.items()}, bench.rounds)
    ratio = paired.ratio(series["periodic"], series["fenced"])
    bench.section.text(f"""Exchange: {beds.TILE} spheres on a floor, box periodic in x and y against four walls:
{series["periodic"].median:.1f} against {series["fenced"].median:.1f} ns per particle and step, ratio {ratio}. The periodic one has
proxies on four sides, on which contacts are computed twice.""")
    bench.section.record(feature="exchange, periodic", ns=series["periodic"].median, ratio=ratio.median)


def draw(plt, rows):
    _, axes = plt.subplots(figsize=(6.5, 0.3 * len(rows) + 1))
    axes.barh(range(len(rows)), [float(row[2].split()[0]) for row in rows], color="0.5")
    axes.axvline(1.0, color="0.0", linestyle="--")
    axes.set_yticks(range(len(rows)), [row[0] for row in rows], fontsize=7)
    axes.invert_yaxis()
    axes.set_xlabel("time / time with multistep friction")


# ---- what is wrong without it -----------------------------------------------------------------

def where_it_matters(bench):
    section, rows = bench.section, []

    def turned(words):
        data, _ = beds.bed(bench, bench.size(50000, 12500))
        physics = beds.talus().replace("symplectic start", f"symplectic{words} start")
        return hybrid(data, physics, "hybrid sphere dipole", bench.size(300, 100), warm=0)
    for part in (left_out.slope, left_out.spinning, left_out.damping, left_out.adhesion, left_out.bodies):
        bench.note(f"left out: {part.__name__}")
        rows += part(bench)
    bench.note("left out: orientation, exchange")
    rows += left_out.orientation(bench, turned)
    if features.has(bench, "comm_proxy yes"):
        rows += left_out.exchange(bench)
    for row in rows:
        section.record(feature="left out: " + row[0], scene=row[1], quantity=row[2], full=row[3], left_out=row[4])
    section.heading("What is wrong without it")
    section.table(["feature", "where it matters", "", "with it", "without"], rows)
    section.text("""Orientation, and angular velocities in messages of scenes without friction, can be left out for nothing. The others are what the scene
is about, or can go: friction without memory does not hold anything on a slope, it only slows it down.""")


def errors(bench):
    section = bench.section
    laws = heap.laws()
    steps = bench.size(60000, 12000)
    with concurrent.futures.ThreadPoolExecutor(len(machine.cores())) as pool:
        found = dict(zip(laws, pool.map(lambda law: heap.collapse(bench, law, laws[law], steps), laws)))
    full = found[next(iter(laws))]
    rows = []
    for name, state in found.items():
        rows.append([name, state.height, state.runout, state.creep, 100 * (state.height / full.height - 1)])
        section.record(feature="heap: " + name, height=state.height, runout=state.runout, creep=state.creep)
    section.heading("What is wrong without it: a heap")
    section.table(["law", "mean height (d)", "run-out (d)", "creep (d/s)", "height, difference (%)"], rows)
    section.text(f"""A column of {heap.COUNT} spheres falls apart on a floor, {steps} steps of {heap.DT:g} s. mean height of the centers and
run-out (radius that holds 95 % of the spheres) at the end, in diameters; creep: mean horizontal way in the last quarter of the
time over that time. The first row is the full law; a heap of spheres without friction, or with friction that has no memory,
does not stand.""")


def measure(bench):
    costs(bench)
    if bench.wants("left out"):
        where_it_matters(bench)
    if bench.wants("heap"):
        bench.note("heap")
        errors(bench)
