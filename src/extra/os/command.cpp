// SPDX-License-Identifier: Apache-2.0
// 1023h, OS command, 1024h, its mode, and 1025h, debugger interface. [301:7.5.2.26, 7.5.2.27, 7.5.2.28]
//
// CO_OS_COMMAND.Command contains records of a length (two bytes) and a command. The records up to Used are complete. A
// download is written behind them, so that an aborted download has no effect. An executed command is kept for uploads:
// a download is written behind it if there is space, otherwise over it. An execution is the run of the records from
// Next to Used: one command, or all stored ones.
#include "co_os.h"

#include "base/events.hpp"
#include "co_assert.h"
#include "co_core.h"
#include "dictionary/dict.hpp"
#include "dictionary/obj.hpp"
#include "dictionary/types/stream.hpp"
#include "wire/bytes.hpp"

#if USE_OBJ_EX

namespace co::os_command {
namespace {

constexpr uint16_t length_bytes = 2;
constexpr uint16_t no_download = UINT16_MAX;  // value of Begin

// Bits of CO_OS_COMMAND.Phase.
constexpr uint8_t busy = 1;      // a command is executed
constexpr uint8_t starting = 2;  // run() is calling Execute: run(), not COOsEnd(), starts the next command

bool is_executing(const CO_OS_COMMAND& os) { return os.Status == CO_OS_STATUS_EXECUTING; }

void set_phase(CO_OS_COMMAND& os, uint8_t phase) { os.Phase = phase; }

uint8_t* record_at(const CO_OS_COMMAND& os, uint32_t position) { return os.Command + position; }
uint16_t length_at(const CO_OS_COMMAND& os, uint32_t position) {
  const uint8_t* const record = record_at(os, position);
  return static_cast<uint16_t>(record[0] | (record[1] << 8U));
}

// Returns the maximum length of the next command.
uint32_t space(const CO_OS_COMMAND& os) {
  const uint32_t taken = uint32_t{os.Used} + length_bytes;
  return os.Command != nullptr && os.CommandSize > taken ? os.CommandSize - taken : 0;
}

// Execution -----------------------------------------------------------------------------------------------------------

// Ends the command that is executed.
void end_one(CO_OS_COMMAND& os, bool failed) {
  set_phase(os, static_cast<uint8_t>(os.Phase & ~busy));
  os.Failed = static_cast<uint8_t>(failed || os.Failed != 0 ? 1 : 0);
}

void start_next(CO_NODE& node, CO_OS_COMMAND& os) {
  const uint32_t position = os.Next;
  const uint16_t length = length_at(os, position);
  CO_ASSERT(position + length_bytes + length <= os.Used);
  os.Next = static_cast<uint16_t>(position + length_bytes + length);
  set_phase(os, busy | starting);
  if (os.Execute != nullptr) {
    os.Execute(&node, node.Ext->User, &os, record_at(os, position) + length_bytes, length);
  } else {
    end_one(os, true);
  }
  set_phase(os, static_cast<uint8_t>(os.Phase & ~starting));
}

// Sets the status at the end of an execution, and removes its commands.
void finish(CO_OS_COMMAND& os) {
  const unsigned result = os.Failed != 0 ? CO_OS_STATUS_FAILED : CO_OS_STATUS_DONE;
  os.Status = static_cast<uint8_t>(os.ReplyLength != 0 ? result | CO_OS_STATUS_REPLY : result);
  os.Used = os.Base;
}

// Executes commands until one does not end in its call, or one fails, or all are executed. A loop, because COOsEnd() in
// Execute would be a recursion.
void run(CO_NODE& node, CO_OS_COMMAND& os) {
  while (is_executing(os) && os.Failed == 0 && os.Next < os.Used) {
    start_next(node, os);
    if (os.Phase != 0) {
      return;
    }
  }
  if (is_executing(os)) {
    finish(os);
  }
}

// Begins the execution of the records from a position on. A download in progress cannot continue.
void execute_from(CO_NODE& node, CO_OS_COMMAND& os, uint16_t position) {
  os.Begin = no_download;
  os.Base = position;
  os.Next = position;
  os.Failed = 0;
  os.ReplyLength = 0;
  os.Status = CO_OS_STATUS_EXECUTING;
  run(node, os);
}

// Ends the execution and removes all commands.
void abort_all(CO_NODE& node, CO_OS_COMMAND& os) {
  os.Base = 0;
  os.Used = 0;
  os.Next = 0;
  os.Begin = no_download;
  if (!is_executing(os)) {
    return;
  }
  if (os.Abort != nullptr) {
    os.Abort(&node, node.Ext->User, &os);
  }
  set_phase(os, static_cast<uint8_t>(os.Phase & starting));
  os.Failed = 1;
  finish(os);
}

// Command -------------------------------------------------------------------------------------------------------------

// Aborts a command that is being executed when the node is reset. At power-on the structure is 0.
CO_ERR init_command(CO_OBJ* obj, CO_NODE* node) {
  const CO_ERR err = dict::check_type(*obj, *node, rules::os_command);
  auto* const os = data_of<CO_OS_COMMAND>(*obj);
  if (err != CO_ERR_NONE || os == nullptr) {
    return err;
  }
  abort_all(*node, *os);
  os->Mode = CO_OS_MODE_IMMEDIATE;
  os->Status = CO_OS_STATUS_DONE;
  os->Last = 0;
  os->LastLength = 0;
  os->ReplyLength = 0;
  return CO_ERR_NONE;
}

// Without Data, returns at most the length of an expedited download, so that begin_command() is called and refuses it.
uint32_t command_size(CO_OBJ* obj, CO_NODE*, uint32_t width) {
  constexpr uint32_t expedited = 4;
  const auto* const os = data_of<const CO_OS_COMMAND>(*obj);
  if (width == 0) {
    return os == nullptr ? 0 : os->LastLength;
  }
  const uint32_t longest = os == nullptr ? expedited : space(*os);
  return width < longest ? width : longest;
}

// Returns the position of a download: behind the complete records, and behind the last command if there is space.
uint16_t begin_of_download(const CO_OS_COMMAND& os) {
  const uint32_t kept = uint32_t{os.Last} + length_bytes + os.LastLength;
  const bool is_kept = os.Last >= os.Used && os.LastLength != 0 && kept + length_bytes < os.CommandSize;
  return is_kept ? static_cast<uint16_t>(kept) : os.Used;
}

// Clears the length of the last command if a download overwrites it.
void clear_overwritten_last(CO_OS_COMMAND& os) {
  if (os.Last >= os.Used) {
    os.LastLength = 0;
  }
}

// Moves the download to the end of the complete records: it is complete, or the space behind the last command is too
// small for it.
void move_to_records(CO_OS_COMMAND& os) {
  if (os.Begin != os.Used) {
    __builtin_memmove(record_at(os, os.Used) + length_bytes, record_at(os, os.Begin) + length_bytes, os.Written);
    os.Begin = os.Used;
    clear_overwritten_last(os);
  }
}

CO_ERR begin_command(CO_OBJ* obj, CO_NODE*, CO_OBJ_TRANSFER transfer, uint32_t) {
  auto* const os = data_of<CO_OS_COMMAND>(*obj);
  if (os == nullptr) {
    return transfer == CO_OBJ_UPLOAD ? CO_ERR_TYPE_RD : CO_ERR_TYPE_WR;
  }
  if (transfer == CO_OBJ_UPLOAD) {
    return CO_ERR_NONE;
  }
  if (is_executing(*os)) {
    return CO_ERR_OBJ_STATE;
  }
  os->Begin = begin_of_download(*os);
  os->Written = 0;
  return CO_ERR_NONE;
}

CO_ERR reset_command(CO_OBJ* obj, CO_NODE*, uint32_t position) {
  auto* const os = data_of<CO_OS_COMMAND>(*obj);
  if (os == nullptr) {
    return CO_ERR_TYPE_RESET;
  }
  os->CommandOffset = position;
  return CO_ERR_NONE;
}

CO_ERR read_command(CO_OBJ* obj, CO_NODE*, void* buffer, uint32_t length) {
  auto* const os = data_of<CO_OS_COMMAND>(*obj);
  if (os == nullptr || os->Command == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  const uint32_t n = stream::clip(length, os->CommandOffset, os->LastLength);
  wire::copy(static_cast<uint8_t*>(buffer), record_at(*os, os->Last) + length_bytes + os->CommandOffset, n);
  os->CommandOffset += n;
  return CO_ERR_NONE;
}

// Returns whether the download can continue. Since it began, a write to 1024h may have started an execution, or
// removed the records before it.
bool is_downloading(const CO_OS_COMMAND& os) { return os.Begin != no_download; }

CO_ERR write_command(CO_OBJ* obj, CO_NODE*, void* buffer, uint32_t length) {
  auto* const os = data_of<CO_OS_COMMAND>(*obj);
  if (os == nullptr || os->Command == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  if (!is_downloading(*os)) {
    return CO_ERR_OBJ_STATE;
  }
  const uint32_t n = stream::clip(length, os->CommandOffset, space(*os));
  if (n != length) {
    return CO_ERR_OBJ_SIZE;
  }
  if (uint32_t{os->Begin} + length_bytes + os->CommandOffset + n > os->CommandSize) {
    move_to_records(*os);
  }
  if (os->Begin == os->Used) {
    clear_overwritten_last(*os);
  }
  wire::copy(record_at(*os, os->Begin) + length_bytes + os->CommandOffset, static_cast<const uint8_t*>(buffer), n);
  os->CommandOffset += n;
  os->Written = static_cast<uint16_t>(os->CommandOffset);
  return CO_ERR_NONE;
}

// Completes the record behind the others, and executes it.
void accept(CO_NODE& node, CO_OS_COMMAND& os) {
  move_to_records(os);
  const uint16_t position = os.Used;
  const uint16_t length = os.Written;
  uint8_t* const record = record_at(os, position);
  record[0] = static_cast<uint8_t>(length);
  record[1] = static_cast<uint8_t>(length >> 8U);
  os.Last = position;
  os.LastLength = length;
  os.Used = static_cast<uint16_t>(position + length_bytes + length);
  os.Begin = no_download;
  if (os.Mode == CO_OS_MODE_IMMEDIATE) {
    execute_from(node, os, position);
  }
}

CO_ERR end_command(CO_OBJ* obj, CO_NODE* node, CO_OBJ_TRANSFER transfer, uint32_t abort) {
  auto* const os = data_of<CO_OS_COMMAND>(*obj);
  if (os == nullptr || transfer == CO_OBJ_UPLOAD || abort != 0) {
    return CO_ERR_NONE;
  }
  if (!is_downloading(*os)) {
    return CO_ERR_OBJ_STATE;
  }
  if (os->Command == nullptr || os->CommandSize - os->Used < length_bytes) {
    return CO_ERR_OBJ_SIZE;
  }
  accept(*node, *os);
  return CO_ERR_NONE;
}

// Status and reply ----------------------------------------------------------------------------------------------------

uint32_t byte_size(CO_OBJ* obj, CO_NODE*, uint32_t) { return uintptr_t{obj->Data} == 0 ? 0 : 1; }

CO_ERR read_status(CO_OBJ* obj, CO_NODE*, void* buffer, uint32_t length) {
  const auto* const os = data_of<const CO_OS_COMMAND>(*obj);
  if (os == nullptr || length != 1) {
    return CO_ERR_BAD_ARG;
  }
  *static_cast<uint8_t*>(buffer) = os->Status;
  return CO_ERR_NONE;
}

uint32_t reply_size(CO_OBJ* obj, CO_NODE*, uint32_t) {
  const auto* const os = data_of<const CO_OS_COMMAND>(*obj);
  return os == nullptr ? 0 : os->ReplyLength;
}

CO_ERR begin_reply(CO_OBJ* obj, CO_NODE*, CO_OBJ_TRANSFER, uint32_t) {
  const auto* const os = data_of<const CO_OS_COMMAND>(*obj);
  if (os == nullptr) {
    return CO_ERR_TYPE_RD;
  }
  if (is_executing(*os)) {
    return CO_ERR_OBJ_STATE;
  }
  return os->ReplyLength == 0 ? CO_ERR_OBJ_NO_DATA : CO_ERR_NONE;
}

CO_ERR reset_reply(CO_OBJ* obj, CO_NODE*, uint32_t position) {
  auto* const os = data_of<CO_OS_COMMAND>(*obj);
  if (os == nullptr) {
    return CO_ERR_TYPE_RESET;
  }
  os->ReplyOffset = position;
  return CO_ERR_NONE;
}

// Reads a piece of the reply. Refuses it if another command has replaced the reply since the upload began.
CO_ERR read_reply(CO_OBJ* obj, CO_NODE*, void* buffer, uint32_t length) {
  auto* const os = data_of<CO_OS_COMMAND>(*obj);
  if (os == nullptr || os->Reply == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  if (is_executing(*os) || stream::clip(length, os->ReplyOffset, os->ReplyLength) != length) {
    return CO_ERR_OBJ_STATE;
  }
  wire::copy(static_cast<uint8_t*>(buffer), os->Reply + os->ReplyOffset, length);
  os->ReplyOffset += length;
  return CO_ERR_NONE;
}

// Mode ----------------------------------------------------------------------------------------------------------------

CO_ERR execute_stored(CO_NODE& node, CO_OS_COMMAND& os) {
  if (is_executing(os)) {
    return CO_ERR_OBJ_STATE;
  }
  execute_from(node, os, 0);
  return CO_ERR_NONE;
}

CO_ERR write_mode(CO_OBJ* obj, CO_NODE* node, void* buffer, uint32_t length) {
  auto* const os = data_of<CO_OS_COMMAND>(*obj);
  if (os == nullptr || length != 1) {
    return CO_ERR_BAD_ARG;
  }
  const uint8_t mode = *static_cast<const uint8_t*>(buffer);
  switch (mode) {
    case CO_OS_MODE_IMMEDIATE:
    case CO_OS_MODE_BUFFERED: os->Mode = mode; return CO_ERR_NONE;
    case CO_OS_MODE_EXECUTE: return execute_stored(*node, *os);
    case CO_OS_MODE_ABORT: abort_all(*node, *os); return CO_ERR_NONE;
    default: return CO_ERR_OBJ_RANGE;
  }
}

}  // namespace
}  // namespace co::os_command

extern "C" {

const CO_OBJ_TYPE_EX COTOsCommand = {{co::os_command::command_size, co::os_command::init_command,
                                      co::os_command::read_command, co::os_command::write_command, COObjTypeExReset},
                                     co::os_command::reset_command,
                                     co::os_command::begin_command,
                                     co::os_command::end_command};
const CO_OBJ_TYPE COTOsStatus = {co::os_command::byte_size, co::dict::checked_by<co::rules::os_status>,
                                 co::os_command::read_status, nullptr, nullptr};
const CO_OBJ_TYPE_EX COTOsReply = {{co::os_command::reply_size, co::dict::checked_by<co::rules::os_reply>,
                                    co::os_command::read_reply, nullptr, COObjTypeExReset},
                                   co::os_command::reset_reply,
                                   co::os_command::begin_reply,
                                   nullptr};
const CO_OBJ_TYPE COTOsMode = {co::os_command::byte_size, co::dict::checked_by<co::rules::os_mode>, nullptr,
                               co::os_command::write_mode, nullptr};

CO_ERR COOsReply(CO_OS_COMMAND* os, const uint8_t* bytes, uint16_t length) {
  if (os == nullptr || bytes == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  if ((os->Phase & co::os_command::busy) == 0) {
    return CO_ERR_OBJ_STATE;
  }
  if (os->Reply == nullptr || length > os->ReplySize - os->ReplyLength) {
    return CO_ERR_OBJ_SIZE;
  }
  co::wire::copy(os->Reply + os->ReplyLength, bytes, length);
  os->ReplyLength = static_cast<uint16_t>(os->ReplyLength + length);
  return CO_ERR_NONE;
}

CO_ERR COOsEnd(CO_NODE* node, CO_OS_COMMAND* os, bool failed) {
  if (node == nullptr || os == nullptr) {
    return CO_ERR_BAD_ARG;
  }
  if ((os->Phase & co::os_command::busy) == 0) {
    return CO_ERR_OBJ_STATE;
  }
  co::os_command::end_one(*os, failed);
  if (os->Phase == 0) {
    co::os_command::run(*node, *os);
    co::event::run_deferred(*node);
  }
  return CO_ERR_NONE;
}

}  // extern "C"

#endif
