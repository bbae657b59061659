# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Sections of the stability study: particles with a shape, and meshes that deform."""

import extreme_meshes
import extreme_shapes
from lammps import SECOND, TALUS


def cells(outcome, energy=True):
    """Energy, overlap, verdict with the faults; a run that was refused has none of them."""
    word = outcome.word()
    faults = ", ".join(outcome.faults())
    text = word + (f": {faults}" if faults else "")
    if word == "refused":
        return [""] * (2 if energy else 1) + [text]
    return ([outcome.growth] if energy else []) + [outcome.overlap, text]


def record(section, part, name, code, outcome):
    section.record(part=part, case=name, code=code, verdict=outcome.word(), growth=outcome.growth, overlap=outcome.overlap,
                   lost=outcome.lost, finite=outcome.finite, kinetic=outcome.kinetic, said=len(outcome.warnings), error=outcome.error)


def shapes(bench, pool):
    section = bench.section
    scenes = extreme_shapes.scenes(bench.quick)
    order = sorted(scenes, key=lambda s: -s.steps * len(s.bodies))      # the long ones first
    found = dict(zip((s.name for s in order), pool.map(lambda s: extreme_shapes.run(bench, s), order)))
    rows = []
    for scene in scenes:
        outcome, code = found[scene.name], SECOND if scene.order == 2 else TALUS
        rows.append([scene.name, *cells(outcome)])
        record(section, "shapes", scene.name, code, outcome)
        bench.tally.add(scene.name, code, outcome.word())
    section.heading("Particles with a shape")
    section.table(["scene", "energy", "overlap/r", "verdict"], rows)
    section.text(f"""Linear contacts, of beds with damping and friction .5, of gases and of two bodies that meet elastic and without friction;
time steps are {extreme_shapes.FRACTION:g} of the critical one of spheres with the same mass unless the name says otherwise; fast: speeds of 30, which
press thin ones through each other. overlap/r: over the radius of the largest sphere inside. Energies are those that Talus accounts for
(kinetic, potential, elastic). Shapes are of order 1: the last scene has spheres of order 2 among them.""")
    alarms = [name for name, outcome in found.items() if outcome.warnings and outcome.word() == "stable"]
    section.text("Warnings in scenes that stayed stable: " + "; ".join(alarms) + ".")


def meshes(bench, pool):
    section = bench.section
    jobs = [(number, order) for number in range(len(extreme_meshes.SCENES)) for order in (1, 2)]
    found = dict(zip(jobs, pool.map(lambda job: extreme_meshes.run(bench, *job), jobs)))
    rows = []
    for number, scene in enumerate(extreme_meshes.SCENES):
        rows.append([scene.name])
        for order, code in ((1, TALUS), (2, SECOND)):
            outcome = found[number, order]
            rows[-1] += cells(outcome, energy=False)
            record(section, "meshes", scene.name, code, outcome)
            bench.tally.add("sheet: " + scene.name, code, outcome.word())
    section.heading("Meshes that deform")
    section.table(["scene", "order 1: overlap/r", "verdict", "order 2: overlap/r", "verdict"], rows)
    section.text("""A partner moves the vertices of a sheet of 512 triangles under 50 spheres of diameter 1, skin .2, with an exchange every ten steps, or in
each; it does work on the grains, so that energies are not judged. `refused` and `stopped`: the partner was told what is wrong with the
places that it gave, by number of vertex or triangle, before anything was changed.""")
