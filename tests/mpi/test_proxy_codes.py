# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=15 timeout=300
"""Encoded values through the direct exchange, for every decomposition that bricks can make.

Without physics, in two programs: the transfer alone, without LAMMPS, and the host's communication
object with `comm_proxy yes`.  27 ranks are in test_proxy_codes_long.py."""

import os
import random
import unittest

from talus_testing import SceneCase, Sphere, run_program, write_sphere_data

RANKS = 1, 2, 4, 8

SCENE = """
units lj
boundary {boundary}
atom_style {style}
atom_modify map yes
newton off
processors {grid}
comm_modify vel {vel} cutoff {cutoff}
{box}
{middle}
pair_style zero 1.2 nocoeff
pair_coeff * *
neighbor 0.3 bin
{change}
comm_proxy yes
comm_proxy check yes
{after}
run 0
"""
DATA = "read_data grains"
TRICLINIC = """
region box prism 0 7 0 6 0 5 {tilt}
create_box 1 box
create_atoms 1 random 300 881 box
set type 1 diameter 1.0 density 1.0
"""
ATOMIC = """
region box block 0 7 0 6 0 5
create_box 2 box
create_atoms 1 random 300 881 box
{set}
"""
DEFAULT = dict(boundary="p p p", style="sphere", grid="* * *", vel="yes", cutoff=1.5, box=DATA,
               middle="", change="", after="")
DEFORM = """
fix step all nve/sphere
fix shape all deform 1 {what} remap x
thermo 100
run 60
"""


def scenes(ranks):
    """{name: script}"""
    cases = {"cubic": {}}
    for name, grid in (("x", f"{ranks} 1 1"), ("y", f"1 {ranks} 1"), ("z", f"1 1 {ranks}")):
        cases["line along " + name] = dict(grid=grid, cutoff=1.2)
    for name, grid in (("xy", "* * 1"), ("xz", "* 1 *"), ("yz", "1 * *")):
        cases["plane " + name] = dict(grid=grid)
    for boundary in "p p f", "p f p", "f p p", "p f f", "f f p", "f p f", "f f f", "s p m":
        cases["boundary " + boundary] = dict(boundary=boundary)
    cases["thin"] = dict(cutoff=3.3)
    cases["thinner"] = dict(cutoff=3.3, grid=f"{ranks} 1 1")
    cases["thin, walls"] = dict(cutoff=3.3, grid=f"1 1 {ranks}", boundary="f p f")
    cases["several periods"] = dict(cutoff=15.5)
    cases["no velocities"] = dict(vel="no")
    cases["uneven"] = dict(change="balance 1.0 shift xyz 20 1.01")
    cases["uneven, thin"] = dict(change="balance 1.0 shift xyz 20 1.01", cutoff=3.3)
    cases["uneven, walls"] = dict(change="balance 1.0 shift xz 20 1.01", boundary="f f f",
                                  cutoff=2.4)
    tiled = dict(middle="comm_style tiled\n")
    cases["tiled"] = tiled
    cases["tiled, thin"] = dict(tiled, cutoff=3.3)
    cases["rcb"] = dict(tiled, change="balance 1.0 rcb")
    cases["rcb, walls"] = dict(tiled, change="balance 1.0 rcb", boundary="f p f", cutoff=2.4)
    cases["rcb, tilted"] = dict(tiled, change="balance 1.0 rcb", box=TRICLINIC.format(tilt="0.5 -0.3 0.2"))
    if ranks > 1:
        cuts = " ".join(str(0.05 + 0.9 * k / ranks ** 1.2) for k in range(1, ranks))
        cases["uneven by hand"] = dict(grid=f"{ranks} 1 1", change=f"balance 1.0 x {cuts}")
    cases["group"] = dict(middle="group some type 1\natom_modify first some\n"
                                 "comm_modify group some\n")
    for name, tilt in (("small", "0.5 -0.3 0.2"), ("large", "3.5 -2.5 2.0")):
        box = TRICLINIC.format(tilt=tilt)
        cases["triclinic " + name] = dict(box=box)
        cases["triclinic thin " + name] = dict(box=box, cutoff=3.0)
        cases["triclinic walls " + name] = dict(box=box.replace("3.5 -2.5 2.0", "3.5 0 0")
                                                .replace("0.5 -0.3 0.2", "0.5 0 0"),
                                                boundary="p p f")
    cases["deform"] = dict(after=DEFORM.format(what="x erate 0.5 y erate -0.3"))
    cases["deform, tilted"] = dict(box=TRICLINIC.format(tilt="0.5 -0.3 0.2"),
                                   after=DEFORM.format(what="xy erate 0.5"))
    moves = DEFORM.replace("remap x", "remap v")
    cases["deform with velocities"] = dict(after=moves.format(what="x erate 0.5 y erate -0.3"))
    cases["deform with velocities, tilted"] = dict(box=TRICLINIC.format(tilt="0.5 -0.3 0.2"),
                                                   after=moves.format(what="xy erate 0.5 yz erate 0.2"))
    cases["radii that vary"] = dict(style="sphere 1")
    cases["atomic"] = dict(style="atomic", box=ATOMIC.format(set="mass * 1.0"))
    cases["ellipsoids"] = dict(style="ellipsoid", box=ATOMIC.format(    # messages of any length
        set="set type 1 type/fraction 2 0.5 7\nset type * density 1\nset type 1 shape 1 1 2\n"
            "set type 1 quat 1 0 0 30"))
    cases["hybrid"] = dict(style="hybrid sphere dipole", box=ATOMIC.format(
        set="set type 1 diameter 1.0\nset type 1 density 1\nset type 1 dipole/random 7 1.0"))
    return {name: SCENE.format(**{**DEFAULT, **case}) for name, case in cases.items()}


def grains():
    """More of them at the low corner, so that balancing has something to do."""
    draw = random.Random(2)
    def place(length):
        return length * draw.random() ** 1.5
    return [Sphere((place(7.0), place(6.0), place(5.0)), diameter=draw.uniform(0.5, 1.0),
                   type=draw.choice((1, 2))) for _ in range(400)]


class ProxyCodes(SceneCase):

    def run_codes(self, program, ranks, arguments=()):
        result = run_program(os.path.join(os.environ["TALUS_BINARY_DIR"], "tests", program),
                             np=ranks, arguments=arguments, cwd=self.dir)
        self.assertEqual(result.output.count("codes right"), 1, result.output[-3000:])
        return result.output

    def check_scenes(self, ranks):
        write_sphere_data(self.path("grains"), ((0, 7), (0, 6), (0, 5)), grains())
        names = []
        for name, script in scenes(ranks).items():
            names.append("in." + name.replace(" ", "_"))
            self.write(names[-1], script)
        output = self.run_codes("proxy_state_codes", ranks, names)
        counts = [line.split() for line in output.splitlines() if line.endswith("ghosts")]
        self.assertEqual(len(counts), len(names), output[-3000:])
        for scene, number, _ in counts:    # that something was exchanged at all
            if ranks > 1 or scene not in ("in.boundary_f_f_f", "in.boundary_s_p_m",
                                          "in.uneven,_walls"):
                self.assertGreater(int(number), 0, scene)

    def test_transfer(self):
        for ranks in RANKS:
            with self.subTest(ranks=ranks):
                self.run_codes("proxy_transfer_codes", ranks)

    def test_states(self):
        for ranks in RANKS:
            with self.subTest(ranks=ranks):
                self.check_scenes(ranks)


if __name__ == "__main__":
    unittest.main()
