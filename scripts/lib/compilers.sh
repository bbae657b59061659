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

# can_be_installed PACKAGE: apt takes a name that it does not have for a pattern, and finds others.
can_be_installed() { apt-cache show "$1" 2>/dev/null | grep -Fx "Package: $1" >/dev/null; }

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
    if can_be_installed "$package" && (install_packages "$package") && have "$compiler" && ! is_default_compiler "$compiler"; then
      printf '%s' "$compiler"
      return
    fi
  done
}

# all_compilers: the oldest and the newest of each kind that are here.
all_compilers() {
  local kind number found
  for kind in g++ clang++; do
    found=()
    for number in {10..40}; do
      if have "$kind-$number"; then found+=("$kind-$number"); fi
    done
    [[ $kind == clang++ ]] && found=($(printf '%s\n' "${found[@]}" | grep -v -e '-1[0-3]$' || true))
    ((${#found[@]} == 0)) || printf '%s\n' "${found[0]}" "${found[-1]}"
  done | awk '!seen[$0]++'
}

# oldest_compiler: of those that know every level of x86-64; that of the build where there is none.
oldest_compiler() {
  local compiler
  for compiler in $(all_compilers) "$(host_compiler)"; do
    if knows_level "$compiler" x86-64-v4; then break; fi
  done
  printf '%s' "$compiler"
}

# compile_core NAME TITLE "TARGETS" [options of CMake]: in build-NAME; all targets where none is named.
compile_core() {
  local title=$2 dir=$TALUS_ROOT/build-$1 targets cache
  read -ra targets <<<"$3"
  shift 3
  note "== $title =="
  mapfile -t cache < <(compiler_cache_options)
  mkdir -p "$dir"
  cmake -S "$TALUS_ROOT" -B "$dir" -G "$(generator)" -D TALUS_CORE_ONLY=ON -D "TALUS_WERROR=$(warnings_are_errors)" \
    "${cache[@]}" "$@" >"$dir/configure.log" 2>&1 || {
    grep -A 6 'CMake Error' "$dir/configure.log" | head -n 20 >&2
    note "$title: could not be configured; all of it is in $dir/configure.log"
    return 1
  }
  show_build "building, $title" "$dir" "$dir/build.log" "${targets[@]}" || {
    grep -E -A 12 'FAILED|error:' "$dir/build.log" | head -n 40 >&2
    note "$title: could not be built; all of it is in $dir/build.log"
    return 1
  }
}

# core_only NAME TITLE [options of CMake]: the same, and run its tests.
core_only() {
  local name=$1 title=$2
  shift 2
  compile_core "$name" "$title" '' "$@" && run_ctest "$TALUS_ROOT/build-$name"
}

# The levels of x86-64 (psABI), each of which contains those before it; compilers optimize differently for each, and warn of
# other things.
TALUS_LEVELS=(x86-64 x86-64-v2 x86-64-v3 x86-64-v4)

# level_of_build: the highest level that the code of the build contains.
level_of_build() {
  local macros level=0
  macros=$("$(host_compiler)" "-march=${TALUS_ARCH:-native}" -x c++ -dM -E - </dev/null 2>/dev/null)
  if [[ $macros == *__SSE4_2__* ]]; then level=1; fi
  if [[ $macros == *__AVX2__* && $macros == *__FMA__* ]]; then level=2; fi
  if [[ $macros == *__AVX512VL__* && $macros == *__AVX512BW__* ]]; then level=3; fi
  printf '%s' "${TALUS_LEVELS[level]}"
}

# can_run LEVEL: this machine, by what its kernel says.
can_run() {
  local flags
  flags=" $(sed -n '/^flags/{s/.*: //p;q}' /proc/cpuinfo 2>/dev/null) "
  case $1 in
    native | x86-64) return 0 ;;
    x86-64-v2) [[ $flags == *' sse4_2 '* ]] ;;
    x86-64-v3) [[ $flags == *' avx2 '* && $flags == *' fma '* ]] ;;
    x86-64-v4) [[ $flags == *' avx512vl '* && $flags == *' avx512bw '* ]] ;;
  esac
}

knows_level() { "$1" "-march=$2" -x c++ -E - </dev/null >/dev/null 2>&1; }

# other_level COMPILER: not that of the build: what users' machines have and this one may not. Plain x86-64 for a compiler
# that does not know the levels.
other_level() {
  local level=x86-64-v3
  [[ $(level_of_build) != "$level" ]] || level=x86-64-v4
  knows_level "$1" "$level" || level=x86-64
  printf '%s' "$level"
}

# Little optimization: vectors and rounding are the same, and the time is half.
TALUS_CHECK=(-D CMAKE_BUILD_TYPE=Check -D CMAKE_CXX_FLAGS_CHECK=-O1)

# with_compiler COMPILER LEVEL [options of CMake]: unit tests for a level, or "native"; compiled only where this machine
# cannot run them.
with_compiler() {
  local compiler=$1 level=$2 name=$1 options
  shift 2
  options=("${TALUS_CHECK[@]}" -D "CMAKE_CXX_COMPILER=$compiler" -D "TALUS_ARCH=$level" "$@")
  [[ $level == native ]] || name+=-$level
  if [[ $level != native ]] && ! knows_level "$compiler" "$level"; then
    note "left out: $compiler for $level, which it does not know"
  elif can_run "$level"; then
    core_only "$name" "unit tests with $compiler for $level" "${options[@]}"
  else
    compile_core "$name" "$compiler for $level, which this machine cannot run: compiled" '' "${options[@]}"
  fi
}

# Unit tests of what must have the same bits everywhere.
TALUS_BITS_TESTS='same_everywhere_test;all_laws_bits_test'

# bits_with COMPILER LEVEL [options of CMake]: the core, and these tests.
bits_with() { with_compiler "$1" "$2" -D LAMMPS_BINARY_DIR= -D "TALUS_UNIT_TESTS=$TALUS_BITS_TESTS" "${@:3}"; }

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
