# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=600
"""A portable build: which instructions it takes, what it refuses, and that all of them give the same bits."""

import itertools
import os
import re
import shutil
import subprocess
import unittest

import session_scene
from session_scene import PAIR, START
from talus_testing import SceneCase, read_dump, write_sphere_data

BUILD = os.environ["TALUS_BINARY_DIR"]
CXX = os.environ.get("TALUS_CXX", "g++")
WORDS = ["baseline", "avx2", "avx512"]
LOGGED = {"baseline": "SSE2", "avx2": "AVX2", "avx512": "AVX-512"}


def runnable():
    """Words that this machine can run, by what its kernel says."""
    with open("/proc/cpuinfo") as file:
        flags = set(re.search(r"^flags\s*:(.*)", file.read(), re.MULTILINE)[1].split())
    return [word for word, needed in zip(WORDS, (set(), {"avx2", "fma", "bmi2"}, {"avx512f", "avx512vl", "avx512dq"}))
            if needed <= flags]


CAN_RUN = runnable()

# of every kind, and a body that is hit and turns: sums in its integrator are those of a library
SPEED, STEPS = 10.0, 300
BALL = (f"sphere 5 4 12  1.5 outside contact {session_scene.LAW} move free mass 20 inertia 15 18 21 "
        f"velocity 0 0 {-SPEED} spin 1 2 3")
BALL_STATE = range(7, 20)
LAWS = {
    "hertz multistep": "hertz 4000.0 40.0 tangential multistep NULL NULL 0.5",
    "onestep rolling": "hooke 4000.0 20.0 tangential onestep NULL NULL 0.5 rolling 0.1 spinning 0.1",
    "material adhesion": "hertz/material 4000.0 0.5 0.3 tangential multistep NULL NULL 0.5 rolling 0.1 adhesion constant 1.0",
    "tanh": "plaincoulomb/material 4000.0 0.5 0.3 0.5",
    "flores": "flores/material 4000.0 0.5 0.3 2.0 tangential multistep NULL NULL 0.5",
    "frictionless": "hertz 4000.0 40.0",
}


def scene(law, run_style="verlet"):
    physics = session_scene.PHYSICS.format(ylo=session_scene.PLANE).replace(session_scene.LAW, law)
    return (START + "read_data grains\n" + PAIR.replace(session_scene.LAW, law) + physics +
            f"fix ball all large/body {BALL}\nthermo 100\nrun_style {run_style}\nrun {STEPS}\n"
            "write_dump all custom end id x y z vx vy vz omegax omegay omegaz modify format float %a\n" +
            "".join(f'print "ball $(f_ball[{k}]:%.17g)"\n' for k in BALL_STATE))


class Portable(SceneCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), session_scene.BOX[:2] + ((-1, 30),), session_scene.grains(1.2))

    def isa(self, word):
        return {"TALUS_ISA": word} if word else {}

    def assert_takes(self, word, script=None, np=1, **env):
        result = self.run_lammps(script or scene(LAWS["frictionless"]).replace(f"run {STEPS}", "run 0"), np=np, env=env)
        found = re.findall(r"\d+ kernel\(s\), (.*)", result.log)
        self.assertEqual(found, [LOGGED[word]] * len(found))
        self.assertGreater(len(found), 0)
        return result

    def refused(self, np=1, path=BUILD, before="", **env):
        """The one line that ends a run, by the command and by the path."""
        lines = []
        for script, plugin_path in (("", path), (f'plugin load "{path}/talusplugin.so"\n', "")):
            result = self.run_lammps(script + 'print "REACHED"\n', np=np, expect_error=True,
                                     env={"LAMMPS_PLUGIN_PATH": plugin_path, **env})
            self.assertNotIn("\nREACHED", result.log)
            text = " ".join((result.log + result.output).split())
            lines.append(re.search(r"ERROR: (Talus: .*?)(?= \(src| Last input| For more|$)", text)[1])
        self.assertEqual(lines[0], lines[1])
        return lines[0]


