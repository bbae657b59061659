# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Large bodies that move: belts, free bodies against particles of the same mass and inertia, pistons, Newton's third
law and the balance of energy."""

import math
import unittest

import body_balance
import body_meshes
from talus_testing import SceneCase, Sphere, begin, read_dump, thermo, write_sphere_data

SCENE = begin(read="read_data grains", law="{pair}", skin=0.2, dt="{dt}") + """
{commands}
thermo {thermo}
thermo_style custom step {columns}
thermo_modify norm no format float %.17g
run {steps}
write_dump all custom state id x y z vx vy vz omegax omegay omegaz modify format float %.17g
"""
BOX = ((-10, 10), (-10, 10), (-10, 10))
MASS = math.pi / 6.0    # of a sphere of diameter 1 and density 1
VECTOR = " ".join(f"f_body[{k}]" for k in range(1, 21))


class MotionCase(SceneCase):

    def simulate(self, particles, commands, steps, dt=1e-3, pair="hooke 1e4 0", columns=VECTOR,
                 every=None, np=1, **options):
        write_sphere_data(self.path("grains"), BOX, particles)
        log = self.run_lammps(SCENE.format(pair=pair, dt=dt, commands=commands, columns=columns,
                                           steps=steps, thermo=every or steps), np=np, **options).log
        self.frame, = read_dump(self.path("state"))
        self.log = log
        return thermo(log)

    def vector(self, row):
        return [row[f"f_body[{k}]"] for k in range(1, 21)]


class SurfaceVelocity(MotionCase):

    def test_belt(self):
        # friction acts until the surfaces no longer slip: v + 5/2 v = V for a full sphere
        for move, name in (("linear 3.5 0 0", "linear"), ("variable v_x NULL NULL v_v NULL NULL", "variable")):
            with self.subTest(name):
                self.simulate([Sphere((0, 0, 0.4995))], f"""
fix step all nve/sphere/symplectic gravity 9.81 vector 0 0 -1
variable v equal 3.5
variable x equal 3.5*step*0.0001
fix body all large/body plane 0 0 0  0 0 1 contact hooke 1e4 50 tangential multistep NULL NULL 0.3 move {move}
""", 15000, dt=1e-4)
                vx, wy = self.frame.column("vx")[1], self.frame.column("omegay")[1]
                print(f"belt ({name}): v = {vx:.6f} of 1, surface {0.5 * wy:.6f} of -2.5")
                self.assertAlmostEqual(vx, 1.0, delta=2e-3)
                self.assertAlmostEqual(0.5 * wy, -2.5, delta=2e-3)

    def test_damping_sees_the_wall_approach(self):
        # a wall that comes at speed 1 throws the sphere back as a sphere at speed 1 leaves a wall at rest
        law = "contact hooke 1e5 80"
        self.simulate([Sphere((0, 0, 0.6), v=(0, 0, -1.0))], f"""
fix step all nve/sphere/symplectic
fix body all large/body plane 0 0 0 0 0 1 {law}""", 3000, dt=1e-4)
        bounced = self.frame.column("vz")[1]
        self.simulate([Sphere((0, 0, 0.6))], f"""
fix step all nve/sphere/symplectic
fix body all large/body plane 0 0 0 0 0 1 {law} move linear 0 0 1""", 3000, dt=1e-4)
        self.assertLess(bounced, 0.9)
        self.assertAlmostEqual(self.frame.column("vz")[1] - 1.0, bounced, delta=1e-6)

    def test_riding_on_a_turntable(self):
        # rolling and sliding are those against the turning body: a sphere that moves with it feels no friction
        w, r = 0.7, 2.0
        rows = self.simulate([Sphere((r, 0, 0.499), v=(0, w * r, 0), omega=(0, 0, w))], f"""
fix step all nve/sphere/symplectic gravity 9.81 vector 0 0 -1
fix body all large/body plane 0 0 0  0 0 1 contact hooke 1e4 50 tangential multistep NULL NULL 0.9 &
    rolling 0.1 spinning 0.1 move rotate 0 0 0 0 0 1 {2 * math.pi / w}
