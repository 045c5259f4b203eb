// SPDX-License-Identifier: Apache-2.0
#include "extra/od/properties.hpp"

#if USE_OD

#include "dictionary/obj.hpp"
#include "dictionary/types/stream.hpp"
#include "wire/bytes.hpp"

// Weak: a comparison with the address of a type does not link the type.
#pragma weak ODTypeInit
#pragma weak COTInt8
#pragma weak COTInt16
#pragma weak COTInt32
#pragma weak COTInt64
#pragma weak COTBoolean
#pragma weak COTReal32
#pragma weak COTReal64
#pragma weak COTUnsigned24
#pragma weak COTUnsigned40
#pragma weak COTUnsigned48
#pragma weak COTUnsigned56
#pragma weak COTSigned24
#pragma weak COTSigned40
#pragma weak COTSigned48
#pragma weak COTSigned56
#pragma weak COTString
#pragma weak COTVisibleString
#pragma weak COTOctetString
#pragma weak COTUnicodeString
#pragma weak COTDomain
#pragma weak ODTNumber

namespace co {

const CO_OBJ_TYPE* stream::original_type(const CO_OBJ& obj) {
  const bool has_original = obj.Type->Init != nullptr && obj.Type->Init == ODTypeInit;
  return has_original ? reinterpret_cast<const OD_TYPE*>(obj.Type)->Original : obj.Type;
}

namespace od {
namespace {

bool is_wide(const CO_OBJ_TYPE* type) {
  return type == &COTInt64 || type == &COTReal64 || type == &COTUnsigned40 || type == &COTUnsigned48 ||
         type == &COTUnsigned56 || type == &COTSigned40 || type == &COTSigned48 || type == &COTSigned56;
}

// Returns the bytes of the variable of a number; 0: the type is not a number type of this library.
unsigned storage_of(const CO_OBJ_TYPE* type) {
  if (type == &COTInt8 || type == &COTBoolean) {
    return 1;
  }
  if (type == &COTInt16) {
    return 2;
  }
  if (type == &COTInt32 || type == &COTReal32 || type == &COTUnsigned24 || type == &COTSigned24) {
    return 4;
  }
  return is_wide(type) ? longest_number : 0;
}

// Returns the address of the value of a number whose variable has storage bytes; null: storage is 0. With flag D the
// value is in the least significant bytes of Data.
void* address_of_number(CO_OBJ& obj, unsigned storage) {
  if (storage == 0) {
    return nullptr;
  }
  if (CO_IS_DIRECT(obj.Key) == 0) {
    return data_of<void>(obj);
  }
  const size_t above = wire::host_is_little_endian || storage >= sizeof obj.Data ? 0 : sizeof obj.Data - storage;
  return reinterpret_cast<uint8_t*>(&obj.Data) + above;
}

// Returns the permissions of SDO and PDO as bits ODA_….
OD_attr_t rights_of(const CO_OBJ& obj) {
  constexpr unsigned transmit = CO_SRDO_N > 0 ? unsigned{ODA_TPDO} | ODA_TSRDO : unsigned{ODA_TPDO};
  constexpr unsigned receive = CO_SRDO_N > 0 ? unsigned{ODA_RPDO} | ODA_RSRDO : unsigned{ODA_RPDO};
  const bool mappable = CO_IS_PDOMAP(obj.Key) != 0;
  unsigned rights = 0;
  if (CO_IS_READ(obj.Key) != 0) {
    rights |= mappable ? unsigned{ODA_SDO_R} | transmit : unsigned{ODA_SDO_R};
  }
  if (CO_IS_WRITE(obj.Key) != 0) {
    rights |= mappable ? unsigned{ODA_SDO_W} | receive : unsigned{ODA_SDO_W};
  }
  return static_cast<OD_attr_t>(rights);
}

// Returns the length of an upload in bytes; 0 if it is not known yet.
uint32_t size_of(CO_OBJ& obj, CO_NODE& node, const CO_OBJ_TYPE& type) {
  const uint32_t size = type.Size == nullptr ? 0 : type.Size(&obj, &node, 0);
  return size == CO_OBJ_SIZE_UNKNOWN ? 0 : size;
}

// Returns the kind of an entry whose type has a Reset function.
Kind kind_of_stream(const CO_OBJ_TYPE* type) {
  if (type == &COTVisibleString || type == &COTUnicodeString) {
    return Kind::text;
  }
  if (type == &COTOctetString) {
    return Kind::octets;
  }
  if (type == &COTString) {
    return Kind::constant_text;
  }
  return type == &COTDomain ? Kind::domain : Kind::application_stream;
}

void add_attribute(Properties& properties, OD_attributes_t attribute) {
  properties.attribute = static_cast<OD_attr_t>(properties.attribute | attribute);
}

void describe_string(const CO_OBJ& obj, Properties& properties) {
  const auto* const string = data_of<const CO_OBJ_STR_RW>(obj);
  if (string != nullptr) {
    properties.memory = string->Start;
    properties.length = string->Capacity;
  }
}

Kind kind_of(CO_OBJ& obj, CO_NODE& node, const CO_OBJ_TYPE* type) {
  if (type == nullptr) {
    return Kind::none;
  }
  if (type->Reset != nullptr) {
    return kind_of_stream(type);
  }
  return size_of(obj, node, *type) <= longest_number ? Kind::number : Kind::long_value;
}

}  // namespace

bool can_seek(const CO_OBJ_TYPE& type) {
  const CO_OBJ_TYPE_EX* const type_ex = extended_type(&type);
  return type_ex == nullptr ? type.Reset != nullptr : type_ex->Reset != nullptr;
}

CO_ERR seek(CO_OBJ& obj, CO_NODE& node, const CO_OBJ_TYPE& type, uint32_t position) {
  const CO_OBJ_TYPE_EX* const type_ex = extended_type(&type);
  const CO_OBJ_RESET_FUNC reset = type_ex == nullptr ? type.Reset : type_ex->Reset;
  return reset == nullptr ? CO_ERR_NONE : reset(&obj, &node, position);
}

unsigned bytes_of_character(const CO_OBJ_TYPE* original) {
  return original != nullptr && original == &COTUnicodeString ? 2 : 1;
}

Properties properties_of(CO_OBJ& obj, CO_NODE& node) {
  const CO_OBJ_TYPE* const type = original_type(obj);
  Properties properties = {kind_of(obj, node, type), type, nullptr, 0, rights_of(obj)};
  switch (properties.kind) {
    case Kind::none:  // without original type, Data is the length
      properties.length = static_cast<OD_size_t>(uintptr_t{obj.Data});
      break;
    case Kind::text: add_attribute(properties, ODA_STR); [[fallthrough]];
    case Kind::octets: describe_string(obj, properties); break;
    case Kind::constant_text:
      add_attribute(properties, ODA_STR);
      if (const auto* const text = data_of<const CO_OBJ_STR>(obj); text != nullptr) {
        properties.memory = const_cast<uint8_t*>(text->Start);
      }
      properties.length = size_of(obj, node, *properties.type);
      break;
    case Kind::domain:
      if (const auto* const domain = data_of<const CO_OBJ_DOM>(obj); domain != nullptr) {
        properties.memory = domain->Start;
        properties.length = domain->Size;
      }
      break;
    default:  // number, long_value, application_stream
      properties.memory = address_of_number(obj, storage_of(properties.type));
      properties.length = size_of(obj, node, *properties.type);
      break;
  }
  const bool is_number = properties.kind == Kind::number || obj.Type == &ODTNumber.Ex.Type;
  if (is_number && properties.length > 1) {
    add_attribute(properties, ODA_MB);
  }
  return properties;
}

OD_stream_t stream_of(CO_OBJ& obj, CO_NODE& node) {
  const Properties properties = properties_of(obj, node);
  OD_stream_t stream = {};
  stream.dataOrig = properties.memory;
  stream.dataLength = properties.length;
  stream.attribute = properties.attribute;
  stream.index = CO_GET_IDX(obj.Key);
  stream.subIndex = CO_GET_SUB(obj.Key);
  stream.Entry = &obj;
  stream.Owner = &node;
  return stream;
}

}  // namespace od
}  // namespace co

#endif
