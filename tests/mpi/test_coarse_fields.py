#!/usr/bin/env python3
# ctest: stay
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""compute coarse/grid: sums over the grid against sums over particles and contacts, the weight of a bed, ranks, errors."""

import math
import random
import unittest

from talus_testing import SceneCase, Sphere, head, marked_word, thermo, write_sphere_data

SCENE = head("si", "{boundary}") + """
read_data grains
{pair}
neighbor 0.1 bin
timestep 1e-4
{more}
fix step all {move}
"""
TALUS = """pair_style gran/penalty
pair_coeff * * hooke 1e5 10 tangential multistep NULL NULL 0.5"""
STOCK = "pair_style gran/hooke/history 1e5 NULL 10 NULL 0.5 1\npair_coeff * *"
SYMPLECTIC = "nve/sphere/symplectic"
FIELDS = ("number density fraction vx vy vz temp kxx kyy kzz kxy kxz kyz cxx cxy cxz cyx cyy cyz czx czy czz "
          "sxx syy szz sxy sxz syz press").split()
FIELD = "compute field {group} coarse/grid {cells} {width} {values}\n"
OUTPUT = """compute cell all property/grid {cells} id
dump field all grid {every} fields c_cell:grid:data c_field:grid:data{columns}
dump_modify field format float %.17g
"""
SUMS = """compute s all stress/atom NULL virial
compute sums all reduce sum c_s[1] c_s[2] c_s[3] c_s[4] c_s[5] c_s[6]
compute k all stress/atom NULL ke
compute sumk all reduce sum c_k[1] c_k[2] c_k[3] c_k[4] c_k[5] c_k[6]
thermo_style custom step c_sums[1] c_sums[2] c_sums[3] c_sums[4] c_sums[5] c_sums[6] &
    c_sumk[1] c_sumk[2] c_sumk[3] c_sumk[4] c_sumk[5] c_sumk[6]
