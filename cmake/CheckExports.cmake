# cmake -D nm=... -D file=... -D expected=REGEX -P CheckExports.cmake
# Fails unless the file exports something, and all of it matches.
execute_process(COMMAND "${nm}" -D --defined-only "${file}"
  OUTPUT_VARIABLE listing RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE)
if(failed)
  message(FATAL_ERROR "${nm} cannot read ${file}")
endif()
string(REPLACE "\n" ";" lines "${listing}")
foreach(line IN LISTS lines)
  if(NOT line MATCHES " T (${expected})$")
    list(APPEND others "${line}")
  endif()
endforeach()
if(others OR NOT listing)
  message(FATAL_ERROR "${file} must export ${expected} and nothing else, but exports:\n${listing}")
endif()
