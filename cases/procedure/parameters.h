#pragma once
// Parameters of a procedure: a described struct, read from a TOML file and overrides with the means of a scene.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/scene/document.h"
#include "cases/scene/overrides.h"
#include "cases/scene/reader.h"
#include "cases/scene/toml_writer.h"
#include "cases/scene/writer.h"
#include "core/check.h"

namespace lahar::cases {

/// `parameters` as the file (none: its defaults) and the overrides change them. A type of parameters needs two
/// functions beside it: `describe(visitor, parameters)`, see cases/scene/schema.h, and `check(parameters, findings)`,
/// which notes what cannot be run at the key that is to blame. Throws InputError with every mistake.
template <class Parameters>
Parameters load_parameters(const std::optional<std::filesystem::path>& file,
                           const std::vector<std::string>& overrides) {
  scene::Findings findings(file ? file->string() : "--set");
  std::vector<InputMistake> wrong;
  toml::table root;
  if (file) {
    root = scene::read_document(*file, overrides, wrong);
  } else {
    wrong = scene::apply_overrides(root, overrides);
  }
  for (const InputMistake& m : wrong) findings.mistake_at({m.file, m.line, m.column}, m.message);
  Parameters parameters;
  scene::Reader reader(root, "", findings);
  describe(reader, parameters);
  reader.refuse_unknown();
  findings.raise();
  check(parameters, findings);
  findings.raise();
  return parameters;
}

/// The same as TOML, every default filled in.
template <class Parameters>
std::string parameters_text(Parameters parameters) {
  scene::TomlWriter writer("");
  describe(writer, parameters);
  return std::string(scene::resolved_mark) + " Parameters of a procedure, every default filled in.\n" + writer.text("");
}

}  // namespace lahar::cases
