// SPDX-License-Identifier: Apache-2.0
#include "storage/store.hpp"

#include "base/events.hpp"
#include "co_assert.h"
#include "hal/port.hpp"
#include "storage/budget.hpp"
#include "wire/crc.hpp"

#if USE_PARA

namespace co::slots {
namespace {

using store::Found;
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

[[gnu::noinline]] uint32_t round_up(uint32_t value, uint32_t unit) {
  const uint32_t over = value % unit;
  return over == 0 ? value : value + (unit - over);
}

// The two slots of a record, and the geometry of the memory that they are in.
struct Region {
  Region(CO_NODE& owner, const Record& what)
      : node(owner),
        record(what),
        shape(port::nvm_geometry(owner)),
        program(shape.ProgramSize == 0 ? 1 : shape.ProgramSize),
        unit(shape.EraseSize == 0 ? program : shape.EraseSize),
        buffer(CO_STORE_BUFFER - CO_STORE_BUFFER % program),
        header(round_up(sizeof(Header), program)),
        slot(round_up(header + round_up(what.size, program), unit)) {}

  // Returns whether the record fits into the memory. Also requires that the erase size is a multiple of the program
  // size. The first condition limits all sizes to half the capacity, so that no later sum exceeds 32 bits.
  [[nodiscard]] bool fits() const {
    const uint32_t half = shape.Capacity / 2;
    if (program > CO_STORE_BUFFER || shape.EraseSize % program != 0 || shape.EraseSize > half || record.size > half) {
      return false;
    }
    return slot <= half && record.start <= shape.Capacity - 2 * slot && record.start % unit == 0;
  }

  CO_NODE& node;
  const Record& record;
  CO_NVM_SHAPE shape;
  uint32_t program;  // program size
  uint32_t unit;     // address and size of a slot are multiples of this
  uint32_t buffer;   // bytes of the work memory that are used: a multiple of the program size
  uint32_t header;   // bytes that the header occupies
  uint32_t slot;     // bytes that a slot occupies
};

// Returns the CRC of the header and the identity of the record; the data are to be added.
[[gnu::noinline]] wire::Crc32 crc_of(const Header& header, const Record& record) {
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
      : node_(const_cast<CO_NODE&>(node)), working_(node_), ext_(node.IsNodeLocked != 0 ? node.Ext : nullptr) {
    port::unlock_node(node_, ext_);
  }
  ~Outside() {
    if (ext_ != nullptr) {
      port::lock_node(node_);
    }
  }
  Outside(const Outside&) = delete;
  Outside& operator=(const Outside&) = delete;

 private:
  CO_NODE& node_;
  event::Working working_;
  const CO_NODE_EXT* ext_;
};
#else
class Outside {
 public:
  explicit Outside(const CO_NODE&) {}
};
#endif

bool read(const Region& region, uint32_t start, void* to, uint32_t size) {
  const Outside outside(region.node);
  return port::nvm_read(region.node, start, static_cast<uint8_t*>(to), size) == size;
}

// Returns the size of the next piece, of the bytes that are left.
uint32_t piece_of(const Region& region, uint32_t left) {
  CO_ASSERT(region.buffer != 0);
  return left < region.buffer ? left : region.buffer;
}

// Use of the data of a slot while their CRC is calculated.
struct Pass {
  uint8_t* data;  // memory of the application
  uint32_t left;  // number of its bytes that follow
  bool compares;  // the bytes are compared with the slot; otherwise copied from it
  bool differs;   // result of the comparison
};

void use(Pass& pass, const uint8_t* bytes, uint32_t size) {
  const uint32_t used = size < pass.left ? size : pass.left;
  if (!pass.compares) {
    __builtin_memcpy(pass.data, bytes, used);
  } else if (!is_same(bytes, pass.data, used)) {
    pass.differs = true;
  }
  pass.data += used;
  pass.left -= used;
}

// Adds size bytes of the memory to the CRC, in pieces. Returns false if they cannot be read. The application's memory
// is written with the node lock held.
bool add_to_crc(const Region& region, uint32_t start, uint32_t size, wire::Crc32& crc, Pass* pass) {
  uint8_t buffer[CO_STORE_BUFFER];
  while (size != 0) {
    const uint32_t piece = piece_of(region, size);
    if (!read(region, start, buffer, piece)) {
      return false;
    }
    crc.add(buffer, piece);
    if (pass != nullptr) {
      use(*pass, buffer, piece);
    }
    start += piece;
    size -= piece;
  }
  return true;
}

// Returns whether the header is that of an unused memory: FFh or 00h throughout.
bool is_blank(const Header& header) {
  const auto* const bytes = reinterpret_cast<const uint8_t*>(&header);
  const bool uniform = is_same(bytes, bytes + 1, sizeof header - 1);
  return uniform && (*bytes == erased || *bytes == 0);
}

// Reads header and data of a slot; pass: null, or how the data are used. Returns what the slot holds;
// Found::lost if its header or its CRC is invalid. A header that cannot be read is 0 throughout.
Found read_slot(const Region& region, uint32_t start, Header& header, Pass* pass) {
  if (!read(region, start, &header, sizeof header)) {
    header = {};
    return Found::lost;
  }
  if (is_blank(header)) {
    return Found::blank;
  }
  const bool is_default = header.size == defaults;
  const uint32_t size = region.record.size;
  if (header.magic != magic || header.version != region.record.version || (!is_default && header.size != size)) {
    return Found::lost;
  }
  wire::Crc32 crc = crc_of(header, region.record);
  if (!add_to_crc(region, start + region.header, is_default ? 0 : size, crc, pass) || crc.value() != header.crc) {
    return Found::lost;
  }
  return is_default ? Found::defaults : Found::data;
}

// One of the two slots of a record.
struct Slot {
  Slot(const Region& region, uint32_t begin, Pass* pass)
      : start(begin), header{}, found(region.fits() ? read_slot(region, begin, header, pass) : Found::no_room) {}

