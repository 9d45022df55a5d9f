# What the build needs: the libraries, and what no installed file refers to.
include(${CMAKE_CURRENT_LIST_DIR}/LibraryDependencies.cmake)

find_path(CLI11_INCLUDE_DIR CLI/CLI.hpp REQUIRED)

# Not linked: svt/crs loads it when it is first needed, by the name that the linker would have written down.
find_package(PROJ REQUIRED)
foreach(property IN ITEMS IMPORTED_SONAME_NONE IMPORTED_SONAME_RELEASE IMPORTED_SONAME)
  if(NOT SVT_PROJ_LIBRARY)
    get_target_property(SVT_PROJ_LIBRARY PROJ::proj ${property})
  endif()
endforeach()

# Not linked either: svt/writers loads it for PDF.
find_path(CAIRO_INCLUDE_DIR cairo/cairo-pdf.h REQUIRED)
find_path(FONTCONFIG_INCLUDE_DIR fontconfig/fontconfig.h REQUIRED)  # of the fonts in PDF
set(SVT_CAIRO_LIBRARY libcairo.so.2)
find_path(XLSXWRITER_INCLUDE_DIR xlsxwriter.h REQUIRED)  # loaded for tables as XLSX

find_file(DEJAVU_SANS DejaVuSans.ttf PATHS /usr/share/fonts/truetype/dejavu /usr/share/fonts/TTF /usr/share/fonts/dejavu
  /usr/share/fonts/dejavu-sans-fonts REQUIRED)

# Clipper serves as a second implementation in tests; see docs/dev/dependencies.md.
if(SVT_TESTS)
  find_path(CLIPPER_INCLUDE_DIR polyclipping/clipper.hpp REQUIRED)
  find_library(CLIPPER_LIBRARY polyclipping REQUIRED)
  if(NOT TARGET Clipper::Clipper)
    add_library(Clipper::Clipper INTERFACE IMPORTED)
    target_include_directories(Clipper::Clipper SYSTEM INTERFACE ${CLIPPER_INCLUDE_DIR})
    target_link_libraries(Clipper::Clipper INTERFACE ${CLIPPER_LIBRARY})
  endif()
endif()
