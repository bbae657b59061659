# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=180 label=portable cost=25
"""scripts/package: what the archive and the Debian package hold, and that they run where they are put: the package in an
empty system, the archive in a folder whose name has a space; alone, from Python and from C."""

import glob
import os
import re
import shlex
import shutil
import subprocess
import tarfile
import tempfile
import unittest

ROOT = os.environ["TALUS_SOURCE_DIR"]
VERSION = os.environ["TALUS_VERSION"]
SCRIPT = os.path.join(ROOT, "scripts", "package")
CLEAN = {key: value for key, value in os.environ.items()
         if key not in ("LAMMPS_PLUGIN_PATH", "LD_LIBRARY_PATH", "PYTHONPATH", "PKG_CONFIG_PATH", "TALUS_HOME")}
BROUGHT = re.compile(r"lib/talus/lib(png16|ccd)\.so\.\d+(\.copyright)?$")
HELD = ("bin/talus-lmp", "include/talus.h", "lib/talus/lmp", "lib/talus/liblammps.so", "lib/talus/talusplugin.so",
        "lib/talus/talusstyles.so", "lib/talus/libtalus.so", "lib/talus/talus.py", "lib/talus/talus_precice.py",
        "lib/talus/talus.env",
        "lib/talus/lammps/python/lammps/core.py", "lib/talus/lammps/src/library.h", "share/talus/input/in.drum",
        "share/talus/input/meshes/drum.stl", "share/talus/examples/partner/partner.c", "share/doc/talus/tutorial.md",
        "share/doc/talus/copyright", "share/doc/talus/about/LICENSE")


def run(command, env=None, **words):
    """Status and output. MPI without its daemon, which now and then hangs, and with temporary files of its own."""
    with tempfile.TemporaryDirectory(prefix="mpi-", ignore_cleanup_errors=True) as private:
        env = {**(env or CLEAN), "TMPDIR": private, "OMPI_MCA_ess_singleton_isolated": "1"}
        done = subprocess.run(command, env=env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                              text=True, timeout=150, check=False, **words)
    return done.returncode, done.stdout


def bash(text, *words):
    """What this prints, with the functions of the scripts."""
    status, said = run(["bash", "-c", f'set -euo pipefail; . "{ROOT}/scripts/lib/all.sh"; {text}', "bash", *words])
    if status:
        raise AssertionError(said)
    return said.strip()


