# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Large bodies: what meshes cost in time and memory, and how exact bodies are."""

import math
import os
import re
import sys

import beds
import curved_walls
import lammps
import machine
import paired
import plot
import problems
import turned_mesh
import vessels
from lammps import LIGGGHTS, TALUS

sys.path.append(os.path.join(machine.ROOT, "tests", "lib"))
import body_balance

TITLE = "Large bodies"
QUESTION = """What does it cost if a vessel is a mesh instead of planes, or has many triangles far from all particles? How much
memory does a mesh take on each rank? How long do other mesh walls take? What do walls that are curved inside cost shapes? And how well do
bodies keep momentum and energy?"""

REBUILD = 100    # steps between rebuilds of the neighbor lists, in all codes
LAW = f"contact {beds.HISTORY}"


def steps_for(bench, count):
    return max(100, int(bench.size(2.5e7, 2.5e6) / count / 100) * 100)


def bed_in(bench, count, physics, steps, law=beds.HISTORY):
    """A bed between the given walls. Returns a script."""
    data, _ = beds.bed(bench, count)
    alone = [line for line in beds.talus(law).splitlines() if "large/body" not in line]
    return beds.script(data, "\n".join(alone) + "\n" + physics, 100, steps, REBUILD)


def planes(law=beds.HISTORY):
    return "".join(line + "\n" for line in beds.talus(law).splitlines() if "large/body" in line)


def mesh(file, law=beds.HISTORY):
    return f"fix vessel all large/body mesh {file} contact {law}\n"


def run(bench, name, script, code=TALUS, **options):
    if options.get("ranks", 1) == 1:
        options.setdefault("cores", paired.one_core())
    return lammps.run(bench.workdir, name, script, code, **options)


def output(log, columns):
    """Lines of thermo output with so many columns."""
    found = []
    for line in log.splitlines():
        words = line.split()
        if len(words) == columns and words[0].isdigit():
            try:
                found.append(list(map(float, words)))
            except ValueError:
                pass    # words of a message
    return found


# ---- time -------------------------------------------------------------------------------------

def cost(bench):
    count, triangles = bench.size(50000, 12500), bench.size(100000, 10000)
    _, box = beds.bed(bench, count)
    made = vessels.write(bench.path("vessel.stl"), vessels.bed(box, triangles))
    steps = steps_for(bench, count)
    scripts = {"planes": bed_in(bench, count, planes(), steps), "mesh": bed_in(bench, count, mesh("vessel.stl"), steps)}
    found = paired.measure({name: lambda n=name: run(bench, n, scripts[n]).loops()[-1].nanoseconds() for name in scripts},
                           2 * bench.rounds)
    ratio = paired.ratio(found["mesh"], found["planes"])
    for k, (a, b) in enumerate(zip(found["planes"].values, found["mesh"].values)):
        bench.section.record(part="cost", round=k + 1, planes_ns=a, mesh_ns=b)
    bench.section.heading("A mesh instead of planes")
    bench.section.table(["floor and four walls", "triangles", "ns per particle and step", "over planes, median (range)"],
                        [["planes", "", found["planes"].median, ""], ["mesh", made, found["mesh"].median, str(ratio)]])
    bench.section.text(f"{count} spheres in a settled bed, Hertz, friction with history. 1.25 was aimed at.")
    if ratio.median > 1.25:
        bench.section.headline(f"bodies: a mesh takes {ratio.median:.2f} times the time of planes, more than 1.25.")


