// SPDX-License-Identifier: Apache-2.0
// pcapng (draft-ietf-opsawg-pcapng) and pcap (draft-ietf-opsawg-pcap) with frames of the link type SocketCAN (227): the
// CAN-ID with its flags (big-endian), the length, flags of CAN FD, two bytes, data.
#include <algorithm>
#include <array>
#include <cstring>

#include "bus/log_formats.hpp"

namespace lexican::host_bus {
namespace {

constexpr std::uint32_t section_header = 0x0A0D0D0A;
constexpr std::uint32_t interface_description = 1;
constexpr std::uint32_t simple_packet = 3;
constexpr std::uint32_t interface_statistics = 5;
constexpr std::uint32_t enhanced_packet = 6;
constexpr std::uint32_t byte_order = 0x1A2B3C4D;

constexpr std::uint16_t link_type_socketcan = 227;
constexpr std::size_t can_header = 8;
constexpr std::uint8_t flag_xl = 0x80;  // in the place of the length

// Options.
constexpr std::uint16_t end_of_options = 0;
constexpr std::uint16_t packet_flags = 2;
constexpr std::uint16_t packet_drops = 4;
constexpr std::uint16_t statistics_drops = 5;
constexpr std::uint16_t interface_name = 2;
constexpr std::uint16_t interface_resolution = 9;

constexpr std::uint64_t million = 1'000'000;
constexpr const char* no_can = "the packets are not CAN frames (link type 227, SocketCAN)";

/// Returns value * million / units; saturates at max_time.
Micros micros_of(std::uint64_t value, std::uint64_t units) {
  const std::uint64_t seconds = value / units;
  if (seconds >= max_time / million) {
    return max_time;
  }
  const std::uint64_t rest = value % units;
  const std::uint64_t divisor = units > UINT64_MAX / million ? units / million : 0;
  return seconds * million + (divisor != 0 ? rest / divisor : rest * million / units);
}

/// Numbers of a file in its byte order.
class Numbers {
 public:
  void set_big_endian(bool is_big_endian) { is_big_endian_ = is_big_endian; }

  std::uint16_t two(const std::uint8_t* bytes) const {
    const auto number = static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8);
    return is_big_endian_ ? static_cast<std::uint16_t>(number >> 8 | number << 8) : number;
  }
  std::uint32_t four(const std::uint8_t* bytes) const {
    const std::uint32_t first = two(bytes);
    const std::uint32_t second = two(bytes + 2);
    return is_big_endian_ ? first << 16 | second : second << 16 | first;
  }
  std::uint64_t eight(const std::uint8_t* bytes) const {
    const std::uint64_t first = four(bytes);
    const std::uint64_t second = four(bytes + 4);
    return is_big_endian_ ? first << 32 | second : second << 32 | first;
  }

 private:
  bool is_big_endian_ = false;  // big-endian
};

/// Decodes a packet of the link type SocketCAN.
Parsed parse_packet(const std::uint8_t* bytes, std::size_t size, CO_IF_FRM& frame) {
  if (size < can_header) {
    return Parsed::malformed;
  }
  // Programs that do not set flags mark frames of CAN FD by their size.
  if ((bytes[4] & flag_xl) != 0 || bytes[5] != 0 || bytes[4] > 8 || size == can_header + 64) {
    return Parsed::other_frame;
  }
  Numbers network;
  network.set_big_endian(true);
  frame.Identifier = network.four(bytes);
  frame.DLC = bytes[4];
  const bool is_remote = (frame.Identifier & CO_IF_FRM_RTR) != 0;
  const bool is_base = (frame.Identifier & (CO_IF_FRM_EXT | CO_IF_FRM_ERROR)) == 0;
  if ((is_base && (frame.Identifier & max_extended_id) > max_base_id) ||
      (!is_remote && size < can_header + frame.DLC)) {
    return Parsed::malformed;
  }
  if (!is_remote) {
    std::memcpy(frame.Data, bytes + can_header, frame.DLC);
  }
  return Parsed::frame;
}

class PacketReader : public LogReader {
 public:
  explicit PacketReader(LogInput input) : input_(std::move(input)) {}

 protected:
  /// Reads a part of a block completely.
  /// \retval false  the file has ended; within a block that is a fault
  bool read(std::uint8_t* bytes, std::size_t size, bool is_within) {
    const std::size_t number = input_.read(bytes, size);
    if (number == size) {
      return true;
    }
    if (input_.is_broken()) {
      fault_ = "the file cannot be read to its end";
    } else if (number != 0 || is_within) {
      fault_ = "the file ends within a packet";
    }
    return false;
  }

