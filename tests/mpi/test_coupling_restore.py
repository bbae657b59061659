# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=400 stay
"""talus_restore(): what a partner has told and is owed comes back as well; outputs of steps that are repeated; commands in
between; what is refused; fixed point iteration on it."""

import os
import unittest

import body_meshes
from coupled_case import CoupledCase
from saved_scenes import LAW, MOVE, SCENES, pair, start, tossed, walls
from talus_testing import read_dump, thermo

BEGIN = """
import ctypes, json, math, sys, warnings
from lammps import lammps
from talus import FixedPoint, Partner, TalusError
def scene(root=-1, name="scene", log="none", words=()):
    lmp = lammps(cmdargs=["-log", log, "-screen", "none", *words])
    lmp.commands_string(open(name).read())
    return lmp, Partner(lmp, root)
def show(lmp, name):
    lmp.command(f"write_dump all custom {name} id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz "
                "modify sort id format float %a")
def say(lmp, result, root=0):
    if lmp.extract_setting("world_rank") == root:
        with open("said", "w") as file:
            json.dump(result, file)
def refusal(call, *words):
    try:
        call(*words)
    except TalusError as error:
        return str(error)
    return "none"
"""
PARTNER_SCENE = start() + pair() + MOVE + walls() + f"""
fix guided all large/body box 8.5 1.0 3.5 1 1 1 outside contact {LAW} move external
fix sheet all large/body mesh sheet.stl contact {LAW} move vertices
"""
# what the partner tells depends on what it got: a wrong number anywhere shows in all that follow
EXCHANGE = """
def exchange(partner, steps):
    guided, sheet = partner.body("guided"), partner.body("sheet")
    impulse, twist, work, time = guided.load()
    touched, impulses, done, since = sheet.vertex_loads()
    state = guided.state
    state[9] = 0.3 - 0.02 * impulse[2]
    state[0] -= 0.004 * (1 + 0.01 * impulse[0])
    guided.put_state(state, steps)
    x, _ = sheet.mesh
    sheet.put_vertices([[a, b, c + 0.01 * math.sin(a + 0.01 * done)] for a, b, c in x], steps=steps)
    ids = list(range(1, 60))
    drag = partner.drag_impulses(ids)
    partner.put_drag(ids, [0.3 + 0.001 * abs(row[0]) for row in drag], [[0.2, 0.1, 0.5]] * len(ids))
    partner.put_forces(ids[:9], [[0.1 * impulse[2], 0, 0.2]] * 9)
    partner.advance(steps)
    numbers = [*impulse, *twist, work, time, *touched, *(y for row in impulses for y in row), done, since, *state,
               *(y for row in drag for y in row)]
    return [float(number).hex() for number in numbers]
"""
PARTNER = BEGIN + EXCHANGE + """
lmp, partner = scene()
partner.body("guided").watch()
result = {"first": [exchange(partner, 20) for _ in range(10)]}
if sys.argv[1] == "plain":
    result["then"] = [exchange(partner, 20) for _ in range(20)]
else:
    snapshot = partner.save()
    result["then"] = [exchange(partner, 20) for _ in range(20)]
    partner.restore(snapshot)
    result["then.1"] = [exchange(partner, 20) for _ in range(1)]
    partner.restore(snapshot)
    result["then.2"] = [exchange(partner, 20) for _ in range(20)]
show(lmp, sys.argv[1])
say(lmp, result)
lmp.finalize()
"""
OUTPUTS = BEGIN + """
lmp, partner = scene(log="log.out", words=sys.argv[1:])
partner.advance(40)
with partner.save() as snapshot:
    partner.advance(43)
    partner.restore(snapshot)
    partner.advance(43)
    partner.restore(snapshot)
    partner.advance(20)
    partner.advance(23)
lmp.finalize()
"""
BETWEEN = BEGIN + """
lmp, partner = scene()
partner.advance(300)
snapshot = partner.save()
partner.advance(400)
show(lmp, "plain")
partner.restore(snapshot)
lmp.command("delete_atoms group few")
partner.advance(50)
partner.restore(snapshot)
partner.advance(400)
show(lmp, "deleted")
partner.restore(snapshot)
lmp.command("write_restart between")
partner.restore(snapshot)
partner.advance(400)
show(lmp, "written")
partner.restore(snapshot)
lmp.command("pair_coeff 1 2 hertz 8000.0 40.0")
partner.restore(snapshot)
partner.advance(400)
show(lmp, "law")
partner.restore(snapshot)
partner.advance(400)
show(lmp, "law.2")
lmp.finalize()
"""
ERRORS = BEGIN + """
lmp, partner = scene(root=1)
said = []
snapshot = partner.save()
class Nothing:
    _handle = ctypes.c_void_p()
said.append(refusal(partner.restore, Nothing))
lmp.command("fix more all viscous 0.1")
said.append(refusal(partner.restore, snapshot))
lmp.command("unfix more")
partner.restore(snapshot)
lmp.command("unfix floor")
said.append(refusal(partner.restore, snapshot))
lmp.command("fix floor all viscous 0.1")
said.append(refusal(partner.restore, snapshot))
lmp.command("unfix floor")
lmp.command("group pieces id 1 2")
lmp.command("fix bricks pieces rigid single")
said.append(refusal(partner.save))
lmp.command("unfix bricks")
other, other_partner = scene(root=1)
said.append(refusal(other_partner.restore, snapshot))
other_partner.close()
other.close()
size = snapshot.size
snapshot.discard()
snapshot.discard()
said.append(size > 1000 and snapshot.size == 0)
try:
    FixedPoint(partner)
except ValueError as error:
    said.append(str(error))
say(lmp, said, 1)
partner.close()
lmp.finalize()
"""
MEMORY = BEGIN + """
import resource
lmp, partner = scene()
partner.advance(100)
taken = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (taken + 2**25, -1))
kept, said = [], "none"
while said == "none" and len(kept) < 100000:
    try:
        kept.append(partner.save())
    except TalusError as error:
        said = str(error)
kept.clear()
partner.advance(100)
show(lmp, "after")
say(lmp, said)
lmp.finalize()
"""
FIXED_POINT = BEGIN + """
lmp, partner = scene()
partner.advance(10)
steps, said = [], {}
class Other:
    value = 1.0
other = Other()
def window(y):
    steps.append(partner.step)
    partner.advance(3)
    other.value += 1.0
    return [5.0 - 3.0 * y[0], 2.0 + 0.2 * y[0] - 1.5 * y[1]]    # plain iteration diverges
fixed_point = FixedPoint(partner, save=lambda: other.value, restore=lambda value: setattr(other, "value", value),
                         relative=1e-10, max_iterations=50)
said["result"] = fixed_point.advance(window, [0.0, 0.0])
said["iterations"] = fixed_point.last_iterations
said["steps"], said["step"], said["other"] = steps, partner.step, other.value
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    fixed_point.max_iterations = 3
    fixed_point.advance(window, [7.0, -3.0])
    said["warning"] = [str(one.message) for one in caught if one.category is RuntimeWarning]
said["counts"] = fixed_point.windows, fixed_point.not_converged
say(lmp, said)
lmp.finalize()
"""


