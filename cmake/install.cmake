# What `cmake --install` copies. The program finds its modules by a path from its own folder, so the tree may be moved
# as a whole. Components: program, view (the window), library,
# scenes, doc.
include(GNUInstallDirs)
set(LANCER_ZSH_COMPLETIONS share/zsh/site-functions CACHE STRING "Where zsh looks for completions; Debian's looks in share/zsh/vendor-completions")
set(modules_folder ${CMAKE_INSTALL_LIBDIR}/lancer)
file(RELATIVE_PATH modules_from_program "/${CMAKE_INSTALL_BINDIR}" "/${modules_folder}")
set_source_files_properties(src/io/module_file.cpp PROPERTIES
  COMPILE_DEFINITIONS "LANCER_INSTALLED_MODULES=\"${modules_from_program}\"")
foreach(folder BINDIR LIBDIR DATADIR)
  if(IS_ABSOLUTE "${CMAKE_INSTALL_${folder}}")
    message(FATAL_ERROR "CMAKE_INSTALL_${folder} is absolute; what is installed can be moved only if it is below the prefix")
  endif()
endforeach()

install(TARGETS lancer RUNTIME COMPONENT program)
foreach(module ${LANCER_MODULES})
  if(module STREQUAL "lancer_view")
    install(TARGETS ${module} LIBRARY DESTINATION ${modules_folder} COMPONENT view)
  else()
    install(TARGETS ${module} LIBRARY DESTINATION ${modules_folder} COMPONENT program)
  endif()
endforeach()

# The library: for C by pkg-config or find_package(lancer), which gives the target lancer::lancer; for Python.
if(TARGET lancer_shared)
  include(CMakePackageConfigHelpers)
  target_include_directories(lancer_shared INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  install(TARGETS lancer_shared EXPORT lancer LIBRARY COMPONENT library NAMELINK_COMPONENT library)
  install(EXPORT lancer FILE lancerConfig.cmake NAMESPACE lancer:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lancer
    COMPONENT library)
  write_basic_package_version_file(${CMAKE_BINARY_DIR}/lancerConfigVersion.cmake COMPATIBILITY SameMajorVersion)
  file(RELATIVE_PATH prefix_from_pkgconfig "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
  configure_file(cmake/lancer.pc.in ${CMAKE_BINARY_DIR}/lancer.pc @ONLY)
  install(FILES ${CMAKE_BINARY_DIR}/lancer.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT library)
  install(FILES ${CMAKE_BINARY_DIR}/lancerConfigVersion.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/lancer
    COMPONENT library)
  install(FILES src/app/api/lancer.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT library)
  install(FILES python/lancer.py DESTINATION lib/python3/dist-packages COMPONENT library)
endif()

# Manual pages and completions are written by the program itself: scripts/option-tables.sh, docs/architecture.md.
install(DIRECTORY share/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES share/completions/lancer.bash RENAME lancer
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES share/completions/_lancer DESTINATION ${LANCER_ZSH_COMPLETIONS} COMPONENT program)
install(FILES share/completions/lancer.fish
  DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

# A desktop shows what opens a window.
if(TARGET lancer_view)
  configure_file(share/metainfo/localhost.lancer.lancer.metainfo.xml.in
    ${CMAKE_BINARY_DIR}/share/localhost.lancer.lancer.metainfo.xml @ONLY)
  install(FILES share/applications/lancer.desktop
    DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT view)
  install(FILES share/icons/lancer.svg
    DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT view)
  install(FILES ${CMAKE_BINARY_DIR}/share/localhost.lancer.lancer.metainfo.xml
    DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo COMPONENT view)
endif()

# Scenes with their meshes and textures, without the programs that made these.
install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/lancer COMPONENT scenes
  PATTERN "*.cpp" EXCLUDE PATTERN "*.h" EXCLUDE)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT doc)
