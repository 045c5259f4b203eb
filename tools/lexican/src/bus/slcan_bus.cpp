// SPDX-License-Identifier: Apache-2.0
// Buses that use the slcan protocol: a serial adapter, an adapter behind TCP, and a pseudo-terminal or a connection
// that another program uses as its adapter. The driver CO_SLCAN decodes and encodes the frames.
#include "co_slcan.h"

#include <fcntl.h>
#include <netdb.h>
#include <netinet/tcp.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/inotify.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

#include "bus/hub_messages.hpp"
#include "bus/open.hpp"

namespace lexican::host_bus {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds connect_timeout{2000};
constexpr milliseconds answer_timeout{100};
constexpr milliseconds closing_timeout{500};  // for the rest of the text to be sent
constexpr std::size_t shortest_line = 6;      // "t0000" and CR
constexpr std::size_t read_size = 256;        // bytes that are read at once
constexpr std::size_t most_frames = 64;       // that the driver stores; more than are read at once
constexpr unsigned reads_in_turn = 64;        // of one call of receive(), so that invalid lines cannot keep it busy
constexpr std::size_t most_waiting = 65536;   // bytes that a program that is served has not read
constexpr std::size_t most_text = 1024;       // to be sent, above which no further commands are read
static_assert(read_size / shortest_line < most_frames);

// --- Names

/// Bit rates of the commands S0 to S8.
constexpr std::array<std::uint32_t, 9> rates = {10000, 20000, 50000, 100000, 125000, 250000, 500000, 800000, 1000000};

/// Returns the command that sets a bit rate, such as S6; empty: the adapter keeps its rate.
/// \retval false  slcan does not have the rate; \a why says which ones it has
bool rate_command(std::uint32_t bit_rate, std::string& command, std::string& why) {
  const auto* const rate = std::find(rates.begin(), rates.end(), bit_rate);
  const bool is_available = rate != rates.end();
  if (bit_rate != 0 && !is_available) {
    why = "slcan does not have " + std::to_string(bit_rate) +
          " bit/s; it has 10, 20, 50, 100, 125, 250, 500, 800 and 1000 kbit/s";
  }
  command = is_available ? "S" + std::to_string(rate - rates.begin()) : "";
  return bit_rate == 0 || is_available;
}

// --- Descriptors

/// Opens a serial device and discards bytes received before. USB adapters ignore the speed; others use this one.
/// \retval -1  errno says why
int open_serial(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
  termios settings{};
  if (fd < 0 || tcgetattr(fd, &settings) != 0) {
    const int error = errno;
    close(fd);
    errno = error;
    return -1;
  }
  cfmakeraw(&settings);
  cfsetspeed(&settings, B115200);
  settings.c_cflag |= static_cast<tcflag_t>(CLOCAL | CREAD);
  settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS);
  settings.c_cc[VMIN] = 1;  // a read of 0 bytes is a hang-up
  settings.c_cc[VTIME] = 0;
  tcflush(fd, TCIFLUSH);
  tcsetattr(fd, TCSANOW, &settings);
  return fd;
}

/// Excludes other programs from a serial device. A pseudo-terminal is only locked: it would remain exclusive after a
/// program that was killed.
/// \retval false  another program uses it
bool make_exclusive(int fd) {
  if (flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    return false;
  }
  constexpr unsigned first_pseudo_terminal = 136;  // major numbers. [linux/major.h]
  constexpr unsigned last_pseudo_terminal = 143;
  struct stat about {};
  fstat(fd, &about);
  const unsigned kind = major(about.st_rdev);
  if (kind < first_pseudo_terminal || kind > last_pseudo_terminal) {
    ioctl(fd, TIOCEXCL);
  }
  return true;
}

bool is_socket(const std::string& path) {
  struct stat about {};
  return stat(path.c_str(), &about) == 0 && S_ISSOCK(about.st_mode);
}

/// Starts to connect.
/// \retval -1  errno says why
int connect_to(int family, const sockaddr* address, socklen_t size) {
  const int fd = socket(family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd >= 0 && connect(fd, address, size) != 0 && errno != EINPROGRESS) {
    const int error = errno;
    close(fd);
    errno = error;
    return -1;
  }
  return fd;
}

