# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""Bodies and region walls that end on faces of a periodic box go on behind them: nothing happens to what slides over a face."""

import math
import unittest

from body_meshes import grid, write_stl
from talus_testing import SceneCase, head, read_dump

SLIDE = head(boundary="p p f") + """
region box block 0 10 0 4 -1 5
create_box 1 box
create_atoms 1 single 5 2 0.49
create_atoms 1 single 7 1 0.49
set group all diameter 1.0 density 1.0
neighbor 0.3 bin
velocity all set 1.0 0.3 0
pair_style gran/penalty
pair_coeff * * hooke 100 0
fix step all nve/sphere/symplectic gravity {gravity} vector 0 0 -1
{floor}
timestep 0.001
thermo 2000
thermo_style custom step ke
thermo_modify norm no format float %.12g
dump all all custom 2000 dump id vx vy vz z
dump_modify all format float %.15g sort id
run {steps}
"""
GRAVITY = 100 * 0.01 / (math.pi / 6)    # an overlap of .01
OWN = {
    "box": "fix w all large/body box 5 2 -0.5 10 4 1 outside contact hooke 100 0",
    "rectangle": "fix w all large/body rectangle 5 2 0 0 0 1 1 0 0 10 4 contact hooke 100 0",
    "rectangle along y": "fix w all large/body rectangle 5 2 0 0 0 1 0 1 0 4 10 contact hooke 100 0",
    "region": "region r block 0 10 0 4 0 5 open 1 open 2 open 3 open 4 open 6\nfix w all large/body region r contact hooke 100 0",
    "mesh": "fix w all large/body mesh floor.stl contact hooke 100 0",
    "one-sided mesh": "fix w all large/body mesh floor.stl one-sided contact hooke 100 0",
    "wall of a region": ("region r block 0 10 0 4 0 5 open 1 open 2 open 3 open 4 open 6\n"
                         "fix w all wall/gran/region/talus hooke/history 100 NULL 1e-12 NULL 0 0 region r"),
}
WAVY = head(boundary="p p f") + """
region box block 0 10 0 4 -2 6
create_box 1 box
region grains block 0 10 0 4 0.5 4
create_atoms 1 random 60 77 grains overlap 1.0 maxtry 200
displace_atoms all move {shift} 0 0
set group all diameter 1.0 density 1.0
neighbor {skin} bin
velocity all set 2 0.5 0
pair_style gran/penalty
pair_coeff * * {law}
fix step all nve/sphere/symplectic gravity 1 vector 0 0 -1
fix w all large/body mesh wavy.stl contact {law}
timestep 0.001
thermo 1000
thermo_style custom step ke
dump all all custom 100 dump id x y z vx vy vz
dump_modify all format float %.15g sort id
run {steps}
"""


RIDGE = head(boundary="p p f") + """
region box block 0 {length} 0 4 -2 5
create_box 1 box
create_atoms 1 single 2.0995 2 1
set group all diameter 1.0 density 1.0
neighbor 0.3 bin
velocity all set 1 0 0
pair_style gran/penalty
pair_coeff * * hooke 1e4 0
fix step all nve/sphere/symplectic
fix w all large/body mesh ridge.stl contact hooke 1e4 5
timestep 0.0005
thermo 1000
thermo_style custom step ke
dump all all custom 50 dump id vx vy vz z
dump_modify all format float %.15g sort id
run 600
"""


def wavy(shift):
    """Waves with the period of the box, that begin anywhere."""
    def at(i, j):
        x = i / 4
        return x, j, 0.3 * math.sin(2 * math.pi * (x + shift) / 5)
    return grid(at, 40, 4)


class PeriodicFloors(SceneCase):

    def slide(self, floor, np=1, steps=16000):
        write_stl(self.path("floor.stl"), [((0, 0, 0), (10, 0, 0), (10, 4, 0)), ((0, 0, 0), (10, 4, 0), (0, 4, 0))])
        self.run_lammps(SLIDE.format(floor=floor, gravity=GRAVITY, steps=steps), np=np)
        return read_dump(self.path("dump"))

    def test_nothing_happens_on_a_flat_floor(self):
        for name, floor in OWN.items():
            for np in (1, 2) if name in ("mesh", "wall of a region") else (1,):
                with self.subTest(floor=name, np=np):
                    for frame in self.slide(floor, np):
                        for tag in 1, 2:
                            for column, value in ("vx", 1.0), ("vy", 0.3), ("vz", 0.0), ("z", 0.49):
                                self.assertAlmostEqual(frame.column(column)[tag], value, delta=1e-9)

    def wave(self, shift, skin, law="hooke 1e3 2 tangential multistep NULL NULL 0.4"):
        write_stl(self.path("wavy.stl"), wavy(shift))
        self.run_lammps(WAVY.format(skin=skin, steps=1000, law=law, shift=-shift))
        return read_dump(self.path("dump"))

    def assert_same_motion(self, frames, others):
        for a, b in zip(frames, others, strict=True):
            for column in "vx", "vy", "vz", "z":
                for tag, value in a.column(column).items():
                    self.assertAlmostEqual(value, b.column(column)[tag], delta=1e-7)

    def test_waves_may_begin_anywhere(self):
        first = self.wave(0.0, 0.3)
        self.assertGreater(max(abs(v) for v in first[-1].column("vz").values()), 0.1)
        for shift in 0.25, 2.5, 7.75:
            with self.subTest(shift=shift):
                self.assert_same_motion(first, self.wave(shift, 0.3))

    def test_lists_do_not_matter(self):
        """With the shortest skin grains are hardly ever beyond a face, with a long one often."""
        self.assert_same_motion(self.wave(0.25, 0.02), self.wave(0.25, 0.6))

    def test_a_grain_that_reaches_far_over_a_face(self):
        """A ridge .56 behind the face: a grain that was at the face when lists were made touches it before they are made
        anew. In a box of three periods the face is elsewhere."""
        length, profile, found = 2.1, ((0, 0), (0.56, 0), (0.62, 2), (0.68, 0)), []
        for periods in 1, 3:
            def at(i, j, periods=periods):
                x, z = profile[i % 4]
                return i // 4 * length + x, 4.0 * j, float(z)
            write_stl(self.path("ridge.stl"), grid(at, 4 * periods, 1))
            self.run_lammps(RIDGE.format(length=periods * length))
            found.append(read_dump(self.path("dump")))
        self.assert_same_motion(*found)
        self.assertLess(found[0][-1].column("vx")[1], -0.5)


if __name__ == "__main__":
    unittest.main()
