// Steady flow in a cube whose lid slides, Re = 1000, against the spectral solution of Albensoeder & Kuhlmann 2005.
// Their cube is [-1/2, 1/2]^3 with the lid at x = -1/2 moving along +y. Started at rest on coarse grids, each one until
// it is steady and then the start of the next.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "cases/pictures/chart.h"
#include "cases/validate/entry.h"
#include "cases/validate/fluid/flows.h"
#include "cases/validate/reference_table.h"

namespace lahar::validate {

namespace {

constexpr double kReynolds = 1000;
constexpr int kMostPassages = 100;

/// One grid of the way to the steady state.
struct Stage {
  int cells;
  double lid_speed;     ///< lu; 0.1 and 0.05 differ by up to 1 % in the profiles, hence the slow lid in the end
  double small_change;  ///< steady: largest change of the profiles in one passage of the lid (H / U), in lid speeds
};
constexpr std::array<Stage, 4> kStages = {{{24, 0.1, 2e-3}, {48, 0.1, 1e-3}, {96, 0.1, 5e-4}, {96, 0.05, 3e-4}}};
constexpr std::array<Stage, 2> kQuickStages = {{{16, 0.1, 4e-3}, {32, 0.1, 4e-3}}};

/// (place, speed) in units of the cube's side and the lid's speed.
using Points = std::vector<std::pair<double, double>>;

struct Spectral {
  Points v, u;  ///< v(x, 0, 0), u(0, y, 0)
  Spectral() {
    const ReferenceTable table = reference("cavity3d_re1000_albensoeder.csv");
    v = table.where("profile", "v(x,0,0)").points("coord", "value");
    u = table.where("profile", "u(0,y,0)").points("coord", "value");
  }
};

/// Velocity and density of the cell centres of a cube.
class CubeField {
 public:
  using Values = Eigen::Vector4d;  ///< velocity / U, (rho - 1) / U^2 with the speed U of the lid in lu

  explicit CubeField(int cells)
      : cells_(cells), values_(static_cast<std::size_t>(cells) * cells * cells, Values::Zero()) {}

  template <class Real>
  CubeField(const lbm::Fluid<Real>& fluid, const Stage& stage) : CubeField(stage.cells) {
    fluid.for_each_wet_cell([&](const lbm::WetCell& c) {
      const Vec3i i = c.centre.array().floor().cast<int>();
      values_[index(i)] << c.velocity / stage.lid_speed, 3 * c.pressure / (stage.lid_speed * stage.lid_speed);
    });
  }

  [[nodiscard]] const Values& cell(const Vec3i& i) const { return values_[index(i)]; }
  [[nodiscard]] int cells() const { return cells_; }

  /// Trilinear between cell centres, at a place in units of the side from the corner; carried on outwards in the half
  /// cell next to a wall.
  [[nodiscard]] Values operator()(const Vec3& place) const {
    const Vec3 p = (place * cells_).array() - 0.5;
    const Vec3i low = p.array().floor().cast<int>().max(0).min(cells_ - 2);
    const Vec3 share = p - low.cast<double>();
    Values sum = Values::Zero();
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3i step(corner & 1, corner >> 1 & 1, corner >> 2);
      double weight = 1;
      for (int a = 0; a < 3; ++a) weight *= step[a] ? share[a] : 1 - share[a];
      sum += weight * cell(low + step);
    }
    return sum;
  }

 private:
  [[nodiscard]] std::size_t index(const Vec3i& i) const {
    return static_cast<std::size_t>((i.x() * cells_ + i.y()) * cells_ + i.z());
  }
  int cells_;
  std::vector<Values> values_;
};

/// Velocity component along a line through the cube's centre, in lid speeds: cell centres and both walls.
struct Profile {
  std::vector<double> place, speed;
};

/// The line runs along `axis`; `lower` and `upper` are the speeds of the walls at its ends.
Profile profile_of(const CubeField& field, int axis, int component, double lower, double upper) {
  const int n = field.cells(), middle = n / 2;  // n is even: the line lies between four rows of cells
  Profile profile{{-0.5}, {lower}};
  for (int k = 0; k < n; ++k) {
    double sum = 0;
    for (int row = 0; row < 4; ++row) {
      Vec3i i;
      i[axis] = k, i[(axis + 1) % 3] = middle - (row & 1), i[(axis + 2) % 3] = middle - (row >> 1);
      sum += field.cell(i)[component];
    }
    profile.place.push_back((k + 0.5) / n - 0.5);
    profile.speed.push_back(sum / 4);
  }
  profile.place.push_back(0.5);
  profile.speed.push_back(upper);
  return profile;
}

/// Cubic through the four nearest points.
double interpolate(const Profile& p, double place) {
  const auto above = std::lower_bound(p.place.begin(), p.place.end(), place) - p.place.begin();
  const auto first = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 2, 0, std::ssize(p.place) - 4));
  double sum = 0;
  for (std::size_t i = first; i < first + 4; ++i) {
    double weight = 1;
    for (std::size_t j = first; j < first + 4; ++j)
      if (j != i) weight *= (place - p.place[j]) / (p.place[i] - p.place[j]);
    sum += weight * p.speed[i];
  }
  return sum;
}

