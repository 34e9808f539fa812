// Counts what a thread takes from the heap: replaces the malloc family of the whole test program (operator new of
// libstdc++ calls malloc; glibc's own names keep working underneath). To be included by one source of a program. The
// sanitizers replace malloc themselves: under them nothing is counted, and the tests skip.
#pragma once

#include <stdlib.h>

#include <atomic>
#include <cerrno>
#include <cstddef>

namespace nord_driver::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kCanCountAllocations = false;
#else
constexpr bool kCanCountAllocations = true;
#endif

inline thread_local bool counted_thread = false;
inline std::atomic<unsigned long> allocations{0};

/// From here on the calling thread's allocations count, or no longer.
inline void countThisThread(bool on) noexcept {
  counted_thread = on;
}

/// What this thread allocates while `work()` runs.
template <typename Work>
unsigned long countAllocations(const Work& work) {
  allocations = 0;
  countThisThread(true);
  work();
  countThisThread(false);
  return allocations;
}

/// Called by the functions below.
inline void countAllocation() noexcept {
  if (counted_thread) ++allocations;
}

}  // namespace nord_driver::test

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* memory, size_t size);
void* __libc_memalign(size_t alignment, size_t size);

void* malloc(size_t size) {
  nord_driver::test::countAllocation();
  return __libc_malloc(size);
}
void* calloc(size_t number, size_t size) {
  nord_driver::test::countAllocation();
  return __libc_calloc(number, size);
}
void* realloc(void* memory, size_t size) {
  nord_driver::test::countAllocation();
  return __libc_realloc(memory, size);
}
void* memalign(size_t alignment, size_t size) {
  nord_driver::test::countAllocation();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(size_t alignment, size_t size) {
  nord_driver::test::countAllocation();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, size_t alignment, size_t size) {
  nord_driver::test::countAllocation();
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
}
#endif
