// SPDX-License-Identifier: Apache-2.0
// Mapping entries, and writes of PDO parameters in random order, compared with a model of the rules. [301:7.5.2.35-38]
#include <random>

#include "support/pdo_model.hpp"

namespace {

using namespace test;

constexpr std::uint16_t mapping_of(bool transmit) { return transmit ? 0x1A00 : 0x1600; }

// Sweeps --------------------------------------------------------------------------------------------------------------

void check_word(PdoNode& node, const ModelObjects& objects, std::uint32_t word) {
  for (const bool transmit : {false, true}) {
    const std::uint32_t expected = word == 0 ? 0 : objects.check(transmit, word);
    const std::uint32_t abort = node.set(mapping_of(transmit), 1, 4, word);
    if (abort != expected) {
      CAPTURE(word);
      CAPTURE(transmit);
      CHECK(abort == expected);
    }
  }
}

TEST_CASE("PDO mapping sweep: each of the 65536 indices, with the lengths 8, 32 and 64 [M4] [M5] [M8]") {
  PdoNode node;
  const ModelObjects objects(node->Dict);
  for (std::uint32_t index = 0; index <= 0xFFFF; index += stride(97)) {
    for (const std::uint32_t low : {0x0008U, 0x0120U, 0x0140U}) {
      if ((index & 0x0FFF) < 0x300 || low == 0x0008) {
        check_word(node, objects, index << 16 | low);
      }
    }
  }
}

TEST_CASE("PDO mapping sweep: each sub-index and its length of each object [M4] [M5]") {
  PdoNode node;
  const ModelObjects objects(node->Dict);
  unsigned round = 0;
  for (const std::uint32_t index : objects.indices()) {
    for (std::uint32_t sub = round++ % stride(31); sub <= 255; sub += stride(31)) {
      for (const std::uint32_t bits : {8U, 16U, 32U, 64U}) {
        check_word(node, objects, index << 16 | sub << 8 | bits);
      }
    }
  }
}

TEST_CASE("PDO mapping sweep: each length of each object [M5]") {
  PdoNode node;
  const ModelObjects objects(node->Dict);
  unsigned round = 0;
  for (const std::uint32_t index : objects.indices()) {
    for (const std::uint32_t sub : {0U, 1U}) {
      for (std::uint32_t bits = round++ % stride(31); bits <= 255; bits += stride(31)) {
        check_word(node, objects, index << 16 | sub << 8 | bits);
      }
    }
  }
}

// Random order --------------------------------------------------------------------------------------------------------

std::string hex_bytes(const Bytes& bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    constexpr char digits[] = "0123456789ABCDEF";
    text += {digits[byte >> 4], digits[byte & 0xF]};
  }
  return text;
}

/// Data of a frame: values without gaps from bit 0 of byte 0.
class Packed {
 public:
  void append(const Bytes& value, unsigned bits) {
    for (unsigned k = 0; k < bits; ++k, ++size_) {
      data_.resize(size_ / 8 + 1);
      data_[size_ / 8] = static_cast<std::uint8_t>(data_[size_ / 8] | (value[k / 8] >> (k % 8) & 1U) << (size_ % 8));
    }
  }
  const Bytes& data() const { return data_; }

 private:
  Bytes data_;
  std::size_t size_ = 0;  // bits
};

template <class T>
Bytes little_endian(T value) {
  Bytes bytes;
  for (unsigned k = 0; k < sizeof value; ++k) {
    bytes.push_back(static_cast<std::uint8_t>(value >> (8 * k)));
  }
  return bytes;
}

/// A node and its model, which receive the same random writes.
class Trial {
 public:
  explicit Trial(unsigned seed) : random_(seed), objects_(node_->Dict), words_{words(false), words(true)} {
    for (unsigned n = 0; n < std::min(2U, fixture_rpdos); ++n) {
      pdos_.emplace_back(objects_, false, node_.rpdo[n]);
      number_.push_back(n);
    }
    for (unsigned n = 0; n < std::min(2U, fixture_tpdos); ++n) {
      pdos_.emplace_back(objects_, true, node_.tpdo[n]);
      number_.push_back(n);
    }
  }

