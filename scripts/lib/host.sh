# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# shellcheck shell=bash
# The host: which LAMMPS, where it is cached, and its build. After prepare_host:
#   HOST_SOURCE  source tree      HOST_BINARY  build directory with lmp

# name, version of Debian's source package, suite that has it, packages that only it has
TALUS_HOSTS="4Feb2025 20250204+dfsg.1 trixie
4Jul2026 20260704+dfsg forky GRAPHICS"
TALUS_DEFAULT_HOST=4Feb2025

TALUS_HOST_PACKAGES=(GRANULAR MOLECULE RIGID OPENMP PLUGIN EXTRA-FIX EXTRA-COMPUTE DIPOLE BPM)

# GRAPHICS has `dump image` in newer versions; older ones have it in the core.
packages_of_tree() { if [[ -d $1/src/GRAPHICS ]]; then echo GRAPHICS; fi; }

host_field() { awk -v name="$1" -v field="$2" '$1 == name { print $field }' <<<"$TALUS_HOSTS"; }

host_names() { awk '{ printf "%s%s", sep, $1; sep = ", " }' <<<"$TALUS_HOSTS"; }

# "4 Feb 2025" of version.h -> 20250204
tree_version() {
  awk -F'"' '/LAMMPS_VERSION/ {
    split($2, d, " ")
    month = (index("JanFebMarAprMayJunJulAugSepOctNovDec", substr(d[2], 1, 3)) + 2) / 3
    printf "%04d%02d%02d\n", d[3], month, d[1] }' "$1/src/version.h"
}

# The top of a tree, given that or its src folder.
tree_top() {
  local dir
  dir=$(cd "$1" 2>/dev/null && pwd) || die "no such directory: $1. --host takes $(host_names), a LAMMPS source tree or a LAMMPS build directory"
  [[ -f $dir/version.h && ! -d $dir/src ]] && dir=$(dirname "$dir")
  [[ -f $dir/src/version.h && -f $dir/cmake/CMakeLists.txt ]] ||
    die "$dir is not a LAMMPS source tree (no src/version.h and cmake/CMakeLists.txt); give an unpacked source of LAMMPS 4 Feb 2025 or newer"
  printf '%s\n' "$dir"
}

# Before minutes go into a build that cannot be used.
check_tree_age() {
  local version
  version=$(tree_version "$1")
  ((version >= 20250204)) ||
    die "LAMMPS $version in $1 is too old: Talus needs 4 Feb 2025 or newer. Give a newer tree, or use --host $TALUS_DEFAULT_HOST"
}

host_compiler() { printf '%s' "${CXX:-g++}"; }

# The MPI, by its compiler: MPICXX, where a machine has several.
mpi_compiler() { printf '%s' "${MPICXX:-mpicxx}"; }

# mpi_options: for CMake, where another MPI than the first one was asked for.
mpi_options() {
  [[ -n ${MPICXX:-} ]] || return 0
  printf -- '-D\n%s\n' "MPI_CXX_COMPILER=$(command -v "$MPICXX")"
  local launcher=${MPICXX/mpicxx/mpiexec}
  if have "$launcher"; then printf -- '-D\n%s\n' "MPIEXEC_EXECUTABLE=$(command -v "$launcher")"; fi
}

# check_compiler: before minutes go into a build that cannot be used.
check_compiler() {
  local compiler macros clang gnu
  compiler=$(host_compiler)
  have "$compiler" || die "there is no compiler '$compiler': install it (Debian: g++), or set CXX to another one (GCC 10, Clang 14 or newer)"
  macros=$("$compiler" -x c++ -dM -E - </dev/null 2>/dev/null) || return 0
  clang=$(awk '$2 == "__clang_major__" { print $3 }' <<<"$macros")
  gnu=$(awk '$2 == "__GNUC__" { print $3 }' <<<"$macros")
  if [[ -n $clang ]]; then
    ((clang >= 14)) || die "$compiler is Clang $clang, which is too old: set CXX to Clang 14, GCC 10 or newer"
  elif [[ -n $gnu ]]; then
    ((gnu >= 10)) || die "$compiler is GCC $gnu, which is too old: set CXX to GCC 10, Clang 14 or newer (on a cluster: module load gcc)"
  fi
}

