#pragma once

#include <mpi.h>

#include <functional>

namespace seedflow {

/// Runs `work`, which itself communicates with no other rank, and lets a failure on one rank be the failure
/// of all, so that none waits for the others forever: the exception of the lowest failing rank is thrown on
/// every rank, InputError as such, any other std::exception as RunError with its text. Collective.
void together(MPI_Comm communicator, const std::function<void()>& work);

}  // namespace seedflow
