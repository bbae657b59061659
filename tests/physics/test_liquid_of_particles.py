# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=240
"""Bridges of the liquid that particles have: a pair that is drawn apart twice, against the equations of the page and against
bridges of given volume; energy; grains that are shaken, against a slow twin; what is refused."""

import itertools
import math
import random
import unittest

from talus_testing import SceneCase, Sphere, begin, read_dump, thermo, write_sphere_data

RADII, LIQUID = (1.0e-3, 1.7e-3), (3.0e-12, 8.0e-13)
TENSION, THETA, SPEED = 0.05, 30, 0.1
ELASTIC = "hertz 1e6 0.0"
HAVE = "fix liquid all property/atom d_liquid ghost yes\n"


def cap(own, other):
    return (1 - math.sqrt(1 - (other / (own + other))**2)) / 2


def facing(radii, liquid):
    return cap(*radii) * liquid[0], cap(*reversed(radii)) * liquid[1]


def volume_of(radii, liquid, share, largest):
    return min(share * sum(facing(radii, liquid)), largest)


def after_rupture(radii, liquid, share, volume):
    """What both have then."""
    one, other = facing(radii, liquid)
    half = min(volume, share * (one + other)) / 2
    flow = half * (other - one) / (one + other)
    return liquid[0] + flow, liquid[1] - flow


def willett(gap, volume):
    radius = 2 * RADII[0] * RADII[1] / sum(RADII)
    s = gap * math.sqrt(radius / volume)
    return 2 * math.pi * radius * TENSION * math.cos(math.radians(THETA)) / (1 + 1.05 * s + 2.5 * s * s)


def reach(volume):
    return (1 + math.radians(THETA) / 2) * volume**(1 / 3)


PAIR = begin("si", law=ELASTIC + " {adhesion}", skin=1e-3, dt=1e-6) + HAVE + """
set atom 1 d_liquid {one!r}
set atom 2 d_liquid {other!r}
group one id 1
group other id 2
fix hold one move linear 0 0 0
fix drive other move linear 0 0 {speed}
dump state all custom 10 out id z fz d_liquid
dump_modify state format float %.17g
run 5000
unfix drive
fix drive other move linear 0 0 -{speed}
run 5000
unfix drive
fix drive other move linear 0 0 {speed}
run 5000
"""


class Pair(SceneCase):

    def states(self, adhesion, liquid=LIQUID):
        """(gap, pull, liquid of both)."""
        write_sphere_data(self.path("data"), ((-1e-2, 1e-2),) * 3,
                          [Sphere((0, 0, 0), diameter=2 * RADII[0]), Sphere((0, 0, sum(RADII) - 1e-6), diameter=2 * RADII[1])])
        self.run_lammps(PAIR.format(adhesion=adhesion, speed=SPEED, one=liquid[0], other=liquid[1]))
        for frame in read_dump(self.path("out")):
            z, f, had = frame.column("z"), frame.column("fz"), frame.column("d_liquid")
            yield z[2] - z[1] - sum(RADII), f[1], (had[1], had[2])

    def drawn_apart(self, states, liquid, share, largest):
        """The liquid of both after that."""
        volume = volume_of(RADII, liquid, share, largest)
        after, bridged = after_rupture(RADII, liquid, share, volume), 0
        for gap, pull, has in states:
            holds = gap < reach(volume)
            for found, expected in zip(has, liquid if holds else after, strict=True):
                self.assert_close(found, expected, 1e-14)
            if not holds:
                self.assertEqual(pull, 0)
            elif gap > 0:
                self.assert_close(pull, willett(gap, volume), 1e-9)
                bridged += 1
        self.assertGreater(bridged, 50)
        self.assertFalse(holds)
        return after

    def check(self, share, largest):
        states = list(self.states(f"adhesion willett {TENSION} {THETA} volume {largest!r} share {share}"))
        once = self.drawn_apart(states[:501], LIQUID, share, largest)
        for gap, pull, has in states[501:1001]:    # and brought back
            self.assertTrue(gap < 0 or pull == 0)
            for found, expected in zip(has, once, strict=True):
                self.assert_close(found, expected, 1e-14)
        twice = self.drawn_apart(states[1001:], once, share, largest)
        print(f"\n{LIQUID} -> {once} -> {twice}")
        self.assertGreater(abs(twice[0] - LIQUID[0]), 0.01 * LIQUID[0])
        self.assert_close(sum(states[-1][2]), sum(LIQUID), 1e-15)

    def test_all_that_is_between_them(self):
        self.check(1, 1e-11)

    def test_a_share(self):
        self.check(0.4, 1e-11)

    def test_the_largest_volume(self):
        self.check(1, 2e-13)

    def test_force_of_the_given_volume(self):
        words = f"adhesion rabinovich {TENSION} {THETA} volume"
        volume = volume_of(RADII, LIQUID, 0.7, 1e-11)
        shared = list(self.states(f"{words} 1e-11 viscosity 0.01 0.02 share 0.7"))[:501]
        given = list(self.states(f"{words} {volume!r} viscosity 0.01 0.02"))[:501]
        bridged = [(a[1], b[1]) for a, b in zip(shared, given, strict=True) if 0 < a[0] < 0.99 * reach(volume)]
        self.assertGreater(len(bridged), 50)
        for ours, theirs in bridged:
            self.assert_close(ours, theirs, 1e-12)

    def test_dry_ones_have_no_bridge(self):
        dry = list(self.states(f"adhesion rabinovich {TENSION} {THETA} volume 1e-11 share 1 viscosity 0.01 0.02", (0.0, 0.0)))
        self.assertEqual(dry, list(self.states("", (0.0, 0.0))))


