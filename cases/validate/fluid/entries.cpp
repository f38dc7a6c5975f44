#include "cases/validate/fluid/entries.h"

#include "cases/validate/fluid/surface_entries.h"

namespace lahar::validate {

std::vector<Entry> fluid_entries() {
  std::vector<Entry> entries = {
      order_taylor_green(), order_poiseuille(), order_duct(), order_couette(), taylor_green_re1600(),
      cavity_re1000(),      determinism(),      hard_h19(),   shear_layer(),   slipping_box(),
      bingham_channel(),    log_law_channel(),  hard_h12(),
  };
  for (Entry& e : surface_entries()) entries.push_back(std::move(e));
  return entries;
}

}  // namespace lahar::validate
