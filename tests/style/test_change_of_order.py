# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=25 label=smoke stay
"""A run goes on with the other order of the integrator: what contacts remember goes with it."""

import unittest

from talus_testing import SceneCase, Sphere, head, max_difference, read_dump, write_sphere_data

SCENE = """
pair_style gran/penalty
pair_coeff * * {law}
group free type 1
{step}
fix floor all large/body plane 0 0 0  0 0 1 contact {law}
neighbor 0.1 bin
timestep {dt!r}
thermo 1000
"""
START = head()
OUT = "id x y z vx vy vz omegax omegay omegaz fx fy fz"
MOTION = "x y z vx vy vz omegax omegay omegaz".split()
OTHER = {"order 1 start half": "order 2", "order 2": "order 1 start half"}
SLIDES = "multistep NULL NULL 0.5 slider midpoint"


class ChangeOfOrder(SceneCase):

    def end(self, law, spheres, orders, gravity="10 vector 0.1 0 -1", steps=6000, then=300, dt=1e-4, restart=False, np=1):
        """The last frame, and that of the set-up of the second run."""
        write_sphere_data(self.path("data"), ((-5, 5), (-5, 5), (-5, 5)), spheres)

        def step(order):
            return f"fix step free nve/sphere/symplectic {order} gravity {gravity}"

        first = SCENE.format(law=law, step=step(orders[0]), dt=dt)
        last = f"dump all all custom {then} frames {OUT}\ndump_modify all sort id format float %.17g\nrun {then}\n"
        if restart:
            self.run_lammps(f"{START}read_data data\n{first}run {steps}\nwrite_restart state\n", np=np)
            self.run_lammps(f"{START}read_restart state\n{SCENE.format(law=law, step=step(orders[1]), dt=dt)}{last}", np=3 - np)
        else:
            self.run_lammps(f"{START}read_data data\n{first}run {steps}\nunfix step\n{step(orders[1])}\n{last}", np=np)
        frames = read_dump(self.path("frames"))
        return frames[-1], frames[0]

    def check(self, law, spheres, moved=1e-5, **options):
        """Where nothing moves fast the order does not matter."""
        for before, after in OTHER.items():
            expected, force = self.end(law, spheres, (before, before), **options)
            for restart in False, True:
                for np in 1, 2:
                    with self.subTest(law=law, before=before, restart=restart, ranks=np):
                        found, start = self.end(law, spheres, (before, after), restart=restart, np=np, **options)
                        self.assertLess(max_difference(found, expected, ["x", "y", "z"]), moved)
                        self.assertLess(max_difference(force, start, ["fx", "fy", "fz"]), 2e-2)
        return expected

    valley = [Sphere((-0.6, 0, 1.0), type=2), Sphere((0.6, 0, 1.0), type=2), Sphere((0.0, 0, 1.79))]

    def test_springs_of_friction_and_rolling_hold_on(self):
        law = f"hertz 2.0e4 50 tangential {SLIDES} rolling sds 2e3 5 0.3 limit_damping"
        frame = self.check(law, [Sphere((0, 0, 0.5)), *(Sphere((s.x[0], 3, s.x[2]), type=s.type) for s in self.valley)])
        self.assertLess(abs(frame.column("vx")[1]), 2e-3)
        self.assertLess(abs(frame.column("x")[1]), 0.1)

    def test_springs_beside_an_impact_that_is_kept(self):
        for tangential in "mindlin 1e4 0 0.5", SLIDES, "mindlin/force 1e4 0 0.5", "mindlin_rescale 1e4 0 0.5":
            self.check(f"hooke/material 1e5 0.5 0.3 1 tangential {tangential} limit_damping", self.valley)

    def test_contacts_that_pull_hold_on(self):
        """Under 95 percent of the pull-off force particles are apart."""
        gamma = 10 * 0.5235987755982988 / (0.95 * 3 * 3.141592653589793 * 0.25)
        pair = [Sphere((0, 0, 3.0), type=2), Sphere((0, 0, 2.0005))]
        for words in "", " tangential mindlin NULL 0 0.5", " rolling sds 2e3 5 0.3":
            frame = self.check(f"jkr 1e4 2000 0.3 {gamma!r}{words}", pair, gravity="10 vector 0 0 -1", steps=10000)
            self.assertLess(frame.column("z")[2], 2.0 - 1e-5)
            self.assertGreater(frame.column("z")[2], 1.98)

    def test_a_contact_goes_on_sliding(self):
        ball = [Sphere((0, 0, 0.5), (2.0, 0, 0))]
        for before, after in OTHER.items():
            for restart in False, True:
                with self.subTest(before=before, restart=restart):
                    end, start = self.end(f"hertz 2.0e4 500 tangential {SLIDES} limit_damping", ball, (before, after),
                                          gravity="10 vector 0 0 -1", steps=500, then=1, restart=restart)
                    for frame in start, end:
                        self.assertAlmostEqual(frame.column("fx")[1] / frame.column("fz")[1], -0.5, delta=1e-3)
                        self.assertGreater(frame.column("fz")[1], 1.0)


if __name__ == "__main__":
    unittest.main()
