#pragma once
// Elastic impacts of Chung & Ooi 2011 (tests 1 and 2) against Hertz: overlap, force and duration are computed apart
// from this code (reference/dem_hertz.csv).
#include <initializer_list>
#include <string>

#include "cases/validate/dem/impact.h"

namespace lahar::validate {

struct ElasticImpact {
  std::string material;   ///< in labels
  std::string reference;  ///< row of the table
  ImpactSpec spec;
};

/// Rows of impacts whose outcome the table gives, and of their energy ledger.
std::vector<Row> elastic_rows(std::initializer_list<ElasticImpact> impacts);

}  // namespace lahar::validate
