# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
"""What ranks send each other, counted by the library count_mpi (tests/mpi/count_mpi.cpp), which knows nothing of Talus."""

import os


def counting(path):
    """The environment of a run whose ranks write counts to the files path.RANK."""
    library = os.path.join(os.environ["TALUS_BINARY_DIR"], "tests", "libcount_mpi.so")
    return {"LD_PRELOAD": " ".join(filter(None, [os.environ.get("LD_PRELOAD"), library])), "TALUS_COUNTS": path}


def gathered(path, np):
    """Bytes that all ranks have given to MPI_Allgatherv()."""
    size = 0
    for rank in range(np):
        with open(f"{path}.{rank}") as file:
            size += sum(int(words[1]) for words in map(str.split, file) if words[0] == "gathered")
    return size


def sent(path, np):
    """Messages and bytes that all ranks have sent to others, point to point."""
    messages = size = 0
    for rank in range(np):
        with open(f"{path}.{rank}") as file:
            for words in map(str.split, file):
                if words[0] == "to" and int(words[1]) != rank:
                    messages += int(words[3])
                    size += int(words[5])
    return messages, size
