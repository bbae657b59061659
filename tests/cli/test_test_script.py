# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: label=hostless
"""scripts/test: which configurations are built and tested, and that nothing is left out without a word. Build, ctest and
the hosts are stubs that write down how they are called."""

import os
import re
import shutil
import unittest

from test_build_errors import ROOT, ScriptCase, write

SECOND = "4Jul2026"
LEVELS = ["build-g++-10-x86-64-v3", "build-g++-10-x86-64-v2", "build-g++-10-x86-64"]    # of those that the stub can run
BITS = "build-g++-10-x86-64-v3"


class Configurations(ScriptCase):

    def setUp(self):
        super().setUp()
        for folder in "scripts", "cmake":
            shutil.copytree(os.path.join(ROOT, folder), self.path("tree", folder))
        # build_talus makes the default configuration: packages, host and compilation are not what is tested here
        with open(self.path("tree", "scripts", "lib", "all.sh"), "a") as file:
            file.write('build_talus() { TALUS_BUILD=$(build_directory "$1" "$2" "$3"); }\n'
                       "prepare_host() { HOST_BINARY=none; }\nall_compilers() { echo g++-10; }\n"
                       "can_run() { [ $1 != x86-64-v4 ]; }\nlevel_of_build() { echo x86-64-v4; }\n")
        note = f"printf '%s ' {{}} \"$@\" >> '{self.path('calls')}'; echo >> '{self.path('calls')}'\n"
        write(self.path("tree", "scripts", "build"), "#!/bin/sh\n" + note.format('"build [$TALUS_TARGETS]"'), executable=True)
        self.command("ctest", note.format("ctest") + '[ "$2" != "$FAILING" ]\n')
        self.command("cmake", f"echo \"$@\" >> '{self.path('configured')}'\n")
        self.command("ninja", 'echo "$@"\n')
        self.command("clang++", "exit 0\n")
        self.command("g++-10", "echo g++ 10\n")
        self.command("aarch64-linux-gnu-g++", "exit 0\n")
        self.command("qemu-aarch64", "exit 0\n")

    def run_test(self, *arguments, **environment):
        result = self.run_command([self.path("tree", "scripts", "test"), *arguments], **environment)
        calls = []
        if os.path.exists(self.path("calls")):
            with open(self.path("calls")) as file:
                calls = [line.replace(self.path("tree"), "TREE").strip() for line in file]
            os.remove(self.path("calls"))
        return result, calls

    def of_ctest(self, calls):
        """[(folder, options)]"""
        found = [re.match(r"ctest --test-dir TREE/(\S+) --output-on-failure --no-tests=error -j \d+ ?(.*)", call)
                 for call in calls if not call.startswith("build ")]
        return [match.groups() for match in found]

    def test_without_the_second_host_a_line_says_what_is_left_out(self):
        result, calls = self.run_test()
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertEqual(self.of_ctest(calls), [(BITS, ""), ("build", "-LE slow")])
        said = [line for line in result.stdout.splitlines() if "left out" in line]
        self.assertEqual(len(said), 1, result.stdout)
        for part in "tests/styles", SECOND, "scripts/test --all":
            self.assertIn(part, said[0])

    def test_in_ci_the_second_host_is_built(self):
        result, calls = self.run_test(CI="true")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertNotIn("left out", result.stdout)
        second = f"build-{SECOND}-smallbig"
        self.assertEqual(self.of_ctest(calls), [(BITS, ""), (second, "-L smoke"), (second, "-L dem"), ("build", "-LE slow")])

    def test_a_host_in_the_cache_runs_smoke_tests_and_cases_of_styles(self):
        host = self.run_command(["bash", "-c", f'. "{ROOT}/scripts/lib/all.sh"; released_host_dir {SECOND} smallbig']).stdout
        for name in "stamp", "build/liblammps.so":
            write(os.path.join(host, name), "")
        write(os.path.join(host, "build/lmp"), "", executable=True)
        result, calls = self.run_test()
        second = f"build-{SECOND}-smallbig"
        self.assertEqual(self.of_ctest(calls), [(BITS, ""), (second, "-L smoke"), (second, "-L dem"), ("build", "-LE slow")])
        builds = [call for call in calls if call.startswith("build ")]
        self.assertEqual(builds, [f"build [smoke] --host {SECOND} --sizes smallbig"] * 2)
        self.assertNotIn("left out", result.stdout)

    def configured(self):
        """[options of CMake] of all calls so far."""
        with open(self.path("configured")) as file:
            return file.read().splitlines()

    def test_another_compiler_compiles_for_another_level_of_the_processor(self):
        for own, other, runs in ("x86-64-v4", "x86-64-v3", True), ("x86-64-v3", "x86-64-v4", False):
            with open(self.path("tree", "scripts", "lib", "all.sh"), "a") as file:
                file.write(f"level_of_build() {{ echo {own}; }}\n")
            result, calls = self.run_test()
            self.assertEqual(result.returncode, 0, result.stdout)
            self.assertRegex(self.configured()[-1], rf"CMAKE_CXX_COMPILER=g\+\+-10 .*TALUS_ARCH={other} .*TALUS_UNIT_TESTS=same_everywhere_test;")
            self.assertEqual((f"build-g++-10-{other}", "") in self.of_ctest(calls), runs)
        self.command("g++-10", 'case "$*" in *x86-64-v?*) exit 1;; esac; echo g++ 10\n')    # that knows no levels
        self.run_test()
        self.assertIn("TALUS_ARCH=x86-64 ", self.configured()[-1])

    def test_warnings_are_errors_where_we_check_ourselves(self):
        for arguments, environment, word in ((), {}, "OFF"), ((), {"CI": "true"}, "ON"), (("--all",), {}, "ON"), (("--tsan",), {}, "ON"):
            self.run_test(*arguments, **environment)
            calls = self.configured()
            os.remove(self.path("configured"))
            self.assertTrue(calls)
            for call in calls:
                self.assertIn(f"TALUS_WERROR={word} ", call)

    def test_a_user_is_told_of_warnings_at_the_end(self):
        warning = "src/base/words.cpp:7:1: warning: this is odd [-Wodd]"
        self.command("ninja", f"echo '../{warning}'; echo '/usr/include/x.h:1:1: warning: foreign'\n")
        result, _ = self.run_test()
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertRegex(result.stdout, rf"the compiler warns in 1 places, [^\n]*:\n{re.escape(warning)}\n")
        self.command("ninja", "exit 0\n")
        result, _ = self.run_test()
        self.assertNotIn("warns", result.stdout, "those of earlier builds are not told again")

    def test_options_narrow_the_run_to_the_default_host(self):
        _, calls = self.run_test("-L", "unit", CI="true")
        self.assertEqual(self.of_ctest(calls), [("build", "-LE slow -L unit")])

    def test_all(self):
        result, calls = self.run_test("--all")
        self.assertEqual(result.returncode, 0, result.stdout)
        found = self.of_ctest(calls)
        folders = [folder for folder, _ in found]
        self.assertEqual(folders, [f"build-{SECOND}-bigbig"] * 2 + ["build-none-smallbig-portable", "build-sanitize",
                                   "build-tsan", *LEVELS, "build-aarch64", "build"])
        self.assertRegex(found[0][1], r"^-L style\|dropin\|smoke\|mpi\|cli -LE slow\|hostless\|dem -E test_\(against_stock\|[a-z_|]*\)$",
                         "what needs no host runs once")
        slow = [folder for folder, options in found if "-LE" not in options and "-L" not in options]
        self.assertEqual(slow, ["build-tsan", *LEVELS, "build-aarch64", "build"],
                         "slow tests run once, with the default host; builds without a host have none")
        self.assertTrue(any("TALUS_ARCH=x86-64-v4" in call for call in self.configured()), "compiled, since it cannot be run")

    def test_a_failure_is_remembered(self):
        for folder, name in ((f"build-{SECOND}-bigbig", f"second host {SECOND}, BIGBIG"),
                             ("build-tsan", "thread sanitizer"), ("build-sanitize", "sanitizers")):
            result, calls = self.run_test("--all", FAILING=self.path("tree", folder))
            self.assertEqual(result.returncode, 1)
            self.assertIn(f"failed before: {name} (its output is above)", result.stdout)
            self.assertEqual(self.of_ctest(calls)[-1][0], "build", "the others still run")

    def test_no_clang_is_an_error(self):
        os.remove(self.path("bin", "clang++"))
        self.hide("clang++")
        for option in "--all", "--tsan":
            result, calls = self.run_test(option)
            self.assert_message(result, "clang++", "clang libclang-rt-dev libomp-dev")
            self.assertEqual(calls, [], "said before anything is built")

    def test_clang_is_installed(self):
        self.command("dpkg-query", 'eval last=\\${$#}; [ "$last" = libomp-dev ] || echo installed\n')
        self.command("apt-get", f"echo \"$@\" >> '{self.path('apt')}'\n")
        self.command("id", "echo 0\n")
        for option, installed in ((), False), (("--tsan",), True), (("--all",), True):
            result, _ = self.run_test(*option, TALUS_SKIP_PACKAGES="")
            self.assertEqual(result.returncode, 0, result.stdout)
            self.assertEqual(os.path.exists(self.path("apt")), installed)
        with open(self.path("apt")) as file:
            self.assertIn("libomp-dev", file.read())


if __name__ == "__main__":
    unittest.main()
