# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=25 timeout=300 label=hostless
"""What the scripts say when something is missing: one message, with the cure, and a failure.

The hosts here are stubs: a few files that look like a LAMMPS source tree or build directory.
"""

import glob
import os
import shutil
import subprocess
import tempfile
import unittest

ROOT = os.environ.get("TALUS_SOURCE_DIR") or os.path.abspath(
    os.path.join(os.path.dirname(__file__), "..", ".."))
BUILD = os.path.join(ROOT, "scripts", "build")


def write(path, text, executable=False):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w") as file:
        file.write(text)
    if executable:
        os.chmod(path, 0o755)
    return path


class ScriptCase(unittest.TestCase):
    def setUp(self):
        self.dir = tempfile.mkdtemp(prefix="talus cli ")    # scripts must survive a space
        self.addCleanup(shutil.rmtree, self.dir, ignore_errors=True)

    def path(self, *names):
        return os.path.join(self.dir, *names)

    # ---- stubs -------------------------------------------------------------------------------

    def source_tree(self, version="4 Feb 2025", name="tree"):
        write(self.path(name, "src", "version.h"), f'#define LAMMPS_VERSION "{version}"\n')
        for header in ("lammpsplugin.h", "pair.h"):
            write(self.path(name, "src", header), "")
        write(self.path(name, "cmake", "CMakeLists.txt"), "")
        return self.path(name)

    def build_directory(self, lmp="#!/bin/sh\n", **changes):
        options = {"LAMMPS_SIZES": "smallbig", "BUILD_MPI": "on", "BUILD_OMP": "on",
                   "BUILD_SHARED_LIBS": "on", "PKG_PLUGIN": "on", "PKG_GRANULAR": "on", **changes}
        lines = [f"{key}:STRING={value}" for key, value in options.items()]
        lines.append(f"CMAKE_HOME_DIRECTORY:INTERNAL={self.source_tree()}/cmake")
        write(self.path("host", "CMakeCache.txt"), "\n".join(lines) + "\n")
        if lmp:
            write(self.path("host", "lmp"), lmp, executable=True)
        return self.path("host")

    def host_with_foreign_mpi(self):
        """A build directory whose lmp is linked to a libmpi that is not the one of this machine."""
        host = self.build_directory(lmp=None)
        compiler = os.environ.get("TALUS_CXX", "g++")
        write(self.path("mpi.cpp"), 'extern "C" int MPI_Init() { return 0; }\n')
        write(self.path("lmp.cpp"), 'extern "C" int MPI_Init(); int main() { return MPI_Init(); }\n')
        library = self.path("libmpi.so.99")
        subprocess.run([compiler, "-shared", "-fPIC", "-Wl,-soname,libmpi.so.99",
                        self.path("mpi.cpp"), "-o", library], check=True)
        subprocess.run([compiler, self.path("lmp.cpp"), library, f"-Wl,-rpath,{self.dir}",
                        "-o", os.path.join(host, "lmp")], check=True)
        return host

    def command(self, name, text):
        """A program that is found before the system's."""
        write(self.path("bin", name), "#!/bin/sh\n" + text, executable=True)

    def hide(self, *names):
        """A PATH without some programs: links to everything else."""
        folder = self.path("hidden")
        os.makedirs(folder, exist_ok=True)
        for directory in os.environ["PATH"].split(os.pathsep):
            for name in os.listdir(directory) if os.path.isdir(directory) else []:
                link = os.path.join(folder, name)
                if name not in names and not os.path.lexists(link):
                    os.symlink(os.path.join(directory, name), link)
        self.search_path = folder

    # ---- running -----------------------------------------------------------------------------

    search_path = os.environ["PATH"]

    def run_command(self, command, **environment):
        env = {key: value for key, value in os.environ.items()
               if key not in ("LAMMPS_SOURCE_DIR", "LAMMPS_BINARY_DIR", "LAMMPS_EXECUTABLE", "LAMMPS_PLUGIN_PATH", "CI", "TALUS_INPUTS",
                              "TALUS_STRICT", "TALUS_LARGE_TESTS", "TALUS_ARCH")}
        env.update({"PATH": self.path("bin") + os.pathsep + self.search_path,
                    "XDG_CACHE_HOME": self.path("cache"), "TALUS_SKIP_PACKAGES": "1",
                    **environment})
        return subprocess.run(command, env=env, stdin=subprocess.DEVNULL, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=120)

    def build(self, *arguments, **environment):
        return self.run_command([BUILD, "--build-dir", self.path("build"), *arguments],
                                **environment)

    def assert_message(self, result, *parts):
        """The last line is the message, it is the only one, and it has all parts."""
        lines = result.stdout.strip().splitlines()
        self.assertNotEqual(result.returncode, 0, result.stdout)
        self.assertTrue(lines and lines[-1].startswith("talus: "), result.stdout)
        for part in parts:
            self.assertIn(part, lines[-1])
        return lines


