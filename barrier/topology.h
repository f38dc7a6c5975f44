#pragma once
// Which rings hold which: linking numbers of all rings and cables of a net. They cannot change unless a wire passed
// through another, so a run can assert that none did.
#include <string>
#include <vector>

#include "barrier/net.h"

namespace lahar::barrier {

/// A ring's link with another ring or with a cable.
struct Link {
  int other = 0;   ///< number of a ring, or rings + k for cable k
  int number = 0;  ///< linking number, not 0
  bool operator==(const Link&) const = default;
};

struct Topology {
  std::vector<std::vector<Link>> links;  ///< by ring, ascending by `other`
  std::vector<bool> whole;               ///< by ring, then cable: false once a bond has broken; it has no links then
};

/// All links as the net lies now. Takes well below a second for 500 rings.
[[nodiscard]] Topology find_topology(const Net& net, const dem::Particles& particles, const dem::Bonds& bonds);

/// True if all wires that are whole in both have the same links with each other.
[[nodiscard]] bool same_links(const Topology& before, const Topology& now);

/// The first difference in words, empty if there is none.
[[nodiscard]] std::string first_difference(const Topology& before, const Topology& now);

}  // namespace lahar::barrier
