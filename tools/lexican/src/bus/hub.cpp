// SPDX-License-Identifier: Apache-2.0
#include "bus/hub.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "bus/clock.hpp"
#include "bus/hub_messages.hpp"
#include "bus/open.hpp"

namespace lexican::host_bus {
namespace {

constexpr const char* no_hub = "the program at this socket is not a hub of this version of lexican";
constexpr const char* ended = "the hub has ended";
constexpr std::size_t longest_greeting = 64;
constexpr std::uint32_t lowest_rate = 10'000;  // bit/s, of a paced hub
constexpr std::uint32_t highest_rate = 1'000'000;
constexpr int greeting_timeout = 1000;  // ms
constexpr Micros linger = 2'000'000;    // that a hub without clients waits for the next one

/// \retval -1  errno says why
int connect_to(const sockaddr_un& address) {
  const int fd = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd >= 0 && connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    const int error = errno;
    close(fd);
    errno = error;
    return -1;
  }
  return fd;
}

/// Creates a directory for this user only.
/// \retval false  it is not safe; \a why says so
bool make_directory(const std::string& path, std::string& why) {
  struct stat found {};
  if (mkdir(path.c_str(), 0700) != 0 && errno != EEXIST) {
    why = "the directory " + path + " cannot be created: " + std::strerror(errno);
  } else if (lstat(path.c_str(), &found) != 0 || !S_ISDIR(found.st_mode) || found.st_uid != geteuid() ||
             (found.st_mode & 077U) != 0) {
    why = path + " has to be a directory of this user that others may not enter (chmod 700)";
  }
  return why.empty();
}

/// A lock file, so that one program at a time starts or ends the server of a hub.
class Lock {
 public:
  explicit Lock(const std::string& path) : fd_(::open((path + ".lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600)) {
    if (fd_ >= 0) {
      flock(fd_, LOCK_EX);
    }
  }
  ~Lock() {
    if (fd_ >= 0) {
      close(fd_);
    }
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  int fd_;
};

/// Leaves the terminal, the files and the directory of the program that has started the server.
void detach(const HubServer& server) {
  setsid();
  if (chdir("/") != 0) {
    return;
  }
  const int null = ::open("/dev/null", O_RDWR);
  for (int fd = 0; fd < 3; ++fd) {
    dup2(null, fd);
  }
  const auto listener = static_cast<unsigned>(server.listener());
  if (listener > 3) {
    close_range(3, listener - 1, 0);
  }
  close_range(listener + 1, ~0U, 0);
}

/// Runs the server in a process that is no child of this one.
bool run_in_background(HubServer& server) {
  const pid_t child = fork();
  if (child == 0) {
    if (fork() == 0) {
      detach(server);
      run_hub(server);
    }
    _exit(0);
  }
  return child > 0 && waitpid(child, nullptr, 0) == child;
}

/// Starts the server of a hub, unless another program has done so meanwhile, and connects to it.
/// \retval -1  \a why or errno says why
int start(const std::string& path, const sockaddr_un& address, std::uint32_t bit_rate, std::string& why) {
  const Lock lock(path);
  const int fd = connect_to(address);
  if (fd >= 0) {
    return fd;
  }
  unlink(path.c_str());
  HubServer server(bit_rate != 0 ? "simulated " + std::to_string(bit_rate) : "simulated", bit_rate);
  return server.open(path, why) && run_in_background(server) ? connect_to(address) : -1;
}

/// Connects to the server of a hub; starts it, with this bit rate, if there is none.
/// \retval -1  \a why says why
int connect_or_start(const std::string& path, std::uint32_t bit_rate, std::string& why) {
  sockaddr_un address{};
  if (!address_of(path, address, why)) {
    return -1;
  }
  int fd = connect_to(address);
  fd = fd >= 0 ? fd : start(path, address, bit_rate, why);
  if (fd < 0 && why.empty()) {
    why = "the hub at " + path + " does not answer: " + std::strerror(errno);
  }
  return fd;
}

/// Removes the path of a server without clients.
/// \retval false  a client has connected at this moment
bool is_ended(HubServer& server) {
  const Lock lock(server.path());
  server.process(clock_now(CLOCK_REALTIME));
  return server.clients() == 0 && (unlink(server.path().c_str()) == 0 || errno == ENOENT);
}

class HubBus : public Bus {
 public:
  /// \a bit_rate: that the hub has to have; 0: any.
  HubBus(std::string path, bool starts_server, std::uint32_t bit_rate)
      : path_(std::move(path)), starts_server_(starts_server), required_rate_(bit_rate), bit_rate_(bit_rate) {}
  ~HubBus() override { disconnect(""); }
  HubBus(const HubBus&) = delete;
  HubBus& operator=(const HubBus&) = delete;

  pollfd wanted() override { return {fd_, static_cast<short>(is_refused_ ? POLLIN | POLLOUT : POLLIN), 0}; }

  std::optional<Entry> receive() override {
    std::array<char, longest_greeting> bytes{};
    while (fd_ >= 0) {
      const ssize_t size = recv(fd_, bytes.data(), bytes.size(), 0);
      if (size < 0 && (errno == EAGAIN || errno == EINTR)) {
        return std::nullopt;
      }
      const std::string_view message(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
      if (message.empty()) {
        disconnect(is_greeted_ ? ended : no_hub);
      } else if (!is_greeted_) {
        read_greeting(message);
      } else if (const std::optional<Entry> entry = entry_of(message)) {
        return entry;
      }
    }
    return std::nullopt;
  }

  bool send(const CO_IF_FRM& frame) override {
    const HubMessage message = message_with(frame);
    const ssize_t size = fd_ < 0 ? -1 : ::send(fd_, message.data(), message.size(), MSG_NOSIGNAL);
    is_refused_ = size < 0 && fd_ >= 0 && (errno == EAGAIN || errno == EINTR);
    if (size < 0 && !is_refused_ && fd_ >= 0) {
      disconnect(ended);
    }
    return size >= 0;
  }

  bool restore() override {
    if (fd_ >= 0) {
      return true;
    }
    std::string why;
    sockaddr_un address{};
    if (starts_server_ && !was_adapter_) {
      fd_ = connect_or_start(path_, bit_rate_, why);
    } else if (address_of(path_, address, why)) {
      fd_ = connect_to(address);
      why = fd_ >= 0 ? "" : path_ + ": " + std::strerror(errno);
    }
    fault_ = why;
    is_greeted_ = is_refused_ = false;
    return fd_ >= 0;
  }

  /// Waits for the greeting.
  bool is_greeted() {
    pollfd answer{fd_, POLLIN, 0};
    poll(&answer, 1, greeting_timeout);
    std::array<char, longest_greeting> bytes{};
    const ssize_t size = recv(fd_, bytes.data(), bytes.size(), 0);
    if (size <= 0) {
      disconnect(ended);
    } else {
      read_greeting({bytes.data(), static_cast<std::size_t>(size)});
    }
    return is_greeted_;
  }

  const std::string& fault() const override { return fault_; }
  std::uint64_t lost() const override { return lost_; }
  bool is_physical() const override { return is_physical_; }
  std::uint32_t bit_rate() const override { return bit_rate_; }

 private:
  void read_greeting(std::string_view text) {
    constexpr std::string_view simulated = "simulated";
    if (text.substr(0, hub_greeting.size()) != hub_greeting) {
      disconnect(no_hub);
      return;
    }
    text.remove_prefix(hub_greeting.size());
    is_greeted_ = true;
    const bool is_simulated = text.substr(0, simulated.size()) == simulated;
    if (was_adapter_ && is_simulated) {  // commands that the user means for devices would reach nothing
      disconnect("the hub is a simulated one now, and was an adapter");
      return;
    }
    is_physical_ = !is_simulated;
    was_adapter_ = is_physical_;
    const std::size_t space = text.find(' ');
    std::uint32_t rate = 0;
    if (space != std::string_view::npos) {
      parse_number(text.substr(space + 1), rate);
    }
    if (required_rate_ != 0 && rate != required_rate_) {
      disconnect("the hub " + (rate == 0 ? "has no bit rate" : "has " + std::to_string(rate) + " bit/s") + ", not " +
                 std::to_string(required_rate_) + " bit/s: open it without @, or end the programs that use it");
    }
    bit_rate_ = fd_ >= 0 ? rate : bit_rate_;
  }

  std::optional<Entry> entry_of(std::string_view bytes) {
    HubMessage message{};
    std::copy_n(bytes.begin(), std::min(bytes.size(), message.size()), message.begin());
    const bool is_whole = bytes.size() == message.size();
    Entry entry;
    if (is_whole && message[0] == 'F' && frame_of(message, entry.frame)) {
      entry.time = number_at(message, 8, 8);
      entry.direction = Direction::received;
      return entry;
    }
    if (is_whole && message[0] == 'L') {
      lost_ += number_at(message, 4, 4);
    } else {
      disconnect(no_hub);
    }
    return std::nullopt;
  }

  void disconnect(std::string why) {
    if (fd_ >= 0) {
      close(fd_);
    }
    fd_ = -1;
    fault_ = std::move(why);
  }

  std::string path_;
  bool starts_server_;
  int fd_ = -1;
  bool is_greeted_ = false;
  bool is_refused_ = false;      // the last frame to send
  bool was_adapter_ = false;     // a greeting has said so: this program is no server for it
  bool is_physical_ = true;      // until the greeting says otherwise
  std::uint32_t required_rate_;  // bit/s; 0: any
  std::uint32_t bit_rate_;       // of the greeting, and of a server that is started
  std::uint64_t lost_ = 0;
  std::string fault_;
};

}  // namespace

void run_hub(HubServer& server) {
  Micros last_used = clock_now(CLOCK_MONOTONIC);
  Micros now = last_used;
  while (now - last_used < linger || !is_ended(server)) {
    std::vector<pollfd> wanted = server.wanted();
    constexpr Micros longest = 500'000;
    const Micros time = clock_now(CLOCK_REALTIME);
    const Micros due = server.due().value_or(time + longest);
    const Micros limit = due > time ? std::min(due - time, longest) : 0;
    const timespec timeout{0, static_cast<long>(limit * 1000)};
    ppoll(wanted.data(), wanted.size(), &timeout, nullptr);
    server.process(clock_now(CLOCK_REALTIME));
    now = clock_now(CLOCK_MONOTONIC);
    last_used = server.clients() != 0 ? now : last_used;
  }
}

namespace {

bool is_hub_name(const std::string& name) {
  return !name.empty() && name.size() <= 40 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' || c == '_';
  });
}

constexpr const char* wrong_hub_name = "the name of a hub has 1 to 40 letters, digits, - and _";

}  // namespace

std::string hub_name_fault(std::string& name, BusOptions& options) {
  std::string why;
  if (!split_rate(name, options, why)) {
    return why;
  }
  if (options.bit_rate != 0 && (options.bit_rate < lowest_rate || options.bit_rate > highest_rate)) {
    return "the bit rate of a hub is 10k to 1M";
  }
  return is_hub_name(name) ? "" : wrong_hub_name;
}

std::string hub_path(const std::string& name, std::string& why) {
  if (!is_hub_name(name)) {
    why = wrong_hub_name;
    return {};
  }
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  const std::string directory = runtime != nullptr && runtime[0] == '/' ? std::string(runtime) + "/lexican"
                                                                        : "/tmp/lexican-" + std::to_string(geteuid());
  return make_directory(directory, why) ? directory + '/' + name + ".hub" : std::string();
}

std::unique_ptr<Bus> open_hub(std::string name, std::string& why) {
  BusOptions options;
  why = hub_name_fault(name, options);
  if (!why.empty()) {
    return nullptr;
  }
  const std::string path = hub_path(name, why);
  constexpr unsigned most_tries = 3;  // a server may end at this moment
  for (unsigned n = 0; n < most_tries && !path.empty(); ++n) {
    auto bus = std::make_unique<HubBus>(path, true, options.bit_rate);
    const bool is_greeted = bus->restore() && bus->is_greeted();
    why = bus->fault();
    if (is_greeted) {
      return why.empty() ? std::move(bus) : nullptr;
    }
  }
  return nullptr;
}

std::unique_ptr<Bus> connect_to_hub(const std::string& path, std::string& why) {
  auto bus = std::make_unique<HubBus>(path, false, 0);
  if (!bus->restore()) {
    why = bus->fault();
    return nullptr;
  }
  return bus;
}

}  // namespace lexican::host_bus
