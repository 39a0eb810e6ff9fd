#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "seedflow/base/device_geometry.h"
#include "seedflow/coupling/coupling_parameters.h"
#include "seedflow/coupling/momentum_ledger.h"
#include "seedflow/coupling/suction_parameters.h"
#include "seedflow/coupling/suction_step.h"
#include "seedflow/fluid/fluid.h"
#include "seedflow/mesh/device_mesh.h"

namespace seedflow {

/// How the air of a metering device is computed: sections "Air" and "Device mesh".
struct ResolvedSuctionParameters {
  ResolvedSuctionParameters();

  DeviceMeshParameters mesh;
  std::string rotor = "sliding";  ///< sliding: the mesh turns with the disc; frozen: it lags
  double ramp = 5e-3;       ///< the vacuum grows from nothing during this time; delay of fan and line [s]
  FluidParameters flow;     ///< turbulence and solvers; the rest is set by the device
  double resistance = 1e7;  ///< of seeds near holes, see SolidSeeds [kg/(m3 s)]
  double margin = 0.5;      ///< by which they are larger, in local cells [1]
  double reach = 0;         ///< of the holes within which seeds are solid [m]; 0: two hole diameters
  double frozen_angle = 0;  ///< rotor frozen: the mesh is moved on after this angle [rad]; 0: a pitch

  void declare(Parameters& parameters);
};

/// Seeds and the computed air of a metering disc: the flow through seed chamber, holes and vacuum chamber on
/// the mesh of DeviceMesh, with
///   * seeds solid near the mouths of the holes that face the vacuum (SolidSeeds): they shut the holes,
///     and the pressure holds them;
///   * elsewhere drag and whatever effects the run has on seeds or sub-spheres (Coupling/Drag on), with
///     the kernel of the cell that contains them (Eq. 8) and a void fraction of 1, in model B: no
///     pressure gradient acts on them but the hydrostatic one. (The void fraction of Eq. 5 has no meaning
///     in cells smaller than a sub-sphere, and a kernel of a seed's width reaches through the disc.)
///   * seeds outside the mesh, below the unloading point, in still air.
///
/// The pressure at the back of the vacuum chamber is that in balance with fan, suction line and leak
/// (SuctionBalance). Disc and seeds enter it with their effective area S = Q sqrt(rho/(2 dp)), which the air
/// in fan and line follows with the delay `ramp`: dS/dt = (Q sqrt(rho/(2 dp)) - S)/ramp. (A line of 1 m and
/// 25 mm takes some rho L Q/(A dp) = 4 ms; without delay the balance jumps to and fro from step to step.)
/// What leaks in between disc and chamber is not in the mesh: it joins the flow at the chamber's back. A disc
/// that shakes along its axis shakes for the seeds; the mesh stands, so the travel must be small against a
/// cell.
///
/// Rotor "sliding": every step the mesh turns to the disc's angle at the end of the step. Rotor "frozen": the
/// mesh stands, the flow is that relative to the turning disc (multiple reference frames), and seeds meet the
/// air of the place where they are relative to the disc; when the disc has turned by `frozen_angle` more than
/// the mesh, the mesh is moved on. The ends of the vacuum's arc are off by less than that angle.
class ResolvedSuction {
 public:
  /// \param disc the wall that turns about the z axis and carries the holes. The seeds must be all there at
  /// the first advance().
  ResolvedSuction(const ResolvedSuctionParameters& parameters, const SuctionParameters& suction,
                  const DeviceGeometry& device, const CouplingParameters& coupling, int disc,
                  EffectSet& effects, const Vec3& gravity, MPI_Comm comm);
  ~ResolvedSuction();

  /// Advances air and seeds, in steps of the air. Returns the impulse of the air on all seeds [N s].
  Vec3 advance(Dem& dem, double duration);

  const std::vector<SeedLoad>& seed_loads() const { return mean_load; }
  const SuctionBalance& chamber() const { return balance; }
  double air_drawn() const { return tally.volume; }
  double work() const { return tally.energy; }

  struct Tally {
    double volume = 0, energy = 0;  ///< drawn [m3], work of the vacuum on it [J]
    double mass_error = 0;          ///< every pressure test function, worst step
    double interface_error = 0;     ///< out of rotor against into stator, worst step
    double volume_error = 0;        ///< through the sides, worst step
    double courant = 0;             ///< largest
    double steps = 0, seconds_in_air = 0, seconds_in_seeds = 0, seconds = 0;  ///< CPU, this rank
    double pressure_iterations = 0, momentum_iterations = 0;                  ///< of all steps
    double most_outside = 0;                                                  ///< bodies outside the mesh
  };
  const Tally& totals() const { return tally; }
  double n_cells() const;
  bool is_frozen() const { return parameters.rotor == "frozen"; }
  /// Zero before the first step.
  MomentumLedger momentum() const;
  /// CPU seconds of the air by part of its step, and of turning; this rank.
  FluidStatistics statistics() const;

  /// Along the axis of a hole, from the seed chamber into the vacuum chamber. Collective.
  struct AxisPoint {
    double z = 0, pressure = 0, velocity = 0;  ///< [m], [Pa], axial [m/s]
  };
  std::vector<AxisPoint> along_hole(int hole) const;

  /// As Fluid::write; "" before the first step.
  std::string write(const std::string& directory, const std::string& name, unsigned int counter) const;

  void save(std::ostream& out) const;
  void load(std::istream& in);

 private:
  struct Scene;
  void begin(Dem& dem);
  void step(Dem& dem, double dt);
  /// Of the vacuum chamber below ambient at a time [s], for the delayed area [Pa].
  double chamber_drop(double time) const;

  ResolvedSuctionParameters parameters;
  SuctionParameters suction;
  DeviceGeometry device;
  CouplingParameters coupling;
  int disc;
  EffectSet& effects;
  Vec3 gravity;
  MPI_Comm comm;
  std::unique_ptr<Scene> scene;  ///< from the first step on
  std::string saved;             ///< what load() read, until then
  std::vector<SeedLoad> seed_load, mean_load;
  SuctionBalance balance;  ///< of the last step, flow with leak
  double disc_area = 0;    ///< S, delayed [m2]
  Tally tally;
};

}  // namespace seedflow
