# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=180
"""The tutorial: its page names the files of examples/tutorial and variables that they have, and each runs, with small numbers, and
says what it has to: the same motion from both styles, a bed that leans with its drum, steeper heaps with more friction, a blade
against whose motion grains push."""

import os
import re
import sys
import unittest

from coupled_case import SOURCE, CoupledCase
from doc_tables import blocks, page
from talus_testing import relative_difference, run_program, thermo

FOLDER = os.path.join(SOURCE, "examples", "tutorial")


def text_of(name):
    with open(os.path.join(FOLDER, name)) as file:
        return file.read()


class Page(unittest.TestCase):

    def test_commands_are_those_files(self):
        lines = [line for block in blocks(page("tutorial.md")) for line in block.splitlines()]
        named = set()
        for line in lines:
            files = re.findall(r"examples/tutorial/([\w.]+)", line)
            for name in files:
                named.add(name)
                for variable in re.findall(r"-var (\w+)", line):
                    self.assertRegex(text_of(name), rf"(?m)^variable +{variable} +index ", line)
                for option in re.findall(r" (--\w+)", line):
                    self.assertIn(f'add_argument("{option}"', text_of(name), line)
        self.assertEqual(named | {"in.blade"}, set(os.listdir(FOLDER)) - {"__pycache__"})    # in.blade is read by blade.py


class Tutorial(CoupledCase):

    def script(self, name, words=(), np=1, **variables):
        """Its log. LAMMPS runs in the folder of the input, as scripts/run does."""
        log = self.path("log.run")
        command = ["-in", name, "-log", log, "-screen", "none", *words]
        for key, value in {"out": self.dir, **variables}.items():
            command += ["-var", key, str(value)]
        run_program(os.environ["TALUS_LMP"], np, command, cwd=FOLDER)
        return self.read("log.run")

    def test_a_script_of_lammps(self):
        stock, talus = (self.script("in.box", words, np, edge=5, time=0.6) for words, np in (((), 1), (("-sf", "talus"), 2)))
        styles = re.findall(r"^  (?:pair|fix|run) .* accelerated$", talus, re.M)
        self.assertEqual(len(styles), 5, "pair, move, fall, floor, run")
        stock, talus = thermo(stock), thermo(talus)
        self.assertGreater(stock[-1]["c_coordination"], 0.05)
        self.assertEqual(len(stock), len(talus))
        for theirs, ours in zip(stock, talus):
            for column, value in theirs.items():
                self.assertLess(relative_difference(ours[column], value), 1e-6, column)

    def test_tablets(self):
        log = self.script("in.tablets", a=0.005, time=0.24, frames=2)
        said = {name: float(value) for name, value in re.findall(r"^(\w+).* (-?\d[\d.]*)(?: degrees)?$", log.split("--- tablets ---")[-1], re.M)}
        self.assertGreater(said["tablets"], 30)
        self.assertAlmostEqual(said["weight"], 1.0, delta=0.1)
        self.assertTrue(10 < said["lean"] < 70, said)    # to the side that rises; 0 at rest
        self.assertLess(said["mixing"], 0.9)
        self.assertTrue(any(name.endswith(".png") for name in os.listdir(self.dir)))
        self.assertRegex(self.read("tablets.pvd"), r"tablets\.shapes\.\d+\.vtp")

    def test_heaps(self):
        angles = []
        for mu, rolling in (0.05, 0.0), (0.5, 0.3):
            log = self.script("in.heap", mu=mu, rolling=rolling, length=7, height=7, width=4, rest=25)
            angle, grains = re.search(r"^Result: .* angle (\S+) grains (\d+)$", log, re.M).groups()
            self.assertGreater(int(grains), 40)
            angles.append(float(angle))
        self.assertTrue(3 < angles[0] < 24, angles)
        self.assertTrue(angles[0] + 5 < angles[1] < 50, angles)

    def test_blade(self):
        """Grains push it up, then back; their work on it is that of the forces of each row on its ways."""
        said = self.launch([sys.executable, os.path.join(FOLDER, "blade.py"), "--speed", "0.4", "--way", "0.008", "--out", self.dir])
        up, back, work = map(float, re.search(r"against (\S+) N at most\n.*against (\S+) N .*work (\S+) J", said).groups())
        self.assertTrue(0.1 < up < 10 and 0.05 < back < 5, said)
        rows = [list(map(float, line.split())) for line in self.read("force.txt").splitlines()[1:]]
        places = [[20, 45], *([x, z] for x, z, *_ in rows)]
        ways = [((b[0] - a[0]) / 1000, (b[1] - a[1]) / 1000) for a, b in zip(places, places[1:])]
        expected = sum(row[2] * x + row[3] * z for row, (x, z) in zip(rows, ways))
        self.assertLess(work, -0.001)
        self.assertLess(relative_difference(work, expected), 2e-3)


if __name__ == "__main__":
    unittest.main()
