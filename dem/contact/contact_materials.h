#pragma once
// What contact evaluation needs to know of pairs of materials, one row of eight numbers a pair.
#include <cstdint>

#include "core/row_field.h"
#include "dem/material.h"

namespace lahar::dem {

/// All pairs of materials, then the same once more without friction, for beads of one body.
class ContactMaterials {
 public:
  static constexpr std::size_t kMost = 181;  ///< materials: pairs are numbered in 16 bits

  /// Throws std::logic_error for more materials.
  explicit ContactMaterials(const Materials& materials);

  /// Where the pair (a, b) is found.
  [[nodiscard]] std::uint16_t index(int a, int b, bool frictionless = false) const {
    const auto pair = static_cast<std::size_t>(a) * count_ + static_cast<std::size_t>(b);
    return static_cast<std::uint16_t>(pair + (frictionless ? count_ * count_ : 0));
  }
  /// Effective modulus and shear modulus (Pa), friction, damping ratio, rolling friction.
  [[nodiscard]] const double* operator[](std::uint16_t pair) const { return rows_[pair]; }
  static constexpr std::size_t kRollingFriction = 4;  ///< its place in the row
  /// Whether some pair resists rolling.
  [[nodiscard]] bool rolls() const { return rolls_; }

 private:
  std::size_t count_;
  RowField rows_;
  bool rolls_ = false;
};

}  // namespace lahar::dem
