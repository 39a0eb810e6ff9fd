// The air mesh of somebody's own device: reading, checking against the geometry, writing.

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/base/nearest_name.h"
#include "seedflow/mesh/device_mesh.h"
#include "seedflow/mesh/gmsh_file.h"
#include "seedflow/mesh/sliding_interface.h"

namespace seedflow {

using dealii::Point;

namespace {

using Side = DeviceMesh::Side;

constexpr double degree = M_PI / 180;
constexpr double in_plane = 0.02;   // of the thickness: what may lie beside a plane
constexpr double same_area = 0.15;  // an octagon in a circle has 10 % less

std::string mm(double metres) {
  std::ostringstream text;
  text.precision(4);
  text << 1e3 * metres << " mm";
  return text.str();
}

std::string place(const Point<3>& x) {
  return "(" + mm(x[0]) + ", " + mm(x[1]) + ", " + mm(x[2]) + ")";
}

std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "\"" : ", \"") + name + "\"";
  return text.empty() ? "none" : text;
}

template <typename Map>
std::vector<std::string> values(const Map& map) {
  std::vector<std::string> all;
  for (const auto& [id, name] : map) all.push_back(name);
  return all;
}

/// Those of the device's side names that the mesh must have, all others are its optional walls.
bool is_needed(const std::string& name) {
  return name != "housing" && name != "vacuum wall";
}

/// A face of the boundary.
struct Face {
  Side side;
  Point<3> centre;
  std::array<Point<3>, 4> corner;  ///< lexicographic
  double area;
};

class DeviceCheck {
 public:
  DeviceCheck(const std::string& file, const DeviceGeometry& geometry) : file(file), device(geometry) {}

  [[noreturn]] void refuse(const std::string& reason) const {
    throw InputError("Mesh file \"" + file + "\" " + reason);
  }

  /// Which id of the device each id of the file means.
  template <typename Id>
  std::map<Id, Id> meaning(const std::map<Id, std::string>& found, const std::map<Id, std::string>& known,
                           const std::string& kind) const {
    std::map<Id, Id> result;
    for (const auto& [id, name] : found) {
      const auto match =
          std::find_if(known.begin(), known.end(), [&](const auto& k) { return k.second == name; });
      if (match == known.end())
        refuse("has the " + kind + " \"" + name + "\", which means nothing here. " +
               suggestion(name, values(known), kind) + " Known are " + list(values(known)) +
               "; walls that stand are \"housing\" in the turning part and \"vacuum wall\" in the standing "
               "one.");
      result[id] = match->first;
    }
    return result;
  }

  void require_all(const std::vector<std::string>& present, const std::vector<std::string>& needed,
                   const std::string& kind) const {
    std::vector<std::string> missing;
    for (const std::string& name : needed)
      if (!std::count(present.begin(), present.end(), name)) missing.push_back(name);
    if (!missing.empty())
      refuse("has no " + kind + " " + list(missing) + ". Needed: " + list(needed) +
             "; found: " + list(present) + ". Give every " + kind + " one of these names in Gmsh.");
  }

  void holes(const std::vector<Face>& faces) const;
  void vacuum_face(const std::vector<Face>& faces) const;
  void front(const std::vector<Face>& faces) const;
  void revolution(const std::vector<Face>& faces) const;

 private:
  /// The hole whose place is nearest.
  int nearest(const Point<3>& x) const {
    const double turn = (std::atan2(x[1], x[0]) - device.first_angle) / device.pitch_angle();
    const int k = static_cast<int>(std::lround(turn)) % device.holes;
    return k < 0 ? k + device.holes : k;
  }
  double off_axis(int hole, const Point<3>& x) const {
    const Vec3 c = device.hole_centre(hole, 0);
    return std::hypot(x[0] - c.x, x[1] - c.y);
  }
  std::string hole_name(int k) const {
    const Vec3 c = device.hole_centre(k, 0);
    return "hole " + std::to_string(k) + " (at x = " + mm(c.x) + ", y = " + mm(c.y) + ")";
  }

  const std::string& file;
  const DeviceGeometry& device;
};

