# One interface target that carries the warnings of our own code.
add_library(lancer_warnings INTERFACE)
target_compile_options(lancer_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wold-style-cast -Wno-psabi)
# Where files are joined (cmake/unity.cmake), a local name hides no global of another file: only builds without that look.
if(NOT LANCER_UNITY)
  target_compile_options(lancer_warnings INTERFACE -Wshadow)
elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(lancer_warnings INTERFACE -Wshadow=local)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # False alarms about strings that are added up, by another name where <string> is precompiled (GCC's bug 105651).
  target_compile_options(lancer_warnings INTERFACE -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow
                         -Wno-stringop-overread)
elseif(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  target_compile_options(lancer_warnings INTERFACE -Wno-sign-conversion)  # a part of -Wconversion to clang, but not to g++
  # A formula for one ray and for eight writes & for both, without branches.
  target_compile_options(lancer_warnings INTERFACE -Wno-bitwise-instead-of-logical)
endif()

# What another compiler warns of must not stop somebody who only wants to build.
option(LANCER_WERROR "Warnings are errors, if this compiler was tried" OFF)
if(LANCER_WERROR)
  set(tried "GNU 12" "GNU 14" "Clang 14" "Clang 19")  # of Debian 12 and 13
  string(REGEX MATCH "^[0-9]+" major "${CMAKE_CXX_COMPILER_VERSION}")
  if("${CMAKE_CXX_COMPILER_ID} ${major}" IN_LIST tried)
    target_compile_options(lancer_warnings INTERFACE -Werror)
  else()
    message(STATUS "Warnings stay warnings: lancer was not tried with ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}")
  endif()
endif()
