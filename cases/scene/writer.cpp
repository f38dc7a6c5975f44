#include "cases/scene/writer.h"

#include "cases/scene/toml_writer.h"

namespace lahar::scene {

std::string to_toml(const Scene& scene) {
  Scene copy = scene;  // the description is one for readers and writers, and so takes what could be written to
  TomlWriter writer("");
  describe(writer, copy);
  return std::string(resolved_mark) + " Every default is filled in; running it again reproduces the run.\n" +
         writer.text("");
}

}  // namespace lahar::scene