void DeviceCheck::holes(const std::vector<Face>& faces) const {
  const double t = device.thickness, near = in_plane * t;
  std::vector<double> area(device.n_holes(), 0);
  for (const Face& f : faces) {
    if (f.side != DeviceMesh::hole_end && f.side != DeviceMesh::vacuum_face) continue;
    const std::string name = DeviceMesh::side_names().at(f.side);
    for (const Point<3>& x : f.corner)
      if (std::abs(x[2] - t) > near)
        refuse("has its side \"" + name + "\" at z = " + mm(x[2]) + ", which Device/Disc thickness puts at " +
               mm(t) +
               ". The disc's front is z = 0, the vacuum is at larger z; mend the mesh, the entry, or "
               "Device mesh/Unit.");
    if (f.side != DeviceMesh::hole_end) continue;
    const int k = nearest(f.centre);
    if (k >= device.n_holes() || off_axis(k, f.centre) > 1.2 * device.hole_radius())
      refuse("has a face of the side \"hole end\" at " + place(f.centre) +
             ", where Device/Holes, Drilled, Pitch radius and First angle put no hole; the nearest is " +
             hole_name(k) + ". Mend these entries or the mesh, which shows the disc not turned.");
    area[k] += f.area;
  }
  for (int k = 0; k < device.n_holes(); ++k)
    if (std::abs(area[k] / device.hole_area() - 1) > same_area)
      refuse("has a side \"hole end\" of " + std::to_string(1e6 * area[k]) + " mm2 at " + hole_name(k) +
             "; Device/Hole diameter makes it " + std::to_string(1e6 * device.hole_area()) +
             " mm2. Mend the entry or the mesh (at least eight cells around a hole).");
}

void DeviceCheck::vacuum_face(const std::vector<Face>& faces) const {
  constexpr int around = 720;
  // Along three circles: the holes' middle, inner and outer side.
  for (const double reach : {0.0, -0.9, 0.9}) {
    const double radius = device.pitch_radius + reach * device.hole_radius();
    std::vector<char> covered(around, 0);
    const auto point = [&](int i) {
      const double angle = 2 * M_PI * i / around;
      return Point<2>(radius * std::cos(angle), radius * std::sin(angle));
    };
    for (const Face& f : faces) {
      if (f.side != DeviceMesh::vacuum_face) continue;
      // Only the points that the face's own arc can contain.
      const double middle = std::atan2(f.centre[1], f.centre[0]);
      double half = 0;
      for (const Point<3>& x : f.corner)
        half = std::max(half, std::abs(std::remainder(std::atan2(x[1], x[0]) - middle, 2 * M_PI)));
      const double step = 2 * M_PI / around;
      for (int j = static_cast<int>(std::floor((middle - half) / step)); j * step <= middle + half + step;
           ++j) {
        const int i = ((j % around) + around) % around;
        const Point<2> x = point(i);
        bool left = true, right = true;
        constexpr int ring[] = {0, 1, 3, 2};
        for (int c = 0; c < 4; ++c) {
          const Point<3>&a = f.corner[ring[c]], &b = f.corner[ring[(c + 1) % 4]];
          const double side = (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]);
          left = left && side >= -1e-9 * radius * radius;
          right = right && side <= 1e-9 * radius * radius;
        }
        if (left || right) covered[i] = 1;
      }
    }
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * M_PI * i / around, exposure = device.exposure(angle);
      std::ostringstream where;
      where << std::remainder(angle, 2 * M_PI) / degree << " deg, " << mm(radius) << " from the axis";
      if (exposure >= 1 && !covered[i])
        refuse(
            "has no side \"vacuum face\" at " + where.str() +
            ", where a hole faces the vacuum by Device/Vacuum from and Vacuum to: interface and arc do not "
            "match. Let the face lie under the whole holes on this arc, or mend the entries.");
      if (exposure <= 0 && covered[i])
        refuse("has its side \"vacuum face\" at " + where.str() +
               ", outside the arc of Device/Vacuum from and Vacuum to. Mend the entries or the mesh.");
    }
  }
}

void DeviceCheck::front(const std::vector<Face>& faces) const {
  const double mouth = device.hole_radius() + device.chamfer;
  std::vector<double> off(device.n_holes(), 1e300);
  for (const Face& f : faces)
    if (const int k = nearest(f.centre); f.side == DeviceMesh::disc && k < device.n_holes())
      for (const Point<3>& x : f.corner)
        if (const double r = off_axis(k, x); r > 0.9 * mouth && r < 3 * mouth)
          if (std::abs(x[2]) < std::abs(off[k])) off[k] = x[2];
  for (int k = 0; k < device.n_holes(); ++k)
    if (std::abs(off[k]) > in_plane * device.thickness)
      refuse("has no side \"disc\" in the plane z = 0 around " + hole_name(k) +
             (off[k] < 1e299 ? "; the nearest is at z = " + mm(off[k]) : std::string()) +
             ". Shift the mesh along z, or name the disc's front face so.");
}

