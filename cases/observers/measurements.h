#pragma once
// What a run measures: time series, and the metrics that come out of them. Definitions in docs/outputs.md.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "barrier/net.h"
#include "barrier/response.h"
#include "barrier/topology.h"
#include "cases/files/series_writer.h"
#include "cases/observers/probes.h"
#include "cases/observers/sections.h"
#include "cases/pictures/chart.h"
#include "cases/scene/scene.h"
#include "coupling/coupled_step.h"

namespace lahar::cases {

/// Sums over the wet cells at one moment.
struct FlowFigures {
  double kinetic = 0, potential = 0;      ///< J, about the datum
  Vec3 momentum = Vec3::Zero();           ///< kg m/s
  double front = 0;                       ///< m, see front_of
  double outflow_power = 0;               ///< W, energy flux through the outflow section
  double outflow_rate = 0;                ///< kg/s through that section
  double deepest = 0, deepest_speed = 0;  ///< m, m/s at the section with the largest depth
};

template <class Real>
class Measurements {
 public:
  Measurements(const scene::Scene& scene, coupling::CoupledStep<Real>& step, const barrier::Net* net,
               SeriesWriter& series);

  /// To be called after every step: sums what only lasts for a step.
  void after_step() { probes_->after_step(); }
  /// Takes a row of all series at the present time.
  void sample();
  /// Sums, peaks and crossings so far, for a checkpoint.
  void transfer(Archive& archive);
  /// Time of the last row, s.
  [[nodiscard]] double last_time() const { return last_time_; }
  /// Closes the books: everything that the run has found.
  [[nodiscard]] std::map<std::string, double> metrics();
  /// Rings that have gone through each other since the start, in words; empty if none or no net.
  [[nodiscard]] std::string lost_links() const;
  /// Force sums of the cables over time, for the chart; empty without a barrier.
  [[nodiscard]] std::vector<ChartSeries> cable_chart() const;

 private:
  void declare_columns();
  [[nodiscard]] double height(const Vec3& p) const;
  [[nodiscard]] FlowFigures look_at_fluid();
  void sample_fluid(std::vector<double>& row, double interval);
  void sample_grains(std::vector<double>& row, double interval);
  void sample_barrier(std::vector<double>& row);
  [[nodiscard]] double retention_limit() const;
  void note_arrivals(const FlowFigures& f);
  void note_inflow(const FlowFigures& f);

  const scene::Scene& scene_;
  coupling::CoupledStep<Real>& step_;
  const barrier::Net* net_;
  SeriesWriter& series_;
  std::optional<double> section_;
  Vec3 up_;
  double datum_height_ = 0, last_time_ = 0;
  std::vector<std::uint8_t> crossed_;  // per particle: beyond the outflow section
  double grain_energy_out_ = 0, fluid_energy_out_ = 0, fluid_mass_passed_ = 0;
  double grain_front_ = 0, grain_energy_ = 0;
  std::map<std::string, double> found_;  // metrics as they become known
  std::optional<barrier::Topology> topology_;
  std::optional<Probes<Real>> probes_;
  std::optional<Sections<Real>> sections_;
  std::vector<double> times_;
  std::array<std::vector<double>, barrier::all_components.size()> force_sums_;
};

extern template class Measurements<float>;
extern template class Measurements<double>;

}  // namespace lahar::cases
