// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The intrinsics of the processor: 56 000 lines with GCC on x86-64, and so in the precompiled headers.

#ifndef TALUS_BASE_INTRINSICS_H
#define TALUS_BASE_INTRINSICS_H

#if defined(__SSE2__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

#endif
