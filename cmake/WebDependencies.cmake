# Builds the libraries of the WebAssembly module from the sources fetched by scripts/web_dependencies.sh, under the
# target names of cmake/Dependencies.cmake.
set(WEB_SOURCES ${PROJECT_SOURCE_DIR}/build/web-sources)
if(NOT EXISTS ${WEB_SOURCES}/zlib/.complete)
  message(FATAL_ERROR "The sources of the libraries are missing: run scripts/web_dependencies.sh")
endif()

# web_library(<alias> <include folder> <sources>...): sources are patterns below build/web-sources.
function(web_library alias include)
  string(REGEX REPLACE ".*::" "web_" target ${alias})
  list(TRANSFORM ARGN PREPEND ${WEB_SOURCES}/)
  file(GLOB sources ${ARGN})
  add_library(${target} STATIC ${sources})
  add_library(${alias} ALIAS ${target})
  target_include_directories(${target} SYSTEM PUBLIC ${WEB_SOURCES}/${include})
  target_compile_options(${target} PRIVATE -w)
endfunction()

# Header-only Debian packages work for every target.
# Threads are those of svt/core/parallel/parallel_web.cpp; Emscripten provides OpenGL; without PROJ svt/crs knows less.
foreach(none TBB::tbb Threads::Threads EGL::EGL GLESv2::GLESv2 PROJ::proj)
  add_library(${none} INTERFACE IMPORTED)
endforeach()
add_library(web_fmt INTERFACE)
add_library(web_nlohmann_json INTERFACE)
# Without a thousands separator of the locale, which no code uses and for which the whole of std::locale would be linked.
target_compile_definitions(web_fmt INTERFACE FMT_HEADER_ONLY FMT_STATIC_THOUSANDS_SEPARATOR=44)
add_library(fmt::fmt ALIAS web_fmt)
add_library(nlohmann_json::nlohmann_json ALIAS web_nlohmann_json)

web_library(pugixml::pugixml pugixml/src pugixml/src/pugixml.cpp)
web_library(simdjson::simdjson simdjson/include simdjson/src/simdjson.cpp)
target_include_directories(web_simdjson PRIVATE ${WEB_SOURCES}/simdjson/src)

web_library(ZLIB::ZLIB zlib zlib/adler32.c zlib/compress.c zlib/crc32.c zlib/deflate.c zlib/inf*.c zlib/trees.c
  zlib/uncompr.c zlib/zutil.c)

web_library(ZSTD::ZSTD zstd/lib zstd/lib/common/*.c zstd/lib/decompress/*.c zstd/lib/compress/*.c)
target_compile_definitions(web_ZSTD PRIVATE ZSTD_DISABLE_ASM=1)

web_library(PNG::PNG libpng libpng/png*.c)
list(APPEND png_tests ${WEB_SOURCES}/libpng/pngtest.c)
get_target_property(png_sources web_PNG SOURCES)
list(REMOVE_ITEM png_sources ${png_tests})
set_target_properties(web_PNG PROPERTIES SOURCES "${png_sources}")
configure_file(${WEB_SOURCES}/libpng/scripts/pnglibconf.h.prebuilt ${CMAKE_CURRENT_BINARY_DIR}/libpng/pnglibconf.h COPYONLY)
target_include_directories(web_PNG SYSTEM PUBLIC ${CMAKE_CURRENT_BINARY_DIR}/libpng)
target_link_libraries(web_PNG PUBLIC ZLIB::ZLIB)

# Highway 1.0.3 has no 64-bit floats for WASM; its portable vectors do, and web/wasm/highway gives them SIMD.
web_library(hwy::hwy highway highway/hwy/targets.cc highway/hwy/aligned_allocator.cc highway/hwy/per_target.cc)
target_include_directories(web_hwy SYSTEM BEFORE PUBLIC ${PROJECT_SOURCE_DIR}/web/wasm/highway)
target_compile_definitions(web_hwy PUBLIC HWY_COMPILE_ONLY_EMU128)

# The parts of FreeType needed to draw glyphs of one TrueType font.
web_library(Freetype::Freetype freetype/include freetype/src/base/ftbase.c freetype/src/base/ftinit.c
  freetype/src/base/ftsystem.c freetype/src/base/ftdebug.c freetype/src/base/ftbitmap.c
  freetype/src/sfnt/sfnt.c freetype/src/truetype/truetype.c
  freetype/src/smooth/smooth.c)
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/freetype/ftmodule.h CONTENT
"FT_USE_MODULE(FT_Driver_ClassRec, tt_driver_class)
FT_USE_MODULE(FT_Module_Class, sfnt_module_class)
FT_USE_MODULE(FT_Renderer_Class, ft_smooth_renderer_class)
")
file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/freetype/ftoption.h CONTENT
"#include <freetype/config/ftoption.h>
#undef FT_CONFIG_OPTION_USE_ZLIB
#undef FT_CONFIG_OPTION_USE_LZW
#undef FT_CONFIG_OPTION_MAC_FONTS
#undef TT_CONFIG_OPTION_EMBEDDED_BITMAPS
#undef TT_CONFIG_OPTION_BDF
#undef TT_CONFIG_OPTION_GX_VAR_SUPPORT
#undef TT_CONFIG_OPTION_BYTECODE_INTERPRETER
#undef TT_CONFIG_OPTION_SUBPIXEL_HINTING
#undef TT_USE_BYTECODE_INTERPRETER
#undef TT_SUPPORT_SUBPIXEL_HINTING_INFINALITY
#undef TT_SUPPORT_SUBPIXEL_HINTING_MINIMAL
")
target_compile_definitions(web_Freetype PRIVATE FT2_BUILD_LIBRARY
  FT_CONFIG_MODULES_H=<${CMAKE_CURRENT_BINARY_DIR}/freetype/ftmodule.h>
  FT_CONFIG_OPTIONS_H=<${CMAKE_CURRENT_BINARY_DIR}/freetype/ftoption.h>)

web_library(GLU::GLU glu/include glu/src/libtess/*.c)
target_include_directories(web_GLU PRIVATE ${WEB_SOURCES}/glu/src/include)
target_compile_options(web_GLU PRIVATE -include limits.h)  # missing in one of its source files

foreach(library pugixml simdjson PNG Freetype GLU)
  target_compile_options(web_${library} PRIVATE -Os)
endforeach()

set(DEJAVU_SANS /usr/share/fonts/truetype/dejavu/DejaVuSans.ttf)
