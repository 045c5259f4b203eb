// SPDX-License-Identifier: Apache-2.0
/// \file co_os.h
/// Command line of a device over CANopen: OS command (1023h) with its mode (1024h), debugger interface (1025h), and OS
/// prompt (1026h). [CiA 301, 7.5.2.26 to 7.5.2.29] The stack transports the bytes and keeps order and state; the
/// application executes the commands.
///
/// OS command and debugger: a CO_OS_COMMAND each, Data of all entries of 1023h and 1024h, or of 1025h.
/// - Sub-index 1, CO_TOS_COMMAND, OCTET_STRING: a download is a command; an upload returns the command that was written
///   last. A command that arrives completely is executed, or stored if 1024h is 1; a download that is aborted has no
///   effect, except that an upload returns 0 bytes if the memory had no space for it beside the last command. Refused
///   are a command that does not fit (0607 0012h) and each command while one is executed (0800 0022h).
/// - Sub-index 2, CO_TOS_STATUS, UNSIGNED8: CO_OS_STATUS_…
/// - Sub-index 3, CO_TOS_REPLY, OCTET_STRING: the reply; 0800 0024h without a reply, 0800 0022h during execution.
/// - 1024h, CO_TOS_MODE, UNSIGNED8, write-only: CO_OS_MODE_…; other values are refused (0609 0030h).
///
///     static uint8_t Command[64], Reply[256];
///     static CO_OS_COMMAND Os = CO_OS_COMMAND_OF(Command, Reply, execute, abort);
///     {CO_KEY(0x1023, 1, CO_OBJ_____RW), CO_TOS_COMMAND, (CO_DATA)(&Os)},
///     {CO_KEY(0x1023, 2, CO_OBJ_____R_), CO_TOS_STATUS, (CO_DATA)(&Os)},
///     {CO_KEY(0x1023, 3, CO_OBJ_____R_), CO_TOS_REPLY, (CO_DATA)(&Os)},
///     {CO_KEY(0x1024, 0, CO_OBJ______W), CO_TOS_MODE, (CO_DATA)(&Os)},
///
/// Prompt: a CO_OS_PROMPT, Data of all entries of 1026h. Each access transports one character.
/// - Sub-index 1, CO_TOS_STDIN, write-only: a write by SDO or RPDO calls CO_OS_PROMPT.Input.
/// - Sub-indices 2 and 3, CO_TOS_STDOUT, StdOut and StdErr: an SDO upload takes the next character of COOsPrint();
///   without one it is aborted with 0800 0024h. A TPDO that maps an entry transmits one character each time, or 0 if
///   there is none. Characters trigger event-driven TPDOs: one each millisecond, or in each inhibit time (1800h:3).
///   Characters that wait for Operational or for the bus stay in the ring, until their frame was given to the driver.
///
/// CONodeInit() and NMT resets abort a command that is executed, and empty all buffers. Context: the loop; with
/// USE_REAL_TIME also the thread that receives or transmits a PDO that maps 1026h.
#ifndef CO_OS_H_
#define CO_OS_H_

#include "co_obj.h"
#include "co_tmr.h"
#include "co_types.h"
#include "lexican/detail/needs.h"

