// The time that reading a mesh takes, for load_obj.cpp and load_gltf.cpp.
#pragma once

#include <chrono>
#include <cstdio>
#include <ctime>

class LoadTime {
public:
    int print(size_t triangles) const
    {
        const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        const double cpu = static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC;
        std::printf("LOADED %.6f %.6f %zu\n", wall, cpu, triangles);
        return 0;
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::clock_t cpu_ = std::clock();
};
