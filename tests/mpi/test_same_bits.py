# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=65 timeout=300 stay
"""One trajectory: the same bits on any ranks, threads, grid, balance, skin, rebuild setting, sorting, restart.

The scene is a heap that collapses when a wall is taken away; the reference is one uninterrupted run
on one rank.  Compared at several steps are position, velocity, spin and stress of every particle, and
force, overlap and friction (so the history) of every contact; -0 counts as 0.  The stock style in the
same scene is the negative control."""

import itertools
import os
import random
import re
import shutil
import tempfile
import unittest

from talus_testing import (SceneCase, Sphere, part_of, read_dump, read_local, run_lammps,
                           write_sphere_data)

BOX = ((-1, 25), (-1, 11), (-1, 22))
STEPS, EVERY = 1200, 400     # beyond step 1000, where the order of sums is renewed
LAW = "hertz 4000.0 40.0 tangential multistep NULL NULL 0.5"
PAIR = f"pair_style gran/penalty\npair_coeff * * {LAW}\n"
HYBRID = ("pair_style hybrid/overlay zero 0.1 gran/penalty\npair_coeff * * zero\n"
          f"pair_coeff * * gran/penalty {LAW}\n")
STOCK = "pair_style gran/hertz/history 4000.0 NULL 40.0 NULL 0.5 1\npair_coeff * *\n"

START = """
units lj
boundary f f f
atom_style sphere
atom_modify map yes sort {sort}
newton {newton}
comm_modify vel yes
processors {grid}
{comm}
"""
REBUILDS = "neighbor {skin} bin\nneigh_modify {rebuild}\n"

# a floor, three walls that stay and one that is taken away
PHYSICS = f"""
timestep 0.001
fix step all nve/sphere/symplectic gravity 4.0 vector 0.1 0.05 -1.0
fix floor all large/body plane 0 0 0  0 0 1  contact {LAW}
fix xlo all large/body plane 0 0 0  1 0 0  contact {LAW}
fix ylo all large/body rectangle 12 0 9  0 1 0  1 0 0  26 30  contact {LAW}
fix yhi all large/body rectangle 12 10 9  0 -1 0  1 0 0  26 30  contact {LAW}
"""
GATE = f"fix xhi all large/body plane 11 0 0  -1 0 0  contact {LAW}\n"
OUTPUT = f"""
compute stress all stress/atom NULL
compute ends all property/local patom1 patom2 cutoff radius
compute contact all pair/local dist force p1 p2 p3 p4 p5 p6 p7 p8 p9 p10 {{more}} cutoff radius
thermo {EVERY}
dump atoms all custom {EVERY} atoms.* id x y z vx vy vz omegax omegay omegaz c_stress[*] proc
dump_modify atoms format float %a
dump contacts all local {EVERY} contacts.* index c_ends[*] c_contact[*]
dump_modify contacts format float %a
"""


def start(sort="1000 0", grid="* * *", comm="", newton="off"):
    return START.format(sort=sort, grid=grid, comm=comm, newton=newton)


def rebuilds(skin=0.1, rebuild="every 1 delay 0 check yes"):
    return REBUILDS.format(skin=skin, rebuild=rebuild)


def physics(middle="", overlap="p11"):
    return PHYSICS + middle + OUTPUT.format(more=overlap)


def grains():
    """A jittered lattice of spheres; neighbors in space are not neighbors by number."""
    draw = random.Random(1)
    sites = [(i, j, k) for k in range(15) for j in range(9) for i in range(10)]
    draw.shuffle(sites)
    return [Sphere(tuple(1.1 * s + 0.7 + draw.uniform(-0.1, 0.1) for s in site),
                   diameter=draw.uniform(0.7, 1.2)) for site in sites]


# ---- what is compared ------------------------------------------------------------------------

def bits(value):
    return value + 0.0    # -0 + 0 = 0: numbers that are equal then have the same bits


