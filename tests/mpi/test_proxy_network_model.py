# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""The network model of the benchmarks: nothing arrives too early, and all of it is right."""

import os
import unittest

from talus_testing import SceneCase, run_program


class NetworkModel(SceneCase):

    def check(self, **variables):
        build = os.environ["TALUS_BINARY_DIR"]
        preload = " ".join(filter(None, [os.environ.get("LD_PRELOAD"),
                                         os.path.join(build, "bench", "libnetwork_model.so")]))
        output = run_program(os.path.join(build, "tests", "network_model_check"), np=3, cwd=self.dir,
                             env={"LD_PRELOAD": preload, **variables}).output
        self.assertIn("model right", output)

    def test_latency(self):
        self.check(TALUS_LATENCY="2e-3", TALUS_BANDWIDTH="1e12")

    def test_bandwidth(self):
        self.check(TALUS_LATENCY="0", TALUS_BANDWIDTH="1e8")


if __name__ == "__main__":
    unittest.main()
