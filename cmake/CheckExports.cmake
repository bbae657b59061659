# cmake -D nm=... -D file=... -D expected=REGEX -P CheckExports.cmake
# Fails unless the file exports exactly one symbol, and it matches.
execute_process(COMMAND "${nm}" -D --defined-only "${file}"
  OUTPUT_VARIABLE listing RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE)
if(failed)
  message(FATAL_ERROR "${nm} cannot read ${file}")
endif()
string(REPLACE "\n" ";" lines "${listing}")
list(LENGTH lines count)
if(NOT count EQUAL 1 OR NOT lines MATCHES " T ${expected}$")
  message(FATAL_ERROR "${file} must export ${expected} and nothing else, but exports:\n${listing}")
endif()
