# Compiles through ccache where it is installed, and keeps the path of the checkout out of all objects: two clones of one
# commit compile to the same bytes, so the second clone takes every object from the cache.
#   paths in objects      relative to the root of the checkout; start gdb there
#   precompiled headers   of GCC are the same in each clone; those of clang hold the path of the clone, so the presets with
#                         clang that compile objects do without (SVT_PCH)
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(compiler_type auto)
  if(EMSCRIPTEN)
    set(compiler_type clang)  # em++ is a script that ccache does not know
  endif()
  set(launcher ${CMAKE_COMMAND} -E env CCACHE_COMPILERTYPE=${compiler_type}
    CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
    CCACHE_SLOPPINESS=pch_defines,time_macros  # the conditions of ccache for sources that include a precompiled header
    ${CCACHE_PROGRAM})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
  set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
endif()
# Only the absolute path is mapped. ccache passes paths relative to the build folder; mapped as well, the names of headers
# would lead nowhere, and no precompiled header of another clone would be found.
add_compile_options(-ffile-prefix-map=${PROJECT_SOURCE_DIR}/=)
