# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""fix nve/sphere/symplectic: order, stability, conservation, restart, gravity, orientation."""

import math
import unittest

from talus_testing import SceneCase, Sphere, max_difference, read_dump, thermo, write_sphere_data

MASS = math.pi / 6    # diameter 1, density 1
BITS = "id x y z vx vy vz omegax omegay omegaz"

HEAD = """
units si
dimension {dimension}
boundary {boundary}
atom_style sphere
atom_modify map yes sort 0 0
comm_modify vel yes
newton off
read_data {data}
"""


def scene(data, more="", dimension=3, boundary=None):
    boundary = boundary or {3: "f f f", 2: "f f p"}[dimension]
    return HEAD.format(data=data, dimension=dimension, boundary=boundary) + more


def contact(law, kn, gn=0.0):
    return f"pair_style gran/penalty\npair_coeff * * {law} {kn!r} {gn!r}\n"


def dump(name, columns=BITS, every=1):
    return (f"dump d all custom {every} {name} {columns}\n"
            'dump_modify d format float %.17g sort id\n')


def results(log, word="RESULT"):
    """Numbers of the lines that a script printed as: RESULT number number ..."""
    return [list(map(float, line.split()[1:])) for line in log.splitlines()
            if line.startswith(word + " ")]


# ---- one sphere held by gravity on a frozen one: an oscillator of frequency 1 ------------------

KN, DEPTH = MASS, 0.1       # hooke: omega = 1; static overlap
GRAVITY = DEPTH * KN / MASS


def write_stack(path, overlap):
    write_sphere_data(path, ((-2, 2), (-2, 2), (-2, 3)),
                      [Sphere((0, 0, 0)), Sphere((0, 0, 1 - overlap))])


def stack(data, law, start, dt, gravity=GRAVITY):
    return scene(data, f"""
{law}group base id 1
group top id 2
fix hold base freeze
fix step all nve/sphere/symplectic start {start} gravity {gravity!r} vector 0 0 -1
timestep {dt}
thermo 1000000
""")


def reference(acceleration, x, v, time, steps=4000):
    """x, v after a time by the classical Runge-Kutta method, errors of about 1e-12."""
    h = time / steps
    for _ in range(steps):
        k1, l1 = v, acceleration(x)
        k2, l2 = v + h / 2 * l1, acceleration(x + h / 2 * k1)
        k3, l3 = v + h / 2 * l2, acceleration(x + h / 2 * k2)
        k4, l4 = v + h * l3, acceleration(x + h * k3)
        x, v = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), v + h / 6 * (l1 + 2 * l2 + 2 * l3 + l4)
    return x, v


class Order(SceneCase):
    """Sphere released from rest off its equilibrium, always in contact: a smooth force."""

    TIME = 9.0                      # one period and a half, not near an extreme
    STEPS = (200, 400, 800, 1600)
    LAWS = {    # name: (stiffness, acceleration as a function of the height)
        "hooke": (KN, lambda z: KN * (1 - z) / MASS - GRAVITY),
        "hertz": (9 * MASS, lambda z: 9 * math.sqrt((1 - z) / 4) * (1 - z) - GRAVITY),
    }
    PRINT = """variable z equal z[2]
variable v equal vz[2]
variable zz format z %.17g
variable vv format v %.17g
print "RESULT ${zz} ${vv}"
"""

    def final_states(self, law, start, schedule):
        """(height, velocity) for every number of steps; schedule gives [(dt, steps)]."""
        kn, _ = self.LAWS[law]
        write_stack(self.path("data"), 1.3 * DEPTH)
        script = ""
        for n in self.STEPS:
            script += "clear\n" + stack("data", contact(law, kn), start, 1.0)
            for dt, steps in schedule(n):
                script += f"timestep {dt!r}\nrun {steps}\n"
            script += self.PRINT
        return results(self.run_lammps(script).log)

    def assert_order(self, errors, order, what):
        for coarse, fine in zip(errors, errors[1:]):
            measured = math.log2(coarse / fine)
            self.assertAlmostEqual(measured, order, delta=0.1, msg=f"{what}: errors {errors}")

    def test_order_of_both_starts(self):
        for law, (_, acceleration) in self.LAWS.items():
            exact, _ = reference(acceleration, 1 - 1.3 * DEPTH, 0.0, self.TIME)
            for start, order in (("plain", 1), ("half", 2)):
                final = self.final_states(law, start, lambda n: [(self.TIME / n, n)])
                self.assert_order([abs(z - exact) for z, _ in final], order, f"{law} {start}")

    def test_velocity_of_start_half_belongs_to_the_half_step(self):
        _, acceleration = self.LAWS["hertz"]
        final = self.final_states("hertz", "half", lambda n: [(self.TIME / n, n)])
        errors = []
        for n, (_, v) in zip(self.STEPS, final):
            time = self.TIME * (1 - 0.5 / n)
            errors.append(abs(v - reference(acceleration, 1 - 1.3 * DEPTH, 0.0, time)[1]))
        self.assert_order(errors, 2, "velocity")

    def test_change_of_time_step_keeps_second_order(self):
        _, acceleration = self.LAWS["hertz"]
        exact, _ = reference(acceleration, 1 - 1.3 * DEPTH, 0.0, self.TIME)

        def schedule(n):
            return [(0.4 * self.TIME / n, n), (0.15 * self.TIME / n, 4 * n)]
        errors = [abs(z - exact) for z, _ in self.final_states("hertz", "half", schedule)]
        self.assert_order(errors, 2, "two time steps")


