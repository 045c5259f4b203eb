// SPDX-License-Identifier: Apache-2.0
// OD_readOriginal() and OD_writeOriginal(): access to objects through their original types, in pieces of any length.
// Kind::application_stream is a stream whose type the application defines: only the functions of its type access its
// data.
#include "base/events.hpp"
#include "dictionary/access.hpp"
#include "dictionary/obj.hpp"
#include "dictionary/types/stream.hpp"
#include "extra/od/properties.hpp"
#include "extra/od/types.hpp"
#include "hal/port.hpp"
#include "service/pdo/mapping.hpp"
#include "wire/bytes.hpp"

#if USE_OD

namespace co::od {
namespace {

uint8_t* bytes_at(void* memory, OD_size_t position) { return static_cast<uint8_t*>(memory) + position; }

// Piece of an access to a value whose end is known; all members in bytes.
struct Piece {
  OD_size_t position;
  OD_size_t bytes;
  OD_size_t end;
};

bool is_last(const Piece& piece) { return piece.position + piece.bytes == piece.end; }

// Returns whether an access can continue at dataOffset: before the end or, if the value is empty, at its end.
bool can_continue(const OD_stream_t& stream, OD_size_t end) {
  return stream.dataOffset < end || (end == 0 && stream.dataOffset == 0);
}

// Sets the position of an access behind a piece that was read or written. Returns ODR_OK after the last piece, and sets
// the position to the beginning for the next access; else ODR_PARTIAL. passed: bytes of the piece.
ODR_t advance_access(OD_stream_t& stream, const Piece& piece, OD_size_t& passed) {
  passed = piece.bytes;
  stream.dataOffset = is_last(piece) ? 0 : piece.position + piece.bytes;
  return is_last(piece) ? ODR_OK : ODR_PARTIAL;
}

CO_ERR call(CO_OBJ_READ_FUNC function, const OD_stream_t& stream, void* data, uint32_t n) {
  return function == nullptr ? CO_ERR_OBJ_ACC : function(stream.Entry, stream.Owner, data, n);
}

// Writes a copy of the data: a type function may change the buffer that it gets, but the caller's buffer must stay
// unchanged. Also calls the function for 0 bytes, which empty an object of variable length.
CO_ERR write_copy(const CO_OBJ_TYPE& type, const OD_stream_t& stream, const uint8_t* from, uint32_t n) {
  uint8_t copy[32];
  CO_ERR err = CO_ERR_NONE;
  do {
    const uint32_t part = n < sizeof copy ? n : static_cast<uint32_t>(sizeof copy);
    wire::copy(copy, from, part);
    err = call(type.Write, stream, copy, part);
    from += part;
    n -= part;
  } while (n != 0 && err == CO_ERR_NONE);
  return err;
}

uint32_t size_of(const OD_stream_t& stream, const CO_OBJ_TYPE& type) {
  return type.Size == nullptr ? 0 : type.Size(stream.Entry, stream.Owner, 0);
}

// Returns whether an SDO transfer has the object open, other than the one that is being processed, which may be the
// caller. A stream of the application allows one access at a time.
bool is_in_sdo_transfer(const OD_stream_t& stream) {
  const CO_NODE& node = *stream.Owner;
  return access::requested_object(node) != stream.Entry && access::is_open(node, *stream.Entry);
}

// Sets the position of a stream of the application to dataOffset. At position 0 also opens the stream, like an SDO
// transfer: calls the Read or Write function with length 0.
ODR_t open(const OD_stream_t& stream, const CO_OBJ_TYPE& type, CO_OBJ_READ_FUNC function) {
  if (is_in_sdo_transfer(stream)) {
    return ODR_DATA_DEV_STATE;
  }
  if (stream.dataOffset != 0 && !can_seek(type)) {
    return ODR_UNSUPP_ACCESS;
  }
  CO_ERR err = seek(*stream.Entry, *stream.Owner, type, stream.dataOffset);
  if (err == CO_ERR_NONE && stream.dataOffset == 0) {
    uint8_t nothing = 0;
    err = call(function, stream, &nothing, 0);
  }
  return result_of(*stream.Owner, *stream.Entry, err);
}

// Returns whether the original type cannot access the object: there is no original type, or no memory.
bool is_inaccessible(const Properties& properties) {
  const bool is_memory = properties.kind >= Kind::text && properties.kind <= Kind::domain;
  return properties.kind == Kind::none || (is_memory && properties.memory == nullptr);
}

// Reading -------------------------------------------------------------------------------------------------------------

CO_ERR read_number(const OD_stream_t& stream, const CO_OBJ_TYPE& type, const Piece& piece, uint8_t* to) {
  uint8_t value[longest_number] = {};
  const CO_ERR err = call(type.Read, stream, value, piece.end);
  if (err == CO_ERR_NONE) {
    wire::copy(to, value + piece.position, piece.bytes);
  }
  return err;
}

// Reads a piece of a text; bytes behind the end of the text are 0.
CO_ERR read_text(const OD_stream_t& stream, const CO_OBJ_TYPE& type, const Piece& piece, uint8_t* to) {
  const co::stream::KeptPosition kept(*stream.Entry);
  const uint32_t length = size_of(stream, type);
  const uint32_t left = piece.position < length ? length - piece.position : 0;
  __builtin_memset(to, 0, piece.bytes);
  const CO_ERR err = seek(*stream.Entry, *stream.Owner, type, piece.position);
  return err != CO_ERR_NONE ? err : call(type.Read, stream, to, left < piece.bytes ? left : piece.bytes);
}

CO_ERR read_stream(const OD_stream_t& stream, const CO_OBJ_TYPE& type, const Piece& piece, uint8_t* to) {
  const co::stream::KeptPosition kept(*stream.Entry);
  const CO_ERR err = seek(*stream.Entry, *stream.Owner, type, piece.position);
  return err != CO_ERR_NONE ? err : call(type.Read, stream, to, piece.bytes);
}

// Reads a value of more than 8 bytes, in one call. The call with length 0 marks the start of the access, as in an SDO
// transfer.
ODR_t read_long(const OD_stream_t& stream, const CO_OBJ_TYPE& type, const Piece& piece, uint8_t* to) {
  if (piece.position != 0 || !is_last(piece)) {
    return ODR_UNSUPP_ACCESS;
  }
  const CO_ERR err = call(type.Read, stream, to, 0);
  return result_of(*stream.Owner, *stream.Entry, err != CO_ERR_NONE ? err : call(type.Read, stream, to, piece.bytes));
}

// Reads the next piece of a stream of the application. Its size may become known only when its end has been read: Size
// is called before and after the read.
ODR_t read_application_stream(OD_stream_t& stream, const CO_OBJ_TYPE& type, uint8_t* to, OD_size_t count,
                              OD_size_t& passed) {
  const ODR_t opened = open(stream, type, type.Read);
  if (opened != ODR_OK) {
    return opened;
  }
  uint32_t size = size_of(stream, type);
  const OD_size_t position = stream.dataOffset;
  const bool unknown = size == CO_OBJ_SIZE_UNKNOWN;
  if (!unknown && position > size) {
    return ODR_DEV_INCOMPAT;
  }
  OD_size_t bytes = unknown || count < size - position ? count : size - position;
  const CO_ERR err = bytes == 0 ? CO_ERR_NONE : call(type.Read, stream, to, bytes);
  if (err != CO_ERR_NONE) {
    return result_of(*stream.Owner, *stream.Entry, err);
  }
  size = unknown ? size_of(stream, type) : size;
  if (size < position) {
    return ODR_DEV_INCOMPAT;
  }
  if (size == CO_OBJ_SIZE_UNKNOWN) {
    size = UINT32_MAX;
  } else if (size - position < bytes) {
    bytes = size - position;
  }
  return advance_access(stream, {position, bytes, size}, passed);
}

ODR_t read_piece(const OD_stream_t& stream, const CO_OBJ_TYPE& type, Kind kind, const Piece& piece, uint8_t* to) {
  switch (kind) {
    case Kind::number: return result_of(*stream.Owner, *stream.Entry, read_number(stream, type, piece, to));
    case Kind::text: return result_of(*stream.Owner, *stream.Entry, read_text(stream, type, piece, to));
    case Kind::long_value: return read_long(stream, type, piece, to);
    default: return result_of(*stream.Owner, *stream.Entry, read_stream(stream, type, piece, to));
  }
}

// Returns the end of a read access in bytes: dataLength of a text (unless the caller changes it, its capacity), else
// the length of the object.
OD_size_t end_of(const OD_stream_t& stream, const CO_OBJ_TYPE& type, Kind kind) {
  return kind == Kind::text ? stream.dataLength : size_of(stream, type);
}

ODR_t read_object(OD_stream_t& stream, uint8_t* to, OD_size_t count, OD_size_t& passed) {
  const Properties properties = properties_of(*stream.Entry, *stream.Owner);
  if (is_inaccessible(properties)) {
    return ODR_SUB_NOT_EXIST;
  }
  const CO_OBJ_TYPE& type = *properties.type;
  if (type.Read == nullptr) {
    return ODR_WRITEONLY;
  }
  if (properties.kind == Kind::application_stream) {
    return read_application_stream(stream, type, to, count, passed);
  }
  const OD_size_t end = end_of(stream, type, properties.kind);
  if (!can_continue(stream, end)) {
    return ODR_DEV_INCOMPAT;
  }
  const OD_size_t left = end - stream.dataOffset;
  const Piece piece = {stream.dataOffset, count < left ? count : left, end};
  const ODR_t result = read_piece(stream, type, properties.kind, piece, to);
  return result != ODR_OK ? result : advance_access(stream, piece, passed);
}

ODR_t read_memory(OD_stream_t& stream, uint8_t* to, OD_size_t count, OD_size_t& passed) {
  if (stream.dataOrig == nullptr) {
    return ODR_SUB_NOT_EXIST;
  }
  if (stream.dataOffset >= stream.dataLength) {
    return ODR_DEV_INCOMPAT;
  }
  const OD_size_t left = stream.dataLength - stream.dataOffset;
  const Piece piece = {stream.dataOffset, count < left ? count : left, stream.dataLength};
  wire::copy(to, bytes_at(stream.dataOrig, piece.position), piece.bytes);
  return advance_access(stream, piece, passed);
}

// Writing -------------------------------------------------------------------------------------------------------------

// Writes a piece of a number; its other bytes keep their values.
CO_ERR write_number(const OD_stream_t& stream, const CO_OBJ_TYPE& type, const Piece& piece, const uint8_t* from) {
  uint8_t value[longest_number] = {};
  const bool is_complete = piece.position == 0 && is_last(piece);
  CO_ERR err = is_complete ? CO_ERR_NONE : call(type.Read, stream, value, piece.end);
  if (err == CO_ERR_NONE) {
    wire::copy(value + piece.position, from, piece.bytes);
    err = call(type.Write, stream, value, piece.end);
  }
  return err;
}

CO_ERR write_stream(const OD_stream_t& stream, const CO_OBJ_TYPE& type, const Piece& piece, const uint8_t* from) {
  const co::stream::KeptPosition kept(*stream.Entry);
  const CO_ERR err = seek(*stream.Entry, *stream.Owner, type, piece.position);
  return err != CO_ERR_NONE ? err : write_copy(type, stream, from, piece.bytes);
}

bool is_zero(const uint8_t* character, unsigned bytes) { return character[0] == 0 && character[bytes - 1] == 0; }

// Writes a piece of a text. After the last piece, zeros at the end are removed from the length of the text.
CO_ERR write_text(const OD_stream_t& stream, const CO_OBJ_TYPE& type, const Piece& piece, const uint8_t* from) {
  const CO_ERR err = write_stream(stream, type, piece, from);
  if (err != CO_ERR_NONE || !is_last(piece)) {
    return err;
  }
  auto& string = *data_of<CO_OBJ_STR_RW>(*stream.Entry);
  const unsigned character = bytes_of_character(&type);
  while (string.Size >= character && is_zero(string.Start + string.Size - character, character)) {
    string.Size -= character;
  }
  return CO_ERR_NONE;
}

ODR_t write_long(const OD_stream_t& stream, const CO_OBJ_TYPE& type, const Piece& piece, const uint8_t* from) {
  if (piece.position != 0 || !is_last(piece)) {
    return ODR_UNSUPP_ACCESS;
  }
  uint8_t nothing = 0;
  const CO_ERR err = call(type.Write, stream, &nothing, 0);
  return result_of(*stream.Owner, *stream.Entry,
                   err != CO_ERR_NONE ? err : write_copy(type, stream, from, piece.bytes));
}

ODR_t write_application_stream(const OD_stream_t& stream, const CO_OBJ_TYPE& type, const Piece& piece,
                               const uint8_t* from) {
  const ODR_t opened = open(stream, type, type.Write);
  return opened != ODR_OK ? opened
                          : result_of(*stream.Owner, *stream.Entry, write_copy(type, stream, from, piece.bytes));
}

ODR_t write_piece(const OD_stream_t& stream, const Properties& properties, const Piece& piece, const uint8_t* from) {
  const CO_OBJ_TYPE& type = *properties.type;
  switch (properties.kind) {
    case Kind::number: return result_of(*stream.Owner, *stream.Entry, write_number(stream, type, piece, from));
    case Kind::text: return result_of(*stream.Owner, *stream.Entry, write_text(stream, type, piece, from));
    case Kind::long_value: return write_long(stream, type, piece, from);
    case Kind::application_stream: return write_application_stream(stream, type, piece, from);
    default: return result_of(*stream.Owner, *stream.Entry, write_stream(stream, type, piece, from));
  }
}

bool is_in_memory(const Properties& properties) {
  return properties.kind == Kind::text || properties.kind == Kind::octets || properties.kind == Kind::domain;
}

// Returns the bytes that the value will have: dataLength if the caller has reduced it and the object can be shorter
// than its capacity, else the length of the object. For a stream of the application returns dataLength, or UINT32_MAX
// if the length is not known, except for a write of 0 bytes at the beginning, which empties the stream.
OD_size_t end_of_write(const OD_stream_t& stream, const Properties& properties, OD_size_t count) {
  const bool is_unknown = stream.dataLength == 0 && (count != 0 || stream.dataOffset != 0);
  if (properties.kind == Kind::application_stream) {
    return is_unknown ? UINT32_MAX : stream.dataLength;
  }
  return is_in_memory(properties) && stream.dataLength < properties.length ? stream.dataLength : properties.length;
}

// Returns the running call of an extension's write function, if it is for this object; else null.
OD_WRITING_T* find_running_write(const OD_stream_t& stream) {
  const OD_t* const od = port::od_of(*stream.Owner);
  OD_WRITING_T* const writing = od == nullptr ? nullptr : od->Writing;
  return writing != nullptr && &writing->obj == stream.Entry ? writing : nullptr;
}

// Writes on behalf of the write function of an extension. TPDOs that are triggered by a change are deferred while
// mapped objects are locked.
ODR_t write_for_extension(OD_WRITING_T& writing, const OD_stream_t& stream, const Properties& properties,
                          const Piece& piece, const uint8_t* from) {
  const pdo::Lock lock(*stream.Owner);
  writing.by_original = !is_in_memory(properties);
  return write_piece(stream, properties, piece, from);
}

ODR_t write_object(OD_stream_t& stream, const uint8_t* from, OD_size_t count, OD_size_t& passed) {
  const Properties properties = properties_of(*stream.Entry, *stream.Owner);
  if (is_inaccessible(properties)) {
    return ODR_SUB_NOT_EXIST;
  }
  if (properties.type->Write == nullptr) {
    return ODR_READONLY;
  }
  const OD_size_t end = end_of_write(stream, properties, count);
  if (!can_continue(stream, end)) {
    return ODR_DEV_INCOMPAT;
  }
  if (count > end - stream.dataOffset) {
    return ODR_DATA_LONG;
  }
  const Piece piece = {stream.dataOffset, count, end};
  if (count == 0 && !is_last(piece)) {
    return advance_access(stream, piece, passed);
  }
  OD_WRITING_T* const writing = find_running_write(stream);
  const ODR_t result = writing == nullptr ? write_piece(stream, properties, piece, from)
                                          : write_for_extension(*writing, stream, properties, piece, from);
  return result != ODR_OK ? result : advance_access(stream, piece, passed);
}

ODR_t write_memory(OD_stream_t& stream, const uint8_t* from, OD_size_t count, OD_size_t& passed) {
  if (stream.dataOrig == nullptr) {
    return ODR_SUB_NOT_EXIST;
  }
  if (stream.dataOffset >= stream.dataLength) {
    return ODR_DEV_INCOMPAT;
  }
  if (count > stream.dataLength - stream.dataOffset) {
    return ODR_DATA_LONG;
  }
  const Piece piece = {stream.dataOffset, count, stream.dataLength};
  wire::copy(bytes_at(stream.dataOrig, piece.position), from, piece.bytes);
  return advance_access(stream, piece, passed);
}

}  // namespace

}  // namespace co::od

