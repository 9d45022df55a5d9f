# What `make install` puts where: the command with its manual, completions and viewer; the libraries with their public
# headers, a CMake package and a pkg-config file.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS svt RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)

# Manual pages and completions, printed by the command itself.
set(manual ${CMAKE_BINARY_DIR}/manual)
add_custom_command(OUTPUT ${manual}/man1/svt.1.gz DEPENDS svt ${PROJECT_SOURCE_DIR}/cmake/Manual.cmake
  COMMAND ${CMAKE_COMMAND} -DSVT=$<TARGET_FILE:svt> -DOUTPUT=${manual} -P ${PROJECT_SOURCE_DIR}/cmake/Manual.cmake)
add_custom_target(svt_manual ALL DEPENDS ${manual}/man1/svt.1.gz)
install(DIRECTORY ${manual}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT command)
install(FILES ${manual}/svt.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME svt COMPONENT command)
install(FILES ${manual}/_svt DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT command)
install(FILES ${manual}/svt.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT command)
# The page, where `make viewer` has built it.
install(DIRECTORY ${CMAKE_BINARY_DIR}/share/svt/viewer DESTINATION ${CMAKE_INSTALL_DATADIR}/svt COMPONENT command OPTIONAL)

# For the desktop: types of files, the viewer as the program that opens them, thumbnails, icons (scripts/make_logo.py).
set(desktop ${PROJECT_SOURCE_DIR}/cmake/desktop)
install(FILES ${desktop}/svt.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT command)
install(FILES ${desktop}/svt.thumbnailer DESTINATION ${CMAKE_INSTALL_DATADIR}/thumbnailers COMPONENT command)
install(FILES ${desktop}/svt.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages COMPONENT command)
set(icons ${CMAKE_INSTALL_DATADIR}/icons/hicolor)
install(FILES ${desktop}/icons/svt.svg DESTINATION ${icons}/scalable/apps COMPONENT command)
foreach(size 16 24 32 48 64 128 256 512)
  install(FILES ${desktop}/icons/svt-${size}.png DESTINATION ${icons}/${size}x${size}/apps RENAME svt.png COMPONENT command)
endforeach()

# The top of each folder is its public API.
get_property(folders GLOBAL PROPERTY SVT_FOLDERS)
foreach(folder ${folders})
  install(TARGETS svt_${folder} EXPORT svt ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/svt/${folder}/*.hpp)
  list(FILTER headers EXCLUDE REGEX "_test\\.hpp$")
  install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/svt/${folder} COMPONENT development)
endforeach()
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/svt)
install(EXPORT svt NAMESPACE svt:: FILE svtTargets.cmake DESTINATION ${package} COMPONENT development)
file(WRITE ${CMAKE_BINARY_DIR}/svtConfig.cmake [[
include(${CMAKE_CURRENT_LIST_DIR}/LibraryDependencies.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/svtTargets.cmake)
]])
write_basic_package_version_file(${CMAKE_BINARY_DIR}/svtConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/svtConfig.cmake ${CMAKE_BINARY_DIR}/svtConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/LibraryDependencies.cmake DESTINATION ${package} COMPONENT development)

# A static archive names what it needs behind itself.
set(archives ${folders})
list(REVERSE archives)
list(TRANSFORM archives PREPEND "-lsvt_")
list(JOIN archives " " archives)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/svt.pc @ONLY CONTENT [[
prefix=${pcfiledir}/../../..
libdir=${prefix}/@CMAKE_INSTALL_LIBDIR@
includedir=${prefix}/include

Name: svt
Description: @PROJECT_DESCRIPTION@
Version: @PROJECT_VERSION@
Cflags: -I${includedir} -std=c++20
Libs: -L${libdir} -Wl,--start-group @archives@ -Wl,--end-group -lpugixml -lsimdjson -lhwy -lGLU -ltbb
Requires: fmt zlib libpng libjpeg freetype2 libzstd egl glesv2
]])
install(FILES ${CMAKE_BINARY_DIR}/svt.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
