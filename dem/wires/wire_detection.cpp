#include "dem/wires/wire_detection.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "dem/wires/spline_segment.h"

namespace lahar::dem {

namespace {

constexpr std::uint64_t kRun = std::uint64_t{1} << 31;  // particles are fewer

std::uint64_t candidate(ParticleId segment, ParticleId partner, bool run) {
  return (static_cast<std::uint64_t>(segment) << 32) + partner + (run ? kRun : 0);
}
ParticleId segment_of(std::uint64_t c) { return static_cast<ParticleId>(c >> 32); }
ParticleId partner_of(std::uint64_t c) { return static_cast<ParticleId>(c & (kRun - 1)); }
bool is_run(std::uint64_t c) { return (c & kRun) != 0; }

bool in_run(const WireSlot& slot, const WireChains& chains, ParticleIndex bead) {
  ParticleIndex k = slot.partner;
  for (std::uint32_t n = 0; n < slot.count; ++n, k = chains.behind(k))
    if (k == bead) return true;
  return false;
}

/// Whether anything that the particle's sphere or segment hangs on can move.
bool can_move(const Particles& p, const WireChains& chains, std::size_t i) {
  bool free = p.inverse_mass[i] > 0;
  for (const ParticleIndex j : {chains.before(i), chains.behind(i)})
    free = free || (j != WireChains::none && p.inverse_mass[j] > 0);
  return free;
}

}  // namespace

bool WireDetection::outdated(const Particles& particles) const {
  return particles.size() != built_at_.size() || any_moved(particles.position, built_at_, move_limit2_);
}

/// What the neighbour list is to see: spheres around the segments of wires; all others as they are.
Particles WireDetection::spheres_around_segments(const Particles& p, const WireChains& chains) const {
  Particles s;
  s.position = p.position;
  s.radius = p.radius;
  s.state = p.state;
  s.numbering = p.numbering;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (s.state[i] == ParticleState::removed) continue;
    if (chains.covered()[i] != 0) s.radius[i] += SplineSegment::extent(chains, p.position, i);
    s.state[i] = can_move(p, chains, i) ? ParticleState::free : ParticleState::fixed;
  }
  return s;
}

/// A segment moves with three beads, each of which may move by half the least of their skins.
void WireDetection::set_move_limits(const std::vector<double>& radius, const WireChains& chains) {
  const auto skin = [&](std::size_t i) { return std::max(options_.relative_skin * radius[i], options_.minimum_skin); };
  move_limit2_.resize(radius.size());
  for (std::size_t i = 0; i < radius.size(); ++i) {
    double least = skin(i);
    for (const ParticleIndex j : {chains.before(i), chains.behind(i)})
      if (j != WireChains::none) least = std::min(least, skin(j));
    move_limit2_[i] = 0.25 * least * least;
  }
}

double WireDetection::rebuild(const Particles& p, const WireChains& chains) {
  std::vector<std::uint8_t> plain(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) plain[i] = chains.covered()[i] == 0 ? 1 : 0;
  // As with two rates: pairs of plain particles are not looked for.
  const Particles spheres = spheres_around_segments(p, chains);
  neighbours_.build(spheres, PairSet{}, {.rate = Rate::fast, .slow = plain.data()});
  built_at_ = p.position;
  set_move_limits(spheres.radius, chains);
  list_candidates(p, chains);
  const auto old = std::exchange(slots_, {});
  for (std::size_t first = 0, last = 0; first < candidates_.size(); first = last) {
    for (last = first; last < candidates_.size() && segment_of(candidates_[last]) == segment_of(candidates_[first]);)
      ++last;
    std::size_t k = first;
    for (; k < last && !is_run(candidates_[k]); ++k) {
      WireSlot slot;
      slot.wire = p.index(segment_of(candidates_[k])), slot.partner = p.index(partner_of(candidates_[k]));
      slot.last = slot.partner;
      slots_.push_back(slot);
    }
    add_runs(chains, p.numbering, k, last);
  }
  return carry_histories(old, chains, p.numbering);
}

void WireDetection::renumber(const Renumbering& change) {
  for (WireSlot& s : slots_)
    for (ParticleIndex* i : {&s.wire, &s.partner, &s.last}) *i = change.to(*i);
  change.move(built_at_);
  change.move(move_limit2_);
}

