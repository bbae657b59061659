# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""No fused multiply-add in the code, whatever the compiler thinks: the same number is computed in more than one place, in
vectors and alone, and must have the same bits."""

import glob
import os
import re
import shutil
import subprocess
import unittest

# the modules of the plugin, or what a build without a host has of it
CODE = os.environ.get("TALUS_CODE", os.path.join(os.environ["TALUS_BINARY_DIR"], "talusstyles*.so"))
OBJDUMP = os.environ.get("TALUS_OBJDUMP", "objdump")
FUSED = re.compile(r"\tvfn?m(add|sub)|\tf(n?madd|n?msub|mla|mls)\b")    # of x86 and ARM


class FusedArithmetic(unittest.TestCase):

    @unittest.skipUnless(shutil.which(OBJDUMP), "needs objdump")
    def test_no_function_of_the_plugin_has_any(self):
        modules = glob.glob(CODE, recursive=True)
        self.assertTrue(modules)
        for module in modules:
            with subprocess.Popen([OBJDUMP, "-d", "-C", "--no-show-raw-insn", module], stdout=subprocess.PIPE,
                                  text=True) as run:
                function, found = "", []
                for line in run.stdout:
                    if line.endswith(">:\n"):
                        function = line[line.index("<") + 1:-3]
                    elif FUSED.search(line):
                        found.append(function)
            self.assertEqual(run.returncode, 0)
            self.assertEqual(sorted(set(found)), [], f"{module}: see -ffp-contract in cmake/TalusFlags.cmake")


if __name__ == "__main__":
    unittest.main()
