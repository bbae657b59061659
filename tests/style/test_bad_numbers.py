# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Positions, velocities and radii that cannot be: one message that names the particle, on any number of ranks."""

import unittest

from talus_testing import SceneCase, Sphere, begin, write_sphere_data

SCENE = begin("si", boundary="{boundary}", law="{law}", skin=0.1) + """
fix step all {step}
timestep 1e-4
thermo 20
{more}
"""
LAW = "hooke 1000.0 1.0 tangential multistep NULL NULL 0.5"
NOT_A_NUMBER = "particle {} is not a number, or much too large, at step {}: use a smaller time step"


class Refused(SceneCase):

    def refused(self, more, np=1, law=LAW, boundary="f f f", step="nve/sphere/symplectic", **options):
        write_sphere_data(self.path("data"), ((-4, 4),) * 3,
                          [Sphere((0.99 * n - 3, 0, 0), id=n + 1, diameter=1.0) for n in range(7)])
        return self.run_lammps(SCENE.format(more=more, law=law, boundary=boundary, step=step), np=np, expect_error=True,
                               **options).log

    def test_what_a_command_sets(self):
        for np in 1, 2:
            log = self.refused("set atom 5 omega 0 0 1e160\nrun 100", np)
            self.assertIn("the angular velocity of " + NOT_A_NUMBER.format(5, 0), log)
            log = self.refused("variable big atom 1e200*(id==3)\nset group all vx v_big\nrun 100", np)
            self.assertIn("the velocity of " + NOT_A_NUMBER.format(3, 0), log)

    def test_what_happens_in_a_run(self):
        """Found at the next output, in the records and in the arrays, with the run style of LAMMPS as well."""
        push = "variable f atom 1e200*(id==6)*(step>4)\nfix push all addforce v_f 0 0\nrun 100"
        for np in 1, 2:
            for more in push, "run_style verlet/stock\n" + push:
                self.assertRegex(self.refused(more, np), "of particle 6 is not a number, or much too large, at step (\d|1\d|20):")
        stiff = self.refused("thermo 30\nrun 100", 2, law="hooke 1e200 1.0 tangential multistep NULL NULL 0.5")
        self.assertRegex(stiff, r"of particle \d is not a number, or much too large, at step (\d|1\d|2\d|30):")

    def test_radii_beyond_the_box(self):
        for np in 1, 2:
            for boundary in "f f f", "p p p":
                log = self.refused("set atom 2 diameter 2e12\nrun 10", np, boundary=boundary)
                self.assertIn("Pair style gran/penalty: the largest particle has a radius of 1e+12, 1.25e+11 times the longest "
                              "side of the box: look for what has set it", log)

    def test_own_image(self):
        for np in 1, 2:
            for law in LAW, "hooke 1000.0 1.0":
                log = self.refused("set atom 2 diameter 8.1\nrun 10", np, law=law, boundary="f p f")
                self.assertIn("the box is periodic in y with a period of 8, and the largest particle has a diameter of 8.1: it "
                              "touches its own image: make the box at least 16.2 wide, or use 'boundary f'", log)

    def test_frozen_particles_may_touch_their_image(self):
        write_sphere_data(self.path("data"), ((-4, 4),) * 3, [Sphere((0, 0, -3), id=1), Sphere((0, 0, 3.5), id=2, diameter=0.5)])
        self.run_lammps(SCENE.format(law="hooke 1000.0 1.0", boundary="f p f", step="nve/sphere/symplectic",
                                     more="set atom 1 diameter 8.1\ngroup still id 1\nfix hold still freeze\nrun 5"))


if __name__ == "__main__":
    unittest.main()
