# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120 label=hostless
"""The archive of a release, its version in all places that name it, and the recipes, as far as Python reads them."""

import ast
import datetime
import glob
import os
import re
import shutil
import subprocess
import tarfile
import tempfile
import unittest

ROOT = os.environ["TALUS_SOURCE_DIR"]
BUILD = os.environ["TALUS_BINARY_DIR"]
# not in the archive: what git and editors keep for themselves
NOT_PACKED = (".git",)


def read(*path):
    with open(os.path.join(ROOT, *path)) as file:
        return file.read()


VERSION = re.search(r"project\(talus VERSION ([\d.]+)", read("CMakeLists.txt"))[1]


class Packaging(unittest.TestCase):

    def test_version_is_the_same_everywhere(self):
        self.assertIn(f"\n## {VERSION}", read("CHANGELOG.md"))
        self.assertIn(f"\nversion: {VERSION}\n", read("CITATION.cff"))
        self.assertIn(f"talus_{VERSION}_amd64.deb", read("README.md"))
        self.assertIn(f'version("{VERSION}")', read("packaging", "spack", "packages", "talus", "package.py"))
        self.assertTrue(glob.glob(os.path.join(ROOT, "packaging", "easybuild", f"Talus-{VERSION}-*.eb")))
        self.assertIn(f'\nversion = "{VERSION}"\n', read("python", "pyproject.toml"))
        for name in f"talus_{VERSION}_amd64.deb", f"talus-{VERSION}-x86_64.tar.xz", f"`talus/{VERSION}`":
            self.assertIn(name, read("doc", "install.md"))

    def test_date_is_the_same_everywhere(self):
        date = re.search(rf"^## {VERSION}, (.*)$", read("CHANGELOG.md"), re.M)[1]
        cited = re.search(r"^date-released: (.*)$", read("CITATION.cff"), re.M)[1]
        self.assertEqual(datetime.datetime.strptime(date, "%d %B %Y").date().isoformat(), cited)

    def test_recipes_are_python(self):
        tree = ast.parse(read("packaging", "spack", "packages", "talus", "package.py"))
        recipe, = (node for node in tree.body if isinstance(node, ast.ClassDef))
        self.assertEqual((recipe.name, recipe.bases[0].id), ("Talus", "CMakePackage"))
        path, = glob.glob(os.path.join(ROOT, "packaging", "easybuild", "*.eb"))
        values = {}
        with open(path) as file:
            exec(compile(file.read(), path, "exec"), values)    # a file of assignments
        self.assertEqual((values["name"], values["version"]), ("Talus", VERSION))
        self.assertEqual(values["sources"][0].replace("%(version)s", VERSION), f"talus-{VERSION}.tar.gz")

    def test_options_of_the_recipes_exist(self):
        """CMake's options that they set are options of CMakeLists.txt or of cmake/."""
        known = read("CMakeLists.txt") + "".join(read("cmake", name) for name in os.listdir(os.path.join(ROOT, "cmake")))
        words = set(re.findall(r"-D (\w+)=", read("packaging", "easybuild", os.path.basename(
            glob.glob(os.path.join(ROOT, "packaging", "easybuild", "*.eb"))[0]))))
        words |= set(re.findall(r'self\.define\("(\w+)"', read("packaging", "spack", "packages", "talus", "package.py")))
        self.assertGreater(len(words), 2)
        for word in words:
            self.assertIn(word, known)

    def test_archive_of_a_release(self):
        """All that git holds, nothing that was built."""
        listed = ""    # of an unpacked archive, or where there is no git
        if shutil.which("git"):
            listed = subprocess.run(["git", "-C", ROOT, "ls-files"], capture_output=True, text=True, check=False).stdout
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([os.environ.get("TALUS_CPACK", "cpack"), "--config", os.path.join(BUILD, "CPackSourceConfig.cmake"), "-B", folder],
                           capture_output=True, check=True)
            with tarfile.open(os.path.join(folder, f"talus-{VERSION}.tar.gz")) as archive:
                names = {name.partition("/")[2] for name in archive.getnames() if not name.endswith("/")}
        self.assertFalse([name for name in names if name.startswith(("build", ".git/", "out/")) or name.endswith((".so", ".pyc", ".o"))])
        self.assertIn("scripts/build", names)
        missing = [name for name in listed.splitlines() if name not in names and not name.startswith(NOT_PACKED)
                   and os.path.exists(os.path.join(ROOT, name))]
        self.assertEqual(missing, [])


if __name__ == "__main__":
    unittest.main()
