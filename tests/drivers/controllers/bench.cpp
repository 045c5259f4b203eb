// SPDX-License-Identifier: Apache-2.0
#include "bench.hpp"

#include <stdexcept>
#include <type_traits>

#include "bit_timing.hpp"
#include "bxcan.hpp"
#include "bxcan_rates.hpp"
#include "co_can_bxcan.h"
#include "co_can_fdcan.h"
#include "co_can_flexcan.h"
#include "co_can_mcp2515.h"
#include "co_can_mcp251xfd.h"
#include "co_can_sja1000.h"
#include "co_can_twai.h"
#include "fdcan_rates.hpp"
#include "flexcan.hpp"
#include "flexcan_rates.hpp"
#include "m_can.hpp"
#include "mcp2515.hpp"
#include "mcp2515_rates.hpp"
#include "mcp251xfd.hpp"
#include "mcp251xfd_rates.hpp"
#include "pelican.hpp"
#include "sja1000_rates.hpp"
#include "support/notation.hpp"

namespace test {
namespace {

constexpr std::uintptr_t bxcan_address[] = {0x40006400, 0x40006800};
constexpr std::uintptr_t fdcan_address[] = {0x40006400, 0x40006800};
constexpr std::uintptr_t fdcan_ram = 0x4000A400;
constexpr std::uintptr_t mcan_address[] = {0x4000A000, 0x4000A400};
constexpr std::uintptr_t mcan_ram = 0x4000AC00;
constexpr std::uintptr_t flexcan_address[] = {0x02090000, 0x02094000};

// Models of several kinds can be on one bus: their addresses must not overlap.
constexpr std::uintptr_t distance_of_kinds = 0x100000;

template <class Register>
Register* pointer(std::uintptr_t address) {
  return reinterpret_cast<Register*>(address);
}

constexpr unsigned most_interrupts = 10;

class BxcanController : public Controller {
 public:
  BxcanController(CanWire& wire, const ControllerOptions& options, BxCan* master)
      : model(wire, bxcan_address[options.number], model_options(options, master)), frames_(options.frames) {
    driver = &BxcanCanDriver;
    can_.Registers = pointer<CO_BXCAN_REGISTERS>(bxcan_address[options.number]);
    can_.Master = options.number == 0 ? nullptr : pointer<CO_BXCAN_REGISTERS>(bxcan_address[0]);
    can_.FirstBank = static_cast<std::uint8_t>(options.bxcan.first);
    can_.BankNum = static_cast<std::uint8_t>(options.bxcan.number);
    can_.Rates = rates_;
    can_.RateNum = 1;
    can_.Frames = frames_.data();
    can_.FrameNum = options.frames;
    can_.Recovery = options.recovery;
    can_.Loopback = options.loopback;
    rates_[0] = co::bxcan_rate(Bench::baud, co::find_bit_timing(options.clock, Bench::baud, co::bxcan_limits));
    model.release_accesses = options.bxcan.release_accesses;
    model.late_abort_clears_flags = options.bxcan.late_abort_clears_flags;
  }

  void* context() override { return &can_; }
  bool has_interrupt() const override {
    return model.transmit_interrupt() || model.receive_interrupt(0) || model.status_interrupt();
  }
  void call_interrupt() override { COCanBxcanInterrupt(&can_); }
  bool has_frames() const override { return COCanBxcanHasFrames(&can_); }
  std::uint32_t lost() const override { return COCanBxcanLost(&can_); }
  CO_CAN_ERROR_COUNTERS errors() const override { return COCanBxcanErrors(&can_); }
  CanNode& node() override { return model.node(); }
  RegisterModel& registers() override { return model; }
  std::uint32_t bit_rate() const override { return model.bit_rate(); }
  unsigned sample_point() const override { return model.sample_point(); }
  void set_timing(std::uint32_t baud, std::uint32_t timing) override { rates_[0] = {baud, timing}; }
  unsigned fifo_places() const override { return 3; }

