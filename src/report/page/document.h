// A report as plain data: sections of paragraphs, tables, plots, pictures and raw data. html.h writes it as a page,
// markdown.h as text for the documentation.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace lancer {

enum class Tone { plain, good, bad };

struct Cell {
    std::string text;     // may have several lines
    bool number = false;  // numbers are set flush right
    Tone tone = Tone::plain;
};

struct Table {
    std::string caption;
    std::vector<std::string> head;
    std::vector<std::vector<Cell>> rows;  // short ones are filled up with empty cells
};

struct Paragraph {
    std::string text;
    Tone tone = Tone::plain;  // bad: a warning
};

struct Plot {
    std::string svg;  // as to_svg() makes it
};

// Kept in the page for programs to read; not shown.
struct JsonData {
    std::string id;
    std::string json;  // valid JSON
};

struct Picture {
    std::string name, caption;
    std::string png;  // the bytes of the file
};

// Pictures of one place side by side, of one size. The first is what the others are held against: it is seen in their
// place while one points at them. Below, two that one chooses, with a slider between them.
struct PictureRow {
    std::string id;  // letters, digits and '-'; no other block of the document has it
    std::string caption;
    std::vector<Picture> pictures;
};

// Pictures of different things beside each other, each with its name and caption.
struct Gallery {
    std::vector<Picture> pictures;
};

using Block = std::variant<Paragraph, Table, Plot, PictureRow, Gallery, JsonData>;

struct Section {
    std::string heading;
    std::vector<Block> blocks;
    bool page_only = false;  // too long for the documentation
};

struct Document {
    std::string title;
    std::vector<Block> opening;  // before the first section
    std::vector<Section> sections;
};

}  // namespace lancer
