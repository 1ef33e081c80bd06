#include "render/diffuse_kernel.h"

namespace lancer {

template struct DiffuseKernel<true>;

}  // namespace lancer
