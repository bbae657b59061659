# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=25 timeout=400 stay
"""fix rigid/small/talus and rigid/small/symplectic: clumps of spheres. The numbers of the style of LAMMPS, and the same
bits on any number of ranks and threads, wherever a step is made, and through restarts."""

import math
import os
import unittest

from saved_scenes import CLUMP
from talus_testing import SceneCase, head, max_difference, read_dump, thermo
from tossed_clumps import FLAT_BOX, tossed_in_a_plane, write_clumps

MOTION = "x y z vx vy vz omegax omegay omegaz".split()
ALL = MOTION + "fx fy fz tqx tqy tqz".split()
RECORDS = "steps without output              in the records"
PAIR = "pair_style gran/hertz/history@ 20000 NULL 50 NULL 0.5 1\npair_coeff * *"
WALL = "wall/gran@ hertz/history 20000 NULL 50 NULL 0.5 1"

HEAD = head(boundary="p p f") + "{before}\n"
REST = """
group single type 2
group clumps type 1
{pair}
neighbor 0.2 bin
neigh_modify every 1 delay 0 check yes exclude molecule/intra clumps
timestep 0.0005
{gravity}
{move}
{floor}
{style}
thermo {every}
compute press all pressure NULL virial
thermo_style custom step f_move c_press
thermo_modify norm no lost error format float %.17g
dump all all custom {every} dump id {all}
dump_modify all format float %a sort id
{run}
write_dump all custom last id {all} modify format float %a sort id
"""
MOLECULES = "fix prop all property/atom mol ghost yes"
READ = f"{MOLECULES}\nread_data grains fix prop NULL Molecules"
TALUS = "fix move clumps rigid/small/talus molecule\nfix move2 single nve/sphere/talus"
STOCK = TALUS.replace("/talus", "")
SYMPLECTIC = """fix move clumps rigid/small/symplectic molecule start half gravity 10 vector 0.2 0 -1
fix move2 single nve/sphere/symplectic start half gravity 10 vector 0.2 0 -1"""
LAW = "hertz 2.0e4 50 tangential multistep NULL NULL 0.5 slider midpoint limit_damping"
SECOND = SYMPLECTIC.replace("start half", "order 2")
# the pair style and the floor
OF_SECOND = dict(pair=f"pair_style gran/penalty\npair_coeff * * {LAW}",
                 floor="\n".join(f"fix {n} all large/body plane 0 0 {z}  0 0 {up} contact {LAW}"
                                 for n, z, up in (("floor", 0, 1), ("roof", 9, -1))))
PROXY = "comm_proxy yes\nrun_style verlet/proxy"
GRAVITY = "fix fall all gravity@ 10 vector 0.2 0 -1"
MOVES = (TALUS, {}), (SYMPLECTIC, {}), (SECOND, OF_SECOND)


class ClumpCase(SceneCase):

    def setUp(self):
        write_clumps(self.path("grains"))

    def simulate(self, move=TALUS, np=1, threads=1, every=100, run="run 300", style=PROXY,
                 before="", read=READ, floor="fix floor all " + WALL + " zplane 0 9", pair=PAIR, suffix=None, gravity=None,
                 expect=RECORDS, **options):
        """The frames of the dump, and the state at the end."""
        suffix = ("" if move == STOCK else "/talus") if suffix is None else suffix
        gravity = ("" if "gravity" in move else GRAVITY) if gravity is None else gravity
        self.log = self.run_lammps((HEAD + read + REST).format(
            before=before, pair=pair.replace("@", suffix), move=move, floor=floor.replace("@", suffix), style=style,
            every=every, run=run, all=" ".join(ALL), gravity=gravity.replace("@", suffix)), np=np,
            env={"OMP_NUM_THREADS": str(threads)}, **options).log
        if suffix and expect:
            self.assertIn(expect, self.log)
        if options.get("expect_error"):
            return []
        frames = read_dump(self.path("dump")) + read_dump(self.path("last"))
        for name in "dump", "last":
            os.remove(self.path(name))
        return frames


