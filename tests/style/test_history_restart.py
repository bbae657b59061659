# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Contact history in restart files, and which Talus wrote them; test_restart_damage.py has what is refused."""

import os
import random
import struct
import unittest

import restart_file
from talus_testing import SceneCase, Sphere, head, read_dump, write_sphere_data

START = head(boundary="p f f", map=None)
PAIR = """
pair_style gran/penalty
pair_coeff * * hertz 4000.0 40.0 tangential multistep NULL NULL 0.5
"""
REST = """
timestep 0.001
fix step all nve/sphere/symplectic
"""
END = "write_dump all custom {} id x y z vx vy vz omegax omegay omegaz fx fy fz modify format float %a\n"
# the second pair touches across the border
GRAINS = [Sphere((4.5, 1, 1), v=(0, 1, 0)), Sphere((5.45, 1, 1)), Sphere((9.6, 2, 2), v=(0, 0, 1)), Sphere((0.55, 2, 2))]


class HistoryRestart(SceneCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), ((0, 10), (0, 3), (0, 3)), GRAINS)
        self.run_lammps(START + "read_data grains\n" + PAIR + REST + "run 10\nwrite_restart half\nrun 10\n" +
                        END.format("whole"))

    def test_displacements_are_there_again(self):
        self.run_lammps(START + "read_restart half\n" + REST + "run 10\n" + END.format("again"))
        whole, again = (read_dump(self.path(name))[0] for name in ("whole", "again"))
        self.assert_same_bits(whole, again)
        # with the pair style set anew after write_data they are not
        self.run_lammps(START + "read_restart half\nwrite_data bare\nclear\n" + START + "read_data bare\n" + PAIR + REST +
                        "run 10\n" + END.format("without"))
        without, = read_dump(self.path("without"))
        for tag in whole.atoms:
            self.assertNotEqual(whole.column("fy")[tag] + whole.column("fz")[tag],
                                without.column("fy")[tag] + without.column("fz")[tag])

    def test_contacts_that_one_side_sees(self):
        """Grazing ones across a periodic border: positions are rounded there, and the other side decides."""
        draw, grains, length = random.Random(1), [], 10.0
        while len(grains) < 200:
            d, x = draw.uniform(0.8, 1.0), draw.uniform(0.2, 0.4)
            far = x + length - d + draw.choice((-1, 0, 1)) * 1.8e-15
            one, other = x - (far - length), (x + length) - far
            if (one * one < d * d) == (other * other < d * d):
                continue
            k = len(grains) // 2
            place = (1.5 * (k // 10) + 0.75, 1.5 * (k % 10) + 0.75)
            grains += [Sphere((x, *place), diameter=d), Sphere((far, *place), diameter=d)]
        write_sphere_data(self.path("grazing"), ((0, length), (0, 15), (0, 15)), grains)
        for np in 1, 2:
            self.run_lammps(START + "read_data grazing\n" + PAIR + REST + "run 0\nwrite_restart grazing.restart\n", np=np)
            log = self.run_lammps(START + "read_restart grazing.restart\n" + REST + "run 0\n").log
            self.assertIn("200 atoms", log)

    def test_version_of_talus(self):
        """Of the laws of gran/penalty: a newer Talus is worth a warning."""
        with open(self.path("half"), "rb") as file:
            content = file.read()
        major, minor, patch = (int(n) for n in os.environ["TALUS_VERSION"].split("."))
        ours = 10000 * major + 100 * minor + patch
        part = next(part for part in restart_file.parts_of_talus(content)
                    if struct.unpack_from("<i", content, part.begin + restart_file.SIZE_HEAD)[0] == ours)
        at = part.begin + restart_file.SIZE_HEAD
        data = struct.pack("<i", ours + 1) + content[at + 4:part.end]
        with open(self.path("newer"), "wb") as file:
            file.write(content[:at - 8] + restart_file.digest(restart_file.FORMAT_OF_LAWS, data) + data + content[part.end:])
        dumps = []
        for name, warns in ("half", False), ("newer", True):
            log = self.run_lammps(START + f"read_restart {name}\n" + REST + "run 10\n" + END.format(name + ".dump")).log
            self.assertEqual("the restart file was written by a newer Talus" in log, warns)
            dumps += read_dump(self.path(name + ".dump"))
        self.assert_same_bits(*dumps)


if __name__ == "__main__":
    unittest.main()
