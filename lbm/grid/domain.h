#pragma once
// The box that fluid may fill, cut into cells, and what stands in it: walls, open faces, periodic axes.
#include <array>

#include "core/geometry.h"
#include "lbm/grid/cells.h"

namespace lahar::lbm {

/// Faces of the box in the order x-, x+, y-, y+, z-, z+.
enum class FaceKind : std::uint8_t {
  closed,    ///< a wall, by DomainSpec::slip
  open,      ///< liquid leaves at ambient pressure and does not come back
  periodic,  ///< both faces of an axis; the number of cells must be a multiple of 8
};

/// Where no-slip walls are felt.
enum class WallPlacement : std::uint8_t {
  half_way,      ///< half-way between the cells, wherever the wall is: first order
  interpolated,  ///< at their distance along each link: second order (boundary/wall_reflection.h)
};

struct DomainSpec {
  Vec3 lower = Vec3::Zero(), upper = Vec3::Ones();  ///< m; rounded outwards to whole cells from `lower`
  double cell_size = 0;                             ///< m
  std::array<FaceKind, 6> faces{};
  WallSlip slip = WallSlip::no_slip;  ///< of closed faces; a wall in the same place goes before
  Walls walls;                        ///< signed distances; the closed faces are added as planes
  WallPlacement placement = WallPlacement::half_way;
};

/// Cells that cover a length (both in m), but for 1e-6 of a cell: a whole number, as the domain is cut.
double covering_cells(double length, double cell_size);

class Domain {
 public:
  /// Throws std::logic_error if a periodic axis is not a multiple of 8 cells, or periodic on one side only.
  explicit Domain(DomainSpec spec);

  [[nodiscard]] double cell_size() const { return spec_.cell_size; }
  [[nodiscard]] const Walls& walls() const { return spec_.walls; }
  [[nodiscard]] WallPlacement placement() const { return spec_.placement; }
  /// Share of the way from a cell centre to another, inside a wall, at which the wall begins: above 0, at most 1.
  [[nodiscard]] double wall_share(const Vec3& from, const Vec3& into) const;
  /// Position of the lower corner of cell (0, 0, 0). Along a bounded axis this lies one cell outside the domain, so
  /// that the layer of wall cells shares blocks with the first fluid cells.
  [[nodiscard]] const Vec3& origin() const { return origin_; }
  [[nodiscard]] Vec3 centre(const Vec3i& cell) const {
    return origin_ + spec_.cell_size * (cell.cast<double>() + Vec3::Constant(0.5));
  }
  /// Cell that holds a point.
  [[nodiscard]] Vec3i cell_at(const Vec3& p) const {
    return ((p - origin_) / spec_.cell_size).array().floor().cast<int>();
  }
  /// First cell inside the domain and number of cells, per axis.
  [[nodiscard]] const Vec3i& first() const { return first_; }
  [[nodiscard]] const Vec3i& cells() const { return cells_; }
  /// Last cell, per axis, whose centre is not beyond DomainSpec::upper: where that is no whole cell the last of `cells`
  /// may be.
  [[nodiscard]] Vec3i last_within() const;
  /// Number of blocks after which an axis repeats, 0 for none.
  [[nodiscard]] const Vec3i& period() const { return period_; }
  /// See Walls.
  bool open_walls_by(double time) { return spec_.walls.open_by(time); }
  /// State of a checkpoint: which walls are open.
  void transfer(Archive& archive) { spec_.walls.transfer(archive); }
  /// gas (free), wall, or sink.
  [[nodiscard]] CellType classify(const Vec3i& cell) const;
  /// Index of the wall that a point in walls is of: the deepest, of those in one place the first. How distances are
  /// rounded, or sampled, decides nothing: a wall that ends at a face of the domain goes before the face.
  [[nodiscard]] int wall_of(const Vec3& p) const { return spec_.walls.nearest(p, 1e-3 * spec_.cell_size).wall; }
  /// Signed distance of the nearest wall, m; of a point beyond a periodic face that of its image inside.
  [[nodiscard]] double wall_distance(const Vec3& p) const;

 private:
  [[nodiscard]] bool outside_open_face(const Vec3i& cell) const;

  DomainSpec spec_;
  Vec3 origin_;
  Vec3i first_, cells_, period_ = Vec3i::Zero();
};

}  // namespace lahar::lbm
