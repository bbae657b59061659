# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=240
"""Liquid bridges: a measured pair of spheres that is drawn apart, and meets again without a bridge; large bodies of all kinds; what an
impact loses, against the work of the force by quadrature."""

import math
import unittest

import body_meshes
from doc_tables import commands, page, rows
from talus_testing import SceneCase, Sphere, begin, read_dump, thermo, write_sphere_data

# Willett et al. 2000
R, TENSION, VOLUME = 2.381e-3, 0.0206, 7.42e-11
ETA, LEAST = 0.01, 0.02
ELASTIC = "hertz 1e6 0.0"
WILLETT = f"willett {TENSION} 0 volume {VOLUME}"
REACH = VOLUME**(1 / 3)


def willett(gap, radius, tension=TENSION, volume=VOLUME):
    s = gap * math.sqrt(radius / volume)
    return 2 * math.pi * radius * tension / (1 + 1.05 * s + 2.5 * s * s)


def rabinovich(gap, radius, theta, tension=TENSION, volume=VOLUME):
    gap = max(gap, 1e-12)
    d = gap / 2 * (-1 + math.sqrt(1 + 2 * volume / (math.pi * radius * gap * gap)))
    alpha = math.sqrt(2 * d / radius)
    return 2 * math.pi * radius * tension * (math.cos(theta) / (1 + gap / (2 * d)) + math.sin(alpha) * math.sin(theta + alpha))


def viscous(gap, r_eff, speed):
    return 6 * math.pi * ETA * r_eff * speed / max(LEAST, gap / r_eff)


def integral(force, end, parts=4000):
    """From 0, by Simpson's rule over the square root, where all these forces are smooth."""
    def slope(root):
        return 2 * root * force(root * root)
    h = math.sqrt(end) / parts
    inner = sum((4 if n % 2 else 2) * slope(n * h) for n in range(1, parts))
    return (slope(0) + slope(math.sqrt(end)) + inner) * h / 3


APART = begin("si", law=ELASTIC + " adhesion {adhesion}", skin=1e-3, dt="{dt}") + """
group one id 1
group other id 2
fix hold one move linear 0 0 0
fix drive other move linear 0 0 {speed}
dump state all custom 10 {out} id z fz
dump_modify state format float %.17g
run {steps}
unfix drive
fix drive other move linear 0 0 -{speed}
run {steps}
"""
SPEED = 0.1


class Pair(SceneCase):

    def gaps_and_pulls(self, adhesion, steps=5000, way=5e-4, **options):
        write_sphere_data(self.path("data"), ((-1e-2, 1e-2),) * 3, [Sphere((0, 0, 0), diameter=2 * R),
                                                                    Sphere((0, 0, 2 * R - 1e-6), diameter=2 * R)])
        self.run_lammps(APART.format(adhesion=adhesion, speed=SPEED, dt=way / SPEED / steps, steps=steps, out="apart"), **options)
        frames = read_dump(self.path("apart"))
        for frame in frames:
            z, f = frame.column("z"), frame.column("fz")
            self.assertEqual(f[1], -f[2])
            yield z[2] - z[1] - 2 * R, f[1]


class DrawnApart(Pair):

    def check(self, adhesion, expected, reach=REACH):
        states = list(self.gaps_and_pulls(adhesion))
        out, back = states[:501], states[501:]
        bridged = [(gap, pull) for gap, pull in out if 0 < gap < reach]
        self.assertGreater(len(bridged), 400)
        worst = max(abs(pull / expected(gap) - 1) for gap, pull in bridged)
        print(f"\n{adhesion}: {len(bridged)} forces, largest error {worst:.1e}; at contact {bridged[0][1]:.4g} N, "
              f"rupture at {1e3 * bridged[-1][0]:.3f} mm")
        self.assertLess(worst, 1e-9)
        self.assertTrue(all(pull == 0 for gap, pull in out if gap > reach))
        self.assertGreater(max(gap for gap, _ in out), reach)
        # nothing before they touch again
        self.assertTrue(all(pull == 0 for gap, pull in back if gap > 0))
        self.assertTrue(any(pull != 0 for gap, pull in back if gap < 0))

    def test_measured_pair(self):
        self.check(WILLETT, lambda gap: willett(gap, R))
        self.assertAlmostEqual(willett(0, R), 3.08e-4, delta=0.005e-4)
        self.assertAlmostEqual(REACH, 0.42e-3, delta=0.001e-3)

    def test_viscous(self):
        self.check(f"{WILLETT} viscosity {ETA} {LEAST}", lambda gap: willett(gap, R) + viscous(gap, R / 2, SPEED))

    def test_rabinovich(self):
        theta = math.radians(20)
        self.check(f"rabinovich {TENSION} 20 volume {VOLUME}", lambda gap: rabinovich(gap, R, theta), (1 + theta / 2) * REACH)

    def test_fraction_of_volume(self):
        fraction = VOLUME / (2 * 4 / 3 * math.pi * R**3)
        self.check(f"willett {TENSION} 0 fraction {fraction!r}", lambda gap: willett(gap, R))

    def test_threads_and_ranks(self):
        wet = f"{WILLETT} viscosity {ETA} {LEAST}"
        one = list(self.gaps_and_pulls(wet, 500))
        self.assertEqual(one, list(self.gaps_and_pulls(wet, 500, np=2)))
        self.assertEqual(one, list(self.gaps_and_pulls(wet, 500, env={"OMP_NUM_THREADS": 3})))


