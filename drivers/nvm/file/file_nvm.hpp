// SPDX-License-Identifier: Apache-2.0
/// \file file_nvm.hpp
/// Driver for a parameter memory in a file.
///
///     co::FileNvm memory;
///     if (!memory.open("/var/lib/node/parameters", 4096)) { report(memory.error()); }
///     ext.Nvm = &co::FileNvmDriver;  ext.NvmCtx = &memory;   // CO_NODE_EXT
///
/// A file that does not exist is created; a file that is shorter than the capacity is extended with FFh, like erased
/// memory. A longer file keeps the bytes beyond the capacity. Accesses are limited to the capacity and return the
/// number of bytes processed. Write returns after the data has reached the storage device (fdatasync); if that fails it
/// returns 0, because the content is undefined then. error() returns a text for the last error.
///
/// Context: one thread. Owner: the caller; must outlive the node. One process per file: the file is not locked.
#ifndef CO_DRIVERS_FILE_NVM_HPP_
#define CO_DRIVERS_FILE_NVM_HPP_

#include <cstdint>
#include <string>

#include "co_nvm_file.h"

namespace co {

/// A parameter memory in a file: the context of FileNvmDriver. Not copyable: it owns a file descriptor.
class FileNvm {
 public:
  /// Constructs a memory without file; its capacity is 0.
  FileNvm() = default;
  /// Closes the file. The node must not use it any more.
  ~FileNvm();
  FileNvm(const FileNvm&) = delete;
  FileNvm& operator=(const FileNvm&) = delete;

  /// Opens or creates the file, after closing the previous one. \a capacity: bytes.
  /// \retval true   the file is open
  /// \retval false  it cannot be used; error() returns the reason
  bool open(const std::string& path, std::uint32_t capacity);
  /// Closes the file; its capacity is then 0.
  void close();

  /// Reads \a size bytes from position \a start into \a buffer. Returns the number of bytes read: less than \a size at
  /// the end of the capacity or after an error.
  std::uint32_t read(std::uint32_t start, std::uint8_t* buffer, std::uint32_t size);
  /// Writes \a size bytes from \a buffer to position \a start and waits until the storage device has them. Returns the
  /// number of bytes written: less than \a size at the end of the capacity or after an error, 0 if the device has
  /// reported a failure.
  std::uint32_t write(std::uint32_t start, const std::uint8_t* buffer, std::uint32_t size);

  /// Returns the capacity in bytes, 0: not open.
  std::uint32_t capacity() const { return capacity_; }
  /// Returns the text of the last error, empty after a successful open().
  const std::string& error() const { return error_; }

 private:
  bool extend_to_capacity();
  std::uint32_t bytes_inside(std::uint32_t start, std::uint32_t size) const;
  std::uint32_t write_all(std::uint32_t start, const std::uint8_t* buffer, std::uint32_t size);
  bool fail_with(const char* action);

  std::string path_;
  std::string error_;
  std::uint32_t capacity_ = 0;
  int fd_ = -1;
};

/// The driver; its context is a FileNvm.
inline constexpr const CO_IF_NVM_DRV_EX& FileNvmDriver = COFileNvmDriver;

}  // namespace co

#endif