  void step() {
    const auto which = static_cast<std::size_t>(any(static_cast<unsigned>(pdos_.size())));
    switch (any(12)) {
      case 0: write_cob_id(which); break;
      case 1:
      case 2: write_communication(which); break;
      case 3: write_number(which); break;
      case 4:
      case 5: write_word(which); break;
      case 6:
      case 7: configure(which); break;
      case 8: change_state(); break;
      case 9: read_back(which); break;
      default: exchange(which);
    }
  }

  unsigned exchanged() const { return exchanged_; }

 private:
  std::uint32_t any_word() { return static_cast<std::uint32_t>(random_()); }
  unsigned any(unsigned below) { return any_word() % below; }
  template <class T>
  T any_of(const std::vector<T>& values) {
    return values[any(static_cast<unsigned>(values.size()))];
  }

  std::vector<std::uint32_t> words(bool transmit) const {
    std::vector<std::uint32_t> all = objects_.mappable(transmit);
    if (!transmit) {
      all.insert(all.end(), {0x00020008, 0x00030010, 0x00040020, 0x00050008, 0x00060010, 0x00070020});
    }
    if (USE_PDO_BITS != 0) {
      for (std::uint32_t n = 0; n < 100; ++n) {  // about half of the mapping entries
        all.push_back(transmit || n % 4 != 0 ? 0x22500001U | (n % 8 + 1) << 8 : 0x00010001U);
      }
    }
    return all;
  }

  std::uint16_t communication(std::size_t which) const {
    return static_cast<std::uint16_t>((pdos_[which].is_transmit() ? 0x1800U : 0x1400U) + number_[which]);
  }
  std::uint16_t mapping(std::size_t which) const { return static_cast<std::uint16_t>(communication(which) + 0x200U); }

  void set_communication(std::size_t which, std::uint8_t sub, unsigned bytes, std::uint32_t value) {
    CAPTURE(communication(which));
    CAPTURE(unsigned{sub});
    CAPTURE(value);
    const std::uint32_t expected = pdos_[which].write_communication(sub, value);
    REQUIRE(node_.set(communication(which), sub, bytes, value) == expected);
    node_.silent();
  }
  void set_number(std::size_t which, std::uint32_t value) {
    CAPTURE(mapping(which));
    CAPTURE(value);
    const std::uint32_t expected = pdos_[which].write_number(value);
    REQUIRE(node_.set(mapping(which), 0, 1, value) == expected);
  }
  void set_word(std::size_t which, std::uint8_t sub, std::uint32_t value) {
    CAPTURE(mapping(which));
    CAPTURE(unsigned{sub});
    CAPTURE(value);
    const std::uint32_t expected = pdos_[which].write_word(sub, value);
    REQUIRE(node_.set(mapping(which), sub, 4, value) == expected);
  }

