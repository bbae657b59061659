# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""comm_modify mode multi and multi/old, neighbor multi: the same bits as without them, in the records, with the same proxies."""

import os
import random
import re
import unittest

from talus_testing import SceneCase, Sphere, head, read_dump, write_sphere_data

LENGTH = 12.0
SCENE = head(boundary="p p f", newton="{newton}") + """
read_data grains
{modes}
pair_style gran/penalty
pair_coeff * * hertz 4000.0 40.0 tangential multistep NULL NULL 0.5
timestep 0.001
fix step all nve/sphere/symplectic gravity 5.0 vector 0 0 -1
fix floor all large/body plane 0 0 0  0 0 1  contact hertz 4000.0 40.0 tangential multistep NULL NULL 0.5
thermo 1000
thermo_modify lost ignore
run 300
write_dump all custom dump id x y z vx vy vz omegax omegay omegaz modify format float %a sort id
comm_proxy info
"""
MODES = {
    "single": "neighbor 0.15 bin",
    "multi": "neighbor 0.15 multi\ncomm_modify mode multi",
    "multi with collections": "neighbor 0.15 multi\nneigh_modify collection/type 2 1 2\ncomm_modify mode multi",
}
if int(os.environ["TALUS_LAMMPS_VERSION"]) < 20260000:    # removed from newer ones
    MODES["multi/old"] = "neighbor 0.15 multi/old\ncomm_modify mode multi/old"


def grains():
    """Large ones with small ones between them, tossed."""
    draw = random.Random(11)
    found = [Sphere((3.0 * i + 1.5, 3.0 * j + 1.5, 1.3 + 2.4 * k), v=tuple(draw.gauss(0, 1) for _ in "xyz"), type=2, diameter=2.0)
             for k in range(2) for j in range(4) for i in range(4)]
    return found + [Sphere((1.5 * i + 1.7 + draw.uniform(-.05, .05), 3.0 * j + draw.uniform(-.05, .05), 0.4 + 0.6 * k),
                           v=tuple(draw.gauss(0, 1) for _ in "xyz"), type=1, diameter=draw.uniform(0.4, 0.5))
                    for k in range(8) for j in range(4) for i in range(0, 8, 2)]


class Modes(SceneCase):

    def run_scene(self, modes, np, newton="off"):
        write_sphere_data(self.path("grains"), ((0, LENGTH), (0, LENGTH), (-0.5, 12)), grains(), types=2)
        log = self.run_lammps(SCENE.format(modes=modes, newton=newton), np=np).log
        self.assertIn("steps without output              in the records", log)
        return read_dump(self.path("dump"))[0], float(re.search(r"^  proxies +\S+ +(\S+)", log, re.MULTILINE)[1])

    def test_same_bits(self):
        first, most = self.run_scene(MODES["single"], 1)
        for name, modes in MODES.items():
            for np, newton in (1, "off"), (2, "off"), (4, "on"):
                with self.subTest(mode=name, np=np):
                    frame, proxies = self.run_scene(modes, np, newton)
                    self.assert_same_bits(first, frame)
                    if np == 1:
                        self.assertEqual(proxies, most)

    def test_cutoffs(self):
        """Of the user, by collection and type: kept, so that there are more proxies."""
        first, least = self.run_scene(MODES["single"], 1)
        for name in MODES.keys() & {"multi", "multi/old"}:
            for np in 1, 2:
                frame, proxies = self.run_scene(f"{MODES[name]} cutoff/{name} 1 3.5", np)
                self.assert_same_bits(first, frame)
                if np == 1:
                    self.assertGreater(proxies, 1.3 * least)

    def test_reduced(self):
        """reduce/multi leaves out proxies that a contact has on one side. Where contacts choose them it changes nothing, and
        with cutoffs of the user the exchange is that of LAMMPS, with the reason in the log."""
        first, most = self.run_scene(MODES["single"], 1)
        for np in 1, 2:
            frame, proxies = self.run_scene(MODES["multi"] + " reduce/multi", np, newton="on")
            self.assert_same_bits(first, frame)
        script = SCENE.format(modes=MODES["multi"] + " reduce/multi cutoff/multi 1 2.0", newton="on").replace("comm_proxy info", "")
        for np in 1, 2:
            log = self.run_lammps(script, np=np).log
            self.assertIn("the exchange is the one of LAMMPS: 'comm_modify reduce/multi' is not supported with "
                          "'comm_modify cutoff' or 'group': remove it", log)


if __name__ == "__main__":
    unittest.main()