  BxCan model;

 private:
  static BxCan::Options model_options(const ControllerOptions& options, BxCan* master) {
    BxCan::Options result;
    result.filter_banks = options.bxcan.banks;
    result.master = master;
    result.clock = options.clock;
    return result;
  }

  CO_CAN_BXCAN_RATE rates_[1]{};
  std::vector<CO_IF_FRM> frames_;
  CO_CAN_BXCAN can_{};
};

class MCanController : public Controller {
 public:
  MCanController(CanWire& wire, MessageRam& ram, Kind kind, const ControllerOptions& options)
      : model(wire, address(kind, options.number), ram, model_options(kind, options)),
        kind_(kind),
        frames_(options.frames),
        fifo_(options.fifo) {
    driver = kind == Kind::fdcan ? &FdcanCanDriver : &McanCanDriver;
    const unsigned offset = model_options(kind, options).ram_offset;
    can_.Registers = pointer<void>(model.address());
    can_.Ram = pointer<volatile std::uint32_t>(ram.address() + (kind == Kind::fdcan ? 4 * offset : 0));
    can_.RamOffset = static_cast<std::uint16_t>(kind == Kind::mcan ? 100 + options.number * 700 : 0);
    can_.FifoNum = options.fifo;
    can_.Rates = rates_;
    can_.RateNum = 1;
    can_.Frames = frames_.data();
    can_.FrameNum = options.frames;
    can_.Recovery = options.recovery;
    can_.WaitForIdle = options.wait_for_idle;
    can_.Loopback = options.loopback;
    rates_[0] = co::fdcan_rate(Bench::baud, co::find_bit_timing(options.clock, Bench::baud, co::fdcan_limits));
  }

  void* context() override { return &can_; }
  bool has_interrupt() const override { return model.interrupt(0); }
  void call_interrupt() override { kind_ == Kind::fdcan ? COCanFdcanInterrupt(&can_) : COCanMcanInterrupt(&can_); }
  bool has_frames() const override { return COCanFdcanHasFrames(&can_); }
  std::uint32_t lost() const override { return COCanFdcanLost(&can_); }
  CO_CAN_ERROR_COUNTERS errors() const override { return COCanFdcanErrors(&can_); }
  CanNode& node() override { return model.node(); }
  RegisterModel& registers() override { return model; }
  std::uint32_t bit_rate() const override { return model.bit_rate(); }
  unsigned sample_point() const override { return model.sample_point(); }
  void set_timing(std::uint32_t baud, std::uint32_t timing) override { rates_[0] = {baud, timing}; }
  unsigned fifo_places() const override { return kind_ == Kind::fdcan ? 3 : fifo_; }

  MCan model;

 private:
  static std::uintptr_t address(Kind kind, unsigned number) {
    return distance_of_kinds * static_cast<unsigned>(kind) +
           (kind == Kind::fdcan ? fdcan_address[number] : mcan_address[number]);
  }
  static MCan::Options model_options(Kind kind, const ControllerOptions& options) {
    MCan::Options result;
    result.layout = kind == Kind::fdcan ? MCanLayout::fixed : MCanLayout::configurable;
    result.ram_offset = kind == Kind::fdcan ? options.number * MCan::fixed_words : 0;
    result.clock = options.clock;
    return result;
  }

