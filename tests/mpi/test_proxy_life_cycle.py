# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""The exchange is swapped in and out in the middle of a session, and everything that renumbers particles happens.

A session under the direct exchange must print and dump what the same session prints under the stock one."""

import unittest

import session_scene
from session_scene import PAIR, START
from talus_testing import SceneCase, read_dump, thermo, write_sphere_data

PHYSICS = session_scene.PHYSICS.format(ylo=session_scene.PLANE) + """
thermo 20
thermo_style custom step atoms ke pxx pxy f_floor[3]
thermo_modify norm no format float %.17g
"""
DIRECT = "comm_proxy yes\ncomm_proxy check yes\n"
SWAP = {"stock": "comm_proxy no\nrun_style verlet/stock\n", "direct": DIRECT + "run_style verlet/stock\n",
        "overlapped": DIRECT + "run_style verlet/proxy overlap yes\n", "automatic": ""}
DUMP = "write_dump all custom {} id type x y z vx vy vz omegax omegay omegaz modify format float %a\n"

# everything after 'run 60' of a session; {swap} again where the host forgets it
PIECES = {
    "the session of the plan": """
balance 1.0 shift xz 10 1.0
change_box all x final -2 40 y final -2 20 z final -2 30
write_restart half
run 40
clear
{start}
read_restart half
{physics}
{swap}
run 40
change_box all x final -2 42 y final -2 20 z final -2 30
run 20
""",
    "run 0, run pre no": "run 0\nrun 20 pre no\nrun 0 pre no\nrun 1 pre no\nrun 20 pre no post no\nrun 20\n",
    "swapped out and in": "comm_proxy no\nrun 20 pre no\n{swap}\nrun 20 pre no\ncomm_proxy no\n{swap}\nrun 20\n",
    "write_restart, run pre no": "write_restart there\nrun 20 pre no\nwrite_data data\nrun 20 pre no\n",
    "fix balance": "fix even all balance 10 1.0 shift xz 10 1.01\nrun 60\n",
    "delete_atoms": "region cut block 2 4 INF INF INF INF\ndelete_atoms region cut compress no\nrun 40\n"
                    "delete_atoms overlap 0.8 all all\nrun 20\n",
    "create_atoms": "create_atoms 1 single 3.1 3.1 11.5\nset type 1 density 1.0\nrun 20\n"
                    "create_atoms 1 single 3.1 5.1 11.5\nrun 20\n",
    "create_atoms while running":
        'create_atoms 1 single 1.5 3.1 11.5\nrun 30 every 10 "create_atoms 1 single $(step*0.05) 5.1 11.5"\n',
    "fix deposit": "region top block 1 8 1 7 10.5 11.9\n"
                   "fix more all deposit 5 1 12 4767 region top near 0.5\nrun 80\n",
    "set and velocity": "set type 1 density 1.1\nvelocity all scale 0.5\nrun 20\ndisplace_atoms all move 0.01 0 0\n"
                        "run 20\nreset_atoms id\nrun 20\n",
    "comm_modify, neigh_modify": "comm_modify cutoff 2.5\nrun 20\ncomm_modify cutoff 0.0\n"
                                 "neighbor 0.3 bin\nneigh_modify every 2 delay 4\nrun 20\n",
    "lost particles": "thermo_modify lost ignore\nfix wind all addforce 500.0 0 0\nrun 100\n",
    "minimize": "unfix step\nmin_style quickmin\nminimize 0.0 1.0e-3 5 10\n"
                "fix step all nve/sphere/symplectic\nrun 20\n",
    "rerun": "dump d all custom 10 frames id type x y z vx vy vz omegax omegay omegaz\n"
             "dump_modify d format float %.17g\nrun 20\nundump d\n"
             "rerun frames dump x y z vx vy vz\nrun 5\n",
    "styles and timers": "timer sync\nrun 10\ntimer nosync full\nrun 10\nrun_style verlet/stock\nrun 10\n"
                         "timer timeout 1000 every 2\nrun 10\n",
}


class Session(SceneCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), session_scene.BOX, session_scene.grains(1.0))

    def session(self, piece, swap, name):
        def filled(text):
            return text.format(start=START, physics=PHYSICS, swap=SWAP[swap])
        if swap == "stock":
            piece = piece.replace("comm_proxy no\n", "")
        return (f"log log.{name}\n" + START + "read_data grains\n" + PAIR + PHYSICS + SWAP[swap] +
                "run 60\n" + filled(piece) + DUMP.format("dump." + name) + "clear\n")

    def check(self, pieces, ranks):
        script, names = "", {}
        for number, piece in enumerate(pieces):
            for swap in SWAP:
                names[piece, swap] = f"{number}-{swap}"
                script += self.session(PIECES[piece], swap, names[piece, swap])
        self.run_lammps(script + 'log log.end\nprint "END REACHED"\n', np=ranks)
        self.assertIn("END REACHED", self.read("log.end"))
        self.changed = 0
        for (piece, swap), name in names.items():
            with self.subTest(piece=piece, swap=swap, ranks=ranks):
                if swap != "stock":
                    self.compare(name, names[piece, "stock"])

        self.assertEqual(self.changed, 3 * 5)    # that particles came, went and were lost

    def compare(self, name, reference):
        frame, expected = (read_dump(self.path("dump." + n))[0] for n in (name, reference))
        self.assertGreater(len(expected.atoms), 100)
        self.assert_same_bits(frame, expected)
        rows, wanted = (self.rows_of(n) for n in (name, reference))
        self.assertEqual([(row["Step"], row["Atoms"]) for row in rows],
                         [(row["Step"], row["Atoms"]) for row in wanted])
        if wanted[0]["Atoms"] != wanted[-1]["Atoms"]:
            self.changed += 1
        for row, other in zip(rows, wanted):
            self.assertLess(abs(row["KinEng"] - other["KinEng"]), 1e-11 * other["KinEng"] + 1e-300)

    def rows_of(self, name):
        return thermo(self.read("log." + name))

    def test_one_rank(self):
        self.check(PIECES, 1)

    def test_four_ranks(self):
        self.check(PIECES, 4)


if __name__ == "__main__":
    unittest.main()
