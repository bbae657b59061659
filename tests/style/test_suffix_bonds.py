#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=15 timeout=600
"""Scripts of package BPM with and without the suffix talus: forces, motion and breaking of bonds as stock LAMMPS has them,
contacts where bonds have broken, the same bits on any ranks and threads, and restart files that either can go on from."""

import os
import unittest

from bonded_scenes import NEW, OUTPUT, RECORDS, SCENE, TALUS, BondedScenes
from talus_testing import SceneCase, read_local, thermo

# an atom style with a topology that the script does not use
UNUSED = """
units lj
boundary m m m
atom_style {style}
newton off
comm_modify vel yes
region box block 0 6 0 6 0 6
create_box 1 box {types}
create_atoms 1 random 80 7 NULL overlap 1.0 maxtry 500
set group all diameter 1 density 1
velocity all create 1.0 3
{zero}
neighbor 0.3 bin
timestep 0.005
pair_style gran/hooke/history 200.0 NULL 5.0 NULL 0.5 1
pair_coeff * *
fix move all nve/sphere
fix weight all gravity 1.0 vector 0 0 -1
fix floor all wall/gran hooke/history 200.0 NULL 5.0 NULL 0.5 1 zplane 0.0 6.0
thermo 100
dump d all custom 100 state id x y z vx vy vz omegax omegay omegaz
dump_modify d format float %.17g
run 300
"""


