// A test for every value that the description of a scene refuses, key by key.
#include <gtest/gtest.h>

#include "tests/cases/assembly/rejections.h"

namespace lahar::scene {
namespace {

class RejectedValue : public testing::TestWithParam<Rejection> {};

TEST_P(RejectedValue, IsTheOneMistake) { expect_rejection(case_file("debris_flow/scene.toml"), GetParam()); }

Rejection value(const std::string& path, const std::string& wrong, const std::string& part) {
  return {{path + "=" + wrong}, path, part};
}

INSTANTIATE_TEST_SUITE_P(
    Schema, RejectedValue,
    testing::Values(
        value("scene.name", "3", "is a whole number"), value("scene.title", "[1]", "is a list"),
        value("run.duration_s", "0", "above 0"), value("run.duration_s", "inf", "is inf"),
        value("run.duration_s", "nan", "is nan"), value("run.duration_s", "'long'", "is a string"),
        value("run.series_interval_s", "0.0", "above 0"), value("run.output_interval_s", "-0.1", "at least 0"),
        value("run.image_interval_s", "-1", "at least 0"), value("run.seed", "-1", "at least 0"),
        value("run.seed", "0.5", "a whole number"), value("run.precision", "half", "one of \"float\", \"double\""),
        value("gravity.magnitude_m_s2", "-9.81", "at least 0"), value("gravity.slope_deg", "91", "from 0 to 90"),
        value("gravity.slope_deg", "-1", "from 0 to 90"), value("domain.lower_m", "0", "three numbers"),
        value("domain.upper_m", "[1, 2, 3, 4]", "has 4 entries"), value("domain.upper_m", "[1, inf, 3]", "is inf"),
        value("domain.open_faces", "['x']", "has entry 1"), value("domain.open_faces", "x+", "is a string"),
        value("domain.periodic_axes", "['t']", "one of \"x\""), value("wall[0].shape", "disc", "one of \"plane\""),
        value("wall[0].normal", "up", "is a string"), value("wall[0].slip", "slippery", "one of \"no_slip\""),
        value("wall[0].name", "1", "is a whole number"), value("wall[0].velocity_m_s", "1", "three numbers"),
        value("fluid.enabled", "1", "true or false"), value("fluid.cell_size_m", "0", "above 0"),
        value("fluid.cell_size_m", "-0.01", "above 0"), value("fluid.density_kg_m3", "0", "above 0"),
        value("fluid.kinematic_viscosity_m2_s", "0", "above 0"), value("fluid.collision", "mrt", "one of"),
        value("fluid.smagorinsky", "0.6", "from 0 to 0.5"), value("fluid.smagorinsky", "-0.1", "from 0 to 0.5"),
        value("fluid.lattice_velocity", "0", "above 0"), value("fluid.lattice_velocity", "0.4", "at most 0.3"),
        value("fluid.max_speed_m_s", "-1", "at least 0"), value("fluid.adaptive_time_step", "1", "true or false"),
        value("fluid.density_kg_m3", "1e300", "makes sense in no unit"),
        value("fluid.cell_size_m", "1e-300", "makes sense in no unit"),
        value("fluid.uncounted_share", "-0.1", "from 0 to 0.1"), value("fluid.uncounted_share", "0.2", "from 0 to 0.1"),
        value("fluid.surface_tension_N_m", "-0.1", "at least 0"),
        value("fluid.region[0].velocity_m_s", "[1]", "has 1 entries"),
        value("materials.rock.youngs_modulus_Pa", "0", "above 0"),
        value("materials.rock.poisson_ratio", "0.6", "from 0 to 0.5"),
        value("materials.rock.poisson_ratio", "-0.1", "from 0 to 0.5"),
        value("contact[0].friction", "-0.1", "at least 0"), value("contact[0].restitution", "0", "above 0"),
        value("contact[0].rolling_friction", "-0.1", "at least 0"), value("contact[0].restitution", "1.1", "at most 1"),
        value("contact[0].materials", "['rock']", "2 of them"), value("solids.time_step_s", "-1", "at least 0"),
        value("solids.contact_safety", "0", "above 0"), value("solids.contact_safety", "1.5", "at most 1"),
        value("solids.bond_safety", "0", "above 0"), value("solids.contact_modulus_scale", "0", "above 0"),
        value("solids.contact_modulus_scale", "2", "at most 1"), value("solids.bond_stiffness_scale", "0", "above 0"),
        value("solids.bond_damping_ratio", "1.5", "from 0 to 1"),
        value("grains.packing[0].target_height_m", "-1", "at least 0"),
        value("grains.packing[0].sizes[0].diameter_m", "0", "above 0"),
        value("grains.packing[0].sizes[0].count", "0", "from 1 to 1e+07"),
        value("grains.packing[0].sizes[0].count", "1.5", "a whole number"),
        value("grains.packing[0].sizes[0].density_kg_m3", "-2500", "above 0"),
        value("grains.packing[0].sizes[0].material", "7", "is a whole number"),
        value("barrier.enabled", "on", "true or false"), value("barrier.net.origin_m", "[0]", "has 1 entries"),
        value("barrier.net.width_m", "-1.8", "above 0"), value("barrier.net.height_m", "0", "above 0"),
        value("barrier.net.ring_diameter_m", "0", "above 0"), value("barrier.net.ring_pitch_m", "0", "above 0"),
        value("barrier.net.beads_per_ring", "7", "from 8 to 1000"),
        value("barrier.net.wire_diameter_m", "0", "above 0"), value("barrier.net.density_kg_m3", "0", "above 0"),
        value("barrier.bonds.ring_stiffness_N_m3", "0", "above 0"),
        value("barrier.bonds.cable_stiffness_N_m3", "-8e11", "above 0"),
        value("barrier.bonds.dissipator_stiffness_N_m3", "[1, 2, 3, 4]", "0 to 3 of them"),
        value("barrier.bonds.dissipator_stiffness_N_m3", "[8e11, 0]", "has entry 2"),
        value("barrier.bonds.dissipator_force_limit_N", "[-1]", "has entry 1"),
        value("barrier.bonds.plastic_unloading", "0", "true or false"),
        value("barrier.anchors.lateral_cable_middles_fixed", "'yes'", "true or false"),
        value("coupling.body_weighting", "half", "one of"), value("coupling.wire_drag", "off", "true or false"),
        value("measure.section_x_m", "'net'", "is a string"), value("measure.inflow_distance_m", "-0.1", "at least 0"),
        value("measure.outflow_distance_m", "-0.1", "at least 0"), value("measure.energy_datum_z_m", "nan", "is nan")));

}  // namespace
}  // namespace lahar::scene
