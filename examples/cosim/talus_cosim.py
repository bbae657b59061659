# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Steering large bodies (fix large/body ... move external) from Python with the `lammps` module of the host.

All calls are collective: every MPI rank makes them with the same arguments and gets the same numbers."""


class Body:
    """A large body of a LAMMPS instance.

    state: position (3), orientation as quaternion w x y z (4), velocity (3), angular velocity (3)."""

    def __init__(self, lmp, fix_id):
        self.lmp, self.id = lmp, fix_id

    def set_state(self, state, after=0):
        """The body is to have this state `after` steps from now; 0: at once, going on with its velocity."""
        numbers = " ".join(f"{x:.17g}" for x in state)
        self.lmp.command(f"fix_modify {self.id} state {numbers} after {after}")

    def _numbers(self, first, last):
        return [self.lmp.extract_fix(self.id, 0, 1, k, 0) for k in range(first, last)]

    @property
    def state(self):
        return self._numbers(6, 19)

    @property
    def load(self):
        """Force (3) and torque about the reference point (3) of the particles on the body, last step."""
        return self._numbers(0, 6)


def run(lmp, steps):
    """Steps without the set-up of a new run; the first run must be a `run 0`."""
    lmp.command(f"run {steps} pre no post no")
