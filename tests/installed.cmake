# Installs into a folder, moves that, and runs the program from there: what is installed must not know where it lies,
# nor need the source or the build. With a blank in its name, as folders of users have.
#   cmake -DBUILD=<build folder> -DSCRATCH=<folder to use> -DREADELF=<program> -DVIEW=<whether there is a window> -P tests/installed.cmake
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
if(sources)
  message(SEND_ERROR "source files are installed: ${sources}")
endif()
file(GLOB tomls "${scenes}/*.toml")
foreach(scene ${tomls})
  if(NOT scene MATCHES "/forest\\.toml$")  # it takes seconds, and its files are named like those of the others
    run(0 ${lancer} check ${scene})
  endif()
endforeach()
file(REMOVE_RECURSE ${SCRATCH})