# check_tools: what no package manager has brought.
check_tools() {
  have cmake || die "there is no cmake: install CMake 3.22 or newer (doc/install.md)"
  have ninja || have make || die "there is neither ninja nor make: install one of them"
  check_compiler
  have "$(mpi_compiler)" ||
    die "no MPI: there is no $(mpi_compiler). Install one (Debian: libopenmpi-dev openmpi-bin), load its module, or set MPICXX to its C++ compiler"
}

generator() { if have ninja; then printf Ninja; else printf 'Unix Makefiles'; fi; }

has_png() { "$(host_compiler)" -x c++ -E - <<<'#include <png.h>' >/dev/null 2>&1; }

# host_options SIZES [PACKAGE]: all that makes one build of the host different from another.
host_options() {
  local sizes=$1 arch=${TALUS_ARCH:-native} package png=on
  has_png || png=off
  printf -- '-D\n%s\n' CMAKE_BUILD_TYPE=Release "CMAKE_CXX_COMPILER=$(host_compiler)" \
    "CMAKE_CXX_FLAGS_RELEASE=-O3 -DNDEBUG -march=$arch" "LAMMPS_SIZES=$sizes" \
    BUILD_SHARED_LIBS=on BUILD_MPI=on BUILD_OMP=on BUILD_TOOLS=off \
    "WITH_PNG=$png" WITH_JPEG=off WITH_FFMPEG=off WITH_CURL=off \
    DOWNLOAD_POTENTIALS=off FETCHCONTENT_FULLY_DISCONNECTED=on
  for package in "${TALUS_HOST_PACKAGES[@]}" ${2:+"$2"}; do
    printf -- '-D\nPKG_%s=on\n' "$package"
  done
  mpi_options
}

# host_key SIZES PACKAGE TREE: "native" means another thing on every machine, and a home directory
# may be shared.
host_key() {
  {
    host_options "$1" "$2"
    printf '%s\n' "$3"
    "$(host_compiler)" --version | head -n 1
    "$(host_compiler)" "-march=${TALUS_ARCH:-native}" -Q --help=target 2>/dev/null
    mpirun --version 2>/dev/null | head -n 1
  } | sha256sum | cut -c1-10
}

# stamp_is_good DIR: the stamp is written last, so without it DIR holds an interrupted attempt.
stamp_is_good() {
  [[ -f $1/stamp && -x $1/build/lmp && -e $1/build/liblammps.so ]]
}

run_host_build() {
  local source=$1 dir=$2 sizes=$3 options
  mapfile -t options < <(host_options "$sizes" "$(packages_of_tree "$source")")
  note "configuring LAMMPS $(tree_version "$source") ($sizes)"
  cmake -S "$source/cmake" -B "$dir/build" -G "$(generator)" "${options[@]}" \
    -D "CMAKE_PROJECT_lammps_INCLUDE=$TALUS_ROOT/cmake/HostHeaders.cmake" >"$dir/configure.log" 2>&1 || {
    grep -A 6 'CMake Error' "$dir/configure.log" | head -n 20 >&2
    die "the host could not be configured; all of it is in $dir/configure.log"
  }
  show_build "building LAMMPS, once per machine" "$dir/build" "$dir/build.log" ||
    die "the host could not be built; all of it is in $dir/build.log. Run the command again to go on from there"
}

# Objects are 20 times as large as the library and never needed again.
prune_host_build() {
  rm -rf "$1"/build/{CMakeFiles,.ninja_log,.ninja_deps,build.ninja,cmake_install.cmake}
}

finish_host() {
  local dir=$1 source=$2 sizes=$3
  prune_host_build "$dir"
  host_options "$sizes" "$(packages_of_tree "$source")" | grep -v '^-D$' >"$dir/stamp.new"
  mv "$dir/stamp.new" "$dir/stamp"
  note "host ready: $dir"
}

