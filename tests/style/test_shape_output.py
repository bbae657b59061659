# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=60
"""What can be seen of convex particles: dump vtk/gran, dump image, fix_modify orient, what the log says of other commands."""

import math
import unittest

from talus_testing import SceneCase, Sphere, head, read_dump, thermo, write_sphere_data
from vtk_files import read_part, read_series

SCENE = head() + """
read_data grains
group balls type 1
neighbor 0.2 bin
pair_style gran/penalty
pair_coeff * * hooke 1e4 0 tangential multistep NULL NULL 0.5
timestep 1e-3
fix 1 balls nve/sphere/symplectic
fix s all shape/gran type 2 box 1 1 1 density 2 type 3 box 0.6 0.6 0.6 rounded 0.2 density 1
fix_modify s orient 2 0 0 0 3
fix floor all large/body plane 0 0 -0.5 0 0 1 contact hooke 1e4 0
dump film all vtk/gran 1 run.pvd id type
dump picture all image 1 run.*.png type diameter atom no fix s type 1 0.0 size 200 200
dump text all custom 1 text id mass radius f_s[1] f_s[4] fx fy fz
dump_modify text format float %.17g
compute pairs all pair gran/penalty
thermo_style custom step c_pairs[1] f_s[6] f_s[7] press
thermo_modify norm no
run 0
"""


class ShapeOutput(SceneCase):

    def test_parts_of_a_frame(self):
        # a cube, another one that lies on it, and a ball on top; gaps of -0.01
        write_sphere_data(self.path("grains"), 3 * ((-4, 4),),
                          [Sphere((0, 0, 2.47)), Sphere((0, 0, 0), type=2), Sphere((0.1, 0, 0.99), type=3),
                           Sphere((0, 0, 2.9), diameter=0.1)])
        for np in (1, 2):
            log = self.run_lammps(SCENE, np=np).log
            row, = thermo(log)
            self.assertEqual((row["c_pairs[1]"], row["f_s[6]"]), (2.0, 1.0 + 0.0))
            frame, = read_dump(self.path("text"))
            self.assertAlmostEqual(frame.column("mass")[2], 2.0)
            self.assertAlmostEqual(frame.column("radius")[2], 0.75 ** 0.5)
            self.assertAlmostEqual(frame.column("radius")[3], 0.27 ** 0.5 + 0.2)
            self.assertEqual([frame.column(f"f_s[{k}]")[2] for k in (1, 4)], [0.0, 1.0])
            self.assertEqual([frame.column(f"f_s[{k}]")[1] for k in (1, 4)], [0.0, 0.0])
            (_, parts), = read_series(self.path("run.pvd"))
            shapes = [piece for piece in read_part(parts["shapes"])]
            ids = [i for piece in shapes for i in piece.cell_data["id"]]
            self.assertEqual(ids.count(2), 12)
            self.assertGreater(ids.count(3), 100)
            self.assertEqual(ids.count(1), 0)
            points = [p for piece in shapes for p in piece.points]
            self.assertAlmostEqual(max(p[2] for p in points), 0.99 + 0.5, delta=1e-9)
            self.assertAlmostEqual(min(p[2] for p in points), -0.5, delta=1e-9)
            contacts, = read_part(parts["contacts"])
            total = [0.0, 0.0, 0.0]
            for i, j, force in zip(contacts.cell_data["id1"], contacts.cell_data["id2"], contacts.cell_data["force"]):
                if {i, j} == {2, 3}:
                    sign = 1 if i == 3 else -1
                    total = [t + sign * f for t, f in zip(total, force)]
            for value, key in zip(total, ("fx", "fy", "fz")):
                self.assertAlmostEqual(value, frame.column(key)[3], delta=1e-9)
            self.assertGreater(total[2], 50.0)
            with open(self.path("run.0.png"), "rb") as file:
                self.assertEqual(file.read(4), b"\x89PNG")

    def test_pictures_of_shapes_alone(self):
        """A cube of edge 2 and a ball of diameter 2, seen along an axis: with the sphere around it the cube cannot be seen."""
        write_sphere_data(self.path("grains"), 3 * ((-4, 4),), [Sphere((0, 2, 0), diameter=2.0), Sphere((0, -2, 0), type=2)],
                          types=3)
        scene = SCENE.split("fix s all")[0] + "fix s all shape/gran type 2 box 2 2 2 density 2 type 3 box 1 1 1 density 1\n"
        look = "size 200 200 view 90 0 box no 0 fsaa no shiny 0"
        for name, words in (("alone", "all image 1 {}.*.ppm type diameter atom no fix s type 1 0.0"),
                            ("balls", "balls image 1 {}.*.ppm type diameter fix s type 1 0.0"),
                            ("spheres", "all image 1 {}.*.ppm type diameter fix s type 1 0.0")):
            scene += f"dump {name} {words.format(name)} {look}\ndump_modify {name} acolor 1 red acolor 2 blue backcolor white\n"
        self.run_lammps(scene + "run 0\n")
        areas = {}
        for name in "alone", "balls", "spheres":
            with open(self.path(f"{name}.0.ppm"), "rb") as file:
                pixels = file.read()[-3 * 200 * 200:]
            kinds = [(pixels[k] > pixels[k + 2] + 15, pixels[k + 2] > pixels[k] + 15) for k in range(0, len(pixels), 3)]
            areas[name] = [sum(kind[n] for kind in kinds) for n in (0, 1)]
        cube = areas["alone"][1]
        self.assertEqual(areas["alone"][0], 0)
        self.assertGreater(cube, 500)
        # the ball touches four sides of a square as large
        self.assertAlmostEqual(areas["balls"][0] / cube, math.pi / 4, delta=0.05)
        self.assertAlmostEqual(areas["balls"][1], cube, delta=0.01 * cube)
        self.assertGreater(areas["spheres"][1], 2 * cube)    # 3 pi/4


if __name__ == "__main__":
    unittest.main()
