#include "render/wide_kernel.h"

namespace lancer {

template struct WideKernel<Shading::plain>;

}  // namespace lancer
