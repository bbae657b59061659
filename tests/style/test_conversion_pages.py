# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300 stay
"""Every line of the pages on other codes, on choosing coefficients and on output runs; both lines of a row give the same
motion, but for the half step by which integrators differ. Pebbles of the page on clumps fall, and parcels rebound as grains do."""

import math
import os
import random
import re
import unittest

import body_meshes
from doc_tables import SOURCE, blocks, commands, page, rows
from talus_testing import SceneCase, Sphere, begin, head, max_difference, read_dump, thermo, write_sphere_data

NEW = int(os.environ["TALUS_LAMMPS_VERSION"]) >= 20260000
MOTION = "x y z vx vy vz omegax omegay omegaz".split()

# Slots of the scene, in order; a line of a page takes the place of the slot that it belongs to.
SCENE = {
    "pair": ["pair_style gran/hooke/history 1e4 NULL 20 NULL 0.5 1", "pair_coeff * *"],
    "fix move": ["fix move all nve/sphere"],
    "fix fall": ["fix fall all gravity 9.81 vector 0 0 -1"],
    "fix floor": ["fix floor all wall/gran hooke 1e4 NULL 20 10 0.5 1 zplane 0 NULL"],
}
HEAD = head() + """
read_data grains
neighbor 0.2 bin
timestep 0.0005
"""
TAIL = """
thermo 50
thermo_modify norm no lost error
run {steps}
write_dump all custom state id x y z vx vy vz omegax omegay omegaz modify format float %.17g
"""


def slot_of(line):
    words = line.split()
    if words[0] in ("pair_style", "pair_coeff"):
        return "pair"
    return " ".join(words[:2]) if words[0] == "fix" else None


class PageCase(SceneCase):

    def setUp(self):
        draw = random.Random(6)
        grains = [Sphere(tuple(0.9 * s + 0.75 + draw.uniform(-0.02, 0.02) for s in (i, j, 0.9 * k)),
                         v=tuple(draw.gauss(0, 0.5) for _ in "xyz"), diameter=draw.uniform(0.8, 0.98))
                  for i in range(5) for j in range(5) for k in range(3)]
        write_sphere_data(self.path("grains"), ((-8, 8), (-8, 8), (-2, 20)), grains, types=2)
        body_meshes.write_stl(self.path("drum.stl"), body_meshes.sphere((2.5, 2.5, 4), 12, 12))
        os.makedirs(self.path("post"))

    def script_of(self, lines, replaced, steps):
        slots = {name: list(own) for name, own in SCENE.items()}
        for name in replaced:
            slots[name] = []
        more = []
        before = [line for line in lines if line.startswith("variable")]
        for line in (line for line in lines if line not in before):
            slots.get(slot_of(line), more).append(line)
        return "\n".join([HEAD, *before, *sum(slots.values(), []), *more, TAIL.format(steps=steps)])

    def simulate(self, lines, replaced=(), steps=60, **options):
        return self.run_lammps(self.script_of(lines, replaced, steps), **options).log

    def replaced_by(self, *lists):
        return {slot for lines in lists for slot in map(slot_of, lines) if slot in SCENE}

    def state(self):
        frame, = read_dump(self.path("state"))
        os.remove(self.path("state"))
        return frame