/// Sends bytes. A socket whose other end is closed returns an error instead of raising a signal.
ssize_t write_bytes(int fd, const std::string& bytes) {
  const ssize_t sent = ::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  return sent < 0 && errno == ENOTSOCK ? ::write(fd, bytes.data(), bytes.size()) : sent;
}

/// Returns why a connection has ended, in words.
const char* reason_of(int error) {
  const bool is_closed = error == EPIPE || error == EIO || error == ENXIO || error == ENODEV || error == ECONNRESET;
  return is_closed ? "it is unplugged, or its other end is closed" : std::strerror(error);
}

// --- Buses

/// A stream of slcan lines in both directions.
class SlcanBus : public Bus {
 public:
  SlcanBus(std::string title, std::uint32_t bit_rate) : bit_rate_(bit_rate), title_(std::move(title)) {}
  ~SlcanBus() override {
    if (fd_ >= 0) {
      close(fd_);
    }
  }
  SlcanBus(const SlcanBus&) = delete;
  SlcanBus& operator=(const SlcanBus&) = delete;

  pollfd wanted() override {
    const int input = text_.size() < most_text ? POLLIN : 0;
    const int output = is_refused_ || has_text() ? POLLOUT : 0;
    return {fd_, static_cast<short>(input | output), 0};
  }

  std::optional<Entry> receive() override {
    Entry entry;
    for (unsigned n = 0;; ++n) {
      if (SlcanDriver.Read(&can_, &entry.frame) > 0) {
        entry.time = read_time_;
        entry.direction = Direction::received;
        return entry;
      }
      if (n == reads_in_turn || !read()) {
        flush();
        return std::nullopt;
      }
    }
  }

  bool send(const CO_IF_FRM& frame) override {
    if (fd_ < 0) {
      return false;
    }
    if (!carries() || (frame.Identifier & CO_IF_FRM_ERROR) != 0) {
      is_refused_ = false;
      return true;  // an error frame is not a line
    }
    flush();
    if (text_.size() < space()) {
      move_text();
    }
    is_refused_ = SlcanDriver.Send(&can_, &frame) == 0;
    flush();
    return !is_refused_ && fd_ >= 0;
  }

  const std::string& fault() const override { return fault_; }
  /// Returns the number of invalid lines: 65535 at most between two calls of restore(). The driver's queue does not
  /// overflow.
  std::uint64_t lost() const override { return lost_before_ + COSlcanMalformed(&can_); }
  bool is_physical() const override { return true; }
  std::uint32_t bit_rate() const override { return bit_rate_; }

 protected:
  /// Returns false while frames are not sent but discarded.
  virtual bool carries() const { return true; }
  /// Returns how many bytes of frames may wait beyond those that the driver stores.
  virtual std::size_t space() const { return 0; }
  /// Returns true if the other end is open.
  virtual bool has_other_end() const { return true; }
  /// Processes bytes that were read.
  virtual void process(std::string_view bytes) = 0;
  /// Called when the other end is closed.
  virtual void on_end(const std::string& why) { lose(why); }

  /// Begins with a descriptor, and with the driver on the bus. The driver's commands are discarded, as it does not have
  /// listen-only.
  void begin(int fd) {
    lost_before_ = lost();
    fd_ = fd;
    fault_.clear();
    is_refused_ = false;
    COSlcanInit(
        &can_, frames_.data(), static_cast<std::uint16_t>(frames_.size()), [](void* /*ctx*/) {}, nullptr);
    SlcanDriver.Init(&can_);
    SlcanDriver.Enable(&can_, 0);
    discard_text();
  }

  void lose(const std::string& why) {
    if (fd_ >= 0) {
      close(fd_);
    }
    fd_ = -1;
    fault_ = title_ + ": " + why;
  }

  /// Sends text, as much as the other end accepts now.
  void flush() {
    while (fd_ >= 0 && has_text() && write_some()) {
    }
  }

