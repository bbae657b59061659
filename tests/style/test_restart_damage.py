# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=200
"""Restart files with one bit that is wrong among what Talus has written (tests/lib/restart_file.py says which bytes that
are): one message, or the trajectory of the file as it was; never a crash, a hang or another trajectory."""

import concurrent.futures
import random
import struct
import unittest

import restart_file
from talus_testing import SceneCase, Sphere, head, read_dump, run_lammps, write_sphere_data

HEAD = head()
LAW = "hertz 4000.0 40.0 tangential multistep NULL NULL 0.5"
END = "run 3\nwrite_dump all custom {} id x y z vx vy vz omegax omegay omegaz fx fy fz modify format float %a\n"
DAMAGED = "the restart file is damaged"

# spheres and boxes on a plate that turns, and a stream; each kind of fix of Talus that has something in the file
SHAPES = f"""
neighbor 0.2 bin
timestep 0.001
region mouth block 1 9 1 9 8 9
group all_of_them union all
group balls type 1
fix fall all gravity 1.0 vector 0 0 -1
fix step balls nve/sphere/symplectic
fix floor all large/body plane 0 0 0  0 0 1 move rotate 5 5 0  0 0 1  10 contact {LAW}
fix dice all shape/gran type 2 box 1 1 1 density 1
fix in balls pour/rate 2 1 mouth 300 diameter 0.6 density 1.0 seed 3
"""
# clumps, and walls of the suffix
CLUMPS = """
fix prop all property/atom mol ghost yes
neighbor 0.2 bin
neigh_modify exclude molecule/intra all
thermo_style custom step
timestep 0.001
pair_style gran/hooke/history 4000.0 NULL 40.0 NULL 0.5 1
pair_coeff * *
{molecules}
fix step all rigid/small/symplectic molecule gravity 1.0 vector 0 0 -1
fix floor all wall/gran hooke/history 4000.0 NULL 40.0 NULL 0.5 1 zplane 0.0 NULL
region pot block -1 11 -1 11 0.0 11
fix pot all wall/gran/region hooke/history 4000.0 NULL 40.0 NULL 0.5 1 region pot
"""
MOLECULES = "set atom 1*2 mol 1\nset atom 3*4 mol 2"
SUFFIX = ["-sf", "talus"]


