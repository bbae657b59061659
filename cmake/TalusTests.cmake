# Helpers that register tests. Labels: the folder of the test (unit, style, physics, mpi, cli, portable) and
# what a script asks for in comment lines such as
#   # ctest: timeout=600 label=slow,smoke cost=60 serial procs=2 stay
# cost: about how many seconds, for what takes long; such tests begin first. procs: for a script that starts several
# ranks by other means than tests/lib/talus_testing.py, which waits for cores for each run on its own.
# stay: LAMMPS runs in processes that stay, for scripts with many short runs (run_lammps of talus_testing.py).
# Label hostless: no LAMMPS is run, so that one configuration is enough.

if(NOT TARGET GTest::gtest)
  find_package(GTest REQUIRED)
endif()
find_package(Python3 REQUIRED COMPONENTS Interpreter)

set(TALUS_TEST_ENVIRONMENT
  "TALUS_LMP=${TALUS_HOST_LMP}"
  "TALUS_LAUNCHER=${PROJECT_BINARY_DIR}/lmp"
  "TALUS_PLUGIN=${PROJECT_BINARY_DIR}/talusplugin.so"
  "TALUS_BINARY_DIR=${PROJECT_BINARY_DIR}"
  "TALUS_SOURCE_DIR=${PROJECT_SOURCE_DIR}"
  "TALUS_LAMMPS_SOURCE=${LAMMPS_SOURCE_DIR}"
  "TALUS_LAMMPS_BINARY=${LAMMPS_BINARY_DIR}"
  "TALUS_VERSION=${PROJECT_VERSION}"
  "TALUS_LAMMPS_VERSION=${TALUS_LAMMPS_VERSION}"
  "TALUS_SIZES=${TALUS_HOST_SIZES}"
  "TALUS_PORTABLE=$<BOOL:${TALUS_PORTABLE}>"
  "TALUS_SANITIZE=$<JOIN:${TALUS_SANITIZE},$<COMMA>>"
  "TALUS_CCD=$<TARGET_EXISTS:ccd>"
  "TALUS_MPIEXEC=${MPIEXEC_EXECUTABLE}"
  "TALUS_MPICXX=${MPI_CXX_COMPILER}"
  "TALUS_CMAKE=${CMAKE_COMMAND}"
  "TALUS_CXX=${CMAKE_CXX_COMPILER}"
  "LAMMPS_PLUGIN_PATH=${PROJECT_BINARY_DIR}"
  "PYTHONDONTWRITEBYTECODE=1"
  "OMP_NUM_THREADS=1"
  "MALLOC_PERTURB_=128"    # glibc fills new memory with 1e306: what is read before it is set shows
  "OMP_WAIT_POLICY=passive"
  "OMPI_MCA_pml=ob1"
  "OMPI_MCA_mpi_yield_when_idle=1"
  "OMPI_MCA_rmaps_base_oversubscribe=1"    # Open MPI 4
  "OMPI_MCA_hwloc_base_binding_policy=none"    # jobs side by side would be bound to the same cores
  "PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe"    # Open MPI 5
  "PRTE_MCA_hwloc_default_binding_policy=none"
  "OMPI_ALLOW_RUN_AS_ROOT=1"
  "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1")
if(TALUS_SANITIZER_RUNTIMES)
  string(REPLACE ";" ":" talus_preload "${TALUS_SANITIZER_RUNTIMES}")
  list(APPEND TALUS_TEST_ENVIRONMENT
    "LD_PRELOAD=${talus_preload}" "ASAN_OPTIONS=detect_leaks=0")
endif()

