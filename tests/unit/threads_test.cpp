// SPDX-License-Identifier: Apache-2.0
#include "src/scene/threads.hpp"

#include <gtest/gtest.h>
#include <omp.h>
#include <sched.h>

#include <vector>

namespace fastrt {
namespace {

cpu_set_t allowed_processors() {
  cpu_set_t allowed;
  EXPECT_EQ(sched_getaffinity(0, sizeof allowed, &allowed), 0);
  return allowed;
}

// What the threads of a team of all processors may run on.
std::vector<cpu_set_t> allowed_of_team() {
  std::vector<cpu_set_t> allowed(static_cast<std::size_t>(omp_get_num_procs()));
#pragma omp parallel num_threads(omp_get_num_procs())
  allowed[static_cast<std::size_t>(omp_get_thread_num())] = allowed_processors();
  return allowed;
}

void expect_all_to_equal(const std::vector<cpu_set_t>& sets, const cpu_set_t& expected) {
  for (std::size_t i = 0; i < sets.size(); ++i)
    EXPECT_TRUE(CPU_EQUAL(&sets[i], &expected)) << "thread " << i << " may run on " << CPU_COUNT(&sets[i]);
}

TEST(Threads, PlacedOnesMayStillRunEverywhere) {
  if (omp_get_proc_bind() != omp_proc_bind_false) GTEST_SKIP() << "OMP_PROC_BIND binds them";
  const cpu_set_t before = allowed_processors();
  place_threads(omp_get_num_procs());
  expect_all_to_equal(allowed_of_team(), before);
}

// A thread that the caller's program has bound stays where it is.
TEST(Threads, BoundOnesStayBound) {
  const cpu_set_t before = allowed_processors();
  const int processors = omp_get_num_procs();
  std::vector<cpu_set_t> bound(static_cast<std::size_t>(processors));
#pragma omp parallel num_threads(processors)
  {
    int left = omp_get_thread_num();
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int i = 0; i < CPU_SETSIZE; ++i)
      if (CPU_ISSET(i, &before) && left-- == 0) CPU_SET(i, &one);
    if (omp_get_thread_num() != 0) sched_setaffinity(0, sizeof one, &one);
    bound[static_cast<std::size_t>(omp_get_thread_num())] = allowed_processors();
  }
  place_threads(processors);
  const std::vector<cpu_set_t> after = allowed_of_team();
  for (std::size_t i = 0; i < after.size(); ++i)
    EXPECT_TRUE(CPU_EQUAL(&after[i], &bound[i])) << "thread " << i;
}

} // namespace
} // namespace fastrt
