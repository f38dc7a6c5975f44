#include "dem/contact/contact_materials.h"

#include <limits>

#include "core/check.h"
#include "dem/contact/damping.h"

namespace lahar::dem {

ContactMaterials::ContactMaterials(const Materials& materials) : count_(materials.size()) {
  static_assert(2 * kMost * kMost <= std::numeric_limits<std::uint16_t>::max());
  require(count_ <= kMost, "ContactMaterials: too many materials");
  rows_.resize(2 * count_ * count_);
  for (const bool frictionless : {false, true})
    for (int a = 0; a < static_cast<int>(count_); ++a)
      for (int b = 0; b < static_cast<int>(count_); ++b) {
        const MaterialPair& p = materials.pair(a, b);
        const double rubbing = frictionless ? 0.0 : 1.0;
        store_aligned(rows_[index(a, b, frictionless)],
                      Row<double>{p.effective_modulus, p.effective_shear_modulus, rubbing * p.friction,
                                  damping_ratio(p.restitution), rubbing * p.rolling_friction, 0, 0, 0});
        rolls_ = rolls_ || p.rolling_friction > 0;
      }
}

}  // namespace lahar::dem
