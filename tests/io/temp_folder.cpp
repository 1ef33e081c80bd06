#include "io/temp_folder.h"

namespace lancer {

std::vector<std::string> malformed_files(const std::string& folder)
{
    const char* const given = std::getenv("LANCER_SHARED");
    const std::string root = given ? given : LANCER_SOURCE_DIR "/../shared";
    std::vector<std::string> result;
    std::error_code none;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root + "/malformed/" + folder, none)) {
        if (entry.is_regular_file()) result.push_back(entry.path());
    }
    std::sort(result.begin(), result.end());
    return result;
}

void expect_error(ErrorKind kind, const std::string& path, const std::string& words,
                  const std::function<void()>& action)
{
    try {
        action();
        ADD_FAILURE() << "nothing thrown for " << path;
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), kind) << e.what();
        EXPECT_NE(std::string(e.what()).find(path), std::string::npos) << e.what();
        EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
}

void expect_read_or_refused(const std::string& path, const std::function<Image(const std::string&)>& read)
{
    try {
        const Image image = read(path);
        EXPECT_EQ(image.pixels.size(), image.data.area()) << path;
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::invalid_input) << e.what();
        EXPECT_NE(std::string(e.what()).find(path), std::string::npos) << e.what();
    }
}

}  // namespace lancer
