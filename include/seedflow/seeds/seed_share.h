#pragma once

#include <mpi.h>

#include <algorithm>
#include <vector>

#include "seedflow/seeds/contact_list.h"
#include "seedflow/seeds/neighbour_skin.h"
#include "seedflow/seeds/numbering.h"

namespace seedflow {

/// Which rank computes which seeds: whole blocks of the stores, in each store a contiguous range. Every rank
/// remembers all seeds; what others have computed is brought by gather().
class SeedShare {
 public:
  explicit SeedShare(MPI_Comm communicator);

  int rank() const { return own_rank; }
  int n_ranks() const { return ranks; }
  MPI_Comm communicator() const { return comm; }

  /// One block: where it stands on the curve along which blocks are divided, and what it costs.
  struct Block {
    int store, block;
    unsigned long long key;
    double cost;
  };
  /// Divides the blocks, which must ascend along the curve within each store, into parts of equal cost.
  void divide(const std::vector<SeedStore>& stores, std::vector<Block> blocks);
  /// Blocks that were added since belong to the last rank.
  void extend(const std::vector<SeedStore>& stores);

  int begin(int t) const { return bound[t][own_rank]; }
  int end(int t) const { return bound[t][own_rank + 1]; }
  int owner(int t, int block) const;
  /// Cost of the dearest rank over the mean.
  double imbalance() const { return dearest; }

  /// Completes an array of `per_block` entries for each block of store t.
  template <class T>
  void gather(int t, std::vector<T>& data, std::size_t per_block) const {
    gather_bytes(t, reinterpret_cast<char*>(data.data()), per_block * sizeof(T));
  }
  /// All ranks' entries one after the other.
  template <class T>
  void concatenate(std::vector<T>& data) const {
    std::vector<char> bytes =
        concatenated(reinterpret_cast<const char*>(data.data()), data.size() * sizeof(T));
    data.resize(bytes.size() / sizeof(T));
    std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(data.data()));
  }
  /// Adds up; exact where all but one rank hold zero.
  void add_up(std::vector<Vec3>& values) const;
  void add_up(ListSizes& sizes) const;

 private:
  void gather_bytes(int t, char* data, std::size_t bytes_per_block) const;
  std::vector<char> concatenated(const char* data, std::size_t size) const;

  MPI_Comm comm;
  int own_rank = 0, ranks = 1;
  std::vector<std::vector<int>> bound;  ///< [store][rank] first block; [n_ranks]: number of blocks
  double dearest = 1;
};

/// Brings the state of other ranks' sub-spheres that stand in pairs with own ones, and of their bodies.
/// Messages travel between start() and finish(), while the ranks compute.
class GhostExchange {
 public:
  /// From the lists; both sides of a pair find it, so both know what to send and to expect.
  void set(const SeedShare& share, const Numbering& numbering, const std::vector<SeedStore>& stores,
           const ContactBodies& bodies, const PairList& pairs);
  /// Marks the entries that other ranks wait for.
  void mark_sent(std::vector<char>& entry) const;
  /// Sends them as they are now.
  void start(const SeedShare& share, const ContactBodies& bodies);
  /// Takes what other ranks have sent, if a start() went before.
  void finish(ContactBodies& bodies);
  /// As finish(), and own messages have arrived, too.
  void complete(ContactBodies& bodies);

 private:
  struct Neighbour {
    int rank;
    std::vector<int> send, receive;                ///< entries
    std::vector<int> send_bodies, receive_bodies;  ///< of these entries
    std::vector<HalfLine> out[2], in;
  };
  std::vector<Neighbour> neighbours;
  std::vector<MPI_Request> receiving, sending[2];
  int turn = 0;  ///< of the two buffers sent from: slower ranks may still read the other
};

}  // namespace seedflow
