// SPDX-License-Identifier: Apache-2.0
// Fuzzes SDO clients on an unreliable bus: frames are lost, duplicated, reordered, changed and invented, the controller
// refuses frames, requests are cancelled, the NMT state and the COB-IDs change. A model of each client predicts every
// frame and every callback. Loss, duplication and reordering alone never make a transfer with wrong data succeed.
// [301:7.2.4.3] [C1] [T11]
#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <iterator>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "co_core.h"
#include "fuzz/fuzz.hpp"
#include "fuzz/sdo_client_peer.hpp"

namespace {

using fuzz::Bytes;
using fuzz::dev_of;
using fuzz::Frames;
using fuzz::pattern;
using fuzz::Peer;
using fuzz::Request;
using fuzz::require;
using fuzz::SdoBytes;
using fuzz::SdoKey;
using fuzz::SdoObject;

constexpr std::uint8_t node_id = 5;
constexpr unsigned peers = 2;                               // clients of other nodes: 1280h and 1281h
constexpr unsigned own = 2;                                 // the client 1282h, whose server is this node
constexpr std::uint32_t times_out[] = {0, 20, 1000, 1000};  // ms; a tick is 1 ms
constexpr std::uint32_t patience = 1300;                    // ms, longer than any time-out plus a quarter
constexpr unsigned max_depth = 3;                           // nested calls of the stack
constexpr std::size_t largest = 1200;                       // bytes of a transfer

class Bench;
Bench* bench = nullptr;  // current instance, for the callbacks

SdoBytes bytes_of(const CO_IF_FRM& frame) {
  SdoBytes bytes{};
  std::copy(std::begin(frame.Data), std::end(frame.Data), bytes.begin());
  return bytes;
}

class Bench {
 public:
  explicit Bench(fuzz::Input input) : input_(input) {
    bench = this;
    const unsigned buffer = std::array<unsigned, 4>{127, 3, 0, 1}[input_.below(4)];
    peers_.emplace_back(buffer);
    peers_.emplace_back(127);
    ext_.Size = sizeof ext_;
    ext_.Can = &can;
    ext_.Timer = &timer;
    constexpr std::uint16_t entries = std::extent_v<decltype(table_)>;
    CO_NODE_SPEC spec{node_id, 250000, table_, entries, nullptr, nullptr, 0, 1000, nullptr, nullptr};
    CONodeInitEx(&node_, &spec, &ext_);
    require(CONodeGetErr(&node_) == CO_ERR_NONE, "the node starts");
    CONodeStart(&node_);
  }
  ~Bench() {
    CONodeStop(&node_);
    bench = nullptr;
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  void run() {
    while (!input_.is_empty()) {
      act(input_.byte());
      check();
    }
    come_to_rest();
    transfer_at_last();
  }

  // Processes a change of the NMT state: the new state may forbid queued frames, or a reset discard them.
  void change_mode(CO_MODE mode) {
    if (mode != CO_PREOP && mode != CO_OPERATIONAL) {
      for (Peer& peer : peers_) {
        peer.waiting.clear();
      }
    }
  }

 private:
  // Actions ------------------------------------------------------------

  void act(std::uint8_t kind) {
    Peer& peer = peers_[(kind >> 5) & 1U];
    switch (kind & 0x1FU) {
      case 0:
      case 1:
      case 2:
      case 3: begin(peer, input_.byte()); break;
      case 4: lose(peer.to_client); break;
      case 5: lose(peer.to_server); break;
      case 6: repeat(peer.to_client); break;
      case 7: repeat(peer.to_server); break;
      case 8: swap(peer.to_client); break;
      case 9: change(peer); break;
      case 10: make_up(peer, true); break;
      case 11: make_up(peer, false); break;
      case 12: deliver_odd_frame(peer); break;
      case 13: remind(peer); break;
      case 14: pass(input_.byte()); break;
      case 15: pass(4U * input_.byte()); break;
      case 16: cancel(peer); break;
      case 17: command_nmt(input_.byte()); break;
      case 18: set_mode(input_.byte()); break;
      case 19: refuses_ = true; break;
      case 20: accept(); break;
      case 21: begin_own(input_.byte()); break;
      case 22: configure(peer); break;
      case 23: abort_by_server(peer); break;
      case 24:
      case 25: carry(peer, 1); break;
      case 26: carry(peer, input_.byte()); break;
      default: carry(peer, 8); break;
    }
  }

  // Called from callbacks: may execute an action on the node.
  void meddle() {
    const std::uint8_t byte = input_.byte();
    if ((byte & 0x80U) == 0 || depth_ == max_depth) {
      return;
    }
    ++depth_;
    fuzz::given.alone = false;
    Peer& peer = peers_[byte & 1U];
    switch ((byte >> 1) & 7U) {
      case 0: cancel(peer); break;
      case 1: set_mode(input_.byte()); break;
      case 2: begin_own(input_.byte()); break;
      case 3: configure(peer); break;
      default: begin(peer, input_.byte()); break;
    }
    --depth_;
  }

  bool is_allowed() const { return node_.Nmt.Mode == CO_PREOP || node_.Nmt.Mode == CO_OPERATIONAL; }
  unsigned number_of(const Peer& peer) const { return static_cast<unsigned>(&peer - peers_.data()); }
  CO_CSDO* client_of(const Peer& peer) { return &node_.CSdo[number_of(peer)]; }

  // Requests ---------------------------------------------------------------

  static SdoKey key_of(const SdoObject& object) {
    return {static_cast<std::uint8_t>(object.index), static_cast<std::uint8_t>(object.index >> 8), object.sub};
  }

  void begin(Peer& peer, std::uint8_t kind) {
    const SdoObject& object = peer.server.objects()[kind % peer.server.objects().size()];
    Request request = make_request((kind & 0x80U) != 0, object.capacity, (kind & 0x40U) != 0);
    request.key = key_of(object);
    request.key[2] = (kind & 0x30U) == 0x30U ? std::uint8_t{0x77} : request.key[2];  // a sub-index that does not exist
    const bool starts = is_allowed() && peer.is_configured && !peer.request.is_open;
    const std::size_t size = size_;
    if (!starts) {
      expect_refusal(peer, request, size);
      return;
    }
    peer.is_tampered =
        !peer.waiting.empty() || !peer.to_client.empty() || !peer.to_server.empty() || peer.server.is_open();
    peer.waiting.push_back(request.is_upload ? peer.model.start_upload(request.key, size)
                                             : peer.model.start_download(request.key, request.data));
    peer.request = std::move(request);
    peer.request.is_open = true;
    const CO_ERR err = call(client_of(peer), peer.request, size);
    if (err != CO_ERR_NONE) {
      require(err == CO_ERR_IF_CAN_SEND && refuses_, "a request is started");
      peer.waiting.pop_back();
      peer.model.close(0);
      peer.request.is_open = false;
    }
  }

  Request make_request(bool is_upload, std::uint32_t capacity, bool exact) {
    Request request;
    request.is_upload = is_upload;
    request.timeout = times_out[input_.below(std::size(times_out))];
    size_ = exact ? capacity : 1U + input_.byte();
    size_ += !exact && (size_ & 7U) == 7U ? largest - 256 : 0;
    request.buffer = std::make_unique<std::uint8_t[]>(size_);
    if (!is_upload) {
      request.data = pattern(size_, input_.byte());
      std::copy(request.data.begin(), request.data.end(), request.buffer.get());
    }
    return request;
  }

  static CO_ERR call(CO_CSDO* client, const Request& request, std::size_t size) {
    const auto start = request.is_upload ? COCSdoRequestUpload : COCSdoRequestDownload;
    return start(client, dev_of(request.key), request.buffer.get(), static_cast<std::uint32_t>(size), on_end,
                 request.timeout);
  }

  void expect_refusal(Peer& peer, const Request& request, std::size_t size) {
    const CO_ERR err = call(client_of(peer), request, size);
    require(err == (peer.request.is_open ? CO_ERR_SDO_BUSY : CO_ERR_SDO_OFF), "a request is refused");
  }

  void cancel(Peer& peer) {
    const bool was_open = peer.request.is_open;
    const unsigned before = callbacks_;
    const Peer* const outer = std::exchange(cancelled_, &peer);
    const CO_ERR err = COCSdoCancel(client_of(peer));
    cancelled_ = outer;
    require(err == (was_open ? CO_ERR_NONE : CO_ERR_SDO_OFF), "what is open can be cancelled");
    require(!was_open || callbacks_ > before, "the callback comes before COCSdoCancel() returns");
  }

  // Toggles bit 31 of 1280h:1; the CAN-IDs stay the same. [301:7.5.2.34] Within a callback the change takes effect
  // later. Does nothing while frames are queued: NMT stop does not find queued frames of an identifier that is no
  // longer valid.
  void configure(Peer& peer) {
    if (refuses_) {
      return;
    }
    peer.is_configured = !peer.is_configured;
    const std::uint32_t id = 0x606U + number_of(peer) + (peer.is_configured ? 0U : CO_SDO_ID_OFF);
    const CO_ERR err = CODictWrLong(&node_.Dict, CO_DEV(0x1280U + number_of(peer), 1), id);
    require(err == CO_ERR_NONE, "a client can be switched off and on");
  }

  // Callbacks ----------------------------------------------------------------

  static void on_end(CO_CSDO* csdo, std::uint16_t index, std::uint8_t sub, std::uint32_t code) {
    const auto number = static_cast<unsigned>(csdo - bench->node_.CSdo);
    ++bench->callbacks_;
    Request& request = number == own ? bench->own_ : bench->peers_[number].request;
    require(std::exchange(request.is_open, false), "a request has one callback");
    require(CO_DEV(index, sub) == dev_of(request.key), "a callback names the object");
    require(csdo->State == CO_CSDO_STATE_IDLE, "a client is ready for the next request in its callback");
    require(request.is_upload || request.keeps_data(), "the data of a download do not change");
    number == own ? bench->own_ended(code) : bench->ended(bench->peers_[number], code);
    request.buffer.reset();
    bench->meddle();
  }

  void ended(Peer& peer, std::uint32_t code) {
    if (peer.model.is_open()) {
      require(code == reason(peer), "a transfer ends by itself only for the reasons that are named");
      if (is_allowed()) {
        peer.waiting.push_back(peer.model.abort(code));
      }
      peer.model.close(code);
    }
    require(code == peer.model.end(), "a transfer ends as the standard says");
    if (code == 0) {
      check_data(peer);
    }
  }

  // Returns the abort code with which the client may end a transfer without an answer now; 0: it must not.
  std::uint32_t reason(const Peer& peer) const {
    if (cancelled_ == &peer) {
      return CO_SDO_ERR_TOS_LOCAL;
    }
    if (!is_allowed() || !peer.is_configured) {
      return CO_SDO_ERR_TOS_STATE;
    }
    return passes_ ? CO_SDO_ERR_TIMEOUT : 0;
  }

  void check_data(const Peer& peer) {
    const Request& request = peer.request;
    const Bytes& data = request.is_upload ? peer.model.data() : request.data;
    const std::uint32_t num = COCSdoGetNum(client_of(peer));
    require(num == data.size(), "the callback can ask how many bytes were transferred");
    require(std::equal(data.begin(), data.end(), request.buffer.get()), "the buffer has what the frames have carried");
    require(peer.is_tampered || peer.has_right_data(), "lost, doubled and reordered frames give no wrong data");
  }

  // The bus --------------------------------------------------------------------

  static void lose(Frames& queue) {
    if (!queue.empty()) {
      queue.pop_front();
    }
  }
  static void repeat(Frames& queue) {
    if (!queue.empty()) {
      queue.push_front(queue.front());
    }
  }
  static void swap(Frames& queue) {
    if (queue.size() > 1) {
      std::swap(queue[0], queue[1]);
    }
  }
  void change(Peer& peer) {
    if (!peer.to_client.empty()) {
      peer.to_client.front()[input_.below(8)] ^= static_cast<std::uint8_t>(1U << input_.below(8));
      peer.is_tampered = true;
    }
  }

  void make_up(Peer& peer, bool is_plausible) {
    constexpr std::uint8_t commands[] = {0x00, 0x10, 0x01, 0x1D, 0x20, 0x30, 0x60, 0x40, 0x41, 0x43, 0x4F, 0x42,
                                         0xC0, 0xC2, 0xC4, 0xC6, 0xC1, 0xD5, 0xA0, 0xA4, 0xA1, 0xA2, 0x80, 0x81};
    SdoBytes bytes{};
    std::generate(bytes.begin(), bytes.end(), [this] { return input_.byte(); });
    if (is_plausible) {
      bytes[0] = commands[bytes[0] % std::size(commands)];
      std::copy(peer.request.key.begin(), peer.request.key.end(), bytes.begin() + 1);
      std::fill(bytes.begin() + 5, bytes.end(), std::uint8_t{0});
    }
    peer.is_tampered = true;
    deliver(peer, bytes);
  }

  void abort_by_server(Peer& peer) {
    constexpr std::uint32_t codes[] = {CO_SDO_ERR_CMD, CO_SDO_ERR_GENERAL, CO_SDO_ERR_OBJ, 0};
    SdoBytes bytes = peer.model.abort(codes[input_.below(std::size(codes))]);
    bytes[1] ^= input_.below(4) == 0 ? std::uint8_t{1} : std::uint8_t{0};
    peer.is_tampered = true;
    deliver(peer, bytes);
  }

  // Passes an eighth of the server's time-out without a request.
  void remind(Peer& peer) {
    if (const auto said = peer.server.slice(); said) {
      peer.to_client.push_back(*said);
    }
  }

  // Receives a frame that is not a response: of another kind, or shorter than 8 bytes. DLC codes above 8 mean 8 bytes.
  // [ISO 11898-1]
  void deliver_odd_frame(Peer& peer) {
    const std::uint8_t kind = input_.byte();
    CO_IF_FRM frame{0x586U + number_of(peer), {0x80}, static_cast<std::uint8_t>(kind & 7U)};
    frame.Identifier |= (kind & 0x40U) != 0 ? CO_IF_FRM_RTR : 0U;
    frame.Identifier |= (kind & 0x80U) != 0 ? CO_IF_FRM_EXT : 0U;
    receive(frame);
  }

  // Delivers \a number frames, those to the server first.
  void carry(Peer& peer, unsigned number) {
    for (; number > 0 && !(peer.to_client.empty() && peer.to_server.empty()); --number) {
      if (!peer.to_server.empty()) {
        const SdoBytes request = peer.to_server.front();
        peer.to_server.pop_front();
        const std::vector<SdoBytes> answers = peer.server.answers(request);
        peer.to_client.insert(peer.to_client.end(), answers.begin(), answers.end());
      } else {
        const SdoBytes response = peer.to_client.front();
        peer.to_client.pop_front();
        deliver(peer, response);
      }
    }
  }

  void deliver(Peer& peer, const SdoBytes& response) {
    if (is_allowed() && peer.is_configured) {
      expect(peer, peer.model.answer(response));
    }
    CO_IF_FRM frame{0x586U + number_of(peer), {}, 8};
    std::copy(response.begin(), response.end(), frame.Data);
    receive(frame);
  }

  static void expect(Peer& peer, const std::optional<SdoBytes>& request) {
    if (request) {
      peer.waiting.push_back(*request);
    }
  }

  void receive(const CO_IF_FRM& frame) {
    received_ = frame;
    fuzz::given = {frame.Identifier, frame.DLC, frame.Data, true};
    fuzz::process(node_);
  }

  void accept() {
    refuses_ = false;
    fuzz::process(node_);
  }

  // NMT --------------------------------------------------------------------------

  void command_nmt(std::uint8_t kind) {
    constexpr std::uint8_t specifiers[] = {1, 2, 128, 129, 130, 2, 1, 128};
    receive({0, {specifiers[kind & 7U], node_id}, 2});
  }

  void set_mode(std::uint8_t kind) {
    constexpr CO_MODE modes[] = {CO_PREOP, CO_OPERATIONAL, CO_STOP};
    CONmtSetMode(&node_.Nmt, modes[kind % std::size(modes)]);
  }

  // The own dictionary -------------------------------------------------------------

  void begin_own(std::uint8_t kind) {
    constexpr SdoKey keys[] = {{0x00, 0x20, 0}, {0x01, 0x20, 0}, {0x02, 0x20, 0}};
    constexpr std::uint32_t sizes[] = {4, sizeof own_domain_, 1};
    const unsigned object = kind % 3U;
    Request request = make_request((kind & 0x80U) != 0, sizes[object], (kind & 0x40U) != 0);
    request.key = keys[object];
    if (own_.is_open || !is_allowed()) {
      const CO_ERR err = call(&node_.CSdo[own], request, size_);
      require(err == (own_.is_open ? CO_ERR_SDO_BUSY : CO_ERR_SDO_OFF), "a request is refused");
      return;
    }
    own_size_ = size_;
    own_ = std::move(request);
    own_.is_open = true;
    require(call(&node_.CSdo[own], own_, own_size_) == CO_ERR_NONE, "a request is started");
  }

  void own_ended(std::uint32_t code) {
    const bool interrupted = code == CO_SDO_ERR_TOS_STATE && !is_allowed();
    require(interrupted || code == result_of_own(), "the own dictionary is accessed with the rights of the network");
    if (code != 0) {
      return;
    }
    const Bytes held = held_by_own();
    const std::uint32_t num = COCSdoGetNum(&node_.CSdo[own]);
    require(num <= own_size_ && num <= held.size(), "the callback can ask how many bytes were transferred");
    require(std::equal(held.begin(), held.begin() + num, own_.buffer.get()), "the buffer has what the object holds");
  }

  Bytes held_by_own() const {
    if (own_.key[0] == 1) {
      return Bytes(std::begin(own_domain_), std::end(own_domain_));
    }
    Bytes bytes;
    for (unsigned n = 0; n < 4; ++n) {
      bytes.push_back(static_cast<std::uint8_t>(own_number_ >> (8 * n)));
    }
    return bytes;
  }

  std::uint32_t result_of_own() const {
    const bool is_number = own_.key[0] == 0;
    const std::size_t capacity = is_number ? 4 : sizeof own_domain_;
    if (own_.key[0] == 2) {
      return CO_SDO_ERR_OBJ;
    }
    if (own_.is_upload) {
      return own_size_ < capacity ? CO_SDO_ERR_MEM : 0;
    }
    const bool is_short = own_size_ < capacity && is_number;
    return own_size_ > capacity ? CO_SDO_ERR_LEN_HIGH : is_short ? CO_SDO_ERR_LEN_SMALL : 0;
  }

  // Time -----------------------------------------------------------------------------

  // Advances the time. The controller accepts the queued frames first: otherwise the abort after a time-out could not
  // be distinguished from an answer.
  void pass(std::uint32_t ticks) {
    accept();
    passes_ = true;
    for (const std::uint32_t end = now_ + ticks; now_ != end;) {
      now_ += std::clamp<std::uint32_t>(CONodeNextDeadline(&node_), 1, end - now_);
      COTmrService(&node_.Tmr);
      COTmrProcess(&node_.Tmr);
      fuzz::process(node_);
    }
    passes_ = false;
  }

  // Properties to check ---------------------------------------------------------------

  void check() {
    for (Peer& peer : peers_) {
      require(refuses_ || (peer.waiting.empty() && !peer.model.segment()), "what is to be sent is sent");
      const bool is_busy = client_of(peer)->State == CO_CSDO_STATE_BUSY;
      require(is_busy == peer.request.is_open, "a client is busy from the request to the callback");
      require(is_busy == peer.model.is_open(), "a transfer is open until its callback");
    }
  }

  void come_to_rest() {
    pass(patience);
    for (Peer& peer : peers_) {
      require(!peer.request.is_open || peer.request.timeout == 0, "a transfer ends when its time is over");
      cancel(peer);
    }
    require(!own_.is_open, "an access to the own dictionary ends by itself");
    check();
  }

  void transfer_at_last() {
    command_nmt(3);
    for (Peer& peer : peers_) {
      if (!peer.is_configured) {
        configure(peer);
      }
      peer.to_client.clear();
      peer.to_server.clear();
      peer.server.close();
      const unsigned before = callbacks_;
      begin(peer, 0x80U | 0x40U | 5U);
      carry(peer, 100);
      require(callbacks_ == before + 1 && peer.model.end() == 0, "a client that has come to rest transfers");
    }
  }

  std::int16_t take(const CO_IF_FRM& frame) {
    if (refuses_) {
      return 0;
    }
    const std::uint32_t number = frame.Identifier - 0x606U;
    if (number < peers) {
      take_request(peers_[number], bytes_of(frame));
      require(frame.DLC == 8, "a request has eight bytes");
      require(is_allowed(), "a client is silent while SDO is not allowed");
    } else {
      require(frame.Identifier == 0x700U + node_id, "the node has nothing else to say");
    }
    return sizeof frame;
  }

  void take_request(Peer& peer, const SdoBytes& bytes) {
    peer.to_server.push_back(bytes);
    if (!peer.waiting.empty()) {
      require(peer.waiting.front() == bytes, "a request is that of the standard");
      peer.waiting.pop_front();
      return;
    }
    const std::uint32_t code = reason(peer);
    if (code != 0 && peer.model.is_open() && bytes == peer.model.abort(code)) {
      peer.model.close(code);
      return;
    }
    if (passes_ && peer.model.repeat_acknowledge(bytes)) {
      return;
    }
    require(peer.model.segment() == bytes, "a segment is that of the standard");
  }

  static void nothing(void*) {}
  static void no_number(void*, std::uint32_t) {}
  static std::int16_t can_read(void*, CO_IF_FRM* frame) {
    if (!bench->received_) {
      return 0;
    }
    *frame = *std::exchange(bench->received_, std::nullopt);
    return sizeof *frame;
  }
  static std::int16_t can_send(void*, const CO_IF_FRM* frame) { return bench->take(*frame); }
  static std::uint32_t time(void*) { return bench->now_; }
  static constexpr CO_IF_CAN_DRV_EX can = {nothing, no_number, can_read, can_send, nothing, nothing, nullptr, nullptr};
  static constexpr CO_IF_TIMER_DRV_EX timer = {no_number, time, nullptr};

  fuzz::Input input_;
  std::vector<Peer> peers_;
  Request own_;
  std::size_t own_size_ = 0;
  std::size_t size_ = 0;  // size of the last buffer
  unsigned depth_ = 0;
  unsigned callbacks_ = 0;
  bool refuses_ = false;             // the controller accepts no frames
  bool passes_ = false;              // time is advancing
  const Peer* cancelled_ = nullptr;  // client whose COCSdoCancel() is running
  std::optional<CO_IF_FRM> received_;
  std::uint32_t now_ = 0xFFFFF800;  // wraps after 2048 ms

  std::uint8_t error_register_ = 0;
  std::uint32_t number_of_requests_[3] = {0x606, 0x607, 0x605};
  std::uint32_t number_of_answers_[3] = {0x586, 0x587, 0x585};
  std::uint32_t own_number_ = 1;
  std::uint8_t own_domain_[30] = {};
  CO_OBJ_DOM domain_{0, sizeof own_domain_, own_domain_};
  CO_OBJ table_[13] = {
      {CO_KEY(0x1001, 0, CO_OBJ_____R_), CO_TUNSIGNED8, (CO_DATA)(&error_register_)},
      {CO_KEY(0x1018, 1, CO_OBJ_D___R_), CO_TUNSIGNED32, (CO_DATA)(5)},
      {CO_KEY(0x1280, 1, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&number_of_requests_[0])},
      {CO_KEY(0x1280, 2, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&number_of_answers_[0])},
      {CO_KEY(0x1280, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(6)},
      {CO_KEY(0x1281, 1, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&number_of_requests_[1])},
      {CO_KEY(0x1281, 2, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&number_of_answers_[1])},
      {CO_KEY(0x1281, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(7)},
      {CO_KEY(0x1282, 1, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&number_of_requests_[2])},
      {CO_KEY(0x1282, 2, CO_OBJ_____RW), CO_TSDO_ID, (CO_DATA)(&number_of_answers_[2])},
      {CO_KEY(0x1282, 3, CO_OBJ_D___R_), CO_TUNSIGNED8, (CO_DATA)(node_id)},
      {CO_KEY(0x2000, 0, CO_OBJ_____RW), CO_TUNSIGNED32, (CO_DATA)(&own_number_)},
      {CO_KEY(0x2001, 0, CO_OBJ_____RW), CO_TDOMAIN, (CO_DATA)(&domain_)},
  };
  CO_NODE_EXT ext_{};
  CO_NODE node_{};
};

static_assert(CO_CSDO_N > own, "the largest configuration has three clients");

}  // namespace

extern "C" {

void CONmtModeChange(CO_NMT*, CO_MODE mode) { bench->change_mode(mode); }

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bench(fuzz::Input(data, size)).run();
  return 0;
}

}  // extern "C"
