# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Strength of wet spheres, against what the forces of their bridges say."""

import math
import os
import statistics

import numpy

import problems

TITLE = "Strength of wet grains"
QUESTION = """Liquid bridges make a granular material cohere. Its strength is that of the dry material under the sum of the applied stress
and that of the bridges (effective stress; Badetti, Fall, Chevoir, Roux, Eur. Phys. J. E 41, 68, 2018, measured and simulated: very good,
not exact, where bridges are not stronger than the applied stress times two d^2). A simpler estimate takes the stress of bridges from
their number, solid fraction z F/(pi d^2) with z bridges of the force F at each grain (Rumpf), and the cohesion of Mohr and Coulomb for
tan(phi) times that (Richefeu, El Youssoufi, Radjai, Phys. Rev. E 73, 051304, 2006: fairly good agreement with direct shear tests)."""

BRIDGES = (0.25, 0.5, 1.0)      # force at contact over lateral stress times d^2
VOLUME = 1e-3                   # of a bridge, over d^3
SEEDS = (1, 2)
QUICK = {"number": 300, "rate": 1e-2, "begin": 0.15, "strain": 0.25}


class State:
    """Means of the critical state: stresses that are applied and those of the bridges, over the lateral one."""

    def __init__(self, lateral, axial, solid, coordination):
        self.lateral, self.axial, self.solid, self.coordination = lateral, axial, solid, coordination
        self.of_bridges = 0.0, 0.0      # lateral, axial
        self.mean_force = 0.0           # over that at contact

    def ratio(self):
        return self.axial / self.lateral

    def effective(self):
        return (self.axial + self.of_bridges[1]) / (self.lateral + self.of_bridges[0])


def entries(path):
    """Frames of a dump: one array of rows each."""
    frames = []
    with open(path) as file:
        for line in file:
            if line.startswith("ITEM: NUMBER"):
                count = int(next(file))
            elif line.startswith(("ITEM: ENTRIES", "ITEM: ATOMS")):
                frames.append(numpy.array([next(file).split() for _ in range(count)], dtype=float))
    return frames


def add_bridges(state, folder, bridge, volume):
    """From all bridges of some states, by the formula of Willett et al. written here once more."""
    radius = dict(entries(os.path.join(folder, "spheres.dump"))[0])
    frames = entries(os.path.join(folder, "bridges.dump"))
    one, other, overlap, nz = numpy.concatenate(frames).T
    r1, r2 = (numpy.array([radius[k] for k in ids]) for ids in (one, other))
    derjaguin, gap = 2 * r1 * r2 / (r1 + r2), numpy.maximum(0, -overlap)
    s = gap * numpy.sqrt(derjaguin / VOLUME)
    at_contact = 2 * bridge * derjaguin       # 2 pi R gamma with gamma = bridge/(pi d)
    force = at_contact / (1 + 1.05 * s + 2.5 * s**2)
    moment = force * (r1 + r2 - overlap) / (volume * len(frames))
    axial = float(sum(moment * nz**2))
    state.of_bridges = 0.5 * (float(sum(moment)) - axial), axial
    state.mean_force = float(force.mean() / at_contact.mean())


def compress(bench, bridge, seed, cores):
    variables = {"bridge": bridge, "seed": seed, "volume": VOLUME, **bench.size({}, QUICK)}
    folder, result = problems.run(bench, "wet", f"bridge-{bridge}-{seed}", variables, cores)
    *means, volume = result.printed("Mean")[0]
    state = State(*means)
    if bridge:
        add_bridges(state, folder, bridge, volume)
    bench.note(f"bridge {bridge}, sample {seed}: ratio {state.ratio():.2f}, effective {state.effective():.2f}")
    return state


def cohesion(axial, ratio):
    """Of Mohr and Coulomb, lateral stress 1: axial = ratio + 2 c sqrt(ratio)."""
    return (axial - ratio) / (2 * math.sqrt(ratio))


def rumpf(state, bridge, ratio):
    """tan(phi) times the tensile stress by the number of bridges and their mean force."""
    tangent = (ratio - 1) / (2 * math.sqrt(ratio))
    return tangent * state.solid * state.coordination * bridge * state.mean_force / math.pi


