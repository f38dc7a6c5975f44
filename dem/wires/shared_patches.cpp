#include "dem/wires/shared_patches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace lahar::dem {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The weights of particles on one side of a patch.
struct Weights {
  std::vector<std::pair<ParticleIndex, double>> of;

  void add(const WireSide& side, double share) {
    for (std::size_t k = 0; k < side.count; ++k) {
      const WireShare& b = side.shares[k];
      const auto found = std::find_if(of.begin(), of.end(), [&](const auto& w) { return w.first == b.particle; });
      if (found == of.end())
        of.emplace_back(b.particle, share * b.weight);
      else
        found->second += share * b.weight;
    }
  }
  [[nodiscard]] double inverse_mass(const Particles& p, const Triple& normal) const {
    double sum = 0;
    for (const auto& [i, weight] : of) sum += weight * weight * p.free_share(i, normal) * p.inverse_mass[i];
    return sum;
  }
};

double inverse_mass(const WireContact& c, const Particles& p) {
  double sum = 0;
  for (const WireSide* side : {&c.wire, &c.partner})
    for (std::size_t k = 0; k < side->count; ++k) {
      const WireShare& b = side->shares[k];
      sum += b.weight * b.weight * p.free_share(b.particle, c.normal) * p.inverse_mass[b.particle];
    }
  return sum;
}

}  // namespace

void SharedPatches::list(const std::vector<WireSlot>& slots, const WireChains& chains) {
  std::vector<std::uint32_t> first(chains.covered().size(), kNone);  // slot by segment
  for (auto k = static_cast<std::uint32_t>(slots.size()); k-- > 0;) first[slots[k].wire] = k;
  std::vector<ParticleIndex> run;
  const auto joins_it = [&](const WireSlot& other, const WireSlot& slot) {
    if (other.count == 0 || slot.count == 0) return other.count == slot.count && other.partner == slot.partner;
    ParticleIndex j = other.partner;
    for (std::uint32_t n = 0; n < other.count; ++n, j = chains.behind(j))
      if (std::find(run.begin(), run.end(), j) != run.end()) return true;
    return false;
  };
  beside_.clear();
  for (std::uint32_t k = 0; k < slots.size(); ++k) {
    run.clear();
    ParticleIndex j = slots[k].partner;
    for (std::uint32_t n = 0; n < slots[k].count; ++n, j = chains.behind(j)) run.push_back(j);
    const ParticleIndex next = chains.behind(slots[k].wire);
    if (next == WireChains::none) continue;
    for (std::uint32_t m = first[next]; m < slots.size() && slots[m].wire == next; ++m)
      if (joins_it(slots[m], slots[k])) beside_.emplace_back(k, m);
  }
  place_.assign(slots.size(), kNone);
}

std::uint32_t SharedPatches::root_of(std::uint32_t k) {
  while (up_[k] != k) k = up_[k] = up_[up_[k]];
  return k;
}

void SharedPatches::share_out(std::span<WireTouch* const> touching, const Particles& particles) {
  up_.resize(touching.size());
  std::iota(up_.begin(), up_.end(), 0U);
  for (std::uint32_t n = 0; n < touching.size(); ++n) {
    place_[touching[n]->slot] = n;
    touching[n]->share = touching[n]->yields = 1;
  }
  bool shared = false;
  for (const auto& [k, m] : beside_) {
    if (place_[k] == kNone || place_[m] == kNone) continue;
    const std::uint32_t a = root_of(place_[k]), b = root_of(place_[m]);
    up_[std::max(a, b)] = std::min(a, b);
    shared = true;
  }
  for (const WireTouch* touch : touching) place_[touch->slot] = kNone;
  if (!shared) return;
  by_root_.clear();
  for (std::uint32_t n = 0; n < touching.size(); ++n) by_root_.emplace_back(root_of(n), n);
  std::sort(by_root_.begin(), by_root_.end());
  for (std::size_t first = 0, last = 0; first < by_root_.size(); first = last) {
    patch_.clear();
    for (last = first; last < by_root_.size() && by_root_[last].first == by_root_[first].first; ++last)
      patch_.push_back(touching[by_root_[last].second]);
    if (patch_.size() > 1) share_out_one(patch_, particles);
  }
}

void SharedPatches::share_out_one(std::span<WireTouch* const> patch, const Particles& particles) {
  double integral = 0;
  for (const WireTouch* touch : patch) integral += touch->integral;
  Weights wire, partner;
  for (WireTouch* touch : patch) {
    touch->share = touch->integral / integral;
    wire.add(touch->contact.wire, touch->share), partner.add(touch->contact.partner, touch->share);
  }
  for (WireTouch* touch : patch) {
    const Triple& normal = touch->contact.normal;
    const double all = wire.inverse_mass(particles, normal) + partner.inverse_mass(particles, normal);
    if (all > 0) touch->yields = inverse_mass(touch->contact, particles) / all;
  }
}

}  // namespace lahar::dem
