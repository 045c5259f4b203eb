// SPDX-License-Identifier: Apache-2.0
#include "simulate/dictionary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <iterator>

#include "co_core.h"
#include "lexican/detail/objects.h"
#include "lexican/detail/rules.hpp"
#include "model/types.hpp"

namespace lexican::simulate {
namespace {

using codict::TypeKind;
using codict::gen::Item;
using codict::gen::Plan;
using codict::gen::Reset;
using codict::gen::Storage;

constexpr std::uint32_t string_bytes = 256;    // of a string whose length is not described
constexpr std::uint32_t domain_bytes = 65536;  // of a domain without value
constexpr std::uint16_t first_application = 0x2000;
constexpr std::uint16_t store_parameters = 0x1010;

struct NamedType {
  std::string_view name;
  const CO_OBJ_TYPE* type;
};

// clang-format off
#define SIMULATE_TYPE(rule, macro, functions, first, last, first_sub, last_sub, bytes, flags, value, use, setting) \
  {#macro, (const CO_OBJ_TYPE*)&(functions)},
// clang-format on

/// Returns the functions of a type that the stack implements; null for others.
const CO_OBJ_TYPE* type_named(std::string_view name) {
  static const NamedType types[] = {{"CO_TBOOLEAN", CO_TBOOLEAN},
                                    {"CO_TSIGNED8", CO_TSIGNED8},
                                    {"CO_TSIGNED16", CO_TSIGNED16},
                                    {"CO_TSIGNED24", CO_TSIGNED24},
                                    {"CO_TSIGNED32", CO_TSIGNED32},
                                    {"CO_TSIGNED40", CO_TSIGNED40},
                                    {"CO_TSIGNED48", CO_TSIGNED48},
                                    {"CO_TSIGNED56", CO_TSIGNED56},
                                    {"CO_TSIGNED64", CO_TSIGNED64},
                                    {"CO_TUNSIGNED8", CO_TUNSIGNED8},
                                    {"CO_TUNSIGNED16", CO_TUNSIGNED16},
                                    {"CO_TUNSIGNED24", CO_TUNSIGNED24},
                                    {"CO_TUNSIGNED32", CO_TUNSIGNED32},
                                    {"CO_TUNSIGNED40", CO_TUNSIGNED40},
                                    {"CO_TUNSIGNED48", CO_TUNSIGNED48},
                                    {"CO_TUNSIGNED56", CO_TUNSIGNED56},
                                    {"CO_TUNSIGNED64", CO_TUNSIGNED64},
                                    {"CO_TREAL32", CO_TREAL32},
                                    {"CO_TREAL64", CO_TREAL64},
                                    {"CO_TTIME_OF_DAY", CO_TTIME_OF_DAY},
                                    {"CO_TTIME_DIFFERENCE", CO_TTIME_DIFFERENCE},
                                    {"CO_TSTRING", CO_TSTRING},
                                    {"CO_TVISIBLE_STRING", CO_TVISIBLE_STRING},
                                    {"CO_TOCTET_STRING", CO_TOCTET_STRING},
                                    {"CO_TUNICODE_STRING", CO_TUNICODE_STRING},
                                    {"CO_TDOMAIN", CO_TDOMAIN},
                                    {"CO_TDOMAIN_RO", CO_TDOMAIN_RO},
                                    CO_OBJECTS(SIMULATE_TYPE)};
  const auto* const found =
      std::find_if(std::begin(types), std::end(types), [&](const NamedType& row) { return row.name == name; });
  return found != std::end(types) ? found->type : nullptr;
}

#undef SIMULATE_TYPE

/// Returns the default value of a number as the stack stores it in a variable.
std::uint64_t stored_number(const Item& item) {
  std::uint64_t bits = item.value.integer.bits();
  switch (codict::data_type(item.form->code).kind) {
    case TypeKind::real:
      if (item.form->size == 4) {
        const auto single = static_cast<float>(item.value.real);
        bits = 0;
        std::memcpy(&bits, &single, sizeof single);
      } else {
        std::memcpy(&bits, &item.value.real, sizeof bits);
      }
      break;
    case TypeKind::time: {
      CO_TIME_OF_DAY time{};
      time.Ms = static_cast<std::uint32_t>(bits & 0x0FFFFFFF);
      time.Days = static_cast<std::uint16_t>(bits >> 32);
      std::memcpy(&bits, &time, sizeof bits);
      break;
    }
    default: break;
  }
  return bits;
}

/// Returns the bytes of a text, octet string or domain.
std::string bytes_of_value(const Item& item) {
  switch (codict::data_type(item.form->code).kind) {
    case TypeKind::visible_string: return item.value.text;
    case TypeKind::unicode_string: {
      const std::u16string wide = codict::gen::utf16(item.value.text);
      return {reinterpret_cast<const char*>(wide.data()), 2 * wide.size()};
    }
    default: return *item.value.octets;
  }
}

std::size_t words(std::size_t bytes) { return (bytes + 7) / 8; }

bool is_stored_string(const Item& item) {
  return item.storage == Storage::string ||
         (item.storage == Storage::external && codict::data_type(item.form->code).kind != TypeKind::domain &&
          item.form->bytes == 0);
}

bool is_number(const Item& item) {
  return item.storage == Storage::variable || item.storage == Storage::constant || item.storage == Storage::consumer ||
         (item.storage == Storage::external && item.form->bytes != 0);
}

/// Returns the bytes that a string can have.
std::uint32_t capacity_of(const Item& item) {
  const auto length = static_cast<std::uint32_t>(bytes_of_value(item).size());
  return std::max({item.capacity, length, item.storage == Storage::external ? string_bytes : 2U}) / 2 * 2 + 2;
}

CO_ERR call_init(const CO_OBJ_TYPE& type, CO_OBJ* obj, CO_NODE* node) {
  return type.Init != nullptr ? type.Init(obj, node) : CO_ERR_NONE;
}

}  // namespace

/// The variables: those that the network cannot write; those of the communication profile, then of the application,
/// that it can. Both NMT resets set the second ones, and reset node also the third ones.
class Dictionary::Memory {
 public:
  explicit Memory(const Plan& plan) {
    for (const Reset reset : {Reset::none, Reset::communication, Reset::node}) {
      for (const Item& item : plan.items) {
        const std::size_t size = size_of(item);
        if (size != 0 && codict::gen::reset_of(item) == reset) {
          std::size_t& used = reset == Reset::none ? fixed_words_ : written_words_;
          places_[item.key()] = {reset == Reset::none, used};
          used += size;
        }
      }
      communication_words_ = reset == Reset::node ? communication_words_ : written_words_;
    }
    fixed_.resize(fixed_words_);
    written_.resize(written_words_);
  }

