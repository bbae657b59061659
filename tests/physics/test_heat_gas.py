# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300 cost=20
"""Heat through gas: a cubic bed against resistances in a row; grains that fly about, against a slow twin that looks at all pairs, with
the same bits on any ranks and threads; heat that goes in is stored or goes out."""

import math
import random
import unittest

from body_meshes import write_stl
from talus_testing import SceneCase, Sphere, head, read_dump, thermo, write_sphere_data

K, GAS, COLUMN, REACH = 20.0, 0.026, 0.5, 0.4
YOUNG, POISSON = 1e6, 0.3
LAW = f"hertz/material {YOUNG} 0.9 {POISSON}"
HEAT = f"heat gas {K} {GAS} {COLUMN} {REACH}"


def conductance(gap, one, other=None):
    """Power over difference of temperature; no other radius: a flat wall. The gap is below 0 where they overlap."""
    effective = one * other / (one + other) if other else one
    radius, alpha = 2 * effective, K / GAS
    if gap >= REACH * radius:
        return 0.0
    a = math.sqrt(effective * max(0.0, -gap))
    lam, beta = alpha**2 * max(0.0, gap) / radius, alpha * a / radius
    f = 50 + 8 * math.sqrt(lam) + lam + 40 * beta + 2.4 * beta**2
    column = COLUMN * min(one, other or one)
    return 2 * K * a + math.pi * GAS * radius * math.log(1 + (alpha * column / radius)**2 / f)


BED = head("si", "p p f") + """
fix therm all property/atom temperature heatflow ghost yes
read_data data
pair_style gran/penalty
pair_coeff * * {law}
neighbor {skin} bin
timestep {dt}
set group all temperature 300
variable hot equal {hot}
fix lo all large/body {floor} contact {law} temperature v_hot {more}
fix hi all large/body plane 0 0 {height} 0 0 -1 contact {law} temperature 300
fix heat all heat/flow constant 500
thermo_style custom step f_lo[21] f_hi[21] {columns}
thermo_modify format float %.17g
thermo {every}
compute t all property/atom temperature
dump grains all custom {every} grains id c_t
dump_modify grains sort id format float %.17g
run {steps}
"""


