// SPDX-License-Identifier: Apache-2.0
// Types of extensible entries: streams.
#include "dictionary/types/stream.hpp"
#include "dictionary/access.hpp"
#include "dictionary/obj.hpp"
#include "extra/od/transfer.hpp"
#include "extra/od/types.hpp"
#include "hal/port.hpp"
#include "wire/bytes.hpp"

#if USE_OD

namespace co::od {
namespace {

// One piece of an access through an extension.
struct Access {
  CO_OBJ& obj;
  CO_NODE& node;
  const OD_extension_t& extension;
  OD_TRANSFER& transfer;  // element of OD_t.Transfer to which the access belongs
  OD_TRANSFER state;      // copy of transfer during the piece: a function of the application may begin another access,
                          // which overwrites transfer
  OD_stream_t stream;     // argument of the extension's function
};

// Begins a piece: sets the flag in_application and prepares the argument of the extension's function.
Access begin_piece(CO_OBJ& obj, CO_NODE& node, const OD_extension_t& extension, OD_TRANSFER& transfer) {
  Access access = {obj, node, extension, transfer, transfer, stream_of(obj, node)};
  access.stream.object = extension.object;
  access.stream.dataOffset = transfer.Offset;
  access.stream.dataLength = transfer.Length;
  set(transfer, in_application);
  return access;
}

// Ends a piece: copies the state back, which clears the flag in_application, unless the extension's function has ended
// the access.
void end_piece(Access& access) {
  access.state.Offset = access.stream.dataOffset;
  access.state.Length = access.stream.dataLength;
  if (has(access.transfer, extension_changed)) {
    set(access.state, extension_changed);
  }
  if (access.transfer.Entry != nullptr) {
    access.transfer = access.state;
  }
}

// Returns whether the object still has the extension: the extension's function may have removed it.
bool is_valid(const Access& access) { return extension_of(access.node, access.obj) == &access.extension; }

bool is_success(ODR_t result) { return result == ODR_OK || result == ODR_PARTIAL; }

bool is_text(const OD_stream_t& stream) { return (stream.attribute & ODA_STR) != 0; }

unsigned bytes_of_character(const Access& access) { return od::bytes_of_character(original_type(access.obj)); }

// Lengths -------------------------------------------------------------------------------------------------------------

// Returns the length in bytes nearest to width that a download may have (objects of variable length: up to their
// capacity); width 0: the length of an upload.
uint32_t size_of_original(CO_OBJ& obj, CO_NODE& node, uint32_t width) {
  const CO_OBJ_TYPE* const type = original_type(obj);
  if (type != nullptr) {
    return type->Size == nullptr ? 0 : type->Size(&obj, &node, width);
  }
  const auto length = static_cast<uint32_t>(uintptr_t{obj.Data});
  return length == 0 ? width : length;
}

// Returns the length in bytes of an upload, or CO_OBJ_SIZE_UNKNOWN: strings can be shorter than their capacity.
uint32_t length_of(CO_OBJ& obj, CO_NODE& node) {
  const Properties properties = properties_of(obj, node);
  const bool varies =
      (properties.attribute & ODA_STR) != 0 || properties.kind == Kind::octets || properties.length == 0;
  return varies ? CO_OBJ_SIZE_UNKNOWN : properties.length;
}

// Returns the length of an upload through an extension: after the last piece the bytes that were read, before that
// length_of().
uint32_t size_to_read(CO_OBJ& obj, CO_NODE& node) {
  const OD_TRANSFER* const transfer = find_access(*node.Ext->Od, node, obj);
  return transfer != nullptr && is_read_completely(*transfer) ? transfer->Passed : length_of(obj, node);
}

// Returns the length of an upload: the size that was indicated to the client or, for the application, the length of the
// object.
uint32_t bytes_to_read(const Access& access) {
  return is_of_application(*access.node.Ext->Od, access.transfer) ? length_of(access.obj, access.node)
                                                                  : access.state.Total;
}

// Returns the length of a download, which is known once the last piece arrives. end: bytes up to the end of this piece.
// The application writes a value in one piece: its length is the one nearest to end that the object allows.
uint32_t bytes_to_write(const Access& access, uint32_t end) {
  if (is_of_application(*access.node.Ext->Od, access.transfer)) {
    return size_of_original(access.obj, access.node, end);
  }
  return access.state.Total != CO_OBJ_SIZE_UNKNOWN ? access.state.Total : access::total_of(access.node, access.obj);
}

// Reading -------------------------------------------------------------------------------------------------------------

// Calls the read function until the buffer is full or all data are read. Returns ODR_DEV_INCOMPAT if the function
// returns too many bytes, or ODR_PARTIAL without any.
ODR_t call_read(Access& access, uint8_t* to, OD_size_t size, OD_size_t& passed) {
  const OD_read_t function = access.extension.read;
  ODR_t result = ODR_PARTIAL;
  passed = 0;
  while (result == ODR_PARTIAL && passed < size) {
    if (passed != 0 && !is_valid(access)) {
      return ODR_DATA_DEV_STATE;
    }
    OD_size_t n = 0;
    result = function(&access.stream, to + passed, size - passed, &n);
    if (is_success(result) && (n > size - passed || (n == 0 && result == ODR_PARTIAL))) {
      return ODR_DEV_INCOMPAT;
    }
    passed += is_success(result) ? n : 0;
  }
  return result;
}

// Reads a piece. If it ends within a character of two bytes, the second byte is read ahead into KeptByte, because a
// text ends at the character whose two bytes are 0. passed: bytes in the buffer.
ODR_t read_piece(Access& access, uint8_t* to, OD_size_t size, OD_size_t& passed) {
  OD_TRANSFER& state = access.state;
  OD_size_t held = 0;
  if (has(state, has_kept_byte)) {
    to[held++] = state.KeptByte;
    clear(state, has_kept_byte);
  }
  ODR_t result = has(state, all_passed) ? ODR_OK : ODR_PARTIAL;
  passed = 0;
  if (result == ODR_PARTIAL && held < size) {
    result = call_read(access, to + held, size - held, passed);
  }
  passed += held;
  if (result == ODR_PARTIAL && (state.Passed + passed) % bytes_of_character(access) != 0) {
    OD_size_t ahead = 0;
    result = call_read(access, &state.KeptByte, 1, ahead);
    if (ahead != 0) {
      set(state, has_kept_byte);
    }
  }
  return result;
}

// Returns whether the character at data[at] (n bytes of data) is 0. Its second byte may be in KeptByte.
bool is_zero(const Access& access, const uint8_t* data, OD_size_t n, OD_size_t at) {
  if (data[at] != 0 || bytes_of_character(access) == 1) {
    return data[at] == 0;
  }
  return at + 1 < n ? data[at + 1] == 0 : has(access.state, has_kept_byte) && access.state.KeptByte == 0;
}

// Returns how many of n bytes belong to the text, which ends at its first zero. An empty text counts as one character,
// the zero, because an upload of 0 bytes would mean that there is no value.
OD_size_t length_of_text(Access& access, const uint8_t* data, OD_size_t n) {
  const unsigned character = bytes_of_character(access);
  OD_size_t at = access.state.Passed % character;
  while (at < n && !is_zero(access, data, n, at)) {
    at += character;
  }
  if (at >= n) {
    return n;
  }
  set(access.state, all_passed);
  if (access.state.Passed == 0 && at == 0) {
    at = character;
  }
  if (at > n) {
    return n;
  }
  clear(access.state, has_kept_byte);
  return at;
}

// Checks the length of an upload against the size that was indicated to the client. A text may have any length.
ODR_t check_read(const Access& access, ODR_t result) {
  const uint32_t announced = is_text(access.stream) ? CO_OBJ_SIZE_UNKNOWN : bytes_to_read(access);
  if (announced == CO_OBJ_SIZE_UNKNOWN || !is_success(result)) {
    return result;
  }
  if (result == ODR_OK) {
    return access.state.Passed == announced ? ODR_OK : ODR_DEV_INCOMPAT;
  }
  return access.state.Passed < announced ? ODR_PARTIAL : ODR_DATA_LONG;
}

// Reads a piece through an extension; bytes of the buffer behind the data are set to 0.
ODR_t read(CO_OBJ& obj, CO_NODE& node, const OD_extension_t& extension, OD_TRANSFER& transfer, uint8_t* to,
           uint32_t size) {
  if (extension.read == nullptr) {
    return ODR_UNSUPP_ACCESS;
  }
  if (size == 0 || is_read_completely(transfer)) {
    return ODR_OK;
  }
  Access access = begin_piece(obj, node, extension, transfer);
  OD_size_t passed = 0;
  const ODR_t result = read_piece(access, to, size, passed);
  if (result == ODR_OK) {
    set(access.state, all_passed);
  }
  if (is_success(result)) {
    passed = is_text(access.stream) ? length_of_text(access, to, passed) : passed;
    __builtin_memset(to + passed, 0, size - passed);  // clears bytes that the function may have written there
    access.state.Passed += passed;
  }
  end_piece(access);
  return check_read(access, result);
}

// Writing -------------------------------------------------------------------------------------------------------------

constexpr uint32_t short_text = 8;  // bytes, without the terminating zero: as many as a PDO has

// Sets dataLength to the length of the download, by which the function detects the last piece. A terminating zero is
// added to a text if its capacity allows that. Returns the bytes of this zero.
unsigned set_length(Access& access, uint32_t total) {
  const OD_size_t capacity = is_text(access.stream) ? properties_of(access.obj, access.node).length : 0;
  const unsigned character = bytes_of_character(access);
  const unsigned zeros = total + character <= capacity ? character : 0;
  access.stream.dataLength = total + zeros;
  return zeros;
}

// Calls the write function once. It must accept all bytes or none.
ODR_t call_once(Access& access, const uint8_t* from, uint32_t size) {
  OD_size_t passed = 0;
  const ODR_t result = access.extension.write(&access.stream, from, size, &passed);
  return is_success(result) && passed != size ? ODR_DEV_INCOMPAT : result;
}

// Writes a piece, and the zero (zeros bytes) that terminates a text. A text of up to 8 bytes is written with its zero
// in one call.
ODR_t call_write(Access& access, const uint8_t* from, uint32_t size, unsigned zeros) {
  uint8_t copy[short_text + 2] = {};
  if (zeros == 0) {
    return call_once(access, from, size);
  }
  if (size <= short_text) {
    wire::copy(copy, from, size);
    return call_once(access, copy, size + zeros);
  }
  const ODR_t result = call_once(access, from, size);
  if (result != ODR_PARTIAL) {
    return result;
  }
  return is_valid(access) ? call_once(access, copy, zeros) : ODR_DATA_DEV_STATE;
}

// Checks the result of a write function: it has to be ODR_OK for the last piece and ODR_PARTIAL for any other.
ODR_t check_write(ODR_t result, bool is_last) {
  if (result == ODR_PARTIAL) {
    return is_last ? ODR_DATA_SHORT : ODR_PARTIAL;
  }
  return result == ODR_OK && !is_last ? ODR_DATA_LONG : result;
}

// Checks the length of a download before its last piece is written, so that a function never completes a value whose
// length the object cannot have.
ODR_t check_total(const Access& access, uint32_t total) {
  const uint32_t possible = total == 0 ? 0 : size_of_original(access.obj, access.node, total);
  if (total == possible) {
    return ODR_OK;
  }
  return total > possible ? ODR_DATA_LONG : ODR_DATA_SHORT;
}

// Checks the length of a download, writes a piece of it and reports the change. total: bytes of the download. Called
// while the flag in_application is set, so that the read access of a TPDO is not part of the SDO transfer.
ODR_t write_checked(Access& access, const uint8_t* from, uint32_t size, uint32_t total) {
  const uint32_t end = access.state.Passed + size;
  const bool is_last = end == total;
  if (end > total) {
    return ODR_DATA_LONG;
  }
  ODR_t result = is_last ? check_total(access, total) : ODR_OK;
  if (result != ODR_OK) {
    return result;
  }
  const Writing writing(access.node, access.obj);
  result = check_write(call_write(access, from, size, is_last ? set_length(access, total) : 0), is_last);
  if (is_success(result)) {
    access.state.Passed = end;
  }
  if (result == ODR_OK) {
    set(access.state, all_passed);
  }
  report_change(access.node, access.obj, result == ODR_OK, writing.by_original());
  return result;
}

// Writes a piece through an extension.
ODR_t write(CO_OBJ& obj, CO_NODE& node, const OD_extension_t& extension, OD_TRANSFER& transfer, const uint8_t* from,
            uint32_t size) {
  if (extension.write == nullptr) {
    return ODR_UNSUPP_ACCESS;
  }
  if (size == 0) {
    return ODR_OK;
  }
  if (has(transfer, all_passed)) {
    return ODR_DATA_LONG;
  }
  Access access = begin_piece(obj, node, extension, transfer);
  const ODR_t result = write_checked(access, from, size, bytes_to_write(access, transfer.Passed + size));
  end_piece(access);
  return result;
}

// Ends a download whose last piece had no data: calls the function with 0 bytes, so that it detects the end.
CO_ERR finish_download(CO_OBJ& obj, CO_NODE& node, OD_TRANSFER& transfer) {
  const OD_extension_t* const extension = extension_of(node, obj);
  if (extension == nullptr || extension->write == nullptr || has(transfer, all_passed)) {
    return CO_ERR_NONE;
  }
  constexpr uint8_t no_data = 0;
  Access access = begin_piece(obj, node, *extension, transfer);
  const ODR_t result = write_checked(access, &no_data, 0, access.state.Passed);
  end_piece(access);
  return set_abort_code(obj, node, result, CO_OBJ_DOWNLOAD);
}

// Position ------------------------------------------------------------------------------------------------------------

// Highest number of bytes that one call reads again: the bytes that a block transfer reads ahead. An access of the
// application reads all of them in one call.
constexpr uint32_t max_reread = CO_SDO_BUF_BYTE;

// Reads and discards the bytes up to a position.
ODR_t skip_bytes(CO_OBJ& obj, CO_NODE& node, const OD_extension_t& extension, OD_TRANSFER& transfer,
                 uint32_t position) {
  while (transfer.Passed < position) {
    uint8_t unwanted[32];
    const uint32_t before = transfer.Passed;
    const uint32_t left = position - before;
    const ODR_t result = read(obj, node, extension, transfer, unwanted,
                              left < sizeof unwanted ? left : static_cast<uint32_t>(sizeof unwanted));
    if (!is_success(result)) {
      return result;
    }
    if (transfer.Passed == before || extension_of(node, obj) != &extension) {
      return ODR_DATA_DEV_STATE;
    }
  }
  return ODR_OK;
}

// Moves a read access to a position. A function can only restart at the beginning, so the bytes up to the position are
// read again and discarded. Returns ODR_PARTIAL if another call is needed.
ODR_t move_to_position(CO_OBJ& obj, CO_NODE& node, const OD_extension_t& extension, OD_TRANSFER& transfer,
                       uint32_t position) {
  if (!has(transfer, rereads) || position < transfer.Passed) {
    restart(transfer, stream_of(obj, node).dataLength);
    set(transfer, rereads);
  }
  const bool is_near = position - transfer.Passed <= max_reread || is_of_application(*node.Ext->Od, transfer);
  const ODR_t result = skip_bytes(obj, node, extension, transfer, is_near ? position : transfer.Passed + max_reread);
  if (result == ODR_OK && !is_near) {
    return ODR_PARTIAL;
  }
  clear(transfer, rereads);
  return result;
}

// Sets the position of an access through an extension; for the application, position 0 begins a new access. The
// direction is not known here; it only selects the error if ODR_t has no corresponding abort code.
CO_ERR set_position(CO_OBJ& obj, CO_NODE& node, const OD_extension_t& extension, uint32_t position) {
  OD_t& od = *node.Ext->Od;
  const bool by_application = !is_called_by_transfer(od, node, obj);
  OD_TRANSFER* const transfer = by_application && position == 0 ? &begin_access(od, obj) : find_access(od, node, obj);
  if (transfer == nullptr) {
    return set_abort_code(obj, node, ODR_DATA_DEV_STATE, CO_OBJ_UPLOAD);
  }
  if (position > transfer->Passed && !has(*transfer, rereads)) {
    return CO_ERR_TYPE_RESET;
  }
  if (!by_application) {
    mark_if_of_server(*transfer, node);
  }
  if (position == transfer->Passed && position != 0 && !has(*transfer, rereads)) {
    return CO_ERR_NONE;
  }
  const ODR_t result = move_to_position(obj, node, extension, *transfer, position);
  return result == ODR_PARTIAL ? CO_ERR_TYPE_AGAIN : set_abort_code(obj, node, result, CO_OBJ_UPLOAD);
}

// Original types ------------------------------------------------------------------------------------------------------

// Returns the SDO transfer that is being processed if the running access belongs to it, else null.
OD_TRANSFER* transfer_of_original(const CO_OBJ& obj, const CO_NODE& node) {
  OD_t* const od = port::od_of(node);
  return od != nullptr && is_called_by_transfer(*od, node, obj) ? find_transfer(*od, node, obj) : nullptr;
}

// Reads or writes a piece of a stream of this library at a position. The position is set for each piece, because the
// application may have used the stream in between.
CO_ERR access_at(CO_OBJ& obj, CO_NODE& node, CO_OBJ_READ_FUNC function, uint32_t position, void* buffer,
                 uint32_t size) {
  const stream::KeptPosition kept(obj);
  const CO_ERR err = stream::seek(obj, position);
  return err != CO_ERR_NONE ? err : function(&obj, &node, buffer, size);
}

// Reads or writes a piece through the original type of an entry that is not extended.
CO_ERR access_original(CO_OBJ& obj, CO_NODE& node, void* buffer, uint32_t size, CO_OBJ_TRANSFER direction) {
  const CO_OBJ_TYPE* const type = type_if_not_extended(*extensible(obj));
  const CO_OBJ_READ_FUNC function = type == nullptr ? nullptr : (direction == CO_OBJ_UPLOAD ? type->Read : type->Write);
  if (function == nullptr) {
    return refuse_access(obj, node, direction);
  }
  OD_TRANSFER* const transfer = transfer_of_original(obj, node);
  if (transfer == nullptr || type->Reset != stream::reset) {
    return function(&obj, &node, buffer, size);
  }
  const uint32_t position = transfer->Passed;
  transfer->Passed += size;
  return access_at(obj, node, function, position, buffer, size);
}

CO_ERR set_original_position(CO_OBJ& obj, CO_NODE& node, uint32_t position) {
  const CO_OBJ_TYPE* const type = type_if_not_extended(*extensible(obj));
  if (OD_TRANSFER* const transfer = transfer_of_original(obj, node); transfer != nullptr) {
    transfer->Passed = position;
    mark_if_of_server(*transfer, node);
    if (type != nullptr && type->Reset == stream::reset) {
      return CO_ERR_NONE;
    }
  }
  return type == nullptr ? CO_ERR_NONE : seek(obj, node, *type, position);
}

CO_ERR begin_original(CO_OBJ& obj, CO_NODE& node, CO_OBJ_TRANSFER transfer, uint32_t size) {
  const CO_OBJ_TYPE_EX* const type = extended_type(original_type(obj));
  return type == nullptr || type->Begin == nullptr ? CO_ERR_NONE : type->Begin(&obj, &node, transfer, size);
}

CO_ERR end_original(CO_OBJ& obj, CO_NODE& node, CO_OBJ_TRANSFER transfer, Abort abort) {
  const CO_OBJ_TYPE_EX* const type = extended_type(original_type(obj));
  return type == nullptr || type->End == nullptr ? CO_ERR_NONE
                                                 : type->End(&obj, &node, transfer, static_cast<uint32_t>(abort));
}

// Upload and download -----------------------------------------------------------------------------------------------

// Reads a piece, through the extension of the object or its original type.
CO_ERR upload_piece(CO_OBJ& obj, CO_NODE& node, void* buffer, uint32_t size) {
  const OD_extension_t* const extension = extension_of(node, obj);
  if (extension == nullptr) {
    return access_original(obj, node, buffer, size, CO_OBJ_UPLOAD);
  }
  OD_TRANSFER* const transfer = find_access(*node.Ext->Od, node, obj);
  const ODR_t result = transfer == nullptr
                           ? ODR_DATA_DEV_STATE
                           : read(obj, node, *extension, *transfer, static_cast<uint8_t*>(buffer), size);
  return set_abort_code(obj, node, result, CO_OBJ_UPLOAD);
}

// Writes a piece, through the extension of the object or its original type.
CO_ERR download_piece(CO_OBJ& obj, CO_NODE& node, void* buffer, uint32_t size) {
  const OD_extension_t* const extension = extension_of(node, obj);
  if (extension == nullptr) {
    return access_original(obj, node, buffer, size, CO_OBJ_DOWNLOAD);
  }
  OD_TRANSFER* const transfer = find_access(*node.Ext->Od, node, obj);
  const ODR_t result = transfer == nullptr
                           ? ODR_DATA_DEV_STATE
                           : write(obj, node, *extension, *transfer, static_cast<const uint8_t*>(buffer), size);
  return set_abort_code(obj, node, result, CO_OBJ_DOWNLOAD);
}

// Calls a function for a transfer. If its object has got another extension, before or during the call, refuses the
// transfer (ODR_DATA_DEV_STATE).
template <class Function>
CO_ERR unless_extension_changed(CO_OBJ& obj, CO_NODE& node, CO_OBJ_TRANSFER transfer, Function function) {
  const CO_ERR err = is_extension_changed(node, obj) ? CO_ERR_NONE : function();
  return is_extension_changed(node, obj) ? set_abort_code(obj, node, ODR_DATA_DEV_STATE, transfer) : err;
}

}  // namespace
}  // namespace co::od

