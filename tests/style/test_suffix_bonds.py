#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=15 timeout=600
"""Scripts of package BPM with and without the suffix talus: forces, motion and breaking of bonds as stock LAMMPS has them,
contacts where bonds have broken, the same bits on any ranks and threads, and restart files that either can go on from."""

import os
import unittest

from bonded_grains import bonds_within, crystal, write_bonded_data
from talus_testing import SceneCase, max_difference, read_dump, read_local, thermo

BOX = ((-1.0, 7.0), (-1.0, 7.0), (-2.0, 12.0))
STATE = ("x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz "
         "c_turn[1] c_turn[2] c_turn[3] c_turn[4]").split()
WHOLE = "30.0 10.0 2.0 3.0 {0} {0} {0} {0} 0.3 0.2 0.1 0.05".format(1e9)
BRITTLE = "30.0 10.0 2.0 3.0 0.9 0.6 0.2 0.2 0.3 0.2 0.1 0.05"
HEAD = """
units lj
boundary {boundary}
atom_style bpm/sphere
newton {newton}
comm_modify vel yes cutoff 3.0
special_bonds {special}
"""
SCENE = HEAD + """
read_data grains
neighbor 0.3 bin
timestep 0.01
pair_style {pair}
pair_coeff * *
bond_style {bond} {words}
{coeffs}
""" + """
fix move all nve/bpm/sphere
fix weight all gravity 0.1 vector 0 0 -1
fix floor all wall/gran hooke/history 200.0 NULL 5.0 NULL 0.5 1 zplane -1.0 NULL
"""
OUTPUT = """
compute turn all property/atom quatw quati quatj quatk
thermo_style custom step atoms ke pxx pyy pzz pxz
thermo_modify format float %.17g norm no
thermo {every}
dump d all custom {every} state id """ + " ".join(STATE) + """
dump_modify d format float %.17g
{more}
{commands}
"""
RESTARTED = HEAD + """
read_restart middle
neighbor 0.3 bin
timestep 0.01
{again}
fix move all nve/bpm/sphere
fix weight all gravity 0.1 vector 0 0 -1
fix floor all wall/gran hooke/history 200.0 NULL 5.0 NULL 0.5 1 zplane -1.0 NULL
""" + OUTPUT
TALUS = ["-sf", "talus"]
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
NEW = int(os.environ["TALUS_LAMMPS_VERSION"]) >= 20260000
# of the older host; what the newer one does without words has tests of its own
OLDER_WORDS = " frame particle damping dem" if NEW else ""
ACCELERATED = r"(?m)^  {} +accelerated$"


