#include "io/image/ocio.h"

#include <memory>

#include "core/names.h"
#include "io/image/ocio_module.h"
#include "io/module_file.h"

namespace lancer {
namespace {

struct OcioModule {
    decltype(&lancer_ocio_open) open;
    decltype(&lancer_ocio_apply) apply;
    decltype(&lancer_ocio_close) close;
};

OcioModule load_ocio()
{
    void* const library =
        open_module("lancer_ocio", lancer_ocio_current_version,
                    "which draws pictures by views of OpenColorIO, is missing; build the target lancer_ocio (it needs "
                    "libopencolorio-dev) or leave --ocio out");
    OcioModule m = {};
    find_symbol(library, "lancer_ocio_open", m.open);
    find_symbol(library, "lancer_ocio_apply", m.apply);
    find_symbol(library, "lancer_ocio_close", m.close);
    return m;
}

}  // namespace

OcioView open_ocio(const OcioChoice& choice)
{
    static const OcioModule module = load_ocio();
    LancerOcioInfo info = {};
    LancerOcioView* const opened =
        module.open(choice.config.c_str(), choice.display.c_str(), choice.view.c_str(), &info);
    if (!opened && info.is_unknown)
        throw Error(ErrorKind::usage, {}, "--ocio: " + in_quotes(choice.config) + " " + info.message);
    if (!opened) throw Error(ErrorKind::invalid_input, {choice.config}, info.message);
    const std::shared_ptr<LancerOcioView> view(opened, module.close);
    static_assert(sizeof(Color) == 3 * sizeof(float));
    return {.choice = {choice.config, info.display, info.view},
            .input = info.input,
            .curve = [view, config = choice.config](std::span<Color> pixels) {
                LancerOcioInfo failure = {};
                if (!module.apply(view.get(), &pixels[0].r, static_cast<int64_t>(pixels.size()), &failure))
                    throw Error(ErrorKind::failed, {config}, failure.message);
            }};
}

}  // namespace lancer
