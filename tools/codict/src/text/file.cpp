// SPDX-License-Identifier: Apache-2.0
#include "text/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

namespace lexican::codict {

namespace {

constexpr mode_t new_file = 0666;  // permissions of a new file, before the umask is applied

class Descriptor {
 public:
  explicit Descriptor(int number, bool is_owned = true) : number_(number), is_owned_(is_owned) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }
  bool close() {
    const bool closes = is_owned_ && number_ >= 0;
    is_owned_ = false;
    return !closes || ::close(number_) == 0;
  }

 private:
  int number_;
  bool is_owned_;
};

std::string reason(const std::string& path, int error) { return path + ": " + std::generic_category().message(error); }

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) {
      return false;
    }
    bytes.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
  }
  return true;
}

// Reads at most one block beyond the size limit, enough to detect that the file is too large.
bool read_all(int file, std::string& bytes) {
  std::array<char, 65536> block{};
  while (bytes.size() <= Source::size_limit) {
    const ssize_t got = ::read(file, block.data(), block.size());
    if (got < 0 && errno != EINTR) {
      return false;
    }
    if (got == 0) {
      break;
    }
    bytes.append(block.data(), got < 0 ? 0 : static_cast<std::size_t>(got));
  }
  return true;
}

bool has_bytes(const std::string& path, std::string_view bytes) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error) || std::filesystem::file_size(path, error) != bytes.size()) {
    return false;
  }
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  std::array<char, 65536> block{};
  ssize_t got = file.number() < 0 ? -1 : 1;
  while (got > 0 || (got < 0 && errno == EINTR)) {
    got = ::read(file.number(), block.data(), block.size());
    const auto length = static_cast<std::size_t>(std::max<ssize_t>(got, 0));
    if (bytes.compare(0, length, block.data(), length) != 0) {
      return false;
    }
    bytes.remove_prefix(length);
  }
  return got == 0 && bytes.empty();
}

// Writes cached data of a file or directory to its medium. EINVAL and ENOTSUP mean that the file system does not
// support it.
bool sync(int file) { return ::fsync(file) == 0 || errno == EINVAL || errno == ENOTSUP; }

bool sync_directory_of(const std::string& path) {
  const std::string directory = std::filesystem::path(path).parent_path().string();
  const Descriptor file(::open(directory.empty() ? "." : directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return file.number() < 0 || sync(file.number());  // a directory without read permission cannot be synchronised
}

// Replaces a file by a new one with its name and permissions. A symbolic link is followed: its target is replaced. On
// success, `warning` is set if a power failure may undo the change.
bool replace_file(const std::string& path, std::string_view bytes, std::string& warning) {
  std::error_code error;
  const std::filesystem::path canonical = std::filesystem::canonical(path, error);
  const std::string target = error ? path : canonical.string();
  std::string temporary = target + ".XXXXXX";
  Descriptor file(::mkstemp(temporary.data()));
  if (file.number() < 0) {
    return false;
  }
  struct stat old {};
  const mode_t mask = ::umask(0);
  ::umask(mask);
  const mode_t mode = ::stat(target.c_str(), &old) == 0 ? old.st_mode & 07777U : new_file & ~mask;
  const bool complete =
      write_all(file.number(), bytes) && ::fchmod(file.number(), mode) == 0 && sync(file.number()) && file.close();
  if (complete && ::rename(temporary.c_str(), target.c_str()) == 0) {
    if (!sync_directory_of(target)) {
      warning = fmt::format(
          "{}: the file is written, but a power failure now may undo it: its directory cannot be synchronised ({})",
          path, std::generic_category().message(errno));
    }
    return true;
  }
  const int first_error = errno;
  ::unlink(temporary.c_str());
  errno = first_error;
  return false;
}

}  // namespace

std::optional<Source> read_file(const std::string& path, std::string& why) {
  const bool is_standard = path == "-";
  const Descriptor file(is_standard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC), !is_standard);
  std::string bytes;
  if (file.number() < 0 || !read_all(file.number(), bytes)) {
    why = reason(path, errno);
    return std::nullopt;
  }
  if (bytes.size() > Source::size_limit) {
    why = path + ": more than 64 MB: this is no device description";
    return std::nullopt;
  }
  return Source(is_standard ? "<stdin>" : path, std::move(bytes));
}

Written write_file(const std::string& path, std::string_view bytes, std::string& why) {
  why.clear();
  if (path != "-" && has_bytes(path, bytes)) {
    return Written::unchanged;
  }
  std::error_code error;
  const bool is_stream =
      path == "-" || (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error));
  bool is_written = false;
  if (path == "-") {
    is_written = write_all(STDOUT_FILENO, bytes);
  } else if (is_stream) {  // a device or a pipe is written to, not replaced by a file
    Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    is_written = file.number() >= 0 && write_all(file.number(), bytes) && file.close();
  } else {
    is_written = replace_file(path, bytes, why);
  }
  if (!is_written) {
    why = reason(path, errno);
  }
  return is_written ? Written::yes : Written::no;
}

}  // namespace lexican::codict
