#include "seedflow/output/vtu.h"

#include <charconv>
#include <cstring>
#include <fstream>
#include <regex>

#include "seedflow/base/error.h"
#include "seedflow/output/folder.h"
#include "seedflow/output/svg.h"

namespace seedflow {

namespace {

std::string base64(const std::string& bytes) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? digits[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

template <class T>
std::string data_array(const std::string& name, const char* type, int components,
                       const std::vector<T>& values) {
  // VTK's inline binary form: the number of bytes (header_type), then the bytes, in base64.
  const std::uint64_t size = values.size() * sizeof(T);
  std::string bytes(sizeof size + size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
  return "<DataArray type=\"" + std::string(type) + "\" Name=\"" + escaped(name) +
         "\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"binary\">" + base64(bytes) +
         "</DataArray>\n";
}

std::string data_array(const std::string& name, const std::vector<double>& values) {
  return data_array(name, "Float32", 1, std::vector<float>(values.begin(), values.end()));
}

std::string data_array(const std::string& name, const std::vector<Vec3>& values) {
  std::vector<float> flat;
  flat.reserve(3 * values.size());
  for (const Vec3& v : values)
    for (int d = 0; d < 3; ++d) flat.push_back(static_cast<float>(v[d]));
  return data_array(name, "Float32", 3, flat);
}

std::string data_array(const std::string& name, const std::vector<std::int64_t>& values) {
  return data_array(name, "Int64", 1, values);
}

using Arrays = std::vector<std::pair<std::string, std::string>>;

template <class T>
void add_array(Arrays& arrays, std::size_t n, const std::string& name, const std::vector<T>& values) {
  for (const auto& array : arrays)
    if (array.first == name) throw RunError("The data '" + name + "' are given twice.");
  if (values.size() != n)
    throw RunError("The data '" + name + "' have " + std::to_string(values.size()) + " values for " +
                   std::to_string(n) + " points or polygons.");
  arrays.emplace_back(name, data_array(name, values));
}

std::string joined(const Arrays& arrays) {
  std::string text;
  for (const auto& array : arrays) text += array.second;
  return text;
}

std::string file_start(const std::string& type) {
  const std::uint16_t probe = 1;
  const bool little = *reinterpret_cast<const unsigned char*>(&probe) == 1;
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"1.0\" byte_order=\"" +
         (little ? "LittleEndian" : "BigEndian") + "\" header_type=\"UInt64\">\n";
}

std::string count(const char* what, std::size_t n) {
  return std::string(what) + "=\"" + std::to_string(n) + "\"";
}

}  // namespace

PointCloud::PointCloud(std::vector<Vec3> positions_) : positions(std::move(positions_)) {}

PointCloud& PointCloud::add(const std::string& name, const std::vector<double>& values) {
  return add_array(arrays, positions.size(), name, values), *this;
}
PointCloud& PointCloud::add(const std::string& name, const std::vector<Vec3>& values) {
  return add_array(arrays, positions.size(), name, values), *this;
}
PointCloud& PointCloud::add(const std::string& name, const std::vector<std::int64_t>& values) {
  return add_array(arrays, positions.size(), name, values), *this;
}

void PointCloud::write(const std::filesystem::path& file) const {
  // One vertex cell per point: without cells ParaView's filters find nothing.
  const std::size_t n = positions.size();
  std::vector<std::int64_t> connectivity(n), offsets(n);
  for (std::size_t i = 0; i < n; ++i)
    connectivity[i] = offsets[i] = static_cast<std::int64_t>(i), ++offsets[i];
  const std::vector<std::uint8_t> types(n, 1);  // VTK_VERTEX
  write_file_atomically(file, file_start("UnstructuredGrid") + "<UnstructuredGrid>\n<Piece " +
                                  count("NumberOfPoints", n) + " " + count("NumberOfCells", n) +
                                  ">\n<Points>\n" + data_array("Points", positions) +
                                  "</Points>\n<PointData>\n" + joined(arrays) + "</PointData>\n<Cells>\n" +
                                  data_array("connectivity", connectivity) + data_array("offsets", offsets) +
                                  data_array("types", "UInt8", 1, types) +
                                  "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
}

Polygons::Polygons(std::vector<Vec3> vertices_, std::vector<std::vector<int>> polygons_)
    : vertices(std::move(vertices_)), polygons(std::move(polygons_)) {
  for (const auto& polygon : polygons)
    for (const int v : polygon)
      if (v < 0 || v >= static_cast<int>(vertices.size()))
        throw RunError("A polygon refers to vertex " + std::to_string(v) + " of " +
                       std::to_string(vertices.size()) + ".");
}

Polygons& Polygons::add(const std::string& name, const std::vector<double>& values) {
  return add_array(arrays, polygons.size(), name, values), *this;
}
Polygons& Polygons::add(const std::string& name, const std::vector<Vec3>& values) {
  return add_array(arrays, polygons.size(), name, values), *this;
}
Polygons& Polygons::add(const std::string& name, const std::vector<std::int64_t>& values) {
  return add_array(arrays, polygons.size(), name, values), *this;
}

void Polygons::write(const std::filesystem::path& file) const {
  std::vector<std::int64_t> connectivity, offsets;
  for (const auto& polygon : polygons) {
    connectivity.insert(connectivity.end(), polygon.begin(), polygon.end());
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  write_file_atomically(
      file, file_start("PolyData") + "<PolyData>\n<Piece " + count("NumberOfPoints", vertices.size()) + " " +
                count("NumberOfVerts", 0) + " " + count("NumberOfLines", 0) + " " +
                count("NumberOfStrips", 0) + " " + count("NumberOfPolys", polygons.size()) + ">\n<Points>\n" +
                data_array("Points", vertices) + "</Points>\n<CellData>\n" + joined(arrays) +
                "</CellData>\n<Polys>\n" + data_array("connectivity", connectivity) +
                data_array("offsets", offsets) + "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n");
}

PvdSeries::PvdSeries(std::filesystem::path file_) : file(std::move(file_)) {
  write();
}

PvdSeries::PvdSeries(std::filesystem::path file_, double resume_time) : file(std::move(file_)) {
  const std::string text = read_file(file);
  if (text.find("</VTKFile>") == std::string::npos)
    throw InputError("'" + file.string() + "' is not a complete .pvd file; start without --resume.");
  const std::regex pattern("<DataSet timestep=\"([^\"]*)\" part=\"([^\"]*)\" file=\"([^\"]*)\"/>");
  for (std::sregex_iterator m(text.begin(), text.end(), pattern), end; m != end; ++m) {
    const std::string number = (*m)[1], part = (*m)[2], name = unescaped((*m)[3]);
    double time = 0;
    if (std::from_chars(number.data(), number.data() + number.size(), time).ec != std::errc())
      throw InputError("'" + file.string() + "': '" + number + "' is not a time.");
    if (time > resume_time) continue;
    if (part == "0") entries.push_back({time, {}});
    if (entries.empty()) throw InputError("'" + file.string() + "': the first part of a time is missing.");
    entries.back().second.push_back(name);
  }
  write();
}

void PvdSeries::add_parts(double time, const std::vector<std::string>& data) {
  entries.emplace_back(time, data);
  write();
}

void PvdSeries::write() const {
  std::string text = file_start("Collection") + "<Collection>\n";
  for (const auto& [time, parts] : entries)
    for (std::size_t part = 0; part < parts.size(); ++part) {
      char number[32];
      const std::string exact(number, std::to_chars(number, number + sizeof number, time).ptr);
      text += "<DataSet timestep=\"" + exact + "\" part=\"" + std::to_string(part) + "\" file=\"" +
              escaped(parts[part]) + "\"/>\n";
    }
  write_file_atomically(file, text + "</Collection>\n</VTKFile>\n");
}

}  // namespace seedflow
