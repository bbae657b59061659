# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# ctest: timeout=120
"""compute timestep/gran of cubes: stable a little below its limit, unstable above. Mass and edge 1, linear contacts of
stiffness 1 that stay closed and stick."""

import unittest

from talus_testing import SceneCase, Sphere, begin, write_sphere_data

SCRIPT = "\nclear" + begin(read="read_data grains", law="{pair}", skin=0.2) + """
fix s all shape/gran type 1 box 1 1 1 rounded {rounded} density {density!r}
compute t all timestep/gran
timestep {dt!r}
thermo 100000
thermo_modify norm no lost ignore
thermo_style custom step f_s c_t[1] c_t[2] c_t[7] c_t[8]
{scene}
run 0
variable begin string $(f_s)
variable grown equal f_s/v_begin
fix stop all halt 1 v_grown > 1e8 error continue message no
run 4000
print "RESULT $(v_grown) $(c_t[1]:%.17g) $(c_t[2]:%.17g) $(c_t[7]:%.17g) $(c_t[8]:%.17g)"
"""
DEPTH, KICK = 1e-6, 1e-9
STICKS = "hooke 1.0 {gn!r} tangential multistep {kt!r} {gt!r} 1e9"
LEAST = 0.5 - DEPTH
CORNER = "\n".join(f"fix w{axis} all large/body plane {p} {n} contact {{law}}" for axis, p, n in (
    ("x", f"-{LEAST} 0 0", "1 0 0"), ("y", f"0 -{LEAST} 0", "0 1 0"), ("z", f"0 0 -{LEAST}", "0 0 1"))) + "\nfix g all gravity/talus $(4e-6*sqrt(3)) vector -1 -1 -1"
CAGE = f"fix w all large/body box 0 0 0 {2 * LEAST} {2 * LEAST} {2 * LEAST} inside contact {{law}}"
FLOOR = f"fix w all large/body plane 0 0 -{LEAST} 0 0 1 contact {{law}}\nfix g all gravity/talus 4e-6 vector 0 0 -1"
KICKS = (3 * KICK, -2 * KICK, KICK), (KICK, 2 * KICK, -4 * KICK)
PRESS = "fix push all addforce 0 0 v_push\nvariable push atom \"-8e-6*(z>0)+8e-6*(z<0)\""


class ShapeStability(SceneCase):

    def grown(self, scene, fraction, places=((0, 0, 0),), kt=1.0, gn=0.0, gt=0.0):
        """Growth of the kinetic energy at this fraction of the limit, and the limit. Pairs alone have it, or bodies."""
        write_sphere_data(self.path("grains"), 3 * ((-9, 9),), [
            Sphere(x, [s * v for v in KICKS[0]], [s * w for w in KICKS[1]]) for x, s in zip(places, (1, -2))])
        law = STICKS.format(gn=gn, kt=kt, gt=gt)
        pair = law if len(places) > 1 else "hooke 1e-3 0"
        found = []
        for dt in (1e-9, None):
            script = SCRIPT.format(pair=pair, rounded=0, density=1.0, dt=dt or fraction * found[-1], scene=scene.format(law=law))
            if not found:
                script = script.replace("run 4000", "run 0")
            numbers = [float(x) for x in self.run_lammps(script).log.split("\nRESULT ")[1].splitlines()[0].split()]
            found.append(numbers[3] if not found else numbers[0])
        return found[1], found[0]

    def bounds(self, name, scene, stable, unstable, **options):
        low, limit = self.grown(scene, stable, **options)
        high, _ = self.grown(scene, unstable, **options)
        print(f"{name:40} limit {limit:.4f}: grows {low:.3g} at {stable} of it, {high:.3g} at {unstable}")
        self.assertLess(low, 30.0, name)
        self.assertGreater(high, 3e3, name)    # until contacts open

    def test_corner(self):
        """Three faces are held, half of all: what the limit of large bodies is meant for."""
        self.bounds("cube in a corner", CORNER, 0.95, 0.98)
        for kt, gn, gt in (0.3, 0.0, 0.0), (1.0, 0.5, 0.2):
            self.bounds(f"cube in a corner, kt {kt}, gn {gn}", CORNER, 0.9, 1.1, kt=kt, gn=gn, gt=gt)

    def test_floor(self):
        """One face: kn = kt = 1 is 8 + sqrt(40), half of all have 36."""
        self.bounds("cube on a plane", FLOOR, 1.56, 1.61)

    def test_cage(self):
        """All faces are held: sqrt(1/2) of the limit of half of them."""
        self.bounds("cube in a box", CAGE, 0.69, 0.73)

    def test_two_cubes(self):
        """One face of each is held."""
        z = LEAST
        self.bounds("two cubes pressed together", PRESS, 1.0, 3.0, places=((0, 0, -z), (0, 0, z)))


if __name__ == "__main__":
    unittest.main()
