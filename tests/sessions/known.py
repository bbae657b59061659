# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Faults that are known and not mended yet, each with what tells it from others."""

import re

# (relation, pattern of the fault, pattern of the input, what it is)
KNOWN = [
    ("robust", "crash|hang", "pre no", "walls, groups and more that come before a run without set-up"),
    ("robust", "crash|hang", "comm_style tiled", "tiles"),
    ("robust", "crash|hang", r"region \w+ delete", "regions that are gone"),
    ("robust", "crash|hang", "read_restart half", "restart files with wrong bits"),
    ("same_bits", "other bits", r"fix squeeze all deform(.*\n)*(compute|dump|fix_modify|thermo_style|fix) o?", "outputs with fix deform"),
    ("like_stock", "differs", r"rigid/small molecule\nfix fall all gravity", "gravity behind fix rigid/small"),
    ("gradients", "gradient", r"type 1 (box|vertices).*\n(.*\n)*fix b all large/body (cone|cylinder).*outside", "edges across a rim"),
    ("surfaces", "is not plane", r"type 1 (super)?ellipsoid", "ellipsoids on meshes and rectangles"),
]


def known(relation, fault, sessions):
    """What it is; empty if it is new."""
    lines = "\n".join("\n".join(session.lines) for session in sessions)
    for name, in_fault, in_input, what in KNOWN:
        if name == relation and re.search(in_fault, fault) and re.search(in_input, lines):
            return what
    return ""
