# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What LAMMPS writes: dumps and logs."""

import dataclasses
import functools
import itertools
import re


@dataclasses.dataclass
class Frame:
    """One frame of a custom text dump: step, column names, a line for each particle.  Only what is asked for is made a number."""
    step: int
    columns: list
    lines: list

    @functools.cached_property
    def _rows(self):
        """Words of the lines."""
        return [line.split() for line in self.lines]

    @functools.cached_property
    def tags(self):
        """IDs in the order of the lines."""
        k = self.columns.index("id")
        return [int(row[k]) for row in self._rows]

    @functools.cached_property
    def _by_name(self):
        return {}

    @functools.cached_property
    def atoms(self):
        """{id: tuple of floats}, not to be changed."""
        return {tag: tuple(_numbers(row)) for tag, row in zip(self.tags, self._rows)}

    def words(self, name):
        """{id: number as it was written}."""
        k = self.columns.index(name)
        return {tag: row[k] for tag, row in zip(self.tags, self._rows)}

    def column(self, name):
        """{id: number}, not to be changed."""
        if name not in self._by_name:
            k = self.columns.index(name)
            self._by_name[name] = dict(zip(self.tags, _numbers([row[k] for row in self._rows])))
        return self._by_name[name]

    def largest(self, names):
        """Absolute number of these columns."""
        key = names = tuple(names)
        if key not in self._by_name:
            self._by_name[key] = max(abs(value) for name in names for value in self.column(name).values())
        return self._by_name[key]


def _number(word):
    return float.fromhex(word) if "0x" in word else float(word)


def _numbers(words):
    try:
        return list(map(float, words))
    except ValueError:    # some have digits of base 16
        return list(map(_number, words))


def read_dump(path):
    """Frames of a `dump custom` file that has a column id and only numbers.

    `dump_modify ID format float %.17g` and `%a` both keep every bit."""
    frames = []
    with open(path) as file:
        for line in file:
            if line.startswith("ITEM: TIMESTEP"):
                frames.append(Frame(int(next(file)), [], []))
            elif line.startswith("ITEM: NUMBER OF ATOMS"):
                count = int(next(file))
            elif line.startswith("ITEM: ATOMS"):
                frames[-1].columns = line.split()[2:]
                frames[-1].lines = list(itertools.islice(file, count))
    return frames


@dataclasses.dataclass
class LocalFrame:
    """One frame of a local text dump: step, column names, rows (tuples of floats)."""
    step: int
    columns: list
    rows: list


def read_local(path):
    """Frames of a `dump local` file that has only numbers."""
    frames = []
    with open(path) as file:
        for line in file:
            if line.startswith("ITEM: TIMESTEP"):
                frames.append(LocalFrame(int(next(file)), [], []))
            elif line.startswith("ITEM: NUMBER OF"):
                count = int(next(file))
            elif line.startswith("ITEM: ENTRIES"):
                frames[-1].columns = line.split()[2:]
                frames[-1].rows = [tuple(_numbers(line.split())) for line in itertools.islice(file, count)]
    return frames


def thermo(log):
    """All lines of thermodynamic output in a log text, as a list of {column: float}."""
    rows, columns = [], None
    for line in log.splitlines():
        words = line.split()
        if words[:1] == ["Step"]:
            columns = words
        elif line.startswith("Loop time of"):
            columns = None
        elif columns and len(words) == len(columns):
            try:
                rows.append(dict(zip(columns, map(float, words))))
            except ValueError:
                pass    # a warning between the lines
    return rows


def marked_word(log):
    """The word of the input line that an error message marks with ^^^^, or None."""
    lines = log.splitlines()
    for above, below in zip(lines, lines[1:]):
        if re.fullmatch(r" *\^+", below):
            return above[below.index("^"):][:below.count("^")]
    return None
