// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the two files of the plugin agree on. talusplugin.so (the gate) checks the host, opens
// talusstyles.so beside it and calls its one function. The name of that function spells out what
// a binary depends on, so a file left over from another build is never called by accident. In a
// portable build talusstyles.so is talusdispatch.cpp, and the styles are in files of their own,
// talusstyles-WORD.so, whose function ends in the word of their instruction set.

#ifndef TALUS_TALUS_ABI_H
#define TALUS_TALUS_ABI_H

#include "system/host/lammps_compat.h"

#if defined(LAMMPS_BIGBIG)
#define TALUS_SIZES bigbig
#elif defined(LAMMPS_SMALLBIG)
#define TALUS_SIZES smallbig
#else
#error "Talus supports hosts with LAMMPS_SMALLBIG or LAMMPS_BIGBIG"
#endif

// set by the build of one file of several: the word of its instructions after an underscore
#if !defined(TALUS_INSTRUCTION_SET)
#define TALUS_INSTRUCTION_SET
#endif

#define TALUS_JOIN_(version, sizes, set) talus_register_##version##_##sizes##set
#define TALUS_JOIN(version, sizes, set) TALUS_JOIN_(version, sizes, set)
#define TALUS_TEXT_(a) #a
#define TALUS_TEXT(a) TALUS_TEXT_(a)

// (lmp, handle, register function), as lammpsplugin_init: talus_register_20250204_smallbig in
// talusstyles.so, talus_register_20250204_smallbig_avx2 in talusstyles-avx2.so
#define TALUS_REGISTER TALUS_JOIN(TALUS_LAMMPS_VERSION, TALUS_SIZES, )
#define TALUS_REGISTER_STYLES TALUS_JOIN(TALUS_LAMMPS_VERSION, TALUS_SIZES, TALUS_INSTRUCTION_SET)

#endif
