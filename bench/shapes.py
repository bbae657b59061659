# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What convex particles, superellipsoids and clumps cost, and how dense convex ones pack."""

import re
import shutil
import subprocess

import clump_beds
import lammps
import machine
import paired
import shape_beds
from lammps import ASPHERE, BODY, STOCK, TALUS

TITLE = "Particles that are not spheres"
QUESTION = """What do a convex particle and a clump cost per step, beside a sphere and beside what LAMMPS has for them? Settled beds,
periodic in x and y, on a floor, one core; linear springs with damping and friction, of clumps Hertzian ones. Convex bodies are rounded by 1/20 of
the edge of the cube."""

KINDS = ("spheres", "cubes", "dodecahedra", "mixed")
COMPARED = ("cubes", "dodecahedra")     # with pair body/rounded/polyhedron
FLOOR = 10.0
SIZES = (8, 12), (5, 6)     # bodies along the sides, layers
# J. Baker, A. Kudrolli, Phys. Rev. E 82, 061304 (2010): loosest and densest packings of plastic dice (with friction)
MEASURED = {"cubes": (0.54, 0.67), "dodecahedra": (0.51, 0.63), "tetrahedra": (0.51, 0.64)}

NARROW = re.compile(r"collide|find_gap|find_least_depth|nearest_point|highest_vertex|_contacts|edges_touch|weights_of_edges|"
                    r"find_common_normal|CommonNormalSearch|EightPairs|eight_poses|many_superellipsoids|Superellipsoid|Simplex|Candidates|least_of_faces|edges_above|to_space|Talus::touch")


def run(bench, name, script, code=TALUS, **options):
    return lammps.run(bench.workdir, name, script, code, cores=paired.one_core(), **options)


def state(bench, kind, bed, law=shape_beds.LAW):
    """Of a bed at rest: mass, moment and volume of a body; pairs that touch and points per body, kinetic energy."""
    more = "variable m equal mass(all)/atoms\n"
    shaped = any(shape_beds.BODIES[kind])
    print_it = 'print "RESULT ' + ("$(f_shapes[6]/atoms) $(f_shapes[7]/atoms) $(f_shapes/atoms)" if shaped else "0 0 0") \
        + ' $(v_m)"\n'
    if shaped:
        more += "thermo_style custom step f_shapes f_shapes[6] f_shapes[7]\nthermo_modify norm no lost error\n"
    result = run(bench, "state", shape_beds.talus_script(bench, kind, bed, shape_beds.REST, 1, law, more) + print_it)
    return result.printed("RESULT")[0]


def narrow_share(bench, script):
    """Share of the samples of a run in functions of the narrow phase, by perf; NaN without it."""
    perf = shutil.which("perf")
    if not perf:
        return float("nan")
    data = bench.path("perf.data")
    try:
        run(bench, "perf", script, prefix=[perf, "record", "-q", "-F", "997", "-o", data, "--"])
    except lammps.Failed:
        return float("nan")
    done = subprocess.run([perf, "report", "-i", data, "--comm", "lmp", "--stdio", "--no-children", "-F", "overhead,symbol",
                           "-g", "none"], capture_output=True, text=True, check=False)
    shares = [(float(match[1]), match[2]) for match in re.finditer(r"^\s*([\d.]+)%\s+\[.\]\s+(.*)$", done.stdout, re.MULTILINE)]
    total = sum(share for share, _ in shares)
    return sum(share for share, name in shares if NARROW.search(name)) / total if total else float("nan")


def memory(bench, kind, bed):
    """Bytes per body, from the peaks of two beds."""
    peaks, counts = [], []
    for times in bench.size((2, 5), (1, 3)):
        larger = shape_beds.tiled(bed, times)
        peaks.append(run(bench, "memory", shape_beds.talus_script(bench, kind, larger, 0, 30)).peak)
        counts.append(len(larger[1]))
    return (peaks[1] - peaks[0]) / (counts[1] - counts[0])


def moment_of(bench, kind, bed):
    """Moment of inertia of bodies with three equal ones: L = I omega."""
    omega = 1e-3
    script = shape_beds.head() + f"read_data {kind}.data\n" + shape_beds.physics(kind, shape_beds.LAW) \
        + f"set group all omega {omega} 0 0\nthermo_style custom step f_shapes[3]\nthermo_modify norm no lost error\n" \
        + f"timestep {shape_beds.DT}\nneighbor 0.15 bin\nrun 0\n" + 'print "RESULT $(f_shapes[3]/atoms)"\n'
    return run(bench, "moment", script).printed("RESULT")[0][0] / omega


def timed(bench, kind, bed, steps):
    script = shape_beds.talus_script(bench, kind, bed, shape_beds.REST, steps)
    return lambda: run(bench, kind, script).loops()[-1].nanoseconds()


