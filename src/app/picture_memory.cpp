#include "app/picture_memory.h"

#include "app/console.h"
#include "app/system_info.h"

namespace lancer {

PictureMemory memory_for(const MemorySize& size, unsigned threads)
{
    const auto in_units = [](double bytes) {
        return bytes >= 1e9 ? format_text("%.2f GB", 1e-9 * bytes) : format_text("%.1f MB", 1e-6 * bytes);
    };
    double bytes = size.amount;
    std::string part;
    if (size.is_part) {
        bytes *= static_cast<double>(memory_bytes());
        part = format_text(" (%.4g %% of the memory that there is)", 100 * size.amount);
    }
    PictureMemory memory{.limit = static_cast<uint64_t>(bytes), .limit_text = in_units(bytes) + part};
    memory.threads = threads;
    memory.ahead = memory.limit / 8;
    return memory;
}

void serve(PictureMemory& memory, ImageSource& images)
{
    memory.header = [&images](const std::string& file) { return images.header(file); };
    memory.demand = [&images](const std::string& file) { images.demand(file); };
}

}  // namespace lancer
