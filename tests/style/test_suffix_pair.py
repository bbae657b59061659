#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""Pair styles gran/* with the suffix talus against the stock styles: the same script, with and without -sf talus."""

import itertools
import os
import random
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "lib"))
from talus_testing import (SceneCase, Sphere, max_difference, read_dump, read_local, thermo,
                           write_sphere_data)

STYLES = {
    "hooke": "gran/hooke 2000.0 NULL 10.0 NULL 0.5 1",
    "hooke undamped": "gran/hooke 2000.0 500.0 10.0 70.0 0.5 0",
    "hooke/history": "gran/hooke/history 2000.0 NULL 10.0 NULL 0.5 1",
    "hooke/history undamped": "gran/hooke/history 2000.0 1500.0 10.0 70.0 0.2 0",
    "hooke/history limit_damping": "gran/hooke/history 2000.0 1500.0 60.0 30.0 0.3 1 limit_damping",
    "hertz/history": "gran/hertz/history 10000.0 NULL 10.0 NULL 0.5 1",
    "hertz/history undamped": "gran/hertz/history 10000.0 9000.0 10.0 70.0 0.2 0",
    "hertz/history limit_damping": "gran/hertz/history 10000.0 8000.0 100.0 90.0 0.3 1 limit_damping",
}

SCRIPT = """
units {units}
dimension {dimension}
boundary {boundary}
newton {newton}
atom_style sphere
atom_modify map yes
comm_modify vel yes
{processors}
read_data {data}
{before}
{pair}
neighbor 0.1 bin
neigh_modify every 1 delay 0 check yes
timestep 0.001
fix step all nve/sphere{disc}
{more}
compute stress all stress/atom NULL
compute local all pair/local dist fx fy fz p1 p2 p3 p4 p5 p6 p7 p8 p9 p10
compute pairs all property/local patom1 patom2
thermo_style custom step pe ke press pxx pyy pzz pxy pxz pyz
thermo_modify format float %.17g norm no
thermo {every}
dump state all custom {every} state.* id xu yu zu vx vy vz fx fy fz tqx tqy tqz c_stress[*]
dump_modify state format float %.17g first yes
{dump_local}
{run}
"""

LOCAL = """dump local all local {every} local.* index c_pairs[*] c_local[*]
dump_modify local format float %.17g first yes"""


def packing(count, box, flat=False, sizes=(0.1, 1.0), types=1, seed=1):
    """Spheres that overlap a little, in motion."""
    rng = random.Random(seed)
    spheres = []
    while len(spheres) < count:
        d = sizes[0] if len(spheres) % 4 else sizes[1]
        d *= rng.uniform(0.8, 1.0)
        x = tuple(rng.uniform(lo, hi) for lo, hi in box)
        if flat:
            x = x[:2] + (0.0,)
        touching = [(sum((a - b)**2 for a, b in zip(x, s.x))**0.5, s) for s in spheres]
        overlaps = [0.5 * (d + s.diameter) - r for r, s in touching]
        if any(o > 0.1 * min(d, s.diameter) for o, (_, s) in zip(overlaps, touching)):
            continue
        if spheres and not any(o > 0 for o in overlaps) and rng.random() < 0.7:
            continue
        v = [rng.gauss(0, 0.5) for _ in range(6)]
        if flat:
            v[2] = v[3] = v[4] = 0.0
        spheres.append(Sphere(x, tuple(v[:3]), tuple(v[3:]), d, type=1 + len(spheres) % types))
    return spheres


