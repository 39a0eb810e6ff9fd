#include "seedflow/base/nearest_name.h"

#include <algorithm>
#include <cctype>

namespace seedflow {

int edit_distance(const std::string& a, const std::string& b) {
  const auto same = [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  };
  const std::size_t n = a.size(), m = b.size();
  std::vector<std::vector<int>> d(n + 1, std::vector<int>(m + 1));
  for (std::size_t i = 0; i <= n; ++i) d[i][0] = static_cast<int>(i);
  for (std::size_t j = 0; j <= m; ++j) d[0][j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= n; ++i)
    for (std::size_t j = 1; j <= m; ++j) {
      const int replace = d[i - 1][j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, replace});
      if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]))
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[n][m];
}

std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates) {
  std::string best;
  int least = 0;
  for (const std::string& candidate : candidates) {
    const int distance = edit_distance(name, candidate);
    if (best.empty() || distance < least) {
      best = candidate;
      least = distance;
    }
  }
  // A third of the letters may differ (two at least); beyond that the names share only their length.
  const int allowed = std::max(2, static_cast<int>(std::max(name.size(), best.size())) / 3);
  return least <= allowed && least < static_cast<int>(name.size()) ? best : "";
}

std::string suggestion(const std::string& name, const std::vector<std::string>& candidates,
                       const std::string& kind) {
  const std::string near = nearest_name(name, candidates);
  if (!near.empty()) return "Nearest valid " + kind + ": \"" + near + "\".";
  const std::string plural = kind.back() == 'y' ? kind.substr(0, kind.size() - 1) + "ies" : kind + "s";
  if (candidates.empty()) return "There are no valid " + plural + " here.";
  std::string list;
  for (const std::string& candidate : candidates) list += (list.empty() ? "\"" : ", \"") + candidate + "\"";
  return "Valid " + plural + ": " + list + ".";
}

}  // namespace seedflow
