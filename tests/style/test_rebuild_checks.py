# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""run_style verlet/proxy: neighbor lists are made in time whatever the distance of the checks, and a warning names what
was in the way if not."""

import random
import re
import unittest

from talus_testing import SceneCase, Sphere, head, max_difference, read_dump, write_sphere_data

SCRIPT = head("si") + """
read_data data
neighbor 0.2 bin
neigh_modify {checks}
pair_style gran/penalty
pair_coeff * * hooke 1000.0 0.0
fix move all nve/sphere/symplectic
timestep 0.001
thermo 1000
dump all all custom 100 dump id x y z vx vy vz
dump_modify all format float %a
{run}
"""
# a bed at rest, whose grains are apart by less than they move in the first step
BED = head() + """
read_data data
neighbor {skin} bin
neigh_modify every 1 delay 0 check {check}
pair_style gran/hooke/history 1e5 NULL 50 NULL 0.5 1
pair_coeff * *
fix move all nve/sphere
fix fall all gravity 1.0 vector 0.2 0 -1
fix floor all wall/gran hooke/history 1e5 NULL 50 NULL 0.5 1 zplane 0 NULL
timestep 0.001
thermo 1000
dump all all custom 1 dump id x y z vx vy vz
dump_modify all format float %a
run 3
undump all
dump all all custom 40 dump.later id x y z vx vy vz
dump_modify all format float %a
run 80
"""
# hardly moves: lists are made five times in 2000 steps, and not at step 1000 and 2000
SHEARED = head(boundary="p p p", map="") + """
region box prism 0 8 0 8 0 8 0 0 0
create_box 1 box
lattice sc 1.0
create_atoms 1 box
displace_atoms all random 0.01 0.01 0.01 7
set type 1 diameter 0.95 density 1.0
velocity all create 0.02 11
pair_style gran/hooke/history 1000 NULL 20 NULL 0.3 1
pair_coeff * *
neighbor 0.3 bin
timestep 0.001
fix move all nve/sphere
fix shear all deform 1 xy erate 0.003 remap v
dump all all custom 50 dump id vx vy vz
dump_modify all sort id format float %a
run 2100
"""
DELAYED = "made too late: particles moved by more than half of the skin before the first check"
UNFORESEEN = "made too late: between two checks"


class RebuildChecks(SceneCase):

    def run_scene(self, checks, spheres, run="run 200", np=1):
        write_sphere_data(self.path("data"), ((-5, 5),) * 3, spheres)
        log = self.run_lammps(SCRIPT.format(checks=checks, run=run), np=np).log
        return log, int(re.search(r"Neighbor list builds = (\d+)", log)[1]), int(re.search(r"Dangerous builds = (\d+)", log)[1])

    def collision(self):
        """In 10 steps the fast one moves by .06, where half of the skin is .1; they meet after some 150 steps."""
        return [Sphere((-3.0, 0.1, 0), (6.0, 0, 0)), Sphere((-1.1, 0, 0)), Sphere((3.0, 3.0, 3.0))]

    def test_checks_that_are_far_from_each_other(self):
        for np in 1, 2:
            _, often, _ = self.run_scene("every 1 delay 0 check yes", self.collision(), np=np)
            expected = read_dump(self.path("dump"))
            self.assertGreater(expected[-1].column("vx")[2], 1.0, "they have met")
            for checks in "every 2 delay 0 check yes", "every 10 delay 0 check yes", "every 3 delay 6 check yes":
                with self.subTest(checks=checks, np=np):
                    log, builds, dangerous = self.run_scene(checks, self.collision(), np=np)
                    self.assertEqual(dangerous, 0)
                    self.assertNotIn("too late", log)
                    self.assertGreaterEqual(builds, often)
                    for mine, theirs in zip(read_dump(self.path("dump")), expected, strict=True):
                        self.assert_same_bits(mine, theirs)

    def test_lists_are_kept_over_several_checks(self):
        slow = [Sphere((-3.0, 0, 0), (1.0, 0, 0))]    # .005 between two checks
        _, builds, dangerous = self.run_scene("every 5 delay 0 check yes", slow)
        self.assertEqual(dangerous, 0)
        self.assertGreater(builds, 0)
        self.assertLess(builds, 5)

    def bed(self, speed):
        """Columns of grains beside each other that the floor throws up, with gaps below the way of the first step."""
        draw = random.Random(5)
        spheres = []
        for i in range(5):
            for j in range(3):
                z = 0.0
                for k in range(5):
                    radius = draw.uniform(0.4, 0.5)
                    z += radius + (draw.uniform(0.0, 1e-6) if k else -1e-3)
                    spheres.append(Sphere((1.0 * i - 2.0 + (0.5 - radius), 1.0 * j - 1.0, z),
                                          tuple(speed * draw.uniform(-1, 1) for _ in range(3)), diameter=2 * radius))
                    z += radius
        return spheres

    def test_skin_of_zero(self):
        """Contacts that begin in the first step, or in any other, are not missed: the numbers are those of a wide skin."""
        for speed in 0.0, 0.5:
            write_sphere_data(self.path("data"), ((-5, 5), (-5, 5), (-1, 9)), self.bed(speed))

            def frames(skin, check, words, np):
                self.run_lammps(BED.format(skin=skin, check=check), np=np, arguments=words)
                return read_dump(self.path("dump")) + read_dump(self.path("dump.later"))

            expected, stock = frames(0.3, "yes", ("-sf", "talus"), 1), frames(0.3, "yes", (), 1)
            self.assertNotEqual(expected[1].column("vz"), expected[2].column("vz"))
            for mine, theirs in zip(expected[:4], stock[:4], strict=True):
                self.assertLess(max_difference(mine, theirs, ("vx", "vy", "vz")), 1e-12)
            for check, np in (("yes", 1), ("no", 1), ("yes", 2)):
                with self.subTest(speed=speed, check=check, ranks=np):
                    for mine, theirs in zip(frames(0.0, check, ("-sf", "talus"), np), expected, strict=True):
                        self.assert_same_bits(mine, theirs)

    def test_delay(self):
        log, _, dangerous = self.run_scene("every 1 delay 30 check yes", self.collision())
        self.assertGreater(dangerous, 0)
        self.assertIn(DELAYED, log)
        self.assertIn("'neigh_modify every 1 delay 30'", log)
        self.assertNotIn(UNFORESEEN, log)

    def test_acceleration(self):
        """From a small speed to beyond half of the skin in a step; from rest nothing is taken for granted."""
        for speed, late in (1e-3, True), (0.0, False):
            log, _, dangerous = self.run_scene("every 1 delay 0 check yes", [Sphere((-3.0, 0, 0), (speed, 0, 0))],
                                               run="fix push all addforce 150000.0 0 0\nrun 3")
            self.assertEqual(dangerous > 0, late)
            self.assertEqual(UNFORESEEN in log, late)
            self.assertNotIn(DELAYED, log)

    def test_no_lists_of_ours_where_velocities_change_at_boundaries(self):
        """LAMMPS changes them when it makes lists: in other steps they would be others in output."""
        builds, frames = [], []
        for words in (), ("-sf", "talus"):
            log = self.run_lammps(SHEARED, np=2, arguments=words).log
            builds.append(re.findall(r"Neighbor list builds = (\d+)", log))
            frames.append(read_dump(self.path("dump")))
        self.assertEqual(*builds)
        for stock, ours in zip(*frames):
            self.assertLess(max_difference(stock, ours, ("vx", "vy", "vz")), 1e-9, stock.step)


if __name__ == "__main__":
    unittest.main()
