// SPDX-License-Identifier: Apache-2.0
// Buses by name.
#include "bus/open.hpp"

#include <doctest/doctest.h>
#include <stdlib.h>

#include <filesystem>
#include <string>

namespace {

using namespace lexican::host_bus;

TEST_CASE("open_bus: a name selects the kind of bus, and listening does not send") {
  char directory[] = "/tmp/lexican-test-XXXXXX";
  setenv("XDG_RUNTIME_DIR", mkdtemp(directory), 1);
  const std::string name = "hub:open";
  std::string why;
  const std::unique_ptr<Bus> sender = open_bus(name, {}, why);
  const std::unique_ptr<Bus> listener = open_bus(name, {0, true}, why);
  REQUIRE_MESSAGE((sender != nullptr && listener != nullptr), why);
  CHECK(!sender->is_physical());
  CHECK(!listener->is_physical());
  CHECK(!listener->send({0x123, {}, 0}));
  REQUIRE(sender->send({0x321, {}, 0}));
  pollfd wait = listener->wanted();
  poll(&wait, 1, 1000);
  const std::optional<Entry> entry = listener->receive();
  REQUIRE(entry);
  CHECK(entry->frame.Identifier == 0x321);
  CHECK(!sender->receive());
  unsetenv("XDG_RUNTIME_DIR");
  std::filesystem::remove_all(directory);
}

TEST_CASE("open_bus: only an adapter needs a bit rate") {
  CHECK(needs_rate("slcan:/dev/ttyACM0", {}));
  for (const char* const name : {"slcan:/dev/ttyACM0@500k", "hub:bench", "hub:bench@500k", "can0", "slcan-pty"}) {
    CHECK(!needs_rate(name, {}));
  }
}

TEST_CASE("open_bus: a bus that cannot be opened is named with the reason") {
  std::string why;
  CHECK(open_bus("hub:../x", {}, why) == nullptr);
  CHECK(why == "the name of a hub has 1 to 40 letters, digits, - and _");
  CHECK(open_bus("no-such-can", {}, why) == nullptr);
  CHECK_MESSAGE((why.find("no-such-can") != std::string::npos || why.find("CAN") != std::string::npos), why);
  CHECK(open_bus("", {}, why) == nullptr);
  CHECK(!why.empty());
}

}  // namespace
