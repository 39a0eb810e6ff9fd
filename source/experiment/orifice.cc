#include "seedflow/experiment/orifice.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <sstream>

#include "seedflow/experiment/command_of.h"
#include "seedflow/fluid/fluid.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/progress.h"
#include "seedflow/output/report.h"
#include "seedflow/output/series.h"
#include "seedflow/output/summary.h"

namespace seedflow {

void OrificeParameters::declare(Parameters& p) {
  declare_experiment_name(p, name);
  geometry.declare(p);
  {
    const auto section = p.section("Run", "What drives the air, and for how long.");
    p.number("Pressure drop", pressure_drop, "Pa", Range::positive(), "Ambient minus behind the plate.");
    p.number("Ramp", ramp, "s", Range::positive(), "Time over which the pressure drop grows to its value.");
    p.number("End time", end_time, "s", Range::positive(), "Of the run.");
    p.number("Time step", time_step, "s", Range::positive(), "Of the air.");
    p.number("Average from", average_from, "s", Range::non_negative(), "Means are taken from here on.");
  }
  air.declare(p);
}

void OrificeParameters::check(const Parameters& p) const {
  geometry.check(p);
  if (average_from >= end_time)
    p.reject("Run/Average from", "nothing is left to average", "use less than Run/End time");
  if (p.is_set("Air/Boundary conditions"))
    p.reject("Air/Boundary conditions", "this experiment sets them itself", "remove the entry");
}

double long_orifice_discharge(double l, double re) {
  const double ultimate = 0.827 - 0.0085 * l, decade = std::log10(0.00015 * re);
  return 1 / (1 / ultimate + 20 / re * (1 + 2.25 * l) - 0.005 * l / (1 + 7.5 * decade * decade));
}

OrificeResult run_orifice(const OrificeParameters& p, const std::string& folder, MPI_Comm comm) {
  const OrificeGeometry& g = p.geometry;
  Domain<3> domain = [&] {
    const OrificeMesh mesh(g);
    return Domain<3>(mesh.coarse, mesh.sides, {}, comm);
  }();
  FluidParameters air = p.air;
  {
    std::ostringstream text;
    text.precision(17);
    text << "upstream: pressure inlet, 0; downstream: pressure outlet, " << -p.pressure_drop << "*min(1, t/"
         << p.ramp << "); " << (g.quarter ? "symmetry: slip; " : "") << "*: wall";
    air.boundary_conditions = text.str();
  }
  Fluid<3> fluid(air, domain);
  fluid.set_initial(
      0, [](const dealii::Point<3>&) { return dealii::Tensor<1, 3>(); },
      [](const dealii::Point<3>&) { return 0.0; });

  const bool writes = dealii::Utilities::MPI::this_mpi_process(comm) == 0 && !folder.empty();
  const double copies = g.quarter ? 4 : 1;
  std::unique_ptr<SeriesWriter> series;
  std::unique_ptr<Progress> progress;
  if (writes) {
    series = std::make_unique<SeriesWriter>(std::filesystem::path(folder) / "series.csv",
                                            std::vector<Column>{{"time", "s"},
                                                                {"flow", "m3/s"},
                                                                {"discharge coefficient"},
                                                                {"Courant number"},
                                                                {"mass balance"},
                                                                {"momentum balance"}});
    progress = std::make_unique<Progress>("simulated", p.end_time);
  }
  OrificeResult r;
  r.cells = domain.triangulation().n_global_active_cells();
  r.reynolds = p.air.density * g.diameter * std::sqrt(2 * p.pressure_drop / p.air.density) / p.air.viscosity;
  const double ideal = 0.25 * M_PI * g.diameter * g.diameter * std::sqrt(2 * p.pressure_drop / p.air.density);
  const long steps = std::lround(p.end_time / p.time_step);
  double n = 0, sum = 0, squares = 0, power = 0;
  for (long step = 1; step <= steps; ++step) {
    fluid.advance(p.time_step, {});
    const MassBalance& mass = fluid.mass_balance();
    const double out = copies * mass.outflow.at("downstream"), in = -copies * mass.outflow.at("upstream");
    const double courant = fluid.courant_number(p.time_step);
    r.largest_courant = std::max(r.largest_courant, courant);
    r.imbalance = std::max(r.imbalance, std::abs(out - in) / (copies * mass.flow));
    r.largest_mass_error = std::max(r.largest_mass_error, mass.largest);
    r.largest_momentum_error = std::max(r.largest_momentum_error, fluid.momentum_balance().residual);
    if (fluid.time() > p.average_from) {
      n += 1;
      sum += out;
      squares += out * out;
      power -= copies * mass.power.at("downstream");
    }
    if (writes) {
      series->row({fluid.time(), out, out / ideal, courant, mass.largest, fluid.momentum_balance().residual});
      progress->update(fluid.time(), "C_d " + Table::number(out / ideal));
    }
  }
  if (progress) progress->finish();
  r.flow = sum / n;
  r.flow_deviation = std::sqrt(std::max(0.0, squares / n - r.flow * r.flow)) / std::abs(r.flow);
  r.discharge = r.flow / ideal;
  // What the fan behind the plate adds; the ambient side has no pressure.
  r.power = power / n;
  const FluidStatistics& s = fluid.statistics();
  r.seconds = s.momentum_assembly + s.momentum_solve + s.pressure_assembly + s.pressure_setup +
              s.pressure_solve + s.update;

  // From three diameters in front of the hole to six behind it, a little off the axis, which is an edge of
  // the quarter.
  std::vector<dealii::Point<3>> line;
  const double off = 1e-3 * g.diameter, from = std::max(-3 * g.diameter, -0.99 * g.upstream_depth),
               to = std::min(g.length + 6 * g.diameter, g.length + 0.99 * g.downstream_depth);
  for (int i = 0; i <= 180; ++i) line.emplace_back(off, off, from + (to - from) * i / 180);
  const auto samples = fluid.sample(line);
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (!samples[i].inside) continue;
    r.z.push_back(line[i][2]);
    r.pressure.push_back(samples[i].pressure);
    r.velocity.push_back(samples[i].velocity[2]);
  }
  if (!folder.empty()) fluid.write(folder, "air", 0);
  return r;
}

