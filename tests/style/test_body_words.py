# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=200 stay
"""fix large/body: refusals of shapes, meshes and motions; pictures, files for ParaView, loads of triangles; a shape of
one's own; regions of the host."""

import collections
import math
import os
import re
import subprocess
import unittest

import body_meshes
from talus_testing import SceneCase, Sphere, begin, marked_word, read_dump, thermo, write_sphere_data
from vtk_files import Piece

SOURCE = os.environ["TALUS_SOURCE_DIR"]
LAW = "contact hooke 1e4 10"
BOX = "box 0 0 0 4 4 4 inside"
FREE = "move free mass 1 inertia 1 1 1"

SCENE = begin(read="read_data grains", law="hooke 1e4 10", skin=0.2, dt=0.001) + """
fix step all nve/sphere/symplectic gravity 9.81 vector 0 0 -1
region well cylinder z 0 0 3 -3 3
variable a equal 3
region breathing sphere 0 0 0 v_a
variable atoms atom x
"""

REFUSED = [    # words of the fix, message, marked word
    ("box 0 0 0 1 1", "fix large/body box: missing edge length lz", "1"),
    ("box 0 0 0 1 0 1 inside " + LAW, "box: expected edge length ly (a number > 0) instead of '0'", "0"),
    ("box 0 0 0 1 1 1 within " + LAW, "box: unknown side 'within', expected inside or outside", "within"),
    (f"{BOX} {LAW} two-sided", "two-sided is for plane, rectangle and mesh", None),
    ("sphere 0 0 0 -1 inside " + LAW, "sphere: expected radius r (a number > 0) instead of '-1'", "-1"),
    ("cylinder 0 0 0 0 0 0 1 1 inside " + LAW, "cylinder: axis (ax ay az) must not be zero", "0"),
    ("cylinder 0 0 0 0 0 1 1 long inside " + LAW, "cylinder: expected length l (a number > 0) instead of 'long'", "long"),
    ("cone 0 0 0 0 0 1 0 0 1 inside " + LAW, "cone: radii must not be negative, and one of them", "0"),
    ("cone 0 0 0 0 0 1 1 2 INF inside " + LAW, "cone: expected length l (a number > 0) instead of 'INF'", "INF"),
    ("region nowhere " + LAW, "region: region 'nowhere' does not exist", "nowhere"),
    ("region breathing " + LAW, "region 'breathing' changes its shape, which a large body does not: use fix wall/gran/region", "breathing"),
    ("mesh", "mesh: missing file", "mesh"),
    ("mesh nothing.stl " + LAW, "mesh: cannot read the file 'nothing.stl'", "nothing.stl"),
    ("mesh empty.stl " + LAW, "mesh: 'empty.stl': the file is empty", "empty.stl"),
    ("mesh cut.stl " + LAW, "mesh: 'cut.stl': it announces", "cut.stl"),
    ("mesh letter.stl " + LAW, "mesh: 'letter.stl': it is no STL file: it begins with 'Dear all,'", "letter.stl"),
    ("mesh flat.stl " + LAW, "mesh: 'flat.stl': all its triangles are without area", "flat.stl"),
    ("mesh turned.stl one-sided " + LAW, "mesh: 'turned.stl': 3 edges lie between triangles that face opposite sides, "
     "the first at triangle", None),
    ("mesh good.stl scale 0 " + LAW, "mesh: expected scale s (a number > 0) instead of '0'", "0"),
    ("mesh good.stl rotate 30 0 0 0 " + LAW, "mesh: rotate axis (ax ay az) must not be zero", "0"),
    ("custom nothing.so 0 " + LAW, "custom: cannot open 'nothing.so'", "nothing.so"),
    ("custom good.so -1 " + LAW, "custom: expected number of arguments (a whole number >= 0) instead of '-1'", "-1"),
    (f"{BOX} {LAW} move", "fix large/body move: missing style of motion", "move"),
    (f"{BOX} {LAW} move about", "move: unknown style of motion 'about', expected none, linear, wiggle, rotate, variable, external, free or vertices", "about"),
    (f"{BOX} {LAW} move linear 1 2", "move linear: missing velocity (vx vy vz)", "2"),
    (f"{BOX} {LAW} move wiggle 1 2 3 0", "move wiggle: expected period (a number > 0) instead of '0'", "0"),
    (f"{BOX} {LAW} move rotate 0 0 0 0 0 0 1", "move rotate: axis (ax ay az) must not be zero", "0"),
    (f"{BOX} {LAW} move linear 1 0 0 move none", "move: the body has a motion already", "move"),
    (f"{BOX} {LAW} move free mass 1", "move free: missing inertia Ixx Iyy Izz", None),
    (f"{BOX} {LAW} move free inertia 1 1 1", "move free: missing mass M", None),
    (f"{BOX} {LAW} move free mass 1 inertia 1 1 3", "no body has these moments of inertia", None),
    (f"{BOX} {LAW} {FREE} lock", "expected one or more of x y z rx ry rz after lock", None),
    (f"{BOX} {LAW} {FREE} gravity", "fix large/body gravity: missing magnitude", "gravity"),
    (f"{BOX} {LAW} gravity 9.81 vector 0 0 -1", "gravity acts on bodies with 'move free' only", None),
    (f"{BOX} {LAW} load 0 0 0 0 0 1", "load acts on bodies with 'move free' only", None),
    (f"{BOX} {LAW} servo weight", "servo: unknown quantity 'weight', expected force or torque", "weight"),
    (f"{BOX} {LAW} servo force 0 0 1 0 1", "servo: target must not be zero", "0"),
    (f"{BOX} {LAW} servo force 0 0 1 5 0", "servo: expected vmax (a number > 0) instead of '0'", "0"),
    (f"{BOX} {LAW} pressure yes", "only the triangles of a mesh are looked at one by one", None),
    (f"mesh good.stl {LAW} pressure maybe", "pressure: unknown value 'maybe', expected yes, no or average", "maybe"),
    (f"{BOX} {LAW} vtk 0 a.*", "vtk: expected interval N (a whole number >= 1) instead of '0'", "0"),
    (f"{BOX} {LAW} vtk 5 a.vtk", "vtk: the name of the file needs a * for the time step", "a.vtk"),
    (f"{BOX} {LAW} vtk 5 a.*.vtk", "vtk: the name of the file must end in .vtp", "a.*.vtk"),
]
REFUSED_AT_RUN = [
    (f"{BOX} {LAW} move variable v_no NULL NULL NULL NULL NULL", "variable 'no' does not exist"),
    (f"{BOX} {LAW} move variable v_atoms NULL NULL NULL NULL NULL", "variable 'atoms' is not an equal-style variable"),
]


