#pragma once
// Files of meshes, written for tests.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "tests/core/shapes.h"

namespace lahar::cases {

inline std::string stl_text(const TriangleMesh& m) {
  std::string text = "solid test\n";
  for (std::size_t t = 0; t < m.triangles.size(); ++t) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (std::size_t k = 0; k < 3; ++k)
      text += fmt::format("  vertex {} {} {}\n", m.corner(t, k).x(), m.corner(t, k).y(), m.corner(t, k).z());
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid test\n";
}

template <class T>
void put(std::string& bytes, T value, bool turned = false) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (turned) std::reverse(raw, raw + sizeof value);
  bytes.append(raw, sizeof value);
}

inline std::string stl_bytes(const TriangleMesh& m) {
  std::string bytes(80, ' ');
  put(bytes, static_cast<std::uint32_t>(m.triangles.size()));
  for (std::size_t t = 0; t < m.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) put(bytes, 0.0F);
    for (std::size_t k = 0; k < 3; ++k)
      for (int a = 0; a < 3; ++a) put(bytes, static_cast<float>(m.corner(t, k)[a]));
    put(bytes, std::uint16_t{0});
  }
  return bytes;
}

inline std::string obj_text(const TriangleMesh& m) {
  std::string text;
  for (const Vec3& p : m.points) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  for (const auto& t : m.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

inline std::string ply_header(const TriangleMesh& m, const char* format) {
  return fmt::format(
      "ply\nformat {} 1.0\ncomment a test\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "property uchar red\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      format, m.points.size(), m.triangles.size());
}

inline std::string ply_text(const TriangleMesh& m) {
  std::string text = ply_header(m, "ascii");
  for (const Vec3& p : m.points) text += fmt::format("{} {} {} 7\n", p.x(), p.y(), p.z());
  for (const auto& t : m.triangles) text += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  return text;
}

inline std::string ply_bytes(const TriangleMesh& m, bool big) {
  std::string bytes = ply_header(m, big ? "binary_big_endian" : "binary_little_endian");
  for (const Vec3& p : m.points) {
    for (int a = 0; a < 3; ++a) put(bytes, p[a], big);
    put(bytes, std::uint8_t{7});
  }
  for (const auto& t : m.triangles) {
    put(bytes, std::uint8_t{3});
    for (const std::uint32_t corner : t) put(bytes, static_cast<std::int32_t>(corner), big);
  }
  return bytes;
}

}  // namespace lahar::cases
