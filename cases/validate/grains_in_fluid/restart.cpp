// Case H12 of reference/hard_cases.csv: a restart in the middle of a splash, through a checkpoint file; with contacts,
// bonds and broken bonds in a small debris flow.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "cases/files/checkpoint_file.h"
#include "cases/validate/entry.h"
#include "core/memory_archive.h"
#include "coupling/coupled_step.h"

namespace lahar::validate {
namespace {

/// A file for the time of a comparison.
class ScratchFile {
 public:
  ScratchFile() : path_(std::filesystem::temp_directory_path() / ("lahar_h12_" + std::to_string(::getpid()) + ".h5")) {}
  ~ScratchFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Through a file and back.
template <class Owner>
void restart(Owner& from, Owner& into) {
  const ScratchFile file;
  {
    cases::CheckpointWriter archive(file.path());
    from.transfer(archive);
    archive.file().close();
  }
  cases::CheckpointReader archive(file.path());
  into.transfer(archive);
}

/// How many lists of the state differ in any bit, of how many.
template <class Owner>
void compare(std::vector<Row>& rows, const std::string& name, Owner& whole, Owner& resumed) {
  const StoredState a = state_of(whole), b = state_of(resumed);
  rows.push_back(at_most_row(name + ": lists of the state that differ in any bit",
                             static_cast<double>(differing_lists(a, b).size()), 0));
  rows.push_back(at_least_row(name + ": bytes compared, MB", static_cast<double>(a.bytes()) * 1e-6, 1));
}

lbm::FluidOptions splash_options(bool quick) {
  lbm::FluidOptions o;
  o.domain.upper = Vec3(0.8, 0.2, 0.6);
  o.domain.cell_size = quick ? 0.02 : 0.01;
  o.domain.faces[5] = lbm::FaceKind::open;
  o.time_step = 0.1 * o.domain.cell_size / 3.0;
  o.gravity = Vec3(0, 0, -9.81);
  return o;
}

template <class Real>
std::size_t interface_cells(const lbm::Fluid<Real>& fluid) {
  std::size_t count = 0;
  for (const lbm::BlockIndex b : fluid.grid().owned())
    if (const auto* surface = fluid.grid().block(b).surface) count += static_cast<std::size_t>(surface->count);
  return count;
}

/// The step of the splash with the most interface cells, until 1 s.
int roughest_step(bool quick) {
  lbm::Fluid<float> fluid(splash_options(quick));
  fluid.fill({{Vec3::Zero(), Vec3(0.2, 0.2, 0.4)}});
  std::size_t most = 0;
  std::int64_t when = 0;
  while (fluid.time() < 1) {
    fluid.step();
    if (fluid.steps() % 20 != 0) continue;
    if (const std::size_t now = interface_cells(fluid); now > most) most = now, when = fluid.steps();
  }
  return static_cast<int>(when);
}

template <class Real>
void splash(std::vector<Row>& rows, const std::string& name, int before, bool quick) {
  const int more = quick ? 200 : 1000;
  lbm::Fluid<Real> whole(splash_options(quick)), resumed(splash_options(quick));
  whole.fill({{Vec3::Zero(), Vec3(0.2, 0.2, 0.4)}});
  for (int s = 0; s < before; ++s) whole.step();
  rows.push_back(at_least_row(name + ": interface cells at the restart", static_cast<double>(interface_cells(whole)),
                              quick ? 500 : 2000));
  restart(whole, resumed);
  for (int s = 0; s < more; ++s) whole.step(), resumed.step();
  compare(rows, name + ", " + std::to_string(more) + " steps later", whole, resumed);
}

/// Strings of beads across a channel, fixed at their ends, whose bonds break under grains and water.
void add_strings(dem::Particles& p, dem::Bonds& bonds) {
  dem::BondSort wire;
  wire.axial.stiffness = {1e9, 1e9, 1e9};
  wire.shear_stiffness = 1e9;
  wire.bond_radius = 0.003;
  wire.damping_ratio = 0.05;
  wire.tensile_strength = wire.shear_strength = 3e5;
  bonds.add_sort(wire);
  for (int k = 0; k < 3; ++k)
    for (int n = 0; n < 26; ++n) {
      dem::ParticleSpec bead;
      bead.position = Vec3(0.4, 0.005 + 0.006 * n, 0.02 + 0.04 * k);
      bead.radius = 0.003;
      bead.density = 7850;
      bead.kind = dem::ParticleKind::bead;
      bead.body = k;
      bead.state = n % 25 == 0 ? dem::ParticleState::fixed : dem::ParticleState::free;
      const dem::ParticleIndex i = p.add(bead);
      if (n > 0) bonds.add({i - 1, i, 0}, p);
    }
}

std::unique_ptr<coupling::CoupledStep<double>> debris_flow() {
  dem::Particles p;
  for (int n = 0; n < 18; ++n) {
    dem::ParticleSpec grain;
    grain.position = Vec3(0.05 + 0.075 * (n % 3), 0.045 + 0.07 * (n / 3 % 2), 0.04 + 0.075 * (n / 6));
    grain.radius = 0.03;
    grain.density = 2500;
    p.add(grain);
  }
  dem::Bonds bonds;
  add_strings(p, bonds);
  Walls walls;
  walls.add({"bed", HalfSpace{Vec3::Zero(), Vec3::UnitZ()}});
  walls.add({"right", HalfSpace{Vec3::Zero(), Vec3::UnitY()}});
  walls.add({"left", HalfSpace{Vec3(0, 0.16, 0), -Vec3::UnitY()}});
  dem::Materials rock;
  rock.add({"rock", 1e8, 0.3});
  rock.set_pair(0, 0, 0.3, 0.7);
  dem::SolidsOptions solids;
  solids.gravity = Vec3(4, 0, -9);
  solids.time_step = 1;  // set by the coupled step
  solids.watchdog.overlap_limit = 1;
  lbm::FluidOptions fluid;
  fluid.domain.upper = Vec3(0.64, 0.16, 0.4);
  fluid.domain.cell_size = 0.01;
  fluid.domain.faces[1] = fluid.domain.faces[5] = lbm::FaceKind::open;
  fluid.time_step = 2e-4;
  fluid.gravity = solids.gravity;
  return std::make_unique<coupling::CoupledStep<double>>(fluid, dem::Solids(p, bonds, rock, walls, solids),
                                                         coupling::CouplingOptions{.substeps = 20});
}

void bond_history(std::vector<Row>& rows, bool quick) {
  const int more = quick ? 100 : 1000;
  const auto whole = debris_flow(), resumed = debris_flow();
  whole->fill({{Vec3::Zero(), Vec3(0.24, 0.16, 0.2)}});
  const auto broken = [&] {
    const auto& intact = whole->solids()->bonds().intact;
    return static_cast<double>(std::count(intact.begin(), intact.end(), 0));
  };
  const auto touching = [&] {
    const dem::Solids& solids = *whole->solids();
    return static_cast<double>(solids.contacts().stored_contacts(solids.particles()).size());
  };
  for (int s = 0; s < 2000 && (broken() < 3 || touching() < 10); ++s) whole->advance();
  rows.push_back(at_least_row("debris flow: broken bonds at the restart", broken(), 3));
  rows.push_back(at_least_row("debris flow: wet beads at the restart", static_cast<double>(whole->wet_beads()), 10));
  rows.push_back(at_least_row("debris flow: touching contacts at the restart", touching(), 10));
  restart(*whole, *resumed);
  for (int s = 0; s < more; ++s) whole->advance(), resumed->advance();
  compare(rows, "debris flow, " + std::to_string(more) + " steps later", *whole, *resumed);
}

std::vector<Row> run(const Context& context) {
  std::vector<Row> rows;
  const int before = roughest_step(context.quick);
  splash<double>(rows, "splash, double", before, context.quick);
  splash<float>(rows, "splash, float", before, context.quick);
  bond_history(rows, context.quick);
  return rows;
}

}  // namespace

Entry restart() { return {"grains_in_fluid.restart", {"the program itself, never stopped", {"hard_cases.csv"}}, run}; }

}  // namespace lahar::validate