  std::uint64_t* of(const Item& item) {
    const auto [is_fixed, position] = places_.at(item.key());
    return (is_fixed ? fixed_ : written_).data() + position;
  }
  void keep_defaults() { defaults_ = written_; }
  std::uint8_t* written() { return reinterpret_cast<std::uint8_t*>(written_.data()); }
  std::uint8_t* defaults() { return reinterpret_cast<std::uint8_t*>(defaults_.data()); }
  std::uint32_t communication_bytes() const { return static_cast<std::uint32_t>(8 * communication_words_); }
  std::uint32_t written_bytes() const { return static_cast<std::uint32_t>(8 * written_.size()); }
  /// Returns a number that depends on the entries and their places.
  std::uint32_t version() const {
    std::uint32_t hash = 0x811C9DC5;
    for (const auto& [key, place] : places_) {
      for (const std::size_t part : {std::size_t{key}, place.second}) {
        hash = (hash ^ static_cast<std::uint32_t>(part)) * 0x01000193U;
      }
    }
    return (hash >> 24 ^ hash) & 0x00FFFFFFU;
  }

 private:
  /// Returns the words of an entry; a string has its length in the first one.
  static std::size_t size_of(const Item& item) {
    return is_number(item) ? 1 : is_stored_string(item) ? 1 + words(capacity_of(item)) : 0;
  }

  std::map<std::uint32_t, std::pair<bool, std::size_t>> places_;
  std::size_t fixed_words_ = 0;
  std::size_t written_words_ = 0;
  std::size_t communication_words_ = 0;
  std::vector<std::uint64_t> fixed_;
  std::vector<std::uint64_t> written_;
  std::vector<std::uint64_t> defaults_;
};

/// Type of an application object: refuses values outside the limits, and what refuse() has set.
struct Dictionary::Guard {
  CO_OBJ_TYPE type;
  const CO_OBJ_TYPE* plain;
  Dictionary* owner;
  std::uint16_t index;
  std::uint8_t sub_index;
  TypeKind kind;
  bool is_limited;
  std::uint64_t low;
  std::uint64_t high;
  std::uint32_t abort;

