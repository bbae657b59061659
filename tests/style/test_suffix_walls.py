# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=70 timeout=300 stay
"""fix wall/gran/talus and wall/gran/region/talus against the stock fixes: the same bits.

The contacts are computed by the model of LAMMPS, and the sums have one order: so each scene runs with the stock wall,
through the arrays of LAMMPS, and with the accelerated one, in the records, and all dumps must be equal.  Particles that
are no candidates are what could go wrong: walls and grains are fast, and lists old.

Where a wall is, is computed in two places, of which that of LAMMPS may fuse multiplications with additions: amplitudes
are powers of two, and cylinders are compared up to rounding.  Collisions of grains make rounding larger, each scene by
another factor: how much, tells the stock wall itself with all grains displaced by the last digits of their places."""

import re
import unittest

from talus_testing import SceneCase, head, max_difference, read_dump, write_sphere_data
from tossed_grains import tossed_grains

RECORDS = "steps without output are made in Talus' own records|steps without output +in the records"
HOST = "every step goes through the arrays of LAMMPS: |through the arrays of LAMMPS: "
BEGIN = head()
SCENE = BEGIN + """
{read}
group some id <= 100
pair_style gran/penalty
pair_coeff * * hertz 4000.0 40.0 tangential multistep NULL NULL 0.5
neighbor 0.1 bin
timestep 0.001
fix step all nve/sphere/symplectic gravity 10.0 vector 0.3 0.1 -1
{walls}
{more}
comm_proxy yes
run_style verlet/proxy
thermo 1000
thermo_modify norm no lost ignore
dump all all custom 53 {dump} id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz{columns}
dump_modify all format float %a sort id
{run}
"""
HOOKE = "hooke 4000.0 NULL 20.0 NULL 0.5 0"
HOOKE_HISTORY = "hooke/history 4000.0 NULL 20.0 NULL 0.5 0"
HERTZ_HISTORY = "hertz/history 4000.0 NULL 40.0 NULL 0.5 1 limit_damping"
MINDLIN = ("granular hertz/material 1e4 0.4 0.3 tangential mindlin NULL 1.0 0.5 rolling sds 500.0 20.0 0.1 "
           "twisting marshall damping tsuji")
COHESIVE = ("granular jkr 1e4 0.3 0.3 20.0 tangential mindlin_rescale/force NULL 1.0 0.5 rolling sds 500.0 20.0 0.1 "
            "damping viscoelastic")
DMT = "granular dmt 1e4 0.3 0.3 20.0 tangential linear_history 3000.0 1.0 0.5"

