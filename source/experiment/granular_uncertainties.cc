#include "seedflow/experiment/granular_uncertainties.h"

#include <set>

#include "seedflow/base/error.h"

namespace seedflow {

namespace {

/// Pairs stand in the order of Materials/Names, whichever that is.
std::string pair_entry(const Parameters& p, const std::string& a, const std::string& b,
                       const std::string& entry) {
  const std::string path = "Contact pairs/" + a + " - " + b + "/" + entry;
  try {
    p.value(path);
    return path;
  } catch (const InputError&) {
    return "Contact pairs/" + b + " - " + a + "/" + entry;
  }
}

}  // namespace

std::vector<UsualUncertainty> granular_uncertainties(const Parameters& p,
                                                     const std::vector<std::string>& wall_materials) {
  // The mean over many seeds by callipers and balance; an inclined plane repeats to a tenth.
  std::vector<UsualUncertainty> all = {{"seed diameter", "Seeds/Diameter", 0.01, true, false},
                                       {"seed density", "Seeds/Density", 0.01, true, false}};
  const std::string seed = p.value("Seeds/Material");
  std::set<std::string> partners = {seed};
  for (const std::string& entry : wall_materials) partners.insert(p.value(entry));
  for (const std::string& partner : partners)
    all.push_back({"friction of " + seed + " and " + partner, pair_entry(p, seed, partner, "Static friction"),
                   0.1, true, false});
  return all;
}

}  // namespace seedflow