class Choice(Portable):

    def test_the_fastest_by_itself(self):
        for np in 1, 2:
            self.assert_takes(CAN_RUN[-1], np=np)

    def test_on_request(self):
        for word in CAN_RUN:
            self.assert_takes(word, TALUS_ISA=word)
        self.assert_takes(CAN_RUN[-1], TALUS_ISA="")

    def test_a_wrong_word(self):
        for np in 1, 2:
            self.assertEqual(self.refused(np=np, TALUS_ISA="AVX2"),
                             "Talus: the environment variable TALUS_ISA is 'AVX2', which is no instruction set of Talus; "
                             f"use one of: {', '.join(CAN_RUN)}; or unset it, and Talus takes the fastest of them")

    def slower_rank(self):
        """On rank 1, the first minimum of one int that anybody asks for, which is that of the instruction sets, is 0."""
        with open(self.path("slower.cpp"), "w") as file:
            file.write("""#include <mpi.h>
                extern "C" int MPI_Allreduce(const void *send, void *receive, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm)
                {
                  static bool asked = false;
                  int rank, zero = 0;
                  PMPI_Comm_rank(comm, &rank);
                  if (op == MPI_MIN && n == 1 && type == MPI_INT && !asked) {
                    asked = true;
                    if (rank == 1) send = &zero;
                  }
                  return PMPI_Allreduce(send, receive, n, type, op, comm);
                }
                """)
        subprocess.run(["mpicxx", "-shared", "-fPIC", self.path("slower.cpp"), "-o", self.path("slower.so")],
                       check=True, env={**os.environ, "OMPI_CXX": CXX})
        return self.path("slower.so")

    def test_all_ranks_take_what_the_slowest_can_run(self):
        env = {"LD_PRELOAD": self.slower_rank()}
        self.assert_takes("baseline", np=2, **env)
        self.assertIn("'avx2', which not all ranks of this run can execute; use one of: baseline;",
                      self.refused(np=2, TALUS_ISA="avx2", **env))

    def test_a_file_is_missing(self):
        folder = self.path("part")
        os.makedirs(folder)
        for name in "talusplugin.so", "talusstyles.so", "talusstyles-baseline.so":
            shutil.copy(os.path.join(BUILD, name), folder)
        for np in 1, 2:
            line = self.refused(np=np, path=folder, TALUS_ISA=CAN_RUN[-1])
            self.assertIn(f"talusstyles-{CAN_RUN[-1]}.so", line)
            self.assertIn("of one build in one folder", line)
        self.assert_takes("baseline", LAMMPS_PLUGIN_PATH=folder, TALUS_ISA="baseline")
        shutil.copy(os.path.join(folder, "talusstyles-baseline.so"), os.path.join(folder, f"talusstyles-{CAN_RUN[-1]}.so"))
        self.assertIn("is from another build", self.refused(path=folder, TALUS_ISA=CAN_RUN[-1]))

    def test_unloading(self):
        """Styles of a file behind the one that LAMMPS knows: in use, unloaded, loaded again, and at `clear`."""
        plugin = os.path.join(BUILD, "talusplugin.so")
        load = f'plugin load "{plugin}"\n'
        use = scene(LAWS["hertz multistep"], "verlet").replace(f"run {STEPS}", "run 20")
        use = use[:use.index("write_dump")]
        unload = "plugin unload pair gran/penalty\nplugin unload fix large/body\n"
        for word in CAN_RUN:
            for np in 1, 2:
                script = load + use + unload + load + "clear\n" + load + use + "plugin clear\n" + load + "clear\n"
                self.assert_takes(word, script, np=np, LAMMPS_PLUGIN_PATH="", TALUS_ISA=word)


class SameBits(Portable):

    def end(self, law, word, np):
        result = self.assert_takes(word, scene(law), np=np, TALUS_ISA=word)
        return read_dump(self.path("end"))[0], re.findall(r"^ball (\S+)$", result.log, re.MULTILINE)

    def test_all_laws_on_all_sets(self):
        for name, law in LAWS.items():
            with self.subTest(name):
                frame, ball = self.end(law, "baseline", 1)
                self.assertEqual(len(ball), len(BALL_STATE))
                self.assertGreater(float(ball[9]), -0.99 * SPEED)     # grains slow it down
            for word, np in itertools.product(CAN_RUN, (1, 2)):
                with self.subTest(name, word=word, np=np):
                    other, other_ball = self.end(law, word, np)
                    self.assert_same_bits(frame, other)
                    self.assertEqual(ball, other_ball)


if __name__ == "__main__":
    unittest.main()