# of all kinds; {wall}: style, {law}: words of the model
BOX = """fix xw all {wall} {law} xplane 0 9.5
fix yw all {wall} {law} yplane 0 7.2
"""
FLOOR = "fix zw all {wall} {law} zplane 0 NULL\n"
PLANES = {
    "box": BOX + FLOOR,
    "lid": BOX + "fix zw all {wall} {law} zplane 0 3.6\n",
    "wiggled floor": BOX + "fix zw all {wall} {law} zplane 0 NULL wiggle z 0.5 0.4\n",
    "floor wiggled along itself": BOX + "fix zw all {wall} {law} zplane 0 NULL wiggle x 0.4 0.3\n",
    "sheared floor": BOX + "fix zw all {wall} {law} zplane 0 NULL shear y 3.0\n",
    "fast piston": BOX + FLOOR + "fix px all {wall} {law} xplane -2.5 NULL wiggle x 4.0 0.5\n",
    "of a group": BOX + "fix zw some {wall} {law} zplane 0 NULL\nfix zz all {wall} {law} zplane -2 NULL\n",
}
CYLINDER = {
    "cylinder": "fix cw all {wall} {law} zcylinder 12.5\n" + FLOOR,
    "cylinder sheared along its axis": "fix cw all {wall} {law} zcylinder 12.5 shear z 2.0\n" + FLOOR,
    "cylinder wiggled along its axis": "fix cw all {wall} {law} zcylinder 12.5 wiggle z 0.5 0.3\n" + FLOOR,
}
TURN = "variable turn equal 'v_rate*time'\nvariable rate equal 3.0\n"
SHAKE = "variable dx equal swiggle(0,1.5,0.4)\nvariable dz equal 'ramp(0.0,1.5) + 0.2*sin(20*step*dt)'\n"
SWELL = "variable radius equal '2.5 + swiggle(0,1.2,0.3)'\n"
REGIONS = {
    "box": "region w block 0 9.5 0 7.2 0 9\n",
    "box open at a side": "region w block 0 9.5 0 7.2 0 9 open 2 open 6\n",
    "cylinder": "region w cylinder z 4.75 3.6 6.5 0 9\n",
    "cylinder without ends": "region w cylinder z 4.75 3.6 5.0 0 9 open 1 open 2\n",
    "narrow tube": "region w cylinder z 4.7 3.6 0.6 -30 30\n",
    "obstacle": "region w sphere 4.7 3.5 0.5 1.5 side out\n",
    "hopper": "region w cone z 4.75 3.6 1.0 7.0 -0.6 6 open 1\n",
    "prism": "region w prism -0.5 10 -0.5 7.7 0 8 0.4 0.8 -0.5\n",
    "tilted plane": "region w plane 0 0 0 0.3 0.1 1\n",
    "ball": "region w sphere 4.7 3.5 1.5 6.5\n",
    "drum": TURN + "region w cylinder y 4.75 3.0 6.2 -0.5 7.6 rotate v_turn 4.75 0 3.0 0 1 0\n",
    "turning box": TURN + "region w block -1.5 11 -1.5 9 -1 9 rotate v_turn 4.7 3.6 4 0.2 1 0.3\n",
    "shaken box": SHAKE + "region w block 0 9.5 0 7.2 0 9 move v_dx NULL v_dz\n",
    "moved and turned": SHAKE + TURN + "region w block 3 6 2 5 -1 1.5 side out move v_dx NULL v_dz "
                        "rotate v_turn 4.5 3.5 0 0 0 1\n",
    # LAMMPS reads the point of contact of a region that swells, but computes it only if it turns
    "swelling ball": SWELL + TURN + "region w sphere 4.7 3.5 0.0 v_radius side out rotate v_turn 4.7 3.5 0 0 0 1\n",
    "union": "region a sphere 2.0 2.0 0.5 1.3\nregion b block 5 8 2 5 -1 1.2\nregion w union 2 a b side out\n",
    "inside of a union": "region a cylinder z 3 3.6 4.5 0 9\nregion b block 4 10 0 7 0.5 8\nregion w union 2 a b\n",
    "moving part of a union": SHAKE + "region a sphere 3.0 3.0 0.3 1.3 move v_dx NULL v_dz\nregion b block 5 8 2 5 -1 1.2\n"
                              "region w union 2 a b side out\n",
    "stirred tank": TURN + "region a block -0.2 9.7 -0.2 7.4 0 9\n"
                    "region b block 3 6 3 4 -1 1.5 side out rotate v_turn 4.5 3.5 0 0 0 1\nregion w intersect 2 a b\n",
    "intersection": "region a block -0.2 9.7 -0.2 7.4 0 9\nregion b sphere 4.7 3.5 0.5 1.5 side out\n"
                    "region w intersect 2 a b\n",
}


# Of the largest number, until grains have met a wall a few times; and later, times what grows from DISPLACED: that enters
# once, and rounding in each step of a contact with the wall.
EARLY, TIMES = 1e-12, 30.0
DISPLACED = "".join(f"variable place_{c} atom {c}+4e-15\nset group all {c} v_place_{c}\n" for c in "xyz")


def difference(frame, other):
    """The largest, relative to the largest vector or tensor of its kind."""
    most = 0.0
    for key in frame.columns:
        alike = [column for column in frame.columns if column[:2] == key[:2] or {column, key} <= {"x", "y", "z"}]
        scale = frame.largest(alike)
        if scale > 0.0:
            most = max(most, max_difference(frame, other, [key]) / scale)
        elif max_difference(frame, other, [key]) > 0.0:
            most = float("inf")
    return most


