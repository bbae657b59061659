# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=20 timeout=300
"""run_style verlet/proxy skin chosen: the skin for neighbor lists is the same on any number of ranks and threads, with
any output and after a restart, and only last digits depend on it, in periodic boxes."""

import os
import random
import re
import unittest

from granular_script import head
from talus_testing import SceneCase, Sphere, max_difference, read_dump, thermo, write_sphere_data

GAS = head(boundary="{boundary}") + """
read_data ../grains
pair_style gran/hertz/history/talus 1e5 NULL 50 NULL 0.5 1
pair_coeff * *
neighbor 0.3 bin
run_style verlet/proxy skin {skin}
timestep 1e-3
fix move all nve/sphere
{walls}
{more}
thermo 100
run {steps}
write_dump all custom end id x y z vx vy vz omegax omegay omegaz modify sort id format float %a
"""
WALLS = """
fix x all wall/gran hertz/history 1e5 NULL 50 NULL 0.5 1 xplane 0 30
fix y all wall/gran hertz/history 1e5 NULL 50 NULL 0.5 1 yplane 0 20
fix z all wall/gran hertz/history 1e5 NULL 50 NULL 0.5 1 zplane 0 20
"""
LISTS = """
compute c all coord/atom cutoff 0.99
compute m all reduce sum c_c
compute p all pair/local dist
compute d all reduce sum c_p inputs local
thermo_style custom step ke c_m c_d
thermo_modify norm no
"""


def grains():
    draw = random.Random(11)
    return [Sphere(tuple(2.0 * n + 1.0 for n in (i, j, k)), v=tuple(draw.gauss(0.0, 1.0) for _ in "xyz"), density=1.9)
            for i in range(15) for j in range(10) for k in range(10)]


def chosen(log):
    found = re.search(r"have a skin of (\S+), chosen by what they cost; given: 0.3", log)
    return found and float(found.group(1))


def rebuilds(log):
    return int(re.search(r"Neighbor list builds = (\d+)", log).group(1))


class ChosenSkin(SceneCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), ((0, 30), (0, 20), (0, 20)), grains())

    def gas(self, name, np=1, boundary="p p p", more="", steps=300, skin="chosen", **options):
        where = self.path(name)
        os.makedirs(where, exist_ok=True)
        script = "suffix talus\n" + GAS.format(boundary=boundary, walls=WALLS if boundary == "f f f" else "", more=more,
                                               steps=steps, skin=skin)
        log = self.run_lammps(script, np=np, cwd=where, **options).log
        return read_dump(os.path.join(where, "end"))[0], log

    def test_it_is_the_same_everywhere(self):
        one, log = self.gas("one")
        skin = chosen(log)
        self.assertGreater(skin, 0.5)
        for name, np, more, env in (("two", 2, "", None), ("four", 4, "", None), ("threads", 1, "", {"OMP_NUM_THREADS": "2"}),
                                    ("tiled", 3, "comm_style tiled\nbalance 1.1 rcb", None), ("direct exchange off", 2, "comm_proxy no", None),
                                    ("arrays", 1, "fix look all ave/atom 1 1 1 fx", None), ("lists of LAMMPS", 2, LISTS, None)):
            with self.subTest(name):
                frame, log_here = self.gas(name, np, more=more, env=env)
                self.assertEqual(chosen(log_here), skin)
                self.assertEqual(rebuilds(log_here), rebuilds(log))
                self.assert_same_bits(frame, one)

    def test_given(self):
        """Fewer rebuilds with the chosen one; last digits differ in a periodic box, and none between walls."""
        for boundary, most in (("p p p", 1e-7), ("f f f", 0.0)):
            frame, log = self.gas(f"chosen {boundary}", boundary=boundary)
            given, log_of_given = self.gas(f"given {boundary}", boundary=boundary, skin="given")
            self.assertIsNone(chosen(log_of_given))
            self.assertLess(2 * rebuilds(log), rebuilds(log_of_given))
            if most:
                self.assertLess(max_difference(frame, given, ("vx", "vy", "vz")), most)
            else:
                self.assert_same_bits(frame, given)

    def test_lists_of_lammps_are_complete(self):
        """They are used for as long as those of Talus."""
        rows = [thermo(self.gas(f"lists {skin}", np=2, more=LISTS, boundary="f f f", skin=skin)[1])
                for skin in ("chosen", "given")]
        self.assertGreater(max(row["c_m"] for row in rows[0]), 4)
        self.assertGreater(max(row["c_d"] for row in rows[0]), 1)
        for mine, theirs in zip(*rows, strict=True):
            self.assertEqual(mine["c_m"], theirs["c_m"])
            self.assert_close(mine["c_d"], theirs["c_d"], 1e-9)

    def test_restart(self):
        """The choice is in the file; another skin of the script takes its place."""
        where = self.path("file")
        os.makedirs(where, exist_ok=True)
        _, log = self.gas("file", more="restart 300 half")
        going_on = """
            suffix talus
            read_restart half.300
            pair_style gran/hertz/history/talus 1e5 NULL 50 NULL 0.5 1
            pair_coeff * *
            neighbor {skin} bin
            run_style verlet/proxy skin chosen
            fix move all nve/sphere
            run 0
        """
        self.assertEqual(chosen(self.run_lammps(going_on.format(skin=0.3), np=2, cwd=where).log), chosen(log))
        self.assertIsNone(chosen(self.run_lammps(going_on.format(skin=0.31), cwd=where).log))

    def test_words(self):
        for words, message in (("skin", "Run_style verlet/proxy skin: value is missing"),
                               ("skin wide", "expected chosen or given"),
                               ("range given", "expected overlap or skin instead of 'range'")):
            with self.subTest(words):
                self.run_lammps(f"run_style verlet/proxy {words}", expect_error=message)


if __name__ == "__main__":
    unittest.main()
