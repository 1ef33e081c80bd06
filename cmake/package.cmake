# What `cpack` makes of what is installed: one archive that runs from any folder, and Debian packages of its parts.
# scripts/release.sh runs it, with the preset "package".
set(CPACK_GENERATOR "TGZ;DEB")
set(CPACK_PACKAGE_NAME lancer)
set(CPACK_PACKAGE_VENDOR "the lancer developers")
set(CPACK_PACKAGE_CONTACT "lancer developers <lancer@localhost>")
set(CPACK_PACKAGE_FILE_NAME lancer-${PROJECT_VERSION}-linux-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program library scenes doc)
if(TARGET lancer_view)
  list(APPEND CPACK_COMPONENTS_ALL view)
endif()
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_SOURCE_DIR}/cmake/package_files.cmake)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_SOURCE_DIR}/cmake/package_libraries.cmake)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME lancer)
set(needs_processor)
if(base_processor STREQUAL "x86-64-v3")
  set(needs_processor " The processor must be an x86-64-v3\none (AVX2, FMA).")
endif()
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "path tracer for CPUs
lancer renders OBJ and PLY meshes, with materials and textures, and small
TOML scenes. Pictures are unbiased and have the same bits on any number of
threads.${needs_processor}

A plain render needs no recommended library: those are for TIFF, WebP and other
formats of OpenImageIO, for views of OpenColorIO, for compressed meshes and
glTF files. The window is in lancer-view.")
set(CPACK_DEBIAN_VIEW_PACKAGE_NAME lancer-view)
set(CPACK_DEBIAN_VIEW_DESCRIPTION "window of the path tracer lancer
Shows a scene while it renders; camera, lights and materials are moved by
hand.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "lancer-view, lancer-scenes, lancer-doc, ffmpeg")
# What the library is linked with is what the program is linked with.
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME lancer-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "python3-numpy")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${CMAKE_SOURCE_DIR}/cmake/debian/prerm)
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "library of the path tracer lancer
Renders scenes, or arrays of triangles, for C programs and for Python, with
the bits of the program.")
set(CPACK_DEBIAN_SCENES_PACKAGE_NAME lancer-scenes)
set(CPACK_DEBIAN_SCENES_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_SCENES_PACKAGE_ENHANCES lancer)
set(CPACK_DEBIAN_SCENES_DESCRIPTION "scenes for the path tracer lancer
A still life, rooms, a forest, charts of materials and smaller scenes, with
their meshes and textures, to render and to start from.")
set(CPACK_DEBIAN_DOC_PACKAGE_NAME lancer-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_DESCRIPTION "documentation of the path tracer lancer
Scene files, options, methods and measurements, with a gallery.")

# For package_libraries.cmake, which cpack runs.
set(CPACK_LANCER_PROGRAM ${CMAKE_BINARY_DIR}/lancer)
set(CPACK_LANCER_MODULES)
foreach(module ${LANCER_MODULES})
  list(APPEND CPACK_LANCER_MODULES ${CMAKE_BINARY_DIR}/${module}.so)
endforeach()
list(FILTER CPACK_LANCER_MODULES EXCLUDE REGEX "/lancer_view.so$")
set(CPACK_LANCER_VIEW ${CMAKE_BINARY_DIR}/lancer_view.so)
include(CPack)
