#include "seedflow/experiment/bench_report.h"

#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <ostream>

#include "seedflow/output/json.h"

namespace seedflow {

void print_bench_table(const std::vector<BenchResult>& results, std::ostream& out) {
  std::size_t width = 0;
  for (const BenchResult& result : results) width = std::max(width, result.name.size());
  for (const BenchResult& result : results) {
    out << "  " << std::left << std::setw(static_cast<int>(width)) << result.name << "  " << std::right
        << std::setw(12) << std::setprecision(4) << result.value << ' ' << std::left << std::setw(28)
        << result.unit << ' ' << result.ranks << (result.ranks == 1 ? " rank" : " ranks") << '\n';
  }
  out << std::flush;
}

void write_bench_file(const std::vector<BenchResult>& results, const std::string& file) {
  Json list = Json::array();
  for (const BenchResult& result : results)
    list.push_back(
        {{"name", result.name}, {"value", result.value}, {"unit", result.unit}, {"ranks", result.ranks}});
  write_json(file, list);
}

}  // namespace seedflow
