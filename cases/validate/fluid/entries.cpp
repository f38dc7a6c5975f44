#include "cases/validate/fluid/entries.h"

namespace lahar::validate {

std::vector<Entry> fluid_entries() {
  return {
      order_taylor_green(), order_poiseuille(), order_duct(), order_couette(), taylor_green_re1600(),
      cavity_re1000(),      determinism(),      hard_h19(),   shear_layer(),
  };
}

}  // namespace lahar::validate
