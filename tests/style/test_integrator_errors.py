# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=30 stay
"""Every refusal of fix nve/sphere/symplectic: its text, the word it points at, on 1 and 2 ranks."""

import re
import unittest

from talus_testing import SceneCase, marked_word

FIX = "fix step all nve/sphere/symplectic"
GRAVITY = FIX + " gravity 9.81 vector 0 0 -1"
G = "Fix nve/sphere/symplectic gravity: "

BOX = """
units si
dimension {dimension}
boundary p p p
atom_style {style}
atom_modify map yes
comm_modify vel yes cutoff 2
newton off
region box block -4 4 -4 4 -0.5 0.5
create_box 1 box
create_atoms 1 single -2 0 0
create_atoms 1 single 2 0 0
{sizes}
group left id 1
group right id 2
pair_style none
"""
SPHERES = "set group all diameter 1 density 1"

# words after FIX, what the message says, the word it points at
BAD_WORDS = [
    ("foo", "unknown keyword 'foo', expected start, order, gravity, orientation or disc", "foo"),
    ("start half 0.5", "unknown keyword '0.5', expected start, ", "0.5"),
    ("start half start plain", "keyword 'start' given twice", "start"),
    ("start", "start: missing value: half or plain", "start"),
    ("start full", "start: unknown value 'full', expected half or plain", "full"),
    ("order", "order: missing value: 1 or 2", "order"),
    ("order 3", "order: unknown value '3', expected 1 or 2", "3"),
    ("orientation", "orientation: missing value: yes or no", "orientation"),
    ("orientation maybe", "orientation: unknown value 'maybe', expected yes or no", "maybe"),
    ("orientation yes", "orientation: expected an atom style with a quaternion or a dipole", "yes"),
    ("disc", "disc: expected a 2d simulation", "disc"),
    ("gravity", "gravity: missing magnitude", "gravity"),
    ("gravity 1", "gravity: missing direction: chute, spherical or vector", "1"),
    ("gravity up chute 1", r"gravity: expected magnitude \(a number\) instead of 'up'", "up"),
    ("gravity v_g chute 1", "gravity: expected a constant for magnitude instead of variable "
     "'v_g'", "v_g"),
    ("gravity 1e999 chute 1", r"gravity: expected magnitude \(a number\) instead of '1e999'",
     "1e999"),
    ("gravity nan chute 1", r"gravity: expected magnitude \(a number\) instead of 'nan'", "nan"),
    ("gravity 1 down", "gravity: unknown direction 'down', expected chute, spherical or vector", "down"),
    ("gravity 1 chute", "gravity: missing angle in degrees", "chute"),
    ("gravity 1 chute steep", r"gravity: expected angle in degrees \(a number\) instead of 'steep'", "steep"),
    ("gravity 1 chute v_a", "gravity: expected a constant for angle in degrees instead of "
     "variable 'v_a'", "v_a"),
    ("gravity 1 spherical 10", "gravity: missing theta in degrees", "10"),
    ("gravity 1 spherical x 10", r"gravity: expected phi in degrees \(a number\) instead of 'x'",
     "x"),
    ("gravity 1 spherical 10 v_t", "gravity: expected a constant for theta in degrees", "v_t"),
    ("gravity 1 vector 0 1", "gravity: missing component z", "1"),
    ("gravity 1 vector a 0 1", r"gravity: expected component x \(a number\) instead of 'a'", "a"),
    ("gravity 1 vector 0 b 1", r"gravity: expected component y \(a number\) instead of 'b'", "b"),
    ("gravity 1 vector 0 1 v_z", "gravity: expected a constant for component z", "v_z"),
    ("gravity 1 vector 0.0 0 0", "gravity: the direction must not be zero", "0.0"),
    ("gravity 1 vector 0 0 -1 2", "unknown keyword '2', expected start, ", "2"),
]

