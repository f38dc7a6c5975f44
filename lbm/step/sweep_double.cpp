#include "lbm/step/sweep_kernel.h"

namespace lahar::lbm {

template BlockSweep<double> choose_sweep<double>(const SweepParameters&, bool, bool);

}  // namespace lahar::lbm