  CO_CAN_FDCAN_RATE rates_[1]{};
  Kind kind_;
  std::vector<CO_IF_FRM> frames_;
  std::uint8_t fifo_;
  CO_CAN_FDCAN can_{};
};

// FlexCAN2 of i.MX 6 with the receive FIFO, FlexCAN3 of i.MX 8M Plus with message buffers that receive.
class FlexcanController : public Controller {
 public:
  FlexcanController(CanWire& wire, Kind kind, const ControllerOptions& options)
      : model(wire, address(kind, options.number), model_options(kind, options)), kind_(kind), frames_(options.frames) {
    driver = &FlexcanCanDriver;
    can_.Registers = pointer<CO_FLEXCAN_REGISTERS>(model.address());
    can_.MailboxNum = 64;
    can_.Receive = kind == Kind::flexcan2 ? CO_CAN_FLEXCAN_FIFO : CO_CAN_FLEXCAN_MAILBOXES;
    can_.Rates = rates_;
    can_.RateNum = 1;
    can_.Frames = frames_.data();
    can_.FrameNum = options.frames;
    can_.Recovery = options.recovery;
    can_.Ecc = kind == Kind::flexcan3;
    can_.Loopback = options.loopback;
    rates_[0] = co::flexcan_rate(Bench::baud, co::find_bit_timing(options.clock, Bench::baud, co::flexcan_limits));
  }

  void* context() override { return &can_; }
  bool has_interrupt() const override { return model.interrupt(); }
  void call_interrupt() override { COCanFlexcanInterrupt(&can_); }
  bool has_frames() const override { return COCanFlexcanHasFrames(&can_); }
  std::uint32_t lost() const override { return COCanFlexcanLost(&can_); }
  CO_CAN_ERROR_COUNTERS errors() const override { return COCanFlexcanErrors(&can_); }
  CanNode& node() override { return model.node(); }
  RegisterModel& registers() override { return model; }
  std::uint32_t bit_rate() const override { return model.bit_rate(); }
  unsigned sample_point() const override { return model.sample_point(); }
  void set_timing(std::uint32_t baud, std::uint32_t timing) override { rates_[0] = {baud, timing, 0}; }
  unsigned fifo_places() const override { return kind_ == Kind::flexcan2 ? 6 : 28; }

  FlexCan model;

 private:
  static std::uintptr_t address(Kind kind, unsigned number) {
    return distance_of_kinds * static_cast<unsigned>(kind) + flexcan_address[number];
  }
  static FlexCan::Options model_options(Kind kind, const ControllerOptions& options) {
    FlexCan::Options result = kind == Kind::flexcan2 ? FlexCan::imx6() : FlexCan::imx8mp();
    result.clock = options.clock;
    return result;
  }

  CO_CAN_FLEXCAN_RATE rates_[1]{};
  Kind kind_;
  std::vector<CO_IF_FRM> frames_;
  CO_CAN_FLEXCAN can_{};
};

// Access functions of SJA1000 that access the model.
std::uint8_t read_sja1000(void* ctx, std::uint8_t address) {
  return static_cast<std::uint8_t>(lexican_model_read(static_cast<PeliCan*>(ctx)->address() + 4U * address));
}
void write_sja1000(void* ctx, std::uint8_t address, std::uint8_t value) {
  lexican_model_write(static_cast<PeliCan*>(ctx)->address() + 4U * address, value);
}
constexpr CO_SJA1000_ACCESS sja1000_access = {read_sja1000, write_sja1000};

std::uintptr_t sja1000_address(Kind kind, unsigned number) {
  return distance_of_kinds * static_cast<unsigned>(kind) + 0x1000 * (number + 1);
}

// The model of SJA1000 or TWAI, and what their contexts have in common.
template <class Context>
class Sja1000Base : public Controller {
 public:
  Sja1000Base(CanWire& wire, Kind kind, const ControllerOptions& options)
      : model(wire, sja1000_address(kind, options.number), model_options(kind, options)), frames_(options.frames) {
    can_.Rates = rates_;
    can_.RateNum = 1;
    can_.Frames = frames_.data();
    can_.FrameNum = options.frames;
    can_.Recovery = options.recovery;
    can_.Loopback = options.loopback;
  }

  void* context() override { return &can_; }
  bool has_interrupt() const override { return model.interrupt(); }
  CanNode& node() override { return model.node(); }
  RegisterModel& registers() override { return model; }
  std::uint32_t bit_rate() const override { return model.bit_rate(); }
  unsigned sample_point() const override { return model.sample_point(); }
  void set_timing(std::uint32_t baud, std::uint32_t timing) override { rates_[0] = {baud, timing}; }
  unsigned fifo_places() const override { return 16; }  // frames with a byte of data