# lines after the box, what the message says
REFUSED = [
    (f"{FIX}\nset group right diameter 0\nrun 0",
     "expected spheres of non-zero radius, but 1 members of group all have none"),
    (f"{FIX}\nminimize 0 0 1 1", "cannot be used with minimize"),
    (f"{FIX}\nrun_style respa 2 2\nrun 0", "cannot be used with run_style respa: no inner levels"),
    (f"{GRAVITY}\nfix other right gravity 1 chute 0\nrun 0",
     G + r"fix other \(gravity\) acts on 1 members of group all: gravity would act twice"),
    (f"{GRAVITY}\nfix other right nve/sphere/symplectic gravity 1 chute 0\nrun 0",
     G + r"fix other \(nve/sphere/symplectic\) acts on 1 members of group all: gravity would act"),
    (f"{GRAVITY}\nfix other right setforce 0 0 0\nrun 0",
     G + r"fix other \(setforce\) acts on 1 members of group all: gravity is not seen"),
    (f"{GRAVITY}\nfix other right freeze\nvelocity right set 0 0 1e-9\nrun 0",
     G + r"fix other \(freeze\) acts on 1 members of group all: frozen .* these move"),
    (f"{GRAVITY}\nfix other right freeze\nset group right omega 0 1e-9 0\nrun 0",
     G + r"fix other \(freeze\) acts on 1 members of group all: frozen .* these move"),
]

SECOND = f"{FIX} order 2"
PAIR = "pair_style gran/penalty\npair_coeff * * "
O = "Fix nve/sphere/symplectic order 2: "
REFUSED += [
    (f"{FIX} start plain order 2", O + "velocities of 'start plain' .* use 'start half'"),
    (f"{SECOND}\nrun 0", O + "contacts of particles are not those of a pair style of Talus: use pair_style gran/penalty, or"),
    (f"{PAIR}hooke 1e4 10\n{SECOND}\nrun 0",
     O + "the contact of types 1 and 1 has damping that may attract.*add 'limit_damping'; or use order 1"),
    (f"{PAIR}hooke 1e4 10 tangential multistep NULL NULL 0.5 limit_damping\n{SECOND}\nrun 0",
     O + "the contact of types 1 and 1 has the tangential law multistep, which .*: use .*slider midpoint' or gt = 0"),
    (f"{PAIR}hooke 1e4 0 tangential onestep 1e3 0 0.5\n{SECOND}\nrun 0",
     O + "the contact of types 1 and 1 has the tangential law onestep: use .*slider midpoint"),
    (f"change_box all boundary f f f\npair_style granular/talus\npair_coeff * * hooke 1e4 10 tangential linear_history 1e3 1 0.5 "
     f"limit_damping\n{SECOND}\nrun 0",
     O + "the contact of types 1 and 1 has the tangential law linear_history, which .*: use xt = 0"),
    (f"change_box all boundary f f f\npair_style granular/talus\npair_coeff * * hertz/material 1e4 0.5 0.3 tangential mindlin_rescale NULL 1 0.5 "
     f"limit_damping\n{SECOND}\nrun 0",
     O + "the contact of types 1 and 1 has the tangential law mindlin_rescale, which .*: use xt = 0; or use order 1"),
    (f"change_box all boundary f f f\npair_style gran/hooke/history/talus 1e4 NULL 10 NULL 0.5 1 limit_damping\npair_coeff * *\n"
     f"{SECOND}\nrun 0",
     O + r"the contact of types 1 and 1 has the tangential law multistep, which .* or gt = 0 \(in gran/hooke/history: dampflag 0\)"),
    (f"pair_style gran/hooke/history 1e4 NULL 0 NULL 0.5 1\npair_coeff * *\n{SECOND}\nrun 0",
     O + "contacts of particles are not those of a pair style of Talus"),
    (f"{PAIR}hertz 1e4 0 rolling 0.1 delayed\n{SECOND}\nrun 0", O + "the contact of types 1 and 1 has resistance.*'delayed'"),
    (f"{PAIR}jkr 1e5 1 0.3 1 tangential mindlin/force NULL 1 0.5\n{SECOND}\nrun 0",
     O + "the contact of types 1 and 1 has the tangential law mindlin/force, which .*: use xt = 0"),
    (f"{PAIR}hertz 1e4 0\n{SECOND}\nfix other right nve/sphere\nrun 0",
     O + r"fix other \(nve/sphere\) moves particles as well"),
    (f"{PAIR}hertz 1e4 0\n{SECOND}\nfix w all wall/gran/region hertz/history 1e4 NULL 0 NULL 0.5 1 region box\nrun 0",
     O + r"contacts with fix w \(wall/gran/region\) are of first order: use fix large/body"),
    (f"{PAIR}hertz 1e4 0\nfix b all large/body plane 0 0 0 0 0 1 contact hertz 1e4 0\n{SECOND}\nrun 0",
     O + "fix large/body b was defined before the integrator and keeps no history .*: define it after"),
]
# of bodies with laws that have none of second order, in both orders of definition
for law, message in (
        ("hertz 1e4 0 rolling 0.1 delayed", "has resistance.*'delayed'"),
        ("hertz 1e4 0 tangential onestep 1e3 0 0.5", "has the tangential law onestep: use .*slider midpoint"),
        ("hertz 1e4 10 tangential mindlin/force 1e3 1 0.5 limit_damping", "has the tangential law mindlin/force, which .*use xt = 0")):
    pair = PAIR + "hertz 1e4 0"
    floor = f"fix b all large/body plane 0 0 0 0 0 1 contact {law}"
    for lines in f"{SECOND}\n{floor}", f"{floor}\n{SECOND}":
        REFUSED.append((f"{pair}\n{lines}\nrun 0", O + f"fix large/body b {message}"))

