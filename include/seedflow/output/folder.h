#pragma once

#include <filesystem>
#include <string>

namespace seedflow {

/// Creates the output folder (with its parents) and proves that a file can be written into it, so that a run
/// fails before the first step and not after the last. Errors: InputError naming the folder, the system's
/// reason, the remedy.
void prepare_output_folder(const std::filesystem::path& folder);

/// Writes a whole file so that a reader (or a run killed at any moment) sees either the old or the new
/// content: a temporary file in the same folder, synchronised to disk, renamed over the target. Errors:
/// RunError (disk full, folder gone, ...); the old content then is untouched and no temporary file stays.
void write_file_atomically(const std::filesystem::path& file, const std::string& content);

/// The whole content of a file. Errors: InputError.
std::string read_file(const std::filesystem::path& file);

}  // namespace seedflow
