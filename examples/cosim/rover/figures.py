# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Tables and plots of the drive.  A row is: phase, time, place, mean slip; load, slip and sinkage of each wheel."""

import math


def mean(values):
    values = list(values)
    return math.fsum(values) / len(values)


def write_table(path, rows, wheels):
    header = ["phase", "time", "x", "slip", *(f"{what}_{wheel[6:]}" for what in ("load", "slip", "sinkage") for wheel in wheels)]
    with open(path, "w") as file:
        file.write(",".join(header) + "\n")
        file.writelines(f"{row[0]}," + ",".join(map(repr, row[1:])) + "\n" for row in rows)


PHASES = ("level", "foot", "slope")


def summary(rows, wheels):
    """(phase, slip, sinkage) of each phase."""
    found = []
    for phase in PHASES:
        some = [row for row in rows if row[0] == phase]
        if some:
            found.append((phase, mean(row[3] for row in some), mean(mean(row[4 + 2 * wheels:]) for row in some)))
    return found


PAIRS = (("front", "#c0392b"), ("middle", "#2471a3"), ("rear", "#1e8449"))


def plot(path, rows):
    """Load, slip and sinkage over time, means of left and right; dashed: where the front wheels come to the slope, and the
    rear ones."""
    width, height, gap, left = 640, 170, 60, 80
    count, first, end = 2 * len(PAIRS), rows[0][1], rows[-1][1]
    begins = [next((row[1] for row in rows if row[0] == phase), end) for phase in PHASES]
    shown = [row for row in rows if row[0] != "start"]
    curves = (("load of a wheel (N)", 1.0, 4, rows), ("slip", 1.0, 4 + count, shown), ("sinkage (mm)", 1e3, 4 + 2 * count, rows))
    with open(path, "w") as file:
        file.write(f'<svg xmlns="http://www.w3.org/2000/svg" width="{width + left + 20}" height="{3 * (height + gap) + 20}" '
                   'font-family="sans-serif" font-size="14">\n<rect width="100%" height="100%" fill="white"/>\n')
        for n, (name, unit, column, some) in enumerate(curves):
            lines = [[unit * mean(row[column + 2 * k:column + 2 * k + 2]) for row in some] for k in range(len(PAIRS))]
            low, high = min(0.0, *map(min, lines)), max(map(max, lines))
            y0 = 35 + n * (height + gap)

            def place(time, value):
                return f"{left + width * (time - first) / (end - first):.1f},{y0 + height * (high - value) / (high - low):.1f}"

            file.write(f'<rect x="{left}" y="{y0}" width="{width}" height="{height}" fill="none" stroke="gray"/>\n'
                       f'<text x="8" y="{y0 - 12}">{name}</text>\n<text x="8" y="{y0 + 12}">{high:.3g}</text>\n'
                       f'<text x="8" y="{y0 + height}">{low:.3g}</text>\n'
                       f'<polyline points="{place(first, 0)} {place(end, 0)}" stroke="silver"/>\n')
            for begin in begins:
                file.write(f'<polyline points="{place(begin, low)} {place(begin, high)}" stroke="gray" stroke-dasharray="4 4"/>\n')
            for (_, color), values in zip(PAIRS, lines):
                points = " ".join(place(row[1], value) for row, value in zip(some, values))
                file.write(f'<polyline points="{points}" fill="none" stroke="{color}" stroke-width="1.5"/>\n')
        for k, (name, color) in enumerate(PAIRS):
            file.write(f'<text x="{left + width - 190 + 65 * k}" y="23" fill="{color}">{name}</text>\n')
        for begin, name in zip(begins, ("level", "at the foot", "slope")):
            x = left + width * (begin - first) / (end - first)
            file.write(f'<text x="{x + 4:.1f}" y="{3 * (height + gap) - 8}" fill="gray">{name}</text>\n')
        file.write(f'<text x="{left + width // 2 - 60}" y="{3 * (height + gap) + 10}">time {first:.2f} ... {end:.2f} s</text>\n</svg>\n')
