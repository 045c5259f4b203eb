// SPDX-License-Identifier: Apache-2.0
// replay:FILE: a log as a bus.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bus/open.hpp"

namespace {

using namespace lexican::host_bus;

/// File that exists during a test.
class File {
 public:
  explicit File(const std::string& text) {
    char path[] = "/tmp/lexican-replay-XXXXXX";
    const int fd = mkstemp(path);
    REQUIRE(fd >= 0);
    REQUIRE(write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size()));
    close(fd);
    path_ = path;
  }
  ~File() { std::filesystem::remove(path_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

bool is_readable(Bus& bus) {
  pollfd wanted = bus.wanted();
  return poll(&wanted, 1, 0) == 1 && (wanted.revents & POLLIN) != 0;
}

/// Returns "time frame" of all entries.
std::vector<std::string> read(Bus& bus) {
  std::vector<std::string> entries;
  for (bool is_entry = true; is_entry;) {
    CHECK(is_readable(bus));
    const std::optional<Entry> entry = bus.receive();
    is_entry = entry.has_value();
    if (entry) {
      entries.push_back(std::to_string(entry->time) + ' ' + to_text(entry->frame));
    }
  }
  return entries;
}

const char* const text =
    "(1.000000) can0 123#11\n(2.500000) can1 12345678#R\nDROPCOUNT: dropped 3 CAN frames on 'can0' socket\nrubbish\n"
    "(2.600000) can0 123##0\n";
using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("replay: a log is a bus that is lost at its end") {
  const File file(text);
  std::string why;
  const std::unique_ptr<Bus> bus = open_bus("replay:" + file.path(), {}, why);
  REQUIRE_MESSAGE(bus != nullptr, why);
  CHECK_FALSE(bus->is_physical());
  CHECK(bus->bit_rate() == 0);
  CHECK(bus->fault().empty());
  CHECK_FALSE(bus->send({0x123, {}, 0}));
  CHECK(read(*bus) == Texts{"1000000 123#11", "2500000 12345678#R"});
  CHECK(bus->fault() == "the log has ended");
  CHECK(bus->wanted().fd == -1);
  CHECK_FALSE(bus->receive());
  CHECK_FALSE(bus->restore());
  CHECK_FALSE(bus->send({0x123, {}, 0}));
  CHECK(bus->lost() == 3);
  REQUIRE(bus->log() != nullptr);
  CHECK(bus->log()->channels() == Texts{"can0", "can1"});
  CHECK(bus->log()->malformed() == 1);
  CHECK(bus->log()->other_frames() == 1);
}

TEST_CASE("replay: listening only gives access to the log, too") {
  const File file(text);
  std::string why;
  const std::unique_ptr<Bus> bus = open_bus("replay:" + file.path(), {0, true}, why);
  REQUIRE_MESSAGE(bus != nullptr, why);
  CHECK(read(*bus).size() == 2);
  REQUIRE(bus->log() != nullptr);
  CHECK(bus->log()->channels().size() == 2);
}

TEST_CASE("replay: the fault of the reader is that of the bus") {
  const File file("(1.000000) can0 123#11\n (000.000000)  can0  123   [1]  11\n");
  std::string why;
  const std::unique_ptr<Bus> bus = open_bus("replay:" + file.path(), {}, why);
  REQUIRE_MESSAGE(bus != nullptr, why);
  CHECK(read(*bus) == Texts{"1000000 123#11"});
  CHECK(bus->fault() == "the output of candump for the screen; candump -l or -L writes a log");
  CHECK(bus->wanted().fd == -1);
}

TEST_CASE("replay: a file that cannot be read is named with the reason") {
  std::string why;
  CHECK(open_bus("replay:/tmp/no-such-log", {}, why) == nullptr);
  CHECK(why == "/tmp/no-such-log: No such file or directory");
  CHECK(open_bus("replay:/tmp", {}, why) == nullptr);
  CHECK_MESSAGE(why.find("/tmp: ") == 0, why);
  const File empty("");
  CHECK(open_bus("replay:" + empty.path(), {}, why) == nullptr);
  CHECK(why == empty.path() + ": the file is empty");
}

TEST_CASE("replay: - is standard input") {
  const File file(text);
  const int saved = dup(0);
  const int fd = open(file.path().c_str(), O_RDONLY | O_CLOEXEC);
  REQUIRE(fd >= 0);
  REQUIRE(dup2(fd, 0) == 0);
  std::string why;
  const std::unique_ptr<Bus> bus = open_bus("replay:-", {}, why);
  const Texts entries = bus != nullptr ? read(*bus) : Texts{why};
  dup2(saved, 0);
  close(saved);
  close(fd);
  CHECK(entries == Texts{"1000000 123#11", "2500000 12345678#R"});
}
