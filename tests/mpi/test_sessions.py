# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=60 timeout=600
"""Random sessions with relations that hold whatever they contain; tests/sessions/sessions.py says which, and runs more of them."""

import itertools
import os
import random
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "sessions"))
from sessions import Judge, judge_many, rounds    # first: sets the path
import same_bits
import scenes
from pool import CRASH, ERROR, HANG, OK, Pool, Session
from shrink import shrink


class Tools(unittest.TestCase):
    """That faults are seen."""

    def test_outcomes(self):
        with Pool() as pool:
            for ranks in 1, 2:
                for lines, limit, kind in ((["units lj"], 60, OK), (["@abort"], 60, CRASH), (["units moon"], 60, ERROR),
                                           (["@sleep 60"], 1, HANG), (["units lj", "@sleep 0.1"], 60, OK)):
                    self.assertEqual(pool.run(Session(lines, ranks), limit=limit).kind, kind, f"{lines} on {ranks}")

    def test_stock_styles_have_other_bits_on_other_ranks(self):
        """And that the scene becomes small."""
        grid = (("ranks", 2),)
        with Pool() as pool:
            drawn = (scenes.of_the_host(random.Random(seed)).but(words=(), program=(("run", 60),)) for seed in range(20))
            tried = ((scene, same_bits.check(pool.run, scene, grid)[0]) for scene in drawn)
            scene, fault = next(((scene, fault) for scene, fault in tried if fault), (None, ""))
            self.assertRegex(fault, "^other bits")
            (smaller, _), fault = shrink(same_bits, pool.run, (scene, grid), fault, 4.0)
            self.assertRegex(fault, "^other bits")
            self.assertLess(len(smaller.grains), len(scene.grains))


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