  bool has_text() const {
    const std::uint8_t* bytes = nullptr;
    return !text_.empty() || COSlcanPending(&can_, &bytes) != 0;
  }

  /// Sends text after the frames that were sent before.
  void append(std::string_view text) {
    move_text();
    text_ += text;
  }

  void discard_text() {
    move_text();
    text_.clear();
  }

  /// \retval false  there are no bytes, or no space for answers
  bool read() {
    std::array<char, read_size> bytes{};
    if (fd_ < 0 || text_.size() >= most_text) {
      return false;
    }
    const ssize_t size = ::read(fd_, bytes.data(), bytes.size());
    if (size > 0) {
      const auto now = std::chrono::system_clock::now().time_since_epoch();
      read_time_ = static_cast<Micros>(std::chrono::duration_cast<std::chrono::microseconds>(now).count());
      process({bytes.data(), static_cast<std::size_t>(size)});
      flush();
    } else if (size == 0 || (errno != EAGAIN && errno != EINTR)) {
      on_end(reason_of(size == 0 ? EPIPE : errno));
    }
    return size > 0;
  }

  const std::string& title() const { return title_; }

  int fd_ = -1;
  CO_SLCAN can_{};
  std::uint32_t bit_rate_;
  std::string fault_;

 private:
  /// Moves the lines of the driver to the text to be sent. They are complete.
  void move_text() {
    const std::uint8_t* bytes = nullptr;
    while (const std::uint32_t size = COSlcanPending(&can_, &bytes)) {
      text_.append(reinterpret_cast<const char*>(bytes), size);
      COSlcanSent(&can_, size);
    }
  }

  /// \retval false  the other end does not accept text now
  bool write_some() {
    if (!has_other_end()) {
      discard_text();
      return false;
    }
    if (text_.empty()) {
      move_text();  // not earlier: the driver refuses frames while its buffer is full
    }
    const ssize_t sent = write_bytes(fd_, text_);
    if (sent > 0) {
      text_.erase(0, static_cast<std::size_t>(sent));
    } else if (sent < 0 && errno != EAGAIN && errno != EINTR) {
      lose(reason_of(errno));
    }
    return sent > 0;
  }

  std::string title_;
  std::array<CO_IF_FRM, most_frames> frames_{};
  std::string text_;         // to be sent: complete lines, except for the begin of the first one
  bool is_refused_ = false;  // the last frame to send
  Micros read_time_ = 0;
  std::uint64_t lost_before_ = 0;  // lost() before the last restore()
};

/// An adapter. Its subclass opens the connection.
class AdapterBus : public SlcanBus {
 public:
  /// \a rate_command: such as S6; empty: the adapter keeps its rate.
  AdapterBus(const std::string& name, const BusOptions& options, const std::string& rate_command)
      : SlcanBus("slcan adapter " + name, options.bit_rate) {
    set_commands(options, rate_command);
  }

  /// Sends the rest of the text, and closes the channel. Otherwise close() would wait, for up to 30 seconds, for text
  /// that a serial device does not accept.
  ~AdapterBus() override {
    append("C\r");
    const Clock::time_point end = Clock::now() + closing_timeout;
    flush();
    while (fd_ >= 0 && is_unsent() && Clock::now() < end) {
      usleep(5000);
      flush();
    }
    if (fd_ >= 0 && is_unsent()) {
      tcflush(fd_, TCOFLUSH);
    }
  }
  AdapterBus(const AdapterBus&) = delete;
  AdapterBus& operator=(const AdapterBus&) = delete;

  bool restore() override {
    if (fd_ >= 0) {
      return true;
    }
    std::string why;
    const int fd = open_line(why);
    if (fd < 0) {
      fault_ = title() + ": " + why;
      return false;
    }
    begin(fd);
    send_commands();
    return fd_ >= 0;
  }

  bool configure(const BusOptions& options) override {
    std::string command;
    std::string why;
    if (!rate_command(options.bit_rate, command, why)) {
      return false;
    }
    bit_rate_ = options.bit_rate;
    set_commands(options, command);
    send_commands();
    return true;
  }

