# Find the host LAMMPS, check it, and offer it as target lammps_host.
#
# The host is a build directory of LAMMPS, or an installed program whose source tree is given as well: then what the
# program says of itself (lmp -h) stands for the build directory.
#
# Sets TALUS_LAMMPS_VERSION (yyyymmdd), TALUS_HOST_SIZES, TALUS_HOST_LMP, TALUS_HOST_OMP,
# LAMMPS_SOURCE_DIR, LAMMPS_BINARY_DIR. Every check ends in one message with its cure; scripts/build
# shows the text from "talus:" on.

set(TALUS_OLDEST_LAMMPS 20250204)

function(talus_fail)
  string(JOIN "" text ${ARGN})
  message(FATAL_ERROR "talus: ${text}")
endfunction()

# An input may come as a cache variable or from the environment, also after a try without it.
function(talus_input name type help)
  if(NOT ${name})
    set(${name} "$ENV{${name}}" CACHE ${type} "${help}" FORCE)
  endif()
endfunction()

function(talus_read_host_cache)
  if(NOT LAMMPS_BINARY_DIR)
    talus_fail("no host: LAMMPS_BINARY_DIR is not set. Run scripts/build, which makes a host, or "
      "pass -D LAMMPS_BINARY_DIR=<build directory of your LAMMPS>.")
  endif()
  get_filename_component(dir "${LAMMPS_BINARY_DIR}" ABSOLUTE)
  if(NOT EXISTS "${dir}/CMakeCache.txt")
    talus_fail("${dir} is not a build directory of LAMMPS: it has no CMakeCache.txt. Build LAMMPS "
      "with CMake and pass that directory as LAMMPS_BINARY_DIR, or run scripts/build.")
  endif()
  set(wanted CMAKE_HOME_DIRECTORY LAMMPS_SIZES LAMMPS_MACHINE BUILD_MPI BUILD_OMP
    BUILD_SHARED_LIBS PKG_PLUGIN PKG_BPM PKG_GRANULAR PKG_RIGID)
  load_cache("${dir}" READ_WITH_PREFIX HOST_ ${wanted})
  foreach(name IN LISTS wanted)
    set(HOST_${name} "${HOST_${name}}" PARENT_SCOPE)
  endforeach()
  set(LAMMPS_BINARY_DIR "${dir}" PARENT_SCOPE)
endfunction()

# The same of an installed program. LAMMPS_BINARY_DIR becomes the folder it is in, for messages.
function(talus_ask_host_program)
  find_program(TALUS_HOST_PROGRAM "${LAMMPS_EXECUTABLE}" NO_CACHE)
  if(NOT TALUS_HOST_PROGRAM)
    talus_fail("there is no program '${LAMMPS_EXECUTABLE}' (LAMMPS_EXECUTABLE): give the lmp that is installed, with its path "
      "if it is not in PATH.")
  endif()
  if(NOT LAMMPS_SOURCE_DIR)
    talus_fail("LAMMPS_EXECUTABLE needs LAMMPS_SOURCE_DIR: the unpacked source of the same release of LAMMPS (installed headers "
      "are not enough).")
  endif()
  set(ENV{LAMMPS_PLUGIN_PATH} "")
  execute_process(COMMAND "${TALUS_HOST_PROGRAM}" -h OUTPUT_VARIABLE text ERROR_VARIABLE problem RESULT_VARIABLE failed)
  if(failed OR NOT text MATCHES "Massively Parallel Simulator - ([0-9]+ [A-Z][a-z][a-z][a-z]* [0-9]+)")
    talus_fail("'${TALUS_HOST_PROGRAM} -h' does not answer as LAMMPS does: ${problem}")
  endif()
  set(HOST_VERSION "${CMAKE_MATCH_1}" PARENT_SCOPE)
  set(HOST_LAMMPS_SIZES "")
  if(text MATCHES "-DLAMMPS_(SMALLBIG|BIGBIG|SMALLSMALL)")
    string(TOLOWER "${CMAKE_MATCH_1}" sizes)
    set(HOST_LAMMPS_SIZES "${sizes}" PARENT_SCOPE)
  endif()
  string(REGEX MATCH "Installed packages:.*" packages "${text}")
  foreach(name PLUGIN BPM GRANULAR RIGID)
    string(REGEX MATCH "[ \n]${name}[ \n]" HOST_PKG_${name} "${packages}")
    set(HOST_PKG_${name} "${HOST_PKG_${name}}" PARENT_SCOPE)
  endforeach()
  string(REGEX MATCH "MPI v[0-9.]+: [^\n]*" mpi "${text}")
  if(mpi MATCHES "STUBS")
    set(mpi "")
  endif()
  set(HOST_BUILD_MPI "${mpi}" PARENT_SCOPE)
  string(REGEX MATCH "OpenMP [0-9]" openmp "${text}")
  set(HOST_BUILD_OMP "${openmp}" PARENT_SCOPE)
  get_filename_component(dir "${TALUS_HOST_PROGRAM}" DIRECTORY)
  set(LAMMPS_BINARY_DIR "${dir}" PARENT_SCOPE)
  set(TALUS_HOST_LMP "${TALUS_HOST_PROGRAM}" PARENT_SCOPE)
