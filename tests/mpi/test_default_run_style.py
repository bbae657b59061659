# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=20 timeout=300
"""With the plugin loaded run style verlet is that of Talus, the direct exchange and overlap are chosen for each run, and
the log says what is accelerated.  Pair styles of others run as without the plugin."""

import os
import re
import subprocess
import sys
import unittest

from talus_testing import PLUGIN, SceneCase, head

BOX = head(boundary="{boundary}", map=None) + """
region box block 0 8 0 7 0 6
create_box 1 box
region middle block 1 7 1 6 1 5
create_atoms 1 random 200 77 middle overlap 0.5 maxtry 500
set group all diameter 0.5 density 1.0
neighbor 0.2 bin
timestep 0.001
velocity all create 0.3 4711 loop geom
"""
PAIR = """
pair_style gran/penalty
pair_coeff * * hertz 4000.0 40.0
fix step all nve/sphere/symplectic
"""
DUMP = "write_dump all custom dump id x y z vx vy vz modify format float %a sort id\n"


def scene(more="", boundary="f f f", pair=PAIR, run="run 30\n"):
    return BOX.format(boundary=boundary) + pair + more + "\nthermo 10\n" + run


def blocks(log):
    """Of the log: lists of (style, what it is)."""
    found = []
    for text in re.findall(r"^Talus: styles of this run\n((?:  .*\n)+)", log, re.MULTILINE):
        found.append([(line[2:36].rstrip(), line[36:]) for line in text.splitlines()])
    return found


IN_RECORDS = ("steps without output", "in the records")


def through_arrays(reason):
    return "steps without output", "through the arrays of LAMMPS: " + reason


OURS = [("pair gran/penalty", "accelerated"), ("fix step nve/sphere/symplectic", "accelerated"),
        ("run verlet", "accelerated"), IN_RECORDS]


class Block(SceneCase):

    def test_default(self):
        for ranks in 1, 2:
            for more in "", "run_style verlet":
                log = self.run_lammps(scene(more, run="run 30\nrun 10\nrun 10 pre no\n"), np=ranks).log
                self.assertEqual(blocks(log), [OURS])
                self.assertLess(log.index("Talus: styles"), log.index("Step "))
        for boundary in "p p f", "p p p":
            self.assertEqual(blocks(self.run_lammps(scene(boundary=boundary)).log), [OURS])

    def test_with_a_suffix(self):
        for word in "talus", "omp":
            with self.subTest(suffix=word):
                log = self.run_lammps(scene("run_style verlet"), arguments=("-sf", word)).log
                self.assertEqual(blocks(log), [OURS])
                self.assertEqual(blocks(self.run_lammps(f"suffix {word}\n" + scene()).log), [OURS])

    def test_other_run_styles_of_the_user(self):
        log = self.run_lammps(scene("run_style verlet/proxy overlap yes\n")).log
        self.assertIn(("run verlet/proxy", "accelerated"), blocks(log)[0])
        log = self.run_lammps(scene("run_style verlet/stock\n")).log
        self.assertEqual(blocks(log)[0][2:], [("run verlet/stock", "stock: use run_style verlet"),
                                              through_arrays("run style verlet/stock")])
        log = self.run_lammps(BOX.format(boundary="f f f") + "run_style verlet/stock\n" + PAIR + "run 1\n").log
        self.assertIn(("run verlet/stock", "stock: use run_style verlet"), blocks(log)[0])

    def test_what_changes_is_said_again(self):
        log = self.run_lammps(scene(run="run 10\nfix drag all recenter NULL NULL NULL units box\nrun 10\nunfix drag\nrun 10\n"), np=2).log
        drag = [*OURS[:2], ("fix drag recenter", "stock: no accelerated variant"), OURS[2],
                through_arrays("fix drag (recenter): may look at particles in every step")]
        self.assertEqual(blocks(log), [OURS, drag, OURS])

    def test_fixes(self):
        more = ('fix say all print 10 "here"\ncompute ke all ke\nfix mean all ave/time 2 5 10 c_ke\n'
                "group still id 1\nfix step all nve/sphere/symplectic\nregion top block 1 7 1 6 4 5\n"
                "fix more all deposit 1 1 100 4767 region top near 0.5\n")
        more = more.replace("fix step all nve/sphere/symplectic\n", "")
        self.assertEqual(blocks(self.run_lammps(scene(more)).log), [OURS])
        log = self.run_lammps(scene("compute ke all ke\nfix mean all ave/time 1 10 10 c_ke")).log
        self.assertEqual(blocks(log), [OURS])

    def test_energies_leave_steps_in_the_records(self):
        log = self.run_lammps(scene("compute e all penalty/stats\nthermo_style custom step c_e[1]")).log
        self.assertEqual(blocks(log), [OURS])

    def test_stock_granular_pairs(self):
        stock = "pair_style {}\n{}\nfix step all nve/sphere\n"
        for style, words, coefficients in (("gran/hooke", "2000.0 NULL 50.0 NULL 0.5 0", "pair_coeff * *"),
                                           ("granular", "", "pair_coeff * * hooke 1000.0 50.0 tangential linear_nohistory 1.0 0.4")):
            with self.subTest(style=style):
                (block,) = blocks(self.run_lammps(scene(pair=stock.format(f"{style} {words}", coefficients)), np=2).log)
                self.assertRegex(block[0][1], "^stock: (no accelerated variant|start with -sf talus, or write [a-z/]+/talus$)")
                self.assertEqual(block[0][0], "pair " + style)
                self.assertEqual(block[-2], ("run verlet", "stock: the pair style is not accelerated"))
        self.assertEqual(blocks(self.run_lammps(scene(pair="pair_style none\nfix step all nve\n")).log), [])

    def test_hybrid(self):
        pair = ("pair_style hybrid/overlay soft 1.0 gran/penalty\npair_coeff * * soft 1.0\n"
                "pair_coeff * * gran/penalty hertz 4000.0 40.0\nfix step all nve/sphere/symplectic\n")
        (block,) = blocks(self.run_lammps(scene(pair=pair), np=2).log)
        self.assertEqual(block[0], ("pair hybrid/overlay", "sub-styles of Talus accelerated; others stock"))
        self.assertEqual(block[-1], through_arrays("the pair style is hybrid, and contacts have no torques"))


