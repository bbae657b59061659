# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""rolling cdt and epsd2: torques of single contacts against their formulas, and what they do to a sphere that rolls."""

import math
import unittest

from talus_testing import SceneCase, Sphere, begin, read_dump, write_sphere_data

BEGIN = begin("si", read="read_data grains", law="{law}", skin=0.1, dt="{dt}") + """
"""
DUMP = "write_dump all custom state id x vx omegax omegay omegaz tqx tqy tqz modify sort id format float %.17g\n"
KN, MU = 1000.0, 0.3
LAW = f"hooke {KN} 0 tangential dashpot 0 0"
BOX = ((-5, 5), (-5, 5), (-5, 5))
G = 10.0
MASS = math.pi / 6 * 2000    # of a sphere of diameter 1


def across(w, n):
    along = sum(a * b for a, b in zip(w, n))
    return [a - along * b for a, b in zip(w, n)]


class RollingOfLiggghts(SceneCase):

    def torques(self, rolling, spheres, more="", dt=1e-5):
        write_sphere_data(self.path("grains"), BOX, spheres)
        self.run_lammps(BEGIN.format(law=f"{LAW} rolling {rolling}", dt=dt) + more + "fix step all nve/noforce\nrun 1\n" + DUMP)
        frame, = read_dump(self.path("state"))
        return {tag: [frame.column(f"tq{a}")[tag] for a in "xyz"] for tag in frame.column("tqx")}

    def assert_torque(self, found, expected):
        scale = max(map(abs, expected)) or 1.0
        for a, b in zip(found, expected):
            self.assertAlmostEqual(a, b, delta=1e-12 * scale)

    def test_two_spheres(self):
        """Between unlike spheres, and in the three cases that tell laws apart."""
        for radii in (0.5, 0.5), (0.5, 0.2):
            for one, other in (((0, 100, 0), (0, -100, 0)), ((0, 100, 0), (0, 100, 0)), ((0, 100, 0), (0, 0, 0)),
                               ((3, 100, -7), (50, 20, 1))):
                with self.subTest(radii=radii, omega=(one, other)):
                    overlap = 0.01
                    apart = sum(radii) - overlap
                    found = self.torques(f"cdt {MU}", [
                        Sphere((0, 0, 0), diameter=2 * radii[0], density=2000.0, omega=one),
                        Sphere((apart, 0, 0), diameter=2 * radii[1], density=2000.0, omega=other)])
                    w = [a - b for a, b in zip(one, other)]
                    size = math.hypot(*w)
                    effective = radii[0] * radii[1] / sum(radii)
                    unit = across([a / size for a in w], (1, 0, 0)) if size else [0, 0, 0]
                    torque = [-MU * KN * overlap * effective * a for a in unit]
                    self.assert_torque(found[1], torque)
                    self.assert_torque(found[2], [-a for a in torque])

    def test_at_a_wall(self):
        floor = f"fix floor all large/body plane 0 0 0 0 0 1 contact {LAW} rolling cdt {MU}\n"
        found = self.torques(f"cdt {MU}", [Sphere((0, 0, 0.49), diameter=1.0, density=2000.0, omega=(0, 5, 0))], floor)
        self.assert_torque(found[1], [0, -MU * KN * 0.01 * 0.5, 0])

    def roll(self, rolling, steps, dt=1e-4, speed=1.0, slope=0.0):
        """The state of a sphere that rolls on a floor in the direction x."""
        overlap = MASS * G / 1e6
        write_sphere_data(self.path("grains"), BOX, [Sphere((-4, 0, 0.5 - overlap), diameter=1.0, density=2000.0,
                                                            v=(speed, 0, 0), omega=(0, 2 * speed, 0))])
        law = f"hooke 1e6 500 tangential multistep 3e5 30 0.8 rolling {rolling}"
        self.run_lammps(BEGIN.format(law=law, dt=dt) + f"fix floor all large/body plane 0 0 0 0 0 1 contact {law}\n"
                        f"fix step all nve/sphere/symplectic gravity {G} vector {math.sin(slope)} 0 {-math.cos(slope)}\n"
                        f"run {steps}\n" + DUMP)
        frame, = read_dump(self.path("state"))
        return {name: frame.column(name)[1] for name in ("x", "vx", "omegay")}

    def test_a_sphere_slows_down(self):
        """By 5/7 mu_r g, as long as it rolls."""
        for rolling in "cdt 0.05", "cdt 0.05 capped":
            with self.subTest(rolling=rolling):
                end = self.roll(rolling, 10000)
                self.assert_close(end["vx"], 1.0 - 5 / 7 * 0.05 * G * 1.0, 1e-3)
                self.assert_close(end["omegay"], 2 * end["vx"], 1e-3)

    def test_capped_comes_to_rest(self):
        end = self.roll("cdt 0.05 capped", 60000)
        self.assertLess(abs(end["vx"]), 1e-9)
        self.assertLess(abs(end["omegay"]), 1e-9)
        self.assert_close(end["x"], -4 + 0.5 / (5 / 7 * 0.05 * G), 2e-3)
        self.assertGreater(abs(self.roll("cdt 0.05", 60000)["omegay"]), 1e-9)

    def test_epsd2_holds_on_a_slope(self):
        held = self.roll("epsd2 0.2", 40000, speed=0.0, slope=math.atan(0.15))
        self.assertLess(abs(held["vx"]), 1e-3)
        self.assertLess(abs(held["x"] + 4), 0.05)
        gone = self.roll("epsd2 0.2", 5000, speed=0.0, slope=math.atan(0.4))
        self.assertGreater(gone["vx"], 0.3)

    def test_epsd2_spring(self):
        """The first torque of a contact that turns: kt R^2 times the angle, up to mu_r R F_n."""
        kt, dt, omega = 300.0, 1e-5, 2.0
        for mu in 10.0, 1e-6:
            with self.subTest(mu=mu):
                law = f"hooke {KN} 0 tangential onestep {kt} 0 0 rolling epsd2 {mu}"
                write_sphere_data(self.path("grains"), BOX, [
                    Sphere((0, 0, 0), diameter=1.0, density=2000.0, omega=(0, omega, 0)),
                    Sphere((0.99, 0, 0), diameter=1.0, density=2000.0, omega=(0, -omega, 0))])
                self.run_lammps(BEGIN.format(law=law, dt=dt) + "fix step all nve/noforce\nrun 50\n" + DUMP)
                frame, = read_dump(self.path("state"))
                angle, effective = 50 * dt * 2 * omega, 0.25
                expected = min(kt * effective**2 * angle, mu * KN * 0.01 * effective)
                self.assert_close(frame.column("tqy")[1], -expected, 1e-6)
                self.assert_close(frame.column("tqy")[2], expected, 1e-6)

    def test_errors(self):
        write_sphere_data(self.path("grains"), BOX, [Sphere((0, 0, 0), diameter=1.0, density=2000.0)])
        for words, message in (("cdt", "missing"), ("cdt -1", "mu_cdt"), ("epsd2 x", "mu_epsd2")):
            log = self.run_lammps(BEGIN.format(law=f"{LAW} rolling {words}", dt=1e-5), expect_error=True).log
            self.assertIn(message, log)
        law = "hertz/material 1e7 0.5 0.3 damping tsuji tangential mindlin NULL 1.0 0.5 rolling epsd2 0.1"
        log = self.run_lammps(BEGIN.format(law=law, dt=1e-5), expect_error=True).log
        self.assertIn("epsd2 takes the stiffness of the tangential law", log)


if __name__ == "__main__":
    unittest.main()
