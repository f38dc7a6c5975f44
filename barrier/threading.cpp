#include "barrier/threading.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/check.h"

namespace lahar::barrier {

namespace {

/// Share of the way from p to q at which that segment goes through the triangle abc (Moeller & Trumbore 1997, J.
/// Graphics Tools 2:21), or nothing.
std::optional<double> pierced_at(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 way = q - p, ab = b - a, ac = c - a, h = way.cross(ac), from = p - a;
  const double volume = ab.dot(h);
  if (volume == 0) return std::nullopt;
  const Vec3 k = from.cross(ab);
  const double u = from.dot(h) / volume, v = way.dot(k) / volume, t = ac.dot(k) / volume;
  if (u < 0 || v < 0 || u + v > 1 || t < 0 || t >= 1) return std::nullopt;
  return t;
}

}  // namespace

std::vector<Threading> threadings(const Net& net) {
  std::vector<Threading> all;
  for (std::size_t c = 0; c < net.cables.size(); ++c)
    for (std::size_t r = 0; r < net.rings.size(); ++r) {
      if (net.span_of_cable(c) != net.span_of_ring(r)) continue;
      const int column = static_cast<int>(r) % net.columns, row = static_cast<int>(r) / net.columns % net.rows;
      const Side side = net.cable_sides[c];
      if ((side == Side::lower && row == 0) || (side == Side::upper && row + 1 == net.rows) ||
          (side == Side::left && column == 0) || (side == Side::right && column + 1 == net.columns))
        all.push_back({r, c});
    }
  return all;
}

std::optional<double> place_on_cable(const Polyline& ring, const Polyline& cable) {
  const BoundingSphere sphere = bounding_sphere(ring);
  std::vector<double> places;
  for (std::size_t s = 0; s < cable.segments(); ++s) {
    const Vec3 &p = cable.start(s), &q = cable.end(s);
    if ((0.5 * (p + q) - sphere.centre).norm() > sphere.radius + 0.5 * (q - p).norm()) continue;
    for (std::size_t k = 0; k < ring.segments(); ++k)
      if (const auto t = pierced_at(p, q, sphere.centre, ring.start(k), ring.end(k)))
        places.push_back(static_cast<double>(s) + *t);
  }
  if (places.empty()) return std::nullopt;
  std::ranges::sort(places);
  return places[places.size() / 2];
}

std::vector<double> places_on_cables(const Net& net, const std::vector<Threading>& threads,
                                     const dem::Particles& particles, const dem::Bonds& bonds) {
  std::vector<double> all(threads.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t k = 0; k < threads.size(); ++k) {
    const Wire &ring = net.rings[threads[k].ring], &cable = net.cables[threads[k].cable];
    if (!is_whole(ring, bonds) || !is_whole(cable, bonds)) continue;
    const auto segment = place_on_cable(centre_line(ring, particles), centre_line(cable, particles));
    const auto first = bonds.rest_length.begin() + static_cast<std::ptrdiff_t>(cable.first_bond);
    const double made = std::accumulate(first, first + static_cast<std::ptrdiff_t>(cable.bonds), 0.0);
    if (segment) all[k] = *segment * made / static_cast<double>(cable.bonds);
  }
  return all;
}

Travel travel_between(const std::vector<double>& before, const std::vector<double>& now) {
  require(before.size() == now.size(), "travel_between: places of other rings");
  Travel travel;
  double sum = 0, count = 0;
  for (std::size_t k = 0; k < now.size(); ++k) {
    const double way = std::abs(now[k] - before[k]);
    if (!std::isfinite(way)) continue;
    sum += way, count += 1;
    travel.furthest = std::max(travel.furthest, way);
  }
  travel.mean = sum / std::max(count, 1.0);
  return travel;
}

void tie_to_cables(const Net& net, const dem::Particles& particles, int sort, dem::Bonds& bonds) {
  for (const auto& [r, c] : threadings(net)) {
    const Wire &ring = net.rings[r], &cable = net.cables[c];
    double nearest = std::numeric_limits<double>::infinity();
    dem::BondSpec tie{0, 0, sort};
    for (dem::ParticleId i = ring.first_bead; i < ring.first_bead + ring.beads; ++i)
      for (dem::ParticleId j = cable.first_bead; j < cable.first_bead + cable.beads; ++j) {
        const double distance =
            (particles.position[particles.index(i)] - particles.position[particles.index(j)]).norm();
        if (distance < nearest) nearest = distance, tie.i = i, tie.j = j;
      }
    bonds.add(tie, particles);
  }
}

}  // namespace lahar::barrier
