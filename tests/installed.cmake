# Installs into a folder, moves that, and runs the program from there: what is installed must not know where it lies,
# nor need the source or the build. With a blank in its name, as folders of users have.
#   cmake -DBUILD=<build folder> -DGENERATOR=<its generator> -DSCRATCH=<folder to use> -DREADELF=<program>
#     -DVIEW=<whether there is a window> -P tests/installed.cmake
cmake_minimum_required(VERSION 3.23)
set(first ${SCRATCH}/first)
set(tree "${SCRATCH}/moved here")
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH}/work)

# Runs a command in SCRATCH/work, with no display; its exit code must be `code`. Result: what it said.
function(run code)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env --unset=DISPLAY --unset=WAYLAND_DISPLAY ${ARGN}
    WORKING_DIRECTORY ${SCRATCH}/work OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE result)
  if(NOT result EQUAL code)
    message(SEND_ERROR "exit code ${result} in place of ${code} of: ${ARGN}\n${said}")
  endif()
  set(said "${said}" PARENT_SCOPE)
endfunction()
function(expect_file name)
  file(GLOB found "${tree}/${name}")
  if(NOT found)
    message(SEND_ERROR "not installed: ${name}")
  endif()
endfunction()

run(0 ${CMAKE_COMMAND} --install ${BUILD} --prefix ${first})
file(RENAME ${first} "${tree}")
set(lancer "${tree}/bin/lancer")
set(scenes "${tree}/share/lancer/scenes")

run(0 ${BUILD}/lancer --version)
set(of_build "${said}")
run(0 ${lancer} --version)
if(NOT said STREQUAL of_build)
  message(SEND_ERROR "the version of the build folder is:\n${of_build}and that of the installed program:\n${said}")
endif()

file(GLOB_RECURSE modules "${tree}/lib*/lancer_*.so")
foreach(binary ${lancer} ${modules})
  run(0 ${READELF} -d ${binary})
  if(said MATCHES "R(UN)?PATH[^\n]*\\[([^]$][^]]*)\\]")
    message(SEND_ERROR "${binary} looks for libraries in ${CMAKE_MATCH_2}")
  endif()
endforeach()

# A scene of the installed folder, from another folder; a picture that only a module reads; a window that only lacks a
# display.
run(0 ${lancer} "${scenes}/still_life_textured.toml" --size 32x18 -s 1 -q -o a.png -o a.ppm)
if(modules MATCHES "lancer_oiio")
  run(0 ${lancer} compare a.ppm a.png --fail-above 0.001)
endif()
if(VIEW)
  run(1 ${lancer} view "${scenes}/cornell.toml")
  if(said MATCHES "Looked for|\\.so")
    message(SEND_ERROR "the module of the window is not found:\n${said}")
  endif()
  foreach(file applications/lancer.desktop icons/hicolor/scalable/apps/lancer.svg
      metainfo/localhost.lancer.lancer.metainfo.xml)
    expect_file(share/${file})
  endforeach()
  find_program(VALIDATE_DESKTOP desktop-file-validate)
  if(VALIDATE_DESKTOP)
    run(0 ${VALIDATE_DESKTOP} "${tree}/share/applications/lancer.desktop")
  endif()
  find_program(APPSTREAM appstreamcli)
  if(APPSTREAM)
    run(0 ${APPSTREAM} validate --no-net "${tree}/share/metainfo/localhost.lancer.lancer.metainfo.xml")
  endif()
endif()

# Every scene with the files that it names; what only made them is no use.
foreach(file share/doc/lancer/README.md share/doc/lancer/LICENSE share/doc/lancer/CHANGELOG.md
    share/man/man1/lancer.1 share/man/man1/lancer-render.1 share/bash-completion/completions/lancer
    share/zsh/*/_lancer share/fish/vendor_completions.d/lancer.fish share/doc/lancer/docs/scene-format.md share/lancer/scenes/README.md)
  expect_file(${file})
endforeach()
file(GLOB_RECURSE sources "${tree}/*.cpp" "${tree}/*.h")
list(FILTER sources EXCLUDE REGEX "/include/lancer\\.h$")
if(sources)
  message(SEND_ERROR "source files are installed: ${sources}")
endif()
file(GLOB tomls "${scenes}/*.toml")
foreach(scene ${tomls})
  if(NOT scene MATCHES "/forest\\.toml$")  # it takes seconds, and its files are named like those of the others
    run(0 ${lancer} check ${scene})
  endif()
endforeach()

# A C program finds the library by pkg-config and by find_package, and the library its modules; so does Python.
file(WRITE ${SCRATCH}/work/use.c "#include <lancer.h>
#include <stdio.h>
int main(int argc, char** argv)
{
    float color[3 * 8 * 6];
    lancer_layer layer = {\"color\", color, 3 * 8 * 6};
    lancer_scene* scene = lancer_scene_open(argv[argc - 1]);
    int code = lancer_scene_define(scene, \"render.size=[8, 6]\");
    if (code == LANCER_OK) code = lancer_scene_define(scene, \"render.spp=2\");
    if (code == LANCER_OK) code = lancer_scene_render(scene, &layer, 1, 0, NULL, NULL);
    printf(\"%s %d %g %s\\n\", lancer_version(), code, color[0], lancer_error());
    lancer_scene_free(scene);
    return code;
}
")
file(WRITE ${SCRATCH}/work/CMakeLists.txt "cmake_minimum_required(VERSION 3.23)
project(use C)
find_package(lancer REQUIRED)
add_executable(use use.c)
target_link_libraries(use lancer::lancer)
")
file(GLOB library "${tree}/lib*/*/liblancer.so.1" "${tree}/lib*/liblancer.so.1")
get_filename_component(libraries "${library}" DIRECTORY)
set(scene "${scenes}/still_life_textured.toml")
run(0 ${CMAKE_COMMAND} -G ${GENERATOR} -S . -B cmake_build -DCMAKE_PREFIX_PATH=${tree})
run(0 ${CMAKE_COMMAND} --build cmake_build)
run(0 cmake_build/use "${scene}")
find_program(PKG_CONFIG pkg-config)
find_program(CC NAMES cc gcc)
if(PKG_CONFIG AND CC)
  run(0 ${CMAKE_COMMAND} -E env "PKG_CONFIG_PATH=${libraries}/pkgconfig" ${PKG_CONFIG} --cflags --libs lancer)
  separate_arguments(flags UNIX_COMMAND "${said}")
  run(0 ${CC} -std=c99 -Wall -Wextra -pedantic -Werror use.c -o use_of_pkg_config ${flags})
  run(0 ${CMAKE_COMMAND} -E env "LD_LIBRARY_PATH=${libraries}" ./use_of_pkg_config "${scene}")
endif()
execute_process(COMMAND nm -D --defined-only "${library}" OUTPUT_VARIABLE exported)
if(exported MATCHES "[0-9a-f] [A-Z] ([^l\n][^\n]*)" AND NOT CMAKE_MATCH_1 MATCHES "LANCER_1")
  message(SEND_ERROR "the library exports ${CMAKE_MATCH_1}")
endif()
execute_process(COMMAND python3 -c "import numpy" RESULT_VARIABLE no_numpy ERROR_QUIET)
if(NOT no_numpy)
  run(0 ${CMAKE_COMMAND} -E env "PYTHONPATH=${tree}/lib/python3/dist-packages" PYTHONDONTWRITEBYTECODE=1
    python3 -c "import lancer, sys; print(lancer.render(sys.argv[1], spp=1, size=(8, 6))['color'].mean())" "${scene}")
endif()
file(REMOVE_RECURSE ${SCRATCH})
