// Scenes that cannot be built.
#pragma once

#include <gtest/gtest.h>

#include "scene/scene.h"

namespace lancer {

// That building the scene fails, with a message that has these words.
inline void expect_refused(const SceneDescription& d, const std::string& why)
{
    Diagnostics diagnostics;
    try {
        Scene::build(d, d.render, diagnostics);
        ADD_FAILURE() << "no error of: " << why;
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
    }
}

}  // namespace lancer
