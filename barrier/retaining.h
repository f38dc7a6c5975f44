#pragma once
// Retaining cables: straight cables from the heads of posts to anchors in the ground.
#include <cstdint>
#include <string_view>
#include <vector>

#include "barrier/cable.h"
#include "barrier/post.h"

namespace lahar::barrier {

struct Construction;
struct SpansSpec;

/// An element (elements.h): the cable of one post, or one at every post.
struct RetainingCable {
  static constexpr std::string_view name = "retaining", component = "retaining_cables";
  static constexpr std::string_view meaning = "A cable from the head of a post to an anchor in the ground.";

  std::int64_t post = -1;      ///< number of the post, 0 is the leftmost; -1 for every post
  Vec3 anchor = Vec3::Zero();  ///< m, from the point where the post stands on the line of the net's lower edge
  std::vector<double> dissipators_at{};  ///< fractions of the cable's length from the anchor
  bool operator==(const RetainingCable&) const = default;

  /// Throws InputError for the number of a post that there is not, for what add_retaining refuses, and for a cable that
  /// runs through the net or a post.
  void add_to(Construction& construction, std::vector<Wire>& wires) const;
  [[nodiscard]] double beads(const SpansSpec& spec) const;
  [[nodiscard]] double bond_limit(const SpansSpec& spec) const;
};

/// A retaining cable of this wire from the anchor to the head of a post, with a tie at the head. Returns the wire and
/// the bond of the tie. `sorts` are bond sorts of `bonds`. Throws InputError for an anchor at the post, or one so near
/// that no cable fits.
struct Retaining {
  Wire wire;
  std::size_t tie = 0;
};
Retaining add_retaining(const Post& post, const Vec3& anchor, const std::vector<double>& dissipators_at,
                        const WireProperties& properties, const CableSorts& sorts, int tie_sort, std::int32_t body,
                        dem::Particles& particles, dem::Bonds& bonds);

}  // namespace lahar::barrier