# build_released_host NAME SIZES DIR
build_released_host() {
  local name=$1 sizes=$2 dir=$3
  stamp_is_good "$dir" && return
  [[ -d $dir ]] && note "an earlier build of this host was interrupted: doing what is left"
  rm -f "$dir/stamp"
  mkdir -p "$dir"
  if [[ ! -f $dir/src.stamp ]]; then
    rm -rf "$dir"/{src,download,build}
    download_source "$(host_field "$name" 2)" "$(host_field "$name" 3)" "$dir/download"
    note "unpacking"
    unpack_source "$(ls "$dir"/download/lammps_*.orig.tar.*)" "$dir/src"
    rm -rf "$dir/download"
    touch "$dir/src.stamp"
  fi
  run_host_build "$dir/src" "$dir" "$sizes"
  finish_host "$dir" "$dir/src" "$sizes"
}

# want_inputs: the next host that is prepared shall have the inputs for grains of its LAMMPS. Sources
# that are unpacked now have them; without a network those that were unpacked without stay so.
want_inputs() { export TALUS_INPUTS=1; }

# complete_released_host NAME DIR
complete_released_host() {
  has_inputs "$2/src" && return
  note "the source of LAMMPS in $2 was unpacked without its inputs for grains: getting them"
  with_lock "$2.lock" download_inputs "$(host_field "$1" 2)" "$(host_field "$1" 3)" "$2/src" ||
    note "left out: what runs the inputs for grains of LAMMPS $1, which could not be fetched (see above)." \
      "Run the command again with a network"
}

# A tree of the user's may change at any time: its build is brought up to date on every call.
build_users_host() {
  local source=$1 sizes=$2 dir=$3
  mkdir -p "$dir"
  run_host_build "$source" "$dir" "$sizes"
}

released_host_dir() {
  printf '%s/host-%s-%s-%s' "$(cache_dir)" "$1" "$2" "$(host_key "$2" "$(host_field "$1" 4)" '')"
}

users_host_dir() {
  printf '%s/host-%s-%s-%s' "$(cache_dir)" "$(tree_version "$1")" "$2" \
    "$(host_key "$2" "$(packages_of_tree "$1")" "$1")"
}

is_build_directory() { [[ -f $1/CMakeCache.txt ]] && grep -q '^LAMMPS_SIZES:' "$1/CMakeCache.txt"; }

use_users_build() {
  HOST_BINARY=$(cd "$1" && pwd)
  HOST_SOURCE=${LAMMPS_SOURCE_DIR:-}
}

use_users_tree() {
  local dir sizes=${2:-smallbig}
  HOST_SOURCE=$(tree_top "$1") || exit 1
  check_tree_age "$HOST_SOURCE"
  dir=$(users_host_dir "$HOST_SOURCE" "$sizes")
  with_lock "$dir.lock" build_users_host "$HOST_SOURCE" "$sizes" "$dir"
  HOST_BINARY=$dir/build
}

use_released_host() {
  local dir sizes=${2:-smallbig}
  dir=$(released_host_dir "$1" "$sizes")
  stamp_is_good "$dir" || with_lock "$dir.lock" build_released_host "$1" "$sizes" "$dir"
  [[ -z ${TALUS_INPUTS:-} ]] || complete_released_host "$1" "$dir"
  HOST_SOURCE=$dir/src
  HOST_BINARY=$dir/build
}

# prepare_host [NAME or DIR or empty] [SIZES or empty]
prepare_host() {
  local host=$1 sizes=$2
  if [[ -z $host && -n ${LAMMPS_BINARY_DIR:-} ]]; then
    use_users_build "$LAMMPS_BINARY_DIR"
  elif [[ -z $host && -n ${LAMMPS_SOURCE_DIR:-} ]]; then
    use_users_tree "$LAMMPS_SOURCE_DIR" "$sizes"
  elif [[ -n $(host_field "${host:-$TALUS_DEFAULT_HOST}" 1) ]]; then
    use_released_host "${host:-$TALUS_DEFAULT_HOST}" "$sizes"
  elif is_build_directory "$host"; then
    LAMMPS_SOURCE_DIR='' use_users_build "$host"
  else
    use_users_tree "$host" "$sizes"
  fi
}
