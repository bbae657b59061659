# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What stands in memory for each particle, by array: for comparison with what is measured.

Bytes for each particle, candidate pair, contact, end of a contact (two of them), or large body and particle; from the
sources of Talus and of LAMMPS.  Ghosts take as much as owned particles in the arrays that hold both.
"""

import dataclasses

ALWAYS = "always"

# when an array stands: in steps, while displacements are put aside (by Talus) or filed by particle (by the stock style),
# while new lists are made
STEPS, FILING, LISTING = "steps", "filing", "listing"
PHASES = (STEPS, FILING, LISTING)


@dataclasses.dataclass
class Array:
    what: str
    bytes: float
    per: str            # particle, pair, contact, end, body
    when: str = ALWAYS
    counted: bool = True    # in the bed that is measured
    phases: tuple = PHASES


HOST = [
    Array("positions, velocities, forces, angular velocities, torques", 120, "particle"),
    Array("radius, mass", 16, "particle"),
    Array("atom ID, type, groups, periodic image (smallbig)", 16, "particle"),
    Array("where an atom ID is", 4, "particle", "atom_modify map array"),
    Array("bins of sorting, about", 12, "particle"),
    Array("positions when lists were made", 24, "particle", "neigh_modify check yes", False),
]

TALUS = [
    Array("records: place and radius; velocity and 1/mass", 64, "particle"),
    Array("records: angular velocity and 1/radius", 32, "particle", "friction"),
    Array("records: sum of forces", 32, "particle", "steps", True, (STEPS,)),
    Array("records: sum of moments", 32, "particle", "steps, friction", True, (STEPS,)),
    Array("records: torques of resistance", 32, "particle", "steps, rolling or spinning resistance", False),
    Array("records: place when lists were made", 32, "particle", "run_style verlet of Talus, neigh_modify check yes", False),
    Array("order: key, tag, both numberings", 24, "particle"),
    Array("tag, rank and slot in the last lists, list of displacements that came along", 20, "particle"),
    Array("order: part, and marks of particles that others read, that are sent, that rest", 5, "particle",
          "threads, ranks", False),
    Array("pairs: two indices", 8, "pair"),
    Array("pairs: begin of each row, for each thread", 8, "particle", "rebuild", True, (LISTING,)),
    Array("pairs: those that touch", 4, "contact", "steps", True, (STEPS,)),
    Array("pairs: displacement, whether it slides", 32, "contact", "multistep", True, (STEPS, FILING)),
    Array("pairs: place of the displacement; whether it touches", 4.125, "pair", "multistep", True, (STEPS, FILING)),
    Array("pairs: impact velocity, age", 32, "contact", "laws that read them", False),
    Array("displacements by particle, with the tag of the partner", 40, "end", "from restart files", False, (LISTING,)),
    Array("displacements kept", 32, "contact", "rebuild, multistep", True, (LISTING,)),
    Array("pairs they belong to", 8, "contact", "rebuild, multistep", True, (FILING, LISTING)),
    Array("begin of their rows, for each thread", 4, "particle", "rebuild, multistep", True, (FILING, LISTING)),
    Array("slots in the last lists, in the new order", 4, "particle", "rebuild, multistep", True, (LISTING,)),
    Array("tags and numbers of followers, for particles that leave", 12, "particle", "rebuild, several ranks", False,
          (FILING, LISTING)),
    Array("followers, for particles that leave", 4, "contact", "rebuild, several ranks", False, (FILING, LISTING)),
    Array("large bodies: where the displacement is", 4, "body", "multistep"),
    Array("neighbor search: cells, places in them, rows", 36, "particle", "rebuild", True, (LISTING,)),
    Array("neighbor search: neighbors", 4, "pair", "rebuild", True, (LISTING,)),
    Array("tags in the old order", 8, "particle", "rebuild", True, (LISTING,)),
]

STOCK = [
    Array("heads of the neighbor list", 16, "particle"),
    Array("neighbors", 4, "pair"),
    Array("bins of the neighbor list, about", 48, "particle"),
    Array("heads of the displacements by pair and by particle", 36, "particle"),
    Array("pairs: displacement, whether it touches", 28, "pair"),
    Array("displacements filed by particle, with the ID of the partner", 28, "end"),
    Array("walls: displacement", 24, "body"),
]


def bytes_per_particle(array, contacts, pairs, bodies):
    return array.bytes * {"particle": 1, "pair": pairs, "contact": contacts, "end": 2 * contacts, "body": bodies}[array.per]


def table(contacts, pairs, bodies, stock_walls):
    """(rows of a table, {code: {phase: sum of what the measured bed holds}}); bodies and walls: arrays of that kind."""
    rows, sums = [], {}
    for owner, arrays, count in (("LAMMPS", HOST, bodies), ("Talus", TALUS, bodies), ("stock gran/hertz/history", STOCK,
                                                                                    stock_walls)):
        sums[owner] = dict.fromkeys(PHASES, 0.0)
        for array in arrays:
            size = bytes_per_particle(array, contacts, pairs, count)
            rows.append([owner, array.what, f"{array.bytes:g} per {NAMES[array.per]}", size, array.when])
            for phase in array.phases if array.counted else ():
                sums[owner][phase] += size
    return rows, sums


NAMES = {"particle": "particle", "pair": "candidate pair", "contact": "contact", "end": "contact and particle",
         "body": "body and particle"}
