#include "seedflow/base/units.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "seedflow/base/error.h"

namespace seedflow {
namespace {

constexpr double pi = 3.14159265358979323846;

std::string message(const std::string& text, const std::string& unit) {
  try {
    to_si(text, unit);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// Decimal prefixes are exact: the result is the double nearest to the decimal number, as if typed in SI.
TEST(Units, DecimalFactorsAreRoundedOnce) {
  EXPECT_EQ(to_si("4 mm", "m"), 0.004);
  EXPECT_EQ(to_si("0.3 mm", "m"), 0.0003);
  EXPECT_EQ(to_si("0.3mm", "m"), 0.0003);
  EXPECT_EQ(to_si("1.1e2 um", "m"), 0.00011);
  EXPECT_EQ(to_si("0.05 mPa s", "Pa s"), 0.00005);
  EXPECT_EQ(to_si("18.2 uPa s", "Pa s"), 18.2e-6);
  EXPECT_EQ(to_si("18.2 \xc2\xb5Pa s", "Pa s"), 18.2e-6);
  EXPECT_EQ(to_si("-3 kPa", "Pa"), -3000);
  EXPECT_EQ(to_si("1.2 g/cm3", "kg/m3"), 1200);
  EXPECT_EQ(to_si("1.2 g/cm^3", "kg/m3"), 1200);
  EXPECT_EQ(to_si("7 %", "1"), 0.07);
  EXPECT_EQ(to_si("3 GPa", "N/m2"), 3e9);
  EXPECT_EQ(to_si("2 mbar", "Pa"), 200);
  EXPECT_EQ(to_si("5 m s-2", "m/s2"), 5);
  EXPECT_EQ(to_si("5 J/(kg K)", "m2/s2/K"), 5);
}

TEST(Units, OtherFactors) {
  EXPECT_DOUBLE_EQ(to_si("30 rpm", "rad/s"), pi);
  EXPECT_DOUBLE_EQ(to_si("10 deg", "rad"), pi / 18);
  EXPECT_DOUBLE_EQ(to_si("2 rev/min", "rad/s"), 4 * pi / 60);
  EXPECT_DOUBLE_EQ(to_si("36 km/h", "m/s"), 10);
  EXPECT_DOUBLE_EQ(to_si("6 L/min", "m3/s"), 1e-4);
  EXPECT_DOUBLE_EQ(to_si("20 degC", "K"), 293.15);
  EXPECT_DOUBLE_EQ(to_si("20 \xC2\xB0"
                         "C",
                         "K"),
                   293.15);
  EXPECT_DOUBLE_EQ(to_si("180 \xC2\xB0", "rad"), to_si("180 deg", "rad"));
  EXPECT_DOUBLE_EQ(to_si("3 -", "1"), 3);
  EXPECT_DOUBLE_EQ(to_si("3 N m/deg", "N m/rad"), 3 * 180 / pi);
}

TEST(Units, BareNumbersAreInTheEntrysUnit) {
  EXPECT_EQ(to_si("0.02", "Pa s"), 0.02);
  EXPECT_EQ(to_si(" +1e-3 ", "m"), 0.001);
}

TEST(Units, OtherDimensionIsRefusedWithWhatIsAccepted) {
  EXPECT_EQ(message("4 kg", "m"),
            "the unit \"kg\" does not measure the same as m. Accepted: m, mm, um, cm, km.");
  EXPECT_EQ(message("4 1/s", "rad/s"),
            "the unit \"1/s\" does not measure the same as rad/s. Accepted: rad/s, deg/s, rpm.");
  EXPECT_EQ(message("4 m", "1"),
            "the unit \"m\" does not measure the same as a pure number. Accepted: 1, %.");
}

TEST(Units, UnknownUnitNamesTheNearest) {
  EXPECT_NE(message("4 rpn", "rad/s").find("Nearest valid unit: \"rpm\"."), std::string::npos);
  EXPECT_NE(message("4 rpn", "rad/s").find("Accepted: rad/s, deg/s, rpm."), std::string::npos);
  EXPECT_NE(message("4 m/", "m/s").find("missing at its end"), std::string::npos);
  EXPECT_NE(message("4 J/(kg K", "m").find("parenthesis is not closed"), std::string::npos);
  EXPECT_NE(message("4 N/m s", "N s/m").find("two ways"), std::string::npos);
  EXPECT_NE(message("4 degC/s", "K").find("write K"), std::string::npos);
  EXPECT_NE(message("4 m^x", "m").find("'^'"), std::string::npos);
}

TEST(Units, WhatIsNotANumberIsRefused) {
  for (const char* text : {"", " ", "abc", "mm", "1.2.3", "1-2", "4e", "--4", "0x10 m", "nan", "inf", "-inf",
                           "1e999", "1e300 Gm 3", "1,2", "4 m m_"})
    EXPECT_THROW(to_si(text, "m"), InputError) << text;
  EXPECT_EQ(message("1e999", "m"), "\"1e999\" is too large or too small");
  EXPECT_EQ(message("1e308 km", "m"), "\"1e308 km\" is too large or too small");
}

TEST(Units, ExactTextIsReadBackAsTheSameDouble) {
  for (const double x :
       {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -0.0, 299792458.0, 4 * std::atan(1.0)}) {
    const double back = std::strtod(exact_text(x).c_str(), nullptr);
    EXPECT_EQ(back, x);
    EXPECT_EQ(std::signbit(back), std::signbit(x));
  }
  EXPECT_EQ(exact_text(0.1), "0.1");
}

// Every unit offered in a message must be one which is accepted.
TEST(Units, AcceptedUnitsAreAccepted) {
  for (const char* si :
       {"m", "kg", "s", "m/s", "Pa", "Pa s", "rad/s", "rad", "1", "kg/m3", "N/m", "m3/s", "K", "kg/s"}) {
    const auto names = accepted_units(si);
    EXPECT_EQ(names.front(), si);
    for (const std::string& name : names) EXPECT_NO_THROW(to_si("1 " + name, si)) << name;
  }
  const auto names = accepted_units("Pa s");
  EXPECT_NE(std::find(names.begin(), names.end(), "mPa s"), names.end());
}

}  // namespace
}  // namespace seedflow
