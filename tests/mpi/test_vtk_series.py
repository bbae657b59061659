#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""dump vtk/gran: what its files say against dump custom and sums over contacts, on 1 and 2 ranks."""

import math
import os
import random
import unittest

import body_meshes
from talus_testing import SceneCase, Sphere, head, read_dump, write_sphere_data
from vtk_files import read_part, read_series

SCENE = head("si", "p f p") + """
read_data grains
{pair}
neighbor 0.2 bin
timestep 1e-4
"""
TALUS = """pair_style gran/penalty
pair_coeff * * hooke 1e6 100 tangential multistep NULL NULL 0.5"""
STOCK = "pair_style gran/hooke/history 1e6 NULL 100 NULL 0.5 1\npair_coeff * *"
MOVE = "fix step all nve/sphere/symplectic\n"
COLUMNS = "id type radius x y z vx vy vz fx fy fz c_s[1] c_s[2] c_s[3]"
DUMPS = f"""
compute s all stress/atom NULL virial
dump text all custom 20 text {COLUMNS}
dump_modify text format float %.17g
dump vtk {{group}} vtk/gran 20 {{file}} id type radius vx vy vz fx fy fz c_s[*] {{modify}}
"""
BODIES = """
fix floor all large/body plane 0 -0.01 0 0 1 0 contact hooke 1e6 100
fix ball_1 all large/body mesh ball.stl contact hooke 1e6 100 pressure yes
"""


def grains():
    draw = random.Random(5)
    return [Sphere(tuple(0.98 * (s + 0.5) + draw.uniform(-0.02, 0.02) for s in (i, j, k)),
                   tuple(draw.gauss(0, 0.5) for _ in "xyz"), diameter=1.0, density=1000.0)
            for i in range(4) for j in range(3) for k in range(4)]


def merged(pieces, kind, name):
    return [row for piece in pieces for row in getattr(piece, kind)[name]]


