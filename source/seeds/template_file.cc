#include "seedflow/seeds/template_file.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <ostream>
#include <set>
#include <sstream>

#include "seedflow/base/error.h"
#include "seedflow/seeds/template_bonds.h"

namespace seedflow {
namespace {

/// The shortest digits that read back as the same number, whatever the locale.
std::string digits(double a) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, a).ptr};
}

void write_row(std::ostream& out, const std::string& keyword, std::initializer_list<double> numbers) {
  out << keyword;
  for (const double a : numbers) out << ',' << digits(a);
  out << '\n';
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

class Reader {
 public:
  Reader(std::istream& in, const std::string& file) : in(in), file(file) {}

  SeedTemplate read() {
    seed.name = file;
    std::string text;
    while (std::getline(in, text)) {
      ++line;
      text = trimmed(text);
      if (text.empty() || text[0] == '#') continue;
      const auto comma = text.find(',');
      keyword = trimmed(text.substr(0, comma));
      if (comma == std::string::npos) fail("'" + text + "' is not a row 'keyword,value,...'.");
      take(text.substr(comma + 1));
    }
    if (in.bad()) throw InputError(file + ": reading stopped after line " + std::to_string(line) + ".");
    complete();
    return std::move(seed);
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw InputError(file + ", line " + std::to_string(line) + ": " + reason);
  }

  std::vector<double> numbers(const std::string& values, std::size_t least, std::size_t most) const {
    std::vector<double> found;
    std::istringstream rest(values + ",");  // so that an empty last value is seen, too
    for (std::string value; std::getline(rest, value, ',');) {
      value = trimmed(value);
      double a = 0;
      const char* const end = value.data() + value.size();
      const auto [stop, error] = std::from_chars(value.data(), end, a);
      if (error != std::errc() || stop != end || !std::isfinite(a))
        fail("'" + value + "' is not a finite number (row '" + keyword + "').");
      found.push_back(a);
    }
    if (found.size() < least || found.size() > most) {
      std::string allowed = std::to_string(least);
      if (most != least) allowed += " or " + std::to_string(most);
      fail("row '" + keyword + "' has " + std::to_string(found.size()) + " numbers, it needs " + allowed +
           ".");
    }
    return found;
  }

  int index(double a) const {
    if (a != std::floor(a) || a < 0 || a > 1e9)
      fail("'" + digits(a) + "' is not the number of a sub-sphere (0, 1, ...).");
    return static_cast<int>(a);
  }

  double positive(double a, const std::string& what) const {
    if (!(a > 0)) fail(what + " " + digits(a) + " must be positive.");
    return a;
  }

  void take(const std::string& values) {
    const bool repeatable = keyword == "sphere" || keyword == "bond";
    if (!repeatable && !seen.insert(keyword).second) fail("row '" + keyword + "' is given twice.");
    if (keyword == "name") {
      seed.name = trimmed(values);
    } else if (keyword == "volume") {
      seed.seed_volume = positive(numbers(values, 1, 1)[0], "volume");
    } else if (keyword == "density") {
      seed.seed_density = positive(numbers(values, 1, 1)[0], "density");
    } else if (keyword == "semi-axes") {
      const auto a = numbers(values, 3, 3);
      for (const double each : a) positive(each, "semi-axis");
      seed.seed_semi_axes = {a[0], a[1], a[2]};
    } else if (keyword == "centre") {
      const auto x = numbers(values, 3, 3);
      seed.seed_centre = {x[0], x[1], x[2]};
    } else if (keyword == "frame") {
      const auto q = numbers(values, 4, 4);
      seed.seed_frame = {q[0], {q[1], q[2], q[3]}};
      const double length = std::sqrt(q[0] * q[0] + norm_square(seed.seed_frame.v));
      if (std::abs(length - 1) > 1e-9)
        fail("the quaternion of 'frame' must have length 1, it has " + digits(length) + ".");
    } else if (keyword == "sphere") {
      take_sphere(numbers(values, 4, 5));
    } else if (keyword == "bond") {
      const auto b = numbers(values, 3, 3);
      seed.bond.push_back({index(b[0]), index(b[1]), positive(b[2], "bond radius")});
      bond_line.push_back(line);
    } else {
      fail("'" + keyword +
           "' is unknown; allowed: name, volume, density, semi-axes, centre, frame, sphere, bond.");
    }
  }

  void take_sphere(const std::vector<double>& s) {
    seed.position.push_back({s[0], s[1], s[2]});
    seed.radius.push_back(positive(s[3], "sub-sphere radius"));
    if (s.size() == 5) seed.relative_density.push_back(positive(s[4], "relative density"));
    if (!seed.relative_density.empty() && seed.relative_density.size() != seed.position.size())
      fail("a relative density (fifth number) must be in all rows 'sphere' or in none.");
  }

  void complete() {
    for (const char* needed : {"volume", "density"})
      if (!seen.count(needed))
        throw InputError(file + ": the row '" + std::string(needed) + ",...' is missing.");
    if (seed.position.empty())
      throw InputError(file + ": there is no row 'sphere,...'; at least one is needed.");
    if (!seen.count("semi-axes")) {
      const double r = std::cbrt(0.75 * seed.seed_volume / M_PI);
      seed.seed_semi_axes = {r, r, r};
    }
    std::set<std::pair<int, int>> pairs;
    for (std::size_t b = 0; b < seed.bond.size(); ++b) {
      const auto [first, second, radius] = seed.bond[b];
      line = bond_line[b];
      if (first >= second || second >= seed.n_spheres())
        fail("a bond joins two sub-spheres first < second out of 0.." + std::to_string(seed.n_spheres() - 1) +
             ".");
      if (!pairs.emplace(first, second).second) fail("this bond is given twice.");
    }
    seed.finish();
    try {
      require_one_piece(seed);
    } catch (const InputError& error) {
      throw InputError(file + ": " + error.what());
    }
  }

  std::istream& in;
  const std::string& file;
  SeedTemplate seed;
  std::string keyword;
  int line = 0;
  std::set<std::string> seen;
  std::vector<int> bond_line;
};

}  // namespace

