# Our own libraries, which need no LAMMPS: talus_core, and talus_exchange, which needs the headers of MPI besides.

# Folders that need neither LAMMPS nor MPI, from the bottom up; then the exchange, which needs MPI and packs the records of
# particles/.
set(talus_law_folders laws laws/normal laws/damping laws/tangential laws/rolling laws/twisting laws/cohesion laws/heat)
set(talus_core_folders base ${talus_law_folders} material particles neighbors history contact body/shape body/motion
  body/contact bonds fluid vtk packing shape shape/convex shape/superellipsoid shape/contact)

function(talus_glob result)
  set(patterns ${ARGN})
  list(TRANSFORM patterns PREPEND "${PROJECT_SOURCE_DIR}/src/")
  list(TRANSFORM patterns APPEND "/*.cpp")
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  set(${result} "${sources}" PARENT_SCOPE)
endfunction()
talus_glob(talus_core_sources ${talus_core_folders})
talus_glob(talus_exchange_sources exchange)

# Counts of pairs and of bytes pass 2^31: no 64-bit number becomes an int unseen.
set(talus_index_flags -Wconversion -Wno-sign-conversion -Wno-float-conversion)

# Headers of others that most sources include, compiled once. None of ours that may change: everything would be compiled
# anew. Other builds go without (TalusCoreOnly.cmake), so that no include is missing unseen.
set(talus_headers <algorithm> <array> <cmath> <cstdint> <cstring> <deque> <functional> <limits> <map> <memory> <numeric>
  <optional> <stdexcept> <string> <utility> <vector> <Eigen/Geometry> "${PROJECT_SOURCE_DIR}/src/base/intrinsics.h")

# talus_add_code(suffix): libraries talus_core and talus_exchange with the flags talus_flags, each name with the suffix.
function(talus_add_code suffix)
  # Contact laws, batch kernel and geometry: no LAMMPS include, so that tests need no host.
  set(core talus_core${suffix})
  add_library(${core} STATIC ${talus_core_sources})
  target_link_libraries(${core} PUBLIC talus_flags${suffix} Eigen3::Eigen
    PRIVATE $<TARGET_NAME_IF_EXISTS:ccd>)
  target_compile_options(${core} PRIVATE ${talus_index_flags})
  # of its one user alone: other sources are compiled the same with and without it, and come from the cache
  set_property(SOURCE "${PROJECT_SOURCE_DIR}/src/shape/convex/mpr_contact.cpp" PROPERTY COMPILE_DEFINITIONS
    TALUS_HAS_CCD=$<TARGET_EXISTS:ccd>)

  target_precompile_headers(${core} PRIVATE ${talus_headers})

  # Headers of MPI only: the library comes from the process the plugin is loaded into, and tests link it themselves.
  set(exchange talus_exchange${suffix})
  add_library(${exchange} STATIC ${talus_exchange_sources})
  target_include_directories(${exchange} SYSTEM PUBLIC ${MPI_CXX_INCLUDE_DIRS})
  target_compile_definitions(${exchange} PUBLIC OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
  target_link_libraries(${exchange} PUBLIC talus_flags${suffix} ${core})
  target_compile_options(${exchange} PRIVATE ${talus_index_flags})

  foreach(library ${core} ${exchange})
    set_target_properties(${library} PROPERTIES
      POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    target_include_directories(${library} PUBLIC src)
  endforeach()
endfunction()