  bool read_block(std::size_t size) {
    if (size > max_block) {
      fault_ = "a packet is longer than a megabyte: the file is damaged";
      return false;
    }
    block_.resize(size);
    return read(block_.data(), size, true);
  }

  /// Reads and ignores a part of a block.
  bool skip(std::size_t size) {
    block_.resize(std::min(size, max_block));
    while (size > 0 && read(block_.data(), std::min(size, block_.size()), true)) {
      size -= std::min(size, block_.size());
    }
    return size == 0;
  }

  void add_lost(std::uint64_t number) { lost_ += std::min(number, UINT64_MAX - lost_); }

  bool count_packet(Parsed parsed) {
    other_frames_ += parsed == Parsed::other_frame ? 1 : 0;
    malformed_ += parsed == Parsed::malformed ? 1 : 0;
    return parsed == Parsed::frame;
  }

  Numbers numbers_;
  std::vector<std::uint8_t> block_;

 private:
  LogInput input_;
};

// --- pcap

class PcapReader : public PacketReader {
 public:
  using PacketReader::PacketReader;

  std::optional<Entry> next() override {
    std::array<std::uint8_t, 16> head{};
    if (!fault_.empty() || (!has_begun_ && !begin())) {
      return std::nullopt;
    }
    while (read(head.data(), head.size(), false) && read_block(numbers_.four(&head[8]))) {
      Entry entry;
      entry.time = numbers_.four(head.data()) * million + micros_of(numbers_.four(&head[4]), units_);
      if (count_packet(parse_packet(block_.data(), block_.size(), entry.frame))) {
        entry.channel = channel_of("can");
        return entry;
      }
    }
    return std::nullopt;
  }

 private:
  bool begin() {
    has_begun_ = true;
    std::array<std::uint8_t, 24> head{};
    if (!read(head.data(), head.size(), true)) {
      return false;
    }
    numbers_.set_big_endian(head[0] == 0xA1);
    units_ = (numbers_.four(head.data()) & 0xFFFF) == 0x3C4D ? 1000 * million : million;
    if ((numbers_.four(&head[20]) & 0xFFFF) != link_type_socketcan) {
      fault_ = no_can;
    }
    return fault_.empty();
  }

  bool has_begun_ = false;
  std::uint64_t units_ = million;  // per second
};

// --- pcapng

class PcapngReader : public PacketReader {
 public:
  using PacketReader::PacketReader;

  std::optional<Entry> next() override {
    std::array<std::uint8_t, 8> head{};
    while (fault_.empty() && read(head.data(), head.size(), false)) {
      Entry entry;
      if (is_block(head) && is_frame(numbers_.four(head.data()), entry)) {
        return entry;
      }
    }
    if (fault_.empty() && has_other_packets_ && channels_.empty()) {
      fault_ = no_can;
    }
    return std::nullopt;
  }

 private:
  struct Interface {
    bool is_can = false;
    std::uint64_t units = million;  ///< of time stamps, per second
    std::string name{};
    std::uint64_t lost = 0;  ///< according to the last statistics
  };
  static constexpr std::size_t max_interfaces = 1024;

  /// Reads the rest of a block into block_, without the length at its end.
  bool is_block(const std::array<std::uint8_t, 8>& head) {
    std::array<std::uint8_t, 4> magic{};
    const bool is_section = numbers_.four(head.data()) == section_header;  // reads identically in both byte orders
    if (is_section) {
      if (!read(magic.data(), magic.size(), true)) {
        return false;
      }
      numbers_.set_big_endian(magic[0] == (byte_order >> 24));
      interfaces_.clear();
      if (numbers_.four(magic.data()) != byte_order) {
        fault_ = "a section has no byte-order magic: the file is damaged";
        return false;
      }
    }
    const std::uint32_t read_already = is_section ? 12 : 8;
    const std::uint32_t length = numbers_.four(&head[4]);
    if (length < read_already + 4 || length % 4 != 0) {
      fault_ = "a block has an impossible length: the file is damaged";
      return false;
    }
    if (is_section || !is_used(numbers_.four(head.data()))) {
      skip(length - read_already);
      return false;
    }
    if (!read_block(length - read_already)) {
      return false;
    }
    block_.resize(block_.size() - 4);
    return true;
  }