endfunction()

# Accepts the top of the tree and its src folder.
function(talus_find_host_source)
  set(dir "${LAMMPS_SOURCE_DIR}")
  if(NOT dir)
    get_filename_component(dir "${HOST_CMAKE_HOME_DIRECTORY}" DIRECTORY)
  endif()
  get_filename_component(dir "${dir}" ABSOLUTE)
  if(EXISTS "${dir}/version.h" AND NOT EXISTS "${dir}/src/version.h")
    get_filename_component(dir "${dir}" DIRECTORY)
  endif()
  if(NOT EXISTS "${dir}/src/version.h" OR NOT EXISTS "${dir}/src/lammpsplugin.h")
    talus_fail("${dir} is not a LAMMPS source tree: src/version.h or src/lammpsplugin.h is "
      "missing. Set LAMMPS_SOURCE_DIR to an unpacked source of LAMMPS 4 Feb 2025 or newer "
      "(installed headers are not enough).")
  endif()
  set(LAMMPS_SOURCE_DIR "${dir}" PARENT_SCOPE)
  if(LAMMPS_EXECUTABLE)
    return()
  endif()
  get_filename_component(built_from "${HOST_CMAKE_HOME_DIRECTORY}/.." REALPATH)
  get_filename_component(given "${dir}" REALPATH)
  if(NOT built_from STREQUAL given)
    talus_fail("the host in ${LAMMPS_BINARY_DIR} was built from ${built_from}, but "
      "LAMMPS_SOURCE_DIR is ${given}. Give a pair that belongs together.")
  endif()
endfunction()

# "4 Feb 2025" -> 20250204
function(talus_read_version file result)
  file(STRINGS "${file}" line REGEX "define +LAMMPS_VERSION")
  if(NOT line MATCHES "\"([0-9]+ [A-Z][a-z][a-z][a-z]* [0-9]+)\"")
    talus_fail("no version like \"4 Feb 2025\" in ${file}. Is this a LAMMPS source tree?")
  endif()
  if(HOST_VERSION AND NOT HOST_VERSION STREQUAL CMAKE_MATCH_1)
    talus_fail("${TALUS_HOST_LMP} is LAMMPS ${HOST_VERSION}, but the source in ${LAMMPS_SOURCE_DIR} is that of "
      "${CMAKE_MATCH_1}. Give the source of the same release.")
  endif()
  string(REGEX MATCH "([0-9]+) ([A-Z][a-z][a-z])[a-z]* ([0-9]+)" line "${CMAKE_MATCH_1}")
  set(day "${CMAKE_MATCH_1}")
  set(year "${CMAKE_MATCH_3}")
  list(FIND talus_months "${CMAKE_MATCH_2}" month)
  math(EXPR number "${year} * 10000 + (${month} + 1) * 100 + ${day}")
  set(${result} "${number}" PARENT_SCOPE)