namespace {

void write_report(const OrificeParameters& p, const OrificeResult& r, const RunOptions& options) {
  const std::filesystem::path folder = options.output;
  const double l = p.geometry.length / p.geometry.diameter;
  Report report("Air through one hole", command_of(options), "seedflow");
  report.lead("The flow that a pressure difference drives through a hole of a disc, without a seed.");
  const double published = long_orifice_discharge(l, r.reynolds);
  const bool in_range = l >= 2 && l <= 10 && r.reynolds <= 2e4 && p.geometry.chamfer == 0;
  if (in_range)
    report.verdict(
        std::abs(r.discharge / published - 1) < 0.1 ? Report::Verdict::agrees : Report::Verdict::disagrees,
        "Discharge coefficient " + Table::number(r.discharge) + ", published " + Table::number(published) +
            " (Lichtarowicz et al. 1965).");
  else
    report.verdict(Report::Verdict::neutral,
                   "Discharge coefficient " + Table::number(r.discharge) +
                       ". The published formula is for sharp-edged holes of 2 to 10 diameters length.");
  const Series series = read_series(folder / "series.csv");
  LinePlot flow{"Discharge coefficient", {"time", "s"}, {"C_d", "1"}};
  flow.series.push_back({"computed", series["time"], series["discharge coefficient"]});
  if (in_range) flow.horizontal.push_back({published, "Lichtarowicz et al. 1965"});
  report.add(flow);
  LinePlot pressure{"Pressure along the axis", {"z", "m"}, {"p", "Pa"}};
  pressure.series.push_back({"at the end", r.z, r.pressure});
  LinePlot velocity{"Velocity along the axis", {"z", "m"}, {"velocity", "m/s"}};
  velocity.series.push_back({"at the end", r.z, r.velocity});
  for (LinePlot* plot : {&pressure, &velocity}) {
    plot->vertical = {{0, "inlet"}, {p.geometry.length, "outlet"}};
    report.add(*plot);
  }
  report.write(folder / "report.html");
}

}  // namespace

int run_orifice_experiment(const RunOptions& options) {
  const MPI_Comm comm = MPI_COMM_WORLD;
  OrificeParameters p;
  Parameters parameters;
  p.declare(parameters);
  parameters.read(options.prm, options.overrides);
  p.check(parameters);
  if (options.resume)
    throw InputError(
        "The experiment \"orifice\" takes minutes and keeps no checkpoint. Start it without --resume.");
  const bool writes = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
  if (options.dry_run) {
    if (writes)
      std::cout << OrificeMesh(p.geometry).coarse.n_active_cells() << " cells, "
                << std::lround(p.end_time / p.time_step) << " steps" << std::endl;
    return exit_done;
  }
  const std::filesystem::path folder = options.output;
  if (writes) {
    prepare_output_folder(folder);
    std::ostringstream used;
    parameters.write(used);
    write_file_atomically(folder / "used.prm", used.str());
  }
  MPI_Barrier(comm);
  const OrificeResult r = run_orifice(p, options.output, comm);
  Summary summary;
  summary.text("experiment", p.name);
  const double l = p.geometry.length / p.geometry.diameter;
  summary.observe("discharge coefficient", r.discharge, "1");
  summary.observe("published discharge coefficient (2 <= l/d <= 10, sharp edge)",
                  long_orifice_discharge(l, r.reynolds), "1");
  summary.observe("air consumption", r.flow, "m3/s");
  summary.observe("relative fluctuation of the flow", r.flow_deviation, "1");
  summary.observe("power", r.power, "W");
  summary.observe("hydraulic Reynolds number", r.reynolds, "1");
  summary.observe("length / diameter", l, "1");
  summary.observe("largest Courant number", r.largest_courant, "1");
  summary.observe("cells", r.cells, "1");
  summary.conserve("air mass, local", r.largest_mass_error, 1e-8);
  summary.conserve("air volume through the sides", r.imbalance, 1e-8);
  summary.conserve("air momentum", r.largest_momentum_error, 1e-6);
  summary.performance.wall_time_s = r.seconds;
  summary.performance.peak_memory_MiB = peak_memory_MiB(comm);
  summary.performance.cell_steps_per_second_per_core =
      r.cells * (p.end_time / p.time_step) / r.seconds / dealii::Utilities::MPI::n_mpi_processes(comm);
  if (writes) {
    write_series(folder / "axis.csv",
                 {{{"z", "m"}, {"pressure", "Pa"}, {"velocity", "m/s"}}, {r.z, r.pressure, r.velocity}});
    summary.write(folder / "summary.json");
    write_report(p, r, options);
    std::cout << "C_d = " << r.discharge << " (l/d = " << l << ", Re_h = " << r.reynolds
              << ", Courant number up to " << r.largest_courant
              << ")\nreport: " << (folder / "report.html").string() << std::endl;
  }
  summary.require_conservation();
  return exit_done;
}

void describe_orifice(std::ostream& out, const std::string& section) {
  OrificeParameters p;
  Parameters parameters;
  p.declare(parameters);
  parameters.describe(out, section);
}

}  // namespace seedflow
