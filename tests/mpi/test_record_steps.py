# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=30 timeout=300 stay
"""run style verlet of Talus: steps without output are made in its own records, and it does not show.

Every scene runs with the run style of LAMMPS and with that of Talus, and must have the same bits wherever
anybody can look: dumps, thermo output, averages of host fixes, restarts, runs that go on without a
setup or end before their time.  What may look at particles in every step switches records off, and
the log says so."""

import os
import re
import unittest

from tossed_grains import LAW, MOVERS, TossedCase

RECORDS = "steps without output              in the records"
HOST = "steps without output              through the arrays of LAMMPS: "
STOCK = "run_style verlet/stock"    # of LAMMPS
FROZEN = """
group base id <= 40
group loose subtract all base
fix step loose nve/sphere/symplectic gravity 4.0 vector 0.3 0.1 -1
fix held base freeze
"""
# bodies at rest before and behind one that moves, and corners where particles touch several
WALLS = """
fix xlo all large/body plane 0 0 0  1 0 0  contact {law}
fix ylo all large/body plane 0 0 0  0 1 0  contact {law}
fix top all large/body box 4.5 3.5 4.5 5 3 1.5 outside move rotate 4.5 3.5 4.5  0 0 1  3.0  contact {law}
fix xhi all large/body plane 9.5 0 0  -1 0 0  contact {law}
fix yhi all large/body plane 0 7.2 0  0 -1 0  contact {law}
"""
LID = f"fix lid all large/body plane 0 0 6 0 0 -1 move variable NULL NULL v_d NULL NULL NULL contact {LAW}"
PROXY = "comm_proxy yes\nrun_style verlet/proxy overlap yes"


class RecordsCase(TossedCase):

    def run_scene(self, style, law=LAW, boundary="f f f", more="", **options):
        """The text of the dump and of the log."""
        walls = WALLS.format(law=law) if boundary == "f f f" else ""
        return self.run_tossed(law=law, boundary=boundary, more=f"{walls}{more}\n{style}\nthermo 7", **options)

    def assert_same(self, style=PROXY, np=1, threads=1, **options):
        stock = ("comm_proxy yes\n" if "comm_proxy" in style else "") + STOCK
        expected, _ = self.run_scene(stock, np=np, **options)
        frames, log = self.run_scene(style, np=np, threads=threads, **options)
        self.assertIn(RECORDS, log)
        self.assertGreater(expected.count("TIMESTEP"), 2)
        self.assertEqual(frames, expected)
        return log

    def assert_same_end(self, styles, columns, more="", **options):
        """A run ends when its time is over, at a step that nobody was going to look at; the same number of steps without
        records. Returns the state at the end."""
        def run(steps):
            return (f"thermo 0\nundump all\nrun 50\n{steps}\ntimer timeout off\n"
                    f"write_dump all custom dump id x {columns} modify format float %a sort id\n")
        frames, log = self.run_scene(styles[1], more=more, run=run("timer timeout 0:00:01 every 10\nrun 100000000"), **options)
        self.assertIn(RECORDS, log)
        made = int(re.findall(r"Loop time .* for (\d+) steps", log)[1])
        self.assertTrue(0 < made < 100000000, made)
        self.assertIn(f"ITEM: TIMESTEP\n{50 + made}\n", frames)
        expected, _ = self.run_scene(styles[0], more=more, run=run(f"run {made}"), **options)
        self.assertEqual(frames, expected)
        return frames


