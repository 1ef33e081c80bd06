# The check of the structure, checked: in a scratch tree that keeps the rules one fault after the other is planted, and
# each must be reported, alone and with its line.
#   cmake -DSCRATCH=<folder to use> -P tests/layering_catches_faults.cmake
cmake_minimum_required(VERSION 3.23)
set(check "${CMAKE_CURRENT_LIST_DIR}/layering.cmake")
set(failures 0)
set(planted 0)

function(run_check)
  execute_process(COMMAND "${CMAKE_COMMAND}" "-DSOURCE=${SCRATCH}" -P "${check}"
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  set(result "${result}" PARENT_SCOPE)
  set(output "${output}" PARENT_SCOPE)
endfunction()

# Plants `source` as src/`file` and expects the report of one fault in `line` whose text matches `expected`.
function(expect_fault file line expected source)
  file(WRITE "${SCRATCH}/src/${file}" "${source}")
  run_check()
  if(result EQUAL 0 OR NOT output MATCHES "src/${file}:${line}: [^\n]*${expected}" OR NOT output MATCHES "layering: 1 faults")
    message("not reported as it should be: ${file}:${line}: ${expected}\n---- output\n${output}----")
    math(EXPR n "${failures} + 1")
    set(failures ${n} PARENT_SCOPE)
  endif()
  file(REMOVE "${SCRATCH}/src/${file}")
  math(EXPR n "${planted} + 1")
  set(planted ${n} PARENT_SCOPE)
endfunction()

# A tree with nothing wrong, but with much that looks like it.
file(REMOVE_RECURSE "${SCRATCH}")
file(WRITE "${SCRATCH}/src/core/vec.h" [=[
// No virtual, no std::cout, no exit() in here; see "x.h".
#pragma once
#include <cstdio>
/* #include <png.h>
   virtual printf( */
inline const char* text() { return "https://x \" std::cerr << exit(1) virtual"; }
inline int write(char* s) { return std::snprintf(s, 3, "a"); }
inline bool virtual_camera(char c) { return c == '"'; }  // " stays open: virtual
inline bool on_exit(int v[2]) { return v[0] == 1; }
]=])
file(WRITE "${SCRATCH}/src/core/parallel.cpp" "#include \"core/vec.h\"\n#include <tbb/parallel_for.h>\n")
file(WRITE "${SCRATCH}/src/geometry/accel.h" "#include \"core/vec.h\"\nstruct A { virtual ~A() = default; };\n")
file(WRITE "${SCRATCH}/src/core/lanes/x86.h" "#include <immintrin.h>\ninline float f(float x) { return _mm_cvtss_f32(_mm_set_ss(x)); }\n")
file(WRITE "${SCRATCH}/src/core/lanes/types.h" "struct Comm_size { int __minute, a_mm_b; };  // not _mm_set_ss, not __m256\n")
file(WRITE "${SCRATCH}/src/geometry/embree/api.h" "#include <embree3/rtcore.h>\n")
file(WRITE "${SCRATCH}/src/scene/scene.h" "#include \"geometry/accel.h\"  // a; b [c\n")
file(WRITE "${SCRATCH}/src/report/stats_json.cpp" "#include <nlohmann/json.hpp>\n#include \"render/renderer.h\"\n")
file(WRITE "${SCRATCH}/src/io/image/exr.cpp" "#include <OpenEXR/ImfOutputFile.h>\n#include <Imath/half.h>\n#include \"scene/scene.h\"\n")
file(WRITE "${SCRATCH}/src/app/main.cpp" "#include \"io/image/png.h\"\n#include \"render/renderer.h\"\nint main() { std::cout << 1; exit(1); }\n")
run_check()
if(NOT result EQUAL 0)
  message(FATAL_ERROR "a tree that keeps the rules is refused:\n${output}")
endif()

# The ladder.
expect_fault(core/a.h 1 "core may not include geometry" "#include \"geometry/hit.h\"\n")
expect_fault(geometry/a.h 2 "geometry may not include materials" "\n#include \"materials/bsdf.h\"\n")
expect_fault(materials/a.h 1 "materials may not include geometry" "#include \"geometry/hit.h\"\n")
expect_fault(materials/a.h 1 "materials may not include scene" "#include \"scene/scene.h\"\n")
expect_fault(scene/a.cpp 1 "scene may not include integrators" "#include \"integrators/path/path.h\"\n")
expect_fault(integrators/a.h 1 "integrators may not include render" "#include \"render/kernel/kernel.h\"\n")
expect_fault(render/a.h 1 "render may not include report" "#include \"report/metrics/metrics.h\"\n")
expect_fault(report/a.h 1 "report may not include io" "#include \"io/image/exr.h\"\n")
expect_fault(io/a.cpp 1 "io may not include integrators" "#include \"integrators/path/path.h\"\n")
expect_fault(io/a.cpp 3 "io may not include render" "\n\n  #  include \"render/renderer.h\"\n")
expect_fault(io/a.cpp 1 "io may not include report" "#include \"report/metrics/metrics.h\"\n")
expect_fault(render/a.cpp 1 "render may not include app" "#include \"app/options/options.h\"\n")
# Ways around it.
expect_fault(core/a.h 1 "named from src on" "#include \"../scene/scene.h\"\n")
expect_fault(core/a.h 1 "named from src on" "#include \"vec.h\"\n")
expect_fault(core/a.h 1 "stand in quotes" "#include <scene/scene.h>\n")
expect_fault(core/a.h 2 "without a macro" "#define HEADER \"scene/scene.h\"\n#include HEADER\n")
expect_fault(utils/a.h 1 "every source is" "int a();\n")
expect_fault(a.h 1 "every source is" "int a();\n")
expect_fault(core/a/b/c.h 1 "every source is" "int a();\n")
expect_fault(core/lanes/a.h 1 "core may not include geometry" "#include \"geometry/bvh8/node.h\"\n")
# One library, one file.
expect_fault(geometry/bvh.cpp 1 "may include embree" "#include <embree4/rtcore.h>\n")
expect_fault(render/a.cpp 1 "may include embree" "#include <rtcore.h>\n")
expect_fault(core/parallel.h 1 "may include tbb" "#include <tbb/parallel_for.h>\n")
expect_fault(render/a.cpp 1 "may include tbb" "#include <oneapi/tbb/task_arena.h>\n")
expect_fault(io/obj/obj.h 1 "may include tinyobjloader" "#include <tiny_obj_loader.h>\n")
expect_fault(scene/a.cpp 1 "may include toml" "#include <toml++/toml.h>\n")
expect_fault(io/image/read.cpp 1 "may include OpenImageIO" "#include <OpenImageIO/imageio.h>\n")
expect_fault(core/film.h 1 "may include OpenEXR" "#include <OpenEXR/ImfRgbaFile.h>\n")
expect_fault(core/film.h 1 "may include OpenEXR" "#include <Imath/half.h>\n")
expect_fault(core/film.h 1 "may include OpenEXR" "#include <ImfHeader.h>\n")
expect_fault(app/tonemap.cpp 1 "may include libpng" "#include <png.h>\n")
expect_fault(io/image/read.cpp 1 "may include libjpeg" "#include <jpeglib.h>\n")
expect_fault(app/commands/a.cpp 1 "may include CLI11" "#include <CLI/CLI.hpp>\n")
expect_fault(app/view/a.cpp 1 "may include GLFW" "#include <GLFW/glfw3.h>\n")
expect_fault(app/view/a.cpp 1 "may include ImGui" "#include <imgui.h>\n")
expect_fault(app/a.cpp 1 "may include OpenGL" "#include <GL/gl.h>\n")
expect_fault(app/commands/info.cpp 1 "may include nlohmann-json" "#include <nlohmann/json.hpp>\n")
# Intrinsics.
expect_fault(geometry/a.h 1 "may include intrinsics" "#include <immintrin.h>\n")
expect_fault(core/lanes/types.h 1 "may include intrinsics" "#include <xmmintrin.h>\n")
expect_fault(geometry/a.h 2 "intrinsics stand only in" "\ninline int f(float x) { return _mm_cvtss_si32(g(x)); }\n")
expect_fault(render/a.cpp 1 "intrinsics stand only in" "__m256 f();\n")
expect_fault(core/a.h 1 "intrinsics stand only in" "float f(float x) { return __builtin_ia32_rcpss(x); }\n")
# Words.
expect_fault(materials/a.h 2 "virtual" "/* a\n*/ struct B { virtual int f() = 0; };\n")
expect_fault(geometry/a.cpp 1 "only app prints" "void f() { std::cout << 1; }\n")
expect_fault(core/a.cpp 2 "only app prints" "\nvoid f() { std::cerr << \"x\"; }  // why\n")
expect_fault(io/a.cpp 1 "only app prints" "void f() { printf(\"x\"); }\n")
expect_fault(io/a.cpp 1 "only app prints" "void f() { std::fprintf(stderr, \"x\"); }\n")
expect_fault(scene/a.cpp 3 "only app ends the program" "int a;\n// exit\nvoid f() { std::exit(1); }\n")

file(REMOVE_RECURSE "${SCRATCH}")
if(failures GREATER 0)
  message(FATAL_ERROR "layering: ${failures} of ${planted} planted faults were not reported as they should be")
endif()
message(STATUS "layering: all ${planted} planted faults were reported")
