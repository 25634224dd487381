// Threads (TBB behind it). Results must never depend on the thread count: work items write to their own place only.
#pragma once
#include <cstddef>
#include <functional>

namespace witherfield {

/// Runs body(begin, end) over disjoint ranges that cover [0, n). grain = smallest range.
void parallel_for(std::size_t n, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body);

/// Limits the number of threads used by parallel_for while it lives. threads = 0 means all.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

}  // namespace witherfield
