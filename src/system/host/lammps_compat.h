// Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
//
// The only place where LAMMPS versions are told apart. Sources include it and use the names
// defined here; nothing else may test TALUS_LAMMPS_VERSION (yyyymmdd, set by the build).

#ifndef TALUS_SYSTEM_HOST_LAMMPS_COMPAT_H
#define TALUS_SYSTEM_HOST_LAMMPS_COMPAT_H

#if !defined(TALUS_LAMMPS_VERSION)
#error "link the CMake target lammps_host: it defines TALUS_LAMMPS_VERSION"
#elif TALUS_LAMMPS_VERSION < 20250204
#error "Talus needs LAMMPS 4 Feb 2025 or newer"
#endif

// Pair::atom2cut() and Pair::radii2cut(), which `neighbor multi` asked for, were removed in summer
// 2025, possibly within updates of a release that keep its date: so the build looks into the
// header.
#if TALUS_HOST_HAS_ATOM2CUT
#define TALUS_OVERRIDE_ATOM2CUT override
#else
#define TALUS_OVERRIDE_ATOM2CUT
#endif

// TALUS_HOST_HAS_RUN_PLUGINS, set by the build: plugins may bring run styles, which came in summer
// 2025. Before, they enter them in LAMMPS' table of run styles, a public member of Update.
#if !defined(TALUS_HOST_HAS_RUN_PLUGINS)
#error "link the CMake target lammps_host: it defines TALUS_HOST_HAS_RUN_PLUGINS"
#endif

// TALUS_HOST_TELLS_FORMULAS, set by the build: Variable::get_info() tells the text of a variable.
// Before, it is a private member.
#if !defined(TALUS_HOST_TELLS_FORMULAS)
#error "link the CMake target lammps_host: it defines TALUS_HOST_TELLS_FORMULAS"
#endif

// Set by the build: TALUS_HOST_HAS_GRANULAR, LAMMPS has package GRANULAR; of its fix wall/gran,
// TALUS_HOST_HAS_WALL_CYLINDER, it has the keyword zcylinder, and TALUS_HOST_DRAWS_GRAN_WALLS, its
// planes can be seen in pictures. All three changed within updates of a release.
#if !defined(TALUS_HOST_HAS_GRANULAR) || !defined(TALUS_HOST_HAS_WALL_CYLINDER) ||                 \
    !defined(TALUS_HOST_DRAWS_GRAN_WALLS)
#error "link the CMake target lammps_host: it defines TALUS_HOST_HAS_GRANULAR"
#endif

// TALUS_HOST_SCALES_CLASSIC_SLIP, set by the build: where the classic tangential models of pair
// granular slip, the displacement is set back by the stiffness that the contact has; and only that
// of mindlin_classic is scaled with the contact radius. Before, both are scaled, and what is set
// back is not.
#if !defined(TALUS_HOST_SCALES_CLASSIC_SLIP)
#error "link the CMake target lammps_host: it defines TALUS_HOST_SCALES_CLASSIC_SLIP"
#endif

// comm_modify mode multi/old and its cutoffs by type were removed in 2026.
#define TALUS_HOST_HAS_MULTI_OLD (TALUS_LAMMPS_VERSION < 20260000)

// Extents of regions that move follow them; before, they are those of the region where it is defined.
#define TALUS_HOST_MOVES_EXTENTS (TALUS_LAMMPS_VERSION >= 20260000)

// Kind of object that Fix::image() hands to dump image: triangles. The older host has the list in
// dump_image.cpp alone.
#if TALUS_LAMMPS_VERSION >= 20260000
#include "graphics.h"
#define TALUS_IMAGE_TRIANGLE LAMMPS_NS::Graphics::TRI
#else
#define TALUS_IMAGE_TRIANGLE 2
#endif

#endif
