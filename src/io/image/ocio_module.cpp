// The module lancer_ocio: the only file that knows OpenColorIO.
#include "io/image/ocio_module.h"

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <string>

namespace ocio = OCIO_NAMESPACE;

struct LancerOcioView {
    ocio::ConstCPUProcessorRcPtr processor;
};

namespace {

struct Failure {
    std::string text;
    bool is_unknown = false;
};

template <size_t size>
void copy_text(char (&to)[size], const std::string& text)
{
    const size_t length = std::min(text.size(), size - 1);
    std::copy_n(text.data(), length, to);
    to[length] = 0;
}

// Runs f; nothing that is thrown gets out.
template <class F>
bool is_done(LancerOcioInfo* info, const F& f)
{
    try {
        f();
        return true;
    } catch (const Failure& failure) {
        copy_text(info->message, failure.text);
        info->is_unknown = failure.is_unknown ? 1 : 0;
    } catch (const std::exception& e) {
        copy_text(info->message, e.what());
    }
    return false;
}

// The names of count things.
template <class Name>
std::string listed(int count, const Name& name)
{
    std::string text;
    for (int i = 0; i < count; ++i) text += (i ? ", '" : "'") + std::string(name(i)) + "'";
    return text.empty() ? "none" : text;
}

// What the configurations of ACES, of Blender and of others call linear Rec. 709, else the space for scene-linear work.
std::string find_input(const ocio::Config& config)
{
    for (const char* name : {"lin_rec709", "lin_rec709_scene", "Linear Rec.709 (sRGB)", "Linear Rec.709", "lin_srgb",
                             "Utility - Linear - sRGB", "Utility - Linear - Rec.709"})
        if (const auto space = config.getColorSpace(name)) return space->getName();
    if (const auto space = config.getColorSpace(ocio::ROLE_SCENE_LINEAR)) return space->getName();
    throw Failure{"has neither a color space lin_rec709 nor the role scene_linear"};
}

std::string find_display(const ocio::Config& config, const std::string& wanted)
{
    const std::string display = wanted.empty() ? config.getDefaultDisplay() : wanted.c_str();
    const int count = config.getNumDisplays();
    for (int i = 0; i < count; ++i)
        if (display == config.getDisplay(i)) return display;
    const std::string all = listed(count, [&](int i) { return config.getDisplay(i); });
    throw Failure{"has no display '" + display + "'; it has " + all, true};
}

std::string find_view(const ocio::Config& config, const std::string& display, const std::string& wanted)
{
    const std::string view = wanted.empty() ? config.getDefaultView(display.c_str()) : wanted.c_str();
    const int count = config.getNumViews(display.c_str());
    const auto name = [&](int i) { return config.getView(display.c_str(), i); };
    for (int i = 0; i < count; ++i)
        if (view == name(i)) return view;
    throw Failure{"has no view '" + view + "' of the display '" + display + "'; it has " + listed(count, name), true};
}

void open_view(const char* path, const char* display, const char* view, LancerOcioInfo* info, LancerOcioView& opened)
{
    ocio::SetLoggingLevel(ocio::LOGGING_LEVEL_NONE);  // what is wrong is thrown as well
    const ocio::ConstConfigRcPtr config = ocio::Config::CreateFromFile(path);
    config->validate();
    const std::string input = find_input(*config), on = find_display(*config, display),
                      seen = find_view(*config, on, view);
    copy_text(info->input, input);
    copy_text(info->display, on);
    copy_text(info->view, seen);
    // Without approximations of powers and logarithms.
    opened.processor = config->getProcessor(input.c_str(), on.c_str(), seen.c_str(), ocio::TRANSFORM_DIR_FORWARD)
                           ->getOptimizedCPUProcessor(ocio::OPTIMIZATION_LOSSLESS);
}

}  // namespace

extern "C" {

int32_t lancer_ocio_version() { return lancer_ocio_current_version; }

LancerOcioView* lancer_ocio_open(const char* config, const char* display, const char* view, LancerOcioInfo* info)
{
    auto opened = std::make_unique<LancerOcioView>();
    return is_done(info, [&] { open_view(config, display, view, info, *opened); }) ? opened.release() : nullptr;
}

int32_t lancer_ocio_apply(LancerOcioView* view, float* pixels, int64_t count, LancerOcioInfo* info)
{
    return is_done(info, [&] {
        ocio::PackedImageDesc image(pixels, static_cast<long>(count), 1, 3);
        view->processor->apply(image);
    });
}

void lancer_ocio_close(LancerOcioView* view) { delete view; }
}
