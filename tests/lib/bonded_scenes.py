# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Scripts of package BPM with and without the suffix talus: a bonded crystal falls on a plate and is hit.
BondedScenes has the scene and the tests that hold for every bond style."""

import os

from bonded_grains import bonds_within, crystal, write_bonded_data
from talus_testing import max_difference, read_dump, read_local, thermo

PAIR = "gran/hooke/history 200.0 NULL 5.0 NULL 0.5 1"
BOX = ((-1.0, 7.0), (-1.0, 7.0), (-2.0, 12.0))
MOTION = "x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz".split()
TURNS = "c_turn[1] c_turn[2] c_turn[3] c_turn[4]".split()
OF_TURNS = "compute turn all property/atom quatw quati quatj quatk"
HEAD = """
units lj
boundary {boundary}
atom_style {atoms}
newton {newton}
comm_modify vel yes cutoff 3.0
special_bonds {special}
{grid}
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
fix move all {move}
fix weight all gravity 0.1 vector 0 0 -1
fix floor all wall/gran hooke/history 200.0 NULL 5.0 NULL 0.5 1 zplane -1.0 NULL
"""
OUTPUT = """
{turn}
thermo_style custom step atoms ke pxx pyy pzz pxz
thermo_modify format float %.17g norm no
thermo {every}
dump d all custom {every} state id {columns}
dump_modify d format float %.17g
{more}
{commands}
"""
RESTARTED = HEAD + """
read_restart middle
neighbor 0.3 bin
timestep 0.01
{again}
fix move all {move}
fix weight all gravity 0.1 vector 0 0 -1
fix floor all wall/gran hooke/history 200.0 NULL 5.0 NULL 0.5 1 zplane -1.0 NULL
""" + OUTPUT
TALUS = ["-sf", "talus"]
NEW = int(os.environ["TALUS_LAMMPS_VERSION"]) >= 20260000
ACCELERATED = r"(?m)^  {} +accelerated$"
RECORDS = r"steps without output +in the records"


class BondedScenes:
    """Of a SceneCase with BOND, the style; coefficients WHOLE, of bonds that last, and BRITTLE; LACKING, words that restart files of LAMMPS
    4 Feb 2025 lack, and TOLD of them; and ERROR, relative to stock while bonds last. WORDS: those of all runs without a `frame`;
    UNTIL_BROKEN: steps after which many of the brittle ones are."""

    MOVER = "nve/bpm/sphere"
    WORDS = ""
    UNTIL_BROKEN = 80

    def setUp(self):
        super().setUp()
        self.spheres = crystal((3, 3, 2), 1.02, velocity=(0.0, 0.0, -0.4))
        bonded = bonds_within(self.spheres, 1.2, types=2)
        self.spheres += crystal((1, 1, 1), 1.05, origin=(1.0, 1.0, 5.0), velocity=(0.1, 0.0, -1.0), seed=2)
        self.bonds = bonded

    def script(self, folder, text, options):
        """With these options; its data file is in the folder then."""
        settings = dict(atoms="bpm/sphere", move="nve/bpm/sphere", boundary="s s m", newton="on off", special="lj 0 1 1 coul 1 1 1",
                        bond=self.BOND, words="", coeffs=f"bond_coeff * {self.WHOLE}", pair=PAIR, every=50, more="",
                        commands="run 200", again="", grid="")
        settings.update(options)
        if settings["bond"] == self.BOND and "frame" not in settings["words"]:
            settings["words"] += " " + self.WORDS
        turning = settings["atoms"] == "bpm/sphere"
        settings.update(turn=OF_TURNS if turning else "", columns=" ".join(MOTION + TURNS * turning))
        os.makedirs(folder, exist_ok=True)
        write_bonded_data(os.path.join(folder, "grains"), BOX, self.spheres, self.bonds, bond_types=2, style=settings["atoms"])
        return text.format(**settings)

    def simulate(self, suffix=(), np=1, threads=1, text=SCENE + OUTPUT, name="run", folder=None, **options):
        cwd = folder or self.path(f"{name}{len(os.listdir(self.dir))}")
        self.log = self.run_lammps(self.script(cwd, text, options), np=np, cwd=cwd, arguments=suffix,
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
            for column in a.columns:
                scale = max(1.0, *map(abs, a.column(column).values()))
                self.assertLessEqual(max_difference(a, b, [column]), limit * scale, f"{column} at {a.step}")
        for a, b in zip(rows, thermo(self.log)):
            for key in a:
                self.assertLessEqual(abs(a[key] - b[key]), limit * max(1.0, abs(a[key])), f"{key} at {a['Step']}")
        return folder

    def assert_accelerated(self, *styles):
        for style in styles:
            self.assertRegex(self.log, ACCELERATED.format(style))

    def test_bonds_that_last(self):
        for np in 1, 2, 3:
            self.compare(self.ERROR, np=np, words="break no smooth no")
            self.assert_accelerated(f"bond {self.BOND}")

    def broken(self, folder):
        return [tuple(map(int, row)) for frame in read_local(os.path.join(folder, "breaks")) for row in frame.rows]

    def breaking(self, **options):
        return {"words": "store/local broken 1 time id1 id2", "coeffs": f"bond_coeff * {self.BRITTLE}", "every": 10,
                "more": "dump b all local 1 breaks f_broken[1] f_broken[2] f_broken[3]\n"
                        "dump_modify b format line '%.0f %.0f %.0f'", **options}

    def test_bonds_that_break(self):
        """In the same order; from then on their particles touch, in the same step, without new neighbor lists."""
        for np in 1, 2:
            folder = self.compare(2.5 * self.ERROR, np=np, **self.breaking(commands=f"run {self.UNTIL_BROKEN}"))
            stock, talus = self.broken(folder), self.broken(self.folder)
            self.assertGreater(len(stock), 20)
            self.assertEqual(sorted(stock), sorted(talus))
            if np == 1:
                self.assertEqual(stock, talus)

    def test_same_bits(self):
        self.same_bits()

    def same_bits(self, **more):
        for boundary in "s s m", "p p m":
            options = self.breaking(commands="run 300", boundary=boundary, every=100, **more)
            reference = self.simulate(TALUS, **options)
            broken = sorted(self.broken(self.folder))
            self.assertGreater(len(broken), 20)
            for np, threads in (2, 1), (3, 1), (4, 1), (1, 2), (2, 2):
                frames = self.simulate(TALUS, np=np, threads=threads, **options)
                self.assertEqual(sorted(self.broken(self.folder)), broken)
                for a, b in zip(reference, frames):
                    self.assert_same_bits(a, b, a.columns)

    def test_steps_in_the_records(self):
        """The bits of a run through the arrays of LAMMPS, also of what bonds that break store; and of a run that goes on."""
        for boundary in "s s m", "p p m":
            self.in_the_records(boundary=boundary)
        self.in_the_records(commands="run 70\nrun 30 pre no\nrun 200")

    def in_the_records(self, ways=((1, 1), (2, 1), (3, 1), (1, 2), (2, 2)), style="", **more):
        """At steps with output only is anything shown; borders of ranks cut bonds."""
        options = self.breaking(**{"commands": "run 300", **more})
        # where particles are wrapped they are rounded: lists have to be made in the same steps
        lists = "neigh_modify every 5 delay 0 check no\n" if options.get("boundary", "s").startswith("p") else ""
        commands = lists + options["commands"]
        options.update(grid="processors * * 1", words="store/local broken 50 time id1 id2 x y z " + more.get("words", ""), every=100,
                       more="dump b all local 50 breaks f_broken[*]\ndump_modify b format float %.17g\n" + more.get("more", ""))
        reference = self.simulate(TALUS, **{**options, "commands": f"run_style verlet/stock\n{commands}"})
        self.assertNotRegex(self.log, RECORDS)

        def rows():
            return sorted(tuple(row) for frame in read_local(os.path.join(self.folder, "breaks")) for row in frame.rows)
        broken = rows()
        self.assertGreater(len(broken), 20)
        for np, threads in ways:
            frames = self.simulate(TALUS, np=np, threads=threads, **{**options, "commands": f"{style}\n{commands}"})
            self.assertRegex(self.log, RECORDS)
            self.assertEqual(rows(), broken)
            self.assertEqual(len(frames), len(reference))
            for a, b in zip(reference, frames):
                self.assert_same_bits(a, b, a.columns)

    def test_records_with_others(self):
        """Spheres that have a fix of their own, are frozen or in clumps; contacts of bonded spheres; a fix of LAMMPS on some."""
        parts = "group some id <= 5\ngroup rest subtract all some\n"
        self.in_the_records(more=f"{parts}unfix move\nfix move rest {self.MOVER}\nfix other some {self.MOVER}\n"
                                 "fix push rest addforce 0.05 0.0 0.0\n", ways=((1, 1), (2, 2)))
        self.in_the_records(more=f"{parts}velocity some set 0 0 0\nfix still some freeze\n", ways=((1, 2), (2, 1)))
        self.in_the_records(more=f"{parts}set atom 1*3 mol 1\nset atom 4*5 mol 2\nunfix move\nfix move rest {self.MOVER}\n"
                                 "fix clumps some rigid/small molecule\n", ways=((1, 1), (2, 2)))
        overlap = "run_style verlet/proxy overlap yes"
        self.in_the_records(words="overlay/pair yes", special="lj 1 1 1 coul 1 1 1", style=overlap, boundary="p p m",
                            ways=((2, 1), (3, 1), (2, 2)))

    def test_restart_files(self):
        self.read_each_others()

    def read_each_others(self, **more):
        """Of either, read by either: the same motion as without a stop."""
        whole = self.simulate(TALUS, commands="run 100\nrun 100", **more)[-1]
        for writer in [], TALUS:
            for reader in [], TALUS:
                self.simulate(writer, commands="run 100\nwrite_restart middle", **more)
                folder = self.folder
                again = f"pair_style {PAIR}\npair_coeff * *" if not reader or not writer else ""
                last = self.simulate(reader, folder=folder, text=RESTARTED, again=again, commands="run 100",
                                     np=1 if not reader else 2)[-1]
                for column in whole.columns:
                    scale = max(1.0, *map(abs, whole.column(column).values()))
                    self.assertLessEqual(max_difference(whole, last, [column]), self.ERROR * scale, f"{column} {writer} {reader}")
                if reader and writer:
                    self.assert_same_bits(whole, last, whole.columns)

    def test_words_that_restart_files_lack(self):
        """Those of LAMMPS 4 Feb 2025: bond_style is given again, or a warning tells it."""
        lacking = dict(words=self.LACKING)
        whole = self.simulate(TALUS, commands="run 50\nrun 50", **lacking)[-1]
        self.simulate(TALUS, commands="run 50\nwrite_restart middle", **lacking)
        reader = dict(folder=self.folder, text=RESTARTED, commands="run 50")
        again = f"bond_style {self.BOND} {self.LACKING} {self.WORDS}\nbond_coeff * {self.WHOLE}"
        last = self.simulate(TALUS, again=again, np=2, **reader)[-1]
        self.assert_same_bits(whole, last, whole.columns)
        told = f"WARNING: Bond style {self.BOND}: restart files of this LAMMPS have {self.TOLD}: if bond_style had such words, repeat it"
        self.assertNotIn(told, self.log)
        self.simulate(TALUS, **reader)
        self.assertEqual(self.log.count(told), 0 if NEW else 1)

    def test_breaking_after_a_restart(self):
        """Bonds that are left go on as they were: with LAMMPS those of a particle take the places of others in that run."""
        whole = self.simulate(TALUS, **self.breaking(commands=f"run 20\nrun {self.UNTIL_BROKEN - 20}", every=20))[-1]
        self.assertGreater(sum(step > 20 for step, _, _ in self.broken(self.folder)), 10)
        self.simulate(TALUS, **self.breaking(commands="run 20\nwrite_restart middle", every=20))
        for np in 1, 2:
            last = self.simulate(TALUS, np=np, folder=self.folder, text=RESTARTED, commands=f"run {self.UNTIL_BROKEN - 20}", every=20)[-1]
            self.assert_same_bits(whole, last, whole.columns)

    def refused(self, np, **options):
        """What the run says at its end."""
        cwd = self.path(f"refused{len(os.listdir(self.dir))}")
        text = self.script(cwd, SCENE + "{commands}\n", {"commands": "run 5", **options})
        result = self.run_lammps(text, np=np, cwd=cwd, arguments=TALUS, expect_error=True)
        return result.log + result.output

    def test_bond_beyond_ghosts(self):
        """A warning where it can be computed."""
        self.bonds.append((1, 1, len(self.spheres)))
        self.simulate(TALUS, commands="run 5", words="break no smooth no")
        self.assertRegex(self.log, rf"WARNING: Bond style {self.BOND}: the longest bond has a length of [5-9][.\d]*, and ghosts are "
                                   r"known up to 3[.\d]*: more ranks will miss its ends; give 'comm_modify cutoff' more than its length")
        self.bonds.pop()
        self.simulate(TALUS, commands="run 5", words="break no smooth no")
        self.assertNotIn("longest bond", self.log)