class Case(SceneCase):
    def scene(self, spheres, box, types=None):
        write_sphere_data(self.path("data"), box, spheres, types)

    def one(self, suffix, name, np=1, threads=1, **options):
        settings = dict(units="lj", dimension=3, boundary="f f f", newton="on", processors="", before="",
                        disc="", more="", every=1, run="run 1", data=self.path("data"), pair="", local=True)
        settings.update(options)
        local = settings.pop("local")
        settings["dump_local"] = LOCAL.format(**settings) if local else ""
        cwd = self.path(name)
        os.makedirs(cwd, exist_ok=True)
        text = SCRIPT.format(**settings)
        text = text.replace("state.*", "state").replace("local.*", "local")
        return self.run_lammps(text, np=np, cwd=cwd, arguments=["-sf", "talus"] if suffix else [],
                               env={"OMP_NUM_THREADS": threads})

    def assert_equal_states(self, one, other, tolerance, columns=None):
        frames, others = (read_dump(self.path(f"{n}/state")) for n in (one, other))
        self.assertEqual(len(frames), len(others))
        for a, b in zip(frames, others):
            self.assertEqual(a.step, b.step)
            for column in columns or a.columns[1:]:
                largest = max(map(abs, a.column(column).values()))
                group = [c for c in a.columns if c[:2] == column[:2]]
                scale = max(max(map(abs, a.column(c).values())) for c in group)
                self.assertLessEqual(max_difference(a, b, [column]), tolerance * max(scale, 1e-300),
                                     f"{column} at step {a.step}, largest {largest}")

    def assert_equal_thermo(self, one, other, tolerance):
        for a, b in zip(thermo(one.log), thermo(other.log)):
            scale = max(abs(a[k]) for k in a if k.startswith("P") and k != "PotEng")
            for key in a:
                self.assertLessEqual(abs(a[key] - b[key]), tolerance * max(abs(a[key]), scale), key)

    def assert_equal_pairs(self, one, other, tolerance):
        def by_pair(frame):
            found = {}
            for row in frame.rows:
                i, j = int(row[1]), int(row[2])
                sign = 1 if i < j else -1
                values = list(row[3:])
                # force, friction and velocities change sign with the order of the two
                for k in (1, 2, 3, 4, 5, 6, 8, 9, 10, 11, 12, 13):
                    values[k] *= sign
                found.setdefault((min(i, j), max(i, j)), values)
            return found
        frames, others = (read_local(self.path(f"{n}/local")) for n in (one, other))
        self.assertEqual(len(frames), len(others))
        for a, b in zip(map(by_pair, frames), map(by_pair, others)):
            self.assertEqual(a.keys(), b.keys())
            touching = [k for k in a if any(a[k][1:])]
            self.assertGreater(len(touching), 5)
            scales = [max(abs(a[k][n]) for k in a) for n in range(14)]
            for key in a:
                for n in range(14):
                    self.assertLessEqual(abs(a[key][n] - b[key][n]), tolerance * max(scales[n], 1e-300),
                                         f"column {n} of {key}: {a[key]} {b[key]}")


