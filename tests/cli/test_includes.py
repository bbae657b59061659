#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: label=smoke timeout=60
"""Which folder of src may include which: every #include against the table of doc/architecture.md."""

import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

SOURCE = Path(os.environ["TALUS_SOURCE_DIR"])
ROW = re.compile(r"^\| `src/([a-z/]*)` \|[^|]*\| ([^|]*) \|")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^">]+)[">]')

# Headers of LAMMPS are told from those of Talus by having no folder; MPI and threads are libraries of their own.
MPI, LAMMPS = "MPI", "LAMMPS"


def read_table(text):
    """{folder: set of folders and libraries that it may include}."""
    table = {}
    for line in text.splitlines():
        row = ROW.match(line)
        if row:
            table[row.group(1)] = {word.strip("` ") for word in row.group(2).split(",")} - {"", "-"}
    return table


def reachable(table, folder):
    """What a folder may include, and what those may."""
    found, todo = set(), [folder]
    while todo:
        for other in table.get(todo.pop(), ()):
            if other not in found:
                found.add(other)
                todo.append(other)
    return found


def folder_of(path):
    """The folder of the table that a file in src belongs to: some have rooms, and one row for all of them."""
    folder = str(Path(path).parent).strip(".")
    first = folder.split("/")[0]
    return first if first in ("laws", "system", "fix") else folder


def target_of(source, bracket, name):
    """Folder or library that an include leads to; None for the standard library and the like."""
    if bracket == "<":
        return MPI if name == "mpi.h" else None
    if (source / name).exists():
        return folder_of(name)
    return LAMMPS


def wrong_arrows(source, table):
    """Lines 'file -> include' that the table does not allow."""
    wrong = []
    for file in sorted(source.glob("**/*")):
        if file.suffix not in (".h", ".cpp"):
            continue
        folder = folder_of(file.relative_to(source))
        if folder not in table:
            wrong.append(f"{file.relative_to(source)}: folder '{folder}' is not in the table")
            continue
        allowed = reachable(table, folder) | {folder}
        for line in file.read_text().splitlines():
            include = INCLUDE.match(line)
            if not include:
                continue
            target = target_of(source, *include.groups())
            if target is not None and target not in allowed:
                wrong.append(f"{file.relative_to(source)} -> {include.group(2)}")
    return wrong


class Includes(unittest.TestCase):
    def setUp(self):
        self.table = read_table((SOURCE / "doc" / "architecture.md").read_text())

    def test_table_names_every_folder(self):
        folders = {folder_of(f.relative_to(SOURCE / "src")) for f in (SOURCE / "src").glob("**/*.cpp")}
        self.assertGreater(len(folders), 10)
        self.assertEqual(folders - set(self.table), set())
        self.assertEqual(set(self.table) - folders - {""}, set(), "folders that are gone")

    def test_picture_shows_every_folder(self):
        shown = re.findall(r"<text[^>]*>([a-z/]+)<", (SOURCE / "doc" / "architecture.svg").read_text())
        self.assertEqual(sorted(shown), sorted(set(self.table) - {""}))

    def test_no_cycle(self):
        for folder in self.table:
            self.assertNotIn(folder, reachable(self.table, folder), f"{folder} reaches itself")

    def test_every_include_is_allowed(self):
        self.assertEqual(wrong_arrows(SOURCE / "src", self.table), [])

    def test_wrong_arrows_are_found(self):
        with tempfile.TemporaryDirectory() as name:
            source = Path(name)
            for folder in ("low", "high"):
                (source / folder).mkdir()
                (source / folder / "a.h").write_text("")
            (source / "low" / "b.cpp").write_text('#include "high/a.h"\n#include "low/a.h"\n#include <mpi.h>\n')
            (source / "high" / "b.cpp").write_text('#include "low/a.h"\n#include "atom.h"\n')
            self.assertEqual(wrong_arrows(source, {"low": set(), "high": {"low", "LAMMPS"}}),
                             ["low/b.cpp -> high/a.h", "low/b.cpp -> mpi.h"])
            self.assertEqual(wrong_arrows(source, {"low": {MPI}, "high": {"low"}}),
                             ["high/b.cpp -> atom.h", "low/b.cpp -> high/a.h"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
