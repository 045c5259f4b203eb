// SPDX-License-Identifier: Apache-2.0
// Drivers of non-volatile memory: in RAM, and in a file.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "co_nvm_ram.h"

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>

#include <climits>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "file_nvm.hpp"
#endif

namespace {

using Bytes = std::vector<std::uint8_t>;

// Checks accesses through the driver table, which are equal for both memories.
void check_accesses(const CO_IF_NVM_DRV_EX& driver, void* ctx, std::uint32_t capacity) {
  driver.Init(ctx);
  const CO_NVM_SHAPE shape = driver.Shape(ctx);
  CHECK(shape.Capacity == capacity);
  CHECK(shape.ProgramSize == 1);
  CHECK(shape.EraseSize == 0);
  const bool erases = driver.Erase != nullptr;
  CHECK_FALSE(erases);

  Bytes buffer(capacity, 0);
  CHECK(driver.Read(ctx, 0, buffer.data(), capacity) == capacity);
  CHECK(buffer == Bytes(capacity, 0xFF));

  const Bytes data = {1, 2, 3, 4};
  CHECK(driver.Write(ctx, 5, data.data(), 4) == 4);
  CHECK(driver.Read(ctx, 4, buffer.data(), 6) == 6);
  CHECK(Bytes(buffer.begin(), buffer.begin() + 6) == Bytes{0xFF, 1, 2, 3, 4, 0xFF});

  CHECK(driver.Write(ctx, capacity - 2, data.data(), 4) == 2);
  CHECK(driver.Read(ctx, capacity - 3, buffer.data(), 100) == 3);
  CHECK(Bytes(buffer.begin(), buffer.begin() + 3) == Bytes{0xFF, 1, 2});

  CHECK(driver.Read(ctx, capacity, buffer.data(), 1) == 0);
  CHECK(driver.Write(ctx, capacity, data.data(), 1) == 0);
  CHECK(driver.Read(ctx, capacity + 1, buffer.data(), 1) == 0);
  CHECK(driver.Write(ctx, capacity + 1, data.data(), 1) == 0);
  CHECK(driver.Read(ctx, UINT32_MAX, buffer.data(), UINT32_MAX) == 0);
  CHECK(driver.Write(ctx, UINT32_MAX, data.data(), 4) == 0);
  CHECK(driver.Read(ctx, 0, buffer.data(), 0) == 0);
  CHECK(driver.Write(ctx, 0, data.data(), 0) == 0);

  driver.Init(ctx);
  CHECK(driver.Read(ctx, 5, buffer.data(), 1) == 1);
  CHECK(buffer[0] == 1);  // Init does not clear the memory
}

}  // namespace

TEST_CASE("NVM in RAM: new memory is FFh, accesses are truncated at the end, and Init keeps the content") {
  Bytes memory(32, 0);
  CO_NVM_RAM ram = {memory.data(), 32};
  CONvmRamClear(&ram);
  check_accesses(RamNvmDriver, &ram, 32);
}

TEST_CASE("NVM in RAM: an empty and a missing memory are handled") {
  CO_NVM_RAM ram = {nullptr, 0};
  CONvmRamClear(&ram);
  CONvmRamClear(nullptr);
  std::uint8_t byte = 7;
  CHECK(RamNvmDriver.Read(&ram, 0, &byte, 1) == 0);
  CHECK(RamNvmDriver.Write(&ram, 0, &byte, 1) == 0);
  CHECK(byte == 7);
}

#ifdef __linux__

namespace {

// A directory that is removed at the end of the test.
class Directory {
 public:
  Directory() {
    char name[] = "/tmp/lexican-nvm-XXXXXX";
    REQUIRE(mkdtemp(name) != nullptr);
    path_ = name;
  }
  ~Directory() {
    unlink(file().c_str());
    rmdir(path_.c_str());
  }
  Directory(const Directory&) = delete;
  Directory& operator=(const Directory&) = delete;
  const std::string& path() const { return path_; }
  std::string file() const { return path_ + "/memory"; }

 private:
  std::string path_;
};

// Limits the size of files as long as the object exists, to simulate a full device.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*signal_)(int);
};

