# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=15 label=smoke timeout=300
"""The main scene, input/in.settling, at a small size: what it promises in its summary, what it
writes, and the same particles with the same bits on any number of ranks."""

import glob
import os
import re
import unittest

from talus_testing import *

SCENE = os.path.join(os.environ["TALUS_SOURCE_DIR"], "input", "in.settling")
SPHERES = 600
FINAL_STATE = """
write_dump all custom final.dump id diameter x y z vx vy vz omegax omegay omegaz &
    modify format float %a
"""


def summary(log):
    """{words: number} of the lines behind '--- settled bed ---'."""
    text = log.rsplit("--- settled bed ---", 1)[1]
    lines = re.findall(r"^([a-zA-Z /-]+?) {2,}(\S+)", text, re.MULTILINE)
    return {name: float(value) for name, value in lines}


class SettlingScene(SceneCase):
    def settle(self, np, **variables):
        cwd = self.path(f"np{np}")
        os.makedirs(cwd)
        with open(SCENE) as file:
            script = file.read() + FINAL_STATE
        result = run_lammps(script, np=np, cwd=cwd, timeout=250,
                            variables={"n": SPHERES, "out": ".", **variables})
        return result, read_dump(os.path.join(cwd, "final.dump"))[-1]

    def test_bed_comes_to_rest_on_its_floor_and_walls(self):
        result, _ = self.settle(2)
        bed = summary(result.log)
        print(bed)
        self.assertEqual(bed["particles"], SPHERES)
        self.assertGreater(bed["contacts"], 1.5 * SPHERES)
        self.assertLess(bed["largest overlap / radius"], 0.03)
        self.assertAlmostEqual(bed["vertical force on floor and walls/weight"], 1.0, delta=0.01)
        self.assertIn("of the critical one", result.log)
        self.assertEqual(re.findall("WARNING.*", result.log), [])
        self.assertRegex(result.log, "steps without output +in the records")
        pictures = glob.glob(os.path.join(result.workdir, "settling.*.png"))
        self.assertGreaterEqual(len(pictures), 4)
        for picture in pictures:
            with open(picture, "rb") as file:
                self.assertEqual(file.read(8), b"\x89PNG\r\n\x1a\n")
        self.assertTrue(os.path.getsize(os.path.join(result.workdir, "settling.restart")))

    def test_same_bits_on_any_number_of_ranks(self):
        frames = [self.settle(np, time=0.06)[1] for np in (1, 2, 4)]
        for other in frames[1:]:
            self.assert_same_bits(frames[0], other)
        moved = max(abs(v) for v in frames[0].column("vz").values())
        self.assertGreater(moved, 0.0)


if __name__ == "__main__":
    unittest.main()
