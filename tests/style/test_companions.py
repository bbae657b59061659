# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: procs=2
"""gran/penalty together with other commands of the host, each time against the stock style with the same law
in the same script, on 2 ranks."""

import os
import random
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "lib"))
from talus_testing import (SceneCase, Sphere, max_difference, read_dump, read_local, thermo,
                           write_sphere_data)

STOCK = "pair_style gran/hooke/history 3000.0 NULL 20.0 NULL 0.5 1\npair_coeff * *"
TALUS = "pair_style gran/penalty\npair_coeff * * hooke 3000.0 20.0 tangential multistep NULL NULL 0.5"
WALL = "hooke/history 3000.0 NULL 20.0 NULL 0.5 1"

SCRIPT = """
units lj
{before}
boundary {boundary}
{atom_style}
atom_modify map yes
newton off
comm_modify vel yes
read_data grains
{box}
group base type 2
group grains type 1
{pair}
neighbor 0.3 bin
neigh_modify every 1 delay 0 check yes
timestep 0.001
fix gravity all gravity 2.0 vector {gravity} -1
thermo 100
thermo_modify norm no lost error
{commands}
run {steps}
write_dump all custom state id type diameter x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz &
    modify format float %.17g
"""
MOVE, FREEZE = "fix step grains nve/sphere", "fix hold base freeze"
BED = f"{MOVE}\n{FREEZE}\nneigh_modify exclude group base base"
EVEN = ("dist", "force", "eng", "p4")    # of a contact: same from both sides
MOTION = "x y z vx vy vz omegax omegay omegaz".split()

SCENES = {    # commands; other options of AgainstStock.script()
    "freeze": (BED, {}),
    "frozen particles that are not excluded": (f"{MOVE}\n{FREEZE}", {}),
    "neigh_modify exclude type": (f"{BED}\nneigh_modify exclude type 1 2", {}),
    "fix move wiggle": (f"{MOVE}\nfix hold base move wiggle 0.2 0 0.05 0.4", {}),
    "fix move linear, frozen": (f"{MOVE}\nfix belt base move linear 0.5 0 0\n{FREEZE}", {}),
    "fix rigid/small": (f"""{FREEZE}
fix which all property/atom i_clump
variable clump atom 1+floor(x)+6*floor(y)+36*floor((z-0.975)/1.9)
set type 1 i_clump v_clump
fix step grains rigid/small custom i_clump""", {}),
    "fix rigid of one big clump": (f"""{FREEZE}
region half block -1 3 INF INF INF INF
group clump region half
group clump clear
group upper region half
group clump intersect upper grains
group single subtract grains clump
fix step single nve/sphere
fix clump clump rigid single
neigh_modify exclude group clump clump""", {}),
    "wall/gran zplane": (f"{MOVE}\nfix wall grains wall/gran {WALL} zplane 0.9 NULL\n{FREEZE}", {}),
    "wall/gran/region": (f"{BED}\nregion tube cylinder z 3 3 2.6 -5 12 side in\n"
                         f"fix wall grains wall/gran/region {WALL} region tube", {}),
    "fix pour": (f"{BED}\nregion slab block 0.8 5.2 0.8 5.2 7.1 10 units box\n"
                 "fix pour grains pour 30 1 4767 vol 0.3 100 diam range 0.8 1.9 region slab vel 0 0 0 0 -9", {"gravity": "0 0"}),
    "fix deposit": (f"{BED}\nregion slab block 0.8 5.2 0.8 5.2 7.1 10 units box\n"
                    "fix drop grains deposit 10 1 20 4767 region slab near 1.2 vz -9 -9", {}),
    "fix adapt diameter": (f"{BED}\nvariable size equal 1.05-0.0004*step\n"
                           "fix grow grains adapt 1 atom diameter v_size",
                           {"atom_style": "atom_style sphere 1"}),
    "fix adapt diameter, mass kept": (f"{BED}\nvariable size equal 1.05-0.0004*step\n"
                                      "fix grow grains adapt 5 atom diameter v_size mass no",
                                      {"atom_style": "atom_style sphere 1"}),
    "special_bonds without bonds": (f"{BED}\nspecial_bonds lj 0.1 0.2 0.3", {}),
    "balance and fix balance": (f"balance 1.0 z 0.3\n{BED}\n"
                                "fix even all balance 20 1.0 shift xz 5 1.0", {}),
    "comm_style tiled": (f"{BED}\nfix even all balance 20 1.0 rcb", {"box": "comm_style tiled"}),
    "neighbor multi": (f"{BED}\nneighbor 0.3 multi\ncomm_modify mode multi vel yes", {}),
    "neighbor nsq": (f"{BED}\nneighbor 0.3 nsq", {}),
    "fix deform": (f"{BED}\nfix shear all deform 1 x scale 0.97 y erate 0.1 remap v", {}),
    "fix deform of a tilted box": (f"{BED}\nfix shear all deform 1 xy erate 0.4 remap v",
                                   {"box": "change_box all triclinic"}),
    "minimize": (f"{BED}\nmin_style quickmin\nminimize 0 0 20 20\nreset_timestep 0", {}),
}


