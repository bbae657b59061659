# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Test cases with a program that hosts LAMMPS, and is a partner of it: in Python (python/talus.py) or in C (libtalus.so)."""

import json
import os
import sys

from talus_testing import DEFAULT_TIMEOUT, SceneCase, cores_held, head, run_in_a_process_that_stays, run_program, stays

SOURCE, BUILD = os.environ["TALUS_SOURCE_DIR"], os.environ["TALUS_BINARY_DIR"]
HOST, HOST_SOURCE = os.environ["TALUS_LAMMPS_BINARY"], os.environ["TALUS_LAMMPS_SOURCE"]
if not os.path.isdir(os.path.join(HOST_SOURCE, "python")):
    HOST_SOURCE = os.path.dirname(HOST_SOURCE.rstrip("/"))

# two clumps of two grains each
TWO_CLUMPS = head() + """
fix prop all property/atom mol ghost yes
region box block -10 10 -10 10 -20 20
create_box 1 box
create_atoms 1 single 5 0 0.4
create_atoms 1 single 5 0 -0.4
create_atoms 1 single -5 0 0.4
create_atoms 1 single -5 0 -0.4
set group all diameter 1 mass 0.5
set atom 1*2 mol 1
set atom 3*4 mol 2
pair_style gran/penalty
pair_coeff * * hooke 1e3 0 tangential multistep NULL NULL 0.5
neighbor 0.2 bin
neigh_modify exclude molecule/intra all
timestep 0.001
{move}
thermo {thermo}
thermo_style custom step
"""


def host_environment(**more):
    """What programs need to find LAMMPS, its Python module and that of Talus."""
    return {"PYTHONPATH": ":".join([os.path.join(HOST_SOURCE, "python"), os.path.join(SOURCE, "python"),
                                    os.path.join(SOURCE, "tests", "lib")]),
            "LD_LIBRARY_PATH": ":".join([HOST, BUILD, os.environ.get("LD_LIBRARY_PATH", "")]), **more}


class CoupledCase(SceneCase):

    def read_json(self, name):
        return json.loads(self.read(name))

    def launch(self, command, np=1, env=None, **options):
        """What it prints."""
        return run_program(command[0], np, command[1:], cwd=self.dir, env=host_environment(**(env or {})), **options).output

    def drive(self, program, *words, np=1, env=None, timeout=DEFAULT_TIMEOUT, stay=True):
        """The same of a Python program given as text, as one of many in a process in scripts with the word stay in their line
        "# ctest:"; stay=False: of one that is to fail, or leaves something behind."""
        name, words = self.write("driver.py", program), list(map(str, words))
        if not (stay and stays(env)):
            return self.launch([sys.executable, name, *words], np, env=env, timeout=timeout)
        threads = int((env or {}).get("OMP_NUM_THREADS", 1))
        with cores_held(np * threads):
            job = {"folder": self.dir, "words": words, "program": name}
            returncode, output = run_in_a_process_that_stays(job, np, threads, timeout)
        if returncode != 0:
            raise AssertionError(f"return code {returncode}: {name} {' '.join(words)}\n{output[-3000:]}")
        return output

    def compile(self, name, text, compiler=None):
        """A program in C that is linked with LAMMPS and libtalus.so."""
        words = compiler or [os.environ.get("TALUS_MPICC", "mpicc")]
        self.launch([*words, "-Wall", "-Werror", "-DLAMMPS_LIB_MPI", self.write(name + ".c", text), "-I",
                     os.path.join(HOST_SOURCE, "src"), "-I", os.path.join(SOURCE, "src", "coupling"), "-L", HOST, "-llammps", "-L", BUILD,
                     "-ltalus", "-o", name])
        return "./" + name
