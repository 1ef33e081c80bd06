#include "report/synthetic_study.h"

namespace lancer {

StudyRun synthetic_run(const SyntheticMethod& m, const std::string& scene, uint64_t seed, double slowness,
                       Random& random)
{
    StudyRun run{scene, m.name, seed, {}, false, ""};
    for (uint32_t spp = 1; spp <= m.last_spp; spp *= 2) {
        ErrorPoint p;
        p.spp = spp;
        p.wall_s = spp * m.seconds_per_spp * slowness;
        p.cpu_s = 2 * p.wall_s;
        p.rays_camera = 1000 * spp, p.rays_bounce = 3000 * spp, p.rays_shadow = 2000 * spp;
        p.relmse = m.relmse_1 * std::pow(spp, m.exponent) * std::exp(m.noise * normal(random)) + m.plateau;
        p.rmse = 0.3 * std::sqrt(p.relmse);
        p.relmse_trimmed = 0.8 * p.relmse;
        p.smape = 0.1 * std::sqrt(p.relmse);
        run.points.push_back(p);
    }
    return run;
}

Study synthetic_study(const std::vector<SyntheticMethod>& methods, uint64_t truth_seed, size_t seeds,
                      const std::string& scene)
{
    Random random(truth_seed);
    Study study;
    study.title = "A study";
    study.scenes.push_back({scene, "a scene", "path, 65536 samples", 0});
    for (const SyntheticMethod& m : methods) study.methods.push_back({m.name, "", {}, false, "1"});
    for (uint64_t seed = 1; seed <= seeds; ++seed) {
        const double disturbed = std::exp(0.2 * std::abs(normal(random)));
        for (const SyntheticMethod& m : methods) {
            const double slowness = disturbed * std::exp(0.02 * normal(random));
            study.runs.push_back(synthetic_run(m, scene, seed, slowness, random));
        }
    }
    study.machine = {{"CPU", "a CPU"}, {"threads", "2"}};
    study.baseline = methods.front().name;
    return study;
}

}  // namespace lancer
