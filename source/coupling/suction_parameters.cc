#include "seedflow/coupling/suction_parameters.h"

#include <cmath>

namespace seedflow {

void SuctionParameters::declare(Parameters& p) {
  {
    const auto section = p.section("Air", "The air in the device.");
    p.number("Density", density, "kg/m3", Range::positive(), "Of the air.");
    p.number("Dynamic viscosity", viscosity, "Pa s", Range::positive(), "Of the air.");
    p.number("Step", air_step, "s", Range::positive(),
             "The air's forces on the seeds are held over this time.");
  }
  {
    const auto section = p.section("Suction", "What draws the air through the holes.");
    p.number("Vacuum", vacuum, "Pa", Range::any(),
             "Pressure of the vacuum chamber against the surroundings, negative; with a loss in fan or line "
             "the pressure at no flow.");
    p.number(
        "Discharge coefficient", hole_coefficient, "1", Range{0, 1, true},
        "Of an open hole. Sharp-edged holes as long as wide have about 0.75 to 0.8, chamfered ones more.");
    p.number("Gap coefficient", gap_coefficient, "1", Range{0, 1, true},
             "Discharge coefficient of the gap between a hole's rim and a seed.");
    p.number("Seat roughness", seat_roughness, "m", Range::positive(),
             "Gap that is left under a seated seed.");
    p.flag("Seeds block holes", blocking,
           "true: a seed in front of a hole narrows it, and the pressure below it holds the seed. false: the "
           "air flows as if no seed were there and holds it by drag alone, as with unresolved drag laws.");
    p.number(
        "Fan flow", fan_flow, "m3/s", Range::non_negative(),
        "Flow at which the fan gives no pressure any more; its curve is a parabola. 0: the same pressure "
        "at any flow.");
  }
  const auto section = p.section("Effects", "");
  {
    const auto inner = p.section("Seal leak", "Air that enters between disc and vacuum chamber.");
    p.number("Strength", leak_strength, "1", Range::between(0, 2), "0: tight.");
    p.number("Gap", leak_gap, "m", Range::positive(), "Between disc and the chamber's rim, all around.");
  }
  {
    const auto inner = p.section("Suction line loss", "Pressure lost between fan and vacuum chamber.");
    p.number("Strength", line_strength, "1", Range::between(0, 2), "0: none.");
    p.number("Loss coefficient", line_loss, "1", Range::positive(), "Of hose, bends and fittings together.");
    p.number("Diameter", line_diameter, "m", Range::positive(), "Of the hose.");
  }
  {
    const auto inner = p.section("Disc vibration", "The disc shakes along its axis.");
    p.number("Strength", vibration_strength, "1", Range::between(0, 2), "0: none.");
    p.number("Amplitude", vibration_amplitude, "m", Range::positive(), "Half the travel.");
    p.number("Frequency", vibration_frequency, "1/s", Range::positive(), "Of the sinusoid.");
  }
}

void SuctionParameters::check(const Parameters& p, double largest_step) const {
  if (!(vacuum <= 0))
    p.reject("Suction/Vacuum", "a vacuum is below the surroundings",
             "use a negative pressure, such as -3 kPa");
  if (vacuum < -7500)
    p.reject("Suction/Vacuum",
             "the air would flow faster than a third of the speed of sound; the laws are those of "
             "incompressible air",
             "use a pressure above -7.5 kPa");
  if (air_step > largest_step)
    p.reject("Air/Step", "a seed falls into a hole within a millisecond",
             largest_step > 5e-4 ? "use at most 1 ms" : "use at most 0.5 ms");
}

double leak_area(const SuctionParameters& p, const DeviceGeometry& device) {
  const double arc = device.vacuum_to - device.vacuum_from;
  const double rim = (device.vacuum_inner_radius + device.vacuum_outer_radius) * arc +
                     2 * (device.vacuum_outer_radius - device.vacuum_inner_radius);
  return p.gap_coefficient * p.leak_strength * p.leak_gap * rim;
}

SuctionBalance suction_balance(const SuctionParameters& p, double area) {
  const double area_square = 2 / p.density * area * area;  // Q^2 per dp
  double lost = 0;                                         // pressure per Q^2
  if (p.fan_flow > 0) lost += -p.vacuum / (p.fan_flow * p.fan_flow);
  if (p.line_strength > 0) {
    const double line = M_PI / 4 * p.line_diameter * p.line_diameter;
    lost += p.line_strength * p.line_loss * 0.5 * p.density / (line * line);
  }
  SuctionBalance balance;
  balance.drop = -p.vacuum / (1 + lost * area_square);
  balance.flow = std::sqrt(area_square * balance.drop);
  return balance;
}

}  // namespace seedflow
