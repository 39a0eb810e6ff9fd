#pragma once

#include "seedflow/seeds/contact_state.h"

namespace seedflow {

/// Elastic tangential displacement of a contact with partial slip. The traction of Mindlin's contact slips at
/// its rim long before the contact slides as a whole, so it is softer than 8 G* a:
///   dT = 8 G* a (1 - sigma (T - T*)/(mu N - sigma T*))^(1/3) ds
/// with sigma = 1 where T grows along its direction and -1 where it falls, T* its value when sigma changed
/// last (Walton & Braun 1986, J. Rheol. 30, 949-980, doi:10.1122/1.549893; for a constant load the first
/// loading is exactly that of Mindlin & Deresiewicz 1953, J. Appl. Mech. 20, 327-344). When the contact
/// grows, T stays; when it shrinks, T shrinks with the radius (Thornton, Cummins & Cleary 2013, Powder
/// Technol. 233, 30-46, doi:10.1016/j.powtec.2012.08.012).
///
/// `strength` in [0, 1]: 0 leaves the contact without slip, 1 is the model.
///
/// The memory holds q = -T/(8 G* a) [m] as its spring and, in `mark`, sigma (1 + q*): 0 before the first
/// step.
template <class Real>
SEEDFLOW_INLINE void partial_slip(double strength, const ContactKinematics<Real>& c,
                                  const VectorOf<Real>& slip, Real normal_speed, Real limit_displacement,
                                  double step, VectorOf<Real>& spring, Real& mark) {
  const Real zero{}, one = zero + 1.0, tiny = zero + 1e-30;
  // The overlap one step ago tells the contact radius one step ago.
  const Real overlap = lane_max(c.overlap, tiny);
  const Real before = lane_max(c.overlap + step * normal_speed, zero);
  const Real grown = (1 - strength) + strength * lane_sqrt(lane_min(before / overlap, one));
  spring = grown * turned_into_plane<Real>(spring, c.normal);

  const Real direction = select(mark < zero, -one, one);
  Real turning = select(mark == zero, zero, grown * (mark * direction - 1.0));
  const Real size = norm(spring);
  const Real moving = select(dot(spring, slip) < zero, -one, one);
  turning = select(moving == direction, turning, size);
  const Real left = lane_max(limit_displacement - moving * turning, tiny);
  const Real part = lane_max(lane_min(1.0 - moving * (size - turning) / left, one), zero);
  const VectorOf<Real> next = spring + (step * ((1 - strength) + strength * lane_cbrt(part))) * slip;
  // Through zero: what fell along the old direction grows along the new one.
  const Real through = select(dot(spring, next) < zero, -one, one);
  mark = through * moving * (1.0 + through * turning);
  spring = next;
}

}  // namespace seedflow