def contact_bits(row):
    """(tags, bits) of a contact as the particle with the lower tag sees it."""
    a, b, dist, force, *p = row[1:]
    sign = 1.0 if a < b else -1.0
    values = [dist, force, p[3], *(sign * v for v in p[0:3] + p[4:10]), *p[10:]]
    return (min(a, b), max(a, b)), tuple(map(bits, values))


def snapshot(folder, step):
    atoms, = read_dump(os.path.join(folder, f"atoms.{step}"))
    contacts, = read_local(os.path.join(folder, f"contacts.{step}"))
    return {"particles": {tag: tuple(map(bits, row[:-1])) for tag, row in atoms.atoms.items()},
            "contacts": dict(map(contact_bits, contacts.rows))}


def ranks_of(folder, step):
    return read_dump(os.path.join(folder, f"atoms.{step}"))[0].column("proc")


def count_in(pattern, log):
    return sum(map(int, re.findall(pattern + r" = (\d+)", log)))


HOME, EXPECTED = None, {}    # folder with the settled heap; {step: snapshot}


def scene(pair=PAIR, neighbors=rebuilds(), middle="", run=f"run {STEPS}\n", overlap="p11", **options):
    return (start(**options) + f"read_data {HOME}/heap\n" + neighbors + pair +
            physics(middle, overlap) + run)


def setUpModule():
    global HOME
    HOME = tempfile.mkdtemp(prefix="talus-same-bits-")
    unittest.addModuleCleanup(shutil.rmtree, HOME, ignore_errors=True)
    write_sphere_data(os.path.join(HOME, "start"), BOX, grains())
    run_lammps(start() + "read_data start\n" + rebuilds() + PAIR + PHYSICS + GATE +
               "fix drag all viscous 0.4\nrun 6000\nwrite_data heap\n", cwd=HOME)
    run_lammps(scene(), cwd=HOME)
    EXPECTED.update({s: snapshot(HOME, s) for s in range(0, STEPS + 1, EVERY)})


class HeapCase(SceneCase):

    def run_in(self, name, script, np=1, **options):
        """Runs in a new folder self.dir/name: no file of another run can be taken for its result."""
        os.mkdir(self.path(name))
        return self.run_lammps(script, np=np, cwd=self.path(name), **options).log

    def assert_same(self, name, steps=(0, STEPS)):
        for step in steps:
            found = snapshot(self.path(name), step)
            for what, expected in EXPECTED[step].items():
                self.assertEqual(sorted(found[what]), sorted(expected), f"{what} at step {step}")
                wrong = [key for key in expected if found[what][key] != expected[key]]
                self.assertEqual(wrong, [], f"{len(wrong)} of {len(expected)} {what} differ at {step}")

    def check(self, name, np, **options):
        with self.subTest(name, np=np):
            log = self.run_in(f"{name}-{np}", scene(**options), np)
            self.assert_same(f"{name}-{np}")
            self.assertEqual(count_in("Dangerous builds", log), 0)


