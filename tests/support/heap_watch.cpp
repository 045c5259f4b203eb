// SPDX-License-Identifier: Apache-2.0
#include "heap_watch.hpp"

#include <cstddef>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define LEXICAN_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define LEXICAN_SANITIZER 1
#endif
#endif

namespace test {
namespace {

// No initialisation at run time: malloc() may run before anything else of a thread does.
thread_local int depth __attribute__((tls_model("initial-exec"))) = 0;
thread_local std::uint64_t requests __attribute__((tls_model("initial-exec"))) = 0;

void note() {
  if (depth > 0) {
    ++requests;
  }
}

}  // namespace

InsideStack::InsideStack() { ++depth; }
InsideStack::~InsideStack() { --depth; }

OutsideStack::OutsideStack() : depth_(depth) { depth = 0; }
OutsideStack::~OutsideStack() { depth = depth_; }

std::uint64_t heap_requests() { return requests; }

}  // namespace test

#ifdef LEXICAN_SANITIZER

// The sanitizers own malloc() and offer a hook instead.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*)(const volatile void*, std::size_t),
                                                         void (*)(const volatile void*));
namespace {
void on_malloc(const volatile void*, std::size_t) { test::note(); }
void on_free(const volatile void*) {}
[[maybe_unused]] const int hooks = __sanitizer_install_malloc_and_free_hooks(on_malloc, on_free);
}  // namespace

#elif defined(__GLIBC__)

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void __libc_free(void* old);

void* malloc(std::size_t size) {
  test::note();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  test::note();
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  test::note();
  return __libc_realloc(old, size);
}
void free(void* old) { __libc_free(old); }
}

#endif
