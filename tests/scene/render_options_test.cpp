// The table of render options: every row reads and writes its own field.
#include "scene/description/render_options.h"

#include <gtest/gtest.h>

#include <set>

namespace lancer {
namespace {

// The settings with one option changed.
RenderSettings changed(const RenderOption& option)
{
    RenderSettings s;
    std::visit(
        [&]<class Field>(const Field& field) {
            if constexpr (std::is_same_v<Field, ChoiceField>)
                field.set(s, field.get(s) ? 0 : 1);
            else if constexpr (std::is_same_v<Field, SwitchField>)
                s.*field.member = !(s.*field.member);
            else if constexpr (std::is_same_v<Field, SizeField>)
                s.*field.member = {1, 2};
            else
                s.*field.member = field.most;
        },
        option.field);
    return s;
}

TEST(RenderOptions, EachHasANameAndAFieldOfItsOwn)
{
    std::set<std::string_view> names;
    for (const RenderOption& option : render_options()) {
        EXPECT_TRUE(names.insert(option.name).second) << option.name;
        EXPECT_EQ(&render_option(option.name), &option);
        EXPECT_FALSE(option.help.empty()) << option.name;
        const RenderSettings s = changed(option);
        for (const RenderOption& other : render_options())
            EXPECT_EQ(is_default(s, other), &other != &option) << option.name << " and " << other.name;
    }
}

TEST(RenderOptions, OnlyWhatIsGivenOverrides)
{
    for (const RenderOption& option : render_options()) {
        const RenderSettings over = changed(option);
        RenderSettings s;
        override_with(s, over);
        EXPECT_EQ(s, RenderSettings{}) << option.name;
        RenderSettings given = over;
        mark_given(given, option);
        override_with(s, given);
        EXPECT_EQ(s, given) << option.name;
        for (const RenderOption& other : render_options()) EXPECT_EQ(is_given(s, other), &other == &option);
    }
}

TEST(RenderOptions, AFieldThatIsGivenMarksItsRow)
{
    RenderSettings s;
    s.give(&RenderSettings::filter, FilterKind::blackman_harris);  // the default, and given nevertheless
    EXPECT_TRUE(s.is_given(&RenderSettings::filter));
    EXPECT_TRUE(is_given(s, render_option("filter")));
    EXPECT_FALSE(s.is_given(&RenderSettings::size));
    EXPECT_FALSE(s.is_given(&RenderSettings::replicates));
    s.give(&RenderSettings::size, {3, 4});
    EXPECT_EQ(value_text(s, render_option("size")), "3x4");
    EXPECT_TRUE(is_given(s, render_option("size")));
}

TEST(RenderOptions, ValuesAreWrittenAsTheCommandLineTakesThem)
{
    const RenderSettings s{.seed = 9223372036854775807, .accel = AccelKind::list8, .isa = Isa::sse4_2, .mis = false};
    EXPECT_EQ(value_text(s, render_option("seed")), "9223372036854775807");
    EXPECT_EQ(value_text(s, render_option("accel")), "list8");
    EXPECT_EQ(value_text(s, render_option("isa")), "sse4.2");
    EXPECT_EQ(value_text(s, render_option("mis")), "false");
    EXPECT_EQ(value_text(s, render_option("stop_error")), "0.01");
    EXPECT_EQ(value_text({}, render_option("filter")), "blackman-harris");
}

TEST(RenderOptions, TechniquesDoNotBias)
{
    for (const char* name : {"nee", "mis", "always_nee", "mis_compensation", "learned_nee", "light_tree", "split",
                             "roulette", "seed", "sampler", "filter"})
        EXPECT_FALSE(is_biased(changed(render_option(name)), render_option(name))) << name;
    for (const char* name : {"direct", "indirect", "emitters", "fresnel", "soft_shadows", "straight_shadows",
                             "multiscatter", "terminator", "compact", "legacy", "max_depth"}) {
        EXPECT_TRUE(is_biased(changed(render_option(name)), render_option(name))) << name;
        EXPECT_FALSE(is_biased({}, render_option(name))) << name;
    }
    const RenderOption& stop = render_option("stop");
    EXPECT_FALSE(is_biased({.stop = true}, stop));
    EXPECT_FALSE(is_biased({.stop = true, .legacy = true}, stop));
    EXPECT_TRUE(is_biased({.integrator = IntegratorKind::whitted, .stop = true, .legacy = true}, stop));
    EXPECT_FALSE(is_biased({.integrator = IntegratorKind::whitted, .stop = true}, stop));
}

}  // namespace
}  // namespace lancer