class CubicBed(SceneCase):
    """3 by 3 columns of 6 spheres; neighbors beside have the same temperature."""

    RADIUS, DENSITY, SIDE, LAYERS = 1e-3, 2500.0, 3, 6

    def bed(self, gap, floor="plane 0 0 0 0 0 1", more="", columns="", law=f"{LAW} {HEAT}", hot="350", dt=0.05, steps=6000, every=6000, **options):
        pitch = 2 * self.RADIUS + gap
        height = (self.LAYERS - 1) * pitch + 2 * (self.RADIUS + gap)
        side = self.SIDE * pitch
        spheres = [Sphere(((i + 0.5) * pitch, (j + 0.5) * pitch, self.RADIUS + gap + k * pitch), density=self.DENSITY, diameter=2 * self.RADIUS)
                   for i in range(self.SIDE) for j in range(self.SIDE) for k in range(self.LAYERS)]
        write_sphere_data(self.path("data"), ((0, side), (0, side), (-1e-3, height + 1e-3)), spheres)
        log = self.run_lammps(BED.format(law=law, floor=floor, more=more, hot=hot, height=height, columns=columns, dt=dt, steps=steps,
                                         every=every, skin=3e-4), **options).log
        frames = [frame.column("c_t") for frame in read_dump(self.path("grains"))]
        return frames, thermo(log)

    def good_step(self, largest):
        """A tenth of the heat capacity of a sphere over this conductance: 6000 steps are many times what the bed needs."""
        return 0.1 * 500 * self.DENSITY * 4 / 3 * math.pi * self.RADIUS**3 / largest

    def test_conductivity(self):
        for gap in 2e-4, 2e-5, 0.0, -4e-6:
            with self.subTest(gap=gap):
                between, at_wall = conductance(gap, self.RADIUS, self.RADIUS), conductance(gap, self.RADIUS)
                expected = self.SIDE**2 * 50 / (2 / at_wall + (self.LAYERS - 1) / between)
                frames, rows = self.bed(gap, dt=self.good_step(at_wall))
                tolerance = 1e-7 if gap else 1e-5    # H has a root of the gap, which is of the size of rounding then
                self.assertAlmostEqual(rows[-1]["f_lo[21]"] / -expected, 1, delta=tolerance)
                self.assertAlmostEqual(rows[-1]["f_hi[21]"] / expected, 1, delta=tolerance)
                # of the bed without its walls
                last = frames[-1]
                pitch, drop = 2 * self.RADIUS + gap, last[1] - last[self.LAYERS]
                found = expected / (self.SIDE * pitch)**2 * (self.LAYERS - 1) * pitch / drop
                self.assertAlmostEqual(found * pitch / between, 1, delta=tolerance)
                print(f"\ngap {gap:g}: conductivity {found / GAS:.3f} times that of the gas, alpha {K / GAS:.0f}")

    def test_mesh(self):
        """A floor of triangles, seen through the gap, is a plane; heat goes through the triangles."""
        gap = 1e-4
        (*_, plane), rows = self.bed(gap, steps=400, every=400)
        side = self.SIDE * (2 * self.RADIUS + gap)
        corners = [(0, 0, 0), (side, 0, 0), (side, side, 0), (0, side, 0)]
        write_stl(self.path("floor.stl"), [(corners[0], corners[1], corners[2]), (corners[0], corners[2], corners[3])])
        (*_, mesh), of_mesh = self.bed(gap, "mesh floor.stl", "pressure yes", "f_lo[1][4] f_lo[2][4]", steps=400, every=400)
        for one, other in zip(plane.values(), mesh.values(), strict=True):
            self.assertAlmostEqual(one, other, delta=1e-9)
        flow = of_mesh[-1]["f_lo[21]"]
        self.assertAlmostEqual(flow, rows[-1]["f_lo[21]"], delta=1e-9 * abs(flow))
        self.assertAlmostEqual(side**2 / 2 * (of_mesh[-1]["f_lo[1][4]"] + of_mesh[-1]["f_lo[2][4]"]), flow, delta=1e-9 * abs(flow))

    def test_modulus_of_the_grains(self):
        """The circle is that of the real grains, the rest of the gas the same."""
        overlap = 4e-6
        ratio = ((YOUNG / (1 - POISSON**2)) / (6e10 / (1 - 0.04)))**(1 / 3)
        # an overlap of this size has the same circle
        between, at_wall = (conductance(-overlap * ratio**2, self.RADIUS, other) for other in (self.RADIUS, None))
        _, rows = self.bed(-overlap, law=f"{LAW} {HEAT} modulus 6e10 0.2", dt=self.good_step(at_wall))
        expected = self.SIDE**2 * 50 / (2 / at_wall + (self.LAYERS - 1) / between)
        self.assertAlmostEqual(rows[-1]["f_hi[21]"] / expected, 1, delta=1e-6)

    def test_what_goes_in_stays_or_goes_out(self):
        for np in 1, 2:
            frames, rows = self.bed(5e-5, hot="300+10*step*dt", dt=0.02, steps=300, every=1, np=np)
            gone = 0.02 * math.fsum(row["f_lo[21]"] + row["f_hi[21]"] for row in rows[1:])
            mass = self.DENSITY * 4 / 3 * math.pi * self.RADIUS**3
            stored = 500 * mass * (math.fsum(frames[-1].values()) - math.fsum(frames[0].values()))
            self.assertGreater(stored, 0.01)
            self.assertAlmostEqual(-gone / stored, 1, delta=1e-10)

    def test_neighbor_lists_of_lammps(self):
        """They know of spheres that touch."""
        self.bed(1e-4, steps=1)
        script = self.read("in.script").replace("pair_style gran/penalty", "pair_style hybrid/overlay gran/penalty zero 0.001")
        result = self.run_lammps(script.replace("pair_coeff * * hertz", "pair_coeff * * zero\npair_coeff * * gran/penalty hertz"),
                                 expect_error=True)
        self.assertIn("heat gas acts beyond the neighbor lists of LAMMPS, which are used because of pair style hybrid", result.log)

    def test_what_touches_only_after_it_has(self):
        result = self.run_lammps(BED.split("set group")[0].format(law=f"jkr 1e6 0.9 0.3 0.1 {HEAT}", skin=3e-4, dt=1.0)
                                 .replace("read_data data", "region b block 0 1 0 1 0 1\ncreate_box 1 b"), expect_error=True)
        self.assertIn("jkr only after they have", result.log)


