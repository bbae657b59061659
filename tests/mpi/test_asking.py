# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=500 cost=60
"""Asking for contacts changes nothing, and what is told is what acted: with particles that fix deform or press/berendsen move
at the end of each step the trajectory has the same bits with outputs and without, at any interval, on any number of
ranks; and the forces of the rows add up to those that acted on each particle, also where contacts that were there are gone
at the positions to which the particles have been moved since."""

import collections
import unittest

from body_meshes import box as box_mesh, write_stl
from talus_testing import SceneCase, head, read_dump, read_local
from tossed_clumps import write_clumps

LAW = "hertz 2.0e4 50.0 tangential multistep NULL NULL 0.5"
STOCK = "hertz/history 2.0e4 NULL 50.0 NULL 0.5 0"
WORDS = "id1 id2 body part x1 y1 z1 px py pz fx fy fz tx ty tz fn eng overlap".split()
HEAD = head(boundary="{boundary}", map=None, style="{style}")
RANDOM = """
region box block 0 8 0 8 0 8
create_box 1 box
create_atoms 1 random 320 12345 NULL overlap 0.75 maxtry 500
region core sphere 4 4 4 2.0
delete_atoms region core
set group all diameter 1.0 density 1.0
velocity all create 2.0 777 loop geom
"""
PENALTY = f"pair_style gran/penalty\npair_coeff * * {LAW}\n"
SPHERES = "fix step all nve/sphere/symplectic\n"
TWO_BALLS = """
region one sphere 3.2 4 4 1.3 side out
region two sphere 4.8 4 4 1.3 side out
region both intersect 2 one two
region inside_one sphere 3.2 4 4 1.76
region inside_two sphere 4.8 4 4 1.76
region inside union 2 inside_one inside_two
delete_atoms region inside
"""
# name: (atom style, boundary, particles, pair style and what moves them, body)
SCENES = {
    "sphere": ("sphere", "p p p", RANDOM, PENALTY + SPHERES, f"fix b all large/body sphere 4 4 4 1.5 outside contact {LAW}"),
    "mesh": ("sphere", "p p p", RANDOM, PENALTY + SPHERES, f"fix b all large/body mesh stone.stl contact {LAW}"),
    "turning": ("sphere", "p p p", RANDOM, PENALTY + SPHERES,
                f"fix b all large/body box 4 4 4 2.2 2.2 2.2 outside contact {LAW} move rotate 4 4 4 0 0 1 3.0"),
    "planes": ("sphere", "p p f", RANDOM, f"pair_style gran/{STOCK}\npair_coeff * *\nfix step all nve/sphere\n",
               f"fix b all wall/gran {STOCK} zplane 0 8 contacts"),
    "region": ("sphere", "p p p", RANDOM, f"pair_style gran/{STOCK}\npair_coeff * *\nfix step all nve/sphere\n",
               f"{TWO_BALLS}fix b all wall/gran/region {STOCK} region both"),
    "shapes": ("sphere", "p p p", RANDOM, PENALTY + "fix s all shape/gran type 1 box 0.6 0.6 0.5 density 1 orient random 5\n",
               f"fix b all large/body sphere 4 4 4 1.75 outside contact {LAW}"),
    "clumps": ("sphere", "p p f", "atom_modify map yes\nfix prop all property/atom mol ghost yes\nread_data clumps fix prop NULL Molecules\n",
               PENALTY + "group clumps molecule > 0\ngroup single molecule 0\nfix step clumps rigid/small/symplectic molecule\n"
               "fix step2 single nve/sphere/symplectic\nneigh_modify exclude molecule/intra clumps\n",
               f"fix b all large/body sphere 2.7 2.7 2.7 2.2 outside contact {LAW}\nfix c all large/body plane 0 0 0.9 0 0 1 contact {LAW}"),
}
MOVERS = {
    "deform": "fix d all deform 1 x erate -0.05 y erate 0.05 remap x\n",
    "press": "fix d all press/berendsen x 1 1 0.05 y 2 2 0.05 modulus 100\n",
}
STEPS = """
neighbor 0.3 bin
timestep 0.0005
thermo_style custom step
thermo 100
"""
OUTPUTS = f"""
compute rows all contact/gran/local {" ".join(WORDS)}
compute number all contact/gran/atom
dump rows all local {{every}} rows index c_rows[*]
dump_modify rows format line "%d{" %.17g" * len(WORDS)}"
dump atoms all custom {{every}} atoms id fx fy fz tqx tqy tqz c_number[3]
dump_modify atoms format float %.17g
{{more}}
thermo {{every}}
"""
ENERGY = "compute s all penalty/stats\nthermo_style custom step f_b c_s[2] c_s[4]\nthermo_modify format float %.17g"
END = "\nrun 84\nwrite_dump all custom final id x y z vx vy vz omegax omegay omegaz modify sort id format float %a\n"