Bytes content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void fill(const std::string& path, const Bytes& bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("NVM in a file: a new file is FFh, accesses are truncated at the capacity, and Init keeps the content") {
  const Directory directory;
  co::FileNvm nvm;
  REQUIRE(nvm.open(directory.file(), 10000));
  CHECK(nvm.error().empty());
  CHECK(content(directory.file()) == Bytes(10000, 0xFF));
  check_accesses(co::FileNvmDriver, &nvm, 10000);
}

TEST_CASE("NVM in a file: written bytes are read after reopening") {
  const Directory directory;
  const Bytes data = {0xDE, 0xAD, 0xBE, 0xEF};
  {
    co::FileNvm nvm;
    REQUIRE(nvm.open(directory.file(), 64));
    CHECK(nvm.write(60, data.data(), 4) == 4);
    CHECK(content(directory.file()).size() == 64);
  }
  co::FileNvm nvm;
  REQUIRE(nvm.open(directory.file(), 64));
  Bytes buffer(4, 0);
  CHECK(nvm.read(60, buffer.data(), 4) == 4);
  CHECK(buffer == data);
  nvm.close();
  CHECK(nvm.capacity() == 0);
  CHECK(nvm.read(60, buffer.data(), 4) == 0);
  CHECK(nvm.write(60, data.data(), 4) == 0);
}

TEST_CASE("NVM in a file: a short file is extended; bytes behind the capacity are kept") {
  const Directory directory;
  fill(directory.file(), {1, 2, 3});
  co::FileNvm nvm;
  REQUIRE(nvm.open(directory.file(), 6));
  CHECK(content(directory.file()) == Bytes{1, 2, 3, 0xFF, 0xFF, 0xFF});
  REQUIRE(nvm.open(directory.file(), 2));
  const Bytes data = {7, 8, 9};
  CHECK(nvm.write(1, data.data(), 3) == 1);
  CHECK(content(directory.file()) == Bytes{1, 7, 3, 0xFF, 0xFF, 0xFF});
}

TEST_CASE("NVM in a file: a read of a file that was truncated returns the remaining bytes and an error") {
  const Directory directory;
  co::FileNvm nvm;
  REQUIRE(nvm.open(directory.file(), 16));
  REQUIRE(truncate(directory.file().c_str(), 5) == 0);
  Bytes buffer(16, 0);
  CHECK(nvm.read(0, buffer.data(), 16) == 5);
  CHECK(nvm.error() == directory.file() + " cannot be read: it ends early");
}

TEST_CASE("NVM in a file: a failure to open is reported with the reason") {
  const Directory directory;
  co::FileNvm nvm;
  CHECK_FALSE(nvm.open(directory.path() + "/nowhere/memory", 16));
  CHECK(contains(nvm.error(), "/nowhere/memory cannot be opened: No such file or directory"));
  CHECK_FALSE(nvm.open(directory.path(), 16));
  CHECK(contains(nvm.error(), "cannot be opened: Is a directory"));
  CHECK_FALSE(nvm.open("/dev/null", 16));
  CHECK(nvm.error() == "/dev/null is not a regular file");
  CHECK(nvm.capacity() == 0);
  REQUIRE(nvm.open(directory.file(), 16));
  CHECK(nvm.error().empty());
}

TEST_CASE("NVM in a file: a full device prevents the creation, or truncates a write") {
  const Directory directory;
  co::FileNvm nvm;
  REQUIRE(nvm.open(directory.file(), 16));
  const Bytes data(16, 0x55);
  std::uint32_t written = 0;
  std::string write_error;
  bool made = true;
  {
    const FileSizeLimit limit(8);
    written = nvm.write(0, data.data(), 16);
    write_error = nvm.error();
    nvm.close();
    unlink(directory.file().c_str());
    made = nvm.open(directory.file(), 16);
  }
  CHECK(written == 8);
  CHECK(write_error == directory.file() + " cannot be written: File too large");
  CHECK_FALSE(made);
  CHECK(nvm.capacity() == 0);
  CHECK(nvm.error() == directory.file() + " cannot be filled: File too large");
  REQUIRE(nvm.open(directory.file(), 16));  // fills the rest of the file
  CHECK(content(directory.file()) == Bytes(16, 0xFF));
}

TEST_CASE("NVM in a file: a relative path is relative to the working directory") {
  const Directory directory;
  char before[PATH_MAX];
  REQUIRE(getcwd(before, sizeof before) != nullptr);
  REQUIRE(chdir(directory.path().c_str()) == 0);
  co::FileNvm nvm;
  const bool opened = nvm.open("memory", 8);
  REQUIRE(chdir(before) == 0);
  CHECK(opened);
  CHECK(content(directory.file()) == Bytes(8, 0xFF));
}

#endif
