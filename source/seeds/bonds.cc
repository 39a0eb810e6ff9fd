#include "seedflow/seeds/bonds.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "seedflow/base/binary.h"
#include "seedflow/base/parameters.h"
#include "seedflow/seeds/copy_lane.h"
#include "seedflow/seeds/seed_share.h"

namespace seedflow {

void BondParameters::declare(Parameters& p) {
  const auto section = p.section("Bonds", "Parallel bonds between the sub-spheres of a seed.");
  p.number("Normal stiffness", normal_stiffness, "N/m3", Range::positive(), "k_n per unit area of the bond.");
  p.number("Shear stiffness", shear_stiffness, "N/m3", Range::positive(), "k_t per unit area of the bond.");
  p.number("Normal strength", normal_strength, "Pa", Range::positive(),
           "Critical tensile stress of a bond. 1e20 and above: bonds never break.");
  p.number("Shear strength", shear_strength, "Pa", Range::positive(),
           "Critical shear stress of a bond. 1e20 and above: bonds never break.");
  p.number("Damping ratio", damping_ratio, "1", Range::between(0, 1),
           "Viscous damping of each bond as a fraction of the critical damping of its two sub-spheres.");
  p.choice("Form", form, {"total", "incremental"},
           "total: forces from the present shape of the seed, conserves energy; incremental: summed step by "
           "step.");
  p.choice("Moments", moments, {"standard", "printed"},
           "standard: twist k_t J, bending k_n I; printed: twist k_n J, bending k_t J/2 as in the source "
           "paper's Eq. 1.");
}

Bonds::Bonds(const SeedTemplate& model, const BondParameters& bond_parameters)
    : parameters(bond_parameters), n_spheres(model.n_spheres()) {
  for (const Bond& bond : model.bond) {
    Constants c{};
    c.first = std::min(bond.first, bond.second);
    c.second = std::max(bond.first, bond.second);
    const Vec3 d = model.position[c.second] - model.position[c.first];
    const double length2 = norm_square(d);
    if (!(length2 > 0))
      throw InputError("Template '" + model.name + "': sub-spheres " + std::to_string(c.first) + " and " +
                       std::to_string(c.second) +
                       " are bonded but have the same centre. Move one of them or remove the bond.");
    for (int k = 0; k < 3; ++k) c.half[k] = 0.5 * d[k];
    c.length = std::sqrt(length2);
    c.radius = bond.radius;
    c.area = M_PI * bond.radius * bond.radius;
    c.inertia = 0.25 * c.area * bond.radius * bond.radius;
    c.shear = parameters.shear_stiffness * c.area;
    c.normal = parameters.normal_stiffness * c.area;
    c.stretch = (c.normal - c.shear) / length2;
    const bool printed = parameters.moments == "printed";
    c.bend = (printed ? parameters.shear_stiffness : parameters.normal_stiffness) * c.inertia;
    c.twist = (printed ? parameters.normal_stiffness : parameters.shear_stiffness) * 2 * c.inertia;
    c.twist_extra = (c.twist - c.bend) * 4 / length2;
    const auto reduced = [](double a, double b) { return a * b / (a + b); };
    const double mass = reduced(model.sphere_mass[c.first], model.sphere_mass[c.second]);
    const double inertia = reduced(model.sphere_inertia[c.first], model.sphere_inertia[c.second]);
    c.damping[0] = 2 * parameters.damping_ratio * std::sqrt(c.normal * mass);
    c.damping[1] = 2 * parameters.damping_ratio * std::sqrt(c.bend * inertia);
    constants.push_back(c);
  }
  std::stable_sort(constants.begin(), constants.end(),
                   [](const Constants& a, const Constants& b) { return a.first < b.first; });
}

void Bonds::add_block() {
  dissipated.push_back(0);
  if (parameters.can_break()) intact.insert(intact.end(), constants.size(), broadcast(1.0));
  if (parameters.form == "incremental") history.insert(history.end(), constants.size(), History{});
}

void Bonds::rearrange(const std::vector<int>& from) {
  const std::vector<Lanes> old_intact = std::move(intact);
  const std::vector<History> old_history = std::move(history);
  intact.clear(), history.clear();
  dissipated_before = dissipated_energy();
  dissipated.clear();
  const auto copy = [&](auto& now, const auto& old, std::size_t k) {
    if (!now.empty())
      copy_lane(&now[k / lane_width * n_bonds()], k % lane_width, &old[from[k] / lane_width * n_bonds()],
                from[k] % lane_width, n_bonds());
  };
  for (std::size_t k = 0; k < from.size(); ++k) {
    if (k % lane_width == 0) add_block();
    copy(intact, old_intact, k);
    copy(history, old_history, k);
  }
}

double Bonds::dissipated_energy() const {
  return std::accumulate(dissipated.begin(), dissipated.end(), dissipated_before);
}

void Bonds::gather(const SeedShare& share, int t) {
  if (!intact.empty()) share.gather(t, intact, n_bonds());
  if (!history.empty()) share.gather(t, history, n_bonds());
  share.gather(t, dissipated, 1);
}

int Bonds::n_broken(int b, int lane) const {
  int sum = 0;
  for (int k = 0; k < n_bonds(); ++k) sum += is_broken(b, k, lane);
  return sum;
}

bool Bonds::is_broken(int b, int bond, int lane) const {
  return !intact.empty() && intact[static_cast<std::size_t>(b) * n_bonds() + bond][lane] == 0.0;
}

double Bonds::largest_frequency(const SeedTemplate& model) const {
  // Power iteration on M^-1 K, K the stiffness linearised about the reference shape. The estimate rises
  // monotonically towards omega_max^2; after 400 rounds it is within about one per cent.
  const int n = model.n_spheres();
  std::vector<Vec3> u(n), turn(n), force(n), torque(n);
  for (int i = 0; i < n; ++i) {
    u[i] = {std::sin(12.9898 * i + 1), std::sin(78.233 * i + 2), std::sin(37.719 * i + 3)};
    turn[i] = (1.0 / model.radius[i]) * Vec3{u[i].y, u[i].z, u[i].x};
  }
  double value = 0;
  for (int round = 0; round < 400 && !constants.empty(); ++round) {
    std::fill(force.begin(), force.end(), Vec3{});
    std::fill(torque.begin(), torque.end(), Vec3{});
    for (const Constants& c : constants) {
      const Vec3 half{c.half[0], c.half[1], c.half[2]}, e = 2.0 * half;
      const Vec3 gap = u[c.second] - u[c.first] - cross(turn[c.first] + turn[c.second], half);
      const Vec3 pull = c.shear * gap + c.stretch * dot(gap, e) * e;
      const Vec3 rotation = turn[c.second] - turn[c.first];
      const Vec3 moment = c.bend * rotation + c.twist_extra * dot(rotation, half) * half;
      force[c.first] -= pull, force[c.second] += pull;
      torque[c.first] -= moment + cross(half, pull);
      torque[c.second] += moment - cross(half, pull);
    }
    double square = 0, product = 0;
    for (int i = 0; i < n; ++i) {
      square += model.sphere_mass[i] * norm_square(u[i]) + model.sphere_inertia[i] * norm_square(turn[i]);
      product += dot(u[i], force[i]) + dot(turn[i], torque[i]);
    }
    value = product / square;
    double size = 0;
    for (int i = 0; i < n; ++i) {
      u[i] = force[i] / model.sphere_mass[i], turn[i] = torque[i] / model.sphere_inertia[i];
      size = std::max(size, norm(u[i]));
    }
    if (!(size > 0)) break;
    for (int i = 0; i < n; ++i) u[i] /= size, turn[i] /= size;
  }
  return std::sqrt(value);
}

std::size_t Bonds::bytes() const {
  return constants.capacity() * sizeof(Constants) + intact.capacity() * sizeof(Lanes) +
         history.capacity() * sizeof(History);
}

void Bonds::save(std::ostream& out) const {
  write_binary(out, intact);
  write_binary(out, history);
  write_binary(out, dissipated);
  write_binary(out, dissipated_before);
}

void Bonds::load(std::istream& in) {
  read_binary(in, intact);
  read_binary(in, history);
  read_binary(in, dissipated);
  read_binary(in, dissipated_before);
}

}  // namespace seedflow
