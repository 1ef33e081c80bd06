// The page of a study of error against run time: what may be said at the top, then for each scene curves with bands,
// times to errors, gains and slopes with their intervals, pictures at equal time, and the raw data.
#pragma once

#include <string>
#include <vector>

#include "report/page/document.h"
#include "report/study/results.h"

namespace lancer {

// Parts of a scene's picture by the reference, which comes first, and by methods at equal time; `name` of a picture is
// that of its method.
struct SceneCrops {
    std::string scene;
    std::vector<PictureRow> rows;  // the page gives them ids
};

// The study must have passed check_study() (study/check.h). crops: of some of its scenes, each at most once; may be
// empty.
Document make_study_page(const Study& study, const std::vector<SceneCrops>& crops);

}  // namespace lancer