class Series(SceneCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), ((0, 3.92), (-1, 9), (0, 3.92)), grains())
        body_meshes.write_stl(self.path("ball.stl"), body_meshes.sphere((2, 3.6, 2), 1, 6))

    def scene(self, pair=TALUS, bodies=BODIES, group="all", file="run.pvd", modify="", steps=40, after=""):
        return (SCENE.format(pair=pair) + MOVE + bodies + DUMPS.format(group=group, file=file, modify=modify) +
                f"run {steps}\n{after}")

    def check(self, pieces_of_ranks, bodies):
        series = read_series(self.path("run.pvd"))
        frames = read_dump(self.path("text"))
        self.assertEqual([time for time, _ in series], [0.0, 20e-4, 40e-4])
        for frame, (time, parts) in zip(frames, series):
            self.assertEqual(list(parts), ["grains", "contacts", *bodies])
            read = {name: read_part(path) for name, path in parts.items()}
            for name in ("grains", "contacts"):
                self.assertEqual(len(read[name]), pieces_of_ranks)
            for pieces in read.values():
                for piece in pieces:
                    self.assertEqual(piece.time, time)
            self.check_grains(frame, read["grains"])
            self.check_contacts(frame, read["contacts"], bodies)
        return series

    def check_grains(self, frame, pieces):
        tags = merged(pieces, "point_data", "id")
        self.assertEqual(sorted(tags), sorted(frame.atoms))
        points = [p for piece in pieces for p in piece.points]
        rows = {"x": points, "type": merged(pieces, "point_data", "type"), "radius": merged(pieces, "point_data", "radius"),
                "v": merged(pieces, "point_data", "v"), "f": merged(pieces, "point_data", "f"),
                "c_s": merged(pieces, "point_data", "c_s")}
        self.assertEqual({k for piece in pieces for k in piece.point_data}, {"id", *rows} - {"x"})
        for k, tag in enumerate(tags):
            row = dict(zip(frame.columns, frame.atoms[tag]))
            self.assertEqual(rows["x"][k], (row["x"], row["y"], row["z"]))
            self.assertEqual(rows["v"][k], (row["vx"], row["vy"], row["vz"]))
            self.assertEqual(rows["f"][k], (row["fx"], row["fy"], row["fz"]))
            self.assertEqual(rows["c_s"][k][:3], tuple(row[f"c_s[{c}]"] for c in (1, 2, 3)))
            self.assertEqual(len(rows["c_s"][k]), 6)
            self.assertEqual((rows["type"][k], rows["radius"][k]), (1, 0.5))
        self.assertEqual({kind for piece in pieces for kind in piece.cells}, {"Verts"})

    def check_contacts(self, frame, pieces, bodies):
        x = frame.column("x"), frame.column("y"), frame.column("z")
        total = {tag: [0.0] * 3 for tag in frame.atoms}
        seen, touched = set(), set()
        for piece in pieces:
            values = zip(piece.cells["Lines"], piece.cell_data["id1"], piece.cell_data["id2"], piece.cell_data["body"],
                         piece.cell_data["force"], piece.cell_data["overlap"])
            for (a, b), i, j, body, force, overlap in values:
                if body:
                    self.assertEqual(j, 0)
                    self.check_body_contact(piece, a, b, body, overlap)
                    touched.add(body)
                    for c in range(3):
                        total[i][c] += force[c]
                    continue
                self.assertNotIn(frozenset((i, j)), seen)
                seen.add(frozenset((i, j)))
                begin, end = piece.points[a], piece.points[b]
                self.assertEqual(begin, tuple(c[i] for c in x))
                for c, place, period in zip(range(3), end, (3.92, None, 3.92)):
                    off = abs(place - x[c][j])
                    self.assertLess(min(off, abs(off - (period or 0.0))), 1e-12)
                self.assertAlmostEqual(1.0 - math.dist(begin, end), overlap, delta=1e-12)
                normal = [(p - q) / math.dist(begin, end) for p, q in zip(begin, end)]
                along = sum(f * n for f, n in zip(force, normal))
                self.assertAlmostEqual(piece.point_data["normal_force"][a], along, delta=1e-9 * abs(along) + 1e-9)
                self.assertEqual(piece.point_data["normal_force"][a], piece.point_data["normal_force"][b])
                for c in range(3):
                    total[i][c] += force[c]
                    total[j][c] -= force[c]
        self.assertGreater(len(seen), 50)
        self.assertEqual(touched, set(range(1, len(bodies) + 1)))
        for tag, force in total.items():
            for c, name in enumerate(("fx", "fy", "fz")):
                self.assertAlmostEqual(force[c], frame.column(name)[tag], delta=1e-8)

    def check_body_contact(self, piece, a, b, body, overlap):
        """From the center to the surface: of the floor, or of the ball, whose facets are within it."""
        begin, end = piece.points[a], piece.points[b]
        self.assertAlmostEqual(math.dist(begin, end), 0.5 - overlap, delta=1e-12)
        if body == 1:
            self.assertAlmostEqual(end[1], -0.01, delta=1e-9)
        else:
            self.assertTrue(0.7 < math.dist(end, (2, 3.6, 2)) < 1.0 + 1e-6)

    def test_forces_of_contacts_are_those_on_grains(self):
        for name, pair in (("talus", TALUS), ("stock", STOCK)):
            for np in (1, 2):
                with self.subTest(name, np=np):
                    self.run_lammps(self.scene(pair=pair, bodies=""), np=np)
                    self.check(1, [])

    def test_one_piece_for_each_rank_and_bodies(self):
        self.run_lammps(self.scene(file="run%.pvd"), np=2)
        series = self.check(2, ["body_floor", "body_ball_1"])
        floor, = read_part(series[0][1]["body_floor"])
        for p in floor.points:
            self.assertAlmostEqual(p[1], -0.01, delta=1e-12)
        ball, = read_part(series[0][1]["body_ball_1"])
        self.assertEqual(set(ball.cell_data), {"pressure", "shear_stress", "shear_work", "force"})
        self.assertGreater(max(ball.cell_data["pressure"]), 0.0)
        for p in ball.points:
            self.assertAlmostEqual(math.dist(p, (2, 3.6, 2)), 1.0, delta=1e-6)

    def test_files_of_several_ranks_and_sorting(self):
        self.run_lammps(self.scene(bodies="", file="run%.pvd", modify="\ndump_modify vtk nfile 2"), np=3)
        self.check(2, [])
        self.run_lammps(self.scene(bodies="", modify="\ndump_modify vtk sort id"), np=2)
        self.check(1, [])
        grains, = read_part(read_series(self.path("run.pvd"))[0][1]["grains"])
        self.assertEqual(grains.point_data["id"], sorted(grains.point_data["id"]))

    def test_group_parts_and_going_on(self):
        self.run_lammps(self.scene(group="few", modify="\ndump_modify vtk bodies no pad 4",
                                   after="write_restart half\n").replace("neighbor", "group few id 1:9\nneighbor", 1))
        series = read_series(self.path("run.pvd"))
        self.assertEqual(list(series[0][1]), ["grains", "contacts"])
        self.assertTrue(series[0][1]["grains"].endswith("run.grains.0000.vtp"))
        grains, = read_part(series[0][1]["grains"])
        self.assertEqual(sorted(grains.point_data["id"]), list(range(1, 10)))
        contacts, = read_part(series[0][1]["contacts"])
        self.assertLessEqual({*contacts.cell_data["id1"], *contacts.cell_data["id2"]}, set(range(10)))    # 0: a body
        again = self.scene(modify="\ndump_modify vtk append yes contacts no")
        self.run_lammps(again.replace("read_data grains", "read_restart half"))
        times = [time for time, _ in read_series(self.path("run.pvd"))]
        self.assertEqual(len(times), 5)
        self.assertAlmostEqual(times[-1], 80e-4, delta=1e-12)

    def test_life_cycle(self):
        script = self.scene(bodies="")
        self.run_lammps(script + "undump vtk\nclear\n" + script + "undump text\nclear\n")
        self.run_lammps(self.scene(bodies="", steps=0) +
                        "write_dump all vtk/gran one.pvd id vx vy vz modify contacts no\n", np=2)
        (_, parts), = read_series(self.path("one.pvd"))
        self.assertEqual(list(parts), ["grains"])
        self.run_lammps(self.scene(bodies="", after="write_dump all vtk/gran one.pvd id\n"))    # contacts are those of the dump
        last = [merged(read_part(read_series(self.path(name))[-1][1]["contacts"]), "cell_data", "force") for name in ("run.pvd", "one.pvd")]
        self.assertTrue(len(last[0]))
        self.assertEqual(*(repr(one) for one in last))

    def test_names_are_written_safely(self):
        os.mkdir(self.path("a&b"))
        self.run_lammps(self.scene(bodies="", file="'a&b/run.pvd'", steps=0))
        (_, parts), = read_series(self.path("a&b/run.pvd"))
        self.assertEqual(len(read_part(parts["grains"])), 1)

    def test_errors(self):
        lj = "pair_style none"
        cases = [(self.scene(file="run.vtk"), "the file name 'run.vtk' must end in .pvd"),
                 (self.scene(file="run*.pvd"), r"the file name 'run\*.pvd' must have no \*"),
                 (self.scene(file="nowhere/run.pvd"), r"dump vtk/gran vtk: cannot write 'nowhere/run.grains.0.vtp': No such"),
                 (self.scene(modify="foo"), "(?i)invalid attribute foo in dump vtk/gran"),
                 (self.scene(modify="\ndump_modify vtk contacts maybe"), "Expected boolean parameter instead of 'maybe'"),
                 (self.scene(modify="\ndump_modify vtk bodies"), "Illegal dump_modify bodies command: missing argument"),
                 (self.scene(modify="\ndump_modify vtk pbc yes"), "dump_modify pbc yes is not for dump vtk/gran"),
                 (self.scene(pair=lj, bodies=""), "no contacts: there is no pair style; use 'dump_modify vtk contacts no'"),
                 (SCENE.format(pair=TALUS) + MOVE + "run 0\nwrite_dump all vtk/gran one.pvd id\n",
                  "contacts are known from the first run after the dump command on")]
        for script, message in cases:
            for np in (1, 2):
                with self.subTest(message, np=np):
                    found = self.run_lammps(script, np=np, expect_error=True)
                    self.assertRegex(found.log + found.output, message)


if __name__ == "__main__":
    unittest.main()
