// Counts what a piece of a test takes from the free store. To be included in one source of a test program only: the
// whole program runs on the operators defined here.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

namespace nord_driver::test {

inline bool counting_allocations = false;
inline std::size_t allocations = 0;

inline void* allocateCounted(std::size_t size) {
  if (counting_allocations) ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc{};
}

/// The number of allocations while `work()` runs.
template <typename Work>
std::size_t countAllocations(const Work& work) {
  allocations = 0;
  counting_allocations = true;
  work();
  counting_allocations = false;
  return allocations;
}

}  // namespace nord_driver::test

void* operator new(std::size_t size) {
  return nord_driver::test::allocateCounted(size);
}
void* operator new[](std::size_t size) {
  return nord_driver::test::allocateCounted(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}