WALL = begin("si", law=ELASTIC, skin=1e-3, dt=1e-6) + """
fix drive all move linear 0 0 {speed}
fix w all large/body {shape} contact {law}
dump state all custom 10 {out} id z fz
dump_modify state format float %.17g
run 5000
unfix drive
fix drive all move linear 0 0 -{speed}
run 4000
"""


class Bodies(SceneCase):
    """A bridge to a body is that of a flat one: R of Derjaguin is twice the radius."""

    def states(self, shape, adhesion, name="wall"):
        write_sphere_data(self.path("data"), ((-1e-2, 1e-2),) * 3, [Sphere((1e-4, 2e-4, R - 1e-6), diameter=2 * R)])
        self.run_lammps(WALL.format(shape=shape, law=f"{ELASTIC} adhesion {adhesion}", speed=SPEED, out=name))
        return [(frame.column("z")[1] - R, frame.column("fz")[1]) for frame in read_dump(self.path(name))]

    def test_plane(self):
        states = self.states("plane 0 0 0 0 0 1", f"{WILLETT} viscosity {ETA} {LEAST}")
        bridged = [(gap, force) for gap, force in states[:501] if 0 < gap < REACH]
        self.assertGreater(len(bridged), 400)
        for gap, force in bridged:
            expected = willett(gap, 2 * R) + viscous(gap, R, SPEED)
            self.assertAlmostEqual(-force, expected, delta=1e-9 * expected)
        self.assertTrue(all(force == 0 for gap, force in states[:501] if gap > REACH))
        self.assertTrue(all(force == 0 for gap, force in states[501:] if gap > 0))

    def test_shapes(self):
        adhesion = f"rabinovich {TENSION} 30 fraction 0.001 viscosity {ETA} {LEAST}"
        plane = self.states("plane 0 0 0 0 0 1", adhesion)
        self.assertLess(min(force for _, force in plane), 0)
        body_meshes.write_stl(self.path("plate.stl"), body_meshes.grid(lambda i, j: (5e-3 * i - 2e-2, 5e-3 * j - 2e-2, 0.0), 7, 7))
        for shape in ("box 0 0 -1e-2 4e-2 4e-2 2e-2 outside", "rectangle 0 0 0 0 0 1 1 0 0 4e-2 4e-2", "mesh plate.stl"):
            with self.subTest(shape):
                other = self.states(shape, adhesion, "other")
                scale = max(abs(force) for _, force in plane)
                self.assertLess(max(abs(a[1] - b[1]) for a, b in zip(plane, other, strict=True)), 1e-9 * scale)


IMPACT = begin("si", law="{words}", skin=1e-3, dt="{dt}") + """
fix step all nve/sphere/symplectic start half
{wall}
compute s all penalty/stats
compute k all ke
compute r all erotate/sphere
thermo_style custom step c_k c_r c_s[2] c_s[4] c_s[5] c_s[6]
thermo_modify format float %.17g norm no
thermo 20
run {steps}
"""


