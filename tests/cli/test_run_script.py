# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300 serial
"""scripts/run: what a user sees, with a small scene and the host of this build."""

import io
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = os.environ["TALUS_SOURCE_DIR"]
sys.path.insert(0, os.path.join(ROOT, "scripts", "lib"))
import progress

SCENE = """
variable out index .
variable value index none
units lj
boundary f f f
atom_style sphere
region box block 0 4 0 4 0 4
create_box 1 box
create_atoms 1 single 2 2 2
comm_modify vel yes
pair_style zero 1.0
pair_coeff * *
fix move all nve/sphere
thermo 50
print "Progress: steps 200 falling"
run 200
print "Result: value ${value} in ${out}" file ${out}/result.txt
"""

PROGRAM = """# packages: base-files coreutils
import argparse
import os
from lammps import lammps
from talus import Partner
parser = argparse.ArgumentParser()
parser.add_argument("--out")
parser.add_argument("--steps", type=int, default=1)
options = parser.parse_args()
lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
for line in ("units lj", "atom_style sphere", "region box block 0 4 0 4 0 4", "create_box 1 box",
             "create_atoms 1 single 2 2 2", "comm_modify vel yes", "pair_style gran/penalty", "pair_coeff * * hooke 100 0",
             "fix move all nve/sphere/symplectic"):
    lmp.command(line)
with Partner(lmp) as partner:
    partner.advance(options.steps)
    if lmp.extract_setting("world_rank") == 0:
        print(f"Result: step {partner.step}")
        open(os.path.join(options.out, "result.txt"), "w").close()
lmp.finalize()
"""


class Run(unittest.TestCase):
    def setUp(self):
        self.dir = os.path.realpath(tempfile.mkdtemp(prefix="talus run "))
        self.addCleanup(shutil.rmtree, self.dir, ignore_errors=True)

    def scene(self, text=SCENE, name="in.small"):
        os.makedirs(os.path.join(self.dir, "scenes"), exist_ok=True)
        path = os.path.join(self.dir, "scenes", name)
        with open(path, "w") as file:
            file.write(text)
        return path

    def run_script(self, *arguments):
        env = {**os.environ, "TALUS_SKIP_PACKAGES": "1",
               "TALUS_BUILD_DIR": os.environ["TALUS_BINARY_DIR"],
               "LAMMPS_BINARY_DIR": os.environ["TALUS_LAMMPS_BINARY"],
               "LAMMPS_SOURCE_DIR": os.environ["TALUS_LAMMPS_SOURCE"]}
        env.pop("LAMMPS_PLUGIN_PATH", None)
        return subprocess.run([os.path.join(ROOT, "scripts", "run"), *arguments], env=env,
                              cwd=self.dir, stdin=subprocess.DEVNULL, text=True,
                              capture_output=True, timeout=200)

    def test_a_scene(self):
        self.scene()
        result = self.run_script("scenes/in.small", "-np", "2", "-var", "value", "-0.5")
        out = os.path.join(self.dir, "out", "small")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertIn("small on 2 ranks x 1 threads", result.stderr)
        self.assertIn("Result: value -0.5 in ../out/small", result.stdout)
        self.assertIn(f"Written to {out}:", result.stderr)
        for name in ("log.lammps", "result.txt"):
            self.assertIn(f"  {name}  ", result.stderr)
            self.assertTrue(os.path.isfile(os.path.join(out, name)))

    def test_a_coupled_program(self):
        self.scene(PROGRAM, "small.py")
        for ranks in ("1", "2"):
            result = self.run_script("scenes/small.py", "-np", ranks, "--", "--steps", "7")
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            self.assertIn("Result: step 7", result.stdout)
            self.assertIn("  result.txt  ", result.stderr)
        result = self.run_script("scenes/small.py", "-np", "1", "--", "--nonsense")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("small failed with status 2; see above", result.stderr)
        for words, message in ((["scenes/small.py", "-var", "a", "1"], "-var is for input scripts"),
                               (["drum", "--", "--quick"], "words after -- are for programs")):
            self.assertIn(message, self.run_script(*words).stderr)
        listed = self.run_script("nonsense").stderr
        self.assertRegex(listed, r"scenes: .*\bdrum\b.*; programs: .*\bwheel\b")

    def test_threads(self):
        self.scene()
        result = self.run_script("scenes/in.small", "-nt", "2", "-np", "1")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        with open(os.path.join(self.dir, "out", "small", "log.lammps")) as log:
            self.assertIn("using 2 OpenMP thread(s)", log.read())

    def test_an_error_is_passed_on(self):
        self.scene(SCENE.replace("run 200", "run 200\nnonsense"))
        for ranks in ("1", "2"):
            result = self.run_script("scenes/in.small", "-np", ranks)
            self.assertNotEqual(result.returncode, 0)
            self.assertIn("ERROR: Unknown command: nonsense", result.stdout)
            self.assertIn("small failed with status", result.stderr)
            self.assertIn("log.lammps", result.stderr)