  /// Returns a random valid COB-ID that no other PDO of the test uses.
  std::uint32_t own_id(std::size_t which) {
    const auto place = static_cast<std::uint32_t>(which);
    return any_of<std::uint32_t>({0x200U + place, 0x300U + place, 0x20012340U + place, 0x3FFFFFF0U + place}) |
           (pdos_[which].is_transmit() && any(4) != 0 ? 0x40000000U : 0U);
  }
  void write_cob_id(std::size_t which) {
    const std::uint32_t present = pdos_[which].entries().cob_id;
    const std::uint32_t value =
        any_of<std::uint32_t>({own_id(which), present, present ^ 0x80000000U, present | 0x80000000U,
                               present ^ 1U << any(32), own_id(which) | 0x80000000U, 0x00000101, 0x80000101, 0x40000000,
                               0x000007FF, 0x00001201, 0xC0001201, any_word()});
    if ((value & 0x80000000U) != 0 || is_never_taken(value) || is_own(which, value)) {
      set_communication(which, 1, 4, value);
    }
  }
  static bool is_never_taken(std::uint32_t value) {
    const std::uint32_t id = value & 0x1FFFFFFFU;
    return (value & 0x20000000U) == 0 && (id > 0x7FF || is_restricted(id));
  }
  /// Returns true for a CAN-ID that no other PDO of the test uses. 29-bit CAN-IDs up to 7FFh are excluded.
  static bool is_own(std::size_t which, std::uint32_t value) {
    const std::uint32_t id = value & 0x1FFFFFFFU;
    return (id & 0xFU) == which && ((value & 0x20000000U) == 0 || id > 0x7FF);
  }
  void write_communication(std::size_t which) {
    const PdoEntries& present = pdos_[which].entries();
    switch (any(5)) {
      case 0: return set_communication(which, 2, 1, any_of<std::uint32_t>({254, 255, 254, 255, any(256), any(256)}));
      case 1: return set_communication(which, 3, 2, any_of<std::uint32_t>({0, present.inhibit, any(11)}));
      case 2: return set_communication(which, 4, 1, any(256));
      case 3: return set_communication(which, 5, 2, any_of<std::uint32_t>({0, 60000U + any(5000)}));
      default: return set_communication(which, 6, 1, any_of<std::uint32_t>({0, present.start, any(256)}));
    }
  }
  void write_number(std::size_t which) {
    set_number(which,
               any_of<std::uint32_t>({0, 0, any(9), any(CO_PDO_MAP_N + 1), pdos_[which].entries().number, any(0xFE)}));
  }
  void write_word(std::size_t which) {
    const auto sub = static_cast<std::uint8_t>(1 + any(CO_PDO_MAP_N + 1));
    const std::uint32_t right = any_of(words_[pdos_[which].is_transmit()]);
    const std::uint32_t other = any_of(words_[!pdos_[which].is_transmit()]);
    const std::uint32_t present = sub <= CO_PDO_MAP_N ? pdos_[which].entries().map[sub - 1U] : 0;
    set_word(which, sub,
             any_of<std::uint32_t>({right, right, other, 0, present, right ^ 1U << any(8), right ^ 1U << any(32),
                                    (right & 0xFFFF00FFU) | any(256) << 8, any_word()}));
  }
  /// Runs the remapping procedure with valid mapping entries, which mostly succeeds.
  void configure(std::size_t which) {
    set_communication(which, 1, 4, own_id(which) | 0x80000000U);
    set_number(which, 0);
    const unsigned number = 1 + any(CO_PDO_MAP_N);
    for (std::uint8_t sub = 1; sub <= number; ++sub) {
      set_word(which, sub, any_of(words_[pdos_[which].is_transmit()]));
    }
    for (unsigned fitting = number; fitting > 0 && pdos_[which].entries().number == 0; --fitting) {
      set_number(which, fitting);
    }
    set_communication(which, 2, 1, 254 + any(2));
    set_communication(which, 1, 4, own_id(which));
  }

  void change_state() {
    const char* const command = any_of<const char*>({"000#0101", "000#0101", "000#0101", "000#8001", "000#8201"});
    node_.rx(command);
    operational_ = command == std::string("000#0101");
    if (command == std::string("000#8201")) {
      node_.tx("701#00");
    }
    node_.frames();  // TPDOs that are sent when Operational is entered
  }

