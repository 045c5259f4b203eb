// SPDX-License-Identifier: Apache-2.0
#include "file_nvm.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

namespace co {
namespace {

constexpr std::uint8_t erased = 0xFF;
constexpr mode_t readable_by_all = 0644;

// Synchronises the directory of a file: otherwise a new file could be missing after a power failure.
void sync_directory(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  const std::string directory = (slash == std::string::npos) ? "." : path.substr(0, slash + 1);
  const int fd = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd >= 0) {
    ::fsync(fd);
    ::close(fd);
  }
}

off_t offset_of(std::uint32_t start, std::uint32_t at) { return static_cast<off_t>(start) + static_cast<off_t>(at); }

// Repeats pread or pwrite until all bytes are processed, the end of the file is reached, or an error occurs. Returns
// the number of bytes processed.
template <typename Access>
std::uint32_t transfer_all(std::uint32_t size, Access access) {
  std::uint32_t done = 0;
  while (done < size) {
    const ssize_t bytes = access(done);
    if (bytes < 0 && errno == EINTR) {
      continue;
    }
    if (bytes <= 0) {
      break;
    }
    done += static_cast<std::uint32_t>(bytes);
  }
  return done;
}

}  // namespace

FileNvm::~FileNvm() { close(); }

bool FileNvm::open(const std::string& path, std::uint32_t capacity) {
  close();
  path_ = path;
  error_.clear();
  fd_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, readable_by_all);
  if (fd_ < 0) {
    return fail_with("cannot be opened");
  }
  capacity_ = capacity;
  if (!extend_to_capacity()) {
    close();
    return false;
  }
  return true;
}

void FileNvm::close() {
  if (fd_ >= 0) {
    ::close(fd_);
  }
  fd_ = -1;
  capacity_ = 0;
}

std::uint32_t FileNvm::read(std::uint32_t start, std::uint8_t* buffer, std::uint32_t size) {
  const std::uint32_t wanted = bytes_inside(start, size);
  errno = 0;
  const std::uint32_t done = transfer_all(
      wanted, [&](std::uint32_t at) { return ::pread(fd_, buffer + at, wanted - at, offset_of(start, at)); });
  if (done < wanted) {
    fail_with("cannot be read");
  }
  return done;
}

std::uint32_t FileNvm::write(std::uint32_t start, const std::uint8_t* buffer, std::uint32_t size) {
  const std::uint32_t wanted = bytes_inside(start, size);
  if (wanted == 0) {
    return 0;
  }
  errno = 0;
  const std::uint32_t done = write_all(start, buffer, wanted);
  if (done < wanted) {
    fail_with("cannot be written");
  }
  if (::fdatasync(fd_) != 0) {
    fail_with("cannot be synchronised");
    return 0;
  }
  return done;
}

// Extends the file with FFh to the capacity, and synchronises it.
bool FileNvm::extend_to_capacity() {
  struct stat status {};
  if (::fstat(fd_, &status) != 0) {
    return fail_with("cannot be examined");
  }
  if (!S_ISREG(status.st_mode)) {
    error_ = path_ + " is not a regular file";
    return false;
  }
  std::array<std::uint8_t, 4096> blank{};
  blank.fill(erased);
  for (std::uint64_t at = static_cast<std::uint64_t>(status.st_size); at < capacity_;) {
    const auto size = static_cast<std::uint32_t>(std::min<std::uint64_t>(blank.size(), capacity_ - at));
    if (write_all(static_cast<std::uint32_t>(at), blank.data(), size) < size) {
      return fail_with("cannot be filled");
    }
    at += size;
  }
  if (::fsync(fd_) != 0) {
    return fail_with("cannot be synchronised");
  }
  sync_directory(path_);
  return true;
}

// Returns the number of bytes of an access that are within the capacity.
std::uint32_t FileNvm::bytes_inside(std::uint32_t start, std::uint32_t size) const {
  return (start >= capacity_) ? 0 : std::min(size, capacity_ - start);
}

std::uint32_t FileNvm::write_all(std::uint32_t start, const std::uint8_t* buffer, std::uint32_t size) {
  return transfer_all(size,
                      [&](std::uint32_t at) { return ::pwrite(fd_, buffer + at, size - at, offset_of(start, at)); });
}

// Stores the text of an error. errno: its reason; 0: the end of the file was reached. Returns false.
bool FileNvm::fail_with(const char* action) {
  const std::string reason = (errno == 0) ? "it ends early" : std::generic_category().message(errno);
  error_ = path_ + " " + action + ": " + reason;
  return false;
}

namespace {

FileNvm& file(void* ctx) { return *static_cast<FileNvm*>(ctx); }

void init(void* /*ctx*/) {}

std::uint32_t read(void* ctx, std::uint32_t start, std::uint8_t* buffer, std::uint32_t size) {
  return file(ctx).read(start, buffer, size);
}

std::uint32_t write(void* ctx, std::uint32_t start, const std::uint8_t* buffer, std::uint32_t size) {
  return file(ctx).write(start, buffer, size);
}

CO_NVM_SHAPE shape(void* ctx) { return {file(ctx).capacity(), 1, 0}; }

}  // namespace

}  // namespace co

const CO_IF_NVM_DRV_EX COFileNvmDriver = {co::init, co::read, co::write, nullptr, co::shape};
