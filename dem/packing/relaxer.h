#pragma once
// Spheres on their way into a packing: from a random start, under soft frictionless contacts, to rest.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "core/vector.h"
#include "dem/packing/near_lists.h"
#include "dem/packing/packing.h"
#include "dem/particles.h"

namespace lahar::dem {

/// Spheres with soft frictionless contacts in a box with its lower corner at the origin and an open top.
class Relaxer {
 public:
  static constexpr double kGravity = 9.81;  ///< m/s^2

  Relaxer(const PackingSpec& spec, const std::vector<ParticleSpec>& spheres);

  /// Lists near spheres; to be done before anything that feels overlaps. (Before the spheres have places all lie at one
  /// point, where the lists would hold every pair.)
  void list_near() { near_->list(x_); }
  /// A loose start: anywhere in a column of half solid fraction, overlapping.
  void place_at_random();
  /// Pushes apart the overlaps of a random start, without weight or inertia.
  void spread();
  /// Lets the spheres fall under a share of gravity until they lie still, `fall_times` at most.
  void settle(double gravity_share, double fall_times);
  /// Lets overlaps push the spheres apart, without weight and inside the box, until no pair has more than `overlap` of
  /// a radius.
  void relieve(double overlap);
  /// Gives all spheres a random velocity, upwards on average.
  void tap(double speed);

  [[nodiscard]] double max_relative_overlap() const;
  [[nodiscard]] double height() const;
  [[nodiscard]] double surface_height() const;
  [[nodiscard]] const Vec3Field& position() const { return x_; }
  [[nodiscard]] double largest_radius() const { return *std::max_element(radius_.begin(), radius_.end()); }

 private:
  [[nodiscard]] std::size_t size() const { return radius_.size(); }
  [[nodiscard]] double random() { return static_cast<double>(generator_() >> 11) * 0x1.0p-53; }  // [0, 1)
  [[nodiscard]] Vec3 force_on(std::size_t i) const;
  [[nodiscard]] Vec3 wall_force(std::size_t i) const;
  void step(double gravity);
  void descend();
  void clamp_to_box();
  [[nodiscard]] double kinetic_energy() const;

  double width_, depth_;
  std::vector<double> radius_, mass_;
  Vec3Field x_, v_, f_;
  double stiffness_ = 0;  // Pa: contact stiffness / radius
  double time_step_ = 0, weight_ = 0;
  double drag_ = 0;  // 1/s
  std::mt19937_64 generator_;
  std::optional<NearLists> near_;
};

}  // namespace lahar::dem
