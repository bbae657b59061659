# -D TALUS_CORE_ONLY=ON: what needs no LAMMPS, with its unit tests, to try a compiler, a processor or a sanitizer.
#
#   TALUS_OPENMP           threads, where the compiler has OpenMP (default ON)
#   LAMMPS_BINARY_DIR      with a host, the styles and the plugin are compiled as well, but not linked
#   MPI_HEADERS            folder of mpi.h, for a compiler without an MPI of its own (default: that of the machine's)
#   TALUS_SANITIZE=thread  only the tests that use threads. Needs Clang: its OpenMP library tells the sanitizer through
#                          the tool Archer when threads start, meet and end (OMPT); GCC's does not, and every barrier
#                          of it would be reported as a race
#
# A cross-compiler needs CMAKE_SYSTEM_NAME, CMAKE_SYSTEM_PROCESSOR and CMAKE_CROSSCOMPILING_EMULATOR, and GoogleTest as
# source (GTEST_SOURCE_DIR; Debian: googletest).

option(TALUS_OPENMP "Threads, where the compiler has OpenMP" ON)
set(GTEST_SOURCE_DIR /usr/src/googletest CACHE PATH "Source of GoogleTest, for cross-compilers")
set(TALUS_LAMMPS_VERSION none)
option(CMAKE_DISABLE_PRECOMPILE_HEADERS "No include is missing unseen" ON)

if(LAMMPS_BINARY_DIR)
  include(TalusHost)
endif()
if(MPI_HEADERS)
  set(MPI_CXX_INCLUDE_DIRS "${MPI_HEADERS}")
elseif(NOT MPI_CXX_FOUND)
  find_package(MPI REQUIRED COMPONENTS CXX)
endif()
set(TALUS_HOST_OMP OFF)
if(TALUS_OPENMP)
  find_package(OpenMP QUIET COMPONENTS CXX)
  set(TALUS_HOST_OMP ${OpenMP_CXX_FOUND})
endif()
message(STATUS "Core only: ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}, OpenMP: ${TALUS_HOST_OMP}")
include(TalusFlags)
include(TalusEigen)
find_package(ccd QUIET NO_MODULE)
include(TalusCore)
talus_add_code("")

if(LAMMPS_BINARY_DIR)
  include(TalusStyles)
  talus_add_style_objects("")
  target_compile_options(talus_styles PRIVATE -O0)    # never run
  add_library(talus_plugin_objects OBJECT "${PROJECT_SOURCE_DIR}/src/talusplugin.cpp"
    "${PROJECT_SOURCE_DIR}/src/talusstyles.cpp")
  target_link_libraries(talus_plugin_objects PRIVATE talus_core talus_exchange lammps_host)
endif()

# The sanitizers' runtimes are in the programs of the tests themselves.
set(TALUS_SANITIZER_RUNTIMES "")
if(CMAKE_CROSSCOMPILING)
  add_subdirectory("${GTEST_SOURCE_DIR}/googletest" googletest EXCLUDE_FROM_ALL)
  foreach(library gtest gtest_main)
    if(NOT TARGET GTest::${library})    # before 1.11
      add_library(GTest::${library} ALIAS ${library})
    endif()
  endforeach()
endif()
enable_testing()
include(TalusTests)
if("thread" IN_LIST TALUS_SANITIZE)
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang" OR NOT TALUS_HOST_OMP)
    message(FATAL_ERROR "talus: the thread sanitizer needs Clang and its OpenMP library")
  endif()
  file(GLOB llvm /usr/lib/llvm-*/lib)
  find_library(talus_archer archer PATHS ${llvm} REQUIRED)
  list(REMOVE_ITEM TALUS_TEST_ENVIRONMENT "OMP_NUM_THREADS=1")
  list(APPEND TALUS_TEST_ENVIRONMENT "OMP_NUM_THREADS=3" "OMP_TOOL_LIBRARIES=${talus_archer}"
    "TSAN_OPTIONS=ignore_noninstrumented_modules=1:halt_on_error=1")
  set(TALUS_UNIT_TESTS contact_pipeline_test one_trajectory_test record_steps_test body_contacts_test
    body_records_test body_threads_test deferred_forces_test history_store_test law_stages_test neighbor_search_test pair_rows_test
    work_partition_test)
endif()
add_subdirectory(tests/unit)
if(NOT TALUS_SANITIZE)
  talus_add_python_test(cli/test_fused_arithmetic)
  set_property(TEST cli/test_fused_arithmetic APPEND PROPERTY ENVIRONMENT
    "TALUS_CODE=${PROJECT_BINARY_DIR}/**/*talus_*.dir/**/*.o" "TALUS_OBJDUMP=${CMAKE_OBJDUMP}")
endif()