def far(bench):
    """Triangles that no particle is near to."""
    count = 12500
    _, box = beds.bed(bench, count)
    numbers = bench.size((0, 1000, 10000, 100000, 1000000), (0, 1000, 100000))
    near = vessels.bed(box, 1000)
    for n in numbers:
        vessels.write(bench.path(f"far{n}.stl"), near + vessels.plate(box, n), binary=True)
    steps = steps_for(bench, count) // 2
    found = paired.measure({n: lambda k=n: run(bench, f"far{k}", bed_in(bench, count, mesh(f"far{k}.stl"), steps))
                            .loops()[-1].nanoseconds() for n in numbers}, bench.size(3, 1))
    rows = []
    for n in numbers:
        ratio = paired.ratio(found[n], found[0])
        rows.append([n, found[n].median, str(ratio)])
        bench.section.record(part="far", triangles=n, ns=found[n].median, ratio=ratio.median)
        if ratio.median > 1.1:
            bench.section.headline(f"bodies: {n} triangles far from all particles make steps {ratio.median:.2f} times as long.")
    bench.section.heading("Triangles far from all particles")
    bench.section.table(["triangles far away", "ns per particle and step", "over none, median (range)"], rows)
    bench.section.text(f"{count} spheres in a vessel of {len(near)} triangles, and a plate of more triangles above it.")


def against_liggghts(bench):
    count, triangles = 12500, bench.size(25000, 2500)
    data, box = beds.bed(bench, count)
    made = vessels.write(bench.path("same.stl"), vessels.bed(box, triangles))
    steps = steps_for(bench, count) // 4
    walls = ("fix cad all mesh/surface file same.stl type 1\n"
             "fix walls all wall/gran model hertz tangential history mesh n_meshes 1 meshes cad\n")
    theirs = [line for line in beds.liggghts_script(data, box, 100, steps, REBUILD).splitlines() if "primitive" not in line]
    at = next(k for k, line in enumerate(theirs) if line.startswith("timestep"))
    theirs = "\n".join(theirs[:at]) + "\n" + walls + "\n".join(theirs[at:]) + "\n"
    ours = bed_in(bench, count, mesh("same.stl", beds.MATERIAL), steps, beds.MATERIAL)
    found = paired.measure({
        LIGGGHTS: lambda: run(bench, "theirs", theirs, LIGGGHTS).loops()[-1].nanoseconds(),
        TALUS: lambda: run(bench, "ours", ours).loops()[-1].nanoseconds()}, bench.rounds)
    ratio = paired.ratio(found[LIGGGHTS], found[TALUS])
    bench.section.heading("Mesh walls of LIGGGHTS")
    bench.section.table(["", "ns per particle and step"], [[code, found[code].median] for code in found])
    bench.section.text(f"{count} spheres in a vessel of {made} triangles, Hertz with history from the same material: LIGGGHTS takes "
                       f"{ratio} times as long (median, range); 4 was aimed at.")
    bench.section.record(part="liggghts", triangles=made, liggghts_ns=found[LIGGGHTS].median, ours_ns=found[TALUS].median,
                         ratio=ratio.median)
    if ratio.median < 4:
        bench.section.headline(f"bodies: LIGGGHTS' mesh walls take {ratio.median:.1f} times as long, less than the 4 aimed at.")


def turning_drum(bench):
    """The drum of scripts/validate drum, in which grains have just come to rest, as a mesh."""
    size = bench.size(1.0, 0.25)
    folder, settled = problems.run(bench, "drum", "drum", {"scale": size, "spin": 0.0, "watch": 1e-3, "states": 1}, paired.one_core())
    bench.section.heading("A drum that is a mesh")
    rows, grains = [], settled.loops()[-1].atoms
    for ranks in (1, 2):
        found = turned_mesh.compare(folder, os.path.join(folder, "settled.txt"), 0.042, 0.01 * size, 45, bench.rounds, ranks)
        ratio = paired.ratio(found[LIGGGHTS], found[TALUS])
        rows.append([ranks, found[LIGGGHTS].median, found[TALUS].median, ratio])
        bench.section.record(part="drum", triangles=4 * turned_mesh.SEGMENTS, ranks=ranks, liggghts_ns=found[LIGGGHTS].median,
                             ours_ns=found[TALUS].median, ratio=ratio.median)
    bench.section.table(["ranks", "LIGGGHTS, ns per particle and step", "Talus, ns per particle and step", "ratio, median (range)"], rows)
    bench.section.text(f"""The drum of [the measured flow](../doc/validation/drum.md), {grains} grains and a mesh of {4 * turned_mesh.SEGMENTS}
triangles, hertz/material with history, `rolling cdt` in both codes, 45 turns per minute: {turned_mesh.STEPS} steps after
{turned_mesh.WARM}, lists rebuilt when particles have moved.""")


