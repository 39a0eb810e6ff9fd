#include "seedflow/output/checkpoint.h"

#include <cstdio>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "checksum_stream.h"
#include "seedflow/base/binary.h"
#include "seedflow/base/error.h"
#include "seedflow/base/together.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/json.h"

namespace seedflow {

namespace {

namespace fs = std::filesystem;

// To be raised when any part of a saved state changes its layout.
constexpr int format_version = 1;
const char* const pointer_name = "current";
const char* const manifest_name = "manifest.json";

struct Ranks {
  explicit Ranks(MPI_Comm comm_) : comm(comm_) {
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
  }
  MPI_Comm comm;
  int rank = 0, size = 1;
};

void broadcast(std::string& text, int root, const Ranks& ranks) {
  unsigned long long length = text.size();
  MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG_LONG, root, ranks.comm);
  text.resize(length);
  MPI_Bcast(text.data(), static_cast<int>(length), MPI_CHAR, root, ranks.comm);
}

std::string stream_file(const std::string& name, int rank) {
  char suffix[16];
  std::snprintf(suffix, sizeof suffix, ".%05d", rank);
  return name + suffix;
}

/// The slot that holds the valid state, or "".
std::string valid_slot(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_regular_file(folder / pointer_name, ignored)) return "";
  std::string slot = read_file(folder / pointer_name);
  slot.erase(slot.find_last_not_of(" \r\n\t") + 1);
  return slot == "a" || slot == "b" ? slot : "";
}

/// "Section/Sub/Entry" -> value, from the text of a .prm file.
std::map<std::string, std::string> entries_of(const std::string& text) {
  std::map<std::string, std::string> entries;
  std::vector<std::string> sections;
  std::istringstream lines(text);
  const auto trim = [](const std::string& s) {
    const auto first = s.find_first_not_of(" \t\r");
    return first == std::string::npos ? std::string()
                                      : s.substr(first, s.find_last_not_of(" \t\r") - first + 1);
  };
  for (std::string line; std::getline(lines, line);) {
    line = trim(line.substr(0, line.find('#')));
    if (line.compare(0, 11, "subsection ") == 0) {
      sections.push_back(trim(line.substr(11)) + "/");
    } else if (line == "end" && !sections.empty()) {
      sections.pop_back();
    } else if (line.compare(0, 4, "set ") == 0 && line.find('=') != std::string::npos) {
      std::string path;
      for (const std::string& section : sections) path += section;
      entries[path + trim(line.substr(4, line.find('=') - 4))] = trim(line.substr(line.find('=') + 1));
    }
  }
  return entries;
}

}  // namespace

struct CheckpointWriter::Implementation {
  struct File {
    explicit File(const fs::path& path) : buffer(path), stream(&buffer) {}
    ChecksumFile buffer;
    std::ostream stream;
  };

  Implementation(const fs::path& folder_, MPI_Comm comm) : ranks(comm), folder(folder_) {}

  Ranks ranks;
  fs::path folder, slot;
  Json manifest;                                       // complete on rank 0 only
  std::map<std::string, std::unique_ptr<File>> files;  // of this rank
  bool committed = false;

  /// Closes this rank's files and tells rank 0 about them.
  void close_files() {
    Json list = Json::object();
    together(ranks.comm, [&] {
      for (auto& [name, file] : files) {
        file->stream.flush();
        const std::string reason = file->buffer.close();
        if (!reason.empty() || !file->stream)
          throw RunError("The checkpoint cannot be written: '" +
                         (slot / stream_file(name, ranks.rank)).string() +
                         "': " + (reason.empty() ? "the stream has failed" : reason) +
                         ". Free some space; the checkpoint before this one is still valid.");
        list[stream_file(name, ranks.rank)] = {{"bytes", file->buffer.checksum().bytes()},
                                               {"checksum", file->buffer.checksum().text()},
                                               {"rank", ranks.rank}};
      }
    });
    for (int rank = 0; rank < ranks.size; ++rank) {
      std::string text = ranks.rank == rank ? list.dump() : "";
      broadcast(text, rank, ranks);
      if (ranks.rank == 0) manifest["files"].update(Json::parse(text));
    }
  }

  /// Rank 0: adds the files other libraries have left in the slot and makes the slot the valid one.
  void publish() {
    for (const fs::directory_entry& entry : fs::directory_iterator(slot)) {
      const std::string name = entry.path().filename().string();
      if (manifest["files"].contains(name)) continue;
      const Checksum sum = checksum_of(entry.path());
      manifest["files"][name] = {{"bytes", sum.bytes()}, {"checksum", sum.text()}};
    }
    write_json(slot / manifest_name, manifest);
    write_file_atomically(folder / pointer_name, slot.filename().string() + "\n");
  }
};

CheckpointWriter::CheckpointWriter(const fs::path& folder, double time, const std::string& parameters,
                                   MPI_Comm comm)
    : implementation(std::make_unique<Implementation>(folder, comm)) {
  Implementation& i = *implementation;
  std::string free_slot;
  together(i.ranks.comm, [&] {
    if (i.ranks.rank != 0) return;
    fs::create_directories(folder);
    free_slot = valid_slot(folder) == "a" ? "b" : "a";
    fs::remove_all(folder / free_slot);
    fs::create_directory(folder / free_slot);
  });
  broadcast(free_slot, 0, i.ranks);
  i.slot = folder / free_slot;
  i.manifest = {{"version", format_version},
                {"ranks", i.ranks.size},
                {"time", time},
                {"parameters", parameters},
                {"files", Json::object()}};
}

CheckpointWriter::~CheckpointWriter() = default;

std::ostream& CheckpointWriter::stream(const std::string& name) {
  auto& file = implementation->files[name];
  if (!file)
    file = std::make_unique<Implementation::File>(implementation->slot /
                                                  stream_file(name, implementation->ranks.rank));
  return file->stream;
}