  static Guard& of(CO_OBJ* obj) {
    void* const first_member = const_cast<CO_OBJ_TYPE*>(obj->Type);
    return *static_cast<Guard*>(first_member);
  }
  static CO_ERR refuse(CO_OBJ* obj, CO_NODE* node, std::uint32_t code, CO_ERR error) {
    COObjTypeUserSDOAbort(obj, node, code);
    return error;
  }
  static std::uint32_t size(CO_OBJ* obj, CO_NODE* node, std::uint32_t width) {
    return of(obj).plain->Size(obj, node, width);
  }
  static CO_ERR init(CO_OBJ* obj, CO_NODE* node) { return call_init(*of(obj).plain, obj, node); }
  static CO_ERR read(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t bytes) {
    const Guard& guard = of(obj);
    return guard.abort != 0 ? refuse(obj, node, guard.abort, CO_ERR_OBJ_READ)
                            : guard.plain->Read(obj, node, buffer, bytes);
  }
  static CO_ERR write(CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t bytes) {
    const Guard& guard = of(obj);
    if (guard.abort != 0) {
      return refuse(obj, node, guard.abort, CO_ERR_OBJ_WRITE);
    }
    if (guard.is_limited) {
      const int beyond = guard.beyond(buffer, bytes);
      if (beyond != 0) {
        return refuse(obj, node, beyond < 0 ? CO_SDO_ERR_RANGE_LOW : CO_SDO_ERR_RANGE_HIGH, CO_ERR_OBJ_RANGE);
      }
    }
    const CO_ERR error = guard.plain->Write(obj, node, buffer, bytes);
    if (error == CO_ERR_NONE && guard.owner->written_) {
      guard.owner->written_(guard.index, guard.sub_index);
    }
    return error;
  }
  static CO_ERR reset(CO_OBJ* obj, CO_NODE* node, std::uint32_t position) {
    return of(obj).plain->Reset(obj, node, position);
  }

  /// Returns -1 or 1 for a value below or above the limits, else 0.
  int beyond(const void* buffer, std::uint32_t bytes) const {
    std::uint64_t bits = 0;
    std::memcpy(&bits, buffer, std::min<std::size_t>(bytes, sizeof bits));
    const unsigned unused = 64 - 8 * std::min(bytes, 8U);
    switch (kind) {
      case TypeKind::signed_integer:
        return place(extended(bits, unused), static_cast<std::int64_t>(low), static_cast<std::int64_t>(high));
      case TypeKind::real: return place(real(bits, bytes), real(low, bytes), real(high, bytes));
      default: return place(bits, low, high);
    }
  }
  template <typename Number>
  static int place(Number value, Number least, Number most) {
    return value < least ? -1 : most < value ? 1 : 0;  // a limit that is no number is none
  }
  static std::int64_t extended(std::uint64_t bits, unsigned unused) {
    return unused < 64 ? static_cast<std::int64_t>(bits << unused) >> unused : 0;
  }
  static double real(std::uint64_t bits, std::uint32_t bytes) {
    double number = 0;
    float single = 0;
    std::memcpy(&single, &bits, sizeof single);
    std::memcpy(&number, &bits, sizeof number);
    return bytes == 4 ? static_cast<double>(single) : number;
  }
};

/// A string in the memory that resets set, with its length.
struct Dictionary::String {
  CO_OBJ_STR_RW string;
  std::uint64_t* length;
  const CO_OBJ_TYPE* plain;

  static String& of(CO_OBJ* obj) {
    auto& string = *static_cast<String*>(obj->Data);
    string.string.Size = static_cast<std::uint32_t>(*string.length);
    return string;
  }
  static const CO_OBJ_TYPE type;
};

const CO_OBJ_TYPE Dictionary::String::type = {
    [](CO_OBJ* obj, CO_NODE* node, std::uint32_t width) { return of(obj).plain->Size(obj, node, width); },
    [](CO_OBJ* obj, CO_NODE* node) { return call_init(*of(obj).plain, obj, node); },
    [](CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
      return of(obj).plain->Read(obj, node, buffer, size);
    },
    [](CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
      const String& stored = of(obj);
      const CO_ERR error = stored.plain->Write(obj, node, buffer, size);
      *stored.length = stored.string.Size;
      return error;
    },
    [](CO_OBJ* obj, CO_NODE* node, std::uint32_t position) { return of(obj).plain->Reset(obj, node, position); }};

/// A heartbeat consumer whose value is in the memory that resets set.
struct Dictionary::Consumer {
  CO_HBCONS consumer;
  std::uint64_t* value;

