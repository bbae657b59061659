# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=20
"""Contacts with walls of LAMMPS that are accelerated, in all outputs of contacts: those of the same wall as a large body;
forces and torques of rows that add up to those of the particles, for all that LAMMPS' models remember and for walls that
move."""

import collections
import unittest

import test_suffix_walls as walls_of_lammps
from talus_testing import SceneCase, read_dump, read_local, thermo, write_sphere_data
from tossed_grains import tossed_grains
from vtk_files import read_part, read_series

WORDS = ("id1 id2 body part x1 y1 z1 x2 y2 z2 px py pz nx ny nz overlap force fn ft fx fy fz tx ty tz eng").split()
# a law that has one energy whatever the path was, and that fix wall/gran, region walls and bodies have alike
STOCK, OURS = "hooke 4000.0 NULL 20.0 10.0 0.5 1", "hooke 4000.0 20.0 tangential dashpot 10.0 0.5"
SCENE = walls_of_lammps.BEGIN + """
read_data grains
pair_style gran/penalty
pair_coeff * * {pair}
neighbor 0.1 bin
timestep 0.001
fix step all nve/sphere/symplectic gravity 10.0 vector 0.3 0.1 -1
{walls}
compute rows all contact/gran/local """ + " ".join(WORDS) + """
compute n all contact/gran/atom
compute lost all dissipation/gran/atom
compute p all penalty/stats
compute field all coarse/grid 4 4 4 18.0 cxx cyy czz cxy cxz cyz
compute sum all reduce sum c_lost[1] c_lost[2] c_lost[3] c_n[3]
compute spin all erotate/sphere
thermo 200
thermo_style custom step c_p[1] c_p[2] c_p[3] c_p[4] c_p[5] c_p[6] c_p[7] c_sum[1] c_sum[2] c_sum[3] c_sum[4] ke c_spin
thermo_modify norm no lost ignore format float %.17g
dump rows all local {every} rows index c_rows[*]
dump_modify rows format line "%.0f""" + " %.17g" * len(WORDS) + """"
dump atoms all custom {every} atoms id x y z fx fy fz tqx tqy tqz c_n[1] c_n[2] c_n[3]
dump_modify atoms format float %.17g sort id
dump field all grid 200 field c_field:grid:data[*]
dump_modify field format float %.17g
{more}
run {steps}
"""


def planes_of_lammps(law):
    return "".join(f"fix {d}w all wall/gran/talus {law} {d}plane 0 NULL\n" for d in "xyz")


def planes_as_bodies(law):
    normals = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}
    return "".join(f"fix {d}w all large/body plane 0 0 0  {n}  contact {law}\n" for d, n in normals.items())


REGION = "region w block 0 9.5 0 7.2 0 9\n"