  static bool is_used(std::uint32_t type) {
    return type == interface_description || type == interface_statistics || type == simple_packet ||
           type == enhanced_packet;
  }

  bool is_frame(std::uint32_t type, Entry& entry) {
    switch (type) {
      case interface_description: describe_interface(); return false;
      case interface_statistics: count_statistics(); return false;
      case simple_packet: return is_simple(entry);
      case enhanced_packet: return is_enhanced(entry);
      default: return false;
    }
  }

  /// Calls \a use(code, bytes, size) for each option behind \a begin bytes of the block.
  template <typename Use>
  void for_options(std::size_t begin, Use use) {
    while (begin + 4 <= block_.size()) {
      const std::uint16_t code = numbers_.two(&block_[begin]);
      const std::size_t size = numbers_.two(&block_[begin + 2]);
      if (code == end_of_options || begin + 4 + size > block_.size()) {
        return;
      }
      use(code, block_.data() + begin + 4, size);
      begin += 4 + (size + 3) / 4 * 4;
    }
  }

  void describe_interface() {
    if (block_.size() < 8 || interfaces_.size() >= max_interfaces) {
      ++malformed_;
      return;
    }
    Interface interface;
    interface.is_can = numbers_.two(block_.data()) == link_type_socketcan;
    interface.name = "can" + std::to_string(interfaces_.size());
    for_options(8, [&](std::uint16_t code, const std::uint8_t* bytes, std::size_t size) {
      if (code == interface_name && size > 0) {
        interface.name = channel_name({reinterpret_cast<const char*>(bytes), size});
      } else if (code == interface_resolution && size == 1) {
        interface.units = units_of(bytes[0]);
      }
    });
    interfaces_.push_back(std::move(interface));
  }

  /// Returns the time stamps per second; finer resolutions than 64 bits can count are regarded as the finest.
  static std::uint64_t units_of(std::uint8_t resolution) {
    const unsigned power = resolution & 0x7FU;
    if ((resolution & 0x80U) != 0) {
      return std::uint64_t{1} << std::min(power, 63U);
    }
    std::uint64_t units = 1;
    for (unsigned n = 0; n < std::min(power, 19U); ++n) {
      units *= 10;
    }
    return units;
  }

  /// Returns the interface of the block; null: it is not one for CAN.
  Interface* interface_of(std::uint32_t number) {
    return number < interfaces_.size() && interfaces_[number].is_can ? &interfaces_[number] : nullptr;
  }

  void count_statistics() {
    Interface* const interface = block_.size() < 12 ? nullptr : interface_of(numbers_.four(block_.data()));
    if (interface == nullptr) {
      return;
    }
    for_options(12, [&](std::uint16_t code, const std::uint8_t* bytes, std::size_t size) {
      if (code == statistics_drops && size == 8) {
        const std::uint64_t total = numbers_.eight(bytes);
        add_lost(total > interface->lost ? total - interface->lost : 0);
        interface->lost = total;
      }
    });
  }

  bool is_simple(Entry& entry) {
    const Interface* const interface = block_.size() < 4 ? nullptr : interface_of(0);
    if (interface == nullptr) {
      return count_unusable(0, block_.size() >= 4);
    }
    const std::size_t size = std::min<std::size_t>(numbers_.four(block_.data()), block_.size() - 4);
    entry.time = last_;
    return parse(*interface, block_.data() + 4, size, entry);
  }

  bool is_enhanced(Entry& entry) {
    Interface* const interface = block_.size() < 20 ? nullptr : interface_of(numbers_.four(block_.data()));
    const std::size_t size = block_.size() < 20 ? 0 : numbers_.four(&block_[12]);
    if (interface == nullptr || size > block_.size() - 20) {
      return count_unusable(block_.size() < 20 ? 0 : numbers_.four(block_.data()), block_.size() >= 20);
    }
    const std::uint64_t stamp = std::uint64_t{numbers_.four(&block_[4])} << 32 | numbers_.four(&block_[8]);
    last_ = entry.time = micros_of(stamp, interface->units);
    for_options(20 + (size + 3) / 4 * 4, [&](std::uint16_t code, const std::uint8_t* bytes, std::size_t length) {
      if (code == packet_flags && length == 4) {
        const unsigned direction = numbers_.four(bytes) & 3U;
        entry.direction = direction == 1 ? Direction::received : direction == 2 ? Direction::sent : Direction::unknown;
      } else if (code == packet_drops && length == 8) {
        add_lost(numbers_.eight(bytes));
        interface->lost += std::min(numbers_.eight(bytes), UINT64_MAX - interface->lost);
      }
    });
    return parse(*interface, block_.data() + 20, size, entry);
  }

