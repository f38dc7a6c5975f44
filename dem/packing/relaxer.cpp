#include "dem/packing/relaxer.h"

#include <cmath>
#include <numeric>
#include <utility>

#include "core/parallel.h"
#include "core/sphere.h"

namespace lahar::dem {

namespace {

constexpr double kStartFraction = 0.5;   // solid fraction of the random start
constexpr double kSoftOverlap = 0.01;    // overlap / radius at the floor while settling: soft, for long time steps
constexpr double kContactDamping = 0.3;  // of critical
constexpr double kStepAngle = 0.3;       // time step x frequency of the stiffest single contact
constexpr double kSkin = 0.4;            // of the smallest radius
constexpr std::size_t kChunk = 256;      // spheres
constexpr double kStill = 1e-5;          // kinetic energy / (weight x largest radius) of spheres at rest
constexpr double kDescent = 0.3;         // share of an overlap that one contact removes per step of descent
constexpr int kSpreadSteps = 300;
constexpr int kMaxReliefSteps = 5000;
constexpr double kTiny = 1e-300;

/// Linear spring and dashpot along one contact: force on the sphere, along `normal` out of it.
Vec3 contact_force(double overlap, double closing_speed, double stiffness, double mass, const Vec3& normal) {
  const double damping = 2 * kContactDamping * std::sqrt(stiffness * mass);
  return -std::max(stiffness * overlap + damping * closing_speed, 0.0) * normal;
}

/// Height under which 99.5 % of the spheres' tops lie.
double quantile_height(std::vector<double> tops) {
  if (tops.empty()) return 0;
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.995 * static_cast<double>(tops.size()))) - 1;
  std::nth_element(tops.begin(), tops.begin() + rank, tops.end());
  return tops[static_cast<std::size_t>(rank)];
}

}  // namespace

Relaxer::Relaxer(const PackingSpec& spec, const std::vector<ParticleSpec>& spheres)
    : width_(spec.upper.x() - spec.lower.x()), depth_(spec.upper.y() - spec.lower.y()), generator_(spec.seed) {
  for (const ParticleSpec& s : spheres) {
    radius_.push_back(s.radius);
    mass_.push_back(s.density * sphere_volume(s.radius));
    weight_ += mass_.back() * kGravity;
    x_.push_back(s.position - spec.lower);
  }
  stiffness_ = 4 * weight_ / (width_ * depth_) / kSoftOverlap;
  double fastest = 0;
  for (std::size_t i = 0; i < size(); ++i) fastest = std::max(fastest, stiffness_ * radius_[i] / mass_[i]);
  time_step_ = kStepAngle / std::sqrt(fastest);
  drag_ = std::sqrt(kGravity / largest_radius());
  for (Vec3Field* field : {&v_, &f_}) field->resize(size());
  near_.emplace(width_, depth_, radius_, kSkin * *std::min_element(radius_.begin(), radius_.end()));
}

void Relaxer::place_at_random() {
  double volume = 0;
  for (const double r : radius_) volume += sphere_volume(r);
  // At least two of the largest: spheres at one height cannot push each other up.
  const double height = std::max(volume / (width_ * depth_) / kStartFraction, 4 * largest_radius());
  for (std::size_t i = 0; i < size(); ++i) {
    const double r = radius_[i];
    const auto within = [&](double extent) { return r + random() * std::max(extent - 2 * r, 0.0); };
    const double x = within(width_), y = within(depth_), z = within(height);
    x_.set(i, {x, y, z});
  }
  list_near();
}

Vec3 Relaxer::wall_force(std::size_t i) const {
  const double r = radius_[i], k = stiffness_ * r;
  Vec3 force = Vec3::Zero();
  const auto push = [&](double distance, const Vec3& outwards) {
    if (distance < r) force += contact_force(r - distance, v_[i].dot(outwards), k, mass_[i], outwards);
  };
  push(x_.z[i], -Vec3::UnitZ());
  push(x_.x[i], -Vec3::UnitX());
  push(x_.y[i], -Vec3::UnitY());
  push(width_ - x_.x[i], Vec3::UnitX());
  push(depth_ - x_.y[i], Vec3::UnitY());
  return force;
}

Vec3 Relaxer::force_on(std::size_t i) const {
  Vec3 force = wall_force(i);
  const Vec3 x = x_[i], v = v_[i];
  const double r = radius_[i], m = mass_[i];
  for (const std::uint32_t j : near_->of(i)) {
    const Vec3 arm = x_[j] - x;
    const double reach = r + radius_[j], squared = arm.squaredNorm();
    if (squared >= reach * reach || squared == 0) continue;
    const double distance = std::sqrt(squared);
    const Vec3 normal = arm / distance;
    const double stiffness = 2 * stiffness_ * r * radius_[j] / reach;
    force += contact_force(reach - distance, (v - v_[j]).dot(normal), stiffness, m * mass_[j] / (m + mass_[j]), normal);
  }
  return force;
}