def grains():
    """Three layers of a frozen base (type 2) and loose grains of one sixth more height (type 1)."""
    draw = random.Random(3)
    found = []
    for k in range(7):
        for site in ((i, j) for i in range(6) for j in range(6)):
            x = tuple(s + 0.5 + draw.uniform(-0.1, 0.1) for s in (*site, 0.95 * k))
            motion = [tuple(draw.gauss(0, 1.0) for _ in "xyz") for _ in "vw"]
            if k < 1:
                found.append(Sphere(x, diameter=draw.uniform(0.9, 1.1), type=2))
            else:
                found.append(Sphere(x, *motion, diameter=draw.uniform(0.85, 1.15), type=1))
    draw.shuffle(found)
    return found


class BedCase(SceneCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), ((0, 6), (0, 6), (-2, 14)), grains())

    def simulate(self, pair, commands, np=2, steps=200, atom_style="atom_style sphere", before="",
                 box="", gravity="0.3 0.1",
                 boundary="p p f", **options):
        self.log = self.run_lammps(SCRIPT.format(
            pair=pair, commands=commands, steps=steps, box=box, atom_style=atom_style,
            before=before, gravity=gravity, boundary=boundary), np=np, **options).log
        frame, = read_dump(self.path("state"))
        os.remove(self.path("state"))
        return frame

    def assert_same_motion(self, frame, reference, limit=1e-9):
        self.assertEqual(sorted(frame.atoms), sorted(reference.atoms))
        found = max_difference(frame, reference, MOTION)
        self.assertLess(found, limit)
        return found


class Scenes(BedCase):

    def test_scenes(self):
        for name, (commands, options) in SCENES.items():
            with self.subTest(name):
                expected = self.simulate(STOCK, commands, **options)
                found = self.assert_same_motion(self.simulate(TALUS, commands, **options), expected)
                print(f"{name:45}{len(expected.atoms):5} particles, largest difference {found:.1e}")


    def test_contacts_of_poured_particles_are_found(self):
        """The largest ones are poured: the cutoff must know them before they exist."""
        commands, options = SCENES["fix pour"]
        frame = self.simulate(TALUS, commands, **options)
        poured = [row for row in frame.atoms.values() if row[0] > 252]
        touched = [row for row in poured if row[8] > -8.9]    # slower than it was poured with
        self.assertGreater(max(row[2] for row in touched), 1.3)


def contacts(frame, names):
    """{(lower tag, higher tag): values} as the particle with the lower tag sees them."""
    found = {}
    for row in frame.rows:
        a, b, *values = row[1:]
        sign = 1.0 if a < b else -1.0
        found[min(a, b), max(a, b)] = [v if name in EVEN else sign * v
                                       for name, v in zip(names, values)]
    return found


