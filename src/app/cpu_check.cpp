// The only file compiled for any x86-64: it says what is missing before an instruction of the rest can fail. main() is
// called after it. On arm64 all is compiled for every processor of that kind, and there is nothing to check.
#if defined(__x86_64__)

#include <cstdlib>

#include <unistd.h>

namespace {

// Before every other static object, whose initialisers may already use AVX2.
__attribute__((constructor(101))) void check_cpu()
{
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2")) return;
    constexpr char message[] =
        "lancer: error: this CPU lacks AVX2, FMA or BMI2 (x86-64-v3, Intel Haswell or AMD Zen and newer)\n";
    if (write(STDERR_FILENO, message, sizeof message - 1) < 0) std::_Exit(1);
    std::_Exit(1);
}

}  // namespace

#endif