class SameBits(HeapCase):

    def test_the_scene_is_demanding(self):
        log = self.run_in("ranks", scene(), 4)
        before, after = ranks_of(self.path("ranks"), 0), ranks_of(self.path("ranks"), STEPS)
        moved = sum(before[tag] != after[tag] for tag in before)
        contacts = {step: 2 * len(s["contacts"]) / len(s["particles"])
                    for step, s in EXPECTED.items()}
        builds = count_in("Neighbor list builds", log)
        print(f"{len(before)} particles; contacts per particle",
              ", ".join(f"{n:.2f} at step {step}" for step, n in contacts.items()),
              f"; {builds} rebuilds; {moved} particles end on another of 4 ranks")
        self.assertGreaterEqual(min(contacts.values()), 3.0)
        self.assertGreaterEqual(builds, 20)
        self.assertGreaterEqual(moved, 50)

    def test_ranks_skins_and_sorting(self):
        default, often, never = "1000 0", "1 0.7", "0 0"
        settings = (0.05, default), (0.1, often), (0.1, never), (0.3, default), (0.3, often)
        for np, (skin, sort) in part_of(itertools.product((1, 2, 4), settings), 2):
            self.check(f"skin {skin} sort {sort}", np, neighbors=rebuilds(skin), sort=sort)

    def test_rebuild_settings(self):
        settings = "every 1 delay 0 check no", "every 7 delay 0 check no", "delay 5"
        for rebuild, np in part_of(itertools.product(settings, (1, 4)), 2, 1):
            self.check(rebuild, np, neighbors=rebuilds(0.3, rebuild))

    def test_processor_grids(self):
        for grid in part_of(("4 1 1", "2 2 1", "1 4 1", "1 2 2", "1 1 4", "2 1 2"), 2):
            self.check(grid, 4, grid=grid)
        self.check("3 1 1", 3, grid="3 1 1")

    def test_newton(self):
        for np in part_of((4, 1, 2), 2):
            self.check("newton on", np, newton="on")

    def test_threads(self):
        for np, threads in part_of(((2, 2), (1, 2), (3, 3), (1, 3), (8, 1)), 2):
            self.check(f"threads {threads}", np, comm=f"package omp {threads}")
        self.check("threads by suffix", 2, comm="suffix omp\npackage omp 2")

    def test_load_balancing(self):
        """(The command `balance ... shift` itself rounds positions once: the host's doing.)"""
        self.check("balance x", 2, middle="balance 1.0 x 0.3\n", grid="2 1 1")
        self.check("fix balance shift", 2, middle="fix even all balance 100 1.0 shift xyz 10 1.0\n")
        self.check("fix balance shift", 4, middle="fix even all balance 37 1.0 shift xz 10 1.0\n")
        tiled = "balance 1.0 rcb\nfix even all balance 70 1.0 rcb\n"
        for np in part_of((4, 3, 2), 1):
            self.check("rcb", np, middle=tiled, comm="comm_style tiled")

    def test_hybrid_overlay(self):
        for np in 1, 4:
            self.check("hybrid", np, pair=HYBRID)

    def test_several_runs(self):
        self.check("runs", 2, run="run 300\nrun 400 pre no\nrun 300\nrun 1\nrun 0\nrun 499\n")

    def test_the_stock_style_differs(self):
        found = []
        for np in 1, 2, 4:
            self.run_in(f"stock-{np}", scene(pair=STOCK, overlap=""), np)
            found.append(snapshot(self.path(f"stock-{np}"), STEPS)["particles"])
        for other in found[1:]:
            different = sum(other[tag] != found[0][tag] for tag in other)
            self.assertGreater(different, len(other) // 2)


class Restart(HeapCase):
    """The pair style and its coefficients come from the restart file."""

    @staticmethod
    def rest(file, pair=""):
        return (start() + f"read_restart {file}\n" +
                rebuilds() + pair + physics() + f"run {STEPS} upto\n")

    def assert_same_after(self, step, name):
        self.assert_same(name, [s for s in EXPECTED if s >= step])

    def test_in_a_new_process_on_other_ranks(self):
        for step, before, after, pair in ((650, 1, 4, ""), (999, 4, 2, PAIR), (1000, 2, 1, "")):
            with self.subTest(step=step, before=before, after=after):
                self.run_in(f"first-{step}", scene(run=f"run {step}\nwrite_restart half\n"), before)
                self.run_in(f"then-{step}", self.rest(f"../first-{step}/half", pair), after)
                self.assert_same_after(step, f"then-{step}")

    def test_in_the_same_process(self):
        for np, pair in ((1, ""), (2, PAIR), (4, "")):
            with self.subTest(np=np):
                name = f"same-{np}"
                self.run_in(name, scene(run="run 650\nwrite_restart half\nclear\n") +
                            self.rest("half", pair), np)
                self.assert_same_after(650, name)

    def test_from_files_written_during_a_run(self):
        self.run_in("writer", scene(middle="restart 350 half.*\n"), 2)
        self.assert_same("writer")
        for step, np in ((350, 4), (1050, 1)):
            with self.subTest(step=step):
                self.run_in(f"reader-{step}", self.rest(f"../writer/half.{step}"), np)
                self.assert_same_after(step, f"reader-{step}")


if __name__ == "__main__":
    unittest.main()
