#!/usr/bin/env python3
# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=20 timeout=300 stay
"""Pair styles gran/* with the suffix talus against the stock styles: the same script, with and without -sf talus."""

import itertools
import os
import random
import unittest
from unittest import mock

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

    def one(self, suffix, name, np=1, threads=1, stay=True, **options):
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
                               env={"OMP_NUM_THREADS": threads}, stay=stay)

    def assert_equal_states(self, one, other, tolerance, columns=None):
        frames, others = (read_dump(self.path(f"{n}/state")) for n in (one, other))
        self.assertEqual(len(frames), len(others))
        for a, b in zip(frames, others):
            self.assertEqual(a.step, b.step)
            for column in columns or a.columns[1:]:
                scale = a.largest(c for c in a.columns if c[:2] == column[:2])
                self.assertLessEqual(max_difference(a, b, [column]), tolerance * max(scale, 1e-300),
                                     f"{column} at step {a.step}, largest {a.largest([column])}")

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
        self.assertIn("not needed here", ours.log)
        self.assertNotIn("not needed here", stock.log)
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


    def test_collisions(self):
        """1000 steps: no farther from stock than stock is from itself on two ranks, in a box that is moved by a rounding
        error."""
        box = ((0.0, 6.0),) * 3
        spheres = packing(120, box, sizes=(0.7, 1.0))
        for s in spheres:
            s.v = tuple(4 * v for v in s.v)
        self.scene(spheres, box)
        options = dict(boundary="p p p", local=False, every=1000, run="run 1000")
        for name in ("hooke", "hooke/history", "hertz/history"):
            pair = f"pair_style {STYLES[name]}\npair_coeff * *"
            shift = "displace_atoms all move 3e-15 3e-15 3e-15"
            for folder, suffix, np, more in (("one", False, 1, ""), ("two", False, 2, shift), ("ours", True, 1, "")):
                self.one(suffix, folder, np, pair=pair, more=more, **options)
            one, two, ours = (read_dump(self.path(f"{n}/state"))[-1] for n in ("one", "two", "ours"))
            self.assertEqual(one.step, 1000)
            moved = max_difference(read_dump(self.path("one/state"))[0], one, ["xu", "yu", "zu"])
            self.assertGreater(moved, 1.0)
            spread = max_difference(one, two, ["xu", "yu", "zu"])
            difference = max_difference(one, ours, ["xu", "yu", "zu"])
            print(f"{name}: {difference:.2e} from stock, stock {spread:.2e} from itself")
            self.assertLessEqual(difference, max(10 * spread, 1e-10))

    def test_energies_and_contacts_of_computes(self):
        self.scene(packing(150, self.BOX, sizes=(0.3, 0.9), types=2), self.BOX)
        more = ("compute number all contact/atom\ncompute numbers all reduce sum c_number\n"
                "compute fabric all fabric radius contact force/normal force/tangential\nfix print all ave/time 1 1 1 c_numbers c_fabric[*] "
                "file fabric format ' %.15g'")
        for name in ("hooke", "hooke/history"):
            self.compare(f"pair_style {STYLES[name]}\npair_coeff * *", more=more, run="run 3", local=False)
            rows = []
            for folder in "stock", "ours":
                with open(self.path(f"{folder}/fabric")) as file:
                    rows.append([list(map(float, line.split())) for line in file if line[0] != "#"])
            self.assertGreater(rows[0][0][1], 10)
            for a, b in zip(*rows):
                for x, y in zip(a, b):
                    self.assertAlmostEqual(x, y, delta=1e-11 * max(1.0, abs(x)))

    def test_pouring(self):
        """Particles to come count for the cutoffs."""
        self.scene(packing(20, self.BOX, sizes=(0.1, 0.2)), self.BOX)
        more = ("region slot block 0.5 2.5 0.5 2.5 2.0 3.0\nfix weight all gravity 1.0 vector 0 0 -1\n"
                "velocity all set 0 0 0\nfix rain all pour 30 1 4767548 region slot diam range 0.3 0.5\n"
                "fix floor all wall/gran hooke 2000.0 NULL 10.0 NULL 0.5 1 zplane 0.0 NULL")
        self.compare(f"pair_style {STYLES['hooke/history']}\npair_coeff * *", 1e-9, more=more, run="run 1200",
                     every=300, local=False, boundary="p p f")

    def test_minimize(self):
        self.scene(packing(100, self.BOX, sizes=(0.5, 0.9)), self.BOX)
        self.compare(f"pair_style {STYLES['hooke']}\npair_coeff * *", 1e-9, local=False, boundary="s s s",
                     before="min_style fire", run="velocity all set 0 0 0\nminimize 0 0 5 5")