endfunction()
set(talus_months Jan Feb Mar Apr May Jun Jul Aug Sep Oct Nov Dec)

# Sets `result` to 1 if a line of a source file of the host matches, else to 0.
function(talus_look_into_host result file regex)
  file(STRINGS "${LAMMPS_SOURCE_DIR}/src/${file}" lines REGEX "${regex}")
  if(lines)
    set(${result} 1 PARENT_SCOPE)
  else()
    set(${result} 0 PARENT_SCOPE)
  endif()
endfunction()

function(talus_check_host_options)
  if(TALUS_LAMMPS_VERSION LESS TALUS_OLDEST_LAMMPS)
    talus_fail("LAMMPS ${TALUS_LAMMPS_VERSION} in ${LAMMPS_SOURCE_DIR} is too old: Talus needs "
      "${TALUS_OLDEST_LAMMPS} (4 Feb 2025) or newer. Give a newer tree, or run scripts/build "
      "without LAMMPS_SOURCE_DIR.")
  endif()
  if(NOT HOST_PKG_PLUGIN)
    talus_fail("the host in ${LAMMPS_BINARY_DIR} has no package PLUGIN and cannot load plugins. "
      "Rebuild it with -D PKG_PLUGIN=on, or run scripts/build. (The packages of Debian 12 and 13 have none.)")
  endif()
  if(NOT HOST_BUILD_MPI)
    talus_fail("the host in ${LAMMPS_BINARY_DIR} was built without MPI. Rebuild it with "
      "-D BUILD_MPI=on, or run scripts/build.")
  endif()
  if(NOT HOST_LAMMPS_SIZES MATCHES "^(smallbig|bigbig)$")
    talus_fail("the host in ${LAMMPS_BINARY_DIR} has integer sizes '${HOST_LAMMPS_SIZES}'; Talus "
      "supports smallbig and bigbig. Rebuild it with -D LAMMPS_SIZES=smallbig.")
  endif()
  if(LAMMPS_SIZES AND NOT LAMMPS_SIZES STREQUAL HOST_LAMMPS_SIZES)
    talus_fail("integer sizes differ: ${LAMMPS_SIZES} was asked for, the host in "
      "${LAMMPS_BINARY_DIR} has ${HOST_LAMMPS_SIZES}. Rebuild the host with "
      "-D LAMMPS_SIZES=${LAMMPS_SIZES}, or drop --sizes.")
  endif()
  if(NOT HOST_PKG_GRANULAR)
    message(WARNING "The host lacks package GRANULAR: Talus works, but without the accelerated "
      "variants of its styles, and most tests will fail.")
  endif()
endfunction()

function(talus_find_host_program)
  set(suffix "")
  if(HOST_LAMMPS_MACHINE)
    set(suffix "_${HOST_LAMMPS_MACHINE}")
  endif()
  set(lmp "${LAMMPS_BINARY_DIR}/lmp${suffix}")
  if(NOT EXISTS "${lmp}")
    talus_fail("the host in ${LAMMPS_BINARY_DIR} is not built: there is no ${lmp}. Build it with "
      "cmake --build ${LAMMPS_BINARY_DIR}, or run scripts/build.")
  endif()
  set(TALUS_HOST_LMP "${lmp}" PARENT_SCOPE)
endfunction()

