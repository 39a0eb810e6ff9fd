#include "seedflow/output/summary_tables.h"

namespace seedflow {

void add_summary_tables(const Summary& summary, Report& report) {
  report.heading("Numbers");
  Table numbers{"Observables", {"name", "value", "unit"}};
  for (const auto& o : summary.observables())
    numbers.rows.push_back({o.name, Table::number(o.value), o.unit});
  report.add(numbers);
  Table balances{"Conservation", {"balance", "relative error", "limit"}};
  for (const auto& b : summary.balances())
    balances.rows.push_back({b.name, Table::number(b.relative_error, 2), Table::number(b.limit, 2)});
  if (!balances.rows.empty()) report.add(balances);
}

}  // namespace seedflow