class InstalledHost(ScriptCase):
    """A program in the place of a build directory: preset installed."""

    ANSWER = """
Large-scale Atomic/Molecular Massively Parallel Simulator - {version}

Compiler: GNU C++ 12.2.0 with OpenMP 4.5
MPI v3.1: Open MPI v4.1.4

-DLAMMPS_{sizes}

Installed packages:

{packages}

List of individual style options included in this LAMMPS executable
"""

    def configure(self, version="4 Feb 2025", sizes="SMALLBIG", packages="GRANULAR PLUGIN RIGID", source=True, **more):
        self.command("lmp", "cat <<'END'" + self.ANSWER.format(version=version, sizes=sizes, packages=packages) + "END\n")
        environment = {"LAMMPS_SOURCE_DIR": self.source_tree()} if source else {}
        return self.run_command(
            [os.environ.get("TALUS_CMAKE", "cmake"), "-S", ROOT, "--preset", "installed", "-B", self.path("build")],
            **environment, **more)

    def assert_refused(self, result, *parts):
        self.assertNotEqual(result.returncode, 0, result.stdout)
        words = " ".join(result.stdout.split())
        self.assertEqual(words.count("talus: "), 1, result.stdout)
        for part in parts:
            self.assertIn(part, words)

    def test_what_does_not_fit(self):
        self.assert_refused(self.configure(source=False), "LAMMPS_EXECUTABLE needs LAMMPS_SOURCE_DIR")
        self.assert_refused(self.configure(version="2 Apr 2025"), "is LAMMPS 2 Apr 2025", "that of 4 Feb 2025")
        self.assert_refused(self.configure(packages="GRANULAR RIGID"), "no package PLUGIN", "-D PKG_PLUGIN=on")
        self.assert_refused(self.configure(sizes="SMALLSMALL"), "integer sizes 'smallsmall'")
        self.assert_refused(self.configure(LAMMPS_EXECUTABLE="nonsense", version="x"), "does not answer as LAMMPS does")

    def test_no_such_program(self):
        result = self.run_command([os.environ.get("TALUS_CMAKE", "cmake"), "-S", ROOT, "--preset", "installed", "-B",
                                   self.path("build"), "-D", "LAMMPS_EXECUTABLE=lmp-of-mine"])
        self.assert_refused(result, "no program 'lmp-of-mine'")


class Arguments(ScriptCase):
    def test_words(self):
        table = [
            (["--hots", "x"], "unknown option '--hots'", "--help"),
            (["--host"], "--host needs a value", "--help"),
            (["--sizes", "smallsmall"], "smallbig or bigbig", "smallsmall"),
            (["--host", "17Apr2024"], "no such directory", "4Feb2025"),
        ]
        for arguments, *parts in table:
            with self.subTest(arguments=arguments):
                self.assertEqual(len(self.assert_message(self.build(*arguments), *parts)), 1)

    def test_portable(self):
        self.assert_message(self.build("--portable", "--sanitize"), "exclude each other", "--help")
        self.assert_message(self.build("--portable", TALUS_ARCH="znver4"), "TALUS_ARCH=znver4", "unset TALUS_ARCH")
        self.command("old-compiler", "exit 1\n")
        self.assert_message(self.build("--portable", CXX="old-compiler"), "old-compiler does not know", "set CXX")
        self.command("uname", "echo riscv64\n")
        self.assert_message(self.build("--portable"), "for x86-64 machines, and this is riscv64")

    def test_run_and_test_scripts(self):
        run = os.path.join(ROOT, "scripts", "run")
        table = [
            ([run, "-np", "0"], "-np needs a number of 1 or more"),
            ([run, "-nt"], "-nt needs a number"),
            ([run, "-var", "n"], "-var needs a name and a value"),
            ([run, "--fast"], "unknown option '--fast'"),
            ([run, "no-such-scene"], "no input script 'no-such-scene'"),
        ]
        for command, *parts in table:
            with self.subTest(command=command[1:]):
                self.assert_message(self.run_command(command), *parts)

    def test_help(self):
        for name in ("build", "run", "test"):
            result = self.run_command([os.path.join(ROOT, "scripts", name), "--help"])
            self.assertEqual(result.returncode, 0)
            self.assertIn(f"usage: scripts/{name}", result.stdout)


