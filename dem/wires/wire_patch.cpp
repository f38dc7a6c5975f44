#include "dem/wires/wire_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lahar::dem {

namespace {

// Gauss-Legendre, four nodes on [0, 1]: exact up to degree 7. The overlap is nearly a parabola, its square of degree 4.
constexpr std::array<double, 4> kPlace{0.06943184420297371, 0.3300094782075719, 0.6699905217924281, 0.9305681557970262};
constexpr std::array<double, 4> kShare{0.17392742256872692, 0.32607257743127305, 0.32607257743127305,
                                       0.17392742256872692};

// Wires that lie nearly along each other may be nearest at several places of a segment.
constexpr std::size_t kStretches = 4;
static_assert(2 * kStretches * kPlace.size() <= std::tuple_size_v<decltype(WirePatch::nodes)>);

// What lies beyond an edge adds the third power of the overlap there, as a share of the deepest. The deepest place only
// has to lie in the patch: its overlap is short by at most a quarter (a stretch) of the slope left, over the reach.
constexpr double kEdge = 1e-4, kDeepest = 1e-6;

/// Half the slope of the squared distance between a place and a segment, along the segment: a cubic in t.
class Turn {
 public:
  /// @param from  from the place to the segment's start
  Turn(const SplineSegment& p, const Triple& from)
      : c0_(dot(from, p.slope)),
        c1_(dot(p.slope, p.slope) + 2 * dot(from, p.bend)),
        c2_(3 * dot(p.slope, p.bend)),
        c3_(2 * dot(p.bend, p.bend)) {}
  [[nodiscard]] double at(double t) const { return c0_ + t * (c1_ + t * (c2_ + t * c3_)); }
  /// By how much the squared distance at t is more than at the start.
  [[nodiscard]] double gained(double t) const {
    return t * (2 * c0_ + t * (c1_ + t * (2.0 / 3 * c2_ + 0.5 * t * c3_)));
  }
  /// The zero between low and high, given that it grows from below to above there (Newton, guarded by bisection).
  [[nodiscard]] double zero(double low, double high, double guess) const {
    double t = guess;
    for (int iteration = 0; iteration < 40; ++iteration) {
      const double g = at(t);
      (g < 0 ? low : high) = t;
      double next = t - g / (c1_ + t * (2 * c2_ + 3 * c3_ * t));
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
      const double step = std::abs(next - t);
      t = next;
      if (step < 1e-8) break;  // the error is about the square of it
    }
    return t;
  }

 private:
  double c0_, c1_, c2_, c3_;
};

/// What is known of one place of the segment.
struct Probe {
  double s = 0, overlap = 0, turn = 0;  // turn: half the slope of the squared distance
  NearestPoint nearest;
};

class Search {
 public:
  Search(const SplineSegment& segment, const WirePartner& partner, double reach, WirePatch& patch)
      : segment_(segment), partner_(partner), reach_(reach), patch_(patch) {}

  Probe probe(double s, const NearestPoint& from) const {
    const Triple x = segment_.at(s);
    Probe p{s, 0, 0, nearest_point(partner_, x, from)};
    const Triple d = x - p.nearest.point;
    p.overlap = reach_ - length(d);
    p.turn = dot(d, segment_.along(s));
    return p;
  }

  /// The place between a and b at which the distance has its extremum: their turns differ in sign. By Newton, guarded
  /// by bisection.
  Probe extremum(const Probe& a, const Probe& b, Probe p) const {
    double low = a.s, high = b.s;
    for (int iteration = 0; iteration < 30 && std::abs(p.turn) > kDeepest * reach_ * reach_; ++iteration) {
      ((p.turn > 0) == (a.turn > 0) ? low : high) = p.s;
      double next = p.s - p.turn / growth_of_turn(p);
      if (!(next > low && next < high)) next = 0.5 * (low + high);
      p = probe(next, p.nearest);
    }
    return p;
  }

