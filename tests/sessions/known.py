# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Faults that are known and not mended yet, each with what tells it from others."""

import re

# (relation, pattern of the fault, pattern of the input, what it is)
KNOWN = [
    ("same_bits", "^other bits", r"triclinic[\s\S]*fix drive all deform.* (xy|xz|yz) erate (1[5-9]|2\d)",
     "triclinic boxes that flip within the run, on other ranks: positions differ in the last digit"),
]


def known(relation, fault, sessions):
    """What it is; empty if it is new."""
    lines = "\n".join("\n".join(session.lines) for session in sessions)
    for name, in_fault, in_input, what in KNOWN:
        if name == relation and re.search(in_fault, fault) and re.search(in_input, lines):
            return what
    return ""