class Life(SceneCase):

    def test_after_clear(self):
        again = scene() + "clear\n" + scene()
        self.assertEqual(blocks(self.run_lammps(again, np=2).log), [OURS, OURS])
        load = f'plugin load "{PLUGIN}"\n'
        log = self.run_lammps(load + scene() + "clear\n" + load + scene(), env={"LAMMPS_PLUGIN_PATH": ""}).log
        self.assertEqual(blocks(log), [OURS, OURS])

    def test_after_unloading(self):
        load = f'plugin load "{PLUGIN}"\n'
        unload = "plugin unload pair gran/penalty\nplugin unload fix nve/sphere/symplectic\n"
        stock = "pair_style soft 1.0\npair_coeff * * 1.0\nfix step all nve/sphere\nrun 5\n"
        log = self.run_lammps(load + scene() + unload + stock + load + "unfix step\n" + PAIR + "run 5\nclear\n" + load + scene(),
                              env={"LAMMPS_PLUGIN_PATH": ""}).log
        self.assertEqual(blocks(log), [OURS, OURS])    # the second one after clear

    def test_loaded_after_the_user_has_chosen(self):
        log = self.run_lammps(BOX.format(boundary="f f f") + "run_style respa 2 2\n" + f'plugin load "{PLUGIN}"\n' +
                              "fix step all nve/sphere\ninfo styles\npair_style zero 1.0\npair_coeff * *\nrun 2\n",
                              env={"LAMMPS_PLUGIN_PATH": ""}).log
        self.assertIn("respa", log)
        self.assertEqual(blocks(log), [])

    def test_restart(self):
        log = self.run_lammps(scene(run="run 10\nwrite_restart there\nclear\nnewton off\nread_restart there\n" + PAIR[PAIR.index("fix"):] +
                                    "run 10\n"), np=2).log
        self.assertEqual(blocks(log), [OURS, OURS])

    def test_two_instances(self):
        """In turn in one process; an older LAMMPS has the styles of a plugin in the first one only."""
        program = (
            "import ctypes, sys\n"
            "lib = ctypes.CDLL(sys.argv[1], ctypes.RTLD_GLOBAL)\n"
            "lib.lammps_open_no_mpi.restype = ctypes.c_void_p\n"
            "def start(name):\n"
            "    words = [b'lmp', b'-log', name.encode(), b'-screen', b'none']\n"
            "    return ctypes.c_void_p(lib.lammps_open_no_mpi(len(words), (ctypes.c_char_p * len(words))(*words), None))\n"
            "both = [start('log.a'), start('log.b')]\n"
            "stock = 'fix step all nve/sphere\\npair_style zero 1.0\\npair_coeff * *\\n'\n"
            "for text in sys.argv[2], 'run 10\\n':\n"
            "    lib.lammps_commands_string(both[0], text.encode())\n"
            "    lib.lammps_commands_string(both[1], text.replace(sys.argv[3], stock).encode())\n"
            "for one in both: lib.lammps_close(one)\n"
            "print('survived')\n")
        library = os.path.join(os.environ["TALUS_LAMMPS_BINARY"], "liblammps.so")
        result = subprocess.run([sys.executable, "-c", program, library, scene(), PAIR], cwd=self.dir, capture_output=True,
                                text=True, timeout=120, env={**os.environ, "TMPDIR": self.dir})
        self.assertIn("survived", result.stdout, result.stderr)
        self.assertEqual(blocks(self.read("log.a")), [OURS])
        with open(self.path("log.b")) as file:
            log = file.read()
        self.assertEqual(blocks(log), [])
        self.assertEqual(log.count("Loop time"), 2)


