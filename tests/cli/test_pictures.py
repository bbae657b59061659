#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""examples/vtk/pictures.py draws the pictures of the documentation."""

import os
import subprocess
import sys
import tempfile
import unittest
import zlib

SCRIPT = os.path.join(os.environ["TALUS_SOURCE_DIR"], "examples", "vtk", "pictures.py")


class Pictures(unittest.TestCase):

    def test_pictures_of_the_documentation(self):
        with tempfile.TemporaryDirectory() as folder:
            result = subprocess.run([sys.executable, SCRIPT, os.environ["TALUS_LAUNCHER"], folder], capture_output=True, text=True)
            self.assertEqual(result.returncode, 0, result.stdout[-2000:] + result.stderr)
            self.assertNotIn("WARNING", result.stdout)
            for name in ("grains", "contacts", "bodies"):
                with open(os.path.join(folder, f"vtk_{name}.png"), "rb") as file:
                    png = file.read()
                self.assertTrue(png.startswith(b"\x89PNG"))
                begin = png.index(b"IDAT") + 4
                pixels = zlib.decompress(png[begin:-16])
                colors = {pixels[k:k + 3] for k in range(1, len(pixels) - 3, 3001)}
                self.assertGreater(len(colors), 10, name)

    def test_usage(self):
        result = subprocess.run([sys.executable, SCRIPT], capture_output=True, text=True)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("usage: pictures.py LMP", result.stderr)


if __name__ == "__main__":
    unittest.main()
