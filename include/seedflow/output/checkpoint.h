#pragma once

#include <mpi.h>

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace seedflow {

/// Writes the state of a run so that a run killed at any moment can be resumed from the last complete state.
///
/// The folder holds two slots, `a` and `b`, and the file `current` that names the valid one. A writer fills
/// the other slot: one binary file per stream and rank and a manifest (version, ranks, time, parameters, size
/// and checksum of every file); commit() then switches `current` by an atomic rename. Until that moment the
/// old state stays valid.
///
///   CheckpointWriter checkpoint(folder, time, parameter_text, comm);
///   dem.save(checkpoint.stream("seeds"));
///   triangulation.save(checkpoint.external("air"));   // files written by others into the slot, by that
///   prefix checkpoint.commit();
///
/// All ranks construct and commit together and open the same streams. Errors: RunError on all ranks if any of
/// them could not write (disk full, folder gone); the former checkpoint then is still valid.
class CheckpointWriter {
 public:
  /// `parameters`: the complete .prm of the run as text (Parameters::write).
  CheckpointWriter(const std::filesystem::path& folder, double time, const std::string& parameters,
                   MPI_Comm comm);
  ~CheckpointWriter();
  CheckpointWriter(const CheckpointWriter&) = delete;
  CheckpointWriter& operator=(const CheckpointWriter&) = delete;

  /// This rank's binary stream of that name; valid until commit().
  std::ostream& stream(const std::string& name);
  /// A path inside the slot for a library that writes its files by itself; every file of the slot whose name
  /// starts with `prefix` is checksummed by rank 0.
  std::string external(const std::string& prefix);
  /// Collective. Without it nothing has happened.
  void commit();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation;
};

/// Reads the state written by CheckpointWriter. The constructor verifies version, number of ranks and
/// checksums. Errors, the same on all ranks: InputError if there is no checkpoint, it was written by another
/// number of ranks or with other parameters; RunError if a file is damaged.
class CheckpointReader {
 public:
  CheckpointReader(const std::filesystem::path& folder, MPI_Comm comm);
  ~CheckpointReader();
  CheckpointReader(const CheckpointReader&) = delete;
  CheckpointReader& operator=(const CheckpointReader&) = delete;

  double time() const;  ///< [s]
  /// Throws InputError listing every entry that differs ("Air/Density: 1000 -> 998"), except those in
  /// `may_change` (paths, or sections given as "Output/"): end time, output intervals.
  void require_same_parameters(const std::string& parameters,
                               const std::vector<std::string>& may_change) const;

  /// Calls load(), which reads from the streams. What it finds in another layout than it expects, though the
  /// checksums agree, another version of the program has written: InputError.
  void read(const std::function<void()>& load) const;
  /// This rank's stream. Errors: RunError if the checkpoint has none of that name.
  std::istream& stream(const std::string& name);
  std::string external(const std::string& prefix) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation;
};

/// Is there a complete checkpoint in the folder?
bool checkpoint_exists(const std::filesystem::path& folder);

}  // namespace seedflow