thermo 50
thermo_modify format float %.17g norm no
"""
SIZE = 4.0
CELLS = 9, 8, 7


def field(values=" ".join(FIELDS), cells=CELLS, width=0.9, group="all"):
    return FIELD.format(values=values, cells=" ".join(map(str, cells)), width=width, group=group)


def output(every=50, columns="[*]", cells=CELLS):
    return OUTPUT.format(every=every, columns=columns, cells=" ".join(map(str, cells)))


def read_grid(path):
    """[rows of numbers, x fastest] of each step of a dump grid, whose first column is the number of the cell."""
    steps = []
    with open(path) as file:
        for line in file:
            if line.startswith("ITEM: GRID CELLS"):
                steps.append([])
            elif steps and not line.startswith("ITEM"):
                steps[-1].append(tuple(map(float, line.split())))
            if line.startswith("ITEM: TIMESTEP") and steps:
                next(file)
            elif line.startswith(("ITEM: UNITS", "ITEM: TIME", "ITEM: BOX BOUNDS", "ITEM: DIMENSION", "ITEM: GRID SIZE")):
                for _ in range(3 if "BOX" in line else 1):
                    next(file)
    for rows in steps:
        rows.sort()
        assert [row[0] for row in rows] == list(range(1, len(rows) + 1))
    return [[row[1:] for row in rows] for rows in steps]


def gas():
    draw = random.Random(11)
    place = lambda k: (0.8 * (k + 0.5) + draw.uniform(-0.05, 0.05))
    return [Sphere((place(i), place(j), place(k)), tuple(draw.gauss(1, 0.5) for _ in "xyz"),
                   tuple(draw.gauss(0, 0.5) for _ in "xyz"), diameter=draw.uniform(0.78, 0.86), density=1000.0)
            for i in range(5) for j in range(5) for k in range(5)]


class Fields(SceneCase):

    def make(self, spheres=None, box=((0, SIZE),) * 3):
        self.spheres = spheres or gas()
        write_sphere_data(self.path("grains"), box, self.spheres)

    def scene(self, more, boundary="p p p", pair=TALUS, move=SYMPLECTIC, steps=50):
        return SCENE.format(boundary=boundary, pair=pair, more=more, move=move) + f"run {steps}\n"

    def sums(self, rows):
        volume = SIZE**3 / len(rows)
        return {name: volume * math.fsum(row[k] for row in rows) for k, name in enumerate(FIELDS)}

    def check_sums(self, log, steps, cells_of_grid=CELLS):
        masses = [s.density * math.pi / 6 * s.diameter**3 for s in self.spheres]
        for row, cells in zip(thermo(log), steps, strict=True):
            self.assertEqual(len(cells), math.prod(cells_of_grid))
            found = self.sums(cells)
            self.assert_close(found["density"], math.fsum(masses), 1e-12)
            self.assert_close(found["number"], len(masses), 1e-12)
            self.assert_close(found["fraction"], math.fsum(masses) / 1000.0, 1e-12)
            # the host's xy is the x of the branch with the y of the force
            scale = max(abs(row[f"c_sums[{k}]"]) for k in (1, 2, 3))
            for k, name in enumerate(("cxx", "cyy", "czz", "cyx", "czx", "czy"), start=1):
                self.assertAlmostEqual(found[name], row[f"c_sums[{k}]"], delta=1e-10 * scale)
            self.assertGreater(abs(row["c_sums[4]"]), 1e-3 * scale)
            volume = SIZE**3 / len(cells)
            column = FIELDS.index
            for k, (name, a, b) in enumerate((("kxx", "vx", "vx"), ("kyy", "vy", "vy"), ("kzz", "vz", "vz"), ("kxy", "vx", "vy"),
                                              ("kxz", "vx", "vz"), ("kyz", "vy", "vz")), start=1):
                mean = math.fsum(c[column("density")] * c[column(a)] * c[column(b)] for c in cells)
                self.assert_close(found[name] - volume * mean, row[f"c_sumk[{k}]"], 1e-10)
            for c in cells:
                value = dict(zip(FIELDS, c))
                self.assertAlmostEqual(value["temp"] * 3 * value["density"], -value["kxx"] - value["kyy"] - value["kzz"],
                                       delta=1e-9 * value["density"])
                self.assertAlmostEqual(value["sxy"], value["kxy"] + value["cxy"], delta=1e-9)
                self.assertAlmostEqual(-3 * value["press"], value["sxx"] + value["syy"] + value["szz"], delta=1e-7)

    def test_volume_is_where_spheres_are(self):
        """A large sphere among small ones, with a width below its radius: solid inside, nothing outside, all of it together."""
        small = [Sphere((0.5 + k, 0.5 + m, 0.3), diameter=0.3, density=1000.0) for k in range(4) for m in range(4)]
        self.make([Sphere((3.9, 2.0, 2.3), diameter=1.9, density=1000.0)] + small)
        cells, width = (20, 24, 21), 0.25
        script = self.scene(field("fraction number", cells, width) + output(cells=cells), steps=0)
        first = None
        for np in 1, 2:
            self.run_lammps(script, np=np)
            rows, = read_grid(self.path("fields"))
            first = first or rows
            self.assertLess(max(abs(a[0] - b[0]) for a, b in zip(first, rows)), 1e-13)
        cell = SIZE**3 / math.prod(cells)
        self.assert_close(cell * math.fsum(row[0] for row in rows), math.pi / 6 * (1.9**3 + 16 * 0.3**3), 1e-13)
        self.assert_close(cell * math.fsum(row[1] for row in rows), 17, 1e-12)
        inside = outside = 0
        for n, (fraction, _) in enumerate(rows):
            x = [SIZE * (k + 0.5) / m for k, m in zip((n % 20, n // 20 % 24, n // 480), cells)]
            away = [a - b for a, b in zip(x, (3.9, 2.0, 2.3))]
            distance = math.hypot(*(a - SIZE * round(a / SIZE) for a in away))
            self.assertLess(fraction, 1.02)
            if distance < 0.95 - width:
                self.assertAlmostEqual(fraction, 1.0, delta=0.02)
                inside += 1
            elif distance > 0.95 + width and x[2] > 0.3 + 0.15 + width:
                self.assertEqual(fraction, 0.0)
                outside += 1
        self.assertGreater(inside, 150)
        self.assertGreater(outside, 3000)

    def test_sums_over_the_grid_and_ranks(self):
        self.make()
        styles = {"penalty": (TALUS, []), "stock": (STOCK, []), "suffix": (STOCK, ["-sf", "talus"])}
        for name, (pair, arguments) in styles.items():
            first = None
            for np in (1, 2, 4) if name == "penalty" else (2,):
                with self.subTest(name, np=np):
                    script = self.scene(field() + output() + SUMS, pair=pair)
                    log = self.run_lammps(script, np=np, arguments=arguments).log
                    steps = read_grid(self.path("fields"))
                    self.check_sums(log, steps)
                    first = first or steps
                    self.assert_same(first, steps)

    def test_profiles(self):
        """One cell along a direction takes the mean: the same sums, and over one coordinate the density by hand."""
        self.make()
        for cells in (1, 1, 7), (9, 1, 1), (9, 1, 7):
            first = None
            for np in 1, 2, 4:
                with self.subTest(cells, np=np):
                    log = self.run_lammps(self.scene(field(cells=cells) + output(cells=cells) + SUMS), np=np).log
                    steps = read_grid(self.path("fields"))
                    self.check_sums(log, steps, cells)
                    first = first or steps
                    self.assert_same(first, steps)
        self.run_lammps(self.scene(field("density fraction", (1, 1, 20), 0.9) + output(cells=(1, 1, 20)), steps=0))
        rows, = read_grid(self.path("fields"))
        density, fraction = ([0.0] * 20 for _ in range(2))
        for sphere in self.spheres:
            radius = sphere.diameter / 2
            parts = [(radius * (k + 0.5) / 50, radius**2 * (1 - ((k + 0.5) / 50)**2)) for k in range(-50, 50)]
            for column, points in (density, [(0.0, 1.0)]), (fraction, parts):
                smeared = [sum(part * self.kernel((n + 0.5) / 20 * SIZE - sphere.x[2] - off, 0.9) for off, part in points)
                           for n in range(20)]
                factor = math.pi / 6 * sphere.diameter**3 / math.fsum(smeared) / (SIZE**3 / 20)
                for n in range(20):
                    column[n] += smeared[n] * factor
        for row, a, b in zip(rows, density, fraction, strict=True):
            self.assert_close(row[0], 1000.0 * a, 1e-10)
            self.assert_close(row[1], b, 1e-3)

    @staticmethod
    def kernel(distance, width):
        distance -= SIZE * round(distance / SIZE)
        return max(0.0, 1 - (distance / width)**2)**2

    def assert_same(self, some, others):
        self.assertEqual(len(some), len(others))
        for one, other in zip(some, others):
            self.assertEqual(len(one), len(other))
            for k, name in enumerate(FIELDS):
                scale = max(abs(row[k]) for row in one)
                self.assertGreater(scale, 0.0)
                for a, b in zip(one, other):
                    self.assertAlmostEqual(a[k], b[k], delta=1e-11 * scale, msg=name)

    def test_one_sphere_against_the_formula(self):
        self.make([Sphere((1.7, 2.1, 1.9), (3, 0, 0), diameter=0.5, density=100.0)], ((0, 4),) * 3)
        more = field("density vx temp", (16, 16, 16), 1.0) + output(cells=(16, 16, 16))
        self.run_lammps(self.scene(more, boundary="f f f", steps=0))
        cells, = read_grid(self.path("fields"))
        mass = 100 * math.pi / 6 * 0.5**3
        for n, (density, v, temperature) in enumerate(cells):
            center = [0.25 * (i + 0.5) for i in (n % 16, n // 16 % 16, n // 256)]
            r = math.dist(center, (1.7, 2.1, 1.9))
            expected = mass * 105 / (32 * math.pi) * max(0.0, 1 - r * r)**2
            self.assertAlmostEqual(density, expected, delta=2e-2 * mass)
            self.assertAlmostEqual(v, 3.0 if density else 0.0, delta=1e-12)
            self.assertAlmostEqual(temperature, 0.0, delta=1e-12)

    def bed(self):
        """Columns of spheres on frozen ones, shifted so that contacts are oblique to nothing but the grid."""
        return [Sphere((0.5 + i, 0.5 + j, 0.5 + k), diameter=1.0, density=1000.0, type=1 if k else 2)
                for i in range(3) for j in range(3) for k in range(9)]

    def test_weight_of_a_bed(self):
        """On frozen spheres, and on a plane: there the stress ends within W of the plane."""
        for base in ("freeze", "plane"):
            with self.subTest(base):
                self.check_weight(base)

    def check_weight(self, base):
        self.make(self.bed(), ((0, 3), (0, 3), (0, 12)))
        more = """group base type 2
