# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Every refusal of fix rigid/small/symplectic: its text, and the word it points at, on 1 and 2 ranks."""

import re
import unittest

from talus_testing import SceneCase, marked_word, ranks_of_refusal

FIX = "fix move pairs rigid/small/symplectic molecule"
TITLE = "Fix rigid/small/symplectic move: "
MOVED = TITLE + r"of the spheres of its clumps 4 are in the group of fix other \({}\), which "

BOX = """
units si
boundary p p p
atom_style {style}
atom_modify {map}
comm_modify vel yes
newton off
fix which all property/atom mol ghost yes
region box block -4 4 -4 4 -4 4
create_box 1 box
create_atoms 1 single -2 0 0
create_atoms 1 single -1.5 0 0
create_atoms 1 single 1.5 0 0
create_atoms 1 single 2 0 0
set group all diameter {size} mass 1
set atom 1*2 mol 1
set atom 3*4 mol 2
group pairs id 1:4
pair_style gran/penalty
pair_coeff * * hooke 1000 1 tangential multistep NULL NULL 0.5
neigh_modify exclude molecule/intra all
neighbor 0.1 bin
timestep 1e-4
thermo_style custom step
"""

# words after FIX, what the message says, the word it points at
BAD_WORDS = [
    ("foo", "unknown keyword 'foo', expected start, order, gravity, mol, infile or reinit", "foo"),
    ("start half start plain", "keyword 'start' given twice", "start"),
    ("start", "start: missing value: half or plain", "start"),
    ("order 3", "order: unknown value '3', expected 1 or 2", "3"),
    ("gravity 9.81 down", "gravity: unknown direction 'down', expected chute, spherical or vector", "down"),
    ("gravity v_g chute 1", "gravity: expected a constant for magnitude instead of variable 'v_g'", "v_g"),
    ("mol", "mol: missing ID of a molecule template", "mol"),
    ("infile", "infile: missing name of a file", "infile"),
    ("reinit", "reinit: missing yes or no", "reinit"),
    ("langevin 1 1 1 4711", "unknown keyword 'langevin'", "langevin"),
]

# commands, what the message says
REFUSED = [
    (f"{FIX} mol pebble", "Molecule template ID pebble for fix rigid/small/symplectic does not exist"),
    (f"molecule pebble pebble.mol\n{FIX} mol pebble", TITLE + "spheres of molecule template pebble have no masses: give it a "
     "section Masses"),
    (f"{FIX}\nfix other all nve/sphere", MOVED.format("nve/sphere") + "moves them as well: give it another group"),
    (f"{FIX}\nfix other all freeze", MOVED.format("freeze") + "freezes them, but they move: give it another group"),
    (f"{FIX} gravity 9.81 vector 0 0 -1\nfix other all gravity 9.81 vector 0 0 -1",
     MOVED.format("gravity") + "lets them fall a second time: leave the word gravity out, or use 'disable' there"),
    (f"{FIX} order 2", TITLE.replace("move", "order 2") + "the contact of types 1 and 1 has damping that may attract"),
    (f"{FIX} order 2 start plain", "Fix rigid/small/symplectic order 2: velocities of 'start plain' .* use 'start half'"),
    (f"group other id > 4\n{FIX} order 2\nfix second other nve/sphere/symplectic start half",
     r"Fix rigid/small/symplectic order 2: fix second \(nve/sphere/symplectic\) moves particles as well, with order 1: use order 1,"),
    (f"{FIX} order 2\nregion ball sphere 0 0 0 9\n"
     "fix wall all wall/gran/region hooke 1000 NULL 1 NULL 0.5 1 region ball",
     r"Fix rigid/small/symplectic order 2: contacts with fix wall \(wall/gran/region\) are of first order: use fix large/body"),
    (f"{FIX}\nrun_style respa 2 2", TITLE + "run_style respa has levels: use fix rigid/small"),
    (f"{FIX}\ngroup gone id 1\ndelete_atoms group gone compress no",
     TITLE + "spheres of clumps are missing or have new IDs, in that of particle 2: .*'mol yes' and 'compress no'"),
    (f"{FIX}\ngroup gone id 1 2\ndelete_atoms group gone", TITLE + "spheres of clumps are missing or have new IDs"),
    # the largest ID, which the map of LAMMPS does not reach afterwards
    (f"create_atoms 1 single 1.75 0 0\nset atom 5 mol 2 mass 1 diameter 0.5\ngroup pairs id 5\n{FIX}\nrun 0\ngroup gone id 5\n"
     "delete_atoms group gone compress no", TITLE + "spheres of clumps are missing or have new IDs, in that of particle 3"),
    (f"{FIX}\nfix_modify move bodyforces early", TITLE + "'fix_modify bodyforces early' is set: use fix rigid/small"),
]


PEBBLE = """A clump without masses

2 atoms

Coords

1 0 0 0
2 0.5 0 0

Types

1 1
2 1

Diameters

1 0.8
2 0.8
"""


class ClumpErrors(SceneCase):

    def setUp(self):
        self.write("pebble.mol", PEBBLE)

    def refuse(self, np, commands, expected, run="run 1", style="sphere", size="0.8", map="map array"):
        log = self.run_lammps(BOX.format(style=style, size=size, map=map) + commands + "\n" + run, np=np,
                              expect_error=True).log
        errors = re.findall(r"^ERROR(?: on proc \d+)?: (.*)$", log, re.MULTILINE)
        self.assertEqual(len(errors), 1, log[-2000:])
        self.assertRegex(errors[0], expected)
        return log

    def test_words(self):
        for n, (words, text, word) in enumerate(BAD_WORDS):
            for np in ranks_of_refusal(n):
                with self.subTest(words, ranks=np):
                    log = self.refuse(np, f"{FIX} {words}", "fix rigid/small/symplectic:? .*" + text)
                    self.assertEqual(marked_word(log), word)
        for words, text in (("", "missing kind of bodies: molecule or custom"), ("group", "unknown kind of bodies 'group', "
                                                                               "expected molecule or custom"),
                            ("custom", "missing i_name or v_name")):
            with self.subTest(words):
                self.refuse(2, f"fix move pairs rigid/small/symplectic {words}", text)

    def test_settings(self):
        for n, (commands, text) in enumerate(REFUSED):
            for np in (1, 2):
                with self.subTest(commands, ranks=np):
                    self.refuse(np, commands, text)
        self.refuse(2, FIX, "requires an atom map, see atom_modify", map="sort 0 0")
        self.refuse(2, FIX, TITLE + "there are no time steps in a minimization", run="minimize 0 0 1 1")

    def test_gravity_that_is_disabled_is_no_second_one(self):
        self.run_lammps(BOX.format(style="sphere", size="0.8", map="map array") + f"{FIX} gravity 9.81 vector 0 0 -1\n"
                        "fix other all gravity 9.81 vector 0 0 -1 disable\nrun 1")


if __name__ == "__main__":
    unittest.main()
