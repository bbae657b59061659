# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=12 timeout=200
"""What contacts remember rests in one place, whoever has them: each once, through chains of restart files, commands that
are defined again, and runs of the stock styles in between."""

import unittest

from talus_testing import SceneCase, Sphere, head, read_dump, write_sphere_data

HEAD = head(boundary="{0} {0} f")
LAW = "hertz/history 40000.0 NULL 400.0 NULL 0.5 1"
OWN = "contact hertz 40000.0 400.0 tangential multistep NULL NULL 0.5"
AGAIN = "\nclear\n" + HEAD.format("f") + "read_restart state\n"
FORCES = """
neighbor 0.2 bin
timestep 0.0005
suffix {suffix}
pair_style gran/""" + LAW + """
pair_coeff * *
fix step all nve/sphere
fix fall all gravity 1.0 vector 0.2 0.1 -1
"""
WALLS = f"fix w all wall/gran {LAW} xplane 0 10\nregion pot block -1 11 0 10 0 14\nfix pot all wall/gran/region {LAW} region pot\n"
FLOOR = f"fix floor all large/body plane 0 0 0  0 0 1 {OWN}\n"
STONE = f"fix stone all large/body sphere 5 5 0.5 1.2 outside {OWN} move rotate 5 5 0.5 0 0 1 4.0\n"
END = "write_dump all custom {} id x y z vx vy vz omegax omegay omegaz fx fy fz modify format float %a\n"


class ContactMemory(SceneCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), ((0, 10), (0, 10), (0, 12)),
                          [Sphere((0.6 + 1.01 * i, 0.6 + 1.01 * j, 0.5 + 0.99 * k), v=(0.1 * ((i + j) % 3 - 1), 0.05 * (k - 1), -0.1))
                           for i in range(9) for j in range(9) for k in range(3) if not (1 < i < 7 and 1 < j < 7)])

    def end(self, script, np=1):
        self.run_lammps(HEAD.format("f") + "read_data grains\n" + script + END.format("end"), np=np)
        frame, = read_dump(self.path("end"))
        return frame

    def test_a_chain_of_restart_files(self):
        """Read, defined and written again without a run: walls are in them in the format of LAMMPS as well."""
        scene = FORCES.format(suffix="talus") + WALLS + STONE
        whole = self.end(scene + "run 900\nrun 300\n")
        for np in 1, 2:
            with self.subTest(ranks=np):
                self.assert_same_bits(self.end(scene + "run 900\nwrite_restart state\n" + (AGAIN + scene + "write_restart state\n") * 3 +
                                               AGAIN + scene + "run 300\n", np), whole)

    def test_defined_again_before_the_first_run(self):
        scene = FORCES.format(suffix="talus") + FLOOR + STONE
        first = scene + "run 900\nwrite_restart state\n" + AGAIN
        self.assert_same_bits(self.end(first + scene + FLOOR + STONE + "run 200\n"), self.end(first + scene + "run 200\n"))

    def test_defined_again_between_two_runs(self):
        """A body that is another one, with the name of the first: its contacts are new ones."""
        scene = FORCES.format(suffix="talus") + FLOOR
        other = FLOOR.replace("floor", "other")
        same, new = (self.end(scene + f"run 2000\nunfix floor\n{body}run 100\n") for body in (FLOOR, other))
        self.assert_same_bits(same, new)
        kept = self.end(scene + "run 2000\nrun 100\n")
        self.assertFalse(kept.atoms == new.atoms, "there is no friction yet")

    def test_stock_styles_in_between(self):
        """The file of a run of the stock pair style, with a body: contacts between spheres are what that style has written."""
        def scene(suffix):
            return FORCES.format(suffix=suffix) + FLOOR + STONE + "run 600\nwrite_restart state\n"

        mixed, stock = (self.end(scene(first) + AGAIN + scene("off") + AGAIN + scene(last))
                        for first, last in (("talus", "talus"), ("off", "off")))
        for tag, row in stock.atoms.items():
            for mine, theirs in zip(mixed.atoms[tag], row):
                self.assertLess(abs(mine - theirs), 1e-6 * max(1.0, abs(theirs)), tag)

    def test_added_before_all_others(self):
        """A fix that adds particles stands before the pair style: ranks to which it adds none do not wait for ever."""
        boxes = HEAD.format("p") + """
region box block 0 10 0 10 0 16 units box
create_box 1 box
lattice sc 0.7
region low block 0.3 9.7 0.3 9.7 0.6 4 units box
create_atoms 1 region low
region top block 1 9 1 9 10 15 units box
fix more all deposit 20 1 20 77 region top near 1.3 vz -2 -2
neighbor 0.2 bin
timestep 0.0005
pair_style gran/penalty
""" + f"pair_coeff * * {OWN.replace('contact ', '')}\nfix s all shape/gran type 1 box 0.8 0.7 0.6 density 1\n" + \
            f"fix fall all gravity 5 vector 0.3 0 -1\n{FLOOR}thermo 100\nrun 500\n"
        for np in 1, 2, 4:
            with self.subTest(ranks=np):
                self.assertIn("Loop time of", self.run_lammps(boxes, np=np).log)


if __name__ == "__main__":
    unittest.main()