class Stability(SceneCase):
    """Largest time step by bisection: h = omega dt < 2 (sqrt(1+z^2) - z)."""

    STEPS = 20000
    GROWTH = 1e4        # stable motion near the limit grows 100-fold at most, then stops
    BISECTION = """
variable low string {low!r}
variable high string {high!r}
variable k loop {halvings}
label again
variable h equal 0.5*(v_low+v_high)
variable here string ${{h}}
clear
{stack}
variable growth equal abs(z[2]-{rest!r})/{perturbation!r}
variable unstable equal v_growth>{growth}
fix stop all halt 1 v_growth > {growth} error continue message no
run {steps}
if "${{unstable}}" then "variable high string ${{here}}" else "variable low string ${{here}}"
next k
jump SELF again
print "RESULT ${{low}} ${{high}}"
"""

    def limit(self, zeta, start):
        perturbation = 1e-6 * DEPTH
        write_stack(self.path("data"), DEPTH + perturbation)
        script = self.BISECTION.format(
            low=0.5, high=3.0, halvings=15, steps=self.STEPS, growth=self.GROWTH,
            rest=1 - DEPTH, perturbation=perturbation,
            stack=stack("data", contact("hooke", KN, 2 * zeta), start, "${here}"))
        (low, high), = results(self.run_lammps(script).log)
        return 0.5 * (low + high)

    def test_limit(self):
        for zeta in 0.0, 0.1, 0.3, 0.7:
            for start in "plain", "half":
                expected = 2 * (math.sqrt(1 + zeta**2) - zeta)
                self.assertAlmostEqual(self.limit(zeta, start), expected, delta=1e-3,
                                       msg=f"zeta {zeta} start {start}")


# ---- conservation ------------------------------------------------------------------------------

