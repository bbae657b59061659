# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""Convex particles of extreme shape fall into a box: none is lost, none goes through a wall or another one, nothing is not a
number; the deepest overlap is printed. And the warning where cores of rounded particles overlap."""

import math
import random
import unittest

from talus_testing import SceneCase, Sphere, begin, read_dump, thermo, write_sphere_data

POUR = begin(read="read_data grains", law="{law}", skin="{skin}", dt="{dt}") + """
fix s all shape/gran {shapes}
fix g all gravity/talus 10 vector 0 0 -1
fix walls all large/body box 0 0 {top} {side} {side} $(2*{top}) inside contact {law}
compute deep all contact/gran/local overlap
compute deepest all reduce max c_deep inputs local
variable height atom 10*mass*z
compute height all reduce sum v_height
thermo {every}
thermo_style custom step atoms f_s c_deepest f_s[6] c_height
thermo_modify norm no lost error format float %.17g
run {steps}
write_dump all custom state id type x y z f_s[1] f_s[2] f_s[3] f_s[4] modify format float %.17g
"""


def rotated(q, r):
    w, x, y, z = q
    return ((1 - 2 * (y * y + z * z)) * r[0] + 2 * (x * y - w * z) * r[1] + 2 * (x * z + w * y) * r[2],
            2 * (x * y + w * z) * r[0] + (1 - 2 * (x * x + z * z)) * r[1] + 2 * (y * z - w * x) * r[2],
            2 * (x * z - w * y) * r[0] + 2 * (y * z + w * x) * r[1] + (1 - 2 * (x * x + y * y)) * r[2])


def corners_of(a, b, c):
    return [(sx * a / 2, sy * b / 2, sz * c / 2) for sx in (-1, 1) for sy in (-1, 1) for sz in (-1, 1)]


def round_stone(count):
    draw = random.Random(5)
    found = []
    for _ in range(count):
        x = [draw.gauss(0, 1) for _ in range(3)]
        size = 2 * math.sqrt(sum(c * c for c in x))
        found.append(tuple(c / size for c in x))
    return found


class Poured(SceneCase):

    def pour(self, name, shapes, thinnest, spacing, stiffness, steps, dt, corners, across=3, layers=3, warned=False,
             types=None, damping=400):
        """Bodies on a lattice; corners: of types; thinnest: smallest width of a body."""
        types = types or [1]
        grains = []
        for n in range(across * across * layers):
            place = [spacing * (s + 0.5) for s in (n % across, n // across % across, n // across ** 2)]
            place = [place[0] - 0.5 * across * spacing, place[1] - 0.5 * across * spacing, place[2]]
            grains.append(Sphere(tuple(place), v=(0.3 * math.sin(n), 0.3 * math.cos(2 * n), -1.0),
                                 omega=(math.sin(3 * n), math.cos(5 * n), 0.2), type=types[n % len(types)]))
        side, top = across * spacing, (layers + 1) * spacing
        reach = 0.5 * side + 1
        write_sphere_data(self.path("grains"), ((-reach, reach), (-reach, reach), (-1, 2 * top + 1)), grains, len(set(types)))
        run = self.run_lammps(POUR.format(skin=0.05 * spacing, dt=dt, shapes=shapes, side=side, top=top, steps=steps,
                                          law=f"hooke {stiffness} {damping} tangential multistep NULL NULL 0.5", every=max(1, steps // 200)))
        rows = thermo(run.log)
        deepest = max(row["c_deepest"] for row in rows)
        warnings = [line for line in run.log.splitlines() if line.startswith("WARNING")]
        print(f"{name}: deepest overlap {deepest / thinnest:.3f} of the thinnest width, kinetic energy {rows[-1]['f_s']:.1e} "
              f"from {max(row['f_s'] for row in rows):.1e}, {rows[-1]['f_s[6]']:.0f} pairs, {len(warnings)} warnings")
        self.assertEqual(rows[-1]["Atoms"], len(grains))
        self.assertTrue(all(math.isfinite(row["f_s"]) for row in rows))
        energies = [row["f_s"] + row["c_height"] for row in rows]
        self.assertLess(max(energies), energies[0] + 1e-3 * abs(energies[0]), "no energy out of nothing")
        self.assertLess(energies[-1], energies[0])
        if warned:
            self.assertTrue(warnings)
        else:
            self.assertEqual(warnings, [])
            self.assertLess(deepest, 0.5 * thinnest, "none goes through another one")
        frame, = read_dump(self.path("state"))
        for tag in range(1, len(grains) + 1):
            at = [frame.column(c)[tag] for c in "xyz"]
            turn = [frame.column(f"f_s[{k}]")[tag] for k in range(1, 5)]
            for corner in corners[int(frame.column("type")[tag]) - 1]:
                x = [a + b for a, b in zip(at, rotated(turn, corner))]
                self.assertGreater(x[2], -0.5 * thinnest)
                self.assertLess(max(abs(x[0]), abs(x[1])), 0.5 * side + 0.5 * thinnest)
        return run

    def test_rods(self):
        core = 0.016, 0.016, 0.996
        for name, words, corners in (("sharp rods 1:50", "box 0.02 0.02 1", corners_of(0.02, 0.02, 1)),
                                     ("rods 1:50", "box 0.016 0.016 0.996 rounded 0.002", corners_of(*core))):
            with self.subTest(name):
                self.pour(name, f"type 1 {words} density 2500 orient random 4", 0.02, 1.1, 3.2e7, 112500, 1e-5, [corners], damping=800)

    def test_plates(self):
        for name, words in (("sharp plates", "box 1 1 0.02"), ("plates", "box 0.99 0.99 0.01 rounded 0.005")):
            with self.subTest(name):
                self.pour(name, f"type 1 {words} density 50 orient random 4", 0.02, 1.5, 2.4e7, 60000, 2e-5,
                          [corners_of(0.99, 0.99, 0.01)])

    def test_many_corners(self):
        stone = round_stone(500)
        flat = " ".join(f"{c:.15g}" for corner in stone for c in corner)
        for rounded in "", " rounded 0.02":
            with self.subTest(rounded):
                self.pour(f"500 corners{rounded}", f"type 1 vertices 500 {flat}{rounded} density 2 orient random 4", 0.95, 1.15,
                          1e5, 4000, 3e-4, [[]], across=2, layers=2, damping=60)

    def test_size_ratio(self):
        small = corners_of(0.1, 0.1, 0.1)
        self.pour("size ratio 1:30", "type 1 box 2.9 2.9 2.9 rounded 0.05 density 1 orient random 4 "
                  "type 2 box 0.09 0.09 0.09 rounded 0.005 density 1000 orient random 5", 0.1, 5.5, 6e6, 50000, 2.8e-5,
                  [corners_of(2.9, 2.9, 2.9), small], across=2, layers=2, types=[1, 2])

    def test_cores_that_overlap_are_warned_of(self):
        run = self.pour("soft rods", "type 1 box 0.016 0.016 0.996 rounded 0.002 density 2500 orient random 4", 0.02, 1.1, 2e4,
                        6000, 2e-4, [[]], warned=True, damping=60)
        said = [line for line in run.log.splitlines() if "the cores of the rounded particles" in line]
        self.assertTrue(said)
        self.assertRegex(said[0], r"the cores of the rounded particles \d+ and \d+ overlap, by \S+ of the smaller rounding "
                                  r"radius, at step \d+")


if __name__ == "__main__":
    unittest.main()
