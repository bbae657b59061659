# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""A large sphere at the corner of a periodic box, in contact with a thousand small ones: on any number of ranks the same bits,
and what the ranks tell each other of histories is as much as there are contacts with ghosts, not ghosts or entries of ghosts."""

import math
import random
import unittest

from message_counts import counting, sent
from talus_testing import SceneCase, Sphere, head, read_dump, write_sphere_data

EDGE, LARGE, SMALL = 24.0, 10.0, 0.5    # box, diameters
SHELL, OTHERS = 1200, 1500
DRIFT = 3.0, 2.0, 1.0                   # all move through borders
STEPS, EVERY = 100, 10
FRICTION, WITHOUT_HISTORY = "multistep", "onestep"
SCRIPT = (head(boundary="p p p", map=None) + """
{grid}
read_data grains
pair_style gran/penalty
pair_coeff * * hooke 20.0 0.1 tangential {friction} NULL NULL 0.5
neighbor 0.3 bin
neigh_modify every %d delay 0 check no
timestep 0.001
fix step all nve/sphere/symplectic
{more}
compute touching all contact/atom
thermo 1000
dump all all custom 50 dump id x y z vx vy vz omegax omegay omegaz fx fy fz c_touching
dump_modify all format float %%a sort id
run %d
""") % (EVERY, STEPS)


def grains():
    """The large one turns; those around it fly towards it, spread evenly over its surface; others fill the box."""
    draw = random.Random(4)
    spheres = [Sphere((0.01, 0.02, 0.01), v=DRIFT, omega=(2.0, -1.0, 3.0), diameter=LARGE)]
    distance = 0.5 * (LARGE + SMALL) - 0.01
    for n in range(SHELL):
        z = 1 - (2 * n + 1) / SHELL
        r, angle = math.sqrt(1 - z * z), n * math.pi * (3 - math.sqrt(5))
        normal = r * math.cos(angle), r * math.sin(angle), z
        spheres.append(Sphere(tuple((distance * c + s) % EDGE for c, s in zip(normal, spheres[0].x)),
                              v=tuple(d - c for d, c in zip(DRIFT, normal)), diameter=SMALL))
    while len(spheres) < 1 + SHELL + OTHERS:
        x = tuple(draw.uniform(0, EDGE) for _ in range(3))
        if math.dist([min(c, EDGE - c) for c in x], (0, 0, 0)) > 0.5 * LARGE + 2 * SMALL:
            spheres.append(Sphere(x, v=tuple(d + draw.uniform(-2, 2) for d in DRIFT), diameter=SMALL))
    return spheres


class SharedHistories(SceneCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), ((0, EDGE),) * 3, grains())

    def simulate(self, np, grid="", more="", friction=FRICTION):
        """Frames, and (messages, bytes) that all ranks have sent point to point."""
        counts = self.path("counts")
        self.run_lammps(SCRIPT.format(grid=grid, more=more, friction=friction), np=np, env=counting(counts))
        return read_dump(self.path("dump")), *sent(counts, np)

    def test_same_bits_and_few_bytes(self):
        expected = self.simulate(1)[0]
        touching = [frame.column("c_touching")[1] for frame in expected]
        print("contacts of the large sphere:", touching)
        self.assertGreaterEqual(min(touching), 1000)
        for np, grid, more in ((2, "processors 2 1 1", ""), (4, "processors 1 2 2", ""), (4, "processors 4 1 1", ""),
                               (2, "comm_style tiled", "balance 1.0 rcb"), (4, "", "run_style verlet/proxy overlap yes")):
            with self.subTest(np=np, grid=grid, more=more):
                frames, messages, size = self.simulate(np, grid, more)
                self.assertEqual(len(frames), len(expected))
                for frame, other in zip(frames, expected):
                    self.assert_same_bits(frame, other)
                _, messages_without, size_without = self.simulate(np, grid, more, friction=WITHOUT_HISTORY)
                rebuilds = STEPS // EVERY
                per_rebuild = (size - size_without) / rebuilds, (messages - messages_without) / rebuilds
                print(f"{np} ranks {grid} {more!r}: bytes and messages more per rebuild with histories:", per_rebuild)
                # two names and four numbers for each contact; the large sphere takes its list with it when it migrates
                self.assertLessEqual(per_rebuild[0], 2 * 6 * 8 * max(touching))
                self.assertLessEqual(per_rebuild[1], np * (np - 1))


if __name__ == "__main__":
    unittest.main()