class FromLammps(PageCase):

    def test_tables(self):
        text = page("from_lammps.md")
        compared = 0
        for theirs, ours, differs in rows(text, "LAMMPS"):
            theirs, ours = commands(theirs), commands(ours)
            with self.subTest(theirs[-1]):
                if NEW and "zcylinder" in theirs[-1]:
                    log = self.simulate(theirs, self.replaced_by(theirs), expect_error=True)
                    self.assertIn("The zcylinder keyword has been removed", log)
                    self.simulate(ours, self.replaced_by(theirs, ours))
                    self.state()
                    continue
                self.simulate(theirs, self.replaced_by(theirs))
                reference = self.state()
                integrates = "symplectic" in ours[-1]    # its velocities are those of half a step before
                log = self.simulate(ours, self.replaced_by(theirs, ours))
                self.assertEqual(re.findall("WARNING: (?!.*overlap).*", log), [])
                frame = self.state()
                if integrates and "start half" not in ours[-1]:    # with the half step by which they differ at the start
                    self.simulate([*ours[:-1], ours[-1] + " start half"], self.replaced_by(theirs, ours))
                    frame = self.state()
                if "a fault" in differs and not NEW:
                    continue
                compared += 1
                self.assertLess(max_difference(frame, reference, MOTION[:3] if integrates else MOTION), 1e-8)
        self.assertGreater(compared, 20)

    def test_outputs(self):
        """Numbers of contacts are those of compute contact/atom."""
        (theirs, ours), = [(commands(theirs), commands(ours)) for theirs, ours, _ in rows(page("from_lammps.md"), "LAMMPS")
                           if "contact/atom" in theirs]
        counts = []
        for lines, column in ((theirs, "c_touching"), (ours, "c_touching[2]")):
            self.simulate([*lines, f"dump count all custom 60 counts.{len(counts)} id {column}"], self.replaced_by(lines))
            counts.append(read_dump(self.path(f"counts.{len(counts)}"))[-1].column(column))
        self.assertEqual(*counts)
        self.assertGreater(sum(counts[0].values()), 5)

    def test_one_law_for_many_bodies(self):
        block, = blocks(page("from_lammps.md"))
        self.simulate(block.splitlines(), {"pair", "fix floor"})


class FromLiggghts(PageCase):
    """Each row is a script: the lines of the table of the set-up, a few grains, and what the row does not bring itself."""

    GRAINS = """create_atoms 1 single 0.0 0.0 0.012
create_atoms 1 single 0.0025 0.001 0.014
set group all diameter 0.003
set group all density 2500"""
    MOVE = "fix integr all nve/sphere/symplectic gravity 9.81 vector 0 0 -1"

    def script(self, setup, pair, lines):
        early = [line for line in lines if line.split()[0] in ("region", "fill_region", "variable")]
        late = [line for line in lines if line not in early]
        return "\n".join([
            "units si", *setup, "region box block -0.1 0.1 -0.1 0.1 -0.1 0.1", "create_box 2 box", *early,
            *([] if any(line.startswith("fill_region") for line in early) else [self.GRAINS]),
            *([] if any(line.startswith("pair_style") for line in late) else pair), "timestep 1e-6",
            *([] if any("nve/sphere" in line for line in late) else [self.MOVE]), *late, "run 20"])

    def test_tables(self):
        text = page("from_liggghts.md")
        scripts = [(theirs, commands(ours)) for theirs, ours, *_ in rows(text, "LIGGGHTS")]
        setup = [line for _, lines in scripts for line in lines
                 if line.split()[0] in ("atom_style", "comm_modify", "newton", "boundary", "neighbor", "neigh_modify")]
        block, = blocks(text)
        pair = block.splitlines()[:2]
        bodies = 0
        for theirs, lines in scripts:
            lines = [line for line in lines if line not in setup]
            if not lines:
                continue
            with self.subTest(theirs):
                log = self.run_lammps(self.script(setup, pair, lines)).log
                self.assertEqual(re.findall("WARNING.*", log), [])
                bodies += "large/body" in log
        self.assertGreater(bodies, 8)
        self.run_lammps(self.script(setup, [], block.splitlines()))


class Choosing(PageCase):
    """The coefficients that the scripts of the page compute have the restitution and the overlap that were asked for."""

    IMPACT = """
create_atoms 1 single -0.001501 0 0
create_atoms 1 single 0.001501 0 0
set group all diameter ${d}
set group all density ${rho}
set atom 1 vx $(0.5*v_v)
set atom 2 vx $(-0.5*v_v)
"""
    REST = """
fix move all nve/sphere/symplectic
compute overlap all pair/local p11
compute deepest all reduce max c_overlap inputs local
variable speed equal vx[2]-vx[1]
thermo_style custom step c_deepest v_speed
thermo 1
run 60
"""

    def test_impacts(self):
        head = ("units si\natom_style sphere\natom_modify map yes\ncomm_modify vel yes\nboundary f f f\n"
                "region box block -0.01 0.01 -0.01 0.01 -0.01 0.01\ncreate_box 1 box\n")
        found = blocks(page("choosing.md"))
        self.assertEqual(len(found), 2)
        for block in found:
            variables, commands_of_talus = block.split("\npair_style")
            log = self.run_lammps(head + variables + self.IMPACT + "pair_style" + commands_of_talus + self.REST).log
            self.assertNotIn("WARNING", log)
            table = thermo(log)
            self.assertAlmostEqual(table[-1]["v_speed"], 0.8 * 0.5, delta=0.01)
            deepest = max(abs(row["c_deepest"]) for row in table if abs(row["c_deepest"]) < 1)
            self.assertGreater(deepest, 0.007)
            self.assertLess(deepest, 0.0101)


