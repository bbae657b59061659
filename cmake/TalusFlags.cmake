# Flags of our own code, as target talus_flags: the same for every source, so that an inline
# function gives the same bits wherever it is compiled. A portable build has more such targets, which
# differ in nothing but the instruction set.

include(CheckCXXCompilerFlag)
include(CheckCXXSourceCompiles)

add_library(talus_common_flags INTERFACE)

# Same as the host's: comparisons with the stock styles are comparisons of code, not of flags.
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")

# One trajectory on any number of ranks and threads: the same contact is computed in more than one
# place, by vector code here and perhaps by other vector code there. Contraction to fused
# multiply-add is the compiler's free choice in each place and would give different bits.
target_compile_options(talus_common_flags INTERFACE
  -ffp-contract=off -fno-math-errno -fno-trapping-math -fopenmp-simd)

# Eigen's own vector code fuses multiplication and addition where the processor can, whatever the compiler was told:
# the motion of a body would depend on the instruction set. Without it types are laid out the same everywhere, too.
target_compile_definitions(talus_common_flags INTERFACE EIGEN_DONT_VECTORIZE EIGEN_MAX_ALIGN_BYTES=0)

# talus_add_flags(target arch): a target with the common flags and those for code at -march=arch.
function(talus_add_flags target arch)
  set(options "")
  if(arch)
    set(options "-march=${arch}")
    check_cxx_compiler_flag("${options}" "TALUS_HAS_ARCH_${arch}")
    if(NOT TALUS_HAS_ARCH_${arch})
      message(FATAL_ERROR "talus: ${CMAKE_CXX_COMPILER} does not know -march=${arch} on this machine "
        "(${CMAKE_SYSTEM_PROCESSOR}). Set TALUS_ARCH to another value; for --portable, use GCC 11 or Clang 12, "
        "or newer ones, on x86-64.")
    endif()
  endif()
  # Compilers prefer 256-bit vectors even where 512-bit ones are faster for the batch kernel.
  set(CMAKE_REQUIRED_FLAGS "${options}")
  check_cxx_source_compiles("
    #ifndef __AVX512F__
    #error no AVX-512
    #endif
    int main() { return 0; }" "TALUS_HAS_AVX512_${arch}")
  unset(CMAKE_REQUIRED_FLAGS)
  check_cxx_compiler_flag(-mprefer-vector-width=512 TALUS_HAS_VECTOR_WIDTH_FLAG)
  if(TALUS_HAS_AVX512_${arch} AND TALUS_HAS_VECTOR_WIDTH_FLAG)
    list(APPEND options -mprefer-vector-width=512)
  endif()
  add_library(${target} INTERFACE)
  target_compile_options(${target} INTERFACE ${options})
  target_link_libraries(${target} INTERFACE talus_common_flags)
endfunction()

talus_add_flags(talus_flags "${TALUS_ARCH}")

target_compile_options(talus_common_flags INTERFACE -Wall -Wextra)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # Said of every vector type used as a template argument, where nothing is lost.
  target_compile_options(talus_common_flags INTERFACE -Wno-ignored-attributes)
endif()
# Vector types wider than the machine's registers are passed in memory: nothing of ours crosses a library with them.
target_compile_options(talus_common_flags INTERFACE -Wno-psabi)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # False alarm in the compiler's own AVX-512 headers once they are inlined (GCC bug 105593).
  target_compile_options(talus_common_flags INTERFACE -Wno-maybe-uninitialized)
endif()
if(TALUS_WERROR)
  target_compile_options(talus_common_flags INTERFACE -Werror)
endif()

# Threads are the host's choice: without OpenMP there, the pragmas are plain loops here.
if(TALUS_HOST_OMP)
  target_link_libraries(talus_common_flags INTERFACE OpenMP::OpenMP_CXX)
endif()

# The sanitizer runtimes must be in the process before a host that does not use them:
# TALUS_SANITIZER_RUNTIMES is what the launcher and the tests preload.
set(TALUS_SANITIZER_RUNTIMES "")
if(TALUS_SANITIZE)
  string(REPLACE ";" "," talus_sanitizers "${TALUS_SANITIZE}")
  target_compile_options(talus_common_flags INTERFACE
    -fsanitize=${talus_sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer -g)
  target_link_options(talus_common_flags INTERFACE -fsanitize=${talus_sanitizers})
  if("undefined" IN_LIST TALUS_SANITIZE)
    # vptr looks into type information of LAMMPS classes, which a host need not export.
    target_compile_options(talus_common_flags INTERFACE -fno-sanitize=vptr)
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
