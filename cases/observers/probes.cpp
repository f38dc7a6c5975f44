#include "cases/observers/probes.h"

#include <algorithm>

#include "cases/observers/fluid_samples.h"
#include "cases/observers/peaks.h"

namespace lahar::cases {

namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};

void append(std::vector<double>& row, const Vec3& v) { row.insert(row.end(), {v.x(), v.y(), v.z()}); }

}  // namespace

template <class Real>
Probes<Real>::Probes(const scene::Scene& scene, coupling::CoupledStep<Real>& step, SeriesWriter& series)
    : scene_(scene), step_(step) {
  for (const auto& p : scene.probes) {
    if (p.kind == scene::ProbeKind::height) series.declare(p.name, "m", "depth of liquid over the point");
    if (p.kind == scene::ProbeKind::pressure) series.declare(p.name, "Pa", "pressure above ambient");
    if (p.kind != scene::ProbeKind::force) continue;
    const auto declare = [&](const std::string& what, const char* unit, const std::string& text) {
      for (const char* axis : kAxes) series.declare(p.name + "_" + what + "_" + axis + "_" + unit, unit, text + axis);
    };
    if (step.fluid()) {
      declare("fluid_force", "N", "mean force of the liquid on the wall since the last row, along ");
      declare("fluid_moment", "Nm", "its moment about the probe's point, about ");
    }
    if (step.solids()) {
      declare("grains_force", "N", "mean force of grains and barrier on the wall since the last row, along ");
      declare("grains_moment", "Nm", "its moment about the probe's point, about ");
    }
    const auto wall =
        std::find_if(scene.walls.begin(), scene.walls.end(), [&](const auto& w) { return w.name == p.wall; });
    forces_.push_back({p.name, static_cast<std::uint32_t>(wall - scene.walls.begin()), p.position, {}, {}});
  }
  if (!forces_.empty() && step.fluid()) step.fluid()->measure_walls();
}

template <class Real>
void Probes<Real>::after_step() {
  if (!step_.solids()) return;
  for (ForceProbe& probe : forces_) {
    probe.grains.force += step_.time_step() * step_.solids()->force_on_wall(probe.wall);
    probe.grains.moment += step_.time_step() * step_.solids()->moment_on_wall(probe.wall);
  }
}

template <class Real>
void Probes<Real>::sample_force(ForceProbe& probe, std::vector<double>& row, double interval,
                                std::map<std::string, double>& metrics) {
  const double rate = interval > 0 ? 1 / interval : 0.0;
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  const auto add = [&](const Load& load) {
    const Vec3 f = rate * load.force, m = rate * load.moment - probe.point.cross(f);
    append(row, f), append(row, m);
    force += f, moment += m;
  };
  if (step_.fluid()) {
    const lbm::WallLoad& now = step_.fluid()->wall_loads()[probe.wall];
    add({now.impulse - probe.fluid_before.force, now.angular_impulse - probe.fluid_before.moment});
    probe.fluid_before = {now.impulse, now.angular_impulse};
  }
  if (step_.solids()) add(probe.grains);
  probe.grains = {};
  note_peak(metrics, probe.name + "_force", "N", force.norm(), step_.time());
  note_peak(metrics, probe.name + "_moment", "Nm", moment.norm(), step_.time());
}

template <class Real>
void Probes<Real>::sample(std::vector<double>& row, double interval, std::map<std::string, double>& metrics) {
  auto force = forces_.begin();
  for (const auto& p : scene_.probes) {
    if (p.kind == scene::ProbeKind::force) {
      sample_force(*force++, row, interval, metrics);
      continue;
    }
    const bool height = p.kind == scene::ProbeKind::height;
    const double value = height ? depth_over(*step_.fluid(), p.position, scene_.domain.upper.z())
                                : pressure_at(*step_.fluid(), p.position);
    row.push_back(value);
    note_peak(metrics, p.name, height ? "m" : "Pa", value, step_.time());
    if (height && value > scene_.fluid.cell_size / 2) metrics.try_emplace(p.name + "_arrival_s", step_.time());
  }
}

template <class Real>
void Probes<Real>::transfer(Archive& archive) {
  for (ForceProbe& probe : forces_) {
    archive.part(probe.name + "_fluid_before", probe.fluid_before);
    archive.part(probe.name + "_grains", probe.grains);
  }
}

template class Probes<float>;
template class Probes<double>;

}  // namespace lahar::cases