void write_template(std::ostream& out, const SeedTemplate& seed) {
  if (seed.name.find_first_of("\r\n") != std::string::npos || seed.name != trimmed(seed.name))
    throw InputError("Seed template '" + seed.name +
                     "': a name must be one line without blanks at its ends.");
  out << "# seedflow seed template; SI units\n";
  out << "name," << seed.name << '\n';
  out << "# of the real seed: volume [m3], density [kg/m3], semi-axes [m], centre [m] and frame (unit "
         "quaternion w, x, y, "
         "z: the shape's axes -> the axes of this file)\n";
  write_row(out, "volume", {seed.seed_volume});
  write_row(out, "density", {seed.seed_density});
  write_row(out, "semi-axes", {seed.seed_semi_axes.x, seed.seed_semi_axes.y, seed.seed_semi_axes.z});
  write_row(out, "centre", {seed.seed_centre.x, seed.seed_centre.y, seed.seed_centre.z});
  const Quaternion& q = seed.seed_frame;
  write_row(out, "frame", {q.w, q.v.x, q.v.y, q.v.z});
  out << "# sphere: x [m], y [m], z [m], radius [m], relative density [1] (only if they differ)\n";
  for (int i = 0; i < seed.n_spheres(); ++i) {
    const Vec3& x = seed.position[i];
    if (seed.relative_density.empty())
      write_row(out, "sphere", {x.x, x.y, x.z, seed.radius[i]});
    else
      write_row(out, "sphere", {x.x, x.y, x.z, seed.radius[i], seed.relative_density[i]});
  }
  out << "# bond: first, second (sub-spheres in the order above, from 0), radius [m]\n";
  for (const Bond& b : seed.bond)
    write_row(out, "bond", {static_cast<double>(b.first), static_cast<double>(b.second), b.radius});
}

void write_template(const std::string& file, const SeedTemplate& seed) {
  std::ofstream out(file);
  write_template(out, seed);
  out.close();
  if (!out)
    throw RunError("Seed template: cannot write '" + file +
                   "'; check the folder, its rights and free space.");
}

SeedTemplate read_template(std::istream& in, const std::string& file) {
  return Reader(in, file).read();
}

SeedTemplate read_template(const std::string& file) {
  std::ifstream in(file);
  if (!in)
    throw InputError("Seed template: cannot open '" + file + "'; give the name of a readable CSV file.");
  return read_template(in, file);
}

}  // namespace seedflow