  /// Waits for the answers to the commands of opening. Some adapters do not answer.
  void await_answers() {
    const Clock::time_point end = Clock::now() + answer_timeout;
    while (fd_ >= 0 && answers_ < commands_.size() && CORingCount(&can_.Frames) == 0 && Clock::now() < end) {
      pollfd wanted = this->wanted();
      poll(&wanted, 1, 5);
      read();
      flush();
    }
  }

  std::string refusal() const override {
    return refused_.empty()
               ? ""
               : title() + " has refused " + refused_ + (bit_rate_ == 0 ? "; it may need a bit rate: @500k" : "");
  }

 protected:
  /// Opens the connection without waiting.
  /// \retval -1  \a why says why; it may be open at the next call
  virtual int open_line(std::string& why) = 0;

 private:
  void set_commands(const BusOptions& options, const std::string& rate_command) {
    commands_ = {"C"};
    if (!rate_command.empty()) {
      commands_.push_back(rate_command);
    }
    commands_.emplace_back(options.listens_only && !options.acknowledges ? "L" : "O");
  }

  void send_commands() {
    answers_ = 0;
    refused_.clear();
    for (const std::string& command : commands_) {
      append(command + '\r');
    }
    flush();
  }

  void process(std::string_view bytes) override {
    for (const char byte : bytes) {
      const std::uint16_t refused = COSlcanRefused(&can_);
      const bool is_accepted = byte == '\r' && can_.LineLen == 0;
      COSlcanReceive(&can_, static_cast<std::uint8_t>(byte));
      const bool is_refused = COSlcanRefused(&can_) != refused;
      if (is_refused) {
        note_refusal();
      }
      answers_ += is_accepted || is_refused ? 1U : 0U;
    }
  }

  /// Stores which line the adapter has refused. Some adapters refuse C if the channel is closed.
  void note_refusal() {
    if (answers_ >= commands_.size()) {
      refused_ = refused_.empty() ? "a frame" : refused_;
    } else if (answers_ != 0) {
      refused_ = "the command " + commands_[answers_];
    }
  }

  bool is_unsent() const {
    int queued = 0;
    return has_text() || (isatty(fd_) != 0 && ioctl(fd_, TIOCOUTQ, &queued) == 0 && queued != 0);
  }

  std::vector<std::string> commands_;
  std::size_t answers_ = 0;  // to the commands, and then to frames
  std::string refused_;
};

/// A serial device, or a Unix socket.
class SerialBus : public AdapterBus {
 public:
  SerialBus(const std::string& path, const BusOptions& options, const std::string& rate_command)
      : AdapterBus(path, options, rate_command), path_(path) {}

 private:
  int open_line(std::string& why) override {
    sockaddr_un address{};
    int fd = -1;
    if (!is_socket(path_)) {
      fd = open_serial(path_);
      if (fd >= 0 && !make_exclusive(fd)) {
        close(fd);
        fd = -1;
        errno = EBUSY;
      }
    } else if (address_of(path_, address, why)) {
      fd = connect_to(AF_UNIX, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    }
    if (fd < 0 && why.empty()) {
      why = errno == ENOTTY   ? "it is not a serial device"
            : errno == EBUSY  ? "another program uses it; lexican share hands it to several"
            : errno == EACCES ? "permission denied; join the group that owns it (dialout)"
                              : std::strerror(errno);
    }
    return fd;
  }

  std::string path_;
};

class TcpBus : public AdapterBus {
 public:
  using AdapterBus::AdapterBus;
  ~TcpBus() override { abandon(); }
  TcpBus(const TcpBus&) = delete;
  TcpBus& operator=(const TcpBus&) = delete;

  /// Looks up the addresses. They remain the same for each restore(), as a lookup may take long.
  bool resolve(const std::string& host, const std::string& port, std::string& why) {
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = AI_NUMERICSERV;
    addrinfo* found = nullptr;
    const int error = getaddrinfo(host.c_str(), port.c_str(), &hints, &found);
    if (error != 0) {
      why = title() + ": " + gai_strerror(error);
      return false;
    }
    for (const addrinfo* next = found; next != nullptr; next = next->ai_next) {
      Address address{{}, next->ai_addrlen};
      std::memcpy(&address.bytes, next->ai_addr, next->ai_addrlen);
      addresses_.push_back(address);
    }
    freeaddrinfo(found);
    return true;
  }

