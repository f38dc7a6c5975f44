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

  /// The place between a and b at which f is zero, given that its signs differ there. Illinois' method.
  template <class F>
  Probe root(Probe a, Probe b, const F& f, double tolerance, Probe p) const {
    double fa = f(a), fb = f(b);
    int side = 0;
    for (int iteration = 0; iteration < 30; ++iteration) {
      const double fp = f(p);
      if (std::abs(fp) <= tolerance) break;
      if ((fp > 0) == (fb > 0)) {
        b = p, fb = fp;
        if (side == 1) fa *= 0.5;
        side = 1;
      } else {
        a = p, fa = fp;
        if (side == -1) fb *= 0.5;
        side = -1;
      }
      p = probe((a.s * fb - b.s * fa) / (fb - fa), p.nearest);
    }
    return p;
  }

  /// End of the patch between `outside` and the deepest place.
  double edge(const Probe& outside, const Probe& deepest) const {
    if (outside.overlap >= 0) return outside.s;
    const double fall = deepest.overlap - outside.overlap;  // of a parabola
    const double s = deepest.s + (outside.s - deepest.s) * std::sqrt(deepest.overlap / fall);
    return root(
               outside, deepest, [](const Probe& p) { return p.overlap; }, kEdge * deepest.overlap,
               probe(s, deepest.nearest))
        .s;
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
    const auto turn = [](const Probe& p) { return p.turn; };
    const double tolerance = kDeepest * reach_ * reach_;
    if (a.turn < 0 && b.turn > 0) {
      const double s = a.s + (b.s - a.s) * a.turn / (a.turn - b.turn);
      return around(a, root(a, b, turn, tolerance, probe(s, a.nearest)), b);
    }
    if (a.turn >= 0 && b.turn >= 0) return around(a, a, b);
    if (a.turn <= 0 && b.turn <= 0) return around(a, b, b);
    // Nearest at both ends, farthest in between: one patch at each end, or all of it.
    const Probe far = root(a, b, turn, tolerance, probe(0.5 * (a.s + b.s), a.nearest));
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
  const auto consider = [&](std::size_t k, double t) {
    const Triple point = partner.segments[k].at(t);
    const double square = dot(point - x, point - x);
    if (square < least) least = square, best = {point, static_cast<std::uint32_t>(k), t};
  };
  const auto consider_all_of = [&](std::size_t k) {
    const SplineSegment& p = partner.segments[k];
    const auto slope = [&](double t) { return dot(p.at(t) - x, p.along(t)); };
    consider(k, 0);
    consider(k, 1);
    constexpr int parts = 4;
    double before = slope(0);
    for (int n = 1; n <= parts; ++n) {
      const double now = slope(1.0 * n / parts);
      if (before < 0 && now > 0) consider(k, nearest_on(p, x, (n - 1.0) / parts, 1.0 * n / parts, (n - 0.5) / parts));
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
    double t = 0;
    if (dot(p.start - x, p.slope) >= 0) {
      if (k > 0 && way <= 0) {
        way = -1, --k;
        continue;
      }
    } else if (dot(p.at(1) - x, p.along(1)) <= 0) {
      t = 1;
      if (k + 1 < count && way >= 0) {
        way = 1, ++k;
        continue;
      }
    } else {
      t = nearest_on(p, x, 0, 1, k == from.segment ? from.t : 0.5);
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