class Exchange(SceneCase):

    def run_scene(self, more, np=2, boundary="p p f", **options):
        log = self.run_lammps(scene(more, boundary=boundary, run="run 30\ncomm_proxy info\n" + DUMP), np=np, **options).log
        return log, self.read("dump")

    def test_chosen_for_the_run(self):
        dumps = []
        for more, np, on in (("", 1, True), ("", 2, True), ("comm_proxy auto", 2, True), ("comm_proxy yes", 2, True),
                             ("comm_proxy no\ncomm_proxy auto", 2, True), ("comm_proxy no", 2, False),
                             ("comm_proxy yes\ncomm_proxy no", 2, False), ("comm_proxy no\nrun_style verlet/proxy", 2, False)):
            with self.subTest(more=more, ranks=np):
                log, dump = self.run_scene(more, np)
                self.assertIn("comm_proxy: on\n" if on else "comm_proxy: off", log)
                self.assertEqual(blocks(log)[0][-1], IN_RECORDS if on else through_arrays(
                    "the exchange is the one of LAMMPS: 'comm_proxy no' is set: remove it"))
                self.assertNotIn("WARNING: Run style", log)
                if np == 2:    # create_atoms numbers them by ranks
                    dumps.append(dump)
        self.assertEqual(len(set(dumps)), 1)

    def test_not_where_nothing_is_exchanged(self):
        self.assertIn("comm_proxy: off", self.run_scene("", np=1, boundary="f f f")[0])

    def test_where_it_is_not_supported(self):
        """A reason instead of an error, also if the settings change after it was switched on."""
        for before in "", "run 1\n":
            for more, reason in (("group some id 1 2\nfix shape some deform 1 x erate 0.1 remap v",
                                  "fix deform with 'remap v' is supported for group all only"),):
                with self.subTest(more=more, before=before):
                    log = self.run_scene(before + more)[0]
                    self.assertEqual(blocks(log)[-1][-1], through_arrays("the exchange is the one of LAMMPS: " + reason))
        log = self.run_scene("run 1\ncomm_style tiled\nrun 1")[0]
        self.assertEqual({b[-1] for b in blocks(log)}, {IN_RECORDS})

    def test_minimize_after_a_run(self):
        self.run_scene("run 1\nunfix step\nneighbor 0.2 multi\ncomm_modify mode multi\nmin_style quickmin\n"
                       "minimize 0.0 1.0e-3 5 10\nfix step all nve/sphere/symplectic")

    def overlapped(self, log):
        updates, overlapped = map(int, re.search(r"Talus exchange: (\d+) updates of proxies, (\d+)", log).groups())
        self.assertIn(overlapped, (0, updates))
        return overlapped > 0

    def test_overlap_between_machines(self):
        """A library in the place of MPI's answer says that each rank has a machine of its own."""
        with open(self.path("alone.c"), "w") as file:
            file.write("#include <mpi.h>\nint MPI_Comm_split_type(MPI_Comm all, int type, int key, MPI_Info info, MPI_Comm *to)\n"
                       "{ int rank; (void) type; (void) key; (void) info; MPI_Comm_rank(all, &rank);\n"
                       "  return MPI_Comm_split(all, rank, 0, to); }\n")
        subprocess.run(["mpicc", "-shared", "-fPIC", self.path("alone.c"), "-o", self.path("alone.so")], check=True)
        preload = " ".join(filter(None, [os.environ.get("LD_PRELOAD"), self.path("alone.so")]))
        dumps = []
        for env, more, expected in ((None, "", False), (None, "run_style verlet/proxy overlap yes", True),
                                    ({"LD_PRELOAD": preload}, "", True), ({"LD_PRELOAD": preload}, "run_style verlet/proxy", True),
                                    ({"LD_PRELOAD": preload}, "run_style verlet/proxy overlap no", False)):
            with self.subTest(more=more, machines=env is not None):
                log, dump = self.run_scene(more, env=env)
                self.assertEqual(self.overlapped(log), expected)
                dumps.append(dump)
        self.assertEqual(len(set(dumps)), 1)


