# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""Rows of the page on output tell what their words say: two grains at rest on each other and on a floor, and one that flies
past and turns; and grains of two types that do not touch, on a slope and in flight: all numbers are known."""

import math
import os
import re
import unittest

import test_conversion_pages as pages
from talus_testing import SceneCase, Sphere, begin, read_local, thermo, write_sphere_data

STIFFNESS, GRAVITY, RADIUS = 1e4, 10.0, 0.5
MASS = math.pi / 6
WEIGHT = MASS * GRAVITY
DEEP, SHALLOW = 2 * WEIGHT / STIFFNESS, WEIGHT / STIFFNESS    # overlaps with the floor and with each other
LOW = RADIUS - DEEP
DISTANCE = 2 * RADIUS - SHALLOW
SPEED, SPIN, HEIGHT = 1.5, 2.0, 4.0
VOLUME = 8.0 * 6.0 * 10.0
STRESS = WEIGHT * DISTANCE / VOLUME, 2 * WEIGHT * RADIUS / VOLUME    # zz, of both grains; of one and the floor
FLOW = MASS * SPEED**2 / VOLUME
ELASTIC = 0.5 * STIFFNESS * (DEEP**2 + SHALLOW**2)

SCENE = f'\nvariable law string "hooke {STIFFNESS} 20"' + begin(read="read_data grains", law="${law}", skin=0.2, dt=1e-6) + f"""
group resting id 1 2
fix move all nve/sphere/symplectic
fix fall resting gravity/talus {GRAVITY} vector 0 0 -1
fix floor all large/body plane 0 0 0 0 0 1 contact ${{law}}
"""
END = "thermo_modify norm no format float %.15g\nrun 0\n"

# by the first words of a row: what its columns are
KNOWN = {
    "kinetic energy of spheres": {"KinEng": MASS * SPEED**2 / 2, "c_spin": 0.2 * MASS * RADIUS**2 * SPIN**2},
    "number of contacts between grains": {"c_pair[1]": 1, "v_mean": 2 / 3},
    "largest overlap between grains": {"c_deepest": SHALLOW / RADIUS},
    "force on a body, torque": {"f_floor[1]": 0, "f_floor[3]": -2 * WEIGHT, "f_floor[6]": 0},
    "where a body is": {"f_floor[7]": 0, "f_floor[9]": 0, "f_floor[16]": 0},
    "elastic and dissipated energy": {"c_energy[2]": 2, "c_energy[3]": DEEP / RADIUS, "c_energy[4]": ELASTIC, "c_energy[5]": 0},
    "pressure and stress of the contacts between grains |": {"c_p": STRESS[0] / 3, "c_p[1]": 0, "c_p[3]": STRESS[0]},
    "the same with the contacts with a body": {"c_p": sum(STRESS) / 3, "c_p[1]": 0, "c_p[3]": sum(STRESS)},
    "pressure and stress of the contacts between grains and of velocities": {
        "Press": (STRESS[0] + FLOW) / 3, "Pxx": FLOW, "Pyy": 0, "Pzz": STRESS[0]},
    "mass of the grains in the box": {"c_passed": MASS},
    "height of the center of mass": {"c_center[3]": (2 * LOW + DISTANCE + HEIGHT) / 3, "c_fastest": SPEED},
    "mean coordination number": {"c_coordination": 1},
    "fabric tensors": {"c_fabric": 1},
}


def lines_of(words):
    found = [lines for label, lines in pages.rows(pages.page("output.md"), "what you want") if (label + " |").startswith(words)]
    return pages.commands(found[0]) if len(found) == 1 else found


class RowCase(SceneCase):

    def assert_known(self, log, known):
        row = thermo(log)[-1]
        scale = max(map(abs, known.values()))
        for column, value in known.items():
            self.assertAlmostEqual(row[column], value, delta=1e-9 * scale, msg=column)


class Rows(RowCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), ((0, 8), (0, 6), (-1, 9)),
                          [Sphere((2, 3, LOW)), Sphere((2, 3, LOW + DISTANCE)), Sphere((5, 3, HEIGHT), v=(SPEED, 0, 0), omega=(0, 0, SPIN))])

    def run_row(self, words, more=""):
        lines = lines_of(words)
        if "c_fabric[*]" in lines[-1]:    # its scalar is the number of contacts
            lines[-1] += " c_fabric"
        return self.run_lammps("\n".join([SCENE, *lines, more, END])).log

    def test_numbers_in_the_log(self):
        for words, known in KNOWN.items():
            with self.subTest(words):
                self.assert_known(self.run_row(words), known)

    def test_stress_of_each_grain(self):
        """Half of the contact of two grains for each, all of that with the floor; tension is positive."""
        self.run_row("stress of each grain")
        with open(self.path("grains.0.txt")) as file:
            rows = [list(map(float, line.split())) for line in file if re.match(r"[123] ", line)]
        zz = {row[0]: row[3] for row in rows}
        between = WEIGHT * DISTANCE / 2
        for tag, value in (1, between + 2 * WEIGHT * RADIUS), (2, between), (3, 0.0):
            self.assertAlmostEqual(zz[tag], -value, delta=1e-5 * WEIGHT)

    def test_contacts(self):
        for words in "all contacts, those with bodies", "force chains as lines", "what contacts remember":
            with self.subTest(words):
                self.run_row(words)
                name = "chains.0.txt" if "chains" in words else "contacts.0.txt"
                self.assertEqual(len(read_local(self.path(name))[0].rows), 2)

    def test_force_chains_in_a_picture(self):
        log = self.run_row("force chains: grains", "compute most all reduce max v_push\nthermo_style custom step c_most")
        self.assert_known(log, {"c_most": (WEIGHT * DISTANCE / 2 + 2 * WEIGHT * RADIUS) / (4 * math.pi * RADIUS**3)})
        self.assertTrue(os.path.getsize(self.path("chains.0000000.ppm")))


TAN, FAST, SLOW, DT, HIGH = 0.4, -2.0, 0.25, 1e-3, 2.045
STREAM = [*(Sphere((x, 1.0, 4.5 - TAN * x), type=2) for x in (1.5, 2.5, 3.5)),    # the surface of the slope
          Sphere((2.6, 3.0, 0.6)), Sphere((3.3, 3.0, 0.7)), Sphere((0.4, 1.0, 3.8)),
          Sphere((6.5, 1.0, HIGH), v=(0, 0, FAST)), Sphere((6.5, 3.0, 2.6), v=(0, 0, SLOW), diameter=0.8, type=2)]


def mean_height(kind):
    return sum(s.x[2] * s.diameter**3 for s in STREAM if s.type == kind) / sum(s.diameter**3 for s in STREAM if s.type == kind)


def lacey(edge):
    """(s0^2 - s^2)/(s0^2 - sr^2) with the variances s0^2 = p (1 - p) of grains apart and sr^2 = s0^2/n of cells of n grains at random."""
    cells = {}
    for sphere in STREAM:
        cells.setdefault(tuple(int(x // edge) for x in sphere.x), []).append(sphere.type == 2)
    p = sum(map(sum, cells.values())) / len(STREAM)
    apart, mean_number = p * (1 - p), len(STREAM) / len(cells)
    found = sum(len(cell) * (sum(cell) / len(cell) - p)**2 for cell in cells.values()) / len(STREAM)
    return (apart - found) / (apart - apart / mean_number)


class Streams(RowCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), ((0, 8), (0, 4), (0, 8)), STREAM)

    def assert_row(self, words, known):
        script = begin(read="read_data grains", law="hooke 1e4 20", skin=0.2, dt=DT) + "\nfix move all nve/sphere/symplectic\n"
        self.assert_known(self.run_lammps(script + "\n".join([*lines_of(words), END])).log, known)

    def test_flow(self):
        flow = MASS * (FAST + 0.8**3 * SLOW)
        self.assert_row("mass flow along z", {"c_flow": flow})

    def test_residence_time(self):
        """Two grains were never in the mouth; the fast one leaves it after 0.0225, and was last seen in it at 0.02."""
        self.assertTrue(0.020 < (HIGH - 2.0) / -FAST < 0.025)
        self.assert_row("residence time", {"c_age": (0.05 + 0.05 + 0.03) / 3})

    def test_angle_of_repose(self):
        self.assert_row("angle of repose", {"v_angle": math.degrees(math.atan(TAN))})

    def test_mixing_and_segregation(self):
        self.assertTrue(0.1 < lacey(2.0) < 0.9)
        self.assert_row("mixing index of Lacey", {"v_lacey": lacey(2.0)})
        self.assert_row("segregation of two types", {"v_above": mean_height(2) - mean_height(1)})


if __name__ == "__main__":
    unittest.main()
