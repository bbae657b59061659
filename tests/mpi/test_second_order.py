# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=35 stay
"""Order 2 keeps one trajectory: the same bits on any ranks and threads, with and without overlap, in steps through the
arrays of LAMMPS, in several runs, and from a restart file, on other ranks as well; also with large bodies that move."""

import random
import unittest

import body_meshes
from talus_testing import SceneCase, Sphere, head, read_dump, write_sphere_data

SIDE = 6
LAW = "hertz 2.0e4 50.0 tangential multistep NULL NULL 0.5 slider midpoint limit_damping"
RESISTING = {"holding": LAW.replace("limit", "rolling 0.1 spinning 0.1 limit"),
             "springs": LAW.replace("limit", "rolling sds 2e3 5 0.1 limit"),
             "forces": "hertz 2.0e4 0 tangential mindlin/force 2e4 0 0.5"}
START = head(boundary="{boundary}") + """
read_data data
"""
CONTINUE = head() + "read_restart half\n"
UNDAMPED = "hooke 2.0e4 0.0 tangential multistep NULL 0 0.2 slider midpoint"      # contacts end with a correction
PHYSICS = """
neighbor 0.1 bin
pair_style {pair}
pair_coeff * * {own}
fix floor all large/body plane 0 0 0  0 0 1 contact {law}
fix step all nve/sphere/symplectic {order} gravity 2.0 vector 0.2 0 -1
timestep 0.0005
thermo 100
"""
OUTPUT = "dump all all custom {every} {name} id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz\n" \
         "dump_modify all format float %.17g\n"


# above the spheres, which fly and bounce; each moves in another way
BODIES = f"""
fix belt all large/body rectangle 3 3 0.2  0 0 1  1 0 0  4 4 contact {LAW} surface_velocity 0.5 0.1 0
fix mixer all large/body cylinder 1.5 3 7  0 1 0  0.7 3 outside contact {LAW} move rotate 1.5 3 7  0 1 0  0.5
fix stone all large/body box 4.5 3 7  1.5 2 1.5 outside contact {LAW} &
move free mass 3 inertia 1 0.8 1.2 spin 1 2 0.5 gravity 2 vector 0 0 -1
fix press all large/body rectangle 0.3 3 3  1 0 0  0 1 0  6 6 contact {LAW} servo force 1 0 0 20 0.5
fix ball all large/body mesh ball.stl outside contact {LAW} move wiggle 0.2 0 0.3 0.4
variable z equal 0.2*sin(30*step*dt)
region r cylinder y 3 5.5 0.5 EDGE EDGE move NULL NULL v_z side out
fix bar all large/body region r contact {LAW}
"""


