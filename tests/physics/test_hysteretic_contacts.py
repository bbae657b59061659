# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""Contacts that remember their largest overlap, luding, walton/braun and eepa: restitution and lost energy of impacts; a body that is
pressed, let go and pressed again, of all kinds; a run that goes on in the middle of a contact."""

import math
import unittest

import body_meshes
from talus_testing import SceneCase, Sphere, begin, read_dump, thermo, write_sphere_data

R, DENSITY = 0.5, 10.0
MASS = DENSITY * 4 / 3 * math.pi * R**3
K1, K2, KC, PHI = 1e4, 4e4, 3e3, 0.05
WALTON, LUDING = f"walton/braun {K1} {K2} 0", f"luding {K1} {K2} {KC} {PHI} 0"
EEPA = "eepa 1e6 1 0.3 {gamma} 0.6 0 1.5 2"

IMPACT = begin("si", law="{words}", skin=0.05, dt=1e-5) + """
fix step all nve/sphere/symplectic start half
compute s all penalty/stats
compute k all ke
thermo_style custom step c_k c_s[2] c_s[4] c_s[5]
thermo_modify format float %.17g norm no
thermo 50
run {steps}
"""


class Impacts(SceneCase):

    def impact(self, words, speed, steps=9000):
        spheres = [Sphere((s * (R + 1e-3 * speed), 0, 0), (-s * speed, 0, 0), density=DENSITY, diameter=2 * R) for s in (-1, 1)]
        write_sphere_data(self.path("data"), ((-4, 4),) * 3, spheres)
        rows = thermo(self.run_lammps(IMPACT.format(words=words, steps=steps)).log)
        totals = [row["c_k"] + row["c_s[4]"] + row["c_s[5]"] for row in rows]
        self.assertLess(max(abs(total - totals[0]) for total in totals), 2e-3 * totals[0])
        self.assertEqual(rows[-1]["c_s[2]"], 0, "they have not come apart")
        self.assertEqual(rows[-1]["c_s[4]"], 0)
        self.assert_close(rows[-1]["c_s[5]"], totals[0] - rows[-1]["c_k"], 2e-3)
        return math.sqrt(rows[-1]["c_k"] / rows[0]["c_k"])

    def test_walton_braun(self):
        for speed in 0.1, 1.0:
            found = self.impact(WALTON, speed)
            print(f"\nwalton/braun at {speed}: restitution {found:.5f}, sqrt(k1/k2) {math.sqrt(K1 / K2):.5f}")
            self.assertAlmostEqual(found, math.sqrt(K1 / K2), delta=1e-3)

    def test_luding(self):
        plastic = K2 / (K2 - K1) * PHI * R
        deepest = 0.7 * plastic
        speed = 0.5 * deepest * math.sqrt(K1 / (MASS / 2))
        k = K1 + (K2 - K1) * deepest / plastic
        zero = (1 - K1 / k) * deepest
        back = (0.5 * (K1 * deepest)**2 / k - 0.5 * KC * zero * k * zero / (k + KC)) / (0.5 * K1 * deepest**2)
        found = self.impact(LUDING, speed, 20000)
        print(f"\nluding: restitution {found:.5f}, expected {math.sqrt(back):.5f}")
        self.assertAlmostEqual(found, math.sqrt(back), delta=2e-3)

    def test_eepa(self):
        """The work of unloading, and of the adhesive branch, over that of loading."""
        n, lam, chi, r_eff = 1.5, 0.6, 2, R / 2
        k1 = 4 / 3 * 1e6 / (2 * (1 - 0.3**2)) * r_eff**2
        k2 = k1 / (1 - lam)
        for gamma, speed in (0, 0.3), (0, 2.0), (300, 2.0):
            load = MASS * speed**2
            x = (load * (n + 1) / (k1 * r_eff))**(1 / (n + 1))
            plastic = lam * x**n
            most = min(1.5 * math.pi * gamma * r_eff * math.sqrt(2 * plastic**(1 / n)), k2 * plastic / 2)
            low = (plastic - most / k2)**(1 / n)
            back = k2 * ((x**(n + 1) - low**(n + 1)) / (n + 1) - plastic * (x - low)) - most * low / (chi + 1)
            expected = math.sqrt(back * r_eff / load)
            found = self.impact(EEPA.format(gamma=gamma), speed, 12000)
            print(f"\neepa, gamma {gamma}, at {speed}: restitution {found:.5f}, expected {expected:.5f}")
            self.assertAlmostEqual(found, expected, delta=2e-3)


PRESSED = begin("si", law="{law}", skin=0.05, dt=1e-4) + """
fix drive all move wiggle 0 0 {depth} 0.4
fix w all large/body {shape} contact {law}
dump state all custom 1 {out} id z fz
dump_modify state format float %.17g
run {first}
{middle}
run {second}
"""


class Bodies(SceneCase):

    def forces(self, shape, name, law=LUDING, first=6000, middle="", second=0):
        write_sphere_data(self.path("data"), ((-4, 4),) * 3, [Sphere((0.1, 0.2, R + 0.005), diameter=2 * R)])
        self.run_lammps(PRESSED.format(depth=-0.025, shape=shape, law=law, out=name, first=first, middle=middle, second=second))
        frames = read_dump(self.path(name))
        return [(R - frame.column("z")[1], frame.column("fz")[1]) for frame in frames]

    def test_branches(self):
        """Down to an overlap of .02, up again and down: loading, unloading, adhesive branch, and a new contact."""
        states = self.forces("plane 0 0 0 0 0 1", "plane")
        plastic = 2 * R * PHI * K2 / (K2 - K1)
        down = [(d, f) for d, f in states[:1001] if d > 0]
        for d, f in down:
            self.assertAlmostEqual(f, K1 * d, delta=1e-9)
        deepest = max(d for d, _ in down)
        k = K1 + (K2 - K1) * deepest / plastic
        up = [(d, f) for d, f in states[1001:2500] if d > 0]
        for d, f in up:
            self.assertAlmostEqual(f, max(k * d - (k - K1) * deepest, -KC * d), delta=1e-8)
        self.assertLess(min(f for _, f in up), -0.5 * KC * (1 - K1 / k) * deepest * k / (k + KC))
        again = [(d, f) for d, f in states[4000:5000] if d > 0]    # they have been apart
        self.assertGreater(len(again), 100)
        for d, f in again:
            self.assertAlmostEqual(f, K1 * d, delta=1e-9)

    def test_shapes(self):
        plane = self.forces("plane 0 0 0 0 0 1", "plane")
        body_meshes.write_stl(self.path("plate.stl"), body_meshes.grid(lambda i, j: (1.1 * i - 4, 1.1 * j - 4, 0.0), 7, 7))
        for shape in ("box 0 0 -1 6 6 2 outside", "rectangle 0 0 0 0 0 1 1 0 0 6 6", "mesh plate.stl"):
            for law in LUDING, WALTON, EEPA.format(gamma=100):
                with self.subTest(shape=shape, law=law):
                    expected = plane if law == LUDING else self.forces("plane 0 0 0 0 0 1", "w", law)
                    other = self.forces(shape, "other", law)
                    self.assertLess(max(abs(a[1] - b[1]) for a, b in zip(expected, other, strict=True)), 1e-6)

    def test_run_in_two_parts(self):
        """The largest overlap is kept where a run ends, also over a rebuild."""
        once = self.forces("plane 0 0 0 0 0 1", "once")
        twice = self.forces("plane 0 0 0 0 0 1", "twice", first=1300, second=4700)
        self.assertEqual(once, twice)


if __name__ == "__main__":
    unittest.main()
