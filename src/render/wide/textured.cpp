#include "render/wide/kernel.h"

namespace lancer {

template struct WideKernel<Shading::looked_up>;

}  // namespace lancer
