// Films and cameras of a sight, and pictures of it that are rendered to their end.
#pragma once

#include "app/view/session.h"

namespace lancer {

// An empty film of 1/reduction of the width and height, with room for what is shown.
Film film_of(const Sight& sight, uint32_t reduction);
// Takes all samples out of it. Must be called inside with_threads.
void clear(Film& film);
Camera camera_of(const Renderer& renderer, const Sight& sight, const Film& film);

// With all samples, and the bits of lancer render at that size. report: the part that is done. Null if it was stopped.
// Must be called inside with_threads.
std::unique_ptr<Film> still_of(const Renderer& renderer, const Sight& sight, uint32_t reduction,
                               const std::stop_token& stop, const std::function<void(double)>& report);

}  // namespace lancer