SHAKEN = begin("lj", boundary="p p f", law="hertz 2e3 20.0 tangential multistep NULL NULL 0.4 adhesion willett 0.1 20 "
               "fraction 0.01 share {share}", skin=0.3, dt=2e-3) + HAVE + """
variable wet atom "(x > 2)*0.03*radius^2"
set group all d_liquid v_wet
fix step all nve/sphere/symplectic
fix floor all wall/reflect zlo EDGE zhi EDGE
dump state all custom 1 out id x y z radius d_liquid
dump_modify state format float %.17g
run 600
"""


class Shaken(SceneCase):

    LENGTH, HEIGHT, FRACTION = 4.0, 4.0, 0.01

    def grains(self):
        draw = random.Random(7)
        sites = list(itertools.product(range(4), repeat=3))
        draw.shuffle(sites)
        return [Sphere(tuple(s + 0.5 + draw.uniform(-0.02, 0.02) for s in site), tuple(draw.uniform(-2, 2) for _ in range(3)),
                       diameter=draw.uniform(0.6, 0.95)) for site in sites]

    def gap(self, x, radius, i, j):
        (a, b, c), (d, e, f) = x[i], x[j]
        across, along = a - d - self.LENGTH * round((a - d) / self.LENGTH), b - e - self.LENGTH * round((b - e) / self.LENGTH)
        return math.sqrt(across * across + along * along + (c - f)**2) - radius[i] - radius[j]

    def test_against_a_twin(self):
        """Liquid of every grain after every step, from the positions alone."""
        share = 0.8
        write_sphere_data(self.path("data"), ((0, self.LENGTH), (0, self.LENGTH), (0, self.HEIGHT)), self.grains())
        self.run_lammps(SHAKEN.format(share=share))
        frames = read_dump(self.path("out"))
        radius, liquid = frames[0].column("radius"), dict(frames[0].column("d_liquid"))
        pairs, bridges, broken, total = list(itertools.combinations(sorted(radius), 2)), {}, 0, sum(liquid.values())
        for frame in frames:
            flows = dict.fromkeys(liquid, 0.0)
            places = [frame.column(axis) for axis in "xyz"]
            x = {tag: tuple(axis[tag] for axis in places) for tag in liquid}
            for i, j in pairs:
                gap, radii, both = self.gap(x, radius, i, j), (radius[i], radius[j]), (liquid[i], liquid[j])
                if gap < 0:
                    largest = self.FRACTION * 4 / 3 * math.pi * (radii[0]**3 + radii[1]**3)
                    bridges[i, j] = volume_of(radii, both, share, largest)
                elif (i, j) in bridges and gap >= (1 + math.radians(20) / 2) * bridges[i, j]**(1 / 3):
                    volume = bridges.pop((i, j))
                    if volume > 0:
                        one, other = after_rupture(radii, both, share, volume)
                        flows[i] += one - both[0]
                        flows[j] += other - both[1]
                        broken += 1
            has = frame.column("d_liquid")
            for tag in liquid:
                liquid[tag] += flows[tag]
                self.assertAlmostEqual(has[tag], liquid[tag], delta=1e-12 * total)
        wet = [sum(1 for has in frame.column("d_liquid").values() if has > 0) for frame in (frames[0], frames[-1])]
        print(f"\n{broken} bridges broke, {wet[0]} -> {wet[1]} wet grains of {len(liquid)}")
        self.assertGreater(broken, 100)
        self.assertGreater(wet[1], wet[0])
        self.assert_close(math.fsum(frames[-1].column("d_liquid").values()), total, 1e-13)


