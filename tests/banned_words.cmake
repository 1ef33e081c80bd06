# Words that shall not stand in the source: code that is switched off, notes of work left undone, and the compiler
# option that breaks "the same pixels everywhere". A comment may say why that option is not used.
#   cmake -DSOURCE=<the repository> -P tests/banned_words.cmake
cmake_minimum_required(VERSION 3.23)
set(faults 0)
file(GLOB_RECURSE files RELATIVE "${SOURCE}"
  "${SOURCE}/src/*" "${SOURCE}/tests/*.cpp" "${SOURCE}/tests/*.h" "${SOURCE}/tests/*.cmake" "${SOURCE}/tests/CMakeLists.txt"
  "${SOURCE}/bench/*.cpp" "${SOURCE}/bench/*.h" "${SOURCE}/bench/CMakeLists.txt" "${SOURCE}/cmake/*" "${SOURCE}/scripts/*")
foreach(file IN LISTS files ITEMS CMakeLists.txt CMakePresets.json)
  file(READ "${SOURCE}/${file}" text)
  string(REGEX REPLACE "[][;\r]" " " text "\n${text}\n")
  string(REGEX MATCHALL "\n[^\n]*(TO[D]O|FIX[M]E)[^\n]*" found "${text}")
  if(file MATCHES "\\.(h|cpp)$")
    string(REGEX MATCHALL "\n[ \t]*#[ \t]*if[ \t]+0[^\n]*" off "${text}")
    string(REGEX REPLACE "//[^\n]*" "" code "${text}")
  else()
    set(off)
    string(REGEX REPLACE "#[^\n]*" "" code "${text}")
  endif()
  string(REGEX MATCHALL "\n[^\n]*fast[-]math[^\n]*" fast "${code}")
  foreach(line IN LISTS found off fast)
    string(STRIP "${line}" line)
    message("${file}: ${line}")
    math(EXPR faults "${faults} + 1")
  endforeach()
endforeach()
if(faults GREATER 0)
  message(FATAL_ERROR "banned words: ${faults} lines")
endif()
