#include "oblique_impact_report.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "seedflow/experiment/command_of.h"
#include "seedflow/output/report.h"

namespace seedflow {

namespace {

constexpr double degree = M_PI / 180;

/// Factor to the unit shown: angles in degrees.
double shown(const Observable& o) {
  return o.unit == "rad" ? 1 / degree : 1;
}

LinePlot plot_of(const Observable& o, const std::vector<Sweep>& sweeps, const ObliqueImpactParameters& p) {
  LinePlot plot{o.name, {"impact angle", "deg"}, {o.name, o.unit == "rad" ? "deg" : o.unit}};
  int style = 0;
  for (const Sweep& s : sweeps) {
    LineSeries line{sweeps.size() == 1 ? "computed" : s.name, {}, {}};
    for (std::size_t i = 0; i < s.angles.size(); ++i) {
      line.x.push_back(s.angles[i] / degree);
      line.y.push_back(value_of(s.rebounds[i], o.name) * shown(o));
    }
    line.style = style;
    LineSeries points{sweeps.size() == 1 ? "measured" : s.name + " measured", {}, {}};
    for (const MeasuredImpact& m : s.measured) {
      if (m.quantity != o.name) continue;
      points.x.push_back(m.angle / degree);
      points.y.push_back(m.value * shown(o));
      points.error.push_back(m.uncertainty * shown(o));
    }
    points.draw = LineSeries::Draw::markers;
    points.style = style++;
    plot.series.push_back(line);
    if (!points.x.empty()) plot.series.push_back(points);
  }
  LineSeries theory{"sliding throughout", {}, {}};
  for (const double angle : sweeps.front().angles) {
    if (angle < sweeps.front().sliding_from) continue;
    theory.x.push_back(angle / degree);
    theory.y.push_back(value_of(sliding_rebound(p, angle), o.name) * shown(o));
  }
  theory.style = style;
  if (!theory.x.empty()) plot.series.push_back(theory);
  plot.vertical.push_back({sweeps.front().sliding_from / degree, "slides throughout"});
  plot.caption =
      "Bars: standard uncertainty. Sliding throughout: the closed form with impulse mu (1 + e) m v_n.";
  return plot;
}

/// 95 % of the rms deviations of n values with known uncertainty are below this: the square root of chi^2/n,
/// chi^2 by Wilson & Hilferty (1931), doi:10.1073/pnas.17.12.684.
double usual_rms(int n) {
  const double spread = 2.0 / (9 * n);
  return std::pow(1 - spread + 1.645 * std::sqrt(spread), 1.5);
}

std::string percent(double x) {
  return Table::number(100 * x, 2) + " %";
}

}  // namespace

double value_of(const Rebound& r, const std::string& quantity) {
  if (quantity == "tangential restitution") return r.tangential_restitution;
  return quantity == "rebound spin" ? r.spin : r.angle;
}

Agreement agreement(const Sweep& sweep, const std::string& quantity) {
  Agreement a;
  for (const MeasuredImpact& m : sweep.measured) {
    if (m.quantity != quantity) continue;
    const double difference = m.computed - m.value, scaled = std::abs(difference) / m.uncertainty;
    ++a.n;
    a.rms += difference * difference;
    a.rms_scaled += scaled * scaled;
    a.largest_scaled = std::max(a.largest_scaled, scaled);
  }
  if (a.n > 0) a.rms = std::sqrt(a.rms / a.n), a.rms_scaled = std::sqrt(a.rms_scaled / a.n);
  return a;
}

void write_impact_report(const std::vector<Sweep>& sweeps, const ObliqueImpactParameters& p,
                         const RunOptions& options) {
  Report report("Oblique impact of a sphere on a plane", command_of(options), "seedflow");
  std::ostringstream lead;
  lead << "A sphere of " << 1e3 * p.diameter << " mm (" << p.sphere_material << ") against a plane ("
       << p.plane_material << ") at " << p.speed << " m/s, restitution " << p.contact().restitution
       << ", friction " << p.contact().static_friction << ", at all angles.";
  report.lead(lead.str());

  const std::vector<Observable> quantities = oblique_impact_observer().observables;
  double worst = 0, sliding = 0;
  bool compared = false, within = true;
  Table table{"Computed beside measured",
              {"condition", "quantity", "values", "rms deviation", "rms deviation / uncertainty",
               "usual rms deviation / uncertainty", "largest deviation / uncertainty"}};
  for (const Sweep& s : sweeps) {
    sliding = std::max(sliding, s.sliding_error);
    for (const Observable& o : quantities) {
      const Agreement a = agreement(s, o.name);
      if (a.n == 0) continue;
      compared = true;
      worst = std::max(worst, a.rms_scaled);
      within = within && a.rms_scaled <= usual_rms(a.n);
      table.rows.push_back({s.name, o.name, std::to_string(a.n),
                            Table::number(a.rms * shown(o), 3) + (o.unit == "1"     ? ""
                                                                  : o.unit == "rad" ? " deg"
                                                                                    : " " + o.unit),
                            Table::number(a.rms_scaled, 3), "up to " + Table::number(usual_rms(a.n), 3),
                            Table::number(a.largest_scaled, 3)});
    }
  }
  std::ostringstream verdict;
  if (compared)
    verdict << "The rms deviation from the measured values is at most " << Table::number(worst, 3)
            << " standard uncertainties" << (within ? ", what their scatter alone explains. " : ". ");
  verdict << "Where the sphere slides throughout, the tangential impulse is mu (1 + e) m v_n within "
          << percent(sliding) << ".";
  const bool exact = sliding < 0.01;
  report.verdict(exact && within       ? Report::Verdict::agrees
                 : exact && worst <= 2 ? Report::Verdict::doubtful
                                       : Report::Verdict::disagrees,
                 verdict.str());
  const std::string notice = p.materials.notice();
  if (!notice.empty()) report.paragraph("**" + notice + "**");
  for (const Observable& o : quantities) report.add(plot_of(o, sweeps, p));
  if (compared) report.add(table);

  double deepest = 0;
  for (const Sweep& s : sweeps)
    for (const Rebound& r : s.rebounds) deepest = std::max(deepest, r.overlap);
  report.paragraph("The largest overlap is " + percent(2 * deepest / p.diameter) +
                   " of the radius. Sliding throughout begins at " +
                   Table::number(sweeps.front().sliding_from / degree, 3) + " degrees.");
  report.write(std::filesystem::path(options.output) / "report.html");
}

}  // namespace seedflow
