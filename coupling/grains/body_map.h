#pragma once
// Where the grains are in the fluid's blocks, and whose momentum is whose.
//
// Liquid and bodies share the cells ("total fill": the mass of a wet cell includes the body's share). Populations of
// wet cells carry the mixture, so that a body that moves inside the liquid pushes it by itself. A body that moves
// between a gas cell and a wet cell is not carried by any population; its change of volume in wet cells is added to the
// interface cells at its waterline, as they have room or liquid for it (docs/decisions/0045). Cells full of bodies hold
// no liquid: what flows into or out of the interface cells among them goes to the same place (docs/decisions/0041). So
// a body entering the water raises the level by its volume, and
//   liquid = sum of wet masses - sum over bodies of their volume in wet cells
// is conserved exactly (docs/coupling.md, docs/decisions/0003).
//
// Only what changed is redone: a body that stands where it stood keeps its blocks and volumes, and a block whose bodies
// all are, move and turn as in the last mapping keeps its fields. The results are those of a full mapping, to the bit.
#include <span>
#include <vector>

#include "coupling/grains/grid_sphere.h"
#include "dem/particles.h"
#include "lbm/step/fluid.h"

namespace lahar::coupling {

template <class Real>
class BodyMap {
 public:
  /// `radius_shift`: what is added to the radius (in cells) at which the fluid comes to rest, with
  /// BodyWeighting::wall_distance; the volume stays that of the body.
  explicit BodyMap(double radius_shift = 0) : radius_shift_(radius_shift) {}

  /// Maps all free and fixed grains (not beads) at their present places (clear_body_fields goes before, see
  /// body_fields.h), and books displaced volume.
  void update(lbm::Fluid<Real>& fluid, const dem::Particles& particles);

  /// Before the first step: maps grains into liquid that was filled around them. The fill is the total of both, so
  /// nothing is displaced; restart the fluid's mass ledger afterwards (Fluid::open_ledger).
  void embed(lbm::Fluid<Real>& fluid, const dem::Particles& particles);

  /// After the fluid step: adds force and torque (SI) of the fluid on each grain. Returns the sum of the forces in lu
  /// before the interior correction, for the audit.
  Vec3 add_forces(lbm::Fluid<Real>& fluid, dem::Particles& particles);

  /// Volume of the mapped bodies inside wet cells, in cells (last update).
  [[nodiscard]] double wet_volume() const { return wet_volume_; }
  [[nodiscard]] std::size_t pairs() const { return pairs_.size(); }
  /// Blocks whose fields the last update wrote.
  [[nodiscard]] std::size_t written_blocks() const;

  /// The next update maps everything again, moved or not.
  void forget() { forgotten_ = true; }

  /// State of a checkpoint: the last mapping, whose displaced volume the next one is compared with
  /// (coupled_step_transfer.cpp).
  void transfer(Archive& archive);

 private:
  /// A body and one block that it reaches.
  struct Pair {
    lbm::BlockIndex block;
    std::uint32_t body;     ///< index into bodies_
    std::uint64_t birth;    ///< of the block
    Vec3i lowest;           ///< first cell of the block as the body sees it: past the end of a periodic axis
    double volume = 0;      ///< cells, over all cells of the block
    double wet_volume = 0;  ///< cells, over wet cells
    // Sums over interface cells that are not full of bodies, of eps, of eps times what is missing to a full cell, and
    // of eps times the liquid in the cell:
    double surface_weight = 0, room = 0, liquid = 0;
    double drift = 0;  ///< mass that those full of bodies gained in the last step, cells
  };
  /// What the cells of a pair do to the body, lu.
  struct Load {
    Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
    double inside = 0;          ///< liquid that stands in the body's place in wet cells, cells
    double held = 0;            ///< liquid in wet cells that a step brings to the body's velocity, cells
    double inside_inertia = 0;  ///< the same times 2/3 of the squared distance from the body's centre
    double held_inertia = 0;
  };
  /// Against the former mapping.
  enum class Change : std::uint8_t {
    none,
    motion,  ///< stands where it stood, with another velocity or spin
    place,
  };
  struct Body {
    dem::ParticleIndex particle;
    std::size_t first_pair = 0, pairs = 0;
    bool all_blocks = true;  ///< every block in reach exists
    Change change = Change::place;
    double volume = 0;                 ///< exact, cells
    double old_wet_volume = 0;         ///< of the former mapping, under present cell types
    Vec3 acceleration = Vec3::Zero();  ///< m/s^2, mean of the last step
    Vec3 spin_up = Vec3::Zero();       ///< rad/s^2, the same
  };
  /// The blocks in reach of a body, x slowest.
  struct Reach {
    Vec3i low, high;
    std::array<lbm::BlockIndex, 8> blocks;  ///< where there are no more than that
  };
  struct Radius {
    double cells = -1, mapped = 0;
  };