""", 2)
        force, torque = self.vector(rows[0])[:2], self.vector(rows[0])[5]
        self.assertLess(max(map(abs, force)), 1e-12)
        self.assertLess(abs(torque), 1e-12)


class FreeBody(MotionCase):
    """A free ball against a frozen particle, and a particle of the same mass and radius against it."""

    @staticmethod
    def law(stiffer=1.0):
        """With the same restitution."""
        return f"hooke {1e6 * stiffer} {20 * stiffer**0.5} tangential multistep NULL NULL 0.3"

    FROZEN = Sphere((0, 0, 0), diameter=2.0, type=2)

    def ball(self, shape, steps, x, v, w, dt, stiffer=1.0):
        self.simulate([self.FROZEN], f"""
fix hold all freeze
fix body all large/body {shape} contact {self.law(stiffer)} move free mass {MASS!r} inertia {0.1 * MASS!r} {0.1 * MASS!r} &
    {0.1 * MASS!r} com {x[0]} {x[1]} {x[2]} velocity {v[0]} {v[1]} {v[2]} spin {w[0]} {w[1]} {w[2]} &
    gravity 9.81 vector 0 0 -1
""", steps, dt=dt, pair=self.law(stiffer), np=2)
        return self.vector(thermo(self.log)[-1])

    def particle(self, steps, x, v, w, dt, stiffer=1.0):
        self.simulate([Sphere(x, v=v, omega=w), self.FROZEN], """
group moves type 1
group base type 2
fix step moves nve/sphere/symplectic gravity 9.81 vector 0 0 -1
fix hold base freeze
compute body all reduce sum x
""", steps, dt=dt, pair=self.law(stiffer), columns="c_body")
        return [self.frame.column(k)[1] for k in
                "x y z vx vy vz omegax omegay omegaz".split()]

    def test_falls(self):
        x, v, w = (3, 1, 8), (0.2, -0.1, 0.5), (1, 2, 3)
        body = self.ball("sphere 3 1 8 0.5 outside", 2000, x, v, w, 1e-4)
        expected = self.particle(2000, x, v, w, 1e-4)
        found = body[6:9] + body[13:19]
        self.assertLess(max(abs(a - b) for a, b in zip(found, expected)), 1e-12)

    def test_bounces_slides_and_spins(self):
        """Friction acts on the body at the end of the particle's radius, so that both balance, but on a particle in its
        place at the end of its own radius: they differ by the overlap over the radius, so less in stiffer contacts."""
        x, v, w = (0.4, 0.1, 1.6), (1.0, 0.2, -3.0), (2, -5, 4)
        body_meshes.write_stl(self.path("ball.stl"), body_meshes.sphere(x, 0.5, 60))
        ball, worst = "sphere 0.4 0.1 1.6 0.5 outside", []
        for shape, stiffer, limit in ((ball, 1, 4e-3), (ball, 16, 1e-3), ("mesh ball.stl", 1, 4e-2)):
            faster = round(stiffer**0.5)
            steps, dt = 4000 * faster, 2e-5 / faster
            expected = self.particle(steps, x, v, w, dt, stiffer)
            body = self.ball(shape, steps, x, v, w, dt, stiffer)
            found = body[6:9] + body[13:19]
            scale = [1.0] * 3 + [3.0] * 3 + [10.0] * 3
            worst.append(max(abs(a - b) / s for a, b, s in zip(found, expected, scale)))
            print(f"{shape}, {stiffer} times as stiff: v {found[3:6]} against {expected[3:6]}, worst {worst[-1]:.1e}")
            self.assertGreater(found[5], 0.5, "it bounces")
            self.assertGreater(math.dist(found[6:9], w), 0.5, "its spin changes")
            self.assertLess(worst[-1], limit)
        self.assertLess(worst[1], 0.4 * worst[0])

    def test_locked(self):
        rows = self.simulate([Sphere((0, 0, 0))], f"""
fix hold all freeze
fix body all large/body box 0 0 1.0 2 2 1.02 outside contact hooke 1e4 10 move free mass 2 inertia 1 1 1 &
    lock x y z rx ry gravity 9.81 vector 0 0 -1 load 0 0 0 0 0 0.5
""", 1000)
        last = self.vector(rows[-1])
        self.assertEqual(last[6:9], [0, 0, 1.0])
        self.assertAlmostEqual(last[18], 0.5, delta=1e-12)    # spin = torque t / I
        self.assertEqual(last[16:18], [0, 0])


def pile(n, start, spacing=1.05, **options):
    return [Sphere(tuple(s + spacing * k for s, k in zip(start, (i, j, l))), **options)
            for l in range(n[2]) for j in range(n[1]) for i in range(n[0])]


class Piston(MotionCase):

    def test_reaches_the_set_force(self):
        rows = self.simulate(pile((4, 4, 4), (-1.55, -1.55, -1.5), 1.04), """
