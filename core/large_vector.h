// A vector for many megabytes that are read in no order: asked of the system in pages of 2 MiB where it has
// them (Linux, madvise), which spares the processor most of its looking up of addresses.
#pragma once
#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

namespace bpms {

template <class T>
struct LargeAllocator {
  using value_type = T;
  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) {}

  T* allocate(std::size_t count) {
    constexpr std::size_t page = std::size_t{1} << 21;
    const std::size_t bytes = count * sizeof(T);
    if (bytes < page) return static_cast<T*>(::operator new (bytes, std::align_val_t{alignof(T)}));
    void* out = std::aligned_alloc(page, (bytes + page - 1) / page * page);
    if (out == nullptr) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    ::madvise(out, bytes, MADV_HUGEPAGE);
#endif
    return static_cast<T*>(out);
  }
  void deallocate(T* memory, std::size_t count) {
    constexpr std::size_t page = std::size_t{1} << 21;
    if (count * sizeof(T) < page)
      ::operator delete (memory, std::align_val_t{alignof(T)});
    else
      std::free(memory);
  }
  template <class U>
  bool operator==(const LargeAllocator<U>&) const {
    return true;
  }
};

template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace bpms
