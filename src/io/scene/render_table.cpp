#include "io/scene/render_table.h"

#include "scene/description/render_options.h"

namespace lancer {
namespace {

// Sets the field to what the table has at that key; false if there is none, or it is wrong.
class FieldReader {
public:
    FieldReader(const TomlTable& table, std::string_view key, RenderSettings& settings)
        : table_(table), key_(key), settings_(settings)
    {
    }

    bool operator()(const SwitchField& field) const { return store(field, table_.boolean(key_)); }
    bool operator()(const SizeField& field) const
    {
        const auto size = table_.size(key_);
        return size && store(field, std::optional(PictureSize{(*size)[0], (*size)[1]}));
    }
    bool operator()(const NumberField<double>& field) const
    {
        return store(field, table_.number(key_, field.least, field.most));
    }
    template <std::integral T>
    bool operator()(const NumberField<T>& field) const
    {
        const auto low = static_cast<int64_t>(field.least), high = static_cast<int64_t>(field.most);
        const std::optional<int64_t> value = table_.integer(key_, low, high);
        return value && store(field, std::optional(static_cast<T>(*value)));
    }
    bool operator()(const ChoiceField& field) const
    {
        const auto place = table_.choice(key_, {field.names.begin(), field.names.end()}, field.get(settings_));
        if (place) field.set(settings_, *place);
        return place.has_value();
    }

private:
    template <class Field, class T>
    bool store(const Field& field, const std::optional<T>& value) const
    {
        if (value) settings_.*field.member = *value;
        return value.has_value();
    }

    const TomlTable& table_;
    std::string_view key_;
    RenderSettings& settings_;
};

}  // namespace

RenderSettings read_render_table(const TomlTable& table)
{
    NameList keys;
    for (const RenderOption& option : render_options()) keys.push_back(option.name);
    table.allow(keys);
    RenderSettings settings;
    for (const RenderOption& option : render_options())
        if (table.has(option.name) && std::visit(FieldReader(table, option.name, settings), option.field))
            mark_given(settings, option);
    return settings;
}

}  // namespace lancer