extern "C" {

ODR_t OD_readOriginal(OD_stream_t* stream, void* buf, OD_size_t count, OD_size_t* countRead) {
  if (stream == nullptr || buf == nullptr || countRead == nullptr) {
    return ODR_DEV_INCOMPAT;
  }
  auto* const to = static_cast<uint8_t*>(buf);
  return stream->Entry == nullptr ? co::od::read_memory(*stream, to, count, *countRead)
                                  : co::od::read_object(*stream, to, count, *countRead);
}

// Runs deferred work, unless an extension's write function is the caller: the caller of that function does it.
ODR_t OD_writeOriginal(OD_stream_t* stream, const void* buf, OD_size_t count, OD_size_t* countWritten) {
  if (stream == nullptr || buf == nullptr || countWritten == nullptr) {
    return ODR_DEV_INCOMPAT;
  }
  const auto* const from = static_cast<const uint8_t*>(buf);
  if (stream->Entry == nullptr) {
    return co::od::write_memory(*stream, from, count, *countWritten);
  }
  CO_NODE& node = *stream->Owner;
  if (!co::port::is_initialised(node)) {
    return ODR_DEV_INCOMPAT;
  }
  const ODR_t result = co::od::write_object(*stream, from, count, *countWritten);
  if (node.Ext->Od == nullptr || node.Ext->Od->Writing == nullptr) {
    co::event::run_deferred(node);
  }
  return result;
}

}  // extern "C"

#endif
