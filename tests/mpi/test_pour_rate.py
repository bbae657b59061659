#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=15 timeout=400
"""fix pour/rate: mass rate, sizes, no overlaps when made, the same on 1, 2 and 4 ranks and after a restart, errors."""

import itertools
import math
import unittest

from message_counts import counting, gathered
from talus_testing import SceneCase, head, marked_word, read_dump, thermo

SCENE = head("si", "p p f") + """
region box block 0 1 0 1 0 2
create_box 2 box
"""
FIXES = """region top block 0 1 0.2 0.8 1.7 1.9
pair_style gran/penalty
pair_coeff * * hooke 1e6 100 tangential multistep NULL NULL 0.5
fix step all nve/sphere/symplectic gravity 9.81 vector 0 0 -1
fix floor all large/body plane 0 0 0.01 0 0 1 contact hooke 1e6 100
group stream empty
timestep 1e-4
fix in stream pour/rate {words}
thermo_style custom step atoms f_in[1] f_in[2] f_in[3]
thermo 100
"""
WORDS = "50 2 top 100.0 diameter uniform 0.05 0.1 mass density 2500 seed 77 velocity 0.1 0 -2"
DUMP = "write_dump all custom {name} id type radius mass x y z vx vy vz modify format float %.17g\n"

# what falls out of the box is lost; thermo output, which looks for it, is rare
LEAKING = head("si") + """
region box block 0 0.1 0 0.1 0 0.3
create_box 1 box
"""
STREAM = """
neighbor 0.001 bin
region feed block 0.02 0.08 0.02 0.08 0.25 0.29
pair_style gran/penalty
pair_coeff * * hooke 2000 500 tangential multistep NULL NULL 0.4
fix step all nve/sphere/symplectic gravity 9.81 vector 0 0 -1
fix in all pour/rate 100 1 feed 0.05 diameter 0.006 density 2500 seed 4711 velocity 0 0 -1
fix plate all large/body plane 0.05 0.05 0.12 0 1 1 contact hooke 2000 500
timestep 5e-5
thermo_style custom step atoms f_in[1] f_in[2]
thermo 100000
thermo_modify lost {lost}
"""


# a bed with a mouth above; {boundary}: of its upper face
BED = head(boundary="f f f{boundary}", map=None) + """
processors {grid}
region box block 0 10 0 10 0 {height}
create_box 1 box
pair_style gran/penalty
pair_coeff * * hertz 2.0e4 50.0
neighbor 0.3 bin
fix step all nve/sphere/symplectic gravity 1.0 vector 0 0 -1
fix floor all large/body plane 0 0 0  0 0 1 contact hertz 2.0e4 50.0
region mouth block 1 9 1 9 17 19
{pour}
region lay block 1 9 1 9 0.5 {top}
fill_region lay 1 number {number} diameter 1.0 density 1.0 seed 8
timestep 0.0005
thermo_style custom step atoms zhi
"""
STREAM_IN = "fix in all pour/rate 200 1 mouth 100 diameter 1.0 density 1.0 seed 3 velocity 0 0 -3"

TABLETS = head("si", "p p f") + """
region box block 0 1 0 1 0 2
create_box 1 box
region top block 0 1 0.2 0.8 1.5 1.9
pair_style gran/penalty
pair_coeff * * hooke 1e6 100 tangential multistep NULL NULL 0.5
fix fall all gravity/talus 9.81 vector 0 0 -1
fix floor all large/body plane 0 0 0.01 0 0 1 contact hooke 1e6 100
fix in all pour/rate 50 1 top 100.0 diameter 0.1 density 1 seed 77 velocity 0 0 -2{end}
fix tablets all shape/gran type 1 ellipsoid 0.05 0.05 0.025 density 2500 orient random 7
timestep 1e-4
thermo_style custom step atoms f_in[1] f_in[2] f_in[3]
thermo 100
run 1000
"""


