// The table of render options: one row for each field of RenderSettings. The command line, [render] of scene files and
// -D, JSON, picture headers, the bias ledger and the tables in docs/ all read it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "scene/description/render_settings.h"

namespace lancer {

struct SwitchField {
    bool RenderSettings::*member;
};
// From least to most, both included.
template <class T>
struct NumberField {
    T RenderSettings::*member;
    T least, most;
};

struct SizeField {
    PictureSize RenderSettings::*member;
};
// A value of an enumeration, as its place among the names.
struct ChoiceField {
    std::span<const std::string_view> names;
    size_t (*get)(const RenderSettings&);
    void (*set)(RenderSettings&, size_t);
    const void* (*address)(const RenderSettings&);
};

using OptionField = std::variant<SwitchField, NumberField<uint32_t>, NumberField<uint64_t>, NumberField<double>,
                                 SizeField, ChoiceField>;

// What an option does to the mean of a picture: its entry in the bias ledger.
struct OptionBias {
    std::string_view effect{};                         // empty: it leaves the mean alone
    std::string_view when = "asked for";               // for readers
    bool (*applies)(const RenderSettings&) = nullptr;  // null: where the value is not the default
};

struct RenderOption {
    std::string_view name;  // the key in [render] and in JSON, the NAME of --set; with dashes the option --NAME
    OptionField field;
    std::string_view help;
    std::string_view unit{};  // empty: none
    OptionBias bias{};
    std::string_view flag{};  // another spelling on the command line

    bool is_switch() const { return std::holds_alternative<SwitchField>(field); }
};

std::span<const RenderOption> render_options();

// One of the rows; name: one of theirs.
const RenderOption& render_option(std::string_view name);

bool is_given(const RenderSettings& settings, const RenderOption& option);
void mark_given(RenderSettings& settings, const RenderOption& option);
// Copies every option that `over` was given.
void override_with(RenderSettings& settings, const RenderSettings& over);

bool is_default(const RenderSettings& settings, const RenderOption& option);
// Whether the option makes the mean of the picture differ from the light that the scene describes.
bool is_biased(const RenderSettings& settings, const RenderOption& option);

// The value as the command line takes it: "64", "0.01", "true", "1280x720", "path".
std::string value_text(const RenderSettings& settings, const RenderOption& option);

}  // namespace lancer
