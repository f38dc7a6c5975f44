// PLY (Turk 1994): a header of text that describes elements and their properties, then the elements as text or binary.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <map>

#include "cases/files/polygon.h"
#include "cases/files/text_lines.h"

namespace lahar::cases {

namespace {

enum class Format { text, little, big };

struct Property {
  std::string name, type, count_type;  ///< count_type is empty unless it is a list
};

struct Element {
  std::string name;
  long count = 0;
  std::vector<Property> properties;
};

struct Header {
  Format format = Format::text;
  std::vector<Element> elements;
};

std::size_t size_of(const std::string& type) {
  static const std::map<std::string, std::size_t> sizes{{"char", 1},  {"int8", 1},    {"uchar", 1},  {"uint8", 1},
                                                        {"short", 2}, {"int16", 2},   {"ushort", 2}, {"uint16", 2},
                                                        {"int", 4},   {"int32", 4},   {"uint", 4},   {"uint32", 4},
                                                        {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

Header read_header(TextLines& lines) {
  Header header;
  std::vector<std::string_view> words;
  if (!lines.next(words) || words[0] != "ply") lines.fail("expected \"ply\"");
  while (lines.next(words) && words[0] != "end_header") {
    if (words[0] == "format" && words.size() > 1) {
      if (words[1] != "ascii" && words[1] != "binary_little_endian" && words[1] != "binary_big_endian")
        lines.fail("unknown format");
      header.format = words[1] == "ascii"                  ? Format::text
                      : words[1] == "binary_little_endian" ? Format::little
                                                           : Format::big;
    } else if (words[0] == "element" && words.size() == 3) {
      header.elements.push_back({std::string(words[1]), lines.whole(words[2]), {}});
      if (header.elements.back().count < 0) lines.fail("a negative number of elements");
    } else if (words[0] == "property" && words.size() >= 3 && !header.elements.empty()) {
      const bool list = words[1] == "list";
      if (list && words.size() != 5) lines.fail("expected \"property list TYPE TYPE NAME\"");
      const Property p = list ? Property{std::string(words[4]), std::string(words[3]), std::string(words[2])}
                              : Property{std::string(words[2]), std::string(words[1]), ""};
      if (size_of(p.type) == 0 || (list && size_of(p.count_type) == 0)) lines.fail("unknown type of a property");
      header.elements.back().properties.push_back(p);
    } else if (words[0] != "comment" && words[0] != "obj_info") {
      lines.fail(fmt::format("\"{}\" is not understood", words[0].substr(0, 40)));
    }
  }
  if (words.empty()) throw ShapeFileError("ends inside its header");
  return header;
}

/// Numbers one after the other, whatever their form.
class Values {
 public:
  Values(std::string_view data, Format format) : data_(data), format_(format) {}
  [[nodiscard]] std::size_t bytes_left() const { return data_.size(); }
  double next(const std::string& type) { return format_ == Format::text ? next_word() : next_binary(type); }

 private:
  double next_word() {
    constexpr std::string_view blank = " \t\r\n";
    const std::size_t start = data_.find_first_not_of(blank);
    if (start == std::string_view::npos) throw ShapeFileError("ends too early");
    data_.remove_prefix(start);
    const std::size_t end = std::min(data_.find_first_of(blank), data_.size());
    const std::string_view word = data_.substr(0, end);
    data_.remove_prefix(end);
    double value = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || stop != word.data() + word.size())
      throw ShapeFileError(fmt::format("\"{}\" is no number", word.substr(0, 40)));
    return value;
  }
  template <class T>
  static double as(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  }
  double next_binary(const std::string& type) {
    const std::size_t size = std::min<std::size_t>(8, size_of(type));
    if (data_.size() < size) throw ShapeFileError("ends too early");
    std::array<char, 8> bytes{};
    for (std::size_t k = 0; k < size; ++k) bytes[format_ == Format::big ? size - 1 - k : k] = data_[k];
    data_.remove_prefix(size);
    if (type.starts_with("float") || type == "double")
      return size == 4 ? as<float>(bytes.data()) : as<double>(bytes.data());
    const bool without_sign = type.starts_with('u');
    if (size == 1) return without_sign ? as<std::uint8_t>(bytes.data()) : as<std::int8_t>(bytes.data());
    if (size == 2) return without_sign ? as<std::uint16_t>(bytes.data()) : as<std::int16_t>(bytes.data());
    return without_sign ? as<std::uint32_t>(bytes.data()) : as<std::int32_t>(bytes.data());
  }

  std::string_view data_;
  Format format_;
};

void read_vertex(Values& values, const Element& element, TriangleMesh& mesh) {
  Vec3 point = Vec3::Zero();
  for (const Property& p : element.properties) {
    const double value = values.next(p.type);
    if (p.name == "x" || p.name == "y" || p.name == "z") point[p.name[0] - 'x'] = value;
  }
  if (!point.allFinite()) throw ShapeFileError(fmt::format("vertex {} is not finite", mesh.points.size()));
  mesh.points.push_back(point);
}

/// `number` counts the elements of this kind from 0.
void read_other(Values& values, const Element& element, long number, TriangleMesh& mesh) {
  for (const Property& p : element.properties) {
    const double count = p.count_type.empty() ? 1 : values.next(p.count_type);
    const bool corners = element.name == "face" && (p.name == "vertex_indices" || p.name == "vertex_index");
    if (!(count >= 0)) throw ShapeFileError("a list has a negative length");
    std::vector<std::uint32_t> face;
    for (double k = 0; k < count; ++k) {
      const double value = values.next(p.type);
      if (!corners) continue;
      if (!(value >= 0 && value < static_cast<double>(mesh.points.size())))
        throw ShapeFileError(fmt::format("corner {} of a face does not exist", value));
      face.push_back(static_cast<std::uint32_t>(value));
    }
    if (!add_face(mesh, face)) throw ShapeFileError(fmt::format("face {}: {}", number, kUncutFace));
  }
}

}  // namespace

TriangleMesh parse_ply(const std::string& bytes) {
  TextLines lines(bytes);
  const Header header = read_header(lines);
  Values values(lines.rest(), header.format);
  TriangleMesh mesh;
  for (const Element& element : header.elements) {
    const bool lists = std::any_of(element.properties.begin(), element.properties.end(),
                                   [](const Property& p) { return !p.count_type.empty(); });
    const bool vertices = element.name == "vertex" && !lists;
    if (element.properties.empty()) continue;
    if (static_cast<std::size_t>(element.count) > values.bytes_left())  // each takes a byte at least
      throw ShapeFileError(
          fmt::format("says that it has {} of \"{}\" and ends too early", element.count, element.name.substr(0, 40)));
    for (long k = 0; k < element.count; ++k) {
      if (vertices)
        read_vertex(values, element, mesh);
      else
        read_other(values, element, k, mesh);
    }
  }
  return mesh;
}

}  // namespace lahar::cases