fix step all nve/sphere/symplectic gravity 1.0 vector 0 0 -1
fix drag all viscous 0.3
fix case all large/body box 0 0 3 4.2 4.2 10 inside contact hooke 1e4 20 tangential multistep NULL NULL 0.3
fix body all large/body rectangle 0 0 4 0 0 -1 1 0 0 4 4 contact hooke 1e4 20 servo force 0 0 -1 200 0.2
fix mean all ave/time 1 2000 2000 f_body[3] mode scalar
""", 16000, dt=1e-3, pair="hooke 1e4 20 tangential multistep NULL NULL 0.3",
                             columns=VECTOR + " f_mean f_case[3]", every=2000)
        last = rows[-1]
        print(f"piston: mean force {last['f_mean']:.3f} of 200, speed {last['f_body[16]']:.1e}, "
              f"case carries {-last['f_case[3]']:.2f} of {200 + 64 * MASS:.2f}")
        self.assertAlmostEqual(last["f_mean"], 200.0, delta=1.0)
        self.assertLess(abs(last["f_body[16]"]), 1e-2)
        self.assertAlmostEqual(-last["f_case[3]"], 200.0 + 64 * MASS, delta=3.0)

    def test_holds_it_against_any_damping(self):
        """A grain between a floor and a plate: beyond G = target / (vmax gain) the speed would flip in each step."""
        for order in "1", "2":
            for damping in 5, 300, 500, 3000:
                for vmax in 0.2, 2.0:
                    with self.subTest(order=order, damping=damping, vmax=vmax):
                        law = f"hooke 1e4 {damping} limit_damping"
                        rows = self.simulate([Sphere((0, 0, 0.5), diameter=1.0, density=1.0)], f"""
fix step all nve/sphere/symplectic order {order}
fix floor all large/body plane 0 0 0 0 0 1 contact {law}
fix body all large/body rectangle 0 0 1.05 0 0 -1 1 0 0 2 2 contact {law} servo force 0 0 -1 10 {vmax}
fix mean all ave/time 1 2000 4000 f_body[3] f_floor[3]
""", 16000, dt=2.5e-4, pair=law, columns=VECTOR + " f_mean[1] f_mean[2]", every=4000)
                        last = rows[-1]
                        self.assertAlmostEqual(last["f_mean[1]"], 10.0, delta=0.02)
                        self.assertAlmostEqual(last["f_mean[2]"], -10.0, delta=0.02)
                        self.assertAlmostEqual(last["f_body[16]"], 0.0, delta=1e-3)


    def test_follows_a_variable(self):
        """Within the time that the speed needs, target/(vmax k), 2 to 8 ms of a period of 1 s."""
        law = "hooke 1e4 20"
        for np in 1, 2:
            rows = self.simulate([Sphere((0, 0, 0.5), diameter=1.0, density=1.0)], f"""
variable aim equal 10*(1+0.5*sin(2*PI*step*dt))
fix step all nve/sphere/symplectic
fix floor all large/body plane 0 0 0 0 0 1 contact {law}
fix body all large/body rectangle 0 0 1.0 0 0 -1 1 0 0 2 2 contact {law} servo force 0 0 -1 v_aim 0.2
""", 8000, dt=2.5e-4, pair=law, columns=VECTOR + " v_aim", every=400, np=np)
            off = [abs(row["f_body[3]"] - row["v_aim"]) for row in rows if row["Step"] > 2000]
            print(f"servo: at most {max(off):.3f} away from a target of 5 to 15")
            self.assertGreater(len(off), 10)
            self.assertLess(max(off), 0.4)

    def test_variables_that_cannot_be_a_target(self):
        write_sphere_data(self.path("grains"), BOX, [Sphere((0, 0, 0.5))])
        for value, message in (("equal step-3", "servo: variable 'aim' is 0 in this step; the target must be a number that is not zero"),
                               ("atom x", "variable 'aim' is not an equal-style variable"), (None, "variable 'aim' does not exist")):
            commands = (f"variable aim {value}\n" if value else "") + (
                "fix body all large/body rectangle 0 0 1.0 0 0 -1 1 0 0 2 2 contact hooke 1e4 20 servo force 0 0 -1 v_aim 0.2")
            for np in 1, 2:
                log = self.run_lammps(SCENE.format(pair="hooke 1e4 20", dt=1e-3, commands=commands, columns="time", steps=10, thermo=10),
                                      np=np, expect_error=True).log
                self.assertIn(message, log.replace("\n", " "))


class Balance(MotionCase):

    def test_third_law(self):
        body_meshes.write_stl(self.path("vessel.stl"), body_meshes.box((-3, -3, -3), (3, 3, 4), 8, inward=True))
        body_meshes.write_stl(self.path("ball.stl"), body_meshes.sphere((1.3, 1.1, 2.3), 0.8, 8))
        friction = "contact hooke 1e4 20 tangential multistep NULL NULL 0.5 rolling 0.05 spinning 0.05"
        rows = self.simulate(pile((5, 5, 4), (-2.2, -2.2, -2.4), 1.02), f"""
