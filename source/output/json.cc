#include "seedflow/output/json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "seedflow/base/error.h"
#include "seedflow/output/folder.h"

namespace seedflow {

namespace {

/// The path of the first number that JSON cannot hold, or "".
std::string find_not_finite(const Json& value, const std::string& path) {
  if (value.is_number_float() && !std::isfinite(value.get<double>())) return path.empty() ? "/" : path;
  if (value.is_structured())
    for (const auto& item : value.items()) {
      const std::string found = find_not_finite(item.value(), path + "/" + item.key());
      if (!found.empty()) return found;
    }
  return "";
}

}  // namespace

void write_json(const std::filesystem::path& file, const Json& value) {
  const std::string bad = find_not_finite(value, "");
  if (!bad.empty())
    throw RunError("'" + file.string() + "' is not written: " + bad +
                   " is not a finite number. The computation that gave it has failed.");
  // Bytes that are no UTF-8 (a file name, say) become the replacement character instead of an exception.
  write_file_atomically(file, value.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

Json read_json(const std::filesystem::path& file) {
  try {
    return Json::parse(read_file(file));
  } catch (const Json::parse_error& error) {
    throw InputError("'" + file.string() + "' is not valid JSON: " + error.what());
  }
}

}  // namespace seedflow
