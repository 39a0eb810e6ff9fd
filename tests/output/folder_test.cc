#include "seedflow/output/folder.h"

#include "testing.h"

namespace seedflow {
namespace {

namespace fs = std::filesystem;

std::size_t n_files(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(Folder, CreatesAFolderWithItsParentsAndLeavesItEmpty) {
  TemporaryFolder folder;
  prepare_output_folder(folder / "a/b/c");
  EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
  EXPECT_EQ(n_files(folder / "a/b/c"), 0u);
  EXPECT_NO_THROW(prepare_output_folder(folder / "a/b/c"));
}

TEST(Folder, AFolderThatCannotBeMadeIsBadInput) {
  TemporaryFolder folder;
  write_text(folder / "file", "x");
  for (const fs::path& bad : {folder / "file/results", folder / "file", fs::path("/proc/results")}) {
    const std::string message = message_of<InputError>([&] { prepare_output_folder(bad); });
    EXPECT_CONTAINS(message, bad.string());
    EXPECT_CONTAINS(message, "cannot be");
    EXPECT_CONTAINS(message, "--output");
  }
}

TEST(Folder, AFullDiskIsFoundBeforeTheRun) {
  TemporaryFolder folder;
  const FileSizeLimit limit(100);
  EXPECT_CONTAINS(message_of<InputError>([&] { prepare_output_folder(folder.path); }), "cannot be written");
}

TEST(Folder, AtomicWriteReplacesAndFailureKeepsTheOldContent) {
  TemporaryFolder folder;
  const fs::path file = folder / "data.txt";
  write_file_atomically(file, "first");
  write_file_atomically(file, "second");
  EXPECT_EQ(read_file(file), "second");
  {
    const FileSizeLimit limit(1000);
    const std::string message =
        message_of<RunError>([&] { write_file_atomically(file, std::string(5000, 'x')); });
    EXPECT_CONTAINS(message, file.string());
    EXPECT_CONTAINS(message, "File too large");
  }
  EXPECT_EQ(read_file(file), "second");
  EXPECT_EQ(n_files(folder.path), 1u) << "no temporary file stays";
}

TEST(Folder, AMissingFileIsNamed) {
  const std::string message = message_of<InputError>([] { read_file("/nowhere/settling.csv"); });
  EXPECT_CONTAINS(message, "/nowhere/settling.csv");
  EXPECT_CONTAINS(message, "no such file");
}

}  // namespace
}  // namespace seedflow
