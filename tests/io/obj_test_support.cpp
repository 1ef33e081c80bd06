#include "io/obj_test_support.h"

namespace lancer {

fs::path shared_folder()
{
    const char* const named = std::getenv("LANCER_SHARED");
    if (named) return named;
    fs::path up = fs::path(LANCER_SOURCE_DIR);
    for (int i = 0; i < 2; ++i) {
        up = up.parent_path();
        if (fs::is_directory(up / "shared")) return up / "shared";
    }
    return {};
}

}  // namespace lancer
