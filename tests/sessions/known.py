# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Faults that are known and not mended yet, each with what tells it from others."""

import re

# (relation or "" of all, pattern of the fault, pattern of the input, what it is)
KNOWN = [
    ("robust", "Bond atom missing in image check", r"delete_atoms", "LAMMPS ends one rank where bonds of deleted particles are left"),
    ("", "FixUpdateSpecialBonds", r"bond_style bpm", "LAMMPS looks for partners of broken bonds that are beyond the ghosts"),
    ("robust", r"^hang", r"(?s)delete_atoms group all.*balance 1\.0 rcb", "LAMMPS hangs in a run after balance rcb without atoms"),
]


def known(relation, fault, sessions):
    """What it is; empty if it is new."""
    lines = "\n".join("\n".join(session.lines) for session in sessions)
    for name, in_fault, in_input, what in KNOWN:
        if name in (relation, "") and re.search(in_fault, fault) and re.search(in_input, lines):
            return what
    return ""
