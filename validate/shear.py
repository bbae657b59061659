# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Simple shear of frictionless spheres."""

import math

import problems

TITLE = "Simple shear"
QUESTION = """In steady simple shear of smooth inelastic spheres the kinetic theory of gases gives pressure and shear stress: collisions take as
much energy as the shear stress feeds in (Lun, Savage, Jeffrey, Chepurniy, J. Fluid Mech. 140, 223, 1984). The theory takes the spheres
that meet for independent, and how many meet from the fluid of hard spheres, which ends at a solid fraction of 0.49."""

FRACTIONS = (0.1, 0.2, 0.3, 0.4, 0.5)
END_OF_FLUID = 0.49
RESTITUTION = 0.9
STIFFNESS = 4e5
BOUND = 0.1


def damping(restitution, stiffness):
    """Coefficient gn of hooke (1/time) of two spheres of diameter and density 1."""
    mass = math.pi / 12
    loss = -math.log(restitution)
    return 2 * loss / math.hypot(math.pi, loss) * math.sqrt(stiffness / mass)


def lun(fraction, restitution):
    """(pressure, shear stress, temperature) over rho d^2 rate^2: with viscosity m sqrt(T) and loss j T^(3/2), T = m/j."""
    eta, g0 = 0.5 * (1 + restitution), (1 - 0.5 * fraction) / (1 - fraction) ** 3
    dilute = 5 * math.sqrt(math.pi) / 96
    bulk = 256 / (5 * math.pi) * dilute * fraction**2 * g0
    viscosity = (dilute / (eta * (2 - eta) * g0) * (1 + 1.6 * eta * fraction * g0) * (1 + 1.6 * eta * (3 * eta - 2) * fraction * g0)
                 + 0.6 * eta * bulk)
    loss = 48 / math.sqrt(math.pi) * eta * (1 - eta) * fraction**2 * g0
    temperature = viscosity / loss
    return (fraction * temperature * (1 + 4 * eta * fraction * g0), viscosity * math.sqrt(temperature), temperature)


def shear(bench, fraction, cores):
    """(pressure, shear stress, temperature)."""
    variables = {"fraction": fraction, "stiffness": STIFFNESS, "damping": damping(RESTITUTION, STIFFNESS), "side": bench.size(10, 6),
                 "strain": bench.size(30, 10), "watch": bench.size(70, 15)}
    _, result = problems.run(bench, "shear", f"fraction-{fraction}", variables, cores)
    temperature, pressure, stress = result.printed("Mean")[0]
    bench.note(f"solid fraction {fraction}: p {pressure:.4g}, shear stress {stress:.4g}")
    return pressure, stress, temperature


def measure(bench):
    fractions = bench.size(FRACTIONS, (0.2, 0.4))
    found = problems.at_once([lambda cores, f=f: shear(bench, f, cores) for f in fractions])
    bound = bench.size(BOUND, 0.4)
    rows = []
    for fraction, (pressure, stress, temperature) in zip(fractions, found):
        theory = lun(fraction, RESTITUTION)
        rows.append([fraction, pressure, theory[0], stress, theory[1], temperature, theory[2]])
        bench.section.record(fraction=fraction, pressure=pressure, theory_pressure=theory[0], stress=stress, theory_stress=theory[1])
        if fraction > END_OF_FLUID:
            continue
        bench.section.result(f"pressure over that of theory, solid fraction {fraction}", pressure / theory[0], 1 - bound, 1 + bound)
        bench.section.result(f"shear stress over that of theory, solid fraction {fraction}", stress / theory[1], 1 - bound, 1 + bound)
    bench.section.table(["solid fraction", "p", "theory", "shear stress", "theory", "temperature", "theory"], rows)
    bench.section.text(f"""{bench.size(10, 6) ** 3} spheres, e = {RESTITUTION}, no friction, linear springs of {STIFFNESS:.0e} rho d^3 rate^2 (impacts are
short), Lees-Edwards boundaries by `fix deform ... remap v`; mean over a strain of {bench.size(70, 15)}. Stresses are over
rho d^2 rate^2, those of dense flows beyond the fluid are shown, not compared; temperatures (a third of the mean square of the speeds) over d^2 rate^2. Input script: `validate/in.shear`.""")
    bench.section.plot("", "Pressure (filled line) and shear stress over the solid fraction; lines: kinetic theory", lambda plt: draw(plt, fractions, found))


def draw(plt, fractions, found):
    import plot
    _, axes = plt.subplots(figsize=(5, 3.5))
    line = [0.08 + 0.005 * k for k in range(89)]
    for k, name in enumerate(("pressure", "shear stress")):
        axes.plot(fractions, [each[k] for each in found], **plot.style(k, linestyle="none"), label=name)
        axes.plot(line, [lun(f, RESTITUTION)[k] for f in line], **plot.style(k, marker=None))
    axes.set_yscale("log")
    axes.set_xlabel("solid fraction")
    axes.set_ylabel("over rho d^2 rate^2")
    axes.legend()
