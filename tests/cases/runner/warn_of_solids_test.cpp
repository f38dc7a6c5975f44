// What `lahar check` and a run warn of: grains, contacts and the barrier.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/cases/runner/warns.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

using scene::case_file;
using scene::load;

TEST(Warnings, Solids) {
  const auto report = [](auto change) {
    scene::Scene debris = scene::debris_flow();
    change(debris);
    return check_scene(debris);
  };
  using S = scene::Scene;
  EXPECT_TRUE(warns(report([](S& s) { s.solids.time_step = 1e-4; }), "above the critical time step"));
  EXPECT_FALSE(warns(report([](S& s) { s.solids.time_step = 1e-7; }), "critical"));
  const auto hanging = [](const char* step) {  // beads that do not touch
    return check_scene(load(case_file("hanging_net/scene.toml"),
                            {"barrier.net.beads_per_ring=26", "barrier.bonds.cable_stiffness_N_m3=3e11",
                             "barrier.bonds.dissipator_stiffness_N_m3=[]", "barrier.bonds.dissipator_force_limit_N=[]",
                             "solids.bond_stiffness_scale=1", std::string("solids.time_step_s=") + step}));
  };
  const char* const as_built = "above what the bonds of the barrier as built allow";
  EXPECT_TRUE(warns(hanging("6.3e-6"), as_built));
  EXPECT_FALSE(warns(hanging("4e-6"), as_built));
  EXPECT_TRUE(
      warns(report([](S& s) { s.solids.contact_modulus_scale = 0.5; }), "contacts are softened: moduli times 0.5"));
  EXPECT_TRUE(warns(report([](S& s) { s.solids.bond_stiffness_scale = 0.5; }), "bonds are softened"));
  EXPECT_TRUE(warns(report([](S& s) { s.coupling.enabled = false; }), "do not feel each other"));
  EXPECT_TRUE(warns(report([](S& s) { s.coupling.wire_drag = false; }), "water does not feel the net"));
  EXPECT_TRUE(warns(report([](S& s) { s.grains.packings[0].sizes[1].density = 190; }), "the lightest grain has 0.19"));
  EXPECT_FALSE(warns(report([](S& s) { s.grains.packings[0].sizes[1].density = 210; }), "the lightest grain"));
  EXPECT_TRUE(warns(report([](S& s) { s.coupling.body_weighting = scene::BodyWeighting::noble_torczynski; }),
                    "lets water through"));
  EXPECT_TRUE(warns(report([](S& s) { s.fluid.cell_size = 0.02; }), "2.0 cells across"));
  EXPECT_TRUE(warns(report([](S& s) { s.grains.packings[0].target_height = 0.5; }), "more than random packings"));
  EXPECT_TRUE(warns(report([](S& s) { s.contacts.erase(s.contacts.begin() + 2); }),
                    "no [[contact]] for \"rock\" and \"steel\""));
  EXPECT_FALSE(warns(report([](S&) {}), "no [[contact]]"));
  const auto rolling = [&](dem::WireContacts wires) {
    return report([&](S& s) {
      s.solids.wire_contacts = wires;
      for (scene::Contact& c : s.contacts) c.rolling_friction = 0.3;
    });
  };
  EXPECT_TRUE(warns(rolling(dem::WireContacts::capsules), "does not act on wires"));
  EXPECT_FALSE(warns(rolling(dem::WireContacts::beads), "does not act on wires"));
  const auto linear = [&](dem::WireContacts wires) {
    return report([&](S& s) {
      s.solids.wire_contacts = wires;
      s.solids.contact_law = dem::LinearSpringDashpot{1e6};
    });
  };
  EXPECT_TRUE(warns(linear(dem::WireContacts::capsules), "\"linear\" with smooth wires"));
  EXPECT_FALSE(warns(linear(dem::WireContacts::beads), "\"linear\" with smooth wires"));
}