  PeliCan model;

 protected:
  static PeliCan::Options model_options(Kind kind, const ControllerOptions& options) {
    PeliCan::Options result;
    result.kind = kind == Kind::sja1000 ? PeliCanKind::sja1000
                  : kind == Kind::esp32 ? PeliCanKind::esp32
                                        : PeliCanKind::esp32c3;
    result.clock = options.clock;
    return result;
  }

  CO_CAN_SJA1000_RATE rates_[1]{};
  Context can_{};

 private:
  std::vector<CO_IF_FRM> frames_;
};

class Sja1000Controller : public Sja1000Base<CO_CAN_SJA1000> {
 public:
  Sja1000Controller(CanWire& wire, const ControllerOptions& options) : Sja1000Base(wire, Kind::sja1000, options) {
    driver = &Sja1000CanDriver;
    can_.Access = &sja1000_access;
    can_.AccessCtx = &model;
    rates_[0] = co::sja1000_rate(Bench::baud, co::find_bit_timing(options.clock / 2, Bench::baud, co::sja1000_limits));
  }

  void call_interrupt() override { COCanSja1000Interrupt(&can_); }
  bool has_frames() const override { return COCanSja1000HasFrames(&can_); }
  std::uint32_t lost() const override { return COCanSja1000Lost(&can_); }
  CO_CAN_ERROR_COUNTERS errors() const override { return COCanSja1000Errors(&can_); }
};

class TwaiController : public Sja1000Base<CO_CAN_TWAI> {
 public:
  TwaiController(CanWire& wire, Kind kind, const ControllerOptions& options) : Sja1000Base(wire, kind, options) {
    const bool is_esp32 = kind == Kind::esp32;
    const co::BitTimingLimits& limits = is_esp32 ? co::sja1000_limits : co::twai_limits;
    const co::BitTiming timing = co::find_bit_timing(options.clock / 2, Bench::baud, limits);
    driver = &TwaiCanDriver;
    can_.Registers = pointer<volatile std::uint32_t>(model.address());
    can_.IsEsp32 = is_esp32;
    can_.ResetPeripheral = [] { only_one->hardware_reset(); };
    rates_[0] = is_esp32 ? co::sja1000_rate(Bench::baud, timing) : co::twai_rate(Bench::baud, timing);
    only_one = is_esp32 ? &model : only_one;
  }

  void call_interrupt() override { COCanTwaiInterrupt(&can_); }
  bool has_frames() const override { return COCanTwaiHasFrames(&can_); }
  std::uint32_t lost() const override { return COCanTwaiLost(&can_); }
  CO_CAN_ERROR_COUNTERS errors() const override { return COCanTwaiErrors(&can_); }

 private:
  static inline PeliCan* only_one = nullptr;  // ESP32 has one controller
};

// Functions of the board: SPI to the model.
void select_spi(void* ctx, bool is_selected) {
  SpiModel& model = *static_cast<SpiModel*>(ctx);
  is_selected ? model.select() : model.deselect();
}
void transfer_spi(void* ctx, std::uint8_t* bytes, std::uint8_t number) {
  for (unsigned n = 0; n < number; ++n) {
    bytes[n] = static_cast<SpiModel*>(ctx)->transfer(bytes[n]);
  }
}
bool spi_has_interrupt(void* ctx) { return static_cast<SpiModel*>(ctx)->interrupt(); }
constexpr CO_CAN_SPI board_spi = {select_spi, transfer_spi, spi_has_interrupt};
constexpr CO_CAN_SPI board_spi_without_pin = {select_spi, transfer_spi, nullptr};

class SpiController : public Controller {
 public:
  SpiController() = default;

