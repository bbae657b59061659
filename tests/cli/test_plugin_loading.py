# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: label=smoke timeout=300 procs=2
"""How the plugin is found, what it refuses, and what `cmake --install` leaves."""

import json
import os
import re
import shutil
import subprocess
import sys
import unittest

from talus_testing import *

BUILD = os.environ["TALUS_BINARY_DIR"]
PLUGIN = os.environ["TALUS_PLUGIN"]
CXX = os.environ.get("TALUS_CXX", "g++")
VERSION = os.environ["TALUS_LAMMPS_VERSION"]
VARIANTS = [f"talusstyles-{word}.so" for word in ("avx2", "avx512", "baseline")
            if os.environ.get("TALUS_PORTABLE") == "1"]

BOX = """
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
region box block 0 1 0 1 0 1
create_box 1 box
"""
USE = BOX + "pair_style gran/penalty\n"

FALL = BOX + """
create_atoms 1 single 0.5 0.5 0.5 units box
create_atoms 1 single 0.52 0.5 0.75 units box
set group all diameter 0.2
set group all density 1.0
pair_style gran/penalty
pair_coeff * * hooke 100.0 1.0
fix step all nve/sphere/symplectic gravity 1.0 vector 0 0 -1
fix floor all large/body plane 0 0 0 0 0 1 contact hooke 100.0 1.0
timestep 0.001
thermo_style custom step ke f_floor[3]
run 800
"""

STYLES = [("pair", "gran/penalty"), ("fix", "nve/sphere/symplectic"), ("fix", "large/body")]


class PluginCase(SceneCase):
    def run_without_path(self, script, **options):
        env = {"LAMMPS_PLUGIN_PATH": "", **options.pop("env", {})}
        return self.run_lammps(script, env=env, **options)

    def complaints(self, result):
        return [line for line in result.output.splitlines() if line.startswith("talus: ")]

    def assert_refused(self, *parts, plugin=PLUGIN, np=1, env=None):
        """One line that has all parts, and no style: neither through the command nor the path."""
        for script, path in ((f'plugin load "{plugin}"\n', ""), ("", os.path.dirname(plugin))):
            result = self.run_lammps(script + "plugin list\n" + USE, np=np, expect_error=True,
                                     env={"LAMMPS_PLUGIN_PATH": path, **(env or {})})
            lines = self.complaints(result)
            self.assertEqual(len(lines), 1, result.output)
            for part in parts:
                self.assertIn(part, lines[0])
            self.assertTrue(lines[0].endswith("no style registered"), lines[0])
            self.assertNotIn("style plugin", result.log)
            self.assertIn("nrecognized pair style 'gran/penalty'", result.log)


