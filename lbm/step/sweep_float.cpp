#include "lbm/step/sweep_kernel.h"

namespace lahar::lbm {

template BlockSweep<float> choose_sweep<float>(const SweepParameters&, bool, bool);

}  // namespace lahar::lbm
