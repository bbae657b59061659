# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=30 timeout=300
"""run style verlet of Talus: steps without output are made in its own records, and it does not show.

Every scene runs with the run style of LAMMPS and with that of Talus, and must have the same bits wherever
anybody can look: dumps, thermo output, averages of host fixes, restarts, runs that go on without a
setup or end before their time.  What may look at particles in every step switches records off, and
the log says so."""

import os
import re
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "lib"))
from tossed_grains import LAW, TossedCase

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


class RecordSteps(TossedCase):

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
            "fix drag all viscous 0.1": "fix drag (viscous): may look at particles in every step",
            f"variable d equal 0.1*step*dt+0.0*xcm(all,z)\n{LID}":
                "fix lid (large/body): its variables may read particles",
        }
        for more, reason in cases.items():
            with self.subTest(reason=reason):
                _, log = self.run_scene("", more=more, run="run 20")
                self.assertRegex(log, re.escape(HOST) + ".*" + re.escape(reason))
        for style, reason in (("comm_proxy no", "the exchange is the one of LAMMPS: 'comm_proxy no' is set: remove it"),
                              (STOCK, "run style verlet/stock")):
            _, log = self.run_scene(style, np=2, run="run 20")
            self.assertIn(HOST + reason, log)


if __name__ == "__main__":
    unittest.main()
