// SPDX-License-Identifier: Apache-2.0
// The bit rate of a bus is found by listening: an adapter in place of hardware, which executes the commands of slcan.
#include "program/rate.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <string>
#include <thread>

#include "bus/open.hpp"
#include "process.hpp"

namespace {

using namespace lexican::host_bus;
using lexican::program::HeardRate;
using lexican::program::listen_for_rate;

/// An slcan adapter on a pseudo-terminal, on a bus with heartbeats of a device, which also answers SDO uploads.
class Adapter {
 public:
  struct Kind {
    char rate = '6';           ///< code of the bus's bit rate; 0: no frames
    bool can_listen = true;    ///< it has the command L
    bool is_alone = false;     ///< the device is alone with the adapter: its frames need an acknowledge
    std::string stale = "";    ///< frames that it sends after each command C, too late
    std::string refused = "";  ///< letter of a command that it refuses
  };

  explicit Adapter(Kind kind) : kind_(std::move(kind)), fd_(posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    REQUIRE(fd_ >= 0);
    grantpt(fd_);
    unlockpt(fd_);
    path_ = ptsname(fd_);
    device_ = open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios settings{};
    tcgetattr(device_, &settings);
    cfmakeraw(&settings);
    tcsetattr(device_, TCSANOW, &settings);
    thread_ = std::thread([this] { run(); });
  }
  ~Adapter() {
    is_ended_ = true;
    thread_.join();
    close(device_);
    close(fd_);
  }
  Adapter(const Adapter&) = delete;
  Adapter& operator=(const Adapter&) = delete;

  const std::string& path() const { return path_; }
  void wait_for_command() const {
    while (!has_command_) {
      std::this_thread::yield();
    }
  }
  /// Returns the commands so far, separated by spaces. Context: after the last use of the adapter.
  std::string commands() {
    is_ended_ = true;
    thread_.join();
    thread_ = std::thread([] {});
    return commands_;
  }

 private:
  void run() {
    for (;;) {
      pollfd wanted{fd_, POLLIN, 0};
      if (poll(&wanted, 1, 10) > 0) {
        char byte = 0;
        if (read(fd_, &byte, 1) == 1 && byte != '\r') {
          line_ += byte;
        } else {
          execute();
        }
      } else if (is_ended_) {
        return;
      } else if (is_on_bus()) {
        answer("t70517F\r");
      }
    }
  }

  bool is_on_bus() const { return rate_ == kind_.rate && (mode_ == 'O' || (mode_ == 'L' && !kind_.is_alone)); }

  void execute() {
    const char letter = line_.empty() ? '\0' : line_[0];
    if (letter == 'S') {
      rate_ = line_[1];
    }
    if (letter == 'C' || letter == 'O' || letter == 'L') {
      mode_ = letter == 'L' && !kind_.can_listen ? 'C' : letter;
    }
    has_command_ = has_command_ || letter == 'S';
    if (letter != 't') {
      commands_ += line_ + ' ';
    }
    const bool is_refused =
        (letter == 'L' && !kind_.can_listen) || (letter != '\0' && kind_.refused == std::string(1, letter));
    answer(is_refused ? "\a" : "\r");
    if (letter == 'C') {
      answer(kind_.stale);
    }
    if (letter == 't' && mode_ == 'O' && is_on_bus() && line_.substr(1, 3) == "605") {
      answer("t585880" + line_.substr(7, 6) + "00000206\r");
    }
    line_.clear();
  }

  void answer(const std::string& text) const { CHECK(write(fd_, text.data(), text.size()) == ssize_t(text.size())); }

