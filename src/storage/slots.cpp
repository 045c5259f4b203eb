// SPDX-License-Identifier: Apache-2.0
#include "storage/slots.hpp"

#include "base/events.hpp"
#include "co_assert.h"
#include "hal/port.hpp"
#include "storage/budget.hpp"
#include "wire/crc32.hpp"

#if USE_PARA

namespace co::slots {
namespace {

using store::Found;
using store::Loaded;
using store::Record;

constexpr uint32_t magic = 0x324E584C;     // "LXN2"
constexpr uint32_t defaults = UINT32_MAX;  // Header.size: the defaults are to be used, there are no data
constexpr uint8_t erased = 0xFF;

struct Header {
  uint32_t magic;
  uint32_t version;
  uint32_t size;
  uint32_t generation;
  uint32_t crc;  // of the members above, the identity of the record and the data
};

struct Slot {
  uint32_t start;
  Header header;
  Found found;
};

uint32_t round_up(uint32_t value, uint32_t unit) {
  const uint32_t over = value % unit;
  return over == 0 ? value : value + (unit - over);
}

uint32_t program_size(const CO_NODE& node) {
  const uint32_t size = port::nvm_shape(node).ProgramSize;
  return size == 0 ? 1 : size;
}

// Returns the bytes of which the address and size of a slot are multiples: the unit in which the memory can be erased
// and programmed.
uint32_t unit(const CO_NODE& node) {
  const uint32_t program = program_size(node);
  const uint32_t erase = port::nvm_shape(node).EraseSize;
  return erase == 0 ? program : erase;
}

uint32_t header_size(const CO_NODE& node) { return round_up(sizeof(Header), program_size(node)); }

uint32_t slot_size(const CO_NODE& node, uint32_t size) {
  return round_up(header_size(node) + round_up(size, program_size(node)), unit(node));
}

// Returns the CRC of the header and the identity of the record; the data are to be added.
wire::Crc32 crc_of(const Header& header, const Record& record) {
  wire::Crc32 crc;
  crc.add(reinterpret_cast<const uint8_t*>(&header), offsetof(Header, crc));
  crc.add(reinterpret_cast<const uint8_t*>(&record), sizeof record);
  return crc;
}

// Scope of a driver call. The memory is slow, so the node lock is released meanwhile if this thread holds it; requests
// of other threads are deferred. The driver may then get only memory that no other thread uses.
#if USE_REAL_TIME
class Outside {
 public:
  explicit Outside(const CO_NODE& node)
      : node_(const_cast<CO_NODE&>(node)), serving_(node_), ext_(node.IsNodeLocked != 0 ? node.Ext : nullptr) {
    port::leave(node_, ext_);
  }
  ~Outside() {
    if (ext_ != nullptr) {
      port::enter(node_);
    }
  }
  Outside(const Outside&) = delete;
  Outside& operator=(const Outside&) = delete;

 private:
  CO_NODE& node_;
  event::Serving serving_;
  const CO_NODE_EXT* ext_;
};
#else
class Outside {
 public:
  explicit Outside(const CO_NODE&) {}
};
#endif

// Work memory whose size is a multiple of the program size.
class Buffer {
 public:
  explicit Buffer(const CO_NODE& node) : size_(CO_STORE_BUFFER - CO_STORE_BUFFER % program_size(node)) {
    CO_ASSERT(size_ != 0 && size_ <= sizeof bytes_);
  }
  [[nodiscard]] uint32_t size() const { return size_; }
  [[nodiscard]] uint8_t* bytes() { return bytes_; }

