# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=30 stay
"""Every refusal of pair_style gran/penalty, its pair_coeff, fix large/body and their internal fix: text,
word that is marked, on 1 and 2 ranks, without a hang."""

import re
import resource
import unittest

from talus_testing import SceneCase, marked_word, ranks_of_refusal, thermo

BOX = """
units si
boundary f f f
{atom_style}
{newton}
{velocity}
region box block -4 4 -4 4 -4 4
create_box 2 box
create_atoms 1 single -0.45 0 0
create_atoms 1 single 0.45 0 0
create_atoms 2 single 2 0 0
{sizes}
"""
STYLE = "pair_style gran/penalty\n"
PAIR = STYLE + "pair_coeff * * hooke 1.0 1.0 tangential multistep NULL NULL 0.5\n"
MOVE = "fix move all nve/sphere\n"
LAW = "contact hooke 1.0 1.0"
RUN = PAIR + MOVE + "run 2\n"

NARROW = "group far type 2\ndelete_atoms group far\nchange_box all x final -0.95 0.95 boundary p f f\n"

# 27 000 particles with 1500 pairs each
MANY_PAIRS = """
newton off
atom_style sphere
comm_modify vel yes
boundary f f f
lattice sc 1.0
region box block 0 30 0 30 0 30
create_box 1 box
create_atoms 1 box
neighbor 8.0 bin
""" + PAIR + MOVE + "run 0\n"

PAIR_STYLE = [    # words after pair_style gran/penalty, message, marked word
    ("foo", "unknown word 'foo', expected mix", "foo"),
    ("mix", "missing rule: min, arithmetic or geometric", "mix"),
    ("mix mean", "unknown rule 'mean', expected min, arithmetic or geometric", "mean"),
    ("mix min 1.5", "surplus word '1.5'", "1.5"),
    ("1.0e5 NULL", "unknown word '1.0e5', expected mix", "1.0e5"),
]


def number(name, word):
    return f"expected {name} (a number >= 0) instead of '{word}'", word


CONTACT = [    # words of a contact law, message, marked word
    ("hook 1 1", "unknown normal law 'hook', expected hooke, hertz, flores", "hook"),
    ("hooke", "missing kn (a number >= 0)", "hooke"),
    ("hertz 11", "missing gn (a number >= 0)", "11"),
    ("hooke x 1", *number("kn", "x")),
    ("hooke -1.5 1", *number("kn", "-1.5")),
    ("hooke NULL 1", *number("kn", "NULL")),
    ("hooke 1e999 1", *number("kn", "1e999")),
    ("hooke nan 1", *number("kn", "nan")),
    ("hooke inf 1", *number("kn", "inf")),
    ("hooke 1 -2", *number("gn", "-2")),
    ("hertz 1 tangential", *number("gn", "tangential")),
    ("hooke 1 1 tangential", "missing tangential law: none, dashpot, onestep, multistep, linear_nohistory",
     "tangential"),
    ("hooke 1 1 tangential hertz", "unknown tangential law 'hertz', expected none, dashpot, "
     "onestep, multistep, linear_nohistory", "hertz"),
    ("hooke 1 1 tangential dashpot", "missing gt (a number >= 0)", "dashpot"),
    ("hooke 1 1 tangential dashpot z 0.5", *number("gt", "z")),
    ("hooke 1 1 tangential dashpot 22", "missing mu (a number >= 0)", "22"),
    ("hooke 1 1 tangential dashpot 1 -0.5", *number("mu", "-0.5")),
    ("hooke 1 1 tangential dashpot NULL NULL", *number("mu", "NULL")),
    ("hooke 1 1 tangential onestep", "missing kt (a number >= 0)", "onestep"),
    ("hooke 1 1 tangential onestep -3 1 1", *number("kt", "-3")),
    ("hooke 1 1 tangential onestep 22", "missing gt (a number >= 0)", "22"),
    ("hooke 1 1 tangential onestep 1 -4 1", *number("gt", "-4")),
    ("hooke 1 1 tangential onestep 1 22", "missing mu (a number >= 0)", "22"),
    ("hooke 1 1 tangential multistep", "missing kt (a number >= 0)", "multistep"),
    ("hooke 1 1 tangential multistep k 1 1", *number("kt", "k")),
    ("hooke 1 1 tangential multistep NULL NULL", "missing mu (a number >= 0)", "NULL"),
    ("hooke 1 1 tangential multistep NULL NULL mu", *number("mu", "mu")),
    ("hooke 1 1 tangential multistep 0.0 1 0.5", "tangential multistep needs kt > 0; without a "
     "tangential spring use 'tangential dashpot'", "0.0"),
    ("hooke 0 1 tangential multistep NULL 1 0.5", "tangential multistep needs kt > 0; without a "
     "tangential spring use 'tangential dashpot'", "NULL"),
    ("hooke 1 1 tangential none tangential none", "keyword 'tangential' given twice", "tangential"),
    ("hooke 1 1 limit_damping limit_damping", "keyword 'limit_damping' given twice",
     "limit_damping"),
]
SURPLUS = [    # words behind a complete law
    ("hooke 1 1 33", "33"),
    ("hooke 1 1 tangential none 33", "33"),
    ("hooke 1 1 tangential dashpot 1 1 33", "33"),
    ("hooke 1 1 tangential multistep 1 1 1 limit_damping 33", "33"),
    ("hooke 1 1 limit_damping yes", "yes"),
    ("hooke 1 1 bouncing 33", "bouncing"),
]

