#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=15 timeout=600
"""bond_style bpm/spring with and without the suffix talus: as stock LAMMPS has it, with all of its words, also for spheres that cannot turn;
the same bits on any ranks and threads, unlike stock; volumes; and restart files that either can go on from."""

import os
import unittest

from bonded_grains import crystal
from bonded_scenes import NEW, OUTPUT, RECORDS, SCENE, TALUS, BondedScenes
from talus_testing import SceneCase, thermo

# four bonded spheres
MOLECULE = """bonded

4 atoms
5 bonds

Coords

1 0 0 0
2 1 0 0
3 0.5 0.9 0
4 0.5 0.3 0.8

Types

1 1
2 1
3 1
4 1

Diameters

1 1
2 1
3 1
4 1

Masses

1 0.5
2 0.5
3 0.5
4 0.5

Bonds

1 1 1 2
2 1 1 3
3 2 2 3
4 1 1 4
5 2 2 4
"""
ADDED = "run 50\nmolecule four four\ncreate_atoms 0 single 2.5 2.5 9 mol four 4711\nrun 100"


class SuffixSprings(BondedScenes, SceneCase):

    BOND = "bpm/spring"
    WHOLE = "30.0 2.0 0.3"
    BRITTLE = "30.0 0.03 0.3"
    UNTIL_BROKEN = 121    # LAMMPS 4 Jul 2026 then gives bonds that are left the lengths of others of their particle
    LACKING, TOLD = "break no smooth no", "no 'break'"
    ERROR = 1e-9
    VOLUMES = "volume/factor yes"
    IN_VOLUMES = WHOLE + " 12.0"

    def test_forces_of_one_step(self):
        self.compare(1e-13, commands="run 2", every=1)
        self.assert_accelerated("pair gran/hooke/history", "bond bpm/spring", "fix move nve/bpm/sphere",
                                "fix floor wall/gran", "fix weight gravity")
        self.assertRegex(self.log, RECORDS)

    def test_all_words(self):
        pulled = dict(coeffs="bond_coeff * 30.0 0.2 0.3")
        self.compare(self.ERROR, words="smooth no normalize yes", **pulled)
        self.compare(self.ERROR, words="smooth yes normalize no", **pulled)
        self.compare(self.ERROR, words="overlay/pair yes break no smooth no", special="lj 1 1 1 coul 1 1 1")
        self.compare(self.ERROR, words="overlay/pair yes", special="lj 1 1 1 coul 1 1 1", **pulled)
        self.compare(self.ERROR, coeffs=f"bond_coeff 1 {self.WHOLE}\nbond_coeff 2 20.0 0.5 0.1")
        self.assert_accelerated("bond bpm/spring")

    def test_volumes(self):
        for words in "", "normalize yes", "break no smooth no":
            for np in 1, 2:
                self.compare(self.ERROR, np=np, words=f"{self.VOLUMES} {words}", coeffs=f"bond_coeff * {self.IN_VOLUMES}")
                self.assert_accelerated("bond bpm/spring")

    def test_volumes_without_broken_bonds(self):
        """Those of bonds that break are missing from then on; on one rank, since LAMMPS leaves them to ghosts until lists are new."""
        stock = self.compare(5 * self.ERROR, words=f"{self.VOLUMES} store/local broken 1 time id1 id2", commands=f"run {self.UNTIL_BROKEN}",
                             **self.volumes_that_break())
        self.assertEqual(self.broken(stock), self.broken(self.folder))
        self.assertGreater(len(self.broken(stock)), 10)

    def volumes_that_break(self):
        options = self.breaking()
        return dict(coeffs=f"bond_coeff * {self.BRITTLE} 5.0", every=options["every"], more=options["more"])

    def test_same_bits_with_volumes(self):
        self.same_bits(words=f"{self.VOLUMES} store/local broken 1 time id1 id2", coeffs=f"bond_coeff * {self.BRITTLE} 5.0")

    def test_restart_files_with_volumes(self):
        """LAMMPS cannot read its own with these on several ranks."""
        self.read_each_others(words=self.VOLUMES, coeffs=f"bond_coeff * {self.IN_VOLUMES}")

    def test_bonds_that_come_with_particles(self):
        """On several ranks, which give them other IDs, LAMMPS ends with errors of MPI where it has volumes."""
        with open(os.path.join(self.dir, "four"), "w") as file:
            file.write(MOLECULE)
        for words, coeffs, ranks in ("", self.WHOLE, (1, 2)), (self.VOLUMES, self.IN_VOLUMES, (1,)):
            options = dict(words=words, coeffs=f"bond_coeff * {coeffs}",
                           commands=ADDED.replace("molecule four four", f"molecule four {self.path('four')}"))
            for np in ranks:
                self.compare(self.ERROR, np=np, **options)
            energies = []
            for np in 1, 3:
                self.simulate(TALUS, np=np, **options)
                energies.append(thermo(self.log)[-1]["KinEng"])
            self.assertAlmostEqual(energies[1] / energies[0], 1.0, delta=self.ERROR)

    def test_spheres_of_another_atom_style(self):
        options = dict(atoms="hybrid sphere bond", move="nve/sphere")
        self.compare(self.ERROR, np=2, **options)
        self.assert_accelerated("bond bpm/spring", "fix move nve/sphere")
        self.assertGreater(len(self.spheres), 0)

    def test_order_2_in_the_records(self):
        """Where bonds have broken a rank takes its pairs again, and ghosts have the changes of velocities of their owners."""
        law = "hooke 200.0 5.0 tangential multistep NULL NULL 0.5 slider midpoint limit_damping"
        more = f"unfix floor\nfix floor all large/body plane 0 0 -1 0 0 1 contact {law}\nunfix move\nunfix weight\n" \
               "fix move all nve/sphere/symplectic order 2 gravity 0.1 vector 0 0 -1\n"
        for boundary in "s s m", "p p m":
            self.in_the_records(atoms="hybrid sphere bond", move="nve/sphere", pair="gran/penalty", more=more, boundary=boundary,
                                text=SCENE.replace("pair_coeff * *", f"pair_coeff * * {law}") + OUTPUT, ways=((1, 1), (2, 1), (3, 2)))

    def test_strain_of_zero(self):
        for np in 1, 2:
            said = self.refused(np, coeffs=f"bond_coeff 1 {self.BRITTLE}\nbond_coeff 2 30.0 0.0 0.3")
            self.assertIn("Bond style bpm/spring: bond_coeff 2: ecrit = 0 is no strain to break at: give one above 0, or 'bond_style "
                          "bpm/spring break no'", said.replace("\n", " "))
        self.simulate(TALUS, words="break no smooth no", coeffs="bond_coeff * 30.0 0 0.3", commands="run 5")

    def test_wrong_words(self):
        """The messages of LAMMPS."""
        for options, told in ((dict(words="soft yes"), "invalid argument soft"), (dict(words="break no"), "must turn off smoothing"),
                              (dict(coeffs="bond_coeff * 30.0 0.1"), "Incorrect args for bond coefficients")):
            self.assertIn(told, self.refused(1, **options))

    def test_energies(self):
        """What springs give, they have taken; and those that break. Nothing but springs acts: there is no plate, and contacts have no
        stiffness to speak of."""
        self.spheres = crystal((3, 3, 2), 1.02, velocity=(0.0, 0.0, 0.1))
        lines = ("unfix floor\nunfix weight\ncompute sums all penalty/stats\n"
                 "thermo_style custom step ke pe c_sums[12] c_sums[13] c_sums[14]\n"
                 "thermo_modify format float %.17g norm no\nvelocity all ramp vx 0 1.5 x 0 4 sum yes")
        for words, coeffs, limit in (("smooth no break no", "30.0 1.0 0.3", 4e-6), ("smooth no", "30.0 0.04 0.3", 4e-6)):
            self.simulate(TALUS, pair="gran/hooke 1e-12 NULL 0.0 NULL 0.0 0", words=words, coeffs=f"bond_coeff * {coeffs}",
                          more=lines, every=100, commands="timestep 0.001\nrun 2000")
            rows = thermo(self.log)
            sums = [row["KinEng"] + row["c_sums[12]"] + row["c_sums[13]"] + row["c_sums[14]"] for row in rows]
            for total in sums:
                self.assertLess(abs(total - sums[0]), limit * sums[0])
            last = rows[-1]
            self.assertGreater(last["c_sums[13]"], 0.01 * sums[0])
            self.assertEqual(last["c_sums[14]"] > 0.0, "break" not in words)
            if NEW and "break" in words:
                self.assertLess(abs(last["PotEng"] - last["c_sums[12]"]), 1e-12 * sums[0])

    def test_what_is_stock(self):
        self.compare(1e-9, words="break no smooth no", newton="on on", commands="run 20")
        self.assertIn("stock: newton is on for bonds: use 'newton on off'", self.log)


if __name__ == "__main__":
    unittest.main()
