# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: stay
"""gran/penalty together with other commands of the host, each time against the stock style with the same law
in the same script, on 2 ranks."""

import unittest

from grain_bed import BED, FREEZE, MOVE, STOCK, TALUS, BedCase
from talus_testing import max_difference, read_dump, read_local, thermo

WALL = "hooke/history 3000.0 NULL 20.0 NULL 0.5 1"
EVEN = ("dist", "force", "eng", "p4")    # of a contact: same from both sides

SCENES = {    # commands; other options of BedCase.simulate()
    "freeze": (BED, {}),
    "frozen particles that are not excluded": (f"{MOVE}\n{FREEZE}", {}),
    "neigh_modify exclude type": (f"{BED}\nneigh_modify exclude type 1 2", {}),
    "fix move wiggle": (f"{MOVE}\nfix hold base move wiggle 0.2 0 0.05 0.4", {}),
    "fix move linear, frozen": (f"{MOVE}\nfix belt base move linear 0.5 0 0\n{FREEZE}", {}),
    "fix rigid/small": (f"""{FREEZE}
fix which all property/atom i_clump
variable clump atom 1+floor(x)+6*floor(y)+36*floor((z-0.975)/1.9)
set type 1 i_clump v_clump
fix step grains rigid/small custom i_clump""", {}),
    "fix rigid of one big clump": (f"""{FREEZE}
region half block -1 3 INF INF INF INF
group clump region half
group clump clear
group upper region half
group clump intersect upper grains
group single subtract grains clump
fix step single nve/sphere
fix clump clump rigid single
neigh_modify exclude group clump clump""", {}),
    "wall/gran zplane": (f"{MOVE}\nfix wall grains wall/gran {WALL} zplane 0.9 NULL\n{FREEZE}", {}),
    "wall/gran/region": (f"{BED}\nregion tube cylinder z 3 3 2.6 -5 12 side in\n"
                         f"fix wall grains wall/gran/region {WALL} region tube", {}),
    "fix pour": (f"{BED}\nregion slab block 1.5 4.5 1.5 4.5 8.0 10.0 units box\nfix pour grains pour 30 1 "
                 "4767 vol 0.9 200 diam range 2.0 2.95 region slab vel 0 0 0 0 -11", {"gravity": "0 0"}),
    "fix deposit": (f"{BED}\nregion slab block 0.8 5.2 0.8 5.2 7.1 10 units box\n"
                    "fix drop grains deposit 10 1 20 4767 region slab near 1.2 vz -9 -9", {}),
    "fix adapt diameter": (f"{BED}\nvariable size equal 1.05-0.0004*step\n"
                           "fix grow grains adapt 1 atom diameter v_size",
                           {"atom_style": "atom_style sphere 1"}),
    "fix adapt diameter, mass kept": (f"{BED}\nvariable size equal 1.05-0.0004*step\n"
                                      "fix grow grains adapt 5 atom diameter v_size mass no",
                                      {"atom_style": "atom_style sphere 1"}),
    "special_bonds without bonds": (f"{BED}\nspecial_bonds lj 0.1 0.2 0.3", {}),
    "balance and fix balance": (f"balance 1.0 z 0.3\n{BED}\n"
                                "fix even all balance 20 1.0 shift xz 5 1.0", {}),
    "comm_style tiled": (f"{BED}\nfix even all balance 20 1.0 rcb", {"box": "comm_style tiled"}),
    "neighbor multi": (f"{BED}\nneighbor 0.3 multi\ncomm_modify mode multi vel yes", {}),
    "neighbor nsq": (f"{BED}\nneighbor 0.3 nsq", {}),
    "fix deform": (f"{BED}\nfix shear all deform 1 x scale 0.97 y erate 0.1 remap v", {}),
    "fix deform of a tilted box": (f"{BED}\nfix shear all deform 1 xy erate 0.4 remap v",
                                   {"box": "change_box all triclinic"}),
    "minimize": (f"{BED}\nmin_style quickmin\nminimize 0 0 20 20\nreset_timestep 0", {}),
}