PLANE, RECTANGLE = "plane 0 0 0 0 0 1", "rectangle 0 0 0 0 0 1 1 0 0 2 3"
LARGE_BODY = [    # words after fix f all large/body, message, marked word
    ("", "fix large/body: missing shape: plane, rectangle, mesh, box, sphere", "large/body"),
    ("flat 0 0 0 0 0 1 " + LAW, "fix large/body: unknown shape 'flat', expected plane, rectangle, mesh, box",
     "flat"),
    ("plane", "fix large/body plane: missing point (px py pz)", "plane"),
    ("plane 0 0 77", "fix large/body plane: missing normal (nx ny nz)", "77"),
    ("plane 0 x 0 0 0 1 " + LAW, "plane: expected point (px py pz) (a number) instead of 'x'", "x"),
    ("plane 0 0 1e999 0 0 1 " + LAW, "plane: expected point (px py pz) (a number) instead of "
     "'1e999'", "1e999"),
    ("plane 0 0 0 0 0 " + LAW, "plane: expected normal (nx ny nz) (a number) instead of 'contact'",
     "contact"),
    ("plane 1 1 1 0 0 0 " + LAW, "fix large/body plane: normal (nx ny nz) must not be zero", "0"),
    ("rectangle 1 1", "fix large/body rectangle: missing center (px py pz)", "1"),
    ("rectangle 1 1 1 0 0 nan", "rectangle: expected normal (nx ny nz) (a number) instead of 'nan'",
     "nan"),
    ("rectangle 1 1 1 0 0 5", "fix large/body rectangle: missing first edge (ux uy uz)", "5"),
    ("rectangle 1 1 1 0 0 5 1 0 0 " + LAW, "expected edge length lu (a number > 0) instead of 'contact'",
     "contact"),
    ("rectangle 1 1 1 0 0 5 1 0 0 2 " + LAW, "expected edge length lv (a number > 0) instead of "
     "'contact'", "contact"),
    ("rectangle 1 1 1 0 0 5 0 0 7 2 3 " + LAW, "first edge is parallel to the normal", "0"),
    ("rectangle 1 1 1 0 0 5 0.0 0 0 2 3 " + LAW, "first edge (ux uy uz) must not be zero", "0.0"),
    ("rectangle 1 1 1 0 0 5 1 0 0 -2 3 " + LAW, "expected edge length lu (a number > 0) instead of '-2'", "-2"),
    (PLANE, "fix large/body: no contact law for particles of type 1: add 'contact NORMAL args ...' "
     "or 'contact types 1 NORMAL args ...'", None),
    (f"{RECTANGLE} contact types 1 hooke 1 1", "fix large/body: no contact law for particles of type 2",
     None),
    (f"{PLANE} contact", "fix large/body contact: missing normal law: hooke, hertz, flores", "contact"),
    (f"{PLANE} contact types", "fix large/body contact: missing types, e.g. 1 or 1*3", "types"),
    (f"{PLANE} contact types 3 hooke 1 1", "Numeric index 3 is out of bounds (1-2)", None),
    (f"{PLANE} contact types hooke 1 1", "Invalid range string: hooke", None),
    (f"{PLANE} {LAW} turn none", "fix large/body: unknown word 'turn', expected contact, type, two-sided",
     "turn"),
    (f"{PLANE} onesided {LAW}", "fix large/body: unknown word 'onesided', expected contact, type, "
     "two-sided", "onesided"),
]

