#include "support/exact_ggx.h"

namespace lancer {

long double exact_density(Long h, long double alpha)
{
    const long double tan2 = (h.x * h.x + h.y * h.y) / (h.z * h.z), cos4 = h.z * h.z * h.z * h.z;
    const long double s = alpha * alpha + tan2;
    return alpha * alpha / (std::numbers::pi_v<long double> * cos4 * s * s);
}

std::vector<Pair> pairs_of(float alpha)
{
    Random random(1);
    std::vector<Pair> all;
    for (const double cos : {1.0, 0.7, 0.1, 0.01, 1e-4})
        for (int i = 0; i < 2000; ++i) {
            const Vec3 wo = direction(cos, 1.0);
            const double lean = random.log_uniform(-2, 1) * static_cast<double>(alpha), turn = random.uniform(0, 7);
            const Vec3d h = normalize(Vec3d{lean * std::cos(turn), lean * std::sin(turn), 1});
            const Vec3 wi = to_float(mirrored(to_double(wo), h));
            if (wi.z > 0) all.push_back({wo, wi});
        }
    return all;
}

}  // namespace lancer