class RecordSteps(RecordsCase):

    def test_with_walls_on_ranks_and_threads(self):
        for style in "", "run_style verlet", "run_style verlet/proxy":
            self.assert_same(style)
        for np, threads in (1, 1), (1, 3), (2, 1), (2, 2), (4, 1):
            for overlap in "yes", "no":
                with self.subTest(ranks=np, threads=threads, overlap=overlap):
                    self.assert_same(PROXY.replace("overlap yes", f"overlap {overlap}"), np=np, threads=threads)

    def test_half_kick_at_the_start(self):
        self.assert_same(start="half")

    def test_laws(self):
        for law in ("hertz 4000.0 40.0", LAW + " rolling 0.1",
                    "hooke 4000.0 40.0 tangential onestep NULL NULL 0.5"):
            with self.subTest(law=law):
                self.assert_same(law=law, np=2)

    def test_frozen_particles_stay_where_they_are(self):
        log = self.assert_same(movers=FROZEN, np=2)
        self.assertIn(RECORDS, log)

    def test_fixes_that_look_now_and_then(self):
        more = ("compute ke all ke\ncompute top all reduce max z vx fz\n"
                "fix mean all ave/time 3 2 9 c_ke c_top[*] file means format ' %a'\n")
        results = []
        for style in STOCK, "":
            frames, log = self.run_scene(style, more=more)
            with open(self.path("means")) as f:
                results.append((frames, f.read()))
        self.assertIn(RECORDS, log)
        self.assertGreater(len(results[0][1].splitlines()), 10)
        self.assertEqual(*results)

    def test_runs_that_go_on(self):
        self.assert_same(run="run 33\nrun 47 pre no post no\nrun 50")

    def test_restart_files_on_the_way(self):
        self.assert_same(run="restart 45 middle\nrun 60\nclear\nread_restart middle.45\n"
                             "write_dump all custom dump id x vx omegax modify append yes "
                             "format float %a sort id")

    def test_run_that_ends_before_its_time(self):
        self.assert_same_end((STOCK, ""), "vx omegax fx tqx")

    def test_periodic_boxes(self):
        """Wrapping rounds, so that only the same rebuild schedule gives the same bits: here a fixed one."""
        rebuild = "neigh_modify every 10 delay 0 check no"
        for np in 1, 2:
            with self.subTest(ranks=np):
                self.assert_same(boundary="p p f", more=rebuild, np=np)

    def test_output_that_reads_proxies(self):
        """They go from records to records; whoever looks finds them in the host's arrays."""
        more = ("neigh_modify every 10 delay 0 check no\n"
                "compute touching all contact/atom\ncompute sum all reduce sum c_touching\n"
                "thermo_style custom step c_sum ke\n")
        tables = []
        for style in f"comm_proxy yes\n{STOCK}", PROXY, PROXY.replace("overlap yes", "overlap no"):
            _, log = self.run_scene(style, np=2, threads=2, boundary="p p f", more=more)
            tables.append(re.findall(r"^ +\d+ +[1-9]\d* +\S+ *$", log, re.M))
        self.assertIn(RECORDS, log)
        self.assertEqual(tables[1], tables[0])
        self.assertEqual(tables[2], tables[0])
        self.assertGreater(len(tables[0]), 15)

    def test_proxies_of_a_run_that_ends_before_its_time(self):
        frames = self.assert_same_end((f"comm_proxy yes\n{STOCK}", PROXY), "c_touching", np=2, boundary="p p f",
                                      more="neigh_modify every 30 delay 0 check no\n"
                                           "compute touching all contact/atom")
        touching = re.findall(r"^\d+ \S+ (\S+) *$", frames, re.M)
        self.assertGreater(sum(float.fromhex(number) > 0 for number in touching), 50)

    def test_body_moved_by_a_formula_of_time(self):
        more = f"variable t equal step*dt\nvariable d equal 0.2*sin(v_t)-0.5*ramp(0,1)\n{LID}"
        for np, threads in (1, 1), (2, 2):
            log = self.assert_same(np=np, threads=threads, more=more)
            self.assertIn(RECORDS, log)

    def test_what_looks_in_every_step(self):
        cases = {
            "fix back all recenter NULL NULL NULL": "fix back (recenter): may look at particles in every step",
            "variable a atom x\nfix push all addforce v_a 0 0": "fix push (addforce): variable a reads more than time",
            "variable a equal xcm(all,x)\nregion near sphere v_a 3 3 2\nfix push all addforce 1 0 0 region near":
                "fix push (addforce): its region may move with particles: v_a reads more than time",
            "variable a equal vcm(all,x)*step*dt\nregion near sphere 3 3 3 2 move v_a NULL NULL\nfix push all addforce 1 0 0 region near":
                "fix push (addforce): its region may move with particles: v_a reads more than time",
            "fix step2 loose move linear 0 0 0\nfix step3 base move linear 0 0 0\n":
                "fix step2 (move): fix step may move the same particles",
            "fix t all langevin 1 1 1 4711\ncompute part all temp/partial 1 1 0\nfix_modify t temp part":
                "fix t (langevin): a compute or variable of it may read particles",
            f"variable d equal 0.1*step*dt+0.0*xcm(all,z)\n{LID}":
                "fix lid (large/body): its variables may read particles",
        }
        for more, reason in cases.items():
            with self.subTest(reason=reason):
                groups = "group base id <= 40\ngroup loose subtract all base\n" if "loose" in more else ""
                _, log = self.run_scene("", more=groups + more, run="run 20")
                self.assertRegex(log, re.escape(HOST) + ".*" + re.escape(reason))
        for style, reason in (("comm_proxy no", "the exchange is the one of LAMMPS: 'comm_proxy no' is set: remove it"),
                              (STOCK, "run style verlet/stock")):
            _, log = self.run_scene(style, np=2, run="run 20")
            self.assertIn(HOST + reason, log)

    def test_what_a_window_does_not_do(self):
        movers = FROZEN.replace("fix held base freeze", "fix held base move linear 0 0 0")
        _, log = self.run_scene("", movers=movers, more="compute work all penalty/stats\nthermo_style custom step c_work[1]",
                                run="run 20")
        self.assertIn(HOST + "fix held (move): particles that it moves have no accelerations for order 2 or energies", log)
        _, log = self.run_scene("", law="hertz 4000.0 40.0", more="fix spin all viscous/sphere 0.1", run="run 20")
        self.assertRegex(log, re.escape(HOST) + r"fix spin \(viscous/sphere\): (it acts on rotations|may look)")


