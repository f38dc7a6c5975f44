#pragma once
// The problems, one a file.
#include "cases/speed_error/problem.h"

namespace lahar::validate {

Problem taylor_green_problem(bool quick);
Problem gravity_wave_problem(bool quick);
Problem dam_break_problem(bool quick);
Problem sphere_array_problem(bool quick);
Problem random_pack_problem(bool quick);
Problem gravel_bed_problem(bool quick);
Problem settling_sphere_problem(bool quick);
Problem wire_screen_problem(bool quick);
Problem ring_in_hole_problem(bool quick);
Problem elastic_impact_problem(bool quick);
Problem ring_pull_problem(bool quick);
Problem rockfall_problem(bool quick);
Problem wet_column_problem(bool quick);
Problem debris_flow_problem(bool quick);

}  // namespace lahar::validate
