// What `lahar check` prints.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cases/runner/check.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

using scene::case_file;
using scene::load;

TEST(ReportText, NamesFiguresAndWarnings) {
  scene::Scene debris = scene::debris_flow();
  debris.solids.contact_modulus_scale = 0.1;
  const std::string text = report_text(debris, check_scene(debris));
  for (const char* part :
       {"debris_flow: ", "cells ", "memory", "time step", "tau", "Ma ", "Re, Fr, Bo", "Rayleigh time, beads",
        "bond limit, cables", "steps in a fluid step", "cells per wire", "run time", "warning: contacts"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

/// Water in cells of 20 mm: friction reaches 0.8 mm in 0.7 s. Oil of 1e-3 m^2/s is slowed over 26 mm.
TEST(ReportText, SaysHowFarTheFrictionOfWallsReaches) {
  const auto text = [](const std::vector<std::string>& changes) {
    const scene::Scene scene = load(case_file("dam_break/scene.toml"), changes);
    return report_text(scene, check_scene(scene));
  };
  constexpr auto advice = "free_slip is nearer";
  const std::vector<std::string> common{"fluid.cell_size_m=0.02", "run.duration_s=0.7"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), common.begin(), common.end());
    return text(more);
  };
  EXPECT_NE(with({"domain.slip=no_slip"}).find("0.042 cells"), std::string::npos);
  EXPECT_NE(with({"domain.slip=no_slip"}).find(advice), std::string::npos);
  EXPECT_EQ(with({"domain.slip=free_slip"}).find(advice), std::string::npos);
  EXPECT_EQ(with({"fluid.kinematic_viscosity_m2_s=1e-3"}).find(advice), std::string::npos);
}

}  // namespace
}  // namespace lahar::cases
