# `make package`: packages for Debian, of the components of cmake/Install.cmake and python/CMakeLists.txt. `svt` has the command
# with its manual and page, `libsvt-dev` the static libraries with their headers, `python3-svt` the module for Python.
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL command development)
set(packages command=svt development=libsvt-dev)
if(SVT_HAS_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  list(APPEND packages python=python3-svt)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_SOURCE_DIR}/build/package)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_CONTACT "The SVT authors <svt@example.org>")
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME svt)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)
# PROJ is loaded with the first use, so that its package is not found by what is linked: libproj.so.25 is in libproj25.
string(REPLACE ".so." "" SVT_PROJ_PACKAGE ${SVT_PROJ_LIBRARY})
set(CPACK_DEBIAN_COMMAND_PACKAGE_DEPENDS ${SVT_PROJ_PACKAGE})
# OpenGL is optional, and so are cairo, qpdf and FriBidi, for PDF, its layers and its Arabic and Hebrew text, SQLite, for GeoPackage, libxlsxwriter, for XLSX, curl, for addresses, ffmpeg, for films, and a browser that `svt view` may open.
set(CPACK_DEBIAN_COMMAND_PACKAGE_RECOMMENDS "libegl-mesa0, libgl1-mesa-dri, libcairo2, libqpdf29, libfribidi0, libsqlite3-0, libxlsxwriter4, libcurl4 | libcurl3-gnutls, xdg-utils")
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS ffmpeg)
set(CPACK_COMPONENT_COMMAND_DESCRIPTION "Turns a building model (CityGML, CityJSON, IFC, IndoorGML) into a volume in
which every voxel is labelled with its building component. Draws, measures,
checks and exports solid, labelled sections through the building, without any
mesh repair. File managers show thumbnails of models.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libsvt-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# What cmake/LibraryDependencies.cmake looks for.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libfmt-dev, libtbb-dev, libpugixml-dev, libsimdjson-dev, nlohmann-json3-dev, \
zlib1g-dev, libpng-dev, libjpeg62-turbo-dev, libhwy-dev, libfreetype-dev, libglu1-mesa-dev, libzstd-dev, ${SVT_PROJ_PACKAGE}, libegl-dev, libgles-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "cmake, pkg-config")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "Static libraries and headers to read building models, to build labelled
volumes, and to query and draw them; a CMake package and a pkg-config file.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-svt)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= ${SVT_PYTHON_VERSION}), python3 (<< ${SVT_PYTHON_NEXT}), python3-numpy, ${SVT_PROJ_PACKAGE}")
# The command serves the page of Volume.view().
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS svt)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-xarray, python3-pandas, python3-geopandas, python3-vtk9, python3-scipy, python3-shapely")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${PROJECT_SOURCE_DIR}/cmake/debian/python/postinst;${PROJECT_SOURCE_DIR}/cmake/debian/python/prerm")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Module for Python: volumes in which every point of a building knows
which component it belongs to, as arrays of numpy; labels at points and along
rays, sections as polygons, pictures.")

# What Debian wants beside: copyright and changelog, compressed manual pages.
find_program(GZIP_PROGRAM gzip)
if(GZIP_PROGRAM)
  execute_process(COMMAND git -C ${PROJECT_SOURCE_DIR} log -1 --format=%cd --date=rfc OUTPUT_VARIABLE date
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT date)
    set(date "Thu, 01 Jan 1970 00:00:00 +0000")
  endif()
  foreach(pair ${packages})
    string(REPLACE "=" ";" pair ${pair})
    list(POP_FRONT pair component name)
    set(folder ${CMAKE_BINARY_DIR}/debian/${name})
    file(WRITE ${folder}/changelog.Debian "svt (${PROJECT_VERSION}-1) unstable; urgency=medium

  * Version ${PROJECT_VERSION}; what it brings is in CHANGELOG.md of the sources.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
    execute_process(COMMAND ${GZIP_PROGRAM} -9nf ${folder}/changelog.Debian)
    install(FILES ${folder}/changelog.Debian.gz ${PROJECT_SOURCE_DIR}/cmake/debian/copyright
      DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component} EXCLUDE_FROM_ALL)
  endforeach()
endif()
include(CPack)
