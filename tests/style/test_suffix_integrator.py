# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=400 stay
"""fix nve/sphere/talus, gravity/talus and freeze/talus: the numbers of the styles of LAMMPS, to rounding, and the same
bits wherever a step is made: in Talus' records or in the arrays of LAMMPS."""

import os
import re
import unittest

from talus_testing import SceneCase, Sphere, max_difference, read_dump, write_sphere_data
from tossed_grains import tossed_grains

LAW = "hertz 4000.0 40.0 tangential multistep NULL NULL 0.5"
RECORDS = "steps without output              in the records"
HOST = "steps without output              through the arrays of LAMMPS: "
MOTION = "x y z vx vy vz omegax omegay omegaz".split()
ALL = MOTION + "fx fy fz tqx tqy tqz".split()

SCENE = """
units lj
{dimension}
boundary {boundary}
atom_style {atom_style}
atom_modify map yes
newton off
comm_modify vel yes
read_data grains
group base id <= 40
group loose subtract all base
{groups}
pair_style gran/penalty
pair_coeff * * {law}
neighbor 0.1 bin
timestep 0.001
{fixes}
{floor}
{style}
thermo {every}
thermo_style custom step {columns}
thermo_modify norm no lost ignore format float %.17g
dump all all custom {every} dump id {all} {more_columns}
dump_modify all format float %a sort id
{run}
"""
FIXES = "fix step loose nve/sphere@\nfix g all gravity@ 4.0 vector 0.3 0.1 -1\nfix held base freeze@"
WALLS = """fix floor all large/body plane 0 0 0  0 0 1  contact {law}
fix xlo all large/body plane 0 0 0  1 0 0  contact {law}
fix ylo all large/body plane 0 0 0  0 1 0  contact {law}
"""
PROXY = "comm_proxy yes\nrun_style verlet/proxy"
STOCK, OURS = "", "/talus"