class SuffixBonds(SceneCase):

    def setUp(self):
        super().setUp()
        self.spheres = crystal((3, 3, 2), 1.02, velocity=(0.0, 0.0, -0.4))
        bonded = bonds_within(self.spheres, 1.2, types=2)
        self.spheres += crystal((1, 1, 1), 1.05, origin=(1.0, 1.0, 5.0), velocity=(0.1, 0.0, -1.0), seed=2)
        self.bonds = bonded

    def simulate(self, suffix=(), np=1, threads=1, text=SCENE + OUTPUT, name="run", folder=None, **options):
        settings = dict(boundary="s s m", newton="on off", special="lj 0 1 1 coul 1 1 1", bond="bpm/rotational", words="",
                        coeffs=f"bond_coeff * {WHOLE}", pair="gran/hooke/history 200.0 NULL 5.0 NULL 0.5 1", every=50,
                        more="", commands="run 200", again="")
        settings.update(options)
        if settings["bond"] == "bpm/rotational" and "frame" not in settings["words"]:
            settings["words"] += OLDER_WORDS
        cwd = folder or self.path(f"{name}{len(os.listdir(self.dir))}")
        os.makedirs(cwd, exist_ok=True)
        write_bonded_data(os.path.join(cwd, "grains"), BOX, self.spheres, self.bonds, bond_types=2)
        self.log = self.run_lammps(text.format(**settings), np=np, cwd=cwd, arguments=suffix,
                                   env={"OMP_NUM_THREADS": str(threads)}).log
        self.folder = cwd
        return read_dump(os.path.join(cwd, "state"))

    def compare(self, limit, np=1, **options):
        """Both, and what they have in common; self.log is that with the suffix."""
        stock = self.simulate(np=np, **options)
        rows, folder = thermo(self.log), self.folder
        talus = self.simulate(TALUS, np=np, **options)
        self.assertEqual(len(stock), len(talus))
        for a, b in zip(stock, talus):
            for column in STATE:
                scale = max(1.0, *map(abs, a.column(column).values()))
                self.assertLessEqual(max_difference(a, b, [column]), limit * scale, f"{column} at {a.step}")
        for a, b in zip(rows, thermo(self.log)):
            for key in a:
                self.assertLessEqual(abs(a[key] - b[key]), limit * max(1.0, abs(a[key])), f"{key} at {a['Step']}")
        return folder

    def assert_accelerated(self, *styles):
        for style in styles:
            self.assertRegex(self.log, ACCELERATED.format(style))

    def test_forces_of_one_step(self):
        """The initial angles are zero, those of the second step not."""
        self.compare(1e-6, commands="run 2", every=1)
        self.assert_accelerated("pair gran/hooke/history", "bond bpm/rotational", "fix move nve/bpm/sphere",
                                "fix floor wall/gran", "fix weight gravity")
        self.assertIn("through the arrays of LAMMPS: there are bonds", self.log)

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

    def test_bonds_that_last(self):
        for np in 1, 2, 4:
            self.compare(2e-6, np=np, words="break no smooth no")

    def test_all_words(self):
        pulled = dict(coeffs=f"bond_coeff * {BRITTLE}".replace("0.9 0.6 0.2 0.2", "9 6 2 2"))
        self.compare(2e-6, words="smooth no normalize yes", **pulled)
        self.compare(2e-6, words="smooth yes normalize no", **pulled)
        self.compare(2e-6, words="overlay/pair yes break no smooth no", special="lj 1 1 1 coul 1 1 1")
        self.compare(2e-6, words="overlay/pair yes", special="lj 1 1 1 coul 1 1 1", **pulled)
        self.compare(2e-6, coeffs=f"bond_coeff 1 {WHOLE}\nbond_coeff 2 {WHOLE}".replace("30.0", "20.0", 1))
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

    def broken(self, folder):
        return [tuple(map(int, row)) for frame in read_local(os.path.join(folder, "breaks")) for row in frame.rows]

    def breaking(self, **options):
        return {"words": "store/local broken 1 time id1 id2", "coeffs": f"bond_coeff * {BRITTLE}", "every": 10,
                "more": "dump b all local 1 breaks f_broken[1] f_broken[2] f_broken[3]\n"
                        "dump_modify b format line '%.0f %.0f %.0f'", **options}

    def test_bonds_that_break(self):
        """In the same order; from then on their particles touch, in the same step, without new neighbor lists."""
        for np in 1, 2:
            folder = self.compare(5e-6, np=np, **self.breaking(commands="run 80"))
            stock, talus = self.broken(folder), self.broken(self.folder)
            self.assertGreater(len(stock), 20)
            self.assertEqual(sorted(stock), sorted(talus))
            if np == 1:
                self.assertEqual(stock, talus)

    def test_same_bits(self):
        for boundary in "s s m", "p p m":
            options = self.breaking(commands="run 300", boundary=boundary, every=100)
            reference = self.simulate(TALUS, **options)
            broken = sorted(self.broken(self.folder))
            self.assertGreater(len(broken), 20)
            for np, threads in (2, 1), (4, 1), (1, 2), (2, 2):
                frames = self.simulate(TALUS, np=np, threads=threads, **options)
                self.assertEqual(sorted(self.broken(self.folder)), broken)
                for a, b in zip(reference, frames):
                    self.assert_same_bits(a, b, STATE)

    def test_restart_files(self):
        """Of either, read by either: the same motion as without a stop."""
        whole = self.simulate(TALUS, commands="run 100\nrun 100")[-1]
        for writer in [], TALUS:
            for reader in [], TALUS:
                self.simulate(writer, commands="run 100\nwrite_restart middle")
                folder = self.folder
                again = ("pair_style gran/hooke/history 200.0 NULL 5.0 NULL 0.5 1\npair_coeff * *"
                         if not reader or not writer else "")
                last = self.simulate(reader, folder=folder, text=RESTARTED, again=again, commands="run 100",
                                     np=1 if not reader else 2)[-1]
                for column in STATE:
                    scale = max(1.0, *map(abs, whole.column(column).values()))
                    self.assertLessEqual(max_difference(whole, last, [column]), 2e-6 * scale, f"{column} {writer} {reader}")
                if reader and writer:
                    self.assert_same_bits(whole, last, STATE)

    def test_words_that_restart_files_lack(self):
        """Those of LAMMPS 4 Feb 2025: bond_style is given again, or a warning tells it."""
        lacking = dict(words="normalize yes break no smooth no")
        whole = self.simulate(TALUS, commands="run 50\nrun 50", **lacking)[-1]
        self.simulate(TALUS, commands="run 50\nwrite_restart middle", **lacking)
        reader = dict(folder=self.folder, text=RESTARTED, commands="run 50")
        again = f"bond_style bpm/rotational {lacking['words']}{OLDER_WORDS}\nbond_coeff * {WHOLE}"
        last = self.simulate(TALUS, again=again, np=2, **reader)[-1]
        self.assert_same_bits(whole, last, STATE)
        told = "WARNING: Bond style bpm/rotational: restart files of this LAMMPS have neither 'normalize' nor 'break'"
        self.assertNotIn(told, self.log)
        self.simulate(TALUS, **reader)
        self.assertEqual(self.log.count(told), 0 if NEW else 1)

    def test_breaking_after_a_restart(self):
        """Bonds that are left go on as they were: with LAMMPS those of a particle take the places of others in that run."""
        whole = self.simulate(TALUS, **self.breaking(commands="run 20\nrun 60", every=20))[-1]
        self.assertGreater(sum(step > 20 for step, _, _ in self.broken(self.folder)), 10)
        self.simulate(TALUS, **self.breaking(commands="run 20\nwrite_restart middle", every=20))
        for np in 1, 2:
            last = self.simulate(TALUS, np=np, folder=self.folder, text=RESTARTED, commands="run 60", every=20)[-1]
            self.assert_same_bits(whole, last, STATE)

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

    def refused(self, np, **options):
        """What the run says at its end."""
        settings = dict(boundary="s s m", newton="on off", special="lj 0 1 1 coul 1 1 1", bond="bpm/rotational", words=OLDER_WORDS,
                        coeffs=f"bond_coeff * {WHOLE}", pair="gran/hooke/history 200.0 NULL 5.0 NULL 0.5 1", commands="run 5")
        settings.update(options)
        cwd = self.path(f"refused{len(os.listdir(self.dir))}")
        os.makedirs(cwd)
        write_bonded_data(os.path.join(cwd, "grains"), BOX, self.spheres, self.bonds, bond_types=2)
        result = self.run_lammps((SCENE + "{commands}\n").format(**settings), np=np, cwd=cwd, arguments=TALUS, expect_error=True)
        return result.log + result.output

    def test_strength_of_zero(self):
        for np in 1, 2:
            for place, word in enumerate(("Fcr", "Fcs", "Tct", "Tcb"), start=4):
                coeffs = BRITTLE.split()
                coeffs[place] = "0.0"
                said = self.refused(np, coeffs=f"bond_coeff 1 {BRITTLE}\nbond_coeff 2 " + " ".join(coeffs))
                self.assertIn(f"Bond style bpm/rotational: bond_coeff 2: {word} = 0 is no strength: give one above 0, or 'bond_style "
                              "bpm/rotational break no'", said.replace("\n", " "))
        self.simulate(TALUS, words="break no smooth no", coeffs="bond_coeff * 30.0 10.0 2.0 3.0 0 0 0 0 0.3 0.2 0.1 0.05", commands="run 5")

    def test_bond_beyond_ghosts(self):
        """A warning where it can be computed."""
        self.bonds.append((1, 1, len(self.spheres)))
        self.simulate(TALUS, commands="run 5", words="break no smooth no")
        self.assertRegex(self.log, r"WARNING: Bond style bpm/rotational: the longest bond has a length of [5-9][.\d]*, and ghosts are "
                                   r"known up to 3[.\d]*: more ranks will miss its ends; give 'comm_modify cutoff' more than its length")
        self.bonds.pop()
        self.simulate(TALUS, commands="run 5", words="break no smooth no")
        self.assertNotIn("longest bond", self.log)

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
                     coeffs=f"bond_coeff 1 bpm/rotational {WHOLE}\nbond_coeff 2 bpm/spring 10.0 0.1 0.3")
        self.assertRegex(self.log, r"bond hybrid +stock: ")
        self.compare(1e-9, bond="bpm/spring", coeffs="bond_coeff * 30.0 0.1 0.3", commands="run 40")
        self.assertRegex(self.log, r"bond bpm/spring +stock: no accelerated variant")
        self.assert_accelerated("pair gran/hooke/history", "fix move nve/bpm/sphere")


if __name__ == "__main__":
    unittest.main()
