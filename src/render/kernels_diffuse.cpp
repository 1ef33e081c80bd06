#include "render/diffuse_kernel.h"

namespace lancer {

template struct DiffuseKernel<false>;

}  // namespace lancer