class Stream(io.StringIO):
    def __init__(self, terminal):
        super().__init__()
        self.terminal = terminal

    def isatty(self):
        return self.terminal


class Progress(unittest.TestCase):
    """The display alone, with a clock that advances one minute with every look at it."""

    def follow(self, lines, terminal=False):
        self.time = 0.0

        def now():
            self.time += 60.0
            return self.time
        stream, said = Stream(terminal), []
        display = progress.Display("scene", stream, now)
        log = tempfile.NamedTemporaryFile("w", suffix=".log")
        self.addCleanup(log.close)
        log.write(self.LOG)
        log.flush()
        follower = progress.RunFollower(display, said.append, log.name)
        for line in lines:
            follower.line(line)
        return stream.getvalue(), said

    LOG = ""
    THERMO = ["   Step  Temp", "  1000  0.5", "  1250  nan", "  1500  1e-3", "Loop time of 3"]

    def test_announced_steps(self):
        self.LOG = "run 100\n"
        shown, _ = self.follow(["Progress: steps 500 main part", *self.THERMO])
        self.assertIn("talus: main part: step 0 of 500 (0 %)", shown)
        self.assertIn("main part: step 250 of 500 (50 %)", shown)
        self.assertIn("step 500 of 500 (100 %)", shown)
        self.assertIn(" left", shown)

    def test_steps_of_the_run_command(self):
        self.LOG = "run 7\nrun ${n}\nrun 1000\n"
        shown, _ = self.follow(self.THERMO)
        self.assertIn("scene: step 500 of 1000 (50 %)", shown)

    def test_unknown_length(self):
        shown, _ = self.follow(self.THERMO)
        self.assertIn("scene: step 500,", shown)
        self.assertNotIn("left", shown)

    def test_numbers_elsewhere_are_no_steps(self):
        shown, _ = self.follow(["  1 2 3", *self.THERMO, "  9 9 9"])
        self.assertEqual(shown.count("step"), 3)

    def test_what_passes_through(self):
        lines = ["Talus gran/penalty: kernels", "  not needed here: history", "  Neighbor list info",
                 "Setting up", "  indented", "WARNING: careful", *self.THERMO,
                 "--- bed ---", "a  1", "", "b  2", "ERROR: no", "Last input line: x"]
        _, said = self.follow(lines)
        self.assertEqual(said, lines[:3] + ["WARNING: careful", "--- bed ---", "a  1",
                                            "ERROR: no", "Last input line: x"])

    def test_rows_of_thermo_output_are_no_part_of_a_warning(self):
        lines = ["WARNING: before", *self.THERMO[:2], "WARNING: between", *self.THERMO[2:4],
                 "Talus gran/penalty: kernels", "  not needed here: history"]
        shown, said = self.follow(lines)
        self.assertEqual(said, [lines[0], "WARNING: between", *lines[-2:]])
        self.assertEqual(shown.count("step"), 3)

    def test_terminal_rewrites_one_line(self):
        shown, _ = self.follow(["Progress: steps 500", *self.THERMO], terminal=True)
        self.assertNotIn("\n", shown)
        self.assertEqual(shown.count("\r"), 3)

    def test_build(self):
        stream = Stream(False)
        progress.follow_build(["[0/2] Re-checking"], progress.Display("build", stream))
        self.assertEqual(stream.getvalue(), "")
        progress.follow_build(["[1/2] a", "noise", "[2/2] b"], progress.Display("build", stream))
        self.assertEqual(stream.getvalue(), "talus: build: 2 of 2 (100 %), 0:00 so far\n")


if __name__ == "__main__":
    unittest.main()
