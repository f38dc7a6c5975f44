#pragma once
// What the executables of procedures share: a procedure is what a scene alone cannot express, such as a calibration. It
// takes the command line of every executable and leaves the same files behind as a run.
#include <CLI/CLI.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "cases/procedure/parameters.h"
#include "cases/runner/options.h"
#include "cases/runner/summary.h"

namespace lahar::cases {

/// Where a procedure writes, and how.
struct Workplace {
  std::filesystem::path out;
  std::string name;
  int threads = 1;
  bool quiet = false;
};

/// A procedure under way: fills simulated_seconds, metrics, checks, timers and particle speed of the summary and writes
/// its series and charts into the folder. Returns false if it was interrupted.
template <class Parameters>
using Procedure = std::function<bool(const Parameters&, const Workplace&, Summary&)>;

/// Prepares the folder, runs `body` with the given number of threads, completes and writes the summary and prints it.
/// Returns the exit code. Where `body` throws NumericalFailure after its checks, the summary with these is written too.
int run_in_folder(const Workplace& place, bool overwrite, const std::string& resolved,
                  const std::function<bool(Summary&)>& body);

struct ProcedureArguments {
  std::string file;
  CommonOptions common;
};

/// Sets up `app` for a procedure.
void add_procedure_options(CLI::App& app, ProcedureArguments& arguments);
Workplace workplace_of(const ProcedureArguments& arguments, const std::string& name);

/// The whole main function of a procedure's executable.
template <class Parameters>
int procedure_main(int argc, char** argv, const std::string& name, const std::string& about,
                   const Procedure<Parameters>& procedure) {
  CLI::App app(about, name);
  ProcedureArguments arguments;
  add_procedure_options(app, arguments);
  return parse_and_run(app, argc, argv, [&] {
    const std::optional<std::filesystem::path> file =
        arguments.file.empty() ? std::nullopt : std::optional<std::filesystem::path>(arguments.file);
    const auto parameters = load_parameters<Parameters>(file, arguments.common.set);
    const Workplace place = workplace_of(arguments, name);
    return run_in_folder(place, arguments.common.overwrite, parameters_text(parameters),
                         [&](Summary& summary) { return procedure(parameters, place, summary); });
  });
}

}  // namespace lahar::cases
