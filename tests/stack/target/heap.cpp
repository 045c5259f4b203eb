// SPDX-License-Identifier: Apache-2.0
// Heap of the test programs on boards. The tests allocate so often that the C library's heap, which searches lists,
// would take most of the time. For ARMv7-M the file also defines copy functions: those of the C library access
// unaligned words, which faults where unaligned accesses are trapped.
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "program.hpp"

extern "C" char board_bss_end[], board_heap_end[];  // defined in sections.ld

namespace {

/// Header of a block of 16 << order bytes. Unused blocks are in a list for each order.
struct Header {
  union {
    std::size_t order;
    Header* next;
  };
};

constexpr std::size_t header_size = alignof(std::max_align_t);  // 8 or 16
constexpr std::size_t orders = 24;
constexpr std::size_t size_of(std::size_t order) { return std::size_t{16} << order; }

Header* unused[orders];
char* end = nullptr;

std::size_t order_for(std::size_t size) {
  std::size_t order = 0;
  while (order < orders && size_of(order) < size) {
    ++order;
  }
  return order;
}

char* extend(std::size_t size) {
  if (end == nullptr) {
    end = board_bss_end + (0 - reinterpret_cast<std::uintptr_t>(board_bss_end)) % header_size;
  }
  if (size > static_cast<std::size_t>(board_heap_end - end)) {
    return nullptr;
  }
  char* const begin = end;
  end += size;
  return begin;
}

template <class T>
T* as(void* memory) {
  return static_cast<T*>(memory);
}

Header* header_of(void* memory) { return as<Header>(as<char>(memory) - header_size); }

// Returns an unused block of at least that order, or null. The header contains its order.
Header* take_unused(std::size_t order) {
  while (order < orders && unused[order] == nullptr) {
    ++order;
  }
  if (order == orders) {
    return nullptr;
  }
  Header* const header = unused[order];
  unused[order] = header->next;
  header->order = order;
  return header;
}

Header* make(std::size_t order) {
  auto* const header = order < orders ? as<Header>(extend(header_size + size_of(order))) : nullptr;
  if (header != nullptr) {
    header->order = order;
  }
  return header;
}

// Allocates an unused block of the right order, else a new block, else a larger unused one.
void* allocate(std::size_t size) {
  const std::size_t order = order_for(size);
  const bool fits = order < orders && unused[order] != nullptr;
  Header* header = fits ? take_unused(order) : make(order);
  header = header == nullptr ? take_unused(order) : header;
  if (header == nullptr) {
    board::print("out of memory\n");
    board::leave(98);
  }
  return as<char>(header) + header_size;
}

void release(void* memory) {
  if (memory != nullptr) {
    Header* const header = header_of(memory);
    const std::size_t order = header->order;
    header->next = unused[order];
    unused[order] = header;
  }
}

void* allocate_zeros(std::size_t count, std::size_t size) {
  void* const memory = size != 0 && count > SIZE_MAX / size ? nullptr : allocate(count * size);
  return memory == nullptr ? nullptr : std::memset(memory, 0, count * size);
}

void* resize(void* old, std::size_t size) {
  if (old == nullptr) {
    return allocate(size);
  }
  const std::size_t old_size = size_of(header_of(old)->order);
  if (size <= old_size) {
    return old;
  }
  void* const memory = allocate(size);
  if (memory != nullptr) {
    std::memcpy(memory, old, old_size);
    release(old);
  }
  return memory;
}

}  // namespace

extern "C" {

#ifdef __PICOLIBC__
void* malloc(std::size_t size) { return allocate(size); }
void* calloc(std::size_t count, std::size_t size) { return allocate_zeros(count, size); }
void* realloc(void* old, std::size_t size) { return resize(old, size); }
void free(void* old) { release(old); }
#else
// Functions that newlib and tests/stack/support/heap_watch.cpp call.
void* _malloc_r(struct _reent*, std::size_t size) { return allocate(size); }
void* _calloc_r(struct _reent*, std::size_t count, std::size_t size) { return allocate_zeros(count, size); }
void* _realloc_r(struct _reent*, void* old, std::size_t size) { return resize(old, size); }
void _free_r(struct _reent*, void* old) { release(old); }
#endif

#if defined(__arm__) && __ARM_ARCH >= 7

void* memcpy(void* to, const void* from, std::size_t size) {
  const bool is_aligned = ((reinterpret_cast<std::uintptr_t>(to) | reinterpret_cast<std::uintptr_t>(from)) & 3u) == 0;
  const std::size_t words = is_aligned ? size / 4 : 0;
  for (std::size_t n = 0; n < words; ++n) {
    as<std::uint32_t>(to)[n] = static_cast<const std::uint32_t*>(from)[n];
  }
  for (std::size_t n = 4 * words; n < size; ++n) {
    as<char>(to)[n] = static_cast<const char*>(from)[n];
  }
  return to;
}

void* memmove(void* to, const void* from, std::size_t size) {
  const auto begin = reinterpret_cast<std::uintptr_t>(from);
  const auto target = reinterpret_cast<std::uintptr_t>(to);
  if (target <= begin || target >= begin + size) {
    return memcpy(to, from, size);
  }
  while (size-- > 0) {
    as<char>(to)[size] = static_cast<const char*>(from)[size];
  }
  return to;
}

#endif
}
