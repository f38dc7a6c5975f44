#include "cases/runner/outputs.h"

#include <fmt/format.h>

#include <vector>

#include "cases/assembly/geometry.h"
#include "cases/files/png_file.h"
#include "cases/pictures/camera.h"
#include "cases/pictures/force_map.h"
#include "cases/pictures/picture.h"
#include "cases/runner/output_folder.h"

namespace lahar::cases {

namespace {

/// The scene from downstream and above; the whole domain is in view.
Camera camera_of(const scene::Scene& scene, const PictureStyle& style) {
  const ViewBox box{scene.domain.lower, scene.domain.upper};
  return fitted_camera(box, scene.gravity.vector(), {.azimuth_deg = 115, .elevation_deg = 28},
                       static_cast<double>(style.width) / style.height);
}

}  // namespace

Outputs::Outputs(const scene::Scene& scene, std::filesystem::path folder)
    : scene_(scene),
      folder_(std::move(folder)),
      walls_(scene::make_walls(scene)),
      particles_(folder_),
      frames_(scene.run.output_interval),
      pictures_(scene.run.image_interval),
      force_maps_(scene.barrier.enabled ? scene.run.force_map_interval : 0.0) {
  if (scene.run.output_interval > 0 && scene.fluid.enabled) volumes_.emplace(folder_);
}

void Outputs::write_due(Simulation& run) {
  if (frames_.due(run.time())) write_fields(run);
  if (pictures_.due(run.time())) write_picture(run);
  if (force_maps_.due(run.time())) write_force_map(run);
}

void Outputs::finish(Simulation& run) {
  if (frames_.wants_last(run.time())) write_fields(run);
  if (pictures_.wants_last(run.time())) write_picture(run);
  if (force_maps_.wants_last(run.time())) write_force_map(run);
  particles_.close();
}

void Outputs::write_fields(Simulation& run) {
  if (run.solids()) particles_.write(run.time(), run.solids()->particles(), run.solids()->bonds());
  if (volumes_) volumes_->write(run.time(), run.fluid()->snapshot());
  frames_.note(run.time());
}

void Outputs::write_picture(Simulation& run) {
  lbm::FluidSnapshot fluid;
  PictureScene view;
  if (run.solids()) {
    view.particles = &run.solids()->particles();
    view.bonds = &run.solids()->bonds();
  }
  if (run.fluid()) {
    fluid = run.fluid()->snapshot();
    view.fluid = &fluid;
  }
  walls_.open_by(run.time());
  view.walls = &walls_;
  view.box = {scene_.domain.lower, scene_.domain.upper};
  view.gravity = scene_.gravity.vector();
  view.time_s = run.time();
  PictureStyle style;
  style.title = scene_.identity.title;
  write_png(folder_ / fmt::format("image_{:06d}.png", pictures_.done()),
            render_picture(view, camera_of(scene_, style), style));
  pictures_.note(run.time());
}

void Outputs::write_force_map(Simulation& run) {
  const barrier::Net& net = *run.net();
  ForceMap map;
  map.particles = &run.solids()->particles();
  map.bonds = &run.solids()->bonds();
  map.first_bond = net.first_bond, map.bond_count = net.bonds;
  map.across = net.across, map.up = net.up;
  Eigen::Array2d lower(0, 0),
      upper(scene_.barrier.net.width, scene_.barrier.net.height);  // of a span; and of all built
  for (std::size_t k = 0; k < net.start.size(); ++k) {
    const Vec3 from_corner = net.start[k] - scene_.barrier.net.origin;
    const Eigen::Array2d at(from_corner.dot(net.across), from_corner.dot(net.up));
    lower = lower.min(at), upper = upper.max(at);
  }
  map.origin = scene_.barrier.net.origin + lower.x() * net.across + lower.y() * net.up;
  map.width = upper.x() - lower.x(), map.height = upper.y() - lower.y();
  map.time_s = run.time();
  map.title = scene_.identity.title;
  if (first_places_.empty())
    for (dem::ParticleId id = 0; id < map.particles->size(); ++id)
      first_places_.push_back(map.particles->position[map.particles->index(id)]);
  else
    map.before = &first_places_;
  write_png(folder_ / fmt::format("forces_{:06d}.png", force_maps_.done()), force_map(map));
  force_maps_.note(run.time());
}

void Outputs::transfer(Archive& archive) {
  archive.part("frames", frames_);
  archive.part("pictures", pictures_);
  archive.part("force_maps", force_maps_);
  archive.list("first_places", first_places_);
  archive.part("particles", particles_);
  if (!archive.loading()) return;
  if (frames_.runs()) particles_.take_up();
  if (volumes_) volumes_.emplace(folder_, static_cast<std::uint64_t>(frames_.done()));
  remove_later_files();
}

/// Numbered files from the next number on.
void Outputs::remove_later_files() const {
  std::vector<std::filesystem::path> later;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    const auto is_later = [&](const char* stem, const char* ending, const Schedule& schedule) {
      return schedule.runs() && number_of_file(name, stem, ending) >= schedule.done();
    };
    if (is_later("fluid_", ".vdb", frames_) || is_later("image_", ".png", pictures_) ||
        is_later("forces_", ".png", force_maps_))
      later.push_back(entry.path());
  }
  for (const auto& path : later) std::filesystem::remove(path);
}

}  // namespace lahar::cases
