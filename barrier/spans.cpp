#include "barrier/spans.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "barrier/anchors.h"
#include "barrier/construction.h"
#include "barrier/link.h"
#include "core/check.h"
#include "core/number_text.h"

namespace lahar::barrier {

namespace {

/// A bond of the cable, N/m.
double cable_stiffness(const RingNetSpec& net) {
  const double radius = net.cable.bond_radius > 0 ? net.cable.bond_radius : 0.5 * net.wire_diameter;
  return net.cable.axial.stiffness[0] * std::numbers::pi * radius * radius;
}

/// Fractions of a cable's length that are tied to the left and to the right post.
struct TiedPlaces {
  std::vector<double> left, right;
};

/// Takes out of the supports of a span's cables what the posts hold.
std::array<TiedPlaces, 4> free_ends(RingNetSpec& net) {
  std::array<TiedPlaces, 4> tied;
  for (const auto& [side, cable] : {std::pair{Side::upper, &net.upper}, std::pair{Side::lower, &net.lower}}) {
    if (cable->support.fixed_all) continue;
    auto& places = cable->support.fixed_at;
    TiedPlaces& ends = tied[static_cast<std::size_t>(side)];
    if (std::ranges::count(places, 0.0) > 0) ends.left = {0};
    if (std::ranges::count(places, 1.0) > 0) ends.right = {1};
    std::erase_if(places, [](double f) { return f == 0 || f == 1; });
  }
  tied[static_cast<std::size_t>(Side::left)].left = std::exchange(net.left.support.fixed_at, {});
  tied[static_cast<std::size_t>(Side::right)].right = std::exchange(net.right.support.fixed_at, {});
  return tied;
}

template <class T>
void append(std::vector<T>& all, std::vector<T>& part) {
  all.insert(all.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
}

/// Builds a barrier part by part.
class Builder {
 public:
  Builder(const SpansSpec& spec, dem::Particles& particles, dem::Bonds& bonds)
      : spec_(spec), particles_(particles), bonds_(bonds) {
    tie_sort_ = bonds.add_sort(link_bond(cable_stiffness(spec.net), 0.5 * spec.net.wire_diameter));
  }

  Net build() {
    for (int s = 0; s < spec_.spans; ++s) add_span(s);
    for (int k = 0; k <= spec_.spans; ++k) add_post_at(k);
    for (std::size_t s = 0; s < spans_.size(); ++s) tie_span(s);
    merge();
    add_elements();
    note_beads();
    return std::move(all_);
  }

 private:
  [[nodiscard]] std::int32_t next_body() { return spec_.net.first_body + bodies_++; }

  void add_span(int s) {
    RingNetSpec net = spec_.net;
    net.origin += s * post_distance(spec_) * net.across;
    net.first_body = spec_.net.first_body + bodies_;
    tied_ = free_ends(net);
    spans_.push_back(build_net(net, particles_, bonds_));
    bodies_ += static_cast<std::int32_t>(spans_.back().rings.size() + spans_.back().meshes.size() +
                                         spans_.back().cables.size());
  }

  void add_post_at(int k) {
    PostSpec post = post_spec(spec_, k);
    post.body = next_body();
    posts_.push_back(add_post(post, particles_, bonds_));
  }

  void tie(dem::ParticleId bead, const Post& post) {
    const Vec3 place = particles_.position[particles_.index(bead)];
    const auto away = [&](dem::ParticleId id) {
      return (particles_.position[particles_.index(id)] - place).squaredNorm();
    };
    dem::ParticleId nearest = post.wire.first_bead;
    for (dem::ParticleId i = nearest; i <= post.head(); ++i)
      if (away(i) < away(nearest)) nearest = i;
    ties_.push_back(bonds_.size());
    bonds_.add({bead, nearest, tie_sort_}, particles_);
  }

  void tie_span(std::size_t s) {
    for (std::size_t c = 0; c < spans_[s].cables.size(); ++c) {
      const Wire& cable = spans_[s].cables[c];
      const TiedPlaces& places = tied_[static_cast<std::size_t>(spans_[s].cable_sides[c])];
      const auto first = cable.first_bead;
      for (const std::size_t k : items_at(places.left, cable.beads))
        tie(first + static_cast<dem::ParticleId>(k), posts_[s]);
      for (const std::size_t k : items_at(places.right, cable.beads))
        tie(first + static_cast<dem::ParticleId>(k), posts_[s + 1]);
    }
  }

  void merge() {
    all_ = std::move(spans_.front());
    for (std::size_t s = 1; s < spans_.size(); ++s) {
      append(all_.rings, spans_[s].rings);
      append(all_.meshes, spans_[s].meshes);
      append(all_.cables, spans_[s].cables);
      append(all_.cable_sides, spans_[s].cable_sides);
      append(all_.corners, spans_[s].corners);
      append(all_.dissipators, spans_[s].dissipators);
      append(all_.ties, spans_[s].ties);
    }
    all_.spans = spec_.spans;
    all_.posts = posts_;
    append(all_.ties, ties_);
  }

  void add_elements() {
    Construction construction{spec_, particles_, bonds_, all_, tie_sort_, next_body()};
    all_.elements.resize(Elements::components.size());
    spec_.elements.for_each_kind([&](const auto& list, std::size_t kind) {
      for (const auto& element : list) element.add_to(construction, all_.elements[kind]);
    });
  }

  void note_beads() {
    all_.beads = particles_.size() - all_.first_bead;
    all_.bonds = bonds_.size() - all_.first_bond;
    all_.start = {};
    all_.fixed_beads.clear();
    note_beads_since(all_.first_bead, particles_, all_);
  }

  const SpansSpec& spec_;
  dem::Particles& particles_;
  dem::Bonds& bonds_;
  int tie_sort_ = 0;
  std::int32_t bodies_ = 0;
  std::vector<Net> spans_;
  std::vector<Post> posts_;
  std::vector<std::size_t> ties_;
  std::array<TiedPlaces, 4> tied_;
  Net all_;
};

/// The ends of upper and lower cables hang on posts. The bead nearest to a place beside an end may be that of the end,
/// which would be fixed as well.
void check_places(const RingNetSpec& net) {
  for (const NetCable* cable : {&net.upper, &net.lower}) {
    if (cable->support.fixed_all) continue;
    for (const double f : cable->support.fixed_at) {
      const double away = std::min(f, 1 - f) * net.width;
      if (away > 0 && away < net.wire_diameter)
        throw InputError("a cable is fixed " + number_text(away) +
                         " m from its end, which hangs on a post, expected a wire's diameter, " +
                         number_text(net.wire_diameter) + " m, at least");
    }
  }
}

void check(const SpansSpec& s) {
  if (s.spans < 1) throw InputError("a barrier with posts needs one span at least");
  if (!(s.post_height >= s.net.height))
    throw InputError("posts of " + number_text(s.post_height) + " m are shorter than the net, " +
                     number_text(s.net.height) + " m");
  if (s.net.free_net) throw InputError("a net between posts needs its cables");
  check_places(s.net);
}

}  // namespace

double post_clearance(const RingNetSpec& net) { return net.wire_diameter; }

double post_distance(const SpansSpec& spec) {
  return spec.net.width + spec.post_diameter + 2 * post_clearance(spec.net);
}

Vec3 post_base(const SpansSpec& spec, int k) {
  const double first = -(0.5 * spec.post_diameter + post_clearance(spec.net));
  return spec.net.origin + (first + k * post_distance(spec)) * spec.net.across;
}

PostSpec post_spec(const SpansSpec& spec, int k) {
  PostSpec post;
  post.foot = post_base(spec, k);
  post.head = post_base(spec, k) + (spec.post_height - 0.5 * spec.post_diameter) * spec.net.up;
  post.across = spec.net.across;
  post.diameter = spec.post_diameter;
  post.section = spec.section;
  post.foot_joint = spec.foot;
  post.material = spec.net.material;
  return post;
}

Net build_spans(const SpansSpec& spec, dem::Particles& particles, dem::Bonds& bonds) {
  check(spec);
  return Builder(spec, particles, bonds).build();
}

}  // namespace lahar::barrier
