#include "scene/build/picture_memory.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <vector>

#include "core/names.h"
#include "materials/textures/mip_pyramid.h"
#include "scene/environment/environment.h"
#include "scene/environment/projected_picture.h"

namespace lancer {
namespace {

// What a file takes.
struct Row {
    RasterHeader header;
    uint64_t kept = 0;     // by all that is made of it
    uint64_t working = 0;  // besides, while that is made
    uint64_t bytes() const { return kept + working; }
};

class Bill {
public:
    Bill(const PendingPictures& pending, const PictureMemory& memory, uint32_t texture_limit) : memory_(memory)
    {
        for (const PendingPictures::OfTexture& t : pending.textures) {
            if (!t.image.valid()) continue;
            // What may turn out to be normals then takes all three channels.
            const Channel channel = t.what.may_be_normals ? Channel::color : t.what.use.channel;
            add(t.what.file,
                [&](const RasterHeader& h) { return cost_of_pyramid(h, t.what.use.encoding, channel, texture_limit); });
        }
        if (const auto& e = pending.environment; e && e->image.valid())
            add(e->what.file, [](const RasterHeader& h) {
                return PyramidCost{.kept = EnvironmentMap::bytes_of(h.width, h.height), .working = 0};
            });
        if (!pending.background) return;
        for (const BackgroundPicture* p :
             {&pending.background->what.sky_picture, &pending.background->what.ground_picture})
            if (!p->file.empty())
                add(p->file, [&](const RasterHeader& h) {
                    if (p->projection == Projection::planar)
                        return cost_of_pyramid(h, Encoding::of_file, Channel::color, texture_limit);
                    return PyramidCost{.kept = uint64_t{h.width} * h.height * sizeof(Color), .working = 0};
                });
    }

    uint64_t total() const
    {
        uint64_t kept = 0, rasters = 0;
        std::vector<uint64_t> working;
        for (const auto& [file, row] : rows_) {
            kept += row.kept;
            rasters += row.header.bytes();
            working.push_back(row.working);
        }
        std::sort(working.begin(), working.end(), std::greater());
        uint64_t at_once = 0;
        for (size_t i = 0; i < std::min<size_t>(working.size(), memory_.threads); ++i) at_once += working[i];
        return kept + at_once + std::min(rasters, memory_.ahead);
    }

    std::string table() const
    {
        std::vector<const std::pair<const std::string, Row>*> sorted;
        for (const auto& entry : rows_) sorted.push_back(&entry);
        std::stable_sort(sorted.begin(), sorted.end(),
                         [](const auto* a, const auto* b) { return a->second.bytes() > b->second.bytes(); });
        constexpr size_t most = 20;
        std::string text = "\n       kept     working picture";
        for (size_t i = 0; i < std::min(sorted.size(), most); ++i) {
            const Row& row = sorted[i]->second;
            text += "\n" + padded(row.kept) + padded(row.working) + in_quotes(sorted[i]->first) + ", " +
                    std::to_string(row.header.width) + " x " + std::to_string(row.header.height);
        }
        if (sorted.size() > most) text += "\n    and " + std::to_string(sorted.size() - most) + " smaller ones";
        return text;
    }

    static std::string size_text(uint64_t bytes)
    {
        char text[32];
        const bool is_large = bytes >= 1000000000;
        std::snprintf(text, sizeof text, is_large ? "%.2f GB" : "%.1f MB",
                      static_cast<double>(bytes) * (is_large ? 1e-9 : 1e-6));
        return text;
    }

private:
    template <class Cost>
    void add(const std::string& file, const Cost& cost)
    {
        const std::optional<RasterHeader> header = memory_.header ? memory_.header(file) : std::nullopt;
        if (!header) return;  // why, is told where its pixels are missing
        const PyramidCost c = cost(*header);
        Row& row = rows_[file];
        row.header = *header;
        row.kept += c.kept;
        row.working = std::max(row.working, header->bytes() + header->decoder_bytes + c.working);
    }
    static std::string padded(uint64_t bytes)
    {
        std::string text = size_text(bytes);
        text.insert(0, 11 - std::min<size_t>(text.size(), 11), ' ');
        return text + " ";
    }

    const PictureMemory& memory_;
    std::map<std::string, Row> rows_;
};

// What would help: the largest limit of textures that does.
std::string advice(const PendingPictures& pending, const PictureMemory& memory, uint32_t texture_limit)
{
    const uint32_t largest = texture_limit ? texture_limit : 65536;
    for (uint32_t side = 16384; side >= 64; side /= 2)
        if (side < largest && Bill(pending, memory, side).total() <= memory.limit)
            return "\n--texture-limit " + std::to_string(side) + " would make them fit, with less detail";
    return "";
}

}  // namespace

void check_picture_memory(const PendingPictures& pending, const PictureMemory& memory, uint32_t texture_limit)
{
    if (memory.limit == UINT64_MAX) return;
    const Bill bill(pending, memory, texture_limit);
    if (bill.total() <= memory.limit) return;
    throw Error(ErrorKind::no_memory, "error: the pictures of this scene take " + Bill::size_text(bill.total()) +
                                          ", and --memory allows " + memory.limit_text + ":" + bill.table() +
                                          advice(pending, memory, texture_limit));
}

}  // namespace lancer
