# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What many ranks would do: a projection from measured times, counted messages and bytes, and a stated network.

Every rank holds a cube of a dense bed with neighbors on all sides, and works as long as one core did here with as many
spheres.  Nothing is said about imbalance, jitter of the operating system, or memory that cores share.
"""

import dataclasses
import math

import beds

# of the network, as clusters have it: stated, not measured
LATENCY = 2.0e-6            # s for a message between nodes
BANDWIDTH = 12.5e9          # bytes/s of a node (100 Gbit/s), which its ranks share
RANKS_PER_NODE = 64
LEAVING = RANKS_PER_NODE**(-1 / 3)      # of the proxies: ranks of a node form a cube, messages within it cost their packing

REBUILD = 100               # steps between rebuilds
REBUILD_MESSAGES = 12       # messages of a rebuild over those of a step: migration, borders, their counts, the plan
REBUILD_BYTES = 6           # the same of bytes
FILL = 0.6                  # volume of spheres over volume of the bed
REACH = 1.05 * beds.D + beds.SKIN


@dataclasses.dataclass
class Exchange:
    """Of one way to exchange proxies, per step: messages a rank sends, bytes for each proxy, whether it waits for the
    answer of all ranks if lists are still good, and whether messages travel while forces are computed."""
    messages: int
    bytes: int
    waits_for_all: bool
    overlaps: bool


@dataclasses.dataclass
class Measured:
    """On this machine: {spheres: core ns per particle and step}; s to pack and unpack a proxy; share of the forces of a
    step, behind which messages can travel."""
    nanoseconds: dict
    copying: float
    forces: float


def proxies_of_cube(count):
    """Proxies around a cube that holds `count` spheres, and how many of its own are proxies elsewhere."""
    density = FILL * 6 / math.pi / beds.D**3
    edge = (count / density)**(1 / 3)
    inner = max(0.0, edge - 2 * REACH)
    return density * ((edge + 2 * REACH)**3 - edge**3), density * (edge**3 - inner**3)


def step(count, ranks, exchange, measured):
    """(seconds of a step, share of it that is exchange and waiting)."""
    proxies, sent = proxies_of_cube(count)
    alone = 1e-9 * measured.nanoseconds[count] * count
    # a contact across the border is computed on both sides: for each proxy about half the contacts of a particle
    work = alone * (1.0 + 0.5 * measured.forces * proxies / count)
    per_byte = LEAVING * RANKS_PER_NODE / BANDWIDTH
    network = exchange.messages * LATENCY + proxies * exchange.bytes * per_byte
    if exchange.overlaps:
        interior = max(0.0, 1.0 - sent / count)
        network = max(0.0, network - interior * measured.forces * work)
    if exchange.waits_for_all:
        network += 2 * math.ceil(math.log2(ranks)) * LATENCY
    rebuild = (REBUILD_MESSAGES * exchange.messages * LATENCY + REBUILD_BYTES * proxies * exchange.bytes * per_byte +
               2 * math.ceil(math.log2(ranks)) * LATENCY) / REBUILD
    lost = network + rebuild + measured.copying * proxies
    return work + lost, lost / (work + lost)


def efficiency(count, ranks, exchange, measured):
    """(seconds of a step, share of exchange and waiting, efficiency against one rank without neighbors)."""
    seconds, share = step(count, ranks, exchange, measured)
    return seconds, share, 1e-9 * measured.nanoseconds[count] * count / seconds
