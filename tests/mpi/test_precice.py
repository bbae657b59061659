# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=300
"""python/talus_precice.py with a stand-in for preCICE (tests/lib/precice.py), through which two programs talk: grains in a fluid that
the other computes, and a sheet that the other bends, explicitly and with windows that are repeated, on one rank and two, have the
numbers of one program that does both; refusals."""

import json
import os
import subprocess
import sys
import unittest

import body_meshes
from coupled_case import SOURCE, CoupledCase, host_environment
from talus_testing import environment, head

# python3-numpy of Debian belongs to its own Python, which need not be this one
PYTHON = next((one for one in (sys.executable, "/usr/bin/python3")
               if subprocess.run([one, "-c", "import numpy"], capture_output=True, check=False).returncode == 0), "no Python with NumPy")
DT, STEPS, WINDOWS = 1e-4, 10, 6
BOX, SIDE = 0.06, 3

HEAD = """
import json, sys
import numpy
sys.path[:0] = {path!r}
CASE = {case!r}
WINDOWS, ITERATIONS, WINDOW, STEPS = CASE["windows"], CASE["iterations"], CASE["window"], {steps}
"""

# the other side, also within one program: state and what it gets -> what it tells at the end of a window, and its new state
FLUID = """
SIDE, BOX = 3, 0.06
x = numpy.array([[(i + 0.5) * BOX / SIDE for i in (n % SIDE, n // SIDE % SIDE, n // SIDE**2)] for n in range(SIDE**3)])
FIRST = {"Velocity": numpy.tile([0.5, -0.2, 0.1], (SIDE**3, 1)) * (1 + x[:, :1] / BOX),
         "Volume": numpy.full(SIDE**3, (BOX / SIDE)**3),
         "Gradient": numpy.tile([0.0, 30.0, -2.0], (SIDE**3, 1))}
DENSITY = 1.2

def solve(state, got):
    porosity = 1 - got["SolidFraction"].reshape(-1, 1)
    state = state + WINDOW * got["Drag"] / (DENSITY * porosity)
    return {**FIRST, "Velocity": state}, state

STATE, NOTHING = FIRST["Velocity"], {"SolidFraction": numpy.zeros(SIDE**3), "Drag": numpy.zeros((SIDE**3, 3))}
"""

SHEET = """
FIRST = {}
STIFFNESS = 400.0

def solve(state, got):
    state = 0.8 * state + 0.2 * got["Force"] / STIFFNESS
    return {"Displacement": state}, state
"""

SECOND = """
import precice
participant = precice.Participant("Other", "precice.json", 0, 1)
if MESH == "Fluid-Mesh":
    ids = participant.set_mesh_vertices(MESH, x)
else:
    participant.set_mesh_access_region(MESH, [-9, 9] * 3)
    ids = numpy.arange(CASE["vertices"] * CASE["size"])
    FIRST = {"Displacement": numpy.zeros((len(ids), 3))}
    STATE = FIRST["Displacement"][:CASE["vertices"]]
for name, values in FIRST.items():
    participant.write_data(MESH, name, ids, values)
participant.initialize()
if MESH != "Fluid-Mesh":
    assert len(participant.get_mesh_vertex_ids_and_coordinates(MESH)[0]) == len(ids)

def received():
    got = {name: participant.read_data(MESH, name, ids, 0.0) for name in WRITTEN}
    if MESH != "Fluid-Mesh":    # each rank has all vertices
        got["Force"] = got["Force"].reshape(CASE["size"], -1, 3).sum(0)
    return got

state = STATE
while participant.is_coupling_ongoing():
    if participant.requires_writing_checkpoint() or ITERATIONS == 1:
        kept = state
    told, state = solve(kept, received())
    for name, values in told.items():
        participant.write_data(MESH, name, ids, values if MESH == "Fluid-Mesh" else numpy.tile(values, (CASE["size"], 1)))
    participant.advance(participant.get_max_time_step_size())
    participant.requires_reading_checkpoint()
participant.finalize()
"""

LAMMPS = """
from lammps import lammps
from talus import Partner
lmp = lammps(cmdargs=["-log", "none", "-screen", "none"])
lmp.file("in.scene")
"""

FINISH = """
ids = partner.ids()
x, v = partner.particles(ids, "x", "v")
if lmp.extract_setting("world_rank") == 0:
    with open("{out}", "w") as file:
        json.dump([[float(one).hex() for one in numpy.ravel(some)] for some in (x, v)], file)
"""

END = "\nlmp.close()\nlmp.finalize()\n"

GRAINS = LAMMPS + """
from talus_precice import Participant
with Partner(lmp) as partner:
    grains = Participant(partner, "Grains", "precice.json")
    {coupling}
    grains.run({every})
""" + FINISH.replace("\n", "\n    ") + END