  /// Calls restore() until the bus is open or all addresses have failed, at most for connect_timeout.
  void wait_until_open() {
    while (!restore() && connecting_ >= 0) {
      const auto rest = std::chrono::duration_cast<milliseconds>(deadline_ - Clock::now()).count();
      pollfd connected{connecting_, POLLOUT, 0};
      poll(&connected, 1, static_cast<int>(std::max<long long>(rest + 1, 0)));
    }
  }

 private:
  struct Address {
    sockaddr_storage bytes;
    socklen_t size;
  };

  int open_line(std::string& why) override {
    do {
      int error = connecting_ < 0 ? start() : 0;
      if (error == 0) {
        error = result();
      }
      if (error == EINPROGRESS) {
        why = "it does not answer yet";
        return -1;
      }
      if (error == 0) {
        const int on = 1;
        setsockopt(connecting_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        return std::exchange(connecting_, -1);
      }
      why = std::strerror(error);
      abandon();
      next_ = (next_ + 1) % addresses_.size();
    } while (next_ != 0);
    return -1;
  }

  /// Starts to connect to the next address. Returns an errno; 0: it has started.
  int start() {
    const Address& address = addresses_[next_];
    connecting_ = connect_to(address.bytes.ss_family, reinterpret_cast<const sockaddr*>(&address.bytes), address.size);
    deadline_ = Clock::now() + connect_timeout / static_cast<int>(addresses_.size());
    return connecting_ < 0 ? errno : 0;
  }

  /// Returns the errno of the connection; 0: it is established.
  int result() const {
    pollfd connected{connecting_, POLLOUT, 0};
    if (poll(&connected, 1, 0) <= 0) {
      return Clock::now() < deadline_ ? EINPROGRESS : ETIMEDOUT;
    }
    int error = 0;
    socklen_t size = sizeof error;
    return getsockopt(connecting_, SOL_SOCKET, SO_ERROR, &error, &size) == 0 ? error : errno;
  }

  void abandon() {
    if (connecting_ >= 0) {
      close(connecting_);
    }
    connecting_ = -1;
  }

  std::vector<Address> addresses_;
  std::size_t next_ = 0;  // of the addresses
  int connecting_ = -1;
  Clock::time_point deadline_;
};

/// The adapter of another program, whose commands it answers.
class AnsweringBus : public SlcanBus {
 public:
  using SlcanBus::SlcanBus;

 protected:
  /// Returns whether the bus can have a bit rate.
  virtual bool accepts_rate(std::uint32_t /*rate*/) const { return true; }
  /// Begins with a closed channel.
  void close_channel() {
    channel_ = Channel::closed;
    line_.clear();
  }

  void process(std::string_view bytes) override {
    for (const char byte : bytes) {
      if (byte == '\r') {
        append(answer());
        line_.clear();
      } else if (line_.size() <= CO_SLCAN_LINE && (byte != '\n' || !line_.empty())) {
        line_ += byte;
      }
    }
  }

 private:
  enum class Channel : std::uint8_t { closed, listening, open };

  bool carries() const override { return channel_ != Channel::closed; }

  /// Executes the line that was received. Returns the adapter's answer to it.
  const char* answer() {
    constexpr const char* accepted = "\r";
    constexpr const char* refused = "\a";
    const char letter = line_.empty() ? '\0' : line_[0];
    if (letter == 't' || letter == 'r') {
      return pass_on() ? "z\r" : refused;
    }
    if (letter == 'T' || letter == 'R') {
      return pass_on() ? "Z\r" : refused;
    }
    if (letter == 'S') {
      return set_rate() ? accepted : refused;
    }
    if (line_.size() > 1) {
      return refused;
    }
    switch (letter) {
      case 'C': channel_ = Channel::closed; return accepted;
      case 'O': channel_ = Channel::open; return accepted;
      case 'L': channel_ = Channel::listening; return accepted;
      case 'V': return "V1013\r";
      case 'N': return "N0001\r";
      case 'F': return "F00\r";
      case '\0': return line_.empty() ? accepted : refused;
      default: return refused;
    }
  }

