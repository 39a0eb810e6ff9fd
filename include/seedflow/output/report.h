#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "seedflow/output/plot.h"

namespace seedflow {

/// A table for a report. Cells are text; number() writes numbers with the same number of significant digits.
struct Table {
  std::string title;
  std::vector<std::string> columns;  ///< headings, units in brackets
  std::vector<std::vector<std::string>> rows = {};
  std::string note = "";  ///< a line below

  /// "0.1018", "2.3e-07", "-" for NaN.
  static std::string number(double value, int significant_digits = 4);
};

/// report.html: one file, no scripts, nothing loaded from elsewhere; opens in every browser and prints.
/// All text is escaped; in running text `...` sets code and **...** bold type.
class Report {
 public:
  enum class Verdict { agrees, doubtful, disagrees, neutral };

  /// `command`: what was typed to get this run; `version`: of the program. Both stand in the footer.
  Report(std::string title, std::string command, std::string version);

  /// The sentence below the title that says what was done.
  void lead(const std::string& sentence);
  /// The answer, in a box at the top, before everything else.
  void verdict(Verdict kind, const std::string& sentence);

  void heading(const std::string& text);
  void paragraph(const std::string& text);
  void list(const std::vector<std::string>& items);
  void add(const LinePlot& plot);
  void add(const BarPlot& plot);
  void add(const HeatMap& plot);
  void add(const Table& table);
  /// Any other drawing (an <svg> element), numbered with the plots.
  void figure(const std::string& svg, const std::string& caption);

  std::string html() const;
  /// Atomically. Errors: RunError.
  void write(const std::filesystem::path& file) const;

 private:
  std::string title, command, version;
  std::string lead_html, verdict_html, body;
  int n_figures = 0, n_tables = 0;
};

}  // namespace seedflow
