# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=40 timeout=300 stay
"""fix wall/gran/region/talus with regions that have a formula: contacts are those that LAMMPS finds.

Which grains may touch is found eight at a time; grains at random places, each of which knows a region and nothing else, are
pushed by the stock fix and by ours. Those that are left out by mistake have no force, or keep a history that should be gone.
Sides, open faces, motions, and unions and intersections."""

import random
import unittest

from talus_testing import SceneCase, Sphere, begin, read_dump, write_sphere_data

STIFFNESS = 100.0    # low: many grains begin deep in a wall
HOOKE = f"hooke/history {STIFFNESS} NULL 5.0 NULL 0.5 0"
COHESIVE = f"granular jkr {STIFFNESS} 0.3 0.3 1.0 tangential mindlin NULL 1.0 0.5 damping viscoelastic"

# one after the other each of these is a region of its own, with {more} behind
SHAPES = {
    "block": "block 1 7 0.5 6 1 8",
    "block without ends": "block 1 7 0.5 6 INF INF",
    "cylinder x": "cylinder x 3.5 4.5 2.9 1 7",
    "cylinder y": "cylinder y 3.5 4.5 2.9 INF 7",
    "cylinder z": "cylinder z 3.5 4.5 2.9 INF INF",
    "narrow cylinder": "cylinder z 3.5 4.5 0.8 -5 12",
    "cone x": "cone x 3.5 4.5 0.5 3.6 1 7",
    "cone y": "cone y 3.5 4.5 3.6 0.8 1 7",
    "cone z": "cone z 3.5 4.5 1.0 4.0 2 6",
    "sphere": "sphere 4 3.5 4.5 3.2",
    "plane": "plane 4 3.5 4.5 0.3 -1 0.7",
    "prism": "prism 0.5 6 1 7 0 8 0.4 0.8 -0.5",
}
SIDES = "", "side out"
OPEN = {"block": "open 2 open 6", "cylinder": "open 1", "cone": "open 2", "prism": "open 1 open 4"}
MOTIONS = {
    "still": "",
    "moved": "move v_dx NULL v_dz",
    "turned": "rotate v_turn 4.2 3.3 4.1 0.2 1 0.3",
    "moved and turned": "move v_dx v_dz NULL rotate v_turn 4.2 3.3 4.1 -0.5 0.2 1",
}
VARIABLES = """variable turn equal 0.7+5*time
variable dx equal swiggle(0,1.5,0.4)
variable dz equal 0.3+0.2*sin(20*step*dt)
"""
# of parts a, b and c
PARTS = """region a{k} cylinder z 4 4 3.5 0 8 {a}
region b{k} block 2.5 5 1 6 2 5 side out {b}
region c{k} sphere 6.5 4 4 2.2 {c}
"""
# LAMMPS finds next to nothing outside of a union, and the outside of an intersection must not be that of a block
COMPOSITES = "union 2 a{k} c{k}", "intersect 2 a{k} b{k}", "intersect 2 c{k} a{k} side out"
NESTED = "region n{k} union 2 a{k} c{k}\nregion w{k} intersect 2 n{k} b{k}\n"

GRAINS = 300    # that know a region
NEXT_TO_THE_SURFACE = 3    # of them at most
SCENE = begin(read="read_data grains", law="hertz 4000.0 40.0 tangential multistep NULL NULL 0.5") + """
neigh_modify exclude group all all every 1 {check}
neighbor 0.3 bin
timestep 0.001
{variables}{walls}
fix step all nve/sphere/symplectic gravity 10.0 vector 0.3 0.1 -1
comm_proxy yes
run_style verlet/proxy
thermo 1000
thermo_modify norm no lost ignore
dump all all custom 1 dump id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz
dump_modify all format float %a sort id
run 1
dump_modify all every 80
run 239
"""


def regions_of_shapes():
    """Name, and the commands that make region w{k}."""
    for name, shape in SHAPES.items():
        for side in SIDES:
            # with open faces both sides act, and `side out` allows for one contact
            for faces in ("", OPEN.get(name.split()[0])) if name.split()[0] in OPEN and not side else ("",):
                for motion, words in MOTIONS.items():
                    title = ", ".join(filter(None, (name, side, faces, motion)))
                    yield title, f"region w{{k}} {shape} {side} {faces} {words}\n"


def regions_of_regions():
    for motions in ("still", "still", "still"), ("still", "turned", "still"):
        parts = PARTS.replace("{a}", MOTIONS[motions[0]]).replace("{b}", MOTIONS[motions[1]]).replace(
            "{c}", MOTIONS[motions[2]])
        for words in COMPOSITES:
            yield f"{words}, {motions}", parts + f"region w{{k}} {words}\n"
        yield f"nested, {motions}", parts + NESTED


def random_grains(count, seed):
    some = random.Random(seed)
    return [Sphere(diameter=some.uniform(0.2, 0.9), density=1.0, x=tuple(some.uniform(-0.5, 8.5) for _ in "xyz"),
                     v=tuple(some.uniform(-3, 3) for _ in "xyz"), omega=tuple(some.uniform(-5, 5) for _ in "xyz"))
            for _ in range(count)]