  /// d turn / ds; the nearest point moves along.
  double growth_of_turn(const Probe& p) const {
    const Triple along = segment_.along(p.s), d = segment_.at(p.s) - p.nearest.point;
    const double growth = dot(along, along) + 2 * dot(d, segment_.bend);
    if (partner_.segments.empty() || p.nearest.t <= 0 || p.nearest.t >= 1) return growth;
    const SplineSegment& other = partner_.segments[p.nearest.segment];
    const Triple beside = other.along(p.nearest.t);
    const double follows = dot(along, beside);
    return growth - follows * follows / (dot(beside, beside) - 2 * dot(d, other.bend));
  }

  /// End of the patch between `outside` and the deepest place: from that of a parabola on by Newton, guarded by
  /// bisection; the overlap grows by -turn / distance along the segment.
  double edge(const Probe& outside, const Probe& deepest) const {
    if (outside.overlap >= 0) return outside.s;
    double in = deepest.s, out = outside.s;
    const double fall = deepest.overlap - outside.overlap;
    Probe p = probe(in + (out - in) * std::sqrt(deepest.overlap / fall), deepest.nearest);
    for (int iteration = 0; iteration < 30 && std::abs(p.overlap) > kEdge * deepest.overlap; ++iteration) {
      (p.overlap > 0 ? in : out) = p.s;
      double next = p.s + p.overlap * (reach_ - p.overlap) / p.turn;
      if (!((next - in) * (next - out) < 0)) next = 0.5 * (in + out);
      p = probe(next, p.nearest);
    }
    return p.s;
  }

  void add_nodes(double from, double to, const NearestPoint& hint) {
    for (std::size_t k = 0; k < kPlace.size(); ++k) {
      PatchNode n;
      n.s = from + (to - from) * kPlace[k];
      n.point = segment_.at(n.s);
      n.nearest = nearest_point(partner_, n.point, hint);
      const Triple d = n.nearest.point - n.point;
      const double distance = length(d);
      n.overlap = std::max(0.0, reach_ - distance);
      n.normal = (1 / distance) * d;
      const Triple along = segment_.along(n.s);
      const double stretch = length(along);
      n.along = (1 / stretch) * along;
      n.share = (to - from) * kShare[k];
      n.weight = n.share * stretch;
      patch_.integral += n.weight * n.overlap * n.overlap;
      patch_.depth = std::max(patch_.depth, n.overlap);
      patch_.nodes[patch_.count++] = n;
    }
  }

  void around(const Probe& left, const Probe& deepest, const Probe& right) {
    note_gap(-deepest.overlap - kDeepest * reach_);
    if (deepest.overlap <= 0) return;
    add_nodes(edge(left, deepest), edge(right, deepest), deepest.nearest);
  }

  void note_gap(double gap) { patch_.gap = std::min(patch_.gap, gap); }

  /// The patch within one stretch of the segment, in which the distance has one extremum or none.
  void search(const Probe& a, const Probe& b) {
    if (a.turn < 0 && b.turn > 0) {
      const double s = a.s + (b.s - a.s) * a.turn / (a.turn - b.turn);
      return around(a, extremum(a, b, probe(s, a.nearest)), b);
    }
    if (a.turn >= 0 && b.turn >= 0) return around(a, a, b);
    if (a.turn <= 0 && b.turn <= 0) return around(a, b, b);
    // Nearest at both ends, farthest in between: one patch at each end, or all of it.
    const Probe far = extremum(a, b, probe(0.5 * (a.s + b.s), a.nearest));
    if (far.overlap >= 0) return add_nodes(a.s, b.s, far.nearest);
    around(a, a, far);
    around(far, b, b);
  }

  void run(const NearestPoint& hint) {
    Probe a = probe(0, hint);
    for (std::size_t k = 1; k <= kStretches; ++k) {
      const Probe b = probe(static_cast<double>(k) / kStretches, a.nearest);
      // The distance changes by no more than the way along the wire.
      const double way = std::max(length(segment_.along(a.s)), length(segment_.along(b.s))) / kStretches;
      const double most = 0.5 * (a.overlap + b.overlap + way);
      most > 0 ? search(a, b) : note_gap(-most);
      a = b;
    }
  }

 private:
  const SplineSegment& segment_;
  const WirePartner& partner_;
  double reach_;
  WirePatch& patch_;
};

}  // namespace

