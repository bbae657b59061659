# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""Outputs of contacts of convex particles: the points, forces and torques of compute contact/gran/local add up to the
forces of particles and of a body, counts and energies by particle to those of all, the virial and the fields of compute
coarse/grid to the same; on any number of ranks, behind a run and after a restart."""

import collections
import math
import random
import unittest

from talus_testing import SceneCase, Sphere, head, read_dump, read_local, thermo, write_sphere_data
from vectors import cross

WORDS = "id1 id2 body x1 y1 z1 x2 y2 z2 px py pz nx ny nz overlap fx fy fz tx ty tz fn ft eng h1 h2 h3".split()
LAW = "hooke 1e4 20 tangential multistep NULL NULL 0.5"
CELLS = 6, 6, 16
SCENE = head(boundary="{boundary} f f") + f"""
{{read}}
group balls type 3
neighbor 0.2 bin
pair_style gran/penalty
pair_coeff * * {LAW}
timestep 5e-4
fix s all shape/gran type 1 box 1 0.7 0.5 density 1 orient random 7 &
    type 2 vertices 4 1 1 1 1 -1 -1 -1 1 -1 -1 -1 1 scale 0.4 rounded 0.1 density 1 orient random 9
fix b balls nve/sphere/symplectic
fix g all gravity/talus 10 vector 0 0 -1
fix box all large/body box 3 3 15 {{length}} 6 30 inside contact {LAW}
fix_modify box virial yes
compute rows all contact/gran/local {" ".join(WORDS)}
compute n all contact/gran/atom
compute lost all dissipation/gran/atom
compute p all penalty/stats
compute all_lost all reduce sum c_lost[1] c_lost[2] c_lost[3] c_n[1]
compute v all stress/atom NULL pair fix
compute sums all reduce sum c_v[1] c_v[2] c_v[3] c_v[4] c_v[5] c_v[6]
compute field all coarse/grid {CELLS[0]} {CELLS[1]} {CELLS[2]} 2.0 density fraction cxx cyy czz cxy cxz cyz
dump field all grid 500 fields c_field:grid:data[*]
dump_modify field format float %.17g first no
dump rows all local 500 rows index c_rows[*]
dump_modify rows format line "%d {' '.join(['%.17g'] * len(WORDS))}"
dump atoms all custom 500 atoms id type x y z fx fy fz tqx tqy tqz c_n[1] c_n[2] c_n[3] c_lost[1] c_lost[2] c_lost[3] mass
dump_modify atoms format float %.17g
thermo 500
thermo_style custom step c_p[1] c_p[2] c_p[3] c_p[4] c_p[5] c_p[6] c_all_lost[1] c_all_lost[2] c_all_lost[4] f_s[6] f_s[7] &
    f_box[1] f_box[2] f_box[3] c_sums[1] c_sums[2] c_sums[3] c_sums[4] c_sums[5] c_sums[6] press
