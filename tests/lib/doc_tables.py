# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Tables and scripts of the pages in doc, for tests that run what stands there."""

import os
import re

SOURCE = os.environ["TALUS_SOURCE_DIR"]


def page(*names):
    text = ""
    for name in names:
        with open(os.path.join(SOURCE, "doc", name)) as file:
            text += file.read()
    return text


def rows(text, first):
    """Cells of the rows of all tables whose first column is called so."""
    found, inside = [], False
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split(" | ")] if line.startswith("|") else []
        if not cells:
            inside = False
        elif cells[0] == first:
            inside = True
        elif inside and not cells[0].startswith("---"):
            found.append(cells)
    return found


def commands(cell):
    return re.findall(r"`([^`]+)`", cell)


def blocks(text):
    return re.findall(r"^```\n(.*?)^```$", text, re.M | re.S)