  static Consumer& of(CO_OBJ* obj) { return *static_cast<Consumer*>(obj->Data); }
  static const CO_OBJ_TYPE type;
};

const CO_OBJ_TYPE Dictionary::Consumer::type = {
    [](CO_OBJ* obj, CO_NODE* node, std::uint32_t width) { return CO_THB_CONS->Size(obj, node, width); },
    [](CO_OBJ* obj, CO_NODE* node) {
      Consumer& entry = of(obj);
      entry.consumer.Time = static_cast<std::uint16_t>(*entry.value);
      entry.consumer.NodeId = static_cast<std::uint8_t>(*entry.value >> 16);
      return CO_THB_CONS->Init(obj, node);
    },
    [](CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
      return CO_THB_CONS->Read(obj, node, buffer, size);
    },
    [](CO_OBJ* obj, CO_NODE* node, void* buffer, std::uint32_t size) {
      const CO_ERR error = CO_THB_CONS->Write(obj, node, buffer, size);
      Consumer& entry = of(obj);
      *entry.value = static_cast<std::uint32_t>(entry.consumer.NodeId) << 16 | entry.consumer.Time;
      return error;
    },
    nullptr};

Dictionary::Dictionary(const codict::Device& device, const std::string& file) {
  codict::gen::Options options;
  options.name = "od";
  options.string_capacity = string_bytes;
  options.trigger_tpdos = true;
  codict::Findings findings;
  codict::Device plain = device;
  for (codict::Object& object : plain.objects) {  // 1010h stores everything that the network can write
    object.node.edit().storage_group = {};
    for (codict::Sub& sub : object.subs) {
      sub.node.edit().storage_group = {};
    }
  }
  const Plan plan = codict::gen::make_plan(plain, options, findings);
  for (const codict::Finding& finding : findings.all()) {
    const bool is_switched_off = finding.text.find("is switched off") != std::string::npos;
    if (finding.severity == codict::Severity::error || is_switched_off) {
      left_out_.push_back(codict::message_of(finding));
    }
  }
  note_excess(plan);
  build(plan, file);
}

/// Names the PDOs, SDO servers and the like that the stack of this program does not have.
void Dictionary::note_excess(const Plan& plan) {
  struct Service {
    std::uint16_t first;
    std::uint16_t last;  // the same for an array
    unsigned most;
    const char* name;
  };
  constexpr Service services[] = {{0x1016, 0x1016, CO_HBCONS_N, "heartbeat consumers"},
                                  {0x1028, 0x1028, CO_EMCY_CONS_N, "EMCY consumers"},
                                  {0x1200, 0x127F, CO_SSDO_N, "SDO servers"},
                                  {0x1280, 0x12FF, CO_CSDO_N, "SDO clients"},
                                  {0x1301, 0x1340, CO_SRDO_N, "SRDOs"},
                                  {0x1400, 0x15FF, CO_RPDO_N, "RPDOs"},
                                  {0x1800, 0x19FF, CO_TPDO_N, "TPDOs"}};
  for (const Service& service : services) {
    const auto excess = std::count_if(plan.items.begin(), plan.items.end(), [&](const Item& item) {
      const bool is_one = service.first == service.last || item.sub_index == 1;
      return item.index >= service.first && item.index <= service.last && is_one &&
             !co::rules::is_configured(item.key());
    });
    if (excess != 0) {
      left_out_.push_back(
          fmt::format("{} left out: {}; this program has the first {}", service.name, excess, service.most));
    }
  }
}

Dictionary::~Dictionary() = default;

void Dictionary::build(const Plan& plan, const std::string& file) {
  memory_ = std::make_unique<Memory>(plan);
  add_storage(plan);
  for (const Item& item : plan.items) {
    if (co::rules::is_configured(item.key())) {
      add(item, *memory_, file);
    }
  }
  memory_->keep_defaults();
  const std::uint32_t communication = memory_->communication_bytes();
  defaults_ = {{memory_->written(), memory_->defaults(), communication, CO_RESET_COM},
               {memory_->written() + communication, memory_->defaults() + communication,
                memory_->written_bytes() - communication, CO_RESET_NODE},
               {nullptr, nullptr, 0, CO_RESET_INVALID}};
  if (defaults_[1].Size == 0) {
    defaults_.erase(defaults_.begin() + 1);
  }
  if (communication == 0) {
    defaults_.erase(defaults_.begin());
  }
  for (CO_PARA& group : groups_) {
    group.Default = group.Size != 0
                        ? memory_->defaults() + (static_cast<std::uint8_t*>(group.Start) - memory_->written())
                        : nullptr;
  }
  objects_.push_back(CO_OBJ_DICT_DEFAULTS(defaults_));
}

/// Makes the parameter groups of 1010h: sub-index 1 is all, 2 the communication profile, 3 the application.
void Dictionary::add_storage(const Plan& plan) {
  storage_size_ = lss_memory_size;
  const std::uint32_t communication = memory_->communication_bytes();
  const std::uint32_t all = memory_->written_bytes();
  const auto add_group = [&](std::uint32_t first, std::uint32_t size, std::uint32_t of_communication) {
    CO_PARA group{};
    group.Offset = storage_size_;
    group.Size = size;
    group.Start = size != 0 ? memory_->written() + first : nullptr;
    group.Type = CO_RESET_NODE;
    group.Value = CO_PARA___E | CO_PARA_VERSION(memory_->version());
    group.ComSize = of_communication;
    if (size != 0) {
      storage_size_ += CO_PARA_SPACE(size, 1U, 1U);
    }
    groups_.push_back(group);
  };
  const bool is_divided = plan.find(store_parameters, 2) != nullptr;
  add_group(0, is_divided ? 0 : all, is_divided ? 0 : communication);
  add_group(0, is_divided ? communication : 0, is_divided ? communication : 0);
  add_group(communication, is_divided ? all - communication : 0, 0);
  add_group(0, 0, 0);
}

void Dictionary::add(const Item& item, Memory& memory, const std::string& file) {
  const CO_OBJ_TYPE* type = type_named(item.type);
  CO_DATA data = std::uintptr_t{0};
  switch (item.storage) {
    case Storage::direct: data = static_cast<std::uintptr_t>(stored_number(item)); break;
    case Storage::text:
      bytes_.push_back(bytes_of_value(item));
      texts_.push_back({0, reinterpret_cast<const std::uint8_t*>(bytes_.back().c_str())});
      data = &texts_.back();
      break;
    case Storage::domain:
      bytes_.push_back(bytes_of_value(item));
      bytes_.back().resize(std::max<std::size_t>(bytes_.back().size(), item.capacity));
      domains_.push_back(
          {0, static_cast<std::uint32_t>(bytes_.back().size()), reinterpret_cast<std::uint8_t*>(bytes_.back().data())});
      data = &domains_.back();
      break;
    case Storage::group: {
      const std::size_t group = std::min<std::size_t>(item.sub_index, 4) - 1;
      data = &groups_[group];
      break;
    }
    case Storage::eds:
      bytes_.push_back(file);
      constants_.push_back(
          {0, static_cast<std::uint32_t>(file.size()), reinterpret_cast<const std::uint8_t*>(bytes_.back().data())});
      data = &constants_.back();
      break;
    case Storage::consumer:
      consumers_.push_back({{}, memory.of(item)});
      *memory.of(item) = stored_number(item);
      type = &Consumer::type;
      data = &consumers_.back();
      break;
    case Storage::shared:
    case Storage::application:
    case Storage::error_bits: type = nullptr; break;
    default:
      if (is_number(item)) {
        *memory.of(item) = stored_number(item);
        data = memory.of(item);
      } else if (is_stored_string(item)) {
        const std::string value = bytes_of_value(item);
        std::uint64_t* const length = memory.of(item);
        auto* const start = reinterpret_cast<std::uint8_t*>(length + 1);
        std::memcpy(start, value.data(), value.size());
        *length = value.size();
        const std::uint32_t capacity = capacity_of(item) - 2;
        const bool is_text = type == CO_TSTRING;
        strings_.push_back({{0, 0, capacity, start}, length, is_text ? CO_TVISIBLE_STRING : type});
        type = &String::type;
        data = &strings_.back();
      } else {
        bytes_.emplace_back(domain_bytes, '\0');
        domains_.push_back({0, domain_bytes, reinterpret_cast<std::uint8_t*>(bytes_.back().data())});
        type = CO_TDOMAIN;
        data = &domains_.back();
      }
      break;
  }
  if (type == nullptr) {
    left_out_.push_back(
        fmt::format("{} '{}' has a type that is not simulated", codict::gen::place_name(item), item.name));
    return;
  }
  if (item.index >= first_application || (item.is_limited() && item.place == nullptr)) {
    type = guarded(item, type);
  }
  objects_.push_back({item.key() | item.flags, type, data});
}

const CO_OBJ_TYPE* Dictionary::guarded(const Item& item, const CO_OBJ_TYPE* type) {
  const auto signed_bits = [&](std::uint64_t bits) {
    const unsigned unused = 64 - 8U * item.form->size;
    return static_cast<std::uint64_t>(Guard::extended(bits, unused));
  };
  const TypeKind kind = codict::data_type(item.form->code).kind;
  const bool is_signed = kind == TypeKind::signed_integer;
  const bool is_limited = item.is_limited() && is_number(item);
  guards_.push_back(
      {{Guard::size, Guard::init, Guard::read, Guard::write, type->Reset != nullptr ? Guard::reset : nullptr},
       type,
       this,
       item.index,
       item.sub_index,
       kind,
       is_limited,
       is_limited && is_signed ? signed_bits(item.limits->low_bits) : item.limits->low_bits,
       is_limited && is_signed ? signed_bits(item.limits->high_bits) : item.limits->high_bits,
       0});
  return &guards_.back().type;
}

void Dictionary::set_number(std::uint16_t index, std::uint8_t sub_index, std::uint64_t value) {
  const std::uint32_t key = std::uint32_t{index} << 16 | std::uint32_t{sub_index} << 8;
  for (CO_OBJ& object : objects_) {
    if ((object.Key & 0xFFFFFF00U) == key) {
      object.Data = (object.Key & CO_OBJ_D_____) != 0 ? CO_DATA(value) : object.Data;
      if ((object.Key & CO_OBJ_D_____) == 0) {
        *static_cast<std::uint64_t*>(object.Data) = value;
      }
    }
  }
}

/// Returns an object without its guard.
CO_OBJ Dictionary::plain(const CO_OBJ& object) const {
  CO_OBJ plain = object;
  const auto is_guard = [&](const Guard& guard) { return &guard.type == object.Type; };
  const auto found = std::find_if(guards_.begin(), guards_.end(), is_guard);
  plain.Type = found != guards_.end() ? found->plain : object.Type;
  return plain;
}

bool Dictionary::write(CO_OBJ& object, CO_NODE& node, const Bytes& value) {
  CO_OBJ copy = plain(object);
  copy.Key &= ~static_cast<std::uint32_t>(CO_OBJ___A___);  // the caller decides whether TPDOs are sent
  Bytes bytes = value;
  const auto size = static_cast<std::uint32_t>(bytes.size());
  const bool is_direct = (object.Key & CO_OBJ_D_____) != 0;
  if (is_direct || copy.Type->Write == nullptr || size == 0 || copy.Type->Size(&copy, &node, size) != size) {
    return false;
  }
  if (copy.Type->Reset != nullptr) {
    copy.Type->Reset(&copy, &node, 0);
    copy.Type->Write(&copy, &node, bytes.data(), 0);
  }
  return copy.Type->Write(&copy, &node, bytes.data(), size) == CO_ERR_NONE;
}

std::optional<Bytes> Dictionary::read(CO_OBJ& object, CO_NODE& node) {
  CO_OBJ copy = plain(object);
  Bytes bytes(8);
  const std::uint32_t size = copy.Type->Size(&copy, &node, 0);
  if (size == 0 || size > bytes.size() || copy.Type->Read == nullptr) {
    return std::nullopt;
  }
  bytes.resize(size);
  if (copy.Type->Reset != nullptr) {
    copy.Type->Reset(&copy, &node, 0);
  }
  return copy.Type->Read(&copy, &node, bytes.data(), size) == CO_ERR_NONE ? std::optional(bytes) : std::nullopt;
}

bool Dictionary::refuse(std::uint16_t index, std::uint8_t sub_index, std::uint32_t code) {
  const auto found = std::find_if(guards_.begin(), guards_.end(), [=](const Guard& guard) {
    return guard.index == index && guard.sub_index == sub_index;
  });
  if (found == guards_.end()) {
    return false;
  }
  found->abort = code;
  return true;
}

}  // namespace lexican::simulate