class Damage(SceneCase):
    bits_of_part, rows = 1, 1    # of each part as a whole, and of how many particles

    def setUp(self):
        self.random = random.Random(55)

    def make(self, scene, first, arguments=()):
        """The content of a restart file, and the trajectory that follows."""
        write_sphere_data(self.path("grains"), ((0, 10),) * 3, [
            Sphere((4.5, 1, 0.49), v=(0, 1, 0)), Sphere((5.45, 1, 0.49)), Sphere((2, 5, 0.49), v=(0, 0, -1), type=2),
            Sphere((2.9, 5, 0.6), type=2)], types=2)
        self.scene, self.arguments = scene, arguments
        self.run_lammps(HEAD + "read_data grains\n" + first + "run 5\nwrite_restart state\n" + END.format("whole"),
                        arguments=arguments)
        with open(self.path("state"), "rb") as file:
            self.content = file.read()
        self.whole, = read_dump(self.path("whole"))

    def outcome(self, content, name, np=1):
        """"same", the message of an error, or what is wrong."""
        with open(self.path(name), "wb") as file:
            file.write(content)
        script = HEAD + f"read_restart {name}\n" + self.scene + END.format(name + ".dump")
        try:
            run_lammps(script, np=np, cwd=self.dir, name=name, arguments=self.arguments, timeout=30)
        except AssertionError as problem:
            text = str(problem)
            errors = [line for line in " ".join(text.split()).split("ERROR")[1:]]
            return errors[0] if text.startswith("return code 1:") and errors else "crash or hang: " + text[-1500:]
        again, = read_dump(self.path(name + ".dump"))
        return "same" if again.atoms == self.whole.atoms else "another trajectory"

    def places(self):
        """(part, byte, bit): some of each part, the first of each number, which is what sizes are made of, among them."""
        parts = restart_file.parts_of_talus(self.content)
        rows = {}
        for part in parts:
            if part.name != "as a whole":
                rows.setdefault(part.name, []).append(part)
        chosen = [part for part in parts if part.name == "as a whole"]
        for of_style in rows.values():
            chosen += self.random.sample(of_style, min(self.rows, len(of_style)))
        for part in chosen:
            yield part, part.begin + 7, 4    # of a mark, or the exponent of a count
            yield part, part.begin + self.random.choice((8, 9, 12)), self.random.randrange(8)
            for _ in range(self.bits_of_part):
                yield part, self.random.randrange(part.begin, part.end), self.random.randrange(8)

    def check(self, styles, as_a_whole):
        parts = restart_file.parts_of_talus(self.content)
        self.assertEqual({part.name for part in parts}, styles | {"as a whole"})
        self.assertEqual(sum(part.name == "as a whole" for part in parts), as_a_whole)
        self.assertEqual(self.outcome(self.content, "intact"), "same")
        places = list(self.places())
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            outcomes = list(pool.map(lambda n: self.outcome(restart_file.with_bit(self.content, *places[n][1:]), f"bit{n}",
                                                            2 if n % 16 == 15 else 1), range(len(places))))
        for (part, byte, bit), outcome in zip(places, outcomes):
            with self.subTest(part=part, byte=byte - part.begin, bit=bit):
                if part.name == "NEIGH_HISTORY":    # for the stock style; Talus reads it in a file of that alone
                    self.assertTrue(outcome == "same" or DAMAGED in outcome, outcome)
                else:
                    self.assertIn(DAMAGED, outcome)

    def test_shapes_bodies_and_a_stream(self):
        pair = f"pair_style gran/penalty\npair_coeff * * {LAW}\n"
        again = SHAPES.replace("group balls type 1\n", "").replace("group all_of_them union all\n", "")
        self.make(again, pair + SHAPES)
        self.check({"CONTACT_STORE", "shape/gran"}, 6)

    def test_clumps_and_walls_of_the_suffix(self):
        self.make(CLUMPS.format(molecules=""), CLUMPS.format(molecules=MOLECULES), SUFFIX)
        self.check({"CONTACT_STORE", "NEIGH_HISTORY", "rigid/small/symplectic", "wall/gran", "wall/gran/region"}, 2)

    def test_types_that_do_not_exist(self):
        """Numbers of LAMMPS, which does not look: types are indices of tables of Talus."""
        pair = f"pair_style gran/penalty\npair_coeff * * {LAW}\n"
        physics = "timestep 0.001\nneighbor 0.2 bin\nfix step all nve/sphere/symplectic\n"
        self.make(physics, pair + physics)
        row = next(restart_file.rows_of_particles(self.content))[0] + 8 * restart_file.TYPE
        for np, value in (1, 0), (2, 3), (1, -1), (1, 1 << 30):
            content = self.content[:row] + struct.pack("<q", value) + self.content[row + 8:]
            self.assertRegex(self.outcome(content, "types", np), rf"Particle \d is of type {value}, and there are 2 types")

    def test_files_of_other_versions(self):
        """Those of Talus 1.0 have no mark, and where theirs was the data begin."""
        pair = f"pair_style gran/penalty\npair_coeff * * {LAW}\n"
        again = SHAPES.replace("group balls type 1\n", "").replace("group all_of_them union all\n", "")
        self.make(again, pair + SHAPES)
        expected = "{}: the restart file is damaged, or was written by another version of Talus: use another copy or an " \
                   "earlier file, or go on with that version"
        commands = ("Pair style gran/penalty", "fix pour/rate in", "Fix large/body floor", "Fix shape/gran dice",
                    "Fix nve/sphere/symplectic")
        said = set()
        for n, part in enumerate(part for part in restart_file.parts_of_talus(self.content) if part.name == "as a whole"):
            content = self.content[:part.begin] + struct.pack("<d", -7.0) + self.content[part.begin + 8:]
            outcome = self.outcome(content, f"older{n}", 1 + n % 2)
            said |= {command for command in commands if expected.format(command) in outcome}
        self.assertEqual(said, set(commands))


if __name__ == "__main__":
    unittest.main()
