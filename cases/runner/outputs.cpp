#include "cases/runner/outputs.h"

#include <fmt/format.h>

#include <cstdio>
#include <vector>

#include "cases/assembly/geometry.h"
#include "cases/files/png_file.h"
#include "cases/pictures/camera.h"
#include "cases/pictures/picture.h"

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
      frames_(scene.run.output_interval),
      pictures_(scene.run.image_interval) {
  if (scene.run.output_interval <= 0) return;
  if (scene.has_solids()) particles_.emplace(folder_);
  if (scene.fluid.enabled) volumes_.emplace(folder_);
}

void Outputs::write_due(Simulation& run) {
  if (frames_.due(run.time())) write_fields(run);
  if (pictures_.due(run.time())) write_picture(run);
}

void Outputs::finish(Simulation& run) {
  if (frames_.wants_last(run.time())) write_fields(run);
  if (pictures_.wants_last(run.time())) write_picture(run);
  if (particles_) particles_->close();
}

void Outputs::write_fields(Simulation& run) {
  if (particles_) particles_->write(run.time(), run.solids()->particles(), run.solids()->bonds());
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

void Outputs::transfer(Archive& archive) {
  archive.part("frames", frames_);
  archive.part("pictures", pictures_);
  ParticleWriter none(folder_);  // of a run that has no frames of particles
  archive.part("particles", particles_ ? *particles_ : none);
  if (!archive.loading()) return;
  if (volumes_) volumes_.emplace(folder_, static_cast<std::uint64_t>(frames_.done()));
  remove_later_files();
}

/// Numbered files from the next number on.
void Outputs::remove_later_files() const {
  std::vector<std::filesystem::path> later;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    long long n = 0;
    const bool volume = std::sscanf(name.c_str(), "fluid_%6lld", &n) == 1 && name == fmt::format("fluid_{:06d}.vdb", n);
    const bool picture =
        std::sscanf(name.c_str(), "image_%6lld", &n) == 1 && name == fmt::format("image_{:06d}.png", n);
    if ((volume && n >= frames_.done()) || (picture && n >= pictures_.done())) later.push_back(entry.path());
  }
  for (const auto& path : later) std::filesystem::remove(path);
}

}  // namespace lahar::cases
