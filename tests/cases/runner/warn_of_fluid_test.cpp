// What `lahar check` and a run warn of: the fluid, and bodies and wires in it.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/cases/runner/warns.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

using scene::case_file;
using scene::load;

TEST(Warnings, Fluid) {
  const auto report = [](std::vector<std::string> set) {
    return check_scene(load(case_file("dam_break/scene.toml"), set));
  };
  EXPECT_TRUE(warns(report({"run.output_interval_s=1"}), "run.output_interval_s (1 s) is longer than the run"));
  EXPECT_TRUE(warns(report({"run.series_interval_s=1"}), "run.series_interval_s"));
  EXPECT_TRUE(warns(report({"run.image_interval_s=1"}), "run.image_interval_s"));
  EXPECT_TRUE(
      warns(report({"run.image_interval_s=1e-6"}), "run.image_interval_s (1e-06 s) is less than the time step"));
  EXPECT_FALSE(warns(report({"run.image_interval_s=0.01"}), "less than the time step"));
  EXPECT_TRUE(warns(report({"fluid.collision=bgk"}), "unstable"));
  EXPECT_FALSE(warns(report({"fluid.collision=bgk", "fluid.smagorinsky=0.16"}), "unstable"));
  EXPECT_TRUE(warns(report({"fluid.lattice_velocity=0.2"}), "Ma = 0.35"));
  EXPECT_TRUE(warns(report({"fluid.cell_size_m=0.2"}), "cells deep"));
  EXPECT_TRUE(warns(report({"gravity.magnitude_m_s2=981"}), "gravity.magnitude_m_s2 is 981"));
  EXPECT_FALSE(warns(report({"gravity.magnitude_m_s2=24.8"}), "gravity.magnitude_m_s2"));  // Jupiter
}

/// A box of 0.3 by 0.4 m across a stream of 1 m/s carries 0.12 m^3/s.
TEST(Warnings, ADischargeThatItsBoxDoesNotCarry) {
  const auto report = [](const std::string& discharge, const std::string& velocity) {
    return check_scene(
        load(case_file("dam_break/scene.toml"),
             {"fluid.inflow=[{name = \"pump\", lower_m = [0.4, 0, 0], upper_m = [0.8, 0.3, 0.4], "
              "velocity_m_s = [" +
              velocity + ", 0, 0], discharge_m3_s = [[0, " + discharge + "], [1, " + discharge + "]]}]"}));
  };
  EXPECT_TRUE(warns(report("0.3", "1"), "fluid.inflow \"pump\" comes with 1 m/s, but its discharge_m3_s asks for 2.5"));
  EXPECT_FALSE(warns(report("0.2", "1"), "asks for"));
  EXPECT_FALSE(warns(report("0.3", "0"), "asks for"));
  EXPECT_TRUE(warns(report("2", "0"), "asks for 12.5 m/s"));
  // 0.3 m wide: 0.05 m^3/s at 1 m/s are 0.167 m deep
  EXPECT_FALSE(warns(report("0.05", "1"), "cells deep"));
  EXPECT_TRUE(warns(report("0.015", "1"), "cells deep, with a Froude number of 1.4"));
  EXPECT_FALSE(warns(report("0.06", "4"), "cells deep"));
}

/// The dam is 0.054 m^3 in a tank of 0.384 m^3, of which a sill takes 0.024 m^3.
TEST(Warnings, ATankThatIsOverfilled) {
  const auto report = [](const std::string& discharge, std::vector<std::string> set) {
    set.insert(set.end(), {"domain.open_faces=[]", "run.duration_s=1",
                           "fluid.inflow=[{name = \"pump\", lower_m = [0.4, 0, 0], upper_m = [0.8, 0.3, 0.4], "
                           "velocity_m_s = [1, 0, 0], discharge_m3_s = [[0, " +
                               discharge + "], [1, " + discharge + "]]}]"});
    return check_scene(load(case_file("dam_break/scene.toml"), set));
  };
  const std::vector<std::string> sill{"wall[2].name=sill", "wall[2].shape=box", "wall[2].lower_m=[1.2, -1, -1]",
                                      "wall[2].upper_m=[2, 1, 0.2]"};
  EXPECT_TRUE(warns(report("0.34", {}), "fluid.inflow \"pump\": 0.34 m^3 in the time of the run and 0.054 m^3"));
  EXPECT_TRUE(warns(report("0.34", {}), "0.384 m^3 that the domain has room for"));
  EXPECT_FALSE(warns(report("0.32", {}), "has room for"));
  EXPECT_TRUE(warns(report("0.32", sill), "0.36 m^3 that the domain has room for"));
  EXPECT_FALSE(warns(report("0.3", sill), "has room for"));
}

