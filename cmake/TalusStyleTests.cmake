# The host's own tests of granular styles (unittest/granular, LAMMPS 4 Jul 2026 and newer), run on our styles: the
# drivers are built from the host's sources and get the files tests/styles/demNN-NAME.yaml of ours, as tests
# style/dem/NN-NAME. An older host has no such drivers, and nothing is registered.
#
# A driver runs a file twice, with `newton on` and with `newton off`. A style that is missing makes the driver skip, which counts as failure here: see style/dem/skips_fail.

function(talus_find_style_drivers result)
  set(dir "${LAMMPS_SOURCE_DIR}/unittest/granular")
  set(${result} "" PARENT_SCOPE)
  if(NOT EXISTS "${dir}/test_dem_common.cpp")
    message(STATUS "tests/styles: not run, the host has no drivers for granular tests (unittest/granular)")
    return()
  endif()
  set(suffix "")
  if(HOST_LAMMPS_MACHINE)
    set(suffix "_${HOST_LAMMPS_MACHINE}")
  endif()
  set(library "${LAMMPS_BINARY_DIR}/liblammps${suffix}${CMAKE_SHARED_LIBRARY_SUFFIX}")
  if(NOT EXISTS "${library}")
    message(STATUS "tests/styles: not run, there is no ${library} to link the host's drivers with "
      "(build the host with -D BUILD_SHARED_LIBS=on)")
    return()
  endif()
  set(${result} "${dir}" PARENT_SCOPE)
  set(TALUS_HOST_LIBRARY "${library}" PARENT_SCOPE)
endfunction()

# What all drivers share. Foreign code: none of our warnings.
function(talus_add_driver_library dir)
  find_path(TALUS_YAML_INCLUDE_DIR yaml.h)
  find_library(TALUS_YAML_LIBRARY yaml)
  mark_as_advanced(TALUS_YAML_INCLUDE_DIR TALUS_YAML_LIBRARY)
  if(NOT TALUS_YAML_INCLUDE_DIR OR NOT TALUS_YAML_LIBRARY OR NOT TARGET GTest::gmock)
    talus_fail("libyaml or GoogleMock is missing, which the host's drivers for tests/styles need. Install "
      "them (Debian: libyaml-dev libgmock-dev), or build without tests: -D TALUS_TESTS=OFF.")
  endif()
  add_library(talus_dem_driver STATIC
    "${dir}/../error_stats.cpp" "${dir}/../yaml_writer.cpp" "${dir}/test_config_reader.cpp"
    "${dir}/test_analytic_models.cpp" "${dir}/test_dem_common.cpp" "${dir}/test_main.cpp")
  target_include_directories(talus_dem_driver SYSTEM PUBLIC
    "${dir}" "${dir}/.." "${TALUS_YAML_INCLUDE_DIR}")
  target_compile_definitions(talus_dem_driver PRIVATE
    "TEST_INPUT_FOLDER=${PROJECT_SOURCE_DIR}/tests/styles")
  target_compile_options(talus_dem_driver PUBLIC -w)
  target_link_libraries(talus_dem_driver PUBLIC lammps_host
    GTest::gmock GTest::gtest "${TALUS_HOST_LIBRARY}" "${TALUS_YAML_LIBRARY}" MPI::MPI_CXX)
endfunction()

# The driver's reader ignores keys that it does not know, so a typing error could leave nothing to be checked.
function(talus_check_style_file file)
  file(READ "${file}" text)
  if(NOT text MATCHES "\nanalytic_enable: yes\nanalytic_model: [a-z_]+\nanalytic_tol: [0-9]" AND
     NOT text MATCHES "\nrun_(pos|vel|omega): \\|\n")
    talus_fail("${file} checks nothing: it needs analytic_enable: yes with analytic_model and analytic_tol, or "
      "run_pos, run_vel or run_omega.")
  endif()
  if(NOT text MATCHES "\nprerequisites: \\|\n" OR NOT text MATCHES "\nrun_segments: [0-9]")
    talus_fail("${file} needs prerequisites and run_segments.")
  endif()
endfunction()

# talus_add_style_test(case command ...): a skipped test fails, and so does none at all. The driver shows why a check
# fails only with -v.
function(talus_add_style_test case)
  add_test(NAME style/dem/${case} COMMAND ${ARGN} -v "--gtest_filter=*.newton_*")
  talus_set_test_properties(style/dem/${case} LABELS style dem)
  set_property(TEST style/dem/${case} APPEND PROPERTY FAIL_REGULAR_EXPRESSION "Running 0 tests")
endfunction()

set(talus_style_drivers "")
talus_find_style_drivers(driver_dir)
if(driver_dir)
  talus_add_driver_library("${driver_dir}")
  file(GLOB style_files CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/tests/styles/dem*.yaml")
  foreach(file IN LISTS style_files)
    get_filename_component(name "${file}" NAME_WE)
    if(NOT name MATCHES "^dem([0-9][0-9])-(.+)$")
      talus_fail("${file}: expected a name like dem05-oblique.yaml, 05 being the number of the host's driver.")
    endif()
    set(driver "test_dem_${CMAKE_MATCH_1}")
    set(case "${CMAKE_MATCH_1}-${CMAKE_MATCH_2}")
    talus_check_style_file("${file}")
    if(NOT TARGET ${driver})
      list(APPEND talus_style_drivers ${driver})
      add_executable(${driver} "${driver_dir}/${driver}.cpp")
      target_link_libraries(${driver} PRIVATE talus_dem_driver)
    endif()
    talus_add_style_test(${case} ${driver} "${file}")
    set(last_file "${file}")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
  endforeach()

  # The last file again, without the plugin: these very properties must make it fail. The shell drops the driver's
  # exit code, so that nothing but the word SKIPPED can do so.
  if(style_files)
    talus_add_style_test(skips_fail sh -c "\"$0\" \"$@\" || true" $<TARGET_FILE:${driver}> "${last_file}")
    set_property(TEST style/dem/skips_fail APPEND PROPERTY ENVIRONMENT "LAMMPS_PLUGIN_PATH=/nonexistent")
    set_tests_properties(style/dem/skips_fail PROPERTIES WILL_FAIL ON)
  endif()
endif()
