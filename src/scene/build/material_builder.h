// From what is said of a material to what is rendered: its parameters, and what is computed from them once.
#pragma once

#include <compare>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <utility>

#include "materials/material.h"
#include "scene/description/description.h"

namespace lancer {

// Options of the whole picture.
struct MaterialOptions {
    bool multiscatter = true;  // energy compensation for multiple scattering
    bool fresnel = true;       // false: smooth glass only refracts
};

class MaterialBuilder {
public:
    explicit MaterialBuilder(const MaterialOptions& options) : options_(options) {}

    // The BSDF of a description that is neither a mix nor partly metallic. id_of: the id of a texture.
    Material make(const MaterialDescription& description, const std::function<uint32_t(const TextureUse&)>& id_of);
    // Bodies of glass that have a priority may touch each of these media: to be called when all materials are made, and
    // all media are known.
    void touch(std::span<const Medium> media);

private:
    // What a material has besides its parameters; one that has nothing needs no function here.
    template <class M>
    void finish(M&, const MaterialDescription&)
    {
    }
    void finish(Metal& metal, const MaterialDescription& description);
    void finish(Glass& glass, const MaterialDescription& description);
    void finish(Plastic& plastic, const MaterialDescription& description);
    void finish(Principled& principled, const MaterialDescription& description);
    void finish(Interface& interface, const MaterialDescription& description);

    struct GlassKind {
        float ior;
        bool thin, has_priority;
        friend auto operator<=>(const GlassKind&, const GlassKind&) = default;
    };

    MaterialOptions options_;
    // need(table) asks for what the material needs of it.
    template <class Need>
    void add_losses(Glass& glass, const MaterialDescription& description, const Need& need);
    template <class Need>
    std::shared_ptr<const AlbedoTable> coat_of(float ior, const Need& need);
    template <class Need>
    std::shared_ptr<const AlbedoTable> reflectors(const Need& need);

    // Of every roughness and anisotropy, which takes a second.
    std::shared_ptr<const AnisotropicTable> wide_of(FacetKind kind, double eta);

    // Tables that rough materials share.
    std::map<float, std::shared_ptr<AlbedoTable>> coats_;  // per index of refraction
    std::shared_ptr<AlbedoTable> reflectors_;              // of metals, if there is one
    std::map<GlassKind, std::shared_ptr<GlassLosses>> glasses_;
    std::map<std::pair<FacetKind, double>, std::shared_ptr<AnisotropicTable>> wide_;
    std::shared_ptr<FuzzTable> fuzz_;
};

}  // namespace lancer