def curved(bench):
    rows = curved_walls.compare(bench, run)
    of_mesh = rows[1][-1]
    bench.section.heading("Tablets at a wall that is curved inside")
    bench.section.table(["vessel", "tablets", "pairs that touch", "contacts with the vessel", "ns per tablet and step", "over the mesh"],
                        [[*row[:-1], row[-1].median, str(paired.ratio(row[-1], of_mesh))] for row in rows])
    for row in rows:
        for k, value in enumerate(row[-1].values):
            bench.section.record(part="curved", vessel=row[0], round=k + 1, ns=value)
    bench.section.text("Superellipsoids with half axes of 4, 4 and 2 mm, exponents 4 and 2, at rest in a vessel with a radius of 50 mm; the "
                       "mesh lies around the cylinder. The same time was aimed at.")


# ---- memory -----------------------------------------------------------------------------------

def memory(bench):
    count, triangles = 12500, bench.size(100000, 10000)
    _, box = beds.bed(bench, count)
    made = vessels.write(bench.path("memory.stl"), vessels.bed(box, triangles), binary=True)
    few = vessels.write(bench.path("few.stl"), vessels.bed(box, 1), binary=True)
    rows = []
    for ranks in (1, 2, 4):
        held = {}
        for name in "few", "memory":
            log = run(bench, f"memory-{name}", bed_in(bench, count, mesh(f"{name}.stl"), 100), ranks=ranks).log
            held[name] = [float(x) * 2**20 for x in re.findall(r"^Per MPI rank memory.*= (\S+) \| (\S+) \| (\S+)", log,
                                                                 re.MULTILINE)[-1]]
        each = [(m - f) / (made - few) for m, f in zip(held["memory"], held["few"])]
        rows.append([ranks, *each])
        bench.section.record(part="memory", ranks=ranks, bytes_least=each[0], bytes_mean=each[1], bytes_most=each[2])
    bench.section.heading("Memory of a mesh")
    bench.section.table(["ranks", "bytes per triangle, least", "mean", "most"], rows)
    bench.section.text(f"What each rank holds of a vessel of {made} triangles with {count} spheres, over the number of "
                       f"triangles of the whole; against a vessel of {few}. All hold vertices and which belong to which triangle; the rest is there for triangles near the "
                       "particles of a rank.")


# ---- exactness --------------------------------------------------------------------------------

VESSEL = """units lj
boundary f f f
atom_style sphere
atom_modify map yes
newton off
comm_modify vel yes
read_data grains
neighbor 0.15 bin
neigh_modify every 1 delay 0 check yes
pair_style gran/penalty
pair_coeff * * hertz 4e4 200
timestep 0.001
fix step all nve/sphere/symplectic gravity 5.0 vector 0 0 -1
variable on equal step<{shaken}
variable t equal step*0.001
variable dx equal v_on*0.15*sin(9.0*v_t)*sin(2.0*v_t)
variable vx equal v_on*0.15*(9.0*cos(9.0*v_t)*sin(2.0*v_t)+2.0*sin(9.0*v_t)*cos(2.0*v_t))
variable dz equal v_on*0.2*sin(11.0*v_t)^2
variable vz equal v_on*0.2*22.0*sin(11.0*v_t)*cos(11.0*v_t)
fix vessel all large/body mesh closed.stl contact hertz 4e4 200 tangential multistep NULL NULL 0.4 &
    move variable v_dx NULL v_dz v_vx NULL v_vz
{balance}thermo 10
thermo_style custom step {columns}
thermo_modify lost error norm no
run {shaken}
fix drag all viscous 2.0
thermo 100000
thermo_style custom step
run 20000
unfix drag
fix mean all ave/time 1 500 500 f_vessel[3]
run 500
compute mass all property/atom mass
compute weight all reduce sum c_mass
run 0
thermo_style custom step atoms c_weight
run 0
print "RESULT $(atoms) $(-f_mean/5.0/c_weight:%.12g)"
"""