class Clumps(ClumpCase):

    def test_the_numbers_of_lammps(self):
        ours, stock = self.simulate(), self.simulate(STOCK, style="")
        self.assertEqual(len(ours), 5)
        for a, b in zip(ours, stock):
            self.assertLess(max_difference(a, b, MOTION), 1e-10)
            self.assertLess(max_difference(a, b, ALL), 1e-8)
        self.assertGreater(max_difference(ours[0], ours[-1], ["x"]), 0.3)    # they have moved

    def test_virials_are_those_of_lammps(self):
        tables = []
        for move, style in (TALUS, PROXY), (STOCK, ""):
            self.simulate(move, every=50, style=style)
            tables.append([[float(w) for w in line.split()] for line in self.log.splitlines()
                           if len(line.split()) == 3 and line.split()[0].isdigit() and "." in line])
        self.assertEqual(len(tables[0]), 7)
        for a, b in zip(*tables):
            for x, y in zip(a, b):
                self.assertAlmostEqual(x, y, delta=1e-8 * (1 + abs(y)))

    def test_same_bits(self):
        """On ranks, threads, with overlap, and however often the arrays are looked at."""
        for move, rest in MOVES:
            reference = {f.step: f for f in self.simulate(move, every=1, style="run_style verlet", expect=None, **rest)}
            for np, threads, every, grid, overlap in ((1, 1, 7, "", ""), (1, 2, 100, "", ""), (2, 1, 100, "2 1 1", " overlap yes"),
                                                      (4, 1, 50, "1 2 2", " overlap no"), (3, 1, 1000, "3 1 1", "")):
                with self.subTest(move=move, ranks=np, threads=threads, every=every):
                    frames = self.simulate(move, np, threads, every, before=f"processors {grid}" if grid else "",
                                           style=PROXY + overlap, **rest)
                    for frame in frames:
                        self.assert_same_bits(frame, reference[frame.step])

    def test_a_box_that_deforms_takes_all_spheres_along(self):
        """Also those whose clump belongs to another rank."""
        deform = "fix drive all deform 1 x erate 0.3 remap x\n"
        stock = self.simulate(STOCK, np=2, style=deform, before="processors 2 1 1")
        for move in TALUS, SYMPLECTIC:
            reference = self.simulate(move, style=deform, expect=None)
            with self.subTest(move=move):
                for a, b in zip(self.simulate(move, 2, style=deform, before="processors 2 1 1", expect=None), reference, strict=True):
                    self.assert_same_bits(a, b)
            if move == TALUS:
                self.assertLess(max(max_difference(a, b, MOTION) for a, b in zip(reference, stock, strict=True)), 1e-8)

    def test_what_reads_each_step(self):
        """It finds clumps and their spheres complete, while steps go on in the records, also where one moves clumps alone."""
        reading = ("compute spin all property/atom omegax tqy\n"
                   "compute sums all reduce sum vx z fx c_spin[1] c_spin[2]\ncompute most all reduce max vz\n"
                   "fix say all print 1 '$(c_sums[1]:%.17g) $(c_sums[2]:%.17g) $(c_sums[3]:%.17g) $(c_sums[4]:%.17g) "
                   "$(c_sums[5]:%.17g) $(c_most:%.17g) $(f_move:%.17g)' file said screen no\n")
        for move, rest in MOVES:
            for np in 1, 2:
                with self.subTest(move=move, ranks=np):
                    found = []
                    for style, expect in ("run_style verlet/stock", None), ("run_style verlet", RECORDS):
                        frames = self.simulate(move, np, style=f"{reading}comm_proxy yes\n{style}", expect=expect, **rest)
                        found.append((frames, self.read("said")))
                    for a, b in zip(found[0][0], found[1][0], strict=True):
                        self.assert_same_bits(a, b)
                    self.assertEqual(found[0][1], found[1][1])

    def test_runs_and_restarts_go_on(self):
        """A new set-up would find the masses and axes anew, with other rounding."""
        restart = f"read_restart state.restart\n{MOLECULES}"
        for move, rest in MOVES:
            divided = self.simulate(move, np=2, run="run 170\nrun 130", **rest)[-1]
            if move != TALUS:    # velocity Verlet computes forces with other velocities in a set-up
                self.assert_same_bits(divided, self.simulate(move, **rest)[-1], MOTION)
            self.simulate(move, np=2, run="run 170\nwrite_restart state.restart", **rest)
            for np in 1, 4:
                found = self.simulate(move, np, run="run 130", read=restart, **rest)[-1]
                self.assert_same_bits(found, divided, MOTION)

    def test_a_fix_with_order_2_goes_on_where_one_beside_it_is(self):
        """Velocities of all particles are behind positions by the same time."""
        spheres = SECOND.splitlines()[1]
        whole = self.simulate(SECOND, **OF_SECOND)[-1]
        self.assertEqual(self.log.count("order 2: errors of all contacts are of second order"), 1)    # not for each fix
        for np in 1, 4:
            divided = self.simulate(SECOND, np, run=f"run 100\nunfix move2\n{spheres}\nrun 200", **OF_SECOND)[-1]
            self.assert_same_bits(divided, whole, MOTION)

    def test_what_contacts_take_does_not_depend_on_virials(self):
        """Energies need changes of velocities, which a step with a virial makes in two parts."""
        stats = "compute s all penalty/stats\nthermo_style custom step c_s[4] c_s[5] c_s[6]"
        tables = []
        for press in "", " c_press":
            self.simulate(every=20, run=f"{stats}{press}\nthermo_modify format float %.17g\nrun 300", **OF_SECOND)
            tables.append([[row[f"c_s[{n}]"] for n in (4, 5, 6)] for row in thermo(self.log)])
        self.assertEqual(*tables)
        self.assertGreater(tables[0][-1][1], 0.0)

    def test_a_file_of_bodies(self):
        """ID, mass, center, moments and products of inertia, velocity, angular momentum, periods."""
        with open(self.path("bodies"), "w") as file:
            file.write("2\n1 1.3 1.5 1.4 1.3 0.4 0.5 0.6 0.05 0.01 -0.02 1 2 -3 0.1 0.2 0.3 0 0 0\n"
                       "12 0.9 1.4 1.5 4.4 0.3 0.2 0.4 0 0.05 0 0 1 2 -0.1 0.4 0 0 0 0\n")
        infile = TALUS.replace("molecule", "molecule infile bodies")
        frames = self.simulate(infile), self.simulate(infile.replace("/talus", ""), style="", suffix="")
        for a, b in zip(*frames):
            self.assertLess(max_difference(a, b, MOTION), 1e-10)
        again = self.simulate(infile, np=2)
        self.assert_same_bits(frames[0][-1], again[-1])

    def test_commands_that_move_spheres_are_heeded(self):
        """They are rigid again, with the momentum that the command gave them."""
        change = "run 100\nvelocity all set 1 2 0.5\nrun 100"
        ours, stock = self.simulate(run=change), self.simulate(STOCK, run=change, style="")
        self.assertLess(max_difference(ours[-1], stock[-1], MOTION), 1e-9)

    def test_large_bodies(self):
        floor = """pair_coeff * *
fix floor all large/body plane 0 0 0  0 0 1  contact hertz 20000 50 tangential multistep NULL NULL 0.5
fix roof all large/body plane 0 0 9  0 0 -1  contact hertz 20000 50 tangential multistep NULL NULL 0.5"""
        frame = self.simulate(floor=floor)[-1]
        other = self.simulate(floor=floor, np=2)[-1]
        self.assert_same_bits(frame, other)
        stock = self.simulate(STOCK, floor=floor, suffix="/talus", expect=None)[-1]
        self.assertLess(max_difference(frame, stock, MOTION), 1e-9)

    def test_spheres_of_a_clump_keep_their_distances(self):
        for move in TALUS, SYMPLECTIC:
            first, *_, last = self.simulate(move, run="run 2000", every=1000)
            molecules = {}
            with open(self.path("grains")) as file:
                for line in file.read().split("Molecules")[1].split("\n"):
                    if line.strip():
                        tag, molecule = map(int, line.split())
                        molecules.setdefault(molecule, []).append(tag)
            del molecules[0]

            def distance(frame, a, b):
                rows = [frame.atoms[t] for t in (a, b)]
                k = frame.columns.index("x")
                d = [p - q for p, q in zip(rows[0][k:k + 3], rows[1][k:k + 3])]
                d = [v - 9 * round(v / 9) if n < 2 else v for n, v in enumerate(d)]
                return math.sqrt(sum(v * v for v in d))

            for a, b, c in molecules.values():
                for pair in (a, b), (b, c), (a, c):
                    self.assertAlmostEqual(distance(first, *pair), distance(last, *pair), delta=1e-12)