class Output(BedCase):
    """What the host asks a pair style for."""

    def test_pair_local(self):
        names = "dist force eng fx fy fz p1 p2 p3 p4 p5 p6 p7 p8 p9 p10".split()
        found = []
        for pair in STOCK, TALUS:
            self.simulate(pair, f"""{FREEZE}
fix step grains nve/sphere/symplectic
neigh_modify exclude group base base
compute ends all property/local patom1 patom2 cutoff radius
compute contact all pair/local {' '.join(names)} cutoff radius
dump contacts all local 40 contacts index c_ends[*] c_contact[*]
dump_modify contacts format float %.17g""", steps=40)
            found.append(contacts(read_local(self.path("contacts"))[-1], names))
        expected, mine = found
        self.assertEqual(sorted(mine), sorted(expected))
        self.assertGreater(len(expected), 200)
        self.assertGreater(sum(values[9] > 1.0 for values in expected.values()), 100)    # friction
        for n, name in enumerate(names):
            size = max(abs(values[n]) for values in expected.values()) or 1.0
            wrong = max(abs(mine[key][n] - expected[key][n]) for key in expected)
            self.assertLess(wrong, 1e-10 * size, name)

    def test_contact_and_fabric_computes(self):
        found = []
        for pair in STOCK, TALUS:
            self.simulate(pair, f"""{BED}
compute touch all contact/atom
compute touching all reduce sum c_touch
compute fabric all fabric radius contact branch force/normal force/tangential
compute stress all stress/atom NULL
compute stresses all reduce sum c_stress[*]
thermo_style custom step pxx pyy pzz pxy pxz pyz c_touching c_fabric[*] c_stresses[*]
thermo_modify format float %.17g""")
            found.append(thermo(self.log)[-1])
        for key, value in found[0].items():
            self.assert_close(found[1][key], value, 1e-9, key)

    def test_rerun(self):
        """Forces recomputed from positions and velocities of a dump."""
        record = f"{BED}\ndump steps all custom 50 steps id x y z vx vy vz\n" \
                 "dump_modify steps format float %.17g"
        self.simulate(STOCK, record)
        found = []
        for pair in STOCK, TALUS:
            self.simulate(pair, f"""{BED}
dump forces all custom 50 forces id fx fy fz
dump_modify forces format float %.17g
rerun steps first 50 dump x y z vx vy vz
undump forces""", steps=0)
            found.append(read_dump(self.path("forces")))
        self.assertGreaterEqual(len(found[0]), 4)
        for expected, mine in zip(*found):
            self.assertLess(max_difference(mine, expected, ("fx", "fy", "fz")), 1e-9)


class Variants(BedCase):
    """The same bed with other laws, other sub-styles, another way to run."""

    def compare(self, stock, talus, commands=BED, **options):
        expected = self.simulate(stock, commands, **options)
        self.assert_same_motion(self.simulate(talus, commands, **options), expected)

    def test_coefficients_by_type(self):
        kinds = {(1, 1): "3000.0 {k} 20.0 {g} 0.5", (1, 2): "4000.0 {k} 30.0 {g} 0.1",
                 (2, 2): "5000.0 {k} 40.0 {g} 0.3"}
        stock = "pair_style hybrid" + "".join(
            f" gran/hooke/history {words.format(k='NULL', g='NULL')} 1" for words in kinds.values())
        for n, types in enumerate(kinds, start=1):
            stock += f"\npair_coeff {types[0]} {types[1]} gran/hooke/history {n}"
        talus = "pair_style gran/penalty"
        for (i, j), words in kinds.items():
            kn, kt, gn, gt, mu = words.format(k="NULL", g="NULL").split()
            talus += f"\npair_coeff {i} {j} hooke {kn} {gn} tangential multistep {kt} {gt} {mu}"
        self.compare(stock, talus)
        # 1 2 from 1 1 and 2 2: arithmetic mean, friction by the rule
        for rule, mu in (("min", 0.3), ("arithmetic", 0.4), ("geometric", 0.15 ** 0.5)):
            lines = talus.splitlines()
            mixed = "\n".join([lines[0] + " mix " + rule, lines[1], lines[3]])
            self.compare(stock.replace("0.1 1", f"{mu!r} 1"), mixed)

    def test_different_laws_in_one_scene(self):
        """hertz between grains, frictionless hooke with the base."""
        self.compare("pair_style hybrid gran/hertz/history 9000.0 NULL 20.0 NULL 0.5 1 "
                     "gran/hooke 3000.0 NULL 20.0 0.0 0.0 0\npair_coeff * 2 gran/hooke\n"
                     "pair_coeff 1 1 gran/hertz/history",
                     "pair_style gran/penalty\npair_coeff * 2 hooke 3000.0 20.0\n"
                     "pair_coeff 1 1 hertz 9000.0 20.0 tangential multistep NULL NULL 0.5")

    def test_hybrid_overlay(self):
        soft = "soft 1.2\npair_coeff * * soft 5.0"
        stock = STOCK.replace("gran", "hybrid/overlay gran", 1).replace("* *", "* * gran/hooke/history")
        talus = TALUS.replace("gran", "hybrid/overlay gran", 1).replace("* *", "* * gran/penalty")
        self.compare(stock, talus)
        with_soft = [pair.replace("\n", f" {soft}\n", 1) for pair in (stock, talus)]
        self.compare(*with_soft)
        soft_first = [pair.replace("overlay ", f"overlay soft 1.2 ", 1) + "\npair_coeff * * soft 5.0"
                      for pair in (stock, talus)]
        self.compare(*soft_first)

    def test_omp_suffix(self):
        expected = self.simulate(STOCK, BED)
        found = self.simulate(TALUS, BED, arguments=("-sf", "omp", "-pk", "omp", "2"),
                              env={"OMP_NUM_THREADS": 2})
        self.assert_same_motion(found, expected)

    def test_two_dimensions(self):
        flat = [Sphere((x.x[0], x.x[2], 0), (x.v[0], x.v[2], 0), (0, 0, x.omega[2]), x.diameter,
                       type=x.type) for x in grains() if x.x[1] < 1]
        write_sphere_data(self.path("grains"), ((0, 6), (-2, 14), (-0.5, 0.5)), flat)
        self.compare(STOCK, TALUS, f"{BED}\nfix flat all enforce2d", before="dimension 2",
                     boundary="p f p")