  /// Gives the frame that was received to the driver.
  /// \retval false  it is not valid, or the program does not send
  bool pass_on() {
    const std::uint16_t frames = CORingCount(&can_.Frames);
    if (channel_ == Channel::open) {
      for (const char byte : line_ + '\r') {
        COSlcanReceive(&can_, static_cast<std::uint8_t>(byte));
      }
    }
    return CORingCount(&can_.Frames) != frames;
  }

  /// \retval false  it is not a rate, or the channel is not closed
  bool set_rate() {
    std::size_t code = 0;
    if (channel_ != Channel::closed || line_.size() != 2 || !parse_number(std::string_view(line_).substr(1), code) ||
        code >= rates.size()) {
      return false;
    }
    if (!accepts_rate(rates[code])) {
      return false;
    }
    bit_rate_ = rates[code];
    return true;
  }

  Channel channel_ = Channel::closed;
  std::string line_;  // being received, cut where it is too long for a frame
};

/// A pseudo-terminal that another program opens as its adapter. A hang-up is the end of this program, not of the bus.
class PtyBus : public AnsweringBus {
 public:
  explicit PtyBus(std::uint32_t bit_rate) : AnsweringBus("slcan-pty", bit_rate) {}
  ~PtyBus() override {
    if (opened_ >= 0) {
      close(opened_);
    }
  }
  PtyBus(const PtyBus&) = delete;
  PtyBus& operator=(const PtyBus&) = delete;

  /// While no other program has opened the pseudo-terminal, poll() would report a hang-up at once. inotify reports when
  /// a program opens it.
  pollfd wanted() override {
    pollfd end{fd_, POLLIN, 0};
    const bool is_idle = poll(&end, 1, 0) > 0 && (end.revents & (POLLHUP | POLLIN)) == POLLHUP;
    const bool is_repeated = (SlcanBus::wanted().events & POLLOUT) != 0;  // a frame that was refused
    return fd_ >= 0 && is_idle && !is_repeated ? pollfd{opened_, POLLIN, 0} : SlcanBus::wanted();
  }

  std::optional<Entry> receive() override {
    std::array<char, 1024> events{};
    while (fd_ >= 0 && ::read(opened_, events.data(), events.size()) > 0) {
    }
    return SlcanBus::receive();
  }

  bool restore() override {
    if (fd_ >= 0) {
      return true;
    }
    const int fd = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    begin(fd);
    if (fd < 0 || !create_other_end()) {
      lose(std::strerror(errno));
      return false;
    }
    end_channel();
    return true;
  }

  std::string note() const override { return path_.empty() ? "" : "slcan adapter at " + path_; }

 private:
  /// Creates the device. It transfers bytes unchanged, and reports a hang-up until another program opens it.
  /// \retval false  errno says why
  bool create_other_end() {
    char name[64] = "";
    if (grantpt(fd_) != 0 || unlockpt(fd_) != 0 || ptsname_r(fd_, name, sizeof name) != 0) {
      return false;
    }
    const int other_end = open_serial(name);
    if (other_end < 0) {
      return false;
    }
    close(other_end);
    path_ = name;
    opened_ = opened_ >= 0 ? opened_ : inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
    return opened_ >= 0 && inotify_add_watch(opened_, name, IN_OPEN) >= 0;
  }

  bool has_other_end() const override {
    pollfd end{fd_, 0, 0};
    return poll(&end, 1, 0) <= 0 || (end.revents & POLLHUP) == 0;
  }

  void on_end(const std::string& why) override {
    if (has_other_end()) {
      lose(why);
    } else {
      end_channel();
    }
  }

  /// Discards the rest of the text, also that which the program has not read.
  void end_channel() {
    close_channel();
    discard_text();
    if (is_used_) {  // else inotify would report this opening again and again
      close(open_serial(path_));
      is_used_ = false;
    }
  }

