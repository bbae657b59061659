# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""Wrong words, refusals and hazards of comm_proxy and run_style verlet/proxy, and errors while an exchange is under way."""

import os
import re
import unittest

from talus_testing import SceneCase, head, marked_word, run_program

BOX = head(boundary="p p p", map=None) + """{before}
region box block 0 8 0 7 0 6
create_box 2 box
create_atoms 1 random 250 77 box
set group all diameter 0.5 density 1.0
"""
SCENE = BOX + """
pair_style gran/penalty
pair_coeff * * hertz 4000.0 40.0
neighbor 0.3 bin
timestep 0.0001
fix step all nve/sphere/symplectic
comm_proxy yes
run_style verlet/proxy overlap yes
{middle}
run 3
"""


class Messages(SceneCase):

    def refused(self, script, message, word=None, ranks=(1, 2), arguments=()):
        for np in ranks:
            with self.subTest(script=script[-60:], ranks=np):
                result = self.run_lammps(script, np=np, expect_error=True, arguments=arguments)
                self.assertIn(message, " ".join((result.log + result.output).split()))
                if word:
                    self.assertEqual(marked_word(result.log), word)

    def test_words(self):
        box = BOX.format(before="")
        for command, message, word in (
                ("comm_proxy", "comm_proxy: missing word: auto, yes, no, info or check", None),
                ("comm_proxy maybe", "unknown word 'maybe', expected auto, yes, no, info or check", "maybe"),
                ("comm_proxy yes please", "surplus word 'please'", "please"),
                ("comm_proxy check", "comm_proxy check: missing value: yes or no", "check"),
                ("comm_proxy check perhaps", "comm_proxy check: unknown value 'perhaps', expected yes or no", "perhaps"),
                ("comm_proxy check yes now", "surplus word 'now'", "now"),
                ("comm_proxy check yes", "say 'comm_proxy yes' first", None),
                ("run_style verlet/proxy lap", "expected overlap instead of 'lap'", "lap"),
                ("run_style verlet/proxy overlap", "overlap: missing value: yes or no", "overlap"),
                ("run_style verlet/proxy overlap so", "unknown value 'so', expected yes or no", "so"),
                ("run_style verlet/proxy overlap yes no", "surplus word 'no'", "no")):
            self.refused(box + command + "\n", message, word, ranks=(1,))
        self.refused(box + "comm_proxy maybe\n", "unknown word 'maybe'", "maybe", ranks=(2,))

    def test_before_the_box(self):
        self.refused("comm_proxy yes\n", "before the simulation box is defined")
        self.refused("run_style verlet/proxy\n", "before simulation box is defined", ranks=(1,))

    def test_refusals(self):
        box = BOX.format(before="")
        reduce = "neighbor 0.3 multi\ncomm_modify mode multi reduce/multi"
        self.refused(SCENE.format(before="newton on\n", middle=reduce + " cutoff/multi 1 2.0"),
                     "'comm_modify reduce/multi' is not supported with 'comm_modify cutoff' or 'group': remove it")
        deform = "group some id 1 2\nfix shape some deform 1 x erate 0.1 remap v"
        self.refused(SCENE.format(before="", middle=deform),
                     "fix deform with 'remap v' is supported for group all only")

    def run_scene(self, middle, before="", ranks=2):
        return self.run_lammps(SCENE.format(before=before, middle=middle), np=ranks).log

    def test_hazards(self):
        """One warning with the reason, and blocking exchanges."""
        hybrid = ("pair_style hybrid/overlay soft 1.0 gran/penalty\npair_coeff * * soft 1.0\n"
                  "pair_coeff * * gran/penalty hertz 4000.0 40.0")
        for middle, reason in (
                ("comm_proxy no", "the exchange is the one of LAMMPS: 'comm_proxy no' is set: remove it"),
                ("pair_style zero 1.0\npair_coeff * *", "pair style zero does not wait for proxies"),
                (hybrid, "pair style hybrid/overlay does not wait for proxies"),
                ("pair_modify compute no", "'pair_modify compute no' is set"),
                ("variable d equal 0.5\nfix a all adapt 1 atom diameter v_d",
                 "fix a (adapt) may read proxies before forces are computed"),
                ("timer sync", "'timer sync' lets all ranks wait")):
            with self.subTest(reason=reason):
                before = "atom_style sphere 1" if "adapt" in middle else ""
                log = self.run_scene(middle + "\nrun 3", before)
                self.assertEqual(log.count("overlap is off"), 1, log)
                self.assertIn(reason, log)
                if "comm_proxy no" not in middle:
                    self.assertRegex(log, r"Talus exchange: \d+ updates of proxies, 0 overlapped")

    def test_no_warning_without_need(self):
        for style in "verlet/proxy", "verlet/proxy overlap yes", "verlet/proxy overlap no", "verlet":
            log = self.run_scene(f"run_style {style}")
            self.assertNotIn("WARNING: Run style", log)

    def test_info(self):
        self.assertIn("comm_proxy: off", self.run_scene("comm_proxy no\ncomm_proxy info"))
        log = self.run_scene("comm_proxy info\ncomm_proxy check yes\nrun 2\ncomm_proxy info")
        self.assertIn("comm_proxy: on\n", log)
        self.assertIn("comm_proxy: on, checking\n", log)
        self.assertIn("72 bytes per particle: x, v, omega\n", log)

    def test_partitions(self):
        """Two worlds with an exchange each."""
        script = SCENE.format(before="", middle="comm_proxy check yes")
        self.run_lammps(script + 'print "END REACHED"\n', np=4, arguments=("-partition", "2x2"))
        for number in "0", "1":
            self.assertIn("END REACHED", self.read("log.script." + number))

    def test_errors_in_the_window(self):
        program = os.path.join(os.environ["TALUS_BINARY_DIR"], "tests", "proxy_error")
        for ranks in 1, 2, 4:
            with self.subTest(ranks=ranks):
                output = run_program(program, np=ranks, cwd=self.dir).output
                self.assertIn("survived", output)
                self.assertGreater(int(re.search(r"windows (\d+)", output).group(1)), 100)


if __name__ == "__main__":
    unittest.main()