class BetweenRuns(BedCase):
    """Commands between two runs; the history of contacts that stay must stay."""

    MOVE = f"fix step grains nve/sphere/symplectic\n{FREEZE}\nneigh_modify exclude group base base\n"
    DELETE = "group gone id 5:250:6\ngroup gone intersect gone grains\ndelete_atoms group gone"

    def in_place(self, pair, between):
        """Motion by place in space, so that IDs do not matter."""
        frame = self.simulate(pair, f"{self.MOVE}run 30\n{between}", steps=60)
        k = [frame.columns.index(c) for c in MOTION]
        return sorted(tuple(row[n] for n in k) for row in frame.atoms.values())

    def difference(self, run, other):
        self.assertEqual(len(run), len(other))
        return max(abs(a - b) for row, twin in zip(run, other) for a, b in zip(row, twin))

    def check(self, between, stock_between):
        expected = self.in_place(STOCK, stock_between)
        self.assertLess(self.difference(self.in_place(TALUS, between), expected), 1e-9)
        lost = self.in_place(TALUS, f"{between}\npair_style none\nrun 0\n{TALUS}")
        self.assertGreater(self.difference(lost, expected), 1e-4)    # the test can tell

    def test_delete_atoms(self):
        """The stock style loses history with `compress yes`, the default."""
        stock = self.DELETE + " compress no"
        self.check(stock, stock)
        self.check(self.DELETE, stock)

    def test_reset_atoms_id(self):
        self.check("reset_atoms id sort yes", "")
        self.check("reset_atoms id", "")

    def test_commands_that_move_particles_between_ranks(self):
        for between in ("balance 1.0 z 0.4", "run 0", "write_restart r", "write_data d",
                        "set type 1 density 1.0", "change_box all boundary p p f"):
            with self.subTest(between):
                self.check(between, "")

    def test_another_pair_style_and_back(self):
        """History ends with the style; nothing of it comes back."""
        other = STOCK.replace("hooke/history", "hooke")
        frames = [self.in_place(pair, f"{other}\nrun 10\n{pair}") for pair in (STOCK, TALUS)]
        self.assertLess(self.difference(*frames), 1e-9)

    def test_another_law_and_back(self):
        none = "pair_coeff * * hooke 3000.0 20.0"
        with_law = self.in_place(TALUS, f"{none}\nrun 10\n{TALUS.splitlines()[1]}")
        with_style = self.in_place(TALUS, f"{none}\nrun 10\npair_style none\nrun 0\n{TALUS}")
        self.assertLess(self.difference(with_law, with_style), 1e-9)


if __name__ == "__main__":
    unittest.main()
