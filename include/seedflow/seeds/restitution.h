#pragma once

namespace seedflow {

/// Viscoelastic spheres (Brilliantov, Spahn, Hertzsch & Poeschel 1996, Phys. Rev. E 53, 5382-5392,
/// doi:10.1103/PhysRevE.53.5382): F_n = 4/3 E* sqrt(R*) (delta^(3/2) + 3/2 A delta^(1/2) d delta/dt), A [s] a
/// constant of the two materials. Their restitution falls with the impact speed v,
///   e = 1 - 1.15344 b + 0.79826 b^2 - ...,  b = 3/2 A/T,  T = (m*^2/(K^2 v))^(1/5),  K = 4/3 E* sqrt(R*)
/// (series: Schwager & Poeschel 1998, Phys. Rev. E 57, 650-654, doi:10.1103/PhysRevE.57.650; as there the
/// contact ends when the surfaces part, the force may pull shortly before).

/// Time scale T of an impact [s].
double impact_time(double reduced_radius, double reduced_mass, double young, double speed);

/// e as a function of A/T, by integrating the impact numerically (relative error below 1e-9).
double viscoelastic_restitution(double dissipation_over_time);

/// The inverse: A/T of a given restitution in (0, 1].
double dissipation_of(double restitution);

}  // namespace seedflow
