#include "app/render/frames.h"

#include "io/image/read.h"

namespace lancer {

std::string with_number(std::string name, uint32_t number)
{
    for (size_t at = 0; (at = name.find('#', at)) != std::string::npos;) {
        const size_t end = std::min(name.find_first_not_of('#', at), name.size());
        std::string digits = std::to_string(number);
        if (digits.size() < end - at) digits.insert(0, end - at - digits.size(), '0');
        name.replace(at, end - at, digits);
        at += digits.size();
    }
    return name;
}

RenderOptions options_of_frame(const RenderOptions& all, uint32_t frame)
{
    RenderOptions one = all;
    one.frames.reset();
    for (std::string* name : {&one.picture.scene.file, &one.checkpoint, &one.resume, &one.stats, &one.error_log,
                              &one.write_scene, &one.reference, &one.reference2})
        *name = with_number(*name, frame);
    for (std::string& name : one.outputs) name = with_number(name, frame);
    return one;
}

bool is_finished_picture(const std::string& path, const std::string& identity)
{
    try {
        const Metadata metadata = read_picture_metadata(path);
        return text_of(metadata, "identity") == identity && text_of(metadata, "partial") == "0";
    } catch (const Error&) {
        return false;  // missing, or something else
    }
}

}  // namespace lancer
