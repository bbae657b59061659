# The plugin: libraries of what needs no LAMMPS, which tests use as well, and the files that LAMMPS opens.
# Sets talus_variants, the files that only a portable build has.

# Folders that need neither LAMMPS nor MPI, from the bottom up; then the exchange, which needs MPI and packs the records of
# particles/; then those of LAMMPS.
set(talus_law_folders laws laws/normal laws/damping laws/tangential laws/rolling laws/twisting laws/cohesion)
set(talus_core_folders base ${talus_law_folders} material particles neighbors history contact body/shape body/motion
  body/contact vtk packing shape shaped)
set(talus_style_folders system pair fix compute dump fill comm run)

function(talus_glob result)
  set(patterns ${ARGN})
  list(TRANSFORM patterns PREPEND "${PROJECT_SOURCE_DIR}/src/")
  list(TRANSFORM patterns APPEND "/*.cpp")
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  set(${result} "${sources}" PARENT_SCOPE)
endfunction()
talus_glob(talus_core_sources ${talus_core_folders})
talus_glob(talus_exchange_sources exchange)
talus_glob(talus_style_sources ${talus_style_folders})
# What derives from classes of package GRANULAR, or uses its contact model, is left out for a host without it:
# talusstyles.cpp registers such styles only #if TALUS_HOST_HAS_GRANULAR.
if(NOT TALUS_HOST_HAS_GRANULAR)
  set(talus_granular "#include +\"(pair_gran|fix_freeze|fix_pour|fix_wall_gran|gran_sub_mod|granular_model|fix/wall_batch)")
  foreach(source IN LISTS talus_style_sources)
    string(REGEX REPLACE "\\.cpp$" ".h" header "${source}")
    set(found "")
    foreach(file "${source}" "${header}")
      if(EXISTS "${file}")
        file(STRINGS "${file}" lines REGEX "${talus_granular}")
        list(APPEND found ${lines})
      endif()
    endforeach()
    if(found)
      list(REMOVE_ITEM talus_style_sources "${source}")
    endif()
  endforeach()
endif()

# The same of package RIGID.
if(NOT TALUS_HOST_HAS_RIGID)
  list(FILTER talus_style_sources EXCLUDE REGEX "/fix_rigid_small")
endif()

# GCC (12 at least) makes fused multiply-adds of sums beside differences of products, whatever -ffp-contract says, where
# it packs statements of a source into vectors. tests/cli/test_fused_arithmetic.py finds such sources.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set_source_files_properties(
    "${PROJECT_SOURCE_DIR}/src/fix/fix_rigid_small_talus.cpp"
    "${PROJECT_SOURCE_DIR}/src/shape/face_stiffness.cpp"
    "${PROJECT_SOURCE_DIR}/src/shape/mass_properties.cpp"
    "${PROJECT_SOURCE_DIR}/src/shape/mean_overlap.cpp"
    PROPERTIES COMPILE_OPTIONS -fno-tree-slp-vectorize)
endif()

# Counts of pairs and of bytes pass 2^31: no 64-bit number becomes an int unseen.
set(talus_index_flags -Wconversion -Wno-sign-conversion -Wno-float-conversion)

# talus_add_code(suffix): libraries talus_core and talus_exchange with the flags talus_flags, each name with the suffix.
function(talus_add_code suffix)
  # Contact laws, batch kernel and geometry: no LAMMPS include, so that tests need no host.
  set(core talus_core${suffix})
  add_library(${core} STATIC ${talus_core_sources})
  target_link_libraries(${core} PUBLIC talus_flags${suffix} Eigen3::Eigen
    PRIVATE ccd)
  target_compile_options(${core} PRIVATE ${talus_index_flags})

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

function(talus_add_module name exported)
  add_library(${name} MODULE ${ARGN})
  set_target_properties(${name} PROPERTIES
    PREFIX "" SUFFIX ".so"
    LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}"
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_compile_options(${name} PRIVATE ${talus_index_flags})
  if(APPLE)
    target_link_options(${name} PRIVATE "LINKER:-undefined,dynamic_lookup")
    return()
  endif()
  # Visibility alone does not hide what the C++ library instantiates in our objects.
  set(map "${PROJECT_BINARY_DIR}/${name}.map")
  file(CONFIGURE OUTPUT "${map}" CONTENT "{ global: ${exported}; local: *; };\n")
  set_target_properties(${name} PROPERTIES LINK_DEPENDS "${map}")
  # nodelete: LAMMPS unloads plugins at `clear` while objects of ours (comm) still live.
  target_link_options(${name} PRIVATE "LINKER:--version-script=${map}" "LINKER:-z,nodelete")
endfunction()

# talus_add_styles_module(module suffix sources...): a module with the styles talus_styles${suffix} and more sources.
function(talus_add_styles_module module suffix)
  talus_add_module(${module} "talus_register_*" "${PROJECT_SOURCE_DIR}/src/talusstyles.cpp"
    $<TARGET_OBJECTS:talus_styles${suffix}> ${ARGN})
  target_include_directories(${module} PRIVATE "${PROJECT_SOURCE_DIR}/src")
  target_link_libraries(${module} PRIVATE talus_core${suffix} talus_exchange${suffix} lammps_host)
endfunction()

# talus_add_styles(module suffix): the styles, on top of the code with that suffix.
function(talus_add_styles module suffix)
  add_library(talus_styles${suffix} OBJECT ${talus_style_sources})
  set_target_properties(talus_styles${suffix} PROPERTIES
    POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_include_directories(talus_styles${suffix} PRIVATE src)
  target_link_libraries(talus_styles${suffix} PRIVATE talus_core${suffix} talus_exchange${suffix} lammps_host)
  talus_add_styles_module(${module} "${suffix}")
endfunction()

# The plugin is two files. LAMMPS opens plugins with all symbols bound at once, so one that uses
# C++ symbols which another host lacks fails before its first line runs, with a mangled name as
# the only hint. talusplugin.so therefore uses no symbol of LAMMPS at link time: it asks the host
# for its version, and only then opens talusstyles.so, which holds everything else.
talus_add_module(talusplugin lammpsplugin_init src/talusplugin.cpp)
target_link_libraries(talusplugin PRIVATE lammps_host talus_flags ${CMAKE_DL_LIBS})

# In a portable build, talusstyles.so only chooses between files with the styles, one for each
# instruction set of src/instruction_sets.h. Tests link the code of the baseline.
set(talus_variants "")
talus_add_code("")
if(TALUS_PORTABLE)
  talus_add_module(talusstyles "talus_register_*" src/talusdispatch.cpp)
  target_link_libraries(talusstyles PRIVATE lammps_host talus_flags ${CMAKE_DL_LIBS})
  talus_add_styles(talusstyles-baseline "")
  foreach(pair avx2:x86-64-v3 avx512:x86-64-v4)
    string(REPLACE ":" ";" pair "${pair}")
    list(GET pair 0 word)
    list(GET pair 1 arch)
    talus_add_flags(talus_flags-${word} ${arch})
    talus_add_code(-${word})
    talus_add_styles(talusstyles-${word} -${word})
  endforeach()
  foreach(word baseline avx2 avx512)
    list(APPEND talus_variants talusstyles-${word})
    target_compile_definitions(talusstyles-${word} PRIVATE TALUS_INSTRUCTION_SET=_${word})
  endforeach()
  add_dependencies(talusstyles ${talus_variants})
else()
  talus_add_styles(talusstyles "")
endif()
add_dependencies(talusplugin talusstyles)