IMPACT = begin("si", law="hertz 1e6 0.0 adhesion {adhesion}", skin=1e-3, dt=5e-7) + HAVE + f"""
set atom 1 d_liquid {LIQUID[0]!r}
set atom 2 d_liquid {LIQUID[1]!r}
fix step all nve/sphere/symplectic start half
compute s all penalty/stats
compute k all ke
thermo_style custom step c_k c_s[4] c_s[5] c_s[6]
thermo_modify format float %.17g norm no
thermo 40
run 60000
"""


class Energy(SceneCase):

    def test_what_an_impact_loses(self):
        """The work of the force up to rupture, of both models that of the bridge of given volume."""
        volume, lost = volume_of(RADII, LIQUID, 1, 1e-11), {}
        for model in "willett", "rabinovich":
            for words in "1e-11 share 1", f"{volume!r}":
                write_sphere_data(self.path("data"), ((-2e-2, 2e-2),) * 3,
                                  [Sphere((s * (r + 1e-5), 0, 0), (-s * 0.06, 0, 0), density=2500, diameter=2 * r)
                                   for s, r in zip((-1, 1), RADII, strict=True)])
                rows = thermo(self.run_lammps(IMPACT.format(adhesion=f"{model} {TENSION} {THETA} volume {words}")).log)
                totals = [row["c_k"] + row["c_s[4]"] + row["c_s[5]"] + row["c_s[6]"] for row in rows]
                error = max(abs(total - totals[0]) for total in totals) / totals[0]
                print(f"\n{model} volume {words}: dissipated {rows[-1]['c_s[5]']:.6g}, error of the sum {error:.1e}")
                self.assertLess(error, 2e-5)
                self.assertEqual(rows[-1]["c_s[4]"], 0)    # they have come apart
                lost[model, "share" in words] = rows[-1]["c_s[5]"]
            self.assertGreater(lost[model, True], 0.01 * rows[0]["c_k"])
            self.assert_close(lost[model, True], lost[model, False], 1e-9)


class Refused(SceneCase):

    LAW = ELASTIC + " adhesion willett 0.05 20 volume 1e-12 share 1"

    def error(self, middle, law=LAW):
        write_sphere_data(self.path("data"), ((0, 1),) * 3, [Sphere((0.3, 0.5, 0.5), diameter=0.1)])
        return self.run_lammps(begin("si", law=law, skin=1e-3, dt=1e-6) + middle + "run 0\n", expect_error=True).log

    def test_particles_without_liquid(self):
        for middle in ("", "fix liquid all property/atom d_liquid\n", "fix liquid all property/atom i_liquid ghost yes\n",
                       "fix liquid all property/atom d2_liquid 2 ghost yes\n"):
            self.assertIn("bridges with 'share' have the liquid of particles: add 'fix ID all property/atom d_liquid ghost yes'",
                          self.error(middle))

    def test_bodies(self):
        body = "fix floor all large/body plane 0 0 0 0 0 1 contact "
        self.assertIn("Fix large/body floor: a body has no liquid to 'share': leave 'share' out", self.error(HAVE + body + self.LAW + "\n"))

    def test_second_order(self):
        self.assertIn("a bridge that is made and breaks with a jump: use order 1",
                      self.error(HAVE + "fix step all nve/sphere/symplectic order 2\n"))


if __name__ == "__main__":
    unittest.main()
