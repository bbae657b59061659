# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: cost=60 timeout=600
"""talus_save() and talus_restore(): steps after a restore repeat those after the save with all bits, and are those of a run
that was never saved, for every kind of scene, on ranks and threads; what is refused."""

import json
import os
import sys
import unittest

TESTS = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(TESTS, "..", "lib"))
from saved_scenes import SCENES
from talus_testing import SceneCase, read_dump, run_program

SOURCE = os.environ["TALUS_SOURCE_DIR"]
HOST, HOST_SOURCE = os.environ["TALUS_LAMMPS_BINARY"], os.environ["TALUS_LAMMPS_SOURCE"]
if not os.path.isdir(os.path.join(HOST_SOURCE, "python")):
    HOST_SOURCE = os.path.dirname(HOST_SOURCE.rstrip("/"))

BEGIN = """
import json, sys
sys.path[:0] = [{module!r}, {source!r} + "/python"]
from lammps import lammps
from talus import Partner, TalusError
lmp = lammps(cmdargs=["-log", "none", "-screen", "none"] + {words!r})
lmp.commands_string(open("scene").read())
partner = Partner(lmp)
me = lmp.extract_setting("world_rank")
state = "id type radius x y z ix iy iz vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz {columns}"
numbers = {{}}
def show(name):
    numbers[name] = [lmp.extract_fix(fix, 0, 1, n).hex() for fix, size in {vectors!r} for n in range(size)]
    lmp.command(f"write_dump all custom {{name}} {{state}} modify sort id format float %a")
def guide():
    if {guided!r}:
        body = partner.body("guided")
        there = body.state
        there[0] -= 0.2
        there[9] = 0.1
        body.put_state(there, 180)
def end():
    if me == 0:
        with open("numbers", "w") as file:
            json.dump(numbers, file)
    lmp.finalize()
"""
PLAIN = BEGIN + """
partner.advance(220)
guide()
partner.advance(50)
show("then")
partner.advance(5)
show("soon")
partner.advance(895)
show("later")
end()
"""
SAVED = BEGIN + """
partner.advance(220)
guide()
partner.advance(50)
snapshot = partner.save()
assert snapshot.size > 1000
show("then")
partner.advance(5)
show("soon")
partner.restore(snapshot)
show("then.1")
partner.advance(5)
show("soon.1")
partner.advance(895)
show("later")
partner.restore(snapshot)
show("then.2")
partner.advance(900)
show("later.2")
partner.restore(snapshot)
partner.advance(5)
show("soon.3")
later = partner.save()
partner.advance(300)
partner.restore(snapshot)
partner.advance(300)
partner.restore(later)
snapshot.discard()
partner.advance(895)
show("later.3")
end()
"""


class Snapshots(SceneCase):

    def run_driver(self, text, scene, where, np=1, threads=1):
        os.makedirs(self.path(where), exist_ok=True)
        scene.write(self.path(os.path.join(where, "grains")))
        with open(self.path(os.path.join(where, "scene")), "w") as file:
            file.write(scene.script)
        driver = self.path(os.path.join(where, "driver.py"))
        with open(driver, "w") as file:
            file.write(text.format(module=os.path.join(HOST_SOURCE, "python"), source=SOURCE, words=list(scene.words),
                                   columns=scene.columns, vectors=scene.vectors, guided="fix guided" in scene.script))
        library = os.pathsep.join([HOST, os.environ.get("LD_LIBRARY_PATH", "")])
        result = run_program(sys.executable, np=np, arguments=["driver.py"], cwd=self.path(where),
                             env={"LD_LIBRARY_PATH": library, "OMP_NUM_THREADS": str(threads)}, timeout=200)
        return result.output

    def numbers(self, where):
        with open(self.path(os.path.join(where, "numbers"))) as file:
            return json.load(file)

    def assert_repeats(self, plain, saved):
        expected, found = self.numbers(plain), self.numbers(saved)
        for name in found:
            with self.subTest(state=name):
                of_plain = name.split(".")[0]
                frame, = read_dump(self.path(os.path.join(plain, of_plain)))
                other, = read_dump(self.path(os.path.join(saved, name)))
                self.assertEqual(frame.step, other.step)
                self.assert_same_bits(frame, other)
                self.assertEqual(expected[of_plain], found[name])

    def assert_scene(self, name, cases=((1, 1), (2, 1))):
        scene = SCENES[name]
        self.run_driver(PLAIN, scene, "plain")
        for np, threads in cases:
            with self.subTest(ranks=np, threads=threads):
                where = f"saved-{np}-{threads}"
                self.run_driver(SAVED, scene, where, np, threads)
                self.assert_repeats("plain", where)

    def test_spheres(self):
        self.assert_scene("spheres", ((1, 1), (1, 2), (2, 1), (4, 1)))

    def test_periodic(self):
        self.assert_scene("periodic", ((1, 1), (1, 2), (2, 1), (4, 1)))


def add(name):
    def test(self):
        self.assert_scene(name)
    setattr(Snapshots, "test_" + name.replace(" ", "_"), test)


for name in SCENES:
    if not hasattr(Snapshots, "test_" + name.replace(" ", "_")):
        add(name)


if __name__ == "__main__":
    unittest.main()
