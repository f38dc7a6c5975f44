#pragma once
// A small hanging net under its observers.
#include <gtest/gtest.h>

#include "tests/cases/observers/sampled.h"

namespace lahar::cases {

class SmallNet : public testing::Test {
 protected:
  Sampled run_{scene::load(scene::case_file("hanging_net/scene.toml"),
                           {"barrier.net.width_m=0.38", "barrier.net.height_m=0.26"})};
};

}  // namespace lahar::cases
