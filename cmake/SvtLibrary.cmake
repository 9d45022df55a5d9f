# svt_layers(): reads svt/layers.txt, which lists for each folder the folders it may include and therefore links.
function(svt_layers)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/svt/layers.txt)
  file(STRINGS ${PROJECT_SOURCE_DIR}/svt/layers.txt lines REGEX "^[^#]")
  foreach(line ${lines})
    if(line MATCHES "^(test )?([a-z_/]+):(.*)$")
      set(is_test "${CMAKE_MATCH_1}")
      string(REPLACE "/" "_" folder "${CMAKE_MATCH_2}")
      string(REGEX MATCHALL "[a-z_]+" below "${CMAKE_MATCH_3}")
      if(is_test)
        set(SVT_TEST_LINKS_${folder} ${below} PARENT_SCOPE)
      else()
        set(SVT_LINKS_${folder} ${below} PARENT_SCOPE)
      endif()
    endif()
  endforeach()
endfunction()

# svt_library(<folder> [PRIVATE_LINK <targets>...] [EXCLUDE <sources>...])
#   svt/<folder>/**/*.cpp      -> static library svt_<folder>, alias svt::<folder>, linked to the folders of its layer
#   svt/<folder>/**/*_test.cpp -> test program svt_<folder>_test, its cases registered with ctest
function(svt_library folder)
  cmake_parse_arguments(ARG "" "" "PRIVATE_LINK;EXCLUDE" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/svt/${folder}/*.cpp ${PROJECT_SOURCE_DIR}/svt/${folder}/*.hpp)
  set(tests ${sources})
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "_test\\.(cpp|hpp)$")
  list(TRANSFORM ARG_EXCLUDE PREPEND ${PROJECT_SOURCE_DIR}/svt/)
  list(REMOVE_ITEM sources ${ARG_EXCLUDE})
  add_library(svt_${folder} STATIC ${sources})
  add_library(svt::${folder} ALIAS svt_${folder})
  set_target_properties(svt_${folder} PROPERTIES LINKER_LANGUAGE CXX)
  target_include_directories(svt_${folder} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include>)
  target_compile_features(svt_${folder} PUBLIC cxx_std_20)
  set_target_properties(svt_${folder} PROPERTIES EXPORT_NAME ${folder})
  set_property(GLOBAL APPEND PROPERTY SVT_FOLDERS ${folder})
  list(TRANSFORM SVT_LINKS_${folder} PREPEND svt:: OUTPUT_VARIABLE below)
  target_link_libraries(svt_${folder} PUBLIC ${below} PRIVATE ${ARG_PRIVATE_LINK})
  svt_warnings(svt_${folder})
  svt_optimize(svt_${folder} ${folder})
  svt_unity(svt_${folder})
  if(SVT_TESTS AND tests)
    list(TRANSFORM SVT_TEST_LINKS_${folder} PREPEND svt:: OUTPUT_VARIABLE of_tests)
    svt_test(svt_${folder}_test SOURCES ${tests} LINK svt::${folder} ${of_tests} ${ARG_PRIVATE_LINK})
  endif()
endfunction()

# svt_optimize(<target> <folder>): how hard a folder is optimized, with the precompiled header that fits.
function(svt_optimize target folder)
  if(EMSCRIPTEN AND folder IN_LIST SVT_SMALL_FOLDERS)
    target_compile_options(${target} PRIVATE -Os)
    if(folder IN_LIST SVT_INLINED_FOLDERS)
      target_compile_options(${target} PRIVATE -finline-functions)
    endif()
    svt_precompile(${target} svt_precompiled_small)
  elseif(NOT EMSCRIPTEN AND CMAKE_BUILD_TYPE STREQUAL "Release" AND folder IN_LIST SVT_COLD_FOLDERS)
    target_compile_options(${target} PRIVATE -O1)
    svt_precompile(${target} svt_precompiled_cold)
  else()
    svt_precompile(${target} svt_precompiled)
  endif()
endfunction()

# svt_unity(<target>): compiles sources of a target together, a few at a time, so that what they include is read and
# instantiated once. Kernels that are compiled once for each set of instructions stay alone.
function(svt_unity target)
  if(NOT SVT_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 5)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)  # takes an included source for a header
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    file(STRINGS ${source} kernel REGEX "HWY_TARGET_INCLUDE|packet_kernel" LIMIT_COUNT 1)
    if(kernel)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
endfunction()

# svt_link(<target> <folder> [<targets>...]): links the layers of a folder outside svt/ (svt/layers.txt), and targets.
function(svt_link target folder)
  string(REPLACE "/" "_" folder ${folder})
  list(TRANSFORM SVT_LINKS_${folder} PREPEND svt:: OUTPUT_VARIABLE below)
  target_link_libraries(${target} PRIVATE ${below} ${ARGN})
endfunction()

# svt_test(<name> SOURCES ... LINK ...): a GoogleTest program, its cases registered with ctest.
function(svt_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  # The only source that names the path of the checkout, so that ccache finds all others for another checkout.
  set(root ${CMAKE_BINARY_DIR}/source_root_test.cpp)
  file(CONFIGURE OUTPUT ${root} CONTENT "namespace svt::test {\nextern const char* const kSourceRoot;\n\
const char* const kSourceRoot = \"${PROJECT_SOURCE_DIR}\";\n}\n")
  set_source_files_properties(${root} PROPERTIES SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
  add_executable(${name} ${ARG_SOURCES} ${root})
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF)  # as the precompiled header of tests
  target_link_libraries(${name} PRIVATE ${ARG_LINK} GTest::gtest GTest::gtest_main)
  svt_warnings(${name})
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${name} PRIVATE -O1)  # tests are compiled more often than they run
  endif()
  svt_unity(${name})
  svt_precompile(${name} svt_precompiled_test)
  # The label is the folder: ctest -L '^render$'.
  string(REGEX REPLACE "^svt_|_test$" "" folder ${name})
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 600 PROPERTIES TIMEOUT ${SVT_HANGS_AFTER} LABELS ${folder})
endfunction()

# svt_precompiled(<name> <header> [<targets>...]): a header that is compiled once, for the targets that svt_precompile() gives
# it to. A target of its own, with few definitions: a compiler refuses it where one is missing.
function(svt_precompiled name header)
  file(WRITE ${CMAKE_BINARY_DIR}/${name}.cpp "")
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/${name}.cpp)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${ARGN})
  target_precompile_headers(${name} PRIVATE ${header})
  if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
    # GCC compares each header with #pragma once by its bytes. ccache must compare bytes too, and not only preprocessed
    # text: a header of the cache that differs in comments would lead to redefinitions.
    set(launcher ${CMAKE_CXX_COMPILER_LAUNCHER})
    list(INSERT launcher 3 CCACHE_DEPEND=1)
    set_property(TARGET ${name} PROPERTY CXX_COMPILER_LAUNCHER ${launcher})
  endif()
  svt_warnings(${name})
endfunction()

# svt_precompile(<target> <name>): lets a target use what svt_precompiled(<name>) compiles.
function(svt_precompile target name)
  if(NOT SVT_PCH)
    return()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${name})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fpch-preprocess)  # so that ccache sees what is precompiled
  endif()
endfunction()

# Warnings, and floating-point settings that give identical bits with every compiler and on every machine: no
# contraction into fused multiply-add, no value-changing optimizations. The code reads neither errno nor the
# floating-point exception flags, so rounding and square roots need no calls, and comparisons no branches.
function(svt_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wpedantic -ffp-contract=off -fno-math-errno
                         -fno-trapping-math)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # False positives on std::string concatenation: GCC bug 105651.
    target_compile_options(${target} PRIVATE -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
  endif()
  if(SVT_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()
