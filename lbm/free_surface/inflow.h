#pragma once
// Liquid that enters through a box of cells with a prescribed discharge.
//
// Each step the volume of the hydrograph over that step is put into the wet cells of the box in equal parts, with the
// momentum of the entering velocity: liquid cells get it as density (their rest population) and push the rest out,
// interface cells as mass. Where the box is dry the lowest free cell of each column (along z) is wetted first, so that
// the box fills from below and works on a dry bed, under water and in between. What the cells cannot take in a step
// (kLargestDose each) waits for the next. All that entered is booked in LiquidAccount::inflow, from the numbers as they
// were stored.
#include <string>

#include "lbm/free_surface/conversion.h"
#include "lbm/free_surface/hydrograph.h"

namespace lahar::lbm {

inline constexpr double kLargestDose = 0.2;  ///< of a cell's volume in a step

/// SI.
struct InflowOptions {
  std::string name;
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();  ///< m; cells with their centre inside
  Vec3 velocity = Vec3::Zero();                     ///< m/s, that the liquid comes with
  Hydrograph discharge;
};

template <class Real>
class Inflow {
 public:
  Inflow(InflowOptions options, const Domain& domain);

  /// Makes the blocks of the box if something is due in a step of `duration` from `time` on, s.
  void make_room(FluidGrid<Real>& grid, double time, double duration) const;
  /// Puts in what is due in a step of `duration` from `time` on, s. Throws NumericalFailure where the box cannot take
  /// the discharge.
  void feed(FluidLevel<Real>& level, CellConversion<Real>& conversion, double time, double duration, std::int64_t step,
            LiquidAccount& account);
  void transfer(Archive& archive) { archive.value("owed", owed_); }

 private:
  [[nodiscard]] double volume_due(const FluidGrid<Real>& grid, double time, double duration) const;
  void collect(FluidLevel<Real>& level, CellConversion<Real>& conversion);
  double dose(FluidLevel<Real>& level, CellPlace place, double mass) const;

  InflowOptions options_;
  Vec3i first_, last_;  ///< cells of the box
  double owed_ = 0;     ///< volume due and not yet in, cells
  std::vector<CellPlace> wet_;
};

extern template class Inflow<float>;
extern template class Inflow<double>;

}  // namespace lahar::lbm
