# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=60 label=hostless
"""What README and the pages say about speed is what the report of the benchmarks has, rounded."""

import os
import re
import unittest

ROOT = os.environ.get("TALUS_SOURCE_DIR") or os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))

MEDIAN = "ratio, median (range)"
CLUMPS, CONVEX, ROUND = "Clumps of three spheres", "Convex particles", "Superellipsoids"
STEP = "ns per body and step"


def script(case):
    """One core and two ranks of a script with -sf talus."""
    return [("dropin", None, (case,), column) for column in (MEDIAN, "ratio on 2 ranks")]


def sizes(*key):
    return [("sizes", None, key, column) for column in ("times LAMMPS, one rank", "two ranks")]


# beginning of a row of the table of scripts: cells of the report that its numbers come from, (one core, two ranks) each
SCRIPT_ROWS = {
    "a bed of 50 000 spheres, gran/hertz/history": [script("bed")],
    "the same with pair granular": [script("bed.tsuji")],
    "30 000 settled spheres, sizes 1:10": [sizes("1:10", "30000", "walls", "settled")],
    "the same in a periodic box": [sizes("1:10", "30000", "periodic", "settled")],
    "`in.granregion.mixer`": [script("granregion.mixer")],
    "`in.granregion.funnel`": [script("granregion.funnel")],
    "29 185 grains in a turning drum that is a mesh": [[("bodies", "A drum that is a mesh", (ranks,), MEDIAN) for ranks in "12"]],
    "`in.pour.flatwall`, `in.pour`": [script("pour.flatwall"), script("pour")],
    "`in.chute` of LAMMPS": [script("chute.long")],
    "a gas of 27 000 spheres": [script("gas.0.02"), script("gas.0.1"), script("gas.0.3")],
    "`in.granregion.box`": [script("granregion.box"), script("restitution"), script("pour.2d.molecule")],
    "a block of 4000 spheres with bonds": [script("bonds.block")],
}

# rows of README: the same row in a table of doc/figures.md
README_ROWS = {
    "a bed of 50 000 spheres": "a bed of 50 000 spheres, gran/hertz/history",
    "a drum that is a mesh": "29 185 grains in a turning drum that is a mesh",
    "768 ellipsoids": "768 ellipsoids",
    "a block of 4000 spheres with bonds": "a block of 4000 spheres with bonds",
}


def single(case):
    return [("single", None, (case,), column) for column in ("other, ns", "Talus, ns", MEDIAN)]


def clumps(law):
    stock, ours = (law, "clumps, fix rigid/small of LAMMPS"), (law, "clumps, rigid/small/talus")
    return [("shapes", CLUMPS, stock, STEP), ("shapes", CLUMPS, ours, STEP), ("shapes", CLUMPS, ours, "rigid/small of LAMMPS over it")]


def superellipsoids(kind):
    return [("shapes", ROUND, (kind,), column) for column in ("pair granular/superellipsoid, ns", STEP, "over it")]


# rows of the table of doc/figures.md: beginning of the bed and of the other code, cells of its time, that of Talus, ratio
FIGURES_ROWS = [
    ("50 000 spheres", "stock `gran/hertz/history`", single("bed")),
    ("400 000 spheres", "the same", single("bed400k")),
    ("1 236 372 spheres", "the same", single("bed1236k")),
    ("50 000 spheres", "stock `pair granular`", single("granular")),
    ("50 000 spheres", "LIGGGHTS", single("liggghts")),
    ("`in.chute` of LAMMPS", "stock `gran/hooke/history`", single("chute")),
    ("50 000 spheres, 2 threads", "stock with `-sf omp`", single("omp")),
    ("768 cubes", "stock `body/rounded/polyhedron`",
     [("shapes", CONVEX, ("cubes",), column) for column in ("body/rounded/polyhedron, ns", STEP, "ratio")]),
    ("768 ellipsoids", "`pair granular/superellipsoid`", superellipsoids("ellipsoids")),
    ("768 superellipsoids", "the same", superellipsoids("superellipsoids")),
    ("2500 clumps", "stock `fix rigid/small` with pair granular", clumps("granular")),
    ("2500 clumps", "stock `fix rigid/small` with gran/hertz/history", clumps("gran/hertz/history")),
]

# words of doc/figures.md before a number of a script on one core
SCRIPTS = [("bed with jkr", "bed.jkr"), ("`in.pour.heat`", "pour.heat"), ("`in.pour.drum`", "pour.drum"), ("`in.pour.2d`", "pour.2d")]

# scenes of the section accuracy where contacts are damped; not that of rolling resistance alone, where order 2 gains far more
DAMPED = ("hooke damped", "hertz damped", "mixed", "stack", "cluster")