class ClumpsInAPlane(ClumpCase):

    def setUp(self):
        write_clumps(self.path("grains"), box=FLAT_BOX, toss=tossed_in_a_plane)

    def simulate(self, move=TALUS, np=1, threads=1, every=100, before="", style=PROXY, group="all", **options):
        def plane(y, up, law):
            return f"large/body plane 0 {y} 0  0 {up} 0 contact {law}"
        floor = f"fix floor all {WALL} yplane 0 15"
        if "order 2" in move:
            floor = f"fix floor all {plane(0, 1, LAW)}\nfix roof all {plane(15, -1, LAW)}"
        return super().simulate(move.replace("0.2 0 -1", "0.2 -1 0"), np, threads, every,
                                before=f"dimension 2\nboundary p f p\n{before}", floor=floor, gravity=None if "gravity" in move else
                                GRAVITY.replace("0.2 0 -1", "0.2 -1 0"), style=f"fix flat {group} enforce2d\n{style}", **options)

    def test_the_numbers_of_lammps(self):
        ours, stock = self.simulate(), self.simulate(STOCK, style="")
        for a, b in zip(ours, stock, strict=True):
            self.assertLess(max_difference(a, b, MOTION), 1e-10)
            self.assertLess(max_difference(a, b, ALL), 1e-8)
        self.assertGreater(max_difference(ours[0], ours[-1], ["x"]), 0.3)

    def test_same_bits(self):
        """Eight at a time as one by one, on ranks and threads, with fix enforce2d for all and for some."""
        for move, rest in (TALUS, {}), (SYMPLECTIC, {}), (SECOND, {"pair": OF_SECOND["pair"]}):
            for group in "all", "clumps":
                reference = {f.step: f for f in self.simulate(move, every=1, style="run_style verlet", expect=None, group=group, **rest)}
                for np, threads, every, grid in ((1, 1, 7, ""), (1, 2, 100, ""), (2, 1, 100, "2 1 1"), (4, 1, 50, "2 2 1")):
                    with self.subTest(move=move, group=group, ranks=np, threads=threads, every=every):
                        for frame in self.simulate(move, np, threads, every, before=f"processors {grid}" if grid else "",
                                                   group=group, **rest):
                            self.assert_same_bits(frame, reference[frame.step])

    def test_nothing_leaves_the_plane(self):
        for move in TALUS, SYMPLECTIC:
            frames = self.simulate(move)
            for name in "z", "vz", "omegax", "omegay", "fz", "tqx", "tqy":
                self.assertEqual({abs(x) for f in frames for x in f.column(name).values()}, {0.0}, name)


