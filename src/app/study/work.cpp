#include "app/study/work.h"

#include <filesystem>

#include "io/atomic_file.h"
#include "io/input_text.h"

namespace lancer {
namespace {

namespace fs = std::filesystem;

std::string mark_of(const std::string& file) { return file + ".done"; }

}  // namespace

std::string StudyWork::file(const std::string& name) const { return fs::path(options.folder) / name; }

bool is_done(const std::string& file, const std::string& key)
{
    return fs::exists(mark_of(file)) && read_input_text(mark_of(file)) == key + "\n";
}

void unmark(const std::string& file) { fs::remove(mark_of(file)); }
void mark_done(const std::string& file, const std::string& key) { write_text(mark_of(file), key + "\n"); }

Image mean_of(const Reference& reference)
{
    Image mean = reference.halves[0];
    for (size_t i = 0; i < mean.pixels.size(); ++i)
        mean.pixels[i] = 0.5f * (mean.pixels[i] + reference.halves[1].pixels[i]);
    return mean;
}

}  // namespace lancer