class Parcels(SceneCase):
    """What the page says of parcels is exact: a skew impact of grains that are K times as large is the same, K times as long."""

    K = 3.0
    LAWS = [("hooke {} {} tangential multistep NULL NULL 0.5 rolling 0.1", (2e3, 1), (30, -1)),
            ("hertz {} {} tangential multistep NULL NULL 0.5 rolling 0.1", (1e6, 0), (3e2, -2)),
            ("hertz/material {} 0.7 0.25 tangential multistep NULL NULL 0.5", (1e6, 0)),
            ("jkr {} {} 0.25 {} tangential multistep NULL NULL 0.5", (1e6, 0), (3e2, -2), (0.5, 1)),
            ("dmt {} {} 0.25 {} tangential multistep NULL NULL 0.5", (1e6, 0), (3e2, -2), (0.5, 1)),
            ("hooke {} {} tangential multistep NULL NULL 0.5 adhesion constant {}", (2e3, 1), (30, -1), (3.0, 2)),
            ("hooke {} {} tangential multistep NULL NULL 0.5 adhesion dmt {}", (2e3, 1), (30, -1), (3.0, 1.5)),
            ("hooke {} {} tangential multistep NULL NULL 0.5 adhesion perko {}", (2e3, 1), (30, -1), (3.0, 1))]

    def impact(self, k, law, *numbers):
        """Velocity and spin, times the size, of the first grain in steps of the impact."""
        write_sphere_data(self.path("grains"), [(-4 * k, 4 * k)] * 3,
                          [Sphere((-0.501 * k, 0, 0), v=(0.5, 0.2, 0), omega=(0, 0, 1 / k), diameter=k),
                           Sphere((0.501 * k, 0, 0), v=(-0.5, 0, 0), diameter=k)])
        law = law.format(*(repr(number * k**power) for number, power in numbers))
        rows = thermo(self.run_lammps(begin(read="read_data grains", law=law, skin=0.1 * k, dt=4e-4 * k) + f"""
fix move all nve/sphere/symplectic
variable vx equal vx[1]
variable vy equal vy[1]
compute spin all property/atom omegaz
variable spin equal {k}*C_spin[1]
thermo_style custom step v_vx v_vy v_spin
thermo 10
thermo_modify format float %.12g
run 250
""").log)
        return [value for row in rows for value in (row["v_vx"], row["v_vy"], row["v_spin"])]

    def test_impacts(self):
        for law, *numbers in self.LAWS:
            with self.subTest(law):
                grain, parcel = (self.impact(k, law, *numbers) for k in (1.0, self.K))
                self.assertLess(grain[-3], 0.2)    # it was stopped, or came back
                self.assertNotEqual(grain[-1], grain[2])
                self.assertLess(max(abs(a - b) for a, b in zip(grain, parcel)), 1e-9)
        grain, parcel = (self.impact(k, self.LAWS[0][0], (2e3, 0), (30, -1)) for k in (1.0, self.K))
        self.assertGreater(max(abs(a - b) for a, b in zip(grain, parcel)), 1e-3)    # it would be seen