class Words(SceneCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), ((-9, 9), (-9, 9), (-9, 9)), [Sphere((0.1, 0, 0.2))])

    def refuse(self, words, message, word, np):
        log = self.run_lammps(SCENE + f"fix body all large/body {words}\nrun 1\n", np=np, expect_error=True).log
        errors = [line for line in log.splitlines() if line.startswith("ERROR")]
        self.assertEqual(len(errors), 1, log[-500:])
        self.assertIn(message, errors[0])
        if word is not None:
            self.assertEqual(marked_word(log), word)

    def test_refusals(self):
        tetrahedron = [((0, 0, 0), (0, 1, 0), (1, 0, 0)), ((0, 0, 0), (1, 0, 0), (0, 0, 1)),
                       ((1, 0, 0), (0, 1, 0), (0, 0, 1)), ((0, 0, 0), (0, 0, 1), (0, 1, 0))]
        body_meshes.write_stl(self.path("good.stl"), tetrahedron)
        body_meshes.write_stl(self.path("turned.stl"), tetrahedron[:3] + [tetrahedron[3][::-1]])
        body_meshes.write_stl(self.path("flat.stl"), [((0, 0, 0), (1, 0, 0), (2, 0, 0))])
        open(self.path("empty.stl"), "w").close()
        body_meshes.write_stl(self.path("whole.stl"), tetrahedron, binary=True)
        with open(self.path("whole.stl"), "rb") as whole, open(self.path("cut.stl"), "wb") as cut:
            cut.write(whole.read()[:-20])
        with open(self.path("letter.stl"), "w") as letter:
            letter.write("Dear all,\nthis is no surface.\n")
        for k, (words, message, word) in enumerate(REFUSED):
            with self.subTest(words):
                self.refuse(words, message, word, np=2 if k % 4 == 3 else 1)
        for words, message in REFUSED_AT_RUN:
            with self.subTest(words):
                self.refuse(words, message, None, 1)

    def test_broken_meshes_are_reported_and_used(self):
        plate = [((-2, -2, 0), (2, -2, 0), (2, 2, 0)), ((-2, -2, 0), (2, 2, 0), (-2, 2, 0))]
        fin = [((-2, -2, 0), (2, 2, 0), (0, 0, -3)), ((0, 0, 0), (0, 0, 0), (1, 1, 1)), plate[0]]
        body_meshes.write_stl(self.path("plate.stl"), plate + fin)
        log = self.run_lammps(SCENE + f"fix body all large/body mesh plate.stl two-sided {LAW}\nrun 0\n").log
        for text in ("1 triangles without area are left out; the first is triangle 4",
                     "1 triangles that are there already are left out; the first is triangle 5",
                     "1 edges belong to more than two triangles; the first is triangle 3", "3 triangles, 6 open edges"):
            self.assertIn(text, log)

    def test_bytes_behind_a_mesh_are_reported(self):
        plate = [((-2, -2, 0), (2, -2, 0), (2, 2, 0)), ((-2, -2, 0), (2, 2, 0), (-2, 2, 0))]
        body_meshes.write_stl(self.path("plate.stl"), plate, binary=True)
        with open(self.path("plate.stl"), "ab") as file:
            file.write(b"made by a program")
        log = self.run_lammps(SCENE + f"fix body all large/body mesh plate.stl two-sided {LAW}\nrun 0\n").log
        self.assertIn("17 bytes behind the last of the 2 triangles that the file announces are not read", log)

    def test_directions_of_any_length(self):
        # squares of these numbers are no numbers any more, or zero
        for length in ("1", "1e200", "1e-200"):
            # energy of the contact, and of a body of mass 1 in the field of gravity at z = -9
            for fix, energy in ((f"plane 0 0 -0.2 0 0 {length} {LAW}", 50.0),
                                (f"box 0 0 -9 20 20 17.6 outside {LAW} {FREE} lock x y z rx ry rz "
                                 f"gravity 1 vector 0 0 -{length}", 41.0)):
                with self.subTest(fix):
                    rows = thermo(self.run_lammps(SCENE + f"""
fix body all large/body {fix}
thermo_style custom step f_body f_body[3]
run 0
""").log)
                    self.assertAlmostEqual(rows[0]["f_body[3]"], -1e3, delta=1e-6)
                    self.assertAlmostEqual(rows[0]["f_body"], energy, delta=1e-6)

    def test_scale_rotate_translate(self):
        # scaled by 2, turned by 90 degrees about y: the plate looks along +x, then shifted
        plate = [((-1, -1, 0), (1, -1, 0), (1, 1, 0)), ((-1, -1, 0), (1, 1, 0), (-1, 1, 0))]
        for binary in (False, True):
            body_meshes.write_stl(self.path("plate.stl"), plate, binary)
            rows = thermo(self.run_lammps(SCENE + f"""
fix body all large/body mesh plate.stl translate -0.3 0 0 rotate 90 0 1 0 scale 2 {LAW}
thermo_style custom step f_body[1] f_body[2] f_body[3] f_body[20]
run 0
""").log)
            # at x = 0.1, 0.4 from the plate: overlap 0.1
            self.assertAlmostEqual(rows[0]["f_body[1]"], -1e3, delta=1e-6)
            self.assertAlmostEqual(rows[0]["f_body[3]"], 0.0, delta=1e-6)

    def test_pressure_and_vtk(self):
        plate = [((-2, -2, 0), (2, -2, 0), (2, 2, 0)), ((-2, -2, 0), (2, 2, 0), (-2, 2, 0))]
        body_meshes.write_stl(self.path("plate.stl"), plate)
        write_sphere_data(self.path("grains"), ((-9, 9), (-9, 9), (-9, 9)), [Sphere((1, -0.5, 0.49949), v=(2, 0, 0))])
        commands = f"""
fix body all large/body mesh plate.stl contact hooke 1e4 0 tangential multistep NULL NULL 0.5 &
    move linear 0 0 0 pressure yes vtk 50 plate.*.vtp
thermo_style custom step f_body[1] f_body[3] f_body[1][1] f_body[2][1] f_body[1][2] f_body[1][3] f_body[2][3]
thermo 50
thermo_modify format float %.15g
"""
        rows = thermo(self.run_lammps(SCENE + commands + "run 50\nwrite_restart half\nrun 50\n", np=2).log)
        area = 8.0
        for row in rows:
            self.assertAlmostEqual(row["f_body[1][1]"] * area, -row["f_body[3]"], delta=1e-9)
            self.assertAlmostEqual(row["f_body[1][2]"] * area, abs(row["f_body[1]"]), delta=1e-9)
            self.assertEqual(row["f_body[2][1]"], 0.0)
        self.assertGreater(rows[0]["f_body[1][1]"], 0.5)
        # shear work = force mu N along the slip: at most the way of the surfaces
        self.assertGreater(rows[-1]["f_body[1][3]"], rows[1]["f_body[1][3]"])
        self.assertGreater(rows[1]["f_body[1][3]"], 0.0)
        for step in (0, 50, 100):
            plate_then = Piece(self.path(f"plate.{step}.vtp"))
            self.assertEqual(plate_then.points, [tuple(map(float, p)) for triangle in plate for p in triangle])
            self.assertEqual(plate_then.cells, {"Polys": [[0, 1, 2], [3, 4, 5]]})
            row = [r for r in rows if r["Step"] == step][-1]
            self.assertAlmostEqual(plate_then.cell_data["pressure"][0], row["f_body[1][1]"], delta=1e-6)
        restart = SCENE.replace("read_data grains", "read_restart half")
        again = thermo(self.run_lammps(restart + commands + "run 50\n").log)
        self.assertAlmostEqual(again[-1]["f_body[1][3]"], rows[-1]["f_body[1][3]"], delta=1e-13)

    def test_means_of_loads_go_on_after_a_restart(self):
        """Sums over the steps since the last picture, of all ranks: files are read by one rank or two."""
        plate = [((-2, -2, 0), (2, -2, 0), (2, 2, 0)), ((-2, -2, 0), (2, 2, 0), (-2, 2, 0))]
        body_meshes.write_stl(self.path("plate.stl"), plate)
        write_sphere_data(self.path("grains"), ((-9, 9), (-9, 9), (-9, 9)),
                          [Sphere((1, -0.5, 0.49949), v=(2, 0, 0)), Sphere((-1, 0.5, 0.499), v=(-1, 0, 0))])
        commands = """
fix body all large/body mesh plate.stl contact hooke 1e4 0 tangential multistep NULL NULL 0.5 pressure average
thermo_style custom step f_body[1][1] f_body[2][1] f_body[1][2] f_body[2][3]
thermo 30
thermo_modify format float %.15g
"""
        whole = thermo(self.run_lammps(SCENE + commands + "run 30\nwrite_restart half\nrun 30\n", np=2).log)[-1]
        restart = SCENE.replace("read_data grains", "read_restart half")
        for np in 1, 2:
            again = thermo(self.run_lammps(restart + commands + "run 30\n", np=np).log)[-1]
            for word, value in whole.items():
                self.assertAlmostEqual(again[word], value, delta=1e-12 * abs(value), msg=word)
        self.assertGreater(whole["f_body[1][1]"], 0.1)
        self.assertGreater(whole["f_body[2][1]"], 1.05 * whole["f_body[1][1]"])
        self.assertGreater(whole["f_body[2][3]"], 0.0)

    def test_pictures(self):
        picture = SCENE + """
fix body all large/body {shape} contact hooke 1 0 {more}
dump p all image 10 {name}.*.ppm type type size 120 100 view 60 30 zoom 1.2 box no 0 fix body const 1 0.02
dump_modify p fcolor body red
run 10
"""
        if int(os.environ["TALUS_LAMMPS_VERSION"]) < 20260000:
            picture = picture.replace("fix body const", "fix body type").replace("dump_modify p fcolor body red\n", "")
        body_meshes.write_stl(self.path("ball.stl"), body_meshes.sphere((4, 0, 0), 2, 12))
        shapes = {"mesh": ("mesh ball.stl", "move linear -300 0 0"), "box": ("box 3 0 0 2 3 4 outside", ""),
                  "sphere": ("sphere 4 0 0 2 outside", "move wiggle 0 0 2 0.04"), "plane": ("plane 0 0 -3 0 0.2 1", ""),
                  "rectangle": ("rectangle 0 0 -3 0 0 1 1 0 0 5 5", ""), "cone": ("cone 4 0 0 1 0 1 0 2 4 outside", ""),
                  "cylinder": ("cylinder 4 0 0 0 1 1 1 INF outside", "")}
        for name, (shape, more) in shapes.items():
            with self.subTest(name):
                self.run_lammps(picture.format(shape=shape, more=more, name=name), np=2)
                places = []
                for step in (0, 10):
                    with open(self.path(f"{name}.{step}.ppm"), "rb") as file:
                        data = file.read()[-3 * 120 * 100:]
                    red = [k // 3 for k in range(0, len(data), 3) if data[k] > data[k + 1] + 15]
                    self.assertGreater(len(red), 100)
                    places.append((sum(k % 120 for k in red) / len(red), sum(k // 120 for k in red) / len(red)))
                if name == "box":    # light comes from above: no face is brighter than the upper one
                    faces = collections.Counter(data[0::3])
                    self.assertGreater(max(red for red, count in faces.items() if count > 20), 205)
                moved = math.dist(*places)
                self.assertEqual(moved > 2.0, bool(more), f"moved by {moved} pixels")

    def test_surfaces_without_gaps(self):
        """A plate of many triangles: no pixel of the background is within it, whatever their size and place."""
        size = 200
        for n, (parts, shift) in enumerate(((7, 0.0), (13, 0.013), (31, 0.4))):
            body_meshes.write_stl(self.path("plate.stl"), body_meshes.grid(
                lambda i, j: (-2.0 + 4.0 * i / parts + shift, 0.0, -2.0 + 4.0 * j / parts + 0.7 * shift), parts, parts))
            self.run_lammps(SCENE + f"""
fix body all large/body mesh plate.stl contact hooke 1 0
dump p all image 10 plate{n}.*.ppm type type size {size} {size} view 90 -90 zoom 5 box no 0 atom no fix body type 1 0
dump_modify p backcolor black acolor 1 red
run 0
""", np=1 + n % 2)
            with open(self.path(f"plate{n}.0.ppm"), "rb") as file:
                data = file.read()[-3 * size * size:]
            rows = [[data[3 * (size * y + x)] > 40 for x in range(size)] for y in range(size)]
            full = [row for row in rows if any(row)]
            self.assertGreater(len(full), 40)
            for row in full:
                first, last = row.index(True), size - 1 - row[::-1].index(True)
                self.assertTrue(all(row[first:last + 1]), f"{parts} parts: {row[first:last + 1].count(False)} gaps")

    def compile_shape(self, source, library):
        subprocess.run([os.environ.get("TALUS_CXX", "g++"), "-std=c++17", "-O2", "-march=native", "-ffp-contract=off",
                        "-Wno-psabi", "-shared", "-fPIC", "-I", os.path.join(SOURCE, "src"), source, "-o",
                        self.path(library)], check=True)

    def test_own_shape_of_another_version(self):
        with open(os.path.join(SOURCE, "src", "body", "shape", "custom_shape.h")) as file:
            version = int(re.search("define TALUS_SHAPE_VERSION ([0-9]+)", file.read()).group(1))
        makers = {"talus_make_shape": 1, f"talus_make_shape_{version + 1}": version + 1, "make_a_shape": None}
        for name, other in makers.items():
            self.write("maker.cpp", f'extern "C" void *{name}(int, const char *const *, char *, int) {{ return nullptr; }}\n')
            self.compile_shape(self.path("maker.cpp"), f"{name}.so")
            message = (f"was built with version {other} of custom_shape.h, this Talus has version {version}: compile "
                       "it anew") if other else f"has no function talus_make_shape_{version}: see custom_shape.h"
            self.refuse(f"custom ./{name}.so 0 {LAW}", message, f"./{name}.so", 1)

    def test_own_shape(self):
        folder = os.path.join(SOURCE, "examples", "custom_shape")
        with open(os.path.join(folder, "torus.cpp")) as file:
            line, = re.findall(r"^// +(g\+\+ .*)$", file.read(), re.M)    # as its header tells users to
        command = line.replace("-o torus.so", "-o '" + self.path("torus.so") + "'")
        subprocess.run(command, shell=True, cwd=folder, check=True)
        # in the hole of the ring, touching its wire at x = 1.2
        write_sphere_data(self.path("grains"), ((-9, 9), (-9, 9), (-9, 9)), [Sphere((0.8, 0, 0))])
        ring = "custom ./torus.so 8 0 0 0 0 0 2 1.6 0.4"
        for np in (1, 2):
            rows = thermo(self.run_lammps(SCENE + f"""
fix body all large/body {ring} {LAW} move rotate 0 0 0 0 0 1 1
thermo_style custom step f_body[1] f_body[3] f_body[20]
run 0
""", np=np).log)
            self.assertAlmostEqual(rows[0]["f_body[1]"], 1e4 * 0.1, delta=1e-8)
        self.refuse("custom ./torus.so 3 0 0 0 " + LAW, "'./torus.so': a torus has 8 arguments, not 3", "./torus.so", 2)
        self.refuse(f"{ring.replace('1.6', '0.3')} {LAW}", "ring radius > wire radius > 0", "./torus.so", 1)

    def test_region(self):
        # a well as a region and as a shape: the same motion
        write_sphere_data(self.path("grains"), ((-9, 9), (-9, 9), (-9, 9)),
                          [Sphere((2.3, 0.3, -2.2), v=(2, 3, 0)), Sphere((-2.0, 0, -1.5), v=(-1, 1, 0))])
        law = "contact hooke 1e4 10 tangential multistep NULL NULL 0.4"
        frames = []
        for shape in ("region well", "cylinder 0 0 0 0 0 1 3 6 inside"):
            self.run_lammps(SCENE + f"fix body all large/body {shape} {law}\nrun 800\nwrite_dump all custom state id x y "
                            "z vx vy vz omegax omegay omegaz modify format float %.17g\n", np=2)
            frames.append(read_dump(self.path("state"))[0])
        worst = max(abs(a - b) for t in (1, 2) for a, b in zip(frames[0].atoms[t], frames[1].atoms[t]))
        print(f"region against cylinder: largest difference {worst:.1e}")
        self.assertLess(worst, 1e-9)
        self.assertLess(math.hypot(*frames[0].atoms[1][1:3]), 2.51)


if __name__ == "__main__":
    unittest.main(verbosity=2)
