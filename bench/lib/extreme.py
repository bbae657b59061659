# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Extreme scenes for Talus and for the stock styles, and what becomes of them."""

import math

import extreme_clumps
import extreme_sizes
import lammps
import verdict
from extreme_scene import NU, YOUNG, Ball, Extreme
from lammps import SECOND, STOCK, TALUS

COLUMNS = "id x y z vx vy vz omegax omegay omegaz fx fy fz tqx tqy tqz"
def talus_law(law, more="", limited=False):
    """more: words of the tangential law; limited: damping does not attract."""
    if law[0] == "material":
        _, young, e, nu, mu = law
        text, kt, gt, damped = f"hertz/material {young!r} {e!r} {nu!r}", "NULL", "NULL", e < 1
    else:
        kind, kn, gn, kt, gt, mu = law
        text, damped = f"{kind} {kn!r} {gn!r}", gn > 0
    return text + (f" tangential multistep {kt} {gt} {mu!r}{more}" if mu else "") + " limit_damping" * (limited and damped)


def granular_law(law):
    if law[0] == "material":
        _, young, e, nu, mu = law
        shear = f"mindlin NULL 1.0 {mu!r}" if mu else "linear_nohistory 0.0 0.0"
        return f"hertz/material {young!r} {e!r} {nu!r} tangential {shear} damping coeff_restitution"
    kind, kn, gn, kt, gt, mu = law
    shear = {"hooke": "linear_history", "hertz": "mindlin"}[kind]
    damping = {"hooke": "mass_velocity", "hertz": "viscoelastic"}[kind]
    words = f"{shear} {kt!r} {gt / gn if gn else 0.0!r} {mu!r}" if mu else "linear_nohistory 0.0 0.0"
    return f"{kind} {kn!r} {gn!r} tangential {words} damping {damping}"


def _physics(scene, code):
    text = ""
    if code != STOCK:
        second = code == SECOND
        words = talus_law(scene.law, " slider midpoint" if second else " midpoint" * scene.midpoint, second)
        pull = " order 2" * second + (f" gravity {scene.gravity!r} vector 0 0 -1" if scene.gravity else "")
        mover = "rigid/small/symplectic molecule" if scene.clumps else "nve/sphere/symplectic"
        text += f"pair_style gran/penalty\npair_coeff * * {words}\nfix move moving {mover}{pull}\n"
        for n, (axis, place, sign) in enumerate(scene.planes):
            point, normal = ([place if d == axis else 0 for d in range(3)], [sign if d == axis else 0 for d in range(3)])
            text += f"fix p{n} all large/body plane {' '.join(map(str, point + normal))} contact {words}\n"
        return text
    mover = "rigid/small molecule" if scene.clumps else "nve/sphere"
    text += f"pair_style granular\npair_coeff * * {granular_law(scene.law)}\nfix move moving {mover}\n"
    if scene.gravity:
        text += f"fix gravity all gravity {scene.gravity!r} vector 0 0 -1\n"
    for n, (axis, place, sign) in enumerate(scene.planes):
        ends = f"{place!r} NULL" if sign > 0 else f"NULL {place!r}"
        text += f"fix p{n} all wall/gran granular {granular_law(scene.law)} {'xyz'[axis]}plane {ends}\n"
    return text


def _head(scene, code):
    hold = "group fixed id " + " ".join(str(k + 1) for k in scene.fixed) + "\nfix hold fixed freeze\n" \
        "neigh_modify exclude group fixed fixed\n" if scene.fixed else ""
    moving = "group moving subtract all fixed\n" if scene.fixed else "group moving union all\n"
    return (f"units {scene.units}\natom_style sphere\natom_modify map array\nnewton off\n"
            f"comm_modify vel yes{' cutoff 3.0' * bool(scene.clumps)}\n"
            f"boundary {scene.periodic}\n" + _molecules(scene) + f"neighbor {scene.skin!r} bin\n"
            f"neigh_modify every 1 delay 0 check yes{' exclude molecule/intra all' * bool(scene.clumps)}\n" + hold.split("neigh_modify")[0].split("fix hold")[0] + moving
            + _physics(scene, code) + (hold[hold.index("fix hold"):] if hold else ""))


def _molecules(scene):
    if not scene.clumps:
        return "read_data data\n"
    return "fix prop all property/atom mol ghost yes\nread_data data fix prop NULL Molecules\n"


def write(scene, path):
    lammps.write_data(path, scene.box,
                      [(k + 1, 1, b.diameter, b.density, *b.x) for k, b in enumerate(scene.balls)],
                      [(k + 1, *b.v, *b.w) for k, b in enumerate(scene.balls)], molecules=scene.clumps)