  [[nodiscard]] bool is_alive(const lbm::Fluid<Real>& fluid, const Pair& pair) const;
  void map(lbm::Fluid<Real>& fluid, const dem::Particles& particles);
  void measure_old(lbm::Fluid<Real>& fluid);
  void collect(lbm::Fluid<Real>& fluid, const dem::Particles& particles);
  void place_body(const lbm::Fluid<Real>& fluid, const dem::Particles& particles, std::size_t k);
  void look_up_blocks(const lbm::Fluid<Real>& fluid, std::size_t k, const Pair* hint);
  template <class Visit>
  void for_blocks(const lbm::Fluid<Real>& fluid, const Reach& reach, const Visit& visit) const;
  [[nodiscard]] Change compare(const lbm::Fluid<Real>& fluid, std::size_t k, std::size_t former) const;
  void write_pairs(const lbm::Fluid<Real>& fluid, std::size_t k);
  void sort_by_block(const lbm::Fluid<Real>& fluid);
  void normalize();
  void write_fields(lbm::Fluid<Real>& fluid);
  [[nodiscard]] bool is_same(const lbm::BodyFields<Real>& fields, std::size_t block) const;
  void write_block(lbm::Fluid<Real>& fluid, lbm::BlockIndex b);
  void measure_wet(const lbm::Block<Real>& block, Pair& pair) const;
  void settle_covered(const lbm::Block<Real>& block, Pair& pair) const;
  void book_displacement(lbm::Fluid<Real>& fluid);
  void add_loads(const lbm::Fluid<Real>& fluid, std::size_t block);
  void hand_over(const lbm::Fluid<Real>& fluid, dem::Particles& particles, std::size_t k);
  [[nodiscard]] std::span<const std::uint32_t> pairs_of(const std::vector<std::uint32_t>& start,
                                                        std::size_t block) const;
  void prefetch(std::span<const std::uint32_t> pairs) const;
  template <class Visit>
  void for_each_block(const Visit& visit) const;

  std::vector<Body> bodies_, former_;
  std::vector<GridSphere<Real>> spheres_, former_spheres_;
  std::vector<Pair> pairs_, former_pairs_;                 // by body, then block
  std::vector<Reach> reaches_;                             // by body
  std::vector<Load> loads_;                                // by pair
  std::vector<Vec3> forces_;                               // by body, lu, before the interior correction
  std::vector<std::uint32_t> by_block_;                    // pair indices sorted by block
  std::vector<std::uint32_t> block_start_, former_start_;  // per block index, into by_block_
  std::vector<std::uint32_t> next_;                        // scratch of the sort
  std::vector<std::uint32_t> former_body_;                 // per particle, index into former_
  std::vector<std::uint8_t> written_;                      // per block index: fields of the last update
  std::vector<Radius> radii_;                              // per particle
  std::vector<double> old_wet_;                            // per particle
  std::vector<double> displaced_, change_;                 // per body: share for its cells; for the pool
  std::vector<std::uint8_t> alike_;                        // per body: shares go by eps alone
  std::vector<Vec3> last_velocity_;                        // per particle, m/s
  std::vector<Vec3> last_spin_;                            // per particle, rad/s
  std::vector<Vec3> felt_force_;                           // per particle, N: the fluid's force as the body follows it
  std::vector<Vec3> felt_torque_;                          // per particle, N m
  std::vector<std::uint8_t> known_;                        // per particle: last_velocity_ is set
  double radius_shift_;
  double wet_volume_ = 0;
  bool forgotten_ = false;
};

extern template class BodyMap<float>;
extern template class BodyMap<double>;

}  // namespace lahar::coupling