MIXED = head(boundary="p p f") + """
fix prop all property/atom mol ghost yes
read_data grains fix prop NULL Molecules
group shapes type 2
group clumps type 1
neighbor 0.2 bin
neigh_modify every 1 delay 0 check yes exclude molecule/intra clumps
pair_style gran/penalty
pair_coeff * * hertz 2.0e4 50 tangential multistep NULL NULL 0.5
timestep 0.0005
fix fall all gravity/talus 10 vector 0.2 0 -1
fix move clumps rigid/small/symplectic molecule start half
fix s shapes shape/gran type 2 box 0.8 0.7 0.6 density 1.0 orient random 4711
fix floor all large/body plane 0 0 0 0 0 1 contact hertz 2.0e4 50 tangential multistep NULL NULL 0.5
compute b all rigid/local move id mass x y z quatw quati quatj quatk angmomx angmomy angmomz
compute sum all reduce sum c_b[2] inputs local
thermo 100
thermo_style custom step c_sum
dump local all local 300 local.{np} index c_b[1] c_b[2] c_b[3] c_b[4] c_b[5] c_b[6] c_b[7] c_b[8] c_b[9]
{run}
write_dump all custom last id mol {all} modify format float %a sort id
"""


class ClumpsAndShapes(ClumpCase):

    def test_one_scene_has_both(self):
        """Clumps, and boxes among them: the same bits on ranks and in several runs; and what outputs tell of clumps."""
        frames = []
        for np, run in (1, "run 300"), (2, "run 300"), (4, "run 130\nrun 170"):
            log = self.run_lammps(MIXED.format(np=np, run=run, all=" ".join(ALL)), np=np).log
            self.assertNotIn("ERROR", log)
            frames += read_dump(self.path("last"))
        for frame in frames[1:]:
            self.assert_same_bits(frame, frames[0], MOTION)
        self.assertEqual(len(set(frames[0].column("mol").values())), 23)    # and 0 of the boxes
        rows = [[float(w) for w in line.split()] for line in self.read("local.1").split("c_b[9]")[-1].splitlines() if line.strip()]
        self.assertEqual(len(rows), 22)
        for row in rows:    # the mass of three spheres of density 1, by their diameters, and a quaternion
            self.assertAlmostEqual(row[2], math.pi / 6.0 * (1.0 + 0.9**3 + 0.8**3), delta=1e-5)
            self.assertAlmostEqual(sum(q * q for q in row[6:10]), 1.0, delta=1e-4)


