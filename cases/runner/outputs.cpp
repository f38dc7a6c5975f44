#include "cases/runner/outputs.h"

#include <fmt/format.h>

#include <cstdio>
#include <vector>

#include "cases/assembly/geometry.h"
#include "cases/files/png_file.h"
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

template <class Real>
Outputs<Real>::Outputs(const scene::Scene& scene, std::filesystem::path folder)
    : scene_(scene),
      folder_(std::move(folder)),
      walls_(scene::make_walls(scene)),
      frames_(scene.run.output_interval),
      pictures_(scene.run.image_interval) {
  if (scene.run.output_interval <= 0) return;
  if (scene.has_solids()) particles_.emplace(folder_);
  if (scene.fluid.enabled) volumes_.emplace(folder_);
}

template <class Real>
void Outputs<Real>::write_due(coupling::CoupledStep<Real>& step) {
  if (frames_.due(step.time())) write_fields(step);
  if (pictures_.due(step.time())) write_picture(step);
}

template <class Real>
void Outputs<Real>::finish(coupling::CoupledStep<Real>& step) {
  if (frames_.wants_last(step.time())) write_fields(step);
  if (pictures_.wants_last(step.time())) write_picture(step);
}

template <class Real>
void Outputs<Real>::write_fields(coupling::CoupledStep<Real>& step) {
  if (particles_) particles_->write(step.time(), step.solids()->particles(), step.solids()->bonds());
  if (volumes_) volumes_->write(step.time(), step.fluid()->snapshot());
  frames_.note(step.time());
}

template <class Real>
void Outputs<Real>::write_picture(coupling::CoupledStep<Real>& step) {
  lbm::FluidSnapshot fluid;
  PictureScene view;
  if (step.solids()) {
    view.particles = &step.solids()->particles();
    view.bonds = &step.solids()->bonds();
  }
  if (step.fluid()) {
    fluid = step.fluid()->snapshot();
    view.fluid = &fluid;
  }
  view.walls = &walls_;
  view.box = {scene_.domain.lower, scene_.domain.upper};
  view.gravity = scene_.gravity.vector();
  view.time_s = step.time();
  PictureStyle style;
  style.title = scene_.identity.title;
  write_png(folder_ / fmt::format("image_{:06d}.png", pictures_.done()),
            render_picture(view, camera_of(scene_, style), style));
  pictures_.note(step.time());
}

template <class Real>
void Outputs<Real>::transfer(Archive& archive) {
  archive.part("frames", frames_);
  archive.part("pictures", pictures_);
  ParticleWriter none(folder_);  // of a run that has no frames of particles
  archive.part("particles", particles_ ? *particles_ : none);
  if (!archive.loading()) return;
  if (volumes_) volumes_.emplace(folder_, static_cast<std::uint64_t>(frames_.done()));
  remove_later_files();
}

/// Numbered files from the next number on.
template <class Real>
void Outputs<Real>::remove_later_files() const {
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

template class Outputs<float>;
template class Outputs<double>;

}  // namespace lahar::cases