extern "C" {

// Returns the size of an extensible stream. width: bytes of a download, 0 for an upload.
uint32_t ODStreamSize(CO_OBJ_T* obj, CO_NODE_T* node, uint32_t width) {
  const OD_extension_t* const extension = co::od::extension_of(*node, *obj);
  const bool is_original = extension == nullptr || extension->read == OD_readOriginal;
  return width != 0 || is_original ? co::od::size_of_original(*obj, *node, width) : co::od::size_to_read(*obj, *node);
}

CO_ERR ODStreamRead(CO_OBJ_T* obj, CO_NODE_T* node, void* buffer, uint32_t size) {
  return co::od::unless_extension_changed(*obj, *node, CO_OBJ_UPLOAD,
                                          [=] { return co::od::upload_piece(*obj, *node, buffer, size); });
}

CO_ERR ODStreamWrite(CO_OBJ_T* obj, CO_NODE_T* node, void* buffer, uint32_t size) {
  return co::od::unless_extension_changed(*obj, *node, CO_OBJ_DOWNLOAD,
                                          [=] { return co::od::download_piece(*obj, *node, buffer, size); });
}

CO_ERR ODStreamReset(CO_OBJ_T* obj, CO_NODE_T* node, uint32_t position) {
  return co::od::unless_extension_changed(*obj, *node, CO_OBJ_UPLOAD, [=] {
    const OD_extension_t* const extension = co::od::extension_of(*node, *obj);
    return extension == nullptr ? co::od::set_original_position(*obj, *node, position)
                                : co::od::set_position(*obj, *node, *extension, position);
  });
}

CO_ERR ODStreamBegin(CO_OBJ_T* obj, CO_NODE_T* node, CO_OBJ_TRANSFER transfer, uint32_t size) {
  OD_t* const od = co::port::od_of(*node);
  OD_TRANSFER* const od_transfer = od == nullptr ? nullptr : co::od::begin_transfer(*od, *node, *obj, size);
  if (od == nullptr || od_transfer == nullptr) {
    return od == nullptr ? co::od::begin_original(*obj, *node, transfer, size) : CO_ERR_OBJ_STATE;
  }
  set(*od_transfer, co::od::in_application);
  const CO_ERR err = co::od::begin_original(*obj, *node, transfer, size);
  clear(*od_transfer, co::od::in_application);
  if (err != CO_ERR_NONE) {
    co::od::end_transfer(*od_transfer);
  }
  return err;
}

// Ends a transfer for the extension, then for the original type. If the end fails for the extension, the original type
// gets its abort code.
CO_ERR ODStreamEnd(CO_OBJ_T* obj, CO_NODE_T* node, CO_OBJ_TRANSFER transfer, uint32_t abort) {
  const co::Abort code{abort};
  OD_t* const od = co::port::od_of(*node);
  OD_TRANSFER* const od_transfer = od == nullptr ? nullptr : co::od::first_transfer(*od, *obj);
  if (od_transfer == nullptr) {
    return co::od::end_original(*obj, *node, transfer, code);
  }
  CO_ERR err = CO_ERR_NONE;
  if (code == co::Abort::none) {
    err = co::od::unless_extension_changed(*obj, *node, transfer, [=] {
      return transfer == CO_OBJ_DOWNLOAD ? co::od::finish_download(*obj, *node, *od_transfer) : CO_ERR_NONE;
    });
  }
  set(*od_transfer, co::od::in_application);
  const CO_ERR end =
      co::od::end_original(*obj, *node, transfer, err == CO_ERR_NONE ? code : co::access::abort_for(*node, err));
  co::od::end_transfer(*od_transfer);
  return err != CO_ERR_NONE ? err : end;
}

}  // extern "C"

#endif