def differences(frame, other, tags):
    """Of each grain, largest first: relative to the largest vector of its kind of all grains."""
    found = dict.fromkeys(tags, 0.0)
    for first in "x", "vx", "omegax", "fx", "tqx":
        keys = [first[:-1] + axis for axis in "xyz"]
        mine, theirs = [frame.column(key) for key in keys], [other.column(key) for key in keys]
        scale = frame.largest(keys) or 1.0
        for tag in tags:
            found[tag] = max(found[tag], max(abs(a[tag] - b[tag]) for a, b in zip(mine, theirs)) / scale)
    return sorted(found.values(), reverse=True)


class WallRegions(SceneCase):

    def script(self, regions, style, law, check):
        walls = ""
        for k, (_, commands) in enumerate(regions):
            walls += commands.replace("{k}", str(k))
            walls += f"group g{k} id {k * GRAINS + 1}:{(k + 1) * GRAINS}\nfix w{k} g{k} {style} {law} region w{k}\n"
        return SCENE.format(variables=VARIABLES, walls=walls, check=check)

    def run_scene(self, *of_script):
        self.run_lammps(self.script(*of_script))
        return read_dump(self.path("dump"))

    def refused(self, region, style, law, ranks):
        script = self.script([("", region)], style, law, "delay 0 check yes")
        result = self.run_lammps(script, np=ranks, expect_error=True, stay=False)    # one rank alone ends it
        return result.log + result.output

    def assert_same(self, regions, law=HOOKE, check="delay 0 check yes"):
        """All in one run: LAMMPS has 32 groups."""
        for begin in range(0, len(regions), 30):
            some = regions[begin:begin + 30]
            write_sphere_data(self.path("grains"), ((-30, 40),) * 3, random_grains(len(some) * GRAINS, begin))
            stock = self.run_scene(some, "wall/gran/region", law, check)
            ours = self.run_scene(some, "wall/gran/region/talus", law, check)
            for k, (name, _) in enumerate(some):
                tags = range(k * GRAINS + 1, (k + 1) * GRAINS + 1)
                with self.subTest(region=name):
                    # of regions of regions that turn, contacts of the same grains at the same places
                    first_only = "'turned'" in name
                    self.assert_frames(stock[:2] if first_only else stock, ours[:2] if first_only else ours, tags)

    def assert_frames(self, stock, ours, tags):
        self.assertIn([frame.step for frame in stock], ([0, 1], [0, 1, 80, 160, 240]))
        torque = stock[1].column("tqx")
        touched = sum(torque[tag] != 0.0 for tag in tags)
        self.assertTrue(2 <= touched < GRAINS, f"{touched} touch")
        for frame, other in zip(stock, ours, strict=True):
            found = differences(frame, other, tags)
            if frame.step > 1:
                self.assertLessEqual(found[0], 1e-9, f"at step {frame.step}")
                continue
            # of a center that is next to the surface LAMMPS itself knows the normal with few digits
            self.assertLessEqual(found[0], 1e-10, f"at step {frame.step}")
            self.assertLessEqual(found[NEXT_TO_THE_SURFACE], 1e-12, f"at step {frame.step}")

    def test_shapes(self):
        self.assert_same(list(regions_of_shapes()))

    def test_unions_and_intersections(self):
        self.assert_same(list(regions_of_regions()))

    def test_beyond_contact(self):
        self.assert_same([one for one in regions_of_shapes() if "moved and turned" in one[0]], law=COHESIVE)

    def test_between_opposite_faces(self):
        """More contacts than LAMMPS has room for: our variant must not write beyond it."""
        slit, pill, corner = (f"region w0 {words}\n" for words in (
            "block -29 -9 -29 -9 -20.3 -19.7", "cylinder z -20 -20 0.4 -20.3 -19.7", "block -20.4 0 -20.4 -19.6 -20.3 -19.7"))
        grains = [Sphere(diameter=1.0, density=1.0, x=(-20.0, -20.0, -20.0 + 0.01 * k), v=(0, 0, 0), omega=(0, 0, 0))
                  for k in range(3)]    # on the first rank, the one whose errors are in the log
        write_sphere_data(self.path("grains"), ((-30, 40),) * 3, grains)
        for region, law in (pill, HOOKE), (corner, HOOKE), (corner, HOOKE.replace("/history", "")), (pill, COHESIVE):
            for style in "wall/gran/region", "wall/gran/region/talus":
                for ranks in (1, 2, 3) if style.endswith("talus") else (1,):
                    with self.subTest(region=region, law=law, style=style, ranks=ranks):
                        said = self.refused(region, style, law, ranks)
                        self.assertIn("Too many wallgran/region contacts for one particle", said)
                        if style.endswith("talus"):
                            self.assertRegex(said, r"fix wall/gran/region w0 has room for [23] with region 'w0'")
        self.run_scene([("", slit)], "wall/gran/region/talus", HOOKE, "delay 0 check yes")

    def test_old_lists(self):
        """Grains and walls go further than the skin."""
        moving = [one for one in (*regions_of_shapes(), *regions_of_regions()) if "moved" in one[0]]
        self.assert_same(moving, check="delay 80 check yes")


if __name__ == "__main__":
    unittest.main()
