#include "dem/contact/contact_bodies.h"

#include <algorithm>
#include <limits>

namespace lahar::dem {

namespace {

constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

/// Eight particles, one row per number.
struct EightBodies {
  std::array<Row<double>, 3> x, v, w, kicked_v, kicked_w, force, torque;
  Row<double> radius, inverse_mass, inertia, damping;
};

/// Visits each number of `e` with where it comes from.
template <class Fetch>
void for_each_number(EightBodies& e, const Particles& p, const std::vector<double>& damping, const MeanMotion* mean,
                     const Fetch& fetch) {
  const auto vectors = [&](std::array<Row<double>, 3>& to, const Vec3Field& from) {
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
  fetch(e.inertia, p.inertia);
  fetch(e.damping, damping);
}

}  // namespace

void ContactBodies::make_room(const Particles& particles, const ContactParties& parties) {
  const std::size_t places = parties.particle.size();
  rails_.clear();
  for (std::size_t n = 0; n < places && !particles.rails.empty(); ++n)
    if (const Rail* rail = particles.rail_of(parties.particle[n]))
      rails_.push_back({n, {rail->along.x(), rail->along.y(), rail->along.z()}});
  rows_.resize(4 * (places + 1));
  store_aligned(rows_[4 * places], Row<double>{kNowhere, kNowhere, kNowhere, 0, 0, 0, 0, 0});
  store_aligned(rows_[4 * places + 1], Row<double>{0, 0, 0, 0, 0, 0, 0, 1});
  store_aligned(rows_[4 * places + 2], Row<double>{0, 0, 0, 0, 0, 0, 1, 1});
}

void ContactBodies::pack(const Particles& p, const ContactParties& parties, std::span<const std::uint32_t> places,
                         const std::vector<double>& damping, double dt, const MeanMotion* mean) {
  for (std::size_t n = 0; n < places.size(); n += kRow) {  // the arithmetic is the same wherever they lie
    const std::size_t count = std::min(kRow, places.size() - n);
    std::array<ParticleIndex, kRow> index;
    for (std::size_t l = 0; l < kRow; ++l) index[l] = parties.particle[places[n + std::min(l, count - 1)]];
    EightBodies e;
    if (count == kRow && index[kRow - 1] - index[0] == kRow - 1) {
      for_each_number(e, p, damping, mean, [&](Row<double>& to, const std::vector<double>& from) {
        to = load<Row<double>>(&from[index[0]]);
      });
    } else {
      for_each_number(e, p, damping, mean, [&](Row<double>& to, const std::vector<double>& from) {
        to = gather<Row<double>>(from.data(), index.data());
      });
    }
    auto removed = Mask<double, kRow>::all(false);
    for (std::size_t l = 0; l < count; ++l) removed.set(l, p.state[index[l]] == ParticleState::removed);
    e.x[0] = select(removed, Row<double>(kNowhere), e.x[0]);

    const Row<double> kick = (0.5 * dt) * e.inverse_mass;
    const Row<double> turn = select(e.inverse_mass > 0, (0.5 * dt) / e.inertia, Row<double>{});
    std::array<Row<double>, 3> v_end, w_end;
    for (std::size_t a = 0; a < 3; ++a) {
      v_end[a] = e.kicked_v[a] + kick * e.force[a];
      w_end[a] = e.kicked_w[a] + turn * e.torque[a];
    }
    const Row<double>& r = e.radius;
    std::array<Row<double>, kRow> a{e.x[0], e.x[1], e.x[2], e.v[0], e.v[1], e.v[2], v_end[0], v_end[1]};
    const Row<double> rate = e.inverse_mass * e.damping, spare{};
    Row<double> railed{};
    for (auto rail = first_rail_from(places[n]); rail != rails_.end() && rail->place <= places[n + count - 1]; ++rail) {
      const auto at = std::lower_bound(places.begin() + n, places.begin() + n + count, rail->place);
      if (*at == rail->place) railed.set(static_cast<std::size_t>(at - places.begin()) - n, 1);
    }
    std::array<Row<double>, kRow> b{v_end[2], e.w[0], e.w[1], e.w[2], rate, railed, spare, r};
    std::array<Row<double>, kRow> c{r * e.w[0],   r * e.w[1],   r * e.w[2],     r * w_end[0],
                                    r * w_end[1], r * w_end[2], e.inverse_mass, r};
    transpose(a);
    transpose(b);
    transpose(c);
    for (std::size_t l = 0; l < count; ++l) {
      double* rows = rows_[4 * static_cast<std::size_t>(places[n + l])];
      store_aligned(rows, a[l]);
      store_aligned(rows + kRow, b[l]);
      store_aligned(rows + 2 * kRow, c[l]);
    }
  }
}

std::vector<ContactBodies::RailedPlace>::const_iterator ContactBodies::first_rail_from(std::size_t place) const {
  return std::lower_bound(rails_.begin(), rails_.end(), place,
                          [](const RailedPlace& rail, std::size_t p) { return rail.place < p; });
}

ContactBodies::OnRails ContactBodies::on_rails(std::uint32_t owner_at, std::uint32_t partner_at,
                                               const Triple& normal) const {
  OnRails sum{0, 0};
  for (const std::uint32_t at : {owner_at, partner_at}) {
    const double* rows = data() + at;
    const auto rail = first_rail_from(at / kStride);
    double share = 1;
    if (rows[kRow + 5] != 0) share = dot(normal, rail->along) * dot(normal, rail->along);
    sum.inverse_mass += share * rows[2 * kRow + 6];
    sum.damping_rate += share * rows[kRow + 4];
  }
  return sum;
}

}  // namespace lahar::dem