class TestForces(Case):
    BOX = ((0.0, 3.0), (0.0, 3.0), (0.0, 3.0))

    def compare(self, pair, tolerance=1e-12, np=1, threads=1, **options):
        stock = self.one(False, "stock", np, threads, pair=pair, **options)
        ours = self.one(True, "ours", np, threads, pair=pair, **options)
        self.assertIn("left out", ours.log)
        self.assertNotIn("left out", stock.log)
        self.assert_equal_states("stock", "ours", tolerance)
        self.assert_equal_thermo(stock, ours, tolerance)
        if options.get("local", True):
            self.assert_equal_pairs("stock", "ours", tolerance)
        return stock, ours

    def test_all_styles_and_both_newton_settings(self):
        self.scene(packing(150, self.BOX, sizes=(0.1, 0.9), types=3), self.BOX)
        for (name, words), newton in itertools.product(STYLES.items(), ("on", "off")):
            with self.subTest(style=name, newton=newton):
                self.compare(f"pair_style {words}\npair_coeff * *", newton=newton, run="run 3")

    def test_ranks_and_threads(self):
        self.scene(packing(150, self.BOX, sizes=(0.1, 0.9), types=2), self.BOX)
        for np, threads in ((2, 1), (1, 2), (2, 2)):
            for newton in ("on", "off"):
                with self.subTest(ranks=np, threads=threads, newton=newton):
                    self.compare(f"pair_style {STYLES['hertz/history']}\npair_coeff * *", np=np, threads=threads,
                                 newton=newton, run="run 3")

    def test_periodic_box(self):
        self.scene(packing(200, self.BOX, sizes=(0.3, 0.7)), self.BOX)
        for np in (1, 2):
            self.compare(f"pair_style {STYLES['hooke/history']}\npair_coeff * *", np=np, boundary="p p p", run="run 3",
                         local=np == 1)

    def test_two_dimensions(self):
        box = ((0.0, 4.0), (0.0, 4.0), (-0.5, 0.5))
        self.scene(packing(120, box, flat=True, sizes=(0.1, 0.6)), box)
        for name in ("hooke", "hooke/history", "hertz/history"):
            self.compare(f"pair_style {STYLES[name]}\npair_coeff * *", dimension=2, boundary="f f p",
                         more="fix flat all enforce2d", run="run 3")

    def test_frozen_particles(self):
        self.scene(packing(150, self.BOX, sizes=(0.1, 0.9), types=2), self.BOX)
        more = "group some type 2\nfix ice some freeze\nvelocity some set 0 0 0\nset group some omega 0 0 0"
        for name in ("hooke", "hooke/history", "hertz/history"):
            self.compare(f"pair_style {STYLES[name]}\npair_coeff * *", more=more, run="run 3")

    def test_frozen_particles_and_exclusion(self):
        self.scene(packing(150, self.BOX, sizes=(0.1, 0.9), types=2), self.BOX)
        more = "group some type 2\nfix ice some freeze\nvelocity some set 0 0 0\nneigh_modify exclude group some some"
        self.compare(f"pair_style {STYLES['hooke/history']}\npair_coeff * *", more=more, run="run 3", local=False)

    def test_rigid_bodies(self):
        self.scene(packing(150, self.BOX, sizes=(0.4, 0.9), types=3), self.BOX)
        more = ("group body id 1:6\ngroup other id 7:12\nfix glue body rigid group 1 body\nneigh_modify exclude group body "
                "body\nunfix step\ngroup free id 13:150\nfix step free nve/sphere")
        self.compare(f"pair_style {STYLES['hooke/history']}\npair_coeff * *", more=more, run="run 3", local=False)

    def test_hybrid(self):
        self.scene(packing(150, self.BOX, sizes=(0.3, 0.9), types=2), self.BOX)
        for newton, np in itertools.product(("on", "off"), (1, 2)):
            self.compare(f"pair_style hybrid/overlay zero 1.0 {STYLES['hooke/history']}\npair_coeff * * zero\n"
                         "pair_coeff * * gran/hooke/history", run="run 3", newton=newton, np=np, local=False)
            self.compare(f"pair_style hybrid zero 1.0 {STYLES['hertz/history']}\npair_coeff * * zero\n"
                         "pair_coeff 1 2 gran/hertz/history", run="run 3", newton=newton, np=np, local=False)

    def test_several_runs_and_time_steps(self):
        """Between two runs the stock styles apply the Coulomb limit with the new velocities."""
        self.scene(packing(150, self.BOX, sizes=(0.3, 0.9), types=2), self.BOX)
        run = "run 20\nrun 20\ntimestep 0.0005\nrun 20\nrun 20 pre no\nvelocity all scale 0.1\nrun 20"
        for name in ("hooke/history", "hooke/history limit_damping", "hertz/history"):
            self.compare(f"pair_style {STYLES[name]}\npair_coeff * *", 1e-10, run=run, local=False, every=10,
                         boundary="s s s")

    def test_units_with_pressure(self):
        self.scene(packing(150, self.BOX, sizes=(0.3, 0.9)), self.BOX)
        self.compare(f"pair_style {STYLES['hertz/history']}\npair_coeff * *", units="micro", run="run 3")


if __name__ == "__main__":
    unittest.main()
