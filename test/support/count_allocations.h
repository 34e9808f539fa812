// Counts what a thread takes from the heap, and what the program holds of it: replaces the malloc family of the whole test program (operator new of
// libstdc++ calls malloc; glibc's own names keep working underneath). To be included by one source of a program. The
// sanitizers replace malloc themselves: under them nothing is counted, and the tests skip.
#pragma once

#include <malloc.h>
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
inline std::atomic<long> held{0};

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

/// Bytes of the heap that are in use, by whatever thread; 0 where nothing is counted.
inline long heldBytes() noexcept {
  return held;
}

/// Called by the functions below.
inline void countAllocation() noexcept {
  if (counted_thread) ++allocations;
}
inline void* hold(void* memory) noexcept {
  held += static_cast<long>(::malloc_usable_size(memory));
  return memory;
}
inline void letGo(void* memory) noexcept {
  held -= static_cast<long>(::malloc_usable_size(memory));
}

}  // namespace nord_driver::test

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
extern "C" {
void* __libc_malloc(size_t size);
void* __libc_calloc(size_t count, size_t size);
void* __libc_realloc(void* memory, size_t size);
void* __libc_memalign(size_t alignment, size_t size);
void __libc_free(void* memory);

void* malloc(size_t size) {
  nord_driver::test::countAllocation();
  return nord_driver::test::hold(__libc_malloc(size));
}
void* calloc(size_t number, size_t size) {
  nord_driver::test::countAllocation();
  return nord_driver::test::hold(__libc_calloc(number, size));
}
void* realloc(void* memory, size_t size) {
  nord_driver::test::countAllocation();
  nord_driver::test::letGo(memory);
  void* const moved = __libc_realloc(memory, size);
  nord_driver::test::hold(moved == nullptr && size != 0 ? memory : moved);
  return moved;
}
void* memalign(size_t alignment, size_t size) {
  nord_driver::test::countAllocation();
  return nord_driver::test::hold(__libc_memalign(alignment, size));
}
void* aligned_alloc(size_t alignment, size_t size) {
  nord_driver::test::countAllocation();
  return nord_driver::test::hold(__libc_memalign(alignment, size));
}
int posix_memalign(void** memory, size_t alignment, size_t size) {
  nord_driver::test::countAllocation();
  *memory = nord_driver::test::hold(__libc_memalign(alignment, size));
  return *memory == nullptr ? ENOMEM : 0;
}
void free(void* memory) {
  nord_driver::test::letGo(memory);
  __libc_free(memory);
}
}
#endif