  void read_back(std::size_t which) {
    const PdoModel& pdo = pdos_[which];
    CAPTURE(communication(which));
    for (const std::uint8_t sub :
         {std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}, std::uint8_t{5}, std::uint8_t{6}}) {
      if (sub < 6 || pdo.is_transmit()) {
        CAPTURE(unsigned{sub});
        REQUIRE(node_.get(communication(which), sub) == pdo.read_communication(sub));
      }
    }
    REQUIRE(node_.get(mapping(which), 0) == pdo.entries().number);
    for (std::uint8_t sub = 1; sub <= 8; ++sub) {
      REQUIRE(node_.get(mapping(which), sub) == pdo.entries().map[sub - 1U]);
    }
  }

  /// Sends or receives a frame of an event-driven PDO, and checks that a PDO that is not valid sends and receives none.
  void exchange(std::size_t which) {
    const PdoModel& pdo = pdos_[which];
    const std::uint32_t cob_id = pdo.entries().cob_id;
    const bool is_usable = !is_never_taken(cob_id) && is_own(which, cob_id);
    if (!is_usable || (pdo.exists() && !pdo.is_event_driven())) {
      return;
    }
    exchanged_ += operational_ && pdo.exists() ? 1U : 0U;
    node_.after(2ms);  // longer than the inhibit time
    node_.silent();
    return pdo.is_transmit() ? send(pdo, number_[which]) : receive(pdo);
  }

  Bytes value_of(std::uint32_t word) {
    switch (CO_GET_IDX(word)) {  // write-only objects
      case 0x2231: return little_endian(node_.w8);
      case 0x2232: return little_endian(node_.w16);
      case 0x2234: return little_endian(node_.w32);
      case 0x2238: return little_endian(node_.w64);
      default: return node_.upload(CO_GET_IDX(word), CO_GET_SUB(word));
    }
  }

  void send(const PdoModel& pdo, unsigned number) {
    Packed frame;
    for (const std::uint32_t word : pdo.words()) {
      frame.append(value_of(word), word & 0xFFU);
    }
    node_.trigger(static_cast<std::uint16_t>(number));
    if (operational_ && pdo.exists()) {
      node_.tx(pdo.identifier() + "#" + hex_bytes(frame.data()));
    } else {
      node_.silent();
    }
  }

  /// Returns the values of the objects of these mapping entries, without dummies.
  std::map<std::uint32_t, Bytes> values(const std::vector<std::uint32_t>& words) {
    std::map<std::uint32_t, Bytes> all;
    for (const std::uint32_t word : words) {
      if (CO_GET_IDX(word) > 7) {
        all[word] = value_of(word);
      }
    }
    return all;
  }

  Bytes any_value(std::uint32_t word) {
    Bytes value(((word & 0xFFU) + 7U) / 8U);
    std::generate(value.begin(), value.end(), [&] { return static_cast<std::uint8_t>(any(256)); });
    if (CO_GET_IDX(word) == 0x2250) {
      value[0] &= 1;  // BOOLEAN
    }
    return value;
  }

  void receive(const PdoModel& pdo) {
    std::vector<std::uint32_t> watched = pdo.words();
    for (int others = 0; others < 5; ++others) {
      watched.push_back(any_of(words_[0]));
    }
    std::map<std::uint32_t, Bytes> expected = values(watched);
    Packed frame;
    for (const std::uint32_t word : pdo.words()) {
      const Bytes value = any_value(word);
      frame.append(value, word & 0xFFU);
      if (CO_GET_IDX(word) > 7 && operational_ && pdo.exists()) {
        expected[word] = value;
      }
    }
    node_.rx(pdo.identifier() + "#" + hex_bytes(frame.data()));
    node_.silent();
    REQUIRE(values(watched) == expected);
  }

  std::mt19937 random_;
  PdoNode node_;
  ModelObjects objects_;
  std::array<std::vector<std::uint32_t>, 2> words_;
  std::vector<PdoModel> pdos_;
  std::vector<unsigned> number_;
  bool operational_ = false;
  unsigned exchanged_ = 0;
};

TEST_CASE("PDO mapping sweep: results of writes in random order, and layouts of PDOs, equal those of the model") {
  unsigned exchanged = 0;
  for (unsigned seed = 1; seed <= 10 / stride(5); ++seed) {
    CAPTURE(seed);
    Trial trial(seed);
    for (unsigned step = 0; step < 1000; ++step) {
      CAPTURE(step);
      trial.step();
    }
    exchanged += trial.exchanged();
  }
  CHECK(exchanged > 500 / stride(5));
}

}  // namespace
