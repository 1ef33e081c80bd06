// How pictures for displays (PNG, PPM) are brightened. Scene files and the command line say it.
#pragma once

namespace lancer {

struct Exposure {
    bool is_automatic = false;  // chosen from the picture: render/estimators/auto_exposure.h
    float stops = 0;            // else: by 2^stops
};

}  // namespace lancer