  bool parse(const Interface& interface, const std::uint8_t* bytes, std::size_t size, Entry& entry) {
    if (!count_packet(parse_packet(bytes, size, entry.frame))) {
      return false;
    }
    entry.channel = channel_of(interface.name);
    return true;
  }

  /// Counts a packet that is malformed; packets of interfaces that are not for CAN are ignored.
  bool count_unusable(std::uint32_t interface, bool has_header) {
    if (has_header && interface < interfaces_.size() && !interfaces_[interface].is_can) {
      has_other_packets_ = true;
      return false;
    }
    return count_packet(Parsed::malformed);
  }

  std::vector<Interface> interfaces_;  // of the section
  Micros last_ = 0;                    // simple packets have no time
  bool has_other_packets_ = false;
};

/// Writes a block: numbers are added one after the other, in the order little-endian.
class Block {
 public:
  explicit Block(std::uint32_t type) { add(type).add(0); }

  Block& add(std::uint64_t number, unsigned bytes = 4) {
    for (unsigned n = 0; n < bytes; ++n) {
      bytes_ += static_cast<char>(number >> (8 * n));
    }
    return *this;
  }
  Block& add_option(std::uint16_t code, std::string_view value) {
    return add(code, 2).add(value.size(), 2).add_bytes(value);
  }
  Block& add_bytes(std::string_view value) {
    bytes_ += value;
    bytes_.append((4 - value.size() % 4) % 4, '\0');
    return *this;
  }
  void write_to(std::ostream& stream) {
    const auto length = static_cast<std::uint32_t>(bytes_.size() + 4);
    add(length);
    for (unsigned n = 0; n < 4; ++n) {
      bytes_[4 + n] = static_cast<char>(length >> (8 * n));
    }
    stream.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
  }

 private:
  std::string bytes_;
};

class PcapngWriter : public LogWriter {
 public:
  PcapngWriter(std::ostream& stream, std::string_view channel) : stream_(stream) {
    Block(section_header).add(byte_order).add(1, 2).add(0, 2).add(UINT64_MAX, 8).write_to(stream_);
    Block(interface_description)
        .add(link_type_socketcan, 2)
        .add(0, 2)
        .add(0)
        .add_option(interface_name, channel_name(channel))
        .add(end_of_options)
        .write_to(stream_);
  }

  void write(const Entry& entry) override {
    const CO_IF_FRM& frame = entry.frame;
    const bool is_remote = (frame.Identifier & CO_IF_FRM_RTR) != 0;
    std::string packet;
    for (int shift = 24; shift >= 0; shift -= 8) {
      packet += static_cast<char>(frame.Identifier >> shift);
    }
    packet += static_cast<char>(std::min<unsigned>(frame.DLC, 8));
    packet.append(3, '\0');
    packet.append(reinterpret_cast<const char*>(frame.Data), is_remote ? 0 : std::min<unsigned>(frame.DLC, 8));
    Block block(enhanced_packet);
    block.add(0).add(entry.time >> 32).add(entry.time).add(packet.size()).add(packet.size()).add_bytes(packet);
    if (entry.direction != Direction::unknown) {
      block.add(packet_flags, 2).add(4, 2).add(entry.direction == Direction::received ? 1 : 2);
    }
    block.add(end_of_options).write_to(stream_);
  }

  void write_lost(Micros time, std::uint32_t number) override {
    total_ += number;
    Block(interface_statistics)
        .add(0)
        .add(time >> 32)
        .add(time)
        .add(statistics_drops, 2)
        .add(8, 2)
        .add(total_, 8)
        .add(end_of_options)
        .write_to(stream_);
  }

 private:
  std::ostream& stream_;
  std::uint64_t total_ = 0;
};

}  // namespace

std::unique_ptr<LogReader> read_pcap(LogInput input) { return std::make_unique<PcapReader>(std::move(input)); }
std::unique_ptr<LogReader> read_pcapng(LogInput input) { return std::make_unique<PcapngReader>(std::move(input)); }

std::unique_ptr<LogWriter> write_pcapng(std::ostream& stream, std::string_view channel) {
  return std::make_unique<PcapngWriter>(stream, channel);
}

}  // namespace lexican::host_bus