class SourceTrees(ScriptCase):
    def test_not_a_tree(self):
        os.makedirs(self.path("empty"))
        self.assert_message(self.build("--host", self.path("empty")),
                            "is not a LAMMPS source tree", "4 Feb 2025 or newer")

    def test_too_old(self):
        for version in ("3 Feb 2025", "2 Aug 2023", "29 Aug 2024"):
            with self.subTest(version=version):
                tree = self.source_tree(version)
                self.assert_message(self.build("--host", tree), "too old", "--host 4Feb2025")
                self.assert_message(self.build(LAMMPS_SOURCE_DIR=os.path.join(tree, "src")),
                                    "too old")

    def test_broken_tree_says_where_to_look(self):
        tree = self.source_tree()
        write(os.path.join(tree, "cmake", "CMakeLists.txt"), 'message(FATAL_ERROR "made up")\n')
        result = self.build("--host", tree)
        self.assert_message(result, "could not be configured", "configure.log")
        self.assertIn("made up", result.stdout)


class BuildDirectories(ScriptCase):
    def test_options_of_the_host(self):
        table = [
            ({"PKG_PLUGIN": "off"}, "no package PLUGIN", "-D PKG_PLUGIN=on"),
            ({"BUILD_MPI": "off"}, "without MPI", "-D BUILD_MPI=on"),
            ({"LAMMPS_SIZES": "smallsmall"}, "'smallsmall'", "-D LAMMPS_SIZES=smallbig"),
            ({"lmp": None}, "is not built", "cmake --build"),
        ]
        for changes, *parts in table:
            with self.subTest(changes=changes):
                shutil.rmtree(self.path("host"), ignore_errors=True)
                host = self.build_directory(**changes)
                self.assertEqual(len(self.assert_message(self.build("--host", host), *parts)), 1)

    def test_other_integer_sizes(self):
        host = self.build_directory(LAMMPS_SIZES="bigbig")
        result = self.build("--host", host, "--sizes", "smallbig")
        self.assert_message(result, "smallbig was asked for", "has bigbig", "drop --sizes")

    def test_other_mpi(self):
        result = self.build("--host", self.host_with_foreign_mpi())
        self.assert_message(result, "another MPI", "libmpi.so.99", "rebuild the host")

    def test_pair_that_does_not_belong_together(self):
        host = self.build_directory()
        other = self.source_tree("4 Jul 2026", name="other tree")
        result = self.build(LAMMPS_BINARY_DIR=host, LAMMPS_SOURCE_DIR=other)
        self.assert_message(result, "was built from", "belongs together")

    def test_not_a_build_directory(self):
        os.makedirs(self.path("empty"))
        self.assert_message(self.build(LAMMPS_BINARY_DIR=self.path("empty")),
                            "not a build directory of LAMMPS", "scripts/build")


