#include "seedflow/coupling/momentum_ledger.h"

#include "seedflow/base/binary.h"

namespace seedflow {

double MomentumLedger::relative(const Vec3& imbalance) const {
  return scale > 0 ? norm(imbalance) / scale : norm(imbalance);
}
double MomentumLedger::seeds_error() const {
  return relative(sum.seeds_change - sum.gravity - sum.buoyancy - sum.walls - sum.from_air - sum.still_air);
}
double MomentumLedger::air_error() const {
  return relative(sum.air_change - sum.sides - sum.from_seeds);
}
double MomentumLedger::exchange_error() const {
  return relative(sum.from_air + sum.from_seeds + sum.on_the_way);
}
double MomentumLedger::total_error() const {
  return relative(sum.seeds_change + sum.air_change + sum.on_the_way - sum.gravity - sum.buoyancy -
                  sum.walls - sum.sides - sum.still_air);
}

void MomentumLedger::save(std::ostream& out) const {
  write_binary(out, sum);
  write_binary(out, scale);
}
void MomentumLedger::load(std::istream& in) {
  read_binary(in, sum);
  read_binary(in, scale);
}

}  // namespace seedflow