std::string CheckpointWriter::external(const std::string& prefix) {
  return (implementation->slot / prefix).string();
}

void CheckpointWriter::commit() {
  Implementation& i = *implementation;
  if (i.committed) throw RunError("A checkpoint can be committed once only.");
  i.committed = true;
  i.close_files();
  MPI_Barrier(i.ranks.comm);
  together(i.ranks.comm, [&] {
    if (i.ranks.rank == 0) i.publish();
  });
}

struct CheckpointReader::Implementation {
  explicit Implementation(MPI_Comm comm) : ranks(comm) {}
  Ranks ranks;
  fs::path slot;
  Json manifest;
  std::map<std::string, std::ifstream> streams;

  /// Each rank checks the files it will read; those without a rank are dealt out in turn.
  void verify() const {
    int turn = 0;
    for (const auto& item : manifest.at("files").items()) {
      const int owner =
          item.value().contains("rank") ? item.value().at("rank").get<int>() : turn++ % ranks.size;
      if (owner != ranks.rank) continue;
      const Checksum sum = checksum_of(slot / item.key());
      if (sum.bytes() == item.value().at("bytes").get<std::uint64_t>() &&
          sum.text() == item.value().at("checksum").get<std::string>())
        continue;
      const std::string other = slot.filename() == "a" ? "b" : "a";
      throw RunError("The checkpoint is damaged: '" + (slot / item.key()).string() + "' has " +
                     std::to_string(sum.bytes()) + " bytes with checksum " + sum.text() + ", written were " +
                     item.value().at("bytes").dump() + " bytes with " + item.value().at("checksum").dump() +
                     ". The state before it may be intact: write the letter " + other + " into the file '" +
                     (slot.parent_path() / pointer_name).string() + "' and resume again.");
    }
  }
};

CheckpointReader::CheckpointReader(const fs::path& folder, MPI_Comm comm)
    : implementation(std::make_unique<Implementation>(comm)) {
  Implementation& i = *implementation;
  std::string text, slot;
  together(i.ranks.comm, [&] {
    if (i.ranks.rank != 0) return;
    slot = valid_slot(folder);
    if (slot.empty())
      throw InputError("There is no checkpoint in '" + folder.string() +
                       "' to resume from. Check the output folder, or start without --resume.");
    text = read_json(folder / slot / manifest_name).dump();
  });
  broadcast(slot, 0, i.ranks);
  broadcast(text, 0, i.ranks);
  i.slot = folder / slot;
  together(i.ranks.comm, [&] {
    i.manifest = Json::parse(text);
    if (const int version = i.manifest.at("version").get<int>(); version != format_version)
      throw InputError(
          "The checkpoint in '" + folder.string() + "' has format " + std::to_string(version) +
          "; this program reads format " + std::to_string(format_version) +
          ". Resume with the version of the program that wrote it, or start anew without --resume.");
    if (const int written = i.manifest.at("ranks").get<int>(); written != i.ranks.size)
      throw InputError("The checkpoint in '" + folder.string() + "' was written by " +
                       std::to_string(written) + (written == 1 ? " rank" : " ranks") + ", this run has " +
                       std::to_string(i.ranks.size) + ". Resume with --mpi " + std::to_string(written) + ".");
    i.verify();
  });
}

CheckpointReader::~CheckpointReader() = default;

double CheckpointReader::time() const {
  return implementation->manifest.at("time").get<double>();
}

void CheckpointReader::require_same_parameters(const std::string& parameters,
                                               const std::vector<std::string>& may_change) const {
  const auto before = entries_of(implementation->manifest.at("parameters").get<std::string>());
  const auto now = entries_of(parameters);
  const auto allowed = [&](const std::string& path) {
    for (const std::string& name : may_change)
      if (path == name || (!name.empty() && name.back() == '/' && path.compare(0, name.size(), name) == 0))
        return true;
    return false;
  };
  std::map<std::string, std::pair<std::string, std::string>> both;
  const std::string absent = "(absent)";
  for (const auto& [path, value] : before) both[path] = {value, absent};
  for (const auto& [path, value] : now) both.try_emplace(path, absent, "").first->second.second = value;
  std::string changes;
  for (const auto& [path, values] : both)
    if (values.first != values.second && !allowed(path))
      changes += "\n  " + path + ": " + values.first + " -> " + values.second;
  if (!changes.empty())
    throw InputError("The run cannot be resumed with other parameters than it was begun with:" + changes +
                     "\nSet them back, or start anew in another output folder.");
}

void CheckpointReader::read(const std::function<void()>& load) const {
  try {
    load();
  } catch (const StateFormatError& error) {
    throw InputError(
        "The checkpoint in '" + implementation->slot.string() +
        "' was written by another version of this program: its files are undamaged, but not laid "
        "out as this version expects (" +
        error.what() + "). Resume with the program that wrote it, or start anew without --resume.");
  }
}

std::istream& CheckpointReader::stream(const std::string& name) {
  const std::string file = stream_file(name, implementation->ranks.rank);
  if (!implementation->manifest.at("files").contains(file))
    throw RunError("The checkpoint in '" + implementation->slot.string() + "' has no part '" + name +
                   "' for rank " + std::to_string(implementation->ranks.rank) + ".");
  std::ifstream& in = implementation->streams[name];
  if (!in.is_open()) in.open(implementation->slot / file, std::ios::binary);
  return in;
}

std::string CheckpointReader::external(const std::string& prefix) const {
  return (implementation->slot / prefix).string();
}

bool checkpoint_exists(const fs::path& folder) {
  return !valid_slot(folder).empty();
}

}  // namespace seedflow