def vessel(bench):
    n, shaken = bench.size(14, 7), bench.size(20000, 2000)
    size = [1.08 * n + 0.3, 1.08 * n + 0.3, 1.5 * (1.08 * n + 0.3)]
    rows = [(1 + i + n * (j + n * k), 1, 0.8 + 0.25 * beds.scattered(i + n * (j + n * k)), 1.0,
             *(1.08 * q + 0.7 for q in (i, j, k))) for k in range(n) for j in range(n) for i in range(n)]
    lammps.write_data(bench.path("grains"), [(-3.0, s + 3.0) for s in size], rows)
    made = vessels.write(bench.path("closed.stl"), vessels.closed(size, 29))
    result = run(bench, "vessel", VESSEL.format(shaken=shaken, balance=body_balance.script(["vessel"]),
                                                columns=body_balance.COLUMNS))
    worst = max(abs(value) / row[1] for row in output(result.log, 8) if row[0] > 500 for value in row[2:])
    left, force = result.printed("RESULT")[0]
    bench.section.heading("A closed vessel")
    bench.section.table(["", ""], [["particles", len(rows)], ["triangles", made], ["steps, shaken", shaken],
                                   ["particles lost", len(rows) - int(left)],
                                   ["force over weight at rest, minus 1", abs(force - 1.0)],
                                   ["third law: largest sum of forces or torques, over the sizes of all forces", worst]])
    bench.section.text("tests/physics/test_body_vessel_long.py does this with 20 384 particles for 100 000 steps.")
    bench.section.record(part="vessel", particles=len(rows), lost=len(rows) - int(left), force=force, third_law=worst)


ONE_PARTICLE = """units lj
boundary f f f
atom_style sphere
atom_modify map array
newton off
comm_modify vel yes
region box block -5 5 -5 5 -5 5
create_box 1 box
"""
SPINNING = ONE_PARTICLE + """create_atoms 1 single 4 4 4
set type 1 diameter 0.5 density 1.0
pair_style gran/penalty
pair_coeff * * hooke 1 0
timestep {dt}
fix body all large/body sphere 0 0 0 0.5 outside contact hooke 1 0 move free mass 1 inertia 1 2 3 spin 0.3 1 0.2
thermo {every}
thermo_style custom step f_body[10] f_body[11] f_body[12] f_body[13] f_body[17] f_body[18] f_body[19]
thermo_modify format float %.17g
run {steps}
"""
INERTIA = (1.0, 2.0, 3.0)


def rotated_back(q, v):
    """v in the axes of a body of orientation q = (w, x, y, z)."""
    w, x, y, z = q
    rows = ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))
    return [sum(rows[k][i] * v[k] for k in range(3)) for i in range(3)], rows


def energy_and_momentum(words):
    spin, rows = rotated_back(words[1:5], words[5:8])
    momentum = [sum(rows[i][k] * INERTIA[k] * spin[k] for k in range(3)) for i in range(3)]
    return 0.5 * sum(m * w * w for m, w in zip(INERTIA, spin)), momentum


