# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=20 timeout=300
"""Every example of the documentation, then examples with words that are wrong, and damaged STL files: nothing crashes, hangs, fails without a message or prints numbers that are none. New commands are covered as soon as
their pages have examples."""

import concurrent.futures
import os
import random
import sys
import unittest

TESTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
sys.path[:0] = [os.path.join(TESTS, "lib"), os.path.join(TESTS, "sessions")]
import mutation
import robust
from pool import Pool

DOC = os.path.join(os.environ["TALUS_SOURCE_DIR"], "doc")


class Mutations(unittest.TestCase):
    """seed: of what is drawn. The others: how many runs of each kind."""
    seed, lines, files = 20260101, 60, 12

    def check(self, cases):
        def fault(pool, n, what, script, files):
            session = robust.of_script(script, files)
            session.ranks = 2 if n % 12 == 11 else 1
            return what, robust.check(pool.run, session)[0]

        with Pool() as pool, concurrent.futures.ThreadPoolExecutor(2) as threads:
            found = [threads.submit(fault, pool, n, *case) for n, case in enumerate(cases)]
            faults = [future.result() for future in found if future.result()[1]]
        self.assertEqual(faults, [], f"{len(faults)} faults (seed {self.seed}):\n"
                         + "\n\n".join(f"{what}\n    {fault}" for what, fault in faults[:8]))

    def test_commands(self):
        lines = mutation.examples(DOC)
        self.assertGreater(len(lines), 25)
        self.check(mutation.commands(random.Random(self.seed), DOC, len(lines) + self.lines))

    def test_stl_files(self):
        self.check(mutation.stl_files(random.Random(self.seed), self.files))


if __name__ == "__main__":
    unittest.main()
