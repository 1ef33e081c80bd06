// How much memory the pictures of a scene take together, by the headers of their files, before it is taken.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "scene/build/pending_pictures.h"

namespace lancer {

// What bounds the pictures of a scene, and who reads them.
struct PictureMemory {
    uint64_t limit = UINT64_MAX;  // bytes
    std::string limit_text{};     // for messages: "6.4 GB (80 % of the memory of this machine)"
    unsigned threads = 1;         // so many pictures are read or converted at once
    uint64_t ahead = 0;           // bytes of pictures that may be read before they are needed
    // The header of a file that was requested; waits for it. Nothing if it cannot be read.
    std::function<std::optional<RasterHeader>(const std::string& file)> header{};
    // Says that a picture is waited for. May be empty.
    std::function<void(const std::string& file)> demand{};

    void wait_for(const std::string& file) const
    {
        if (demand) demand(file);
    }
};

// Throws Error (no_memory), with a table of what takes how much, if the pictures would take more than the limit: what
// is kept of all of them, with MIP levels, what reading and converting takes of as many of the largest as there are
// threads, and what is read ahead. Waits for the headers. Without a limit it does nothing. texture_limit: as in
// RenderSettings.
void check_picture_memory(const PendingPictures& pending, const PictureMemory& memory, uint32_t texture_limit);

}  // namespace lancer
