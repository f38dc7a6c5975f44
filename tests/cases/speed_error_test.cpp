// The study of speed against error: the front, the problems, the files.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>

#include "cases/speed_error/pareto.h"
#include "cases/speed_error/report.h"
#include "cases/validate/reference_table.h"
#include "core/check.h"
#include "tests/cases/files/test_folder.h"

namespace lahar::validate {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

TEST(ParetoFront, HoldsWhatNoOtherBeats) {
  // error, seconds
  const std::vector<Measurement> trials{{0.1, 1}, {0.05, 2}, {0.2, 3}, {0.01, 8}, {kNone, kNone}, {0.011, 9}};
  EXPECT_EQ(pareto_front(trials), (std::vector<std::size_t>{0, 1, 3}));
  EXPECT_NEAR(beaten_by(trials, 2), 2, 1e-12);    // by the first: half the error, a third of the time
  EXPECT_NEAR(beaten_by(trials, 5), 1.1, 1e-12);  // error and time 1.1 and 1.125 times those of the fourth
  EXPECT_LT(beaten_by(trials, 0), 1);
}

TEST(ParetoFront, HoldsEquals) {
  EXPECT_EQ(pareto_front({{0.1, 1}, {0.1, 1}}).size(), 2u);
  EXPECT_EQ(pareto_front({{0, 1}, {0, 2}}), (std::vector<std::size_t>{0}));
}

TEST(SpeedError, ProblemsHaveDefaultsAndNamesOfTheirOwn) {
  for (const bool quick : {false, true}) {
    std::set<std::string> names;
    for (const Problem& p : all_problems(quick)) {
      EXPECT_TRUE(names.insert(p.name).second) << p.name;
      std::set<std::string> trials;
      for (const Trial& t : p.trials) EXPECT_TRUE(trials.insert(t.name()).second) << p.name << ": " << t.name();
      EXPECT_EQ(trials.count("defaults"), 1u) << p.name;
      EXPECT_GT(trials.size(), 3u) << p.name;
    }
  }
  EXPECT_EQ(select_problems({"dam_break"}, true).size(), 1u);
  EXPECT_THROW(select_problems({"dambreak"}, true), std::invalid_argument);
}

/// Errors are the same in every run; that of the vortex is one of compressibility, which falls with the speed.
TEST(SpeedError, ErrorsAreDeterministicAndFall) {
  const Problem vortex = select_problems({"taylor_green"}, true).at(0);
  std::vector<double> errors;
  for (const Trial& t : vortex.trials)
    if (t.name() == "lattice_velocity 0.2" || t.name() == "defaults") {
      const Measurement first = t.run();
      EXPECT_EQ(first.error, t.run().error);
      EXPECT_GT(first.seconds, 0);
      errors.push_back(first.error);
    }
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_LT(errors[0], 0.5 * errors[1]);  // defaults 0.1 lu
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(SpeedError, FilesHoldEveryTrial) {
  Problem p{"made_up", "distance", "exact", "none", {}};
  p.trials.push_back({{}, [] { return Measurement{0.1, 2}; }});
  p.trials.push_back({{{"cells", "8"}, {"steps", "2"}}, [] { return Measurement{0.05, 1}; }});
  p.trials.push_back({{{"cells", "1"}}, []() -> Measurement { throw std::runtime_error("too coarse, \"really\""); }});
  const ProblemResult result = run_problem(p, 0.5);
  EXPECT_NEAR(defaults_beaten_by(result), 2, 1e-12);
  const cases::TestFolder files;
  for (const char* name : {"dam_break.svg", "notes.svg"}) std::ofstream(files / name) << "of a former sitting";
  write_results({result}, {"machine", "abc", "2020-02-29", 2, true}, files.path());
  const ReferenceTable table = ReferenceTable::read(files / "speed_error.csv");
  EXPECT_EQ(table.provenance().at(0), "machine, 2 of its threads used, commit abc, 2020-02-29, quick form");
  EXPECT_EQ(table.where("trial", "defaults").number("time"), 4);
  EXPECT_EQ(table.where("trial", "defaults").text("front"), "false");
  EXPECT_EQ(table.where("trial", "cells 8, steps 2").text("front"), "true");
  EXPECT_EQ(table.where("trial", "cells 1").text("failure"), "too coarse, \"really\"");
  const std::string html = text_of(files / "report.html");
  EXPECT_NE(html.find("src=\"data:image/svg+xml;base64,"), std::string::npos);
  EXPECT_NE(html.find("beaten by 2.00"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(files / "made_up.png"));
  EXPECT_FALSE(std::filesystem::exists(files / "dam_break.svg"));
  EXPECT_TRUE(std::filesystem::exists(files / "notes.svg"));
}

/// A long problem is told trial by trial, and what was done stays where it is ended.
TEST(SpeedError, TellsOfEachTrialAndEndsBetweenThem) {
  Problem p{"made_up", "distance", "exact", "none", {}};
  int runs = 0;
  for (const char* cells : {"2", "4", "8"})
    p.trials.push_back({{{"cells", cells}}, [&] {
                          ++runs;
                          return Measurement{0.1 / runs, 1.0 * runs};
                        }});
  std::string told;
  const ProblemResult result = run_problem(p, 0.5, [&](const ProblemResult& so_far) {
    told += so_far.trials.back().name + ". ";
    return so_far.trials.size() < 2;
  });
  EXPECT_EQ(told, "cells 2. cells 4. ");
  EXPECT_EQ(runs, 2);
  EXPECT_EQ(result.trials.size(), 2u);
  EXPECT_NE(trial_text(result.trials[1], 0.5).find("4.00 of the fixed work"), std::string::npos);
  EXPECT_EQ(front_text(result), "  on the Pareto front: cells 2; cells 4\n");
}

/// A scene that is refused says nothing of the knob, numbers that go wrong do.
TEST(SpeedError, NamesTrialsWhoseSceneIsRefused) {
  Problem p{"made_up", "distance", "exact", "none", {}};
  p.trials.push_back({{}, [] { return Measurement{0.1, 2}; }});
  p.trials.push_back({{{"cells", "1"}}, []() -> Measurement { throw NumericalFailure("cell", 3, "too fast"); }});
  EXPECT_EQ(refusals_text(run_problem(p, 0.5)), "");
  p.trials.push_back(
      {{{"cells", "2"}}, []() -> Measurement {
         throw InputError(std::vector<InputMistake>{{"a.toml", 4, 5, "no net"}, {"a.toml", 6, 7, "no bed"}});
       }});
  EXPECT_EQ(refusals_text(run_problem(p, 0.5)),
            "made_up: cells 2: its scene was refused: a.toml:4:5: no net; a.toml:6:7: no bed\n");
}

}  // namespace
}  // namespace lahar::validate