def convex(bench):
    across, layers = bench.size(*SIZES)
    rows, found = [], {}
    for kind in KINDS:
        if not bench.wants(kind):
            continue
        bed = shape_beds.settled(bench, kind, across, layers)
        pairs, points, energy, mass = state(bench, kind, bed)
        steps = bench.size(1000, 200)
        found[kind] = bed, mass, pairs, points
        variants = {TALUS: timed(bench, kind, bed, steps)}
        if kind in COMPARED and machine.BODY_LMP:
            stock = shape_beds.stock_script(bench, kind, bed, 5, bench.size(30, 10), mass, moment_of(bench, kind, bed))
            variants[BODY] = lambda s=stock: run(bench, "body", s, BODY).loops()[-1].nanoseconds()
        bench.note(f"{kind}: {pairs:.2f} pairs, {points:.2f} points per body, kinetic energy {energy:.1e}")
        series = paired.measure(variants, bench.rounds)
        for name, values in series.items():
            for k, value in enumerate(values.values):
                bench.section.record(case=kind, code=name, round=k + 1, ns_per_body=value)
        share = narrow_share(bench, shape_beds.talus_script(bench, kind, bed, 0, steps)) if kind != "spheres" else float("nan")
        ratio = paired.ratio(series[BODY], series[TALUS]) if BODY in series else None
        rows.append([kind, len(bed[1]), pairs or "-", points or "-", series[TALUS].median, f"{100 * share:.0f} %" if share == share else "-",
                     memory(bench, kind, bed), series[BODY].median if ratio else "-", str(ratio) if ratio else "-"])
        bench.section.record(case=kind, code=TALUS, bodies=len(bed[1]), pairs=pairs, points=points, narrow_share=share,
                             bytes_per_body=rows[-1][6])
    if not rows:
        return
    bench.section.heading("Convex particles")
    bench.section.table(["bed", "bodies", "pairs that touch per body", "points per body", "ns per body and step", "narrow phase",
                         "bytes per body", "body/rounded/polyhedron, ns", "ratio"], rows)
    bench.section.text(f"""pair_style body/rounded/polyhedron starts from the same state with the same stiffness, in a LAMMPS with package BODY; faces have at most
four corners there, so those of dodecahedra are divided. Its friction and damping are other formulas. Goal of the ratio: {FLOOR:.0f}. Bytes: difference of the peaks of two beds over
the difference in bodies. Narrow phase: share of samples (perf) of a whole run.""")
    for row in rows:
        if row[0] in COMPARED and row[-1] != "-":
            bench.section.headline(f"shapes: a step of settled {row[0]} takes {row[4] / 1000:.2f} us per body; with pair body/rounded/polyhedron "
                                   f"of LAMMPS {row[-1]} times as long.")


# ---- superellipsoids --------------------------------------------------------------------------

ROUND_LIMITS = {"ellipsoids": 4.0, "superellipsoids": 10.0}      # over a sphere
ROUND_FLOOR = 10.0


def superellipsoids(bench):
    if not bench.wants("superellipsoids"):
        return
    across, layers = bench.size(*SIZES)
    steps = bench.size(1000, 200)
    spheres = timed(bench, "spheres", shape_beds.settled(bench, "spheres", across, layers), steps)
    rows = []
    for kind, limit in ROUND_LIMITS.items():
        bed = shape_beds.settled(bench, kind, across, layers)
        pairs, _, energy, _ = state(bench, kind, bed)
        bench.note(f"{kind}: {pairs:.2f} pairs per body, kinetic energy {energy:.1e}")
        variants = {"spheres": spheres, TALUS: timed(bench, kind, bed, steps)}
        if machine.ASPHERE_LMP:
            stock = shape_beds.superellipsoid_script(bench, kind, bed, 5, bench.size(100, 30))
            variants[ASPHERE] = lambda s=stock: run(bench, "asphere", s, ASPHERE).loops()[-1].nanoseconds()
        series = paired.measure(variants, bench.rounds)
        for name, values in series.items():
            for k, value in enumerate(values.values):
                bench.section.record(case=kind, code=name, round=k + 1, ns_per_body=value)
        share = narrow_share(bench, shape_beds.talus_script(bench, kind, bed, 0, steps))
        over = paired.ratio(series[TALUS], series["spheres"])
        faster = paired.ratio(series[ASPHERE], series[TALUS]) if ASPHERE in series else None
        rows.append([kind, pairs, series[TALUS].median, f"{100 * share:.0f} %", str(over), f"{limit:.0f}",
                     series[ASPHERE].median if faster else "-", str(faster) if faster else "-"])
        bench.section.headline(f"shapes: a step of settled {kind} takes {series[TALUS].median / 1000:.2f} us per body, {over} times that of a sphere"
                               + (f"; with pair granular/superellipsoid of LAMMPS {faster} times as long" if faster else "") + ".")
    bench.section.heading("Superellipsoids")
    bench.section.table(["bed", "pairs that touch per body", "ns per body and step", "narrow phase", "over a sphere", "goal: at most",
                         "pair granular/superellipsoid, ns", "over it"], rows)
    bench.section.text(f"""Half axes .75 .64 .5, and .6 .55 .5 with both exponents 4; linear springs with damping and friction. LAMMPS of 2026 (package ASPHERE)
starts from the same state with the same springs, its lowest bodies at rest in the place of the floor. Goal of that ratio: {ROUND_FLOOR:.0f}.""")


