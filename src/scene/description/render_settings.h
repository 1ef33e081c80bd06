// How a picture is made: what decides the value of its pixels besides the scene. One field an option, which its row in
// render_options.cpp describes; a field without a row does not compile. A scene file fills the settings from [render],
// the command line overrides them, and the renderer reads them.
#pragma once

#include <cstdint>
#include <type_traits>

#include "core/enum_names.h"
#include "core/sampler_kind.h"
#include "geometry/accel_kind.h"

namespace lancer {

enum class IntegratorKind { path, direct, ao, whitted, random_decision };
#ifdef LANCER_NO_CLASSIC
template <>
inline constexpr auto enum_names<IntegratorKind> = std::to_array<std::string_view>({"path", "direct", "ao"});
#else
template <>
inline constexpr auto enum_names<IntegratorKind> = std::to_array<std::string_view>({"path", "direct", "ao", "whitted",
                                                                                    "random-decision"});
#endif

// Whether it is one of the two of the course's ray tracer.
constexpr bool is_classic(IntegratorKind kind)
{
    return kind == IntegratorKind::whitted || kind == IntegratorKind::random_decision;
}

enum class FilterKind { box, gaussian, blackman_harris, narrow_gaussian, centre };
template <>
inline constexpr auto enum_names<FilterKind> = std::to_array<std::string_view>({"box", "gaussian", "blackman-harris",
                                                                                "narrow-gaussian", "centre"});

// Larger pictures are refused before anything is allocated for them.
inline constexpr uint32_t max_picture_side = 65536;
inline constexpr uint64_t max_picture_pixels = uint64_t{1} << 28;

struct PictureSize {
    uint32_t width = 1280, height = 720;  // pixels
    friend bool operator==(const PictureSize&, const PictureSize&) = default;
};
constexpr double aspect_of(const PictureSize& size) { return double(size.width) / size.height; }

struct RenderSettings {
    PictureSize size{};
    uint32_t spp = 64;
    uint64_t seed = 0;
    IntegratorKind integrator = IntegratorKind::path;
    uint32_t max_depth = 0;
    SamplerKind sampler = SamplerKind::sobol;
    FilterKind filter = FilterKind::blackman_harris;
    AccelKind accel = AccelKind::automatic;
    Isa isa = Isa::avx2;
    bool nee = true;
    bool mis = true;
    bool direct = true;
    bool indirect = true;
    bool emitters = true;
    bool fresnel = true;
    bool soft_shadows = true;
    bool straight_shadows = false;
    bool always_nee = false;
    bool mis_compensation = true;
    bool learned_nee = true;
    bool mirror_nee = true;
    bool light_tree = true;
    bool split = true;
    bool roulette = true;
    bool stop = false;
    bool multiscatter = true;
    bool terminator = false;
    bool compact = false;
    bool legacy = false;
    double stop_error = 0.01;
    uint32_t replicates = 1;
    uint32_t texture_limit = 0;

    // The options that a scene file or the command line gave, a bit for each row: what is not given may be replaced.
    uint64_t given = 0;

    template <class T>
    bool is_given(T RenderSettings::*field) const
    {
        return (given & bit_of(&(this->*field))) != 0;
    }
    // Sets a field as if a scene file or the command line gave it.
    template <class T>
    void give(T RenderSettings::*field, std::type_identity_t<T> value)
    {
        this->*field = value;
        given |= bit_of(&(this->*field));
    }
    friend bool operator==(const RenderSettings&, const RenderSettings&) = default;

private:
    // field: the address of one of this object's fields.
    uint64_t bit_of(const void* field) const;
};

}  // namespace lancer
