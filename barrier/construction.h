#pragma once
// A barrier whose nets and posts stand, as elements find it.
#include <optional>
#include <utility>

#include "barrier/spans.h"

namespace lahar::barrier {

struct Construction {
  const SpansSpec& spec;
  dem::Particles& particles;
  dem::Bonds& bonds;
  Net& net;               ///< with its posts; an element adds its dissipators and ties
  int tie_sort = 0;       ///< bond sort of shackles
  std::int32_t body = 0;  ///< number of the next body
  std::optional<CableSorts> sorts{};

  [[nodiscard]] std::int32_t next_body() { return body++; }
  /// Bond sorts of cables as those of the net.
  [[nodiscard]] const CableSorts& cable_sorts() {
    if (!sorts) {
      const int wire = bonds.add_sort(with_wire_radius(spec.net.cable, spec.net.wire_diameter));
      sorts = {wire, bonds.add_sort(with_wire_radius(spec.net.dissipator, spec.net.wire_diameter))};
    }
    return *sorts;
  }
};

}  // namespace lahar::barrier
