#include "cases/validate/grains_in_fluid/hard_spheres.h"

#include <cmath>
#include <random>

namespace lahar::validate {

namespace {

constexpr int kSweeps = 3000;

class HardSpheres {
 public:
  /// Random places, pushed apart to `apart` diameters until none overlap by more than `allowed` of a diameter.
  HardSpheres(std::size_t count, double box, double diameter, unsigned seed, double apart, double allowed);
  /// Moves each as often as `sweeps`.
  void shake(int sweeps);
  [[nodiscard]] std::vector<Vec3> centres() const;

 private:
  [[nodiscard]] double uniform() { return static_cast<double>(random_()) / 4294967296.0; }
  [[nodiscard]] Vec3 nearest(const Vec3& d) const { return d - box_ * (d / box_).array().round().matrix(); }
  [[nodiscard]] bool is_free(std::size_t i, const Vec3& place) const;

  double box_, diameter_;
  std::mt19937 random_;
  std::vector<Vec3> at_;
};

HardSpheres::HardSpheres(std::size_t count, double box, double diameter, unsigned seed, double apart, double allowed)
    : box_(box), diameter_(diameter), random_(seed), at_(count) {
  for (Vec3& p : at_)
    for (int a = 0; a < 3; ++a) p[a] = box * uniform();
  for (int round = 0; round < 20000; ++round) {
    double worst = 0;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = i + 1; j < count; ++j) {
        const Vec3 d = nearest(at_[j] - at_[i]);
        const double gap = d.norm() - apart * diameter;
        if (gap >= 0) continue;
        worst = std::max(worst, diameter - d.norm());
        at_[j] -= 0.5 * gap * d.normalized(), at_[i] += 0.5 * gap * d.normalized();
      }
    if (worst <= allowed * diameter) break;
  }
}

bool HardSpheres::is_free(std::size_t i, const Vec3& place) const {
  for (std::size_t j = 0; j < at_.size(); ++j)
    if (j != i && nearest(place - at_[j]).squaredNorm() < diameter_ * diameter_) return false;
  return true;
}

void HardSpheres::shake(int sweeps) {
  constexpr double kAccepted = 0.4, kAdjust = 1.02;
  double length = 0.05 * diameter_;  // of a move, adjusted until kAccepted of them succeed
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    std::size_t moved = 0;
    for (std::size_t i = 0; i < at_.size(); ++i) {
      Vec3 place = at_[i];
      for (int a = 0; a < 3; ++a) place[a] += length * (2 * uniform() - 1);
      if (is_free(i, place)) at_[i] = place, ++moved;
    }
    length *= static_cast<double>(moved) > kAccepted * static_cast<double>(at_.size()) ? kAdjust : 1 / kAdjust;
  }
}

std::vector<Vec3> HardSpheres::centres() const {
  std::vector<Vec3> inside = at_;
  for (Vec3& p : inside)
    for (int a = 0; a < 3; ++a) p[a] -= box_ * std::floor(p[a] / box_);
  return inside;
}

}  // namespace

std::vector<Vec3> hard_spheres(std::size_t count, double box, double diameter, unsigned seed) {
  HardSpheres spheres(count, box, diameter, seed, 1.01, 0);
  spheres.shake(kSweeps);
  return spheres.centres();
}

std::vector<Vec3> jammed_spheres(std::size_t count, double box, double diameter, unsigned seed) {
  return HardSpheres(count, box, diameter, seed, 1, kJammedOverlap).centres();
}

}  // namespace lahar::validate
