# cmake -D FILE=... -D OLD=its run path -P Beside.cmake: its libraries are looked for in its own folder.
file(RPATH_CHANGE FILE "${FILE}" OLD_RPATH "${OLD}" NEW_RPATH "$ORIGIN")
