# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Sums, gathers and messages of more values than MPI counts, with a smaller limit."""

import os
import unittest

from talus_testing import SceneCase, run_program


class LargeMessages(SceneCase):

    def test_pieces(self):
        program = os.path.join(os.environ["TALUS_BINARY_DIR"], "tests", "large_messages_check")
        for np in 1, 2, 4:
            with self.subTest(ranks=np):
                self.assertIn("all right", run_program(program, np=np, cwd=self.dir).output)


if __name__ == "__main__":
    unittest.main()
