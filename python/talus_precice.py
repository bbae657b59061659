# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Talus as a participant of a simulation that preCICE (version 3) couples: grains in a fluid, and meshes that another solver bends;
doc/coupling.md.

    from lammps import lammps
    from talus import Partner
    from talus_precice import Participant
    lmp = lammps()
    lmp.file("in.grains")
    with Partner(lmp) as partner:
        grains = Participant(partner, "Grains", "precice-config.xml")
        grains.fluid("Fluid-Mesh", (0, 0, 0), (0.1, 0.1, 0.4), "tophat 0.009", "beetstra", 1.2, 1.8e-5)
        grains.run(every=10)

preCICE is asked on each rank; what is exchanged is on the first one, or the same on all. Its time windows must be whole numbers of
time steps of LAMMPS. The Partner lives on all ranks."""

import numpy

FAR = 1.0e30      # where no vertex is

FIELDS = {"velocity": "Velocity", "pressure_gradient": None, "volume": "Volume",
          "solid": "SolidFraction", "grain_velocity": "GrainVelocity", "drag": "Drag", "coefficient": "DragCoefficient"}


def _module():
    try:
        import precice
    except ImportError as error:
        raise ImportError("talus_precice needs the Python bindings of preCICE 3: pip install pyprecice") from error
    return precice


class Participant:
    """partner: of talus.Partner, on all ranks; name, configuration: of preCICE."""

    def __init__(self, partner, name, configuration):
        if partner.root != -1:
            raise ValueError("talus_precice: open the Partner on all ranks (root=ALL_RANKS)")
        self.partner = partner
        self.rank = partner.lmp.extract_setting("world_rank")
        self.precice = _module().Participant(name, configuration, self.rank, partner.lmp.extract_setting("world_size"))
        self._couplings = []

    def fluid(self, mesh, lo, hi, kernel, law, density, viscosity, volume=None, gravity=None, **fields):
        """Grains in the fluid of another participant, whose cells are around the vertices of its mesh between the corners lo, hi
        (api-access). kernel, law, density, viscosity, gravity: as of talus.Fluid. volume: of each cell, if they are equal; else
        the data "Volume" of the other participant tells it, with initial values. fields: names of data, None: not exchanged;
        as here they are read: velocity="Velocity", pressure_gradient=None; and written: solid="SolidFraction",
        grain_velocity="GrainVelocity", drag="Drag" (force of the grains on the fluid, per volume of the cell, mean of the time
        step), coefficient="DragCoefficient" (its derivative by the velocity of the fluid, with the sign changed)."""
        unknown = set(fields) - set(FIELDS)
        if unknown:
            raise ValueError(f"'{unknown.pop()}' is none of {', '.join(FIELDS)}")
        self._couplings.append(_Fluid(self, mesh, (lo, hi), kernel, (law, density, viscosity), volume, gravity, {**FIELDS, **fields}))

    def surface(self, mesh, body, displacement="Displacement", force="Force"):
        """Another participant moves the vertices of the mesh of a fix large/body (mesh ... move vertices) by the displacements
        from where they are now, and gets the forces of grains on them, means of the time step (map them conservatively). Each
        rank gives all vertices, forces are those of the first."""
        self._couplings.append(_Surface(self, mesh, body, displacement, force))

    def run(self, every=None):
        """To the end of the coupled simulation; exchanges every so many time steps of LAMMPS, None: once in each time window."""
        precice, partner = self.precice, self.partner
        for one in self._couplings:
            one.define()
        if precice.requires_initial_data():
            for one in self._couplings:
                one.write_first()
        precice.initialize()
        for one in self._couplings:
            one.begin()
        saved = None
        while precice.is_coupling_ongoing():
            if precice.requires_writing_checkpoint():
                saved = partner.save()
            steps = self._steps(precice.get_max_time_step_size(), every)
            duration = steps * partner.dt
            for one in self._couplings:
                one.read(steps, duration)
            partner.advance(steps)
            for one in self._couplings:
                one.write(duration)
            precice.advance(duration)
            if precice.requires_reading_checkpoint():
                partner.restore(saved)
        precice.finalize()

    def _steps(self, longest, every):
        steps = round(longest / self.partner.dt)
        if steps < 1 or abs(steps * self.partner.dt - longest) > 1e-6 * self.partner.dt:
            raise ValueError(f"talus_precice: preCICE asks for a step of {longest:.9g}, which is no whole number of time steps of "
                             f"LAMMPS ({self.partner.dt:.9g}): change 'timestep', or time-window-size in its configuration")
        return steps if every is None else min(steps, every)


class _Fluid:

    def __init__(self, owner, mesh, box, kernel, law, volume, gravity, names):
        self.owner, self.mesh, self.box, self.kernel, self.law = owner, mesh, box, kernel, law
        self.volume, self.gravity, self.names = volume, gravity, names

    def define(self):
        """Cells are on the first rank."""
        lo, hi = self.box if self.owner.rank == 0 else ((FAR,) * 3, (2 * FAR,) * 3)
        self.owner.precice.set_mesh_access_region(self.mesh, [edge for pair in zip(lo, hi) for edge in pair])

    def write_first(self):
        """Vertices of others are not known before they are asked for."""

    def begin(self):
        self.ids, x = self.owner.precice.get_mesh_vertex_ids_and_coordinates(self.mesh)
        if self.owner.rank == 0 and not len(self.ids):
            raise ValueError(f"talus_precice: mesh '{self.mesh}' has no vertex between {self.box[0]} and {self.box[1]}: give corners of "
                             "a box that contains the cells of the fluid")
        x = numpy.asarray(x, float).reshape(-1, 3)
        volume = numpy.full(len(x), self.volume) if self.volume is not None else self._read("volume", 0.0)
        self.fluid = self.owner.partner.fluid_cells(x.ravel(), volume, self.kernel)
        self.fluid.drag_law(*self.law)

    def _read(self, what, at):
        if not len(self.ids):
            return numpy.zeros(0)
        return numpy.asarray(self.owner.precice.read_data(self.mesh, self.names[what], self.ids, at), float).ravel()

    def _write(self, what, values):
        if self.names[what] and len(self.ids):
            self.owner.precice.write_data(self.mesh, self.names[what], self.ids, numpy.asarray(values))

    def read(self, steps, duration):
        gradient = self._read("pressure_gradient", duration) if self.names["pressure_gradient"] else None
        self.coefficient = self.fluid.put(self._read("velocity", duration), gradient, self.gravity)
        self.fluid.grains("exchange")

    def write(self, duration):
        solid, velocity = self.fluid.grains("solid", "velocity")
        self._write("solid", solid)
        self._write("grain_velocity", velocity)
        self._write("drag", -numpy.asarray(self.fluid.grains("exchange"), float) / duration)
        self._write("coefficient", self.coefficient)


class _Surface:

    def __init__(self, owner, mesh, body, displacement, force):
        self.owner, self.mesh, self.names = owner, mesh, (displacement, force)
        self.body = owner.partner.body(body)

    def define(self):
        x, _ = self.body.mesh
        self.x = numpy.array(x, float).reshape(-1, 3)
        self.ids = self.owner.precice.set_mesh_vertices(self.mesh, self.x)
        self.body.vertex_loads()

    def write_first(self):
        self.owner.precice.write_data(self.mesh, self.names[1], self.ids, numpy.zeros_like(self.x))

    def begin(self):
        pass

    def read(self, steps, duration):
        moved = self.owner.precice.read_data(self.mesh, self.names[0], self.ids, duration)
        self.body.put_vertices((self.x + numpy.asarray(moved, float).reshape(-1, 3)).ravel(), steps=steps)

    def write(self, duration):
        vertices, impulses, _, _ = self.body.vertex_loads()
        force = numpy.zeros_like(self.x)
        if self.owner.rank == 0 and len(vertices):
            force[numpy.asarray(vertices)] = numpy.asarray(impulses, float) / duration
        self.owner.precice.write_data(self.mesh, self.names[1], self.ids, force)