WINDOWS = {
    "viscous": "fix w all viscous 0.3",
    "addforce": "fix w all addforce 0.2 0 0.1",
    "addforce of time": "variable w equal 2*sin(20*step*dt)\nfix w all addforce v_w 0 0",
    "addforce in a region": "region near block INF 5 INF INF INF 3\nfix w all addforce 1 0 0 region near",
    "addforce in a region that moves": "variable w equal 3*step*dt\nregion near block INF 5 INF INF INF 3 move v_w NULL NULL\n"
                                       "fix w all addforce 1 0 0 region near",
    "setforce": "group some id 3 7 50 111\nfix w some setforce 0 NULL 0.5",
    "aveforce": "group some id 3 7 50 111\nfix w some aveforce NULL NULL 0.1",
    "spring": "group some id 3 7 50 111\nfix w some spring tether 20 4 4 4 0.5",
    "spring of two groups": "group some id 3 7\ngroup other id 50 111\nfix w some spring couple other 20 1 1 1 2",
    "spring/self": "group some id 3 7 50 111\nfix w some spring/self 50",
    "planeforce": "group some id 3 7 50 111\nfix w some planeforce 0 1 1",
    "lineforce": "group some id 3 7 50 111\nfix w some lineforce 0 1 1",
    "langevin": "fix w all langevin 1.0 1.0 0.5 4711 omega yes",
    "wall/reflect": "fix w all wall/reflect zhi 3.5 xlo 0.3",
    "indent": "fix w all indent 50 sphere 4 3.5 3.5 2.0",
    "indent of time": "variable w equal 3.5-step*dt\nfix w all indent 50 plane z v_w hi",
    "wall/harmonic": "fix w all wall/harmonic xlo 0.5 50 1.0 0.9 zhi 4.0 50 1.0 0.9",
    "gravity of LAMMPS": "fix w all gravity 1.0 vector 1 0 0",
    "in a dynamic group": "region mid block 2 6 INF INF INF 2\ngroup moves dynamic all region mid every 3\n"
                          "fix w moves addforce 0 0 5.0",
    "in a group of a formula": "variable up atom vz>0&&fx>0\ngroup moves dynamic all var up every 2\nfix w moves viscous 3.0",
    "several": "fix w all viscous 0.3\nfix w2 all addforce 0.2 0 0.1\nfix w3 all langevin 1.0 1.0 2.0 99",
    "before a body": "group some id 3 7 50 111\nfix w some setforce 0 0 0\n"
                     "fix later all large/body plane 0.8 0 0 1 0 0 contact " + LAW,
}
MOVING = {
    "linear": "move linear 0.3 0 0.2",
    "partly": "move linear 0.3 NULL NULL",
    "wiggle": "move wiggle 0.05 0.05 0.1 0.2",
    "rotate": "move rotate 4.5 3.5 0 0 0 1 2.0",
    "variable": "move variable v_d NULL NULL v_u NULL NULL",
    "nve": "nve",
    "nve/limit": "nve/limit 0.0005",
    "nve/noforce": "nve/noforce",
}


FALL = "fix step all nve/sphere/symplectic start {start}\nfix pull all addforce 0.1 0 -2\n"


