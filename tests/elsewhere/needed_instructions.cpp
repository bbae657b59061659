// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// Of a plugin for a processor that no machine has.

#include "instruction_sets.h"

const char *const Talus::needed_instructions[] = {"avx", "avx1024f", nullptr};