TEST(Warnings, AMaxSpeedBelowThatOfADrop) {
  const auto report = [](const char* speed, const char* adaptive = "false") {
    return check_scene(load(case_file("dam_break/scene.toml"), {std::string("fluid.max_speed_m_s=") + speed,
                                                                std::string("fluid.adaptive_time_step=") + adaptive}));
  };
  EXPECT_TRUE(warns(report("2"), "fluid.max_speed_m_s is 2 m/s"));  // sqrt(2 g 0.6 m) = 3.43 m/s
  EXPECT_TRUE(warns(report("2"), "reaches 3.43 m/s: Ma would be 0.30"));
  EXPECT_FALSE(warns(report("3.5"), "max_speed_m_s"));
  EXPECT_FALSE(warns(report("2", "true"), "Ma would be"));  // the step adapts to it
  EXPECT_FALSE(warns(report("0"), "max_speed_m_s"));
}

/// Beads that feel the law of grains feel the water; weightings are of resolved bodies.
TEST(Warnings, AveragedGrainsAreNotWarnedOfBodies) {
  const auto report = [](std::vector<std::string> set) {
    set.insert(set.end(), {"coupling.wire_drag=false", "coupling.body_weighting=noble_torczynski"});
    return check_scene(load(case_file("debris_flow/scene.toml"), set));
  };
  const char *const blind = "water does not feel the net", *const leaks = "lets water through bodies";
  EXPECT_TRUE(warns(report({}), blind));
  EXPECT_TRUE(warns(report({}), leaks));
  const std::vector<std::string> averaged{"coupling.grains=averaged", "coupling.averaging_length_m=0.15",
                                          "coupling.beads_as_grains=true"};
  EXPECT_FALSE(warns(report(averaged), blind));
  EXPECT_FALSE(warns(report(averaged), leaks));
}

TEST(Warnings, OperatorsThatSmallViscositiesUpset) {
  const auto report = [](std::vector<std::string> set) {
    set.insert(set.end(), {"fluid.collision=trt", "fluid.smagorinsky=0"});
    return check_scene(load(case_file("dam_break/scene.toml"), set));
  };
  EXPECT_TRUE(warns(report({"fluid.kinematic_viscosity_m2_s=1e-3"}), "operator may be unstable there without"));
  EXPECT_FALSE(warns(report({"fluid.kinematic_viscosity_m2_s=0.02"}), "may be unstable"));
  const auto mud = [&](const std::string& consistency) {
    return report({"fluid.rheology.law=herschel_bulkley", "fluid.rheology.yield_stress_Pa=10",
                   "fluid.rheology.limit_viscosity_m2_s=1", "fluid.rheology.exponent=0.5",
                   "fluid.rheology.consistency_Pa_s_n=" + consistency, "fluid.kinematic_viscosity_m2_s=0.02"});
  };
  EXPECT_TRUE(warns(mud("1"), "of the liquid that shears fastest is"));
  EXPECT_FALSE(warns(mud("500"), "may be unstable"));
}