  Kind kind_;
  int fd_;
  int device_ = -1;
  std::string path_;
  std::atomic<bool> is_ended_{false};
  std::atomic<bool> has_command_{false};
  char rate_ = '0';
  char mode_ = 'C';
  std::string line_;
  std::string commands_;
  std::thread thread_;
};

HeardRate listen(Adapter& adapter, bool acknowledges, unsigned rounds, std::unique_ptr<Bus>* kept = nullptr) {
  std::string why;
  std::unique_ptr<Bus> bus = open_bus("slcan:" + adapter.path(), {0, true}, why);
  REQUIRE_MESSAGE(bus != nullptr, why);
  const HeardRate heard = listen_for_rate(*bus, {0, true, acknowledges}, 100'000, rounds, lexican::Interruption());
  if (kept != nullptr) {
    *kept = std::move(bus);
  }
  return heard;
}

test::Ran lexican(const std::string& words) {
  return test::Process({"/bin/sh", "-c", "exec \"$0\" " + words, LEXICAN_PROGRAM}, {{"LEXICAN_BUS", ""}}).finish();
}

}  // namespace

TEST_CASE("rate: each bit rate of slcan is found, and nothing else than commands is sent") {
  for (const auto& [code, rate] : {std::pair('6', 500'000U), {'4', 125'000U}, {'0', 10'000U}}) {
    Adapter adapter({code});
    const HeardRate heard = listen(adapter, false, 3);
    CHECK(heard.bit_rate == rate);
    CHECK(heard.frames > 1);
    CHECK(!heard.is_refused);
    const std::string commands = adapter.commands();
    CHECK(commands.find('O') == std::string::npos);
    CHECK(commands.find('t') == std::string::npos);
  }
}

TEST_CASE("rate: frames that an adapter still holds from the rate before do not count") {
  Adapter adapter({'5', true, false, "t70517F\rt70517F\r"});
  CHECK(listen(adapter, false, 1).bit_rate == 250'000);
}

TEST_CASE("rate: a silent bus, a device that is alone, an adapter that cannot listen only") {
  Adapter silent({'\0'});
  CHECK(listen(silent, false, 1).bit_rate == 0);
  Adapter alone({'5', true, true});
  CHECK(listen(alone, false, 1).bit_rate == 0);
  CHECK(listen(alone, true, 1).bit_rate == 250'000);
  Adapter simple({'5', false});
  const HeardRate heard = listen(simple, false, 1);
  CHECK(heard.is_refused);
  CHECK(heard.bit_rate == 0);
  CHECK(simple.commands() == "C L C S6 L C ");
}

TEST_CASE("rate: an adapter that goes ends the search") {
  auto adapter = std::make_unique<Adapter>(Adapter::Kind{'0'});
  std::string why;
  std::unique_ptr<Bus> bus = open_bus("slcan:" + adapter->path(), {0, true}, why);
  REQUIRE(bus != nullptr);
  adapter.reset();
  CHECK(listen_for_rate(*bus, {0, true}, 1'000'000, 100, lexican::Interruption()).bit_rate == 0);
  CHECK(!bus->fault().empty());
}

TEST_CASE("lexican: a verb finds the bit rate before it sends") {
  Adapter adapter({'5'});
  const test::Ran ran = lexican("read 5 6041 --timeout 60000 -i slcan:" + adapter.path());
  CHECK(ran.out == "");
  CHECK(ran.err.find("lexican: bit rate: 250 kbit/s (") == 0);
  CHECK(ran.err.find("node 5, 6041h:00: aborted with 0602 0000h") != std::string::npos);
  CHECK(ran.status == 1);
  CHECK(adapter.commands() == "C L C S6 L C S5 L C S5 O C ");
}

TEST_CASE("lexican: an adapter that cannot listen only is not tried without --yes") {
  Adapter adapter({'6', false});
  const test::Ran ran = lexican("scan -i slcan:" + adapter.path());
  CHECK(ran.out == "");
  CHECK(ran.err == "lexican: slcan adapter " + adapter.path() +
                       " has refused the command L: it cannot listen only. Give its bit rate by --rate; or try each "
                       "rate by --yes, which disturbs a bus with another rate\n");
  CHECK(ran.status == 2);
  CHECK(adapter.commands().find('O') == std::string::npos);
  Adapter other({'6', false});
  const test::Ran sure = lexican("read 5 6041 --yes --timeout 60000 -i slcan:" + other.path());
  CHECK(sure.err.find("lexican: bit rate: 500 kbit/s (") == 0);
  CHECK(sure.status == 1);
}

TEST_CASE("lexican: Ctrl-C ends the search for the bit rate") {
  Adapter adapter({'\0'});
  test::Process scan({LEXICAN_PROGRAM, "scan", "-i", "slcan:" + adapter.path()}, {{"LEXICAN_BUS", ""}});
  adapter.wait_for_command();
  scan.send(SIGINT);
  const test::Ran ran = scan.finish();
  CHECK(ran.err == "lexican: interrupted\n");
  CHECK(ran.status == 130);
  CHECK(adapter.commands().find("S8") == std::string::npos);
}

TEST_CASE("lexican: an adapter that refuses a command or a frame is named") {
  const auto refuses = [](const std::string& words, const std::string& command, const std::string& remedy, int status) {
    CAPTURE(words);
    Adapter adapter({'6', command != "L", false, "", command});
    const test::Ran ran = lexican(words + " -i slcan:" + adapter.path() + "@500k");
    CHECK(ran.out == "");
    CHECK(ran.err == "lexican: slcan adapter " + adapter.path() + " has refused " + remedy + "\n");
    CHECK(ran.status == status);
  };
  refuses("mon", "L", "the command L: it cannot listen only; --ack acknowledges frames", 4);
  refuses("read 5 1008", "O", "the command O", 4);
  refuses("read 5 1008", "S", "the command S6", 4);
  refuses("nmt start all --yes", "t", "a frame: the command was not sent", 4);
  refuses("read 5 1008 --timeout 500", "t", "a frame", 4);
}
