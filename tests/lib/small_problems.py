# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Problems of validate/ in their small versions: they run, and their numbers are within wide bounds."""

import os
import re
import subprocess
import sys
import tempfile

ROOT = os.environ["TALUS_SOURCE_DIR"]
TIMEOUT = 500


def _python():
    """One that has NumPy: Debian's packages belong to its own Python."""
    for python in ("/usr/bin/python3", sys.executable):
        if os.path.exists(python) and subprocess.run([python, "-c", "import numpy"], capture_output=True, check=False).returncode == 0:
            return python
    sys.exit("no Python with NumPy: apt-get install python3-numpy")


def run_small(case, name):
    """{number: text of what Talus has} of the page; fails where one is out of bounds."""
    with tempfile.TemporaryDirectory() as folder:
        env = dict(os.environ, TALUS_ROOT=ROOT, TALUS_BUILD=os.environ["TALUS_BINARY_DIR"], TALUS_BENCH_HOST=os.environ["TALUS_LMP"],
                   TALUS_BENCH_CACHE=folder, PYTHONDONTWRITEBYTECODE="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
        done = subprocess.run([_python(), os.path.join(ROOT, "bench", "lib", "main.py"), "validate", name, "--quick", "--out", folder],
                              capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=TIMEOUT, check=False, env=env)
        case.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with open(os.path.join(folder, name + ".md")) as file:
            page = file.read()
        with open(os.path.join(folder, "README.md")) as file:
            case.assertIn(f"]({name}.md)", file.read())
    rows = re.findall(r"^\| (.*?) \| (.*?) \| .* to .* \| yes \|$", page, re.MULTILINE)
    case.assertTrue(rows, page)
    print("\n".join(f"{what}: {found}" for what, found in rows))
    return dict(rows)
