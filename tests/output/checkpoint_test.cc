#include "seedflow/output/checkpoint.h"

#include <spawn.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "checkpoint_child.h"
#include "seedflow/base/binary.h"
#include "seedflow/output/folder.h"
#include "testing.h"

extern char** environ;

namespace seedflow {
namespace {

namespace fs = std::filesystem;

std::vector<double> read_state(CheckpointReader& reader) {
  const auto k = static_cast<int>(reader.time());
  std::vector<double> state(numbered_state(k).size());
  reader.stream("state").read(reinterpret_cast<char*>(state.data()),
                              static_cast<std::streamsize>(state.size() * sizeof(double)));
  EXPECT_TRUE(reader.stream("state").good());
  EXPECT_EQ(reader.stream("state").peek(), std::char_traits<char>::eof());
  return state;
}

/// The one file of the valid slot whose name begins so.
fs::path file_of(const fs::path& folder, const std::string& prefix) {
  const std::string slot = read_file(folder / "current").substr(0, 1);
  for (const auto& entry : fs::directory_iterator(folder / slot))
    if (entry.path().filename().string().rfind(prefix, 0) == 0) return entry.path();
  ADD_FAILURE() << "no " << prefix;
  return "";
}

TEST(Checkpoint, IsOnlyThereAfterCommitAndTheFormerStaysUntilThen) {
  TemporaryFolder folder;
  const fs::path path = folder / "checkpoint";
  EXPECT_FALSE(checkpoint_exists(path));
  {
    CheckpointWriter writer(path, 1, "", MPI_COMM_SELF);
    writer.stream("state") << "half";
  }
  EXPECT_FALSE(checkpoint_exists(path));
  for (int k = 1; k <= 3; ++k) {
    write_numbered_checkpoint(path, k, MPI_COMM_SELF);
    CheckpointWriter abandoned(path, 99, "", MPI_COMM_SELF);
    abandoned.stream("state") << "something else";
    CheckpointReader reader(path, MPI_COMM_SELF);
    EXPECT_EQ(reader.time(), k);
    EXPECT_EQ(read_state(reader), numbered_state(k));
  }
}

TEST(Checkpoint, AProcessKilledAtAnyMomentLeavesAWholeState) {
  TemporaryFolder folder;
  const fs::path path = folder / "checkpoint";
  int latest = 0;
  for (int attempt = 0; attempt < 6; ++attempt) {
    const std::string self = fs::read_symlink("/proc/self/exe");
    const char* arguments[] = {self.c_str(), "--write-checkpoints", path.c_str(), nullptr};
    pid_t child = 0;
    ASSERT_EQ(posix_spawn(&child, self.c_str(), nullptr, nullptr, const_cast<char**>(arguments), environ), 0);
    // Not before it has begun to write; then at a moment that has nothing to do with what it does.
    const fs::file_time_type begin = fs::file_time_type::clock::now();
    for (int wait = 0; wait < 2000; ++wait) {
      std::error_code none;
      if (fs::last_write_time(path / "current", none) > begin && !none) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    std::this_thread::sleep_for(std::chrono::microseconds(1000 + 3777 * attempt));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    CheckpointReader reader(path, MPI_COMM_SELF);
    EXPECT_EQ(read_state(reader), numbered_state(static_cast<int>(reader.time())));
    latest = std::max(latest, static_cast<int>(reader.time()));
  }
  EXPECT_GE(latest, 1);
}

TEST(Checkpoint, DamageIsFoundAndTheStateBeforeItIsPointedTo) {
  TemporaryFolder folder;
  write_numbered_checkpoint(folder.path, 1, MPI_COMM_SELF);
  write_numbered_checkpoint(folder.path, 2, MPI_COMM_SELF);
  const fs::path file = file_of(folder.path, "state");
  std::string content = read_file(file);
  content[content.size() / 2] ^= 1;  // one bit
  write_text(file, content);
  const std::string message =
      message_of<RunError>([&] { CheckpointReader reader(folder.path, MPI_COMM_SELF); });
  EXPECT_CONTAINS(message, file.string());
  EXPECT_CONTAINS(message, "damaged");
  // What the message advises works.
  const std::string other = file.parent_path().filename() == "a" ? "b" : "a";
  EXPECT_CONTAINS(message, "write the letter " + other);
  write_text(folder / "current", other);
  CheckpointReader reader(folder.path, MPI_COMM_SELF);
  EXPECT_EQ(reader.time(), 1);
  EXPECT_EQ(read_state(reader), numbered_state(1));
}

TEST(Checkpoint, ATruncatedOrMissingFileIsFound) {
  TemporaryFolder folder;
  write_numbered_checkpoint(folder.path, 1, MPI_COMM_SELF);
  const fs::path file = file_of(folder.path, "state");
  fs::resize_file(file, fs::file_size(file) - 8);
  EXPECT_CONTAINS(message_of<RunError>([&] { CheckpointReader reader(folder.path, MPI_COMM_SELF); }),
                  "bytes");
  fs::remove(file);
  EXPECT_CONTAINS(message_of<RunError>([&] { CheckpointReader reader(folder.path, MPI_COMM_SELF); }),
                  "missing");
}

TEST(Checkpoint, FilesWrittenByOthersAreCheckedToo) {
  TemporaryFolder folder;
  {
    CheckpointWriter writer(folder.path, 0.5, "", MPI_COMM_SELF);
    write_text(writer.external("mesh") + ".info", "4 cells");
    write_text(writer.external("mesh"), "cells");
    writer.commit();
  }
  {
    CheckpointReader reader(folder.path, MPI_COMM_SELF);
    EXPECT_EQ(read_file(reader.external("mesh") + ".info"), "4 cells");
  }
  write_text(file_of(folder.path, "mesh.info"), "5 cells");
  EXPECT_THROW(CheckpointReader(folder.path, MPI_COMM_SELF), RunError);
}

TEST(Checkpoint, NothingToResumeFromIsBadInput) {
  TemporaryFolder folder;
  const std::string message =
      message_of<InputError>([&] { CheckpointReader reader(folder.path, MPI_COMM_SELF); });
  EXPECT_CONTAINS(message, folder.path.string());
  EXPECT_CONTAINS(message, "without --resume");
}

TEST(Checkpoint, AnotherLayoutIsCalledAnotherVersionNotDamage) {
  TemporaryFolder folder;
  write_numbered_checkpoint(folder.path, 1, MPI_COMM_SELF);
  CheckpointReader reader(folder.path, MPI_COMM_SELF);
  std::vector<double> numbers;  // the state begins with none
  const std::string message = message_of<InputError>([&] {
    reader.read(
        [&] { read_binary(reader.stream("state"), numbers), read_binary(reader.stream("state"), numbers); });
  });
  EXPECT_CONTAINS(message, "another version");
  EXPECT_CONTAINS(message, folder.path.string());
  EXPECT_CONTAINS(message, "without --resume");
}

TEST(Checkpoint, ChangedParametersAreListed) {
  const std::string before =
      "# The air.\nsubsection Air\n  subsection Liquid\n    set Density = 1000 # [kg/m3]\n  end\n"
      "  set Model = A\nend\nset End time = 0.2\nsubsection Output\n  set Interval = 0.1\nend\n";
  const std::string after =
      "set End time = 0.4\nsubsection Air\n  set Model   =   A\n  subsection Liquid\n    set Density = 998\n"
      "    set Viscosity = 0.01\n  end\nend\nsubsection Output\n  set Interval = 0.2\nend\n";
  TemporaryFolder folder;
  CheckpointWriter(folder.path, 0, before, MPI_COMM_SELF).commit();
  const CheckpointReader reader(folder.path, MPI_COMM_SELF);
  EXPECT_NO_THROW(reader.require_same_parameters(before, {}));
  const std::string message = message_of<InputError>([&] {
    reader.require_same_parameters(after, {"End time", "Output/"});
  });
  EXPECT_CONTAINS(message, "Air/Liquid/Density: 1000 -> 998");
  EXPECT_CONTAINS(message, "Air/Liquid/Viscosity: (absent) -> 0.01");
  EXPECT_EQ(message.find("End time"), std::string::npos);
  EXPECT_EQ(message.find("Interval"), std::string::npos);
  EXPECT_EQ(message.find("Model"), std::string::npos);
  EXPECT_CONTAINS(message_of<InputError>([&] { reader.require_same_parameters(after, {"Air/Liquid/"}); }),
                  "Output/Interval: 0.1 -> 0.2");
}

TEST(Checkpoint, AnUnwritableFolderIsAClearErrorAndTheFormerStateStays) {
  EXPECT_CONTAINS(
      message_of<RunError>([] { CheckpointWriter writer("/proc/checkpoint", 0, "", MPI_COMM_SELF); }),
      "/proc/checkpoint");
  TemporaryFolder folder;
  write_numbered_checkpoint(folder.path, 1, MPI_COMM_SELF);
  CheckpointWriter writer(folder.path, 2, "", MPI_COMM_SELF);
  // The folder of the new state vanishes while it is written.
  const std::string slot = read_file(folder / "current").substr(0, 1) == "a" ? "b" : "a";
  fs::remove_all(folder / slot);
  writer.stream("state") << "x";
  EXPECT_CONTAINS(message_of<RunError>([&] { writer.commit(); }), "cannot be written");
  CheckpointReader reader(folder.path, MPI_COMM_SELF);
  EXPECT_EQ(reader.time(), 1);
}

TEST(Checkpoint, AFullDiskIsAClearErrorAndTheFormerStateStays) {
  TemporaryFolder folder;
  write_numbered_checkpoint(folder.path, 1, MPI_COMM_SELF);
  for (const rlim_t room : {0, 1000, 100000}) {
    const FileSizeLimit limit(room);
    const std::string message =
        message_of<RunError>([&] { write_numbered_checkpoint(folder.path, 2, MPI_COMM_SELF); });
    EXPECT_CONTAINS(message, "File too large");
    EXPECT_CONTAINS(message, "Free some space");
  }
  CheckpointReader reader(folder.path, MPI_COMM_SELF);
  EXPECT_EQ(reader.time(), 1);
  EXPECT_EQ(read_state(reader), numbered_state(1));
}

struct World {
  World() {
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
  }
  int rank = 0, size = 1;
};

TEST(CheckpointMpi, EveryRankGetsItsOwnStreamBack) {
  const World world;
  TemporaryFolder folder(MPI_COMM_WORLD);
  for (int round = 0; round < 3; ++round) {
    CheckpointWriter writer(folder.path, 0.1 + round, "set A = 1\n", MPI_COMM_WORLD);
    writer.stream("seeds") << "seeds of rank " << world.rank << " in round " << round;
    if (world.rank == 0) writer.stream("walls") << "walls";  // a stream that one rank alone has
    writer.commit();
  }
  CheckpointReader reader(folder.path, MPI_COMM_WORLD);
  EXPECT_EQ(reader.time(), 2.1);
  std::string line;
  std::getline(reader.stream("seeds"), line);
  EXPECT_EQ(line, "seeds of rank " + std::to_string(world.rank) + " in round 2");
  if (world.rank > 0) {
    EXPECT_THROW(reader.stream("walls"), RunError);
  }
}

TEST(CheckpointMpi, AnotherNumberOfRanksIsBadInputOnAll) {
  const World world;
  TemporaryFolder folder(MPI_COMM_WORLD);
  write_numbered_checkpoint(folder.path, 1, MPI_COMM_WORLD);
  MPI_Barrier(MPI_COMM_WORLD);
  if (world.size == 1) {
    EXPECT_NO_THROW(CheckpointReader(folder.path, MPI_COMM_SELF));
    return;
  }
  const std::string message =
      message_of<InputError>([&] { CheckpointReader reader(folder.path, MPI_COMM_SELF); });
  EXPECT_CONTAINS(message, "written by " + std::to_string(world.size) + " ranks, this run has 1");
  EXPECT_CONTAINS(message, "--mpi " + std::to_string(world.size));
}

TEST(CheckpointMpi, AFailureOnOneRankIsTheFailureOfAll) {
  const World world;
  TemporaryFolder folder(MPI_COMM_WORLD);
  write_numbered_checkpoint(folder.path, 1, MPI_COMM_WORLD);
  {
    CheckpointWriter writer(folder.path, 2, "", MPI_COMM_WORLD);
    std::ostream& stream = writer.stream("state");
    if (world.rank == world.size - 1) stream.setstate(std::ios::badbit);
    EXPECT_THROW(writer.commit(), RunError);
  }
  {
    CheckpointReader reader(folder.path, MPI_COMM_WORLD);
    EXPECT_EQ(reader.time(), 1);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  char name[32];
  std::snprintf(name, sizeof name, "state.%05d", world.size - 1);
  if (world.rank == 0) fs::resize_file(file_of(folder.path, name), 8);
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_THROW(CheckpointReader(folder.path, MPI_COMM_WORLD), RunError);
}

}  // namespace
}  // namespace seedflow