group mobile type 1
fix weight mobile gravity 10 vector 0 0 -1
fix damp mobile viscous 2e4
fix hold base freeze
timestep 5e-4
"""
        if base == "plane":
            more = more.replace("fix hold base freeze", "fix hold all large/body plane 0 0 1 0 0 1 contact hooke 1e7 10\ndelete_atoms group base")
        self.run_lammps(self.scene(more + field("density szz cxx czx", (6, 6, 48), 1.0) + output(4000, cells=(6, 6, 48)),
                                   boundary="p p f", pair=TALUS.replace("1e5", "1e7"), steps=4000), np=2)
        cells = read_grid(self.path("fields"))[-1]
        layer = [[sum(row[k] for row in cells[36 * z:36 * z + 36]) / 36 for k in range(4)] for z in range(48)]
        h, above, checked = 12 / 48, 0.0, 0
        weight = 8 * 1000 * math.pi / 6 * 10
        for z in reversed(range(48)):
            above += 0.5 * h * layer[z][0] * 10
            # the frozen spheres, and what holds them, do not reach higher; nor does the plane
            if (z + 0.5) * h > (2.5 if base == "freeze" else 2.0):
                self.assertAlmostEqual(layer[z][1], -above, delta=0.005 * weight)
                self.assertAlmostEqual(layer[z][2], 0.0, delta=1e-6 * weight)
                checked += 1
            above += 0.5 * h * layer[z][0] * 10
        self.assertEqual(checked, 38 if base == "freeze" else 40)
        if base == "plane":    # the force of the plane takes over in the middle of the range
            self.assertAlmostEqual((layer[3][1] + layer[4][1]) / (-2 * weight), 0.5, delta=0.05)
            self.assertAlmostEqual(layer[0][1], 0.0, delta=0.05 * weight)

    def test_group_averages_and_one_value(self):
        self.make()
        more = ("group some id <= 60\ngroup others subtract all some\n" + field("cxx density", group="some") +
                field("cxx density", group="others").replace("field", "rest") + field("cxx density").replace("field", "both") +
                field("density").replace("field", "one") +
                "compute cell all property/grid 9 8 7 id\ndump field all grid 50 fields c_cell:grid:data c_field:grid:data[*] c_rest:grid:data[*] c_both:grid:data[*] c_one:grid:data\n"
                "dump_modify field format float %.17g\n"
                "fix mean all ave/grid 50 1 50 9 8 7 c_field:grid:data[1] c_one:grid:data\n"
                "dump mean all grid 50 means c_cell:grid:data f_mean:grid:data[*]\ndump_modify mean format float %.17g\n")
        self.run_lammps(self.scene(more), np=2)
        cells, means = read_grid(self.path("fields"))[-1], read_grid(self.path("means"))[-1]
        for row, mean in zip(cells, means, strict=True):
            self.assertAlmostEqual(row[0] + row[2], row[4], delta=1e-8 * abs(row[4]) + 1e-9)
            self.assert_close(row[1] + row[3], row[5], 1e-12)
            self.assertEqual((row[0], row[6]), mean)
            self.assertEqual(row[5], row[6])

    def test_boxes_that_change_and_balancing(self):
        self.make()
        more = ("fix flat all deform 10 x scale 0.95 remap none\nfix share all balance 20 1.0 shift xyz 5 1.05\n" +
                field("density cxx") + output() + SUMS)
        densities = []
        for np in (1, 4):
            log = self.run_lammps(self.scene(more, move="nve/sphere", steps=100), np=np).log
            steps = read_grid(self.path("fields"))
            volume = SIZE**3 / math.prod(CELLS)
            mass = math.fsum(s.density * math.pi / 6 * s.diameter**3 for s in self.spheres)
            for factor, cells, row in zip((1.0, 0.975, 0.95), steps, thermo(log), strict=True):
                self.assert_close(factor * volume * math.fsum(row[0] for row in cells), mass, 1e-12)
                # nve/sphere has moved velocities since the forces of stress/atom
                self.assert_close(factor * volume * math.fsum(row[1] for row in cells), row["c_sums[1]"], 1e-3)
            densities.append([row[0] for cells in steps for row in cells])
        for one, other in zip(*densities, strict=True):
            self.assertAlmostEqual(one, other, delta=1e-3)    # trajectories in such a box differ by rounding

    def test_behind_a_run(self):
        """The contacts of its last step."""
        self.make()
        columns = "c_cell:grid:data c_field:grid:data"
        write = f"write_dump all grid {{}} {columns} modify format float %.17g\n"
        computes = field("cxx") + "compute cell all property/grid 9 8 7 id\n"
        for np in 1, 2:
            self.run_lammps(self.scene(computes, pair=STOCK) + write.format("stock"), np=np)
            self.assertGreater(max(abs(row[0]) for row in read_grid(self.path("stock"))[-1]), 0.0)
            last = self.scene(computes + f"dump field all grid 50 during {columns}\ndump_modify field format float %.17g\n")
            self.run_lammps(last + write.format("behind"), np=np)
            self.run_lammps(self.scene(computes) + write.format("unasked"), np=np)
            frames = [read_grid(self.path(name))[-1] for name in ("during", "behind", "unasked")]
            self.assertEqual(frames[0], frames[1])
            self.assertEqual(frames[0], frames[2])

    def test_errors(self):
        self.make()
        cases = [("compute f all coarse/grid 4 4\n", "compute coarse/grid: missing Nz", None),
                 (field(cells=(0, 8, 8)), r"expected Nx \(a whole number >= 1\) instead of '0'", "0"),
                 (field(width=-1), "expected width W", "-1"),
                 (field(values=""), "missing a value, e.g. density", None),
                 (field(values="density vq"), "unknown value 'vq', expected number, density, fraction", "vq"),
                 (field(cells=(1, 8, 1), width=0.45), "the width 0.45 is less than the edge 0.5 of the cells along y", None),
                 (field(width=2.5), "the width 2.5 is more than half the period 4 along x", None)]
        for k, (more, message, word) in enumerate(cases):
            for np in (1, 2) if k % 3 == 0 else (1,):
                with self.subTest(message, np=np):
                    result = self.run_lammps(self.scene(more), np=np, expect_error=True)
                    self.assertRegex(result.log, message)
                    if word:
                        self.assertEqual(marked_word(result.log), word)
        result = self.run_lammps(self.scene(field("cxx") + output(columns=""), pair="pair_style none"), expect_error=True)
        self.assertRegex(result.log, "compute coarse/grid: no contact stress: there is no pair style")
        self.run_lammps(self.scene(field("density vx") + output(), pair="pair_style zero 1.0\npair_coeff * *"))
        result = self.run_lammps("region b prism 0 1 0 1 0 1 0.1 0 0\natom_style sphere\ncreate_box 1 b\n" + field(),
                                 expect_error=True)
        self.assertRegex(result.log, "requires 'dimension 3' and a box that is not triclinic")
        for np in 1, 2:
            result = self.run_lammps("boundary f f f\nregion b block 0 1 0 1 0 1\natom_style sphere\ncreate_box 1 b\n"
                                     + field(width=1e3), np=np, expect_error=True)
            self.assertRegex(result.log, "nearer to it than the width 1000 have .* numbers: take less cells or a smaller width")
        result = self.run_lammps("region b block 0 1 0 1 0 1\ncreate_box 1 b\n" + field(), expect_error=True)
        self.assertRegex(result.log, "compute coarse/grid requires atom attributes radius and rmass: use 'atom_style sphere'")


if __name__ == "__main__":
    unittest.main()
