# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=30 timeout=180
"""Users' programs, begun as the pages say: examples/partner in Python and in C, with the file of environment, pkg-config,
CMake and pip, of the build folder and of what is installed. All print the same digits."""

import importlib.util
import os
import re
import shlex
import shutil
import subprocess
import sys
import unittest

from coupled_case import BUILD, SOURCE
from talus_testing import SceneCase, run_program

MPICC = shlex.split(os.environ.get("TALUS_MPICC", "mpicc"))
CMAKE = os.environ.get("TALUS_CMAKE", "cmake")
SET_BY_FILE = "LAMMPS_PLUGIN_PATH", "PYTHONPATH", "LD_LIBRARY_PATH", "PKG_CONFIG_PATH", "talus_DIR"


def sourced(file):
    """What a file of environment sets, in a shell that had none of it."""
    clean = {key: value for key, value in os.environ.items() if key not in SET_BY_FILE}
    lines = subprocess.run(["sh", "-c", '. "$1"; env', "sh", file], env=clean, check=True, capture_output=True, text=True).stdout
    found = dict(line.split("=", 1) for line in lines.splitlines() if line.startswith(SET_BY_FILE))
    return {key: found.get(key, "") for key in SET_BY_FILE}


class Programs(SceneCase):

    def setUp(self):
        self.folder = shutil.copytree(os.path.join(SOURCE, "examples", "partner"), self.path("partner"))
        with open(os.path.join(self.folder, "partner.c"), "a") as file:    # as own programs will
            file.write("#include <math.h>\ndouble way(double angle);\ndouble way(double angle) { return cos(angle); }\n")

    def make(self, command, env):
        subprocess.run(command, cwd=self.folder, env={**os.environ, **env}, check=True, stdout=subprocess.DEVNULL)

    def said(self, program, env, np=1, arguments=()):
        output = run_program(program, np, arguments, cwd=self.folder, env=env).output
        return re.search(r"^lid at 0\.0\d+ m, -?\d+\.\d+ N of the grains$", output, re.M).group()

    def in_c(self, env, np=1):
        flags = subprocess.run(["pkg-config", "--cflags", "--libs", "talus"], env={**os.environ, **env}, check=True,
                               capture_output=True, text=True).stdout
        self.make([*MPICC, "-Wall", "-Wextra", "-Werror", "partner.c", *shlex.split(flags), "-o", "partner"], env)
        return self.said("./partner", {**env, "LD_LIBRARY_PATH": ""}, np)

    def test_all_say_the_same(self):
        env = sourced(os.path.join(BUILD, "env.sh"))
        first = self.said(sys.executable, env, 1, ["partner.py"])
        height, force = map(float, re.findall(r"-?\d+\.\d+", first))
        self.assertTrue(0.03 < height < 0.045 and 8.0 < force < 12.0, first)    # at rest: 10 N
        self.assertEqual(self.said(sys.executable, env, 2, ["partner.py"]), first)
        self.assertEqual(self.in_c(env), first)
        self.make([CMAKE, "-S", ".", "-B", "made"], env)
        self.make([CMAKE, "--build", "made"], env)
        self.assertEqual(self.said("made/partner", env, 2), first)
        self.turn_into_cplusplus()
        self.make([CMAKE, "-S", ".", "-B", "again"], env)
        self.make([CMAKE, "--build", "again"], env)
        self.assertEqual(self.said("again/partner", env), first)

    def turn_into_cplusplus(self):
        """The same program, in a project that has no C."""
        path = os.path.join(self.folder, "partner")
        os.rename(path + ".c", path + ".cpp")
        for file, old, new in ((path + ".cpp", "char *words", "const char *words"), (path + ".cpp", "(5, words", "(5, const_cast<char **>(words)"),
                               (os.path.join(self.folder, "CMakeLists.txt"), "LANGUAGES C)", "LANGUAGES CXX)"),
                               (os.path.join(self.folder, "CMakeLists.txt"), "partner.c)", "partner.cpp)")):
            with open(file) as opened:
                text = opened.read()
            self.assertEqual(text.count(old), 1)
            with open(file, "w") as opened:
                opened.write(text.replace(old, new))

    def test_of_what_is_installed(self):
        prefix = self.path("installed")
        subprocess.run([CMAKE, "--install", BUILD, "--prefix", prefix], check=True, stdout=subprocess.DEVNULL)
        env = sourced(os.path.join(prefix, "lib", "talus", "talus.env"))
        for key in "LAMMPS_PLUGIN_PATH", "PKG_CONFIG_PATH", "talus_DIR":
            self.assertTrue(env[key].startswith(prefix), key)
        self.assertEqual(self.said(sys.executable, env, 1, ["partner.py"]), self.in_c(env))
        self.make([CMAKE, "-S", ".", "-B", "made"], env)
        self.make([CMAKE, "--build", "made"], env)

    def test_values_of_before_stay(self):
        env = dict(os.environ, PYTHONPATH="/mine", LD_LIBRARY_PATH="")
        said = subprocess.run(["sh", "-c", '. "$1"; echo "$PYTHONPATH $LD_LIBRARY_PATH"', "sh", os.path.join(BUILD, "env.sh")],
                              env=env, check=True, capture_output=True, text=True).stdout
        self.assertRegex(said, r":/mine [^:]+\n$")

    if all(map(importlib.util.find_spec, ("pip", "setuptools", "wheel"))):

        def test_pip(self):
            source = shutil.copytree(os.path.join(SOURCE, "python"), self.path("python"))    # a build writes there
            target = self.path("modules")
            subprocess.run([sys.executable, "-m", "pip", "install", "-q", "--no-index", "--no-build-isolation", "--no-deps",
                            "--target", target, source], check=True, stderr=subprocess.PIPE)
            env = sourced(os.path.join(BUILD, "env.sh"))
            found = subprocess.run([sys.executable, "-c", "import talus; print(talus.__file__, talus._library(None)._name)"],
                                   env={**os.environ, **env, "PYTHONPATH": target}, check=True, capture_output=True, text=True).stdout
            self.assertEqual(found.split(), [os.path.join(target, "talus.py"), os.path.join(BUILD, "libtalus.so")])


if __name__ == "__main__":
    unittest.main()