void Relaxer::step(double gravity) {
  near_->update(x_);
  parallel_for(0, size(), kChunk, [&](std::size_t i) { f_.set(i, force_on(i)); });
  const double kept = 1 - drag_ * time_step_;
  for (std::size_t i = 0; i < size(); ++i) {
    v_.set(i, kept * v_[i] + time_step_ / mass_[i] * f_[i] - Vec3(0, 0, time_step_ * gravity));
    x_.add(i, time_step_ * v_[i]);
  }
}

/// Steepest descent: each sphere moves by a share of the overlaps it feels, and by no more than a tenth of its radius,
/// so that spheres that start on top of each other are not shot away.
void Relaxer::descend() {
  near_->update(x_);
  parallel_for(0, size(), kChunk, [&](std::size_t i) { f_.set(i, force_on(i)); });
  for (std::size_t i = 0; i < size(); ++i) {
    const Vec3 move = kDescent / (stiffness_ * radius_[i]) * f_[i];
    const double limit = 0.1 * radius_[i];
    x_.add(i, move * std::min(1.0, limit / std::max(move.norm(), kTiny)));
  }
}

void Relaxer::spread() {
  for (int s = 0; s < kSpreadSteps; ++s) descend();
}

double Relaxer::kinetic_energy() const {
  double e = 0;
  for (std::size_t i = 0; i < size(); ++i) e += 0.5 * mass_[i] * v_[i].squaredNorm();
  return e;
}

void Relaxer::settle(double gravity_share, double fall_times) {
  const double still = kStill * weight_ * gravity_share * largest_radius();  // J
  const int steps = static_cast<int>(fall_times * std::sqrt(2 * height() / kGravity) / time_step_);
  for (int s = 1; s <= steps; ++s) {
    step(gravity_share * kGravity);
    if (s % 50 == 0 && kinetic_energy() < still) break;
  }
}

void Relaxer::relieve(double overlap) {
  v_.fill(Vec3::Zero());
  clamp_to_box();  // first, so that walls throw nothing off
  for (int s = 1; s <= kMaxReliefSteps; ++s) {
    step(0);
    clamp_to_box();
    if (s % 10 == 0 && max_relative_overlap() < overlap) break;
  }
  v_.fill(Vec3::Zero());
}

void Relaxer::tap(double speed) {
  for (std::size_t i = 0; i < size(); ++i) {
    const double x = random() - 0.5, y = random() - 0.5, z = random();
    v_.add(i, 2 * speed * Vec3(x, y, z));
  }
}

void Relaxer::clamp_to_box() {
  for (std::size_t i = 0; i < size(); ++i) {
    const double r = radius_[i];
    x_.set(i, {std::clamp(x_.x[i], r, width_ - r), std::clamp(x_.y[i], r, depth_ - r), std::max(x_.z[i], r)});
  }
}

double Relaxer::max_relative_overlap() const {
  double worst = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const double r = radius_[i];
    const double wall = std::min({x_.x[i], x_.y[i], x_.z[i], width_ - x_.x[i], depth_ - x_.y[i]});
    worst = std::max(worst, (r - wall) / r);
    for (const std::uint32_t j : near_->of(i))
      worst = std::max(worst, (r + radius_[j] - (x_[j] - x_[i]).norm()) / std::min(r, radius_[j]));
  }
  return worst;
}

double Relaxer::height() const {
  std::vector<double> tops(size());
  for (std::size_t i = 0; i < size(); ++i) tops[i] = x_.z[i] + radius_[i];
  return quantile_height(std::move(tops));
}

double Relaxer::surface_height() const {
  constexpr double kLines = 4e6;  // enough for a mean, however small the smallest sphere is
  const double spacing =
      std::max(0.05 * *std::min_element(radius_.begin(), radius_.end()), std::sqrt(width_ * depth_ / kLines));
  const auto lines = [&](double extent) { return static_cast<int>(std::ceil(extent / spacing)); };
  const int nx = lines(width_), ny = lines(depth_);
  const double dx = width_ / nx, dy = depth_ / ny;
  std::vector<double> highest(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny), 0.0);
  for (std::size_t i = 0; i < size(); ++i) {
    const Vec3 x = x_[i];
    const double r = radius_[i];
    const auto first = [&](double p, double d) { return std::max(0, static_cast<int>(std::ceil((p - r) / d - 0.5))); };
    const auto last = [&](double p, double d, int n) { return std::min(n - 1, static_cast<int>((p + r) / d - 0.5)); };
    for (int b = first(x.y(), dy); b <= last(x.y(), dy, ny); ++b)
      for (int a = first(x.x(), dx); a <= last(x.x(), dx, nx); ++a) {
        const double u = (a + 0.5) * dx - x.x(), v = (b + 0.5) * dy - x.y(), left = r * r - u * u - v * v;
        double& top = highest[static_cast<std::size_t>(b) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(a)];
        if (left > 0) top = std::max(top, x.z() + std::sqrt(left));
      }
  }
  return std::accumulate(highest.begin(), highest.end(), 0.0) / static_cast<double>(highest.size());
}

}  // namespace lahar::dem
