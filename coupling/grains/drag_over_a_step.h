#pragma once
// The impulse of a drag on an averaged grain over a whole step of the fluid. (Wires have dem/liquid_drag.h: bonds would
// shake what is dragged by a force that is held.)
//
// What is held over a step would, were it the drag at its start, throw back what is light and in thick liquid: the slip
// s would become s (1 - x), x = beta dt / m with beta the drag over the slip and m the mass that a change of the slip
// moves, that of the body and of the liquid around it together, 1/(1/m_body + 1/m_liquid). Instead it is that of a slip
// which decays as it goes while something else (weight, bonds, the stream) drives it by a constant amount a step:
//   ds/dt = -(x/dt) s + driven/dt:   what the drag takes off = (1 - e^-x) s + (1 - (1 - e^-x)/x) driven.
// A drag in balance with what drives it is exact, however stiff: nothing is taken off what is held.
#include <cmath>

#include "core/vector.h"

namespace lahar::coupling {

/// What is kept of a body from step to step.
class DraggedSlip {
 public:
  /// Of what drives a slip, each step adds so much of the newest to the mean: with half of it a stiff drag (x = 50)
  /// swings up, with a quarter no drag does (roots of the recursion, for masses that are up to 1.2 times too large).
  static constexpr double kDriveShare = 0.25;

  /// At the start of a step, the slip of now, m/s.
  void begin(const Vec3& slip) {
    if (known_)
      driven_ += kDriveShare * (slip - slip_ + dragged_ - driven_);
    else
      driven_ = Vec3::Zero();
    slip_ = slip, dragged_ = Vec3::Zero(), known_ = true;
  }
  /// What a drag takes in this step off the slip, m/s.
  Vec3 drag(double x) {
    const Vec3 taken = decayed(x) * slip_ + held(x) * driven_;
    dragged_ += taken;
    return taken;
  }
  /// The step over which the forces of now act is `ratio` times the one for which they were worked out.
  void stretch(double ratio) { driven_ *= ratio, dragged_ *= ratio; }
  /// The body is dry: what was is of no use.
  void forget() { known_ = false; }

  static constexpr std::size_t kNumbers = 10;  ///< of a checkpoint
  void store(double* numbers) const {
    for (int a = 0; a < 3; ++a) numbers[a] = slip_[a], numbers[3 + a] = driven_[a], numbers[6 + a] = dragged_[a];
    numbers[9] = known_ ? 1 : 0;
  }
  void load(const double* numbers) {
    for (int a = 0; a < 3; ++a) slip_[a] = numbers[a], driven_[a] = numbers[3 + a], dragged_[a] = numbers[6 + a];
    known_ = numbers[9] != 0;
  }

 private:
  static double decayed(double x) { return -std::expm1(-x); }
  static double held(double x) { return x > 1e-4 ? 1 - decayed(x) / x : x / 2; }

  Vec3 slip_ = Vec3::Zero();     // m/s, at the last step
  Vec3 driven_ = Vec3::Zero();   // m/s a step, of the slip but for the drag, smoothed
  Vec3 dragged_ = Vec3::Zero();  // m/s, that the drag of the last step took off the slip
  bool known_ = false;           // the body was wet at the last step
};

}  // namespace lahar::coupling
