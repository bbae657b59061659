# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""Which bytes of a restart file of atom_style sphere Talus has written and reads: others are of LAMMPS, which checks next to
nothing, and whose reader crashes with some that are wrong. Offsets are found by the layout that LAMMPS documents in its
write_restart.cpp, modify.cpp and atom_vec.cpp, and by the mark of Talus' own parts.

  * Parts with the mark: of the pair style, and of fixes as a whole. The number of bytes before those of fixes is read by
    LAMMPS alone.
  * Of each particle what is behind LAMMPS' own numbers, as far as fixes of Talus have written it."""

import dataclasses
import struct

MARK = b"TlrestD\0"
SIZE_HEAD = 24    # mark, size, digest
FORMAT_OF_LAWS = 4    # of pair style gran/penalty
END = b"LammpS RestartT\0"
OF_ATOM = 16    # doubles of LAMMPS: their number, x, ID, type, group bits, image, v, radius, mass, omega
TYPE = 5        # place among them
STYLES = {"CONTACT_STORE", "NEIGH_HISTORY", "large/body", "shape/gran", "rigid/small", "rigid/small/symplectic", "wall/gran",
          "wall/gran/region"}


@dataclasses.dataclass
class Part:
    """Bytes begin ... end-1."""
    name: str
    begin: int
    end: int


def _text(data, at):
    size, = struct.unpack_from("<i", data, at)
    if not 1 < size < 80 or at + 4 + size > len(data):
        return None, at
    word = data[at + 4:at + 4 + size]
    return (word[:-1].decode("ascii", "replace") if word.endswith(b"\0") and word[:-1].isascii() else None), at + 4 + size


def fixes_of_particles(data):
    """Styles of those that have written something for each particle, in their order."""
    for at in range(len(data) - 12):
        count, = struct.unpack_from("<i", data, at)
        if not 0 < count < 12:
            continue
        styles, place = [], at + 4
        for _ in range(count):
            name, place = _text(data, place)
            style, place = _text(data, place) if name else (None, place)
            if not style:
                break
            styles.append(style)
            place += 4
        if len(styles) == count and "CONTACT_STORE" in styles:
            return styles
    raise AssertionError("no list of fixes")


def rows_of_particles(data):
    """Where the row of each particle begins, and its doubles, in a file that one rank has written."""
    end = data.rindex(END)
    begin = next(at for at in range(end - 8, 0, -1)
                 if 8 * struct.unpack_from("<i", data, at - 4)[0] == end - at and 0 < struct.unpack_from("<i", data, at - 8)[0] < 99)
    while begin < end:
        size = int(struct.unpack_from("<d", data, begin)[0])
        yield begin, size
        begin += 8 * size


def parts_of_talus(data):
    found, at = [], data.find(MARK)
    while at >= 0:
        size = struct.unpack_from("<I", data, at + 8)[0]
        found.append(Part("as a whole", at, at + SIZE_HEAD + size))
        at = data.find(MARK, at + SIZE_HEAD + size)
    styles = fixes_of_particles(data)
    for row, size in rows_of_particles(data):
        at = row + 8 * OF_ATOM
        for style in styles:
            end = at + 8 * int(struct.unpack_from("<d", data, at)[0])
            if style in STYLES:
                found.append(Part(style, at, end))
            at = end
        assert at == row + 8 * size, "records of a particle do not fill its row"
    return found


def digest(layout, data):
    """Of a part with the layout of this number: FNV-1a with words, as src/base/state_digest.h has it."""
    value = 14695981039346656037
    words = struct.unpack(f"<{(len(data) + 7) // 8}Q", data + b"\0" * (-len(data) % 8))
    for word in (layout, *words):
        value = (value ^ (word >> 32) ^ word) * 1099511628211 % 2**64
    return struct.pack("<Q", value)


def with_bit(data, byte, bit):
    """The content with another value of this bit."""
    changed = bytearray(data)
    changed[byte] ^= 1 << bit
    return bytes(changed)