/// Keys of TOML in quotes hold anything, and so do the names of materials.
TEST(Warnings, MaterialsAreNamedOnOneLine) {
  const auto report = [](auto change) {
    scene::Scene s = scene::debris_flow();
    const auto rename = [](std::string& name) {
      if (name == "rock") name = "ro\nck";
      if (name == "steel") name = "st\neel";
    };
    for (auto& m : s.materials) rename(m.name);
    for (auto& size : s.grains.packings.at(0).sizes) rename(size.material);
    rename(s.barrier.net.material);
    for (scene::Contact& c : s.contacts)
      for (std::string& name : c.materials) rename(name);
    change(s);
    return check_scene(s);
  };
  using S = scene::Scene;
  EXPECT_FALSE(warns(report([](S&) {}), "\n"));
  EXPECT_TRUE(warns(report([](S& s) { s.contacts.clear(); }), R"(no [[contact]] for "ro\u000Ack" and "st\u000Aeel":)"));
  EXPECT_TRUE(
      warns(report([](S& s) { s.contacts.at(2).friction = 4; }), R"(friction of "ro\u000Ack" and "st\u000Aeel" is 4)"));
  EXPECT_TRUE(warns(report([](S& s) {
                      s.solids.wire_contacts = dem::WireContacts::capsules;
                      s.contacts.at(2).rolling_friction = 0.3;
                    }),
                    R"(rolling_friction of "ro\u000Ack" and "st\u000Aeel" does not act on wires)"));
  EXPECT_TRUE(warns(report([](S& s) { s.materials.at(0).youngs_modulus = 1e3; }),
                    R"(grains of "ro\u000Ack" sink into each other)"));
  EXPECT_TRUE(warns(report([](S& s) {
                      for (auto& m : s.materials) m.youngs_modulus = 1e3;
                    }),
                    R"(wires of "st\u000Aeel" are softer than rubber)"));
}

/// Springs of a linear law whose stiffness is not in N/m, wires whose modulus is not in Pa.
TEST(Warnings, ContactsThatAreTooSoftToHold) {
  const auto sphere = [](const char* stiffness) {
    return check_scene(load(case_file("bouncing_sphere/scene.toml"),
                            {"solids.contact_law=linear", std::string("solids.normal_stiffness_N_m=") + stiffness}));
  };
  EXPECT_TRUE(warns(sphere("100"), "solids.normal_stiffness_N_m of 100 N/m is small"));
  EXPECT_FALSE(warns(sphere("1e6"), "is small"));
  const auto net = [](const char* modulus) {
    return check_scene(load(case_file("hanging_net/scene.toml"),
                            {"solids.bond_safety=0.5", std::string("materials.steel.youngs_modulus_Pa=") + modulus}));
  };
  EXPECT_TRUE(warns(net("210"), "wires of \"steel\" are softer than rubber"));
  EXPECT_FALSE(warns(net("210e9"), "rubber"));
}

TEST(Warnings, StepsOfContactsAboveWhichEnergyIsLost) {
  const auto warned = [](std::vector<std::string> set) {
    return warns(check_scene(load(case_file("bouncing_sphere/scene.toml"), set)), "of an elastic ball that bounces");
  };
  EXPECT_FALSE(warned({"solids.contact_safety=0.3"}));
  EXPECT_TRUE(warned({"solids.contact_safety=0.31"}));
  EXPECT_TRUE(warned({"solids.contact_safety=0.31", "solids.contact_law=linear", "solids.normal_stiffness_N_m=1e6"}));
  EXPECT_FALSE(warned({"solids.time_step_s=1e-6"}));
}

/// Grains among themselves take a longer step than beads, which alone is above the share.
TEST(Warnings, StepsOfTwoRatesAboveWhichEnergyIsLost) {
  const auto report = [](const char* safety) {
    return check_scene(load(case_file("compare_cfd_dem/matched.toml"),
                            {"materials.rock.youngs_modulus_Pa=3.5e9", "solids.two_rates=true",
                             std::string("solids.contact_safety=") + safety}));
  };
  const CheckReport fast = report("0.5");
  const double step = fast.solids->time_step, long_step = static_cast<double>(fast.solids->long_step) * step;
  ASSERT_LT(step, 0.3 * std::min(fast.solids->limits.grain_rayleigh, fast.solids->limits.bead_rayleigh));
  ASSERT_GT(long_step, 0.3 * fast.solids->limits.grain_rayleigh);
  EXPECT_TRUE(warns(fast, "of an elastic ball that bounces"));
  EXPECT_FALSE(warns(report("0.3"), "of an elastic ball that bounces"));
}