# A test that was skipped tested nothing: it must not look like one that passed.
function(talus_set_test_properties test)
  cmake_parse_arguments(arg "SERIAL;STAY" "TIMEOUT;PROCESSORS;COST" "LABELS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  math(EXPR arg_TIMEOUT "3 * ${arg_TIMEOUT}")    # a limit is there to end what hangs, also on a machine with other work
  if(CMAKE_CROSSCOMPILING)    # in an emulator
    math(EXPR arg_TIMEOUT "20 * ${arg_TIMEOUT}")
  endif()
  if(TALUS_SANITIZE)
    math(EXPR arg_TIMEOUT "4 * ${arg_TIMEOUT}")
  endif()
  if(NOT arg_PROCESSORS)
    set(arg_PROCESSORS 1)
  endif()
  set_tests_properties("${test}" PROPERTIES
    LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT} PROCESSORS ${arg_PROCESSORS}
    FAIL_REGULAR_EXPRESSION "SKIPPED;skipped=[1-9]"
    ENVIRONMENT "${TALUS_TEST_ENVIRONMENT}")
  if(arg_STAY)
    set_property(TEST "${test}" APPEND PROPERTY ENVIRONMENT "TALUS_STAY=1")
  endif()
  if("slow" IN_LIST arg_LABELS AND NOT arg_COST)
    set(arg_COST 1000)
  endif()
  if(arg_COST)
    set_tests_properties("${test}" PROPERTIES COST ${arg_COST})
  endif()
  if(arg_SERIAL)
    set_tests_properties("${test}" PROPERTIES RUN_SERIAL ON)
  endif()
endfunction()

# talus_add_unit_test(name): tests/unit/name.cpp with GoogleTest, linked to talus_core.
function(talus_add_unit_test name)
  add_executable(${name} "${PROJECT_SOURCE_DIR}/tests/unit/${name}.cpp")
  target_link_libraries(${name} PRIVATE talus_core GTest::gtest GTest::gtest_main)
  add_test(NAME unit/${name} COMMAND ${name})
  talus_set_test_properties(unit/${name} LABELS unit ${ARGN})
endfunction()

# Turn the "# ctest:" lines of a script into arguments for talus_set_test_properties.
function(talus_read_test_header file result)
  set(options "")
  file(STRINGS "${file}" lines REGEX "^# ctest:")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^# ctest: *" "" line "${line}")
    separate_arguments(words UNIX_COMMAND "${line}")
    foreach(word IN LISTS words)
      if(word STREQUAL "serial")
        list(APPEND options SERIAL)
      elseif(word STREQUAL "stay")
        list(APPEND options STAY)
      elseif(word MATCHES "^timeout=([0-9]+)$")
        list(APPEND options TIMEOUT ${CMAKE_MATCH_1})
      elseif(word MATCHES "^procs=([0-9]+)$")
        list(APPEND options PROCESSORS ${CMAKE_MATCH_1})
      elseif(word MATCHES "^cost=([0-9]+)$")
        list(APPEND options COST ${CMAKE_MATCH_1})
      elseif(word MATCHES "^label=(.+)$")
        string(REPLACE "," ";" labels "${CMAKE_MATCH_1}")
        list(APPEND options LABELS ${labels})
      else()
        message(FATAL_ERROR "${file}: unknown word '${word}' in its ctest line; known are "
          "timeout=SECONDS cost=SECONDS label=NAME,... procs=N serial stay")
      endif()
    endforeach()
  endforeach()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  set(${result} "${options}" PARENT_SCOPE)
endfunction()

# talus_add_python_test(folder/name [LABELS ...] [TIMEOUT s] [COST s] [PROCESSORS n] [SERIAL] [STAY]): a plain unittest script
# tests/folder/name.py.
function(talus_add_python_test test)
  get_filename_component(folder "${test}" DIRECTORY)
  add_test(NAME ${test} COMMAND "${Python3_EXECUTABLE}" "${PROJECT_SOURCE_DIR}/tests/${test}.py")    # not emulated
  talus_set_test_properties(${test} LABELS ${folder} ${ARGN})
endfunction()

# Only the named symbols may be visible: others could bind to another plugin's, or LAMMPS' own.
function(talus_add_export_test target expected)
  add_test(NAME plugin/exports_${target} COMMAND ${CMAKE_COMMAND}
    -D "nm=${CMAKE_NM}" -D "file=$<TARGET_FILE:${target}>" -D "expected=${expected}"
    -P "${PROJECT_SOURCE_DIR}/cmake/CheckExports.cmake")
  set_tests_properties(plugin/exports_${target} PROPERTIES LABELS "plugin;smoke" TIMEOUT 60)
endfunction()
