# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What contact points of shapes remember is kept by both particles, so that nothing has to be sent to ghosts. Where there are
periodic borders the rank of one tells the other: two cubes that rub on each other among many spheres cost next to nothing."""

import unittest

from message_counts import counting, sent
from talus_testing import SceneCase, Sphere, head, thermo, write_sphere_data

EVERY, STEPS = 5, 200
SCRIPT = head(boundary="{boundary}") + """
processors 2 1 1
read_data grains
group balls type 1
neighbor 0.3 bin
neigh_modify every {every} delay 0 check no
pair_style gran/penalty
pair_coeff * * {law}
timestep 1e-4
fix step balls nve/sphere/symplectic
fix shapes all shape/gran type 2 box 1 1 1 density 1
thermo 100
compute stats all penalty/stats
thermo_style custom step c_stats[2]
run {steps}
"""
FRICTION = "hooke 100 1 tangential multistep 20 0.5 0.5"
WITHOUT_HISTORY = "hooke 100 1"
SIDE = 14


class ShapeMessages(SceneCase):

    def setUp(self):
        """Spheres at rest, and two cubes on both sides of the border between two ranks, one sliding over the other."""
        middle = 0.5 * SIDE * 1.01
        spheres = [Sphere(tuple(1.01 * (s + 0.5) for s in (i, j, k)), diameter=1.0)
                   for k in range(SIDE) for j in range(SIDE) for i in range(SIDE)
                   if max(abs(1.01 * (s + 0.5) - middle) for s in (i, j, k)) > 2.2]
        cubes = [Sphere((middle - 0.1, middle, middle - 0.495), type=2, diameter=3**0.5),
                 Sphere((middle + 0.1, middle, middle + 0.495), type=2, diameter=3**0.5, v=(0.1, 0, 0))]
        write_sphere_data(self.path("grains"), ((0, 1.01 * SIDE),) * 3, spheres + cubes)

    def count(self, law, boundary):
        counts = self.path("counts")
        log = self.run_lammps(SCRIPT.format(law=law, boundary=boundary, every=EVERY, steps=STEPS), np=2, env=counting(counts)).log
        self.assertGreater(thermo(log)[-1]["c_stats[2]"], 0)
        return sent(counts, 2)

    def more(self, boundary):
        """Messages and bytes of a rebuild with histories, less those without."""
        with_histories, without = self.count(FRICTION, boundary), self.count(WITHOUT_HISTORY, boundary)
        more = tuple((a - b) / (STEPS // EVERY) for a, b in zip(with_histories, without))
        print(f"messages and bytes more per rebuild with histories, boundary {boundary}: {more}")
        return more

    def test_both_particles_keep_them(self):
        self.assertEqual(self.more("f f f"), (0, 0))

    def test_two_cubes_in_a_periodic_box(self):
        messages, size = self.more("p p p")
        self.assertGreater(size, 0)
        self.assertLess(size, 4000)    # the lists of two cubes, none of spheres
        self.assertLess(messages, 4)


if __name__ == "__main__":
    unittest.main()
