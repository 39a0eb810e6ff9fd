#pragma once

#include <cmath>
#include <limits>

#include "seedflow/output/report.h"

namespace seedflow {

/// A report that uses everything a report can hold, with long labels, near reference lines and awkward names,
/// so that a look at it shows whether anything overlaps.
inline Report demo_report() {
  Report report("Settling of a bonded seed: paper setting & what it gives",
                "./seedflow prm/settling.prm --set \"Air/Dynamic viscosity=0.01\" --output results/settling",
                "seedflow 0.1, commit 0123abc, deal.II 9.4.1");
  report.lead(
      "A 4 mm seed of 70 bonded sub-spheres falls through a liquid (1000 kg/m³, 0.01 Pa s) in a box of 30 × "
      "30 × 120 mm; its speed is compared with published values and with the balance of forces.");
  report.verdict(
      Report::Verdict::disagrees,
      "The terminal velocity is **0.061 m/s** where the force balance of a 4 mm sphere gives 0.102 m/s: drag "
      "on every sub-sphere (`drag = per sub-sphere`) is 2.7 times too strong.");

  report.heading("Velocity over time");
  report.paragraph(
      "Every curve starts from rest. The dashed lines in the margin are independent values; a curve that "
      "levels off at its line has found its terminal velocity.");
  LinePlot velocity{"Velocity of the seed", {"time", "s"}, {"settling velocity", "m/s"}};
  const double terminal[] = {0.061, 0.102, 0.085, 0.074, 0.112};
  const char* const names[] = {"36 sub-spheres", "70 sub-spheres, drag per seed", "109 sub-spheres",
                               "164 sub-spheres", "single sphere"};
  for (int k = 0; k < 5; ++k) {
    LineSeries line;
    line.label = names[k];
    for (int i = 0; i <= 20000; ++i) {
      const double t = 0.2 * i / 20000;
      line.x.push_back(t);
      line.y.push_back(terminal[k] * std::tanh(t / 0.03));
    }
    velocity.series.push_back(line);
  }
  LineSeries measured{"Table 5 (digitised)", {0.05, 0.10, 0.15, 0.20}, {0.078, 0.094, 0.098, 0.0985}};
  measured.draw = LineSeries::Draw::markers;
  measured.error = {0.004, 0.004, 0.005, 0.005};
  velocity.series.push_back(measured);
  velocity.horizontal = {{0.1018, "force balance, Schiller-Naumann, 4 mm sphere"},
                         {0.1045, "wide tank"},
                         {0.098, "published, Table 5"},
                         {0.0607, "root of the sub-sphere drag law"}};
  velocity.vertical = {
      {0.03, "relaxation time"}, {0.036, "first exchange with the air"}, {0.19, "reaches the floor"}};
  velocity.caption =
      "Settling velocity of five seed models. Symbols: published values with their reading error.";
  report.add(velocity);

  LinePlot convergence{
      "Convergence of the velocity error", {"cell size", "m", true}, {"L2 error", "m/s", true}};
  LineSeries order2{"uniform mesh", {}, {}, LineSeries::Draw::both},
      hanging{"hanging nodes", {}, {}, LineSeries::Draw::both};
  for (int i = 0; i < 6; ++i) {
    const double h = 0.01 / (1 << i);
    order2.x.push_back(h), order2.y.push_back(0.8 * h * h);
    hanging.x.push_back(h), hanging.y.push_back(1.7 * h * h);
    order2.error.push_back(0.1 * h * h);
  }
  convergence.series = {order2, hanging};
  convergence.caption = "Both meshes converge with second order.";
  report.add(convergence);

  LinePlot band{"Mass flow with scatter",
                {"time", "s"},
                {"mass flow of seeds through the outlet of the metering unit", "kg/s"}};
  LineSeries flow{"mean of 8 runs and their scatter", {}, {}};
  for (int i = 0; i <= 60; ++i) {
    const double t = 0.05 * i, q = 0.01 + 0.002 * std::sin(4 * t);
    flow.x.push_back(t);
    flow.y.push_back(i > 40 && i < 44 ? std::numeric_limits<double>::quiet_NaN() : q);
    flow.band_low.push_back(q - 0.001), flow.band_high.push_back(q + 0.0012);
  }
  band.series = {flow};
  band.caption = "A gap where values are missing is said below the plot.";
  report.add(band);

  report.heading("Coupling cost and models");
  BarPlot bars{
      "Terminal velocity by model", {"36", "50", "70", "109", "164 (diameter reading)"}, {"velocity", "m/s"}};
  bars.series = {
      {"drag per sub-sphere", {0.083, 0.071, 0.061, 0.052, 0.044}, {0.003, 0.002, 0.002, 0.002, 0.001}},
      {"drag per seed", {0.1015, 0.102, 0.1021, 0.1019, std::numeric_limits<double>::quiet_NaN()}},
      {"published", {0.098, 0.0985, 0.0985, 0.0991, 0.0993}}};
  bars.horizontal = {{0.1018, "force balance"}};
  bars.caption = "The published trend is flat; drag per sub-sphere falls with the number of sub-spheres.";
  report.add(bars);

  BarPlot cost{"Cost of the coupling",
               {"single sphere of 0.3 mm", "36", "70", "164"},
               {"wall time per step", "s", true}};
  cost.series = {{"time", {2e-4, 3.1e-3, 6.2e-3, 1.9e-2}}};
  report.add(cost);

  HeatMap field{"Speed of the air in the mid-plane", {"x", "mm"}, {"z", "mm"}, {"speed", "m/s"}, 30, 120};
  field.x.low = 0, field.x.high = 30, field.y.low = 0, field.y.high = 120;
  field.equal_scale = true;
  for (int j = 0; j < 120; ++j)
    for (int i = 0; i < 30; ++i) {
      const double dx = (i + 0.5 - 15) / 4, dz = (j + 0.5 - 70) / (j > 70 ? 22.0 : 6.0);
      field.values.push_back(dx * dx + dz * dz < 0.05 ? std::numeric_limits<double>::quiet_NaN()
                                                      : 0.1 * std::exp(-dx * dx - dz * dz));
    }
  field.caption = "The wake of the falling seed.";
  report.add(field);

  HeatMap map{
      "Seeding quality", {"forward speed", "km/h"}, {"rotor speed", "1/s"}, {"miss index", "%"}, 8, 5};
  map.x.low = 2, map.x.high = 10, map.y.low = 0.5, map.y.high = 3;
  for (int j = 0; j < 5; ++j)
    for (int i = 0; i < 8; ++i) map.values.push_back(1 + 0.3 * i * j + 0.05 * i * i);
  map.caption = "Share of missed seeds.";
  report.add(map);

  Table table{"Terminal velocity of the five models in both readings.",
              {"model", "sub-spheres", "velocity [m/s]", "against force balance [%]", "remark"}};
  for (int k = 0; k < 4; ++k)
    table.rows.push_back({names[k], std::to_string(36 + 20 * k), Table::number(terminal[k]),
                          Table::number(100 * (terminal[k] / 0.1018 - 1), 3),
                          k == 1 ? "agrees" : "too slow"});
  table.rows.push_back({"<none> & \"other\"", "1", Table::number(std::numeric_limits<double>::quiet_NaN()),
                        Table::number(1.234567e-9), "not run"});
  table.note = "A dash stands for a value that was not computed.";
  report.add(table);
  report.heading("What agrees, what cannot");
  report.list({"Drag per seed agrees with the force balance within 1 %.",
               "Drag per sub-sphere cannot agree: N small spheres have more surface than one large one.",
               "Names with <angle brackets> & ampersands are shown as they are."});
  return report;
}

}  // namespace seedflow