FREE = head(boundary="p p p") + """
fix prop all property/atom mol ghost yes
read_data grains fix prop NULL Molecules
group which molecule 1
group others subtract all which
delete_atoms group others
neighbor 0.2 bin
neigh_modify exclude molecule/intra all
pair_style gran/penalty
pair_coeff * * hooke 1000 0 tangential multistep NULL 0 0.5
timestep 0.01
fix move all rigid/small/symplectic molecule
compute b all rigid/local move angmomx angmomy angmomz
compute l all reduce sum c_b[1] c_b[2] c_b[3] inputs local
compute ke all ke
compute er all erotate/sphere
variable e equal c_ke+c_er
thermo 5000
thermo_style custom step v_e c_l[1] c_l[2] c_l[3]
thermo_modify norm no format float %.17g
run 50000
"""


class FreeClump(ClumpCase):

    def test_free_rotation_keeps_energy_and_angular_momentum(self):
        log = self.run_lammps(FREE).log
        rows = [[float(w) for w in line.split()] for line in log.splitlines()
                if len(line.split()) == 5 and line.split()[0].isdigit() and "." in line]
        self.assertEqual(len(rows), 11)
        for row in rows:
            self.assertAlmostEqual(row[1] / rows[0][1], 1.0, delta=2e-4)
            for k in 2, 3, 4:
                self.assertAlmostEqual(row[k], rows[0][k], delta=1e-12)


ONE = head(boundary="p p f") + """
fix prop all property/atom mol ghost yes
region box block 0 9 0 9 0 9
create_box 1 box
molecule ball ball.mol
pair_style gran/penalty
pair_coeff * * hertz 20000 50 tangential multistep NULL NULL 0.5
neighbor 0.2 bin
timestep 0.0005
{move}
region top block 4 5 4 5 2 3
fix drop all deposit 1 0 1 4711 region top mol ball vx 1.5 1.5 vy 0.5 0.5 vz -5 -5 {rigid}
fix floor all large/body plane 0 4.5 0.5  0 0.1 1  contact hertz 20000 50 tangential multistep NULL NULL 0.5
thermo 500
thermo_modify lost error
run 1000
write_dump all custom last id {all} modify format float %a sort id
"""


