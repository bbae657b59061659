# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Spack recipe, see packaging/README.md."""

import os

from spack.package import *


class Talus(CMakePackage):
    """Granular dynamics with many particles: a plugin for LAMMPS."""

    # the archive of a release is made by: cmake --build build --target package_source
    manual_download = True

    license("GPL-2.0-only")

    version("1.1.0")

    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("ninja", type="build")
    depends_on("eigen@3.3:", type="build")
    depends_on("libccd@2.1:")
    depends_on("mpi")
    depends_on("lammps@20250204: +plugin +granular +rigid +openmp +mpi +lib")

    generator("ninja")

    def url_for_version(self, version):
        return f"file://{os.getcwd()}/talus-{version}.tar.gz"

    def source_of_lammps(self):
        """A plugin needs the source of its host, which Spack keeps with --source."""
        source = join_path(self.spec["lammps"].prefix.share, "lammps", "src")
        if not os.path.isdir(join_path(source, "src")):
            raise InstallError(f"{source} is not there: spack install --source lammps, then talus")
        return source

    def cmake_args(self):
        return [
            self.define("LAMMPS_EXECUTABLE", self.spec["lammps"].prefix.bin.lmp),
            self.define("LAMMPS_SOURCE_DIR", self.source_of_lammps()),
            self.define("TALUS_TESTS", False),
        ]

    def setup_run_environment(self, env):
        env.prepend_path("LAMMPS_PLUGIN_PATH", self.prefix.lib.talus)
