# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Warnings about deep overlaps and large moves: where they are due, once per run, and not elsewhere."""

import math
import re
import unittest

from talus_testing import SceneCase, Sphere, begin, write_sphere_data

OVERLAP = r"WARNING: Pair style gran/penalty: particles (\d+) and (\d+) overlap by (\S+) of the smaller radius at step"
MOVE = r"WARNING: Pair style gran/penalty: particle (\d+) moves by (\S+) of its radius in a time step at step"

BODY_OVERLAP = r"WARNING: Fix large/body (\S+): particle (\d+) overlaps the body by (\S+) of its radius at step"
BODY_MOVE = r"WARNING: Fix large/body (\S+): particle (\d+) and the body move past each other by (\S+) of its radius"

SCRIPT = begin("si", "{boundary}", law="hooke 1000.0 0.0", skin=0.3) + """
fix move all nve/sphere/symplectic
timestep {dt}
thermo 1000
{more}
run {steps}
run {steps}
"""


LOST = "\nthermo_modify lost ignore"    # what flies out of the box


def since_start(cure):
    """The cure of what happens during the run."""
    return "impact" in cure


class Warned(SceneCase):

    def found(self, spheres, pattern, dt=1e-4, steps=10, boundary="f f f", more="", **options):
        write_sphere_data(self.path("data"), ((-5, 5),) * 3, spheres)
        return re.findall(pattern, self.run_lammps(SCRIPT.format(dt=dt, steps=steps, boundary=boundary, more=more), **options).log)

    def pair(self, overlap, axis=0, diameter=1.0):
        """Particles 7 and 3, across the middle of the box; others that touch less."""
        place = [0.0, 0.2, 0.2]
        spheres = []
        for tag, side in (7, -1), (3, 1):
            x = list(place)
            x[axis] = side * (diameter - overlap * diameter / 2) / 2
            spheres.append(Sphere(tuple(x), diameter=diameter, id=tag))
        return spheres + [Sphere((-3, -3, -3), id=1), Sphere((-3, -3, -2.02), id=2)]

    def test_deep_overlap(self):
        for np in 1, 2, 4:
            (low, high, ratio), *more = self.found(self.pair(0.3), OVERLAP, np=np)
            self.assertEqual((low, high), ("3", "7"))
            self.assertAlmostEqual(float(ratio), 0.3, delta=0.02)
            self.assertEqual(more, [], "once for both runs")

    def test_overlap_across_a_periodic_border(self):
        spheres = [Sphere((-4.6, 0, 0), id=4), Sphere((4.6, 0, 0), id=9)]
        (low, high, ratio), *_ = self.found(spheres, OVERLAP, boundary="p p p", np=2)
        self.assertEqual((low, high), ("4", "9"))
        self.assertAlmostEqual(float(ratio), 0.4, delta=0.02)

    def test_smaller_radius_counts(self):
        """An overlap of .06 is little for a sphere of radius 2.5 and much for one of .25."""
        small = [Sphere((0, 0, 0), diameter=5.0), Sphere((2.5 + 0.25 - 0.06, 0, 0), diameter=0.5)]
        large = [Sphere((-1.0, 0, 0), diameter=3.0), Sphere((-1.0 + 3.0 - 0.06, 0, 0), diameter=3.0)]
        self.assertEqual(len(self.found(small, OVERLAP)), 1)
        self.assertEqual(self.found(large, OVERLAP), [])

    def test_ordinary_overlap(self):
        self.assertEqual(self.found(self.pair(0.09), OVERLAP), [])

    def test_again_only_if_it_is_much_worse(self):
        """Overlaps of .3, .4 and .6, which are there from the beginning."""
        spheres = [Sphere((-0.425, 0, 0), id=5), Sphere((0.425, 0, 0), id=6)]
        again = "displace_atoms all ramp x {0} {1} x -0.425 0.425\nrun 0"
        more = "\nfix hold all freeze\nrun 0\n" + again.format(0.025, -0.025) + "\n" + again.format(0.05, -0.05) + "\n"
        found = self.found(spheres, OVERLAP, more=more, steps=0)
        self.assertEqual(len(found), 2)
        for (*_, ratio), expected in zip(found, (0.3, 0.6)):
            self.assertAlmostEqual(float(ratio), expected, delta=0.02)
        write_sphere_data(self.path("data"), ((-5, 5),) * 3, spheres)
        log = self.run_lammps(SCRIPT.format(dt=1e-4, steps=0, boundary="f f f", more="")).log
        self.assertRegex(log, r"particles 5 and 6 overlap by 0.3 of the smaller radius at step 0; they do from the beginning: "
                              "place them further apart")

    def test_deep_overlap_during_an_impact(self):
        """Not there at the beginning of the run: found when the lists are rebuilt."""
        spheres = [Sphere((-0.6, 0, 0), (20, 0, 0), id=5), Sphere((0.6, 0, 0), (-20, 0, 0), id=6)]
        found = self.found(spheres, OVERLAP, dt=1e-3, steps=60)
        self.assertEqual(found[0][:2], ("5", "6"))

    def test_impact_between_two_rebuilds(self):
        """It is over before a particle has moved by half the skin: noticed in the step in which it is deepest."""
        spheres = [Sphere((-0.501, 0, 0), (2.4, 0, 0), id=5), Sphere((0.501, 0, 0), (-2.4, 0, 0), id=6)]
        more = "neighbor 1.0 bin\ncompute deep all penalty/stats\nfix deep all print 1 '$(c_deep[3])' file deep screen no"
        for np in 1, 2:
            (low, high, ratio), *others = self.found(spheres, OVERLAP, dt=1e-3, steps=700, more=more, np=np)
            self.assertEqual((low, high, others), ("5", "6", []))
            self.assertAlmostEqual(float(ratio), self.deepest_of_steps(), delta=5.01e-4, msg="it has three digits")

    def deepest_of_steps(self):
        with open(self.path("deep")) as file:
            return max(float(line) for line in file if not line.startswith("#"))

    def test_impact_on_a_body_between_two_rebuilds(self):
        spheres = [Sphere((0, 0, 0.501), (0, 0, -3.0), id=5), Sphere((0, 4, 4), id=6)]
        more = "neighbor 1.0 bin\nfix floor all large/body plane 0 0 0 0 0 1 contact hooke 1000.0 0.0"
        for np in 1, 2:
            (name, tag, ratio), *others = self.found(spheres, BODY_OVERLAP, dt=1e-3, steps=700, more=more, np=np)
            self.assertEqual((name, tag, others), ("floor", "5", []))
            depth = 3.0 * math.sqrt(math.pi / 6 / 1000.0)
            self.assertAlmostEqual(float(ratio), depth / 0.5, delta=0.01)

    LAWS = {"hooke {k} 0.0": 600.0, "hertz {k} 0.0": 4000.0, "hertz/material {k} 0.9 0.3": 6000.0, "hooke/material {k} 0.9 0.3 4.0": 6000.0}
    NUMBERS = r"for impacts a stiffness \(kn or E\) (\S+) times as high, with (\S+) of the time step, would do"

    def impact(self, law, dt, speed, more=""):
        """Of two spheres, or of one with a body: the ratio that is told, and the cure in numbers."""
        lone = [Sphere((0, 0, 0.501), (0, 0, -speed), id=5), Sphere((0, 4, 4), id=6)]
        pair = [Sphere((-0.501, 0, 0), (speed / 2, 0, 0), id=5), Sphere((0.501, 0, 0), (-speed / 2, 0, 0), id=6)]
        write_sphere_data(self.path("data"), ((-5, 5),) * 3, lone if more else pair)
        script = SCRIPT.replace("hooke 1000.0 0.0", law).format(dt=dt, steps=round(0.35 / dt), boundary="f f f", more=more + LOST)
        log = self.run_lammps(script).log
        return [float(found[2]) for found in re.findall(BODY_OVERLAP if more else OVERLAP, log)], re.findall(self.NUMBERS, log)

    def test_cure_in_numbers_is_enough(self):
        """Of every kind of stiffness, for pairs and bodies; and the time step keeps the steps of an impact."""
        for law, k in self.LAWS.items():
            for body in False, True:
                with self.subTest(law, body=body):
                    def floor(one):
                        return f"fix floor all large/body plane 0 0 0 0 0 1 contact {one}" if body else ""
                    first, speed = law.format(k=k), 3.0
                    (ratio,), ((times, share),) = self.impact(first, 1e-3, speed, floor(first))
                    times, share = float(times), float(share)
                    print(f"{first}, {'body' if body else 'pair'}: overlap {ratio}, {times} times the stiffness, {share} of the time step")
                    self.assertGreater(ratio, 0.12)
                    self.assertAlmostEqual(0.1 / ratio, share, delta=0.02)
                    cured = law.format(k=k * times)
                    self.assertEqual(self.impact(cured, 1e-3 * share, speed, floor(cured))[0], [])
                    half = law.format(k=k * (1 + 0.5 * (times - 1)))
                    self.assertEqual(len(self.impact(half, 1e-3 * share, speed, floor(half))[0]), 1, "the number is not too large")

    def test_numbers_at_the_limit(self):
        """An advice changes something: nothing is said of .1003, and of .102 what is enough."""
        m = math.pi / 6 / 2
        for overlap, expected in ((0.1003, []), (0.102, [("1.1", "0.98")])):
            speed = overlap * 0.5 * math.sqrt(1000.0 / m)
            self.assertEqual(self.impact("hooke 1000.0 0.0", 1e-4, speed)[1], expected)

    def test_deep_impact(self):
        found, numbers = self.impact("hooke 1000.0 0.0", 1e-3, 20.0)
        self.assertGreater(found[0], 0.5)
        self.assertEqual(numbers, [])

    def test_wrong_side(self):
        """A center behind the surface: the message asks for the normal, or the side, and for a stiffness only if it went through."""
        falls = [Sphere((0, 0, 0.7), (0, 0, -3.0), id=4), Sphere((0, 0, 4), id=9)]
        lies = [Sphere((0, 0, 0.45), id=4), Sphere((0, 0, 4), id=9)]
        text = r"WARNING: Fix large/body (\S+): particle (\d+) overlaps the body by (\S+) of its radius at step \d+( or since the last rebuild)?; " \
            r"its center is behind the surface: if particles belong on that side, use (.*); otherwise (.*)"
        normal, side = "the normal the other way round, or 'two-sided'", "the other one of 'inside' and 'outside'"
        shapes = (("plane 0 0 0 0 0 -1", normal), ("box 0 0 4 9 9 8 outside", side), ("sphere 0 0 4 4 outside", side),
                  ("cylinder 0 0 4 0 0 1 4 8 outside", side))
        for np, spheres, cure in ((1, falls, "no impact should go so deep"), (2, lies, "it is there from the beginning: move the particle")):
            for shape, turn in shapes:
                with self.subTest(shape, np=np):
                    more = f"fix wall all large/body {shape} contact hooke 1000.0 0.0{LOST}"
                    (name, tag, ratio, since, told, otherwise), *_ = self.found(spheres, text, dt=1e-3, steps=200 if since_start(cure) else 10,
                                                                              more=more, np=np)
                    self.assertEqual((name, tag, told), ("wall", "4", turn))
                    self.assertGreater(float(ratio), 1.0)
                    self.assertIn(cure, otherwise)
        right = "fix wall all large/body plane 0 0 0 0 0 1 contact hooke 1000.0 0.0"
        self.assertEqual(self.found(lies, text, dt=1e-3, steps=10, more=right), [])

    def test_shapes(self):
        """Of the largest sphere inside of a plate, which is much smaller than the one around it: of two, and of one with a body. And of
        one that turns so fast that its corners are not followed."""
        plates = "fix plates all shape/gran type 1 box 1 1 0.1 density 1.0\nunfix move\n"
        floor = "fix floor all large/body plane 0 0 0 0 0 1 contact hooke 1000.0 0.0\n"
        low, high = Sphere((0, 0, 1.0), id=3), Sphere((0.2, 0, 1.101), (0, 0, -2.0), id=8)
        for np in 1, 2:
            found = self.found([low, high], OVERLAP, dt=1e-3, steps=100, more=plates, np=np)
            self.assertEqual([one[:2] for one in found], [("3", "8")])
            fall = [Sphere((0, 0, 0.051), (0, 0, -2.0), id=5), Sphere((0, 3, 3), id=9)]
            found = self.found(fall, BODY_OVERLAP, dt=1e-3, steps=100, more=plates + floor, np=np)
            self.assertEqual([one[:2] for one in found], [("floor", "5")])
            turning = [Sphere((0, 0, 1.0), omega=(0, 0, 10.0), id=4), Sphere((0, 3, 3), id=9)]
            turned = r"WARNING: Pair style gran/penalty: particle 4 moves by (\S+) of its radius \(its corners by so much of that of the " \
                r"largest sphere inside\) in a time step"
            ratio, *_ = self.found(turning, turned, dt=1e-3, steps=1, more=plates, np=np)
            self.assertAlmostEqual(float(ratio), 1e-3 * 10.0 * math.sqrt(0.5) / 0.05, delta=1e-3)

    def test_large_move(self):
        spheres = self.pair(0.0) + [Sphere((2, 2, 2), (0, 0, -30), id=5), Sphere((3, -3, 0), (30, 0, 0), diameter=2, id=6)]
        for np in 1, 2:
            (tag, ratio), *more = self.found(spheres, MOVE, dt=2e-3, steps=5, np=np)
            self.assertEqual(tag, "5")
            self.assertAlmostEqual(float(ratio), 0.12, delta=1e-3)
            self.assertEqual(len(more), 1, "once for each of the two runs")
        self.assertEqual(self.found(spheres, MOVE, dt=1.5e-3, steps=5), [])

    def test_bodies(self):
        """Particle 4 is deep in a body, 8 touches it as it should; also one with several contacts, and on any rank."""
        spheres = [Sphere((-2.0, 0, 0.32), id=4), Sphere((2.0, 0, 0.48), id=8), Sphere((0, 3, 3), id=9)]
        law = "contact hooke 1000.0 0.0"
        for np in 1, 2:
            for shape in "plane 0 0 0 0 0 1", "box 0 0 4 9 9 8 inside":
                (name, tag, ratio), *more = self.found(spheres, BODY_OVERLAP, more=f"fix floor all large/body {shape} {law}", np=np)
                self.assertEqual((name, tag), ("floor", "4"))
                self.assertAlmostEqual(float(ratio), 0.36, delta=0.01)
                self.assertEqual(more, [], "once for both runs")
        shallow = self.found(spheres[1:], BODY_OVERLAP, more=f"fix floor all large/body plane 0 0 0 0 0 1 {law}")
        self.assertEqual(shallow, [])

    def test_bodies_that_move(self):
        spheres = [Sphere((1.0, 0, 0.49), id=3), Sphere((0, 3, 3), id=9)]
        belt = "fix belt all large/body plane 0 0 0 0 0 1 contact hooke 1000.0 0.0 move linear 30.0 0 0"
        for dt, count in ((2e-3, 2), (1.5e-3, 0)):
            found = self.found(spheres, BODY_MOVE, dt=dt, steps=5, more=belt)
            self.assertEqual(len(found), count)
            for name, tag, ratio in found:
                self.assertEqual((name, tag), ("belt", "3"))
                self.assertAlmostEqual(float(ratio), 0.12, delta=1e-3)


if __name__ == "__main__":
    unittest.main()
