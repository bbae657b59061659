# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Grains in a fluid that a partner computes."""

import json
import math
import os
import subprocess
import sys

import machine
import problems

TITLE = "Grains in a fluid"
QUESTION = """What a fluid does to grains, by the named laws of [coupling](../coupling_fluid.md). One grain sinks in water, from creeping flow to
Newton's range. Many grains sink in a closed vessel: slower by the power n of the porosity, n = 4.65 for terminal Reynolds numbers below 0.2,
4.35 Re^-0.03 to 1, 4.45 Re^-0.1 to 500, 2.39 above (Richardson, Zaki, Trans. Inst. Chem. Eng. 32, 35, 1954). A gas slows down among heavy
grains in a closed box, exponentially with the drag of Stokes, and the momentum of both stays."""

SIZES = (5e-6, 2e-5, 5e-5, 2e-4, 1e-3, 5e-3, 2e-2, 5e-2)       # m; Reynolds numbers 1e-4 to 1e5
HINDERED = ((5e-5, "0.1"), (3e-4, "10"), (1e-3, "200"), (1e-2, "10^4"))
SOLIDS = (0.05, 0.1, 0.2, 0.3, 0.4)
INTERVALS = (1, 2, 5, 10, 20, 50, 100)


def environment():
    """In which programs find LAMMPS, its Python module, and Talus."""
    host = os.path.dirname(os.path.realpath(machine.STOCK_LMP))
    sources = [os.environ[name] for name in ("TALUS_BENCH_SOURCE", "TALUS_LAMMPS_SOURCE") if name in os.environ]
    modules = [os.path.join(folder, "python") for source in sources for folder in (source, os.path.dirname(source.rstrip("/")))]
    paths = {"PYTHONPATH": [path for path in modules if os.path.isdir(os.path.join(path, "lammps"))],
             "LD_LIBRARY_PATH": [host], "LAMMPS_PLUGIN_PATH": [machine.BUILD]}
    return {**os.environ, **{name: ":".join([*folders, os.environ.get(name, "")]) for name, folders in paths.items()},
            "OMP_NUM_THREADS": "1", "OMPI_MCA_ess_singleton_isolated": "1"}


def python(words, cores):
    done = subprocess.run(["taskset", "-c", ",".join(map(str, cores)), sys.executable, *map(str, words)], env=environment(),
                          capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL, timeout=problems.LIMIT)
    if done.returncode:
        raise RuntimeError(f"{' '.join(map(str, words))}: {(done.stdout + done.stderr)[-2000:]}")
    return done.stdout


def case(*words):
    program = os.path.join(machine.ROOT, "validate", "fluid_cases.py")
    return lambda cores: json.loads(python([program, *words], cores))


# ---- single grains, many grains

def settle(bench):
    sizes = bench.size(SIZES, (SIZES[0], SIZES[4], SIZES[-1]))
    rows = problems.at_once([case("settle", d, 900) for d in sizes])
    bench.section.heading("One grain")
    for d, (found, terminal, reynolds) in zip(sizes, rows):
        bench.section.record(part="settling", diameter=d, reynolds=reynolds, found=found, expected=terminal)
    bench.section.result("terminal velocities: largest distance from the balance of forces", max(abs(f / v - 1) for f, v, _ in rows), 0.0, 1e-6)
    bench.section.result("decades of the Reynolds number", math.log10(rows[-1][2] / rows[0][2]), 6.0, 12.0)
    bench.section.table(["d, mm", "Re", "m/s", "expected"], [[1e3 * d, r, f, v] for d, (f, v, r) in zip(sizes, rows)])
    bench.section.text("In water at rest, law `schiller/naumann`, of density 2500 kg/m^3, after 900 exchanges of 20 steps.")
    return rows


def richardson_zaki(reynolds):
    if reynolds < 0.2:
        return 4.65
    if reynolds < 1.0:
        return 4.35 * reynolds**-0.03
    return 4.45 * reynolds**-0.1 if reynolds < 500.0 else 2.39


