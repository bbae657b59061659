# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""fix shape/gran: every wrong word, and all that would take its particles for spheres, ends in one message that names it."""

import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "lib"))
from talus_testing import SceneCase, Sphere, ranks_of_refusal, write_sphere_data

SCENE = """
units lj
boundary f f f
atom_style sphere
atom_modify map yes
newton off
comm_modify vel yes
read_data grains
group balls type 1
group dice type 2
neighbor 0.2 bin
pair_style gran/penalty
pair_coeff * * {pair}
timestep 1e-3
{commands}
run 1
"""
BOX = "type 2 box 1 1 1 density 1"
FIX = f"fix s all shape/gran {BOX}"


class ShapeErrors(SceneCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), 3 * ((-9, 9),), [Sphere((-3, 0, 0)), Sphere((3, 0, 0), type=2)])

    def error(self, number, commands, pair="hooke 1e4 10"):
        for np in ranks_of_refusal(number):
            log = self.run_lammps(SCENE.format(commands=commands, pair=pair), np=np, expect_error=True).log
        return " ".join(next(line for line in log.splitlines() if line.startswith("ERROR")).split())

    def test_words(self):
        path = self.path("open.stl")
        with open(path, "w") as file:
            file.write("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
                       "endsolid x\n")
        for number, (words, expected) in enumerate((
                ("", "no shape is given"),
                ("box 1 1 1", "unknown keyword 'box'"),
                ("type 3 box 1 1 1 density 1", "3"),
                ("type 2 ball 1", "unknown shape 'ball'"),
                ("type 2 box 1 0 1 density 1", "box b"),
                ("type 2 box 1 1 1", "add 'density rho'"),
                ("type 2 box 1 1 1 density 1 color 3", "unknown keyword 'color'"),
                ("type 2 box 1 1 1 density 1 scale 2", "scale is for polyhedron and vertices"),
                ("type 2 box 1 1 1 density 1 rounded -0.1", "rounded r"),
                ("type 2 box 1 1 1 density 1 orient quat 0 0 0 0", "must not be zero"),
                ("type 2 box 1 1 1 density 1 orient up", "unknown orientation 'up'"),
                ("type 2 box 1 1 1 density 1 type 2 box 1 1 1 density 1", "has a shape already"),
                ("type 2 polyhedron nothing.stl density 1", "cannot read the file 'nothing.stl'"),
                ("type 2 polyhedron open.stl density 1", "'open.stl': "),
                ("type 2 vertices 4 0 0 0 1 0 0 0 1 0 1 1 0 density 1", "in one plane"),
                ("type 2 vertices 5 0 0 0 1 0 0 0 1 0 0 0 1 .1 .1 .1 density 1", "vertex 5"))):
            with self.subTest(words):
                error = self.error(number, f"fix s all shape/gran {words}")
                self.assertIn(expected, error)

    def test_companions(self):
        hooke = "contact hooke 1e4 10"
        for number, (commands, expected, *pair) in enumerate((
                (f"{FIX}\nfix t all shape/gran {BOX}", "can be used only once"),
                (f"{FIX}\nfix 1 all nve/sphere/symplectic", "group of another fix that moves particles"),
                (f"{FIX}\nfix 1 all nve/sphere", "group of another fix that moves particles"),
                (f"{FIX}\nfix 1 balls nve/sphere/symplectic order 2", "order"),
                (f"{FIX}\nfix w all wall/gran granular hooke 1e4 10 tangential linear_nohistory 0 0 zplane 0 NULL",
                 "fix large/body"),
                (f"{FIX}\nfix w all large/body cylinder 0 0 0 0 0 1 8 8 open {hooke}", "use plane, rectangle, box, sphere, cylinder or cone without 'open', or mesh"),
                (f"{FIX}\nfix w all large/body plane 0 0 -9 0 0 1 {hooke} tangential multistep NULL NULL 0.5 rolling 0.1", "rolling"),
                (f"{FIX}\ncompute c all pair/local dist", "use compute contact/gran/local"),
                (f"{FIX}\nminimize 0 1e-4 10 10", "minimize"),
                (f"{FIX}\nrun_style respa 1", "respa"),
                (f"{FIX}\npair_style hybrid gran/penalty\npair_coeff * * gran/penalty hooke 1e4 10", "hybrid"),
                (FIX, "rolling or twisting resistance", "hooke 1e4 10 tangential multistep NULL NULL 0.5 rolling 0.1"),
                (f"{FIX}\nfix p all pour 10 2 4711 vol 0.2 10 diam one 1.0 region top", "give it a diameter of 1.73205"),
                (f"{FIX}\nfix_modify s orient 1 1 0 0 0", "no particle with this ID has a shape"))):
            if "fix p" in commands:
                commands = "region top block -5 5 -5 5 5 8 units box\nfix g all gravity 1 vector 0 0 -1\n" + commands
            with self.subTest(commands):
                error = self.error(number, commands, *pair)
                self.assertIn(expected, error)


if __name__ == "__main__":
    unittest.main()
