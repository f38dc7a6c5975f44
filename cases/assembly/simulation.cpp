#include "cases/assembly/simulation.h"

#include <optional>

#include "cases/assembly/build.h"
#include "coupling/coupled_step.h"

namespace lahar::cases {

namespace {

template <class Real>
class CoupledSimulation final : public Simulation {
 public:
  CoupledSimulation(const scene::Scene& scene, Beginning beginning) {
    std::optional<lbm::FluidOptions> fluid;
    if (scene.fluid.enabled) fluid = fluid_options(scene);
    std::optional<dem::Solids> solids;
    const bool fresh = beginning == Beginning::scene;
    if (scene.has_solids()) {
      BuiltSolids built = build_solids(scene, fresh ? GrainStart::packed : GrainStart::placeholders);
      solids.emplace(std::move(built.solids));
      net_ = std::move(built.net);
    }
    step_.emplace(std::move(fluid), std::move(solids), coupling_options(scene));
    if (fresh && step_->solids()) step_->solids()->advance(0);  // forces and energies are those of the start
    if (!step_->fluid()) return;
    if (fresh) step_->fill(liquid_regions(scene));
    view_ = view_of(*step_->fluid());
  }

  void advance() override { step_->advance(); }
  [[nodiscard]] double time() const override { return step_->time(); }
  [[nodiscard]] double time_step() const override { return step_->time_step(); }
  [[nodiscard]] FluidView* fluid() override { return view_.get(); }
  [[nodiscard]] dem::Solids* solids() override { return step_->solids(); }
  [[nodiscard]] const barrier::Net* net() const override { return net_ ? &*net_ : nullptr; }
  [[nodiscard]] const coupling::MomentumAudit& audit() const override { return step_->audit(); }
  [[nodiscard]] Vec3 liquid_momentum() const override { return step_->liquid_momentum(); }
  [[nodiscard]] Vec3 liquid_velocity(const lbm::WetCell& cell) const override { return step_->liquid_velocity(cell); }
  [[nodiscard]] std::size_t wet_beads() const override { return step_->wet_beads(); }

  [[nodiscard]] std::map<std::string, double> seconds() override {
    auto all = step_->timers().seconds();
    if (view_)
      for (const auto& [name, seconds] : view_->seconds()) all[name] = seconds;
    if (step_->solids())
      for (const auto& [name, seconds] : step_->solids()->timers().seconds()) all["solids." + name] = seconds;
    return all;
  }
  void transfer(Archive& archive) override { step_->transfer(archive); }
  void transfer_timers(Archive& archive) override { step_->transfer_timers(archive); }

 private:
  std::optional<barrier::Net> net_;
  std::optional<coupling::CoupledStep<Real>> step_;
  std::unique_ptr<FluidView> view_;
};

}  // namespace

std::unique_ptr<Simulation> build_simulation(const scene::Scene& scene, Beginning beginning) {
  if (scene.run.precision == scene::Precision::float64)
    return std::make_unique<CoupledSimulation<double>>(scene, beginning);
  return std::make_unique<CoupledSimulation<float>>(scene, beginning);
}

}  // namespace lahar::cases
