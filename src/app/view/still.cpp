#include "app/view/still.h"

#include <algorithm>

#include "app/options/settings.h"
#include "app/whole_film.h"
#include "core/parallel.h"
#include "scene/camera.h"

namespace lancer {

Film film_of(const Sight& sight, uint32_t reduction)
{
    const RenderSettings& s = sight.settings;
    const uint32_t width = std::max(1u, s.size.width / reduction), height = std::max(1u, s.size.height / reduction);
    Film film(width, height, {0, 0, width, height});
    // Reduced pictures are gone before they could be denoised.
    keep_for(reduction > 1 && sight.shown == ShownAs::denoised ? ShownAs::light : sight.shown, film);
    keep_for_settings(s, film);
    return film;
}

void clear(Film& film)
{
    constexpr size_t parts = 64;
    const size_t pixels = film.pixels.size();
    parallel_for(parts, [&](size_t part) {
        const auto clear_part = [&](auto& values) {
            using Value = typename std::remove_reference_t<decltype(values)>::value_type;
            const size_t each = values.size() / pixels;  // none, where there is no room for them
            std::fill(values.begin() + static_cast<std::ptrdiff_t>(pixels * part / parts * each),
                      values.begin() + static_cast<std::ptrdiff_t>(pixels * (part + 1) / parts * each), Value{});
        };
        clear_part(film.pixels), clear_part(film.aovs), clear_part(film.open), clear_part(film.open_aovs);
        clear_part(film.replicates), clear_part(film.wanted), clear_part(film.sets);
    });
}

Camera camera_of(const Renderer& renderer, const Sight& sight, const Film& film)
{
    return {sight.camera, renderer.scene().normalisation, film.width, film.height, pixel_grid(sight.settings)};
}

std::unique_ptr<Film> still_of(const Renderer& renderer, const Sight& sight, uint32_t reduction,
                               const std::stop_token& stop, const std::function<void(double)>& report)
{
    auto film = std::make_unique<Film>(film_of(sight, reduction));
    const Camera camera = camera_of(renderer, sight, *film);
    if (!fill_film(renderer, camera, *film, sight.settings.spp, stop, report)) return nullptr;
    return film;
}

}  // namespace lancer
