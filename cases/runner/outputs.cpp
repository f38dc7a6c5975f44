#include "cases/runner/outputs.h"

#include <fmt/format.h>

#include "cases/observers/picture.h"
#include "cases/observers/png_file.h"
#include "cases/scene/geometry.h"

namespace lahar::cases {

namespace {

constexpr double kHalfStep = 1e-9;  ///< s, so that a frame is not missed by rounding

/// The scene from downstream and above; the whole domain is in view.
Camera camera_of(const scene::Scene& scene, const PictureStyle& style) {
  const ViewBox box{scene.domain.lower, scene.domain.upper};
  return fitted_camera(box, scene.gravity.vector(), {.azimuth_deg = 115, .elevation_deg = 28},
                       static_cast<double>(style.width) / style.height);
}

}  // namespace

template <class Real>
Outputs<Real>::Outputs(const scene::Scene& scene, std::filesystem::path folder)
    : scene_(scene), folder_(std::move(folder)), walls_(scene::make_walls(scene)) {
  if (scene.run.output_interval <= 0) return;
  if (scene.has_solids()) particles_.emplace(folder_);
  if (scene.fluid.enabled) volumes_.emplace(folder_);
}

template <class Real>
void Outputs<Real>::write_due(coupling::CoupledStep<Real>& step) {
  const double t = step.time() + kHalfStep;
  if (scene_.run.output_interval > 0 && t >= static_cast<double>(frames_) * scene_.run.output_interval)
    write_fields(step);
  if (scene_.run.image_interval > 0 && t >= static_cast<double>(pictures_) * scene_.run.image_interval)
    write_picture(step);
}

template <class Real>
void Outputs<Real>::finish(coupling::CoupledStep<Real>& step) {
  if (scene_.run.output_interval > 0 && last_frame_ < step.time()) write_fields(step);
  if (scene_.run.image_interval > 0 && last_picture_ < step.time()) write_picture(step);
}

template <class Real>
void Outputs<Real>::write_fields(coupling::CoupledStep<Real>& step) {
  if (particles_) particles_->write(step.time(), step.solids()->particles(), step.solids()->bonds());
  if (volumes_) volumes_->write(step.time(), step.fluid()->snapshot());
  ++frames_;
  last_frame_ = step.time();
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
  write_png(folder_ / fmt::format("image_{:06d}.png", pictures_),
            render_picture(view, camera_of(scene_, style), style));
  ++pictures_;
  last_picture_ = step.time();
}

template class Outputs<float>;
template class Outputs<double>;

}  // namespace lahar::cases
