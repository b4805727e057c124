#include "probation/thread_pool.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <list>
#include <mutex>
#include <system_error>
#include <thread>
#if __has_include(<pthread.h>)
#include <pthread.h>
#endif

namespace probation {
namespace {

using Eigen::Index;

/// One batch, on the stack of its caller.
class Batch {
 public:
  Batch(Index tasks, const std::function<void(int, Index)>& work) : tasks_(tasks), work_(work) {}

  /// Takes tasks until none is left.
  void work_as(int worker, const std::function<void()>& pause = {}) noexcept {
    using Clock = std::chrono::steady_clock;
    constexpr auto between_pauses = std::chrono::milliseconds(50);
    try {
      auto last = pause ? Clock::now() : Clock::time_point();
      for (Index task = next_++; task < tasks_; task = next_++) {
        work_(worker, task);
        if (pause && Clock::now() - last > between_pauses) {
          pause();
          last = Clock::now();
        }
      }
    } catch (...) {
      next_ = tasks_;
      const std::lock_guard<std::mutex> lock(failing_);
      if (!failure_) failure_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

  // The pool's mutex guards these.
  int joined = 1;      ///< workers so far, the caller first
  int wanted = 1;      ///< workers at most
  int still_busy = 0;  ///< others that have not left yet

 private:
  const Index tasks_;
  const std::function<void(int, Index)>& work_;
  std::atomic<Index> next_{0};
  std::mutex failing_;
  std::exception_ptr failure_;
};

class Pool {
 public:
  void run(Batch& batch, int workers, const std::function<void()>& pause) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      batch.wanted = workers;
      batches_.push_back(&batch);
      start_threads(workers - 1);
    }
    arrived_.notify_all();
    batch.work_as(0, pause);
    std::unique_lock<std::mutex> lock(mutex_);
    batches_.remove(&batch);
    left_.wait(lock, [&] { return batch.still_busy == 0; });
  }

 private:
  /// Where the system gives no more threads, those it gave do the work.
  void start_threads(int wanted) {
    try {
      for (; threads_ < wanted; ++threads_) std::thread([this] { serve(); }).detach();
    } catch (const std::system_error&) {
      return;
    }
  }

  Batch* open_batch() {
    const auto found = std::find_if(batches_.begin(), batches_.end(),
                                    [](const Batch* batch) { return batch->joined < batch->wanted; });
    return found == batches_.end() ? nullptr : *found;
  }

  void serve() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
      Batch* batch = nullptr;
      arrived_.wait(lock, [&] { return (batch = open_batch()) != nullptr; });
      const int worker = batch->joined++;
      ++batch->still_busy;
      lock.unlock();
      batch->work_as(worker);
      lock.lock();
      if (--batch->still_busy == 0) left_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable arrived_, left_;
  std::list<Batch*> batches_;
  int threads_ = 0;
};

// Never destroyed: its threads sleep until the process ends, and no destructor waits for them. A forked child
// has none of these threads: it leaves this pool, whose mutex may be locked, and makes its own.
std::atomic<Pool*> the_pool{nullptr};

Pool& pool() {
#if __has_include(<pthread.h>)
  static const int watched = pthread_atfork(nullptr, nullptr, [] { the_pool = nullptr; });
  static_cast<void>(watched);
#endif
  Pool* found = the_pool;
  if (found) return *found;
  Pool* made = new Pool;  // NOLINT(cppcoreguidelines-owning-memory)
  if (the_pool.compare_exchange_strong(found, made)) return *made;
  delete made;  // NOLINT(cppcoreguidelines-owning-memory): another thread was first
  return *found;
}

}  // namespace

int workers_for(Index tasks, const BatchRun& run) {
  constexpr int most = 1024;
  const int wanted = run.threads > 0 ? run.threads : static_cast<int>(std::thread::hardware_concurrency());
  return static_cast<int>(std::clamp<Index>(std::min(wanted, most), 1, std::max<Index>(tasks, 1)));
}

void in_parallel(Index tasks, const BatchRun& run, const std::function<void(int, Index)>& work) {
  const int workers = workers_for(tasks, run);
  Batch batch(tasks, work);
  if (workers == 1)
    batch.work_as(0, run.pause);
  else
    pool().run(batch, workers, run.pause);
  batch.rethrow();
}

}  // namespace probation
