# Talus: granular dynamics for LAMMPS, GPL-2.0, see LICENSE
# shellcheck shell=bash
# Systems that packages run on: versions of symbols that their libraries have (glibc; libstdc++, libgcc and libgomp of their
# GCC), and their packages with the libraries that a program may need.

TALUS_SYSTEMS="system GLIBC GLIBCXX CXXABI GCC GOMP OMP
Debian-12 2.36 3.4.30 1.3.13 12.0.0 5.1 5.1
Debian-13 2.41 3.4.33 1.3.15 14.0.0 5.1.2 5.2
Ubuntu-22.04 2.35 3.4.30 1.3.13 12.0.0 5.1 5.1
Ubuntu-24.04 2.39 3.4.33 1.3.15 14.0.0 5.1.2 5.2"

# library, what Depends says; the names are those of all systems. Open MPI 4 and 5 have the same libmpi.so.40, and need
# their daemon also for one rank.
TALUS_LIBRARIES="libc.so.6 libc6 (>= @GLIBC@)
libm.so.6 libc6 (>= @GLIBC@)
ld-linux-x86-64.so.2 libc6 (>= @GLIBC@)
libstdc++.so.6 libstdc++6 (>= @GNU@)
libgcc_s.so.1 libgcc-s1
libgomp.so.1 libgomp1
libmpi.so.40 libopenmpi3 | libopenmpi3t64 | libopenmpi40, openmpi-bin
libpng16.so.16 libpng16-16 | libpng16-16t64
libz.so.1 zlib1g
libccd.so.2 libccd2"

# those of a system that may be missing, have no versions of their own and are free to copy: an archive brings them
TALUS_BROUGHT=(libpng16.so.16 libccd.so.2)

# needed_versions FILE...: "GLIBC 2.34", the newest of each kind of symbols.
needed_versions() {
  objdump -T "$@" | sed -nE 's/.*\*UND\*.*[ (]([A-Z]+)_([0-9.]+)\)? .*/\1 \2/p' | sort -k1,1 -k2,2V |
    awk '{ newest[$1] = $2 } END { for (kind in newest) print kind, newest[kind] }' | sort
}

# needed_libraries FILE...: those that are not among them.
needed_libraries() {
  objdump -p "$@" | awk '$1 == "NEEDED" { print $2 }' | sort -u | grep -vxFf <(printf '%s\n' "${@##*/}")
}

# too_old SYSTEM FILE...: "GLIBC 2.35" that this system has where the files need a newer one; nothing if they run there.
too_old() {
  local system=$1 kind needed has
  shift
  while read -r kind needed; do
    has=$(awk -v name="$system" -v kind="$kind" 'NR == 1 { for (k = 2; k <= NF; ++k) if ($k == kind) column = k }
      $1 == name && column { print $column }' <<<"$TALUS_SYSTEMS")
    [[ $(printf '%s\n' "$needed" "${has:-0}" | sort -V | tail -n 1) == "${has:-0}" ]] ||
      printf '%s %s instead of %s\n' "$kind" "${has:-none}" "$needed"
  done < <(needed_versions "$@")
}

# gnu_of GLIBCXX: the first GCC whose libstdc++ has these symbols.
gnu_of() {
  local minor=${1##*.}
  if ((minor <= 30)); then echo $((minor - 18)); elif ((minor <= 32)); then echo 13; else echo $((minor - 19)); fi
}

# depends_on FILE...: the line Depends of a Debian package.
depends_on() {
  local versions library rule rules=()
  versions=$(needed_versions "$@")
  while read -r library; do
    rule=$(awk -v library="$library" '$1 == library { $1 = ""; print substr($0, 2) }' <<<"$TALUS_LIBRARIES")
    [[ $rule ]] || die "packages need $library, of which scripts/lib/systems.sh does not know the package"
    rules+=("$rule")
  done < <(needed_libraries "$@")
  printf '%s\n' "${rules[@]}" | sort -u | sed "s/@GLIBC@/$(awk '$1 == "GLIBC" { print $2 }' <<<"$versions")/
    s/@GNU@/$(gnu_of "$(awk '$1 == "GLIBCXX" { print $2 }' <<<"$versions")")/" | paste -sd , | sed 's/,\([^ ]\)/, \1/g'
}