class Asking(SceneCase):

    def run_scene(self, name, mover, every=0, np=1):
        style, boundary, particles, pairs, body = SCENES[name]
        if name == "mesh":
            write_stl(self.path("stone.stl"), box_mesh((2.9, 2.9, 2.9), (5.1, 5.1, 5.1), 3))
        if name == "clumps":
            write_clumps(self.path("clumps"))
        more = ENERGY if "large/body" in body else ""
        script = (HEAD.format(style=style, boundary=boundary) + particles + pairs + body + "\n" + MOVERS[mover] + STEPS
                  + (OUTPUTS.format(every=every, more=more) if every else "") + END)
        self.log = self.run_lammps(script, np=np, arguments=("-sf", "talus")).log
        return read_dump(self.path("final"))[0]

    def assert_rows_acted(self):
        """Of each particle at each time; and how many contacts with bodies there were at most."""
        most = 0
        for rows, frame in zip(read_local(self.path("rows")), read_dump(self.path("atoms")), strict=True):
            force, number = collections.defaultdict(lambda: [0.0] * 3), collections.Counter()
            for values in rows.rows:
                row = dict(zip(WORDS, values[1:]))
                for d, axis in enumerate("xyz"):
                    force[row["id1"]][d] += row["f" + axis]
                    force[row["id2"]][d] -= row["f" + axis]
                if row["body"]:
                    number[row["id1"]] += 1
            most = max(most, sum(number.values()))
            scale = max(abs(f) for atom in frame.atoms.values() for f in atom[1:4])
            for tag, values in frame.atoms.items():
                self.assertEqual(number[tag], values[7], (frame.step, tag))
                for d in range(3):
                    self.assertLess(abs(force[tag][d] - values[1 + d]), 1e-12 * scale, (frame.step, tag))
        return most

    def check(self, name, mover, *ways):
        """ways: interval of outputs and number of ranks."""
        alone = {}
        for every, np in ways:
            with self.subTest(name, mover=mover, every=every, np=np):
                if np not in alone:
                    alone[np] = self.run_scene(name, mover, np=np)
                self.assert_same_bits(alone[np], self.run_scene(name, mover, every, np))
                self.assertGreater(self.assert_rows_acted(), 2)

    def test_bodies_and_fix_deform(self):
        self.check("sphere", "deform", (1, 1), (7, 1), (7, 2), (1, 4))
        self.check("mesh", "deform", (1, 1), (7, 4))
        self.check("turning", "deform", (7, 1), (1, 2))

    def test_bodies_and_press_berendsen(self):
        self.check("sphere", "press", (1, 1), (7, 2))

    def test_walls_of_the_suffix(self):
        self.check("planes", "deform", (1, 1), (7, 4))
        self.check("region", "deform", (1, 1), (7, 1), (1, 4))
        self.check("region", "press", (7, 2))

    def test_shapes(self):
        self.check("shapes", "deform", (1, 1), (7, 2))

    def test_clumps(self):
        self.check("clumps", "deform", (1, 1), (7, 4))


if __name__ == "__main__":
    unittest.main()
