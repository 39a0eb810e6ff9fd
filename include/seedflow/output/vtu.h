#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "seedflow/base/vector.h"

namespace seedflow {

/// Points with named data as a .vtu file for ParaView (show them as "Point Gaussian" or glyph spheres scaled
/// by "radius"). Floating-point data are written as 32-bit floats: enough for the eye, the numbers are in the
/// CSV files.
class PointCloud {
 public:
  explicit PointCloud(std::vector<Vec3> positions);  ///< [m]

  /// One value per point each. Errors: RunError if the length is wrong or the name is taken.
  PointCloud& add(const std::string& name, const std::vector<double>& values);
  PointCloud& add(const std::string& name, const std::vector<Vec3>& values);
  PointCloud& add(const std::string& name, const std::vector<std::int64_t>& values);

  /// Atomically. Errors: RunError.
  void write(const std::filesystem::path& file) const;

 private:
  friend class Polygons;
  std::vector<Vec3> positions;
  std::vector<std::pair<std::string, std::string>> arrays;  ///< name and the finished XML element
};

/// Walls and other surfaces: polygons over shared vertices, as a .vtp file.
class Polygons {
 public:
  /// `polygons[p]`: the indices of the vertices of polygon p in order around it.
  Polygons(std::vector<Vec3> vertices, std::vector<std::vector<int>> polygons);

  /// One value per polygon each.
  Polygons& add(const std::string& name, const std::vector<double>& values);
  Polygons& add(const std::string& name, const std::vector<Vec3>& values);
  Polygons& add(const std::string& name, const std::vector<std::int64_t>& values);

  void write(const std::filesystem::path& file) const;

 private:
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>> polygons;
  std::vector<std::pair<std::string, std::string>> arrays;
};

/// A .pvd file: the list of the files of a time series, of whatever kind (.vtu, .pvtu, .vtp). It is rewritten
/// atomically with every add(), so that it can be opened while the run goes on.
class PvdSeries {
 public:
  /// Begins a new list.
  explicit PvdSeries(std::filesystem::path file);
  /// Continues a list: entries later than `resume_time` [s] are removed. Errors: InputError if it cannot be
  /// read.
  PvdSeries(std::filesystem::path file, double resume_time);

  /// `data`: a file name relative to the folder of the .pvd.
  void add(double time, const std::string& data) { add_parts(time, {data}); }
  /// Several files that make up one time together, one per rank say.
  void add_parts(double time, const std::vector<std::string>& data);

  /// How many times have been added so far; handy to number the files.
  int n_times() const { return static_cast<int>(entries.size()); }

 private:
  void write() const;
  std::filesystem::path file;
  std::vector<std::pair<double, std::vector<std::string>>> entries;
};

}  // namespace seedflow