class Energy(SceneCase):
    """Kinetic, stored and dissipated energy keep their sum; what an impact loses is the work up to rupture."""

    def impact(self, spheres, words, wall="", dt=1e-6, steps=40000):
        write_sphere_data(self.path("data"), ((-2e-2, 2e-2),) * 3, spheres)
        return thermo(self.run_lammps(IMPACT.format(words=words, wall=wall, dt=dt, steps=steps)).log)

    def check(self, rows, expected=None):
        kinetic = [row["c_k"] + row["c_r"] for row in rows]
        totals = [k + row["c_s[4]"] + row["c_s[5]"] + row["c_s[6]"] for k, row in zip(kinetic, rows, strict=True)]
        error = max(abs(total - totals[0]) for total in totals) / totals[0]
        touching = [row for row in rows if row["c_s[2]"] > 0]
        found = rows[-1]["c_s[5]"]
        print(f"\nkinetic energy {kinetic[0]:.5g} -> {kinetic[-1]:.5g}, dissipated {found:.6g}, expected {expected}; error of the sum {error:.1e}")
        self.assertGreater(len(touching), 20)
        self.assertEqual(rows[-1]["c_s[2]"], 0, "they have not come apart")
        self.assertEqual(rows[-1]["c_s[4]"], 0)
        self.assertLess(error, 2e-5)
        if expected is None:
            self.assertGreater(min(found, rows[-1]["c_s[6]"]), 0.05 * (kinetic[0] - kinetic[-1]))
            return
        self.assert_close(found, expected, 2e-3)
        self.assertLess(max(abs(row["c_s[5]"]) for row in touching), 5e-3 * expected)

    def pair(self, speed, side=0.0):
        return [Sphere((s * (R + 1e-5), 0, 0), (-s * speed, s * side, 0), density=2500, diameter=2 * R) for s in (-1, 1)]

    def test_willett(self):
        work = integral(lambda gap: willett(gap, R), REACH)
        mass = 2500 * 4 / 3 * math.pi * R**3
        speed = math.sqrt(2 * work / mass)    # twice the energy
        self.check(self.impact(self.pair(speed), f"{ELASTIC} adhesion {WILLETT}"), work)

    def test_rabinovich_at_a_plane(self):
        theta = math.radians(40)
        work = integral(lambda gap: rabinovich(gap, 2 * R, theta), (1 + theta / 2) * REACH)
        law = f"{ELASTIC} adhesion rabinovich {TENSION} 40 volume {VOLUME}"
        speed = math.sqrt(4 * work / (2500 * 4 / 3 * math.pi * R**3))
        one = [Sphere((0, 0, R + 1e-5), (0, 0, -speed), density=2500, diameter=2 * R)]
        self.check(self.impact(one, ELASTIC, f"fix floor all large/body plane 0 0 0 0 0 1 contact {law}"), work)

    def test_viscous_and_oblique(self):
        law = "hertz 1e6 1e4 tangential multistep NULL NULL 0.5 slider midpoint adhesion " + f"{WILLETT} viscosity {ETA} {LEAST}"
        self.check(self.impact(self.pair(0.15, 0.1), law, dt=2e-7, steps=60000))


class LinesOfOtherPrograms(Pair):
    """What the table of the page gives, against the equations of those programs as the page tells them; two spheres of radius R, whose
    effective radius is R/2, wetted completely where LIGGGHTS is right."""

    VOLUMES = 2 * 4 / 3 * math.pi * R**3

    def drawn(self, program, theta=0):
        """(gap, pull) from contact to rupture, and the reach."""
        (ours,), = [commands(cell) for name, _, cell in rows(page("contact_laws_wet.md"), "program") if name.startswith(program)]
        words = ours.replace("theta", str(theta)).split()
        self.assertEqual(words[0], "adhesion")
        out = list(self.gaps_and_pulls(" ".join(words[1:]), way=6e-4))[:501]
        bridged = [(gap, pull) for gap, pull in out if gap > 0 and pull > 0]
        return bridged, bridged[-1][0]

    def is_reach(self, found, expected):
        """Written every tenth step: two of these are 2.4 um."""
        self.assertAlmostEqual(found, expected, delta=2.4e-6)

    def test_mercury(self):
        gamma, theta, volume = 0.02, math.radians(20), 75e-12
        bridged, reach = self.drawn("MercuryDPM")
        self.is_reach(reach, (1 + theta / 2) * volume**(1 / 3))
        pairs = [(pull / 2, willett(gap, R / 2, gamma * math.cos(theta), volume)) for gap, pull in bridged]
        self.assertAlmostEqual(pairs[0][0] / pairs[0][1], 1, delta=5e-3)    # at contact
        self.assertTrue(all(half <= theirs for half, theirs in pairs))

    def test_washino(self):
        volume = 0.05 * 0.02 * self.VOLUMES
        bridged, reach = self.drawn("LIGGGHTS, cohesion washino")
        self.is_reach(reach, volume**(1 / 3))
        for gap, pull in bridged:
            lubrication = 6 * math.pi * 1e-3 * (R / 2) * SPEED / max(0.01, gap / (R / 2))
            self.assertAlmostEqual(pull / (rabinovich(gap, R, 0.0, 0.07, volume) + lubrication), 1, delta=1e-8)

    def test_easo(self):
        volume = 0.067 * 0.02 * self.VOLUMES
        bridged, reach = self.drawn("LIGGGHTS, cohesion easo")
        self.is_reach(reach, volume**(1 / 3))
        size = math.log(volume / R**3)
        a, b, c = -1.1 * (volume / R**3)**-0.53, -0.0082 * size + 0.48, 0.0018 * size + 0.078
        for gap, pull in bridged[:len(bridged) // 2]:
            lubrication = 6 * math.pi * 1e-3 * (R / 2) * SPEED / max(0.01, gap / (R / 2))
            soulie = math.pi * 0.07 * R * (c + math.exp(a * gap / R + b))
            self.assertAlmostEqual((pull - lubrication) / soulie, 1, delta=0.25)


if __name__ == "__main__":
    unittest.main()