namespace {

/// The nearest of all points of the run. Each quarter of a segment holds at most one place that is nearer than those
/// around it. Segments whose balls are farther than what was found from `from` on are left out.
NearestPoint nearest_point_of_all(const WirePartner& partner, const Triple& x, const NearestPoint& from) {
  NearestPoint best;
  double least = std::numeric_limits<double>::infinity(), distance = least;
  const auto consider_all_of = [&](std::size_t k) {
    const SplineSegment& p = partner.segments[k];
    const Triple to_start = p.start - x;
    const Turn turn(p, to_start);
    const double at_start = dot(to_start, to_start);
    const auto consider = [&](double t) {
      const double square = at_start + turn.gained(t);
      if (square < least) least = square, best.segment = static_cast<std::uint32_t>(k), best.t = t;
    };
    consider(0);
    consider(1);
    constexpr int parts = 4;
    double before = turn.at(0);
    for (int n = 1; n <= parts; ++n) {
      const double now = turn.at(1.0 * n / parts);
      if (before < 0 && now > 0) consider(turn.zero((n - 1.0) / parts, 1.0 * n / parts, (n - 0.5) / parts));
      before = now;
    }
    distance = std::sqrt(least);
  };
  consider_all_of(from.segment);
  for (std::size_t k = 0; k < partner.segments.size(); ++k) {
    const WirePartner::Ball& ball = partner.balls[k];
    const Triple d = ball.centre - x;
    const double reaches = distance + ball.radius;
    if (k != from.segment && dot(d, d) < reaches * reaches) consider_all_of(k);
  }
  best.point = partner.segments[best.segment].at(best.t);
  return best;
}

}  // namespace

void find_kinks(WirePartner& partner, double reach) {
  // The distance to x has one minimum where (C - x) . C' grows: C'^2 + (C - x) . C'' > 0.
  partner.kinked = false;
  for (const SplineSegment& p : partner.segments) {
    const double bend = length(p.bend), along = std::max(0.0, length(p.slope + p.bend) - bend);
    partner.kinked = partner.kinked || along * along <= 2 * bend * (reach + length(p.slope));
  }
  partner.balls.clear();
  if (!partner.kinked) return;
  for (const SplineSegment& p : partner.segments) {
    // The segment lies within its control polygon: start, start + slope / 2, end.
    const Triple middle = p.at(0.5);
    const auto way2 = [&](const Triple& x) { return dot(x - middle, x - middle); };
    partner.balls.push_back(
        {middle, std::sqrt(std::max({way2(p.start), way2(p.start + 0.5 * p.slope), way2(p.at(1))}))});
  }
}

NearestPoint nearest_point(const WirePartner& partner, const Triple& x, const NearestPoint& from) {
  if (partner.segments.empty()) return {partner.centre, 0, 0};
  if (partner.kinked) return nearest_point_of_all(partner, x, from);
  const std::size_t count = partner.segments.size();
  std::size_t k = from.segment;
  for (int way = 0;;) {  // never back: at a joint rounding must not send it to and fro
    const SplineSegment& p = partner.segments[k];
    const Turn turn(p, p.start - x);
    double t = 0;
    if (turn.at(0) >= 0) {
      if (k > 0 && way <= 0) {
        way = -1, --k;
        continue;
      }
    } else if (turn.at(1) <= 0) {
      t = 1;
      if (k + 1 < count && way >= 0) {
        way = 1, ++k;
        continue;
      }
    } else {
      t = turn.zero(0, 1, k == from.segment ? from.t : 0.5);
    }
    return {p.at(t), static_cast<std::uint32_t>(k), t};
  }
}

bool find_patch(const SplineSegment& segment, const WirePartner& partner, double reach, double extent,
                const NearestPoint& hint, WirePatch& patch) {
  patch.integral = patch.depth = 0;
  patch.count = 0;
  const Triple middle = segment.at(0.5);
  const NearestPoint nearest = nearest_point(partner, middle, hint);
  patch.gap = length(nearest.point - middle) - reach - extent;
  if (patch.gap >= 0) return false;
  patch.gap = std::numeric_limits<double>::infinity();
  Search(segment, partner, reach, patch).run(nearest);
  return patch.integral > 0;
}

double equivalent_overlap(double integral, double reach) {
  return std::pow(integral / (16.0 / 15.0 * std::sqrt(2 * reach)), 0.4);
}

}  // namespace lahar::dem
