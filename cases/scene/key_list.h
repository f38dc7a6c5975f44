#pragma once
// Every parameter of a scene as a list, collected from its description: for suggestions and the reference page.
#include <string>
#include <vector>

namespace lahar::scene {

struct KeyEntry {
  std::string key;
  std::string type;           ///< "a number"
  std::string range;          ///< "above 0", "" if unlimited
  std::string default_value;  ///< as TOML, "" if there is none
  bool required = false;
  std::string condition;  ///< "shape = \"plane\"", "" if it always applies
  std::string doc;
};

struct TableEntry {
  std::string path;    ///< "fluid", "grains.packing", "materials.NAME"
  std::string header;  ///< "[fluid]", "[[grains.packing]]"
  std::string doc;
  std::vector<KeyEntry> keys;
};

/// All tables in the order of the description.
const std::vector<TableEntry>& all_keys();

/// docs/scene_reference.md.
std::string reference_page();

}  // namespace lahar::scene