class TestStock(Case):
    """What is not accelerated is computed by the stock methods."""
    BOX = TestForces.BOX

    def check(self, pair, **options):
        stock = self.one(False, "stock", pair=pair, local=False, **options)
        ours = self.one(True, "ours", pair=pair, local=False, **options)
        self.assert_equal_states("stock", "ours", 1e-12)
        self.assert_equal_thermo(stock, ours, 1e-12)
        return ours.log

    def test_second_style_of_hybrid(self):
        self.scene(packing(150, self.BOX, sizes=(0.3, 0.9), types=2), self.BOX)
        log = self.check(f"pair_style hybrid {STYLES['hooke/history']} {STYLES['hertz/history']}\n"
                         "pair_coeff * * gran/hooke/history\npair_coeff 2 2 gran/hertz/history", run="run 5")
        self.assertIn("Talus gran/hooke/history", log)
        self.assertNotIn("Talus gran/hertz/history", log)

    def test_narrow_periodic_box(self):
        box = ((0.0, 1.7), (0.0, 3.0), (0.0, 3.0))
        self.scene(packing(60, box, sizes=(0.5, 0.9)), box)
        pair = "pair_style {}\npair_coeff * *".format
        self.assertNotIn("Talus gran", self.check(pair(STYLES["hooke/history"]), boundary="p p p", run="run 3"))
        self.assertIn("Talus gran", self.check(pair(STYLES["hooke"]), boundary="p p p", run="run 3"))

    def test_units(self):
        self.scene(packing(150, self.BOX, sizes=(0.3, 0.9)), self.BOX)
        log = self.check(f"pair_style {STYLES['hooke']}\npair_coeff * *", units="metal",
                         run="timestep 1e-8\nrun 3")
        self.assertNotIn("Talus gran", log)

    def test_fix_that_migrates(self):
        self.scene(packing(150, self.BOX, sizes=(0.3, 0.9)), self.BOX)
        log = self.check(f"pair_style {STYLES['hooke']}\npair_coeff * *", run="run 3",
                         before="fix even all balance 100 1.0 shift x 5 1.0")
        self.assertNotIn("Talus gran", log)

    def test_two_accelerated_or_penalty(self):
        self.scene(packing(20, self.BOX, sizes=(0.3, 0.9)), self.BOX)
        self.assertIn("used only once", self.run_lammps(SCRIPT.format(
            units="lj", dimension=3, boundary="f f f", newton="on", processors="", before="", disc="", more="", every=1,
            data=self.path("data"), dump_local="", run="run 0", pair=
            f"pair_style hybrid/overlay {STYLES['hooke']} gran/penalty\npair_coeff * * gran/hooke\n"
            "pair_coeff * * gran/penalty hooke 1 1"), arguments=["-sf", "talus"], expect_error=True).log)


class TestRestart(Case):
    BOX = TestForces.BOX
    CONTINUE = """
newton on
read_restart {file}
neighbor 0.1 bin
fix step all nve/sphere
thermo 20
dump state all custom 20 state id xu yu zu vx vy vz fx fy fz tqx tqy tqz
dump_modify state format float %.17g first yes
run 40
"""

    def setUp(self):
        self.scene(packing(150, self.BOX, sizes=(0.3, 0.9), types=2), self.BOX)

    def continued(self, name, suffix, file, np):
        os.makedirs(self.path(name))
        return self.run_lammps(self.CONTINUE.format(file=file), np=np, cwd=self.path(name),
                               arguments=["-sf", "talus"] if suffix else [], stay=False)

    @mock.patch.dict(os.environ, MALLOC_PERTURB_="0")    # stock reads limit_damping unset behind read_restart
    def test_crossing(self):
        """The histories of one are those of the other: a run continued by either is that of stock without an interruption."""
        columns = ["xu", "yu", "zu", "vx", "vy", "vz", "fx", "fy", "fz", "tqx", "tqy", "tqz"]
        for style, boundary in (("hooke/history", "s s s"), ("hertz/history", "p p p"), ("hooke", "s s s")):
            for np in 1, 2:
                with self.subTest(style=style, np=np):
                    options = dict(pair=f"pair_style {STYLES[style]}\npair_coeff * *", boundary=boundary, local=False,
                                   every=20, run="run 40\nwrite_restart restart\nrun 40", stay=False)
                    tag = f"-{style.replace('/', '-')}-{np}"
                    self.one(False, "stock" + tag, np, **options)
                    self.one(True, "ours" + tag, 3 - np, **options)
                    whole = read_dump(self.path(f"stock{tag}/state"))
                    for writer in "stock", "ours":
                        for suffix in False, True:
                            name = f"{writer}-{suffix}{tag}"
                            log = self.continued(name, suffix, self.path(f"{writer}{tag}/restart"), np).log
                            self.assertEqual("Talus gran" in log, suffix)
                            if style != "hooke":
                                self.assertRegex(log, "fix style: (NEIGH_HISTORY|CONTACT_STORE)")
                            # at its first step a run has other forces than the one before at its last
                            for frame in read_dump(self.path(f"{name}/state"))[1:]:
                                same, = [w for w in whole if w.step == frame.step]
                                for kind in ("xyz", "v", "f", "t"):
                                    group = [c for c in columns if c[0] in kind]
                                    scale = max(max(map(abs, same.column(c).values())) for c in group)
                                    self.assertLessEqual(max_difference(frame, same, group), 1e-10 * scale,
                                                         f"{name} {kind} step {frame.step}")

    def test_in_a_process_that_has_had_other_pair_styles(self):
        """LAMMPS numbers them, and histories in files by these numbers."""
        columns = ["vx", "vy", "vz", "fx", "fy", "fz", "tqx", "tqy", "tqz"]
        for style in "hooke/history", "hertz/history":
            for np in 1, 2:
                with self.subTest(style=style, np=np):
                    name = f"{style.replace('/', '-')}-{np}"
                    self.one(True, "written-" + name, np, pair=f"pair_style {STYLES[style]}\npair_coeff * *", boundary="s s s",
                             local=False, every=20, run="run 40\nwrite_restart restart", stay=False)
                    script = self.CONTINUE.format(file=self.path(f"written-{name}/restart"))
                    os.makedirs(self.path(name))
                    self.run_lammps(script.replace("20 state", "20 first") + "clear\n" + script, np=np, cwd=self.path(name),
                                    arguments=["-sf", "talus"], stay=False)
                    for first, again in zip(read_dump(self.path(f"{name}/first")), read_dump(self.path(f"{name}/state"))):
                        self.assertEqual(max_difference(first, again, columns), 0.0)


if __name__ == "__main__":
    unittest.main()