class WallContacts(SceneCase):

    def setUp(self):
        super().setUp()
        write_sphere_data(self.path("grains"), ((-30, 40), (-30, 40), (-30, 40)), tossed_grains(3))

    def run_scene(self, walls, np=1, pair=OURS, more="", steps=800, every=200, **options):
        self.log = self.run_lammps(SCENE.format(walls=walls, pair=pair, more=more, steps=steps, every=every), np=np,
                                   **options).log
        self.rows = [[dict(zip(["index", *WORDS], row)) for row in frame.rows] for frame in read_local(self.path("rows"))]
        self.frames = read_dump(self.path("atoms"))
        self.table = thermo(self.log)
        return self.outputs()

    def outputs(self):
        """Of the last step: rows, those of thermo, the grid."""
        key = lambda row: (row["id1"], row["id2"], row["body"], row["nx"], row["ny"])
        rows = [[row[word] for word in WORDS if word != "part"] for row in sorted(self.rows[-1], key=key)]
        text = self.read("field").rsplit("ITEM: GRID CELLS", 1)[1].splitlines()[1:]
        grid = [[float(word) for word in line.split()] for line in text]
        return rows, [list(row.values()) for row in self.table], grid

    def assert_alike(self, one, other, limit=1e-9):
        for mine, theirs in zip(one, other, strict=True):
            scale = [max(abs(value) for value in column) for column in zip(*mine)]
            for a, b in zip(mine, theirs, strict=True):
                for value, expected, most in zip(a, b, scale, strict=True):
                    self.assertLessEqual(abs(value - expected), limit * max(most, 1e-3))

    def assert_rows_are_forces(self, rows, frame):
        """On the first particle in all of the forces and torques, on the second the opposite force."""
        if not rows:
            return
        force, torque = collections.defaultdict(lambda: [0.0] * 3), collections.defaultdict(lambda: [0.0] * 3)
        for row in rows:
            for d, axis in enumerate("xyz"):
                force[row["id1"]][d] += row["f" + axis]
                torque[row["id1"]][d] += row["t" + axis]
                if row["id2"]:
                    force[row["id2"]][d] -= row["f" + axis]
        scale = max(row["force"] for row in rows)
        alone = set(frame.atoms) - {row["id2"] for row in rows}
        for tag, row in frame.atoms.items():
            for d in range(3):
                self.assertLess(abs(force[tag][d] - row[4 + d]), 1e-9 * scale)
                if tag in alone:
                    self.assertLess(abs(torque[tag][d] - row[7 + d]), 1e-9 * scale)

    def test_as_of_large_bodies(self):
        """Rows, counts, energies and stresses, on any number of ranks and threads."""
        of_bodies = self.run_scene(planes_as_bodies(OURS))
        self.assertGreater(sum(row["body"] > 0 for row in self.rows[-1]), 5)
        for np, threads in (1, 1), (2, 1), (1, 3):
            of_walls = self.run_scene(planes_of_lammps(STOCK), np=np, env={"OMP_NUM_THREADS": str(threads)})
            self.assertRegex(self.log, "steps without output +in the records")
            self.assert_alike(of_bodies, of_walls)
            self.assertEqual({row["part"] for row in self.rows[-1] if row["body"]}, {1.0})

    def test_regions_as_of_large_bodies(self):
        of_bodies = self.run_scene(REGION + f"fix w all large/body region w contact {OURS}\n")
        faces = {row["part"] for row in self.rows[-1] if row["body"]}
        self.assertGreater(len(faces), 1)
        for np in 1, 2:
            of_walls = self.run_scene(REGION + f"fix w all wall/gran/region/talus {STOCK} region w\n", np=np)
            self.assert_alike(of_bodies, of_walls)
            self.assertEqual({row["part"] for row in self.rows[-1] if row["body"]}, faces)

    def test_number_is_that_of_the_script(self):
        walls = planes_of_lammps(STOCK).splitlines(True)
        plane = f"fix b all large/body plane 0 0 0  0 0 1  contact {OURS}\n"
        self.run_scene(walls[0] + plane + walls[1] + walls[2], every=20)
        normals = {row["body"]: (row["nx"], row["ny"], row["nz"]) for rows in self.rows for row in rows if row["body"]}
        self.assertEqual(normals, {1.0: (1, 0, 0), 2.0: (0, 0, 1), 3.0: (0, 1, 0), 4.0: (0, 0, 1)})

    def test_both_planes(self):
        self.run_scene(f"fix zw all wall/gran/talus {STOCK} zplane 0 3.6\n", every=20)
        for part, up in (1, 1.0), (2, -1.0):
            self.assertEqual({row["nz"] for rows in self.rows for row in rows if row["part"] == part}, {up})

    def test_pictures(self):
        self.run_scene(planes_of_lammps(STOCK), more="dump v all vtk/gran 800 run.pvd")
        _, parts = read_series(self.path("run.pvd"))[-1]
        lines, = read_part(parts["contacts"])
        self.assertEqual(sorted(lines.cell_data["body"]), sorted(row["body"] for row in self.rows[-1]))

    def test_forces(self):
        """Whatever models of LAMMPS remember, of walls that move and turn; behind the run as well."""
        models = walls_of_lammps
        planes = models.BOX + "fix zw all {wall} {law} zplane 0 NULL wiggle z 0.125 0.5\n"
        drum = models.REGIONS["drum"] + "fix w all {wall}/region {law} region w\n"
        for law in models.HOOKE_HISTORY, models.MINDLIN, models.COHESIVE:
            for walls in planes, drum:
                with self.subTest(law=law, walls=walls):
                    self.run_scene(walls.replace("{wall}/region", "wall/gran/region/talus").format(
                        wall="wall/gran/talus", law=law), steps=600, every=20)
                    for rows, frame in zip(self.rows[1:], self.frames[1:], strict=True):
                        self.assert_rows_are_forces(rows, frame)
                    self.assertGreater(sum(row["body"] > 0 for rows in self.rows for row in rows), 20)


if __name__ == "__main__":
    unittest.main()
