# Writes svt_version.hpp: version, commit and kind of build. Run at each build; the file changes only where they do.
#   cmake -DSOURCE=<folder> -DOUTPUT=<file> -DVERSION=<x.y.z> -DBUILD_TYPE=<kind> -DDEPENDENCIES=<name=version,...>
#     -P cmake/Version.cmake
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR NOT commit)
  set(commit "unknown")
endif()
string(REPLACE "," "|" dependencies "${DEPENDENCIES}")
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT
"#pragma once
#define SVT_VERSION \"${VERSION}\"
#define SVT_COMMIT \"${commit}\"
#define SVT_BUILD_TYPE \"${BUILD_TYPE}\"
#define SVT_DEPENDENCIES \"${dependencies}\"
")
