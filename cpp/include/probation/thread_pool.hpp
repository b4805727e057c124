#pragma once
// Threads that are kept between batches: starting and joining them costs more than a solve.

#include <Eigen/Core>
#include <functional>

namespace probation {

/// How a batch is run.
struct BatchRun {
  int threads = 0;  ///< how many to use, the caller's among them; 0: one per core
  std::function<void()>
      pause;  ///< called repeatedly by the calling thread; an exception of it ends the batch
};

/// Number of threads for a batch of so many tasks: work() is called with workers 0 .. workers_for() - 1.
int workers_for(Eigen::Index tasks, const BatchRun& run);

/// Calls work(worker, task) for every task, in any order, on the calling thread and on the threads of
/// the pool. A worker does one task at a time. The first exception ends the batch and reaches the caller.
///
/// Several threads may call this at once, and work() may call it, too. After a fork the child starts threads
/// of its own.
void in_parallel(Eigen::Index tasks, const BatchRun& run,
                 const std::function<void(int worker, Eigen::Index task)>& work);

}  // namespace probation