class Pour(SceneCase):

    def pour(self, words=WORDS, commands="run 1000\n", np=1, name="state", before="", **options):
        script = SCENE + FIXES.format(words=words) + before + commands + DUMP.format(name=name)
        self.log = self.run_lammps(script, np=np, **options).log
        if options.get("expect_error"):
            return None
        frame, = read_dump(self.path(name))
        return frame

    def test_rate_and_ranks(self):
        one = self.pour(before="dump first all custom 50 made id radius x y z vx vy vz\ndump_modify first format float %.17g first no\n")
        rows = thermo(self.log)
        largest = 2500 * math.pi / 6 * 0.1**3
        for row in rows[1:]:
            # the first spheres come with the first step
            self.assertAlmostEqual(row["f_in[1]"], 100.0 * 1e-4 * (row["Step"] + 49), delta=0.51 * largest + 100 * 50e-4)
            self.assertEqual(row["Atoms"], row["f_in[2]"])
            self.assertLessEqual(abs(row["f_in[3]"]), 0.5 * largest)
        self.assertAlmostEqual(rows[-1]["f_in[1]"], math.fsum(one.column("mass").values()), delta=1e-4 * rows[-1]["f_in[1]"])
        self.assertGreater(len(one.atoms), 10)
        self.assertEqual(set(one.column("type").values()), {2})
        diameters = [2 * r for r in one.column("radius").values()]
        self.assertTrue(0.05 <= min(diameters) and max(diameters) <= 0.1)
        for np in (2, 4):
            self.assert_same_bits(one, self.pour(np=np))

    def test_shapes_have_their_own_mass(self):
        """And not that of the spheres around them: the rate, what was made, and where it ends."""
        mass = 2500 * 4 / 3 * math.pi * 0.05 * 0.05 * 0.025
        frames = []
        for np in 1, 2:
            log = self.run_lammps(TABLETS.format(end="") + DUMP.format(name="state"), np=np).log
            for row in thermo(log)[1:]:
                self.assertAlmostEqual(row["f_in[1]"], mass * row["f_in[2]"], delta=1e-4 * mass * row["f_in[2]"])
                self.assertAlmostEqual(row["f_in[1]"], 100.0 * 1e-4 * (row["Step"] + 49), delta=0.51 * mass + 100 * 50e-4)
            frames += read_dump(self.path("state"))
        self.assertGreater(len(frames[0].atoms), 10)
        for found in frames[0].column("mass").values():
            self.assertAlmostEqual(found, mass, delta=1e-12)
        self.assert_same_bits(*frames)
        log = self.run_lammps(TABLETS.format(end=" mass 4")).log
        self.assertAlmostEqual(thermo(log)[-1]["f_in[1]"], 4.0, delta=mass)
        self.assertEqual(thermo(log)[-1]["f_in[2]"], math.ceil(4.0 / mass))

    def test_fill_region_asks_for_the_sphere_around_a_shape(self):
        region = TABLETS.split("timestep")[0].format(end="") + "region lay block 0 1 0 1 0.02 1.4\n"
        fill = "fill_region lay 1 number 20 diameter {} density 1 seed 3\n"
        for np in 1, 2:
            log = self.run_lammps(region + fill.format(0.09), np=np, expect_error=True).log
            self.assertIn("fill_region: particles of type 1 have a shape, and the sphere around it has a diameter of 0.1, more than the "
                          "0.09 given: give it a diameter of 0.1000001", " ".join(log.split()))
        self.assertIn("fill_region: 20 spheres in region lay", self.run_lammps(region + fill.format(0.1) + "run 0\n").log)

    def test_spheres_as_they_are_made(self):
        dump = "dump made all custom 1 made id radius x y z vx vy vz\ndump_modify made format float %.17g first yes\n"
        self.pour(WORDS.replace("100.0", "900"), before=dump, commands="run 4\n")
        frame = [f for f in read_dump(self.path("made")) if f.atoms][0]
        spheres = [tuple(row[frame.columns.index(c)] for c in ("x", "y", "z", "radius")) for row in frame.atoms.values()]
        self.assertGreater(len(spheres), 3)
        for a, b in itertools.combinations(spheres, 2):
            d = [p - q for p, q in zip(a[:3], b[:3])]
            d[0] -= round(d[0])
            self.assertGreater(math.hypot(*d), (a[3] + b[3]) * (1 - 1e-9))
        for x, y, z, r in spheres:
            self.assertTrue(0.2 <= y - r and y + r <= 0.8 and z + r <= 1.9 and 1.69 <= z - r)
        for v in frame.column("vx").values():
            self.assertEqual(v, 0.1)

    def test_properties_of_new_spheres(self):
        """0, and not those of the ghost or particle that was at their place in memory."""
        lying = "".join(f"create_atoms 1 single {0.05 + 0.15 * k} 0.5 0.06 units box\n" for k in range(6))
        script = (SCENE + "fix hot all property/atom temperature heatflow mol d_mark i_note d2_pair 2 ghost yes\n" + lying +
                  "set group all diameter 0.08 density 2500 temperature 4 mol 9 d_mark 7 i_note 3 d2_pair[1] 5 d2_pair[2] 6\n" +
                  FIXES.format(words=WORDS) + "compute all all property/atom temperature mol d_mark i_note d2_pair[1] d2_pair[2]\nrun 300\n"
                  "write_dump all custom state id c_all[*]\n")
        for np in 1, 2:
            self.run_lammps(script, np=np)
            rows = read_dump(self.path("state"))[0].atoms
            self.assertGreater(len(rows), 12)
            for tag, row in rows.items():
                self.assertEqual(list(row)[1:], [4, 9, 7, 3, 5, 6] if tag <= 6 else [0] * 6)

    def test_restart_and_end(self):
        whole = self.pour(commands="run 400\nrun 400\n")
        self.pour(commands="run 400\nwrite_restart half\n")
        again = FIXES.format(words=WORDS).replace("group stream empty\n", "")
        self.run_lammps("read_restart half\n" + again + "run 400\n" + DUMP.format(name="again"), np=2)
        frame, = read_dump(self.path("again"))
        self.assert_same_bits(whole, frame)
        self.pour(WORDS + " mass 4.0")
        self.assertAlmostEqual(thermo(self.log)[-1]["f_in[1]"], 4.0, delta=1.31)
        self.assertEqual(thermo(self.log)[-1]["f_in[2]"], thermo(self.log)[-2]["f_in[2]"])

    def test_a_stream_that_leaves_the_box(self):
        for lost in "ignore", "warn":
            for np in 1, 2:
                with self.subTest(lost=lost, np=np):
                    commands = "run 5000\nwrite_restart half\nrun 2000\n" + DUMP.format(name="on")
                    log = self.run_lammps(LEAKING + STREAM.format(lost=lost) + commands, np=np).log
                    end = thermo(log)[-1]
                    self.assert_close(end["f_in[1]"], 0.05 * 7000 * 5e-5, 0.03)
                    self.assertLess(end["Atoms"], 0.7 * end["f_in[2]"])
                    self.run_lammps("read_restart half\n" + STREAM.format(lost=lost) + "run 2000\n" + DUMP.format(name="again"),
                                    np=np)
                    (on,), (again,) = read_dump(self.path("on")), read_dump(self.path("again"))
                    self.assertEqual(len(on.atoms), end["Atoms"])
                    self.assert_same_bits(on, again)

    def test_what_has_left_is_still_reported(self):
        log = self.run_lammps(LEAKING + STREAM.format(lost="error") + "run 5000\n", expect_error=True).log
        self.assertRegex(log, r"Lost atoms: original \d+ current \d+")

    def test_a_stream_that_is_too_strong(self):
        self.pour(WORDS.replace("100.0", "4e5"))
        self.assertEqual(self.log.count("finds no place: the region is too small or particles do not leave it fast enough"), 1)

    def test_with_styles_of_the_host(self):
        more = ("pair_style gran/hooke/history 1e6 NULL 100 NULL 0.5 1\npair_coeff * *\nunfix floor\n"
                "fix floor all wall/gran hooke/history 1e6 NULL 100 NULL 0.5 1 zplane 0 NULL\n")
        first = self.pour(before=more)
        self.assert_same_bits(first, self.pour(before=more, arguments=["-sf", "talus"], np=2), ["radius", "mass"])

    def bed(self, commands, name, boundary="s", grid="* * *", pour=STREAM_IN, top=4, height=20, np=1, **options):
        script = BED.format(boundary=boundary, grid=grid, pour=pour, top=top, height=height, number=25 * top) + commands
        self.log = self.run_lammps(script + DUMP.format(name=name), np=np, **options).log
        return None if options.get("expect_error") else read_dump(self.path(name))[0]

    def test_a_box_that_is_shrink_wrapped_grows(self):
        fixed = self.bed("run 2000\n", "fixed", boundary="")
        self.assertGreater(len(fixed.atoms), thermo(self.log)[0]["Atoms"] + 100)
        for boundary in "s", "m":
            for np, grid in (1, "1 1 1"), (2, "1 1 2"), (4, "2 2 1"):
                with self.subTest(boundary=boundary, np=np):
                    self.assert_same_bits(fixed, self.bed("run 2000\n", "wrapped", boundary, grid, np=np))
                    self.assertGreater(thermo(self.log)[-1]["Zhi"], 17)
        self.bed("run 10\n", "refused", grid="1 1 4", height=5, np=4, expect_error=True)
        self.assertIn("fix pour/rate in: the box grows too fast for this number of ranks along it, to reach the region: use "
                      "'boundary' with m in the place of s", " ".join(self.log.split()))
        self.assert_same_bits(fixed, self.bed("run 2000\n", "least", "m", "1 1 4", np=4))

    def test_fill_region_beyond_a_face_that_is_shrink_wrapped(self):
        fill = "run 1\nfill_region mouth 1 number 60 diameter 1.0 density 1.0 seed 1\nrun 100\n"
        filled = None
        for np, grid in (1, "1 1 1"), (2, "2 1 1"), (4, "1 1 4"):
            frame = self.bed(fill, "filled", "s", grid, pour="", height=5, np=np)
            filled = filled or frame
            self.assert_same_bits(filled, frame)
        self.assertEqual(len(filled.atoms), 100 + 60)
        self.assertEqual(sum(16.9 < z < 19 for z in filled.column("z").values()), 60)

    def test_more_spheres_than_can_be_meant(self):
        for np in 1, 2:
            self.bed("run 10\n", "none", pour=STREAM_IN.replace("diameter 1.0", "diameter 1e-3"), np=np, expect_error=True)
            self.assertRegex(" ".join(self.log.split()), r"fix pour/rate in: 1\.91e\+10 particles are due at a time, a mass of 10: this is "
                             "more than this command is made for, look for a wrong unit in the mass rate, the diameter or "
                             "the density, or take a smaller N")
        # what is due and has no room is no reason
        self.bed("run 2500\n", "full", pour=STREAM_IN.replace("mouth 100", "mouth 1e12"), top=2)
        self.assertIn("finds no place", self.log)

    def test_a_mouth_that_moves(self):
        """Spheres are where it is, and what ranks send each other for that follows the mouth, not the bed."""
        mouth = "region mouth block 1 3 4 6 17 19 move v_way NULL NULL{}\n" + STREAM_IN
        motion = "variable way equal 10*time\nvariable angle equal 3*time\n"
        turning = " rotate v_angle 3 5 18 0 0 1"
        for more, shift in ("", 0.0), (turning, None):
            with self.subTest(more):
                frame = self.bed("run 600\n", "moved", "", pour="region mouth delete\n" + motion + mouth.format(more))
                made = [row for tag, row in frame.atoms.items() if tag > thermo(self.log)[0]["Atoms"]]
                self.assertGreater(len(made), 2)
                if shift is None:
                    continue
                x, y, z = (frame.columns.index(name) for name in "xyz")
                for row in made:
                    # at steps 1, 201 and 401; it has fallen since
                    self.assertTrue(4 <= row[y] <= 6 and any(
                        1.5 <= row[x] - 10 * 0.0005 * (step - 1) <= 2.5 for step in (1, 201, 401)), row)
        size = []
        for top in 2, 9:
            counts = self.path(f"counts{top}")
            self.bed("run 600\n", "counted", "", "2 1 1", "region mouth delete\n" + motion + mouth.format(""), top, np=2,
                     env=counting(counts))
            size.append(gathered(counts, 2))
        self.assertEqual(size[0], size[1])
        self.assertGreater(size[0], 0)

    def test_errors(self):
        cases = [("50 2", "fix pour/rate: missing region-ID", None), (WORDS.replace("50 2", "0 2"), r"expected N \(a whole number >= 1\)", "0"),
                 (WORDS.replace("50 2", "50 3"), "there are 2 types of atoms", "3"),
                 (WORDS.replace("100.0", "-1"), "expected mass rate", "-1"),
                 (WORDS.replace("top", "none"), "fix pour/rate: there is no region 'none'", None),
                 (WORDS.replace("velocity", "speed"), "unknown keyword 'speed', expected diameter, density, seed, velocity, attempts or mass", "speed"),
                 (WORDS.replace("seed 77", ""), "missing seed", None), (WORDS.replace("density 2500", ""), "missing density", None),
                 (WORDS.split("diameter")[0], "missing diameter", None)]
        for k, (words, message, word) in enumerate(cases):
            for np in (1, 2) if k % 4 == 0 else (1,):
                with self.subTest(message, np=np):
                    self.pour(words, np=np, expect_error=True)
                    self.assertRegex(self.log, message)
                    if word:
                        self.assertEqual(marked_word(self.log), word)


if __name__ == "__main__":
    unittest.main()
