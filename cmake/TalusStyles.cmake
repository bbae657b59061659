# The styles: what needs LAMMPS.

set(talus_rooms bodies contacts exchange host loads monitor regions shapes snapshot step)
list(TRANSFORM talus_rooms PREPEND system/)
talus_glob(talus_style_sources ${talus_rooms} pair bond fix/body fix/clump fix/motion fix/shape fix/wall compute dump fill comm run coupling)

# What derives from classes of package GRANULAR, or uses its contact model, is left out for a host without it:
# talusstyles.cpp registers such styles only #if TALUS_HOST_HAS_GRANULAR.
if(NOT TALUS_HOST_HAS_GRANULAR)
  set(talus_granular "#include +\"(pair_gran|fix_freeze|fix_pour|fix_wall_gran|gran_sub_mod|granular_model|fix/wall/wall_law)")
  foreach(source IN LISTS talus_style_sources)
    string(REGEX REPLACE "\\.cpp$" ".h" header "${source}")
    set(found "")
    foreach(file "${source}" "${header}")
      if(EXISTS "${file}")
        file(STRINGS "${file}" lines REGEX "${talus_granular}")
        list(APPEND found ${lines})
      endif()
    endforeach()
    if(found AND NOT source MATCHES "/private_(members|fixes).cpp$")
      list(REMOVE_ITEM talus_style_sources "${source}")
    endif()
  endforeach()
endif()

# The same of package RIGID.
if(NOT TALUS_HOST_HAS_RIGID)
  list(FILTER talus_style_sources EXCLUDE REGEX "/fix_rigid_small")
endif()

# The same of package BPM.
if(NOT TALUS_HOST_HAS_BPM)
  list(FILTER talus_style_sources EXCLUDE REGEX "_bpm_([a-z]+_)?talus.cpp$")
endif()
set(talus_bpm_sources ${talus_style_sources})
list(FILTER talus_bpm_sources INCLUDE REGEX "_bpm_([a-z]+_)?talus.cpp$")
set_source_files_properties(${talus_bpm_sources} PROPERTIES SKIP_PRECOMPILE_HEADERS ON
  COMPILE_DEFINITIONS "${talus_bond_facts}")

# talus_add_style_objects(suffix): the objects of the styles, talus_styles${suffix}, on top of the code with that suffix.
function(talus_add_style_objects suffix)
  add_library(talus_styles${suffix} OBJECT ${talus_style_sources})
  set_target_properties(talus_styles${suffix} PROPERTIES
    POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_include_directories(talus_styles${suffix} PRIVATE src)
  target_link_libraries(talus_styles${suffix} PRIVATE talus_core${suffix} talus_exchange${suffix} lammps_host)
  target_precompile_headers(talus_styles${suffix} PRIVATE ${talus_headers} <atom.h> <comm.h> <compute.h>
    <domain.h> <error.h> <fix.h> <force.h> <group.h> <lammps.h> <modify.h> <neighbor.h> <pair.h> <update.h>)
endfunction()
