# What users' programs need that share a simulation with Talus, in C, C++ and Python: a file to source, one for pkg-config,
# a package for CMake. Each is one template, for the build folder and for what is installed.

string(TOUPPER "${TALUS_HOST_SIZES}" TALUS_PACKAGE_SIZES)
set(TALUS_PACKAGE_LIBRARY "lammps")
if(HOST_LAMMPS_MACHINE)
  set(TALUS_PACKAGE_LIBRARY "lammps_${HOST_LAMMPS_MACHINE}")
endif()
set(TALUS_PACKAGE_LIBRARY_FILE "lib${TALUS_PACKAGE_LIBRARY}${CMAKE_SHARED_LIBRARY_SUFFIX}")
# An installed host: its library is beside the folder of its program, or where the linker looks anyway.
set(TALUS_PACKAGE_LIBRARY_DIR "${LAMMPS_BINARY_DIR}")
foreach(folder "${LAMMPS_BINARY_DIR}" "${LAMMPS_BINARY_DIR}/../lib" "${LAMMPS_BINARY_DIR}/../lib64")
  if(EXISTS "${folder}/${TALUS_PACKAGE_LIBRARY_FILE}")
    get_filename_component(TALUS_PACKAGE_LIBRARY_DIR "${folder}" ABSOLUTE)
    break()
  endif()
endforeach()


# In the build folder: header and Python module are those of the source tree.
function(talus_write_package)
  set(TALUS_PACKAGE_PLUGINS "${PROJECT_BINARY_DIR}")
  set(TALUS_PACKAGE_PYTHON "${PROJECT_SOURCE_DIR}/python")
  set(TALUS_PACKAGE_INCLUDE "${PROJECT_SOURCE_DIR}/src/coupling")
  set(TALUS_PACKAGE_FOLDER "${PROJECT_BINARY_DIR}/package")
  foreach(name talus.pc talus-config.cmake)
    configure_file("${PROJECT_SOURCE_DIR}/cmake/${name}.in" "${TALUS_PACKAGE_FOLDER}/${name}" @ONLY)
  endforeach()
  configure_file("${PROJECT_SOURCE_DIR}/cmake/talus.env.in" "${PROJECT_BINARY_DIR}/env.sh" @ONLY)
endfunction()
talus_write_package()

# lib, not CMAKE_INSTALL_LIBDIR: a path that can be told in one sentence on every distribution. The prefix is known when
# it is installed.
install(FILES src/coupling/talus.h DESTINATION include)
install(FILES "${PROJECT_BINARY_DIR}/libtalus.so" DESTINATION lib/talus)
install(FILES python/talus.py python/talus_precice.py DESTINATION lib/talus)
set(talus_names PROJECT_SOURCE_DIR PROJECT_VERSION LAMMPS_SOURCE_DIR TALUS_PACKAGE_LIBRARY TALUS_PACKAGE_LIBRARY_FILE
  TALUS_PACKAGE_LIBRARY_DIR TALUS_PACKAGE_SIZES)
foreach(name IN LISTS talus_names)
  install(CODE "set(${name} [[${${name}}]])")
endforeach()
install(CODE [[
  get_filename_component(prefix "${CMAKE_INSTALL_PREFIX}" ABSOLUTE)
  set(TALUS_PACKAGE_PLUGINS "${prefix}/lib/talus")
  set(TALUS_PACKAGE_PYTHON "${prefix}/lib/talus")
  set(TALUS_PACKAGE_INCLUDE "${prefix}/include")
  set(TALUS_PACKAGE_FOLDER "${prefix}/lib/talus/package")
  foreach(name talus.pc talus-config.cmake)
    configure_file("${PROJECT_SOURCE_DIR}/cmake/${name}.in" "$ENV{DESTDIR}${TALUS_PACKAGE_FOLDER}/${name}" @ONLY)
  endforeach()
  configure_file("${PROJECT_SOURCE_DIR}/cmake/talus.env.in" "$ENV{DESTDIR}${prefix}/lib/talus/talus.env" @ONLY)
  message(STATUS "Installing: $ENV{DESTDIR}${prefix}/lib/talus/talus.env")
]])