class SecondOrder(SceneCase):

    def setUp(self):
        draw = random.Random(7)

        def some(size):
            return tuple(draw.uniform(-size, size) for _ in "xyz")
        spheres = [Sphere(tuple(c + 0.5 + e for c, e in zip((i, j, k), some(0.05))), some(2.0), some(2.0),
                          density=1.0, diameter=0.9) for i in range(SIDE) for j in range(SIDE) for k in range(SIDE)]
        draw.shuffle(spheres)
        write_sphere_data(self.path("data"), ((0, SIDE), (0, SIDE), (0, SIDE + 9)), spheres)
        body_meshes.write_stl(self.path("ball.stl"), body_meshes.sphere((3, 1, 6.4), 0.7, 6))

    def end(self, name, runs="run 400\n", style="", np=1, boundary="p p f", order="order 2", head=None, law=LAW,
            bodies="", pair="gran/penalty", own=None, **options):
        physics = PHYSICS.format(order=order, law=law, pair=pair, own=law if own is None else own)
        script = (head or START.format(boundary=boundary)) + style + physics
        walls = "" if boundary.startswith("p") else "".join(
            f"fix w{n} all large/body plane {x} contact {law}\n"
            for n, x in enumerate((f"0 0 0 1 0 0", f"{SIDE} 0 0 -1 0 0", "0 0 0 0 1 0", f"0 {SIDE} 0 0 -1 0")))
        self.run_lammps(script + bodies + walls + OUTPUT.format(every=options.pop("every", 100), name=name) + runs, np=np,
                        name=name, **options)
        return {frame.step: frame for frame in read_dump(self.path(name))}

    def assert_same(self, frames, others):
        self.assertIn(400, frames)
        for step in set(frames) & set(others):
            self.assert_same_bits(frames[step], others[step])

    def test_ranks_threads_and_residence(self):
        one = self.end("one")
        for name, options in {
                "ranks": {"np": 4},
                "overlap": {"np": 4, "style": "comm_proxy yes\nrun_style verlet/proxy overlap yes\n"},
                "arrays": {"style": "run_style verlet/stock\n"},
                "arrays_of_ranks": {"np": 3, "style": "run_style verlet/stock\n"},
                "often": {"np": 2, "every": 7},
                "threads": {"arguments": ("-sf", "omp", "-pk", "omp", "2"), "env": {"OMP_NUM_THREADS": "2"}}}.items():
            with self.subTest(name):
                every = 100 if name != "often" else 50
                options["every"] = every
                self.assert_same(self.end(name, **options), one)

    def test_runs_and_restart_files(self):
        one = self.end("one", boundary="f f f")
        self.assert_same(self.end("two", "run 150\nrun 250\n", boundary="f f f"), one)
        self.end("first", "run 150\nwrite_restart half\n", boundary="f f f")
        for np in (1, 4):
            self.assert_same(self.end(f"second{np}", "run 250\n", boundary="f f f", head=CONTINUE, np=np), one)

    def test_contacts_that_end(self):
        one = self.end("one", boundary="f f f", law=UNDAMPED)
        self.assert_same(self.end("ranks", boundary="f f f", law=UNDAMPED, np=4), one)
        self.assert_same(self.end("runs", "run 150\nrun 1\nrun 1\nrun 1\nrun 247\n", boundary="f f f", law=UNDAMPED), one)
        self.end("first", "run 171\nwrite_restart half\n", boundary="f f f", law=UNDAMPED)
        self.assert_same(self.end("second", "run 229\n", boundary="f f f", law=UNDAMPED, head=CONTINUE, np=3), one)

    def test_large_bodies_that_move(self):
        one = self.end("one", bodies=BODIES)
        for name, options in {
                "ranks": {"np": 4},
                "overlap": {"np": 4, "style": "comm_proxy yes\nrun_style verlet/proxy overlap yes\n"},
                "arrays": {"np": 2, "style": "run_style verlet/stock\n"},
                "threads": {"arguments": ("-sf", "omp", "-pk", "omp", "2"), "env": {"OMP_NUM_THREADS": "2"}}}.items():
            with self.subTest(name):
                self.assert_same(self.end(name, bodies=BODIES, **options), one)

    def test_large_bodies_that_move_in_runs_and_restart_files(self):
        f = {"boundary": "f f f", "bodies": BODIES}
        one = self.end("one", **f)
        self.assert_same(self.end("two", "run 150\nrun 250\n", **f), one)
        self.end("first", "run 150\nwrite_restart half\n", **f)
        self.assert_same(self.end("second", "run 250\n", head=CONTINUE, np=3, **f), one)

    def test_adhesion(self):
        law = "hertz 2.0e4 50.0 adhesion constant 0.5 tangential multistep NULL NULL 0.5 slider midpoint limit_damping"
        one = self.end("one", law=law, boundary="f f f")
        self.assert_same(self.end("other", "run 153\nrun 247\n", law=law, np=4, boundary="f f f"), one)

    def test_contacts_that_detach(self):
        law = "jkr 2.0e4 50.0 0.3 0.05 tangential mindlin NULL 0.0 0.5"
        f = {"law": law, "bodies": BODIES.replace(LAW, law), "boundary": "f f f"}
        one = self.end("one", **f)
        self.assert_same(self.end("other", "run 153\nrun 1\nrun 246\n", np=4, **f), one)
        self.end("first", "run 171\nwrite_restart half\n", **f)
        self.assert_same(self.end("second", "run 229\n", head=CONTINUE, np=3, **f), one)

    def test_impact_speeds_that_are_kept(self):
        f = {"law": "hooke/material 1.5e4 0.6 0.3 0.001 tangential multistep NULL NULL 0.5 slider midpoint limit_damping",
             "boundary": "f f f"}
        one = self.end("one", **f)
        self.assert_same(self.end("other", "run 153\nrun 247\n", np=4, **f), one)
        self.end("first", "run 171\nwrite_restart half\n", **f)
        self.assert_same(self.end("second", "run 229\n", head=CONTINUE, np=3, **f), one)

    def test_pair_styles_of_lammps(self):
        for name, pair, own in (
                ("granular", "granular/talus", "hertz 2.0e4 50.0 tangential mindlin 1.0e4 0.0 0.5 damping viscoelastic "
                                               "limit_damping"),
                ("dmt", "granular/talus", "dmt 2.0e4 50.0 0.3 0.02 tangential mindlin NULL 0.0 0.5"),
                ("history", "gran/hertz/history/talus 2.0e4 NULL 50.0 0.0 0.5 1 limit_damping", "")):
            with self.subTest(name):
                f = {"pair": pair, "own": own, "boundary": "f f f"}
                one = self.end(name, **f)
                self.assert_same(self.end(name + "_other", "run 153\nrun 247\n", np=4, **f), one)
                first = self.end(name + "_first", order="start half", **f)
                self.assertNotEqual(one[400].atoms, first[400].atoms)
                x, other = one[100].column("x"), first[100].column("x")
                self.assertLess(max(abs(x[tag] - other[tag]) for tag in x), 2e-3)

    def test_resistance_to_rolling_and_spinning(self):
        for name, law in RESISTING.items():
            f = {"boundary": "f f f", "law": law, "bodies": BODIES.replace(LAW, law)}
            one = self.end(name, **f)
            for other, options in {
                    "ranks": {"np": 4},
                    "overlap": {"np": 4, "style": "comm_proxy yes\nrun_style verlet/proxy overlap yes\n"},
                    "arrays": {"np": 2, "style": "run_style verlet/stock\n"},
                    "runs": {"runs": "run 150\nrun 1\nrun 249\n"},
                    "threads": {"arguments": ("-sf", "omp", "-pk", "omp", "2"), "env": {"OMP_NUM_THREADS": "2"}}}.items():
                with self.subTest(name + " " + other):
                    self.assert_same(self.end(name + other, **f, **options), one)
            with self.subTest(name + " restart"):
                self.end("first", "run 150\nwrite_restart half\n", **f)
                self.assert_same(self.end("second", "run 250\n", head=CONTINUE, np=3, **f), one)
            self.assertNotEqual(one[400].atoms, self.end("without", boundary="f f f", bodies=BODIES)[400].atoms)

    def test_it_is_another_method(self):
        one, other = self.end("one"), self.end("other", order="start half")
        self.assertNotEqual(one[400].atoms, other[400].atoms)


if __name__ == "__main__":
    unittest.main()