class Walls(SceneCase):

    def setUp(self):
        super().setUp()
        write_sphere_data(self.path("grains"), ((-30, 40), (-30, 40), (-30, 40)), tossed_grains(3))

    def run_scene(self, walls, accelerated, law=HOOKE_HISTORY, more="", run="run 900", region=False, dump="dump",
                  columns="", read="read_data grains", **options):
        style = "wall/gran" + ("/region" if region else "") + ("/talus" if accelerated else "")
        result = self.run_lammps(
            SCENE.format(walls=walls.format(wall=style, law=law), more=more, run=run, dump=dump, columns=columns,
                         read=read), **options)
        return read_dump(self.path(dump)), result.log

    def assert_same_numbers(self, frames, others, displaced):
        """But for rounding. `displaced`: runs the scene of `frames` with all grains displaced, if that is needed."""
        for frame, other in zip(frames, others, strict=True):
            self.assertEqual(sorted(frame.atoms), sorted(other.atoms))
        differences = [difference(*both) for both in zip(frames, others)]
        if max(differences) <= EARLY:
            return
        grown = [difference(*both) for both in zip(frames, displaced(), strict=True)]
        for k, frame in enumerate(frames):
            limit = EARLY if frame.step <= 160 else max(EARLY, TIMES * max(grown[:k + 1]))
            self.assertLessEqual(differences[k], limit, f"at step {frame.step}")

    def assert_same(self, walls, in_records=True, **options):
        stock, log = self.run_scene(walls, False, **options)
        self.assertRegex(log, HOST)
        ours, log = self.run_scene(walls, True, **options)
        self.assertRegex(log, RECORDS if in_records else HOST)
        self.assertGreater(len(stock), 3)
        self.assert_same_numbers(stock, ours, lambda: self.run_displaced(walls, False, **options))
        return ours, log

    def run_displaced(self, walls, accelerated, more="", **options):
        return self.run_scene(walls, accelerated, more=DISPLACED + more, **options)[0]

    def test_planes(self):
        for name, walls in PLANES.items():
            with self.subTest(walls=name):
                self.assert_same(walls)

    def test_models(self):
        for law in HOOKE, HERTZ_HISTORY, MINDLIN, COHESIVE, DMT:
            with self.subTest(law=law):
                self.assert_same(PLANES["wiggled floor"], law=law)
                self.assert_same(REGIONS["shaken box"] + "fix w all {wall} {law} region w\n", law=law, region=True)

    def test_cylinder_of_planes(self):
        """zcylinder, which newer LAMMPS does not have."""
        for name, walls in CYLINDER.items():
            with self.subTest(walls=name):
                if re.search(r"LAMMPS \(.* 202[6-9]", self.run_lammps("run 0\n", expect_error=True).log):
                    result = self.run_lammps(SCENE.format(
                        walls=walls.format(wall="wall/gran/talus", law=HOOKE), more="", run="", dump="dump",
                        columns="", read="read_data grains"), expect_error=True)
                    self.assertIn("zcylinder", result.log)
                else:
                    stock, _ = self.run_scene(walls, False, run="run 400")
                    ours, log = self.run_scene(walls, True, run="run 400")
                    self.assertRegex(log, RECORDS)
                    for frame, other in zip(stock, ours):
                        self.assertLess(max_difference(frame, other, ("x", "y", "z", "omegax")), 1e-9)

    def test_regions(self):
        for name, region in REGIONS.items():
            with self.subTest(region=name):
                self.assert_same(region + "fix w all {wall} {law} region w\n", region=True)

    def test_swelling_pushes_like_swelling_and_turning(self):
        """A ball that does not turn has the velocities of its surface all the same."""
        still = SWELL + "variable turn equal 0.0\n" + "region w sphere 4.7 3.5 0.0 v_radius side out"
        walls = [region + "\nfix w all {wall} {law} region w\n"
                 for region in (still, still + " rotate v_turn 4.7 3.5 0 0 0 1")]
        frames = [self.run_scene(one, True, region=True)[0] for one in walls]
        self.assert_same_numbers(*frames, lambda: self.run_displaced(walls[0], True, region=True))

    def test_old_lists(self):
        """Nobody looks how far particles have gone."""
        for check in "every 40 delay 0 check no", "every 20 delay 40 check yes":
            more = "neigh_modify " + check
            with self.subTest(check=check):
                self.assert_same(PLANES["fast piston"], more=more)
                for name in "shaken box", "obstacle", "inside of a union", "drum":
                    self.assert_same(REGIONS[name] + "fix w all {wall} {law} region w\n", region=True, more=more)

    def test_through_the_arrays(self):
        """The same candidates serve where each step goes through the arrays of LAMMPS."""
        more = "fix none all recenter NULL NULL NULL units box"
        self.assert_same(PLANES["fast piston"], more=more, in_records=False)
        self.assert_same(REGIONS["moved and turned"] + "fix w all {wall} {law} region w\n", region=True, more=more,
                         in_records=False)

    def test_contacts_by_particle(self):
        columns = "".join(f" f_zw[{n}]" for n in range(1, 9))
        walls = BOX + "fix zw all {wall} {law} zplane 0 NULL wiggle z 0.125 0.5 contacts\n"
        ours, _ = self.assert_same(walls, columns=columns)
        self.assertGreater(sum(sum(frame.column("f_zw[1]").values()) for frame in ours), 20)
        region = REGIONS["box"] + "fix zw all {wall} {law} region w contacts\n"
        self.assert_same(region, region=True, columns=columns)

    def test_threads(self):
        for walls, region in (PLANES["lid"], False), (REGIONS["drum"] + "fix w all {wall} {law} region w\n", True):
            one, _ = self.run_scene(walls, True, region=region)
            many, _ = self.run_scene(walls, True, region=region, env={"OMP_NUM_THREADS": "3"})
            for frame, other in zip(one, many):
                self.assert_same_bits(frame, other)

    def test_restart_crosses(self):
        """Histories of walls in a restart file, either way."""
        drum = REGIONS["drum"] + "fix w all {wall} {law} region w\n"
        for walls, region in (PLANES["wiggled floor"], False), (drum, True):
            for first in False, True:
                with self.subTest(region=region, first=first):
                    self.run_scene(walls, first, region=region, run="run 600\nwrite_restart mid")
                    stock, _ = self.run_scene(walls, False, region=region, read="read_restart mid")
                    ours, log = self.run_scene(walls, True, region=region, read="read_restart mid")
                    self.assertRegex(log, r"fix style: wall/gran(/region)?, fix ID: (zw|w)\n")
                    self.assert_same_numbers(stock, ours, lambda: self.run_displaced(
                        walls, False, region=region, read="read_restart mid"))

    def test_walls_that_come_and_go(self):
        run = ("run 400\nunfix zw\nrun 100\nfix zw all {wall} {law} zplane -0.3 NULL\nrun 200\n"
               "run 100 pre no post no\nrun 100 pre no\nrun 300")
        style = "wall/gran"
        self.assert_same_with(PLANES["box"], run, style, False)
        change = ("run 400\nunfix w\nregion w delete\nregion w block -1 10 -1 8 -0.5 9\n"
                  "fix w all {wall} {law} region w\nrun 200\n"
                  "region w delete\nregion w block -1.2 10 -1 8 -0.6 9\nrun 300")
        self.assert_same_with(REGIONS["box"] + "fix w all {wall} {law} region w\n", change, style + "/region", True)

    def assert_same_with(self, walls, run, style, region):
        def with_style(suffix):
            return dict(accelerated=bool(suffix), region=region, run=run.format(wall=style + suffix, law=HOOKE_HISTORY))

        frames = [self.run_scene(walls, **with_style(suffix))[0] for suffix in ("", "/talus")]
        self.assert_same_numbers(*frames, lambda: self.run_displaced(walls, **with_style("")))

    def test_between_bodies(self):
        """A large body behind a wall adds its forces behind it."""
        body = "fix b{n} all large/body plane 0 0 0.1 0 0 1 contact hertz 4000.0 40.0 tangential multistep NULL NULL 0.5\n"
        for walls in body.format(n=1) + PLANES["box"], PLANES["box"] + body.format(n=1):
            self.assert_same(walls)

    def reason(self, walls, region=False, more="", **options):
        ours, log = self.run_scene(walls, True, region=region, more=more, run="run 20", **options)
        self.assertRegex(log, HOST)
        return log

    def test_reasons(self):
        region = "fix w all {wall} {law} region w\n"
        self.assertIn("its region may move with particles: v_turn reads more than time",
                      self.reason("variable turn equal ke*0\n"
                                  "region w cylinder y 4 3 30 -20 20 rotate v_turn 4 0 3 0 1 0\n" + region, True))
        self.assertIn("its region may move with particles: v_other reads more than time",
                      self.reason("compute t all ke\nvariable other equal c_t\n" + SWELL +
                                  "region w sphere 4.7 3.5 0.0 v_radius side out\n" + region, True))


if __name__ == "__main__":
    unittest.main()
