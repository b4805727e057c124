// Every task is done once, whoever calls from where; what fails reaches the caller.

#include <doctest/doctest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include "probation/thread_pool.hpp"

#if __has_include(<sys/wait.h>)
#include <sys/wait.h>
#include <unistd.h>
#endif

using namespace probation;
using Eigen::Index;

namespace {

/// How often each task was done.
std::vector<int> done(Index tasks, int threads) {
  std::vector<std::atomic<int>> times(static_cast<std::size_t>(tasks));
  in_parallel(tasks, {threads, {}}, [&](int, Index task) { ++times[static_cast<std::size_t>(task)]; });
  return {times.begin(), times.end()};
}

bool each_once(const std::vector<int>& times) {
  for (const int count : times)
    if (count != 1) return false;
  return true;
}

}  // namespace

TEST_CASE("every task is done once, by any number of threads") {
  for (const int threads : {1, 2, 5, 0})
    for (const Index tasks : {0, 1, 3, 1000}) CHECK(each_once(done(tasks, threads)));
}

TEST_CASE("a worker's number is its own while it works") {
  std::vector<std::atomic<int>> busy(static_cast<std::size_t>(workers_for(200, {4, {}})));
  std::atomic<bool> shared{false};
  in_parallel(200, {4, {}}, [&](int worker, Index) {
    if (busy[static_cast<std::size_t>(worker)].exchange(1) != 0) shared = true;
    std::this_thread::yield();
    busy[static_cast<std::size_t>(worker)] = 0;
  });
  CHECK_FALSE(shared);
}

TEST_CASE("the first failure ends the batch and reaches the caller, and the pool goes on") {
  for (const int threads : {1, 3}) {
    std::atomic<int> calls{0};
    const auto work = [&](int, Index task) {
      ++calls;
      if (task == 5) throw std::runtime_error("task 5");
    };
    CHECK_THROWS_WITH(in_parallel(1'000'000, {threads, {}}, work), "task 5");
    CHECK(calls < 1'000'000);
    CHECK(each_once(done(100, threads)));
  }
}

TEST_CASE("what the pause throws ends the batch") {
  const BatchRun run{2, [] { throw std::runtime_error("interrupted"); }};
  const auto work = [](int, Index) { std::this_thread::sleep_for(std::chrono::milliseconds(2)); };
  CHECK_THROWS_WITH(in_parallel(100'000, run, work), "interrupted");
}

TEST_CASE("batches may be called from several threads and from inside batches") {
  std::atomic<int> sum{0};
  std::vector<std::thread> callers;
  callers.reserve(3);
  for (int k = 0; k < 3; ++k)
    callers.emplace_back([&] {
      in_parallel(4, {2, {}}, [&](int, Index) { in_parallel(10, {3, {}}, [&](int, Index) { ++sum; }); });
    });
  for (std::thread& caller : callers) caller.join();
  CHECK(sum == 3 * 4 * 10);
}

#if __has_include(<sys/wait.h>) && !defined(__SANITIZE_THREAD__)
TEST_CASE("a forked child has threads of its own") {
  CHECK(each_once(done(50, 3)));
  const pid_t child = fork();
  if (child == 0) _exit(each_once(done(50, 3)) ? 0 : 1);
  int status = -1;
  waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}
#endif
