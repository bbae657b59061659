# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""scripts/validate: it says what it installs before it does; and it leaves no process and no temporary file when it is ended, in
any way."""

import contextlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from test_build_errors import ScriptCase

ROOT = os.environ["TALUS_SOURCE_DIR"]
ENDED = os.path.join(ROOT, "bench", "lib", "ended.py")
MARK = "TALUS_TEST_OF_ENDED"

# one that leaves its session and its parent, one in a session of its own, one that goes on starting others in threads
PROGRAM = """
import os, subprocess, sys, tempfile, threading
subprocess.run(["sh", "-c", "setsid sleep 100 & exit 0"])
subprocess.Popen(["sleep", "100"], start_new_session=True)
tempfile.mkdtemp()
def restart():
    while True:
        subprocess.run(["sleep", "100"])
threading.Thread(target=restart).start()
print("ready", flush=True)
"""


def marked(value):
    """Processes with this value of MARK in their environment."""
    found = []
    for entry in filter(str.isdigit, os.listdir("/proc")):
        with contextlib.suppress(OSError), open(f"/proc/{entry}/environ", "rb") as file:
            if f"{MARK}={value}".encode() in file.read().split(b"\0"):
                with open(f"/proc/{entry}/cmdline") as words:
                    found.append(words.read().replace("\0", " "))
    return [words for words in found if words]    # those that have ended and were not waited for have none


def soon(condition, seconds=60.0):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.05)
    return False


class Ended(unittest.TestCase):

    def setUp(self):
        self.dir = tempfile.mkdtemp(prefix="talus ended ")
        self.addCleanup(shutil.rmtree, self.dir, ignore_errors=True)
        self.env = {**os.environ, MARK: self.dir, "TMPDIR": self.path("tmp")}
        os.mkdir(self.path("tmp"))

    def path(self, *names):
        return os.path.join(self.dir, *names)

    def start(self, command):
        process = subprocess.Popen(command, env=self.env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                   cwd=self.dir, stdin=subprocess.DEVNULL)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def assert_gone(self):
        self.assertTrue(soon(lambda: not marked(self.dir)), marked(self.dir))
        self.assertTrue(soon(lambda: not os.listdir(self.path("tmp"))), os.listdir(self.path("tmp")))

    def test_signals(self):
        for number in signal.SIGTERM, signal.SIGINT, signal.SIGHUP:
            process = self.start([sys.executable, ENDED, sys.executable, "-c", PROGRAM])
            self.assertEqual(process.stdout.readline(), "ready\n")
            self.assertTrue(soon(lambda: len(marked(self.dir)) >= 5), marked(self.dir))    # the thread may be late
            process.send_signal(number)
            self.assertEqual(process.wait(60), 128 + number)
            self.assert_gone()

    def test_a_caller_that_is_killed(self):
        process = self.start(["bash", "-c", '"$@" & wait $!', "bash", sys.executable, ENDED, sys.executable, "-c", PROGRAM])
        self.assertEqual(process.stdout.readline(), "ready\n")
        process.kill()
        self.assert_gone()

    def test_one_that_is_done(self):
        process = self.start([sys.executable, ENDED, "sh", "-c", "setsid sleep 100 & exit 7"])
        self.assertEqual(process.wait(60), 7)
        self.assert_gone()
        process = self.start([sys.executable, ENDED, "sh", "-c", "kill -9 $$"])
        self.assertEqual(process.wait(60), 137)
        process = self.start([sys.executable, ENDED, "sh", "-c", "echo kept > $TMPDIR/file"])
        self.assertEqual(process.wait(60), 0)
        self.assertEqual([os.listdir(self.path("tmp", name)) for name in os.listdir(self.path("tmp"))], [["file"]])

    def test_validate(self):
        """From where the build is done."""
        text = '. "$0/scripts/lib/all.sh"; HOST_BINARY=$1 HOST_SOURCE=$2 TALUS_BUILD=$3; allow_any_mpirun; measure validate stop -- --quick'
        command = ["bash", "-c", text, ROOT, *(os.environ[f"TALUS_{name}"] for name in ("LAMMPS_BINARY", "LAMMPS_SOURCE", "BINARY_DIR"))]
        for number in signal.SIGTERM, signal.SIGINT:
            process = self.start(command)
            self.assertTrue(soon(lambda: [words for words in marked(self.dir) if "/lmp " in words], 60), "no LAMMPS runs")
            process.send_signal(number)
            self.assertEqual(process.wait(60), -number)
            self.assert_gone()


class Announced(ScriptCase):

    def said(self, *words, **environment):
        self.command("dpkg-query", 'eval last=\\${$#}; case $last in python3-*|liggghts) ;; *) echo installed;; esac\n')
        self.command("apt-get", "exit 100\n")
        self.command("id", "echo 0\n")
        return self.run_command([os.path.join(ROOT, "scripts", "validate"), *words], TALUS_SKIP_PACKAGES="", **environment).stdout

    def test_packages_are_named_before_anything_is_installed(self):
        for tests in "", "yes":    # the packages of tests have python3-numpy too
            first, second = self.said("drum", TALUS_TESTS=tests).splitlines()[:2]
            self.assertRegex(first, "^talus: installs the Debian packages python3-numpy python3-matplotlib liggghts; with TALUS_SKIP_PACKAGES=1 none$")
            self.assertRegex(second, "^talus: installing Debian packages: python3-numpy$")
        self.assertNotIn("liggghts", self.said("stop"), "only where it is compared with")


if __name__ == "__main__":
    unittest.main()
