#include "seedflow/output/report.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "seedflow/base/error.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/svg.h"

namespace seedflow {

namespace {

const char* const style_sheet = R"(
:root { color-scheme: light; font-size: 17px; }
* { box-sizing: border-box; }
body { margin: 0; background: #fff; color: #1f2328;
  font: 1rem/1.6 "Segoe UI", Roboto, "Helvetica Neue", Arial, "Liberation Sans", "DejaVu Sans", sans-serif; }
main { max-width: 800px; margin: 0 auto; padding: 40px 20px 28px; }
h1 { font-size: 1.75rem; line-height: 1.22; margin: 0 0 10px; letter-spacing: -0.01em; }
h2 { font-size: 1.25rem; line-height: 1.3; margin: 38px 0 10px; padding-top: 16px; border-top: 1px solid #d8dee4; }
p, ul { margin: 0 0 14px; }
p.lead { font-size: 1.1rem; line-height: 1.5; color: #3d444d; margin-bottom: 20px; }
.verdict { border-left: 6px solid; border-radius: 4px; padding: 14px 18px; margin: 0 0 26px; font-size: 1.06rem; line-height: 1.5; }
.verdict b { display: block; font-size: 0.85rem; letter-spacing: 0.02em; }
.agrees { border-color: #00795a; background: #eaf6f1; } .agrees > b { color: #006349; }
.doubtful { border-color: #b87400; background: #fdf5e6; } .doubtful > b { color: #7f4f00; }
.disagrees { border-color: #b83f00; background: #fdefe8; } .disagrees > b { color: #983300; }
.neutral { border-color: #57606a; background: #f3f5f7; } .neutral > b { color: #3d444d; }
figure { margin: 22px 0 26px; break-inside: avoid; }
figure svg { display: block; max-width: 100%; height: auto; }
figcaption, .note { font-size: 0.88rem; line-height: 1.5; color: #444c56; margin-top: 6px; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.88rem; line-height: 1.4; min-width: 50%; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: 7px 12px 7px 0; border-bottom: 1px solid #e4e7eb; vertical-align: top; }
th { border-bottom: 2px solid #57606a; vertical-align: bottom; }
th.n, td.n { text-align: right; }
td.n { white-space: nowrap; padding-left: 10px; }
tbody tr:last-child td { border-bottom: 1px solid #57606a; }
.table-title { font-size: 0.88rem; margin: 0 0 6px; }
code { font: 0.88em "DejaVu Sans Mono", Consolas, Menlo, monospace; background: rgba(31, 35, 40, 0.06); padding: 1px 4px; border-radius: 3px;
  overflow-wrap: anywhere; }
footer { margin-top: 46px; padding-top: 14px; border-top: 1px solid #d8dee4; font-size: 0.82rem; color: #57606a; }
footer p { margin: 0 0 4px; }
@page { margin: 16mm; }
@media print { :root { font-size: 10.5pt; } main { max-width: none; padding: 0; } h2 { break-after: avoid; } p, li { orphans: 3; widows: 3; }
  .verdict, figure, tr { break-inside: avoid; } .scroll { overflow: visible; }
  figure { margin: 12px 0 16px; } figure svg { width: auto; max-width: 88%; max-height: 88mm; } h2 { margin-top: 18px; } td, th { padding-top: 4px; padding-bottom: 4px; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; } }
)";

/// Escapes and sets `code` and **bold**; a mark without its partner stays as it is.
std::string marked_up(const std::string& text) {
  std::string html;
  for (std::size_t i = 0; i < text.size();) {
    const bool code = text[i] == '`', bold = text.compare(i, 2, "**") == 0;
    const std::string mark = code ? "`" : "**";
    const std::size_t close = code || bold ? text.find(mark, i + mark.size()) : std::string::npos;
    if (close != std::string::npos) {
      const std::string inner = escaped(text.substr(i + mark.size(), close - i - mark.size()));
      html += code ? "<code>" + inner + "</code>" : "<strong>" + inner + "</strong>";
      i = close + mark.size();
    } else {
      // A number and a short word behind it (a unit) stay on one line.
      const bool before_unit = text[i] == ' ' && i > 0 &&
                               std::isdigit(static_cast<unsigned char>(text[i - 1])) &&
                               std::min(text.find_first_of(" .,;:)", i + 1), text.size()) - i <= 5;
      html += before_unit ? "\u00a0" : escaped(text.substr(i, 1));
      ++i;
    }
  }
  return html;
}

/// Does a cell hold a number (or stand for a missing one)? Columns of numbers are set flush right.
bool is_number(const std::string& cell) {
  if (cell == "–" || cell == "n/a" || cell.empty()) return true;
  const std::size_t begin = cell.compare(0, std::string("−").size(), "−") == 0 ? std::string("−").size() : 0;
  return begin < cell.size() &&
         (std::isdigit(static_cast<unsigned char>(cell[begin])) || cell[begin] == '.') &&
         cell.find_first_of("abcdfghijklmnopqrstuvwxyzABCDFGHIJKLMNOPQRSTUVWXYZ/") == std::string::npos;
}

}  // namespace

std::string Table::number(double value, int significant_digits) {
  return std::isnan(value) ? "–" : printed_number(value, significant_digits);
}

Report::Report(std::string title_, std::string command_, std::string version_)
    : title(std::move(title_)), command(std::move(command_)), version(std::move(version_)) {}

void Report::lead(const std::string& sentence) {
  lead_html = "<p class=\"lead\">" + marked_up(sentence) + "</p>\n";
}

void Report::verdict(Verdict kind, const std::string& sentence) {
  static const char* const kinds[] = {"agrees", "doubtful", "disagrees", "neutral"};
  static const char* const words[] = {"✓ Agrees", "? In doubt", "✗ Disagrees", "Result"};
  const auto k = static_cast<std::size_t>(kind);
  verdict_html = "<div class=\"verdict " + std::string(kinds[k]) + "\"><b>" + words[k] + "</b>" +
                 marked_up(sentence) + "</div>\n";
}

void Report::heading(const std::string& text) {
  body += "<h2>" + marked_up(text) + "</h2>\n";
}

void Report::paragraph(const std::string& text) {
  body += "<p>" + marked_up(text) + "</p>\n";
}

void Report::list(const std::vector<std::string>& items) {
  body += "<ul>\n";
  for (const std::string& item : items) body += "<li>" + marked_up(item) + "</li>\n";
  body += "</ul>\n";
}

void Report::figure(const std::string& svg, const std::string& caption) {
  body += "<figure>\n" + svg + "<figcaption><strong>Figure " + std::to_string(++n_figures) + ".</strong> " +
          marked_up(caption) + "</figcaption>\n</figure>\n";
}

void Report::add(const LinePlot& plot) {
  figure(plot.svg(), plot.caption.empty() ? plot.title : plot.caption);
}
void Report::add(const BarPlot& plot) {
  figure(plot.svg(), plot.caption.empty() ? plot.title : plot.caption);
}
void Report::add(const HeatMap& plot) {
  figure(plot.svg(), plot.caption.empty() ? plot.title : plot.caption);
}

void Report::add(const Table& table) {
  std::vector<bool> numeric(table.columns.size(), true);
  for (const auto& row : table.rows) {
    if (row.size() != table.columns.size())
      throw RunError("The table '" + table.title + "' has a row of " + std::to_string(row.size()) +
                     " cells for " + std::to_string(table.columns.size()) + " columns.");
    for (std::size_t c = 0; c < row.size(); ++c) numeric[c] = numeric[c] && is_number(row[c]);
  }
  const auto cell = [&](const char* tag, std::size_t c, const std::string& text) {
    return "<" + std::string(tag) + (numeric[c] ? " class=\"n\">" : ">") + marked_up(text) + "</" + tag + ">";
  };
  body += "<figure>\n<p class=\"table-title\"><strong>Table " + std::to_string(++n_tables) + ".</strong> " +
          marked_up(table.title) + "</p>\n<div class=\"scroll\"><table>\n<thead><tr>";
  for (std::size_t c = 0; c < table.columns.size(); ++c) body += cell("th", c, table.columns[c]);
  body += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    body += "<tr>";
    for (std::size_t c = 0; c < row.size(); ++c) body += cell("td", c, row[c]);
    body += "</tr>\n";
  }
  body += "</tbody></table></div>\n";
  if (!table.note.empty()) body += "<div class=\"note\">" + marked_up(table.note) + "</div>\n";
  body += "</figure>\n";
}

std::string Report::html() const {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>" +
         escaped(title) + "</title>\n<style>" + style_sheet + "</style>\n</head>\n<body>\n<main>\n<h1>" +
         marked_up(title) + "</h1>\n" + lead_html + verdict_html + body + "<footer>\n<p>Made by <code>" +
         escaped(command) + "</code></p>\n<p>" + escaped(version) +
         "</p>\n</footer>\n</main>\n</body>\n</html>\n";
}

void Report::write(const std::filesystem::path& file) const {
  write_file_atomically(file, html());
}

}  // namespace seedflow
