#include "tests/performance/lammps.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "dem/contact/damping.h"

namespace lahar::performance {

namespace {

namespace fs = std::filesystem;

/// A folder that goes away with the object.
struct TemporaryFolder {
  fs::path path;
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "lahar_lammps_XXXXXX").string();
    if (mkdtemp(name.data()) != nullptr) path = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path.empty()) fs::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

void write_data(std::ostream& out, const dem::Solids& solids) {
  const dem::Particles& p = solids.particles();
  const dem::Bonds& bonds = solids.bonds();
  const bool bonded = bonds.size() > 0;
  Vec3 lower = p.position[0], upper = lower;
  for (std::size_t i = 0; i < p.size(); ++i) {
    lower = lower.cwiseMin(p.position[i] - p.radius[i] * Vec3::Ones());
    upper = upper.cwiseMax(p.position[i] + p.radius[i] * Vec3::Ones());
  }
  out.precision(17);
  out << "particles\n\n" << p.size() << " atoms\n1 atom types\n";
  if (bonded) out << bonds.size() << " bonds\n1 bond types\n2 extra bond per atom\n4 extra special per atom\n";
  const char* axes[] = {"x", "y", "z"};
  for (int a = 0; a < 3; ++a) {
    const double margin = 0.05 * (upper[a] - lower[a]) + 0.1;
    out << lower[a] - margin << ' ' << upper[a] + margin << ' ' << axes[a] << "lo " << axes[a] << "hi\n";
  }
  out << "\nAtoms\n\n";
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double r = p.radius[i], density = p.mass[i] / (4.0 / 3.0 * std::numbers::pi * r * r * r);
    const Vec3 x = p.position[i];
    // hybrid sphere bond: id type x y z, then diameter density, then molecule
    if (bonded)
      out << i + 1 << " 1 " << x.x() << ' ' << x.y() << ' ' << x.z() << ' ' << 2 * r << ' ' << density << " 1\n";
    else
      out << i + 1 << " 1 " << 2 * r << ' ' << density << ' ' << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
  }
  out << "\nVelocities\n\n";
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3 v = p.velocity[i], w = p.angular_velocity[i];
    out << i + 1 << ' ' << v.x() << ' ' << v.y() << ' ' << v.z() << ' ' << w.x() << ' ' << w.y() << ' ' << w.z()
        << '\n';
  }
  if (!bonded) return;
  out << "\nBonds\n\n";
  for (std::size_t b = 0; b < bonds.size(); ++b)
    out << b + 1 << " 1 " << bonds.i[b] + 1 << ' ' << bonds.j[b] + 1 << '\n';
}

/// gran/hertz/history: F_n = k_n sqrt(R* overlap) overlap + m* g_n sqrt(R* overlap) v, and likewise k_t, g_t, friction.
/// The damper of LAMMPS grows faster with the overlap than ours, which keeps the restitution; its cost does not depend
/// on its size. It is that of the restitution at the overlaps deep in a bed: from smaller ones it is too large there,
/// and LAMMPS throws the grains away at our time step.
std::string contact_numbers(const dem::Solids& solids, const ScenePair& pair) {
  const dem::MaterialPair& m = solids.materials().pair(0, 0);
  const double normal = 4.0 / 3.0 * m.effective_modulus, tangential = 8 * m.effective_shear_modulus;
  const double r = solids.particles().radius[0], mass = solids.particles().mass[0];
  const double overlap = 1e-2 * r;  // the overlap at which damping is that of the restitution
  const double radius = std::sqrt(0.5 * r * overlap), slope = 2 * m.effective_modulus * radius;
  const double damper = 2 * std::sqrt(5.0 / 6.0) * dem::damping_ratio(pair.restitution) * std::sqrt(slope * 0.5 * mass);
  std::ostringstream out;
  out << normal << ' ' << tangential << ' ' << damper / (0.5 * mass * radius) << " NULL " << pair.friction << " 1";
  return out.str();
}