def critical_step(bench, scene, folder):
    """The smallest critical time step of compute timestep/gran at the beginning."""
    script = _head(scene, TALUS) + """compute t all timestep/gran
thermo_style custom step c_t[1] c_t[2] c_t[3]
timestep 1e-30
run 0
print "RESULT $(c_t[1]:%.17g) $(c_t[2]:%.17g) $(c_t[3]:%.17g)"
"""
    found = lammps.run(folder, "critical", script).printed("RESULT")[0]
    return min(t for t in found if t > 0)


def run(bench, scene, code, folder, dt):
    """Outcome of a scene with one code."""
    write(scene, f"{folder}/data")
    every = max(1, scene.steps // scene.frames)
    script = (_head(scene, code) + f"thermo_style custom step atoms pe\nthermo {max(1, scene.steps // 20)}\nthermo_modify norm no lost warn flush no\n"
              f"timestep {dt!r}\ndump d all custom {every} frames.{code} {COLUMNS}\n"
              "dump_modify d format float %.17g sort id\n" + f"run {scene.steps}\n")
    result = lammps.run(folder, f"scene-{code}", script, code, check=False, timeout=bench.size(900, 60))
    frames = lammps.read_frames(f"{folder}/frames.{code}")
    if code != STOCK:
        for _, frame in frames:
            synchronise(scene, frame, dt)
    outcome = verdict.judge(frames, result, grains(scene))
    if scene.fixed:
        outcome.creep = 0.0
    return outcome, frames


def synchronise(scene, frame, dt):
    """Velocities of Talus to the time of the positions, by half a kick; its forces are without gravity."""
    for row, tag in enumerate(frame["id"]):
        k = int(tag) - 1
        if k in scene.fixed or scene.clumps:      # of clumps half a kick is little at the end
            continue
        ball = scene.balls[k]
        inertia = 0.1 * ball.mass() * ball.diameter**2
        for axis in "xyz":
            pull = scene.gravity if axis == "z" else 0.0
            frame["v" + axis][row] += 0.5 * dt * (frame["f" + axis][row] / ball.mass() - pull)
            frame["omega" + axis][row] += 0.5 * dt * frame["tq" + axis][row] / inertia


def grains(scene):
    period = tuple(hi - lo if word == "p" else None for (lo, hi), word in zip(scene.box, scene.periodic.split()))
    return verdict.Grains("hertz" if scene.hertz() else "hooke", scene.stiffness(),
                          [b.diameter / 2 for b in scene.balls],
                          [0.0 if k in scene.fixed else b.mass() for k, b in enumerate(scene.balls)],
                          scene.gravity, scene.planes, period, scene.clumps)


# ---- the list ---------------------------------------------------------------------------------

FREE = ((-20.0, 20.0),) * 3
WIDE = ((-30.0, 30.0), (-5.0, 5.0), (-5.0, 5.0))


def impact(name, law, normal=1.0, across=0.0, second=None, **more):
    """Two spheres meet; second: diameter and density of the one at the right, which is at rest if heavy."""
    diameter, density = second or (1.0, 1000.0)
    gap = 0.01 * min(1.0, diameter)
    share = 1 / (1 + (density * diameter**3) / 1000.0)      # center of mass at rest
    right = Ball((0.5 * diameter + gap / 2, 0, 0), (-normal * share, -across * share, 0), diameter=diameter, density=density)
    left = Ball((-0.5 - gap / 2, 0, 0), (normal * (1 - share), across * (1 - share), 0))
    options = {"steps": 100, "box": WIDE, "skin": 0.1 * min(1.0, diameter), **more}
    return Extreme(name, [left, right], law, **options)


def speed_for(depth):
    """Elastic Hertz impact of two equal spheres whose overlap reaches depth times the radius."""
    e_eff, r_eff, m_eff = YOUNG / (2 * (1 - NU**2)), 0.25, 1000 * math.pi / 12
    return math.sqrt((depth * 0.5)**2.5 * 16 * e_eff * math.sqrt(r_eff) / (15 * m_eff))


def units(factor):
    """The impact with lengths, masses and times multiplied by `factor`: E goes with 1/factor^2."""
    law = ("material", YOUNG / factor**2, 0.8, NU, 0.3)
    scene = impact(f"units times {factor:.0e}", law, 1.0, 0.5, units="lj")
    for b in scene.balls:
        b.x = tuple(c * factor for c in b.x)
        b.w = tuple(c / factor for c in b.w)
        b.diameter *= factor
        b.density /= factor**2
    scene.box = tuple((a * factor, b * factor) for a, b in scene.box)
    scene.skin *= factor
    return scene


def column(count):
    return Extreme(f"column of {count}", [Ball((0, 0, k + 0.5)) for k in range(count)], ("hertz", 1e10, 2e4, 0.0, 0.0, 0.0),
                   steps=20000, box=((-5, 5), (-5, 5), (-1.0, count + 5.0)), gravity=10.0, planes=((2, 0.0, 1),), frames=40)


def small_among_large():
    """Two fixed spheres of .01 and one of .0005 in the gap below them (Vyas et al. 2025)."""
    balls = [Ball((0, 0, 0), diameter=0.01, density=2500.0), Ball((0.01, 0, 0), diameter=0.01, density=2500.0),
             Ball((0.005, 2.79374817e-5, 1.60053725e-3), diameter=5e-4, density=2500.0)]
    return Extreme("size ratio 20, wedged", balls, ("hooke", 1e4, 1.1e5, 8235.0, 5.5e4, 0.5), steps=300000, dt=1e-6,
                   box=((-0.02, 0.03),) * 3, gravity=9.81, fixed=(0, 1), skin=1e-4, frames=300)


def pile(steps):
    """20 spheres heaped on a floor between walls, at rest: what moves in a very long time."""
    balls = [Ball(((k % 3) + 0.51, (k // 3 % 3) + 0.51, 0.5 + 1.01 * (k // 9)), diameter=0.95 + 0.005 * (k % 10))
             for k in range(20)]
    walls = ((2, 0.0, 1), (0, 0.0, 1), (0, 3.02, -1), (1, 0.0, 1), (1, 3.02, -1))
    return Extreme(f"rest of {steps:.0e} steps", balls, ("hertz", 1e8, 2e3, 2.857e7, 1e3, 0.5), steps=steps,
                   box=((-1, 5), (-1, 5), (-1, 6)), gravity=10.0, planes=walls, frames=200, creep=True)


def resting_grid(gravity):
    """27 spheres that just touch, at rest, no gravity."""
    balls = [Ball((k % 3 * 0.9999, k // 3 % 3 * 0.9999, k // 9 * 0.9999)) for k in range(27)]
    return Extreme("zero gravity, at rest", balls, ("material", YOUNG, 0.5, NU, 0.5), steps=20000, box=FREE, gravity=gravity)


def scenes(quick):
    elastic = ("material", YOUNG, 1.0, NU, 0.0)
    lossy = ("material", YOUNG, 0.8, NU, 0.5)
    found = [impact(f"size ratio {n}", lossy, 1.0, 0.5, (1.0 / n, 1000.0)) for n in (10, 100)]
    found += [small_among_large()]
    found += [impact(f"mass ratio {n:.0e}", lossy, 1.0, 0.5, (1.0, 1000.0 * n)) for n in (1e3, 1e6)]
    found += [impact(f"impact to overlap {d} r", elastic, speed_for(d)) for d in (0.05, 0.2, 0.5, 1.0, 1.5)]
    found += [impact("impact, passes through", elastic, 2 * speed_for(2.0))]
    found += [Extreme(f"initial overlap {d} r", [Ball((0, 0, 0)), Ball((1 - d / 2, 0, 0))], elastic, 100, WIDE)
              for d in (0.05, 0.5)]
    found += [impact(f"e = {e}, mu = {mu:g}", ("material", YOUNG, e, NU, mu), 1.0, 1.0)
              for e in (0.0, 0.1, 1.0) for mu in (0.0, 1e3)]
    found += [impact("e = 1.0, mu = 1000, midpoint", ("material", YOUNG, 1.0, NU, 1e3), 1.0, 1.0, midpoint=True)]
    found += [impact("e = 1.0, mu = 1000, dt .05 critical", ("material", YOUNG, 1.0, NU, 1e3), 1.0, 1.0, fraction=0.05,
                     steps=400)]
    found += [units(10.0**n) for n in (-12, -6, 6, 12)]
    found += [column(100 if quick else 1000)]
    found += [Extreme("squeezed between bodies", [Ball((0, 0, 0.475), (0.3, 0, 0), (0, 2.0, 0))], lossy, 20000, FREE,
                      planes=((2, 0.0, 1), (2, 0.95, -1)))]
    found += [resting_grid(0.0), pile(100000 if quick else 10000000)]
    found += [impact("dt 2 critical, impact", elastic, fraction=2.0, steps=20),
              impact("dt 6 critical, impact", elastic, fraction=6.0, steps=6)]
    unstable = pile(20000)
    unstable.name, unstable.fraction, unstable.creep = "dt 1.5 critical, pile", 1.5, False
    return found + [unstable] + extreme_sizes.scenes(quick) + extreme_clumps.scenes(quick)
