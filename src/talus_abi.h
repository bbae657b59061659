// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// What the two files of the plugin agree on. talusplugin.so (the gate) checks the host, opens
// talusstyles.so beside it and calls its one function. The name of that function spells out what
// a binary depends on, so a file left over from another build is never called by accident.

#ifndef TALUS_ABI_H
#define TALUS_ABI_H

#include "lammps_compat.h"

#if defined(LAMMPS_BIGBIG)
#define TALUS_SIZES bigbig
#elif defined(LAMMPS_SMALLBIG)
#define TALUS_SIZES smallbig
#else
#error "Talus supports hosts with LAMMPS_SMALLBIG or LAMMPS_BIGBIG"
#endif

#define TALUS_JOIN_(a, b, c) a##_##b##_##c
#define TALUS_JOIN(a, b, c) TALUS_JOIN_(a, b, c)
#define TALUS_TEXT_(a) #a
#define TALUS_TEXT(a) TALUS_TEXT_(a)

// talus_register_20250204_smallbig(lmp, handle, register function), as lammpsplugin_init
#define TALUS_REGISTER TALUS_JOIN(talus_register, TALUS_LAMMPS_VERSION, TALUS_SIZES)

#endif
