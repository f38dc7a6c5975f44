#pragma once
// Liquid that enters through a box of cells with a prescribed discharge.
//
// Each step the volume of the hydrograph over that step is put into the columns (along z) of the box in equal parts,
// with the momentum of the entering velocity. It goes to the surface as far as there is one in the box: interface cells
// get it as mass, which makes no pressure, so that a stream that comes from a dry box leaves it as a wedge, at its
// velocity (docs/decisions/0091). Liquid cells get the rest as density (their rest population) and push it out. Where a
// column is dry its lowest free cell is wetted, so that the box fills from below and works on a dry bed, under water
// and in between. Columns with a wall close behind them (upstream) take only what the others cannot: the wall would
// hold what comes there, as do those beside an open face, through which it would leave. What the cells cannot take in a
// step (kLargestDose each) waits for the next. All that entered is booked in LiquidAccount::inflow, from the numbers as
// they were stored.
#include <span>
#include <string>

#include "lbm/free_surface/conversion.h"
#include "lbm/free_surface/hydrograph.h"
#include "lbm/step/cell_moments.h"

namespace lahar::lbm {

inline constexpr double kLargestDose = 0.2;  ///< of a cell's volume in a step

/// SI.
struct InflowOptions {
  std::string name;
  Vec3 lower = Vec3::Zero(), upper = Vec3::Zero();  ///< m; cells with their centre inside
  Vec3 velocity = Vec3::Zero();                     ///< m/s, that the liquid comes with
  Hydrograph discharge;
};

/// m^3, of the cells in the box of an inflow that no wall takes; at least that of one cell.
double free_volume(const InflowOptions& inflow, const Domain& domain);

template <class Real>
class Inflow {
 public:
  Inflow(InflowOptions options, const Domain& domain);

  /// Finds the columns of the box; to be called again when a wall has opened.
  void find_columns(const Domain& domain);

  /// Makes the blocks of the box if something is due in a step of `duration` from `time` on, s.
  void make_room(FluidGrid<Real>& grid, double time, double duration) const;
  /// What is due in a step of `duration` from `time` on, s, comes in the next one.
  void wait(const FluidGrid<Real>& grid, double time, double duration) { owed_ = volume_due(grid, time, duration); }
  /// Puts in what is due in a step of `duration` from `time` on, s. Throws NumericalFailure where the box cannot take
  /// the discharge.
  void feed(FluidLevel<Real>& level, CellConversion<Real>& conversion, double time, double duration, std::int64_t step,
            LiquidAccount& account);
  void transfer(Archive& archive) { archive.value("owed", owed_); }

 private:
  /// A wet cell of the box; masses in those of a full cell.
  struct Taker {
    CellPlace place;
    CellMoments<Real> moments;
    double held, dose;
    bool liquid;
  };
  /// The takers above each other.
  struct Column {
    std::size_t begin, end;
  };

  [[nodiscard]] bool has_wall_behind(const Domain& domain, int x, int y) const;
  [[nodiscard]] double volume_due(const FluidGrid<Real>& grid, double time, double duration) const;
  void collect(FluidLevel<Real>& level, CellConversion<Real>& conversion, const std::vector<Eigen::Vector2i>& places);
  double pour(FluidLevel<Real>& level, std::span<const Column> columns, double due);
  [[nodiscard]] static double share_of_column(std::span<const Column> columns, double due);
  static double largest_dose(const Column& column);
  void require_room(std::int64_t step) const;
  double dose(FluidLevel<Real>& level, const Column& column, double mass);
  static void share_out(std::span<Taker> takers, double mass);
  static double put_in(FluidGrid<Real>& grid, const Taker& t, const Vec3& change);

  InflowOptions options_;
  Vec3i first_, last_;                           ///< cells of the box
  std::vector<Eigen::Vector2i> free_, at_wall_;  ///< columns, without and with a wall behind them
  double owed_ = 0;                              ///< volume due and not yet in, cells
  std::vector<Taker> cells_;
  std::vector<Column> columns_;
};

extern template class Inflow<float>;
extern template class Inflow<double>;

}  // namespace lahar::lbm