FLYING = head("si", "p p f") + """
fix therm all property/atom temperature heatflow ghost yes
read_data data
pair_style gran/penalty
pair_coeff * * {law}
neighbor 0.0004 bin
timestep 1e-5
{style}
fix step all nve/sphere/symplectic
fix lo all large/body plane 0 0 0 0 0 1 contact {law} temperature 500
fix hi all large/body plane 0 0 {height} 0 0 -1 contact {law} temperature 300
variable start atom 300+x*1e4
set group all temperature v_start
fix heat all heat/flow constant 5
compute t all property/atom temperature heatflow
compute s all penalty/stats
thermo_style custom step f_lo[1] f_lo[21] f_hi[21] c_s[2]
thermo_modify format float %.17g
thermo 150
dump grains all custom 150 {out} id radius x y z vx vy vz c_t[1] c_t[2]
dump_modify grains sort id format float %.17g
run 300
"""


class FlyingGrains(SceneCase):

    SIDE, HEIGHT, DT = 0.012, 0.018, 1e-5

    def fly(self, out, style="", **options):
        grains, generator = [], random.Random(5)
        for i in range(5):
            for j in range(5):
                for k in range(7):
                    place = tuple(2.4e-3 * n + 1.2e-3 + generator.uniform(-3e-4, 3e-4) for n in (i, j, k))
                    grains.append(Sphere(place, tuple(generator.uniform(-0.3, 0.3) for _ in range(3)), density=2000.0,
                                         diameter=2 * generator.uniform(0.6e-3, 0.95e-3)))
        write_sphere_data(self.path("data"), ((0, self.SIDE), (0, self.SIDE), (-1e-3, self.HEIGHT)), grains)
        law = f"{LAW} tangential multistep NULL NULL 0.4 {HEAT}"
        log = self.run_lammps(FLYING.format(law=law, out=out, style=style, height=7 * 2.4e-3), **options).log
        with open(self.path(out)) as file:
            return file.read(), log

    def twin(self, frame):
        """Heat flows by particle, into both walls, and the number of contacts, by looking at all pairs."""
        ids = list(frame.atoms)
        column = {key: frame.column(key) for key in ("radius", "x", "y", "z", "c_t[1]", "c_t[2]")}
        r, flow, walls, contacts = column["radius"], dict.fromkeys(ids, 0.0), [0.0, 0.0], 0
        mass = {i: 2000.0 * 4 / 3 * math.pi * r[i]**3 for i in ids}
        # before the step was over
        t = {i: column["c_t[1]"][i] - self.DT * column["c_t[2]"][i] / (5 * mass[i]) for i in ids}

        def nearest(d):
            return d - self.SIDE * round(d / self.SIDE)
        for n, i in enumerate(ids):
            for j in ids[:n]:
                d = math.hypot(nearest(column["x"][i] - column["x"][j]), nearest(column["y"][i] - column["y"][j]), column["z"][i] - column["z"][j])
                power = conductance(d - r[i] - r[j], r[i], r[j]) * (t[j] - t[i])
                flow[i] += power
                flow[j] -= power
                contacts += d < r[i] + r[j]
            for wall, (gap, warm) in enumerate(((column["z"][i] - r[i], 500.0), (7 * 2.4e-3 - column["z"][i] - r[i], 300.0))):
                power = conductance(gap, r[i]) * (warm - t[i])
                contacts += gap < 0
                flow[i] += power
                walls[wall] -= power
        return flow, walls, contacts

    def test_all_pairs_within_reach_conduct(self):
        _, log = self.fly("one")
        frame = read_dump(self.path("one"))[-1]
        flow, walls, contacts = self.twin(frame)
        scale = max(abs(f) for f in flow.values())
        self.assertGreater(scale, 0.0)
        for i, found in frame.column("c_t[2]").items():
            self.assertAlmostEqual(found, flow[i], delta=1e-9 * scale)
        row = thermo(log)[-1]
        self.assertAlmostEqual(row["f_lo[21]"], walls[0], delta=1e-9 * abs(walls[0]))
        self.assertAlmostEqual(row["f_hi[21]"], walls[1], delta=1e-9 * abs(walls[1]))
        # gaps are no contacts
        self.assertGreater(contacts, 10)
        self.assertEqual(row["c_s[2]"], contacts)

    def test_same_bits(self):
        first, _ = self.fly("one")
        for np, threads in (2, 1), (4, 1), (1, 2), (2, 2):
            for style in "", "run_style verlet/stock":
                with self.subTest(ranks=np, threads=threads, style=style):
                    self.assertEqual(self.fly("other", style, np=np, env={"OMP_NUM_THREADS": str(threads)})[0], first)


if __name__ == "__main__":
    unittest.main()
