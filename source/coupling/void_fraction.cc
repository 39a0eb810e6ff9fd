#include "seedflow/coupling/void_fraction.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "seedflow/coupling/kernels.h"

namespace seedflow {

VoidFraction::VoidFraction(const CouplingParameters& p, double kernel_width, const PointLocation<3>& location,
                           const QuadratureLayout<3>& layout, MPI_Comm comm)
    : parameters(p),
      sigma(kernel_width),
      location(location),
      layout(layout),
      comm(comm),
      exchange(layout, comm) {}

void VoidFraction::compute(const Bodies& bodies, const std::vector<Vec3>& body_position,
                           const std::vector<Vec3>& sphere_position, double time, std::vector<double>& eps) {
  eps.assign(layout.size(), 1.0);
  if (!active()) return;

  exchange.clear();
  std::vector<double> taken;  // minus the volume of each row
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (parameters.void_fraction_kernel == "gaussian") {
      add_gaussian_kernel(exchange, location, layout, body_position[b], sigma);
      exchange.next();
      taken.push_back(-bodies[b].solid_volume);
    } else {
      for (int s = bodies[b].first; s < bodies[b].last; ++s) {
        add_sampled_kernel(exchange, location, layout, sphere_position[s], bodies.sphere_radius(s),
                           parameters.samples);
        exchange.next();
        taken.push_back(-bodies[b].solid_volume * bodies.share(s));
      }
    }
  }
  const std::vector<long> outside = exchange.normalize();
  if (!outside.empty() && parameters.outside == "stop") {
    std::ostringstream text;
    text << "A seed has left the air's mesh at t = " << time
         << " s.\nRemedy: close the domain with walls for the seeds, make it larger, or set Coupling/Outside "
            "the "
            "mesh = still air.";
    throw RunError(text.str());
  }
  for (const long row : outside) taken[row] = 0;
  exchange.deposit(taken, eps);

  double solid = 0, lowest = 1;
  std::size_t where = 0;
  for (std::size_t q = 0; q < eps.size(); ++q) {
    solid += (1.0 - eps[q]) * layout.JxW[q];
    if (eps[q] < lowest) lowest = eps[q], where = q;
  }
  solid = dealii::Utilities::MPI::sum(solid, comm);
  double volume = 0;
  for (const double v : taken) volume -= v;
  error = volume > 0 ? std::abs(solid / volume - 1.0) : 0.0;

  const double lowest_of_all = dealii::Utilities::MPI::min(lowest, comm);
  if (lowest_of_all < parameters.lowest_void_fraction) {
    std::ostringstream text;
    text << "The void fraction falls to " << lowest_of_all << " at t = " << time << " s";
    if (lowest == lowest_of_all) text << ", near " << layout.position[where] << " m";
    text << "; the lower bound is " << parameters.lowest_void_fraction
         << " (Coupling/Lowest void fraction).\nRemedy: 'Void fraction kernel = gaussian' with a larger "
            "'Kernel "
            "width', or larger cells. Volume is never cut off.";
    throw RunError(text.str());
  }
}

std::vector<Vec3> VoidFraction::average(const Bodies& bodies,
                                        const std::vector<dealii::Tensor<1, 3>>& field) const {
  if (!active()) return std::vector<Vec3>(bodies.size());
  const std::vector<Vec3> of_rows = exchange.average(field);
  if (of_rows.size() == bodies.size()) return of_rows;
  std::vector<Vec3> result(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (int s = bodies[b].first; s < bodies[b].last; ++s) result[b] += bodies.share(s) * of_rows[s];
  return result;
}

}  // namespace seedflow
