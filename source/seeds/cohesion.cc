#include "seedflow/seeds/cohesion.h"

#include <cmath>

namespace seedflow {

CohesionNumbers CohesionNumbers::jkr(double work_of_adhesion, double young) {
  CohesionNumbers n;
  n.adhesion = work_of_adhesion;
  n.root = std::sqrt(2 * M_PI * work_of_adhesion / young);
  return n;
}

CohesionNumbers CohesionNumbers::capillary(double surface_tension, double contact_angle, double volume) {
  CohesionNumbers n;
  const double length = std::cbrt(volume), wider = 1 + contact_angle / 2;
  n.tension = 2 * M_PI * surface_tension * std::cos(contact_angle);
  n.inverse_root = 1 / std::sqrt(volume);
  n.rupture = wider * length;
  n.rupture_curvature = 0.1 * wider * length * length;
  return n;
}

double jkr_neck(const CohesionNumbers& n, double reduced_radius) {
  return 0.75 * n.root * std::cbrt(0.25 * n.root * reduced_radius);
}

double bridge_rupture(const CohesionNumbers& n, double reduced_radius) {
  return n.rupture + n.rupture_curvature / (2 * reduced_radius);
}

}  // namespace seedflow
