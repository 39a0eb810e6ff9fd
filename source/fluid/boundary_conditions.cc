#include "seedflow/fluid/boundary_conditions.h"

#include <deal.II/base/function_parser.h>

#include <memory>
#include <vector>

#include "seedflow/base/error.h"
#include "seedflow/base/nearest_name.h"
#include "seedflow/base/trim.h"

namespace seedflow {

namespace {

const std::map<std::string, BoundaryType>& type_names() {
  static const std::map<std::string, BoundaryType> names = {
      {"wall", BoundaryType::wall},
      {"moving wall", BoundaryType::moving_wall},
      {"rotor wall", BoundaryType::rotor_wall},
      {"velocity inlet", BoundaryType::velocity_inlet},
      {"pressure outlet", BoundaryType::pressure_outlet},
      {"pressure inlet", BoundaryType::pressure_inlet},
      {"slip", BoundaryType::slip},
      {"periodic", BoundaryType::periodic}};
  return names;
}

/// Splits at separators outside parentheses.
std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  int depth = 0;
  for (const char c : text) {
    depth += (c == '(') - (c == ')');
    if (c == separator && depth == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  for (auto& part : parts) part = trim(part);
  return parts;
}

template <int dim>
std::shared_ptr<dealii::FunctionParser<dim>> expression(const std::vector<std::string>& values,
                                                        const std::string& where) {
  auto f = std::make_shared<dealii::FunctionParser<dim>>(values.size());
  try {
    f->initialize(dim == 2 ? "x,y,t" : "x,y,z,t", values, {{"pi", 3.14159265358979323846}}, true);
    for (unsigned int c = 0; c < values.size(); ++c) f->value(dealii::Point<dim>(), c);
  } catch (const std::exception&) {
    std::string all;
    for (const auto& v : values) all += (all.empty() ? "" : ", ") + v;
    throw InputError(where + ": \"" + all + "\" is not a list of numbers or expressions in x, y, " +
                     (dim == 3 ? "z, " : "") + "t.");
  }
  return f;
}

}  // namespace

template <int dim>
BoundaryConditions<dim> parse_boundary_conditions(const std::string& text, const Domain<dim>& domain) {
  const std::string entry = "Air/Boundary conditions";
  BoundaryConditions<dim> result;
  std::unique_ptr<BoundaryCondition<dim>> rest;
  for (const std::string& part : split(text, ';')) {
    if (part.empty()) continue;
    const auto colon = part.find(':');
    if (colon == std::string::npos)
      throw InputError(entry + ": \"" + part + "\" is not of the form `side: type, values`.");
    const std::string name = trim(part.substr(0, colon));
    std::vector<std::string> words = split(part.substr(colon + 1), ',');
    const std::string type = words.front();
    words.erase(words.begin());
    const std::string where = entry + ", side \"" + name + "\"";
    const auto found = type_names().find(type);
    if (found == type_names().end()) {
      std::vector<std::string> valid;
      for (const auto& [n, t] : type_names()) valid.push_back(n);
      throw InputError(where + ": unknown type \"" + type + "\". " + suggestion(type, valid, "type"));
    }
    BoundaryCondition<dim> c;
    c.type = found->second;
    std::size_t needed = 0;
    if (c.type == BoundaryType::moving_wall || c.type == BoundaryType::velocity_inlet) {
      needed = dim;
      if (words.size() == needed) {
        const auto f = expression<dim>(words, where);
        c.velocity = [f](const dealii::Point<dim>& x, double t) {
          f->set_time(t);
          dealii::Tensor<1, dim> u;
          for (int d = 0; d < dim; ++d) u[d] = f->value(x, d);
          return u;
        };
      }
    } else if (c.type == BoundaryType::pressure_outlet || c.type == BoundaryType::pressure_inlet) {
      needed = 1;
      if (words.empty()) words = {"0"};
      if (words.size() == needed) {
        const auto f = expression<dim>(words, where);
        c.pressure = [f](const dealii::Point<dim>& x, double t) {
          f->set_time(t);
          return f->value(x);
        };
      }
    }
    if (words.size() != needed)
      throw InputError(where + ": type \"" + type + "\" needs " + std::to_string(needed) + " values, " +
                       std::to_string(words.size()) + " given.");
    if (name == "*") {
      rest = std::make_unique<BoundaryCondition<dim>>(c);
      continue;
    }
    domain.side(name);
    if (!result.emplace(name, c).second) throw InputError(where + ": given twice. Keep one of them.");
  }
  if (rest)
    for (const auto& [id, name] : domain.sides())
      if (!domain.is_periodic(name) && !domain.is_sliding(name)) result.emplace(name, *rest);
  check_boundary_conditions(result, domain);
  return result;
}

template <int dim>
void check_boundary_conditions(const BoundaryConditions<dim>& conditions, const Domain<dim>& domain) {
  for (const auto& [name, c] : conditions) {
    domain.side(name);
    const std::string where = "Air/Boundary conditions, side \"" + name + "\"";
    if (domain.is_sliding(name))
      throw InputError(where + ": slides along another side, where rotor and stator meet. Leave it out.");
    if (c.type == BoundaryType::rotor_wall && !domain.rotor())
      throw InputError(where + ": a rotor wall, but no part of the mesh turns. Use a moving wall.");
    if ((c.type == BoundaryType::periodic) != domain.is_periodic(name))
      throw InputError(where +
                       (c.type == BoundaryType::periodic
                            ? ": periodic, but the domain does not join it to another side. Name the pair in "
                              "Air domain/Periodic sides."
                            : ": joined to another side by Air domain/Periodic sides; its type must be "
                              "periodic or left out."));
    const bool needs_velocity = c.type == BoundaryType::moving_wall || c.type == BoundaryType::velocity_inlet;
    const bool needs_pressure =
        c.type == BoundaryType::pressure_outlet || c.type == BoundaryType::pressure_inlet;
    if ((needs_velocity && !c.velocity) || (needs_pressure && !c.pressure))
      throw InputError(where + ": its " + (needs_velocity ? "velocity" : "pressure") + " is missing.");
  }
  for (const auto& [id, name] : domain.sides())
    if (!conditions.count(name) && !domain.is_periodic(name) && !domain.is_sliding(name))
      throw InputError("Air/Boundary conditions: side \"" + name + "\" has no condition. Add `" + name +
                       ": wall` (or another type), or `*: wall` for all sides "
                       "not named.");
}

template BoundaryConditions<2> parse_boundary_conditions(const std::string&, const Domain<2>&);
template BoundaryConditions<3> parse_boundary_conditions(const std::string&, const Domain<3>&);
template void check_boundary_conditions(const BoundaryConditions<2>&, const Domain<2>&);
template void check_boundary_conditions(const BoundaryConditions<3>&, const Domain<3>&);

}  // namespace seedflow
