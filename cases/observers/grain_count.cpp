#include "cases/observers/grain_count.h"

#include <algorithm>

#include "cases/observers/grains.h"

namespace lahar::cases {

namespace {

double loose_grains(const dem::Particles& p) {
  double count = 0;
  for (std::size_t i = 0; i < p.size(); ++i) count += is_loose_grain(p, i) ? 1 : 0;
  return count;
}

}  // namespace

bool GrainCount::applies(const Observed& run) {
  return run.simulation.solids() != nullptr && loose_grains(run.simulation.solids()->particles()) > 0;
}

GrainCount::GrainCount(const Observed& run) : Observer(run), behind_(run.simulation.solids()->particles().size()) {
  result("grains_at_start", "1", "loose grains of the scene",
         [this] { return loose_grains(run_.simulation.solids()->particles()); });
  result("grains_gone", "1", "loose grains that have left the domain", [this] { return gone_; });
  if (!run.simulation.solids()->walls().empty())
    result("grains_behind_walls", "1",
           "loose grains whose centre was behind a wall at a row or as they left the domain",
           [this] { return static_cast<double>(std::count(behind_.begin(), behind_.end(), 1)); });
}

bool GrainCount::is_behind_a_wall(std::size_t i) const {
  const dem::Solids& solids = *run_.simulation.solids();
  return solids.walls().nearest(solids.particles().position[i]).distance < 0;
}

/// Grains that were taken out stand still where they left.
void GrainCount::sample(double) {
  const dem::Particles& p = run_.simulation.solids()->particles();
  gone_ = 0;
  for (dem::ParticleId id = 0; id < p.size(); ++id) {
    const dem::ParticleIndex i = p.index(id);
    if (!is_loose_grain(p, i)) continue;
    if (p.state[i] == dem::ParticleState::removed || has_left(run_.scene.domain, p, i)) ++gone_;
    if (behind_[id] == 0 && is_behind_a_wall(i)) behind_[id] = 1;
  }
}

void GrainCount::transfer(Archive& archive) { archive.list_of("behind", behind_, behind_.size()); }

std::vector<ResultCheck> GrainCount::checks(const Metrics& metrics) const {
  return vanishes(metrics, "grains_behind_walls", "grains_behind_walls", 0, "no grain goes through a wall");
}

}  // namespace lahar::cases
