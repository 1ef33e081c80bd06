#include "app/render/render_memory.h"

#include "app/console.h"
#include "app/picture_memory.h"
#include "app/system_info.h"
#include "render/denoise/film_halves.h"

namespace lancer {
namespace {

// The halves of a film, and what filters them.
uint64_t denoiser_bytes(const Tile& crop)
{
    constexpr uint64_t planes = 2 * HalfPlanes::of_half + 1;
    return uint64_t{crop.width()} * crop.height() * planes * sizeof(float) +
           bytes_to_denoise(crop.width(), crop.height());
}

std::string row(uint64_t bytes, const std::string& of)
{
    return format_text("\n%8.1f MB %s", 1e-6 * static_cast<double>(bytes), of.c_str());
}

// Of a film with room for what the options ask for.
uint64_t film_bytes(const PictureRecipe& recipe)
{
    PictureRecipe small = recipe;
    small.stats.settings.crop = {0, 0, 1, 1};
    const Film film = empty_film(small);
    const auto bytes = [](const auto& all) { return all.size() * sizeof(all[0]); };
    const uint64_t per_pixel = bytes(film.pixels) + bytes(film.open) + bytes(film.aovs) + bytes(film.open_aovs) +
                               bytes(film.replicates) + bytes(film.sets) + bytes(film.layer_sums) + bytes(film.mattes) +
                               bytes(film.wanted);
    const Tile& crop = recipe.stats.settings.crop;
    return per_pixel * crop.width() * crop.height();
}

}  // namespace

void require_memory(const PictureRecipe& recipe)
{
    const PictureMemory memory = memory_for(recipe.options.picture.memory, 1);
    const Tile& crop = recipe.stats.settings.crop;
    const uint64_t pixels = uint64_t{crop.width()} * crop.height(), held = resident_bytes(), film = film_bytes(recipe),
                   denoiser = recipe.options.denoise ? denoiser_bytes(crop) : 0;
    const uint64_t total = held + film + denoiser;
    if (total <= memory.limit) return;
    std::string table = row(held, "scene, accelerator and program") +
                        row(film, format_text("film: %.1f million pixels of %llu bytes", 1e-6 * double(pixels),
                                              static_cast<unsigned long long>(film / pixels)));
    if (denoiser > 0) table += row(denoiser, "denoiser");
    throw Error(ErrorKind::no_memory, format_text("error: this render takes %.2f GB, and --memory allows %s:",
                                                  1e-9 * double(total), memory.limit_text.c_str()) +
                                          table + "\n--shard and --crop render a part of the picture");
}

}  // namespace lancer