void WireDetection::list_candidates(const Particles& p, const WireChains& chains) {
  candidates_.clear();
  const auto add_pair = [&](ParticleIndex i, ParticleIndex j) {
    if (chains.near(i, j)) return;
    const bool wire_i = chains.covered()[i] != 0, wire_j = chains.covered()[j] != 0;
    const auto add = [&](ParticleIndex segment, ParticleIndex partner, bool run) {
      candidates_.push_back(candidate(p.id(segment), p.id(partner), run));
    };
    const auto rank = [&](ParticleIndex k) { return std::tuple(!chains.closed(k), p.body[k], p.id(k)); };
    const bool i_gives = wire_i && (!wire_j || rank(i) < rank(j));
    // A run is round at its ends, a segment needs the sphere of the bead that it ends at.
    if (wire_i && (!wire_j || (chains.is_end(j) && !i_gives))) add(i, j, false);
    if (wire_j && (!wire_i || (chains.is_end(i) && i_gives))) add(j, i, false);
    if (wire_i && wire_j) i_gives ? add(i, j, true) : add(j, i, true);
  };
  for (ParticleIndex i = 0; i < p.size(); ++i)
    for (std::uint32_t k = neighbours_.offset()[i]; k < neighbours_.offset()[i + 1]; ++k)
      add_pair(i, neighbours_.neighbour()[k]);
  std::sort(candidates_.begin(), candidates_.end());
}

/// The candidates [first, last) are all that one segment may touch of wires: each stretch of them becomes a run.
void WireDetection::add_runs(const WireChains& chains, const Numbering& numbering, std::size_t first,
                             std::size_t last) {
  if (first == last) return;
  const ParticleId segment_id = segment_of(candidates_[first]);
  const ParticleIndex segment = numbering.index(segment_id);
  const auto listed = [&](ParticleIndex j) {
    return j != WireChains::none && std::binary_search(candidates_.begin() + static_cast<std::ptrdiff_t>(first),
                                                       candidates_.begin() + static_cast<std::ptrdiff_t>(last),
                                                       candidate(segment_id, numbering.id(j), true));
  };
  const auto add_run = [&](ParticleIndex from) {
    WireSlot slot;
    slot.wire = segment, slot.partner = slot.last = from;
    ParticleIndex k = from;
    do ++slot.count, k = chains.behind(k);
    while (k != from && listed(k));
    slots_.push_back(slot);
    return k == from;
  };
  for (std::size_t k = first; k < last; ++k)
    if (const ParticleIndex j = numbering.index(partner_of(candidates_[k])); !listed(chains.before(j))) add_run(j);
  // What is left are rings of which every segment is a candidate: none of them has a beginning.
  std::vector<ParticleIndex> known;
  for (std::size_t k = slots_.size(); k-- > 0 && slots_[k].wire == segment && slots_[k].count > 0;) {
    ParticleIndex j = slots_[k].partner;
    for (std::uint32_t n = 0; n < slots_[k].count; ++n, j = chains.behind(j)) known.push_back(j);
  }
  for (std::size_t k = first; k < last && known.size() < last - first; ++k) {
    const ParticleIndex from = numbering.index(partner_of(candidates_[k]));
    if (std::find(known.begin(), known.end(), from) != known.end()) continue;
    add_run(from);
    ParticleIndex j = from;
    for (std::uint32_t n = 0; n < slots_.back().count; ++n, j = chains.behind(j)) known.push_back(j);
  }
}

double WireDetection::carry_histories(const std::vector<WireSlot>& old, const WireChains& chains,
                                      const Numbering& numbering) {
  double lost = 0;
  std::size_t row = 0;
  for (const WireSlot& was : old) {
    if (was.touching == 0) continue;
    while (row < slots_.size() && numbering.precedes(slots_[row].wire, was.wire)) ++row;
    bool found = false;
    for (std::size_t k = row; k < slots_.size() && slots_[k].wire == was.wire && !found; ++k) {
      WireSlot& slot = slots_[k];
      if ((slot.count == 0) != (was.count == 0) || slot.touching != 0) continue;
      found = slot.count == 0 ? slot.partner == was.partner : in_run(slot, chains, was.last);
      if (found) slot.history = was.history, slot.last = was.last, slot.touching = 1;
    }
    const Triple& d = was.history.tangential_displacement;
    if (!found) lost += 0.5 * was.history.tangential_stiffness * dot(d, d);
  }
  return lost;
}

}  // namespace lahar::dem