  // The interrupt is triggered by the falling edge of INT.
  bool has_interrupt() const override {
    const bool was_low = is_low_;
    is_low_ = spi().interrupt();
    return is_low_ && !was_low;
  }
  RegisterModel& registers() override { throw std::logic_error("no memory-mapped registers"); }
  bool has_faults() override { return !spi().faults().empty(); }
  std::string fault_text() override { return spi().fault_text(); }
  void on_access(std::function<void()> function) override { spi().on_transfer = std::move(function); }

  virtual SpiModel& spi() const = 0;

 private:
  mutable bool is_low_ = false;
};

// The model of a controller behind SPI, and what their contexts have in common.
template <class Model, class Context>
class SpiBase : public SpiController {
 public:
  SpiBase(CanWire& wire, const ControllerOptions& options, const typename Model::Options& model_options)
      : model(wire, model_options), frames_(options.frames) {
    can_.Spi = options.has_interrupt_pin ? &board_spi : &board_spi_without_pin;
    can_.SpiCtx = static_cast<SpiModel*>(&model);
    can_.Bus = options.spi_bus;
    can_.Rates = rates_;
    can_.RateNum = 1;
    can_.Frames = frames_.data();
    can_.FrameNum = options.frames;
    can_.Recovery = options.recovery;
    can_.Loopback = options.loopback;
  }

  void* context() override { return &can_; }
  CanNode& node() override { return model.node(); }
  SpiModel& spi() const override { return model; }
  std::uint32_t bit_rate() const override { return model.bit_rate(); }
  unsigned sample_point() const override { return model.sample_point(); }
  void set_timing(std::uint32_t baud, std::uint32_t timing) override { rates_[0] = {baud, timing}; }

  mutable Model model;

 protected:
  std::remove_const_t<std::remove_pointer_t<decltype(Context::Rates)>> rates_[1]{};
  mutable Context can_{};

 private:
  std::vector<CO_IF_FRM> frames_;
};

// Returns the crystal: the clock of the other controllers is too fast for those behind SPI.
std::uint32_t crystal_of(const ControllerOptions& options, std::uint32_t usual) {
  return options.clock == ControllerOptions{}.clock ? usual : options.clock;
}

class Mcp2515Controller : public SpiBase<Mcp2515, CO_CAN_MCP2515> {
 public:
  Mcp2515Controller(CanWire& wire, const ControllerOptions& options) : SpiBase(wire, options, model_options(options)) {
    driver = &Mcp2515CanDriver;
    const std::uint32_t clock = model_options(options).oscillator;
    rates_[0] = co::mcp2515_rate(Bench::baud, co::find_bit_timing(clock / 2, Bench::baud, co::mcp2515_limits));
  }

  void call_interrupt() override { COCanMcp2515Interrupt(&can_); }
  bool has_frames() const override { return COCanMcp2515HasFrames(&can_); }
  std::uint32_t lost() const override { return COCanMcp2515Lost(&can_); }
  CO_CAN_ERROR_COUNTERS errors() const override { return COCanMcp2515Errors(&can_); }
  unsigned fifo_places() const override { return 2; }

 private:
  static Mcp2515::Options model_options(const ControllerOptions& options) {
    Mcp2515::Options result;
    result.oscillator = crystal_of(options, 16'000'000);
    result.is_error_flag_sticky = options.is_error_flag_sticky;
    return result;
  }
};

class Mcp251xfdController : public SpiBase<Mcp251xfd, CO_CAN_MCP251XFD> {
 public:
  Mcp251xfdController(CanWire& wire, const ControllerOptions& options)
      : SpiBase(wire, options, model_options(options)) {
    driver = &Mcp251xfdCanDriver;
    const std::uint32_t clock = model_options(options).oscillator;
    rates_[0] = co::mcp251xfd_rate(Bench::baud, co::find_bit_timing(clock, Bench::baud, co::mcp251xfd_limits));
  }

  void call_interrupt() override { COCanMcp251xfdInterrupt(&can_); }
  bool has_frames() const override { return COCanMcp251xfdHasFrames(&can_); }
  std::uint32_t lost() const override { return COCanMcp251xfdLost(&can_); }
  CO_CAN_ERROR_COUNTERS errors() const override { return COCanMcp251xfdErrors(&can_); }
  unsigned fifo_places() const override { return 32; }

