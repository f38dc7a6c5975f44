#include "barrier/topology.h"

#include <algorithm>

#include "barrier/linking.h"
#include "core/parallel.h"

namespace lahar::barrier {

namespace {

bool near(const BoundingSphere& a, const BoundingSphere& b) {
  return (a.centre - b.centre).norm() < a.radius + b.radius;
}

/// True if a thread, with its straight continuations, comes into the sphere: only then can it be linked with what is
/// inside.
bool enters(const Polyline& thread, const BoundingSphere& sphere) {
  const Vec3 first = thread.points.front(), last = thread.points.back();
  const double far = 10 * ((sphere.centre - first).norm() + (sphere.centre - last).norm() + sphere.radius);
  const Vec3 along = far * (last - first).normalized();
  const auto close = [&](const Vec3& a, const Vec3& b) {
    const double t = std::clamp((sphere.centre - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (a + t * (b - a) - sphere.centre).norm() <= sphere.radius;
  };
  for (std::size_t s = 0; s < thread.segments(); ++s)
    if (close(thread.start(s), thread.end(s))) return true;
  return close(first - along, first) || close(last, last + along);
}

/// Links without those with wires that are broken in either state.
std::vector<Link> comparable(const Topology& which, const Topology& other, std::size_t ring) {
  std::vector<Link> links = which.links[ring];
  std::erase_if(links, [&](const Link& l) { return !other.whole[static_cast<std::size_t>(l.other)]; });
  return links;
}

std::string in_words(const std::vector<Link>& links) {
  std::string text;
  for (const Link& l : links)
    text += (text.empty() ? "" : ", ") + std::to_string(l.other) + " (" + std::to_string(l.number) + ")";
  return text.empty() ? "none" : text;
}

}  // namespace

Topology find_topology(const Net& net, const dem::Particles& particles, const dem::Bonds& bonds) {
  const std::vector<Polyline> lines = centre_lines(net, particles);
  const std::size_t rings = net.rings.size();
  Topology topology{std::vector<std::vector<Link>>(rings), {}};
  std::vector<BoundingSphere> spheres;
  for (const Polyline& line : lines) spheres.push_back(bounding_sphere(line));
  for (const Wire& wire : net.rings) topology.whole.push_back(is_whole(wire, bonds));
  for (const Wire& wire : net.cables) topology.whole.push_back(is_whole(wire, bonds));
  // Each pair once, by its first ring; a ring's own list is all that a thread writes to.
  parallel_for(0, rings, 1, [&](std::size_t a) {
    if (!topology.whole[a]) return;
    for (std::size_t b = a + 1; b < lines.size(); ++b) {
      const bool cable = b >= rings;
      if (cable && net.span_of_cable(b - rings) != net.span_of_ring(a)) continue;  // its straight ends pass there
      if (!topology.whole[b] || !(cable ? enters(lines[b], spheres[a]) : near(spheres[a], spheres[b]))) continue;
      const int number = cable ? links_with_thread(lines[a], lines[b]) : links(lines[a], lines[b]);
      if (number != 0) topology.links[a].push_back({static_cast<int>(b), number});
    }
  });
  for (std::size_t a = rings; a-- > 0;)  // the number of a pair does not depend on the order
    for (const Link& l : std::vector<Link>(topology.links[a]))
      if (static_cast<std::size_t>(l.other) < rings && static_cast<std::size_t>(l.other) > a)
        topology.links[static_cast<std::size_t>(l.other)].push_back({static_cast<int>(a), l.number});
  for (auto& links_of_ring : topology.links) std::ranges::sort(links_of_ring, {}, &Link::other);
  return topology;
}

std::string first_difference(const Topology& before, const Topology& now) {
  if (before.whole.size() != now.whole.size()) return "another number of wires";
  for (std::size_t r = 0; r < before.links.size(); ++r) {
    if (!before.whole[r] || !now.whole[r]) continue;
    const auto was = comparable(before, now, r), is = comparable(now, before, r);
    if (was != is) return "ring " + std::to_string(r) + " was linked with " + in_words(was) + ", now " + in_words(is);
  }
  return "";
}

bool same_links(const Topology& before, const Topology& now) { return first_difference(before, now).empty(); }

}  // namespace lahar::barrier
