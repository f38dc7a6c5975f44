// Flow through fixed random arrays of equal spheres, periodic, driven by a body force g: with F the drag without the
// buoyancy of the pressure gradient over 3 pi nu d U (U the superficial velocity), g = 18 nu U phi F / (d^2 (1 - phi)).
#include <fmt/format.h>

#include <numbers>
#include <random>

#include "cases/validate/entry.h"
#include "cases/validate/grains_in_fluid/closed_forms.h"
#include "cases/validate/grains_in_fluid/sphere_flow.h"

namespace lahar::validate {

namespace {

constexpr double kFinal = 3e-3;  // change of the mean velocity between two spans of time

/// Hard spheres in a periodic cube.
class HardSpheres {
 public:
  /// Random places, pushed apart until none overlap.
  HardSpheres(std::size_t count, double box, double diameter, unsigned seed);
  /// Moves them at random, each as often as `sweeps`, never into another (Metropolis et al. 1953): what is left of the
  /// pushing, pairs that almost touch beside voids, makes a pack up to a third more permeable than one of hard
  /// spheres.
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

HardSpheres::HardSpheres(std::size_t count, double box, double diameter, unsigned seed)
    : box_(box), diameter_(diameter), random_(seed), at_(count) {
  for (Vec3& p : at_)
    for (int a = 0; a < 3; ++a) p[a] = box * uniform();
  for (int round = 0; round < 20000; ++round) {
    double worst = 0;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = i + 1; j < count; ++j) {
        const Vec3 d = nearest(at_[j] - at_[i]);
        const double gap = d.norm() - 1.01 * diameter;
        if (gap >= 0) continue;
        worst = std::max(worst, diameter - d.norm());
        at_[j] -= 0.5 * gap * d.normalized(), at_[i] += 0.5 * gap * d.normalized();
      }
    if (worst <= 0) break;
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

constexpr int kSweeps = 3000;

/// What is asked of the packs of a row.
struct Packs {
  double fraction, reynolds, speed;
  int cells_per_diameter;
  int box;    ///< cells along an edge
  int count;  ///< over how many packs drag and Reynolds number are averaged
};

struct Flow {
  double drag = 0, reynolds = 0, diameter = 0, shifted_viscosity = 0;
  coupling::MomentumAudit audit;
};

Flow flow_through(const Packs& pack, unsigned seed, const Immersion& immersion) {
  using std::numbers::pi;
  const double box = pack.box, phi = pack.fraction;
  const auto count = static_cast<std::size_t>(std::lround(6 * phi * std::pow(box / pack.cells_per_diameter, 3) / pi));
  const double d = std::cbrt(6 * phi * box * box * box / (pi * static_cast<double>(count)));
  const double nu = pack.speed * d / pack.reynolds;
  const double g = 18 * nu * pack.speed * phi * drag_of_pack(phi, pack.reynolds) / (d * d * (1 - phi));
  HardSpheres spheres(count, box, d, seed);
  spheres.shake(kSweeps);
  SphereFlow<double> flow(Vec3i::Constant(pack.box), nu, g * Vec3::UnitX(), immersion, spheres.centres(), d / 2,
                          pack.speed / (1 - phi) * Vec3::UnitX());
  const int span = static_cast<int>(std::lround(0.5 * (1 - phi) * pack.speed / g)) + 200;
  double former = 0, mean = 0;
  for (int round = 0; round < 40; ++round) {
    mean = 0;
    for (int s = 0; s < span; ++s) {
      flow.step();
      if (s % 20 == 0) mean += flow.mean_velocity().x() / ((span + 19) / 20);
    }
    if (round > 2 && std::abs(mean / former - 1) < kFinal) break;
    former = mean;
  }
  return {g * d * d * (1 - phi) / (18 * nu * mean * phi), mean * d / nu, d, 3 * nu, flow.audit()};
}

/// Speeds in lattice units for tau - 1/2 of 0.048 and, at Re 100, 0.006.
std::vector<Packs> packs_of(const Context& context) {
  if (context.quick) return {{0.4, 1, 0.002, 8, 24, 4}};
  std::vector<Packs> packs;
  for (const double phi : {0.4, 0.5, 0.55}) {
    packs.push_back({phi, 0.1, 0.0002, 8, 48, 4});
    packs.push_back({phi, 1, 0.002, 8, 48, 4});
    packs.push_back({phi, 10, 0.02, 8, 48, 4});
    packs.push_back({phi, 100, 0.025, 8, 48, 4});
    packs.push_back({phi, 100, 0.025, 16, 96, 1});
  }
  return packs;
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  coupling::MomentumAudit worst;
  for (const Packs& packs : packs_of(context)) {
    // Two relaxation times carry creeping flow with a place of the wall that does not depend on tau, and are unstable
    // at the larger Reynolds numbers.
    Immersion immersion;
    if (packs.reynolds > 5) immersion.collision = lbm::CentralMoments{};
    double drag = 0, reynolds = 0;
    Flow flow;
    for (int k = 0; k < packs.count; ++k) {
      flow = flow_through(packs, static_cast<unsigned>(k + 1), immersion);
      drag += flow.drag / packs.count, reynolds += flow.reynolds / packs.count;
      if (flow.audit.relative() > worst.relative()) worst = flow.audit;
    }
    rows.push_back(
        relative_row(fmt::format("F, phi {:.2f}, Re {:.3g}, {:.1f} cells, tau - 1/2 = {:.2g}, {} packs", packs.fraction,
                                 reynolds, flow.diameter, flow.shifted_viscosity, packs.count),
                     drag, drag_of_pack(packs.fraction, reynolds),
                     context.quick ? 0.15 : 0.10));  // 21 spheres scatter
  }
  rows.push_back(audit_row("worst of all", worst));
  return rows;
}

}  // namespace

Entry random_pack() {
  return {"grains_in_fluid.random_pack",
          {"Beetstra et al. 2007, eq. 17, +-8 % on its data", {"random_array_drag.csv"}},
          run};
}

}  // namespace lahar::validate
