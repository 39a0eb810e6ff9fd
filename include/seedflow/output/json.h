#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace seedflow {

/// A JSON value whose objects keep the order of insertion. Include <nlohmann/json.hpp> to look into one;
/// numbers are written with the fewest digits that read back to the same double.
using Json = nlohmann::ordered_json;

/// Writes atomically, indented. Errors: RunError if a number is NaN or infinite (JSON has neither; the
/// message gives its path inside the value) or if the file cannot be written.
void write_json(const std::filesystem::path& file, const Json& value);

/// Errors: InputError with the file, line and column.
Json read_json(const std::filesystem::path& file);

}  // namespace seedflow
