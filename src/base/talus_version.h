// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The version of Talus, which CMakeLists.txt sets: in the log, in restart files and in VTK files.

#ifndef TALUS_BASE_TALUS_VERSION_H
#define TALUS_BASE_TALUS_VERSION_H

#if !defined(TALUS_VERSION_MAJOR)
#error "link the CMake target talus_flags: it defines the version"
#endif

#define TALUS_TEXT_OF(number) #number
#define TALUS_TEXT_OF_VERSION(a, b, c) TALUS_TEXT_OF(a) "." TALUS_TEXT_OF(b) "." TALUS_TEXT_OF(c)

/// As text, "1.0.0".
#define TALUS_VERSION                                                                              \
  TALUS_TEXT_OF_VERSION(TALUS_VERSION_MAJOR, TALUS_VERSION_MINOR, TALUS_VERSION_PATCH)

/// As a number that grows: 10000 for 1.0.0, 10203 for 1.2.3.
inline constexpr int talus_version =
    10000 * TALUS_VERSION_MAJOR + 100 * TALUS_VERSION_MINOR + TALUS_VERSION_PATCH;

#endif
