// SPDX-License-Identifier: Apache-2.0
// Library that a test preloads into codict: prints the system calls that make a written file durable, in their order.
// fsync() of a directory fails with the error number in the environment variable DIRECTORY_FSYNC_ERROR, if it is set.
#include <dlfcn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>

extern "C" int fsync(int file) {
  struct stat about {};
  const bool is_directory = ::fstat(file, &about) == 0 && S_ISDIR(about.st_mode);
  std::fputs(is_directory ? "fsync directory\n" : "fsync file\n", stderr);
  const char* const error = std::getenv("DIRECTORY_FSYNC_ERROR");
  if (is_directory && error != nullptr) {
    errno = std::atoi(error);
    return -1;
  }
  return reinterpret_cast<int (*)(int)>(::dlsym(RTLD_NEXT, "fsync"))(file);
}

extern "C" int rename(const char* from, const char* to) noexcept {
  std::fputs("rename\n", stderr);
  return reinterpret_cast<int (*)(const char*, const char*)>(::dlsym(RTLD_NEXT, "rename"))(from, to);
}