class OneSphere(SceneCase):

    def test_a_clump_of_one_sphere_moves_as_that_sphere(self):
        self.write("ball.mol", "ball\n\n1 atoms\n\nCoords\n\n1 0 0 0\n\nTypes\n\n1 1\n\nDiameters\n\n1 1.0\n\nMasses\n\n1 0.7\n")
        frames = []
        for move, rigid in (("rigid/small/symplectic molecule mol ball start half gravity 10 vector 0 0 -1", "rigid move"),
                            ("nve/sphere/symplectic start half gravity 10 vector 0 0 -1", "")):
            self.run_lammps(ONE.format(move="fix move all " + move, rigid=rigid, all=" ".join(ALL)))
            frames += read_dump(self.path("last"))
        self.assertEqual(len(frames[0].atoms), 1)
        self.assertLess(max_difference(*frames, MOTION), 1e-12)
        self.assertGreater(abs(frames[0].column("omegay")[1]), 0.1)    # it has touched the floor


POUR = head(boundary="p p f") + """
fix prop all property/atom mol ghost yes
region box block 0 9 0 9 0 14
create_box 1 box
molecule clump clump.mol
pair_style gran/hertz/history{suffix} 20000 NULL 50 NULL 0.5 1
pair_coeff * *
neighbor 0.2 bin
neigh_modify every 1 delay 0 exclude molecule/intra all
timestep 0.0005
fix fall all gravity{suffix} 10 vector 0 0 -1
{before}
fix move all {style} molecule mol clump
region slab block 1 8 1 8 9 13
{insert}
fix floor all wall/gran{suffix} hertz/history 20000 NULL 50 NULL 0.5 1 zplane 0 NULL
thermo 500
thermo_style custom step
thermo_modify lost error
run 1800
{more}
write_dump all custom last id mol mass {all} modify format float %a sort id
"""
GIVEN = "1.1 mass\n0.3 0.25 0.05 com\n0.2 0.22 0.3 0.01 0.0 0.02 inertia\n"


class PouredClumps(SceneCase):

    def pour(self, style, suffix, np=1, more="", given="", before="",
             insert="fix pour all pour 12 0 4711 vol 0.3 50 region slab mol clump rigid move"):
        self.write("clump.mol", CLUMP.replace("3 atoms\n", f"3 atoms\n{given}"))
        self.log = self.run_lammps(POUR.format(style=style, suffix=suffix, more=more, before=before, insert=insert, all=" ".join(ALL)), np=np).log
        frame, = read_dump(self.path("last"))
        return frame

    def test_fix_pour(self):
        for given in "", GIVEN:
            ours = self.pour("rigid/small/talus", "/talus", given=given)
            self.assertEqual(len(ours.atoms), 36)
            self.assertIn(RECORDS, self.log)
            self.assert_same_bits(ours, self.pour("rigid/small/talus", "/talus", np=4, given=given))
            stock = self.pour("rigid/small", "", given=given)
            self.assertLess(max_difference(ours, stock, MOTION), 1e-7)

    def test_fix_deposit_and_create_atoms(self):
        some = "\n".join(f"create_atoms 0 single {x} {y} 3 mol clump {4711 + x}" for x, y in ((2, 2), (5, 2), (2, 6)))
        deposit = "fix drop all deposit 5 0 300 4711 region slab mol clump rigid move near 2.5 vz -3 -2"
        for given in "", GIVEN:
            words = dict(before=some, insert=deposit, given=given)
            ours = self.pour("rigid/small/talus", "/talus", **words)
            self.assertEqual(len(ours.atoms), 24)
            self.assert_same_bits(ours, self.pour("rigid/small/talus", "/talus", np=2, **words))
            self.assertLess(max_difference(ours, self.pour("rigid/small", "", **words), MOTION), 1e-7)

    def test_warnings_of_time_steps_know_the_mass_of_clumps_that_come(self):
        """With the mass of one sphere the first would have one."""
        for dt, warned in (0.004, False), (0.006, True):
            self.pour("rigid/small/talus", "/talus", before=f"timestep {dt}")
            self.assertEqual("of the critical one" in self.log, warned)

    def test_given_masses_stay_in_later_runs(self):
        once = self.pour("rigid/small/symplectic", "/talus", given=GIVEN, more="run 200")
        again = self.pour("rigid/small/symplectic", "/talus", np=2, given=GIVEN, more="run 100\nrun 100")
        self.assert_same_bits(once, again, MOTION)


if __name__ == "__main__":
    unittest.main()
