#pragma once
// The problems, one a file.
#include "cases/speed_error/problem.h"

namespace lahar::validate {

Problem taylor_green(bool quick);
Problem dam_break(bool quick);
Problem gravel_bed(bool quick);
Problem elastic_impact(bool quick);

}  // namespace lahar::validate