def mean(states, number):
    return statistics.fmean(number(state) for state in states)


def measure(bench):
    bridges, seeds = bench.size(BRIDGES, BRIDGES[-1:]), bench.size(SEEDS, SEEDS[:1])
    jobs = [(bridge, seed) for bridge in (0.0, *bridges) for seed in seeds]
    found = problems.at_once([lambda cores, j=j: compress(bench, *j, cores) for j in jobs])
    states = {bridge: [state for (b, _), state in zip(jobs, found) if b == bridge] for bridge in (0.0, *bridges)}
    dry, bound = mean(states[0.0], State.ratio), bench.size(0.1, 0.25)
    shares = []
    rows = [["dry", dry, "-", "-", "-", mean(states[0.0], lambda s: s.solid), mean(states[0.0], lambda s: s.coordination)]]
    for bridge in bridges:
        of = states[bridge]
        effective = mean(of, State.effective)
        measured, expected = cohesion(mean(of, State.ratio), dry), mean(of, lambda s, b=bridge: rumpf(s, b, dry))
        bench.section.result(f"ratio of effective stresses over that of dry spheres, bridge {bridge}", effective / dry, 1 - bound, 1 + bound)
        shares.append(measured / expected)
        rows.append([bridge, mean(of, State.ratio), effective, measured, expected, mean(of, lambda s: s.solid),
                     mean(of, lambda s: s.coordination)])
        bench.section.record(bridge=bridge, ratio=rows[-1][1], effective=effective, cohesion=measured, rumpf=expected, solid=rows[-1][5],
                             coordination=rows[-1][6], dry=dry)
    bench.section.table(["F over lateral stress times d^2", "ratio of stresses", "effective", "cohesion", "by Rumpf", "solid fraction",
                         "bridges at a grain"], rows)
    samples = f"{len(seeds)} samples of each" if len(seeds) > 1 else "one sample of each"
    bench.section.text(f"""{bench.size(1000, QUICK["number"])} spheres of diameters 1 +- 10 %, friction 0.3, bridges of volume
{VOLUME} d^3 (Willett et al. 2000, complete wetting), which are made at contact and act until they break, in a periodic box that is
compressed along z at the inertial number {bench.size(4e-3, QUICK["rate"])} while the lateral stress is held: means of the critical state,
{samples}. Stresses of bridges are summed over all of them, by the formula of the force written once more; the mean
force of all bridges stands in Rumpf's relation, as those between spheres that are apart pull less. Cohesions are over the lateral stress.
Input script: `validate/in.wet`.""")
    stress = mean(states[bridges[-1]], lambda s: (2 * s.of_bridges[0] + s.of_bridges[1]) / 3)
    low, high, factor = min(shares), max(shares), (1 + stress) / stress / (dry - 1) * dry
    bench.section.text(f"""The papers tell no number for how good the agreement is: the bound of {100 * bound:.0f} % on the ratio of
effective stresses is ours. The cohesion is shown and not compared: here it is {low:.2f} to {high:.2f} of the estimate, so that a bound of
20 % would {"" if low < 0.8 else "not "}be missed. It is a small difference of large numbers: with the stress s of bridges over the
lateral one, a change of the ratio K of effective stresses by 1 % changes it by K (1 + s)/(s (K - 1)) %, about {factor:.1f} % for a bridge
of {bridges[-1]}, and more for weaker ones.""")
    bench.section.plot("", "Ratio of stresses over the force of a bridge; line: effective stresses by Rumpf's relation",
                       lambda plt: draw(plt, states, dry))


def draw(plt, states, dry):
    import plot
    _, axes = plt.subplots(figsize=(5, 3.5))
    bridges = list(states)
    axes.plot(bridges, [mean(states[b], State.ratio) for b in bridges], **plot.style(0, linestyle="none"), label="Talus")
    line = [dry + 2 * math.sqrt(dry) * (mean(states[b], lambda s, b=b: rumpf(s, b, dry)) if b else 0.0) for b in bridges]
    axes.plot(bridges, line, **plot.style(0, marker=None), label="Rumpf")
    axes.set_xlabel("force of a bridge over lateral stress times d^2")
    axes.set_ylabel("axial over lateral stress")
    axes.legend()
