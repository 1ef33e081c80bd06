#include "render/wide/kernel.h"

namespace lancer {

template struct WideKernel<Shading::any>;

}  // namespace lancer