class Scenes(BedCase):

    def test_scenes(self):
        for name, (commands, options) in SCENES.items():
            with self.subTest(name):
                expected = self.simulate(STOCK, commands, **options)
                found = self.assert_same_motion(self.simulate(TALUS, commands, **options), expected)
                print(f"{name:45}{len(expected.atoms):5} particles, largest difference {found:.1e}")


    def test_contacts_of_poured_particles_are_found(self):
        """The largest ones are poured: the cutoff must know them before they exist."""
        commands, options = SCENES["fix pour"]
        frame = self.simulate(TALUS, commands, **options)
        poured = [row for row in frame.atoms.values() if row[0] > 252]
        touched = [row for row in poured if row[8] > -10.9]    # slower than it was poured with
        self.assertGreater(max(row[2] for row in touched), 2.0)


def contacts(frame, names):
    """{(lower tag, higher tag): values} as the particle with the lower tag sees them."""
    found = {}
    for row in frame.rows:
        a, b, *values = row[1:]
        sign = 1.0 if a < b else -1.0
        found[min(a, b), max(a, b)] = [v if name in EVEN else sign * v
                                       for name, v in zip(names, values)]
    return found


class Output(BedCase):
    """What the host asks a pair style for."""

    def test_pair_local(self):
        names = "dist force eng fx fy fz p1 p2 p3 p4 p5 p6 p7 p8 p9 p10".split()
        found = []
        for pair in STOCK, TALUS:
            self.simulate(pair, f"""{BED}
compute ends all property/local patom1 patom2 cutoff radius
compute contact all pair/local {' '.join(names)} cutoff radius
dump contacts all local 40 contacts index c_ends[*] c_contact[*]
dump_modify contacts format float %.17g""", steps=40)
            found.append(contacts(read_local(self.path("contacts"))[-1], names))
        expected, mine = found
        self.assertEqual(sorted(mine), sorted(expected))
        self.assertGreater(len(expected), 200)
        self.assertGreater(sum(values[9] > 1.0 for values in expected.values()), 100)    # friction
        for n, name in enumerate(names):
            size = max(abs(values[n]) for values in expected.values()) or 1.0
            wrong = max(abs(mine[key][n] - expected[key][n]) for key in expected)
            self.assertLess(wrong, 1e-10 * size, name)

    def test_contact_and_fabric_computes(self):
        found = []
        for pair in STOCK, TALUS:
            self.simulate(pair, f"""{BED}
compute touch all contact/atom
compute touching all reduce sum c_touch
compute fabric all fabric radius contact branch force/normal force/tangential
compute stress all stress/atom NULL
compute stresses all reduce sum c_stress[*]
thermo_style custom step pxx pyy pzz pxy pxz pyz c_touching c_fabric[*] c_stresses[*]
thermo_modify format float %.17g""")
            found.append(thermo(self.log)[-1])
        for key, value in found[0].items():
            self.assert_close(found[1][key], value, 1e-9, key)

    def test_rerun(self):
        """Forces recomputed from positions and velocities of a dump."""
        record = f"{BED}\ndump steps all custom 50 steps id x y z vx vy vz\n" \
                 "dump_modify steps format float %.17g"
        self.simulate(STOCK, record)
        found = []
        for pair in STOCK, TALUS:
            self.simulate(pair, f"""{BED}
dump forces all custom 50 forces id fx fy fz
dump_modify forces format float %.17g
rerun steps first 50 dump x y z vx vy vz
undump forces""", steps=0)
            found.append(read_dump(self.path("forces")))
        self.assertGreaterEqual(len(found[0]), 4)
        for expected, mine in zip(*found, strict=True):
            self.assertLess(max_difference(mine, expected, ("fx", "fy", "fz")), 1e-9)


if __name__ == "__main__":
    unittest.main()
