#include "scene/build/texture_table.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/names.h"
#include "core/parallel.h"

namespace lancer {
namespace {

// "path: error: reason" without the path, which the warning names itself.
std::string reason_of(const Error& e, const std::string& file)
{
    const std::string text = e.what(), before = file + ": error: ";
    return text.starts_with(before) ? text.substr(before.size()) : text;
}

// The result of one texture.
struct Outcome {
    std::string problem, damage;
    uint64_t not_finite = 0;
    bool is_normals = false;
};

// The results of all uses of a picture.
struct Report {
    Location first;
    std::string problem, damage;
    uint64_t uses = 0, not_finite = 0;
    bool gives_numbers = false, gives_bumps = false;
};

// What was named as heights. A map of normals that a material names as such has precedence.
void take_for_normals(Scene& scene, uint32_t texture)
{
    for (MaterialTraits& traits : scene.traits) {
        if (traits.bump != texture) continue;
        traits.bump = no_texture;
        if (traits.normal_map == no_texture) traits.normal_map = texture;
    }
}

// Removes bumps that use the texture; returns whether there were any.
bool take_bumps_away(Scene& scene, uint32_t texture)
{
    bool found = false;
    for (MaterialTraits& traits : scene.traits) {
        for (uint32_t* const map : {&traits.bump, &traits.normal_map}) {
            if (*map != texture) continue;
            *map = no_texture;
            found = true;
        }
    }
    return found;
}

void warn(const std::string& file, const Report& r, Diagnostics& diagnostics)
{
    if (r.not_finite > 0) {
        diagnostics.warning(r.first, NamedProblem{"numbers of picture", file, " are not finite; they count as 0"},
                            r.not_finite);
    }
    if (!r.damage.empty())
        diagnostics.warning(r.first,
                            NamedProblem{"picture", file, " is damaged: " + r.damage + "; what could be read is used"});
    if (r.problem.empty()) return;
    const char* const instead = !r.gives_bumps    ? "1 is used instead"
                                : r.gives_numbers ? "1 is used instead, and no bumps"
                                                  : "surfaces have no bumps instead";
    diagnostics.warning(r.first, NamedProblem{"picture", file, " is not used: " + r.problem + "; " + instead}, r.uses);
}

// The textures of each file, in the order of the scene: together, so that no more pictures are held than are worked on.
std::vector<std::vector<size_t>> by_file(const std::vector<PendingPictures::OfTexture>& pending)
{
    std::vector<std::vector<size_t>> groups;
    std::map<std::string, size_t> group_of;
    for (size_t i = 0; i < pending.size(); ++i) {
        const auto [it, is_new] = group_of.try_emplace(pending[i].what.file, groups.size());
        if (is_new) groups.emplace_back();
        groups[it->second].push_back(i);
    }
    return groups;
}

}  // namespace

void receive_textures(Scene& scene, std::vector<PendingPictures::OfTexture> pending, const PictureMemory& memory,
                      uint32_t texture_limit, Diagnostics& diagnostics)
{
    std::vector<Outcome> outcomes(pending.size());
    const std::vector<std::vector<size_t>> groups = by_file(pending);
    const auto receive = [&](size_t i) {
        PendingPictures::OfTexture& p = pending[i];
        // Gone with the last texture that is made of it, so that pictures do not pile up.
        const RasterFuture image = std::move(p.image);
        try {
            if (!image.valid()) throw Error(ErrorKind::failed, "nothing reads pictures here");
            memory.wait_for(p.what.file);
            if (p.what.may_be_normals && looks_like_normals(*image.get())) {
                outcomes[i].is_normals = true;
                p.what.use.channel = Channel::color;
            }
            ImageTexture texture(*image.get(), p.what.use, texture_limit);
            outcomes[i].not_finite = texture.not_finite();
            outcomes[i].damage = image.get()->damage;
            scene.textures[p.texture] = std::move(texture);
        } catch (const Error& e) {
            outcomes[i].problem = reason_of(e, p.what.file);
        }
    };
    parallel_for(groups.size(), [&](size_t group) {
        for (const size_t i : groups[group]) receive(i);
    });
    std::vector<std::string> files;  // in the order of the scene
    std::map<std::string, Report> reports;
    for (size_t i = 0; i < outcomes.size(); ++i) {
        const PendingPictures::OfTexture& p = pending[i];
        const auto [it, is_new] = reports.try_emplace(p.what.file);
        Report& r = it->second;
        if (is_new) {
            files.push_back(p.what.file);
            r.first = p.what.where;
        }
        r.not_finite = std::max(r.not_finite, outcomes[i].not_finite);
        if (!outcomes[i].damage.empty()) r.damage = outcomes[i].damage;
        if (outcomes[i].is_normals) {
            take_for_normals(scene, p.texture);
            diagnostics.warning(p.what.where, "a bump map that looks like normals is used as normals");
        }
        if (outcomes[i].problem.empty()) continue;
        r.problem = outcomes[i].problem;
        ++r.uses;
        (take_bumps_away(scene, p.texture) ? r.gives_bumps : r.gives_numbers) = true;
    }
    for (const std::string& file : files) warn(file, reports[file], diagnostics);
}

}  // namespace lancer