# sentences: file, words with a group for each number, cells of the report
NUMBER, RANGE = r"([\d.]*\d)", r"([\d.]*\d) \(([\d.]*\d) to ([\d.]*\d)\)"
SENTENCES = [
    ("README.md", f"a bed is {NUMBER} times as fast", single("bed")[2:]),
    ("doc/figures.md", f"two ranks reach {RANGE}", single("ranks")[2:]),
    ("doc/figures.md", f"two threads {RANGE}", single("threads")[2:]),
    ("doc/figures.md", f"takes {NUMBER} bytes for each, the stock styles {NUMBER}",
     [("memory", "1236372 spheres, whole process", (code,), "bytes per particle")
      for code in ("Talus, multistep friction, floor and walls", "stock gran/hertz/history, floor and walls")]),
    ("doc/fix_nve_sphere_symplectic.md", f"takes {NUMBER} times as long as one of order 1.*takes {NUMBER} times as long",
     [("needs", "Cost", (case,), "time over that of multistep friction") for case in ("multistep, order 2", "multistep, midpoint")]),
    ("doc/fix_shape_gran_contacts.md", f"takes {NUMBER} ns for each ellipsoid, {NUMBER} ns with",
     [("shapes", ROUND, (kind,), STEP) for kind in ("ellipsoids", "superellipsoids")]),
    *(("doc/figures.md", f"{words} {NUMBER}", script(case)[:1]) for words, case in SCRIPTS),
]


def read(*path):
    with open(os.path.join(ROOT, *path)) as file:
        return file.read()


def table(text):
    """Rows of the first Markdown table, as lists of cells; the first are the headings."""
    lines = re.search(r"(?:^\|.*\n)+", text, re.M)[0].splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if not line.startswith("|---")]


def section(name):
    return re.search(rf"<!-- begin {name} -->.*?<!-- end {name} -->", read("bench", "REPORT.md"), re.S)[0]


def reported(name, heading, key, column):
    """Numbers of a cell: of the first table after the heading, or of that with the heading in its first cell, in the row that begins
    with the key. A ratio has its range after the median."""
    text = section(name)
    if heading:
        text = text[re.search(rf"^(### |\| ){heading}( \||$)", text, re.M).start():]
    head, *rows = table(text)
    row = next(row for row in rows if row[:len(key)] == [*key])
    return numbers(row[head.index(column)])


def numbers(cell):
    """As floats: 5.0 (4.8 to 5.2), 130 000, 1.3e+05."""
    return [float(each) for each in re.findall(r"\d*\.?\d+(?:e[+-]\d+)?", re.sub(r"(?<=\d) (?=\d)", "", cell))]