class FixesOfLammps(RecordsCase):
    """Known fixes of LAMMPS act through a window of arrays while all other particles stay in the records."""

    def test_fixes_that_add_forces(self):
        for k, (name, more) in enumerate(WINDOWS.items()):
            for np, threads in ((1, 2), (2, 1)) if k % 3 == 0 else ((1 + k % 2, 1),):
                with self.subTest(fix=name, ranks=np, threads=threads):
                    self.assert_same(more=more, np=np, threads=threads, movers=FALL if re.search("setforce|gravity", more) else MOVERS)

    def test_fixes_that_move_some(self):
        times = "variable d equal 0.2*sin(5*step*dt)\nvariable u equal cos(5*step*dt)\n"
        for k, (name, words) in enumerate(MOVING.items()):
            groups, step, held = FROZEN.strip().split("\n")[:2], FROZEN.strip().split("\n")[2], f"fix held base {words}"
            for order in ((step, held), (held, step)) if k < 3 else ((step, held),):
                with self.subTest(fix=name, first=order[0]):
                    self.assert_same(movers=times + "\n".join([*groups, *order]), np=1 + k % 2)

    def test_velocity_verlet(self):
        """With the integrator of the suffix both kicks are made on the way through the records."""
        for more in WINDOWS["viscous"], WINDOWS["setforce"], WINDOWS["langevin"]:
            with self.subTest(fix=more):
                self.assert_same(more=more, movers="suffix talus\nfix step all nve/sphere\nfix g all gravity 4.0 vector 0.3 0.1 -1\n")

    def test_output_of_the_fix(self):
        more = WINDOWS["addforce"] + "\nthermo_style custom step ke f_w f_w[1] f_w[3]"
        tables = []
        for style in STOCK, "":
            _, log = self.run_scene(style, more=more)
            tables.append(re.findall(r"^ +\d+ +\S+ +\S+ +\S+ +\S+ *$", log, re.M))
        self.assertIn(RECORDS, log)
        self.assertGreater(len(tables[0]), 15)
        self.assertEqual(*tables)


READERS = """
compute ke all ke
compute spin all property/atom omegaz tqy
compute top all reduce max z vx fx c_spin[1] c_spin[2]
compute touch all contact/atom
compute near all reduce sum c_touch
compute slices all chunk/atom bin/1d x lower 2.0
fix time all ave/time 1 2 3 c_ke c_top[*] c_near file means format ' %a'
fix each all ave/atom 1 1 1 vz fx
compute each all reduce max f_each[1] f_each[2]
fix chunk all ave/chunk 1 3 5 slices vx fz density/mass file chunks format ' %a'
fix histo all ave/histo 1 1 13 -3 3 10 vx mode vector file histo
fix lags all ave/correlate 1 5 20 c_ke file lags
fix rows all vector 1 c_ke
variable last equal f_rows[1]
fix say all print 1 "$(step) $(c_each[1]:%.17g) $(c_each[2]:%.17g) $(c_ke:%.17g) $(fx[7]:%.17g) $(v_last:%.17g)" file said screen no
"""
SEEN = "means", "chunks", "histo", "lags", "said"
SUFFIX_MOVERS = """suffix talus
group base id <= 40
fix step all nve/sphere
fix g all gravity 4.0 vector 0.3 0.1 -1
fix held base freeze
"""