ALONE = LAMMPS + """
with Partner(lmp) as partner:
    {prepare}
    state, told, got = STATE, FIRST, NOTHING
    for window in range(WINDOWS):
        kept, snapshot = state, partner.save()
        for iteration in range(ITERATIONS):
            if iteration:
                partner.restore(snapshot)
            {act}
            told, state = solve(kept, got)
            got = found
""" + FINISH.replace("\n", "\n    ") + END

ACT_FLUID = """fluid.put(told["Velocity"].ravel(), told["Gradient"].ravel(), (0.0, 0.0, -9.81))
            fluid.grains("exchange")
            partner.advance(STEPS)
            found = {"SolidFraction": numpy.array(fluid.grains("solid"))}
            found["Drag"] = -numpy.array(fluid.grains("exchange")) / WINDOW"""

ACT_SHEET = """body.put_vertices((place + told["Displacement"]).ravel(), steps=STEPS)
            partner.advance(STEPS)
            vertices, impulses, _, _ = body.vertex_loads()
            found = {"Force": numpy.zeros_like(place)}
            if len(vertices):
                found["Force"][numpy.array(vertices)] = numpy.array(impulses) / WINDOW"""

SUSPENSION = head(units="si", boundary="p p p", map=None) + f"""
region box block 0 {BOX} 0 {BOX} 0 {BOX} units box
create_box 1 box
lattice sc 0.012
create_atoms 1 box
displace_atoms all random 0.001 0.001 0.001 5
set group all diameter 0.008 density 100
neighbor 0.002 bin
pair_style gran/penalty
pair_coeff * * hooke 100 1 tangential multistep NULL NULL 0.5
timestep {DT}
fix step all nve/sphere/symplectic gravity 9.81 vector 0 0 -1
thermo 0
"""

LOADED = head(units="si", boundary="f f f", map=None) + f"""
region box block -1 1 -1 1 -1 1 units box
create_box 1 box
lattice sc 0.2 origin 0 0 0.47
region some block -0.5 0.5 -0.5 0.5 0.05 0.2 units box
create_atoms 1 region some
set group all diameter 0.19 density 1000
neighbor 0.05 bin
pair_style gran/penalty
pair_coeff * * hooke 1e4 10 tangential multistep NULL NULL 0.5
timestep {DT}
fix step all nve/sphere/symplectic gravity 9.81 vector 0 0 -1
fix sheet all large/body mesh sheet.stl two-sided contact hooke 1e4 10 tangential multistep NULL NULL 0.5 move vertices
velocity all set 0.1 0 -2
thermo 0
"""

DATA = {"Fluid-Mesh": {"Velocity": ["Fluid-Mesh", "Other", 3], "Volume": ["Fluid-Mesh", "Other", 1], "Gradient": ["Fluid-Mesh", "Other", 3],
                       "SolidFraction": ["Fluid-Mesh", "Grains", 1], "GrainVelocity": ["Fluid-Mesh", "Grains", 3],
                       "Drag": ["Fluid-Mesh", "Grains", 3], "DragCoefficient": ["Fluid-Mesh", "Grains", 1]},
        "Sheet-Mesh": {"Displacement": ["Sheet-Mesh", "Other", 3], "Force": ["Sheet-Mesh", "Grains", 3]}}
LAW = '"tophat 0", "gidaspow", 1.2, 1.8e-5'
GRADIENT = 'gravity=(0.0, 0.0, -9.81), pressure_gradient="Gradient"'
COUPLING = {"Fluid-Mesh": f'grains.fluid("Fluid-Mesh", (0, 0, 0), (0.06,) * 3, {LAW}, {GRADIENT})',
            "Sheet-Mesh": 'grains.surface("Sheet-Mesh", "sheet")'}
PREPARE = {"Fluid-Mesh": 'fluid = partner.fluid_cells(x.ravel(), FIRST["Volume"], "tophat 0")\n'
                         '    fluid.drag_law("gidaspow", 1.2, 1.8e-5)',
           "Sheet-Mesh": 'body = partner.body("sheet")\n    place = numpy.array(body.mesh[0])\n    body.vertex_loads()\n'
                         '    STATE = numpy.zeros_like(place)\n    FIRST, NOTHING = {"Displacement": STATE}, {"Force": STATE}'}
OTHER = {"Fluid-Mesh": FLUID, "Sheet-Mesh": SHEET}
ACT = {"Fluid-Mesh": ACT_FLUID, "Sheet-Mesh": ACT_SHEET}
WRITTEN = {"Fluid-Mesh": ["SolidFraction", "GrainVelocity", "Drag", "DragCoefficient"], "Sheet-Mesh": ["Force"]}


