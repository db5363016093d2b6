#include "src2d/dynamics/task_pool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

namespace merge2d {
namespace {

TEST(TaskPool, EveryTaskIsDoneOnceInEveryJob) {
  for (const int threads : {1, 2, 5}) {
    TaskPool pool(threads);
    ASSERT_EQ(pool.threads(), threads);
    for (const std::size_t tasks : {0u, 1u, 2u, 3u, 1000u}) {
      std::vector<int> done(tasks, 0);
      for (int job = 1; job <= 50; ++job) {
        pool.run(tasks, [&](std::size_t task, int) { ++done[task]; });
        ASSERT_TRUE(std::ranges::all_of(done, [&](int times) { return times == job; }));
      }
    }
  }
}

TEST(TaskPool, NoTwoThreadsHaveOneNumber) {
  TaskPool pool(3);
  std::vector<std::uint64_t> sums(3, 0);  // each written by one thread alone
  pool.run(10'000, [&](std::size_t task, int thread) {
    ASSERT_LT(thread, 3);
    sums[static_cast<std::size_t>(thread)] += task;
  });
  EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), std::uint64_t{0}), 10'000u * 9'999u / 2u);
}

TEST(TaskPool, AnExceptionReachesTheCallerOnceNoThreadHasATask) {
  for (const int threads : {1, 2, 5}) {
    TaskPool pool(threads);
    for (int job = 0; job < 50; ++job) {
      std::atomic<int> under_way{0};
      auto fail = [&](std::size_t task, int) {
        ++under_way;
        std::this_thread::yield();
        --under_way;
        if (task % 10 == 7) throw std::runtime_error("no memory");
      };
      EXPECT_THROW(pool.run(100, fail), std::runtime_error);
      EXPECT_EQ(under_way, 0);
      std::atomic<int> done{0};
      pool.run(100, [&](std::size_t, int) { ++done; });
      EXPECT_EQ(done, 100) << "the pool goes on";
    }
  }
}

TEST(TaskPool, AnIndexBelongsToOneRun) {
  TaskPool pool(2);
  for (TaskPool* of : {static_cast<TaskPool*>(nullptr), &pool}) {
    for (const std::size_t n : {0u, 1u, 7u, 8u, 9u, 1001u}) {
      std::vector<int> visits(n, 0);
      forEachIndex(of, n, 8, [&](std::size_t i, int) { ++visits[i]; });
      EXPECT_EQ(std::ranges::count(visits, 1), static_cast<std::ptrdiff_t>(n));
    }
  }
}

}  // namespace
}  // namespace merge2d
