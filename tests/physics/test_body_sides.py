# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""On which side meshes act: grains do not fall through meshes whose triangles face any side; closed meshes act where the
particles are; messages for what is too deep, went through, or is on a side that does not act."""

import random
import unittest

import body_meshes
from talus_testing import SceneCase, Sphere, begin, max_difference, read_dump, write_sphere_data

SCENE = begin(read="{read}", law="hertz 2e5 150 tangential multistep NULL NULL 0.4", skin=0.2, dt=0.001) + """
fix step all nve/sphere/symplectic gravity 9.81 vector 0.2 0.1 -1
"""
LAW = "contact hertz 2e5 150 tangential multistep NULL NULL 0.4"
OUTPUT = """
dump atoms all custom {every} {name}.* id x y z vx vy vz omegax omegay omegaz
dump_modify atoms format float %a
"""
COLUMNS = ["x", "y", "z", "vx", "vy", "vz", "omegax", "omegay", "omegaz"]


def any_side(triangles, seed):
    draw = random.Random(seed)
    return [(a, c, b) if draw.random() < 0.5 else (a, b, c) for a, b, c in triangles]


def grains(low, n, distance=0.9):
    draw = random.Random(3)
    return [Sphere(tuple(low + distance * (i + draw.uniform(-0.03, 0.03)) for i in place), diameter=draw.uniform(0.6, 0.8))
            for place in ((i, j, k) for k in range(n[2]) for j in range(n[1]) for i in range(n[0]))]


class Sides(SceneCase):

    def run_scene(self, name, body, some, steps=600, read="read_data grains", more="", types=None,
                  **options):
        write_sphere_data(self.path("grains"), ((-6, 6), (-6, 6), (-6, 6)), some, types)
        scene = SCENE.format(read=read)
        return self.run_lammps(scene + body + OUTPUT.format(name=name, every=steps) + f"run {steps}\n" + more, name=name,
                               **options).log

    def last(self, name, steps=600):
        return read_dump(self.path(f"{name}.{steps}"))[0]

    def test_a_chute_with_normals_of_any_side(self):
        # two plates that meet in a valley, cut into triangles that face up and down
        def at(i, j):
            return (i - 4.0, j - 4.0, 0.4 * abs(i - 4.0) - 4.0)
        good = body_meshes.grid(at, 8, 8)
        body_meshes.write_stl(self.path("good.stl"), good)
        body_meshes.write_stl(self.path("odd.stl"), any_side(good, 1))
        some = grains(-1.5, (4, 4, 2))
        self.run_scene("good", f"fix body all large/body mesh good.stl one-sided {LAW}\n", some)
        log = self.run_scene("odd", f"fix body all large/body mesh odd.stl {LAW}\n", some)
        self.assertIn("32 open edges, triangles turned at", log)
        self.assertIn("acts on both sides", log)
        self.assertNotIn("WARNING: Fix large/body", log)
        odd = self.last("odd")
        self.assertLess(max_difference(self.last("good"), odd, COLUMNS), 1e-9)
        self.assertGreater(min(odd.column("z").values()), -3.9)
        for np in (2, 4):
            self.run_scene(f"np{np}", f"fix body all large/body mesh odd.stl {LAW}\n", some, np=np)
            self.assert_same_bits(odd, self.last(f"np{np}"), COLUMNS)
        # the other way: normals point down, one-sided nothing holds the grains, and the log says why
        body_meshes.write_stl(self.path("down.stl"), [(a, c, b) for a, b, c in good])
        log = self.run_scene("down", f"thermo_modify lost ignore\nfix body all large/body mesh down.stl one-sided {LAW}\n", some, steps=640, np=2)
        self.assertRegex(log, "particle [0-9]+ is at triangle [0-9]+ of mesh 'down.stl' at step [0-9]+, but on the side "
                              "where the mesh does not act: move it, or use 'two-sided'")
        self.assertRegex(log, "particle [0-9]+ went through triangle [0-9]+ of mesh 'down.stl' before step [0-9]+; the mesh "
                              "does not act on the side that it came from")

    def test_closed_meshes_act_where_particles_are(self):
        vessel = body_meshes.box((-4, -4, -4), (4, 4, 4), 3)
        block = body_meshes.box((-3, -3, -5), (3, 3, -2.1), 2, inward=True)
        body_meshes.write_stl(self.path("vessel.stl"), any_side(vessel, 2))
        body_meshes.write_stl(self.path("block.stl"), block)
        body_meshes.write_stl(self.path("inward.stl"), body_meshes.box((-4, -4, -4), (4, 4, 4), 3, inward=True))
        some = grains(-1.5, (4, 4, 3))
        bodies = f"fix vessel all large/body mesh vessel.stl {LAW}\nfix block all large/body mesh block.stl {LAW}\n"
        log = self.run_scene("one", bodies, some, np=2)
        self.assertIn("mesh 'vessel.stl': particles are inside of it", log)
        self.assertIn("mesh 'block.stl': particles are outside of it", log)
        self.assertNotIn("WARNING: Fix large/body", log)
        said = (f"fix vessel all large/body mesh vessel.stl inside {LAW}\n"
                f"fix block all large/body mesh block.stl outside {LAW}\n")
        log = self.run_scene("said", said, some)
        self.assertIn("acts on particles inside of it", log)
        self.assert_same_bits(self.last("one"), self.last("said"), COLUMNS)
        normals = f"fix vessel all large/body mesh inward.stl one-sided {LAW}\nfix block all large/body box 0 0 -3.55 6 6 2.9 outside {LAW}\n"
        self.run_scene("normals", normals, some)
        self.assertLess(max_difference(self.last("one"), self.last("normals"), COLUMNS), 1e-7)

        # a restart goes on with the side, wherever particles are then
        self.run_scene("half", bodies, some, steps=300, more="write_restart half\n")
        self.run_scene("rest", bodies, some, steps=300, read="read_restart half", np=2)
        self.assert_same_bits(self.last("one"), self.last("rest", 600), COLUMNS)

    def test_the_side_is_found_when_there_are_particles(self):
        body_meshes.write_stl(self.path("vessel.stl"), body_meshes.box((-4, -4, -4), (4, 4, 4), 3))
        body = (f"group in type 2\nfix body in large/body mesh vessel.stl {LAW}\nrun 10\n"
                "create_atoms 2 single 1 1 -3 units box\nset type 2 diameter 0.6\ngroup in type 2\n")
        log = self.run_scene("late", body, [Sphere((5.5, 5.5, 5.5)), Sphere((5.5, -5.5, 5.5), type=2, id=2)][:1], np=2,
                             types=2)
        before, after = log.split("create_atoms 2", 1)
        self.assertNotIn("particles are inside", before)
        self.assertIn("mesh 'vessel.stl': particles are inside of it", after)
        self.assertGreater(min(self.last("late", 600).column("z").values()), -4.0)

    def test_both_sides(self):
        body_meshes.write_stl(self.path("vessel.stl"), body_meshes.box((-4, -4, -4), (2, 2, 2), 3))
        some = grains(-3.5, (4, 4, 2)) + [Sphere((3.0, 3.0, 3.0))]
        log = self.run_scene("both", f"fix body all large/body mesh vessel.stl {LAW}\n", some, np=2)
        self.assertIn("32 particles are inside of it and 1 outside: it acts on both sides; say 'inside' or 'outside'", log)
        self.assertGreater(min(self.last("both").column("z").values()), -4.0)

    def test_deep_contacts_and_grains_that_go_through(self):
        plate = [((-4, -4, 0), (4, -4, 0), (4, 4, 0)), ((-4, -4, 0), (4, 4, 0), (-4, 4, 0))]
        body_meshes.write_stl(self.path("plate.stl"), plate)
        body = f"fix body all large/body mesh plate.stl {LAW}\n"
        log = self.run_scene("deep", body, [Sphere((1, -2, 0.1))], steps=1)
        self.assertRegex(log, "particle 1 overlaps triangle 1 of mesh 'plate.stl' by 0.8 of its radius at step 0; it is there "
                              "from the beginning: move the particle or the body")
        self.assertNotIn("stiffness", log)
        soft = body.replace("2e5", "2e3")
        fast = [Sphere((-1, 2, 2), v=(0, 0, -60)), Sphere((3, -2, 2), v=(0, 0, -2), diameter=0.8)]
        for k, motion in enumerate(("", "move linear 0 0 0.5")):
            log = self.run_scene(f"fast{k}", soft.replace("\n", f" {motion}\n"), fast, steps=100, np=1 + k)
            self.assertRegex(log, "particle 1 went through triangle 2 of mesh 'plate.stl' before step [0-9]+; the contact is "
                                  "too soft, or the time step too long, for so hard an impact")
        slow = [Sphere((-1, 2, 0.6), v=(0, 0, -4))]
        log = self.run_scene("slow", body, slow, steps=300)
        self.assertNotIn("went through", log)

    def test_refusals(self):
        box = body_meshes.box((-4, -4, -4), (4, 4, 4), 1)
        body_meshes.write_stl(self.path("closed.stl"), box)
        body_meshes.write_stl(self.path("open.stl"), box[2:])
        body_meshes.write_stl(self.path("odd.stl"), any_side(box, 3))
        for words, message in (
                ("open.stl inside", "'open.stl' is not closed, so that nothing is inside of it (4 open edges): leave the word "
                                    "out, or use one-sided"),
                ("closed.stl inside outside", "is inside already"),
                ("closed.stl one-sided two-sided", "is two-sided already"),
                ("odd.stl one-sided", "edges lie between triangles that face opposite sides")):
            with self.subTest(words):
                log = self.run_scene("refused", f"fix body all large/body mesh {words} {LAW}\n", [Sphere((0, 0, 0))],
                                     expect_error=True, np=2)
                errors = [line for line in log.splitlines() if line.startswith("ERROR")]
                self.assertEqual(len(errors), 1)
                self.assertIn(message, errors[0])


if __name__ == "__main__":
    unittest.main(verbosity=2)
