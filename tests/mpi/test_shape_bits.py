# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=25 timeout=300
"""One trajectory of convex particles, superellipsoids and spheres: the same bits on any ranks, threads and grid, in a periodic
box, with bodies and meshes that move, particles that come in during the run, and across a restart."""

import functools
import os
import random
import shutil
import tempfile
import unittest

import body_meshes
from talus_testing import SceneCase, Sphere, head, read_dump, run_lammps, thermo, write_sphere_data

STEPS, HALF = 2000, 1200
LAW = "hertz 2e4 60 tangential multistep NULL NULL 0.5"
CORNERS = "vertices 4 1 1 1 1 -1 -1 -1 1 -1 -1 -1 1"

START = head(boundary="{x} f f") + """
processors {grid}
{read}
group balls type 3
neighbor 0.3 bin
pair_style gran/penalty
pair_coeff * * {law}
timestep 0.0005
fix step balls nve/sphere/symplectic
fix shapes all shape/gran type 1 box 0.8 0.7 0.6 density 1 orient random 11 &
    type 2 {corners} scale 0.35 rounded 0.08 density 1 orient random 12 &
    type 4 superellipsoid 0.6 0.55 0.5 4 2.5 density 1 orient random 13 type 5 ellipsoid 0.65 0.5 0.55 density 1 orient random 14
fix g all gravity/talus 15 vector 0.2 0.1 -1
fix floor all large/body plane 0 0 0 0 0 1 contact {law}
fix stirrer all large/body mesh ../stirrer.stl contact {law} move rotate 4 4 0 0 0 1 3
fix sides all large/body box 4 4 6 {length} 8 12 inside contact {law} move wiggle 0 0.2 0 2.5
region top block 0 8 0 8 8 11 units box
fix more all deposit 8 1 60 77 region top near 1.6 vz -2 -2
dump atoms all custom {half} atoms.* id type x y z vx vy vz omegax omegay omegaz f_shapes[1] f_shapes[2] f_shapes[3] &
    f_shapes[4] radius mass
dump_modify atoms format float %a
thermo 250
thermo_style custom step atoms f_shapes f_shapes[6] f_shapes[7] press
thermo_modify norm no lost error
"""


def grains():
    draw = random.Random(5)
    sites = [(i, j, k) for k in range(5) for j in range(5) for i in range(5)]
    return [Sphere((1.6 * i + 0.8, 1.6 * j + 0.8, 1.4 * k + 0.7), v=tuple(draw.gauss(0, 0.7) for _ in "xyz"),
                   omega=tuple(draw.gauss(0, 1) for _ in "xyz"), diameter=draw.uniform(0.6, 1.0),
                   type=draw.choice((1, 1, 2, 3, 4, 4, 5, 5))) for i, j, k in sites]


END = "\nwrite_dump all custom end id type x y z vx vy vz omegax omegay omegaz f_shapes[1] f_shapes[2] " \
      "f_shapes[3] f_shapes[4] modify format float %a"


