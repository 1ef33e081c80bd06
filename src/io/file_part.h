// A part of a file that is read as if it were a file: a picture within a glTF file. Its name alone tells where it is,
// so that whoever asks for pictures by their names asks for these as well.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace lancer {

struct FilePart {
    std::string file;              // that it is in
    std::string label;             // for who reads its name: letters and digits
    uint64_t begin = 0, size = 0;  // bytes of the file
    // If they are base64: which of the bytes that they stand for are the part.
    struct Range {
        uint64_t begin = 0, size = 0;
        friend bool operator==(const Range&, const Range&) = default;
    };
    std::optional<Range> decoded{};
    friend bool operator==(const FilePart&, const FilePart&) = default;
};

// "scene.glb#image3@1234+5678": 5678 bytes from the 1234th on. Base64: "scene.gltf#image3@1234+5678~0+4258".
std::string name_of(const FilePart& part);
// What a name says, if it is one of a part and there is no file of that name.
std::optional<FilePart> part_of_name(const std::string& name);

// Its bytes. Throws Error, with its name: missing_input if there is no such file, invalid_input if it is too short or
// not base64.
std::string read_part(const FilePart& part);

}  // namespace lancer
