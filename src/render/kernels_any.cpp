#include "render/wide_kernel.h"

namespace lancer {

template struct WideKernel<Shading::any>;

}  // namespace lancer
