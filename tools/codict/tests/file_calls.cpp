// SPDX-License-Identifier: Apache-2.0
// Library that a test preloads into codict: prints the system calls that make a written file durable, in their order.
#include <dlfcn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>

extern "C" int fsync(int file) {
  struct stat about {};
  const bool is_directory = ::fstat(file, &about) == 0 && S_ISDIR(about.st_mode);
  std::fputs(is_directory ? "fsync directory\n" : "fsync file\n", stderr);
  return reinterpret_cast<int (*)(int)>(::dlsym(RTLD_NEXT, "fsync"))(file);
}

extern "C" int rename(const char* from, const char* to) noexcept {
  std::fputs("rename\n", stderr);
  return reinterpret_cast<int (*)(const char*, const char*)>(::dlsym(RTLD_NEXT, "rename"))(from, to);
}
