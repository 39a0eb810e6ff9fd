#include "seedflow/seeds/seed_share.h"

#include <algorithm>
#include <tuple>

namespace seedflow {
namespace {

void wait(std::vector<MPI_Request>& requests) {
  if (!requests.empty()) MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  requests.clear();
}

}  // namespace

SeedShare::SeedShare(MPI_Comm communicator) : comm(communicator) {
  // Programs and tests that never start MPI compute alone.
  int running = 0;
  MPI_Initialized(&running);
  if (!running) return;
  MPI_Comm_rank(comm, &own_rank);
  MPI_Comm_size(comm, &ranks);
}

void SeedShare::divide(const std::vector<SeedStore>& stores, std::vector<Block> blocks) {
  std::sort(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) {
    return std::tie(a.key, a.store, a.block) < std::tie(b.key, b.store, b.block);
  });
  double total = 0;
  for (const Block& b : blocks) total += b.cost;
  std::vector<double> cost(ranks, 0.0);
  bound.assign(stores.size(), std::vector<int>(ranks + 1, 0));
  double passed = 0;
  for (const Block& b : blocks) {
    const int rank = std::min(ranks - 1, static_cast<int>((passed + 0.5 * b.cost) / total * ranks));
    for (int r = rank + 1; r <= ranks; ++r) bound[b.store][r] = b.block + 1;
    passed += b.cost;
    cost[rank] += b.cost;
  }
  dearest = total > 0 ? *std::max_element(cost.begin(), cost.end()) / (total / ranks) : 1.0;
}

void SeedShare::extend(const std::vector<SeedStore>& stores) {
  bound.resize(stores.size(), std::vector<int>(ranks + 1, 0));
  for (std::size_t t = 0; t < stores.size(); ++t) bound[t][ranks] = stores[t].n_blocks();
}

int SeedShare::owner(int t, int block) const {
  return static_cast<int>(std::upper_bound(bound[t].begin() + 1, bound[t].end() - 1, block) -
                          bound[t].begin()) -
         1;
}

void SeedShare::gather_bytes(int t, char* data, std::size_t bytes_per_block) const {
  if (ranks == 1) return;
  // Whole blocks are counted, so that the counts stay small.
  MPI_Datatype block;
  MPI_Type_contiguous(static_cast<int>(bytes_per_block), MPI_BYTE, &block);
  MPI_Type_commit(&block);
  std::vector<int> counts(ranks), offsets(ranks);
  for (int r = 0; r < ranks; ++r) offsets[r] = bound[t][r], counts[r] = bound[t][r + 1] - bound[t][r];
  MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, data, counts.data(), offsets.data(), block, comm);
  MPI_Type_free(&block);
}

std::vector<char> SeedShare::concatenated(const char* data, std::size_t size) const {
  if (ranks == 1) return {data, data + size};
  const int own = static_cast<int>(size);
  std::vector<int> counts(ranks), offsets(ranks + 1, 0);
  MPI_Allgather(&own, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
  for (int r = 0; r < ranks; ++r) offsets[r + 1] = offsets[r] + counts[r];
  std::vector<char> all(offsets[ranks]);
  MPI_Allgatherv(data, own, MPI_BYTE, all.data(), counts.data(), offsets.data(), MPI_BYTE, comm);
  return all;
}

void SeedShare::add_up(std::vector<Vec3>& values) const {
  if (ranks > 1)
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(3 * values.size()), MPI_DOUBLE, MPI_SUM,
                  comm);
}

void SeedShare::add_up(ListSizes& sizes) const {
  static_assert(sizeof(ListSizes) == 6 * sizeof(double));
  if (ranks > 1) MPI_Allreduce(MPI_IN_PLACE, &sizes, 6, MPI_DOUBLE, MPI_SUM, comm);
}

