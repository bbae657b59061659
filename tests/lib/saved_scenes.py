# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Scenes of every kind whose state is saved and restored: {name: Scene}, small and with many rebuilds."""

import dataclasses

import body_meshes
from talus_testing import head, write_sphere_data
from tossed_clumps import write_clumps
from tossed_grains import LAW, tossed_grains

SECOND = "hertz 4000.0 40.0 tangential multistep NULL NULL 0.5 slider midpoint limit_damping"
HISTORY = "hooke/history 4000.0 NULL 20.0 NULL 0.5 0"


@dataclasses.dataclass
class Scene:
    """script: of LAMMPS; vectors: (fix, length) whose numbers are compared; columns: more by particle; words: of the command
    line; write: makes the data file 'grains'; later: how 400 steps are divided.  To fix deform each advance is a run."""
    script: str
    vectors: tuple = ()
    columns: str = ""
    words: tuple = ()
    write: object = None
    later: tuple = (400,)


def tossed(path, layers=3, types=1):
    grains = tossed_grains(layers)
    for k, grain in enumerate(grains):
        grain.type = 1 + k % types
    write_sphere_data(path, ((0, 9.5), (0, 7.2), (-0.5, 6.5)), grains, types=max(types, 1))


def start(boundary="f f f", read="read_data grains", style="sphere", more=""):
    return head(boundary=boundary, style=style) + f"""{more}
{read}
neighbor 0.1 bin
timestep 0.001
thermo 100000
thermo_style custom step atoms
thermo_modify norm no lost ignore
"""


def pair(law=LAW):
    return f"pair_style gran/penalty\npair_coeff * * {law}\n"


def walls(law=LAW):
    return "".join(f"fix {name} all large/body plane {plane} contact {law}\n" for name, plane in
                   (("floor", "0 0 0  0 0 1"), ("xlo", "0 0 0  1 0 0"), ("ylo", "0 0 0  0 1 0"), ("xhi", "9.5 0 0  -1 0 0"),
                    ("yhi", "0 7.2 0  0 -1 0")))


MOVE = "fix step all nve/sphere/symplectic gravity 4.0 vector 0.3 0.1 -1\n"
WALL_SCENE = f"""
pair_style gran/hooke/history 4000.0 NULL 20.0 NULL 0.5 0
pair_coeff * *
fix step all nve/sphere
fix g all gravity 10.0 vector 0.3 0.1 -1
variable turn equal 3.0*step*dt
region drum cylinder y 4.75 3.0 6.2 -0.5 7.6 rotate v_turn 4.75 0 3.0 0 1 0
fix floor all wall/gran {HISTORY} zplane 0 NULL wiggle z 0.2 0.3
fix side all wall/gran {HISTORY} xplane 0 9.5 shear y 2.0
fix drum all wall/gran/region {HISTORY} region drum
"""
BODIES = f"""
variable way equal 0.5*sin(6*step*dt)
region ram block -1 1.5 -1 9 3 9 move v_way NULL NULL
fix ram all large/body region ram contact {LAW}
fix lid all large/body rectangle 4.75 3.6 5.5 0 0 -1 1 0 0 12 12 contact {LAW} servo force 0 0 -1 60 4.0
fix block all large/body box 4.5 3.5 4.8 2 2 1 outside contact {LAW} move free mass 5 inertia 2 2 3 gravity 4 vector 0 0 -1
fix stirrer all large/body mesh stirrer.stl contact {LAW} move rotate 4 4 0 0 0 1 3 wear 1e-3 pressure average
fix guided all large/body box 8.5 1.0 3.5 1 1 1 outside contact {LAW} move external
"""
MEMBERS = "fix prop all property/atom mol ghost yes"
CLUMPS = f"""
group single type 2
group clumps type 1
neigh_modify exclude molecule/intra clumps
{{move}}
{{floor}}
"""
CORNERS = "vertices 4 1 1 1 1 -1 -1 -1 1 -1 -1 -1 1"
SHAPES = f"""
group balls type 3
fix step balls nve/sphere/symplectic
fix shapes all shape/gran type 1 box 0.8 0.7 0.6 density 1 orient random 11 &
    type 2 {CORNERS} scale 0.35 rounded 0.08 density 1 orient random 12
fix g all gravity/talus 15 vector 0.2 0.1 -1
fix floor all large/body plane 0 0 0 0 0 1 contact {LAW}
fix yhi all large/body plane 0 7.2 0 0 -1 0 contact {LAW}
fix stirrer all large/body mesh stirrer.stl contact {LAW} move rotate 4 4 0 0 0 1 3
timestep 0.0005
"""
HEAT = "granular\npair_coeff * * hertz 4000 40 tangential linear_history 2000 1.0 0.5 heat area 0.5"