class Tools(ScriptCase):
    """What a machine without Debian's packages may lack: one line, before anything is built."""

    def assert_said_at_once(self, *parts, **environment):
        lines = self.assert_message(self.build(**environment), *parts)
        self.assertEqual(len(lines), 1)

    def compiler(self, *macros):
        self.command("old compiler", "".join(f"echo '#define {macro}'\n" for macro in macros))
        return self.path("bin", "old compiler")

    def test_compilers_that_are_too_old(self):
        self.assert_said_at_once("is GCC 9, which is too old", "set CXX to GCC 10, Clang 14 or newer",
                                 CXX=self.compiler("__GNUC__ 9"))
        self.assert_said_at_once("is Clang 13, which is too old", "set CXX to Clang 14",
                                 CXX=self.compiler("__GNUC__ 4", "__clang_major__ 13"))

    def test_no_such_compiler(self):
        self.assert_said_at_once("there is no compiler 'g++-99'", "set CXX", CXX="g++-99")

    def test_no_cmake(self):
        self.hide("cmake")
        self.assert_said_at_once("there is no cmake", "CMake 3.22")

    def test_no_build_tool(self):
        self.hide("ninja", "make")
        self.assert_said_at_once("neither ninja nor make")

    def test_no_mpi(self):
        self.hide("mpicxx")
        self.assert_said_at_once("no MPI: there is no mpicxx", "libopenmpi-dev", "MPICXX")
        self.search_path = ScriptCase.search_path
        self.assert_said_at_once("no MPI: there is no mpicxx.of-nowhere", MPICXX="mpicxx.of-nowhere")

    def test_no_eigen(self):
        """From the scripts and from plain CMake. Not found: neither its package nor its folder."""
        without = "-DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON -DCMAKE_IGNORE_PATH=/usr/include/eigen3"
        host = self.build_directory()
        self.assert_said_at_once("Eigen 3.3 or newer is missing", "libeigen3-dev", "EIGEN3_ROOT", LAMMPS_BINARY_DIR=host,
                                 TALUS_CMAKE_OPTIONS=without)
        plain = [os.environ.get("TALUS_CMAKE", "cmake"), "-S", ROOT, "-B", self.path("plain"), *without.split()]
        result = self.run_command(plain, LAMMPS_BINARY_DIR=host)
        self.assertIn("talus: Eigen 3.3 or newer is missing", " ".join(result.stdout.split()))
        write(self.path("eigen", "Eigen", "Core"), "")
        result = self.run_command(plain, LAMMPS_BINARY_DIR=host, EIGEN3_ROOT=self.path("eigen"))
        self.assertNotIn("Eigen", result.stdout)


class Apt(ScriptCase):
    """apt is replaced by stubs: nothing is downloaded."""

    SOURCE = 'if [ "$1" = indextargets ]; then echo "http://sources.example/debian stable main"; fi\n'

    def test_no_apt(self):
        self.hide("apt-get")
        self.assert_message(self.build(), "no apt-get", "LAMMPS_SOURCE_DIR")

    def test_no_debian_mirror(self):
        self.command("apt-get", 'echo "http://sources.example/debian stable contrib"\n')
        self.assert_message(self.build(), "no Debian mirror", "LAMMPS_SOURCE_DIR")

    def test_no_network(self):
        self.command("apt-get", self.SOURCE + "[ $1 != update ]\n")
        self.assert_message(self.build(), "network", "LAMMPS_SOURCE_DIR")

    def test_a_newer_version_is_taken(self):
        """A suite of Debian moves on: what it has now is tried, and named."""
        self.command("apt-get", self.SOURCE + "[ $1 != source ]\n")
        self.command("apt-cache", "printf 'Version: %s\\n' 20250722+dfsg-2 20990101+dfsg-1 20260704+dfsg-3\n")
        result = self.build()
        self.assertIn("talus: Debian 'trixie' has lammps 20990101+dfsg-1 in the place of 20250204+dfsg.1: taking that",
                      result.stdout)
        self.assert_message(result, "the source of lammps 20990101+dfsg-1 could not be downloaded")
        newer = glob.glob(self.path("cache", "talus", "host-4Feb2025-*", "newer"))
        with open(newer[0]) as file:
            self.assertEqual(file.read(), "20990101+dfsg-1\n")

    def test_no_version_at_all(self):
        self.command("apt-get", self.SOURCE)
        self.command("apt-cache", "true\n")
        self.assert_message(self.build(), "'trixie' has no source of lammps", "LAMMPS_SOURCE_DIR")

    def test_download_breaks_off(self):
        self.command("apt-get", self.SOURCE + "[ $1 != source ]\n")
        self.command("apt-cache", "echo 'Version: 20250204+dfsg.1-9'\n")
        self.assert_message(self.build(), "could not be downloaded", "LAMMPS_SOURCE_DIR")

    def test_missing_packages_without_rights(self):
        self.hide("sudo")
        self.command("id", "echo 1000\n")
        self.command("dpkg-query", "exit 1\n")
        result = self.build(TALUS_SKIP_PACKAGES="")
        self.assert_message(result, "missing Debian packages", "libopenmpi-dev", "as root run")

    def test_missing_packages_that_apt_cannot_install(self):
        self.command("dpkg-query", 'eval last=\\${$#}; [ "$last" = cmake ] || echo installed\n')
        self.command("apt-get", "echo 'E: no luck'; exit 100\n")
        self.command("id", "echo 0\n")
        result = self.build(TALUS_SKIP_PACKAGES="")
        self.assert_message(result, "could not install: cmake", "network")
        self.assertIn("E: no luck", result.stdout)


