# Flags of our own code, as target talus_flags: the same for every source, so that an inline
# function gives the same bits wherever it is compiled. A portable build has more such targets, which
# differ in nothing but the instruction set.

include(CheckCXXCompilerFlag)
include(CheckCXXSourceCompiles)

add_library(talus_common_flags INTERFACE)

# Same as the host's: comparisons with the stock styles are comparisons of code, not of flags.
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")

# talus_add_known_flags(target flags...): those that the compiler knows; the others do no harm where they are missing.
function(talus_add_known_flags target)
  foreach(flag IN LISTS ARGN)
    # GCC takes any -Wno-... and speaks of it only beside other warnings
    string(REGEX REPLACE "^-Wno-(error=)?" "-W" positive "${flag}")
    string(MAKE_C_IDENTIFIER "TALUS_HAS${positive}" known)
    check_cxx_compiler_flag("${positive}" ${known})
    if(${known})
      target_compile_options(${target} INTERFACE ${flag})
    endif()
  endforeach()
endfunction()

# One trajectory on any number of ranks and threads, on any processor: the same contact is computed in more than one
# place, by vector code here and perhaps by other vector code there. Contraction to fused multiply-add is the compiler's
# free choice in each place and would give different bits. GCC (12 at least) makes fused ones of sums beside differences
# of products, whatever -ffp-contract says, where it packs statements of a source into vectors: it packs none.
# tests/cli/test_fused_arithmetic.py looks for fused instructions in all objects.
target_compile_options(talus_common_flags INTERFACE -ffp-contract=off -fno-math-errno -fno-trapping-math)
talus_add_known_flags(talus_common_flags -fopenmp-simd -fno-tree-slp-vectorize)

target_compile_definitions(talus_common_flags INTERFACE TALUS_VERSION_MAJOR=${PROJECT_VERSION_MAJOR}
  TALUS_VERSION_MINOR=${PROJECT_VERSION_MINOR} TALUS_VERSION_PATCH=${PROJECT_VERSION_PATCH})

# Eigen's own vector code fuses multiplication and addition where the processor can, whatever the compiler was told:
# the motion of a body would depend on the instruction set. Without it types are laid out the same everywhere, too.
target_compile_definitions(talus_common_flags INTERFACE EIGEN_DONT_VECTORIZE EIGEN_MAX_ALIGN_BYTES=0)

# talus_find_arch(arch result): the flag of code for that processor. A compiler that does not know the word makes code for
# any processor of its kind, which is slower but right.
function(talus_find_arch arch result)
  set(flag "")
  if(arch)
    set(flag "-march=${arch}")
    string(MAKE_C_IDENTIFIER "TALUS_HAS_ARCH_${arch}" known)
    check_cxx_compiler_flag("${flag}" ${known})
    if(NOT ${known} AND TALUS_PORTABLE)
      message(FATAL_ERROR "talus: ${CMAKE_CXX_COMPILER} does not know ${flag}, which --portable needs: use GCC 11, Clang 12 "
        "or newer ones, on x86-64; or drop --portable.")
    elseif(NOT ${known})
      message(STATUS "TALUS_ARCH: ${CMAKE_CXX_COMPILER} does not know ${flag}: code for any ${CMAKE_SYSTEM_PROCESSOR}")
      set(flag "")
    endif()
  endif()
  set(${result} "${flag}" PARENT_SCOPE)
endfunction()

# talus_add_flags(target arch): a target with the common flags and those for code at -march=arch.
function(talus_add_flags target arch)
  talus_find_arch("${arch}" options)
  # Compilers prefer 256-bit vectors even where 512-bit ones are faster for the batch kernel.
  set(CMAKE_REQUIRED_FLAGS "${options}")
  string(MAKE_C_IDENTIFIER "TALUS_HAS_AVX512_${arch}" has_avx512)
  check_cxx_source_compiles("
    #ifndef __AVX512F__
    #error no AVX-512
    #endif
    int main() { return 0; }" ${has_avx512})
  unset(CMAKE_REQUIRED_FLAGS)
  check_cxx_compiler_flag(-mprefer-vector-width=512 TALUS_HAS_VECTOR_WIDTH_FLAG)
  if(${has_avx512} AND TALUS_HAS_VECTOR_WIDTH_FLAG)
    list(APPEND options -mprefer-vector-width=512)
  endif()
  add_library(${target} INTERFACE)
  target_compile_options(${target} INTERFACE ${options})
  target_link_libraries(${target} INTERFACE talus_common_flags)
endfunction()

talus_add_flags(talus_flags "${TALUS_ARCH}")

target_compile_options(talus_common_flags INTERFACE -Wall -Wextra)
# Not told, as no mistakes of ours: GCC on every vector type used as a template argument; vectors that are wider than the
# registers and so passed in memory, where nothing crosses a library with them; Clang on `&` of two comparisons without a
# branch, and on loops that it does not make vectors of where OpenMP allows it to.
talus_add_known_flags(talus_common_flags -Wno-psabi -Wno-ignored-attributes -Wno-bitwise-instead-of-logical -Wno-pass-failed)
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")    # std::stable_sort of GCC's library calls what C++17 deprecates; GCC tells of ours
  talus_add_known_flags(talus_common_flags -Wno-deprecated-declarations)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # False alarms: in the compiler's own AVX-512 headers once they are inlined (GCC bug 105593), and about addresses of
  # constants that are copied out of an object before it ends.
  talus_add_known_flags(talus_common_flags -Wno-maybe-uninitialized -Wno-dangling-pointer)
endif()
if(TALUS_WERROR)
  target_compile_options(talus_common_flags INTERFACE -Werror)
endif()

# Threads are the host's choice: without OpenMP there, the pragmas are plain loops here.
if(TALUS_HOST_OMP)
  target_link_libraries(talus_common_flags INTERFACE OpenMP::OpenMP_CXX)
else()
  talus_add_known_flags(talus_common_flags -Wno-unknown-pragmas)
endif()

# The sanitizer runtimes must be in the process before a host that does not use them:
# TALUS_SANITIZER_RUNTIMES is what the launcher and the tests preload.
set(TALUS_SANITIZER_RUNTIMES "")
if(TALUS_SANITIZE)
  string(REPLACE ";" "," talus_sanitizers "${TALUS_SANITIZE}")
  target_compile_options(talus_common_flags INTERFACE
    -fsanitize=${talus_sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer -g1)
  target_link_options(talus_common_flags INTERFACE -fsanitize=${talus_sanitizers})
  if("undefined" IN_LIST TALUS_SANITIZE)
    # vptr looks into type information of LAMMPS classes, which a host need not export; what null, object-size and
    # pointer-overflow find, the address sanitizer finds as well, and a wrong alignment the instructions themselves: the last
    # two are half of the time that this compiles and runs
    target_compile_options(talus_common_flags INTERFACE -fno-sanitize=vptr,null,object-size,pointer-overflow,alignment)
  endif()
  foreach(pair address:asan undefined:ubsan thread:tsan)
    string(REPLACE ":" ";" pair "${pair}")
    list(GET pair 0 sanitizer)
    list(GET pair 1 library)
    if(sanitizer IN_LIST TALUS_SANITIZE)
      execute_process(COMMAND "${CMAKE_CXX_COMPILER}" -print-file-name=lib${library}.so
        OUTPUT_VARIABLE file OUTPUT_STRIP_TRAILING_WHITESPACE)
      list(APPEND TALUS_SANITIZER_RUNTIMES "${file}")
    endif()
  endforeach()
endif()
