#include "cases/observers/solids_energy.h"

namespace lahar::cases {

SolidsEnergy::SolidsEnergy(const Observed& run) : Observer(run) {
  const auto in_kJ = [this](const char* name, const char* meaning, Read read) {
    result(name, "kJ", meaning, [read = std::move(read)] { return read() / 1000; });
  };
  column("solids_friction_J", "J", "lost by sliding and rolling contacts since the first row",
         [this] { return friction(); });
  column("solids_damping_J", "J", "lost by dampers of contacts since the first row", [this] { return damping(); });
  if (run.scene.barrier.enabled)
    column("bonds_lost_J", "J", "lost by dampers, plastic stages and breakage of bonds since the first row",
           [this] { return bonds(); });
  column("solids_work_J", "J", "work of the liquid and of moving walls on grains and barrier since the first row",
         [this] { return work(); });
  column("solids_energy_gap_J", "J",
         "stored + lost + carried away - work of grains and barrier, less what it was at the first row: the error of "
         "the time step",
         [this] { return gap(); })
      .peak_magnitude("solids_energy_gap_max_J", "largest `solids_energy_gap_J` of the rows, without its sign");
  hidden([this] { return turned_over(); })
      .peak("solids_energy_turned_over_max_J", "J",
            "kinetic energy of grains and barrier + lost + work without its sign, the largest of the rows");
  in_kJ("solids_friction_kJ", "lost by sliding and rolling contacts", [this] { return friction(); });
  in_kJ("solids_damping_kJ", "lost by dampers of contacts", [this] { return damping(); });
  in_kJ("solids_work_kJ", "work of the liquid and of moving walls on grains and barrier", [this] { return work(); });
}

void SolidsEnergy::sample(double) {
  now_ = run_.simulation.solids()->ledger();
  if (started_) return;
  started_ = true;
  total_at_start_ = now_.total();
  friction_at_start_ = now_.friction + now_.rolling;
  damping_at_start_ = now_.contact_damping;
  bonds_at_start_ = now_.bonds.dissipated();
  work_at_start_ = now_.external_work;
}

void SolidsEnergy::transfer(Archive& archive) {
  archive.value("started", started_);
  archive.value("total_at_start", total_at_start_);
  archive.value("friction_at_start", friction_at_start_);
  archive.value("damping_at_start", damping_at_start_);
  archive.value("bonds_at_start", bonds_at_start_);
  archive.value("work_at_start", work_at_start_);
}

std::vector<ResultCheck> SolidsEnergy::checks(const Metrics& metrics) const {
  const auto gap = metrics.find("solids_energy_gap_max_J"), all = metrics.find("solids_energy_turned_over_max_J");
  constexpr int first_steps = 1000;  // of what begins to move the error is 1/n of the energy after n steps, and more
  if (gap == metrics.end() || all == metrics.end() || run_.simulation.solids()->step_count() < first_steps) return {};
  constexpr double tolerance = 0.02;
  // Where nothing but rounding moves there is nothing to judge: of what bonds and contacts hold, or of nothing.
  const double rounding = 1e-12 * std::abs(total_at_start_) + 1e-15;
  if (all->second <= rounding) return {};
  const double share = gap->second / all->second;
  return {{"solids_energy_ledger", share, 0, tolerance, share <= tolerance, "conservation of energy"}};
}

}  // namespace lahar::cases
