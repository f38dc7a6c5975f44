#include "cases/pictures/water_field.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace lahar::cases {

namespace {

constexpr float kSurface = 0.5F;
constexpr float kStep = 0.5F;  // of the march through surface blocks, in cells

Vec3i floored(const Vec3f& v) { return v.array().floor().cast<int>(); }

int floor_divide(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

// Adds crossings of the surface along a ray to a list of spans.
class SpanRecorder {
 public:
  explicit SpanRecorder(WetSpans& spans) : spans_(spans) {}
  [[nodiscard]] bool wet() const { return wet_; }
  [[nodiscard]] bool full() const { return spans_.count == static_cast<int>(spans_.spans.size()); }
  void enter(float t) { wet_ = true, entry_ = t; }
  void leave(float t) {
    wet_ = false;
    if (!full() && t > entry_) spans_.spans[static_cast<std::size_t>(spans_.count++)] = {entry_, t};
  }

 private:
  WetSpans& spans_;
  bool wet_ = false;
  float entry_ = 0;
};

}  // namespace

WaterField::WaterField(const lbm::FluidSnapshot& fluid, int smoothing_passes)
    : cell_(static_cast<float>(fluid.cell_size)), origin_(fluid.origin.cast<float>()) {
  if (fluid.blocks.empty()) return;
  index_blocks(fluid);
  fill_padding();
  for (int pass = 0; pass < smoothing_passes; ++pass) {
    smooth();
    fill_padding();
  }
  classify();
}

void WaterField::index_blocks(const lbm::FluidSnapshot& fluid) {
  for (const auto& block : fluid.blocks)
    block_of_brick_.emplace_back(
        block.origin.unaryExpr([](int c) { return floor_divide(c, lbm::FluidSnapshot::block_width); }));
  Vec3i last = first_block_ = block_of_brick_[0];
  for (const Vec3i& b : block_of_brick_) first_block_ = first_block_.cwiseMin(b), last = last.cwiseMax(b);
  blocks_ = last - first_block_ + Vec3i::Ones();
  table_.assign(static_cast<std::size_t>(blocks_.x()) * static_cast<std::size_t>(blocks_.y()) *
                    static_cast<std::size_t>(blocks_.z()),
                -1);
  bricks_.resize(fluid.blocks.size());
  for (std::size_t b = 0; b < bricks_.size(); ++b) {
    const Vec3i r = block_of_brick_[b] - first_block_;
    table_[static_cast<std::size_t>((r.x() * blocks_.y() + r.y()) * blocks_.z() + r.z())] =
        static_cast<std::int32_t>(b);
    for (int x = 0; x < kWidth; ++x)
      for (int y = 0; y < kWidth; ++y)
        for (int z = 0; z < kWidth; ++z)
          bricks_[b][padded_index(x, y, z)] =
              fluid.blocks[b].fill_level[static_cast<std::size_t>((x * kWidth + y) * kWidth + z)];
  }
}

std::int32_t WaterField::brick_at(const Vec3i& block) const {
  const Vec3i r = block - first_block_;
  if ((r.array() < 0).any() || (r.array() >= blocks_.array()).any()) return -1;
  return table_[static_cast<std::size_t>((r.x() * blocks_.y() + r.y()) * blocks_.z() + r.z())];
}

float WaterField::cell_value(const Vec3i& cell) const {
  const Vec3i block = cell.unaryExpr([](int c) { return floor_divide(c, kWidth); });
  const std::int32_t brick = brick_at(block);
  if (brick < 0) return 0;
  const Vec3i local = cell - kWidth * block;
  return bricks_[static_cast<std::size_t>(brick)][padded_index(local.x(), local.y(), local.z())];
}

void WaterField::fill_padding() {
  const auto inside = [](int c) { return c >= 0 && c < kWidth; };
  parallel_for(0, bricks_.size(), 8, [&](std::size_t b) {
    const Vec3i first = kWidth * block_of_brick_[b];
    for (int x = -1; x <= kWidth; ++x)
      for (int y = -1; y <= kWidth; ++y)
        for (int z = -1; z <= kWidth; ++z)
          if (!inside(x) || !inside(y) || !inside(z))
            bricks_[b][padded_index(x, y, z)] = cell_value(first + Vec3i(x, y, z));
  });
}

void WaterField::smooth() {
  std::vector<Brick> smoothed(bricks_.size());
  parallel_for(0, bricks_.size(), 8, [&](std::size_t b) {
    for (int x = 0; x < kWidth; ++x)
      for (int y = 0; y < kWidth; ++y)
        for (int z = 0; z < kWidth; ++z) {
          float sum = 0;
          for (int i = -1; i <= 1; ++i)
            for (int j = -1; j <= 1; ++j)
              for (int k = -1; k <= 1; ++k)
                sum += static_cast<float>((2 - i * i) * (2 - j * j) * (2 - k * k)) *
                       bricks_[b][padded_index(x + i, y + j, z + k)];
          smoothed[b][padded_index(x, y, z)] = sum / 64;
        }
  });
  bricks_ = std::move(smoothed);
}

void WaterField::classify() {
  content_.resize(bricks_.size());
  for (std::size_t b = 0; b < bricks_.size(); ++b) {
    const auto [least, most] = std::minmax_element(bricks_[b].begin(), bricks_[b].end());
    content_[b] = *most < kSurface ? Content::gas : *least >= kSurface ? Content::liquid : Content::surface;
  }
}

// `local` counts cells from the brick's lowest corner, 0..8; cell centres lie at halves.
float WaterField::interpolate(const Brick& brick, const Vec3f& local) const {
  const Vec3f p = (local + Vec3f::Constant(0.5F)).cwiseMax(0.0F).cwiseMin(static_cast<float>(kPadded) - 1.001F);
  const int x = static_cast<int>(p.x()), y = static_cast<int>(p.y()), z = static_cast<int>(p.z());
  const float fx = p.x() - static_cast<float>(x), fy = p.y() - static_cast<float>(y),
              fz = p.z() - static_cast<float>(z);
  const float* c = &brick[padded_index(x - 1, y - 1, z - 1)];
  const auto along_z = [&](int offset) { return c[offset] + fz * (c[offset + 1] - c[offset]); };
  const auto along_y = [&](int offset) {
    const float low = along_z(offset);
    return low + fy * (along_z(offset + kPadded) - low);
  };
  const float low = along_y(0);
  return low + fx * (along_y(kPadded * kPadded) - low);
}

float WaterField::fill_level(const Vec3f& position) const {
  const Vec3f p = to_cells(position) - Vec3f::Constant(0.5F);
  const Vec3i base = floored(p);
  const Vec3f f = p - base.cast<float>();
  float value = 0;
  for (int n = 0; n < 8; ++n) {
    const Vec3i corner(n & 1, n >> 1 & 1, n >> 2 & 1);
    float weight = 1;
    for (int d = 0; d < 3; ++d) weight *= corner[d] != 0 ? f[d] : 1 - f[d];
    value += weight * cell_value(base + corner);
  }
  return value;
}

Vec3f WaterField::normal(const Vec3f& position) const {
  Vec3f gradient;
  for (int d = 0; d < 3; ++d) {
    const Vec3f step = cell_ * Vec3f::Unit(d);
    gradient[d] = fill_level(position + step) - fill_level(position - step);
  }
  const float length = gradient.norm();
  return length > 0 ? Vec3f(-gradient / length) : Vec3f::UnitZ();
}

// Walks through the table of blocks (Amanatides & Woo 1987). visit(block, entry, exit) returns false to stop.
template <class Visit>
void WaterField::visit_blocks(const Ray& ray, float limit, const Visit& visit) const {
  const auto width = static_cast<float>(kWidth);
  const Vec3f lower = width * first_block_.cast<float>(), upper = lower + width * blocks_.cast<float>();
  const BoxSpan span = box_span(lower, upper, ray);
  const float last = std::min(span.exit, limit);
  if (!(span.entry < last)) return;
  Vec3i block =
      floored(ray.at(span.entry) / width).cwiseMax(first_block_).cwiseMin(first_block_ + blocks_ - Vec3i::Ones());
  Vec3i step;
  Vec3f next, delta;
  for (int d = 0; d < 3; ++d) {
    step[d] = ray.direction[d] > 0 ? 1 : -1;
    delta[d] = width / std::abs(ray.direction[d]);
    const float face = width * static_cast<float>(block[d] + (step[d] > 0 ? 1 : 0));
    next[d] = ray.direction[d] != 0 ? (face - ray.origin[d]) / ray.direction[d] : kNoHit;
  }
  for (float entry = span.entry; entry < last;) {
    Eigen::Index axis = 0;
    const float exit = std::min(next.minCoeff(&axis), last);
    if (!visit(block, entry, std::max(entry, exit))) return;
    entry = std::max(entry, exit);
    block[axis] += step[axis];
    next[axis] += delta[axis];
  }
}

WetSpans WaterField::wet_spans(const Ray& ray, float limit) const {
  WetSpans spans;
  if (bricks_.empty()) return spans;
  const Ray in_cells{to_cells(ray.origin), ray.direction};
  SpanRecorder recorder(spans);
  float end = 0;
  visit_blocks(in_cells, limit / cell_, [&](const Vec3i& block, float entry, float exit) {
    const std::int32_t brick = brick_at(block);
    const Content content = brick < 0 ? Content::gas : content_[static_cast<std::size_t>(brick)];
    end = exit;
    if (content != Content::surface) {
      const bool liquid = content == Content::liquid;
      if (liquid && !recorder.wet()) recorder.enter(cell_ * entry);
      if (!liquid && recorder.wet()) recorder.leave(cell_ * entry);
      return !recorder.full();
    }
    const Brick& values = bricks_[static_cast<std::size_t>(brick)];
    const Vec3f corner = static_cast<float>(kWidth) * block.cast<float>();
    const auto excess = [&](float t) { return interpolate(values, in_cells.at(t) - corner) - kSurface; };
    const int steps = std::max(1, static_cast<int>(std::ceil((exit - entry) / kStep)));
    float before = entry, value_before = excess(entry);
    if ((value_before >= 0) != recorder.wet())
      value_before >= 0 ? recorder.enter(cell_ * entry) : recorder.leave(cell_ * entry);
    for (int n = 1; n <= steps && !recorder.full(); ++n) {
      const float t = entry + (exit - entry) * static_cast<float>(n) / static_cast<float>(steps);
      const float value = excess(t);
      if ((value >= 0) != (value_before >= 0)) {
        const float crossing = cell_ * (before + (t - before) * value_before / (value_before - value));
        value >= 0 ? recorder.enter(crossing) : recorder.leave(crossing);
      }
      before = t, value_before = value;
    }
    return !recorder.full();
  });
  if (recorder.wet()) recorder.leave(cell_ * end);
  return spans;
}

}  // namespace lahar::cases
