# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""One trajectory: the same bits however a large scene is run."""

import hashlib
import random
import struct

import beds
import lammps
import machine
from lammps import STOCK, TALUS

TITLE = "One trajectory"
QUESTION = """Does a large scene, run long enough for collisions, migration and many rebuilds, end in the same bits on any
number of ranks and threads, with another skin, without sorting, with load balancing, and after a restart?"""

COLUMNS = "id x y z vx vy vz omegax omegay omegaz"

ARRAYS = "comm_proxy no\nrun_style verlet/stock\n"
OWN, DIRECT = "run_style verlet\n", "comm_proxy yes\nrun_style verlet/proxy overlap yes\n"

# name: ranks, threads, commands before the particles are read, skin in diameters, commands before the run
WAYS = {
    "1 rank": (1, 1, "", 0.1, ARRAYS),
    "2 ranks": (2, 1, "processors 2 1 1\n", 0.1, ARRAYS),
    "4 ranks, 1 x 2 x 2": (4, 1, "processors 1 2 2\n", 0.1, ARRAYS),
    "8 ranks, 2 x 2 x 2": (8, 1, "processors 2 2 2\n", 0.1, DIRECT),
    "2 threads": (1, 2, "", 0.1, ARRAYS),
    "3 threads": (1, 3, "", 0.1, OWN),
    "2 ranks x 2 threads": (2, 2, "processors 1 2 1\n", 0.1, ARRAYS),
    "run_style verlet of Talus": (1, 1, "", 0.1, OWN),
    "2 ranks, direct exchange, overlap": (2, 1, "processors 2 1 1\n", 0.1, DIRECT),
    "3 ranks x 2 threads, direct exchange, overlap": (3, 2, "processors 3 1 1\n", 0.1, DIRECT),
    "skin .02 d": (1, 1, "", 0.02, OWN),
    "skin .3 d, 2 ranks": (2, 1, "processors 2 1 1\n", 0.3, ARRAYS),
    "no sorting": (1, 1, "atom_modify sort 0 0\n", 0.1, OWN),
    "balance, 2 ranks": (2, 1, "balance", 0.1, DIRECT),
    "restart on 2 ranks": (1, 1, "restart", 0.1, DIRECT),
}


def stirred(bench, count):
    """The bed pulled apart upwards, with random velocities and rotation: it falls together again."""
    box, rows, _ = beds.read_data(beds.bed(bench, count)[0])
    draw = random.Random(3)
    speeds = [(r[0], *(draw.gauss(0, 0.3) for _ in "xyz"), *(draw.gauss(0, 50.0) for _ in "xyz")) for r in rows]
    rows = [(*r[:6], 1.5 * r[6]) for r in rows]
    high = max(r[6] for r in rows) + 0.2    # m: the fastest of all, going up, does not get that far
    lammps.write_data(bench.path("stirred.data"), (*box[:2], (box[2][0], high)), [(r[0], 1, *r[2:]) for r in rows], speeds)


def head(before):
    return f"units si\natom_style sphere\natom_modify map array\n{before}newton off\ncomm_modify vel yes\nboundary f f f\n"


def tail(skin, physics):
    return (f"neighbor {skin * beds.D} bin\nneigh_modify every 1 delay 0 check yes\n{physics}timestep {beds.DT}\n"
            "thermo 1000000\nthermo_modify norm no lost error\n")


def dump(name):
    return f"write_dump all custom {name} {COLUMNS} modify format float %a sort id\n"


def digest(path):
    """Hash of the numbers, with -0 taken as 0, and the lines of the file (sorted by particle)."""
    with open(path) as file:
        lines = file.read().split("ITEM: ATOMS")[1].split("\n")[1:-1]
    total = hashlib.sha256()
    for line in lines:
        total.update(struct.pack(f"<{len(COLUMNS.split())}d", *(float.fromhex(w) + 0.0 if "x" in w else float(w) + 0.0
                                                                for w in line.split())))
    return total.hexdigest()[:16]


def run(bench, name, code, physics, steps):
    ranks, threads, before, skin, last = WAYS[name]
    if code == STOCK:
        last = ""      # commands of Talus
    options = dict(ranks=ranks, threads=threads, cores=machine.cores())
    after = ""
    if before == "balance":
        before, after = "", "fix even all balance 500 1.0 shift xy 5 1.02\n"
    if before == "restart":
        half = steps // 2
        lammps.run(bench.workdir, "bits", head("") + "read_data stirred.data\n" + tail(skin, physics)
                   + OWN + f"run {half}\nwrite_restart middle\n", code, **options)
        lammps.run(bench.workdir, "bits", head("") + "read_restart middle\n" + tail(skin, physics)
                   + last + f"run {steps - half}\n" + dump("end"), code, **dict(options, ranks=2))
    else:
        result = lammps.run(bench.workdir, "bits", head(before) + "read_data stirred.data\n" + tail(skin, physics) + after
                            + last + f"run {steps}\n" + dump("end"), code, **options)
        bench.builds = result.log.count("\n") and result.log.split("Neighbor list builds = ")[-1].split()[0]
    return digest(bench.path("end"))


def measure(bench):
    section = bench.section
    count, steps = bench.size(50000, 12500), bench.size(20000, 1000)
    stirred(bench, count)
    physics = {"Talus": (TALUS, beds.talus(), WAYS), "stock": (STOCK, beds.stock(), ["1 rank", "2 ranks"])}
    rows, different = [], []
    for code_name, (code, text, names) in physics.items():
        first = None
        for name in names:
            if not bench.wants(name):
                continue
            bench.note(f"{code_name}: {name}")
            found = run(bench, name, code, text, steps)
            first = first or found
            rows.append([code_name, name, found, "yes" if found == first else "no"])
            section.record(code=code_name, way=name, hash=found, same=found == first)
            if found != first and code == TALUS:
                different.append(name)
    section.table(["code", "", "hash of positions, velocities, angular velocities", "same as the first"], rows)
    section.text(f"""{count} spheres of a bed between floor and walls, pulled apart upwards by a factor of 1.5, with random velocities and rotation, {steps} steps, about {bench.builds}
rebuilds. The hash is that of all numbers, -0 taken as 0. The stock styles are there to show that the scene tells orders of
summation apart.""")
    if different:
        section.headline("bits: not the same trajectory: " + "; ".join(different) + ".")
    if [row[3] for row in rows if row[0] == "stock"] == ["yes", "yes"]:
        section.headline("bits: the scene is too short to tell orders of summation apart.")
