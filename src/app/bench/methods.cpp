#include "app/bench/methods.h"

#include <algorithm>

#include "geometry/embree/embree.h"

namespace lancer {
namespace {

const AccelName& accelerator_of(std::string_view name)
{
    return *std::find_if(accelerators.begin(), accelerators.end(), [&](const AccelName& a) { return a.name == name; });
}

}  // namespace

std::vector<std::string_view> bench_method_names()
{
    std::vector<std::string_view> names{bench_baseline, "embree-fast"};
    for (const AccelName& a : accelerators) names.push_back(a.name);
    return names;
}

bool tries_all(std::string_view method)
{
    return method != bench_baseline && method != "embree-fast" && accelerator_of(method).tries_all;
}

void BenchMethod::build()
{
    // The old one first: two at once need twice the memory.
    direct_.reset(), accel_.reset();
    if (is_direct())
        direct_ = std::make_unique<BareEmbree>(g_, BareMode{.robust = is_robust(), .high = true, .isa = isa_});
    else
        accel_ = make_accelerator(accelerator_of(name_).kind, g_, isa_);
}

uint64_t BenchMethod::bytes() const { return direct_ ? direct_->bytes() : accel_->stats().bytes; }

RayMethod BenchMethod::single() const
{
    return direct_ ? direct_method(name_, *direct_, Way::single) : single_method(name_, *accel_);
}

RayMethod BenchMethod::batch() const
{
    return direct_ ? direct_method(name_, *direct_, Way::packet8) : batch_method(name_, *accel_);
}

std::unique_ptr<Accelerator> BenchMethod::renders_with(const Geometry& geometry) const
{
    if (is_direct()) return make_embree(geometry, isa_, is_robust() ? EmbreeMode::robust : EmbreeMode::fast);
    return make_accelerator(accelerator_of(name_).kind, geometry, isa_);
}

}  // namespace lancer
