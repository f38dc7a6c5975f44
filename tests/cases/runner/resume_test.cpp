// Runs that were stopped and went on, in their folder.
#include "cases/runner/resume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <utility>

#include "cases/assembly/simulation.h"
#include "cases/files/hdf5_file.h"
#include "cases/files/series_reader.h"
#include "cases/runner/checkpoint.h"
#include "cases/runner/machine.h"
#include "cases/runner/run.h"
#include "cases/runner/summary.h"
#include "core/check.h"
#include "core/memory_archive.h"
#include "tests/cases/files/shape_texts.h"
#include "tests/cases/scene/scene_files.h"

namespace lahar::cases {
namespace {

const std::vector<std::string> kCoarse{"fluid.cell_size_m=0.04", "run.duration_s=0.3", "run.output_interval_s=0.04",
                                       "run.series_interval_s=0.01"};

class Resume : public testing::Test {
 protected:
  RunResult run(const std::string& name, std::vector<std::string> set = {}) {
    set.insert(set.begin(), kCoarse.begin(), kCoarse.end());
    return run_to_folder(scene::load(scene::case_file("dam_break/scene.toml"), set),
                         {.out = folder(name), .threads = 1, .quiet = true}, run_scene);
  }
  RunResult resume(const std::string& name, const std::vector<std::string>& set = {}) {
    return run_to_folder(load_resumed(folder(name), set),
                         {.out = folder(name), .threads = 1, .quiet = true, .resume = true}, run_scene);
  }
  [[nodiscard]] std::filesystem::path folder(const std::string& name) const { return scratch_.path() / name; }
  [[nodiscard]] std::size_t files(const std::string& name) const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder(name)), {}));
  }
  /// Until the checkpoint.
  [[nodiscard]] double wall_seconds(const std::string& name) const {
    return Hdf5File::open_for_reading(folder(name) / kCheckpointFile).read<double>("/loop/wall_seconds").at(0);
  }
  /// The message of the one mistake that resuming with `set` makes.
  std::string mistake(const std::string& name, const std::vector<std::string>& set = {}) {
    try {
      resume(name, set);
    } catch (const InputError& e) {
      EXPECT_EQ(e.mistakes().size(), 1U);
      return e.what();
    }
    return "none";
  }
  scene::ScratchFolder scratch_;
};

void expect_same_series(const std::filesystem::path& a, const std::filesystem::path& b) {
  const Series one = read_series(a / "series.h5"), two = read_series(b / "series.h5");
  EXPECT_EQ(one.time_s, two.time_s);
  ASSERT_EQ(one.columns.size(), two.columns.size());
  for (std::size_t c = 0; c < one.columns.size(); ++c)
    EXPECT_EQ(one.columns[c].values, two.columns[c].values) << one.columns[c].name;
}

TEST_F(Resume, ALongerRunIsTheSameAsOneInOnePiece) {
  const RunResult whole = run("whole");
  run("part", {"run.duration_s=0.137"});
  const std::size_t frames = files("part");
  const double before = wall_seconds("part");
  const RunResult rest = resume("part", {"run.duration_s=0.3"});
  EXPECT_EQ(whole.summary.metrics, rest.summary.metrics);
  EXPECT_EQ(whole.summary.simulated_seconds, rest.summary.simulated_seconds);
  EXPECT_EQ(whole.summary.performance.wet_cells_max, rest.summary.performance.wet_cells_max);
  EXPECT_GT(rest.summary.wall_seconds, before);
  expect_same_series(folder("whole"), folder("part"));
  EXPECT_GT(files("part"), frames);
  EXPECT_EQ(files("part"), files("whole"));  // the last frame of the part was written again with its own number
  EXPECT_EQ(scene::file_text(folder("whole") / "fluid_000005.vdb").size(),
            scene::file_text(folder("part") / "fluid_000005.vdb").size());
  const std::string log = scene::file_text(folder("part") / "run.log");
  EXPECT_LT(log.find("done at"), log.find("goes on from the checkpoint of t = 0.1"));
  EXPECT_EQ(scene::load(folder("part") / "scene.resolved.toml").run.duration, 0.3);
}

