#pragma once
// Energy and front of the loose grains, and those that have passed.
#include <cstdint>
#include <vector>

#include "cases/observers/observer.h"

namespace lahar::cases {

/// Whether a particle is a grain of the flow, or was one: fixed grains are obstacles.
[[nodiscard]] inline bool is_loose_grain(const dem::Particles& p, std::size_t i) {
  return p.kind[i] == dem::ParticleKind::grain && p.state[i] != dem::ParticleState::fixed;
}

/// Whether a grain has left the domain for good and is to be taken out of the scene: one that flies up may come back.
[[nodiscard]] bool has_left(const scene::Domain& domain, const dem::Particles& p, std::size_t i);

/// What is beyond the outflow section at the first row has not passed it, as with the liquid (outflow.h).
class Grains final : public Observer {
 public:
  explicit Grains(const Observed& run);
  static bool applies(const Observed& run) { return run.simulation.solids() != nullptr; }
  [[nodiscard]] std::string_view name() const override { return "grains"; }
  /// Looks before grains that have left are taken out, and with them their speed.
  void after_step() override { note_passages(); }
  void sample(double interval) override;
  void transfer(Archive& archive) override;
  /// J, of all grains at the last row.
  [[nodiscard]] double energy() const { return kinetic_ + potential_; }
  /// J, that grains took with them beyond the outflow section.
  [[nodiscard]] double energy_out() const { return energy_out_; }

 private:
  enum class Way : std::uint8_t { upstream, passed, beyond_at_start };  // of the outflow section; stays once beyond

  void note_passages();

  double kinetic_ = 0, potential_ = 0, front_ = 0, passed_ = 0;  // J, J, m, kg at the last row
  bool has_begun_ = false;                                       // a row was taken
  std::vector<Way> way_;                                         // by id
  double energy_out_ = 0, kinetic_out_ = 0;
};

}  // namespace lahar::cases