INPUT = [    # commands after the box, message
    (STYLE + "pair_coeff * *", "pair_coeff gran/penalty: expected two types and a contact law, e.g. "
     "'pair_coeff * * hertz kn gn tangential multistep NULL NULL mu'"),
    (STYLE + "pair_coeff 1 3 hooke 1 1", "Numeric index 3 is out of bounds (1-2)"),
    (STYLE + "pair_coeff 2* 1 hooke 1 1", "pair_coeff gran/penalty: no pair of types in '2* 1', write the "
     "lower type first"),
    (STYLE + "pair_coeff 1 x hooke 1 1", "Invalid range string: x"),
    (STYLE + MOVE + "run 0", "All pair coeffs are not set"),
    (STYLE + MOVE + "pair_coeff 1 1 hooke 1 1\nrun 0", "All pair coeffs are not set"),
    (STYLE + MOVE + "pair_coeff 1 1 hooke 1 1\npair_coeff 2 2 hertz 1 1 tangential multistep 1 1 1\n"
     "run 0", "Pair style gran/penalty: types 1 (hooke + none) and 2 (hertz + multistep) have different "
     "laws: add 'pair_coeff 1 2 ...'"),
    ("pair_style hybrid/overlay gran/penalty\npair_coeff * * gran/penalty hooke 1 x",
     "pair_coeff gran/penalty: expected gn (a number >= 0) instead of 'x'"),
    (PAIR + "fix even all balance 10 1.0 shift x 5 1.1\n" + STYLE.replace("gran/penalty", "none") + RUN,
     "Pair style gran/penalty must be defined before fix even balance, which migrates atoms: move the "
     "pair_style command up"),
    (PAIR + MOVE + "run_style respa 2 2 inner 1 0.1 0.2 outer 2\nrun 0",
     "Pair style does not support rRESPA inner/middle/outer"),
    (f"fix f all large/body {PLANE} {LAW}\n{PAIR}{MOVE}run_style respa 2 2\nrun 0",
     "Fix large/body does not run with run_style respa: use run_style verlet"),
    ("fix f all CONTACT_STORE", "Fix CONTACT_STORE is internal to Talus"),
    ("fix f all CONTACT_STORE 1.0", "Fix CONTACT_STORE is internal to Talus"),
    ("fix f all TALUS_PAIR_HISTORY", "Fix TALUS_PAIR_HISTORY is internal to the pair styles of Talus"),
    (RUN + "unfix TALUS_CONTACTS\nrun 2", "Pair style gran/penalty: its internal fix TALUS_CONTACTS has "
     "been deleted: remove the unfix command"),
    (f"fix f all large/body {PLANE} {LAW} tangential multistep NULL NULL 0.5\nunfix TALUS_CONTACTS\n{MOVE}run 2", "Fix large/body f: its internal fix "
     "TALUS_CONTACTS has been deleted: remove the unfix command"),
    (PAIR + "unfix TALUS_CONTACTS_LATER\n" + MOVE + "run 2", "Pair style gran/penalty: its internal fix "
     "TALUS_CONTACTS_LATER has been deleted: remove the unfix command"),
    (NARROW + RUN, "Pair style gran/penalty: the box is periodic in x with a period of 1.9, below two diameters of the "
     "largest particle: two particles could touch on both sides, and laws with history cannot tell these contacts apart: "
     "make the box at least 2 wide, or use 'boundary f'"),
    (RUN + "replicate 2 1 1", "Cannot replicate with fixes that store per-atom quantities"),
]

HOST = [    # settings that differ from BOX, message
    ({"velocity": ""}, RUN, "Pair style gran/penalty requires ghost atoms to store velocity: add "
     "'comm_modify vel yes'"),
    ({"atom_style": "atom_style atomic", "sizes": "mass * 1"}, RUN.replace("/sphere", ""),
     "Pair style gran/penalty requires atom attributes radius, rmass, omega and torque: use "
     "'atom_style sphere'"),
    ({"atom_style": "atom_style atomic", "sizes": "mass * 1"}, f"fix f all large/body {PLANE} {LAW}",
     "Fix large/body requires atom attributes radius, rmass, omega and torque: use 'atom_style sphere'"),
    ({"atom_style": "atom_style sphere\natom_modify id no"}, RUN,
     "Pair style gran/penalty requires atom IDs: remove 'atom_modify id no'"),
]