void write_walls(std::ostream& out, const Walls& walls, const std::string& contact) {
  const char* planes[] = {"xplane", "yplane", "zplane"};
  for (std::size_t w = 0; w < walls.all().size(); ++w) {
    const auto* plane = std::get_if<HalfSpace>(&walls.all()[w].shape);
    if (plane == nullptr) continue;
    int axis = 0;
    plane->normal.cwiseAbs().maxCoeff(&axis);
    const double at = plane->point[axis];
    out << "fix wall" << w << " all wall/gran hertz/history " << contact << ' ' << planes[axis] << ' ';
    if (plane->normal[axis] > 0)
      out << at << " NULL\n";
    else
      out << "NULL " << at << '\n';
  }
}

void write_script(std::ostream& out, const dem::Solids& solids, const ScenePair& pair, int steps) {
  const dem::Particles& p = solids.particles();
  const dem::Bonds& bonds = solids.bonds();
  const std::string contact = contact_numbers(solids, pair);
  const double smallest = *std::min_element(p.radius.begin(), p.radius.end());
  out.precision(17);
  out << "units si\natom_style " << (bonds.size() > 0 ? "hybrid sphere bond" : "sphere") << "\nboundary f f s\n"
      << "newton off\ncomm_modify vel yes\nprocessors * * 1\n";
  if (bonds.size() > 0) out << "special_bonds lj 0 1 1 coul 0 1 1\n";
  out << "read_data data\n";
  if (bonds.size() > 0) {
    const dem::BondSort& sort = bonds.sorts[0];
    const double k = sort.axial.stiffness[0] * std::numbers::pi * sort.bond_radius * sort.bond_radius;
    out << "bond_style harmonic\nbond_coeff 1 " << 0.5 * k << ' ' << bonds.rest_length[0] << '\n';
  }
  out << "neighbor " << 0.2 * smallest << " bin\nneigh_modify delay 0 every 1 check yes\n"
      << "pair_style gran/hertz/history " << contact << "\npair_coeff * *\n";
  write_walls(out, solids.walls(), contact);
  const Vec3 g = solids.options().gravity;
  if (bonds.size() > 0) {
    out << "group held id";
    for (std::size_t i = 0; i < p.size(); ++i)
      if (p.inverse_mass[i] == 0) out << ' ' << i + 1;
    out << "\ngroup moving subtract all held\n";
  } else {
    out << "group moving union all\n";
  }
  out << "fix gravity moving gravity " << g.norm() << " vector " << g.x() << ' ' << g.y() << ' ' << g.z()
      << "\nfix motion moving nve/sphere\ntimestep " << solids.options().time_step << "\nthermo 1000000\nrun 50\nrun "
      << steps << '\n';
}

/// The last "Loop time of S on ..." of a log, s.
std::optional<double> loop_time(const fs::path& log) {
  std::ifstream in(log);
  std::optional<double> seconds;
  const std::string key = "Loop time of ";
  for (std::string line; std::getline(in, line);)
    if (line.rfind(key, 0) == 0) seconds = std::strtod(line.c_str() + key.size(), nullptr);
  return seconds;
}

}  // namespace

bool have_lammps() { return std::system("command -v lmp >/dev/null 2>&1") == 0; }

std::optional<double> lammps_rate(const dem::Solids& solids, const ScenePair& pair, int processes, int steps) {
  const TemporaryFolder folder;
  if (folder.path.empty()) return std::nullopt;
  {
    std::ofstream data(folder.path / "data"), script(folder.path / "in");
    write_data(data, solids);
    write_script(script, solids, pair, steps);
  }
  std::string run = "lmp -in in -log log -screen none > out 2>&1";
  if (processes > 1) run = "mpirun --allow-run-as-root --oversubscribe -np " + std::to_string(processes) + " " + run;
  const std::string command = "cd '" + folder.path.string() + "' && OMP_NUM_THREADS=1 " + run;
  if (std::system(command.c_str()) != 0) {
    std::ifstream out(folder.path / "out"), log(folder.path / "log");
    std::ostringstream text;
    text << out.rdbuf() << log.rdbuf();
    std::fprintf(stderr, "lmp failed:\n%s\n", text.str().c_str());
    return std::nullopt;
  }
  const auto seconds = loop_time(folder.path / "log");
  if (!seconds || *seconds <= 0) return std::nullopt;
  return static_cast<double>(solids.particles().size()) * steps / *seconds;
}

}  // namespace lahar::performance
