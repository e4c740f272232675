#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <vector>

namespace drape {

/// Calls work(worker, index) once for every index below `count`, on several threads; `worker` is the thread's number,
/// below `workers`. The assignment of indices to threads varies; results must not depend on it. Ends early when a stop
/// is requested or a call throws; rethrows the first exception.
inline void for_each_in_parallel(std::size_t workers, std::size_t count, const std::stop_token& stop,
                                 const std::function<void(std::size_t, std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr error;
  std::mutex mutex;
  {
    std::vector<std::jthread> threads;
    for (std::size_t worker = 0; worker < std::min(workers, count); ++worker) {
      threads.emplace_back([&, worker] {
        try {
          for (std::size_t i = next++; i < count && !stop.stop_requested(); i = next++) work(worker, i);
        } catch (...) {
          const std::scoped_lock lock(mutex);
          if (!error) error = std::current_exception();
          next = count;
        }
      });
    }
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace drape
