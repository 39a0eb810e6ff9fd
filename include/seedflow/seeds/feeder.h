#pragma once

#include <iosfwd>
#include <string>
#include <variant>
#include <vector>

#include "seedflow/base/quaternion.h"
#include "seedflow/base/vector.h"
#include "seedflow/seeds/seed_template.h"

namespace seedflow {

class Dem;
class PortableRandom;

/// Where and how seeds are placed. Bounding spheres of fed seeds touch neither each other, nor seeds that are
/// there, nor walls.
struct RandomPlaces {
  Vec3 low, high;    ///< the box that holds the whole seeds [m]
  int tries = 2000;  ///< for one seed before the feeder counts as full
};
/// A simple cubic lattice from the bottom up, its places shifted at random.
struct LatticePlaces {
  Vec3 low, high;      ///< [m]
  double spacing = 0;  ///< [m]; 0: the closest at which seeds do not touch
  double jitter = 0;   ///< of what is left between neighbours, 0 to 1
};
/// Given places, taken one after the other.
struct ListedPlaces {
  struct Place {
    Vec3 centre;
    Quaternion orientation;
    Vec3 velocity;
    int group = 0;
    int kind = 0;
  };
  std::vector<Place> place;
};

struct FeederParameters {
  std::string name;
  std::variant<RandomPlaces, LatticePlaces, ListedPlaces> places;

  struct Kind {
    int seed_template = 0;  ///< number in the Dem
    double radius = 0;      ///< of its bounding sphere [m]
    double mass = 0;        ///< [kg]
    double share = 1;       ///< of the number of seeds; shares need not add up to 1

    Kind(int number, const SeedTemplate& model, double share = 1)
        : seed_template(number), radius(model.bounding_radius), mass(model.mass), share(share) {}
  };
  std::vector<Kind> kinds;
  std::vector<double> group_shares{1};  ///< group g + first_group has share g of the number
  int first_group = 0;

  int number = 0;    ///< of seeds; 0: see mass
  double mass = 0;   ///< of all seeds [kg]: as near as whole seeds allow
  double rate = 0;   ///< [kg/s]; 0: all at once
  double start = 0;  ///< [s]
  /// Feeding at once what does not fit at once: goes on as room permits instead of being an error.
  bool as_room_permits = false;
  double patience = 1;  ///< so long may a feeder that should feed find no room [s]

  Vec3 velocity;  ///< of new seeds [m/s]
  bool random_orientation = true;
  int random_number = 1;
};

/// Feeds seeds into a Dem. Seed k of a feeder has its template, group and orientation from random stream k of
/// the random number, so they do not depend on when and where it found room.
///
/// Errors: InputError if a feeder that shall feed all at once is full, or a listed place is not free;
/// RunError if a feeder finds no room for longer than its patience. Both say how many seeds were fed.
class Feeder {
 public:
  /// InputError for contradictory parameters.
  explicit Feeder(FeederParameters parameters);

  /// Feeds what is due at the Dem's time; call it before the first advance() and after every one. Returns the
  /// number of new seeds.
  int feed(Dem& dem);

  bool finished() const { return done; }
  int n_fed() const { return fed; }
  double mass_fed() const { return fed_mass; }
  const FeederParameters& settings() const { return parameters; }

  void save(std::ostream& out) const;
  void load(std::istream& in);

 private:
  struct Candidate {
    int kind, group;
    Quaternion orientation;
  };
  class Room;
  Candidate candidate(int number) const;
  bool is_due(const Dem& dem, double mass) const;
  bool place(Dem& dem, Room& room, const Candidate& seed);
  [[noreturn]] void full(const Dem& dem, const std::string& reason) const;

  FeederParameters parameters;
  int fed = 0;
  long calls = 0;  ///< of feed(); begins the random stream of places
  double fed_mass = 0, last_success = 0;
  double largest_radius = 0;
  int next_site = 0;
  bool begun = false, done = false;
};

/// Reads listed places from a CSV file with the columns x, y, z and, if wanted, qw, qx, qy, qz (template to
/// lab), vx, vy, vz, group, kind (number in the feeder's list of templates, from 0). InputError with file and
/// line.
ListedPlaces read_places(const std::string& file);

}  // namespace seedflow