/// RMS difference over the points of a table that are not on a wall.
double rms_difference(const Profile& profile, const Points& points) {
  double sum = 0;
  const auto inner = std::span(points).subspan(1, points.size() - 2);
  for (const auto& [place, speed] : inner) sum += std::pow(interpolate(profile, place) - speed, 2);
  return std::sqrt(sum / static_cast<double>(inner.size()));
}

struct Profiles {
  Profile v, u;  ///< v(x, 0, 0), u(0, y, 0)
  explicit Profiles(const CubeField& field) : v(profile_of(field, 0, 1, 1, 0)), u(profile_of(field, 1, 0, 0, 0)) {}
};

double largest_change(const Profiles& a, const Profiles& b) {
  double change = 0;
  for (std::size_t k = 0; k < a.v.speed.size(); ++k)
    change = std::max({change, std::abs(a.v.speed[k] - b.v.speed[k]), std::abs(a.u.speed[k] - b.u.speed[k])});
  return change;
}

struct Steady {
  CubeField field;
  double change;  ///< largest change of the profiles in the last passage of the lid, lid speeds
  int passages;
};

/// Runs one grid until it is steady.
template <class Real>
Steady run_to_rest(const CubeField& start, const Stage& stage) {
  const double n = stage.cells, speed = stage.lid_speed;
  lbm::FluidOptions o = lattice_box(Vec3i::Constant(stage.cells), speed * n / kReynolds);
  o.domain.faces.fill(lbm::FaceKind::closed);
  Wall lid{"lid", HalfSpace{Vec3::Zero(), Vec3::UnitX()}};
  lid.velocity = speed * Vec3::UnitY();
  o.domain.walls.add(lid);
  lbm::Fluid<Real> fluid(o);
  fluid.fill_everything([&](const Vec3& p) { return Vec3(speed * start(p / n).head<3>()); },
                        [&](const Vec3& p) { return speed * speed * start(p / n)[3]; });
  Steady result{CubeField(fluid, stage), 1, 0};
  while (result.change > stage.small_change && result.passages < kMostPassages) {
    const Profiles before(result.field);
    advance(fluid, static_cast<int>(std::lround(n / speed)));
    result.field = CubeField(fluid, stage);
    result.change = largest_change(before, Profiles(result.field));
    ++result.passages;
  }
  return result;
}

void draw(const Profiles& profiles, const Spectral& spectral, int cells, const std::filesystem::path& folder) {
  const auto computed = [&](const char* name, const Profile& profile) {
    return cases::ChartSeries{.name = fmt::format("{}, {}^{{3}}", name, cells), .x = profile.place, .y = profile.speed};
  };
  const auto exact = [](const char* name, const Points& points) {
    cases::ChartSeries series{.name = name, .mark = cases::Mark::points, .colour = cases::ChartColour::black};
    for (const auto& [place, speed] : points) series.x.push_back(place), series.y.push_back(speed);
    return series;
  };
  cases::Chart{.title = "Lid-driven cube, Re = 1000",
               .x = {"x or y / side"},
               .y = {"speed / lid speed"},
               .series = {computed("v(x, 0, 0)", profiles.v), exact("v, spectral", spectral.v),
                          computed("u(0, y, 0)", profiles.u), exact("u, spectral", spectral.u)}}
      .write_all(folder / "cavity_re1000.png");
}

template <class Real>
std::vector<Row> compare(const Context& context) {
  const std::span<const Stage> stages =
      context.quick ? std::span<const Stage>(kQuickStages) : std::span<const Stage>(kStages);
  Steady steady{CubeField(8), 1, 0};
  const Spectral spectral;
  std::vector<Row> rows;
  for (const Stage& stage : stages) {
    steady = run_to_rest<Real>(steady.field, stage);
    const Profiles profiles(steady.field);
    const bool last = &stage == &stages.back();
    // Coarser grids have no bar of the ladder's table: theirs, of second order, keeps watch over them.
    const double tolerance = std::max(0.01, 28.0 / (stage.cells * stage.cells));
    const std::string grid = fmt::format("{}^3, lid at {:g} lu", stage.cells, stage.lid_speed);
    rows.push_back(
        at_most_row("RMS of v(x, 0, 0) / lid speed, " + grid, rms_difference(profiles.v, spectral.v), tolerance));
    rows.push_back(
        at_most_row("RMS of u(0, y, 0) / lid speed, " + grid, rms_difference(profiles.u, spectral.u), tolerance));
    if (last && !context.plots.empty()) draw(profiles, spectral, stage.cells, context.plots);
  }
  rows.push_back(at_most_row(fmt::format("change in passage {} of the lid", steady.passages), steady.change,
                             stages.back().small_change));
  return rows;
}

}  // namespace

Entry cavity_re1000() {
  return {"fluid.cavity_re1000",
          {"Albensoeder & Kuhlmann 2005, tables 5 and 6 (spectral)", {"cavity3d_re1000_albensoeder.csv"}},
          [](const Context& context) {
            return in_precision(context, [&]<class Real>() { return compare<Real>(context); });
          }};
}

}  // namespace lahar::validate
