# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# shellcheck shell=bash
# Other compilers and processors than those of the build: the code that needs no LAMMPS, with its unit tests, whose
# digests must be the same everywhere (tests/unit/same_everywhere_test.cpp). See cmake/TalusCoreOnly.cmake.

TALUS_OLD_COMPILERS=(g++-10 g++-11 clang++-14 clang++-15 g++-12 clang++)
TALUS_ARM_PACKAGES=(g++-aarch64-linux-gnu qemu-user googletest)

# package_of COMPILER: clang++-14 is in clang-14.
package_of() { printf '%s' "${1/clang++/clang}"; }

# kind_and_version COMPILER: the first line but for the name by which it was called.
kind_and_version() { "$1" --version | sed -n '1s/^\(g++\|c++\)[^ ]* //;1p'; }

is_default_compiler() { [[ $(kind_and_version "$1") == "$(kind_and_version "$(host_compiler)")" ]]; }

# other_compiler: one that is older than usual and not that of the build; the first that is there, else the first that
# can be installed. Nothing if there is none.
other_compiler() {
  local compiler package
  for compiler in "${TALUS_OLD_COMPILERS[@]}"; do
    if have "$compiler" && ! is_default_compiler "$compiler"; then
      printf '%s' "$compiler"
      return
    fi
  done
  [[ -z ${TALUS_SKIP_PACKAGES:-} ]] && have apt-cache || return 0
  for compiler in "${TALUS_OLD_COMPILERS[@]}"; do
    package=$(package_of "$compiler")
    if apt-cache show "$package" >/dev/null 2>&1 && (install_packages "$package") && ! is_default_compiler "$compiler"; then
      printf '%s' "$compiler"
      return
    fi
  done
}

# all_compilers: the oldest and the newest of each kind that are here, but that of the build.
all_compilers() {
  local kind number found
  for kind in g++ clang++; do
    found=()
    for number in {10..40}; do
      if have "$kind-$number" && ! is_default_compiler "$kind-$number"; then found+=("$kind-$number"); fi
    done
    [[ $kind == clang++ ]] && found=($(printf '%s\n' "${found[@]}" | grep -v -e '-1[0-3]$' || true))
    ((${#found[@]} == 0)) || printf '%s\n' "${found[0]}" "${found[-1]}"
  done | awk '!seen[$0]++'
}

# core_only NAME TITLE [options of CMake]: build it in build-NAME and run its tests.
core_only() {
  local name=$1 title=$2 dir=$TALUS_ROOT/build-$1
  shift 2
  note "== $title =="
  local cache
  mapfile -t cache < <(compiler_cache_options)
  mkdir -p "$dir"
  cmake -S "$TALUS_ROOT" -B "$dir" -G "$(generator)" -D TALUS_CORE_ONLY=ON -D TALUS_WERROR=ON "${cache[@]}" "$@" >"$dir/configure.log" 2>&1 || {
    grep -A 6 'CMake Error' "$dir/configure.log" | head -n 20 >&2
    note "$title: could not be configured; all of it is in $dir/configure.log"
    return 1
  }
  show_build "building, $title" "$dir" "$dir/build.log" || {
    grep -E -A 12 'FAILED|error:' "$dir/build.log" | head -n 40 >&2
    note "$title: could not be built; all of it is in $dir/build.log"
    return 1
  }
  run_ctest "$dir"
}

# Little optimization: vectors and rounding are the same, and the time is half.
TALUS_CHECK=(-D CMAKE_BUILD_TYPE=Check -D CMAKE_CXX_FLAGS_CHECK=-O1)

# with_compiler COMPILER [options of CMake]
with_compiler() {
  local compiler=$1
  shift
  core_only "$compiler" "unit tests with $compiler" "${TALUS_CHECK[@]}" -D "CMAKE_CXX_COMPILER=$compiler" "$@"
}

# Folder of mpi.h, for compilers without an MPI of their own.
mpi_headers() {
  local word
  for word in $(mpicxx -show 2>/dev/null); do
    if [[ -f ${word#-I}/mpi.h ]]; then
      printf '%s' "${word#-I}"
      return
    fi
  done
}

# Once without precompiled headers is enough.
TALUS_PRECOMPILE=(-D CMAKE_DISABLE_PRECOMPILE_HEADERS=OFF)

# with_arm [options of CMake]: with a cross-compiler, the tests in an emulator.
with_arm() {
  core_only aarch64 "aarch64, unit tests in an emulator" "${TALUS_CHECK[@]}" \
    -D CMAKE_SYSTEM_NAME=Linux -D CMAKE_SYSTEM_PROCESSOR=aarch64 -D CMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ \
    -D "CMAKE_CROSSCOMPILING_EMULATOR=qemu-aarch64;-L;/usr/aarch64-linux-gnu" \
    -D CMAKE_DISABLE_FIND_PACKAGE_ccd=ON -D "MPI_HEADERS=$(mpi_headers)" "$@"
}

# With Clang, whose OpenMP library tells the sanitizer what its barriers order.
thread_sanitizer() {
  core_only tsan "thread sanitizer" -D CMAKE_CXX_COMPILER=clang++ -D TALUS_SANITIZE=thread \
    -D CMAKE_BUILD_TYPE=Check -D "CMAKE_CXX_FLAGS_CHECK=-O1 -g" "$@"
}
