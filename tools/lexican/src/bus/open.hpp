// SPDX-License-Identifier: Apache-2.0
/// \file open.hpp
/// Opens a bus by its name, the same in each verb (-i BUS).
#pragma once

#include "bus/bus.hpp"

namespace lexican::host_bus {

/// A kind of bus.
struct BusKind {
  const char* prefix;   ///< that a name begins with, such as "hub:"
  const char* example;  ///< a complete name
  const char* about;    ///< a line for --help
  bool has_rate;        ///< an adapter, whose name can end with @RATE
  /// \a name: behind the prefix. Returns null, with the reason in \a why, if it cannot be opened.
  std::unique_ptr<Bus> (*open)(const std::string& name, const BusOptions& options, std::string& why);
  /// Returns true if open() fails because of the name or \a options, not because of the bus. Null: never.
  bool (*is_wrong)(const std::string& name, const BusOptions& options);
  /// How the bit rate is set of a kind for which BusOptions::bit_rate does not set it; null: it does, or the kind has
  /// none.
  const char* rate_setting = nullptr;
};

/// The kinds. The last one has an empty prefix.
extern const std::vector<BusKind> bus_kinds;

/// Opens a bus. It does not send if \a options says so, also where the adapter cannot listen only.
/// \retval null  \a why says why, and the remedy
std::unique_ptr<Bus> open_bus(const std::string& name, const BusOptions& options, std::string& why);

/// Returns true if the bus is an adapter whose bit rate neither its name nor \a options has.
bool needs_rate(const std::string& name, const BusOptions& options);

/// Returns the fault of a bit rate that the user gives beside a name: the name has another one, or, unless
/// \a options listens only, the rate of the bus is set in another way. Empty: there is none.
std::string rate_fault(const std::string& name, const BusOptions& options);

/// Returns true if open_bus() fails because of the name or \a options, not because of the bus: an unknown kind, a
/// name that the kind does not have, a bit rate that the kind or the interface does not have, or a log that cannot be
/// read.
bool is_wrong_name(const std::string& name, const BusOptions& options);

/// Separates the rate from NAME@RATE. A rate in \a options has precedence.
/// \retval false  it is not a rate; \a why says so
bool split_rate(std::string& name, BusOptions& options, std::string& why);

/// Opens an interface of Linux, such as can0.
/// \retval null  \a why says why
std::unique_ptr<Bus> open_socketcan(const std::string& name, const BusOptions& options, std::string& why);

/// Opens a log (log.hpp) as a bus on which frames cannot be sent; "-": standard input. receive() returns the entries as
/// fast as they are requested, with the times of the log. At the end the bus is lost: fault() is "the log has ended",
/// or the error that ended reading. \retval null  \a why says why
std::unique_ptr<Bus> open_replay(const std::string& file, const BusOptions& options, std::string& why);

/// Connects to a server with the protocol of socketcand: "HOST:PORT/BUS", such as "[::1]:29536/can0". Waits at most 2
/// s, like restore(), beyond the lookup of the host. The protocol does not say whether the bus is simulated: it is
/// regarded as physical. send() discards remote frames, and counts them in lost(), as servers before sendrtr do not
/// know them; lost() also counts frames of the server that are malformed. An error message of the server ends the
/// connection. \retval null  \a why says why
std::unique_ptr<Bus> connect_to_socketcand(const std::string& name, const BusOptions& options, std::string& why);

/// Returns true if a name is not HOST:PORT/BUS.
bool has_wrong_socketcand_name(const std::string& name, const BusOptions& options);

/// Opens a serial device or a Unix socket with an slcan adapter, DEV[@RATE]. Sends C, S0 to S8 (if there is a rate),
/// and O or L. \retval null  \a why says why
std::unique_ptr<Bus> open_slcan(const std::string& name, const BusOptions& options, std::string& why);

/// Returns true if the bit rate of a name or of \a options is none, or slcan does not have it.
bool has_wrong_slcan_rate(const std::string& name, const BusOptions& options);

/// Opens an slcan adapter behind TCP, HOST:PORT[@RATE], and sends the same commands. Waits at most two seconds for the
/// connection, and for the lookup of the name, which is not repeated by Bus::restore().
/// \retval null  \a why says why
std::unique_ptr<Bus> open_slcan_tcp(const std::string& name, const BusOptions& options, std::string& why);

/// Creates a pseudo-terminal that another program opens as its slcan adapter. Bus::note() returns its path. Frames are
/// discarded until this program has sent O or L; Bus::bit_rate() is that of its command S0 to S8, else that of
/// \a options. It cannot send after L, like at an adapter.
/// \retval null  \a why says why
std::unique_ptr<Bus> open_slcan_pty(const std::string& name, const BusOptions& options, std::string& why);

/// Serves a program that has connected to a socket, as slcan-pty serves the one that opens it. Owns \a client, a
/// descriptor that does not block. The bus is lost with the connection.
std::unique_ptr<Bus> serve_slcan(int client, std::uint32_t bit_rate);

}  // namespace lexican::host_bus
