#include "app/commands.h"

namespace lancer {
int run_pixel(int, char**) { return exit_failed; }
}  // namespace lancer
