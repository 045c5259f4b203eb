// SPDX-License-Identifier: Apache-2.0
/// \file socketcan.hpp
/// Driver for a CAN interface of Linux (SocketCAN), through a non-blocking raw socket.
///
///     co::SocketCan can;
///     if (!can.open("can0")) { report(can.error()); }            // no exception, the reason in words
///     ext.Can = &co::SocketCanDriver;  ext.CanCtx = &can;        // CO_NODE_EXT
///     pollfd wait{can.fd(), POLLIN, 0};                          // then CONodeProcess()
///
/// Bit rate. A socket cannot set it; an administrator can (ip link set can0 up type can bitrate 250000). Enable uses
/// the bit rate of the interface; a rate changed by LSS has to be set by other means.
///
/// Going on and off the bus. open() connects to the named interface, Enable connects to the interface of the last
/// open(), Close disconnects. Init, Enable and Reset discard frames received before. Frames that the kernel has
/// accepted for transmission cannot be cancelled.
///
/// Filters. The kernel passes exactly the identifiers that the node has set (all frames if there are more than 512);
/// before the node has set any, all frames. Frames sent through this socket are not received by it.
///
/// Errors. Read returns error frames of the controller (bus-off, controller problems, restarted) in the coding of
/// SocketCAN, which the Report function of the table decodes. Read reports an overflow of the kernel's receive queue
/// the same way; lost() counts the frames. Send returns 0 while the transmit queue of the interface is full. Any other
/// error is -1, with errno in code() and a text in error(): ENETDOWN while the interface is down (Read reports it once;
/// sending and receiving resume when it is up again), ENODEV when it has vanished (USB adapters). In this case the
/// socket is closed, fd() is -1, and every Read and Send tries to open the interface again: call fd() before each
/// poll(). While the interface is missing, Read returns 0 and Send -1.
///
/// Context: one thread. Owner: the caller; must outlive the node.
#ifndef CO_DRIVERS_SOCKETCAN_HPP_
#define CO_DRIVERS_SOCKETCAN_HPP_

#include <cstdint>
#include <string>
#include <vector>

#include "co_can_socketcan.h"
#include "socketcan_frame.hpp"

namespace co {

/// A CAN interface of Linux: the context of SocketCanDriver. Not copyable: it owns a socket.
class SocketCan {
 public:
  /// Constructs a closed interface.
  SocketCan() = default;
  /// Closes the interface. The node must not use it any more.
  ~SocketCan();
  SocketCan(const SocketCan&) = delete;
  SocketCan& operator=(const SocketCan&) = delete;

  /// Opens an interface, such as "can0", after closing the previous one. An interface that is down can be opened, see
  /// up().
  /// \retval true   the interface is open
  /// \retval false  it cannot be used; error() returns the reason
  bool open(const std::string& interface);
  /// Closes the socket. Read and Send do not open the interface again.
  void close();

  /// Returns true if the interface is open and up.
  bool up() const;
  /// Returns the file descriptor for poll() and epoll_wait(); -1: closed.
  int fd() const { return fd_; }
  /// Returns errno of the last error; 0: none since open().
  int code() const { return code_; }
  /// Returns the text of the last error; empty: none since open().
  const std::string& error() const { return error_; }
  /// Returns the number of frames lost since the construction because the kernel's receive queue was full.
  std::uint32_t lost() const { return lost_; }

  /// \name Functions of CO_IF_CAN_DRV_EX
  /// \{

  /// Discards the frames in the kernel's receive queue.
  void init();
  /// Opens the interface of the last open() if it is closed, otherwise discards received frames. If it cannot be opened
  /// now, Read and Send try again.
  void enable();
  /// Reads the next received frame or error frame.
  /// \retval sizeof(CO_IF_FRM)  \a frame holds it
  /// \retval 0                  there is none, or the interface is missing
  /// \retval -1                 receiving has failed, see error()
  std::int16_t read(CO_IF_FRM& frame);
  /// Passes a frame to the kernel.
  /// \retval sizeof(CO_IF_FRM)  the kernel has accepted the frame
  /// \retval 0                  the transmit queue of the interface is full
  /// \retval -1                 the interface is missing, or sending has failed, see error()
  std::int16_t send(const CO_IF_FRM& frame);
  /// Discards the frames in the kernel's receive queue; opens the interface again if it had vanished.
  void reset();
  /// Sets the identifiers that the kernel passes. \a ids: see CO_IF_CAN_DRV_EX.Filter. They are set again whenever the
  /// interface is opened.
  void filter(const std::uint32_t* ids, std::uint16_t num);
  /// \}

 private:
  bool open_socket();
  bool set_options();
  bool apply_filters();
  bool bind_to_interface();
  bool open_if_missing();
  void close_socket();
  void discard_received();
  long receive(can_frame& frame);
  void count_lost(std::uint32_t total);
  bool fail_opening(SocketCanStep step, int error);
  std::int16_t fail_transfer(const char* action, int error);

  std::string interface_;
  std::string error_;
  std::vector<can_filter> filters_;
  std::uint32_t lost_ = 0;
  std::uint32_t lost_on_socket_ = 0;  // counted by the kernel since the socket was created
  int code_ = 0;
  int fd_ = -1;
  bool on_bus_ = false;    // true between open() or Enable and Close
  bool filtered_ = false;  // filters_ holds what the node has set
  bool overrun_ = false;   // lost frames that are not yet reported
};

/// The driver; its context is a SocketCan.
inline constexpr const CO_IF_CAN_DRV_EX& SocketCanDriver = COSocketCanDriver;

}  // namespace co

#endif
