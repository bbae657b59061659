# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""fix large/body region follows regions that move, turn, and are defined anew between runs: against fix wall/gran/region,
against a body of the same shape and motion, and with the same bits on any ranks and across a restart."""

import math
import random
import unittest

from talus_testing import SceneCase, Sphere, begin, max_difference, read_dump, thermo, write_sphere_data

START = begin(read="{read}", law="hooke 1e4 20 tangential dashpot 20 0.5", skin=0.2, dt=0.001) + """
fix step all nve/sphere/symplectic gravity 9.81 vector 0 0 -1
variable z equal 0.3*sin(0.008*step)
variable x equal 0.2*sin(0.005*step)
variable theta equal 0.003*step
"""
LAW = "contact hooke 1e4 20 tangential dashpot 20 0.5"
BLOCK = "block -1.6 1.6 -1.6 1.6 -1.6 1.6"
MOVED = f"region its {BLOCK} move v_x NULL v_z\n"
TURNED = f"region its {BLOCK} rotate v_theta 0.3 0 0.1 0 1 0\n"
OUTPUT = """
thermo_style custom step f_body[3] f_body[7] f_body[9] f_body[14] f_body[16] f_body[18] f_body[20]
thermo_modify format float %.15g
thermo 100
dump atoms all custom 200 {name}.* id x y z vx vy vz omegax omegay omegaz
dump_modify atoms format float %a
"""
COLUMNS = ["x", "y", "z", "vx", "vy", "vz", "omegax", "omegay", "omegaz"]


def grains():
    draw = random.Random(4)
    return [Sphere((0.95 * i, 0.95 * j, 0.95 * k), v=tuple(draw.gauss(0, 0.5) for _ in "xyz"),
                   diameter=draw.uniform(0.7, 0.9))
            for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)]


class Regions(SceneCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), ((-5, 5), (-5, 5), (-5, 5)), grains())

    def frame(self, name, commands, steps=400, **options):
        output = OUTPUT if "fix body" in commands else OUTPUT[OUTPUT.index("dump"):]
        log = self.run_lammps(START.format(read="read_data grains") + commands + output.format(name=name) +
                              f"run {steps}\n", name=name, **options).log
        return read_dump(self.path(f"{name}.{steps}"))[0], thermo(log)

    def test_moves_as_with_the_stock_fix(self):
        ours, rows = self.frame("ours", MOVED + f"fix body all large/body region its {LAW}\n")
        stock, _ = self.frame("stock", MOVED + "fix wall all wall/gran/region hooke 1e4 0 20 20 0.5 1 region its\n")
        # until collisions have made rounding larger
        self.assertLess(max_difference(ours, stock, COLUMNS), 1e-7)
        last, dt = rows[-1], 0.001
        self.assertGreater(max(row["f_body[20]"] for row in rows), 2)
        self.assertAlmostEqual(last["f_body[9]"], 0.3 * math.sin(8 * 0.4), delta=1e-12)
        self.assertAlmostEqual(last["f_body[16]"], 0.3 * (math.sin(3.2) - math.sin(3.2 - 8 * dt)) / dt, delta=1e-9)

    def test_turns_as_a_body_does(self):
        ours, rows = self.frame("ours", TURNED + f"fix body all large/body region its {LAW}\n", 200)
        box, _ = self.frame("box", f"fix body all large/body box 0 0 0 3.2 3.2 3.2 inside {LAW} "
                                   f"move rotate 0.3 0 0.1 0 1 0 {2 * math.pi / 3!r}\n", 200)
        self.assertLess(max_difference(ours, box, COLUMNS), 1e-6)
        self.assertGreater(max(row["f_body[20]"] for row in rows), 2)
        self.assertAlmostEqual(rows[-1]["f_body[18]"], 3.0, delta=1e-10)
        self.assertEqual((rows[-1]["f_body[7]"], rows[-1]["f_body[9]"]), (0.3, 0.1))

    def test_a_region_defined_anew_is_followed(self):
        commands = f"region its {BLOCK}\nfix body all large/body region its {LAW}\n" + OUTPUT.format(name="its")
        rows = thermo(self.run_lammps(
            START.format(read="read_data grains") + commands + "run 100\nregion its delete\n" + TURNED +
            f"run 100\nregion its delete\nregion its {BLOCK} move v_x NULL NULL\nrun 100\n"
            f"region its delete\nregion its {BLOCK}\nrun 100\n", np=2).log)
        at = {(n, row["Step"]): row for n, row in enumerate(rows)}
        speeds = [(row["f_body[14]"], row["f_body[18]"]) for row in at.values()]
        self.assertEqual(len(speeds), 8)
        self.assertEqual(speeds[1], (0, 0))
        self.assertAlmostEqual(speeds[3][1], 3.0, delta=1e-10)
        self.assertAlmostEqual(speeds[5][0], math.cos(5 * 0.3), delta=3e-3)
        self.assertEqual(speeds[5][1], 0.0)
        self.assertEqual(speeds[7], (0, 0))

    def test_same_bits_on_any_ranks_and_across_a_restart(self):
        both = MOVED.replace("\n", " rotate v_theta 0 0 0 0 1 0\n")
        law = LAW.replace("dashpot 20", "multistep 3e3 20")
        one, _ = self.frame("one", both + f"fix body all large/body region its {law}\n")
        for np in (2, 4):
            many, _ = self.frame(f"np{np}", both + f"fix body all large/body region its {law}\n", np=np)
            self.assert_same_bits(one, many, COLUMNS)
        self.frame("half", both + f"fix body all large/body region its {law}\nrun 200\nwrite_restart half\n", 400)
        again = START.format(read="read_restart half")
        log = self.run_lammps(again + both + f"fix body all large/body region its {law}\n" +
                              OUTPUT.format(name="again") + "run 200\n", np=2).log
        self.assertNotIn("another kind of motion", log)
        self.assert_same_bits(one, read_dump(self.path("again.400"))[0], COLUMNS)

    def test_refusals(self):
        breathing = "variable r equal 3\nregion its sphere 0 0 0 v_r\n"
        parts = MOVED.replace("its", "part") + f"region rest sphere 0 0 0 3\nregion its union 2 part rest\n"
        own = " move linear 1 0 0"
        cases = ((breathing, "", "region 'its' changes its shape"), (parts, "", "parts of region 'its' move"),
                 (MOVED, own, "region 'its' moves, and the body has a motion as well"))
        for k, (region, motion, message) in enumerate(cases):
            body = f"fix body all large/body region its {LAW}{motion}\n"
            for commands in (region + body, f"region its {BLOCK}\n{body}run 1\nregion its delete\n{region}"):
                with self.subTest(commands):
                    log = self.run_lammps(START.format(read="read_data grains") + commands + "run 1\n", np=1 + k % 2,
                                          expect_error=True).log
                    errors = [line for line in log.splitlines() if line.startswith("ERROR")]
                    self.assertEqual(len(errors), 1)
                    self.assertIn(message, errors[0])


if __name__ == "__main__":
    unittest.main(verbosity=2)
