// What a study's results look like as plots and tables.

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "seedflow/experiment/granular_study.h"
#include "seedflow/output/svg.h"
#include "seedflow/seeds/template_parameters.h"

namespace seedflow {

namespace {

/// BS of the paper's models; 0 for others.
double roughness(int n_spheres) {
  for (const PaperModel& model : paper_models)
    if (model.n_spheres == n_spheres) return model.roughness;
  return 0;
}

/// Adds a point; deviations are kept only if all points have one.
void add_point(LineSeries& curve, double x, double y, double deviation) {
  curve.x.push_back(x);
  curve.y.push_back(y);
  curve.error.push_back(std::isfinite(deviation) ? deviation : 0);
  curve.draw = LineSeries::Draw::both;
}

std::vector<std::string> groups_of(const StudyTable& table) {
  std::vector<std::string> groups;
  for (const StudyTable::Row& row : table.rows)
    if (std::find(groups.begin(), groups.end(), row.of.group) == groups.end()) groups.push_back(row.of.group);
  return groups;
}

}  // namespace

LinePlot StudyTable::against_roughness(const std::string& observable, const std::string& title,
                                       const Axis& y) const {
  LinePlot plot{title, {"surface roughness BS"}, y};
  for (const std::string& group : groups_of(*this)) {
    LineSeries curve{group, {}, {}};
    for (const Row& row : rows)
      if (row.of.group == group && roughness(row.of.n_spheres) > 0)
        add_point(curve, roughness(row.of.n_spheres), row.mean.at(observable), row.deviation.at(observable));
    if (!curve.x.empty()) plot.series.push_back(curve);
  }
  return plot;
}

LinePlot StudyTable::against_axis(const std::string& observable, const std::string& title,
                                  const StudyAxis& axis, const Axis& y) const {
  LinePlot plot{title, {axis.path.substr(axis.path.find('/') + 1), axis.printed_unit}, y};
  std::set<std::string> names;
  const auto name_of = [](const StudyCase& c) {
    return "N = " + std::to_string(c.n_spheres) + ", " + c.motion + ", " + c.reading +
           (c.caliper == "equal" ? ", equal caliper" : "");
  };
  for (const Row& row : rows) names.insert(name_of(row.of));
  for (const std::string& name : names) {
    LineSeries curve{name, {}, {}};
    for (const Row& row : rows)
      if (name_of(row.of) == name)
        add_point(curve, row.of.along * axis.printed_factor, row.mean.at(observable),
                  row.deviation.at(observable));
    plot.series.push_back(curve);
  }
  return plot;
}

Table StudyTable::all(const std::string& title) const {
  Table table{title, {"N", "BS", "model"}, {}, "Mean +- standard deviation over the repeats."};
  for (const std::string& name : observables) table.columns.push_back(name);
  table.columns.push_back("repeats");
  for (const Row& row : rows) {
    std::vector<std::string> cells = {
        std::to_string(row.of.n_spheres),
        roughness(row.of.n_spheres) > 0 ? printed_number(roughness(row.of.n_spheres)) : "-", row.of.group};
    for (const std::string& name : observables) {
      std::string cell = printed_number(row.mean.at(name), 4);
      if (std::isfinite(row.deviation.at(name))) cell += " ± " + printed_number(row.deviation.at(name), 2);
      cells.push_back(cell);
    }
    cells.push_back(std::to_string(row.repeats));
    table.rows.push_back(cells);
  }
  return table;
}

std::string StudyTable::verdict(const std::string& observable, double measured, double deviation) const {
  std::ostringstream text;
  text.precision(4);
  for (const std::string& group : groups_of(*this)) {
    const Row *coarsest = nullptr, *finest = nullptr;
    int inside = 0, all = 0;
    for (const Row& row : rows) {
      if (row.of.group != group) continue;
      ++all;
      inside += std::abs(row.mean.at(observable) - measured) <= deviation;
      if (!coarsest || row.of.n_spheres < coarsest->of.n_spheres) coarsest = &row;
      if (!finest || row.of.n_spheres > finest->of.n_spheres) finest = &row;
    }
    text << "**" << group << ":** " << coarsest->mean.at(observable) << " (N = " << coarsest->of.n_spheres
         << ")";
    if (finest != coarsest)
      text << " to " << finest->mean.at(observable) << " (N = " << finest->of.n_spheres << ")";
    text << ", measured " << measured;
    if (deviation > 0) text << " ± " << deviation << " (" << inside << " of " << all << " models inside)";
    text << ". ";
  }
  return text.str();
}

}  // namespace seedflow
