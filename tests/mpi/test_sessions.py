# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=60 timeout=600
"""Random sessions with relations that hold whatever they contain; tests/sessions/sessions.py says which, and runs more of them."""

import itertools
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "sessions"))
from sessions import Judge, judge_many, rounds
from pool import Pool


class Sessions(unittest.TestCase):
    """first: round to begin with; count: how many cases, a tenth of a second of one core each."""
    first, count = 0, 400

    def test_relations(self):
        with Pool() as pool:
            judge = Judge(pool)
            faults = judge_many(itertools.islice(rounds(self.first), self.count), 2, judge, lambda fault: print(fault, flush=True))
            self.assertEqual(sum(judge.cases.values()), self.count)
        self.assertEqual(len(faults), 0, "see above; tests/sessions/sessions.py --relation NAME --seed NUMBER makes one case again")


if __name__ == "__main__":
    unittest.main()