def write_gas(path):
    """27 spheres of unequal size and mass on collision course, far from the walls of the box."""
    spheres = []
    for i in range(27):
        x = [1.05 * (i // 3**d % 3) - 1.0 for d in range(3)]
        spheres.append(Sphere(x, v=[-x[0] + 0.1 * math.sin(7 * i), -x[1] + 0.1 * math.cos(5 * i),
                                    -x[2] + 0.1 * math.sin(3 * i)],
                              omega=(math.sin(i), math.cos(i), 1), diameter=1 - 0.01 * (i % 7),
                              density=1 + 0.1 * (i % 5)))
    write_sphere_data(path, ((-8, 8),) * 3, spheres)


class Conservation(SceneCase):

    def test_momentum_of_a_free_system(self):
        write_gas(self.path("data"))
        for ranks in 1, 2:
            self.run_lammps(scene("data", contact("hooke", 2000.0, 3.0)
                                  + "fix step all nve/sphere/symplectic\ntimestep 1e-3\n"
                                  + dump("out", "id mass vx vy vz", every=500) + "run 1000\n"),
                            np=ranks)
            first, *_, last = read_dump(self.path("out"))
            mass = first.column("mass")
            moved = max_difference(first, last, ("vx", "vy", "vz"))
            self.assertGreater(moved, 0.5)      # they did collide
            for axis in "vx", "vy", "vz":
                was, now = first.column(axis), last.column(axis)
                scale = sum(mass[i] * abs(was[i]) for i in mass)
                change = math.fsum(mass[i] * (now[i] - was[i]) for i in mass)
                self.assertLess(abs(change), 1e-13 * scale, f"{axis}, {ranks} ranks")

    def test_free_sphere_keeps_velocity_and_spin(self):
        write_sphere_data(self.path("data"), ((-9, 9),) * 3,
                          [Sphere((0, 0, 0), v=(0.1, 0.2, 0.3), omega=(1.1, -2.2, 3.3))])
        self.run_lammps(scene("data", "pair_style none\ncomm_modify cutoff 2\n"
                              "fix step all nve/sphere/symplectic start half\ntimestep 1e-3\n"
                              + dump("out", every=1000) + "run 1000\n"))
        first, last = read_dump(self.path("out"))
        self.assert_same_bits(first, last, BITS.split()[4:])

    def test_particles_outside_the_group_are_not_touched(self):
        write_sphere_data(self.path("data"), ((-9, 9),) * 3,
                          [Sphere((0, 0, k), v=(1, 2, 3), omega=(4, 5, 6)) for k in range(4)])
        more = ("pair_style none\ncomm_modify cutoff 2\ngroup some id 2 4\n{first}"
                "fix step some nve/sphere/symplectic gravity 1 vector 1 1 1\n" + dump("out")
                + "run 3\n")
        last = []
        for first in "", "atom_modify first some\n":
            self.run_lammps(scene("data", more.format(first=first)))
            frames = read_dump(self.path("out"))
            last.append(frames[-1])
            for tag in 1, 3:
                self.assertEqual(frames[0].atoms[tag], frames[-1].atoms[tag])
            for tag in 2, 4:
                self.assertNotEqual(frames[0].atoms[tag], frames[-1].atoms[tag])
        self.assert_same_bits(*last)


class Disc(SceneCase):

    def test_moment_of_inertia(self):
        """One step from a sliding contact: a disc gains 4/5 of the spin of a sphere."""
        write_sphere_data(self.path("data"), ((-3, 3), (-3, 3), (-0.5, 0.5)),
                          [Sphere((0, 0, 0), v=(0, 1, 0)), Sphere((0.99, 0, 0), v=(0, -1, 0))])
        spin = {}
        for word in "", "disc":
            self.run_lammps(scene("data", "pair_style gran/hooke 1000.0 NULL 10.0 NULL 0.5 1\n"
                                  f"pair_coeff * *\nfix step all nve/sphere/symplectic {word}\n"
                                  "fix flat all enforce2d\ntimestep 1e-3\n" + dump("out")
                                  + "run 1\n", dimension=2))
            spin[word] = read_dump(self.path("out"))[-1].column("omegaz")[1]
        self.assertNotEqual(spin[""], 0.0)
        self.assert_close(spin["disc"] / spin[""], 0.8, 1e-14)


# ---- one trajectory ----------------------------------------------------------------------------

class Restart(SceneCase):
    """A run, the run in two parts, and the run continued from a restart file: the same bits."""

    PAIR = contact("hooke", 2000.0, 30.0)
    STEP = "fix {id} all nve/sphere/symplectic start {start} gravity 9.81 chute 20\ntimestep 1e-3\n"

    def script(self, start, id="step"):
        return (scene("data", self.PAIR) + self.STEP.format(start=start, id=id)
                + dump("out", every=100))

    def last(self, script, **options):
        self.run_lammps(script, **options)
        return read_dump(self.path("out"))[-1]

    def continued(self, start, id="step"):
        return ("atom_style sphere\natom_modify map yes sort 0 0\ncomm_modify vel yes\nnewton off\n"
                "read_restart middle\n" + self.PAIR + self.STEP.format(start=start, id=id)
                + dump("out", every=100) + "run 63\n")

    def test_same_bits(self):
        write_gas(self.path("data"))
        for start in "plain", "half":
            once = self.last(self.script(start) + "run 100\n")
            parts = self.last(self.script(start) + "run 1\nrun 36\nrun 0\nrun 63\n")
            self.assert_same_bits(once, parts)
            self.assert_same_bits(once, self.last(self.script(start) + "run 100\n",
                                                  np=2, env={"OMP_NUM_THREADS": 3}))
            self.run_lammps(self.script(start) + "run 37\nwrite_restart middle\n")
            self.assert_same_bits(once, self.last(self.continued(start)))
            self.assert_same_bits(once, self.last(self.script(start) + "run 37\n"
                                  "write_restart middle\nclear\n" + self.continued(start)))

    def test_lag_is_in_the_restart_file(self):
        """Under another fix ID the state is not found, and the half kick comes again."""
        write_gas(self.path("data"))
        once = self.last(self.script("half") + "run 100\n")
        self.run_lammps(self.script("half") + "run 37\nwrite_restart middle\n")
        other = self.last(self.continued("half", id="other"))
        self.assertGreater(max_difference(once, other, ("x", "y", "z")), 1e-6)

    def test_other_start_word(self):
        write_gas(self.path("data"))
        for wrote, reads in ("half", "plain"), ("plain", "half"):
            self.run_lammps(self.script(wrote) + "run 37\nwrite_restart middle\n")
            log = self.run_lammps(self.continued(reads)).log
            self.assertIn(f"start {reads}: the restart file was written with start {wrote}", log)


# ---- gravity -----------------------------------------------------------------------------------

class Gravity(SceneCase):

    STYLES = ("vector 1 -2 3", "vector 0 0 -0.001", "chute 26", "spherical 30 140",
              "spherical 0 90")

    def velocity(self, fixes, units, dimension):
        more = ("pair_style none\ncomm_modify cutoff 2\ntimestep 0.001\n" + fixes + dump("out")
                + "run 2\n")
        script = scene("data", more, dimension).replace("units si", f"units {units}")
        self.run_lammps(script)
        return read_dump(self.path("out"))[-1]

    def test_directions_are_those_of_fix_gravity(self):
        for dimension in 3, 2:
            depth = 9 if dimension == 3 else 0.5
            write_sphere_data(self.path("data"), ((-9, 9), (-9, 9), (-depth, depth)),
                              [Sphere((0, 0, 0), density=3.0), Sphere((3, 3, 0), diameter=0.7)])
            for style in self.STYLES:
                if dimension == 2 and style == "vector 0 0 -0.001":
                    continue
                for units in "si", "real":
                    ours = self.velocity("fix step all nve/sphere/symplectic "
                                         f"gravity 9.81 {style}\n", units, dimension)
                    stock = self.velocity(f"fix g all gravity 9.81 {style}\n"
                                          "fix step all nve/sphere/symplectic\n",
                                          units, dimension)
                    size = max(abs(value) for row in stock.atoms.values() for value in row[4:7])
                    self.assertLess(max_difference(ours, stock, ("vx", "vy", "vz")), 1e-14 * size,
                                    f"{style} {units} {dimension}d")

    def test_potential_energy(self):
        """KE + PE of a flight through a periodic boundary, v taken at the full step."""
        write_sphere_data(self.path("data"), ((-2, 2),) * 3,
                          [Sphere((0, 0, 1), v=(0.3, 0, 2)), Sphere((1, 1, 0), density=2.0),
                           Sphere((1, -1, -1), density=5.0)])
        more = """pair_style none
comm_modify cutoff 2
group base id 3
fix hold base freeze
fix step all nve/sphere/symplectic start half gravity 9.81 vector 0 0 -1
fix_modify step energy yes
timestep 1e-3
thermo 100
thermo_style custom step pe f_step
thermo_modify format float %.17g norm no
"""
        self.run_lammps(scene("data", more + dump("out", "id mass zu vx vy vz", every=100)
                              + "run 1000\n", boundary="p p p"))
        lines = thermo(self.read("log.script"))
        energies = []
        for line, frame in zip(lines, read_dump(self.path("out")), strict=True):
            mass, z, vx, vz = map(frame.column, ("mass", "zu", "vx", "vz"))
            potential = sum(mass[i] * 9.81 * z[i] for i in (1, 2))
            self.assert_close(line["f_step"], potential, 1e-13)
            self.assertEqual(line["PotEng"], line["f_step"])
            half = 0.5e-3 * -9.81 if frame.step else 0.0
            energies.append(line["f_step"] + sum(0.5 * mass[i] * (vx[i]**2 + (vz[i] + half)**2)
                                                 for i in (1, 2)))
        self.assertLess(min(line["f_step"] for line in lines), -30.0)    # they crossed the boundary
        for energy in energies:
            self.assert_close(energy, energies[0], 1e-12)

    def test_frozen_particles_do_not_fall(self):
        write_stack(self.path("data"), DEPTH)
        self.run_lammps(stack("data", contact("hooke", KN, 1.0), "plain", 0.1)
                        + dump("out", every=100) + "run 100\n")
        first, last = read_dump(self.path("out"))
        self.assertEqual(first.atoms[1], last.atoms[1])
        self.assert_close(last.column("z")[2], 1 - DEPTH, 1e-12)


# ---- orientation -------------------------------------------------------------------------------

def turned(vector, omega, time):
    """Rodrigues' formula."""
    speed = math.sqrt(sum(w * w for w in omega))
    a = [w / speed for w in omega]
    c, s = math.cos(speed * time), math.sin(speed * time)
    dot = sum(p * q for p, q in zip(a, vector))
    cross = [a[1] * vector[2] - a[2] * vector[1], a[2] * vector[0] - a[0] * vector[2],
             a[0] * vector[1] - a[1] * vector[0]]
    return [c * p + s * q + (1 - c) * dot * n for p, q, n in zip(vector, cross, a)]


class Orientation(SceneCase):

    OMEGA, STEPS, DT = (0.3, -0.4, 1.2), 1000, 0.01
    SCRIPT = """units si
atom_style {style}
comm_modify vel yes cutoff 2
newton off
region box block -2 2 -2 2 -2 2
create_box 1 box
create_atoms 1 single 0 0 0
set group all diameter 1 density 1 omega 0.3 -0.4 1.2
set group all {orient}
{compute}
pair_style none
fix step all nve/sphere/symplectic orientation {word}
timestep 0.01
"""

    def rows(self, style, orient, columns, word="yes", compute=""):
        self.run_lammps(self.SCRIPT.format(style=style, orient=orient, word=word, compute=compute)
                        + dump("out", "id " + columns, every=self.STEPS) + f"run {self.STEPS}\n")
        return [frame.atoms[1][1:] for frame in read_dump(self.path("out"))]

    def assert_vector(self, value, expected):
        for v, e in zip(value, expected, strict=True):
            self.assertAlmostEqual(v, e, delta=1e-12)

    def test_dipole(self):
        first, last = self.rows("hybrid sphere dipole", "dipole 1 2 -0.5", "mux muy muz mu")
        self.assert_vector(last, turned(first[:3], self.OMEGA, self.STEPS * self.DT) + [first[3]])

    def test_orientation_no(self):
        first, last = self.rows("hybrid sphere dipole", "dipole 1 2 -0.5", "mux muy muz", word="no")
        self.assertEqual(first, last)

    def test_quaternion(self):
        """An axis of the body frame, carried by the quaternion, turns about omega."""
        def x_axis(q):
            w, x, y, z = q
            return [w * w + x * x - y * y - z * z, 2 * (x * y + w * z), 2 * (x * z - w * y)]
        first, last = self.rows("bpm/sphere", "quat 1 2 3 50", "c_q[*]", compute="compute q all "
                                "property/atom quatw quati quatj quatk")
        self.assert_vector(x_axis(last), turned(x_axis(first), self.OMEGA, self.STEPS * self.DT))
        self.assertAlmostEqual(sum(c * c for c in last), 1.0, delta=1e-14)


if __name__ == "__main__":
    unittest.main()