# what looks similar and is allowed
ACCEPTED = [
    f"{FIX}\nfix other all gravity 1 chute 0\nfix third right setforce 0 0 0",
    f"{FIX}\nfix other right freeze\nvelocity right set 0 0 1",
    f"{GRAVITY}\nfix other right freeze",
    "fix step left nve/sphere/symplectic gravity 1 chute 0\n"
    "fix other right gravity 1 chute 0\nfix third right nve/sphere/symplectic",
    "fix step left nve/sphere/symplectic gravity 1 chute 0\nfix third right setforce 0 0 0",
    "fix step left nve/sphere/symplectic gravity 1 chute 0\n"
    "fix other right nve/sphere/symplectic gravity 2 chute 0",
    "group late dynamic all every 1\nfix step late nve/sphere/symplectic gravity 1 chute 0",
    f"{FIX} orientation no start half gravity -1.5e-3 vector 0 0 .5",
]


def box(dimension=3, style="sphere", sizes=SPHERES):
    return BOX.format(dimension=dimension, style=style, sizes=sizes)


class Errors(SceneCase):

    def assert_error(self, script, message, word=None):
        for ranks in 1, 2:
            with self.subTest(script=script[len(BOX):], ranks=ranks):
                log = self.run_lammps(script, np=ranks, expect_error=True, timeout=30).log
                error, = re.findall(r"^ERROR.*", log, re.MULTILINE)
                self.assertRegex(error, f"^ERROR: .*{message}")    # not "ERROR on proc"
                self.assertEqual(marked_word(log), word)

    def assert_bad_words(self, script, words, message, word):
        self.assert_error(f"{script}{FIX} {words}\n", "fix nve/sphere/symplectic.*" + message, word)

    def test_words(self):
        for case in BAD_WORDS:
            self.assert_bad_words(box(), *case)

    def test_words_in_2d(self):
        self.assert_bad_words(box(dimension=2), "gravity 1 vector 0.0 0 -1",
                              "the direction must not be zero in the xy plane", "0.0")

    def test_atom_style(self):
        self.assert_error(box(style="atomic", sizes="mass 1 1") + FIX + "\n", "Fix nve/sphere/"
                          "symplectic requires atom attributes radius, rmass, omega and torque",
                          "nve/sphere/symplectic")

    def test_refused_at_init(self):
        for lines, message in REFUSED:
            self.assert_error(box() + lines + "\n", message)

    def test_accepted(self):
        for lines in ACCEPTED:
            with self.subTest(lines):
                self.run_lammps(box() + lines + "\nrun 2\n")


if __name__ == "__main__":
    unittest.main()
