#include "dem/contact/contact_bodies.h"

#include <algorithm>
#include <limits>

#include "core/parallel.h"

namespace lahar::dem {

namespace {

/// Eight particles, one line per number.
struct EightBodies {
  std::array<Line, 3> x, v, w, kicked_v, kicked_w, force, torque;
  Line radius, inverse_mass;
};

/// Visits each number of `e` with where it comes from.
template <class Fetch>
void for_each_number(EightBodies& e, const Particles& p, const MeanMotion* mean, const Fetch& fetch) {
  const auto vectors = [&](std::array<Line, 3>& to, const Vec3Field& from) {
    fetch(to[0], from.x), fetch(to[1], from.y), fetch(to[2], from.z);
  };
  vectors(e.x, p.position);
  vectors(e.v, mean != nullptr ? mean->velocity : p.velocity);
  vectors(e.w, mean != nullptr ? mean->spin : p.angular_velocity);
  vectors(e.kicked_v, p.velocity);
  vectors(e.kicked_w, p.angular_velocity);
  vectors(e.force, p.force);
  vectors(e.torque, p.torque);
  fetch(e.radius, p.radius);
  fetch(e.inverse_mass, p.inverse_mass);
}

}  // namespace

void ContactBodies::pack(const Particles& p, const ContactParties& parties, double dt, const MeanMotion* mean) {
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
  const std::size_t places = parties.particle.size();
  lines_.resize(4 * (places + 1));
  // At most eight places; the arithmetic is the same wherever they lie.
  const auto pack_eight = [&](std::size_t first, std::size_t count) {
    const ParticleIndex* index = &parties.particle[first];
    EightBodies e;
    bool whole = true;
    if (count == kLine && index[kLine - 1] - index[0] == kLine - 1) {
      for_each_number(e, p, mean, [&](Line& to, const std::vector<double>& from) { to = load_eight(&from[index[0]]); });
    } else {
      for_each_number(e, p, mean, [&](Line& to, const std::vector<double>& from) {
        for (std::size_t l = 0; l < kLine; ++l) to[l] = from[index[std::min(l, count - 1)]];
      });
    }
    for (std::size_t l = 0; l < count; ++l) whole = whole && p.state[index[l]] != ParticleState::removed;
    for (std::size_t l = 0; !whole && l < count; ++l)
      if (p.state[index[l]] == ParticleState::removed) e.x[0][l] = nowhere;

    const Line curvature = 1.0 / e.radius;
    const Line kick = (0.5 * dt) * e.inverse_mass, turn = 2.5 * kick * curvature * curvature;
    std::array<Line, 3> v_end, w_end;
    for (std::size_t a = 0; a < 3; ++a) {
      v_end[a] = e.kicked_v[a] + kick * e.force[a];
      w_end[a] = e.kicked_w[a] + turn * e.torque[a];
    }
    const Line& r = e.radius;
    std::array<Line, kLine> a{e.x[0], e.x[1], e.x[2], e.v[0], e.v[1], e.v[2], v_end[0], v_end[1]};
    std::array<Line, kLine> b{v_end[2], e.w[0], e.w[1], e.w[2], w_end[0], w_end[1], w_end[2], r};
    std::array<Line, kLine> c{r * e.w[0],   r * e.w[1],   r * e.w[2],     r * w_end[0],
                              r * w_end[1], r * w_end[2], e.inverse_mass, r};
    transpose(a);
    transpose(b);
    transpose(c);
    for (std::size_t l = 0; l < count; ++l) {
      store_line(lines_[4 * (first + l)], a[l]);
      store_line(lines_[4 * (first + l) + 1], b[l]);
      store_line(lines_[4 * (first + l) + 2], c[l]);
    }
  };
  parallel_for_even_chunks(places, 512, [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; k += kLine) pack_eight(k, std::min(kLine, last - k));
  });
  store_line(lines_[4 * places], Line{nowhere, nowhere, nowhere});
  store_line(lines_[4 * places + 1], Line{0, 0, 0, 0, 0, 0, 0, 1});
  store_line(lines_[4 * places + 2], Line{0, 0, 0, 0, 0, 0, 1, 1});
}

}  // namespace lahar::dem