MELT = """
units lj
newton {newton}
lattice fcc 0.8442
region box block 0 6 0 6 0 6
create_box 1 box
create_atoms 1 box
mass 1 1.0
velocity all create 3.0 87287 loop geom
pair_style lj/cut 2.5
pair_coeff 1 1 1.0 1.0 2.5
neighbor 0.3 bin
neigh_modify every 20 delay 0 check no
fix 1 all nve
{more}
thermo 10
thermo_modify format float %.17g
"""
GRAINS = BOX.replace("newton off", "newton {newton}") + """
pair_style {pair}
pair_coeff * * {law}
fix 1 all nve/sphere
fix 2 all gravity 1.0 vector 0 0 -1
thermo 10
thermo_modify format float %.17g
"""
GRANULAR = dict(pair="granular", law="hooke 1000.0 50.0 tangential linear_history 500.0 10.0 0.4")
HOOKE = dict(pair="gran/hooke/history 2000.0 NULL 50.0 NULL 0.5 0", law="")


class StockStyles(SceneCase):
    """The same bits as in a LAMMPS without the plugin."""

    def run_both(self, text, np):
        results = []
        for path in os.path.dirname(PLUGIN), "":
            log = self.run_lammps(text + DUMP, np=np, env={"LAMMPS_PLUGIN_PATH": path}).log
            results.append((re.findall(r"^ *\d+(?: +\S+){3,} *$|Neighbor list builds.*|Dangerous builds.*", log, re.M), self.read("dump")))
        self.assertGreater(len(results[0][0]), 4)
        return results

    def check(self, text):
        for np in 1, 2:
            with self.subTest(ranks=np):
                self.assertEqual(*self.run_both(text, np))

    def test_melt(self):
        for newton in "on", "off":
            self.check(MELT.format(newton=newton, more="") + "run 50\nrun 20 pre no\nrun 30 every 10 NULL\n")

    def test_respa_and_minimize(self):
        self.check(MELT.format(newton="on", more="run_style respa 2 2 inner 1 1.5 1.8 outer 2\n") + "run 50\n")
        self.check(MELT.format(newton="on", more="") + "minimize 0.0 1.0e-6 20 100\nrun 20\n")

    def test_grains(self):
        for newton in "on", "off":
            for pair in GRANULAR, HOOKE:
                self.check(GRAINS.format(newton=newton, boundary="p p f", **pair) + "run 60\n")


if __name__ == "__main__":
    unittest.main()