class Output(PageCase):

    def test_tables(self):
        found = [commands(lines) for _, lines in rows(page("output.md"), "what you want")]
        self.assertGreater(len(found), 20)
        talus = ["pair_style gran/penalty", "pair_coeff * * ${law}",
                 "fix floor all large/body plane 0 0 0 0 0 1 contact ${law}"]
        law = 'variable law string "hooke 1e4 20 tangential multistep NULL NULL 0.5"'
        for lines in found:
            with self.subTest(lines[-1]):
                if "f_s[" in lines[-1]:
                    lines = ["unfix move", "fix s all shape/gran type 1 box 0.5 0.5 0.5 density 1", *lines]
                mixed = ["set group all type/ratio 2 0.5 4711"] if "v_lacey" in lines[-1] else []
                log = self.simulate([law, *mixed, *talus, *lines], {"pair", "fix floor"}, steps=100)
                self.assertEqual(re.findall("WARNING: (?!.*overlap).*", log), [])
                for name in re.findall(r"file (\S+\.txt)", " ".join(lines)):
                    self.assertTrue(os.path.getsize(self.path(name)))


class Pebbles(SceneCase):

    def test_lines(self):
        """A lattice of 4 x 4 x 6 clumps in free fall, and none of its spheres on its own."""
        lines, = [block for block in blocks(page("fix_rigid_small_symplectic.md")) if "input/pebble.mol" in block]
        log = self.run_lammps(head(units="si") + "region box block 0 0.08 0 0.08 0 0.2 units box\ncreate_box 1 box\n"
                              "pair_style gran/penalty\npair_coeff * * hooke 1e4 20\nneighbor 0.001 bin\ntimestep 1e-5\n"
                              + lines.replace("input/", os.path.join(SOURCE, "input", ""))
                              + "compute one all rigid/local move mass\ncompute clumps all reduce sum c_one inputs local\n"
                              "compute least all reduce min c_one inputs local\nvariable total equal mass(all)\n"
                              "variable speed equal vcm(all,z)\n"
                              "thermo_style custom step atoms c_clumps c_least v_total v_speed\n"
                              "thermo_modify format float %.12g\nrun 100\n").log
        last = thermo(log)[-1]
        self.assertEqual(last["Atoms"], 3 * 4 * 4 * 6)
        mass = 2600 * math.pi / 6 * 0.016**3 * (0.56**3 + 0.52**3 + 0.60**3)
        self.assertAlmostEqual(last["c_least"], mass, delta=1e-9 * mass)
        self.assertAlmostEqual(last["c_clumps"], last["v_total"], delta=1e-9 * last["v_total"])
        self.assertAlmostEqual(last["v_speed"], -9.81e-3, delta=1e-9)


class Tablets(SceneCase):

    def test_lines(self):
        """The fraction of the volume of the tablets themselves, not of the spheres around them."""
        lines, = [block for block in blocks(page("filling.md")) if "shape/gran" in block]
        log = self.run_lammps(head(units="si") + "region box block 0 0.08 0 0.08 0 0.1 units box\ncreate_box 1 box\n"
                              "region fill block 0.01 0.07 0.01 0.07 0.01 0.09 units box\npair_style gran/penalty\n"
                              "pair_coeff * * hooke 1e3 20 tangential multistep NULL NULL 0.5\ntimestep 1e-5\n" + lines
                              + "variable solid equal mass(all)/1200/(0.06*0.06*0.08)\nthermo_style custom step atoms v_solid\n"
                              "thermo_modify format float %.12g\nrun 0\n").log
        first = thermo(log)[-1]
        tablet = 4 / 3 * math.pi * 0.004 * 0.004 * 0.002 / (0.06 * 0.06 * 0.08)
        self.assertGreater(first["Atoms"], 400)
        self.assertAlmostEqual(first["v_solid"], first["Atoms"] * tablet, delta=1e-9)
        self.assertAlmostEqual(first["v_solid"], 0.2, delta=tablet)


class FirstPage(SceneCase):

    def test_example(self):
        """The floor carries the weight that the page says."""
        text = page("../README.md")
        script, = [block for block in blocks(text) if "lattice" in block]
        weight, = re.findall(r"minus their weight, (\d+)", " ".join(text.split()))
        log = self.run_lammps(script).log
        self.assertEqual(re.findall("WARNING.*", log), [])
        self.assertAlmostEqual(thermo(log)[-1]["f_floor[3]"], -float(weight), delta=8.0)


if __name__ == "__main__":
    unittest.main()
