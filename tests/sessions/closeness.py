# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""States of particles that should be the same to rounding."""

from quantities import AXIAL, PLACE, VECTOR, Quantity
from scene import frame, value

# columns of a dump that belong together: (names, kind, units)
GROUPS = ((("x", "y", "z"), PLACE, (1, 0, 0)), (("vx", "vy", "vz"), VECTOR, (1, 0, -1)),
          (("omegax", "omegay", "omegaz"), AXIAL, (0, 0, -1)), (("fx", "fy", "fz"), VECTOR, (1, 1, -2)),
          (("tqx", "tqy", "tqz"), AXIAL, (2, 1, -2)))
UNITS = {columns[0]: units for columns, _, units in GROUPS}
FLOOR = 1e-9    # of a number that should be zero, in the units in which scenes are drawn


def vectors(dump, change=None):
    """{name of the first column: {id: three numbers}}, in other coordinates and units."""
    rows, names = frame(dump)
    found = {}
    for columns, kind, units in GROUPS:
        places = [names.index(column) for column in columns]
        found[columns[0]] = {}
        for tag, words in rows.items():
            values = tuple(value(words[k]) for k in places)
            found[columns[0]][tag] = change.of(Quantity(values, kind, units)).values if change else values
    return found


def compare(dump, other, position, relative, change=None):
    """Empty, or the first difference. position: of coordinates, in diameters; relative: of other columns, of their largest value.
    change: leads from the first to the second."""
    mine, theirs = vectors(dump, change), vectors(other)
    if sorted(mine["x"]) != sorted(theirs["x"]):
        return f"particles {sorted(mine['x'])} and {sorted(theirs['x'])}"
    for name in mine:
        values = [abs(v) for side in (mine, theirs) for row in side[name].values() for v in row]
        one = change.of(Quantity((1.0,), units=UNITS[name])).values[0] if change else 1.0
        bound = position * one if name == "x" else relative * max(values, default=0.0) + FLOOR * one
        for tag, row in mine[name].items():
            twin = theirs[name][tag]
            worst = max(abs(a - b) for a, b in zip(row, twin))
            if not worst <= bound:
                return f"{name} of particle {tag}: {row} and {twin}, {worst:.3g} apart ({bound:.3g} is allowed)"
    return ""
