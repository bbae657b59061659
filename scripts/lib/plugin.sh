# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# shellcheck shell=bash
# The build of Talus itself, against the host that prepare_host has made ready.

# What to build, as targets of CMake: the plugin, unless a script needs something else.
read -ra TALUS_TARGETS <<<"${TALUS_TARGETS:-}"

# show_build TITLE DIR LOG [TARGET...]: run Ninja with a display of its progress; the log keeps
# everything.
show_build() {
  local title=$1 dir=$2 log=$3
  shift 3
  NINJA_STATUS='[%f/%t] ' build_with "$dir" "$@" 2>&1 </dev/null | tee "$log" | show_progress "$title"
}

build_with() {
  local dir=$1 tool=make
  shift
  if [[ -f $dir/build.ninja || ! -f $dir/Makefile ]]; then tool=ninja; fi
  "$tool" -C "$dir" -j "$(number_of_cores)" "$@"
}

show_progress() {
  if have python3; then
    python3 "$TALUS_LIB/progress.py" build "$1"
  else
    note "$1"
    cat >/dev/null
  fi
}

# CMake wraps messages and adds a stack of its own files: show only ours, on one line.
explain_configure() {
  local log=$1 text
  text=$(awk '/^ *talus: / { on = 1 } on && (NF == 0 || /^Call Stack/) { exit } on { $1 = $1; printf "%s ", $0 }' "$log")
  if [[ -n $text ]]; then
    die "${text#talus: }"
  fi
  grep -A 8 'CMake Error' "$log" | head -n 20 >&2
  die "Talus could not be configured; all of it is in $log"
}

# developer_options: for CMake. Without TALUS_TESTS or TALUS_BENCHMARKS nothing is said, so that scripts/build and
# scripts/run leave a build directory of scripts/test as it is, and compile only what has changed.
developer_options() {
  if [[ -n ${TALUS_TESTS:-} ]]; then
    printf -- '-D\n%s\n' TALUS_TESTS=ON "TALUS_WERROR=$(warnings_are_errors)"
    compiler_cache_options
  fi
  if [[ -n ${TALUS_TESTS:-}${TALUS_BENCHMARKS:-} ]]; then printf -- '-D\n%s\n' TALUS_BENCHMARKS=ON; fi
}

# warnings_are_errors: ON where we check ourselves. A user whose compiler sees more than ours is told of it at the end
# (show_warnings), and has his tests.
warnings_are_errors() { if [[ ${CI:-} == true || -n ${TALUS_STRICT:-} ]]; then echo ON; else echo OFF; fi; }

# show_warnings SINCE: those of our code in the logs of builds that are newer than that file.
show_warnings() {
  local logs warnings
  mapfile -t logs < <(find "$TALUS_ROOT" -maxdepth 2 -path "$TALUS_ROOT/build*/build.log" -newer "$1")
  ((${#logs[@]})) || return 0
  mapfile -t warnings < <(grep -hE '^[^ ]*(src|tests|bench)/.* warning: ' "${logs[@]}" | sed 's|^[./]*||' | sort -u)
  ((${#warnings[@]})) || return 0
  note "the compiler warns in ${#warnings[@]} places, which fails no test; a bug report with these lines is welcome:"
  printf '%s\n' "${warnings[@]:0:20}" >&2
}

# compiler_cache_options: what one clone has compiled, none compiles again.
compiler_cache_options() {
  if have ccache; then printf -- '-D\n%s\n' CMAKE_CXX_COMPILER_LAUNCHER=ccache; fi
}

# use_compiler_cache: precompiled headers need the sloppiness (manual of ccache, "Precompiled headers").
use_compiler_cache() {
  export CCACHE_DIR=${CCACHE_DIR:-$(cache_dir)/ccache} CCACHE_BASEDIR=$TALUS_ROOT CCACHE_NOHASHDIR=1
  export CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
}

configure_talus() {
  local dir=$1 sizes=$2 kind=$3 sanitizers='' portable=OFF more
  read -ra more <<<"${TALUS_CMAKE_OPTIONS:-}"
  mapfile -t -O "${#more[@]}" more < <(mpi_options; developer_options)
  if [[ $kind == sanitize ]]; then sanitizers='address;undefined'; fi
  if [[ $kind == portable ]]; then portable=ON; fi
  mkdir -p "$dir"
  cmake -S "$TALUS_ROOT" -B "$dir" -G "$(generator)" \
    -D "LAMMPS_BINARY_DIR=$HOST_BINARY" -D "LAMMPS_SOURCE_DIR=$HOST_SOURCE" \
    -D "LAMMPS_SIZES=$sizes" -D "TALUS_SANITIZE=$sanitizers" \
    "${more[@]}" -D "TALUS_PORTABLE=$portable" -D "TALUS_ARCH=${TALUS_ARCH:-native}" \
    -D "CMAKE_CXX_COMPILER=$(host_compiler)" >"$dir/configure.log" 2>&1 ||
    explain_configure "$dir/configure.log"
}

compile_talus() {
  local dir=$1 log=$1/build.log
  configure_talus "$@"
  show_build "building Talus" "$dir" "$log" "${TALUS_TARGETS[@]}" || {
    grep -E -A 12 'FAILED|error:' "$log" | head -n 60 >&2
    die "Talus could not be built; all of it is in $log"
  }
}

# build_directory HOST SIZES KIND: build/ belongs to the default, others are told apart. KIND is empty, sanitize or
# portable.
build_directory() {
  local host=$1 sizes=$2 kind=$3 name=build
  if [[ -n ${TALUS_BUILD_DIR:-} ]]; then
    printf '%s' "$TALUS_BUILD_DIR"
    return
  fi
  if [[ -d $host ]]; then
    host=own-$(basename "$(cd "$host" && pwd)")
  fi
  if [[ ${host:-$TALUS_DEFAULT_HOST} != "$TALUS_DEFAULT_HOST" || ${sizes:-smallbig} != smallbig ]]; then
    name+=-${host:-$TALUS_DEFAULT_HOST}-${sizes:-smallbig}
  fi
  printf '%s/%s%s' "$TALUS_ROOT" "$name" "${kind:+-$kind}"
}

# A host that the scripts build for a portable plugin is portable as well. Errors come before minutes go into it.
choose_architecture() {
  [[ $1 == portable ]] || return 0
  [[ $(uname -m) == x86_64 ]] || die "--portable is for x86-64 machines, and this is $(uname -m): drop --portable"
  "$(host_compiler)" -march=x86-64-v4 -x c++ -E - </dev/null >/dev/null 2>&1 ||
    die "$(host_compiler) does not know -march=x86-64-v4: --portable needs GCC 11, Clang 12 or newer; set CXX"
  [[ -z ${TALUS_ARCH:-} || $TALUS_ARCH == x86-64 ]] ||
    die "TALUS_ARCH=$TALUS_ARCH is set, but --portable is for any x86-64 machine: unset TALUS_ARCH, or drop --portable"
  TALUS_ARCH=x86-64
}

# build_talus HOST SIZES KIND [DIR]: everything, from the packages on. Sets TALUS_BUILD.
build_talus() {
  local host=$1 sizes=$2 kind=$3
  ensure_packages
  check_tools
  choose_architecture "$kind"
  prepare_host "$host" "$sizes"
  TALUS_BUILD=${4:-$(build_directory "$host" "$sizes" "$kind")}
  with_lock "$TALUS_BUILD/lock" compile_talus "$TALUS_BUILD" "$sizes" "$kind"
}