thermo_modify format float %.17g norm no
"""


def grains():
    draw = random.Random(3)
    return [Sphere((1.95 * i + 1.05, 1.9 * j + 1.1, 1.5 * k + 1), v=tuple(draw.gauss(0, .3) for _ in "xyz"),
                   omega=tuple(draw.gauss(0, 1) for _ in "xyz"), type=1 + (i + j + k) % 3, diameter=0.9)
            for k in range(5) for j in range(3) for i in range(3)]


class Outputs(SceneCase):

    def run_scene(self, np=1, periodic=False, commands="run 6000", read="read_data grains"):
        write_sphere_data(self.path("grains"), ((0, 6), (-1, 7), (-1, 30)), grains(), types=3)
        script = SCENE.format(boundary="p" if periodic else "f", length=20 if periodic else 6, read=read)
        self.rows = thermo(self.run_lammps(script + commands, np=np).log)
        self.contacts = [dict(zip(WORDS, row)) for row in self.last_local(self.path("rows"))]
        self.atoms = read_dump(self.path("atoms"))[-1]
        self.last = self.rows[-1]

    @staticmethod
    def last_local(path):
        return sorted(row[1:] for row in read_local(path)[-1].rows)

    def check_sums(self):
        force, torque, count = (collections.defaultdict(lambda: [0.0, 0.0, 0.0]) for _ in range(3))
        on_box, energy = [0.0, 0.0, 0.0], 0.0
        for c in self.contacts:
            first, second = int(c["id1"]), int(c["id2"])
            f, point = [c[f"f{d}"] for d in "xyz"], [c[f"p{d}"] for d in "xyz"]
            arm = [p - c[f"{d}1"] for p, d in zip(point, "xyz")]
            self.assertGreater(c["overlap"], 0.0)
            self.assertAlmostEqual(sum(c[f"n{d}"] ** 2 for d in "xyz"), 1.0, delta=1e-12)
            self.assertAlmostEqual(c["fn"], sum(c[f"n{d}"] * x for d, x in zip("xyz", f)), delta=1e-12)
            for d, expected in zip("xyz", cross(arm, f)):
                self.assertAlmostEqual(c[f"t{d}"], expected, delta=2e-3 * abs(c["fn"]) + 1e-12)
            other = cross([p - c[f"{d}2"] for p, d in zip(point, "xyz")], f)
            energy += c["eng"]
            for d in range(3):
                force[first][d] += f[d]
                torque[first][d] += c["t" + "xyz"[d]]
                if second:
                    force[second][d] -= f[d]
                    torque[second][d] -= other[d]
                else:
                    on_box[d] -= f[d]
            count[first][0] += 1
            count[first][2 if not second else 1] += 1
            if second:
                count[second][0] += 1
                count[second][1] += 1
        column = self.atoms.column
        for tag, kind in column("type").items():
            for d, name in enumerate("xyz"):
                weight = -10.0 * column("mass")[tag] if d == 2 else 0.0
                self.assertAlmostEqual(force[tag][d] + weight, column("f" + name)[tag], delta=1e-9)
                if kind < 3:    # arms of spheres are longer by half of the overlap where they act
                    self.assertAlmostEqual(torque[tag][d], column("tq" + name)[tag], delta=5e-3)
                self.assertEqual(count[tag][d], column(f"c_n[{d + 1}]")[tag])
        for d in range(3):
            self.assertAlmostEqual(on_box[d], self.last[f"f_box[{d + 1}]"], delta=1e-9)
        self.assertEqual(self.last["c_p[2]"], len(self.contacts))
        self.assert_close(self.last["c_p[4]"], energy, 1e-10)

    def test_sums(self):
        self.run_scene()
        self.check_sums()
        points = sum(1 for c in self.contacts if c["id2"] and not self.is_ball(c["id1"]) | self.is_ball(c["id2"]))
        print(f"{len(self.contacts)} contacts, {points} points of two shapes")
        self.assertGreater(len(self.contacts), 30)
        self.assertGreater(points, 10)
        self.assertGreater(self.last["c_p[1]"], self.last["f_s[6]"])
        self.assert_close(self.last["c_all_lost[1]"], self.last["c_p[5]"], 1e-12)
        self.assert_close(self.last["c_all_lost[2]"], self.last["c_p[6]"], 1e-12)
        self.assertGreater(self.last["c_p[6]"], 10.0)
        # a row that is not zero
        self.assertGreater(max(abs(c["h1"]) for c in self.contacts), 0.0)
        one = self.contacts, self.last
        for np in 2, 4:
            self.run_scene(np)
            self.check_sums()
            self.assertEqual(len(self.contacts), len(one[0]))
            for a, b in zip(self.contacts, one[0]):
                for word in WORDS:
                    self.assertAlmostEqual(a[word], b[word], delta=1e-11 * max(1.0, abs(b[word])))
            for key, value in one[1].items():
                if key != "Step":
                    self.assertAlmostEqual(self.last[key], value, delta=1e-9 * max(1.0, abs(value)), msg=key)

    def is_ball(self, tag):
        return self.atoms.column("type")[int(tag)] == 3

    def test_virial_and_fields(self):
        self.run_scene(2)
        column = self.atoms.column
        virial = [0.0] * 6
        for c in self.contacts:
            # of a pair the line of centers; of the box the arm
            end = [c[f"{d}{2}"] if c["id2"] else c[f"p{d}"] for d in "xyz"]
            line = [c[f"{d}1"] - e for d, e in zip("xyz", end)]
            if not c["id2"] and self.is_ball(c["id1"]):    # there the whole radius
                line = [0.45 * c[f"n{d}"] for d in "xyz"]
            f = [c[f"f{d}"] for d in "xyz"]
            for k, (a, b) in enumerate(((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))):
                virial[k] -= line[a] * f[b]
        weights = sum(column("mass").values())
        self.assertGreater(-virial[2], weights)
        for k in range(6):
            self.assertAlmostEqual(self.last[f"c_sums[{k + 1}]"], virial[k], delta=1e-8)
        cells = grid(self.path("fields"))
        volume = 6 * 8 * 31 / math.prod(CELLS)
        total = [math.fsum(row[n] for row in cells) * volume for n in range(8)]
        self.assert_close(total[0], weights, 0.3)    # near the border fields end
        self.assertGreater(total[1] / total[0], 0.99)
        self.assertLess(total[1] / total[0], 1.01)

    def test_fields_in_a_periodic_box(self):
        self.run_scene(2, periodic=True)
        cells = grid(self.path("fields"))
        self.assertEqual(len(cells), math.prod(CELLS))
        self.check_sums()

    def test_behind_a_run_and_restart(self):
        self.run_scene(1, commands="run 3000\nwrite_restart half\nrun 3000")
        one = dict(self.last), self.contacts
        self.run_scene(2, commands="run 3000", read="read_restart half")
        for mine, theirs in zip(self.contacts, one[1]):
            for word in WORDS:
                self.assertAlmostEqual(mine[word], theirs[word], delta=1e-9 * max(1.0, abs(theirs[word])))
        for key in "c_p[2]", "c_p[4]", "c_all_lost[1]", "c_all_lost[2]":
            self.assert_close(self.last[key], one[0][key], 1e-9)
        self.run_scene(2, commands="run 3500\nwrite_dump all local later index c_rows[*] modify format line \"%d "
                       + " ".join(["%.17g"] * len(WORDS)) + '"')
        self.assertEqual(self.last_local(self.path("later")), self.last_local(self.path("rows")))


def grid(path):
    """Rows of numbers of the last step of a dump grid."""
    cells = []
    with open(path) as file:
        for line in file:
            if line.startswith("ITEM: GRID CELLS"):
                cells = []
                for row in file:
                    if row.startswith("ITEM"):
                        break
                    cells.append([float(x) for x in row.split()])
    return cells


if __name__ == "__main__":
    unittest.main()