TEST_F(Resume, WhatWasWrittenAfterTheCheckpointIsDropped) {
  run("whole");
  run("killed", {"run.checkpoint_interval_s=0.2"});
  // As if the run had been killed at its end: the checkpoint of the end is gone, that of 0.2 s is there.
  run("early", {"run.checkpoint_interval_s=0.2", "run.duration_s=0.2"});
  std::filesystem::copy_file(folder("early") / kCheckpointFile, folder("killed") / kCheckpointFile,
                             std::filesystem::copy_options::overwrite_existing);
  std::ofstream(folder("killed") / "fluid_000099.vdb") << "later";
  std::ofstream(folder("killed") / "fluid_99_notes.txt") << "mine";
  resume("killed");
  expect_same_series(folder("whole"), folder("killed"));
  EXPECT_FALSE(std::filesystem::exists(folder("killed") / "fluid_000099.vdb"));
  EXPECT_TRUE(std::filesystem::exists(folder("killed") / "fluid_99_notes.txt"));
}

TEST_F(Resume, AFinishedRunHasNothingLeftToDo) {
  const RunResult whole = run("out");
  const Series before = read_series(folder("out") / "series.h5");
  const double earlier = wall_seconds("out");
  const RunResult again = resume("out");
  EXPECT_GT(again.summary.wall_seconds, earlier);  // its own part is far shorter
  EXPECT_EQ(whole.summary.metrics, again.summary.metrics);
  EXPECT_EQ(before.time_s, read_series(folder("out") / "series.h5").time_s);
}

/// Its checkpoint is of up to a step later than its duration.
TEST_F(Resume, TheSameDurationMayBeAskedForTwice) {
  const RunResult whole = run("out");
  ASSERT_GT(whole.summary.simulated_seconds, 0.3 * (1 + 1e-9));
  EXPECT_EQ(resume("out", {"run.duration_s=0.3"}).summary.metrics, whole.summary.metrics);
}

TEST_F(Resume, ParticlesGoOn) {
  const auto bounce = [&](const std::string& name, const char* duration) {
    return run_to_folder(scene::load(scene::case_file("bouncing_sphere/scene.toml"),
                                     {std::string("run.duration_s=") + duration, "run.output_interval_s=0.05"}),
                         {.out = folder(name), .threads = 1, .quiet = true}, run_scene);
  };
  const RunResult whole = bounce("whole", "0.4");
  bounce("part", "0.23");
  const RunResult rest = resume("part", {"run.duration_s=0.4"});
  EXPECT_EQ(whole.summary.metrics, rest.summary.metrics);
  expect_same_series(folder("whole"), folder("part"));
  const Hdf5File one = Hdf5File::open_for_reading(folder("whole") / "particles.h5");
  const Hdf5File two = Hdf5File::open_for_reading(folder("part") / "particles.h5");
  ASSERT_EQ(one.members("/frames"), two.members("/frames"));
  for (const std::string& frame : one.members("/frames"))
    EXPECT_EQ(one.read<float>("/frames/" + frame + "/position"), two.read<float>("/frames/" + frame + "/position"));
}