class FixesThatRead(RecordsCase):
    """What reads particles in every step finds them in the arrays of LAMMPS, while the run goes on in the records."""

    def seen(self, style, **options):
        frames, log = self.run_scene(style, more=READERS, **options)
        texts = [frames]
        for name in SEEN:
            texts.append(self.read(name))
            os.remove(self.path(name))
        return texts, log

    def test_every_step(self):
        for movers in MOVERS, SUFFIX_MOVERS:
            for np, threads, style in (1, 2, ""), (2, 1, PROXY), (2, 1, PROXY.replace("overlap yes", "overlap no")):
                with self.subTest(movers=movers[:12], ranks=np, style=style):
                    stock = ("comm_proxy yes\n" if style else "") + STOCK
                    expected, _ = self.seen(stock, np=np, movers=movers)
                    found, log = self.seen(style, np=np, threads=threads, movers=movers)
                    self.assertIn(RECORDS, log)
                    self.assertGreater(expected[-1].count("\n"), 130)
                    self.assertEqual(found, expected)

    def test_periodic_box_and_a_run_that_goes_on(self):
        more = "neigh_modify every 10 delay 0 check no\n"
        results = []
        for style in f"comm_proxy yes\n{STOCK}", PROXY:
            texts, log = self.seen(more + style, np=2, boundary="p p f", run="run 33\nrun 47 pre no post no\nrun 50")
            results.append(texts)
        self.assertIn(RECORDS, log)
        self.assertEqual(*results)

    def test_what_is_read_now_and_then(self):
        """Particles are shown in the steps that count, not whenever the fix is called: so too where a run ends early."""
        more = "compute ke all ke\nfix time all ave/time 1 1 40 c_ke file means format ' %a'\n"
        self.assert_same_end((STOCK, ""), "vx omegax fx tqx", more=more)

    def test_forces_on_walls_by_particle(self):
        more = ("suffix talus\nfix wall all wall/gran hooke/history 4000 NULL 40 NULL 0.5 1 zplane 0.1 NULL contacts\n"
                "compute touch all reduce sum f_wall[1] f_wall[2] f_wall[4] f_wall[7]\n"
                "fix each all ave/time 1 1 1 c_touch[*] file means format ' %a'\n")
        results = []
        for style in STOCK, "":
            frames, log = self.run_scene(style, more=more)
            results.append((frames, self.read("means")))
        self.assertIn(RECORDS, log)
        self.assertRegex(results[0][1], r"(?m)^\d+ 0x1")
        self.assertEqual(*results)

    def test_those_that_change_particles(self):
        _, log = self.run_scene("", more="fix mom all momentum 1 linear 1 1 1", run="run 20")
        self.assertIn(HOST + "fix mom (momentum): may change particles at the end of every step: a larger Nevery", log)
        for more in ("fix mom all momentum 10 linear 1 1 1", "fix cool all temp/rescale 15 0.5 0.5 0.01 1.0"):
            self.assert_same(more=more, np=2)

    def test_boxes_that_deform(self):
        """Fix deform moves particles at the end of each step, with the box or not."""
        for words in ("x erate 0.3 y erate -0.2", "z erate -0.4 remap none", "x erate 0.3 remap v", "x wiggle 0.2 3.0",
                      "xy erate 1.5"):
            more = "change_box all triclinic\n" if "xy" in words else ""
            with self.subTest(words):
                self.assert_same(boundary="p p p", np=2, more=f"{more}fix box all deform 1 {words} units box")
        self.assert_same(boundary="p p p", threads=2, more="group low id <= 60\nfix box low deform 1 x erate 0.3 units box")
        variable = "variable grown equal 0.001*step\nvariable rate equal 1.0\nfix box all deform 1 x variable v_grown v_rate"
        _, log = self.run_scene(PROXY, boundary="p p p", more=variable, run="run 20")
        self.assertIn(HOST + "fix box (deform): may change particles at the end of every step: a larger Nevery", log)


class HybridPairs(RecordsCase):
    """Other sub-styles of a hybrid pair style add their forces in the arrays of LAMMPS, within a step in the records."""

    LAWS = {
        "after": "pair_style hybrid/overlay gran/penalty lj/cut 1.4\npair_coeff * * gran/penalty {law}\npair_coeff * * lj/cut 0.3 0.9\n",
        "before": "pair_style hybrid/overlay lj/cut 1.4 gran/penalty\npair_coeff * * gran/penalty {law}\npair_coeff * * lj/cut 0.3 0.9\n",
        "with velocities and torques": "pair_style hybrid/overlay gran/hooke 300.0 NULL 10.0 NULL 0.4 0 gran/penalty\n"
                                       "pair_coeff * * gran/hooke\npair_coeff * * gran/penalty {law}\n",
        "alone": "pair_style hybrid gran/penalty\npair_coeff * * gran/penalty {law}\n",
    }

    def test_sub_styles(self):
        for name, pair in self.LAWS.items():
            for newton, np, movers in ("off", 1, MOVERS), ("on", 2, MOVERS), ("off", 2, SUFFIX_MOVERS):
                with self.subTest(pair=name, newton=newton, ranks=np):
                    stock = "suffix off\ncomm_proxy yes\n" + STOCK
                    options = {"pair": pair, "newton": newton, "movers": movers, "np": np}
                    expected, _ = self.run_scene(stock, **options)
                    frames, log = self.run_scene("suffix off\ncomm_proxy yes\nrun_style verlet", **options)
                    self.assertIn(RECORDS, log)
                    self.assertEqual(frames, expected)

    def test_with_all_that_acts_and_reads(self):
        more = WINDOWS["several"] + "\n" + READERS
        results = []
        for style in STOCK, "":
            frames, log = self.run_scene(style, pair=self.LAWS["after"], more=more)
            results.append((frames, self.read("said")))
        self.assertIn(RECORDS, log)
        self.assertEqual(*results)

    def test_what_it_does_not_do(self):
        pair = "pair_style hybrid/overlay gran/penalty lj/cut 1.4\npair_coeff * * gran/penalty hertz 4000 40\npair_coeff * * lj/cut 0.3 0.9\n"
        _, log = self.run_scene("", pair=pair, law="hertz 4000 40", run="run 20")
        self.assertIn(HOST + "the pair style is hybrid, and contacts have no torques", log)


if __name__ == "__main__":
    unittest.main()