class Coupled(CoupledCase):

    def setUp(self):
        super().setUp()
        sheet = body_meshes.grid(lambda i, j: (-0.6 + 0.2 * i, -0.6 + 0.2 * j, 0.0), 6, 6)
        body_meshes.write_stl(self.path("sheet.stl"), sheet)

    def case(self, mesh, size=1, iterations=1, window=STEPS * DT):
        if os.path.exists(self.path("socket")):
            os.remove(self.path("socket"))
        found = {"address": self.path("socket"), "first": "Grains", "second": "Other", "size": size, "window": window,
                 "windows": WINDOWS, "iterations": iterations, "vertices": 49,
                 "meshes": {mesh: "Other" if mesh == "Fluid-Mesh" else "Grains"}, "data": DATA[mesh]}
        self.write("precice.json", json.dumps(found))
        self.write("in.scene", SUSPENSION if mesh == "Fluid-Mesh" else LOADED)
        paths = host_environment()["PYTHONPATH"].split(":")
        return HEAD.format(path=paths, case=found, steps=STEPS) + OTHER[mesh]

    def drive(self, program, *words, np=1, **options):
        return self.launch([PYTHON, self.write("driver.py", program), *words], np, **options)

    def two_programs(self, mesh, every="", coupling=None, **words):
        begin = self.case(mesh, **words)
        other = self.write("other.py", begin + f"MESH, WRITTEN = {mesh!r}, {WRITTEN[mesh]}\n" + SECOND)
        process = subprocess.Popen([PYTHON, other], cwd=self.dir, env=environment(host_environment()), stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        try:
            self.drive(begin + GRAINS.replace("{coupling}", coupling or COUPLING[mesh]).replace("{every}", every)
                       .replace("{out}", "two.json"), np=words.get("size", 1))
            output, _ = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 0, output[-2000:])
        except AssertionError as error:
            process.kill()
            raise AssertionError(f"{error}\nthe other program:\n{process.communicate()[0][-2000:]}") from error
        finally:
            process.kill()
            process.wait()
            process.stdout.close()
        return self.read_json("two.json")

    def alone(self, mesh, **words):
        begin = self.case(mesh, **words)
        self.drive(begin + ALONE.replace("{prepare}", PREPARE[mesh]).replace("{act}", ACT[mesh]).replace("{out}", "alone.json"))
        return self.read_json("alone.json")

    def test_as_one_program(self):
        for mesh in DATA:
            for iterations in 1, 3:
                expected = self.alone(mesh, iterations=iterations)
                for size in 1, 2:
                    with self.subTest(mesh, iterations=iterations, ranks=size):
                        found = self.two_programs(mesh, size=size, iterations=iterations)
                        if mesh == "Fluid-Mesh" or size == 1:
                            self.assertEqual(found, expected)
                        for a, b in zip(sum(found, []), sum(expected, [])):
                            self.assertAlmostEqual(float.fromhex(a), float.fromhex(b), delta=1e-12)
            self.assertNotEqual(expected, self.alone(mesh), "iterations change nothing: the case is too weak")

    def test_equal_volumes_and_data_that_nobody_reads(self):
        found = self.two_programs("Fluid-Mesh", coupling=f'grains.fluid("Fluid-Mesh", (0, 0, 0), (0.06,) * 3, {LAW}, {GRADIENT}, '
                                                         "volume=(0.06 / 3)**3, grain_velocity=None, coefficient=None)")
        self.assertEqual(found, self.alone("Fluid-Mesh"))

    def test_shorter_exchanges_than_windows(self):
        found = self.two_programs("Fluid-Mesh", every="every=4")
        self.assertNotEqual(found, self.alone("Fluid-Mesh"), "drag is that of the last exchange in a window")

    def test_refusals(self):
        for coupling, window, message in (
                ('grains.fluid("Fluid-Mesh", (0,) * 3, (1,) * 3, "tophat 0", "stokes", 1, 1, speed="V")', STEPS * DT,
                 "'speed' is none of velocity, pressure_gradient, volume"),
                (None, 10.5 * DT, "preCICE asks for a step of 0.00105, which is no whole number of time steps"),
                ('grains.fluid("Fluid-Mesh", (0,) * 3, (1,) * 3, "tophat 0", "stoks", 1, 1)', STEPS * DT, "stoks"),
                ('grains.fluid("Fluid-Mesh", (1,) * 3, (2,) * 3, "tophat 0", "stokes", 1, 1)', STEPS * DT,
                 r"mesh 'Fluid-Mesh' has no vertex between \(1, 1, 1\) and \(2, 2, 2\)")):
            for size in 1, 2:
                with self.subTest(message, ranks=size), self.assertRaisesRegex(AssertionError, message):
                    self.two_programs("Fluid-Mesh", size=size, window=window, coupling=coupling)

    def test_without_bindings(self):
        self.write("in.scene", SUSPENSION)
        text = ("import sys\nsys.path[:0] = [" + repr(SOURCE + "/python") + "]\nsys.modules['precice'] = None\n" + LAMMPS +
                "from talus_precice import Participant\nwith Partner(lmp) as partner:\n    Participant(partner, 'Grains', 'none.xml')\n")
        with self.assertRaisesRegex(AssertionError, "needs the Python bindings of preCICE 3: pip install pyprecice"):
            self.drive(text)


if __name__ == "__main__":
    unittest.main()
