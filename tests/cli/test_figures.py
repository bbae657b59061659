# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=60 label=hostless
"""What README and doc/figures.md say about speed is what the report of the benchmarks has, rounded."""

import os
import re
import unittest

ROOT = os.environ.get("TALUS_SOURCE_DIR") or os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))

# beginning of a row of README's first table: rows of the report that its numbers come from
README_ROWS = {
    "a bed of 50 000 spheres, gran/hertz/history": [("dropin", "bed")],
    "the same with pair granular": [("dropin", "bed.tsuji")],
    "30 000 settled spheres, sizes 1:10": [("sizes", "1:10", "30000", "walls", "settled")],
    "the same, falling in a periodic box": [("sizes", "1:10", "30000", "periodic", "falling")],
    "`in.granregion.mixer`": [("dropin", "granregion.mixer")],
    "`in.granregion.funnel`": [("dropin", "granregion.funnel")],
    "`in.pour.flatwall`, `in.pour`": [("dropin", "pour.flatwall"), ("dropin", "pour")],
    "`in.chute` of LAMMPS": [("dropin", "chute.long")],
    "a gas of 27 000 spheres": [("dropin", "gas.0.02"), ("dropin", "gas.0.1"), ("dropin", "gas.0.3")],
    "`in.granregion.box`": [("dropin", "granregion.box"), ("dropin", "restitution")],
}
COLUMNS = {"dropin": ("ratio, median (range)", "ratio on 2 ranks"), "sizes": ("times LAMMPS, one rank", "two ranks")}

# words of doc/figures.md before a number, case of dropin
FIGURES = [("five planes", "bed"), ("with pair granular", "bed.tsuji"), (r"\(jkr", "bed.jkr"), ("`in.granregion.mixer`", "granregion.mixer"),
           ("`.funnel`", "granregion.funnel"), ("`.box`", "granregion.box"), ("`in.pour.flatwall`", "pour.flatwall"), ("`in.pour`", "pour"),
           ("`in.pour.heat`", "pour.heat"), ("`in.chute` with 3000 steps", "chute.long"), ("`in.pour.drum`", "pour.drum"),
           ("`in.pour.2d`", "pour.2d")]


def read(*path):
    with open(os.path.join(ROOT, *path)) as file:
        return file.read()


def table(text):
    """Rows of the first Markdown table, as lists of cells; the first are the headings."""
    lines = re.search(r"(?:^\|.*\n)+", text, re.M)[0].splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if not line.startswith("|---")]


def section(name):
    return re.search(rf"<!-- begin {name} -->.*?<!-- end {name} -->", read("bench", "REPORT.md"), re.S)[0]


def reported(name, *key):
    """(one core, two ranks): medians."""
    head, *rows = table(section(name))
    row = next(row for row in rows if [*key] == [row[k] for k in ((0,) if name == "dropin" else (0, 1, 2, 3))])
    return [float(row[head.index(column)].split()[0]) for column in COLUMNS[name]]


class Figures(unittest.TestCase):

    def assert_rounded(self, shown, value, where):
        digits = len(shown.partition(".")[2])
        self.assertLessEqual(abs(float(shown) - value), 0.5001 * 10**-digits, f"{where}: {shown}, the report has {value}")

    def test_first_table_of_readme(self):
        head, *rows = table(read("README.md"))
        self.assertEqual(head, ["script", "one core", "two ranks"])
        for words, keys in README_ROWS.items():
            with self.subTest(words):
                row = next(row for row in rows if row[0].startswith(words))
                for column in (0, 1):
                    shown = row[1 + column].split(", ")
                    self.assertEqual(len(shown), len(keys))
                    for number, key in zip(shown, keys):
                        self.assert_rounded(number, reported(*key)[column], f"README, {words}")
        self.assertEqual(len(rows), len(README_ROWS))

    def test_page_of_figures(self):
        text = read("doc", "figures.md")
        part = text[text.index("Existing scripts with"):].replace("\n", " ")
        for words, case in FIGURES:
            with self.subTest(case):
                found = re.search(words + r" ([\d.]*\d)", part)
                self.assertTrue(found, words)
                self.assert_rounded(found[1], reported("dropin", case)[0], f"figures.md, {case}")

    def test_every_section_is_there(self):
        """What `scripts/bench all` runs has a section in the report."""
        names = re.search(r"all\) names\+=\(([\w ]*)\)", read("scripts", "bench"))[1].split()
        for name in names:
            self.assertIn(f"<!-- begin {name} -->", read("bench", "REPORT.md"))


if __name__ == "__main__":
    unittest.main()