class SuffixBonds(BondedScenes, SceneCase):

    BOND = "bpm/rotational"
    # of the older host; what the newer one does without words has tests of its own
    WORDS = "frame particle damping dem" if NEW else ""
    WHOLE = "30.0 10.0 2.0 3.0 {0} {0} {0} {0} 0.3 0.2 0.1 0.05".format(1e9)
    BRITTLE = "30.0 10.0 2.0 3.0 0.9 0.6 0.2 0.2 0.3 0.2 0.1 0.05"
    LACKING, TOLD = "normalize yes break no smooth no", "neither 'normalize' nor 'break'"
    ERROR = 2e-6    # LAMMPS takes angles from their cosine

    def test_forces_of_one_step(self):
        """The initial angles are zero, those of the second step not."""
        self.compare(1e-6, commands="run 2", every=1)
        self.assert_accelerated("pair gran/hooke/history", "bond bpm/rotational", "fix move nve/bpm/sphere",
                                "fix floor wall/gran", "fix weight gravity")
        self.assertRegex(self.log, RECORDS)

    def test_styles_without_forces(self):
        """Bonds and angles of style zero leave steps in the records, with the bits of an atom style without them."""
        unused = dict(style="hybrid sphere molecular", types="bond/types 1 angle/types 1",
                      zero="bond_style zero\nbond_coeff *\nangle_style zero\nangle_coeff *")
        for np in 1, 2:
            states = []
            for words in unused, dict(style="sphere", types="", zero=""):
                log = self.run_lammps(UNUSED.format(**words), np=np, arguments=TALUS).log
                self.assertRegex(log, "steps without output +in the records")
                states.append([sorted(frame.splitlines()) for frame in self.read("state").split("TIMESTEP")])
            self.assertEqual(*states)

    def test_all_words(self):
        pulled = dict(coeffs=f"bond_coeff * {self.BRITTLE}".replace("0.9 0.6 0.2 0.2", "9 6 2 2"))
        self.compare(2e-6, words="smooth no normalize yes", **pulled)
        self.compare(2e-6, words="smooth yes normalize no", **pulled)
        self.compare(2e-6, words="overlay/pair yes break no smooth no", special="lj 1 1 1 coul 1 1 1")
        self.compare(2e-6, words="overlay/pair yes", special="lj 1 1 1 coul 1 1 1", **pulled)
        self.compare(2e-6, coeffs=f"bond_coeff 1 {self.WHOLE}\nbond_coeff 2 {self.WHOLE}".replace("30.0", "20.0", 1))
        self.assert_accelerated("bond bpm/rotational")

    def test_frames_and_damping(self):
        """LAMMPS takes angles from their cosine, which rounding makes wrong by 1e-8, and rates of them from one step to the next: 1e-6
        per time. `average` leaves shear out below an absolute 1e-10, see bonds.md; here lengths are 1. The older host has one of each,
        without words."""
        for frame in ("particle", "average") if NEW else [None]:
            for damping in ("dem", "derivative") if NEW else [None]:
                with self.subTest(frame=frame, damping=damping):
                    words = f"frame {frame} damping {damping}" if NEW else ""
                    self.compare(2e-6, words=words, commands="run 20", every=1)
                    self.assert_accelerated("bond bpm/rotational")

    def test_contacts_without_torques(self):
        """Their records have no angular velocities, which beams read."""
        law = "hooke 200.0 5.0"
        self.simulate(TALUS, pair="gran/penalty", text=SCENE.replace("pair_coeff * *", f"pair_coeff * * {law}") + OUTPUT, commands="run 5")
        self.assertIn("through the arrays of LAMMPS: bonds: contacts have no torques", self.log)

    def test_agglomerate(self):
        """The example: what breaks is what is missing, and it falls into parts."""
        example = os.path.join(os.environ["TALUS_SOURCE_DIR"], "examples", "bonds", "in.agglomerate")
        with open(example) as file:
            log = self.run_lammps(file.read(), np=2, variables={"radius": 3, "speed": 15.0, "steps": 3000}, arguments=TALUS).log
        rows = thermo(log)
        broken = sum(len(frame.rows) for frame in read_local(self.path("breaks")))
        self.assertGreater(broken, 10)
        self.assertEqual(rows[0]["v_bonds"] - rows[-1]["v_bonds"], broken)
        self.assertEqual((rows[0]["c_parts"], rows[0]["v_largest"]), (1, rows[0]["Atoms"]))
        self.assertGreater(rows[-1]["c_parts"], 1)
        self.assertLess(rows[-1]["v_largest"], rows[0]["Atoms"])

    def test_strength_of_zero(self):
        for np in 1, 2:
            for place, word in enumerate(("Fcr", "Fcs", "Tct", "Tcb"), start=4):
                coeffs = self.BRITTLE.split()
                coeffs[place] = "0.0"
                said = self.refused(np, coeffs=f"bond_coeff 1 {self.BRITTLE}\nbond_coeff 2 " + " ".join(coeffs))
                self.assertIn(f"Bond style bpm/rotational: bond_coeff 2: {word} = 0 is no strength: give one above 0, or 'bond_style "
                              "bpm/rotational break no'", said.replace("\n", " "))
        self.simulate(TALUS, words="break no smooth no", coeffs="bond_coeff * 30.0 10.0 2.0 3.0 0 0 0 0 0.3 0.2 0.1 0.05", commands="run 5")

    def test_bonds_of_spheres_that_have_turned(self):
        """LAMMPS takes their directions as if they had not; the cure helps."""
        bonds, self.bonds = self.bonds, []
        turning = "run 50\n{cure}\nspecial_bonds lj 0 1 1 coul 0 1 1\ncreate_bonds many all all 1 0.0 1.15\n" \
                  "special_bonds lj 0 1 1 coul 1 1 1\nrun 0"
        told = "WARNING: Bond style bpm/rotational: new bonds of spheres that have turned begin strained"
        free = dict(words="break no smooth no", special="lj 0 1 1 coul 1 1 1", every=50)
        for np in 1, 2:
            forces = []
            for cure in "", "set group all quat 0 0 1 0":
                self.simulate(TALUS, np=np, commands=turning.format(cure=cure), more="thermo_style custom step fmax", **free)
                self.assertEqual(self.log.count(told), 0 if cure else 1)
                forces.append(thermo(self.log)[-1]["Fmax"])
            self.assertGreater(forces[0], 2 * forces[1])
        self.bonds = bonds
        self.simulate(TALUS, commands="run 20\nrun 20", **free)
        self.assertNotIn(told, self.log)

    def test_bond_to_a_particle_that_is_gone(self):
        """The error of LAMMPS; on two ranks that of the lower one, where all of its partners are."""
        for np in 1, 2:
            said = self.refused(np, commands="run 5\ngroup gone id 10\ndelete_atoms group gone compress no\nrun 5")
            self.assertRegex(said, r"ERROR on proc \d: Bond atoms (\d+ 10|10 \d+) missing")

    def test_what_is_stock(self):
        self.compare(1e-9, words="break no smooth no", newton="on on", commands="run 20")
        self.assertIn("stock: newton is on for bonds: use 'newton on off'", self.log)
        self.compare(1e-9, bond="hybrid", words="bpm/rotational bpm/spring", commands="run 20",
                     coeffs=f"bond_coeff 1 bpm/rotational {self.WHOLE}\nbond_coeff 2 bpm/spring 10.0 0.1 0.3")
        self.assertRegex(self.log, r"bond hybrid +stock: ")


if __name__ == "__main__":
    unittest.main()
