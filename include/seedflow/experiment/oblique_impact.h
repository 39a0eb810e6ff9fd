#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "seedflow/experiment/experiment.h"
#include "seedflow/seeds/material_table.h"

namespace seedflow {

/// One sphere flies against a plane at given angles, without gravity and air.
struct ObliqueImpactParameters {
  std::string name = "oblique impact";
  std::string measurements, conditions;  ///< files to compare with; both or none
  std::string sphere_material = "seed", plane_material = "photosensitive resin";
  double diameter = 4e-3;      ///< [m]
  double speed = 1;            ///< of the sphere's centre before the impact [m/s]
  std::vector<double> angles;  ///< between path and normal, in (0, pi/2) [rad]
  double steps_per_contact = 2e3;
  MaterialTable materials;

  /// With the materials that the file names.
  ObliqueImpactParameters(const std::string& prm, const std::vector<std::string>& overrides);
  /// Binds to the members: must not move until Parameters::read.
  void declare(Parameters& parameters);
  void check(const Parameters& parameters);

  const ContactProperties& contact() const;
};

/// What is seen after the impact.
struct Rebound {
  double tangential_restitution = 0;  ///< tangential speed of the centre after / before [1]
  double normal_restitution = 0;      ///< [1]
  double angle = 0;                   ///< between path and normal [rad]
  double spin = 0;                    ///< [rad/s], positive: rolling forward
  double contact_time = 0;            ///< [s]
  double overlap = 0;                 ///< largest [m]
};

/// Errors: RunError if the sphere does not leave the plane.
Rebound oblique_impact(const ObliqueImpactParameters& parameters, double angle);

/// The angle [rad] beyond which the sphere slides from first touch to the end: there the tangential
/// restitution is 1 - mu (1 + e)/tan(angle) and the spin 5 mu (1 + e) v cos(angle)/d.
double sliding_angle(const ObliqueImpactParameters& parameters);
Rebound sliding_rebound(const ObliqueImpactParameters& parameters, double angle);

/// Experiment "oblique impact": a sweep of angles, beside measured ones (Kharaz, Gorham & Salman 2001).
int run_oblique_impact(const RunOptions& options);
void describe_oblique_impact(std::ostream& out, const std::string& section);
/// Quantities tangential restitution, rebound spin, rebound angle over the impact angle.
Observer oblique_impact_observer();

}  // namespace seedflow