# ---- clumps -----------------------------------------------------------------------------------

CLUMPS = (      # what, a bed of clumps, code, mover, arguments
    ("spheres, nve/sphere/talus", False, TALUS, "nve/sphere", ["-sf", "talus"]),
    ("clumps, fix rigid/small of LAMMPS", True, STOCK, "rigid/small molecule", []),
    ("clumps, rigid/small/talus", True, TALUS, "rigid/small molecule", ["-sf", "talus"]),
    ("clumps, rigid/small/symplectic", True, TALUS, "rigid/small/symplectic molecule start half", ["-sf", "talus"]))
CLUMP_FLOOR, CLUMP_LIMIT = 4.0, 3.5


def timed_clumps(bench, granular, clumped, code, mover, arguments):
    """Time per body and step: of a sphere, or of a clump of three."""
    across, steps = bench.size(10, 4), bench.size(2000, 200)
    spheres = len(clump_beds.SPHERES) if clumped else 1
    script = clump_beds.script(clump_beds.settled(bench, clumped, across), clumped, mover, steps // (4 if code == STOCK else 1),
                               granular)
    return lambda: spheres * run(bench, "clumps", script, code, arguments=arguments).loops()[-1].nanoseconds()


def clumps(bench):
    if not bench.wants("clumps"):
        return
    rows, ratios = [], {}
    for pair, granular in (("gran/hertz/history", False), ("granular", True)):
        series = paired.measure({what: timed_clumps(bench, granular, *how) for what, *how in CLUMPS}, bench.rounds)
        sphere, stock = CLUMPS[0][0], CLUMPS[1][0]
        for what, clumped, *_ in CLUMPS:
            faster, spheres = paired.ratio(series[stock], series[what]), paired.ratio(series[what], series[sphere])
            rows.append([pair, what, series[what].median, str(spheres), str(faster) if clumped else "-"])
            ratios[pair, what] = faster
            for k, value in enumerate(series[what].values):
                bench.section.record(case="clumps", law=pair, code=what, round=k + 1, ns_per_body=value)
    bench.section.heading("Clumps of three spheres")
    bench.section.table(["pair_style", "bed", "ns per body and step", "over a sphere", "rigid/small of LAMMPS over it"], rows)
    bench.section.text(f"""Whole loops: contacts, motion, floor, rebuilds of neighbor lists. LAMMPS: fix rigid/small with its own styles gran/hertz/history or
granular, here hertz/material with mindlin, and walls of the same kind. Goals: at most {CLUMP_LIMIT} of a sphere, and {CLUMP_FLOOR:.0f} times faster than LAMMPS.""")
    suffix = CLUMPS[2][0]
    bench.section.headline(f"shapes: a step of a settled clump of three spheres takes {rows[2][2]:.0f} ns; with fix rigid/small of LAMMPS "
                           f"{ratios['gran/hertz/history', suffix]} times as long, and {ratios['granular', suffix]} times with pair granular.")


# ---- packings ---------------------------------------------------------------------------------

def volume_fraction(bed, volume):
    """Of the slab between a sixth and two thirds of the height: away from floor and surface."""
    (x, y, _), rows = bed
    top = sorted(row[4] for row in rows)[int(0.98 * len(rows))]
    low, high = top / 6, 2 * top / 3
    inside = sum(low <= row[4] < high for row in rows)
    return inside * volume / ((x[1] - x[0]) * (y[1] - y[0]) * (high - low))


def packings(bench):
    rows = []
    for kind, (loose, dense) in MEASURED.items():
        if not bench.wants("packing"):
            return
        for name, law, mark in (("frictionless", shape_beds.FRICTIONLESS, "-frictionless"), ("friction .5", shape_beds.LAW, "")):
            bed = shape_beds.settled(bench, kind, *bench.size(*SIZES), law, mark)
            mass = state(bench, kind, bed, law)[3]
            fraction = volume_fraction(bed, mass)       # density 1
            rows.append([kind, name, fraction, loose, dense])
            bench.section.record(case=f"packing, {kind}, {name}", fraction=fraction)
    bench.section.heading("Packing")
    bench.section.table(["poured", "", "volume fraction", "plastic dice, loosest", "densest"], rows)
    bench.section.text("""Bodies with random orientations fall on each other, in the middle of the bed. Measured loosest and densest packings: J. Baker, A. Kudrolli, Phys. Rev. E 82, 061304
(2010), dice with friction, fluidized or vibrated.""")


def measure(bench):
    if not machine.BODY_LMP:
        bench.section.text("Left out: pair body/rounded/polyhedron, for there is no LAMMPS with package BODY.")
    clumps(bench)
    superellipsoids(bench)
    convex(bench)
    packings(bench)