def clumps_of(path):
    write_clumps(path)


def with_stirrer(path, types=1):
    tossed(path, types=types)
    body_meshes.write_stl(path.replace("grains", "stirrer.stl"), body_meshes.box((2, 3.7, 0), (6, 4.3, 0.7), 4))


def clumps(move, floor, law, words=(), vectors=()):
    read = f"{MEMBERS}\nread_data grains fix prop NULL Molecules"
    return Scene(start("p p f", read).replace("neighbor 0.1", "neighbor 0.2").replace("0.001", "0.0005") + law +
                 CLUMPS.format(move=move, floor=floor), words=words, write=clumps_of, vectors=vectors)


CLUMP = """clump

3 atoms

Coords

1 0 0 0
2 0.8 0.1 0
3 0.3 0.7 0.2

Types

1 1
2 1
3 1

Diameters

1 1.0
2 0.9
3 0.8

Masses

1 0.6
2 0.4
3 0.3
"""
POURED = head(boundary="p p f") + """
fix prop all property/atom mol ghost yes
region box block 0 9 0 9 0 14
create_box 1 box
molecule clump clump.mol
pair_style gran/hertz/history 20000 NULL 50 NULL 0.5 1
pair_coeff * *
neighbor 0.2 bin
neigh_modify every 1 delay 0 check yes exclude molecule/intra all
timestep 0.0005
fix move all rigid/small molecule mol clump
fix fall all gravity 10 vector 0.2 0 -1
fix floor all wall/gran hertz/history 20000 NULL 50 NULL 0.5 1 zplane 0 NULL
region slab block 1 8 1 8 8 12
fix drop all deposit 12 0 90 4711 region slab mol clump rigid move near 2.5 vz -6 -4
thermo 100000
thermo_style custom step atoms
thermo_modify norm no lost error
"""


def clump_file(path):
    with open(path.replace("grains", "clump.mol"), "w") as file:
        file.write(CLUMP)