  uint32_t start;
  Header header;
  Found found;
};

// Returns whether the slot holds a valid record.
bool is_whole(const Slot& slot) { return slot.found == Found::data || slot.found == Found::defaults; }

// Returns whether the slot holds a valid record that is newer than that of the other slot. Generations may wrap around.
bool is_newer(const Slot& slot, const Slot& other) {
  return is_whole(slot) && (!is_whole(other) || other.header.generation - slot.header.generation > INT32_MAX);
}

// Reads a slot again. Returns whether it still holds the same.
bool read_again(const Region& region, const Slot& slot, Pass& pass) {
  return Slot(region, slot.start, &pass).found == slot.found;
}

// Both slots of a record.
struct Slots {
  explicit Slots(const Region& region)
      : slot{Slot(region, region.record.start, nullptr), Slot(region, region.record.start + region.slot, nullptr)},
        newest(&slot[is_newer(slot[0], slot[1]) ? 0 : 1]),
        other(&slot[newest == slot ? 1 : 0]) {}
  Slots(const Slots&) = delete;
  Slots& operator=(const Slots&) = delete;

  Slot slot[2];
  const Slot* newest;  // the newest valid one; the second slot if none is valid
  const Slot* other;   // the next store writes it
};

// Returns whether the other slot is damaged and was written after the newest valid one, so that its data are lost. A
// slot whose store was interrupted before its header was written does not count: the header is erased (Found::blank),
// or still that of its previous record, whose generation is one lower than that of the newest valid slot. A header that
// cannot be read, or was written in part, does count.
bool is_newest_damaged(const Slots& slots) {
  const Header& header = slots.other->header;
  const bool is_unread = header.magic == 0;
  return slots.other->found == Found::lost && (is_unread || slots.newest->header.generation - header.generation != 1);
}

// The slot that held the newest record of a group when it was loaded or saved last (CO_NODE.Storage.Newest): it is not
// erased, even if the memory cannot be read meanwhile.
constexpr unsigned groups_in_byte = 4;
constexpr unsigned slot_bits = 2;

// The two bits of a group in CO_NODE.Storage.Newest.
struct Remembered {
  explicit Remembered(const Region& region)
      : byte(region.node.Storage.Newest[region.record.group / groups_in_byte]),
        shift(region.record.group % groups_in_byte * slot_bits) {
    CO_ASSERT(region.record.group / groups_in_byte < sizeof region.node.Storage.Newest);
  }
  uint8_t& byte;
  unsigned shift;
};

// Group 0 is remembered by none, because several records may have it.
void remember(const Region& region, const Slot& slot) {
  if (region.record.group == 0) {
    return;
  }
  const Remembered at(region);
  const unsigned number = slot.start == region.record.start ? 1 : 2;
  const unsigned others = at.byte & ~(3U << at.shift);
  at.byte = static_cast<uint8_t>(others | (is_whole(slot) ? number : 0) << at.shift);
}

// Returns whether the slot that was remembered cannot be read any more.
bool is_hidden(const Region& region, const Slots& slots) {
  const Remembered at(region);
  const unsigned number = unsigned{at.byte} >> at.shift & 3U;
  return number != 0 && !is_whole(slots.slot[number - 1]);
}

bool program(const Region& region, uint32_t start, uint8_t* bytes, uint32_t size) {
  const Outside outside(region.node);
  return port::nvm_write(region.node, start, bytes, size) == size;
}

// Writes bytes and fills the last program unit up. The application may change the bytes during the call, so the CRC is
// calculated from the bytes that are written.
bool write(const Region& region, uint32_t start, const uint8_t* bytes, uint32_t size, wire::Crc32& crc) {
  uint8_t buffer[CO_STORE_BUFFER];
  while (size != 0) {
    const uint32_t piece = piece_of(region, size);
    __builtin_memset(buffer, erased, sizeof buffer);
    __builtin_memcpy(buffer, bytes, piece);
    crc.add(buffer, piece);
    if (!program(region, start, buffer, round_up(piece, region.program))) {
      return false;
    }
    start += piece;
    bytes += piece;
    size -= piece;
  }
  return true;
}

bool erase(const Region& region, uint32_t start) {
  const Outside outside(region.node);
  return region.shape.EraseSize == 0 || port::nvm_erase(region.node, start, region.slot);
}

// Writes a slot, its header last: the slot is invalid until the header is written. data: null for the defaults
bool write_slot(const Region& region, uint32_t start, Header& header, const uint8_t* data) {
  CO_ASSERT(start % region.unit == 0 && start - region.record.start <= region.slot);
  wire::Crc32 crc = crc_of(header, region.record);
  wire::Crc32 unused;
  if (!erase(region, start) ||
      !write(region, start + region.header, data, header.size == defaults ? 0 : header.size, crc)) {
    return false;
  }
  header.crc = crc.value();
  return write(region, start, reinterpret_cast<const uint8_t*>(&header), sizeof header, unused);
}

// Writes the slot that does not hold the newest valid record. data: null for the defaults. The generation is one higher
// than in the remaining slot, even if that one is invalid: is_newest_damaged() compares both. Reads both slots again
// afterwards: if the remaining slot could not be read before, its record may be the newer one.
CO_ERR write_record(const Region& region, const Slots& slots, const uint8_t* data) {
  const uint32_t start = slots.other->start;
  const uint32_t generation = slots.newest->header.generation + 1;
  const Record& record = region.record;
  Header header = {magic, record.version, data == nullptr ? defaults : record.size, generation, 0};
  if (!write_slot(region, start, header, data)) {
    return CO_ERR_IF_NVM_WRITE;
  }
  const Slots after(region);
  const Slot& newest = *after.newest;
  const bool is_loaded_next = newest.start == start && is_whole(newest) && newest.header.crc == header.crc &&
                              newest.header.generation == generation;
  if (!is_loaded_next) {
    return CO_ERR_IF_NVM_WRITE;
  }
  remember(region, newest);
  return CO_ERR_NONE;
}

// Loads the newest valid slot, or the other one if the memory then returns other bytes.
Found load(CO_NODE& node, const Record& record, store::Target& target) {
  CO_ASSERT(target.size <= record.size);
  const Region region(node, record);
  const Slots slots(region);
  target.is_older = is_newest_damaged(slots);
  const Slot* slot = slots.newest;
  for (unsigned n = 0; n < 2; ++n) {
    Pass copy = {target.to, target.size, false, false};
    if (is_whole(*slot) && read_again(region, *slot, copy)) {
      remember(region, *slot);
      return slot->found;
    }
    target.is_older = true;
    slot = slots.other;
  }
  target.is_older = false;
  remember(region, *slots.newest);
  const bool is_unused = !is_whole(*slots.newest) && slots.newest->found == slots.other->found;
  return is_unused ? slots.newest->found : Found::lost;
}

CO_ERR save(CO_NODE& node, const Record& record, const uint8_t* data, store::Cause cause) {
  const Region region(node, record);
  const Slots slots(region);
  if (slots.newest->found == Found::no_room) {
    return CO_ERR_PARA_STORE;
  }
  if (cause == store::Cause::change && slots.newest->found == Found::defaults) {
    return CO_ERR_NONE;
  }
  const Found wanted = data == nullptr ? Found::defaults : Found::data;
  Pass compare = {const_cast<uint8_t*>(data), data == nullptr ? 0 : record.size, true, false};
  if (slots.newest->found == wanted && read_again(region, *slots.newest, compare) && !compare.differs) {
    return CO_ERR_NONE;
  }
  if (is_hidden(region, slots)) {
    return CO_ERR_IF_NVM_WRITE;
  }
  return budget::take_store(node) ? write_record(region, slots, data) : CO_ERR_OBJ_STATE;
}

}  // namespace

bool is_same(const uint8_t* a, const uint8_t* b, uint32_t num) {
  uint32_t n = 0;
  while (n < num && a[n] == b[n]) {
    ++n;
  }
  return n == num;
}

uint32_t space(CO_NODE& node, const Record& record) { return 2 * Region(node, record).slot; }

const CO_STORE_T store = {load, save};

}  // namespace co::slots

#endif
