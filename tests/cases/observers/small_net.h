#pragma once
// A small hanging net and its observers.
#include <gtest/gtest.h>

#include <memory>

#include "cases/observers/observer_list.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {

class SmallNet : public testing::Test {
 protected:
  scene::Scene scene_ = scene::load(scene::case_file("hanging_net/scene.toml"),
                                    {"barrier.net.width_m=0.38", "barrier.net.height_m=0.26"});
  std::unique_ptr<Simulation> simulation_ = build_simulation(scene_);
  ObserverList observers_{scene_, *simulation_};
  scene::ScratchFolder scratch_;
};

}  // namespace lahar::cases
