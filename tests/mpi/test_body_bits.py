# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""One trajectory with large bodies that move, are free, and are held at a force: the same bits of particles and
bodies on any ranks, threads and grid, for other skins, and across a restart."""

import os
import random
import unittest

import body_meshes
from talus_testing import SceneCase, Sphere, head, read_dump, write_sphere_data

STEPS, HALF = 600, 300
LAW = "hertz 4000.0 40.0 tangential multistep NULL NULL 0.5"

START = head() + """
processors {grid}
{read}
neighbor {skin} bin
pair_style gran/penalty
pair_coeff * * {law}
timestep 0.001
fix step all nve/sphere/symplectic gravity 4.0 vector 0.1 0.05 -1.0
"""
BODIES = f"""
fix vessel all large/body mesh vessel.stl contact {LAW} move wiggle 0.3 0.1 0 1.7
fix blade all large/body box 4 4 2.2 6 0.8 1.2 outside contact {LAW} move rotate 4 4 2 0 0 1 2.5
fix ball all large/body mesh ball.stl contact {LAW} move free mass 3 inertia 1.2 1.3 1.6 &
    velocity 0.3 0 -1 spin 1 2 3 gravity 4.0 vector 0 0 -1
fix lid all large/body rectangle 4 4 7.9 0 0 -1 1 0 0 8 8 contact {LAW} servo force 0 0 -1 40 4.0
fix post all large/body cylinder 1.5 1.5 2 0 0 1 0.6 9 outside contact {LAW} move linear 0.1 0.15 NULL
"""
OUTPUT = """
variable step equal step
fix log all print 50 "${step} $(f_ball[1]:%.17g) $(f_ball[6]:%.17g) $(f_ball[7]:%.17g) $(f_ball[9]:%.17g) &
$(f_ball[11]:%.17g) $(f_ball[17]:%.17g) $(f_ball[20]) $(f_lid[3]:%.17g) $(f_lid[9]:%.17g) $(f_lid[16]:%.17g) &
$(f_blade[6]:%.17g) $(f_vessel[3]:%.17g)" append bodies screen no
thermo 300
dump atoms all custom 300 atoms.* id x y z vx vy vz omegax omegay omegaz proc
dump_modify atoms format float %a
"""


def grains():
    draw = random.Random(2)
    sites = [(i, j, k) for k in range(7) for j in range(7) for i in range(7)]
    draw.shuffle(sites)
    return [Sphere(tuple(1.05 * s + 0.85 + draw.uniform(-0.05, 0.05) for s in site),
                   v=tuple(draw.gauss(0, 0.5) for _ in "xyz"), diameter=draw.uniform(0.6, 1.0))
            for site in sites if not (site[2] in (1, 2) and 3 <= site[1] <= 3)
            and not (site[0] <= 1 and site[1] <= 1) and max(abs(site[0] - 5), abs(site[1] - 5),
                                                             abs(site[2] - 5)) > 1]


class BodyBits(SceneCase):

    def run_scene(self, name, np=1, threads=1, grid="* * *", skin=0.15, script=None):
        folder = self.path(name)
        os.mkdir(folder)
        write_sphere_data(os.path.join(folder, "start"), ((-1, 9), (-1, 9), (-1, 12)), grains())
        body_meshes.write_stl(os.path.join(folder, "vessel.stl"),
                              body_meshes.box((0, 0, 0), (8, 8, 11), 12, inward=True))
        body_meshes.write_stl(os.path.join(folder, "ball.stl"),
                              body_meshes.sphere((6.0, 6.0, 6.0), 1.1, 8))
        text = script or START.format(grid=grid, skin=skin, law=LAW, read="read_data start") + \
            BODIES + OUTPUT + f"run {STEPS}\n"
        arguments = ("-pk", "omp", threads) if threads > 1 else ()
        env = {"OMP_NUM_THREADS": str(threads), "OMP_WAIT_POLICY": "passive"} if threads > 1 else None
        return self.run_lammps(text, np=np, cwd=folder, arguments=arguments, env=env).log

    def results(self, name):
        with open(os.path.join(self.path(name), "bodies")) as file:
            bodies = [line for line in file if not line.startswith("#")]
        frames = []
        for step in (0, HALF, STEPS):
            frame, = read_dump(os.path.join(self.path(name), f"atoms.{step}"))
            frames.append({t: tuple((v + 0.0).hex() for v in row[:-1])
                           for t, row in frame.atoms.items()})
        return bodies, frames

    def test_same_bits(self):
        log = self.run_scene("one")
        bodies, frames = self.results("one")
        last = bodies[-1].split()
        print(f"{len(frames[0])} particles, last line of the bodies: {' '.join(last)}")
        self.assertGreater(float(last[7]), 0, "the ball touches particles")
        self.assertGreater(float(last[8]), 1.0, "the lid is pressed")
        self.assertNotIn("Dangerous builds = 1", log)
        for name, options in {"two": {"np": 2}, "four": {"np": 4, "grid": "2 2 1"},
                              "threads": {"threads": 2}, "both": {"np": 2, "threads": 2},
                              "skin": {"skin": 0.4}}.items():
            with self.subTest(name):
                self.run_scene(name, **options)
                found = self.results(name)
                self.assertEqual(found[0], bodies)
                for mine, theirs in zip(found[1], frames):
                    self.assertEqual(mine, theirs)
        with self.subTest("restart"):
            self.check_restart(bodies, frames)

    def check_restart(self, bodies, frames):
        start = START.format(grid="* * *", skin=0.15, law=LAW, read="read_data start")
        self.run_scene("again", np=2, script=start + BODIES + OUTPUT +
                       f"run {HALF}\nwrite_restart half\n")
        folder = self.path("again")
        begin = START.format(grid="* * *", skin=0.15, law=LAW, read="read_restart half")
        self.run_lammps(begin + BODIES + OUTPUT + f"run {HALF}\n", np=3, cwd=folder)
        found = self.results("again")
        self.assertEqual(found[1][2], frames[2])
        unique = sorted(set(found[0]), key=lambda line: int(line.split()[0]))
        self.assertEqual(unique, bodies)


if __name__ == "__main__":
    unittest.main(verbosity=2)
