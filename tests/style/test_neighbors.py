# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=240
"""Neighbors that pair_style gran/penalty finds itself, against the lists of LAMMPS: the same bits.

As one of several parts of pair_style hybrid it takes the lists of LAMMPS.  What neigh_modify excludes is excluded in both."""

import os
import re
import unittest
from unittest import mock

from tossed_grains import LAW, PAIR, TossedCase

OWN = "Talus gran/penalty: finds neighbors itself"
HOST = "Talus gran/penalty: neighbor lists are those of LAMMPS: "
IN_HYBRID = ("pair_style hybrid/overlay zero 0.1 gran/penalty\npair_coeff * * zero\n"
             "pair_coeff * * gran/penalty {law}")
OUTPUT = """
compute touching all contact/atom
compute pairs all pair gran/penalty
compute number all reduce sum c_touching
thermo_style custom step c_number c_pairs[1] c_pairs[2]
thermo 20
"""


class Neighbors(TossedCase):

    types = 2

    def run_scene(self, pair=PAIR, more="", **options):
        """The dump, the log and the rows of thermo output."""
        frames, log = self.run_tossed(pair=pair, more=f"group low id <= 60\ngroup high subtract all low\n{more}{OUTPUT}",
                                      columns="c_touching", **options)
        rows = [list(map(float, row)) for row in re.findall(r"^ +(\d+) +(\S+) +(\S+) +(\S+) *$", log, re.M)]
        return frames, log, rows

    def assert_same(self, **options):
        own, log, rows = self.run_scene(**options)
        self.assertIn(OWN, log)
        host, log, _ = self.run_scene(pair=IN_HYBRID, **options)
        self.assertIn(HOST + "pair style hybrid", log)
        self.assertGreater(own.count("TIMESTEP"), 5)
        self.assertEqual(own, host)
        return own, rows

    def test_same_bits_as_with_the_lists_of_lammps(self):
        for np in 1, 2:
            with self.subTest(ranks=np):
                self.assert_same(np=np, threads=3)

    def test_the_only_part_of_hybrid(self):
        own, _, _ = self.run_scene(np=2)
        for style in "hybrid", "hybrid/overlay":
            with self.subTest(style):
                alone, log, _ = self.run_scene(pair=f"pair_style {style} gran/penalty\n"
                                                    "pair_coeff * * gran/penalty {law}", np=2)
                self.assertIn(OWN, log)
                self.assertRegex(log, f"pair {style} +accelerated\n")
                self.assertEqual(own, alone)
        _, log, _ = self.run_scene(pair="pair_style hybrid gran/penalty\npair_coeff * * gran/penalty {law}\n"
                                        "pair_coeff 1 2 none", np=2)
        self.assertIn(HOST + "pair style hybrid", log)

    def test_periodic_box(self):
        self.assert_same(boundary="p p f", np=2, more="neigh_modify every 10 check no")

    def test_contacts_are_those_that_lammps_counts(self):
        _, rows = self.assert_same()
        self.assertGreater(len(rows), 5)
        self.assertGreater(rows[-1][1], 20)
        for _, touching, contacts, candidates in rows:
            self.assertEqual(touching, 2 * contacts)    # contact/atom counts both sides
            self.assertGreater(candidates, contacts)

    def test_what_is_excluded(self):
        everything = self.assert_same()[0]
        seen = {everything}
        for words in "type 1 2", "group low high", "type 1 1":
            with self.subTest(exclude=words):
                seen.add(self.assert_same(more="neigh_modify exclude " + words)[0])
        self.assertEqual(len(seen), 4)

    def test_what_is_excluded_counts_from_the_next_set_up_on(self):
        """As in LAMMPS, which makes its tables then."""
        again = "run 40\n{}run 30 pre no\nrun 60 pre no"
        plain, _, _ = self.run_scene(run=again.format(""))
        late, _, _ = self.run_scene(run=again.format("neigh_modify exclude type 1 2\n"))
        self.assertEqual(plain, late)

    def test_a_run_without_set_up_after_a_new_pair_style(self):
        for np in 1, 2:
            with self.subTest(ranks=np), self.assertRaisesRegex(
                    AssertionError, "return code 1:(.|\n)*Run: leave 'pre no' out: the pair style has been defined anew since the last set-up"):
                self.run_scene(run=f"run 5\npair_style none\n{PAIR.format(law=LAW)}\nrun 5 pre no", np=np)

    @mock.patch.dict(os.environ, MALLOC_PERTURB_="0")    # LAMMPS sets the forces of the group alone
    def test_lists_of_a_group_are_those_of_lammps(self):
        _, log, _ = self.run_scene(more="atom_modify first low\nneigh_modify include low")
        self.assertIn(HOST + "they are those of a group", log)


if __name__ == "__main__":
    unittest.main()
