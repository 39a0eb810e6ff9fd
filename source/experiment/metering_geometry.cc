// The parametric metering device as files: walls (STL), air mesh (Gmsh) and a .prm that uses them.

#include <cmath>
#include <iostream>
#include <set>
#include <sstream>

#include "seedflow/base/together.h"
#include "seedflow/experiment/granular_report.h"
#include "seedflow/experiment/metering_map.h"
#include "seedflow/output/folder.h"
#include "seedflow/seeds/stl_writer.h"
#include "seedflow/seeds/wall_polygons.h"

namespace seedflow {

namespace {

namespace fs = std::filesystem;

constexpr double mm = 1e-3;

/// The disc with its holes as polygons of 24 sides and equal area: the plane of the mesh, extruded.
TriangleSurface disc_triangles(const DeviceGeometry& device) {
  DeviceGeometry g = device;  // a chamber as wide as the disc
  g.chamber_inner_radius = 0.2 * device.pitch_radius;
  g.chamber_outer_radius = device.disc_radius;
  DeviceMeshParameters sizes;
  sizes.hole_sides = 6, sizes.hole_rings = sizes.mouth_rings = 1;
  sizes.largest_cell = 0.05 * device.disc_radius;
  sizes.growth = 2;
  const HolePlane plane = seed_chamber_plane(g, sizes);

  const double r = device.hole_radius();
  std::vector<std::array<double, 2>> levels = {{0, r + device.chamfer}};  // z, radius of the holes
  if (device.chamfer > 0) levels.push_back({device.chamfer, r});
  levels.push_back({device.thickness, r});
  TriangleSurface s;
  for (const auto& [z, radius] : levels)
    for (const HolePlane::Node& n : plane.nodes) {
      const auto x = n.fixed + radius * n.by_radius;
      s.vertex.push_back({x[0], x[1], z});
    }
  const int n_nodes = static_cast<int>(plane.nodes.size()),
            back = (static_cast<int>(levels.size()) - 1) * n_nodes;
  const auto faces = [&](int a, int b, int c) {
    s.triangle.push_back({back + a, back + b, back + c});
    s.triangle.push_back({a, c, b});
  };
  std::set<std::pair<int, int>> edges;
  for (const HolePlane::Quad& q : plane.quads) {
    if (q.in_hole) continue;
    const int ring[] = {static_cast<int>(q.node[0]), static_cast<int>(q.node[1]), static_cast<int>(q.node[3]),
                        static_cast<int>(q.node[2])};
    faces(ring[0], ring[1], ring[2]);
    faces(ring[0], ring[2], ring[3]);
    for (int c = 0; c < 4; ++c) edges.insert({ring[c], ring[(c + 1) % 4]});
  }
  const int front_centre = static_cast<int>(s.vertex.size());
  s.vertex.push_back({0, 0, 0});
  s.vertex.push_back({0, 0, device.thickness});
  for (const auto& [a, b] : edges) {
    if (edges.count({b, a})) continue;  // inside
    if (plane.nodes[a].fixed.norm() < 1.5 * g.chamber_inner_radius) {
      s.triangle.push_back({back + b, back + a, front_centre + 1});
      s.triangle.push_back({a, b, front_centre});
      continue;
    }
    for (int l = 0; l < back; l += n_nodes) {
      s.triangle.push_back({l + a, l + b, l + n_nodes + b});
      s.triangle.push_back({l + a, l + n_nodes + b, l + n_nodes + a});
    }
  }
  return s;
}

TriangleSurface triangles_of(const std::vector<Wall>& walls) {
  TriangleSurface s;
  for (const Wall& wall : walls) {
    const PolygonSurface p = wall_polygons(wall, 0, {-1, -1, -1}, {1, 1, 1});
    const int first = static_cast<int>(s.vertex.size());
    s.vertex.insert(s.vertex.end(), p.vertex.begin(), p.vertex.end());
    for (const auto& polygon : p.polygon)
      for (std::size_t c = 2; c < polygon.size(); ++c)
        s.triangle.push_back({first + polygon[0], first + polygon[c - 1], first + polygon[c]});
  }
  return s;
}

std::string stl(const TriangleSurface& surface) {
  std::ostringstream text;
  write_stl(surface, mm, text);
  return text.str();
}

}  // namespace

int write_metering_geometry(const RunOptions& options) {
  MeteringInput input(options);
  Parameters parameters;
  input.declare(parameters);
  parameters.read(options.prm, options.overrides);
  Metering& metering = input.experiment;
  metering.surfaces = DeviceSurfaces();  // what the entries make, whatever files they name
  metering.resolved.mesh.file.clear();
  metering.check(parameters);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  together(MPI_COMM_WORLD, [&] {
    if (rank != 0) return;
    const fs::path folder = options.output;
    prepare_output_folder(folder);
    const DeviceMesh mesh(metering.device, metering.resolved.mesh);
    std::ostringstream text;
    write_device_mesh(mesh, mm, text);
    write_file_atomically(folder / "device.msh", text.str());
    write_file_atomically(folder / "disc.stl", stl(disc_triangles(metering.device)));
    std::vector<Wall> chamber, blade;
    metering.add_chamber(chamber, 0);
    metering.add_blade(blade, 0);
    write_file_atomically(folder / "housing.stl", stl(triangles_of(chamber)));
    if (!blade.empty()) write_file_atomically(folder / "blade.stl", stl(triangles_of(blade)));
    write_file_atomically(folder / "parametric.prm", as_text(parameters));
    write_file_atomically(
        folder / "own_device.prm",
        std::string("# The device of parametric.prm from files. Replace those that you have.\n"
                    "include parametric.prm\n\n"
                    "subsection Device\n"
                    "  set Disc surface    = disc.stl\n"
                    "  set Housing surface = housing.stl\n") +
            (blade.empty() ? "" : "  set Blade surface   = blade.stl\n") +
            "  set Surface unit    = 1 mm\n"
            "end\n\n"
            "# Used by the computed air: Air/Model = resolved.\n"
            "subsection Device mesh\n"
            "  set File = device.msh\n"
            "  set Unit = 1 mm\n"
            "end\n");
    std::cout << "written into " << folder.string() << ": device.msh (" << mesh.coarse.n_active_cells()
              << " cells), disc.stl, housing.stl" << (blade.empty() ? "" : ", blade.stl")
              << ", own_device.prm, which uses them\n";
  });
  return exit_done;
}

}  // namespace seedflow
