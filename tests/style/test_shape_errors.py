# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120 stay
"""fix shape/gran: every wrong word, and all that would take its particles for spheres, ends in one message that names it."""

import os
import re
import unittest

from talus_testing import SceneCase, Sphere, head, marked_word, ranks_of_refusal, write_sphere_data

SCENE = head() + """
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
ORDER = "ERROR: Fix shape/gran: contacts of shapes are of first order: use 'order 1' in all fixes nve/sphere/symplectic " \
        "and rigid/small/symplectic"
OF_SPHERES = "knows contacts of spheres only: use"
PRE_NO = "(shape/gran) has been defined since the last set-up"


class ShapeErrors(SceneCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), 3 * ((-9, 9),), [Sphere((-3, 0, 0)), Sphere((3, 0, 0), type=2)])

    def error(self, number, commands, pair="hooke 1e4 10"):
        """The message; the log is in self.log."""
        for np in ranks_of_refusal(number):
            self.log = self.run_lammps(SCENE.format(commands=commands, pair=pair), np=np, expect_error=True).log
            errors = [line for line in self.log.splitlines() if line.startswith("ERROR")]
            self.assertTrue(errors, self.log[-1000:])
        return " ".join(errors[0].split())

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
                ("type 2 ellipsoid 1 0 1 density 1", "ellipsoid b"),
                ("type 2 ellipsoid 1 1 1 rounded 0.1 density 1", "unknown keyword 'rounded'"),
                ("type 2 superellipsoid 1 1 1 1.5 2 density 1", "the exponent n1 is 1.5 and must be between 2 (round) and 20"),
                ("type 2 superellipsoid 1 1 1 4 density 1", "superellipsoid n2"),
                ("type 2 superellipsoid 1 1 1 4 2 density 1 curvature flat", "unknown curvature 'flat', expected mean, gaussian or volume"),
                ("type 2 vertices 4 0 0 0 1 0 0 0 1 0 1 1 0 density 1", "in one plane"),
                ("type 2 vertices 5 0 0 0 1 0 0 0 1 0 0 0 1 .1 .1 .1 density 1", "vertex 5"))):
            with self.subTest(words):
                error = self.error(number, f"fix s all shape/gran {words}")
                self.assertIn(expected, error)

    def test_mpr_without_libccd(self):
        commands = f"{FIX} contacts mpr"
        if os.environ["TALUS_CCD"] == "1":
            self.assertNotIn("ERROR", self.run_lammps(SCENE.format(commands=commands, pair="hooke 1e4 10")).log)
        else:
            self.assertIn("contacts: this Talus was built without libccd, which mpr needs: use 'contacts features', or install "
                          "libccd (Debian: libccd-dev) and build Talus again", self.error(0, commands))

    def test_companions(self):
        hooke = "contact hooke 1e4 10"
        for number, (commands, expected, *pair) in enumerate((
                (f"{FIX}\nfix t all shape/gran {BOX}", "can be used only once"),
                (f"{FIX}\nfix 1 all nve/sphere/symplectic", "group of another fix that moves particles"),
                (f"{FIX}\nfix 1 all nve/sphere", "group of another fix that moves particles"),
                (f"{FIX}\nfix 1 balls nve/sphere/symplectic order 2", ORDER),
                (f"{FIX}\nfix 1 balls nve/sphere/symplectic order 2", ORDER,
                 "hooke 1e4 10 tangential multistep 2e3 5 0.5 slider midpoint"),
                (f"{FIX}\nfix w all wall/gran granular hooke 1e4 10 tangential linear_nohistory 0 0 zplane 0 NULL",
                 "fix large/body"),
                (f"{FIX}\nfix w all large/body cylinder 0 0 0 0 0 1 8 8 open {hooke}", "use plane, rectangle, box, sphere, cylinder or cone without 'open', or mesh"),
                (f"{FIX}\nfix w all large/body plane 0 0 -9 0 0 1 {hooke} tangential multistep NULL NULL 0.5 rolling 0.1", "rolling"),
                (f"{FIX}\ncompute c all pair/local dist",
                 f"compute c (pair/local) {OF_SPHERES} compute contact/gran/local"),
                (f"{FIX}\ncompute c all contact/atom",
                 f"compute c (contact/atom) {OF_SPHERES} compute contact/gran/atom"),
                (f"{FIX}\ncompute c all fabric radius contact",
                 f"compute c (fabric) {OF_SPHERES} the normals of compute contact/gran/local"),
                (f"{FIX}\ncompute c balls group/group dice",
                 f"compute c (group/group) {OF_SPHERES} the rows of compute contact/gran/local"),
                (f"{FIX}\nminimize 0 1e-4 10 10", "minimize"),
                (f"{FIX}\nrun_style respa 1", "respa"),
                (f"{FIX}\npair_style hybrid/overlay zero 0.1 gran/penalty\npair_coeff * * zero\n"
                 "pair_coeff * * gran/penalty hooke 1e4 10", "hybrid"),
                (FIX, "rolling or twisting resistance", "hooke 1e4 10 tangential multistep NULL NULL 0.5 rolling 0.1"),
                (f"{FIX}\nfix p all pour 10 2 4711 vol 0.2 10 diam one 1.0 region top", "give it a diameter of 1.73205"),
                (f"run 1\n{FIX}\nrun 1 pre no", PRE_NO),
                (f"run 1\n{FIX}\nwrite_restart first\nrun 1 pre no", PRE_NO),
                (f"run 2 pre no every 1 '{FIX}'", PRE_NO))):
            if "fix p" in commands:
                commands = "region top block -5 5 -5 5 5 8 units box\nfix g all gravity 1 vector 0 0 -1\n" + commands
            with self.subTest(commands):
                error = self.error(number, commands, *pair)
                self.assertIn(expected, error)

    def test_particles_deleted_before_the_fix(self):
        """What a restart file holds for a fix waits in the order of the particles of the file."""
        hooke = SCENE.format(commands=f"{FIX}\nrun 1\nwrite_restart state", pair="hooke 1e4 10")
        again = head() + "read_restart state\n{}pair_style gran/penalty\npair_coeff * * hooke 1e4 10\n" + f"{FIX}\nrun 1\n"
        remember = "fix floor all large/body plane 0 0 -9  0 0 1 contact hooke 1e4 10 tangential multistep NULL NULL 0.5\n"
        self.run_lammps(hooke)
        self.run_lammps(again.format(""))
        for np in 1, 2:
            delete = "group one id 1\ndelete_atoms group one\n"
            log = self.run_lammps(again.format(delete), np=np, expect_error=True).log
            self.assertIn("ERROR: Pair style gran/penalty: particles were added or deleted between read_restart and the first "
                          "run, so that contact history cannot be assigned", log)
            log = self.run_lammps(again.format(remember + delete), np=np, expect_error=True).log
            self.assertRegex(log, "ERROR: Fix shape/gran s: particles were added or deleted between read_restart and this "
                                  "command, so that orientations cannot be assigned: define the fix right after read_restart")

    def test_modify(self):
        orient, picture = "fix_modify s orient ", "fix_modify s picture "
        for number, (words, expected, word) in enumerate((
                (f"{orient}1 1 0 0 0", "no particle with this ID has a shape", "1"),
                (f"{orient}77 1 0 0 0", "no particle with this ID has a shape", "77"),
                (f"{orient}0 1 0 0 0", "ID of a particle", "0"),
                (f"{orient}2 1 0 up 0", "expected w x y z (a number) instead of 'up'", "up"),
                (f"{orient}2 0 0 0 0.0", "a quaternion must not be zero", "0.0"),
                (f"{orient}2 1 0 0", "missing w x y z", "0"),
                ("fix_modify s dynamic/dof yes orient 77 1 0 0 0", "no particle with this ID has a shape", "77"),
                (f"{picture}nope 1", "there is no other fix with this ID: define it before", "nope"),
                (f"{picture}s 1", "there is no other fix with this ID: define it before", "s"),
                (f"{picture}b 0", "type N", "0"),
                (f"{picture}b 3", "there are 2 types: give a larger number to create_box", "3"),
                (f"{picture}b", "missing type N", "b"))):
            with self.subTest(words):
                error = self.error(number, f"{FIX}\nfix b balls nve/sphere/symplectic\n{words}")
                self.assertRegex(error, f"^ERROR: fix_modify shape/gran (orient|picture): .*{re.escape(expected)}")
                self.assertEqual(marked_word(self.log), word)


if __name__ == "__main__":
    unittest.main()