def exponent(points):
    """Slope of lg(v/v_t) over lg(porosity), through 0."""
    logs = [(math.log(1.0 - solid), math.log(share)) for share, solid, _ in points]
    return sum(a * b for a, b in logs) / sum(a * a for a, _ in logs)


def hinder(bench):
    solids, sizes = bench.size((SOLIDS, HINDERED), ((0.1, 0.3), HINDERED[::3]))
    points = problems.at_once([case("hinder", d, solid) for d, _ in sizes for solid in solids])
    bench.section.heading("Hindered settling")
    rows = []
    for k, (d, _) in enumerate(sizes):
        mine = points[k * len(solids):(k + 1) * len(solids)]
        reynolds = mine[0][2]
        n, expected = exponent(mine), richardson_zaki(reynolds)
        rows.append([1e3 * d, reynolds, n, expected])
        for share, solid, _ in mine:
            bench.section.record(part="hindered", diameter=d, reynolds=reynolds, solid=solid, found=share, expected=(1 - solid)**expected)
        bench.section.result(f"n at Re = {reynolds:.3g}, over that of Richardson and Zaki", n / expected, 0.85, 1.15)
    bench.section.table(["d, mm", "Re", "n", "Richardson and Zaki"], rows)
    bench.section.text("""Law `wen/yu`, pressure gradient given; without walls, the volume of water going up that grains leave. Wen and Yu have
one power of the porosity for all Reynolds numbers, which is too high between the limits.""")
    return points, solids


# ---- exchange of momentum

def decay(bench):
    rows = problems.at_once([case("decay", every) for every in INTERVALS])
    bench.section.heading("Slip in a closed box, and how often to exchange")
    for every, (found, exact, momentum, part) in zip(INTERVALS, rows):
        bench.section.record(part="slip", every=every, found=found, expected=exact, momentum=momentum, interval=part)
    bench.section.result("momentum of grains and gas, largest change over the first one", max(abs(row[2]) for row in rows), 0.0, 1e-12)
    bench.section.result("slip after one decay time, exchange in each step, error", abs(rows[0][0] / rows[0][1] - 1), 0.0, 2e-3)
    errors = [abs(row[0] / row[1] - 1) for row in rows]
    order = math.log(errors[-1] / errors[2]) / math.log(INTERVALS[-1] / INTERVALS[2])
    bench.section.result("order of the error in the interval", order, 0.9, 1.2)
    bench.section.table(["steps between exchanges", "over the decay time", "slip", "exact", "error"],
                        [[every, row[3], row[0], row[1], error] for every, row, error in zip(INTERVALS, rows, errors)])
    bench.section.text("""512 grains of 0.1 mm and 2500 kg/m^3 in gas of 1.2 kg/m^3, the gas explicit: drag of an interval is that of the velocity at
its beginning. A fluid that takes the coefficients of put() implicitly is stable with any interval.""")


def measure(bench):
    singles = settle(bench)
    points, solids = hinder(bench)
    decay(bench)
    bench.section.plot("", "Terminal velocities, and hindered settling with the powers of Richardson and Zaki",
                       lambda plt: draw(plt, points, solids, singles))


def draw(plt, points, solids, singles):
    import plot
    _, (left, middle) = plt.subplots(1, 2, figsize=(9, 3.5))
    left.loglog([r for _, _, r in singles], [f for f, _, _ in singles], **plot.style(0, linestyle="none"))
    left.loglog([r for _, _, r in singles], [v for _, v, _ in singles], **plot.style(0, marker=None))
    left.set_xlabel("Reynolds number")
    left.set_ylabel("terminal velocity, m/s")
    for k in range(len(points) // len(solids)):
        mine = points[k * len(solids):(k + 1) * len(solids)]
        middle.plot([s for _, s, _ in mine], [v for v, _, _ in mine], **plot.style(k, linestyle="none"), label=f"Re {mine[0][2]:.2g}")
        line = [0.45 * j / 50 for j in range(51)]
        middle.plot(line, [(1 - s)**richardson_zaki(mine[0][2]) for s in line], **plot.style(k, marker=None))
    middle.set_xlabel("solid fraction")
    middle.set_ylabel("velocity over that of a single grain")
    middle.legend()