#ifdef __cplusplus
extern "C" {
#endif

/// \name Status of 1023h:2 and 1025h:2
/// \{
enum {
  CO_OS_STATUS_DONE = 0x00,          ///< last command completed without error, no reply
  CO_OS_STATUS_REPLY = 0x01,         ///< last command completed without error, there is a reply
  CO_OS_STATUS_FAILED = 0x02,        ///< last command completed with an error, no reply
  CO_OS_STATUS_FAILED_REPLY = 0x03,  ///< last command completed with an error, there is a reply
  CO_OS_STATUS_EXECUTING = 0xFF,     ///< a command is executed
};
/// \}

/// \name Values of 1024h
/// \{
enum {
  CO_OS_MODE_IMMEDIATE = 0,  ///< the next commands are executed immediately; the default
  CO_OS_MODE_BUFFERED = 1,   ///< the next commands are stored; the status does not change
  /// Executes the stored commands in their order, then removes them. The first one that fails ends the execution.
  /// Refused while a command is executed (0800 0022h). The mode for the next commands does not change.
  CO_OS_MODE_EXECUTE = 2,
  CO_OS_MODE_ABORT = 3,  ///< aborts the command that is executed, and removes the stored ones
};
/// \}

struct CO_OS_COMMAND_T;

/// Executes a command, of \a length bytes, 0 included. It must return soon. COOsReply() adds to the reply; COOsEnd()
/// ends the command, in this call or later. \a command is valid until then. \a user: CO_NODE_EXT.User.
typedef void (*CO_OS_EXECUTE_FUNC)(struct CO_NODE_T* node, void* user, struct CO_OS_COMMAND_T* os,
                                   const uint8_t* command, uint16_t length);
/// Aborts the command that is executed: its execution must have ended when the function returns, without COOsEnd().
typedef void (*CO_OS_ABORT_FUNC)(struct CO_NODE_T* node, void* user, struct CO_OS_COMMAND_T* os);

/// OS command or debugger interface. The application sets the members up to Abort; the others are 0 at first and must
/// not be accessed. It is in RAM and must live as long as the node.
typedef struct CO_OS_COMMAND_T {
  uint8_t* Command;            ///< memory of the commands; each stored command takes two bytes more than its length
  uint16_t CommandSize;        ///< bytes at Command
  uint8_t* Reply;              ///< memory of the reply
  uint16_t ReplySize;          ///< bytes at Reply
  CO_OS_EXECUTE_FUNC Execute;  ///< executes a command; null: every command fails
  CO_OS_ABORT_FUNC Abort;      ///< aborts a command; may be null
  uint32_t CommandOffset;      ///< position of the next access to the command
  uint32_t ReplyOffset;        ///< position of the next access to the reply
  uint16_t Used;               ///< bytes of complete commands, with their lengths
  uint16_t Base;               ///< value of Used when the execution has ended
  uint16_t Next;               ///< position of the next command to be executed
  uint16_t Begin;              ///< position of the command that is being written; FFFFh: none
  uint16_t Written;            ///< its bytes
  uint16_t Last;               ///< position of the command that was written last
  uint16_t LastLength;         ///< its bytes
  uint16_t ReplyLength;        ///< bytes of the reply
  uint8_t Status;              ///< CO_OS_STATUS_…
  uint8_t Mode;                ///< CO_OS_MODE_IMMEDIATE or CO_OS_MODE_BUFFERED
  uint8_t Phase;               ///< whether Execute is being called, or a command is executed
  uint8_t Failed;              ///< a command has failed
} CO_OS_COMMAND;

/// Initialises a CO_OS_COMMAND. \a command, \a reply: arrays of uint8_t; \a execute, \a abort: functions, see there.
#define CO_OS_COMMAND_OF(command, reply, execute, abort) \
  { (command), sizeof(command), (reply), sizeof(reply), (execute), (abort), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 }

/// Adds \a length bytes at \a bytes to the reply of the command that is executed: all or none.
/// \retval CO_ERR_NONE       the bytes were added
/// \retval CO_ERR_BAD_ARG    an argument is null
/// \retval CO_ERR_OBJ_STATE  no command is executed
/// \retval CO_ERR_OBJ_SIZE   CO_OS_COMMAND.ReplySize is too small
CO_ERR COOsReply(CO_OS_COMMAND* os, const uint8_t* bytes, uint16_t length) CO_NEEDS(USE_OBJ_EX);

/// Ends the command that is executed; \a failed: it has failed. Then executes the next stored command, if there is one.
/// \retval CO_ERR_NONE       the command has ended
/// \retval CO_ERR_BAD_ARG    an argument is null
/// \retval CO_ERR_OBJ_STATE  no command is executed
CO_ERR COOsEnd(struct CO_NODE_T* node, CO_OS_COMMAND* os, bool failed) CO_NEEDS(USE_OBJ_EX);

/// Output of the prompt: a ring of characters. The application sets the first two members; the others are 0 at first
/// and must not be accessed.
typedef struct CO_OS_OUTPUT_T {
  uint8_t* Start;          ///< memory of the characters
  uint16_t Size;           ///< bytes at Start
  uint16_t First;          ///< position of the oldest character
  uint16_t Num;            ///< number of characters
  uint8_t Taken;           ///< whether a TPDO has read the oldest one
  struct CO_NODE_T* Node;  ///< owner
  uint32_t Key;            ///< key of the entry
  CO_TMR_MEM Tmr;          ///< time until the next character triggers TPDOs
} CO_OS_OUTPUT;

/// OS prompt, in RAM. It must live as long as the node.
typedef struct CO_OS_PROMPT_T {
  /// Called for each character of StdIn; null: writes are refused (0800 0020h). \a user: CO_NODE_EXT.User.
  void (*Input)(struct CO_NODE_T* node, void* user, uint8_t character);
  CO_OS_OUTPUT Out;  ///< StdOut, sub-index 2
  CO_OS_OUTPUT Err;  ///< StdErr, sub-index 3
} CO_OS_PROMPT;

/// Initialises a CO_OS_PROMPT. \a input: a function, or null; \a out, \a err: arrays of uint8_t.
#define CO_OS_PROMPT_OF(input, out, err) \
  { (input), CO_OS_OUTPUT_OF(out), CO_OS_OUTPUT_OF(err) }
/// Initialises a CO_OS_OUTPUT. \a memory: array of uint8_t.
#define CO_OS_OUTPUT_OF(memory)                                         \
  {                                                                     \
    (memory), sizeof(memory), 0, 0, 0, 0, 0, { 0, 0, 0, 0, 0, 0, 0, 0 } \
  }

/// Appends \a length characters at \a text to an output of 1026h, all or none, and triggers the event-driven TPDOs that
/// map it. \a sub: 2 is StdOut, 3 is StdErr.
/// \retval CO_ERR_NONE           the characters were appended
/// \retval CO_ERR_BAD_ARG        an argument is null, \a node was never initialised, or \a sub is another number
/// \retval CO_ERR_OBJ_NOT_FOUND  there is no such entry of CO_TOS_STDOUT with Data
/// \retval CO_ERR_OBJ_SIZE       the ring has not enough space; try again when the network has read characters
CO_ERR COOsPrint(struct CO_NODE_T* node, uint8_t sub, const uint8_t* text, uint16_t length);

extern const CO_OBJ_TYPE_EX COTOsCommand CO_NEEDS(USE_OBJ_EX);  ///< functions of CO_TOS_COMMAND
extern const CO_OBJ_TYPE COTOsStatus CO_NEEDS(USE_OBJ_EX);      ///< functions of CO_TOS_STATUS
extern const CO_OBJ_TYPE_EX COTOsReply CO_NEEDS(USE_OBJ_EX);    ///< functions of CO_TOS_REPLY
extern const CO_OBJ_TYPE COTOsMode CO_NEEDS(USE_OBJ_EX);        ///< functions of CO_TOS_MODE
extern const CO_OBJ_TYPE COTOsStdin;                            ///< functions of CO_TOS_STDIN
extern const CO_OBJ_TYPE COTOsStdout;                           ///< functions of CO_TOS_STDOUT

#define CO_TOS_COMMAND ((const CO_OBJ_TYPE*)&COTOsCommand.Type)  ///< type of 1023h:1 and 1025h:1; Data: a CO_OS_COMMAND
#define CO_TOS_STATUS ((const CO_OBJ_TYPE*)&COTOsStatus)         ///< type of 1023h:2 and 1025h:2; Data: a CO_OS_COMMAND
#define CO_TOS_REPLY ((const CO_OBJ_TYPE*)&COTOsReply.Type)      ///< type of 1023h:3 and 1025h:3; Data: a CO_OS_COMMAND
#define CO_TOS_MODE ((const CO_OBJ_TYPE*)&COTOsMode)             ///< type of 1024h; Data: the CO_OS_COMMAND of 1023h
#define CO_TOS_STDIN ((const CO_OBJ_TYPE*)&COTOsStdin)           ///< type of 1026h:1; Data: a CO_OS_PROMPT
#define CO_TOS_STDOUT ((const CO_OBJ_TYPE*)&COTOsStdout)         ///< type of 1026h:2 and 3; Data: a CO_OS_PROMPT

#ifdef __cplusplus
}
#endif

#endif
