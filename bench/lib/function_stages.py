# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""To which stage of a step a function belongs. For functions of Talus the file says it in which they, or their classes,
are defined, so that names of functions appear nowhere; for those of LAMMPS, whose names are not ours, patterns do."""

import functools
import os
import re

import machine

# Files below src, by path without extension; first match counts. What is not named (commands, base) has no stage.
PLACES = (
    ("integration", r"^particles/.*(motion|integrat)|^fix/motion/"),
    ("floor and walls", r"^body/|^fix/body/|^system/(bodies|regions)/"),
    ("broad phase", r"^neighbors/|^particles/.*(order|key)|^history/.*(kept|partner|rebuild)|^system/.*(contact_store|neighbor|rebuild)"),
    ("narrow phase", r"^contact/narrow_phase|^history/"),
    ("exchange", r"^(exchange|comm)/"),
    ("contact force", r"^(contact|laws|material|particles|pair)/"),
)
HOST = (
    ("exchange", r"Comm(Brick|Tiled)|pack_comm|pack_border|pack_exchange|AtomVec::(un)?pack"),
    ("broad phase", r"NPair|NBin|NStencil|Neighb|NeighList|FixNeighHistory|Atom::sort|AtomVec::copy"),
    ("floor and walls", r"FixWallGran"),
    ("integration", r"FixNVE|FixGravity|force_clear"),
    ("contact force", r"Pair|GranSub|Granular"),
)
MPI_LIBRARY = r"libmpi|libopen-|mca_|libucp|libpmix|libevent"
MPI_FUNCTION = r"^(opal_|ompi_|mca_|PMPI_|MPI_|pml_)|vader"
OWN_LIBRARY = r"^talus"

DEFINED_TYPE = re.compile(r"^(?:template <[^;{]*>\s*)?(?:class|struct)\s+(?:alignas\([^)]*\)\s*)?(\w+)[^;{()]*\{", re.M)
DEFINED_METHOD = re.compile(r"^\w[^;={}()#]*?\b(\w+)(?:<[^()]*>)?::(~?\w+)\(", re.M)
DEFINED_FUNCTION = re.compile(r"^\w[^;={}()#:]*?[\s*&](\w+)\(", re.M)


def places(folder):
    """{name, or (class, method): file without extension} of all that is defined below the folder."""
    found = {}
    for path, _, names in sorted(os.walk(folder)):
        for name in sorted(names):
            stem, extension = os.path.splitext(name)
            if extension not in (".h", ".cpp"):
                continue
            with open(os.path.join(path, name)) as file:
                text = file.read()
            place = os.path.relpath(os.path.join(path, stem), folder)
            defined = [*DEFINED_TYPE.findall(text), *DEFINED_FUNCTION.findall(text)]
            if extension == ".cpp":
                defined += DEFINED_METHOD.findall(text)
            for key in defined:
                found.setdefault(key, place)
    return found


@functools.lru_cache
def own_places():
    return places(os.path.join(machine.ROOT, "src"))


def stage_of_place(place):
    return next((stage for stage, pattern in PLACES if re.search(pattern, place)), None)


def stage_of_own(symbol, known):
    """By the first part of the name whose file has a stage: a loop over threads is a function of base/ with what it calls
    among its template arguments."""
    function = symbol.replace("(anonymous namespace)::", "").split("(")[0]
    for name in re.findall(r"\w+(?:::~?\w+)*", function):
        parts = name.split("::")
        for key in (tuple(parts[-2:]), *reversed(parts)):
            stage = stage_of_place(known.get(key, ""))
            if stage:
                return stage
    return "other"


def stage_of(library, symbol):
    if re.match(MPI_LIBRARY, library) or re.search(MPI_FUNCTION, symbol):
        return "waiting"
    if re.match(OWN_LIBRARY, library):
        return stage_of_own(symbol, own_places())
    function = symbol.split("(")[0]
    return next((stage for stage, pattern in HOST if "LAMMPS_NS" in symbol and re.search(pattern, function)), "other")