class Packages(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.dir = tempfile.mkdtemp(prefix="talus package ")
        cls.addClassCleanup(shutil.rmtree, cls.dir, ignore_errors=True)
        env = {**CLEAN, "TALUS_BUILD_DIR": os.environ["TALUS_BINARY_DIR"], "TALUS_COMPRESSION": "0"}
        status, cls.said = run([SCRIPT, "--out", cls.dir], env, cwd=cls.dir)
        if status:
            raise AssertionError(cls.said)
        cls.deb = os.path.join(cls.dir, f"talus_{VERSION}_amd64.deb")
        cls.unpacked = os.path.join(cls.dir, f"talus-{VERSION}-x86_64")
        with tarfile.open(cls.unpacked + ".tar.xz") as archive:
            archive.extractall(cls.dir)
        cls.root = os.path.join(cls.dir, "root")
        cls.install(cls.root)

    @classmethod
    def install(cls, root):
        """The package into an empty system; owners can be set by root alone."""
        if os.getuid():
            command = ["dpkg-deb", "-x", cls.deb, root]
        else:
            for name in "info", "updates", "triggers":
                os.makedirs(os.path.join(root, "var", "lib", "dpkg", name))
            open(os.path.join(root, "var", "lib", "dpkg", "status"), "w").close()
            command = ["dpkg", f"--root={root}", "--force-depends", "--force-bad-path", "--install", cls.deb]
        status, said = run(command)
        if status:
            raise AssertionError(said)

    def names(self, prefix):
        found = [os.path.join(folder, name) for folder, _, names in os.walk(prefix) for name in names]
        return {os.path.relpath(path, prefix) for path in found}

    def test_both_hold_the_same(self):
        archive, package = self.names(self.unpacked), self.names(os.path.join(self.root, "usr"))
        self.assertEqual([name for name in HELD if name not in package], [])
        extra = archive - package
        self.assertEqual([name for name in extra if not BROUGHT.match(name)], [])
        self.assertTrue(extra, "libraries that a system may not have")
        self.assertEqual(package - archive, set())
        self.assertFalse([name for name in package if name.endswith((".pyc", ".o"))])
        self.assertTrue(os.path.exists(os.path.join(self.dir, f"talus-{VERSION}.tar.gz")), "the source")

    def test_libraries_are_found_beside(self):
        room = os.path.join(self.root, "usr", "lib", "talus")
        files = [os.path.join(room, "lmp"), os.path.join(room, "liblammps.so.0"), *glob.glob(os.path.join(room, "talus*.so"))]
        self.assertGreaterEqual(len(files), 4)
        for file in files:
            paths = re.findall(r"R(?:UN)?PATH +(\S+)", subprocess.run(["objdump", "-p", file], capture_output=True, text=True,
                                                                     check=True).stdout)
            self.assertEqual(paths, ["$ORIGIN"], file)

    def test_depends(self):
        said = subprocess.run(["dpkg-deb", "-f", self.deb, "Depends"], capture_output=True, text=True, check=True).stdout
        self.assertRegex(said, r"libc6 \(>= 2\.\d+\)")
        self.assertIn("libopenmpi3 | libopenmpi3t64 | libopenmpi40, ", said)
        self.assertIn("openmpi-bin", said)
        if shutil.which("apt-get"):    # all of them are here, with these versions
            status, plan = run(["apt-get", "-s", "install", "--no-install-recommends", self.deb])
            self.assertEqual(status, 0, plan)
            self.assertEqual(re.findall(r"^Inst (\S+)", plan, re.M), ["talus"])

    def scene(self, prefix):
        folder = os.path.join(self.dir, os.path.basename(prefix) + " scenes")
        shutil.copytree(os.path.join(prefix, "share", "talus", "input"), folder)
        status, said = run([os.path.join(prefix, "bin", "talus-lmp"), "-in", "in.drum", "-var", "radius", "8", "-var", "time", "0.02"],
                           cwd=folder)
        self.assertEqual(status, 0, said)
        self.assertTrue(glob.glob(os.path.join(folder, "drum.*.png")))
        return re.search(r"--- rotating drum ---\n.*\n.*\n.*", said).group()

    def test_a_scene(self):
        self.assertEqual(self.scene(os.path.join(self.root, "usr")), self.scene(self.unpacked))

    def sourced(self, shell, env=None, prefix=None):
        """The environment after talus.env in this shell."""
        file = os.path.join(prefix or self.unpacked, "lib", "talus", "talus.env")
        said = subprocess.run([shell, "-c", '. "$1"; env', shell, file], env={**CLEAN, **(env or {})}, capture_output=True, text=True,
                              check=True).stdout
        return dict(line.split("=", 1) for line in said.splitlines() if "=" in line)

    def test_shells(self):
        bash = self.sourced("bash")
        self.assertEqual(bash["LAMMPS_PLUGIN_PATH"], os.path.join(self.unpacked, "lib", "talus"))
        self.assertEqual(self.sourced("sh", {"TALUS_HOME": self.unpacked})["PYTHONPATH"], bash["PYTHONPATH"])

    def test_programs(self):
        """Where the name has no space, which mpicc does not hand on."""
        short = tempfile.mkdtemp(prefix="talus-package-")
        self.addCleanup(shutil.rmtree, short)
        prefix, folder = os.path.join(short, "prefix"), os.path.join(short, "partner")
        os.symlink(self.unpacked, prefix)
        env = self.sourced("bash", prefix=prefix)
        shutil.copytree(os.path.join(self.unpacked, "share", "talus", "examples", "partner"), folder)
        status, python = run(["python3", "partner.py"], env, cwd=folder)
        self.assertEqual(status, 0, python)
        flags = run(["pkg-config", "--cflags", "--libs", "talus"], env)[1]
        status, said = run([*shlex.split(os.environ.get("TALUS_MPICC", "mpicc")), "partner.c", *shlex.split(flags), "-o", "partner"],
                           env, cwd=folder)
        self.assertEqual(status, 0, said)
        status, compiled = run(["./partner"], {**env, "LD_LIBRARY_PATH": ""}, cwd=folder)
        line = r"^lid at 0\.0\d+ m, -?\d+\.\d+ N of the grains$"
        self.assertEqual(re.findall(line, compiled, re.M), re.findall(line, python, re.M), compiled)
        self.assertTrue(re.findall(line, python, re.M), python)
        copy = shutil.copytree(os.path.join(prefix, "share", "talus"), os.path.join(short, "talus"))
        status, said = run(["python3", "blade.py", "--speed", "0.4", "--way", "0.004"], env, cwd=os.path.join(copy, "examples", "tutorial"))
        self.assertEqual(status, 0, said)
        self.assertEqual(len(re.findall(r"^Result: .* against \d+\.\d+ N", said, re.M)), 2, said)


class Systems(unittest.TestCase):
    """By the symbols of what is here."""

    LMP = os.environ["TALUS_LMP"]

    def test_what_runs_here_runs_on_a_system_with_these_versions(self):
        needed = dict(line.split() for line in bash('needed_versions "$1"', self.LMP).splitlines())
        self.assertRegex(needed["GLIBC"], r"^2\.\d+")
        table = "system " + " ".join(needed) + "\\nEqual " + " ".join(needed.values())
        self.assertEqual(bash(f"TALUS_SYSTEMS=$(printf '{table}'); too_old Equal \"$1\"", self.LMP), "")
        for kind, version in needed.items():
            older = {**needed, kind: version.rpartition(".")[0] + "." + str(int(version.rpartition(".")[2]) - 1)}
            if older[kind].endswith("-1"):
                continue
            table = "system " + " ".join(older) + "\\nOlder " + " ".join(older.values())
            self.assertEqual(bash(f"TALUS_SYSTEMS=$(printf '{table}'); too_old Older \"$1\"", self.LMP),
                             f"{kind} {older[kind]} instead of {version}")
        self.assertIn("GLIBC none instead of", bash("TALUS_SYSTEMS=$(printf 'system GCC\\nOther 12'); too_old Other \"$1\"", self.LMP))

    def test_this_system(self):
        """The line of the table for this release says what its libraries have."""
        with open("/etc/os-release") as file:
            about = dict(line.rstrip().split("=", 1) for line in file if "=" in line)
        name = about["ID"].strip('"').capitalize() + "-" + about.get("VERSION_ID", "").strip('"')
        rows = [line.split() for line in bash('echo "$TALUS_SYSTEMS"').splitlines()]
        mine = [dict(zip(rows[0], row)) for row in rows if row[0] == name]
        self.assertEqual(len(rows), 5)
        for row in mine:
            for library, kinds in (("libc", ["GLIBC"]), ("libstdc++", ["GLIBCXX", "CXXABI"]), ("libgcc_s", ["GCC"]),
                                   ("libgomp", ["GOMP", "OMP"])):
                path = subprocess.run(["sh", "-c", f"ldconfig -p | grep -m 1 '{library}\\.so\\.[0-9].*x86-64' | sed 's/.* //'"],
                                      capture_output=True, text=True, check=True).stdout.strip()
                said = subprocess.run(["objdump", "-T", path], capture_output=True, text=True, check=True).stdout
                for kind in kinds:
                    has = max((tuple(map(int, found.split("."))) for found in re.findall(rf"\b{kind}_([\d.]+)", said)))
                    self.assertEqual(row[kind], ".".join(map(str, has)), f"{kind} of {name}")

    def test_compilers(self):
        for version, gnu in ("3.4.29", "11"), ("3.4.30", "12"), ("3.4.32", "13"), ("3.4.33", "14"):
            self.assertEqual(bash(f"gnu_of {version}"), gnu)

    def test_messages(self):
        self.assertEqual(run([SCRIPT, "--help"])[0], 0)
        for words, part in (["--fast"], "unknown option '--fast'"), (["--out"], "--out needs a value"):
            status, said = run([SCRIPT, *words])
            self.assertEqual(status, 1)
            self.assertIn(part, said)
        said = run(["bash", "-c", f'. "{ROOT}/scripts/lib/all.sh"; TALUS_LIBRARIES=; depends_on "$1"', "bash", self.LMP])[1]
        self.assertIn("of which scripts/lib/systems.sh does not know the package", said)


if __name__ == "__main__":
    unittest.main()
