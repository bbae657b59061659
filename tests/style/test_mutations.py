# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=45 timeout=300
"""Every example of the documentation, then examples with words that are wrong, damaged STL files and odd sessions:
nothing crashes, hangs, fails without a message or prints numbers that are none. New commands are covered as soon as
their pages have examples."""

import os
import random
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "lib"))
import mutation

DOC = os.path.join(os.environ["TALUS_SOURCE_DIR"], "doc")


class Mutations(unittest.TestCase):
    """seed: of what is drawn. The others: how many runs of each kind."""
    seed, lines, files, sessions = 20260101, 110, 24, 16

    def check(self, cases):
        faults = mutation.judge(cases, lambda n: 2 if n % 12 == 11 else 1)
        self.assertEqual(faults, [], f"{len(faults)} faults (seed {self.seed}):\n"
                         + "\n\n".join(f"{what}\n    {fault}" for what, fault in faults[:8]))

    def test_commands(self):
        lines = mutation.examples(DOC)
        self.assertGreater(len(lines), 25)
        self.check(mutation.commands(random.Random(self.seed), DOC, len(lines) + self.lines))

    def test_stl_files(self):
        self.check(mutation.stl_files(random.Random(self.seed), self.files))

    def test_sessions(self):
        self.check(mutation.sessions(random.Random(self.seed), self.sessions, 9))


if __name__ == "__main__":
    unittest.main()
