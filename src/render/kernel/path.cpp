#include "integrators/path/path.h"
#include "render/estimators/arrivals.h"
#include "render/kernel/kernel.h"

namespace lancer {

template struct Kernels<Path>;
template void Kernels<Path>::trace(const View&, const Accelerator&, const Camera&, uint32_t, const KernelSettings&,
                                   const Path&, Workspace&, Counters&, const ArrivalListener&);

}  // namespace lancer
