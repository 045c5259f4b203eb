// SPDX-License-Identifier: Apache-2.0
#include "linux_node/storage.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace lexican::demo {

Storage::Storage() { CONvmRamClear(&ram_); }

Storage::~Storage() {
  if (!temporary_.empty()) {
    ::unlink(temporary_.c_str());
  }
}

std::string Storage::open(const std::string& path) {
  return file_.open(path, clock_memory_size) ? std::string() : file_.error();
}

std::string Storage::open_temporary() {
  const char* const directory = std::getenv("TMPDIR");
  std::string path = std::string(directory != nullptr ? directory : "/tmp") + "/lexican-demo-XXXXXX";
  const int descriptor = ::mkstemp(path.data());
  if (descriptor < 0) {
    return path + " cannot be created: " + std::generic_category().message(errno);
  }
  ::close(descriptor);
  temporary_ = path;
  return open(path);
}

Memory Storage::memory() {
  return file_.capacity() != 0 ? Memory{&co::FileNvmDriver, &file_} : Memory{&RamNvmDriver, &ram_};
}

}  // namespace lexican::demo
