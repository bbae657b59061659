#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""fill_region: solid fraction, distribution of sizes, overlaps, walls, the same spheres on 1, 2 and 4 ranks, errors."""

import itertools
import math
import unittest

from talus_testing import SceneCase, head, marked_word, read_dump

BEGIN = head("si", "{boundary}") + """
region box block -1 1 -1 1 -1 1
create_box 2 box
region r {region}
"""
WRITE = """
pair_style gran/penalty
pair_coeff * * hooke 1e6 100
fix step all nve/sphere/symplectic
timestep 1e-5
{before}
run 0
write_dump all custom {name} id type radius mass x y z modify format float %.17g
"""
COMMON = "density 2500 seed 4711"


def volume(d):
    return math.pi / 6 * d**3


class Fill(SceneCase):

    def fill(self, words, region="block -1 1 -1 1 -1 1", boundary="p p f", np=1, name="state", before="", **options):
        script = (BEGIN.format(boundary=boundary, region=region) + f"fill_region r {words}\n" +
                  WRITE.format(name=name, before=before))
        result = self.run_lammps(script, np=np, **options)
        self.log = result.log
        if options.get("expect_error"):
            return None
        frame, = read_dump(self.path(name))
        return frame

    def spheres(self, frame):
        columns = [frame.columns.index(c) for c in ("x", "y", "z", "radius")]
        return [tuple(row[c] for c in columns) for _, row in sorted(frame.atoms.items())]

    def deepest(self, spheres, periodic, limit):
        cells, edge, worst = {}, 2 * max(s[3] for s in spheres), 0.0
        n = max(1, int(2 / edge))
        for k, s in enumerate(spheres):
            cells.setdefault(tuple(min(n - 1, int((s[d] + 1) / 2 * n)) for d in range(3)), []).append(k)
        for cell, mine in cells.items():
            near = set()
            for shift in itertools.product((-1, 0, 1), repeat=3):
                near.add(tuple((c + s) % n for c, s in zip(cell, shift)))
            for i in mine:
                for j in (j for other in near for j in cells.get(other, ()) if j < i):
                    a, b = spheres[i], spheres[j]
                    d = [abs(p - q) for p, q in zip(a[:3], b[:3])]
                    d = [min(x, 2 - x) if p else x for x, p in zip(d, periodic)]
                    worst = max(worst, (a[3] + b[3] - math.hypot(*d)) / min(a[3], b[3]))
        self.assertLessEqual(worst, limit * (1 + 1e-9))
        return worst

    def test_the_same_on_any_number_of_ranks(self):
        words = f"1 fraction 0.58 diameter uniform 0.15 0.3 mass {COMMON}"
        one = self.fill(words)
        self.deepest(self.spheres(one), (True, True, False), 1e-3)
        for s in self.spheres(one):
            self.assertLessEqual(abs(s[2]) + s[3], 1 + 1.001e-3 * s[3])
        self.assert_close(sum(volume(2 * s[3]) for s in self.spheres(one)) / 8, 0.58, 0.01)
        self.assertTrue(any(abs(s[0]) + s[3] > 1.05 for s in self.spheres(one)), "no wall at the periodic faces")
        for np in (2, 4):
            self.assert_same_bits(one, self.fill(words, np=np))
        other = self.fill(words.replace("4711", "4712"))
        self.assertNotEqual(self.spheres(one), self.spheres(other))

    def test_distributions(self):
        cases = {
            "discrete 2 0.2 3 0.1 1 number": lambda d: None,
            "discrete 2 0.2 3 0.1 1 mass": lambda d: None,
            "uniform 0.1 0.2 number": lambda q: 0.1 + 0.1 * q,
            "uniform 0.1 0.2 mass": None,
            "lognormal 0.14 0.2 0.08 0.25 mass": None,
        }
        for words in cases:
            with self.subTest(words):
                frame = self.fill(f"2 fraction 0.3 diameter {words} {COMMON} overlap 0.01")
                diameters = sorted(2 * s[3] for s in self.spheres(frame))
                masses = [volume(d) for d in diameters]
                self.assertEqual({row[frame.columns.index("type")] for row in frame.atoms.values()}, {2})
                for tag, mass in frame.column("mass").items():
                    self.assert_close(mass, 2500 * volume(2 * frame.column("radius")[tag]), 1e-12)
                self.assert_close(sum(masses), 0.3 * 8, 0.01)
                if "discrete" in words:
                    large = [d for d in diameters if d > 0.15]
                    share = (len(large) / len(diameters) if "number" in words else sum(map(volume, large)) / sum(masses))
                    self.assertAlmostEqual(share, 0.75, delta=2e-3)
                elif "number" in words:
                    for k, d in enumerate(diameters):
                        self.assertAlmostEqual(d, 0.1 + 0.1 * (k + 0.5) / len(diameters), delta=1e-9)
                else:
                    below = lambda d: (d - 0.1) / 0.1
                    if "lognormal" in words:
                        normal = lambda d: 0.5 * math.erfc(-math.log(d / 0.14) / 0.2 / math.sqrt(2))
                        below = lambda d: (normal(d) - normal(0.08)) / (normal(0.25) - normal(0.08))
                    passed = 0.0
                    for d, m in zip(diameters, masses):
                        passed += m / sum(masses)
                        self.assertAlmostEqual(passed, below(d), delta=0.01)

    def test_shapes_numbers_and_what_is_there(self):
        frame = self.fill(f"1 fraction 0.55 diameter 0.2 {COMMON}", "cylinder z 0 0 0.8 -0.9 0.7", "f f f")
        for x, y, z, r in self.spheres(frame):
            self.assertLessEqual(math.hypot(x, y) + r, 0.8 + 1.001e-3 * r)
            self.assertTrue(-0.9 - 1e-3 * r <= z - r and z + r <= 0.7 + 1e-3 * r)
        free = math.pi * 0.64 * 1.6
        self.assert_close(len(frame.atoms) * volume(0.2) / free, 0.55, 0.01)
        self.assertRegex(self.log, rf"fill_region: {len(frame.atoms)} spheres in region r, solid fraction 0\.5\d+ of its volume 3\.2\d+")
        # spheres beside others, which stay where they are
        script = (BEGIN.format(boundary="f f f", region="block -0.5 0.5 -0.5 0.5 -0.5 0.5") +
                  f"fill_region r 1 number 5 diameter 0.4 {COMMON}\n" +
                  WRITE.format(name="first", before="") + f"fill_region box 2 number 150 diameter 0.25 {COMMON}\nrun 0\n"
                  "write_dump all custom state id type radius mass x y z modify format float %.17g\nrun 100\n")
        self.run_lammps(script, np=2)
        first, = read_dump(self.path("first"))
        both, = read_dump(self.path("state"))
        self.assertEqual(sorted(both.atoms), list(range(1, 156)))
        for tag, row in first.atoms.items():
            self.assertEqual(both.atoms[tag], row)
        self.deepest(self.spheres(both), (False,) * 3, 1e-3)

    def test_limits_that_cannot_be_held(self):
        for np in (1, 2):
            self.fill(f"1 fraction 0.72 diameter 0.25 {COMMON} steps 300", np=np, expect_error=True)
            self.assertRegex(self.log, r"fill_region: \d+ spheres, a solid fraction of 0\.7\d+ of region 'r', do not fit: the largest overlap "
                             r"is 0\.\d+ of the smaller radius after 300 steps, the limit 0\.001\. Ask for fewer spheres or allow more overlap or more steps")
            self.fill(f"1 number 2000 diameter discrete 2 3.0 1e308 0.2 1 {COMMON}", np=np, expect_error=True)
            self.assertRegex(self.log, r"fill_region: 2000 spheres, a solid fraction of [\d.e+]+ of region 'r', cannot fit: ask for fewer "
                             "or smaller spheres")
        frame = self.fill(f"1 fraction 0.68 diameter 0.25 {COMMON} overlap 0.25")
        self.assertGreater(self.deepest(self.spheres(frame), (True, True, False), 0.25), 0.01)

    def test_errors(self):
        good = f"1 fraction 0.5 diameter 0.2 {COMMON}"
        cases = [("", "fill_region: missing type", None), ("3 " + good[2:], "there are 2 types of atoms", "3"),
                 ("1 amount 3", "unknown amount 'amount', expected fraction or number", "amount"),
                 (good.replace("0.5", "1.5"), r"expected solid fraction", "1.5"),
                 (good.replace("0.2", "-1"), r"diameter: expected D, uniform, lognormal or discrete", "-1"),
                 (good.replace("0.2", "uniform 0.3 0.2"), "diameter: hi must not be less than lo", "0.2"),
                 (good.replace("0.2", "discrete 2 0.3 1"), "diameter: expected diameter D", "density"),
                 (good.replace("seed 4711", "seed 0"), r"expected seed \(a whole number >= 1\) instead of '0'", "0"),
                 (good.replace("seed 4711", ""), "fill_region: missing seed", None),
                 (good.replace("density 2500", ""), "fill_region: missing density", None),
                 (good + " foo", "unknown keyword 'foo', expected diameter, density, seed, overlap or steps", "foo"),
                 (good + " overlap 0", "expected overlap over the smaller radius", "0"),
                 (good.replace("0.5", "1e-6"), "less than one sphere in region 'r' of volume 8", None),
                 (good.replace("0.2", "1e-4"), "spheres are more than this command is made for", None)]
        for k, (words, message, word) in enumerate(cases):
            for np in (1, 2) if k % 4 == 0 else (1,):
                with self.subTest(message, np=np):
                    self.fill(words, np=np, expect_error=True)
                    self.assertRegex(self.log, message)
                    if word:
                        self.assertEqual(marked_word(self.log), word)
        for region, message in (("block 2 3 -1 1 -1 1", "region 'r' is empty or outside the box"),
                                ("block -1 1 -1 1 -1 1 open 1", "region 'r' has open faces"),
                                ("intersect 2 r1 r2", "region 'r' is empty or outside the box")):
            self.fill(good, region, expect_error=True,
                      boundary="p p f\nregion r1 sphere -0.5 0 0 0.2\nregion r2 sphere 0.5 0 0 0.2")
            self.assertRegex(self.log, message)
        self.run_for(f"fill_region no {good}", "fill_region: there is no region 'no'")
        self.assertRegex(self.run_lammps(f"fill_region r {good}", expect_error=True).log, "before the simulation box is defined")
        script = "region r block 0 1 0 1 0 1\ncreate_box 1 r\n" + f"fill_region r {good}\n"
        self.assertRegex(self.run_lammps(script, expect_error=True).log, "requires atom attributes radius and rmass, and IDs")
        script = "atom_style sphere\nregion r prism 0 1 0 1 0 1 0.1 0 0\ncreate_box 1 r\n" + f"fill_region r {good}\n"
        self.assertRegex(self.run_lammps(script, expect_error=True).log, "requires 'dimension 3' and a box that is not triclinic")

    def run_for(self, command, message):
        script = BEGIN.format(boundary="p p f", region="block -1 1 -1 1 -1 1") + command + "\n"
        self.assertRegex(self.run_lammps(script, expect_error=True).log, message)


if __name__ == "__main__":
    unittest.main()
