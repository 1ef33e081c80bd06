// Checkpoints and shards. An input lacks the check sum that ends a file: with a wrong one it would go no further.
#include "app/render/checkpoint_file.h"
#include "app/render/shard.h"
#include "fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    using namespace lancer;
    std::string bytes(fuzz::as_text(data, size));
    const uint64_t hash = Loader::hash_of(bytes);
    bytes.append(reinterpret_cast<const char*>(&hash), sizeof hash);
    const std::string& path = fuzz::as_file(bytes);
    fuzz::reads([&] {
        CheckpointFile file(path);
        // A shard of few pixels may be of a large picture, of which there must be room for all.
        constexpr uint64_t most_pixels = 1 << 14;
        if (pixels_of({file.recipe.stats.settings.crop}) > most_pixels) return;
        Film film = empty_film(file.recipe);
        file.read_film(film, file.state.halves);
    });
    return 0;
}
