#pragma once
// Table, figures and page of a study.
#include <filesystem>
#include <string>
#include <vector>

#include "cases/compare_cfd_dem/comparison.h"
#include "cases/pictures/chart.h"

namespace lahar::study {

/// A figure and what it shows.
struct Figure {
  std::string file, caption;  ///< name without ending
  cases::Chart chart;
};

/// Quantities over the paper's Froude numbers, theirs and ours in one picture; and what happens over time at one
/// distance. Only figures that some case has a point for.
std::vector<Figure> figures_of(const std::vector<CaseResult>& results);

/// What made the page, and what is not there.
struct Sitting {
  std::string commit, date;
  std::vector<std::string> missing;  ///< names of cases that were asked for and have no result
};

/// Writes comparison.csv, the figures as .png, .svg and .pdf, and report.html, which holds a summary of all that
/// follows in it, tables, figures and pictures and needs no other file. Throws cases::FileError.
void write_report(const std::vector<CaseResult>& results, const Sitting& sitting, const std::filesystem::path& folder);

}  // namespace lahar::study
