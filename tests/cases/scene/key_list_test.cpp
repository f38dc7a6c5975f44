#include "cases/scene/key_list.h"

#include <gtest/gtest.h>

#include <set>

#include "cases/scene/schema.h"
#include "cases/scene/value.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::scene {
namespace {

/// Visits every parameter of default-constructed parts and reads its default back under its own rule.
struct DefaultsReader {
  int read_back = 0;

  template <class T>
  void value(std::string_view key, T& field, const Rule& rule, std::string_view doc) {
    EXPECT_GT(doc.size(), 3u) << key;
    const std::string text = toml_text(field);
    if (rule.required || text.empty()) return;
    const toml::table table = toml::parse("v = " + text);
    T back{};
    EXPECT_EQ(read(*table.get("v"), rule, back), "") << key << " = " << text;
    EXPECT_EQ(back, field) << key;
    ++read_back;
  }
  template <class T>
  void table(std::string_view, T& part, Presence, std::string_view) {
    describe(*this, part);
  }
  template <class T>
  void array(std::string_view, std::vector<T>&, std::string_view) {
    T part;
    describe(*this, part);
  }
  template <class T>
  void named(std::string_view, std::vector<T>& parts, std::string_view doc) {
    array("", parts, doc);
  }
  template <class Body>
  void only_with(std::string_view, bool, std::string_view, const Body& body) {
    body();
  }
  template <class Body>
  void when_on(bool, const Body& body) {
    body();
  }
};

TEST(Schema, EveryDefaultLiesInItsOwnRange) {
  DefaultsReader reader;
  Scene scene;
  describe(reader, scene);
  EXPECT_GT(reader.read_back, 40);
}

TEST(KeyList, KeysAreUniqueInTheirTable) {
  std::set<std::string> paths;
  std::size_t keys = 0;
  for (const TableEntry& table : all_keys())
    for (const KeyEntry& key : table.keys) paths.insert(table.path + "." + key.key), ++keys;
  EXPECT_EQ(paths.size(), keys);
  EXPECT_TRUE(paths.contains("grains.packing.sizes.count"));
  EXPECT_TRUE(paths.contains("materials.NAME.poisson_ratio"));
  EXPECT_GT(keys, 90u);
}

TEST(KeyList, DimensionalKeysNameTheirUnit) {
  // Names whose numbers have a dimension must end in a unit; these words never stand alone.
  for (const TableEntry& table : all_keys())
    for (const KeyEntry& key : table.keys) {
      if (key.type == "true or false") continue;
      for (const char* quantity : {"duration", "interval", "diameter", "radius", "density", "modulus", "stiffness",
                                   "position", "lower", "upper", "height", "width", "pitch", "time_step"})
        EXPECT_FALSE(key.key.ends_with(quantity)) << table.path << "." << key.key;
    }
}

TEST(KeyList, OptionsAreExplainedWordByWord) {
  for (const TableEntry& table : all_keys())
    for (const KeyEntry& key : table.keys) {
      if (table.path + "." + key.key != "fluid.collision") continue;
      for (const auto& choice : choices(CollisionOperator{}))
        EXPECT_NE(key.doc.find("`" + std::string(choice.word) + "`: " + std::string(choice.meaning)),
                  std::string::npos);
      return;
    }
  FAIL() << "there is no fluid.collision";
}

TEST(KeyList, ReferencePageIsCurrent) {
  EXPECT_EQ(file_text(source_folder() / "docs/scene_reference.md"), reference_page())
      << "write it anew: lahar keys > docs/scene_reference.md";
}

}  // namespace
}  // namespace lahar::scene
