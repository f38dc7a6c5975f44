#pragma once
// What the files of WireMap share.
#include <optional>

#include "coupling/wires/wire_map.h"

namespace lahar::coupling {

/// Arms of the cells of a row from a place.
template <class Real>
struct ArmRow {
  Row<Real> x;
  Real y, z;
  [[gnu::always_inline]] static ArmRow from(const Real (&place)[3], int x0, int y, int z) {
    return {(static_cast<Real>(x0) + Real(0.5) - place[0]) + lane_index<Row<Real>>(),
            static_cast<Real>(y) + Real(0.5) - place[1], static_cast<Real>(z) + Real(0.5) - place[2]};
  }
};

/// Sums of eps over the cells of a mask, for each of the two beads.
template <class Real>
struct BeadSums {
  Row<Real> all{0}, second{0};
  [[gnu::always_inline]] void add(const Row<Real>& eps, const Row<Real>& share) { all += eps, second += eps * share; }
  void reduce(double& first_bead, double& second_bead) const {
    second_bead = static_cast<double>(sum_of_lanes(second));
    first_bead = static_cast<double>(sum_of_lanes(all)) - second_bead;
  }
};

/// Calls visit(first cell of the row, what the piece covers of it, the row's y and z) for the rows of a block that the
/// piece reaches, as far as `reach` from its axis.
template <bool kByDistance, class Real, class Visit>
[[gnu::always_inline]] inline void for_cylinder_rows(const GridCylinder<Real>& piece, const Vec3i& lowest, Real reach,
                                                     const Visit& visit) {
  for_rows_in(
      box_of(piece, reach), lowest, [&](int y, int z) __attribute__((always_inline)) {
        const CylinderRow<Real> cover = cylinder_row<kByDistance>(piece, lowest.x(), lowest.y() + y, lowest.z() + z);
        visit(lbm::cell_index(0, y, z), cover, lowest.y() + y, lowest.z() + z);
      });
}

}  // namespace lahar::coupling