/// Grains, a net and a surface. The water stands on both sides of the net, so that wires are wet from the start.
TEST_F(Resume, AFlowGoesOnWithAnotherNumberOfThreads) {
  const auto load = [](const std::string& duration) {
    return scene::load(scene::source_folder() / "tests/integration/small_debris_flow.toml",
                       {"run.duration_s=" + duration, "run.output_interval_s=0", "run.image_interval_s=0",
                        "fluid.region[0].upper_m=[0.7, 0.25976, 0.2]"});
  };
  const scene::Scene scene = load("0.08");
  const RunResult whole = run_to_folder(scene, {.out = folder("whole"), .threads = 1, .quiet = true}, run_scene);
  run_to_folder(load("0.033"), {.out = folder("part"), .threads = 1, .quiet = true}, run_scene);
  const RunResult rest = run_to_folder(load_resumed(folder("part"), {"run.duration_s=0.08"}),
                                       {.out = folder("part"), .threads = 2, .quiet = true, .resume = true}, run_scene);
  EXPECT_EQ(whole.summary.metrics, rest.summary.metrics);
  expect_same_series(folder("whole"), folder("part"));
  const auto end_of = [&](const std::string& name) {
    const auto simulation = build_simulation(scene, Beginning::checkpoint);
    load_checkpoint(folder(name), [&](Archive& archive) { archive.part("step", *simulation); });
    EXPECT_GT(simulation->wet_beads(), 100U);
    return state_of(*simulation);
  };
  const StoredState one = end_of("whole"), two = end_of("part");
  EXPECT_GT(one.bytes(), 500'000U);
  EXPECT_EQ(differing_lists(one, two), std::vector<std::string>{});
}

/// Its last row was taken before it ended: what metrics say of the end is known from then.
TEST_F(Resume, AFinishedRunOfParticlesKeepsItsMetrics) {
  const RunResult whole =
      run_to_folder(scene::load(scene::case_file("bouncing_sphere/scene.toml"),
                                {"run.duration_s=0.5", "run.series_interval_s=1e-6", "contact[0].restitution=0.5"}),
                    {.out = folder("out"), .threads = 1, .quiet = true}, run_scene);
  EXPECT_GT(whole.summary.metrics.at("solids_damping_kJ"), 0);
  EXPECT_EQ(resume("out").summary.metrics, whole.summary.metrics);
  EXPECT_EQ(resume("out").summary.metrics, whole.summary.metrics);
}

TEST_F(Resume, FramesAreKeptWhileNoneAreAskedFor) {
  run_to_folder(scene::load(scene::case_file("bouncing_sphere/scene.toml"),
                            {"run.duration_s=0.11", "run.output_interval_s=0.05"}),
                {.out = folder("out"), .threads = 1, .quiet = true}, run_scene);
  resume("out", {"run.duration_s=0.2", "run.output_interval_s=0"});
  EXPECT_EQ(Hdf5File::open_for_reading(folder("out") / "particles.h5").members("/frames").size(), 4U);  // 0.11 s, too
  resume("out", {"run.duration_s=0.3", "run.output_interval_s=0.05"});
  const Hdf5File file = Hdf5File::open_for_reading(folder("out") / "particles.h5");
  const std::vector<std::string> frames = file.members("/frames");
  ASSERT_GE(frames.size(), 5U);
  EXPECT_NEAR(file.number_attribute("/frames/" + frames.front(), "time_s"), 0, 1e-9);
  EXPECT_NEAR(file.number_attribute("/frames/" + frames.back(), "time_s"), 0.3, 0.01);
}

/// The last picture is of the end of the first part, which is in no checkpoint.
TEST_F(Resume, PicturesAreKeptWhileNoneAreAskedFor) {
  run("out", {"run.duration_s=0.03", "run.image_interval_s=0.02"});
  ASSERT_TRUE(std::filesystem::exists(folder("out") / "image_000002.png"));
  resume("out", {"run.duration_s=0.05", "run.image_interval_s=0", "run.output_interval_s=0"});
  EXPECT_TRUE(std::filesystem::exists(folder("out") / "image_000002.png"));
  EXPECT_TRUE(std::filesystem::exists(folder("out") / "fluid_000001.vdb"));
}

/// A run that was to replace it was killed while it prepared: the former one is there to go on with.
TEST_F(Resume, AFormerRunThatStandsAsideComesBack) {
  run("out", {"run.duration_s=0.05"});
  const auto aside = folder("out") / ".former_run";
  std::filesystem::create_directory(aside);
  for (const char* name : {"scene.resolved.toml", "series.h5", "checkpoint.h5", "summary.json"})
    std::filesystem::rename(folder("out") / name, aside / name);
  std::ofstream(folder("out") / "scene.resolved.toml") << "# Lahar: resolved scene of the run that was killed\n";
  EXPECT_NEAR(resume("out", {"run.duration_s=0.08"}).summary.simulated_seconds, 0.08, 0.001);
  EXPECT_FALSE(std::filesystem::exists(aside));
}

/// Cuts a file short, as a full disk or a copy that was broken off would.
void halve(const std::filesystem::path& path) {
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
}

TEST_F(Resume, ADamagedSeriesBeginsAnew) {
  run("out", {"run.duration_s=0.1"});
  halve(folder("out") / "series.h5");
  resume("out", {"run.duration_s=0.2"});
  EXPECT_TRUE(std::filesystem::exists(folder("out") / "series.damaged.h5"));
  const Series series = read_series(folder("out") / "series.h5");
  ASSERT_FALSE(series.time_s.empty());
  EXPECT_GT(series.time_s.front(), 0.09);
  EXPECT_NEAR(series.time_s.back(), 0.2, 0.01);
  EXPECT_NE(scene::file_text(folder("out") / "run.log").find("the series begins anew"), std::string::npos);
}

TEST_F(Resume, WarningsNameFilesOnOneLine) {
  run("two\nlines", {"run.duration_s=0.05"});
  std::filesystem::remove(folder("two\nlines") / "series.h5");
  testing::internal::CaptureStderr();
  resume("two\nlines", {"run.duration_s=0.06"});
  const std::string told = testing::internal::GetCapturedStderr(),
                    log = scene::file_text(folder("two\nlines") / "run.log");
  for (const std::string& text : {told, log})
    EXPECT_NE(text.find("two\\u000Alines/series.h5 is gone: the series begins anew"), std::string::npos) << text;
}

TEST_F(Resume, WhatAUserHasAddedStays) {
  run_to_folder(scene::load(scene::case_file("bouncing_sphere/scene.toml"),
                            {"run.duration_s=0.12", "run.output_interval_s=0.05"}),
                {.out = folder("out"), .threads = 1, .quiet = true}, run_scene);
  const std::vector<double> mine{1, 2, 3, 4};
  const auto series = folder("out") / "series.h5", particles = folder("out") / "particles.h5";
  {
    Hdf5File file = Hdf5File::open_for_appending(series);
    file.write<double>("/series/table", mine, {2, 2});
    file.write<double>("/series/mine/list", mine, {4});
  }
  for (const char* name : {"/frames/notes/list", "/frames/99_notes/list", "/constant/notes/list"})
    Hdf5File::open_for_appending(particles).write<double>(name, mine, {4});
  resume("out", {"run.duration_s=0.2"});
  EXPECT_EQ(scene::file_text(folder("out") / "run.log").find("anew"), std::string::npos);
  EXPECT_EQ(read_series(series).time_s.front(), 0);
  EXPECT_NEAR(read_series(series).time_s.back(), 0.2, 0.01);
  for (const char* name : {"/series/table", "/series/mine/list"})
    EXPECT_EQ(Hdf5File::open_for_reading(series).read<double>(name), mine) << name;
  const Hdf5File file = Hdf5File::open_for_reading(particles);
  for (const char* name : {"/frames/notes/list", "/frames/99_notes/list", "/constant/notes/list"})
    EXPECT_EQ(file.read<double>(name), mine) << name;
  EXPECT_TRUE(file.contains("/frames/000004"));
}

/// A disk that is full says nothing of what was written before: here a folder stands where the copy would.
TEST_F(Resume, WhatCannotBeCopiedIsNotTakenForDamaged) {
  run("out", {"run.duration_s=0.1"});
  const std::string rows = scene::file_text(folder("out") / "series.h5");
  std::filesystem::create_directories(folder("out") / "series.h5.open" / "in the way");
  EXPECT_THROW(resume("out", {"run.duration_s=0.2"}), FileError);
  EXPECT_EQ(scene::file_text(folder("out") / "series.h5"), rows);
  EXPECT_FALSE(std::filesystem::exists(folder("out") / "series.damaged.h5"));
  std::filesystem::remove_all(folder("out") / "series.h5.open");
  resume("out", {"run.duration_s=0.2"});
  EXPECT_EQ(read_series(folder("out") / "series.h5").time_s.front(), 0);
}

TEST_F(Resume, ParticlesThatCannotBeCopiedAreNotTakenForDamaged) {
  run_to_folder(scene::load(scene::case_file("bouncing_sphere/scene.toml"),
                            {"run.duration_s=0.12", "run.output_interval_s=0.05"}),
                {.out = folder("out"), .threads = 1, .quiet = true}, run_scene);
  const std::string frames = scene::file_text(folder("out") / "particles.h5");
  std::filesystem::create_directories(folder("out") / "particles.h5.open" / "in the way");
  EXPECT_THROW(resume("out", {"run.duration_s=0.2"}), std::runtime_error);
  EXPECT_EQ(scene::file_text(folder("out") / "particles.h5"), frames);
  EXPECT_FALSE(std::filesystem::exists(folder("out") / "particles.damaged.h5"));
}

TEST_F(Resume, DamagedOrLostParticlesBeginAnew) {
  const std::vector<std::string> set{"run.duration_s=0.12", "run.output_interval_s=0.05"};
  for (const bool lost : {true, false}) {
    const std::string name = lost ? "lost" : "damaged";
    run_to_folder(scene::load(scene::case_file("bouncing_sphere/scene.toml"), set),
                  {.out = folder(name), .threads = 1, .quiet = true}, run_scene);
    const auto file = folder(name) / "particles.h5";
    if (lost)
      std::filesystem::remove(file);
    else
      halve(file);
    resume(name, {"run.duration_s=0.2"});
    EXPECT_EQ(std::filesystem::exists(folder(name) / "particles.damaged.h5"), !lost);
    EXPECT_NE(scene::file_text(folder(name) / "run.log").find("particles begin anew"), std::string::npos);
    const std::vector<std::string> frames = Hdf5File::open_for_reading(file).members("/frames");
    ASSERT_FALSE(frames.empty());
    EXPECT_GE(frames.front(), "000003");
    const std::string xmf = scene::file_text(folder(name) / "particles.xmf");
    EXPECT_EQ(xmf.find("/frames/000000/"), std::string::npos);
    EXPECT_NE(xmf.find("/frames/" + frames.front() + "/"), std::string::npos);
  }
}

TEST_F(Resume, OnlyWhatLeavesThePhysicsAloneMayBeSet) {
  run("out", {"run.duration_s=0.05"});
  const std::string text = mistake("out", {"fluid.smagorinsky=0.2"});
  EXPECT_TRUE(text.starts_with("--set fluid.smagorinsky=0.2:1:1: cannot change")) << text;
  EXPECT_NE(text.find("run.duration_s"), std::string::npos);
  EXPECT_NE(mistake("out", {"run.precision=double"}).find("is of another scene"), std::string::npos);
  const std::string shorter = mistake("out", {"run.duration_s=0.01"});
  EXPECT_TRUE(shorter.starts_with("--set run.duration_s=0.01:1:1: run.duration_s is 0.01")) << shorter;
  EXPECT_NE(shorter.find("expected at least"), std::string::npos);
}

TEST_F(Resume, AnotherSceneInTheFolderIsRefused) {
  run("out", {"run.duration_s=0.05"});
  std::string text = scene::file_text(folder("out") / "scene.resolved.toml");
  const auto at = text.find("density_kg_m3 = 1000");
  ASSERT_NE(at, std::string::npos);
  std::ofstream(folder("out") / "scene.resolved.toml") << text.replace(at, 20, "density_kg_m3 = 1001");
  const std::string why = mistake("out");
  EXPECT_NE(why.find("checkpoint.h5:1:1: is of another scene ([fluid] density_kg_m3 = 1001"), std::string::npos) << why;
}

TEST_F(Resume, DamageIsFoundAndNamed) {
  run("out", {"run.duration_s=0.05"});
  const auto file = folder("out") / kCheckpointFile;
  const auto size = std::filesystem::file_size(file);
  {
    std::fstream out(file, std::ios::in | std::ios::out | std::ios::binary);
    out.seekp(static_cast<std::streamoff>(size / 2));
    out.write("damage", 6);
  }
  std::string why = mistake("out");
  EXPECT_NE(why.find("checkpoint.h5:1:1: is damaged"), std::string::npos) << why;
  std::filesystem::resize_file(file, size / 3);
  EXPECT_NE(mistake("out").find("checkpoint.h5:1:1: is damaged"), std::string::npos);
  std::filesystem::remove(file);
  EXPECT_NE(mistake("out").find("there is no such file"), std::string::npos);
  EXPECT_NE(mistake("nowhere").find("holds no run"), std::string::npos);
}

/// Flips one bit of a number in the head of a checkpoint: half of it or twice as much is left.
void flip_bit(const std::filesystem::path& file, const std::string& attribute) {
  const auto stored = [&] { return Hdf5File::open_for_reading(file).number_attribute("/", attribute); };
  const double value = stored();
  std::string number(sizeof value, '\0');
  std::memcpy(number.data(), &value, sizeof value);
  const std::string whole = scene::file_text(file);
  for (auto at = whole.find(number); at != std::string::npos; at = whole.find(number, at + 1)) {
    std::string flipped = whole;
    flipped[at + 6] = static_cast<char>(flipped[at + 6] ^ 0x10);
    std::ofstream(file, std::ios::binary) << flipped;
    if (stored() != value) return;
  }
  FAIL() << attribute << " is nowhere in the file";
}

/// By what stands there rows of the series are cut off.
TEST_F(Resume, ABitLostFromTheHeadIsFound) {
  run("out", {"run.duration_s=0.05"});
  const auto file = folder("out") / kCheckpointFile, series = folder("out") / "series.h5";
  const std::string whole = scene::file_text(file), rows = scene::file_text(series);
  for (const char* attribute : {"time_s", "last_row_s"}) {
    flip_bit(file, attribute);
    const std::string why = mistake("out", {"run.duration_s=0.06"});
    EXPECT_NE(why.find("checkpoint.h5:1:1: is damaged or of another version (its head does not have its check sum)"),
              std::string::npos)
        << why;
    EXPECT_EQ(scene::file_text(series), rows) << attribute;
    EXPECT_FALSE(last_checkpoint(folder("out")).has_value()) << attribute;
    std::ofstream(file, std::ios::binary) << whole;
  }
  EXPECT_EQ(mistake("out", {"run.duration_s=0.06"}), "none");
}

TEST(CheckpointHead, EveryPartCountsInItsCheckSum) {
  const CheckpointHead head{0.25, 0.125, "abc"};
  for (const CheckpointHead& other : {CheckpointHead{0.5, 0.125, "abc"}, {0.25, 0.25, "abc"}, {0.25, 0.125, "abd"}})
    EXPECT_NE(check_sum(other), check_sum(head));
}

/// What comes after the checkpoint can still be used when the checkpoint cannot.
TEST_F(Resume, ADamagedCheckpointLeavesTheFolderAsItWas) {
  run("out");
  run("early", {"run.duration_s=0.1"});
  const auto file = folder("out") / kCheckpointFile;
  std::filesystem::copy_file(folder("early") / kCheckpointFile, file,
                             std::filesystem::copy_options::overwrite_existing);
  {
    std::fstream out(file, std::ios::in | std::ios::out | std::ios::binary);
    out.seekp(static_cast<std::streamoff>(std::filesystem::file_size(file) / 2));
    out.write("damage", 6);
  }
  const std::size_t before = files("out");
  const std::string scene = scene::file_text(folder("out") / "scene.resolved.toml");
  const std::string series = scene::file_text(folder("out") / "series.h5");
  const std::string why = mistake("out", {"run.duration_s=0.5"});
  EXPECT_NE(why.find("checkpoint.h5:1:1: is damaged"), std::string::npos) << why;
  EXPECT_EQ(files("out"), before);
  EXPECT_EQ(scene::file_text(folder("out") / "scene.resolved.toml"), scene);
  EXPECT_EQ(scene::file_text(folder("out") / "series.h5"), series);
}

/// The one that the run has read counts, not the one that lies there when a checkpoint is written.
TEST_F(Resume, AMeshThatWasChangedDuringTheRunIsAnotherScene) {
  const std::string mesh = stl_text(box_mesh(Vec3(0.7, 0.7, 0), Vec3(0.9, 0.9, 0.2)));
  const auto file = scratch_.write("block.stl", mesh);
  const scene::Scene scene = scene::load(scratch_.write("scene.toml", scene::small_scene + R"([[wall]]
shape = "mesh"
file = "block.stl"
material = "rock"
)"),
                                         {"run.duration_s=0.01"});
  scratch_.write("block.stl", stl_text(box_mesh(Vec3(0.7, 0.7, 0), Vec3(0.9, 0.9, 0.3))));
  run_to_folder(scene, {.out = folder("out"), .threads = 1, .quiet = true}, run_scene);
  EXPECT_NE(mistake("out").find("is of another scene (# " + file.string()), std::string::npos) << mistake("out");
  scratch_.write("block.stl", mesh);
  EXPECT_EQ(mistake("out"), "none");
}

TEST_F(Resume, AnotherFormatIsRefused) {
  run("out", {"run.duration_s=0.05"});
  {
    Hdf5File file = Hdf5File::create(folder("out") / kCheckpointFile);
    file.set_attribute("/", "format", 99.0);
    file.set_attribute("/", "time_s", 0.1), file.set_attribute("/", "last_row_s", 0.1);
    file.set_attribute("/", "version", std::string("9.9")), file.set_attribute("/", "commit", std::string("abc"));
  }
  const std::string expected =
      "is of format 99, written by Lahar 9.9 (abc), expected format " + std::to_string(kCheckpointFormat);
  EXPECT_NE(mistake("out").find(expected), std::string::npos);
}

TEST_F(Resume, ProgramsOfAllCommitsAreNamed) {
  run("out", {"run.duration_s=0.05"});
  const CheckpointHead head = read_head(folder("out"), scene::load(folder("out") / "scene.resolved.toml"));
  CheckpointHead of_another = head;
  const std::string other(commit().size(), 'f');
  of_another.commit = other;
  std::string bytes = scene::file_text(folder("out") / kCheckpointFile);
  for (const auto& [from, to] : {std::pair{commit(), other}, std::pair{check_sum(head), check_sum(of_another)}}) {
    const auto at = bytes.find(from);
    ASSERT_NE(at, std::string::npos);
    bytes.replace(at, to.size(), to);
  }
  std::ofstream(folder("out") / kCheckpointFile, std::ios::binary) << bytes;
  EXPECT_EQ(resume("out", {"run.duration_s=0.06"}).summary.commit, other + ", " + commit());
  EXPECT_EQ(resume("out", {"run.duration_s=0.07"}).summary.commit, other + ", " + commit());
}

TEST_F(Resume, AFailedRunKeepsAndNamesItsLastCheckpoint) {
  try {
    run("out", {"run.checkpoint_interval_s=0.01", "run.duration_s=2", "fluid.max_speed_m_s=0.45",
                "fluid.region[0].lower_m=[0, 0, 0.5]"});
    FAIL() << "the step is far too long for what falls half a metre";
  } catch (const NumericalFailure& e) {
    EXPECT_NE(std::string(e.what()).find("checkpoint.h5 of t = "), std::string::npos) << e.what();
  }
  EXPECT_TRUE(last_checkpoint(folder("out")).has_value());
  write_summary(folder("out"), {});
  EXPECT_THROW(resume("out"), NumericalFailure);  // it goes on, into the same failure
  EXPECT_FALSE(std::filesystem::exists(folder("out") / "summary.json")) << "of the stretch before";
}

}  // namespace
}  // namespace lahar::cases