class InterruptedHostBuild(ScriptCase):
    """The cache of hosts with a stub tarball, cmake and ninja, which log their calls."""

    def setUp(self):
        super().setUp()
        tree = self.source_tree(name="lammps-stub")
        for name in ("LICENSE", "README", "bench/x", "lib/x", "python/x", "unittest/x"):
            write(os.path.join(tree, name), "")
        self.tarball = self.path("lammps_20250204+dfsg.1.orig.tar.gz")
        subprocess.run(["tar", "-C", self.dir, "-czf", self.tarball, "lammps-stub"], check=True)
        self.command("apt-get", Apt.SOURCE + f"echo $1 >> '{self.path('calls')}'\n"
                     f"[ $1 != source ] || cp '{self.tarball}' .\n")
        self.command("apt-cache", "echo 'Version: 20250204+dfsg.1-9'\n")
        self.command("cmake", f"echo cmake >> '{self.path('calls')}'\n")
        self.working_ninja()

    def working_ninja(self):
        # called as: ninja -C DIR ...
        self.command("ninja", f"echo ninja >> '{self.path('calls')}'\n"
                     'mkdir -p "$2" && touch "$2/lmp" "$2/liblammps.so" && chmod +x "$2/lmp"\n')

    def prepare(self):
        """Make the host ready; return what was called for that."""
        if os.path.exists(self.path("calls")):
            os.remove(self.path("calls"))
        result = self.run_command(["bash", "-euo", "pipefail", "-c",
                                   f'. "{ROOT}/scripts/lib/all.sh"; prepare_host "" ""; '
                                   'printf "HOST %s\\n" "$HOST_BINARY"'])
        calls = []
        if os.path.exists(self.path("calls")):
            with open(self.path("calls")) as file:
                calls = file.read().split()
        return result, [name for name in calls if name not in ("update", "indextargets")]

    def host(self):
        cache = self.path("cache", "talus")
        return next(os.path.join(cache, name) for name in os.listdir(cache)
                    if os.path.isdir(os.path.join(cache, name)))

    def test_a_finished_host_is_used_as_it_is(self):
        result, calls = self.prepare()
        self.assertEqual((result.returncode, calls), (0, ["source", "cmake", "ninja"]),
                         result.stdout)
        result, calls = self.prepare()
        self.assertEqual((result.returncode, calls), (0, []), result.stdout)
        self.assertIn(f"HOST {self.host()}/build", result.stdout)

    def test_an_interrupted_build_is_finished(self):
        self.command("ninja", "kill -9 $$\n")
        result, _ = self.prepare()
        self.assert_message(result, "could not be built", "build.log")
        self.assertFalse(os.path.exists(os.path.join(self.host(), "stamp")))
        self.working_ninja()
        result, calls = self.prepare()
        self.assertEqual((result.returncode, calls), (0, ["cmake", "ninja"]), result.stdout)
        self.assertIn("interrupted", result.stdout)

    def test_an_interrupted_unpacking_is_done_again(self):
        self.prepare()
        host = self.host()
        for name in ("stamp", "src.stamp", os.path.join("src", "src", "version.h")):
            os.remove(os.path.join(host, name))
        result, calls = self.prepare()
        self.assertEqual((result.returncode, calls), (0, ["source", "cmake", "ninja"]),
                         result.stdout)
        self.assertTrue(os.path.exists(os.path.join(host, "src", "src", "version.h")))

    def test_a_stamp_without_the_program_is_not_believed(self):
        self.prepare()
        os.remove(os.path.join(self.host(), "build", "lmp"))
        result, calls = self.prepare()
        self.assertEqual((result.returncode, calls), (0, ["cmake", "ninja"]), result.stdout)

    def test_a_tarball_without_top_folder(self):
        subprocess.run(["tar", "-C", self.path("lammps-stub"), "-czf", self.tarball,
                        *sorted(os.listdir(self.path("lammps-stub")))], check=True)
        result, _ = self.prepare()
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertTrue(os.path.exists(os.path.join(self.host(), "src", "unittest", "x")))

    def test_a_broken_tarball(self):
        write(self.tarball, "this is no archive\n")
        result, _ = self.prepare()
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("talus: cannot unpack", result.stdout)


if __name__ == "__main__":
    unittest.main()
