# Headers that nearly every file reads, read once. Sources still include what they use: CI builds without this too
# (CMAKE_DISABLE_PRECOMPILE_HEADERS).
set(standard_headers <algorithm> <array> <atomic> <bit> <charconv> <chrono> <cmath> <cstdint> <cstdio> <cstdlib>
  <cstring> <filesystem> <fstream> <functional> <initializer_list> <iterator> <limits> <map> <memory> <mutex> <numbers>
  <numeric> <optional> <set> <span> <sstream> <stdexcept> <string> <string_view> <thread> <tuple> <type_traits>
  <unordered_map> <utility> <variant> <vector>)
if(NOT LANCER_PORTABLE_LANES)
  list(APPEND standard_headers <immintrin.h>)  # long, and part of nearly every file by core/lanes/x86.h
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  add_compile_options("SHELL:-Xclang -fno-pch-timestamp")  # or ccache finds none again
endif()

# ccache, where it is installed and nothing else was chosen. Its caution about precompiled headers is not needed: a
# header that changes makes them anew.
if(NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(LANCER_CCACHE ccache)
  if(LANCER_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${LANCER_CCACHE})
  endif()
endif()