class Figures(unittest.TestCase):

    def assert_rounded(self, shown, value, where):
        digits = len(shown.partition(".")[2])
        self.assertLessEqual(abs(float(shown) - value), 0.5001 * 10**-digits, f"{where}: {shown}, the report has {value}")

    def assert_cell(self, shown, value, where):
        """A cell of our pages, all numbers of which are in the report."""
        texts = re.findall(r"\d*\.?\d+", re.sub(r"(?<=\d) (?=\d)", "", shown))
        self.assertLessEqual(len(texts), len(value), where)
        for each, number in zip(texts, value):
            self.assert_rounded(each, number, where)

    def test_scripts(self):
        """Each row of the table of scripts is one of SCRIPT_ROWS with its numbers."""
        head, *rows = self.scripts()
        self.assertEqual(head, ["script", "one core", "two ranks"])
        self.assertEqual(len(rows), len(SCRIPT_ROWS))
        for row in rows:
            with self.subTest(row[0]):
                cells = next(cells for words, cells in SCRIPT_ROWS.items() if row[0].startswith(words))
                for column in (0, 1):
                    shown = row[1 + column].split(", ")
                    self.assertEqual(len(shown), len(cells))
                    for number, pair in zip(shown, cells):
                        self.assert_rounded(number, reported(*pair[column])[0], row[0])

    def scripts(self):
        figures = read("doc", "figures.md")
        return table(figures[figures.index("### Existing scripts"):])

    def test_first_page(self):
        """Its numbers are those of doc/figures.md, the most and the least among them."""
        _, *scripts = self.scripts()
        _, *beds = table(read("doc", "figures.md"))
        figures = [(row[0], row[1]) for row in scripts] + [(row[0], row[4].split()[0]) for row in beds]
        head, *rows = table(read("README.md"))
        self.assertEqual(head, ["one core", "compared with", "times as fast"])
        self.assertEqual(len(rows), len(README_ROWS) + 1)
        for (words, same), row in zip(README_ROWS.items(), rows):
            self.assertTrue(row[0].startswith(words), row)
            self.assertEqual(row[2], next(number for what, number in figures if what.startswith(same)))
        one_core = [float(number) for row in scripts for number in row[1].split(", ")]
        self.assertTrue(rows[-1][0].startswith("the most and the least of LAMMPS' examples"))
        self.assertEqual(rows[-1][2], f"{max(one_core)}, {min(one_core)}")

    def test_table_of_figures(self):
        head, *rows = table(read("doc", "figures.md"))
        self.assertEqual(head, ["bed", "other code", "its time", "Talus", "ratio"])
        self.assertEqual(len(rows), len(FIGURES_ROWS))
        for row, (bed, other, cells) in zip(rows, FIGURES_ROWS):
            with self.subTest(f"{bed}, {other}"):
                self.assertTrue(row[0].startswith(bed) and row[1].startswith(other), row)
                for shown, cell in zip(row[2:], cells):
                    self.assert_cell(shown, reported(*cell), f"figures.md, {bed}, {other}")

    def test_sentences(self):
        for file, words, cells in SENTENCES:
            with self.subTest(f"{file}: {words}"):
                found = re.search(words, read(*file.split("/")).replace("\n", " "))
                self.assertTrue(found, f"{file} has no '{words}'")
                values = [value for cell in cells for value in reported(*cell)[:found.re.groups // len(cells)]]
                for shown, value in zip(found.groups(), values):
                    self.assert_rounded(shown, value, f"{file}, {words}")

    def test_time_steps(self):
        """Steps of order 1 and 2 and of the stock styles in the table of time steps, and what an accuracy costs with e = 0.5."""
        text = section("timestep")
        first, second, stock = [float(x) for x in re.findall(r"([\d.]+) ns per particle with", text)]
        choosing = read("doc", "choosing.md")
        rows = {row[0]: row for row in table(choosing[choosing.index("## Which time step"):])}
        for words, column, value in (("filling", 5, stock / first), ("restitution and rebound to 1 %, e above", 5, stock / first),
                                     ("restitution and rebound to 1 %, e = 0.5", 3, second / first),
                                     ("energy, where nothing", 3, second / first),
                                     # time steps that keep the energy: .03 of the critical one, .07 with Hertz, over .2
                                     ("energy, where nothing", 4, 0.2 / 0.03), ("energy, where nothing", 5, 0.2 / 0.03 * stock / first),
                                     ("the same, Hertz", 3, 0.2 / 0.07), ("the same, Hertz", 4, 0.2 / 0.07),
                                     ("the same, Hertz", 5, 0.2 / 0.07 * stock / first)):
            row = next(row for what, row in rows.items() if what.startswith(words))
            self.assert_rounded(row[column], value, f"choosing.md, {words}")
        laws = ("linear, damped", "hertz/material, e = .5", "hertz/material, e = .5, friction")
        for error, names in (("1 %", {4: "order 1", 5: "stock"}), ("0.1 %", {3: "order 2", 4: "order 1", 5: "stock"})):
            row = rows[f"restitution and rebound to {error}, e = 0.5"]
            for column, name in names.items():
                found = [reported("timestep", "What it costs", (law, error), name)[0] for law in laws]
                for shown, value in zip(row[column].split(" to "), (min(found), max(found))):
                    self.assert_rounded(shown, value, f"choosing.md, {row[0]}, {name}")

    def test_errors_against_run_time(self):
        """What order 1 and the faster stock style take for the motion of a few grains where contacts are damped, over order 2."""
        text = section("accuracy")
        head, *rows = table(text[text.index("| scene | error | Talus with"):])
        order_1, *stock = [head.index(f"{name}: dt") + 2 for name in ("order 1", "stock", "granular")]     # columns of "times"
        choosing = read("doc", "choosing.md")
        row = next(row for row in table(choosing[choosing.index("## Which time step"):]) if row[0].startswith("motion of a few"))
        for columns, shown in ([order_1], row[4].split(" to ")), (stock, row[5].split(" to ")):
            found = [min(float(cells[k].lstrip("~")) for k in columns if cells[k] != "-")
                     for cells in rows if cells[1] == "1e-04" and cells[0] in DAMPED]
            self.assertEqual(len(found), len(DAMPED))
            for number, value in zip(shown, (min(found), max(found))):
                self.assert_rounded(number, value, f"columns {columns}")

    def test_every_section_is_there(self):
        """What `scripts/bench all` runs has a section in the report."""
        names = re.search(r"all\) names\+=\(([\w ]*)\)", read("scripts", "bench"))[1].split()
        for name in names:
            self.assertIn(f"<!-- begin {name} -->", read("bench", "REPORT.md"))


if __name__ == "__main__":
    unittest.main()
