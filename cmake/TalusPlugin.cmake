# The plugin: the files that LAMMPS opens. Sets talus_variants, those that only a portable build has.

include(TalusCore)
include(TalusStyles)

function(talus_add_module name exported)
  add_library(${name} MODULE ${ARGN})
  set_target_properties(${name} PROPERTIES
    PREFIX "" SUFFIX ".so"
    LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}"
    INSTALL_RPATH "$ORIGIN"
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
  target_compile_definitions(${module} PRIVATE TALUS_HOST_HAS_BPM=${TALUS_HOST_HAS_BPM})
  target_link_libraries(${module} PRIVATE talus_core${suffix} talus_exchange${suffix} lammps_host)
endfunction()

# talus_add_styles(module suffix): the styles, on top of the code with that suffix.
function(talus_add_styles module suffix)
  talus_add_style_objects("${suffix}")
  talus_add_styles_module(${module} "${suffix}")
endfunction()

# The plugin is two files. LAMMPS opens plugins with all symbols bound at once, so one that uses
# C++ symbols which another host lacks fails before its first line runs, with a mangled name as
# the only hint. talusplugin.so therefore uses no symbol of LAMMPS at link time: it asks the host
# for its version, and only then opens talusstyles.so, which holds everything else. It also tells
# whether the processor has the instructions of talusstyles.so, and so has none of them itself.
add_library(talus_needs OBJECT src/needed_instructions.cpp)
set_target_properties(talus_needs PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_link_libraries(talus_needs PRIVATE talus_flags)
talus_add_module(talusplugin "lammpsplugin_init; talus_*" src/talusplugin.cpp $<TARGET_OBJECTS:talus_needs>)
target_include_directories(talusplugin PRIVATE "${PROJECT_SOURCE_DIR}/src")
target_link_libraries(talusplugin PRIVATE lammps_host talus_common_flags ${CMAKE_DL_LIBS})
# What programs link that share a simulation (talus.h): the same file, so that it is there once.
add_custom_command(TARGET talusplugin POST_BUILD
  COMMAND ${CMAKE_COMMAND} -E create_symlink talusplugin.so "${PROJECT_BINARY_DIR}/libtalus.so")

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