 private:
  uint32_t size_;
  uint8_t bytes_[CO_STORE_BUFFER] = {};
};

bool read(const CO_NODE& node, uint32_t start, void* to, uint32_t size) {
  const Outside outside(node);
  return port::nvm_read(node, start, static_cast<uint8_t*>(to), size) == size;
}

// Adds size bytes of the memory to the CRC, in pieces. Returns false if they cannot be read.
bool add_to_crc(const CO_NODE& node, uint32_t start, uint32_t size, wire::Crc32& crc) {
  Buffer buffer(node);
  while (size != 0) {
    const uint32_t piece = size < buffer.size() ? size : buffer.size();
    if (!read(node, start, buffer.bytes(), piece)) {
      return false;
    }
    crc.add(buffer.bytes(), piece);
    start += piece;
    size -= piece;
  }
  return true;
}

// Returns whether the header is that of an unused memory: FFh or 00h throughout.
bool is_blank(const Header& header) {
  const bool uniform = header.version == header.magic && header.size == header.magic &&
                       header.generation == header.magic && header.crc == header.magic;
  return uniform && (header.magic == UINT32_MAX || header.magic == 0);
}

// Reads the header of a slot. Returns what the slot holds; Found::lost if its header or its CRC is invalid. A header
// that cannot be read is 0 throughout.
Found read_slot(const CO_NODE& node, const Record& record, uint32_t start, Header& header) {
  if (!read(node, start, &header, sizeof header)) {
    header = {};
    return Found::lost;
  }
  if (is_blank(header)) {
    return Found::blank;
  }
  const bool is_default = header.size == defaults;
  if (header.magic != magic || header.version != record.version || (!is_default && header.size != record.size)) {
    return Found::lost;
  }
  wire::Crc32 crc = crc_of(header, record);
  if (!add_to_crc(node, start + header_size(node), is_default ? 0 : record.size, crc) || crc.value() != header.crc) {
    return Found::lost;
  }
  return is_default ? Found::defaults : Found::data;
}

// Returns whether the slot holds a valid record.
bool is_whole(const Slot& slot) { return slot.found == Found::data || slot.found == Found::defaults; }

// Returns whether the slot holds a valid record that is newer than that of the other slot. Generations may wrap around.
bool is_newer(const Slot& slot, const Slot& other) {
  return is_whole(slot) && (!is_whole(other) || slot.header.generation - other.header.generation <= INT32_MAX);
}

// Both slots of a record, the newest valid one first.
struct Slots {
  Slots(const CO_NODE& node, const Record& record) : newest{record.start, {}, {}}, other{} {
    other.start = record.start + slot_size(node, record.size);
    newest.found = read_slot(node, record, newest.start, newest.header);
    other.found = read_slot(node, record, other.start, other.header);
    if (is_newer(other, newest)) {
      const Slot first = newest;
      newest = other;
      other = first;
    }
  }

