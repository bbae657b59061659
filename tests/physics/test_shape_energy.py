# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""Energies of convex particles: kinetic with rotation + gravitational + stored + dissipated is what it was, to second
order in the time step; what dissipates is known by hand."""

import random
import unittest

from talus_testing import SceneCase, Sphere, head, thermo, write_sphere_data

SCENE = head() + """
read_data grains
group balls type 3
neighbor 0.2 bin
pair_style gran/penalty
pair_coeff * * {law}
timestep {dt!r}
fix s all shape/gran type 1 box 1 0.7 0.5 density 1 orient random 7 &
    type 2 box 0.8 0.8 0.8 rounded 0.1 density 1 orient random 9
fix b balls {balls}
compute kb balls ke
compute rb balls erotate/sphere
fix g all gravity/talus {gravity} vector 0.2 0.1 -1
fix_modify g energy yes
fix box all large/body box 3 3 15 6 6 30 inside contact {law} {move}
compute p all penalty/stats
{more}
thermo {every}
thermo_style custom step f_s[1] f_s[2] c_kb c_rb f_g c_p[1] c_p[2] c_p[4] c_p[5] c_p[6] f_s[7] f_box
thermo_modify norm no format float %.17g
run {steps}
"""
DAMPED = "hooke 1e4 20 tangential multistep NULL NULL 0.5"


def kinetic(row):
    return row["f_s[1]"] + row["f_s[2]"] + row["c_kb"] + row["c_rb"]


def total(row):
    return kinetic(row) + row["f_g"] + row["c_p[4]"] + row["c_p[5]"] + row["c_p[6]"]


class ShapeEnergy(SceneCase):

    def simulate(self, particles, law, dt, time, gravity=5.0, lines=20, np=1, move="", more="",
                 balls="nve/sphere/symplectic", **options):
        write_sphere_data(self.path("grains"), ((-1, 7), (-1, 7), (-1, 30)), particles, types=3)
        steps = round(time / dt)
        log = self.run_lammps(SCENE.format(law=law, dt=dt, gravity=gravity, every=steps // lines, steps=steps, move=move,
                                           more=more, balls=balls), np=np, **options).log
        return thermo(log)

    BRICK = [Sphere((3, 3, 1.5), v=(.5, .3, 0), omega=(1, 2, .5))]
    BALL = [Sphere((3, 3, 0.7), v=(.5, .3, 0), omega=(1, 2, .5)),
            Sphere((2.6, 3.1, 1.9), v=(0.1, .05, -.5), omega=(1, 0, 3), type=3)]
    CUBE = [Sphere((3, 3, 1.5), v=(.5, .3, 0), omega=(1, 2, .5), type=2)]

    def test_balance(self):
        """Until they rest: what is left at the end."""
        print("\n         largest deviation of the sum at the end, steps of 5e-4, 2.5e-4; order; dissipated")
        for name, grains, more in (("brick", self.BRICK, {}), ("rounded cube", self.CUBE, {}),
                                   ("ball and brick", self.BALL, {}),
                                   ("ball of LAMMPS", self.BALL, {"balls": "nve/sphere"})):
            off = []
            for dt in 5e-4, 2.5e-4:
                rows = self.simulate(grains, DAMPED, dt, 4.0, **more)
                off.append(abs(total(rows[-1]) - total(rows[0])))
                lost = rows[-1]["c_p[5]"] + rows[-1]["c_p[6]"]
            print(f"{name:16}{off[0]:12.2e}{off[1]:12.2e}{off[0] / off[1]:8.2f}{lost:10.3f}")
            self.assertGreater(lost, 1.0)
            if "ball" not in name:    # which rolls on
                self.assertLess(kinetic(rows[-1]), 1e-2)
            self.assertLess(off[1], 1e-2 * lost)
            self.assertGreater(off[0] / off[1], 2.5)

    def test_elastic_impacts(self):
        """Bodies that fly apart have what they had; nothing is dissipated."""
        for dt in 1e-3, 2.5e-4:
            for law, lost in (("hooke 1e4 0", False), (DAMPED, True)):
                rows = self.simulate([Sphere((3, 3, 13.5), v=(.1, 0, 0.6), omega=(1, 2, .5)),
                                      Sphere((3.2, 3.1, 15.2), v=(0, 0, -.6), omega=(-1, .4, 1), type=2)], law, dt, 2.0,
                                     gravity=0.0)
                self.assertGreater(max(row["c_p[2]"] for row in rows), 0.0)
                self.assertEqual(rows[-1]["c_p[2]"], 0.0)
                off = abs(total(rows[-1]) - total(rows[0]))
                print(f"impact {law:52} dt {dt}: {off:.2e}")
                self.assertLess(off, 6e-3 if dt == 1e-3 else 6e-4)
                self.assertEqual(rows[-1]["c_p[5]"] + rows[-1]["c_p[6]"] > 1e-2, lost)

    def test_restitution(self):
        """A rounded cube that falls flat loses (1-e^2) m v^2/2, and the scalar of the floor knows it."""
        rows = self.simulate([Sphere((3, 3, 1.0), v=(0, 0, -1), type=2)], "hooke 1e4 20", 1e-4, 1.0, gravity=0.0, lines=1000,
                             more="fix_modify s orient 1 1 0 0 0\nrun 0")
        rows = rows[1:]
        lost = kinetic(rows[0]) - kinetic(rows[-1])
        self.assertEqual(rows[-1]["c_p[2]"], 0.0)
        self.assertEqual(max(row["c_p[2]"] for row in rows), 4.0)
        self.assertGreater(lost, 0.05)
        self.assert_close(rows[-1]["c_p[5]"], lost, 6e-4)
        self.assert_close(rows[-1]["f_box"], lost, 6e-4)
        self.assertEqual(rows[-1]["c_p[6]"], 0.0)

    def test_slide(self):
        """A cube slides on the floor: what it loses goes into friction."""
        rows = self.simulate([Sphere((2, 3, 0.5 - 1.19e-4), v=(1.0, 0, 0), type=2)],
                             "hooke 1e4 0.2 tangential multistep NULL NULL 0.3", 2e-4, 0.4,
                             more="fix_modify s orient 1 1 0 0 0\nrun 0")[1:]
        lost = kinetic(rows[0]) - kinetic(rows[-1]) + rows[0]["f_g"] - rows[-1]["f_g"]
        print(f"slide: {rows[-1]['c_p[6]']:.5f} of {lost:.5f}")
        self.assertGreater(lost, 0.05)
        self.assert_close(rows[-1]["c_p[6]"] + rows[-1]["c_p[5]"] + rows[-1]["c_p[4]"] - rows[0]["c_p[4]"], lost, 2e-3)
        self.assertGreater(rows[-1]["c_p[6]"], 0.99 * lost)

    def test_moving_box(self):
        """The box shakes: the energy that its own account says is that of all contacts with it."""
        rows = self.simulate(self.BALL, DAMPED, 2.5e-4, 2.0, move="move wiggle 0.1 0 0.05 0.5")
        self.assertGreater(rows[-1]["c_p[5]"], 1.0)
        self.assertGreater(rows[-1]["f_box"], 0.5)

    def test_heap(self):
        """27 bodies, rounded and sharp."""
        draw = random.Random(3)
        grains = [Sphere((1.9 * i + 1.1, 1.9 * j + 1.1, 1.9 * k + 1.2), v=tuple(draw.gauss(0, .5) for _ in "xyz"),
                         omega=tuple(draw.gauss(0, 1) for _ in "xyz"), type=1 + (i + j + k) % 3, diameter=0.9)
                  for k in range(3) for j in range(3) for i in range(3)]
        for np in 1, 2:
            rows = self.simulate(grains, DAMPED, 4e-4, 3.0, np=np)
            lost = rows[-1]["c_p[5]"] + rows[-1]["c_p[6]"]
            off = max(abs(total(row) - total(rows[0])) for row in rows)
            print(f"heap on {np} ranks: {off:.3f} of {lost:.1f}, {rows[-1]['c_p[2]']:.0f} contacts")
            self.assertGreater(lost, 50.0)
            self.assertLess(off, 0.02 * lost)
            if np == 1:
                first = rows
        for key in ("c_p[1]", "c_p[2]", "c_p[4]", "c_p[5]", "c_p[6]", "f_box"):
            self.assert_close(rows[-1][key], first[-1][key], 1e-9)


if __name__ == "__main__":
    unittest.main()