class ShapeBits(SceneCase):

    IN_RECORDS = "steps without output              in the records"

    @classmethod
    def write_files(cls, folder):
        write_sphere_data(os.path.join(folder, "grains"), ((0, 8), (-1, 9), (-1, 12)), grains(), types=5)
        body_meshes.write_stl(os.path.join(folder, "stirrer.stl"), body_meshes.box((2, 3.7, 0), (6, 4.3, 0.7), 4))

    @classmethod
    @functools.lru_cache
    def whole(cls):
        """The run on one rank, periodic in x, that others are compared with: its folder and log."""
        home = tempfile.mkdtemp(prefix="talus-shape-bits-")
        unittest.addModuleCleanup(shutil.rmtree, home, ignore_errors=True)
        cls.write_files(home)
        return cls.frames_in(os.path.join(home, "one"))

    def frames(self, name, *words, **options):
        return self.frames_in(self.path(name), *words, **options)

    @staticmethod
    def frames_in(where, np=1, grid="* * *", commands=f"run {STEPS}", read="read_data ../grains", env=None, walls=False):
        """Periodic in x, or with walls there."""
        os.makedirs(where, exist_ok=True)
        script = START.format(grid=grid, read=read, law=LAW, corners=CORNERS, half=HALF, x="f" if walls else "p",
                              length=8 if walls else 40)
        return where, run_lammps(script + commands + END, np=np, cwd=where, env=env).log

    def setUp(self):
        self.write_files(self.dir)

    def assert_same(self, where, other):
        mine, theirs = (read_dump(os.path.join(d, f"atoms.{HALF}"))[0] for d in (where, other))
        self.assert_same_bits(mine, theirs)
        self.assert_same_end(where, other)

    def assert_same_end(self, where, other):
        self.assert_same_bits(*(read_dump(os.path.join(d, "end"))[0] for d in (where, other)))

    def test_ranks_and_threads(self):
        one, log = self.whole()
        rows = thermo(log)
        self.assertEqual(rows[-1]["Atoms"], 133, "all have been put in")
        print(f"{rows[-1]['f_shapes[6]']:.0f} pairs touch at {rows[-1]['f_shapes[7]']:.0f} points at the end")
        self.assertGreater(rows[-1]["f_shapes[6]"], 60)
        for name, np, grid, env in (("two across", 2, "1 2 1", None), ("four", 4, "2 2 1", None),
                                    ("threads", 1, "* * *", {"OMP_NUM_THREADS": "3"}),
                                    ("both", 2, "1 1 2", {"OMP_NUM_THREADS": "2"})):
            with self.subTest(name):
                where, log = self.frames(name, np, grid, env=env)
                self.assert_same(where, one)
                # sums over ranks: to rounding
                for key in ("f_shapes", "f_shapes[6]", "f_shapes[7]", "Press"):
                    self.assert_close(thermo(log)[-1][key], rows[-1][key], 1e-12)
                self.assertIn(self.IN_RECORDS, log)
        parts, _ = self.frames("parts", commands=f"run {HALF}\nrun {STEPS - HALF} pre no")
        self.assert_same(parts, one)

    def test_records_and_arrays(self):
        """Steps in the records, with messages beside the computation and before it, and in the arrays of LAMMPS."""
        one, log = self.whole()
        self.assertIn(self.IN_RECORDS, log)
        for name, np, commands, in_records in (
                ("arrays on two", 2, "run_style verlet/stock", False),
                ("messages of LAMMPS", 2, "comm_proxy no", False),
                ("overlap", 2, "run_style verlet/proxy overlap yes", True),
                ("no overlap", 2, "run_style verlet/proxy overlap no", True),
                ("energies", 2, "compute p all penalty/stats\nthermo_modify lost error", False)):
            with self.subTest(name):
                where, log = self.frames(name, np, commands=f"{commands}\nrun {STEPS}")
                self.assertEqual(self.IN_RECORDS in log, in_records)
                self.assert_same(where, one)

    def test_set_up_and_restart(self):
        one, _ = self.frames("one", walls=True)
        again, _ = self.frames("again", 2, commands=f"run {HALF}\nrun {STEPS - HALF}", walls=True)
        self.assert_same(again, one)
        for file, np in (("half", 1), ("half.*", 4)):
            with self.subTest(file):
                self.frames("first", 2, commands=f"run {HALF - 50}\nwrite_restart {file}", walls=True)
                second, log = self.frames("second", np, commands=f"run {STEPS - HALF + 50}", walls=True,
                                          read=f"read_restart ../first/{file.replace('*', str(HALF - 50))}")
                self.assertIn("All restart file peratom fix info was re-assigned", log)
                self.assert_same(second, one)

    def test_new_ids(self):
        """Two boxes one on the other, held by friction: contacts are known by the IDs that particles had."""
        pile = "".join(f"create_atoms 1 single {x} 4 {z}\n" for z in (0.299, 0.897) for x in (1, 4))
        script = head() + f"processors * * 1\nregion box block 0 8 0 8 0 8\ncreate_box 1 box\n{pile}" \
            "region left block 0 2 0 8 0 8\ndelete_atoms region left compress no\nneighbor 0.3 bin\ntimestep 0.0005\n" \
            f"pair_style gran/penalty\npair_coeff * * {LAW}\nfix s all shape/gran type 1 box 0.8 0.7 0.6 density 1\n" \
            f"fix g all gravity/talus 15 vector 0.15 0 -1\nfix floor all large/body plane 0 0 0 0 0 1 contact {LAW}\n" \
            "run 4000\n{}run 1000\nwrite_dump all custom end id x y z vx vy vz modify format float %a\n"

        def end(np, between):
            self.run_lammps(script.replace("{}", between), np=np)
            frame, = read_dump(self.path("end"))
            rows = [dict(zip(frame.columns, row)) for row in frame.atoms.values()]
            return sorted(rows, key=lambda row: row["z"]), sorted(frame.atoms)

        same, ids = end(1, "")
        self.assertEqual(ids, [2, 4])
        for row in same:
            self.assertLess(abs(row["x"] - 4.0), 0.06, "friction holds it")
        for np in 1, 2:
            new, ids = end(np, "reset_atoms id sort yes\n")
            self.assertEqual(ids, [1, 2])
            for mine, row in zip(new, same):
                for key in "x", "vx":
                    self.assertLess(abs(mine[key] - row[key]), 1e-12, f"{np} ranks, {key}")


if __name__ == "__main__":
    unittest.main()
