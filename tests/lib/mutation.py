# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Commands and files that a user would not write, drawn at random but the same for the same seed.

What must hold of every run: it ends, without a signal; an error is one message; what succeeds has only finite
numbers in its output."""

import glob
import math
import os
import re
import struct

from talus_testing import thermo

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

CRASHES = "SIG|Segmentation|Aborted|stack smashing|free\\(\\)|corrupted(?! LAMMPS restart file)|terminate called|AddressSanitizer|runtime error"


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


# ---- what must hold ----------------------------------------------------------------------------

def fault_of_numbers(log):
    if re.search(r"(?m)^\s*\d+ .*\b-?(nan|inf)\b", log) or any(
            not math.isfinite(value) for row in thermo(log) for value in row.values()):
        return "numbers that are none, without an error: " + log[-900:]
    return ""