def free_rotation(bench):
    rows = []
    for dt in (0.1, 0.05, 0.02, 0.01, 0.005):
        steps = round(200.0 / dt)
        log = run(bench, "spin", SPINNING.format(dt=dt, every=max(1, steps // 1000), steps=steps)).log
        states = [energy_and_momentum(row) for row in output(log, 8)]
        energy, momentum = states[0]
        size = math.dist(momentum, (0, 0, 0))
        rows.append([dt, max(abs(e / energy - 1) for e, _ in states), abs(states[-1][0] / energy - 1),
                     max(math.dist(m, momentum) / size for _, m in states)])
        bench.section.record(part="rotation", dt=dt, energy_swing=rows[-1][1], energy_end=rows[-1][2], momentum=rows[-1][3])
    bench.section.heading("Free rotation")
    bench.section.table(["dt", "energy: largest error", "at the end", "angular momentum: largest error"], rows)
    bench.section.text("A free body with moments of inertia 1, 2 and 3 turns at (.3, 1, .2), near its middle axis, for a time of 200.")
    bench.section.plot("rotation", "Free rotation of an asymmetric body: errors against the time step",
                       lambda plt: draw_errors(plt, rows, ("energy", None, "angular momentum"), "time step"))


COUPLED = ONE_PARTICLE + """create_atoms 1 single 0 0 1
set type 1 diameter 1.0 density 1.0
neighbor 0.3 bin
pair_style gran/penalty
pair_coeff * * hooke 1000 0
timestep 0.0005
fix step all nve/sphere/symplectic start half gravity 1.0 vector 0 0 -1
fix plate all large/body plane 0 0 0 0 0 1 contact hooke 1000 0 move external
variable n equal {every}
variable h equal {every}*0.0005
variable m equal mass[1]
variable z string 0.0
variable v string 0.0
run 0
variable energy equal f_plate+0.5*v_m*vz[1]^2+v_m*z[1]+0.5*5*v_v^2+0.5*40*v_z^2
variable turns loop {exchanges}
label again
variable w equal v_v+v_h*(f_plate[3]-40*v_z)/5
variable v string $(v_w:%.17g)
variable y equal v_z+v_h*v_v
variable z string $(v_y:%.17g)
fix_modify plate state 0 0 $(v_z:%.17g) 1 0 0 0 0 0 $(v_v:%.17g) 0 0 0 after {every}
run {every} pre no post no
print "ENERGY $(v_energy:%.12g) $(f_plate[20])"
next turns
jump SELF again
"""


def coupling(bench):
    rows = []
    for every in (1, 2, 4, 8, 16, 32):
        exchanges = bench.size(16000, 6400) // every
        found = run(bench, "coupled", COUPLED.format(every=every, exchanges=exchanges)).printed("ENERGY")
        apart = [energy for energy, contacts in found if contacts == 0]
        start = apart[0]
        rows.append([every, max(abs(energy / start - 1) for energy in apart),
                     sum(1 for _, contacts in found if contacts) * every])
        bench.section.record(part="coupling", every=every, error=rows[-1][1])
    bench.section.heading("Explicit coupling")
    bench.section.table(["steps between exchanges", "largest error of energy", "steps in contact"], rows)
    bench.section.text("""A ball bounces without loss on a plate (`move external`) of mass 5 on a spring of stiffness 40 whose motion a
program computes from the force at each exchange; energy of ball, contact, plate and spring when they are apart, over that at
first.""")
    bench.section.plot("coupling", "Explicit coupling: error of energy against the time between exchanges",
                       lambda plt: draw_errors(plt, rows, ("energy",), "time steps between exchanges"))


def draw_errors(plt, rows, names, what):
    _, axes = plt.subplots(figsize=(5, 3))
    for k, name in enumerate(names):
        if name:
            axes.loglog([row[0] for row in rows], [max(row[1 + k], 1e-17) for row in rows], label=name, **plot.style(k))
    axes.set_xlabel(what)
    axes.set_ylabel("relative error")
    axes.legend()


PARTS = {"cost": cost, "far": far, "liggghts": against_liggghts, "drum": turning_drum, "curved": curved, "memory": memory, "vessel": vessel,
         "rotation": free_rotation, "coupling": coupling}


def measure(bench):
    for name, part in PARTS.items():
        if bench.wants(name) and (name not in ("liggghts", "drum") or machine.LIGGGHTS):
            bench.note(name)
            part(bench)
