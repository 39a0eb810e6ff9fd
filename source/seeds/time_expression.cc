#include "seedflow/seeds/time_expression.h"

#include <muParser.h>

#include <cmath>

#include "seedflow/base/error.h"

namespace seedflow {

struct TimeExpression::Implementation {
  mutable double t = 0;
  mu::Parser parser;
};

TimeExpression::TimeExpression(const std::string& text)
    : written(text), implementation(std::make_unique<Implementation>()) {
  try {
    implementation->parser.DefineConst("pi", M_PI);
    implementation->parser.DefineVar("t", &implementation->t);
    implementation->parser.SetExpr(text);
    implementation->parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    throw InputError("the expression \"" + text + "\" does not read: " + error.GetMsg() +
                     " Write a function of t (time in s), for example 0.01 * sin(2*pi*50*t).");
  }
}

TimeExpression::~TimeExpression() = default;

double TimeExpression::value(double t) const {
  implementation->t = t;
  const double v = implementation->parser.Eval();
  if (!std::isfinite(v))
    throw RunError("The expression \"" + written + "\" is not a finite number at t = " + std::to_string(t) +
                   " s.");
  return v;
}

double TimeExpression::rate(double t) const {
  const double h = 1e-6;
  return (8 * (value(t + h) - value(t - h)) - (value(t + 2 * h) - value(t - 2 * h))) / (12 * h);
}

}  // namespace seedflow
