#include "cases/observers/observer_list.h"

#include <type_traits>

#include "cases/observers/audit.h"
#include "cases/observers/barrier_loads.h"
#include "cases/observers/barrier_response.h"
#include "cases/observers/flow.h"
#include "cases/observers/flow_energy.h"
#include "cases/observers/fluid_cells.h"
#include "cases/observers/fluid_time_step.h"
#include "cases/observers/grain_count.h"
#include "cases/observers/grain_loads.h"
#include "cases/observers/grains.h"
#include "cases/observers/liquid_mass.h"
#include "cases/observers/liquid_momentum.h"
#include "cases/observers/outflow.h"
#include "cases/observers/probes.h"
#include "cases/observers/retention.h"
#include "cases/observers/ring_links.h"
#include "cases/observers/ring_travel.h"
#include "cases/observers/sections.h"
#include "cases/observers/solids_energy.h"

namespace lahar::cases {

namespace {

/// Null where the run has nothing for it. An observer may take the list of those before it.
template <class T>
std::unique_ptr<Observer> make(const Observed& run, const ObserverList& before) {
  if (!T::applies(run)) return nullptr;
  if constexpr (std::is_constructible_v<T, const Observed&, const ObserverList&>)
    return std::make_unique<T>(run, before);
  else
    return std::make_unique<T>(run);
}

/// Every kind of observer, in the order of the columns in series.h5.
constexpr std::unique_ptr<Observer> (*kKinds[])(const Observed&, const ObserverList&) = {
    make<LiquidMass>,      make<LiquidMomentum>, make<Flow>,       make<FluidCells>,   make<FluidTimeStep>,
    make<Outflow>,         make<Grains>,         make<GrainCount>, make<Retention>,    make<FlowEnergy>,
    make<BarrierResponse>, make<BarrierLoads>,   make<GrainLoads>, make<SolidsEnergy>, make<RingTravel>,
    make<Probes>,          make<Sections>,       make<Audit>,      make<RingLinks>,
};

}  // namespace

Observed::Observed(const scene::Scene& scene_of_run, Simulation& simulation_of_run)
    : scene(scene_of_run), simulation(simulation_of_run), section(scene::section_of(scene_of_run)) {
  const Vec3 g = scene.gravity.vector();
  up = g.norm() > 0 ? Vec3(-g.normalized()) : Vec3(Vec3::UnitZ());
  datum = up.dot(Vec3(section.value_or(0.0), 0, scene.measure.energy_datum_z));
}

ObserverList::ObserverList(const scene::Scene& scene, Simulation& simulation) : run_(scene, simulation) {
  for (const auto& kind : kKinds)
    if (auto observer = kind(run_, *this)) observers_.push_back(std::move(observer));
}

std::vector<const Quantity*> ObserverList::quantities() const {
  std::vector<const Quantity*> all;
  for (const auto& o : observers_)
    for (const Quantity& q : o->quantities()) all.push_back(&q);
  return all;
}

void ObserverList::declare(SeriesWriter& series) const {
  for (const Quantity* q : quantities())
    if (q->is_column) series.declare(q->label.name, q->unit, q->meaning);
}

void ObserverList::after_step() {
  for (const auto& o : observers_) o->after_step();
}

void ObserverList::sample(SeriesWriter& series) {
  const double time = run_.simulation.time();
  for (const auto& o : observers_) o->sample(time - last_time_);
  std::vector<double> row;
  for (const Quantity* q : quantities()) {
    if (!q->is_followed()) continue;
    const double value = q->read();
    if (q->is_column) row.push_back(value);
    follow_row(*q, value, time, found_);
  }
  series.append(time, row);
  last_time_ = time;
  is_current_ = true;
}

Metrics ObserverList::metrics() const {
  Metrics all = found_;
  if (is_current_)
    for (const Quantity* q : quantities()) close_books(*q, all);
  return all;
}

std::vector<ResultCheck> ObserverList::checks() const {
  const Metrics known = metrics();
  std::vector<ResultCheck> all;
  for (const auto& o : observers_)
    for (ResultCheck& check : o->checks(known)) all.push_back(std::move(check));
  return all;
}

std::vector<std::string> ObserverList::warnings() const {
  std::vector<std::string> all;
  for (const auto& o : observers_)
    if (std::string text = o->warning(); !text.empty()) all.push_back(std::move(text));
  return all;
}

void ObserverList::finish(const std::filesystem::path& folder) const {
  for (const auto& o : observers_) o->finish(folder);
}

void ObserverList::transfer(Archive& archive) {
  archive.value("last_time", last_time_);
  found_ = metrics();  // a run that goes on may end before its next row
  archive.numbers("found", found_);
  if (archive.loading()) is_current_ = false;
  for (const auto& o : observers_) archive.part(o->name(), *o);
}

}  // namespace lahar::cases
