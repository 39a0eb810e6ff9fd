#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "seedflow/diagnose/diagnosis.h"
#include "seedflow/experiment/single_seed.h"

namespace seedflow::testing {

inline std::filesystem::path scratch(const std::string& name) {
  const auto folder = std::filesystem::temp_directory_path() / ("seedflow_diagnose_" + name);
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::string write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file) << text;
  return file.string();
}

/// Seeds of several sizes released from rest in water, quasi-steady drag and buoyancy.
inline Problem falling_seeds(const std::string& name) {
  Problem p;
  p.prm = write(scratch(name) / "model.prm",
                "set Experiment = single seed\n"
                "subsection Seeds\n  set Diameter = 1 mm\n  set Density = 1500\nend\n"
                "subsection Air\n  set Dynamic viscosity = 2 mPa s\nend\n"
                "subsection Run\n  set End time = 0.3 s\n  set Time step = 2 ms\nend\n");
  int i = 0;
  for (const char* diameter : {"0.6 mm", "1 mm", "1.5 mm", "2 mm"})
    p.conditions.push_back({std::string("d = ") + diameter,
                            ++i > 2 ? i == 3 : false,
                            {std::string("Seeds/Diameter=") + diameter}});
  return p;
}

/// Velocities at n times with noise of `level` of the largest, made by the model itself with `changes`.
inline void measure(Problem& p, const std::vector<std::pair<std::string, double>>& changes, double level,
                    unsigned seed, int n = 20) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const Observer observer = single_seed_observer();
  for (const Condition& c : p.conditions) {
    const PreparedRun run = observer.prepare(p.prm, c.overrides);
    std::vector<WantedValue> wanted;
    for (int i = 1; i <= n; ++i) wanted.push_back({"velocity", 0.3 * i / n});
    const std::vector<double> values = run.observe(changes, wanted);
    double largest = 0;
    for (const double v : values) largest = std::max(largest, std::abs(v));
    for (int i = 0; i < n; ++i) {
      Measurement m;
      m.condition = c.name, m.quantity = "velocity", m.unit = "mm/s", m.coordinate_unit = "ms";
      m.coordinate = 1e3 * wanted[i].coordinate;
      m.value = 1e3 * (values[i] + level * largest * normal(random));
      m.standard_uncertainty = 1e3 * level * largest;
      p.measurements.push_back(m);
    }
  }
}

}  // namespace seedflow::testing