def box(**options):
    settings = {"atom_style": "atom_style sphere", "newton": "newton off",
                "velocity": "comm_modify vel yes",
                "sizes": "set group all diameter 1\nset group all density 1", **options}
    return BOX.format(**settings)


class Errors(SceneCase):

    def assert_error(self, script, message, word=None, ranks=(1, 2)):
        for np in ranks:
            with self.subTest(script.splitlines()[-1], ranks=np):
                log = self.run_lammps(script + "\n", np=np, expect_error=True, timeout=30).log
                error, = re.findall(r"^ERROR: (.*)", log, re.MULTILINE)    # not "ERROR on proc"
                self.assertIn(message, error)
                self.assertEqual(marked_word(log), word)

    def test_pair_style(self):
        for words, message, word in PAIR_STYLE:
            self.assert_error(f"{box()}pair_style gran/penalty {words}",
                              "pair_style gran/penalty: " + message, word)

    def test_pair_coeff(self):
        for n, (words, message, word) in enumerate(CONTACT):
            self.assert_error(f"{box()}{STYLE}pair_coeff * * {words}",
                              "pair_coeff gran/penalty: " + message, word, ranks_of_refusal(n))
        for n, (words, word) in enumerate(SURPLUS):
            self.assert_error(f"{box()}{STYLE}pair_coeff * * {words}", "pair_coeff gran/penalty: "
                              f"unknown word '{word}', expected tangential, damping, rolling, spinning", word,
                              ranks_of_refusal(n))

    def test_contact_of_large_body(self):
        for words, message, word in CONTACT[:3] + CONTACT[11:13] + CONTACT[-3:]:
            self.assert_error(f"{box()}fix f all large/body {PLANE} contact {words}",
                              "fix large/body contact: " + message, word)
        for words, word in SURPLUS[:3]:
            self.assert_error(f"{box()}fix f all large/body {PLANE} contact {words}", "fix large/body: "
                              f"unknown word '{word}', expected contact, type, two-sided", word)

    def test_large_body(self):
        for words, message, word in LARGE_BODY:
            self.assert_error(f"{box()}fix f all large/body {words}", message, word)

    def test_input(self):
        for commands, message in INPUT:
            word = "x" if "hybrid" in commands else None
            self.assert_error(box() + commands, message, word)

    def test_host_settings(self):
        for settings, commands, message in HOST:
            self.assert_error(box(**settings) + commands, message)

    def test_memory(self):
        """Pairs that do not fit into memory: not a signal, nor a message of the C++ library alone. On one rank: what
        another than the first says goes to its screen, which runs of tests do not have."""
        before = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (1 << 30, before[1]))     # inherited by what is run
        try:
            result = self.run_lammps(MANY_PAIRS, expect_error=True, timeout=60, stay=False)
        finally:
            resource.setrlimit(resource.RLIMIT_AS, before)
        self.assertRegex(result.log + result.output, "ERROR on proc 0: Pair style gran/penalty: not enough memory for the "
                         "pairs of 27000 particles and 0 ghosts of a rank: use more machines")

    def assert_pushed_apart(self, script):
        """The particles begin at rest and overlap."""
        first, last = thermo(self.run_lammps(script).log)
        self.assertEqual((first["Step"], first["Temp"], last["Step"]), (0, 0, 2))
        self.assertGreater(last["Temp"], 0.0)

    def test_what_is_right_runs(self):
        self.assert_pushed_apart(f"{box()}fix f all large/body {RECTANGLE} two-sided contact types 2 hertz 1 1 "
                                 f"limit_damping contact types *1 hooke 1 1 tangential dashpot 1 1\n{RUN}")
        # without history the two contacts of a pair need not be told apart
        self.assert_pushed_apart(f"{box()}{NARROW}{STYLE}pair_coeff * * hooke 1 1 tangential dashpot 1 1\n{MOVE}run 2")


if __name__ == "__main__":
    unittest.main()
