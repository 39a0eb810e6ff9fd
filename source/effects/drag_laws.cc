#include "seedflow/effects/drag_laws.h"

#include <algorithm>
#include <cmath>

#include "seedflow/base/nearest_name.h"

namespace seedflow {
namespace {

double schiller_naumann_low(double re) {
  return 1 + 0.15 * std::pow(re, 0.687);
}

double stokes(double, double, double) {
  return 1;
}

// The correlation meets C_D = 0.44 at Re = 989.2; taking the larger of the two switches exactly there.
double schiller_naumann(double re, double, double) {
  return std::max(schiller_naumann_low(re), 0.44 * re / 24);
}

double as_printed(double re, double, double) {
  if (re <= 0.5) return 1;
  if (re <= 1000) return schiller_naumann_low(re);
  return 0.44 * re / 24;
}

// C_D = (0.63 + 4.8 / sqrt(Re))^2, written so that it is regular at Re = 0 (where it gives 0.96 of Stokes).
double dallavalle(double re) {
  const double root = 0.63 * std::sqrt(re) + 4.8;
  return root * root / 24;
}

// With the superficial slip U = eps |u - v| these laws read F = pi/8 d^2 rho C_D(Re_U) U^2 eps^-b.
double with_voidage_exponent(double re_superficial, double eps, double exponent) {
  return dallavalle(re_superficial) * std::pow(eps, 1 - exponent);
}

double transition(double re_superficial) {
  const double x = 1.5 - std::log10(std::max(re_superficial, 1e-30));
  return std::exp(-0.5 * x * x);
}

double di_felice(double re, double eps, double) {
  return with_voidage_exponent(eps * re, eps, 3.7 - 0.65 * transition(eps * re));
}

double rong(double re, double eps, double) {
  const double exponent = 2.65 * (eps + 1) - (5.3 - 3.5 * eps) * eps * eps * transition(eps * re);
  return with_voidage_exponent(eps * re, eps, exponent);
}

// k = beta V / (1 - eps); f = k / (3 pi mu d) = beta d^2 / (18 mu (1 - eps)).
double gidaspow(double re, double eps, double phi) {
  const double re_superficial = eps * re;
  if (eps >= 0.8) {
    const double lone =
        re_superficial < 1000 ? schiller_naumann_low(re_superficial) : 0.44 * re_superficial / 24;
    return lone * std::pow(eps, -2.65);
  }
  return (150 * (1 - eps) / (eps * phi * phi) + 1.75 * re / phi) / 18;
}

double haider_levenspiel(double re, double, double phi) {
  const double a = std::exp(2.3288 + phi * (-6.4581 + phi * 2.4486));
  const double b = 0.0964 + 0.5565 * phi;
  const double c = std::exp(4.905 + phi * (-13.8944 + phi * (18.4222 - phi * 10.2599)));
  const double d = std::exp(1.4681 + phi * (12.2584 + phi * (-20.7322 + phi * 15.8855)));
  return 1 + a * std::pow(re, b) + re / 24 * c * re / (re + d);
}

std::vector<DragLaw> make_laws() {
  return {
      {"Schiller-Naumann",
       "C_D = max(24/Re (1 + 0.15 Re^0.687), 0.44), continuous (the two meet at Re = 989)",
       "Schiller & Naumann (1933), Z. Ver. Dtsch. Ing. 77, 318-320; see Clift, Grace & Weber (1978), "
       "Bubbles, Drops "
       "and Particles",
       "lone sphere, Re < 1000 within 5 % (0.44 up to 2e5 within 13 %)", 1000, 1, false, false,
       &schiller_naumann},
      {"As printed",
       "C_D = 24/Re for Re <= 0.5; 24/Re (1 + 0.15 Re^0.687) for 0.5 < Re <= 1000; 0.44 above. Jumps by 9 % "
       "at 0.5 "
       "and 0.4 % at 1000",
       "Xu et al. (2024), Agriculture 14, 752, Eqs. 6 and 7", "lone sphere, Re < 2e5", 2e5, 1, false, false,
       &as_printed},
      {"Stokes", "C_D = 24/Re", "Stokes (1851), Trans. Camb. Phil. Soc. 9, 8", "lone sphere, Re < 0.1", 0.1,
       1, false, false, &stokes},
      {"Di Felice",
       "F = pi/8 rho d^2 C_D U^2 eps^-b, U = eps |u - v|, Re_U = rho d U/mu, C_D = (0.63 + "
       "4.8/sqrt(Re_U))^2, "
       "b = 3.7 - 0.65 exp(-(1.5 - log10 Re_U)^2/2)",
       "Di Felice (1994), Int. J. Multiphase Flow 20, 153-159, doi:10.1016/0301-9322(94)90011-6",
       "fixed and fluidised beds of spheres, eps 0.4 to 1, all Re", 2e5, 0.4, true, false, &di_felice},
      {"Gidaspow",
       "eps >= 0.8 (Wen & Yu): beta = 3/4 C_D eps (1 - eps) rho |u - v|/d eps^-2.65, C_D(Re_U) of "
       "Schiller-Naumann, "
       "0.44 for Re_U >= 1000; eps < 0.8 (Ergun): beta = 150 (1 - eps)^2 mu/(eps (phi d)^2) + 1.75 (1 - eps) "
       "rho "
       "|u - v|/(phi d); k = beta V/(1 - eps). Jumps at eps = 0.8",
       "Gidaspow (1994), Multiphase Flow and Fluidization; Wen & Yu (1966), Chem. Eng. Prog. Symp. Ser. 62, "
       "100; "
       "Ergun (1952), Chem. Eng. Prog. 48, 89",
       "packed to dilute beds, eps 0.4 to 1", 2e5, 0.4, true, true, &gidaspow},
      {"Rong", "as Di Felice with b = 2.65 (eps + 1) - (5.3 - 3.5 eps) eps^2 exp(-(1.5 - log10 Re_U)^2/2)",
       "Rong, Dong & Yu (2013), Chem. Eng. Sci. 99, 44-58, doi:10.1016/j.ces.2013.05.036",
       "packed beds of equal spheres, eps 0.37 to 1, Re_U 0.01 to 3000 (lattice-Boltzmann simulations)", 3000,
       0.37, true, false, &rong},
      {"Haider-Levenspiel",
       "C_D = 24/Re (1 + A Re^B) + C/(1 + D/Re); A = exp(2.3288 - 6.4581 phi + 2.4486 phi^2), B = 0.0964 + "
       "0.5565 "
       "phi, C = exp(4.905 - 13.8944 phi + 18.4222 phi^2 - 10.2599 phi^3), D = exp(1.4681 + 12.2584 phi - "
       "20.7322 "
       "phi^2 + 15.8855 phi^3)",
       "Haider & Levenspiel (1989), Powder Technol. 58, 63-70, doi:10.1016/0032-5910(89)80008-7",
       "lone isometric body of sphericity phi 0.67 to 1, Re < 2.6e5", 2.6e5, 1, false, true,
       &haider_levenspiel},
  };
}

}  // namespace

const std::vector<DragLaw>& drag_laws() {
  static const std::vector<DragLaw> laws = make_laws();
  return laws;
}

std::vector<std::string> drag_law_names() {
  std::vector<std::string> names;
  for (const auto& law : drag_laws()) names.push_back(law.name);
  return names;
}

const DragLaw& drag_law(const std::string& name) {
  for (const auto& law : drag_laws())
    if (law.name == name) return law;
  throw InputError("There is no drag law '" + name + "'. " + suggestion(name, drag_law_names(), "drag law"));
}

double slip_reynolds(const FlowAtBody& flow) {
  return flow.density * flow.diameter * norm(slip(flow)) / flow.viscosity;
}

double drag_coefficient(const DragLaw& law, double reynolds, double void_fraction, double sphericity) {
  return 24 * law.factor(reynolds, void_fraction, sphericity) / reynolds;
}

double momentum_exchange(const DragLaw& law, const FlowAtBody& flow) {
  return 3 * M_PI * flow.viscosity * flow.diameter *
         law.factor(slip_reynolds(flow), flow.void_fraction, flow.sphericity);
}

double terminal_speed(const DragLaw& law, double force, double diameter, double density, double viscosity,
                      double sphericity) {
  const double stokes = 3 * M_PI * viscosity * diameter;
  const auto excess = [&](double v) {
    return stokes * law.factor(density * diameter * v / viscosity, 1, sphericity) * v - force;
  };
  double low = 0, high = force / stokes;
  while (excess(high) < 0) high *= 2;  // laws slightly below Stokes at small Re
  for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace seedflow