TEST(Warnings, ModuliOfTheLinearLaw) {
  const auto report = [](std::vector<std::string> set) {
    return check_scene(load(case_file("bouncing_sphere/scene.toml"), set));
  };
  const auto linear = report({"solids.contact_law=linear", "solids.normal_stiffness_N_m=1e6"});
  EXPECT_TRUE(warns(linear, "solids.contact_modulus_scale changes nothing"));
  EXPECT_FALSE(warns(linear, "contacts are softened"));
  EXPECT_TRUE(warns(report({}), "contacts are softened"));
}

TEST(Warnings, GrainsThatAreFixedNeedNoWalls) {
  const auto report = [](std::vector<std::string> set) {
    set.emplace_back("wall=[]");
    return check_scene(load(case_file("bouncing_sphere/scene.toml"), set));
  };
  EXPECT_TRUE(warns(report({}), "nothing holds them"));
  EXPECT_FALSE(warns(report({"grains.sphere[0].fixed=true"}), "nothing holds them"));
}

TEST(Warnings, NodesThinnerThanTheirWires) {
  const auto report = [](const std::string& node) {
    return check_scene(load(case_file("hexagonal_net/scene.toml"), {"barrier.net.node_diameter_m=" + node}));
  };
  EXPECT_TRUE(warns(report("0.0026"), "barrier.net.node_diameter_m (0.0026 m) is less than the diameter of the wires"));
  EXPECT_FALSE(warns(report("0.0028"), "node_diameter_m"));
}

TEST(Warnings, RingsThatBreakWhereTheirBeadsOverlap) {
  const auto report = [](std::vector<std::string> set) {
    return check_scene(load(case_file("hanging_net/scene.toml"), set));
  };
  const std::string breaks = "barrier.bonds.ring_tensile_strength_Pa=1e9";
  EXPECT_TRUE(warns(report({breaks, "barrier.net.beads_per_ring=40"}),
                    "beads_per_ring is 40: beads stand 0.90 diameters apart"));
  EXPECT_TRUE(warns(report({breaks, "barrier.net.beads_per_ring=40"}), "36 do not overlap"));
  EXPECT_FALSE(warns(report({breaks}), "do not overlap"));
  EXPECT_FALSE(warns(report({"barrier.net.beads_per_ring=40"}), "do not overlap"));
}

TEST(Warnings, GrainsWithoutWalls) {
  EXPECT_TRUE(warns(check_scene(load(case_file("bouncing_sphere/scene.toml"), {"wall=[]"})), "nothing holds them"));
  EXPECT_FALSE(warns(check_scene(load(case_file("bouncing_sphere/scene.toml"))), "nothing holds them"));
}

TEST(Warnings, FacesThatGrainsFallOutOf) {
  const auto report = [](const std::vector<std::string>& set) {
    return check_scene(load(case_file("debris_flow/scene.toml"), set));
  };
  EXPECT_FALSE(warns(report({}), "which are lost"));
  EXPECT_TRUE(
      warns(report({"wall[3]={name='other', shape='plane', point_m=[0, 0, 0], normal=[0, 0, 1], material='wall'}"}),
            "without a [[wall]]: y+"));
  EXPECT_TRUE(warns(report({"wall[3]={name='pier', shape='cylinder', start_m=[3, 1, 0], end_m=[3, 1, 1], radius_m=0.1, "
                            "material='wall'}"}),
                    "without a [[wall]]: y+"));
}

/// 50 GPa that were written as 50.
TEST(Warnings, GrainsThatSinkInUnderTheirWeight) {
  const auto report = [](const std::string& modulus) {
    return check_scene(load(case_file("debris_flow/scene.toml"), {"materials.rock.youngs_modulus_Pa=" + modulus}));
  };
  EXPECT_FALSE(warns(report("50e9"), "sink into each other"));
  EXPECT_TRUE(warns(report("50"), "of a radius under their own weight"));
}

}  // namespace
}  // namespace lahar::cases
