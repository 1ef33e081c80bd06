#include "render/wide/kernel.h"

namespace lancer {

template struct WideKernel<Shading::textured>;

}  // namespace lancer