TEST(Warnings, MappedWiresThatShake) {
  const auto warned = [](std::vector<std::string> set) {
    set.insert(set.end(), {"coupling.resolve_wires_from_cells=2", "fluid.cell_size_m=0.003"});
    return warns(check_scene(load(case_file("tutorial/net.toml"), set)), "may shake themselves");
  };
  EXPECT_TRUE(warned({"coupling.body_weighting=wall_distance", "solids.bond_damping_ratio=0.005"}));
  EXPECT_FALSE(warned({"coupling.body_weighting=wall_distance"}));
  EXPECT_FALSE(warned({"coupling.body_weighting=noble_torczynski", "solids.bond_damping_ratio=0.005"}));
}

TEST(Warnings, MudWhoseLimitHidesItsLaw) {
  const auto report = [](const std::string& limit) {
    return check_scene(load(case_file("dam_break/scene.toml"),
                            {"fluid.rheology.law=herschel_bulkley", "fluid.rheology.yield_stress_Pa=50",
                             "fluid.rheology.consistency_Pa_s_n=5", "fluid.rheology.exponent=0.5",
                             "fluid.rheology.limit_viscosity_m2_s=" + limit}));
  };
  EXPECT_TRUE(warns(report("1e-5"), "the law is not felt"));
  EXPECT_FALSE(warns(report("0.5"), "the law is not felt"));
}

/// Resolved grains and films take mud's own number from a key that water's default stands in.
TEST(Warnings, MudThatBodiesTakeForWater) {
  const auto report = [](std::vector<std::string> set) {
    set.insert(set.end(), {"fluid.rheology.law=herschel_bulkley", "fluid.rheology.yield_stress_Pa=20",
                           "fluid.rheology.consistency_Pa_s_n=10", "fluid.rheology.exponent=0.5",
                           "fluid.rheology.limit_viscosity_m2_s=1", "fluid.smagorinsky=0", "fluid.collision=trt",
                           "coupling.body_weighting=wall_distance"});
    return check_scene(load(case_file("debris_flow/scene.toml"), set));
  };
  EXPECT_TRUE(warns(report({}), "by which bodies and lubrication know the liquid"));
  EXPECT_FALSE(warns(report({"fluid.kinematic_viscosity_m2_s=1e-2"}), "know the liquid"));
  EXPECT_FALSE(warns(report({"coupling.grains=averaged"}), "know the liquid"));
}

/// Beads weigh as spheres, two thirds of the cylinders that mapped wires displace: 1500 kg/m^3 bears them in water.
TEST(Warnings, WiresTooThickForTheDragLaw) {
  const auto warned = [](const std::string& cell) {
    return warns(check_scene(load(case_file("tutorial/net.toml"), {"fluid.cell_size_m=" + cell})),
                 "the drag law drags them too little");
  };
  EXPECT_TRUE(warned("0.0007"));  // 8.7 cells
  EXPECT_FALSE(warned("0.0008"));
}

/// Spheres that are held do not settle.
TEST(Warnings, HeldSpheresHaveNoCellReynoldsNumber) {
  const auto number = [](const char* fixed) {
    return check_scene(load(case_file("debris_flow/scene.toml"),
                            {"grains.packing=[]", "barrier.enabled=false", "measure.section_x_m=2",
                             std::string("grains.sphere=[{position_m=[2, 0.9, 0.5], diameter_m=0.08, "
                                         "density_kg_m3=2500, material='rock', fixed=") +
                                 fixed + "}]"}))
        .solids->cell_reynolds;
  };
  EXPECT_TRUE(number("false").has_value());
  EXPECT_FALSE(number("true").has_value());
}

TEST(Warnings, MappedWiresThatFloat) {
  const auto warned = [](const std::string& density, const std::string& from_cells) {
    return warns(
        check_scene(load(case_file("tutorial/net.toml"),
                         {"fluid.cell_size_m=0.003", "coupling.body_weighting=wall_distance",
                          "coupling.resolve_wires_from_cells=" + from_cells, "barrier.net.density_kg_m3=" + density})),
        "they float up");
  };
  EXPECT_TRUE(warned("1400", "2"));
  EXPECT_FALSE(warned("1600", "2"));
  EXPECT_FALSE(warned("1400", "3")) << "by the drag law";
}

}  // namespace
}  // namespace lahar::cases