  void process(std::string_view bytes) override {
    is_used_ = true;
    AnsweringBus::process(bytes);
  }

  std::string path_;
  int opened_ = -1;       // inotify: readable when a program opens the pseudo-terminal
  bool is_used_ = false;  // by another program, since end_channel()
};

/// A program that uses a server of slcan lines as its adapter. Its end is that of the bus.
class ClientBus : public AnsweringBus {
 public:
  ClientBus(int client, std::uint32_t bit_rate) : AnsweringBus("slcan program", bit_rate) { begin(client); }

  /// A frame that was refused is not sent again: poll() would report space for it until the next frame.
  pollfd wanted() override {
    const pollfd wanted = SlcanBus::wanted();
    return {wanted.fd, static_cast<short>((wanted.events & POLLIN) | (has_text() ? POLLOUT : 0)), 0};
  }

  bool restore() override { return fd_ >= 0; }

 private:
  std::size_t space() const override { return most_waiting; }
  bool accepts_rate(std::uint32_t rate) const override { return bit_rate_ == 0 || rate == bit_rate_; }
};

/// Returns a bus that is open.
/// \retval null  \a why says why it is not
template <typename T>
std::unique_ptr<Bus> if_open(std::unique_ptr<T> bus, std::string& why) {
  if (!bus->fault().empty()) {
    why = bus->fault();
    return nullptr;
  }
  return bus;
}

}  // namespace

bool has_wrong_slcan_rate(const std::string& name, const BusOptions& options) {
  std::string path = name;
  BusOptions with_rate = options;
  std::string command;
  std::string why;
  return !split_rate(path, with_rate, why) || !rate_command(with_rate.bit_rate, command, why);
}

std::unique_ptr<Bus> open_slcan(const std::string& name, const BusOptions& options, std::string& why) {
  std::string path = name;
  BusOptions with_rate = options;
  std::string command;
  if (!split_rate(path, with_rate, why) || !rate_command(with_rate.bit_rate, command, why)) {
    return nullptr;
  }
  auto bus = std::make_unique<SerialBus>(path, with_rate, command);
  bus->restore();
  bus->await_answers();
  return if_open(std::move(bus), why);
}

std::unique_ptr<Bus> open_slcan_tcp(const std::string& name, const BusOptions& options, std::string& why) {
  std::string address = name;
  BusOptions with_rate = options;
  std::string command;
  if (!split_rate(address, with_rate, why) || !rate_command(with_rate.bit_rate, command, why)) {
    return nullptr;
  }
  const std::size_t colon = address.rfind(':');
  std::string host = address.substr(0, colon == std::string::npos ? 0 : colon);
  const bool is_bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
  if (is_bracketed) {
    host = host.substr(1, host.size() - 2);
  }
  std::uint16_t port = 0;
  if (host.empty() || (!is_bracketed && host.find_first_of(":[]") != std::string::npos) ||
      !parse_number(std::string_view(address).substr(colon + 1), port) || port == 0) {
    why = "'" + address + "' is not HOST:PORT, such as 127.0.0.1:29537 or [::1]:29537";
    return nullptr;
  }
  auto bus = std::make_unique<TcpBus>(address, with_rate, command);
  if (!bus->resolve(host, std::to_string(port), why)) {
    return nullptr;
  }
  bus->wait_until_open();
  bus->await_answers();
  return if_open(std::move(bus), why);
}

std::unique_ptr<Bus> serve_slcan(int client, std::uint32_t bit_rate) {
  return std::make_unique<ClientBus>(client, bit_rate);
}

std::unique_ptr<Bus> open_slcan_pty(const std::string& name, const BusOptions& options, std::string& why) {
  if (!name.empty()) {
    why = "slcan-pty has no further name: '" + name + "'";
    return nullptr;
  }
  auto bus = std::make_unique<PtyBus>(options.bit_rate);
  bus->restore();
  return if_open(std::move(bus), why);
}

}  // namespace lexican::host_bus
