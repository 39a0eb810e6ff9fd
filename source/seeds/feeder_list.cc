// Places of seeds from a CSV file.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/base/nearest_name.h"
#include "seedflow/seeds/feeder.h"

namespace seedflow {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream in(line);
  for (std::string part; std::getline(in, part, ',');) {
    const auto a = part.find_first_not_of(" \t\r"), b = part.find_last_not_of(" \t\r");
    parts.push_back(a == std::string::npos ? "" : part.substr(a, b - a + 1));
  }
  return parts;
}

const std::vector<std::string> columns{"x",  "y",  "z",  "qw", "qx",    "qy",
                                       "qz", "vx", "vy", "vz", "group", "kind"};

}  // namespace

ListedPlaces read_places(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw InputError("List of seeds: cannot read '" + file + "'. Give the name of a CSV file.");
  ListedPlaces list;
  std::vector<std::string> names;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    if (text.find_first_not_of(" \t\r") == std::string::npos || text[0] == '#') continue;
    const std::string where = file + ":" + std::to_string(line) + ": ";
    const std::vector<std::string> parts = split(text);
    if (names.empty()) {
      names = parts;
      std::map<std::string, int> count;
      for (const std::string& name : names) {
        if (std::find(columns.begin(), columns.end(), name) == columns.end())
          throw InputError(where + "the column \"" + name + "\" is not known. " +
                           suggestion(name, columns, "column"));
        if (++count[name] > 1) throw InputError(where + "there are two columns \"" + name + "\".");
      }
      for (const char* needed : {"x", "y", "z"})
        if (!count[needed])
          throw InputError(where + "there is no column \"" + needed +
                           "\". The first line names the columns: "
                           "x, y, z and, if wanted, qw, qx, qy, qz, vx, vy, vz, group, kind.");
      if ((count["qw"] + count["qx"] + count["qy"] + count["qz"]) % 4)
        throw InputError(where + "an orientation needs the four columns qw, qx, qy, qz.");
      continue;
    }
    if (parts.size() != names.size())
      throw InputError(where + std::to_string(parts.size()) + " values stand here, the first line names " +
                       std::to_string(names.size()) + " columns.");
    std::map<std::string, double> value;
    for (std::size_t i = 0; i < names.size(); ++i) {
      char* end = nullptr;
      const double a = std::strtod(parts[i].c_str(), &end);
      if (parts[i].empty() || *end || !std::isfinite(a))
        throw InputError(where + "\"" + parts[i] + "\" in column \"" + names[i] + "\" is not a number.");
      value[names[i]] = a;
    }
    const auto get = [&](const char* name, double otherwise) {
      const auto found = value.find(name);
      return found == value.end() ? otherwise : found->second;
    };
    ListedPlaces::Place place;
    place.centre = {get("x", 0), get("y", 0), get("z", 0)};
    Quaternion q{get("qw", 1), {get("qx", 0), get("qy", 0), get("qz", 0)}};
    if (!(q.w * q.w + norm_square(q.v) > 0))
      throw InputError(where + "the orientation (qw, qx, qy, qz) is zero.");
    place.orientation = normalized(q);
    place.velocity = {get("vx", 0), get("vy", 0), get("vz", 0)};
    place.group = static_cast<int>(get("group", 0));
    place.kind = static_cast<int>(get("kind", 0));
    list.place.push_back(place);
  }
  if (list.place.empty()) throw InputError(file + ": there is no seed in this list.");
  return list;
}

}  // namespace seedflow
