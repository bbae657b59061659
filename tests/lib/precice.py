# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Stand-in for the Python bindings of preCICE 3, for tests of python/talus_precice.py: the calls that it makes, between a participant
on any number of ranks (`first`) and a program with one rank (`second`), which listens. Schemes are parallel, data are constant over a
window, meshes are accessed directly (api-access): the other side has the vertices as they are, those of all ranks one after the
other. As preCICE it ends in an error where a call is missing, too early or too late.

The configuration is JSON: address (of a socket), first, second, size (ranks of first), window, windows, iterations (of each window),
meshes (mesh: who provides it), data (name: [mesh, who writes it, numbers per vertex])."""

import json
import time
from multiprocessing.connection import Client, Listener

import numpy


class Error(RuntimeError):
    pass


class Participant:

    def __init__(self, name, configuration, rank, size, communicator=None):
        with open(configuration) as file:
            self._given = json.load(file)
        given = self._given
        self._first, self._rank = name == given["first"], rank
        if name not in (given["first"], given["second"]) or size != (given["size"] if self._first else 1):
            raise Error(f"participant {name} on {size} ranks is not in the configuration")
        self._name = name
        self._provided, self._regions, self._received = {}, {}, {}
        self._written, self._read = {}, {}
        self._window = self._iteration = 0
        self._done = self._initialized = self._to_restore = self._asked_to_write = self._asked_to_read = False

    def _require(self, holds, what):
        if not holds:
            raise Error(f"preCICE would refuse: {what}")

    # ---- meshes

    def set_mesh_vertices(self, mesh, positions):
        self._require(not self._initialized and self._given["meshes"][mesh] == self._name, "vertices of a mesh of others, or late")
        self._provided[mesh] = numpy.array(positions, float).reshape(-1, 3)
        return numpy.arange(len(self._provided[mesh]), dtype=numpy.int32)

    def set_mesh_access_region(self, mesh, box):
        self._require(not self._initialized and self._given["meshes"][mesh] != self._name and len(box) == 6, "access region")
        self._regions[mesh] = numpy.array(box, float)

    def get_mesh_vertex_ids_and_coordinates(self, mesh):
        self._require(self._initialized and mesh in self._regions, "vertices without an access region, or before initialize()")
        return self._received[mesh]

    # ---- data

    def requires_initial_data(self):
        return True

    def write_data(self, mesh, data, ids, values):
        of, writer, columns = self._given["data"][data]
        self._require(of == mesh and writer == self._name, f"{self._name} writes {data} to {mesh}")
        values = numpy.array(values, float)
        self._require(values.shape in ((len(ids),), (len(ids), columns)) and values.size == len(ids) * columns and
                      numpy.isfinite(values).all(), f"{data}: shape {values.shape} for {len(ids)} vertices")
        self._written[data] = values.reshape(len(ids), columns)

    def read_data(self, mesh, data, ids, relative_read_time):
        of, writer, columns = self._given["data"][data]
        self._require(self._initialized and of == mesh and writer != self._name, f"{self._name} reads {data} of {mesh}")
        self._require(0.0 <= relative_read_time <= self.get_max_time_step_size() * (1 + 1e-12), "a time outside of the window")
        values = self._read[data][numpy.asarray(ids, int)]
        return values.copy() if columns > 1 else values.ravel().copy()

    # ---- time

    def initialize(self):
        self._initialized = True
        if self._first:
            for _ in range(600):    # until the other listens
                try:
                    self._connection = Client(self._given["address"])
                    break
                except (FileNotFoundError, ConnectionRefusedError):
                    time.sleep(0.05)
            self._connection.send((self._rank, self._provided, self._regions, self._written))
            self._received, self._read = self._connection.recv()
        else:
            self._listen()
        self._left = self._given["window"]

    def _listen(self):
        with Listener(self._given["address"]) as listener:
            some = [listener.accept() for _ in range(self._given["size"])]
        hello = [(one.recv(), one) for one in some]
        hello.sort(key=lambda pair: pair[0][0])
        self._connections = [one for _, one in hello]
        said = [words for words, _ in hello]
        for mesh in self._regions:
            x = numpy.concatenate([words[1][mesh] for words in said])
            self._received[mesh] = (numpy.arange(len(x), dtype=numpy.int32), x)
        self._inside = [{mesh: numpy.nonzero(((box[0::2] <= self._provided[mesh]) & (self._provided[mesh] <= box[1::2])).all(1))[0]
                         for mesh, box in words[2].items()} for words in said]
        self._counts = [{mesh: len(x) for mesh, x in words[1].items()} for words in said]
        self._gather([words[3] for words in said])
        for rank, one in enumerate(self._connections):
            vertices = {mesh: (numpy.arange(len(of), dtype=numpy.int32), self._provided[mesh][of])
                        for mesh, of in self._inside[rank].items()}
            one.send((vertices, self._data_for(rank)))

    def _data_for(self, rank):
        found = {}
        for name, values in self._written.items():
            mesh = self._given["data"][name][0]
            if mesh in self._inside[rank]:
                found[name] = values[self._inside[rank][mesh]]
            else:
                begin = sum(counts[mesh] for counts in self._counts[:rank])
                found[name] = values[begin:begin + self._counts[rank][mesh]]
        return found

    def _gather(self, of_ranks):
        for name, (mesh, writer, columns) in self._given["data"].items():
            if writer == self._name:
                continue
            if mesh in self._provided:
                self._read[name] = numpy.zeros((len(self._provided[mesh]), columns))
                for rank, data in enumerate(of_ranks):
                    if name in data:
                        self._read[name][self._inside[rank][mesh]] = data[name]
            elif all(name in data for data in of_ranks):
                self._read[name] = numpy.concatenate([data[name] for data in of_ranks])

    def is_coupling_ongoing(self):
        return not self._done

    def get_max_time_step_size(self):
        return 0.0 if self._done else self._left

    def requires_writing_checkpoint(self):
        self._asked_to_write = True
        return self._given["iterations"] > 1 and self._iteration == 0 and self._left == self._given["window"]

    def requires_reading_checkpoint(self):
        self._asked_to_read = True
        return self._to_restore

    def advance(self, dt):
        self._require(self._initialized and not self._done and 0.0 < dt <= self._left * (1 + 1e-12), f"advance({dt})")
        self._require(self._asked_to_write or self._given["iterations"] == 1, "requires_writing_checkpoint() was not called")
        self._require(self._asked_to_read or not self._to_restore, "requires_reading_checkpoint() was not called")
        self._left -= dt
        self._to_restore = False
        if self._left > 1e-9 * self._given["window"]:
            return
        if self._first:
            self._connection.send(self._written)
            self._read = self._connection.recv()
        else:
            self._gather([one.recv() for one in self._connections])
            for rank, one in enumerate(self._connections):
                one.send(self._data_for(rank))
        self._left = self._given["window"]
        self._iteration += 1
        self._to_restore = self._iteration < self._given["iterations"]
        self._asked_to_write = self._asked_to_read = False
        if not self._to_restore:
            self._iteration, self._window = 0, self._window + 1
            self._done = self._window == self._given["windows"]

    def finalize(self):
        self._require(self._done, "finalize() before the end")
        for one in [self._connection] if self._first else self._connections:
            one.close()