class SuffixIntegrator(SceneCase):

    def write(self, grains):
        write_sphere_data(self.path("grains"), ((0, 9.5), (0, 7.2), (-0.5, 6.5)), grains)

    def setUp(self):
        super().setUp()
        self.write(tossed_grains(3))

    def simulate(self, suffix, fixes=FIXES, np=1, threads=1, every=130, run="run 130", style=PROXY, law=LAW,
                 boundary="f f f", columns="f_g f_held[1] f_held[2] f_held[3]", dimension="", groups="",
                 atom_style="sphere", floor=WALLS, more_columns="", expect=RECORDS, **options):
        """The frames of the dump; self.log, self.table: the numbers of thermo output. The fixes have the suffix."""
        self.log = self.run_lammps(SCENE.format(
            fixes=fixes.replace("@", suffix), law=law, boundary=boundary, columns=columns, run=run, style=style,
            every=every, dimension=dimension, groups=groups, atom_style=atom_style, all=" ".join(ALL),
            floor=floor.format(law=law), more_columns=more_columns), np=np,
            env={"OMP_NUM_THREADS": str(threads)}, **options).log
        if suffix and expect:
            self.assertIn(expect, self.log)
        self.table = re.findall(r"^ *\d+(?: +[-+.\de]+)+ *$", self.log, re.M)
        if "undump" in run:
            return []
        frames = read_dump(self.path("dump"))
        os.remove(self.path("dump"))
        return frames

    def assert_close_to_stock(self, run, limit, **options):
        ours = self.simulate(OURS, run=run, **options)
        table = self.table
        stock = self.simulate(STOCK, run=run, **options)
        found = max(max_difference(a, b, ALL) for a, b in zip(ours, stock))
        self.assertLess(found, limit)
        self.assertGreater(len(table), 0)
        self.assertEqual(len(table), len(self.table))
        for a, b in zip(table, self.table):
            for one, other in zip(a.split(), b.split()):
                self.assertAlmostEqual(float(one), float(other), delta=limit * (1 + abs(float(other))) * 10)
        return ours

    def test_one_step(self):
        self.assert_close_to_stock("run 1", 1e-11)    # forces of up to 400

    def test_one_sphere_in_free_flight(self):
        self.write([Sphere((4, 4, 3), v=(1, 2, 3), omega=(1, 2, 3))])
        self.assert_close_to_stock("run 1000", 1e-11, fixes="fix s all nve/sphere@\nfix g all gravity@ 4.0 chute 20",
                                   columns="f_g")

    def test_one_contact(self):
        self.write([Sphere((4, 4, 3), v=(1, 0, 0), omega=(1, 2, 3)), Sphere((5.2, 4.3, 3.1), diameter=0.8)])
        self.assert_close_to_stock("run 400", 1e-10, columns="f_g",
                                   fixes="fix s all nve/sphere@\nfix g all gravity@ 0.4 vector 1 0 0")

    def test_many_collisions(self):
        """As close to stock as stock is to itself with another rounding."""
        ours, = self.simulate(OURS, every=1001, run="run 1001")[1:]
        stock, = self.simulate(STOCK, every=1001, run="run 1001")[1:]
        other, = self.simulate(STOCK, every=1001, run="run 1001",
                               fixes=FIXES.replace("4.0", "4.000000000000001"))[1:]
        spread = max_difference(stock, other, ["x", "y", "z"])
        self.assertLess(max_difference(ours, stock, ["x", "y", "z"]), max(1e-10, 10 * spread))

    def test_same_bits_whoever_looks(self):
        reference = self.simulate(OURS, style="run_style verlet", every=1, expect=None)
        cases = [(1, 1, 1, "yes"), (7, 1, 1, "yes"), (1000, 1, 1, "yes"), (7, 1, 2, "yes"), (1000, 2, 1, "yes"),
                 (7, 2, 2, "no"), (1000, 4, 1, "yes")]
        for every, np, threads, overlap in cases:
            with self.subTest(every=every, ranks=np, threads=threads, overlap=overlap):
                run = f"run 130\nwrite_dump all custom last id {' '.join(ALL)} modify format float %a sort id"
                frames = self.simulate(OURS, every=every, np=np, threads=threads, run=run,
                                       style=PROXY + " overlap " + overlap)
                frames += read_dump(self.path("last"))
                self.assertEqual(frames[-1].step, 130)
                for frame in frames:
                    self.assert_same_bits(frame, reference[frame.step])

    def test_same_output_as_through_the_arrays(self):
        self.simulate(OURS, style="run_style verlet", every=10, expect=None)
        expected = self.table
        self.simulate(OURS, every=10)
        self.assertEqual(self.table, expected)
        self.assertEqual(len(expected), 14)

    def test_law_without_friction_and_several_laws(self):
        for law in "hertz 4000.0 40.0", LAW + " rolling 0.1":
            with self.subTest(law=law):
                reference = self.simulate(OURS, style="run_style verlet", law=law, expect=None)
                frames = self.simulate(OURS, np=2, threads=2, law=law)
                self.assert_same_bits(frames[-1], reference[-1])
                self.assert_close_to_stock("run 5", 1e-10, law=law)

    def test_variable_gravity(self):
        fixes = ("variable w equal 2*PI*0.7\nvariable g equal 4.0+0.5*sin(v_w*time)\n"
                 "variable a equal swiggle(0,20,0.3)\n"
                 "fix step loose nve/sphere@\nfix g all gravity@ v_g chute v_a\nfix held base freeze@")
        self.assert_close_to_stock("run 20", 1e-10, fixes=fixes, every=7)
        reference = self.simulate(OURS, fixes=fixes, style="run_style verlet", expect=None)
        for np in 1, 2:
            self.assert_same_bits(self.simulate(OURS, fixes=fixes, np=np)[-1], reference[-1])

    def test_variable_that_reads_particles(self):
        fixes = ("compute ke all ke\nvariable k equal 1+c_ke/1e6\nvariable g equal 4.0*v_k\n"
                 "fix step loose nve/sphere@\nfix g all gravity@ v_g chute 10\nfix held base freeze@")
        self.assert_close_to_stock("run 20", 1e-10, fixes=fixes, columns="c_ke f_g f_held[3]",
                                   expect=HOST + "fix g (gravity): its variable 'g' may read more than the time")

    def test_groups(self):
        """Gravity on some, two integrators, frozen particles within them and moving, not all integrated."""
        groups = ("group few id <= 60\ngroup a id <= 80\ngroup rest subtract all a\n"
                  "group c id > 130\ngroup b subtract rest c\ngroup e id < 100\nvelocity base set 0.1 0.2 0.3")
        fixes = ("fix one a nve/sphere@\nfix two b nve/sphere@\nfix g e gravity@ 4.0 vector 0 0 -1\n"
                 "fix held base freeze@")
        self.assert_close_to_stock("run 20", 1e-10, fixes=fixes, groups=groups, every=7)
        reference = self.simulate(OURS, fixes=fixes, groups=groups, style="run_style verlet", expect=None)
        for np, threads in (1, 1), (2, 2), (4, 1):
            frames = self.simulate(OURS, fixes=fixes, groups=groups, np=np, threads=threads)
            self.assert_same_bits(frames[-1], reference[-1], MOTION)
        start, end = (reference[n].column("z")[3] for n in (0, -1))
        self.assertAlmostEqual(end - start, 130 * 0.001 * 0.3, delta=1e-12)

    def test_symplectic_with_frozen_members(self):
        fixes = "fix step all nve/sphere/symplectic\nfix g all gravity@ 4.0 chute 5\nfix held base freeze@"
        options = dict(fixes=fixes, groups="velocity base set 0.1 0.2 0.3")
        reference = self.simulate(OURS, style="run_style verlet", expect=None, **options)
        self.assert_same_bits(self.simulate(OURS, np=2, threads=2, **options)[-1], reference[-1], MOTION)
        stock = self.simulate(STOCK, **options)
        self.assertLess(max_difference(reference[-1], stock[-1], MOTION), 1e-8)
        own = dict(fixes="fix g all nve/sphere/symplectic gravity 4.0 chute 5\nfix held base freeze",
                   groups="velocity all set 0 0 0")
        reference = self.simulate(OURS, style="run_style verlet", expect=None, **own)
        self.assert_same_bits(self.simulate(OURS, **own)[-1], reference[-1], MOTION)

    def test_freeze_before_gravity(self):
        """Frozen particles have their weight as force, and fall if they are integrated."""
        rest = "fix held base freeze@\nfix g all gravity@ 4.0 chute 5\nfix step loose nve/sphere@"
        self.assert_close_to_stock("run 20", 1e-10, fixes=rest, every=7)
        falls = rest.replace("loose", "all")
        frames = self.assert_close_to_stock(
            "run 20", 1e-10, fixes=falls, every=7,
            expect=HOST + "fix g (gravity): fix held (freeze) comes before it, so that frozen particles fall")
        self.assertLess(frames[-1].column("vz")[3], -0.05)

    def test_disc_dipole_and_dynamic_groups(self):
        self.write([Sphere((s[0], s[1], 0), v=(v[0], v[1], 0), diameter=d) for s, v, d in
                    ((g.x, g.v, g.diameter) for g in tossed_grains(1))])
        flat = dict(dimension="dimension 2", boundary="f f p", floor="", columns="f_g",
                    fixes="fix s all nve/sphere@ disc\nfix 2d all enforce2d\nfix g all gravity@ 4.0 vector 1 -1 0")
        self.assert_close_to_stock("run 50", 1e-10, expect=HOST + "fix g (gravity): fix 2d (enforce2d) acts on forces before it",
                                   **flat)
        flat["fixes"] = "fix s all nve/sphere@ disc\nfix g all gravity@ 4.0 vector 1 -1 0\nfix 2d all enforce2d"
        self.assert_close_to_stock("run 50", 1e-10, **flat)
        flat["fixes"] = "fix s all nve/sphere@ disc\nfix g all gravity@ 4.0 vector 1 -1 0"
        self.assert_close_to_stock("run 50", 1e-10, **flat)
        self.write(tossed_grains(3))
        self.assert_close_to_stock("run 5", 1e-10, fixes="group d dynamic all every 1\n" + FIXES.replace("loose", "d"),
                                   expect=HOST + "fix step (nve/sphere): its group is dynamic")

    def test_runs_that_go_on_and_time_steps_that_change(self):
        self.assert_close_to_stock("run 13\ntimestep 0.0005\nrun 17 pre no post no\nrun 10", 1e-9, every=100)
        fixes = FIXES + "\nfix dt all dt/reset 5 1e-5 1e-3 0.001 units box"
        self.assert_close_to_stock("run 30", 1e-9, fixes=fixes, every=100)

    def test_restart_files_cross(self):
        end = f"write_dump all custom last id {' '.join(ALL)} modify format float %a sort id"
        go_on = ("undump all\nrestart 45 middle\nrun 60\nclear\nnewton off\nread_restart middle.45\n{law}"
                 "neighbor 0.1 bin\nneigh_modify every 1 delay 0 check yes\ntimestep 0.001\n"
                 "comm_modify vel yes\n{fixes}\n{walls}\nrun_style verlet/proxy\nrun 30\n" + end)
        states = {}
        for first in STOCK, OURS:
            for second in STOCK, OURS:
                run = go_on.format(law="", fixes=FIXES.replace("@", second), walls=WALLS.format(law=LAW))
                self.simulate(first, run=run, style="run_style verlet/proxy", every=1000)
                states[first, second], = read_dump(self.path("last"))
        for key, state in states.items():
            self.assertEqual(state.step, 75)
            self.assertLess(max_difference(state, states[STOCK, STOCK], MOTION), 1e-8, key)

    def test_run_that_ends_before_its_time(self):
        columns = "id " + " ".join(ALL)
        def run(steps):
            return (f"undump all\nrun 50\n{steps}\ntimer timeout off\nprint 'held $(f_held[3]:%.17g)'\n"
                    f"write_dump all custom last {columns} modify format float %a sort id\n")
        self.simulate(OURS, run=run("timer timeout 0:00:01 every 10\nrun 100000000"))
        made = int(re.findall(r"Loop time .* for (\d+) steps", self.log)[1])
        self.assertTrue(0 < made < 100000000, made)
        state, = read_dump(self.path("last"))
        self.assertEqual(state.step, 50 + made)
        self.simulate(OURS, run=run(f"run {made}"), style="run_style verlet", expect=None)
        expected, = read_dump(self.path("last"))
        self.assert_same_bits(state, expected)

    def test_poured_particles(self):
        fixes = ("fix step loose nve/sphere@\nfix g all gravity@ 4.0 chute 0\nfix held base freeze@\n"
                 "region slab block 1 8 1 6 5 6 units box\n"
                 "fix pour loose pour 40 1 4767 region slab diam range 0.5 0.6 dens 1.0 1.0")
        reference = self.simulate(OURS, fixes=fixes, style="run_style verlet", expect=None, run="run 300", every=300)
        self.assertGreater(len(reference[-1].atoms), 150)
        for np in 1, 2:
            self.assert_same_bits(self.simulate(OURS, fixes=fixes, run="run 300", every=300, np=np)[-1], reference[-1])

    def test_dipoles_turn_as_in_lammps(self):
        script = """
units lj
boundary f f f
atom_style hybrid sphere dipole
newton off
comm_modify vel yes
region box block 0 6 0 6 0 6
create_box 1 box
lattice sc 1
create_atoms 1 box
set group all diameter 0.95
set group all mass 1
set group all dipole/random 5 1.5
velocity all create 1 5
pair_style gran/penalty
pair_coeff * * hertz 4000.0 40.0
timestep 0.001
fix s all nve/sphere@ update dipole/dlm
fix g all gravity@ 4.0 chute 0
run_style verlet/proxy
run 20
write_dump all custom last id x vx omegax mux muy modify format float %.17g
"""
        states = []
        for suffix in OURS, STOCK:
            log = self.run_lammps(script.replace("@", suffix)).log
            states += read_dump(self.path("last"))
            self.assertIn(HOST, log)
        self.assertLess(max_difference(*states, ["x", "vx", "omegax", "mux", "muy"]), 1e-10)

    def test_minimize_has_no_gravity(self):
        run = "undump all\nunfix floor\nunfix xlo\nunfix ylo\nmin_modify dmax 0.01\nminimize 0 0 3 5\nrun 5"
        results = []
        for suffix in OURS, STOCK:
            self.simulate(suffix, run=run, expect=None,
                          style="run_style verlet")
            results.append(self.table)
        for a, b in zip(*results):
            for one, other in zip(a.split(), b.split()):
                self.assertAlmostEqual(float(one), float(other), delta=1e-8 * (1 + abs(float(other))))


if __name__ == "__main__":
    unittest.main()