void GhostExchange::set(const SeedShare& share, const Numbering& numbering,
                        const std::vector<SeedStore>& stores, const ContactBodies& bodies,
                        const PairList& pairs) {
  for (auto& requests : sending) wait(requests);
  neighbours.clear();
  if (share.n_ranks() == 1) return;
  const auto owner = [&](int entry) {
    const int sphere = bodies.sphere[entry], t = numbering.store_of_sphere(sphere);
    return share.owner(t, (sphere - numbering.first_sphere[t]) / stores[t].n_spheres() / lane_width);
  };
  std::vector<std::vector<int>> send(share.n_ranks()), receive(share.n_ranks());
  for (int k = 0; k < pairs.n_listed(); ++k) {
    const int a = pairs.first_entries()[k], b = pairs.second_entries()[k];
    const int owner_a = owner(a), owner_b = owner(b);
    if (owner_a == owner_b) continue;
    const bool first_is_own = owner_a == share.rank();
    const int other = first_is_own ? owner_b : owner_a;
    send[other].push_back(first_is_own ? a : b);
    receive[other].push_back(first_is_own ? b : a);
  }
  const auto unique = [](std::vector<int>& a) {
    std::sort(a.begin(), a.end());
    a.erase(std::unique(a.begin(), a.end()), a.end());
  };
  const auto bodies_of = [&](const std::vector<int>& entries) {
    std::vector<int> result;
    for (int e : entries) result.push_back(bodies.body[e]);
    unique(result);
    return result;
  };
  for (int r = 0; r < share.n_ranks(); ++r) {
    if (send[r].empty()) continue;
    unique(send[r]), unique(receive[r]);
    Neighbour n{r, send[r], receive[r], bodies_of(send[r]), bodies_of(receive[r]), {{}, {}}, {}};
    const std::size_t lines = bodies.levers() ? 3 : 2;
    for (auto& out : n.out) out.resize(n.send.size() + lines * n.send_bodies.size());
    n.in.resize(n.receive.size() + lines * n.receive_bodies.size());
    neighbours.push_back(std::move(n));
  }
}

void GhostExchange::mark_sent(std::vector<char>& entry) const {
  for (const Neighbour& n : neighbours)
    for (int e : n.send) entry[e] = 1;
}

void GhostExchange::start(const SeedShare& share, const ContactBodies& bodies) {
  const auto bytes = [](const std::vector<HalfLine>& a) {
    return static_cast<int>(a.size() * sizeof(HalfLine));
  };
  static_assert(sizeof(ContactMotion) == 2 * sizeof(HalfLine));
  turn = 1 - turn;
  wait(sending[turn]);
  for (Neighbour& n : neighbours)
    MPI_Irecv(n.in.data(), bytes(n.in), MPI_BYTE, n.rank, 0, share.communicator(), &receiving.emplace_back());
  for (Neighbour& n : neighbours) {
    HalfLine* to = n.out[turn].data();
    for (int e : n.send) *to++ = bodies.state[e];
    for (int b : n.send_bodies) {
      std::copy_n(bodies.motion[b].value, 4, (to++)->value);
      std::copy_n(bodies.motion[b].value + 4, 4, (to++)->value);
      if (bodies.levers()) *to++ = bodies.centre[b];
    }
    MPI_Isend(n.out[turn].data(), bytes(n.out[turn]), MPI_BYTE, n.rank, 0, share.communicator(),
              &sending[turn].emplace_back());
  }
}

void GhostExchange::finish(ContactBodies& bodies) {
  if (receiving.empty()) return;
  wait(receiving);
  for (const Neighbour& n : neighbours) {
    const HalfLine* from = n.in.data();
    for (int e : n.receive) bodies.state[e] = *from++;
    for (int b : n.receive_bodies) {
      std::copy_n((from++)->value, 4, bodies.motion[b].value);
      std::copy_n((from++)->value, 4, bodies.motion[b].value + 4);
      if (bodies.levers()) bodies.centre[b] = *from++;
    }
  }
}

void GhostExchange::complete(ContactBodies& bodies) {
  finish(bodies);
  for (auto& requests : sending) wait(requests);
}

}  // namespace seedflow