 private:
  static Mcp251xfd::Options model_options(const ControllerOptions& options) {
    Mcp251xfd::Options result;
    result.oscillator = crystal_of(options, 40'000'000);
    result.keeps_messages_in_bus_off = options.keeps_messages_in_bus_off;
    result.flags_begin_of_bus_off = options.flags_begin_of_bus_off;
    result.is_2517 = options.number != 0;
    result.start_up_reads = 3;
    return result;
  }
};

bool is_error(const std::string& text) { return text.size() > 8 && text[8] == '#' && text[0] == '2'; }

}  // namespace

Mcp2515& mcp2515_of(Controller& controller) { return static_cast<Mcp2515Controller&>(controller).model; }
Mcp251xfd& mcp251xfd_of(Controller& controller) { return static_cast<Mcp251xfdController&>(controller).model; }
SpiModel& spi_of(Controller& controller) { return static_cast<SpiController&>(controller).spi(); }

std::string name_of(Kind kind) {
  switch (kind) {
    case Kind::bxcan: return "bxCAN";
    case Kind::fdcan: return "FDCAN";
    case Kind::mcan: return "M_CAN";
    case Kind::flexcan2: return "FlexCAN2";
    case Kind::flexcan3: return "FlexCAN3";
    case Kind::sja1000: return "SJA1000";
    case Kind::esp32: return "TWAI of ESP32";
    case Kind::esp32c3: return "TWAI of ESP32-C3";
    case Kind::mcp2515: return "MCP2515";
    case Kind::mcp251xfd: return "MCP251xFD";
  }
  return "";
}

CO_IF_FRM to_driver(const CanFrame& frame) {
  CO_IF_FRM result{};
  result.Identifier = frame.id | (frame.is_extended ? CO_IF_FRM_EXT : 0) | (frame.is_remote ? CO_IF_FRM_RTR : 0);
  result.DLC = frame.dlc;
  for (unsigned i = 0; i < frame.bytes(); ++i) {
    result.Data[i] = frame.data[i];
  }
  return result;
}

CanFrame to_wire(const CO_IF_FRM& frame) {
  CanFrame result;
  result.id = frame.Identifier & CO_IF_FRM_ID;
  result.is_extended = (frame.Identifier & CO_IF_FRM_EXT) != 0;
  result.is_remote = (frame.Identifier & CO_IF_FRM_RTR) != 0;
  result.dlc = frame.DLC;
  for (unsigned i = 0; i < 8; ++i) {
    result.data[i] = frame.Data[i];
  }
  return result;
}

std::vector<std::string> error_frames(const std::vector<std::string>& all) {
  std::vector<std::string> result;
  for (const std::string& one : all) {
    if (is_error(one)) {
      result.push_back(one);
    }
  }
  return result;
}

std::vector<std::string> data_frames(const std::vector<std::string>& all) {
  std::vector<std::string> result;
  for (const std::string& one : all) {
    if (!is_error(one)) {
      result.push_back(one);
    }
  }
  return result;
}

void Controller::filter(const std::vector<std::uint32_t>& ids) {
  driver->Filter(context(), ids.data(), static_cast<std::uint16_t>(ids.size()));
}

std::int16_t Controller::send(const char* text) { return send(frame(text)); }

std::string Controller::read() {
  CO_IF_FRM frm{};
  const std::int16_t result = driver->Read(context(), &frm);
  return result == sizeof frm ? notation(frm) : std::to_string(result);
}

std::vector<std::string> Controller::read_all() {
  std::vector<std::string> all;
  for (std::string text = read(); text != "0"; text = read()) {
    all.push_back(text);
    REQUIRE(all.size() < 1000);
  }
  return all;
}

Bench::Bench() {
  unmatched_accesses().clear();
  wire.bit_rate = baud;
  wire.accesses_per_bit = 20;
}

Bench::~Bench() {
  CHECK(unmatched_accesses().empty());
  for (const auto& one : controllers_) {
    if (checks_faults) {
      CHECK_MESSAGE(!one->has_faults(), one->fault_text());
    }
  }
  for (const auto& one : memory_) {
    CHECK_MESSAGE(one->faults().empty(), one->fault_text());
  }
  controllers_.clear();
}

Controller& Bench::add(Kind kind, const ControllerOptions& options) {
  if (kind == Kind::bxcan) {
    BxCan* const master = options.number == 0 ? nullptr : &static_cast<BxcanController&>(*controllers_[0]).model;
    controllers_.push_back(std::make_unique<BxcanController>(wire, options, master));
  } else if (is_flexcan(kind)) {
    controllers_.push_back(std::make_unique<FlexcanController>(wire, kind, options));
  } else if (kind == Kind::sja1000) {
    controllers_.push_back(std::make_unique<Sja1000Controller>(wire, options));
  } else if (kind == Kind::mcp2515) {
    controllers_.push_back(std::make_unique<Mcp2515Controller>(wire, options));
  } else if (kind == Kind::mcp251xfd) {
    controllers_.push_back(std::make_unique<Mcp251xfdController>(wire, options));
  } else if (is_twai(kind)) {
    controllers_.push_back(std::make_unique<TwaiController>(wire, kind, options));
  } else {
    const unsigned words = kind == Kind::fdcan ? 2 * MCan::fixed_words : MCan::configurable_words;
    const std::uintptr_t at =
        distance_of_kinds * static_cast<unsigned>(kind) + (kind == Kind::fdcan ? fdcan_ram : mcan_ram);
    RegisterModel* ram = nullptr;
    for (const auto& one : memory_) {
      ram = one->address() == at ? one.get() : ram;
    }
    if (ram == nullptr) {
      memory_.push_back(std::make_unique<MessageRam>(at, words));
      ram = memory_.back().get();
    }
    controllers_.push_back(std::make_unique<MCanController>(wire, static_cast<MessageRam&>(*ram), kind, options));
  }
  Controller& added = *controllers_.back();
  if (options.starts) {
    added.init();
    added.enable(baud);
    run(20);
  }
  return added;
}

void Bench::process(Controller& controller) {
  if (!are_interrupts_enabled || is_in_interrupt_) {
    return;
  }
  is_in_interrupt_ = true;
  for (unsigned n = 0; controller.has_interrupt(); ++n) {
    if (n == most_interrupts) {
      FAIL("an interrupt stays active");
    }
    controller.call_interrupt();
  }
  is_in_interrupt_ = false;
}

void Bench::process_interrupts() {
  for (const auto& one : controllers_) {
    process(*one);
  }
}

void Bench::interrupt_everywhere() {
  const auto hook = [this] { process_interrupts(); };
  for (const auto& one : controllers_) {
    one->on_access(hook);
  }
  for (const auto& one : memory_) {
    one->on_access = hook;
  }
}

void Bench::run(std::uint64_t bits) {
  for (; bits != 0; --bits) {
    wire.advance(1);
    process_interrupts();
  }
}

bool Bench::run_until(const std::function<bool()>& condition, std::uint64_t bits) {
  for (; !condition(); --bits) {
    if (bits == 0) {
      return false;
    }
    run(1);
  }
  return true;
}

void Bench::receive(const CanFrame& frame) {
  peer.send(frame);
  REQUIRE(run_until([&] { return peer.queued() == 0; }));
  run(4);
}

std::vector<std::string> Bench::sent_by(Controller& controller) const {
  std::vector<std::string> texts;
  for (const CanRecord& one : wire.records()) {
    if (one.kind == CanRecord::Kind::sent && one.node == &controller.node()) {
      texts.push_back(notation(to_driver(one.frame)));
    }
  }
  return texts;
}

}  // namespace test
