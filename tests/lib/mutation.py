# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Commands, files and sessions that a user would not write, drawn at random but the same for the same seed.

What must hold of every run: it ends, without a signal; an error is one message; what succeeds has only finite
numbers in its output."""

import concurrent.futures
import glob
import math
import os
import re
import struct
import tempfile

from talus_testing import run_lammps, thermo

LIMIT = 60.0    # seconds for one run of some steps

# two types, eight layers of particles that touch, falling onto what a command adds
SCENE = """units si
{suffix}atom_style sphere
boundary f f f
comm_modify vel yes
region box block -4 4 -4 4 -1 7
create_box 2 box
lattice sc 1.0
region grains block -1.4 1.4 -1.4 1.4 0.6 3.4
create_atoms 1 region grains
set group all type/fraction 2 0.4 4711
set group all diameter 1.02
set group all density 1000
group grains type 1 2
neighbor 0.3 bin
timestep 1e-4
{pair}
fix move all nve/sphere{integrator}
{command}
thermo 5
{end}
"""
PAIR = "pair_style gran/penalty\npair_coeff * * hertz 4.0e6 5.0e3 tangential multistep NULL NULL 0.5"
MATERIAL = "pair_style gran/penalty\npair_coeff * * hertz/material 1.0e7 0.5 0.3 tangential multistep NULL NULL 0.5"

NUMBERS = ["0", "-1", "1", "3", "1e-320", "1e-12", "0.3", "1e3", "1e12", "1e160", "-1e160", "1e308", "nan", "inf"]
NASTY = ["NULL", "*", "3*1", "*0", "99999999999999999999",
         "v_none", "c_none", "f_none", "all", "none", "no", "yes", "x" * 300, "1.5.2", "0x10", "--", "\u00e4"]

CRASHES = "SIG|Segmentation|Aborted|stack smashing|free\\(\\)|corrupted|terminate called|AddressSanitizer|runtime error"


# ---- commands ----------------------------------------------------------------------------------

def examples(folder):
    """Every line of the code blocks below `## Examples` in the pages of a folder, continued lines joined."""
    found = []
    for page in sorted(glob.glob(os.path.join(folder, "*.md"))):
        with open(page) as file:
            text = file.read()
        section = re.search(r"(?ms)^## Examples\n(.*?)(?=^## |\Z)", text)
        for block in re.findall(r"(?s)```\w*\n(.*?)```", section.group(1) if section else ""):
            lines = re.sub(r"&\s*\n\s*", " ", block).splitlines()
            found += [line.split("#")[0].strip() for line in lines]
    # compute reduce: its parser in some LAMMPS ends with a signal where words are missing
    return [line for line in found if line and line.split()[0] in PLACES and " reduce " not in line]


def scene(pair=PAIR, command="", end="run 10", integrator="", suffix=""):
    return SCENE.format(pair=pair, command=command, end=end, integrator=integrator, suffix=suffix)


def _with_pair_coeff(line):
    return scene((MATERIAL if "/material" in line else PAIR) + "\n" + line)


def _with_fix(line):
    words = line.split()
    if len(words) > 3 and words[3].startswith("nve/sphere"):
        return scene(command="unfix move\n" + line)
    return scene(MATERIAL if "/material" in line else PAIR, line)


def _with_compute(line):
    """What it computes is asked for, too."""
    words = line.split()
    if len(words) < 4:
        return scene(command=line)
    name, style = words[1], words[3]
    kinds = {"atom": f"dump see all custom 5 dump.see id c_{name}", "local": f"dump see all local 5 dump.see c_{name}[*]",
             "grid": f"dump see all grid 5 dump.see c_{name}:grid:data[*]"}
    of_all = f"thermo_style custom step c_{name}[1]"
    return scene(command=line + "\n" + kinds.get(style.split("/")[-1], of_all))


BIN = "region bin cylinder z 2.5 2.5 0.5 4 6 units box\n"


# first word of an example: the script that has it
PLACES = {
    "pair_style": lambda line: scene(line + "\n" + PAIR.splitlines()[1]),
    "pair_coeff": _with_pair_coeff,
    "fix": _with_fix,
    "compute": _with_compute,
    "comm_proxy": lambda line: scene(command=line),
    "run_style": lambda line: scene(command=line),
    "fill_region": lambda line: scene(command=BIN + line.replace(" 0.00", " 0.1")),    # diameters
    "dump": lambda line: scene(command="shell mkdir post\n" + line),
}


NAMED = {"fix": 4, "compute": 4, "pair_coeff": 3, "dump": 4}    # words that say what kind of command it is


def mutated(random, line, words_of_all):
    """The line with one to three changes of its words: of any of them now and then, mostly of those that follow what
    says which command it is, and mostly of numbers."""
    words = line.split()
    for _ in range(random.choice((1, 1, 2, 3))):
        first = 1 if random.random() < 0.1 else min(NAMED.get(words[0], 1), len(words))
        places = range(first, len(words))
        numbers = [n for n in places if re.fullmatch(r"[-+]?[.\d]+(e[-+]?\d+)?", words[n])]
        if numbers and random.random() < 0.6:
            words[random.choice(numbers)] = random.choice(NUMBERS)
        elif not places:
            words.append(random.choice(words_of_all))
        else:
            k, what = random.choice(places), random.randrange(6)
            if what == 0:
                del words[k]
            elif what == 1:
                words.insert(k, words[k])
            elif what == 2:
                other = random.choice(places)
                words[k], words[other] = words[other], words[k]
            elif what == 3:
                del words[k:]
            elif what == 4:
                words.insert(k, random.choice(words_of_all))
            else:
                words[k] = random.choice(NASTY + words_of_all)
    return " ".join(words)


def commands(random, folder, count):
    """A line, the script it is in and files that it may read: each example as it is, and mutated, in turn."""
    files = {name: text_stl(tetrahedron()) for name in ("drum.stl", "stone.stl")}
    lines = examples(folder)
    words = sorted({word for line in lines for word in line.split()[1:]})
    for n in range(count):
        line = lines[n % len(lines)]
        if n >= len(lines):
            line = mutated(random, line, words)
        yield line, PLACES[line.split()[0]](line), files


# ---- STL files ---------------------------------------------------------------------------------

def tetrahedron(size=2.0):
    """Corners of four triangles, normals outwards, on the floor."""
    a, b, c, d = (-size, -size, 0.0), (size, -size, 0.0), (0.0, size, 0.0), (0.0, 0.0, 0.5)
    return [(a, c, b), (a, b, d), (b, c, d), (c, a, d)]


def binary_stl(triangles):
    rows = b"".join(struct.pack("<12fH", 0, 0, 0, *(x for corner in triangle for x in corner), 0)
                    for triangle in triangles)
    return b"made by a test".ljust(80) + struct.pack("<I", len(triangles)) + rows


def text_stl(triangles):
    facets = "".join("facet normal 0 0 0\nouter loop\n"
                     + "".join("vertex {} {} {}\n".format(*corner) for corner in triangle)
                     + "endloop\nendfacet\n" for triangle in triangles)
    return f"solid made by a test\n{facets}endsolid\n".encode()


def _damaged(random, data):
    data = bytearray(data)
    what = random.randrange(7)
    if what == 0:
        return bytes(data[:random.randrange(len(data))])
    if what == 1:
        return bytes(data) + bytes(random.randrange(256) for _ in range(random.randrange(1, 90)))
    if what == 2:
        data[80:84] = struct.pack("<I", random.choice((0, 1, 3, 5, 2**31, 2**32 - 1)))
    elif what == 3:
        at = random.randrange(84, max(85, len(data) - 4))
        value = random.choice((math.nan, math.inf, 1e38, -1e38, 1e-45, 0.0))
        data[at:at + 4] = struct.pack("<f", value)
    elif what == 4:
        lines = data.split(b"\n")
        lines.insert(random.randrange(len(lines)), random.choice((b"vertex 1 nan 2", b"facet", b"loop", b"\xff\xfe")))
        return b"\n".join(lines)
    elif what == 5:
        words = bytes(data).split(b" ")
        words[random.randrange(len(words))] = random.choice((b"1e999", b"", b"nan", b"-", b"endsolid"))
        return b" ".join(words)
    else:
        for _ in range(random.randrange(1, 9)):
            data[random.randrange(len(data))] = random.randrange(256)
    return bytes(data)


def stl_files(random, count, first=0):
    """The beginning of a file, the script that reads it, and the file."""
    line = "fix stone all large/body mesh mesh.stl contact hertz 4.0e6 5.0e3"
    for n in range(first, first + count):
        triangles = tetrahedron()
        if n % 3 == 0:    # valid as a file, odd as a mesh
            corners = [corner for triangle in triangles for corner in triangle]
            triangles = [tuple(random.choice(corners) for _ in range(3)) for _ in range(random.randrange(1, 9))]
            data = random.choice((binary_stl, text_stl))(triangles)
        else:
            data = _damaged(random, random.choice((binary_stl, text_stl))(triangles))
        yield repr(data[:60]), scene(command=line), {"mesh.stl": data}


# ---- sessions ----------------------------------------------------------------------------------

OPERATIONS = [
    "run 5", "run 7", "run 3 pre no", "run 3 post no", "run 0", "run 6 every 2 NULL",
    "write_restart session.restart", "clear\n{again}", "clear\nread_restart session.restart\n{styles}",
    "unfix move\nfix move all nve/sphere", "unfix move\nfix move all nve/sphere/symplectic",
    "pair_style none\n{pair}", "{pair}", "suffix talus", "suffix off",
    "pair_style gran/hooke/history 2.0e5 NULL 50.0 NULL 0.5 1\npair_coeff * *",
    "fix floor all large/body plane 0 0 0 0 0 1 contact hertz 4.0e6 5.0e3", "unfix floor",
    "fix wall all wall/gran hertz/history 4.0e6 NULL 5.0e3 NULL 0.5 1 zplane 0.0 NULL", "unfix wall",
    "compute account all penalty/stats\nthermo_style custom step atoms ke c_account[1] c_account[4]",
    "thermo_style one\nuncompute account", "compute critical all timestep/gran", "uncompute critical",
    "delete_atoms random fraction 0.3 yes all NULL 12345", "delete_atoms group all",
    "create_atoms 2 random 5 7823 NULL overlap 1.0 maxtry 50", "reset_atoms id", "reset_timestep 0",
    "set group all diameter 0.9", "set group grains type 2", "velocity all set 0 0 -3", "timestep 5e-5",
    "displace_atoms all move 0.01 0 0.02", "change_box all x final -5 5 remap", "change_box all boundary p p f",
    "neigh_modify exclude type 1 2", "neigh_modify exclude none", "neighbor 0.1 bin", "neigh_modify every 3 delay 0",
    "run_style verlet", "run_style verlet/stock", "run_style verlet/proxy overlap yes", "comm_proxy yes", "comm_proxy no",
    "comm_modify mode single cutoff 2.5", "group grains delete", "fix balance all balance 3 1.01 shift xyz 3 1.1",
    "unfix balance", "dump see all custom 2 dump.see id x y z fx fy fz\nrun 0", "undump see", "plugin list",
    "rerun dump.see first 0 every 2 dump x y z", "minimize 1e-4 1e-4 5 5", "info styles pair",
    "write_data session.data", "write_dump all custom dump.once id radius", "fix grav all gravity 9.81 vector 0 0 -1",
    "unfix grav", "fix hold all freeze", "unfix hold", "region grains delete", "shell true", "jump SELF end",
]


def sessions(random, count, length):
    """Scripts of some operations each."""
    for _ in range(count):
        chosen = [random.choice(OPERATIONS) for _ in range(length)]
        again = scene(end="")
        styles = f"{PAIR}\nfix move all nve/sphere\ntimestep 1e-4\nthermo 5"
        text = "\n".join(chosen).replace("{again}", again).replace("{styles}", styles).replace("{pair}", PAIR)
        yield chosen, scene(end="run 4\n" + text + "\nrun 4\nlabel end", suffix=random.choice(("", "suffix talus\n"))), {}


# ---- what must hold ----------------------------------------------------------------------------

def verdict(script, ranks, files):
    """Empty if the run is as it must be, else what is wrong with it."""
    with tempfile.TemporaryDirectory(prefix="talus-mutation-") as folder:
        for name, data in files.items():
            with open(os.path.join(folder, name), "wb") as file:
                file.write(data)
        try:
            return fault_of_numbers(run_lammps(script, np=ranks, cwd=folder, timeout=LIMIT).log)
        except AssertionError as problem:
            text = str(problem)
            if text.startswith("no end after"):
                return text.splitlines()[0]
            return _fault_of_error(text)


def _fault_of_error(text):
    code = re.match(r"return code (-?\d+)", text)
    if not code or code.group(1) != "1":
        return text.splitlines()[0] + ": " + text[-600:]
    if re.search(CRASHES, text):
        return "crash: " + text[-600:]
    messages = set(re.findall(r"(?m)^ERROR[^:\n]*:? ?(.*)$", text))
    return "" if any(len(message) > 10 for message in messages) else "no message: " + text[-600:]


def fault_of_numbers(log):
    if re.search(r"(?m)^\s*\d+ .*\b-?(nan|inf)\b", log) or any(
            not math.isfinite(value) for row in thermo(log) for value in row.values()):
        return "numbers that are none, without an error: " + log[-900:]
    return ""


def judge(cases, ranks_of, workers=2):
    """Runs each (what, script, files); [(what, fault)] of those with a fault."""
    cases = list(cases)
    with concurrent.futures.ThreadPoolExecutor(workers) as pool:
        faults = pool.map(lambda n: verdict(cases[n][1], ranks_of(n), cases[n][2]), range(len(cases)))
    return [(case[0], fault) for case, fault in zip(cases, faults) if fault]