class Loading(PluginCase):
    def test_plugin_load(self):
        result = self.run_without_path(f'plugin load "{PLUGIN}"\nplugin list\n' + USE)
        for style, name in STYLES:
            self.assertIn(f"{style} style plugin {name}", result.log)
        self.assertEqual(self.complaints(result), [])

    def test_plugin_path(self):
        result = self.run_lammps("plugin list\n" + USE, env={"LAMMPS_PLUGIN_PATH": BUILD})
        for style, name in STYLES:
            self.assertIn(f"{style} style plugin {name}", result.log)

    def test_version(self):
        ours = os.environ["TALUS_VERSION"]
        result = self.run_lammps(f"plugin list\ntalus/{ours}\n" + USE + "pair_coeff * * hooke 1.0 0.0\nrun 0\n",
                                 env={"LAMMPS_PLUGIN_PATH": BUILD})
        self.assertIn(f"command style plugin talus/{ours}\n", result.log)
        self.assertRegex(result.log, f"\nTalus {re.escape(ours)} for LAMMPS [0-9]+ [A-Z][a-z]+ 20[0-9]+, [A-Z]")
        self.assertIn(f"\nTalus {ours}\nTalus: styles of this run\n", result.log)

    def test_loading_twice_does_no_harm(self):
        self.run_lammps(f'plugin load "{PLUGIN}"\nplugin load "{PLUGIN}"\n' + USE)

    def test_clear(self):
        """LAMMPS unloads and loads plugins at `clear`; ours must survive that in use and then compute the same."""
        scene = FALL + "thermo 10\nrun 300\n"    # until both have hit the floor
        for load, path in (("", BUILD), (f'plugin load "{PLUGIN}"\n', "")):
            with self.subTest(load or path):
                log = self.run_lammps(load + scene + "clear\n" + load + scene, env={"LAMMPS_PLUGIN_PATH": path}).log
                before, after = log.split("clear\n", 1)
                self.assertTrue(any(row["f_floor[3]"] for row in thermo(before)), "no contact")
                self.assertEqual(thermo(before), thermo(after))

    def test_launcher(self):
        with open(self.path("in.list"), "w") as file:
            file.write('plugin list\nprint "words: ${words}"\n')
        env = {key: value for key, value in os.environ.items() if key != "LAMMPS_PLUGIN_PATH"}
        for prefix in ([], [os.environ.get("TALUS_MPIEXEC", "mpiexec"), "-np", "2"]):
            result = subprocess.run(
                [*prefix, os.path.join(BUILD, "lmp"), "-in", self.path("in.list"),
                 "-log", "none", "-var", "words", "two words"],
                env=env, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            self.assertIn("pair style plugin gran/penalty", result.stdout)
            self.assertIn("words: two words", result.stdout)


class Objects(PluginCase):
    """Two LAMMPS objects in one process: LAMMPS keeps one list of plugins for both."""

    DRIVER = """
import sys
sys.path.insert(0, {module!r})
from lammps import lammps

def new():
    lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
    if {load!r}:
        lmp.command("plugin load " + {load!r})
    lmp.commands_string(scene)
    return lmp

scene = open("in.scene").read()
first = new()
second = new()
for lmp in (second, first, second):    # in turn
    lmp.command("run 100")
first.close()
second.command("run 100")    # after the end of the one that was first
third = new()
third.command("run 300")
print("energies:", second.get_thermo("ke").hex(), third.get_thermo("ke").hex())
"""

    def run_objects(self, load, path):
        source = os.environ["TALUS_LAMMPS_SOURCE"]
        if not os.path.isdir(os.path.join(source, "python")):
            source = os.path.dirname(source.rstrip("/"))
        with open(self.path("in.scene"), "w") as file:
            file.write(FALL)
        with open(self.path("driver.py"), "w") as file:
            file.write(self.DRIVER.replace("{module!r}", repr(os.path.join(source, "python")))
                       .replace("{load!r}", repr(load)))
        libraries = os.environ["TALUS_LAMMPS_BINARY"] + ":" + os.environ.get("LD_LIBRARY_PATH", "")
        result = run_program(sys.executable, 1, ["driver.py"], cwd=self.dir,
                             env={"LD_LIBRARY_PATH": libraries, "LAMMPS_PLUGIN_PATH": path})
        self.assertEqual(self.complaints(result), [])
        line, = [line for line in result.output.splitlines() if line.startswith("energies:")]
        second, third = line.split()[1:]
        self.assertEqual(second, third, "an object feels the others")
        self.assertGreater(float.fromhex(third), 0.0)

    def test_plugin_path(self):
        self.run_objects("", BUILD)

    def test_plugin_load(self):
        self.run_objects(PLUGIN, "")


class Gate(PluginCase):
    """A library that is loaded before LAMMPS answers in its place."""

    SHIM = r"""
        #include <dlfcn.h>
        #include <cstring>
        extern "C" int NAME(ARGUMENTS) { ANSWER }
        """

    def shim(self, name, arguments, answer):
        source, library = self.path("shim.cpp"), self.path("shim.so")
        with open(source, "w") as file:
            file.write(self.SHIM.replace("NAME", name).replace("ARGUMENTS", arguments)
                       .replace("ANSWER", answer))
        subprocess.run([CXX, "-shared", "-fPIC", source, "-o", library, "-ldl"], check=True)
        before = os.environ.get("LD_PRELOAD")
        return {"LD_PRELOAD": f"{before}:{library}" if before else library}    # sanitizers first

    def other_size(self, setting, size):
        return self.shim("lammps_extract_setting", "void *lmp, const char *name", """
            if (strcmp(name, "%s") == 0) return %d;
            using Real = int (*)(void *, const char *);
            return ((Real) dlsym(RTLD_NEXT, "lammps_extract_setting"))(lmp, name);
            """ % (setting, size))

    def test_other_version(self):
        env = self.shim("lammps_version", "void *", "return 20990101;")
        self.assert_refused(f"built for LAMMPS {VERSION}", "the host is LAMMPS 20990101",
                            "scripts/build --host", env=env)

    def test_one_line_for_all_ranks(self):
        env = self.shim("lammps_version", "void *", "return 20990101;")
        self.assert_refused("20990101", np=2, env=env)

    def test_other_tagint(self):
        other = 4 if os.environ["TALUS_SIZES"] == "bigbig" else 8
        self.assert_refused(f"tagint {12 - other} bytes", f"tagint {other} bytes",
                            env=self.other_size("tagint", other))

    def test_other_bigint(self):
        self.assert_refused("bigint 8 bytes", "bigint 4 bytes", env=self.other_size("bigint", 4))

    def test_other_mpi(self):
        env = self.shim("lammps_config_has_mpi_support", "", "return 0;")
        self.assert_refused("MPI handle 0 bytes", env=env)

    def test_host_without_granular_styles(self):
        env = self.shim("lammps_config_has_package", "const char *name", """
            if (strcmp(name, "GRANULAR") == 0) return 0;
            using Real = int (*)(const char *);
            return ((Real) dlsym(RTLD_NEXT, "lammps_config_has_package"))(name);
            """)
        self.assert_refused("a LAMMPS with package GRANULAR, which the host lacks",
                            "build LAMMPS with PKG_GRANULAR on", env=env)

    def test_override_for_developers(self):
        env = self.shim("lammps_version", "void *", "return 20990101;")
        self.run_lammps(USE, env={"LAMMPS_PLUGIN_PATH": BUILD, "TALUS_SKIP_ABI_CHECK": "1", **env})
        self.assert_refused("20990101", env={"TALUS_SKIP_ABI_CHECK": "0", **env})

    def test_another_processor(self):
        """By the gate alone, which has no instructions that not all processors have."""
        folder = os.path.join(BUILD, "elsewhere")
        for np in 1, 2:
            for load, path in (f'plugin load "{folder}/talusplugin.so"\n', ""), ("", folder):
                result = self.run_lammps(load + 'print "REACHED"\n', np=np, expect_error=True, env={"LAMMPS_PLUGIN_PATH": path})
                text = " ".join((result.log + result.output).split())
                self.assertRegex(text, "ERROR[^:]*: Talus: this plugin was built for another processor than that of this machine, "
                                       "which lacks the instructions (avx, )?avx1024f; build it here with scripts/build, or for "
                                       "all machines with scripts/build --portable")
                self.assertEqual(text.count("ERROR on proc"), 1)    # by the rank that writes the log
                self.assertNotIn("\nREACHED", result.log)

    def test_half_of_the_plugin(self):
        folder = self.path("half")
        os.makedirs(folder)
        plugin = shutil.copy(PLUGIN, folder)
        self.assert_refused("talusstyles.so", "in one folder", plugin=plugin)

    def test_link_to_the_plugin(self):
        """The second file is beside the first itself, not beside a link to it."""
        folder = self.path("links")
        os.makedirs(os.path.join(folder, "deep"))
        os.symlink(PLUGIN, os.path.join(folder, "talusplugin.so"))
        os.symlink("../talusplugin.so", os.path.join(folder, "deep", "another-plugin.so"))
        for path in (folder, os.path.join(folder, "deep")):
            result = self.run_lammps("plugin list\n" + USE, env={"LAMMPS_PLUGIN_PATH": path})
            self.assertIn("pair style plugin gran/penalty", result.log)
        result = self.run_without_path(f'plugin load "{folder}/deep/another-plugin.so"\n' + USE)
        self.assertEqual(self.complaints(result), [])

    def test_halves_of_two_builds(self):
        folder = self.path("mixed")
        os.makedirs(folder)
        plugin = shutil.copy(PLUGIN, folder)
        with open(self.path("empty.cpp"), "w") as file:
            file.write("int talus_test_symbol = 0;\n")
        subprocess.run([CXX, "-shared", "-fPIC", self.path("empty.cpp"),
                        "-o", os.path.join(folder, "talusstyles.so")], check=True)
        self.assert_refused("from another build", plugin=plugin)

    def test_the_gate_needs_nothing_of_lammps(self):
        """With an undefined symbol of LAMMPS it could not even be opened by another version."""
        listing = subprocess.run(["nm", "-D", "--undefined-only", PLUGIN], check=True,
                                 capture_output=True, text=True).stdout
        for name in ("LAMMPS", "lammps", "MPI", "mpi", "fmt"):
            self.assertNotIn(name, listing)


class Install(PluginCase):
    def test_install_and_environment_file(self):
        prefix = self.path("prefix with space")
        subprocess.run([os.environ.get("TALUS_CMAKE", "cmake"), "--install", BUILD,
                        "--prefix", prefix], check=True, stdout=subprocess.DEVNULL)
        folder = os.path.join(prefix, "lib", "talus")
        self.assertEqual(sorted(os.listdir(folder)),
                         ["libtalus.so", "package", "talus.env", "talus.py", "talus_precice.py", "talusplugin.so", *VARIANTS,
                          "talusstyles.so"])
        for before, expected in (("", folder), ("/else", folder + ":/else")):
            path = subprocess.run(
                ["sh", "-c", '. "$1"; printf %s "$LAMMPS_PLUGIN_PATH"', "sh",
                 os.path.join(folder, "talus.env")], check=True, capture_output=True, text=True,
                env={**os.environ, "LAMMPS_PLUGIN_PATH": before}).stdout
            self.assertEqual(path, expected)
        result = self.run_lammps("plugin list\n" + USE, env={"LAMMPS_PLUGIN_PATH": folder})
        self.assertIn("pair style plugin gran/penalty", result.log)


    def test_configured_for_an_installed_host(self):
        """Preset installed: what the program says of itself gives the same build as its build directory."""
        build = self.path("build")
        env = {**os.environ, "LAMMPS_SOURCE_DIR": os.environ["TALUS_LAMMPS_SOURCE"]}
        subprocess.run([os.environ.get("TALUS_CMAKE", "cmake"), "-S", os.environ["TALUS_SOURCE_DIR"],
                        "--preset", "installed", "-B", build,
                        "-D", "LAMMPS_EXECUTABLE=" + os.environ["TALUS_LMP"],
                        "-D", "MPI_CXX_COMPILER=" + os.environ["TALUS_MPICXX"]],
                       check=True, stdout=subprocess.DEVNULL, env=env)

        def definitions(folder):
            with open(os.path.join(folder, "compile_commands.json")) as file:
                command, = [entry["command"] for entry in json.load(file)
                            if entry["file"].endswith("talusplugin.cpp") and "talusplugin_EXPORTS" in entry["command"]]
            # NDEBUG tells how the build is optimized
            return sorted(set(re.findall(r"-D *([^ ]+)", command)) - {"NDEBUG"})
        self.assertEqual(definitions(build), definitions(BUILD))
        presets = subprocess.run([os.environ.get("TALUS_CMAKE", "cmake"), "--list-presets=all"],
                                 check=True, capture_output=True, text=True,
                                 cwd=os.environ["TALUS_SOURCE_DIR"]).stdout
        for name in ("default", "installed", "portable"):
            self.assertIn(f'"{name}"', presets)


if __name__ == "__main__":
    unittest.main()
