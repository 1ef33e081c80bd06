// The page of a study of error against run time: the scenes, what may be said and a table over all of them at the top,
// then for each scene curves with bands,
// times to errors, gains and slopes with their intervals, pictures at equal time, and the raw data.
#pragma once

#include <string>
#include <vector>

#include "report/page/document.h"
#include "report/study/results.h"

namespace lancer {

struct ScenePictures {
    std::string scene;
    // Parts of its picture by the reference, which comes first, and by methods at equal time; `name` of a picture is
    // that of its method. The page gives rows their ids.
    std::vector<PictureRow> rows;
    std::string reference_png;  // the whole picture by the reference: the bytes of a file, or nothing
};

// The study must have passed check_study() (study/check.h). pictures: of some of its scenes, each at most once; may
// be empty.
Document make_study_page(const Study& study, const std::vector<ScenePictures>& pictures);

}  // namespace lancer
