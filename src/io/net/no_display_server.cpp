// The display server of a build without one (LANCER_WITH_DISPLAY_SERVER=OFF): it reports that.
#include "io/net/display_server.h"

namespace lancer {

std::string DisplayServer::connect(const std::string&, uint16_t)
{
    return "this build of lancer was made with LANCER_WITH_DISPLAY_SERVER=OFF";
}

std::string DisplayServer::create(const std::string&, int32_t, int32_t) { return "not connected"; }

std::string DisplayServer::update(const Window&, std::span<const Color>) { return "not connected"; }

}  // namespace lancer