class Restore(CoupledCase):

    def setUp(self):
        super().setUp()
        tossed(self.path("grains"))
        self.write("scene", start("p p f") + pair() + MOVE + f"group few id 3 50 7 101\nfix floor all large/body plane 0 0 0 0 0 1 "
                   f"contact {LAW}\n")

    def assert_same_end(self, name, other):
        self.assert_same_bits(*(read_dump(self.path(n))[0] for n in (name, other)))

    def test_what_the_partner_is_owed(self):
        self.write("scene", PARTNER_SCENE)
        body_meshes.write_stl(self.path("sheet.stl"), body_meshes.grid(lambda i, j: (1.0 + i, 1.0 + j, 0.8), 7, 5))
        self.drive(PARTNER, "plain")
        plain = self.read_json("said")
        self.assertGreater(len(set(map(len, plain["then"]))), 1, "more and fewer vertices are touched")
        for np, threads in (1, 1), (2, 1), (2, 2):
            with self.subTest(ranks=np, threads=threads):
                self.drive(PARTNER, "saved", np=np, env={"OMP_NUM_THREADS": str(threads)}, timeout=200)
                said = self.read_json("said")
                self.assertEqual(said["first"], plain["first"])
                self.assertEqual(said["then"], plain["then"])
                self.assertEqual(said["then.1"], plain["then"][:1])
                self.assertEqual(said["then.2"], plain["then"])
                self.assert_same_end("plain", "saved")

    def test_outputs_of_repeated_steps(self):
        """Thermo output: the rows of a step are the same, that of the step of the snapshot as well; fix ave/time reads each
        step once."""
        more = ("compute all all penalty/stats\nfix mean all ave/time 2 3 10 c_all[2] file means\n"
                "thermo_style custom step atoms pe ke press c_all[1] c_all[2] c_all[3] c_all[4] c_all[5] c_all[6] c_all[7] f_floor\n"
                "thermo_modify norm no format float %.17g\nthermo 7\n"
                "dump some all custom 11 dumped id x vx fx c_lost[1]\ndump_modify some sort id format float %a\n")
        with open(self.path("scene"), "a") as file:
            file.write("compute lost all dissipation/gran/atom\n" + more)
        rows = self.repeated_rows()
        self.assertGreater(rows[83][0]["c_all[2]"], 10)
        frames = {}
        for frame in read_dump(self.path("dumped")):
            frames.setdefault(frame.step, []).append(frame)
        self.assertEqual([len(frames[step]) for step in (33, 44, 77)], [1, 3, 3])
        for same in frames.values():
            for frame in same:
                self.assert_same_bits(frame, same[0])
        with open(self.path("means")) as file:
            self.assertEqual([int(line.split()[0]) for line in file if line[0] != "#"], list(range(10, 81, 10)))

    def repeated_rows(self, *words):
        """{step: rows of thermo output}, which are the same."""
        self.drive(OUTPUTS, *words)
        log = self.read("log.out")
        self.assertEqual(log.count("overlap by"), 1, "a warning is not repeated with the steps")
        rows = {}
        for row in thermo(log):
            rows.setdefault(row.pop("Step"), []).append(row)
        self.assertEqual([len(rows[step]) for step in (40, 42, 49, 83)], [4, 3, 3, 3])
        for step, same in rows.items():
            for row in same:
                self.assertEqual(row, same[0], f"step {step}")
        return rows

    def test_contacts_with_walls_in_outputs(self):
        """Of LAMMPS, which keep their contacts to themselves: also of the step of the snapshot."""
        self.write("scene", SCENES["walls of the host"].script.replace("wall/gran ", "wall/gran/talus ") +
                   "compute all all penalty/stats\ncompute pairs all contact/gran/local force overlap\n"
                   "compute sum all reduce sum c_pairs[1] c_pairs[2] inputs local\n"
                   "thermo_style custom step atoms pe ke c_all[1] c_all[2] c_all[3] c_all[4] c_all[5] c_all[6] c_all[7] c_sum[1] c_sum[2]\n"
                   "thermo_modify norm no format float %.17g\nthermo 7\n")
        rows = self.repeated_rows("-sf", "talus")
        self.assertGreater(rows[40][0]["c_all[2]"], 5)

    def test_commands_in_between(self):
        tossed(self.path("grains"), types=2)
        self.drive(BETWEEN)
        self.assert_same_end("plain", "deleted")
        self.assert_same_end("plain", "written")
        # the set-up of the first one is after the restore; with two laws there are more numbers of each contact
        self.assertEqual(*(read_dump(self.path(name))[0].step for name in ("law", "law.2")))
        plain, other = (read_dump(self.path(name))[0] for name in ("plain", "law"))
        self.assertNotEqual(plain.column("z"), other.column("z"), "a law that has changed since is that of the next steps")

    def test_refusals(self):
        for scene in "scene", "bare":
            if scene == "bare":
                self.write("scene", start() + pair() + MOVE + walls())
            self.drive(ERRORS, np=2, stay=False)
            nothing, added, deleted, anew, bricks, other, sizes, root = self.read_json("said")
            self.assertEqual(nothing, "talus_restore: snapshot is NULL")
            self.assertEqual(added, "talus_restore: fix more (viscous) has been added since the snapshot was made")
            self.assertEqual(deleted, "talus_restore: fix floor (large/body) has been deleted since the snapshot was made")
            self.assertIn("fix floor (large/body) has been deleted", anew)
            self.assertRegex(bricks, r"^talus_save: fix bricks \(rigid\) of LAMMPS .*: use fix rigid/small ")
            self.assertEqual(other, "talus_restore: the snapshot is of another instance of LAMMPS")
            self.assertTrue(sizes)
            self.assertIn("open the Partner with ALL_RANKS", root)

    def test_memory(self):
        if os.environ.get("TALUS_SANITIZE"):    # they need more address space than the test leaves
            return
        self.drive(MEMORY, stay=False)
        self.assertEqual(self.read_json("said"), "talus_save: some rank has not enough memory for another snapshot: discard others, "
                         "or use more machines")

    def test_fixed_point(self):
        for np in 1, 2:
            self.drive(FIXED_POINT, np=np)
            said = self.read_json("said")
            for found, expected in zip(said["result"], (1.25, 0.9), strict=True):
                self.assertAlmostEqual(found, expected, places=7)
            self.assertLess(said["iterations"], 50)
            self.assertEqual(said["steps"][:said["iterations"]], [10] * said["iterations"], "each begins at the same step")
            self.assertEqual((said["step"], said["other"]), (13, 2.0), "the last one counts")
            warning, = said["warning"]
            self.assertRegex(warning, r"not converged in 3 iterations at time 0\.016: residual \S+, result \S+, relative 1e-10")
            self.assertEqual(said["counts"], [2, 1])


if __name__ == "__main__":
    unittest.main()
