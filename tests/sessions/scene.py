# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""A scene and what happens in it, in parts that can be left out, moved, turned, told in other units and written as commands."""

import dataclasses

from bonded_grains import bonded_data
from mutation import text_stl
from quantities import Quantity, line, text

COLUMNS = ("type", "radius", "x", "y", "z", "vx", "vy", "vz", "omegax", "omegay", "omegaz", "fx", "fy", "fz", "tqx", "tqy", "tqz")
DATA, BOND_TYPES = "grains.data", 2


@dataclasses.dataclass(frozen=True)
class Grain:
    """A sphere, or what fix shape/gran makes of it. molecule: of a clump, 0: of none."""
    place: Quantity
    velocity: Quantity
    spin: Quantity
    diameter: Quantity
    density: Quantity
    type: int = 1
    molecule: int = 0

    def lines(self, tag):
        more = ("mol", self.molecule) if self.molecule else ()
        (vx, vy, vz), u = self.velocity.values, self.velocity.units
        components = [(name, Quantity((v,), units=u)) for name, v in zip(("vx", "vy", "vz"), (vx, vy, vz))]
        return [line("create_atoms", self.type, "single", self.place, "units box"),
                line("set atom", tag, components, "omega", self.spin, "diameter", self.diameter, "density", self.density, more)]


@dataclasses.dataclass(frozen=True)
class Mesh:
    """triangles: of places, three tuples each."""
    name: str
    triangles: tuple

    def changed(self, change):
        def corner(p):
            return change.of(Quantity(p, "place", (1, 0, 0))).values

        return dataclasses.replace(self, triangles=tuple(tuple(map(corner, triangle)) for triangle in self.triangles))


@dataclasses.dataclass(frozen=True)
class Scene:
    """start: lines up to the box; box: two lines that make it, and what changes it; physics: what is given again after read_restart;
    program: what happens then, ("run", steps) or commands; bonds: (type, i, j) with i, j from 1, the places in grains; once: lines
    behind the physics that are not given again, since restart files have what they say.

    columns: more values of each particle; vectors: (fix, length), told at the end; traits: words on which relations depend; words: of
    the command line."""
    start: tuple = ()
    box: tuple = ()
    grains: tuple = ()
    physics: tuple = ()
    program: tuple = ()
    meshes: tuple = ()
    columns: tuple = ()
    vectors: tuple = ()
    traits: frozenset = frozenset()
    words: tuple = ()
    bonds: tuple = ()
    once: tuple = ()

    def but(self, **changes):
        return dataclasses.replace(self, **changes)

    def files(self):
        found = {mesh.name: text_stl(mesh.triangles) for mesh in self.meshes}
        return {**found, DATA: self._data().encode()} if "read" in self.traits else found

    def beginning(self):
        """Lines up to the physics."""
        if "read" in self.traits:
            return [text(words) for words in (*self.start, line("read_data", DATA), *self.box[2:])]
        made = [words for tag, grain in enumerate(self.grains, start=1) for words in grain.lines(tag)]
        last = len(self.bonds) - 1
        made += [line("create_bonds single/bond", bond, "special", "yes" if n == last else "no") for n, bond in enumerate(self.bonds)]
        return [text(words) for words in (*self.start, *self.box, *made)]

    def edges(self):
        """Of the box: (low, high) along x, y, z."""
        values = [word.values[0] for word in self.box[0] if isinstance(word, Quantity)]
        return tuple(zip(values[::2], values[1::2]))

    def _data(self):
        spheres = [(grain.place.values, grain.velocity.values, grain.spin.values, grain.diameter.values[0], grain.density.values[0])
                   for grain in self.grains]
        return bonded_data(self.edges(), spheres, self.bonds, BOND_TYPES)

    def physical(self, again=False):
        """again: behind read_restart."""
        kept = [words for words in self.once if not again or "again" in self.traits and str(words[0]).startswith("bond_")]
        return [text(words) for words in (*self.physics, *kept)]

    def seen(self, name):
        """Commands that write the present state."""
        columns = " ".join((*COLUMNS, *self.columns))
        lines = [f"write_dump all custom seen.{name} id {columns} modify sort id format float %a"]
        for fix, size in self.vectors:
            numbers = " ".join(f"$(f_{fix}[{n}]:%.17g)" for n in range(1, size + 1))
            lines.append(f'print "{fix} {numbers}" append seen.{name}.vectors screen no')
        return lines

    def steps(self):
        return [f"run {words[1]}" if words[0] == "run" else text(words) for words in self.program]

    def changed(self, change):
        """With other numbers: those of a Change or a Rounding."""
        def grain(one):
            values = {field.name: getattr(one, field.name) for field in dataclasses.fields(one)}
            return Grain(**{name: change.of(value) if isinstance(value, Quantity) else value for name, value in values.items()})

        def one_line(words):
            return tuple(change.of(word) if isinstance(word, Quantity) else word for word in words)

        lines = {name: tuple(map(one_line, getattr(self, name))) for name in ("start", "box", "physics", "once", "program")}
        return self.but(**lines, grains=tuple(map(grain, self.grains)), meshes=tuple(mesh.changed(change) for mesh in self.meshes))


# ---- what was seen ------------------------------------------------------------------------------

def frame(dump):
    """{id: [words]} and the names of columns of the only frame of a dump."""
    names, found = [], {}
    lines = iter(dump.splitlines())
    for row in lines:
        if row.startswith("ITEM: ATOMS"):
            names = row.split()[3:]
            for words in lines:
                tag, *values = words.split()
                found[int(tag)] = values
    return found, names


def value(word):
    return float.fromhex(word) if "0x" in word else float(word)


def same_bits(seen, other):
    """Empty, or the first difference of two {name: text} of files seen.*; signs of zeros do not count."""
    if sorted(seen) != sorted(other):
        return f"{sorted(seen)} and {sorted(other)} were written"
    for name in sorted(seen):
        if seen[name] == other[name]:
            continue
        mine, theirs = (_rows(side[name]) for side in (seen, other))
        if len(mine) != len(theirs):
            return f"{name}: {len(mine)} and {len(theirs)} rows"
        for row, twin in zip(mine, theirs):
            if row != twin:
                return f"{name}: {' '.join(row)}\n{'':{len(name)}}  {' '.join(twin)}"
    return ""


def _rows(dump):
    zeros = {"-0x0p+0": "0x0p+0", "-0": "0"}
    return [[zeros.get(word, word) for word in row.split()] for row in dump.splitlines()]


def not_finite(seen):
    """Names of files with numbers that are none."""
    return [name for name, words in seen.items() if any(word in ("nan", "-nan", "inf", "-inf") for word in words.split())]
