# The program. cpu_check.cpp alone is compiled for any x86-64, so that an older CPU gets a message instead of SIGILL.
file(GLOB_RECURSE app_sources CONFIGURE_DEPENDS src/app/*.cpp)
list(FILTER app_sources EXCLUDE REGEX "/(api|cpu_check|main|window_module)\\.cpp$")
if(LANCER_FUZZ)
  list(FILTER app_sources INCLUDE REGEX "/app/(options/[a-z_]+|render/(checkpoint_file|recipe|render_memory|shard)|console|picture_memory|system_info|version)\\.cpp$")
endif()
# Options and pages of help are its largest part, and are looked at once a run.
add_small_objects(lancer_options app_sources "/src/app/(options|manual)/" "")
target_compile_definitions(lancer_options PRIVATE LANCER_VERSION="${PROJECT_VERSION}")
target_link_libraries(lancer_options PRIVATE CLI11::CLI11)
if(NOT LANCER_WITH_CLASSIC)
  target_compile_definitions(lancer_options PRIVATE LANCER_NO_CLASSIC)
endif()

add_library(lancer_app STATIC ${app_sources} $<TARGET_OBJECTS:lancer_options>)
join_sources(lancer_app)
target_link_libraries(lancer_app PUBLIC lancer_lib PRIVATE lancer_warnings CLI11::CLI11)
target_precompile_headers(lancer_app PRIVATE ${standard_headers})
# What it does takes no time: small counts for more than fast.
target_compile_options(lancer_app PRIVATE $<$<CONFIG:Release>:-O2>)
target_compile_definitions(lancer_app PRIVATE LANCER_VERSION="${PROJECT_VERSION}" LANCER_BUILD_TYPE="${CMAKE_BUILD_TYPE}")
set_source_files_properties(src/app/version.cpp PROPERTIES COMPILE_DEFINITIONS "LANCER_DATE=\"${LANCER_DATE}\"")

# The library for C and Python: app/api/lancer.h. Of all that is linked into it those functions alone are seen.
set_target_properties(lancer_app PROPERTIES POSITION_INDEPENDENT_CODE ON)
if(NOT LANCER_FUZZ)
  add_library(lancer_shared SHARED src/app/api/api.cpp)
  target_link_libraries(lancer_shared PRIVATE lancer_app lancer_warnings)
  set_target_properties(lancer_shared PROPERTIES OUTPUT_NAME lancer VERSION ${PROJECT_VERSION} SOVERSION 1
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR} EXPORT_NAME lancer)
  target_link_options(lancer_shared PRIVATE -Wl,--version-script=${CMAKE_SOURCE_DIR}/cmake/exported.map)
endif()

# The flags that decide how fast the code is, for the machine block of benchmarks.
string(TOUPPER "${CMAKE_BUILD_TYPE}" build_type)
get_target_property(arch_flags lancer_arch INTERFACE_COMPILE_OPTIONS)
get_target_property(common_flags lancer_flags INTERFACE_COMPILE_OPTIONS)
list(APPEND arch_flags ${common_flags})
list(JOIN arch_flags " " flags)
set_property(SOURCE src/app/bench/machine.cpp PROPERTY COMPILE_DEFINITIONS
  "LANCER_FLAGS=\"${CMAKE_CXX_FLAGS_${build_type}} ${flags}\"")

add_library(lancer_cpu_check OBJECT src/app/cpu_check.cpp)
target_link_libraries(lancer_cpu_check PRIVATE lancer_warnings lancer_flags)

add_executable(lancer src/app/main.cpp $<TARGET_OBJECTS:lancer_cpu_check>)
target_link_libraries(lancer PRIVATE lancer_app lancer_warnings)
set_target_properties(lancer PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

# OpenImageIO stands in a module of its own, opened on first need: linking it would cost every start 0.2 s.
if(LANCER_WITH_OIIO AND EXISTS ${CMAKE_SOURCE_DIR}/src/io/image/oiio_module.cpp)
  add_library(lancer_oiio MODULE src/io/image/oiio_module.cpp)
  target_link_libraries(lancer_oiio PRIVATE lancer_flags lancer_arch lancer_warnings PkgConfig::OIIO Imath::Imath)
  set_target_properties(lancer_oiio PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
  add_dependencies(lancer lancer_oiio)
endif()
# So does OpenColorIO, which few pictures need.
if(OCIO_FOUND AND NOT "${LANCER_WITH_OCIO}" STREQUAL "OFF")
  add_library(lancer_ocio MODULE src/io/image/ocio_module.cpp)
  target_link_libraries(lancer_ocio PRIVATE lancer_flags lancer_arch lancer_warnings PkgConfig::OCIO)
  set_target_properties(lancer_ocio PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
  add_dependencies(lancer lancer_ocio)
endif()
# And what unpacks compressed files.
if(DECOMPRESS_FOUND AND NOT "${LANCER_WITH_DECOMPRESS}" STREQUAL "OFF")
  add_library(lancer_decompress MODULE src/io/decompress_module.cpp)
  target_link_libraries(lancer_decompress PRIVATE lancer_flags lancer_arch lancer_warnings PkgConfig::DECOMPRESS)
  set_target_properties(lancer_decompress PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
  add_dependencies(lancer lancer_decompress)
endif()
# So do the decoders of compressed glTF files.
if(GLTF_COMPRESSION_FOUND AND NOT "${LANCER_WITH_GLTF_COMPRESSION}" STREQUAL "OFF")
  add_library(lancer_gltf MODULE src/io/gltf/gltf_module.cpp)
  target_link_libraries(lancer_gltf PRIVATE lancer_flags lancer_arch lancer_warnings meshoptimizer ${DRACO_LIBRARY})
  target_include_directories(lancer_gltf SYSTEM PRIVATE ${DRACO_INCLUDE})
  set_target_properties(lancer_gltf PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
  add_dependencies(lancer lancer_gltf)
endif()
# And OpenSubdiv.
if(OSD_FOUND AND NOT "${LANCER_WITH_SUBDIVISION}" STREQUAL "OFF")
  add_library(lancer_subdivide MODULE src/io/subdivide/osd_module.cpp)
  target_link_libraries(lancer_subdivide PRIVATE lancer_flags lancer_arch lancer_warnings ${OSD_LIBRARY})
  target_include_directories(lancer_subdivide SYSTEM PRIVATE ${OSD_INCLUDE})
  set_target_properties(lancer_subdivide PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
  add_dependencies(lancer lancer_subdivide)
endif()
# And so does the window: no other command needs a display library.
if(VIEW_FOUND AND NOT "${LANCER_WITH_VIEW}" STREQUAL "OFF" AND NOT LANCER_FUZZ)
  add_library(lancer_view MODULE src/app/view/window_module.cpp)
  target_link_libraries(lancer_view PRIVATE lancer_flags lancer_arch lancer_warnings PkgConfig::VIEW ${CMAKE_DL_LIBS})
  set_target_properties(lancer_view PROPERTIES PREFIX "" LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
  add_dependencies(lancer lancer_view)
endif()

# Those that are built.
set(LANCER_MODULES)
foreach(module lancer_oiio lancer_ocio lancer_decompress lancer_gltf lancer_subdivide lancer_view)
  if(TARGET ${module})
    list(APPEND LANCER_MODULES ${module})
  endif()
endforeach()