# Two MPI libraries in one process crash or hang much later, so this is an error right away.
function(talus_check_host_mpi)
  set(ours "")
  foreach(file IN LISTS MPI_CXX_LIBRARIES)
    if(file MATCHES "/libmpi(ch)?\\.(so|dylib)")
      get_filename_component(ours "${file}" REALPATH)
    endif()
  endforeach()
  find_program(TALUS_LDD ldd)
  mark_as_advanced(TALUS_LDD)
  if(NOT TALUS_LDD OR NOT ours)
    return()  # another system: the gate in the plugin still compares handle sizes
  endif()
  execute_process(COMMAND "${TALUS_LDD}" "${TALUS_HOST_LMP}"
    OUTPUT_VARIABLE libraries ERROR_QUIET)
  if(libraries MATCHES "libmpi(ch)?\\.so[^ ]* => ([^\n]+) \\(")
    get_filename_component(theirs "${CMAKE_MATCH_2}" REALPATH)
    if(NOT theirs STREQUAL ours)
      talus_fail("the host in ${LAMMPS_BINARY_DIR} uses another MPI: ${theirs}, while Talus would "
        "be built with ${ours}. Put that host's mpicxx first in PATH, or rebuild the host with "
        "this MPI.")
    endif()
  endif()
endfunction()

talus_input(LAMMPS_SOURCE_DIR PATH "Source tree of the host LAMMPS")
talus_input(LAMMPS_BINARY_DIR PATH "Build directory of the host LAMMPS")
talus_input(LAMMPS_EXECUTABLE STRING "Installed LAMMPS, instead of a build directory")
set(LAMMPS_SIZES "" CACHE STRING "Integer sizes the host must have (default: whatever it has)")
if(LAMMPS_EXECUTABLE)
  talus_ask_host_program()
else()
  talus_read_host_cache()
endif()
talus_find_host_source()
talus_read_version("${LAMMPS_SOURCE_DIR}/src/version.h" TALUS_LAMMPS_VERSION)
talus_check_host_options()
if(NOT LAMMPS_EXECUTABLE)
  talus_find_host_program()
endif()
set(TALUS_HOST_SIZES "${HOST_LAMMPS_SIZES}")
set(TALUS_HOST_OMP "${HOST_BUILD_OMP}")

if(MPI_HEADERS)
  set(MPI_CXX_INCLUDE_DIRS "${MPI_HEADERS}")    # only to compile
else()
  find_package(MPI QUIET COMPONENTS CXX)
endif()
if(NOT MPI_HEADERS AND NOT MPI_CXX_FOUND)
  talus_fail("no MPI found. Install the one the host uses (Debian: libopenmpi-dev) or put its "
    "mpicxx in PATH.")
endif()
talus_check_host_mpi()

# What src/system/host/lammps_compat.h cannot tell from the version alone.
talus_look_into_host(TALUS_HOST_HAS_ATOM2CUT pair.h "virtual double atom2cut")
talus_look_into_host(TALUS_HOST_HAS_RUN_PLUGINS PLUGIN/plugin.cpp "== \"run\"")
talus_look_into_host(TALUS_HOST_TELLS_FORMULAS variable.h "std::string get_info\\(int")
talus_look_into_host(TALUS_HOST_HAS_WALL_CYLINDER GRANULAR/fix_wall_gran.h "cylradius")
talus_look_into_host(TALUS_HOST_DRAWS_GRAN_WALLS GRANULAR/fix_wall_gran.h "imgparms")
talus_look_into_host(TALUS_HOST_SCALES_CLASSIC_SLIP GRANULAR/gran_sub_mod_tangential.cpp
  "-1.0 / \\(k \\* contact_radius\\), history")

set(TALUS_HOST_HAS_GRANULAR 0)
set(talus_granular_headers "")
if(HOST_PKG_GRANULAR)
  set(TALUS_HOST_HAS_GRANULAR 1)  # styles with the suffix talus derive from those of the package
  set(talus_granular_headers "${LAMMPS_SOURCE_DIR}/src/GRANULAR")
endif()

set(TALUS_HOST_HAS_RIGID 0)
set(talus_rigid_headers "")
if(HOST_PKG_RIGID)
  set(TALUS_HOST_HAS_RIGID 1)
  set(talus_rigid_headers "${LAMMPS_SOURCE_DIR}/src/RIGID")