void DeviceCheck::revolution(const std::vector<Face>& faces) const {
  for (const Face& f : faces) {
    if (f.side != DeviceMesh::housing && f.side != DeviceMesh::ambient) continue;
    const auto &a = f.corner[0], &b = f.corner[1], &c = f.corner[2], &d = f.corner[3];
    dealii::Tensor<1, 3> normal = dealii::cross_product_3d(d - a, c - b);
    normal /= normal.norm();
    const double r = std::hypot(f.centre[0], f.centre[1]);
    // Chords on a circle are off by half a cell's angle at most.
    const double around = r > 0 ? (-f.centre[1] * normal[0] + f.centre[0] * normal[1]) / r : 0;
    if (std::abs(around) > 0.5)
      refuse("has a face of the side \"" + DeviceMesh::side_names().at(f.side) + "\" at " + place(f.centre) +
             " that stands across the rotation. The turning part's mesh turns with the disc, so what stands "
             "around it must be a body of revolution: leave dividers and blades to the seeds' walls.");
  }
}

}  // namespace

void read_device_mesh(const std::string& file, double unit, const DeviceGeometry& device,
                      dealii::Triangulation<3>& coarse) {
  const DeviceCheck check(file, device);
  GmshMesh<3> mesh;
  read_gmsh(file, unit, mesh);
  const auto sides = check.meaning(mesh.sides, DeviceMesh::side_names(), "physical surface");
  const auto parts = check.meaning(mesh.parts, DeviceMesh::part_names(), "physical volume");

  std::map<std::string, int> found_parts, found_sides;
  int nameless = 0;
  std::string first;
  for (const auto& cell : mesh.coarse.active_cell_iterators()) {
    const auto part = parts.find(cell->material_id());
    if (part == parts.end()) {
      if (nameless++ == 0) first = place(cell->center());
      continue;
    }
    ++found_parts[mesh.parts.at(cell->material_id())];
    cell->set_material_id(part->second);
  }
  const auto names_of = [](const std::map<std::string, int>& found) {
    std::vector<std::string> names;
    for (const auto& [name, n] : found) names.push_back(name);
    return names;
  };
  check.require_all(names_of(found_parts), values(DeviceMesh::part_names()), "physical volume");
  if (nameless > 0)
    check.refuse("has " + std::to_string(nameless) + " cells in no physical volume, the first at " + first +
                 ". Add them to \"turning\" or \"standing\".");

  std::vector<Face> faces;
  for (const auto& cell : mesh.coarse.active_cell_iterators())
    for (const unsigned int f : cell->face_indices()) {
      const auto face = cell->face(f);
      if (!face->at_boundary()) continue;
      const auto side = sides.find(face->boundary_id());
      if (side == sides.end()) {
        if (nameless++ == 0) first = place(face->center());
        continue;
      }
      const Side s = static_cast<Side>(side->second);
      const bool turns = cell->material_id() == DeviceMesh::turning;
      const std::string& name = DeviceMesh::side_names().at(s);
      if (turns != DeviceMesh::turns(s))
        check.refuse("has a face of the side \"" + name + "\" at " + place(face->center()) + " on the " +
                     (turns ? "turning" : "standing") + " part; it belongs to the " +
                     (turns ? "standing" : "turning") + " one. Mend the names, or the physical volumes.");
      ++found_sides[name];
      face->set_boundary_id(s);
      Face copy{s, face->center(), {}, face->measure()};
      for (int c = 0; c < 4; ++c) copy.corner[c] = face->vertex(c);
      faces.push_back(copy);
    }
  std::vector<std::string> needed;
  for (const std::string& name : values(DeviceMesh::side_names()))
    if (is_needed(name)) needed.push_back(name);
  check.require_all(names_of(found_sides), needed, "physical surface");
  if (nameless > 0)
    check.refuse("has " + std::to_string(nameless) +
                 " faces of its boundary in no physical surface, the first at " + first +
                 ". Name them; if the two parts or two cells should touch there, merge their nodes.");
  check.holes(faces);
  check.vacuum_face(faces);
  check.front(faces);
  check.revolution(faces);
  coarse.copy_triangulation(mesh.coarse);
}

double DeviceMesh::face_cell() const {
  double least = 1e300;
  for (const auto& cell : coarse.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == disc)
        least = std::min(least, cell->measure() / cell->face(f)->measure());
  return least;
}

void check_device_mesh(const DeviceGeometry& g, const DeviceMeshParameters& p, MPI_Comm comm) {
  try {
    SlidingInterface<3>(device_domain(g, p, comm), 1);
  } catch (const InputError& error) {
    const std::string what = error.what();
    if (p.file.empty() || what.find(p.file) != std::string::npos) throw;
    throw InputError("Mesh file \"" + p.file + "\": " + what);
  }
}

void write_device_mesh(const DeviceMesh& mesh, double unit, std::ostream& out) {
  write_gmsh(mesh.coarse, mesh.sides, DeviceMesh::part_names(), unit, out);
}

}  // namespace seedflow