SUFFIX = ("-sf", "talus")
SCENES = {
    "spheres": Scene(start() + pair() + MOVE + walls(), write=tossed),
    "periodic": Scene(start("p p f") + pair() + MOVE + f"fix floor all large/body plane 0 0 0 0 0 1 contact {LAW}\n",
                      write=tossed),
    "energies": Scene(start("p p f") + pair() + MOVE + f"fix floor all large/body plane 0 0 0 0 0 1 contact {LAW}\n"
                      "compute work all penalty/stats\ncompute lost all dissipation/gran/atom\n"
                      "thermo_style custom step pe ke c_work[1] c_work[2] c_work[3] c_work[4] c_work[5] c_work[6]\nthermo 37\n",
                      columns="c_lost[1] c_lost[2]", write=tossed),
    "second order": Scene(start("p p f") + pair(SECOND) + MOVE.replace("gravity", "order 2 gravity") +
                          f"fix floor all large/body plane 0 0 0 0 0 1 contact {SECOND}\n", write=tossed),
    "cohesion": Scene(start("p p f") + "pair_style granular\npair_coeff * * jkr 4000 0.6 0.3 20 tangential "
                      f"linear_history 2000 1.0 0.5\nfix step all nve/sphere\nfix g all gravity 10 vector 0.3 0 -1\n"
                      f"fix floor all large/body plane 0 0 0 0 0 1 contact {LAW}\n", words=SUFFIX, write=tossed),
    "walls of the host": Scene(start() + WALL_SCENE, words=SUFFIX, write=tossed),
    "bodies": Scene(start() + pair() + MOVE + walls() + BODIES, write=with_stirrer,
                    vectors=(("lid", 20), ("block", 20), ("stirrer", 20), ("ram", 20), ("guided", 20))),
    "clumps": clumps("fix move clumps rigid/small/symplectic molecule start half gravity 10 vector 0.2 0 -1\n"
                     "fix move2 single nve/sphere/symplectic start half gravity 10 vector 0.2 0 -1",
                     f"fix floor all large/body plane 0 0 0 0 0 1 contact {LAW}\n"
                     f"fix roof all large/body plane 0 0 9 0 0 -1 contact {LAW}", pair()),
    "clumps of the host": clumps("fix move clumps rigid/small molecule\nfix move2 single nve/sphere\n"
                                 "fix fall all gravity 10 vector 0.2 0 -1",
                                 "fix floor all wall/gran hertz/history 20000 NULL 50 NULL 0.5 1 zplane 0 9",
                                 "pair_style gran/hertz/history 20000 NULL 50 NULL 0.5 1\npair_coeff * *\n", words=SUFFIX),
    "clumps that come": Scene(POURED, words=SUFFIX, write=clump_file),
    "poured by the host": Scene(start("p p f", read="region box block 0 9 0 7 0 12\ncreate_box 1 box") +
                                "pair_style gran/hooke/history 4000 NULL 20 NULL 0.5 0\npair_coeff * *\n"
                                "fix step all nve/sphere\nfix g all gravity 10 vector 0 0 -1\nregion slab block 1 8 1 6 6 11\n"
                                "fix in all pour 150 1 4767 region slab diam range 0.7 1.1 dens 1 1 vol 0.2 30\n"
                                f"fix floor all wall/gran {HISTORY} zplane 0 NULL\n", words=SUFFIX, write=lambda path: None),
    "shapes": Scene(start("p f f") + pair() + SHAPES + "region top block 1 8 1 6 5 6.3\n"
                    "fix more all deposit 20 2 40 77 region top near 1.0 vz -2 -2\n",
                    columns="f_shapes[1] f_shapes[2] f_shapes[3] f_shapes[4]",
                    write=lambda path: with_stirrer(path, types=3)),
    "poured": Scene(start("p p f").replace("neighbor", "group stream empty\nregion top block 1 8 1 6 5 6.3\nneighbor", 1) +
                    pair() + MOVE + f"fix floor all large/body plane 0 0 0 0 0 1 contact {LAW}\n"
                    "fix in stream pour/rate 40 1 top 60.0 diameter uniform 0.5 0.8 density 1.9 seed 77 velocity 0.1 0 -2\n",
                    vectors=(("in", 3),), write=tossed),
    "deposited and lost": Scene(start() + pair() + MOVE +
                                f"fix floor all large/body rectangle 4 3 0 0 0 1 1 0 0 7 9 contact {LAW}\n"
                                "region top block 1 8 1 6 5 6.3\nfix more all deposit 400 1 25 77 region top near 1.0 vz -2 -2\n",
                                write=tossed),
    "moved by the host": Scene(start() + pair() + "group base id <= 40\ngroup loose subtract all base\n" +
                               MOVE.replace("all", "loose") + "fix base base move wiggle 0 0.3 0.2 0.25\n"
                               "fix air loose viscous 0.3\n" + walls(), write=tossed),
    "heat": Scene(start("p p f", read="fix heat all property/atom temperature heatflow ghost yes\nread_data grains\nset group all temperature 1\nset atom 1*50 temperature 3") +
                  f"pair_style {HEAT}\nfix step all nve/sphere\nfix heat2 all heat/flow constant 2.0\ncompute t all property/atom temperature heatflow\n"
                  "fix g all gravity 10 vector 0.3 0 -1\n"
                  "fix floor all wall/gran granular hertz 4000 40 tangential linear_history 2000 1.0 0.5 heat area 0.5 "
                  "zplane 0 NULL temperature 2\n", columns="c_t[1] c_t[2]", words=SUFFIX, write=tossed),
    "liquid": Scene(start("p p f") + "fix liquid all property/atom d_liquid ghost yes\nvariable wet atom \"(x > 4)*0.05*radius^2\"\n"
                    "set group all d_liquid v_wet\ncompute l all property/atom d_liquid\n" +
                    pair(LAW + " adhesion willett 0.3 20 fraction 0.01 share 1") + MOVE +
                    f"fix floor all large/body plane 0 0 0 0 0 1 contact {LAW}\n", columns="c_l", write=tossed),
    "balanced": Scene(start(more="comm_style tiled") + pair() + MOVE + walls() + "fix even all balance 50 1.0 rcb\n", write=tossed),
    "tilted": Scene(start("p p f", read="read_data grains\nchange_box all triclinic\nchange_box all xy final 1.5 remap units box") +
                    pair() + MOVE + f"fix floor all large/body plane 0 0 0 0 0 1 contact {LAW}\n", write=tossed),
    "deformed": Scene(start("p p f") + pair() + MOVE + f"fix floor all large/body plane 0 0 0 0 0 1 contact {LAW}\n"
                      "fix press all deform 1 x erate -0.1 remap x\n", write=tossed, later=(5, 395)),
    "steps of the host": Scene(start("p p f") + pair() + MOVE + f"fix floor all large/body plane 0 0 0 0 0 1 contact {LAW}\n"
                               "comm_proxy no\nrun_style verlet/stock\n", write=tossed),
}