endif()

# Of the styles of package BPM alone: other sources are compiled the same with and without it (TalusStyles.cmake).
set(TALUS_HOST_HAS_BPM 0)
if(HOST_PKG_BPM)
  set(TALUS_HOST_HAS_BPM 1)
endif()
talus_look_into_host(TALUS_HOST_HAS_BOND_FRAMES BPM/bond_bpm_rotational.h "frame_style")
talus_look_into_host(TALUS_HOST_HAS_BOND_STAGES BPM/bond_bpm.h "void pre_compute\\(")
talus_look_into_host(TALUS_HOST_HAS_SPRING_ENERGY BPM/bond_bpm_spring.cpp "ebond = -")
talus_look_into_host(TALUS_HOST_KEEPS_SPRINGS_IN_SETUP BPM/bond_bpm_spring.cpp "setupflag == 0")
talus_look_into_host(TALUS_HOST_FLAGS_SPRING_VOLUMES BPM/bond_bpm_spring.h "vol0_calculated")
set(talus_bond_facts "")
foreach(fact HAS_BOND_FRAMES HAS_BOND_STAGES HAS_SPRING_ENERGY KEEPS_SPRINGS_IN_SETUP FLAGS_SPRING_VOLUMES)
  list(APPEND talus_bond_facts TALUS_HOST_${fact}=${TALUS_HOST_${fact}})
endforeach()

# Headers and definitions only. MPI and LAMMPS come from the process the plugin is loaded into:
# linking our own copies is how two MPI libraries end up in it.
string(TOUPPER "${TALUS_HOST_SIZES}" talus_sizes_upper)
add_library(lammps_host INTERFACE)
target_include_directories(lammps_host SYSTEM INTERFACE
  "${LAMMPS_SOURCE_DIR}/src" ${talus_granular_headers} ${talus_rigid_headers} ${MPI_CXX_INCLUDE_DIRS})
target_compile_definitions(lammps_host INTERFACE
  TALUS_LAMMPS_VERSION=${TALUS_LAMMPS_VERSION}
  TALUS_HOST_HAS_ATOM2CUT=${TALUS_HOST_HAS_ATOM2CUT}
  TALUS_HOST_HAS_RUN_PLUGINS=${TALUS_HOST_HAS_RUN_PLUGINS}
  TALUS_HOST_HAS_GRANULAR=${TALUS_HOST_HAS_GRANULAR}
  TALUS_HOST_HAS_RIGID=${TALUS_HOST_HAS_RIGID}
  TALUS_HOST_TELLS_FORMULAS=${TALUS_HOST_TELLS_FORMULAS}
  TALUS_HOST_HAS_WALL_CYLINDER=${TALUS_HOST_HAS_WALL_CYLINDER}
  TALUS_HOST_DRAWS_GRAN_WALLS=${TALUS_HOST_DRAWS_GRAN_WALLS}
  TALUS_HOST_SCALES_CLASSIC_SLIP=${TALUS_HOST_SCALES_CLASSIC_SLIP}
  LAMMPS_${talus_sizes_upper}
  OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX
  ${MPI_CXX_COMPILE_DEFINITIONS})
target_compile_options(lammps_host INTERFACE ${MPI_CXX_COMPILE_OPTIONS})
if(TALUS_HOST_OMP)
  find_package(OpenMP QUIET COMPONENTS CXX)
  if(NOT OpenMP_CXX_FOUND)
    message(STATUS "${CMAKE_CXX_COMPILER} has no OpenMP: Talus will use one thread per rank")
    set(TALUS_HOST_OMP OFF)
  endif()
endif()
if(TALUS_HOST_OMP)
  target_compile_definitions(lammps_host INTERFACE LAMMPS_OMP_COMPAT=4)
endif()

message(STATUS "Host: LAMMPS ${TALUS_LAMMPS_VERSION} ${TALUS_HOST_SIZES}, ${TALUS_HOST_LMP}")