  Slot newest;
  Slot other;
};

// Returns whether the other slot is damaged and was written after the newest valid one, so that its data are lost. A
// slot whose store was interrupted by a power failure does not count: its header is erased (Found::blank), or still
// that of its previous record, whose generation is one lower than that of the newest valid slot. A header that cannot
// be read does count.
bool is_newest_damaged(const Slots& slots) {
  const bool is_unread = slots.other.header.magic == 0;
  return slots.other.found == Found::lost &&
         (is_unread || slots.newest.header.generation - slots.other.header.generation != 1);
}

// The slot that held the newest record of a group when it was loaded or saved last (CO_NODE.ParaNewest): it is not
// erased, even if the memory cannot be read meanwhile.
constexpr unsigned groups_in_byte = 4;
constexpr unsigned slot_bits = 2;

// A place in CO_NODE.ParaNewest.
struct Remembered {
  Remembered(CO_NODE& node, const Record& record)
      : byte(node.ParaNewest[record.group / groups_in_byte]), shift(record.group % groups_in_byte * slot_bits) {
    CO_ASSERT(record.group / groups_in_byte < sizeof node.ParaNewest);
  }
  uint8_t& byte;
  unsigned shift;
};

void remember(CO_NODE& node, const Record& record, const Slot& slot) {
  const Remembered at(node, record);
  const unsigned number = slot.start == record.start ? 1 : 2;
  at.byte = static_cast<uint8_t>((at.byte & ~(3U << at.shift)) | (is_whole(slot) ? number << at.shift : 0));
}

// Returns whether the slot that was remembered cannot be read any more.
bool is_hidden(CO_NODE& node, const Record& record, const Slots& slots) {
  const Remembered at(node, record);
  const unsigned number = unsigned{at.byte} >> at.shift & 3U;
  const bool is_first = slots.newest.start == record.start;
  return number != 0 && !is_whole(is_first == (number == 1) ? slots.newest : slots.other);
}

// Copies the first size bytes to the memory of the application, with the node lock held, and checks the CRC of all
// data. Returns false if they cannot be read or are invalid.
bool copy(const CO_NODE& node, const Record& record, const Slot& slot, uint8_t* to, uint32_t size) {
  const uint32_t start = slot.start + header_size(node);
  wire::Crc32 crc = crc_of(slot.header, record);
  if (port::nvm_read(node, start, to, size) != size) {
    return false;
  }
  crc.add(to, size);
  return add_to_crc(node, start + size, record.size - size, crc) && crc.value() == slot.header.crc;
}

// Copies the first size bytes of a slot's data, if it holds data, to the memory of the application. Returns false if
// the slot holds neither valid data nor the request for default values.
bool load_slot(const CO_NODE& node, const Record& record, const Slot& slot, uint8_t* to, uint32_t size) {
  return slot.found == Found::defaults || (slot.found == Found::data && copy(node, record, slot, to, size));
}

bool is_equal(const CO_NODE& node, uint32_t start, const uint8_t* data, uint32_t size) {
  Buffer buffer(node);
  while (size != 0) {
    const uint32_t piece = size < buffer.size() ? size : buffer.size();
    if (!read(node, start, buffer.bytes(), piece) || !is_same(buffer.bytes(), data, piece)) {
      return false;
    }
    start += piece;
    data += piece;
    size -= piece;
  }
  return true;
}

bool is_stored(const CO_NODE& node, const Record& record, const Slot& slot, const uint8_t* data) {
  if (data == nullptr) {
    return slot.found == Found::defaults;
  }
  return slot.found == Found::data && is_equal(node, slot.start + header_size(node), data, record.size);
}

bool program(const CO_NODE& node, uint32_t start, uint8_t* bytes, uint32_t size) {
  const Outside outside(node);
  return port::nvm_write(node, start, bytes, size) == size;
}

// Writes bytes and fills the last program unit up. The application may change the bytes during the call, so the CRC is
// calculated from the bytes that are written.
bool write(const CO_NODE& node, uint32_t start, const uint8_t* bytes, uint32_t size, wire::Crc32& crc) {
  Buffer buffer(node);
  while (size != 0) {
    const uint32_t piece = size < buffer.size() ? size : buffer.size();
    const uint32_t whole = round_up(piece, program_size(node));
    __builtin_memcpy(buffer.bytes(), bytes, piece);
    __builtin_memset(buffer.bytes() + piece, erased, whole - piece);
    crc.add(buffer.bytes(), piece);
    if (!program(node, start, buffer.bytes(), whole)) {
      return false;
    }
    start += piece;
    bytes += piece;
    size -= piece;
  }
  return true;
}

bool erase(const CO_NODE& node, uint32_t start, uint32_t size) {
  const Outside outside(node);
  return port::nvm_shape(node).EraseSize == 0 || port::nvm_erase(node, start, size);
}

// Writes a slot, its header last: the slot is invalid until the header is written.
bool write_slot(const CO_NODE& node, const Record& record, Slot& slot, const uint8_t* data) {
  CO_ASSERT(slot.start % unit(node) == 0);
  CO_ASSERT(slot.start - record.start <= slot_size(node, record.size));
  wire::Crc32 crc = crc_of(slot.header, record);
  wire::Crc32 unused;
  if (!erase(node, slot.start, slot_size(node, record.size))) {
    return false;
  }
  if (data != nullptr && !write(node, slot.start + header_size(node), data, record.size, crc)) {
    return false;
  }
  slot.header.crc = crc.value();
  return write(node, slot.start, reinterpret_cast<const uint8_t*>(&slot.header), sizeof slot.header, unused);
}

// Writes the slot that does not hold the newest valid record. data: null for the defaults. The generation is one higher
// than in the remaining slot, even if that one is invalid: is_newest_damaged() compares both. Reads both slots again
// afterwards: if the remaining slot could not be read before, its record may be the newer one.
CO_ERR write_record(CO_NODE& node, const Record& record, const Slots& slots, const uint8_t* data) {
  const bool has_record = is_whole(slots.newest);
  const Slot& target = has_record ? slots.other : slots.newest;
  const uint32_t generation = (has_record ? slots.newest : slots.other).header.generation + 1;
  Slot slot = {target.start, {magic, record.version, data == nullptr ? defaults : record.size, generation, 0}, {}};
  if (!write_slot(node, record, slot, data)) {
    return CO_ERR_IF_NVM_WRITE;
  }
  const Slot newest = Slots(node, record).newest;
  const bool is_loaded_next = newest.start == slot.start && is_whole(newest) && newest.header.crc == slot.header.crc &&
                              newest.header.generation == generation;
  if (!is_loaded_next) {
    return CO_ERR_IF_NVM_WRITE;
  }
  remember(node, record, newest);
  return CO_ERR_NONE;
}

}  // namespace

bool is_same(const uint8_t* a, const uint8_t* b, uint32_t num) {
  uint32_t n = 0;
  while (n < num && a[n] == b[n]) {
    ++n;
  }
  return n == num;
}

uint32_t space(const CO_NODE& node, uint32_t size) { return 2 * slot_size(node, size); }

// Also requires that the erase size is a multiple of the program size. The first condition limits all sizes to half the
// capacity, so that no later sum exceeds 32 bits.
bool fits(const CO_NODE& node, const Record& record) {
  const CO_NVM_SHAPE shape = port::nvm_shape(node);
  const uint32_t half = shape.Capacity / 2;
  const uint32_t program = program_size(node);
  if (program > CO_STORE_BUFFER || shape.EraseSize % program != 0 || shape.EraseSize > half || record.size > half) {
    return false;
  }
  const uint32_t slot = slot_size(node, record.size);
  return slot <= half && record.start <= shape.Capacity - 2 * slot && record.start % unit(node) == 0;
}

Found find(const CO_NODE& node, const Record& record) {
  if (!fits(node, record)) {
    return Found::no_place;
  }
  const Slots slots(node, record);
  const bool blank = slots.newest.found == Found::blank && slots.other.found == Found::blank;
  return blank || is_whole(slots.newest) ? slots.newest.found : Found::lost;
}

Loaded load(CO_NODE& node, const Record& record, uint8_t* to, uint32_t size) {
  CO_ASSERT(size <= record.size);
  if (!fits(node, record)) {
    return {Found::no_place, false};
  }
  const Slots slots(node, record);
  remember(node, record, slots.newest);
  if (load_slot(node, record, slots.newest, to, size)) {
    return {slots.newest.found, is_newest_damaged(slots)};
  }
  if (load_slot(node, record, slots.other, to, size)) {
    remember(node, record, slots.other);
    return {slots.other.found, true};
  }
  return {slots.newest.found == Found::blank && slots.other.found == Found::blank ? Found::blank : Found::lost, false};
}

CO_ERR save(CO_NODE& node, const Record& record, const uint8_t* data) {
  if (!fits(node, record)) {
    return CO_ERR_PARA_STORE;
  }
  const Slots slots(node, record);
  if (is_stored(node, record, slots.newest, data)) {
    return CO_ERR_NONE;
  }
  if (is_hidden(node, record, slots)) {
    return CO_ERR_IF_NVM_WRITE;
  }
  return budget::take_store(node) ? write_record(node, record, slots, data) : CO_ERR_OBJ_STATE;
}

const CO_STORE_T store = {space, find, load, save};

}  // namespace co::slots

#endif
