// SPDX-License-Identifier: Apache-2.0
#include "heap_watch.hpp"

#include <cstddef>
#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define LEXICAN_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define LEXICAN_SANITIZER 1
#endif
#endif

namespace test {
namespace {

#ifdef __NEWLIB__
// Not thread_local: newlib would allocate such variables with malloc(). The targets have no threads.
int depth = 0;
std::uint64_t requests = 0;
#else
// Without initialisation at run time, because malloc() may be the first function that a thread calls.
thread_local int depth __attribute__((tls_model("initial-exec"))) = 0;
thread_local std::uint64_t requests __attribute__((tls_model("initial-exec"))) = 0;
#endif

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

// The sanitizers replace malloc(), and call this hook for each allocation.
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

#elif defined(__PICOLIBC__)

// The linker option --wrap redirects malloc(), calloc() and realloc() to these functions.
extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* old, std::size_t size);

void* __wrap_malloc(std::size_t size) {
  test::note();
  return __real_malloc(size);
}
void* __wrap_calloc(std::size_t count, std::size_t size) {
  test::note();
  return __real_calloc(count, size);
}
void* __wrap_realloc(void* old, std::size_t size) {
  test::note();
  return __real_realloc(old, size);
}
}

#elif defined(__NEWLIB__)

extern "C" {
struct _reent;
extern struct _reent* _impure_ptr;
void* _malloc_r(struct _reent* self, std::size_t size);
void* _calloc_r(struct _reent* self, std::size_t count, std::size_t size);
void* _realloc_r(struct _reent* self, void* old, std::size_t size);
void _free_r(struct _reent* self, void* old);

void* malloc(std::size_t size) {
  test::note();
  return _malloc_r(_impure_ptr, size);
}
void* calloc(std::size_t count, std::size_t size) {
  test::note();
  return _calloc_r(_impure_ptr, count, size);
}
void* realloc(void* old, std::size_t size) {
  test::note();
  return _realloc_r(_impure_ptr, old, size);
}
void free(void* old) { _free_r(_impure_ptr, old); }
}

#endif