fix step all nve/sphere/symplectic gravity 5.0 vector 0.3 0 -1
fix vessel all large/body mesh vessel.stl {friction} move wiggle 0.2 0 0.1 0.8
fix ball all large/body mesh ball.stl {friction} move free mass 2 inertia 0.5 0.6 0.7 spin 3 1 2 velocity 0 0 -4
fix blade all large/body cylinder -0.8 0 1.4 0 1 0 0.5 3 outside {friction} move rotate -0.8 0 1.2 0 1 0 1.1
""" + body_balance.script(["vessel", "ball", "blade"]), 300, columns=f"f_ball[20] f_blade[20] {body_balance.COLUMNS}",
                             every=1, np=2)
        worst = body_balance.worst(rows[20:])
        print(f"third law: worst sum {worst:.1e} of the forces; ball and blade touch "
              f"{rows[-1]['f_ball[20]']:.0f} and {rows[-1]['f_blade[20]']:.0f} particles")
        self.assertLess(worst, 1e-10)
        self.assertGreater(max(row["f_ball[20]"] for row in rows), 0)

    def test_energy(self):
        # free box with bouncing, sliding spheres: nothing gets lost but what the account says
        drift = []
        for dt in (4e-5, 2e-5):
            rows = self.simulate([Sphere((0.3, 0.2, -0.4), v=(2, 1, -1)), Sphere((-1, -1.2, 1), v=(0, -2, 3)),
                                  Sphere((1.2, -1, 1.1), v=(1, 0.5, 0), omega=(3, 2, 1))], """
fix step all nve/sphere/symplectic
fix body all large/body box 0 0 0 4 4 4 inside contact hertz 1e5 100 tangential multistep NULL NULL 0.3 &
    move free mass 5 inertia 6 7 8 spin 0.2 0.1 0
fix_modify body energy yes
compute spin all erotate/sphere
variable total equal pe+ke+c_spin
""", int(0.8 / dt), dt=dt, pair="hooke 1e4 0", columns="pe ke v_total f_body f_body[20]",
                                 every=int(0.01 / dt))
            self.assertGreater(max(row["f_body[20]"] for row in rows), 0)
            first = rows[0]["v_total"]
            drift.append(max(abs(row["v_total"] / first - 1.0) for row in rows))
            lost = rows[0]["KinEng"] - rows[-1]["KinEng"]
        print(f"energy: drifts {drift[0]:.1e} and {drift[1]:.1e} of the total, {lost / first:.2f} left the spheres")
        self.assertGreater(lost / first, 0.1)
        self.assertLess(drift[1], 2e-3)
        self.assertLess(drift[1], 0.7 * drift[0])

    def test_virial(self):
        # a sphere at rest on a plane: branch r times the force, over the volume
        for plane, more in (("plane 0 0 0 0 0 1", ""), ("box 0 0 5 18 18 10 inside", "move linear 0 0 0")):
            rows = self.simulate([Sphere((0, 0, 0.499))], f"""
fix step all nve/sphere/symplectic
fix body all large/body {plane} contact hooke 1e4 0 {more}
fix_modify body virial yes
compute p all pressure NULL fix
compute s all stress/atom NULL fix
compute reduced all reduce sum c_s[3]
""", 0, columns="vol c_p[3] c_reduced")
            row = rows[0]
            self.assertAlmostEqual(row["c_p[3]"] * row["Volume" if "Volume" in row else "vol"], 0.5 * 10.0,
                                   delta=1e-9)
            self.assertAlmostEqual(row["c_reduced"], -0.5 * 10.0, delta=1e-9)


if __name__ == "__main__":
    unittest.main(verbosity=2)
