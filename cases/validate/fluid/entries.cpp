#include "cases/validate/fluid/entries.h"

namespace lahar::validate {

std::vector<Entry> fluid_entries() {
  return {
      order_taylor_green(),
      order_poiseuille(),
      order_duct(),
      order_couette(),
      taylor_green_re1600(),
      cavity_re1000(),
  };
}

}  // namespace lahar::validate
